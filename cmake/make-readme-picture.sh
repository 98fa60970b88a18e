#!/bin/bash
# Draws docs/comparison.png, the picture of README.md: one object under the built-in room by VTK's PBR, by this module and
# by the reference, with errors and the frame time relative to PBR's. The reference takes minutes. The frame time is
# meaningful on an otherwise idle machine only.
#
#   cmake/make-readme-picture.sh [OUTPUT.png]
set -euo pipefail
cd "$(dirname "$0")/.."
display=()
[ -n "${DISPLAY:-}" ] || display=(xvfb-run -a -s "-screen 0 1280x1024x24 -noreset")
mkdir -p output
"${display[@]}" build/bin/measured-brdf compare blue-car-paint --environment room --mesh ball-on-foot --size 400x360 \
  --view 14,12,60 --strip "${1:-docs/comparison.png}" --report output/comparison.json
