#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds the module inside VTK's own source tree, as a remote module, and runs its tests there:
#
#   apt-get source vtk9                          # or any other source tree of VTK 9.1 or later
#   cmake/ci/in-vtk.sh VTK_SOURCE [BUILD]
#
# The committed and other files of this repository are copied to VTK_SOURCE/Remote/MeasuredBRDF. Of VTK, what the module
# and its tests need is built (some 1500 files), in BUILD (default: build-in-vtk).
set -euo pipefail
source_tree=$(realpath "${1:?usage: cmake/ci/in-vtk.sh VTK_SOURCE [BUILD]}")
cd "$(dirname "$0")/../.."
build=${2:-build-in-vtk}
[ -f "$source_tree/CMake/vtkModule.cmake" ] || { echo "in-vtk.sh: $source_tree is no source tree of VTK" >&2; exit 2; }
cmake/install-packages.sh --tests
# Debian's source package leaves these libraries out. VTK takes its own copy of all others.
external=(doubleconversion eigen expat freetype gl2ps glew hdf5 jpeg jsoncpp libproj libxml2 lz4 lzma netcdf ogg png
  sqlite theora tiff utf8 zlib)
external_options=()
for name in "${external[@]}"; do
  external_options+=("-DVTK_MODULE_USE_EXTERNAL_VTK_$name=ON")
done
cmake/install-packages.sh --only libdouble-conversion-dev libeigen3-dev libexpat1-dev libfreetype-dev libgl2ps-dev \
  libglew-dev libhdf5-dev libjpeg-dev libjsoncpp-dev libproj-dev libxml2-dev liblz4-dev liblzma-dev libnetcdf-dev \
  libogg-dev libpng-dev libsqlite3-dev libtheora-dev libtiff-dev libutfcpp-dev zlib1g-dev

remote=$source_tree/Remote/MeasuredBRDF
rm -rf "$remote"
mkdir -p "$remote" "$build"
git ls-files -z --cached --others --exclude-standard | tar --null --no-recursion -T - --ignore-failed-read -cf - |
  tar -C "$remote" -xf -
if ! cmake -S "$source_tree" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON \
  -DVTK_BUILD_TESTING=ON -DVTK_GROUP_ENABLE_MPI=NO -DVTK_GROUP_ENABLE_Qt=NO -DVTK_GROUP_ENABLE_Web=NO \
  "${external_options[@]}" -DVTK_MODULE_ENABLE_VTK_MeasuredBRDF=YES \
  >"$build/configure.log" 2>&1; then
  grep -A 8 'CMake Error' "$build/configure.log" >&2
  exit 1
fi
# The baselines only: the target VTKData would fetch the data of all of VTK's tests.
mapfile -t data < <(ninja -C "$build" -t targets all |
  sed -n 's|^\(ExternalData/Remote/MeasuredBRDF/[^:]*\): CUSTOM_COMMAND$|\1|p')
cmake --build "$build" --target unit-tests render-tests "${data[@]}"
xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" ctest --test-dir "$build" -L 'unit|render' -j "$(nproc)" \
  --no-tests=error --output-on-failure
