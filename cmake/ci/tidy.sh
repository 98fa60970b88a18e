#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy 14 with .clang-tidy over the sources of the module and the tool, or over those named:
#
#   cmake/ci/tidy.sh [FILE...]
#
# It configures a tree of its own, build-tidy, and builds nothing there but generated headers. A file takes 10 to 60
# seconds. Exit status 1 where something was found.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake/install-packages.sh
cmake/install-packages.sh --only clang-tidy-14

build=build-tidy
mkdir -p "$build"
if ! cmake -S . -B "$build" -G Ninja -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DBUILD_TESTING=OFF -DMEASUREDBRDF_WRAP_PYTHON=OFF -DMEASUREDBRDF_BUILD_TOOL=ON -DMEASUREDBRDF_BUILD_LABORATORY=ON \
  -DMEASUREDBRDF_COMPILE_IN_GROUPS=OFF >"$build/configure.log" 2>&1; then
  tail -n 30 "$build/configure.log" >&2
  exit 1
fi
mapfile -t headers < <(ninja -C "$build" -t targets all | sed -n 's/^\([^:]*\.h\): CUSTOM_COMMAND$/\1/p')
ninja -C "$build" "${headers[@]}" >"$build/headers.log" 2>&1 || { tail -n 30 "$build/headers.log" >&2; exit 1; }

files=("$@")
[ $# -gt 0 ] || mapfile -t files < <(find Module Applications -name '*.cxx' | sort)
echo "clang-tidy-14 looks at ${#files[@]} files ..."
# GCC's options that Clang does not know are no finding.
status=0
printf '%s\0' "${files[@]}" |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option \
    >"$build/findings.txt" 2>"$build/tidy.log" || status=1
if [ "$status" -ne 0 ]; then
  # A finding in a header comes once for each file that includes it.
  sed "s|^$PWD/||" "$build/findings.txt" | grep -E '(error|warning): ' | sort -u
  echo
  echo "Findings of each check (with the code: $build/findings.txt):"
  sed "s|^$PWD/||" "$build/findings.txt" | grep -E '(error|warning): ' | sort -u |
    sed -n 's/.*\[\([a-z][A-Za-z0-9.-]*\).*\]$/\1/p' | sort | uniq -c | sort -rn
  exit 1
fi
echo "clang-tidy found nothing."
