#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Measures methods of occlusion and draws docs/occlusion-methods.png, the chart of docs/methods/self-occlusion.md: error over frame time. It
# needs the benchmarks (MEASUREDBRDF_BUILD_BENCHMARKS) and the measured data beside the repository, and takes half an hour.
# With a file of lines that were measured before it only draws.
#
#   cmake/make-occlusion-chart.sh [MEASURED.csv]
set -euo pipefail
cd "$(dirname "$0")/.."
display=()
[ -n "${DISPLAY:-}" ] || display=(xvfb-run -a -s "-screen 0 1280x1024x24 -noreset")
mkdir -p output
lines="${1:-output/occlusion-methods.csv}"
if [ $# -eq 0 ]; then
  "${display[@]}" build/bin/BenchmarkOcclusionMethods --materials lambert blinn50 satin_purple \
    --maps city.exr interior.exr studio.exr --pixels 150 --rounds 2 > "$lines"
fi
"${display[@]}" build/bin/BenchmarkOcclusionMethods --from "$lines" --chart output/occlusion-methods
cp output/occlusion-methods.png docs/occlusion-methods.png
