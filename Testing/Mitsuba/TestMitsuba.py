# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The exact sum and the reference against what Mitsuba 3 made of the same: TestMitsuba.py PROGRAM RECORDED SHARED_DATA ENVIRONMENT."""

import csv
import json
import os
import subprocess
import sys
import tempfile

SUM = 1e-5  # relative, of the sums over texels: Mitsuba is single precision
INTEGRAL = 0.003  # of the reference
SAMPLED = 0.005  # and four standard errors
QUIET = 0.01  # relative standard error up to which sampled figures are compared: eight runs do not tell that of rare peaks
SUM_STEP = 3  # every third pair's sum: every material and map has some
TEXELS = ("--method", "light-set", "--light-set", "variance", "--lights", "1048576")  # at their centers
FEW_NEGATIVE = 0.001  # how much of the radiance negative values may take for the sampled figures to be comparable


def integrate(program, method, material, environment, pairs):
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.write("nx,ny,nz,vx,vy,vz\n")
        for pair in pairs:
            file.write(",".join(map(repr, pair["normal"] + pair["view"])) + "\n")
        file.flush()
        command = [program, "integrate", material, "--environment", environment, *method]
        made = subprocess.run([*command, "--pairs", file.name], stdout=subprocess.PIPE, text=True, check=True)
    return [[float(row[c]) for c in "rgb"] for row in csv.DictReader(made.stdout.splitlines())]


def main():
    program, recorded, shared, environment = sys.argv[1:]
    if not os.path.isdir(os.path.join(shared, "materials", "rgl")):
        print(f"Skipped: no real data at {shared}")
        return 125
    with open(recorded, encoding="ascii") as file:
        record = json.load(file)
    if (record["format"], record["version"]) != ("measured-brdf mitsuba comparison", 2):
        print(f"{recorded}: not of the format that this test reads")
        return 1
    failures = compared = 0
    light = os.path.join(shared, "environments", environment + ".exr")
    for result in record["results"]:
        if result["environment"] != environment:
            continue
        name = result["material"]
        material = os.path.join(shared, "materials", "rgl", name + "_rgb.bsdf")
        worst = farthest = noisy = noise = 0.0
        pairs = result["pairs"]
        integrals = integrate(program, ("--method", "reference"), material, light, pairs)
        summed = pairs[::SUM_STEP]
        sums = integrate(program, TEXELS, material, light, summed)
        assert len(sums) == len(summed), f"{len(sums)} sums of {len(summed)} pairs"
        sums = iter(sums)
        for k, (integral, pair) in enumerate(zip(integrals, pairs, strict=True)):
            value = next(sums) if k % SUM_STEP == 0 else pair["sum"]
            total = sum(pair["integral"])
            for c in range(3):
                expected, whole = pair["integral"][c], pair["integral_unclamped"][c]
                off = abs(value[c] / pair["sum"][c] - 1.0)
                worst = max(worst, off)
                apart = abs(integral[c] - expected) / total
                farthest = max(farthest, apart)
                bad = not off <= SUM or not apart <= INTEGRAL
                error = pair["standard_error"][c]
                if abs(whole / expected - 1.0) <= FEW_NEGATIVE and error <= QUIET * expected:
                    away = abs(integral[c] - pair["sampled"][c])
                    bad = bad or not away <= SAMPLED * expected + 4.0 * error
                    noisy = max(noisy, away / pair["sampled"][c])
                    noise = max(noise, error / expected)
                    compared += 1
                if bad:
                    failures += 1
                    print(f"{name}, pair {k}, channel {c}: {value[c]}, {integral[c]}, Mitsuba {pair}")
        print(
            f"{name}, {environment}: off Mitsuba {record['mitsuba']} by at most {worst:.1e} (sums over texels of {len(summed)} pairs), "
            f"{farthest:.2%} (integrals), {noisy:.2%} (sampled, standard error up to {noise:.2%})"
        )
    print(f"{compared} sampled values compared")
    if compared == 0:
        print(f"{recorded}: nothing under {environment}")
        return 1
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
