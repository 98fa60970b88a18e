#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes results.md and its charts from what make-results.sh measured: make-results.py FOLDER DOCS [REPORT...].

FOLDER is one that `measured-brdf chart` made, each REPORT one of `measured-brdf compare` in a process of its own.

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
# What the planner's rungs were chosen with.
MATERIALS = set(
    "acrylic_felt_pink_rgb satin_purple_rgb leaf_maple_rgb cc_ibiza_sunset_rgb chm_light_blue_rgb carpaint_red nickel "
    "gold-paint blue-fabric".split()
)
MAPS = {"studio", "interior", "city", "pmndrs_sunrise"}


def mean(values):
    return math.exp(statistics.fmean(math.log(max(value, 1e-9)) for value in values))


def percent(share):
    return f"{100 * share:.2g}"


def times(ratio):
    return f"{ratio:.2g}" if ratio < 99.5 else f"{ratio:.0f}"


def error(point):
    return point["errors"][METRIC]


def measured(pair):
    return [point for point in pair["points"] if "left_out" not in point]


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
        rows.append(
            [
                method,
                size,
                *(
                    percent(mean([point["errors"][metric] for point in some]))
                    for metric in (METRIC, "percentile_95", "percentile_99")
                ),
                f"{mean([point['errors']['flip'] for point in some]):.2g}",
                f"{frame:.3g}",
                f"{frame / stock:.2g}" if len(some) == len(pairs) else "",
                f"{mean([point['setup_ms'] for point in some]):.3g}",
                f"{1e-6 * mean([point['texture_bytes'] for point in some]):.2g}",
                f"{statistics.fmean(point['texture_fetches'] for point in some):.3g}",
                len(some),
            ]
        )
    return table(
        [
            "method",
            "size",
            "error %",
            "95 % of the pixels within %",
            "99 %",
            "FLIP",
            "frame ms",
            "frame / PBR's",
            "set-up ms",
            "MB",
            "fetches",
            "pairs",
        ],
        rows,
    )


def get_plans(pair, tolerance):
    """The points of the plan for every view: what is drawn, and what is drawn instead while somebody interacts."""
    some = {
        figure.get("interacting", False): pair["points"][figure["point"]]
        for figure in pair["planner"]
        if figure["tolerance"] == tolerance and not figure.get("in_view", False)
    }
    return some[False], some.get(True, some[False])


def get_frame(pair, point):
    """Times VTK's PBR's."""
    return point["frame_ms"] / next(other["frame_ms"] for other in measured(pair) if other["method"] == "pbr")


def split(pairs):
    """By what the planner's rungs were chosen with."""
    parts = collections.defaultdict(list)
    for pair in pairs:
        used = (pair["material"] in MATERIALS) + (pair["environment"] in MAPS)
        parts[("of materials and maps that were not used", "all others", "used to choose the rungs")[used]].append(pair)
    order = ("used to choose the rungs", "of materials and maps that were not used", "all others")
    return {**{name: parts[name] for name in order if parts[name]}, "all": pairs}


def write_accuracy(pairs, tolerance):
    rows = []
    for name, part in split(pairs).items():
        for samples in (True, False):
            points = [get_plans(pair, tolerance)[not samples] for pair in part]
            above = [point for point in points if error(point) > tolerance]
            told = sum(not point["meets_tolerance"] for point in above)
            pictures = sum(point["predicted_picture_error"] > tolerance for point in above)

            def median(metric):
                return statistics.median(point["errors"][metric] for point in points)

            rows.append(
                [
                    name,
                    "with" if samples else "without",
                    f"{len(points) - len(above)} of {len(points)}",
                    f"{len(above)}: {told}, {pictures}",
                    f"{percent(median(METRIC))}, {percent(max(map(error, points)))}",
                    percent(median("percentile_95")),
                    percent(median("percentile_99")),
                    f"{median('flip'):.2g}, {max(point['errors']['flip'] for point in points):.2g}",
                    sum(error(point) > point["predicted_error"] for point in points),
                    sum(error(point) > point["predicted_picture_error"] for point in points),
                ]
            )
    return table(
        [
            "pairs",
            "samples",
            f"within {percent(tolerance)} %",
            "above; announced in the mean, for single pictures",
            "error %, median and largest",
            "95 % of the pixels within %, median",
            "99 %",
            "FLIP, median and largest",
            "above what was predicted for all views",
            "for single pictures",
        ],
        rows,
    )


def write_costs(pairs, tolerances):
    rows = []
    for tolerance in tolerances:
        for samples in (True, False):
            points = [get_plans(pair, tolerance)[not samples] for pair in pairs]
            frames = [get_frame(pair, point) for pair, point in zip(pairs, points)]
            memory = [point["texture_bytes"] for point in points]
            fetches = [point["texture_fetches"] for point in points]
            drawn = sum(still is not moving for still, moving in (get_plans(pair, tolerance) for pair in pairs))
            rows.append(
                [
                    f"{percent(tolerance)} %",
                    f"with, in {drawn}" if samples else "without",
                    f"{sum(error(point) <= tolerance for point in points)} of {len(points)}",
                    f"{mean(frames):.2f}, {statistics.median(frames):.2f}, {times(max(frames))}",
                    f"{1e-6 * mean(memory):.2g}, {1e-6 * max(memory):.3g}",
                    f"{statistics.fmean(fetches):.1f}, {max(fetches)}",
                ]
            )
    return table(
        [
            "tolerance",
            "samples",
            "within it",
            "frame / PBR's: geometric mean, median, largest",
            "MB, geometric mean and largest",
            "fetches, mean and most",
        ],
        rows,
    )


def write_pairs(pairs, tolerance):
    cells = collections.defaultdict(dict)
    for pair in pairs:
        texts = []
        for point in get_plans(pair, tolerance):
            text = f"{percent(error(point))} / {times(get_frame(pair, point))}"
            if error(point) > tolerance:
                told = max(point["predicted_error"], point["predicted_picture_error"]) > tolerance
                text = f"**{text}**" + (" †" if told else "")
            texts.append(text)
        cells[pair["material"]][pair["environment"]] = texts[0] if texts[0] == texts[1] else "{} ({})".format(*texts)
    environments = list(dict.fromkeys(pair["environment"] for pair in pairs))
    rows = [[material, *(row.get(name, "") for name in environments)] for material, row in cells.items()]
    return table(["material", *environments], rows)


def write_setup(reports):
    rows = []
    for report in reports:
        with open(report, encoding="utf-8") as file:
            found = json.load(file)
        rows.append([1e-3 * found["setup_cpu_ms"], 1e-3 * found["pbr_setup_cpu_ms"]])
        rows[-1].append(rows[-1][0] / rows[-1][1])
    return table(
        [f"{len(rows)} pairs, each in a new process", "geometric mean", "median", "least", "largest"],
        [
            [name, f"{mean(some):.2g}", f"{statistics.median(some):.2g}", f"{min(some):.2g}", f"{max(some):.2g}"]
            for name, some in zip(("the planner, s", "VTK's PBR, s", "the planner's / PBR's"), zip(*rows))
        ],
    )


def keep_conclusions(path):
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        if CONCLUSIONS in text and END in text:
            return text.split(CONCLUSIONS)[1].split(END)[0].strip("\n")
    return "*To be written from the tables below.*"


def main():
    folder, docs, *reports = sys.argv[1:]
    with open(os.path.join(folder, "results.json"), encoding="utf-8") as file:
        results = json.load(file)
    if results["format"] != "measured-brdf chart" or results["version"] not in (1, 2, 3):
        sys.exit(f"{folder}/results.json: not of the format that this script reads")
    machine, settings = results["machine"], results["settings"]
    pairs = [pair for pair in results["pairs"] if pair["planner"]]
    if len(pairs) < len(results["pairs"]):
        print(f"{len(results['pairs']) - len(pairs)} pairs without a plan are left out", file=sys.stderr)
    materials = len({pair["material"] for pair in pairs})
    environments = len({pair["environment"] for pair in pairs})
    tolerances = sorted({figure["tolerance"] for pair in pairs for figure in pair["planner"]})
    tolerance = 0.02 if 0.02 in tolerances else tolerances[0]
    load = statistics.median(pair["load"] for pair in pairs)
    path = os.path.join(docs, "results.md")

    parts = [
        "# Speed against accuracy",
        f"{materials} materials under {environments} environments, {len(pairs)} pairs, a {settings['mesh']} in "
        f"{settings['size']} pixels, at most {settings['reference_pixels']} of which were compared with the reference. "
        f"{machine['processor']}, {machine['threads']} threads, {machine['renderer']} ({machine['renderer_version']}), "
        f"VTK {machine['vtk']}, {results['date']}; median load of the machine when a pair began: {load:.1f}. Errors are "
        "relative L1, mean |x − r| / mean r; the [other figures](metrics.md) are of pixels, too. Light is unoccluded. The "
        "methods' frames were drawn in turns; a frame time is the median, or the only one above half a second.",
        "`cmake/make-results.sh DATA` makes this page. It also writes all figures to results.csv and results.json.",
        CONCLUSIONS + "\n\n" + keep_conclusions(path) + "\n\n" + END,
        "## The planner",
        "These plans are made for a sphere seen from everywhere. *Without samples* is what is drawn while somebody "
        "interacts: the same, or the most accurate cheaper method that was tried where samples are drawn otherwise. The "
        "[rungs](methods/planner.md#the-ladder) were chosen with nine of these materials and four of these environments. "
        "A plan announces that it misses the tolerance in the mean over all views, or that a single picture may.",
        write_accuracy(pairs, tolerance),
        write_costs(pairs, tolerances),
        f"At {percent(tolerance)} %: error in percent / frame time relative to VTK's PBR, in parentheses without samples "
        "where that differs. **Bold**: above the tolerance; †: announced.",
        write_pairs(pairs, tolerance),
    ]
    if reports:
        parts += [
            "### Set-up",
            "The processor's time of all threads, with the system's, from a material and an environment that have been "
            f"read to the end of the first frame, at {percent(tolerance)} %, samples included.",
            write_setup(reports),
        ]
    parts += [
        "## Methods",
        "All figures are geometric means over the pairs. Where a size was too slow to measure in some pairs, its mean is "
        "over the other pairs only and cannot be compared with the rest. The numbers of a size are: `thesis`, lights and "
        "order; `table`, rows, view angles and azimuths; `hybrid`, the same and maps; `filtered`, samples. Set-up is by "
        "the clock until the first frame is done, in a process that has drawn others. Fetches are of textures for a "
        "pixel, their mean; where more than two lamps are evaluated near the lobe's axis, of a pixel that has no more "
        "than one there; each further one, or part of one, takes up to four more.",
        write_methods(pairs),
        *(f"![{caption}](results-{name}.png)\n\n*{caption}.*" for name, caption in CHARTS.items()),
    ]
    for name in CHARTS:
        shutil.copyfile(os.path.join(folder, name + ".png"), os.path.join(docs, f"results-{name}.png"))
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n\n".join(part.rstrip("\n") for part in parts) + "\n")


if __name__ == "__main__":
    main()
