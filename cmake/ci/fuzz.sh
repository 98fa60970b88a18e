#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Fuzzes the readers with libFuzzer and the address and undefined-behavior sanitizers:
#
#   cmake/ci/fuzz.sh [-x EXECUTIONS] [SECONDS] [TARGET...]
#
# Builds the targets of Testing/Fuzz with Clang in a tree of its own, build-fuzz (VTK and the other libraries are not
# instrumented), and runs each, or each that is named ("Merl"), for SECONDS (default 30), or until it was executed
# EXECUTIONS times if that comes first. What was found to be new is kept in build-fuzz/corpus and used again. An input
# that a target does not survive is left in build-fuzz/findings, and the exit status is 1; to see it once more:
# build-fuzz/bin/FuzzTARGET FILE.
set -euo pipefail
cd "$(dirname "$0")/../.."

# name, largest input in bytes
targets="
  Astm             2048
  BsdfXml          8192
  DirectionsCsv    2048
  Environment      1024
  ExrHeader        2048
  ExrMaterial      8192
  Fit              2048
  Image            4096
  MaterialData      512
  Mbsdf            4096
  Merl             4096
  OpenMaterial     2048
  PhotographList   2048
  Tensor           8192
  Utia              256"

usage() {
  echo "usage: cmake/ci/fuzz.sh [-x EXECUTIONS] [SECONDS] [TARGET...]; targets:" $(awk '{ print $1 }' <<<"$targets") >&2
  exit 2
}
executions=-1 # no limit
if [ "${1:-}" = -x ]; then
  [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || usage
  executions=$2
  shift 2
fi
seconds=30
case ${1:-} in
  '' | *[!0-9]*) ;;
  *) seconds=$1; shift ;;
esac
[ "$seconds" -gt 0 ] || usage
for name in "$@"; do
  grep -q "^ *$name " <<<"$targets" || usage
done

cmake/install-packages.sh --tests
# Clang's runtime library with libFuzzer is a package of its own; "clang" is the suite's default version.
suffix=
packages=(clang)
if [ "$(sed -n 's/^VERSION_ID="\(.*\)"$/\1/p' /etc/os-release 2>/dev/null)" = 12 ]; then
  suffix=-14
  packages=(clang-14 libclang-rt-14-dev)
fi
cmake/install-packages.sh --only "${packages[@]}"
if [ -z "$suffix" ] && command -v dpkg-query >/dev/null; then
  version=$(clang -dumpversion | cut -d. -f1)
  cmake/install-packages.sh --only "libclang-rt-$version-dev"
fi

build=build-fuzz
mkdir -p "$build"
if ! cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER="clang$suffix" \
  -DCMAKE_CXX_COMPILER="clang++$suffix" -DBUILD_TESTING=OFF -DMEASUREDBRDF_WRAP_PYTHON=OFF \
  -DMEASUREDBRDF_BUILD_TOOL=OFF -DMEASUREDBRDF_BUILD_FUZZERS=ON >"$build/configure.log" 2>&1; then
  tail -n 30 "$build/configure.log" >&2
  exit 1
fi
cmake --build "$build" --target fuzzers

# VTK keeps objects until the end; leaks are not what is looked for.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
findings=$build/findings
mkdir -p "$findings"
status=0
while read -r name length; do
  [ -n "$name" ] || continue
  if [ $# -gt 0 ] && [[ " $* " != *" $name "* ]]; then
    continue
  fi
  corpus=$build/corpus/$name
  seeds=$build/seeds/$name
  log=$build/$name.log
  mkdir -p "$corpus" "$seeds"
  "$build/bin/MakeFuzzSeeds" "$name" "$seeds"
  start=$SECONDS
  if "$build/bin/Fuzz$name" -max_total_time="$seconds" -runs="$executions" \
    -max_len="$length" -rss_limit_mb=2048 -timeout=20 -use_value_profile=1 \
    -artifact_prefix="$findings/$name-" -print_final_stats=1 -verbosity=1 "$corpus" "$seeds" >"$log" 2>&1; then
    printf '%-16s %10s executions in %s s, %s inputs kept\n' "$name" \
      "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" "$((SECONDS - start))" "$(find "$corpus" -type f | wc -l)"
  else
    status=1
    printf '%-16s FOUND something; log: %s\n' "$name" "$log"
    grep -E -A 12 'ERROR: |runtime error: |terminate called|what\(\)' "$log" | head -n 30 || true
    grep -E '^artifact_prefix|Test unit written to' "$log" || true
  fi
done <<<"$targets"
exit "$status"
