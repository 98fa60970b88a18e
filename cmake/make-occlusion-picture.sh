#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Draws docs/occlusion.png, a molecule that hides much of the sky from itself: light that nothing hides, this module, and the
# traced reference, with errors. It takes about a minute of a core, and VTK's Python modules for the mesh.
#
#   cmake/make-occlusion-picture.sh [OUTPUT.png]
set -euo pipefail
cd "$(dirname "$0")/.."
display=()
[ -n "${DISPLAY:-}" ] || display=(xvfb-run -a -s "-screen 0 1280x1024x24 -noreset")
mkdir -p output
python3 cmake/make-molecule.py output/molecule.vtp
"${display[@]}" build/bin/measured-brdf compare gold-paint --environment room --mesh output/molecule.vtp --size 300x270 \
  --view 20,25,40 --occlusion --strip "${1:-docs/occlusion.png}" --report output/occlusion.json
