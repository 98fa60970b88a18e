#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes results.md and its charts from folders that `measured-brdf chart` made: make-results.py FOLDER DOCS [PLANS].

PLANS are folders of measurements of the planner alone: with more materials, on another mesh, or plans for the view.

People write the text between the lines CONCLUSIONS and END. It is kept from the earlier results.md.
"""

import collections
import json
import math
import os
import shutil
import statistics
import sys

CHARTS = {
    "summary": "Error against the time of a frame",
    "setup": "Error against set-up time",
    "memory": "Error against texture memory",
}
CONCLUSIONS, END = "<!-- conclusions: written by people, kept -->", "<!-- end of conclusions -->"
METRIC = "relative_l1"
WITHIN = 1.2  # of the front's time


def mean(values):
    return math.exp(statistics.fmean(math.log(max(value, 1e-9)) for value in values))


def percent(share):
    return f"{100 * share:.2g}"


def error(point):
    return point["errors"][METRIC]


def measured(pair):
    return [point for point in pair["points"] if "left_out" not in point]


def describe(point):
    return f"{point['method']} {point['size']}".strip()


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines) + "\n"


def write_methods(pairs):
    """Geometric means; of sizes that some pairs left out, over the others, with their number."""
    points = collections.defaultdict(list)
    for pair in pairs:
        for point in measured(pair):
            if point["method"] != "planner":
                points[point["method"], point["size"]].append(point)
    stock = mean([point["frame_ms"] for point in points["pbr", ""]])
    rows = []
    for (method, size), some in points.items():
        frame = mean([point["frame_ms"] for point in some])
        memory = [point["texture_bytes"] for point in some]
        rows.append(
            [
                method,
                size,
                percent(mean([error(point) for point in some])),
                f"{frame:.3g}",
                f"{frame / stock:.2g}" if len(some) == len(pairs) else "",
                f"{mean([point['setup_ms'] for point in some]):.3g}",
                f"{1e-6 * mean(memory):.2g}",
                f"{statistics.fmean(point['texture_fetches'] for point in some):.3g}",
                len(some),
            ]
        )
    return table(
        ["method", "size", "error %", "frame ms", "frame / PBR's", "set-up ms", "MB", "fetches", "pairs"], rows
    )


def find_stock(pair):
    return next(point for point in measured(pair) if point["method"] == "pbr")


def is_announced(point, tolerance):
    """Whether the plan said that this picture may miss the tolerance."""
    return not point["meets_tolerance"] or point.get("predicted_picture_error", 0.0) > tolerance


def write_planner(pairs, front=True, in_view=True):
    """A line for each tolerance, planned for every view and (in_view) for this one; front: whether one was measured."""
    figures = collections.defaultdict(list)
    for pair in pairs:
        for figure in pair["planner"]:
            key = (figure.get("in_view", False), figure["tolerance"])
            if key[0] and not in_view:
                continue
            figures[key].append((figure["time_over_front"], pair["points"][figure["point"]], find_stock(pair)))
    fits, costs = [], []
    for (in_view, tolerance), some in sorted(figures.items()):
        name = f"{percent(tolerance)} %" + (", in view" if in_view else "")
        times = [time for time, _, _ in some]
        points = [point for _, point, _ in some]
        met = sum(error(point) <= tolerance for point in points)
        median = sum(point["errors"]["median_relative"] <= tolerance for point in points)
        above = [point for point in points if error(point) > tolerance and point["meets_tolerance"]]
        broken = sum(not is_announced(point, tolerance) for point in above)
        # Below a thousandth nobody asked for a prediction.
        ratios = [point["predicted_error"] / max(error(point), 1e-3) for point in points]
        fits.append(
            [
                name,
                len(some),
                met,
                median,
                f"{len(above)}, {broken}",
                sum(not is_announced(point, tolerance) for point in points),
                f"{sum(1 / 3 <= ratio <= 3 for ratio in ratios)}, {sum(ratio < 0.5 for ratio in ratios)}",
            ]
        )
        if front:
            fits[-1].append(f"{100 * sum(time <= WITHIN for time in times) / len(times):.0f} %")
            fits[-1].append(f"{max(times):.2g}")
        frames = [point["frame_ms"] / stock["frame_ms"] for _, point, stock in some]
        setups = [point["setup_ms"] / stock["setup_ms"] for _, point, stock in some]
        memory = [point["texture_bytes"] for point in points]
        fetches = [point["texture_fetches"] for point in points]
        costs.append(
            [
                name,
                f"{mean(frames):.2f}",
                f"{max(frames):.2g}",
                f"{mean(setups):.2f}",
                f"{max(setups):.2g}",
                f"{1e-6 * mean(memory):.2g}",
                sum(size <= 4e6 for size in memory),
                f"{statistics.fmean(fetches):.1f}, {max(fetches)}",
            ]
        )
    first = table(
        [
            "tolerance",
            "pairs",
            "error within it",
            "median pixel's error within it",
            "above it, though the plan meets it in the mean of all views; of these, not announced for single pictures",
            "plans that promise it for every picture",
            "prediction within a factor of 3; below half the error",
            *(["at most 20 % slower than the front", "worst time / front's"] if front else []),
        ],
        fits,
    )
    second = table(
        ["tolerance", "frame / PBR's, mean", "worst", "set-up / PBR's, mean", "worst", "MB, mean", "pairs within 4 MB", "fetches, mean and most"],
        costs,
    )
    return first + "\n" + second


def write_pairs(pairs, tolerance):
    environments = list(dict.fromkeys(pair["environment"] for pair in pairs))
    cells = collections.defaultdict(dict)
    for pair in pairs:
        stock = find_stock(pair)
        for figure in pair["planner"]:
            if figure["tolerance"] == tolerance and not figure.get("in_view", False):
                point = pair["points"][figure["point"]]
                text = f"{percent(error(point))} / {point['frame_ms'] / stock['frame_ms']:.2g}"
                if error(point) > tolerance:
                    text = f"**{text}**" + (" †" if is_announced(point, tolerance) else "")
                cells[pair["material"]][pair["environment"]] = text
    rows = [[material, *(row.get(name, "") for name in environments)] for material, row in cells.items()]
    return table(["material", *environments], rows)


def describe_occlusion(pairs):
    """What leaving occlusion out costs on this mesh, where the chart says so."""
    errors = [pair.get("unoccluded_error") for pair in pairs]
    if any(value is None for value in errors):
        return "No prediction of occlusion was measured."
    middle, largest = statistics.median(errors), max(errors)
    return (
        f"Light is unoccluded in all of these figures. On this mesh that alone is predicted to be {percent(middle)} % off in "
        f"the median, at most {percent(largest)} %."
    )


def write_best(pairs, tolerance):
    """Per material, the fastest of all that was measured within the tolerance, by environment."""
    best = collections.defaultdict(collections.Counter)
    for pair in pairs:
        good = [p for p in measured(pair) if p["method"] != "planner" and error(p) <= tolerance]
        chosen = min(good, key=lambda point: point["frame_ms"], default=None)
        best[pair["material"]][describe(chosen) if chosen else "nothing"] += 1
    rows = [
        [material, ", ".join(f"{name} ({count})" for name, count in names.most_common())]
        for material, names in best.items()
    ]
    return table(["material", f"fastest within {percent(tolerance)} % (environments)"], rows)


def keep_conclusions(path):
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        if CONCLUSIONS in text and END in text:
            return text.split(CONCLUSIONS)[1].split(END)[0].strip("\n")
    return "*To be written from the tables below.*"


def has_view(results):
    return any(figure.get("in_view", False) for pair in results["pairs"] for figure in pair["planner"])


def read_results(folder):
    with open(os.path.join(folder, "results.json"), encoding="utf-8") as file:
        results = json.load(file)
    if (results["format"], results["version"]) != ("measured-brdf chart", 1):
        sys.exit(f"{folder}/results.json: not of the format that this script reads")
    return results


def main():
    folder, docs, *plans = sys.argv[1:]
    results = read_results(folder)
    pairs, machine, settings = results["pairs"], results["machine"], results["settings"]
    materials = len({pair["material"] for pair in pairs})
    environments = len({pair["environment"] for pair in pairs})
    tolerances = sorted({figure["tolerance"] for pair in pairs for figure in pair["planner"]})
    tolerance = 0.02 if 0.02 in tolerances else tolerances[0]
    load = statistics.median(pair["load"] for pair in pairs)
    others = [read_results(other) for other in plans]
    path = os.path.join(docs, "results.md")
    kept = keep_conclusions(path)

    parts = [
        "# Speed against accuracy",
        f"{materials} materials under {environments} environments, {len(pairs)} pairs, a {settings['mesh']} in "
        f"{settings['size']} pixels, at most {settings['reference_pixels']} of which were compared with the reference. "
        f"{machine['processor']}, "
        f"{machine['threads']} threads, {machine['renderer']} ({machine['renderer_version']}), VTK {machine['vtk']}, "
        f"{results['date']}; median load of the machine when a pair began: {load:.1f}. Errors are relative L1, mean "
        "|x − r| / mean r. The methods' frames were drawn in turns; a frame time is the median. Set-up is everything "
        "until the first frame is done; the planner's includes the planning.",
        "`cmake/make-results.sh DATA` makes this page. It also writes all figures to results.csv and results.json.",
        CONCLUSIONS + "\n\n" + kept + "\n\n" + END,
        "## Charts",
        *(f"![{caption}](results-{name}.png)\n\n*{caption}.*" for name, caption in CHARTS.items()),
        "## Methods",
        "All figures are geometric means over the pairs. Where a size was too slow to measure in some pairs, its mean is "
        "over the other pairs only and cannot be compared with the rest. The numbers of a size are: `thesis`, lights and "
        "order; `table`, rows, view angles and azimuths; `hybrid`, the same and maps. Fetches are of textures for a pixel, "
        "their mean; where more than two lamps are evaluated near the lobe's axis, of a pixel that has no more than one there; each further one, or part of one, takes up to four more.",
        write_methods(pairs),
        "## The planner",
        "The front holds the measurements of a pair that no other beats in both frame time and error. These plans are made "
        "for a sphere seen from everywhere. Means are geometric.",
        write_planner(pairs, in_view=not any(has_view(other) for other in others)),
        f"At {percent(tolerance)} %: error in percent / frame time relative to VTK's PBR. **Bold**: above the tolerance; "
        "†: the plan announced it, of the mean over all views or of single pictures.",
        write_pairs(pairs, tolerance),
        describe_occlusion(pairs),
        "## Which method for what",
        write_best(pairs, tolerance),
    ]
    for other in others:
        pairs, settings = other["pairs"], other["settings"]
        if has_view(other):
            parts += [
                "## The planner in view",
                "\"In view\" plans are made for the normals, views and pixels of the picture itself (`SetPlanForView`). Both "
                f"kinds of plans were measured side by side, {other['date']}, VTK {other['machine']['vtk']}, on the same "
                f"{len(pairs)} pairs. No front was measured with them.",
                write_planner(pairs, front=False),
            ]
            continue
        parts += [
            f"## The planner on a {os.path.splitext(os.path.basename(settings['mesh']))[0]}",
            f"{len({pair['material'] for pair in pairs})} materials, {len(pairs)} pairs, {settings['size']} pixels, at "
            f"most {settings['reference_pixels']} of which were compared with the reference. The tables are read as above.",
            write_planner(pairs, front=False),
            write_pairs(pairs, tolerance),
            describe_occlusion(pairs),
        ]
    for name in CHARTS:
        shutil.copyfile(os.path.join(folder, name + ".png"), os.path.join(docs, f"results-{name}.png"))
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n\n".join(part.rstrip("\n") for part in parts) + "\n")


if __name__ == "__main__":
    main()
