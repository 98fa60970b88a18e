#!/bin/bash
# Measures the methods on the project's data and writes docs/results.md with its charts.
#
#   cmake/make-results.sh DATA [OPTIONS]
#
# DATA holds materials/rgl, materials/mbsdf and environments. OPTIONS go to `measured-brdf chart` and take the place of
# those below, e.g. `--sweep small --size 200x200`. What was measured is kept in output/results and output/results-setup:
# an interrupted run goes on. With `--sweep small --methods table,hybrid` it takes about 40 minutes on two cores without
# a graphics card, else hours. Times are of worth on an otherwise idle machine only.
set -euo pipefail
[ $# -ge 1 ] && [ -d "$1/environments" ] || { echo "usage: cmake/make-results.sh DATA [OPTIONS]" >&2; exit 2; }
[ -n "${DISPLAY:-}" ] || exec xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$0" "$@"
data=$(cd "$1" && pwd)
shift
cd "$(dirname "$0")/.."

environments=
for name in studio.exr interior.exr city.exr sunset.exr forest.exr pmndrs_sunrise.hdr courtyard.exr rooitou_park_1k.hdr; do
  environments+=${environments:+,}$data/environments/$name
done
materials=("$data"/materials/rgl/*.bsdf "$data"/materials/mbsdf/*.mbsdf
  blue-fabric gold-metallic-paint3 violet-rubber nickel pink-felt gold-paint)
# For a try: RESULTS_MATERIALS="pink-felt gold-paint" RESULTS_ENVIRONMENTS=sky
[ -z "${RESULTS_MATERIALS:-}" ] || read -r -a materials <<<"$RESULTS_MATERIALS"
environments=${RESULTS_ENVIRONMENTS:-$environments}
cold=("$data"/environments/{interior,sunset}.exr) # the rungs were chosen with one of these, and not with the other
[ -z "${RESULTS_ENVIRONMENTS:-}" ] || IFS=, read -r -a cold <<<"$environments"

# Of all pixels, the references of 160 pairs would take hours.
options=()
for usual in "--sweep full" "--reference-pixels 1024" "--tolerances 0.02,0.05" "--rounds 5"; do
  case " $* " in *" ${usual% *} "*) ;; *) read -r -a words <<<"$usual"; options+=("${words[@]}") ;; esac
done
build/bin/measured-brdf chart "${materials[@]}" --environments "$environments" "${options[@]}" "$@" \
  -o output/results

# Set-up in a new process for each pair, of this build.
mkdir -p output/results-setup
reports=()
for map in "${cold[@]}"; do
  for material in "${materials[@]}"; do
    report=output/results-setup/$(basename "$material").$(basename "$map").json
    [ "$report" -nt build/bin/measured-brdf ] || build/bin/measured-brdf compare "$material" --environment "$map" \
      --reference-pixels 64 --report "$report"
    reports+=("$report")
  done
done
python3 cmake/make-results.py output/results "${RESULTS_DOCS:-docs}" "${reports[@]}"
