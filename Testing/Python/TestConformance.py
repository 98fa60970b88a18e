# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Without a material the mappers are the stock ones, pixel for pixel; with one, every picture is right.

    TestConformance.py              every scene of conformance/; exit status 1 if one fails
    TestConformance.py NAME...      these
    TestConformance.py --list

Each scene is drawn in a worker process, so that a crash is one failure and the others go on. What a scene
must show stands in conformance/scene.py.
"""

import os
import re
import subprocess
import sys
import tempfile

# Warnings that the documentation promises for the anisotropic material.
DOCUMENTED = ("no float point tangents",)


def load():
    from conformance import composites, passes, scene, surfaces  # noqa: F401 (they register their scenes)

    return scene


class Log:
    """VTK's messages, which would go to the terminal."""

    def __init__(self):
        from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)
        self.seen = 0

    def take(self):
        """The messages since the last call."""
        text = self.window.GetOutput()
        new, self.seen = text[self.seen :], len(text)
        return [part.strip() for part in re.split(r"\n\s*\n", new) if part.strip()]


def draw(make, factory, log, draw_extra=True):
    """Pixels, depth, what else was asked for, and messages."""
    view = make(factory)
    try:
        pixels, depth = view.draw()
        extra = view.extra(view) if view.extra and draw_extra else None
    finally:
        if hasattr(view, "at_end"):
            view.at_end()
    return view, pixels, depth, extra, log.take()


def difference(a, b):
    """Number of pixels that differ and the largest difference."""
    if len(a) != len(b):
        return "sizes differ"
    pixels = sum(a[k : k + 4] != b[k : k + 4] for k in range(0, len(a), 4))
    return "%d pixels differ, by up to %d" % (pixels, max(abs(x - y) for x, y in zip(a, b)))


def strip_addresses(messages):
    """Messages without addresses, file lines and class names, which differ between runs."""
    return sorted(re.sub(r"0x[0-9a-f]+|\([^)]*\)|line \d+|In \S+|vtk\w*Mapper\w*", "", m) for m in messages)


def run_furnace(scene, make, factories, log, stock, drawn):
    """What is wrong with a scene in the furnace."""
    pixels, depth, extra, said = drawn
    problems = []
    view, lit, depth_lit, extra_lit, said_lit = draw(make, factories["furnace"], log)
    said_lit = [m for m in said_lit if not any(a in m for a in stock.may_warn)]
    if strip_addresses(said_lit) != strip_addresses(said):
        problems.append("furnace: messages %s" % said_lit)
    if view.expect == "stock":
        dark = draw(make, factories["dark"], log, False)[1]
        if dark != lit:
            problems.append("furnace, where the superclass draws: " + difference(dark, lit))
    elif view.expect == "lit stock":
        if lit != pixels:
            problems.append("furnace: " + difference(lit, pixels))
    else:
        wrong = scene.check_picture(view, lit)
        if wrong:
            problems.append("furnace: " + wrong)
    if view.grab is None and depth_lit != depth:
        problems.append("furnace: depths differ from stock's")
    if extra_lit != extra:
        problems.append("furnace: %s instead of %s" % (extra_lit, extra))
    return problems


def run(scene, name, factories, log):
    """What is wrong with a scene, a list."""
    make = scene.SCENES[name]
    problems = []
    try:
        stock, pixels, depth, extra, said = draw(make, factories["stock"], log)
    except AttributeError as missing:
        raise scene.Unavailable("this VTK lacks something: %s" % missing) from missing
    _, plain_pixels, plain_depth, plain_extra, plain_said = draw(make, factories["plain"], log)
    if plain_pixels != pixels:
        problems.append("without a material: " + difference(plain_pixels, pixels))
    if plain_depth != depth:
        problems.append("without a material: depths differ")
    if plain_extra != extra:
        problems.append("without a material: %s instead of %s" % (plain_extra, extra))
    if strip_addresses(plain_said) != strip_addresses(said):
        problems.append("without a material: messages %s instead of %s" % (plain_said, said))

    if stock.has_furnace:
        problems += run_furnace(scene, make, factories, log, stock, (pixels, depth, extra, said))

    # What the tangents come from is a matter of the data.
    for kind in ("material", "brushed") if make.__module__.endswith("surfaces") else ("material",):
        view, shiny, _, _, said = draw(make, factories[kind], log, False)
        said = [m for m in said if not any(a in m for a in stock.may_warn + DOCUMENTED)]
        if strip_addresses(said) != strip_addresses(plain_said):
            problems.append("%s: messages %s" % (kind, said))
        black, black_stock = scene.count(shiny, (0, 0, 0)), scene.count(pixels, (0, 0, 0))
        if black > black_stock and not view.dark:
            problems.append("%s: %d black pixels, stock %d" % (kind, black, black_stock))
        if kind == "material" and not scene.is_finite(view):
            problems.append("%s: NaN or infinite values in a frame buffer of floats" % kind)
        for color, share in view.at_most.items():
            found = scene.count(shiny, color)
            if 4 * found > share * len(shiny):
                problems.append("%s: %d pixels are %s" % (kind, found, color))
    return problems


def work(names):
    """The worker: a line before and after each scene."""
    log = Log()
    scene = load()
    factories = {
        "stock": scene.Stock(),
        "dark": scene.Dark(),
        "plain": scene.Plain(),
        "furnace": scene.Furnace(),
        "material": scene.Material(),
        "brushed": scene.Brushed(),
    }
    for name in names:
        print("BEGIN", name, flush=True)
        try:
            problems = run(scene, name, factories, log)
            print("PROBLEMS " + " | ".join(p.replace("\n", " ") for p in problems) if problems else "PASS", flush=True)
        except scene.Unavailable as reason:
            print("SKIP", reason, flush=True)
        except Exception as problem:  # the other scenes go on
            log.take()
            print("PROBLEMS %s: %s" % (type(problem).__name__, str(problem).replace("\n", " ")), flush=True)


def results_of(names):
    """(name, verdict) of each scene; a worker that dies is started again behind the scene that killed it."""
    rest = list(names)
    while rest:
        with tempfile.TemporaryFile("w+") as errors:
            worker = subprocess.Popen([sys.executable, os.path.abspath(__file__), "--worker"] + rest,
                                      stdout=subprocess.PIPE, stderr=errors, text=True)  # fmt: skip
            current = None
            for line in worker.stdout:
                word, _, text = line.rstrip("\n").partition(" ")
                if word == "BEGIN":
                    current = text
                    rest.remove(current)
                elif current and word in ("PASS", "PROBLEMS", "SKIP"):
                    yield current, word, text
                    current = None
            status = worker.wait()
            errors.seek(0)
            said = " ".join(errors.read()[-300:].split())
        if current:
            yield current, "PROBLEMS", "crashed with status %d: %s" % (status, said)
        elif status:
            sys.exit("the worker failed: " + said)


def main(arguments):
    if arguments[:1] == ["--worker"]:
        work(arguments[1:])
        return 0
    scene = load()
    names = arguments if arguments and arguments != ["--list"] else list(scene.SCENES)
    if arguments == ["--list"]:
        print("\n".join(names))
        return 0
    import vtkmeasuredbrdf

    if not hasattr(vtkmeasuredbrdf, "vtkCompositeMeasuredBRDFMapper"):
        left_out = [name for name in names if name.startswith("composite_")]
        print("%d scenes of composites are skipped: no vtkCompositeMeasuredBRDFMapper" % len(left_out))
        names = [name for name in names if name not in left_out]
    failed = 0
    counts = {"PASS": 0, "PROBLEMS": 0, "SKIP": 0}
    for name, verdict, text in results_of(names):
        counts[verdict] += 1
        if verdict != "PASS":
            print("%-8s %s: %s" % (verdict, name, text[:600]), flush=True)
    print(", ".join("%s %d" % (k.lower(), v) for k, v in counts.items()))
    if counts["SKIP"] > 6:
        print("too many scenes were skipped")
    return 1 if counts["PROBLEMS"] or counts["SKIP"] > 6 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
