#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Draws docs/methods-mirror.png and docs/methods-brushed.png, the pictures of tables, factored tables, hybrids and anisotropic
# tables in docs/methods.md. DATA holds materials and environments as for make-results.sh. It takes some minutes, and VTK's
# Python modules.
#
#   cmake/make-method-pictures.sh DATA
set -euo pipefail
cd "$(dirname "$0")/.."
data=${1:?usage: cmake/make-method-pictures.sh DATA}
display=()
[ -n "${DISPLAY:-}" ] || display=(xvfb-run -a -s "-screen 0 1280x1024x24 -noreset")
for python in /usr/bin/python3 python3; do # VTK's modules belong to one interpreter
  "$python" -c 'import vtkmodules' 2>/dev/null && break
done
cells=output/method-pictures
mkdir -p "$cells"

draw() { # NAME MATERIAL OPTIONS
  local name=$1 material=$2
  shift 2
  "${display[@]}" build/bin/measured-brdf render "$material" --environment "$data/environments/$map.exr" --size 250x250 \
    --output "$cells/$name.png" "$@"
}

map=interior
paint=$data/materials/rgl/chm_light_blue_rgb.bsdf
draw mirror-1 "$paint" --method table --sizes 65,12,16
draw mirror-2 "$paint" --method table --sizes 257,12,16
draw mirror-3 "$paint" --method hybrid --sizes 256,12,8,8,0
draw mirror-4 "$paint" --method hybrid --sizes 256,12,8,4
draw mirror-5 "$paint" --method reference

map=studio
PYTHONPATH=build/lib/python3/dist-packages "$python" cmake/make-brushed.py "$cells"
metal=$cells/brushed.exr
draw brushed-1 "$metal" --method light-set --light-set variance --soft-lights --lights 16
draw brushed-2 "$metal" --method table --sizes 17,8,16,8
draw brushed-3 "$metal" --method table --sizes 33,8,32,8
draw brushed-4 "$metal" --method reference

"$python" cmake/join-pictures.py docs/methods-mirror.png "$cells"/mirror-?.png
"$python" cmake/join-pictures.py docs/methods-brushed.png "$cells"/brushed-?.png
