#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds the library without its optional library, and runs the unit tests there; and the command line tool without
# libcurl and without Qt, where it has to say that it has no explorer:
#
#   cmake/ci/options.sh [OPENIMAGEIO|CURL|QT...]
#
# Without arguments all three. The trees are build-without-NAME. What a build lacks is left out of its tests, or the
# test is skipped and says why; an absent library's headers must not be needed.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake/install-packages.sh --tests

names=("$@")
[ $# -gt 0 ] || names=(OPENIMAGEIO CURL QT)
for name in "${names[@]}"; do
  case $name in
    OPENIMAGEIO | CURL | QT) ;;
    *) echo "usage: cmake/ci/options.sh [OPENIMAGEIO|CURL|QT...]" >&2; exit 2 ;;
  esac
  build=build-without-${name,,}
  mkdir -p "$build"
  if ! cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DBUILD_TESTING=ON \
    -DMEASUREDBRDF_WRAP_PYTHON=OFF -DMEASUREDBRDF_BUILD_TOOL=ON -DMEASUREDBRDF_WARNINGS_AS_ERRORS=ON -DMEASUREDBRDF_COMPILE_IN_GROUPS=OFF \
    "-DMEASUREDBRDF_WITH_$name=OFF" >"$build/configure.log" 2>&1; then
    tail -n 30 "$build/configure.log" >&2
    exit 1
  fi
  printf '\n== without %s\n' "$name"
  grep '^-- Without ' "$build/configure.log"
  if [ "$name" = CURL ]; then
    cmake --build "$build" --target measured-brdf
    ctest --test-dir "$build" -R '^Tool.FetchAbsent$' --no-tests=error --output-on-failure
    continue
  fi
  if [ "$name" = QT ]; then
    cmake --build "$build" --target measured-brdf
    said=$("$build/bin/measured-brdf" explore 2>&1) && status=0 || status=$?
    echo "$said"
    if [ "$status" != 1 ] || [[ $said != *"has no explorer"* ]]; then
      echo "options.sh: measured-brdf explore should say that it has no explorer and exit with 1" >&2
      exit 1
    fi
    "$build/bin/measured-brdf" explore --help
    continue
  fi
  cmake --build "$build" --target unit-tests
  ctest --test-dir "$build" -L unit -j "$(nproc)" --no-tests=error --output-on-failure
done
