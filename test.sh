#!/bin/bash
# Installs what is missing, builds with warnings as errors, and runs every test: unit, render and Python tests, and
# the installed package with its examples. Further arguments go to ctest, e.g. ./test.sh -L unit.
set -euo pipefail
cd "$(dirname "$0")"
minimum_tests=900 # tests that vanish must not go unnoticed
jobs=$(nproc)

step() { printf '\n== %s\n' "$*"; }

step "1/3 packages"
cmake/install-packages.sh --tests

step "2/3 build"
# VTK's Python modules belong to one interpreter, which need not be the first on the PATH.
for python in /usr/bin/python3 python3; do
  "$python" -c 'import vtkmodules' 2>/dev/null && break
done
mkdir -p build
if ! cmake --preset dev -DPython3_EXECUTABLE="$(command -v "$python")" \
  >build/configure.log 2>&1; then
  tail -n 30 build/configure.log >&2
  echo "test.sh: CMake could not configure the build; all of what it said is in build/configure.log" >&2
  exit 1
fi
cmake --build build

step "3/3 tests"
# One X server around all of ctest, and the software renderer everywhere: the same pixels on every machine.
export LIBGL_ALWAYS_SOFTWARE=1
# Compiling shaders takes most of its time: half of that without LLVM's optimization. Code that is made so is kept apart
# from what other programs draw with.
export GALLIVM_PERF=nopt
export MESA_SHADER_CACHE_DIR="$PWD/build/shader-cache"
rm -rf "$MESA_SHADER_CACHE_DIR"
# The library's tests run with decimal commas in C's locale, as in a German user's Qt program. The tool sets no locale, so
# its tests run in C's own.
locale=de_DE.UTF-8
if localedef -i de_DE -f UTF-8 "$PWD/build/$locale" 2>/dev/null || [ -d "build/$locale" ]; then
  export LOCPATH="$PWD/build:/usr/lib/locale" MEASUREDBRDF_TEST_LOCALE=$locale
else
  echo "Not run with decimal commas: localedef made no locale $locale (Debian's package locales has it)"
fi
export MEASUREDBRDF_FUZZ_SECONDS=1 # each of the readers' fuzz targets
status=0
xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" \
  ctest --test-dir build --output-on-failure --output-junit ctest.xml -j "$jobs" "$@" || status=$?

count() { sed -n "s/^.*[ \t]$1=\"\([0-9]*\)\".*/\1/p" build/ctest.xml | head -n 1; }
log=build/Testing/Temporary/LastTest.log
if grep -q ': Skipped$\|^Skipped: ' "$log"; then
  printf '\nWhy tests were skipped:\n'
  # GoogleTest gives the reason in the line after "FILE:LINE: Skipped".
  awk '/: Skipped$/ { getline; print; next } /^Skipped: / { sub("Skipped: ", ""); print }' "$log" | sort | uniq -c
fi
# To ctest a program of GoogleTest's is one test. Its own are counted here, as those of a program that crashed cannot be.
read -r passed failed skipped < <(
  awk -v total="$(count tests)" -v failed="$(count failures)" -v skipped="$(count skipped)" '
    BEGIN { passed = total - failed - skipped }
    /^\[  PASSED  \] [0-9]+ test/ { passed += $4 }
    /^\[  SKIPPED \] [0-9]+ test/ { skipped += $4 }
    /^[0-9]+\/[0-9]+ Testing: / { bad = 0 }
    /^\[  FAILED  \] / { ++bad }
    /^\[=+\] .* ran\./ { if (bad) failed += bad - 1; else --passed }
    END { print passed, failed, skipped }' "$log")
echo "$passed passed, $failed failed, $skipped skipped"
if [ $# -eq 0 ] && [ $((passed + failed + skipped)) -lt "$minimum_tests" ]; then
  echo "test.sh: at least $minimum_tests tests are expected" >&2
  status=1
fi

# The plugin where ParaView is already there; Hosts/ParaView/test.sh installs it.
if [ $# -gt 0 ]; then
  :
elif dpkg-query -W paraview-dev python3-paraview >/dev/null 2>&1; then
  Hosts/ParaView/test.sh || status=1
else
  echo "Not run: the tests of the ParaView plugin (no paraview-dev and python3-paraview here; Hosts/ParaView/test.sh installs it)"
fi
exit "$status"
