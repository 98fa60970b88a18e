#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""results.md and its charts from what `measured-brdf chart` left in a folder: make-results.py FOLDER DOCS.

What stands between the lines CONCLUSIONS and END of an earlier results.md is people's, and stays.
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
                len(some),
            ]
        )
    return table(["method", "size", "error %", "frame ms", "of PBR's", "set-up ms", "MB", "pairs"], rows)


def write_planner(pairs):
    figures = collections.defaultdict(list)
    for pair in pairs:
        for figure in pair["planner"]:
            figures[figure["tolerance"]].append((figure["time_over_front"], pair["points"][figure["point"]]))
    rows = []
    for tolerance, some in sorted(figures.items()):
        times = [time for time, _ in some]
        met = sum(error(point) <= tolerance for _, point in some)
        broken = sum(error(point) > tolerance and point["meets_tolerance"] for _, point in some)
        rows.append(
            [
                f"{percent(tolerance)} %",
                len(some),
                f"{100 * sum(time <= WITHIN for time in times) / len(times):.0f} %",
                f"{statistics.median(times):.2f}",
                f"{max(times):.2f}",
                met,
                broken,
            ]
        )
    head = ["tolerance", "pairs", "on the front or within 20 % of its time", "median time over the front's"]
    return table([*head, "worst", "within the tolerance", "not, though promised"], rows)


def write_pairs(pairs, tolerance):
    environments = list(dict.fromkeys(pair["environment"] for pair in pairs))
    cells = collections.defaultdict(dict)
    for pair in pairs:
        stock = next(point for point in measured(pair) if point["method"] == "pbr")
        for figure in pair["planner"]:
            if figure["tolerance"] == tolerance:
                point = pair["points"][figure["point"]]
                text = f"{percent(error(point))} / {point['frame_ms'] / stock['frame_ms']:.2g}"
                if error(point) > tolerance:
                    text = f"**{text}**" + ("" if point["meets_tolerance"] else " †")
                cells[pair["material"]][pair["environment"]] = text
    rows = [[material, *(row.get(name, "") for name in environments)] for material, row in cells.items()]
    return table(["material", *environments], rows)


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


def main():
    folder, docs = sys.argv[1:]
    with open(os.path.join(folder, "results.json"), encoding="utf-8") as file:
        results = json.load(file)
    if (results["format"], results["version"]) != ("measured-brdf chart", 1):
        sys.exit(f"{folder}/results.json: not of the format that this script reads")
    pairs, machine, settings = results["pairs"], results["machine"], results["settings"]
    materials = len({pair["material"] for pair in pairs})
    environments = len({pair["environment"] for pair in pairs})
    tolerances = sorted({figure["tolerance"] for pair in pairs for figure in pair["planner"]})
    tolerance = 0.02 if 0.02 in tolerances else tolerances[0]
    load = statistics.median(pair["load"] for pair in pairs)
    path = os.path.join(docs, "results.md")
    kept = keep_conclusions(path)

    parts = [
        "# Speed against accuracy",
        f"{materials} materials under {environments} environments, {len(pairs)} pairs, {settings['size']} pixels of a "
        f"{settings['mesh']}, at most {settings['reference_pixels']} of them against the exact sum. {machine['processor']}, "
        f"{machine['threads']} threads, {machine['renderer']} ({machine['renderer_version']}), VTK {machine['vtk']}, "
        f"{results['date']}; load of the machine when the pairs began: median {load:.1f}. Errors are relative L1, mean "
        "|x − r| / mean r. Frame times are medians of frames taken in turns. Set-up is all until the first frame is done; "
        "the planner's contains the planning.",
        "Made by `cmake/make-results.sh DATA`; all figures are in the results.csv and results.json that it leaves.",
        CONCLUSIONS + "\n\n" + kept + "\n\n" + END,
        "## Charts",
        *(f"![{caption}](results-{name}.png)\n\n*{caption}.*" for name, caption in CHARTS.items()),
        "## Methods",
        "Geometric means over the pairs. Sizes whose frames would have taken too long in some pairs are means over the "
        "others, which are not to be compared with the rest. `thesis` sizes are lights, order; `table` rows, view angles, "
        "azimuths.",
        write_methods(pairs),
        "## The planner",
        "The front is the least time of all that was measured on a pair and is no less accurate.",
        write_planner(pairs),
        f"At {percent(tolerance)} %: error in percent / frame time over that of VTK's PBR. **Bold**: above the tolerance; "
        "†: the plan had said so.",
        write_pairs(pairs, tolerance),
        "## Which method for what",
        write_best(pairs, tolerance),
    ]
    for name in CHARTS:
        shutil.copyfile(os.path.join(folder, name + ".png"), os.path.join(docs, f"results-{name}.png"))
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n\n".join(part.rstrip("\n") for part in parts) + "\n")


if __name__ == "__main__":
    main()
