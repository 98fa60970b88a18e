#!/bin/bash
# Builds and draws measured materials: output/gallery.png first, then output/chart.png and output/thesis/*.png. See
# ./run.sh --help.
set -euo pipefail
cd "$(dirname "$0")"

usage() {
  cat <<'END'
usage: ./run.sh [--environment ENV] [-o IMAGE] [FILE...]

Installs what is missing (Debian packages, as root or through sudo), builds, and draws a gallery of measured materials
under a high-dynamic-range environment. Without FILE it goes on once the gallery is there: it draws output/chart.png,
speed against accuracy on this machine from a small sweep of the methods (all of it in output/charts), builds the
laboratory, and draws the figures of the thesis that this project builds: output/thesis/materials.png, ringing.png,
lights.png. A second run only draws.

  FILE...            your own BRDF files (MERL .binary, RGL .bsdf, NVIDIA .mbsdf, published fits) or names of built-in
                     materials (build/bin/measured-brdf list). Default: built-in materials.
  --environment ENV  a lat-long image (.exr, .hdr, ...); `room` (photographed), `sky` or `hall` (computed), which are
                     built in; or one of Blender's: city courtyard forest interior night studio sunrise sunset (taken
                     from the package blender-data, 30 to 50 MB, where it is not installed). Default: room.
  -o IMAGE           where to write (default: output/gallery.png)
END
}

caller=$OLDPWD
environment=room
image=output/gallery.png
files=()
absolute() { case $1 in /*) echo "$1" ;; *) echo "$caller/$1" ;; esac; }
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --environment | -o)
      [ $# -ge 2 ] || { echo "run.sh: $1 needs a value (./run.sh --help)" >&2; exit 2; }
      if [ "$1" = -o ]; then image=$(absolute "$2"); else environment=$2; fi
      shift ;;
    --) shift; break ;;
    -*) echo "run.sh: unknown option $1 (./run.sh --help)" >&2; exit 2 ;;
    *) files+=("$1") ;;
  esac
  shift
done
files+=("$@")
# Paths are the caller's; what is no file there is a built-in material's name.
for k in "${!files[@]}"; do
  path=$(absolute "${files[$k]}")
  [ ! -e "${path%%#*}" ] || files[k]=$path
done

step() { printf '\n== %s\n' "$*"; }

step "1/3 packages"
cmake/install-packages.sh

step "2/3 build"
mkdir -p build
if ! {
  if [ -f build/CMakeCache.txt ]; then
    cmake -S . -B build -DMEASUREDBRDF_BUILD_TOOL=ON -DMEASUREDBRDF_BUILD_LABORATORY=ON
  else
    # The first picture is there sooner than by -O3.
    cmake --preset release -B build -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG" \
      -DMEASUREDBRDF_WRAP_PYTHON=OFF -DMEASUREDBRDF_BUILD_LABORATORY=ON
  fi
} >build/configure.log 2>&1; then
  tail -n 30 build/configure.log >&2
  echo "run.sh: CMake could not configure the build; all of what it said is in build/configure.log" >&2
  exit 1
fi
cmake --build build --target measured-brdf

step "3/3 draw"
builtin() { case $environment in room | sky | hall) ;; *) false ;; esac; }
if ! builtin && [ ! -f "$(absolute "$environment")" ]; then
  name=$environment
  folder=$(cmake/find-environments.sh)
  environment=$folder/$name.exr
  if [ -z "$folder" ]; then
    echo "Without Blender's environments the light is the built-in room."
    environment=room
  elif [ ! -f "$environment" ]; then
    echo "run.sh: no file and none of Blender's environments: $name (./run.sh --help)" >&2
    exit 2
  fi
elif ! builtin; then
  environment=$(absolute "$environment")
fi
echo "Drawing under $environment (about a minute without a graphics card) ..."

display=()
if [ -z "${DISPLAY:-}" ]; then
  display=(xvfb-run -a -s "-screen 0 1280x1024x24 -noreset")
fi
mkdir -p "$(dirname "$image")"
"${display[@]}" build/bin/measured-brdf gallery "${files[@]}" --environment "$environment" -o "$image"
show() { # IMAGE
  if [ -t 1 ] && [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && command -v xdg-open >/dev/null; then
    xdg-open "$1" >/dev/null 2>&1 &
  fi
}
printf '\nDone: %s\n' "$image"
show "$image"

if [ ${#files[@]} -eq 0 ]; then
  echo "Measuring the methods on this machine (two minutes without a graphics card) ..."
  chart() {
    "${display[@]}" build/bin/measured-brdf chart pink-felt gold-paint --size 200x200 --reference-pixels 256 \
      --rounds 3 --slowest 600 --methods table,hybrid,filtered,soft-lights,median-cut -o output/charts
  }
  # What an older program or another machine measured there is of no use to this one; a failure of another kind
  # leaves it.
  chart || { rm -f output/charts/results.json && chart; }
  cp output/charts/summary.png output/chart.png
  step "the laboratory"
  cmake --build build --target measured-brdf-lab
  echo "Drawing the thesis's figures (two minutes without a graphics card) ..."
  other=$environment
  [ "$other" != hall ] || other=sky
  "${display[@]}" build/bin/measured-brdf-lab thesis --environment hall --environment "$other" -o output/thesis
  printf '\nDone: %s\n' "output/chart.png, output/thesis/materials.png, ringing.png, lights.png"
fi
