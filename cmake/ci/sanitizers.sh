#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds with the address and undefined-behavior sanitizers (preset asan, folder build-asan) and runs the unit tests.
# Further arguments go to ctest in place of `-L unit`.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake/install-packages.sh --tests

# Graphics drivers and VTK leak at exit.
export ASAN_OPTIONS=detect_leaks=0
mkdir -p build-asan
if ! cmake --preset asan >build-asan/configure.log 2>&1; then
  tail -n 30 build-asan/configure.log >&2
  exit 1
fi
cmake --build --preset asan
selection=("$@")
[ $# -gt 0 ] || selection=(-L unit)
xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" ctest --preset asan -j "$(nproc)" --no-tests=error "${selection[@]}"
