#!/bin/bash
# Measures the methods on the project's data and writes docs/results.md with its charts.
#
#   cmake/make-results.sh DATA [OPTIONS]
#
# DATA holds materials/rgl, materials/mbsdf and environments. OPTIONS go to `measured-brdf chart` and take the place of
# those below, e.g. `--sweep small --size 200x200`. The sweep is kept in output/results: an interrupted one goes on. Hours
# without a graphics card, and of worth on an otherwise idle machine only.
set -euo pipefail
[ $# -ge 1 ] && [ -d "$1/environments" ] || { echo "usage: cmake/make-results.sh DATA [OPTIONS]" >&2; exit 2; }
data=$(cd "$1" && pwd)
shift
cd "$(dirname "$0")/.."

measured=("$data"/materials/rgl/*.bsdf "$data"/materials/mbsdf/*.mbsdf)
published=(blue-fabric gold-metallic-paint3 violet-rubber nickel pink-felt gold-paint)
environments=
for name in studio.exr interior.exr city.exr sunset.exr forest.exr pmndrs_sunrise.hdr courtyard.exr rooitou_park_1k.hdr; do
  environments+=${environments:+,}$data/environments/$name
done
materials=("${measured[@]}" "${published[@]}")
# For a try: RESULTS_MATERIALS="pink-felt gold-paint" RESULTS_ENVIRONMENTS=sky
[ -z "${RESULTS_MATERIALS:-}" ] || read -r -a materials <<<"$RESULTS_MATERIALS"
environments=${RESULTS_ENVIRONMENTS:-$environments}

sweep=()
case " $* " in *" --sweep "*) ;; *) sweep=(--sweep full) ;; esac
# Of all pixels, the references of 120 pairs would take hours.
pixels=(--reference-pixels 1024)
first_pixels=("${pixels[@]}")
case " $* " in *" --reference-pixels "*) first_pixels=() ;; esac
display=()
[ -n "${DISPLAY:-}" ] || display=(xvfb-run -a -s "-screen 0 1280x1024x24 -noreset")
"${display[@]}" build/bin/measured-brdf chart "${materials[@]}" --environments "$environments" "${sweep[@]}" "${first_pixels[@]}" \
  "$@" -o output/results

# What the planner chooses for every view and for the picture's.
"${display[@]}" build/bin/measured-brdf chart "${materials[@]}" --environments "$environments" \
  --methods planner --tolerances 0.02,0.05 --for-view "${pixels[@]}" --slowest 120 -o output/results-view

# The same on a curved mesh.
curved=("$data"/materials/rgl/{acrylic_felt_pink,satin_purple,irid_flake_paint2,chm_light_blue}_rgb.bsdf)
[ -z "${RESULTS_MATERIALS:-}" ] || { curved=("${materials[@]}"); published=(); }
[ -e output/torus.vtp ] || /usr/bin/python3 cmake/make-torus.py output/torus.vtp
"${display[@]}" build/bin/measured-brdf chart "${curved[@]}" "${published[@]}" --environments "$environments" \
  --methods planner --tolerances 0.02,0.05 --mesh output/torus.vtp --rounds 5 --reference-pixels 300 --slowest 120 \
  -o output/results-torus

# Frames of a mesh of half a million triangles, for the conclusions.
[ -e output/bumps.vtp ] || /usr/bin/python3 cmake/make-bumps.py output/bumps.vtp
"${display[@]}" build/bin/measured-brdf chart "${materials[@]}" --environments "$(cut -d, -f1,2 <<<"$environments")" \
  --methods planner --tolerances 0.02 --mesh output/bumps.vtp --rounds 5 --reference-pixels 300 --slowest 120 \
  -o output/results-bumps
python3 cmake/make-results.py output/results "${RESULTS_DOCS:-docs}" output/results-view output/results-torus
