#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Draws docs/occlusion.png, a molecule that hides much of the sky from itself: light that nothing hides, this module, and the
# traced reference, with errors; and docs/occlusion-bounce.png, a white bowl whose hidden parts send light back: without occlusion,
# black, with one bounce, and traced with one. It takes some minutes of a core, and VTK's Python modules for the meshes.
#
#   cmake/make-occlusion-picture.sh [OUTPUT.png [BOUNCE.png]]
set -euo pipefail
cd "$(dirname "$0")/.."
display=()
[ -n "${DISPLAY:-}" ] || display=(xvfb-run -a -s "-screen 0 1280x1024x24 -noreset")
for python in /usr/bin/python3 python3; do # VTK's modules belong to one interpreter
  "$python" -c 'import vtkmodules' 2>/dev/null && break
done
mkdir -p output
"$python" cmake/make-mesh.py molecule output/molecule.vtp
"${display[@]}" build/bin/measured-brdf compare gold-paint --environment room --mesh output/molecule.vtp --size 300x270 \
  --view 20,25,40 --occlusion --strip "${1:-docs/occlusion.png}" --report output/occlusion.json
"$python" cmake/make-mesh.py bowl output/bowl.vtp
"${display[@]}" build/bin/measured-brdf compare delrin --environment room --mesh output/bowl.vtp --size 230x210 \
  --view 20,40,40 --occlusion --bounces 1 --strip "${2:-docs/occlusion-bounce.png}" --report output/occlusion-bounce.json
