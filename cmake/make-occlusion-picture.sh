#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Draws docs/occlusion.png, the guide's picture of what a mesh hides: light that nothing hides, this module, and the traced
# reference, with errors. It takes about a minute of a core.
#
#   cmake/make-occlusion-picture.sh [OUTPUT.png]
set -euo pipefail
cd "$(dirname "$0")/.."
display=()
[ -n "${DISPLAY:-}" ] || display=(xvfb-run -a -s "-screen 0 1280x1024x24 -noreset")
mkdir -p output
"${display[@]}" build/bin/measured-brdf compare gold-paint --environment room --mesh ball-on-foot --size 300x270 \
  --view 14,12,60 --occlusion --strip "${1:-docs/occlusion.png}" --report output/occlusion.json
