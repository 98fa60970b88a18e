#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Python package with pip against the system's VTK, installs it into a virtual environment (build-venv), and
# uses it there: one copy of the library, a picture that is not empty, and the package's Python tests.
#
#   cmake/ci/wheel.sh [TEST...]                  TEST: names in Testing/Python, e.g. TestEvaluate; default: all
#   cmake/ci/wheel.sh --pypi PYTHON [TEST...]    the same with the wheel in dist/ (cmake/ci/pypi-wheel.sh) beside VTK and PyVista from PyPI,
#                                                without a display
#
# pip compiles in build-wheel, which a later run uses again. The picture is build-venv/sphere.png.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD
venv=$root/build-venv
rm -rf "$venv"
with_display() { "$@"; }
if [ "${1:-}" = --pypi ]; then
  "$2" -m venv "$venv"
  "$venv/bin/pip" install -q dist/*-"$("$2" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')"-*.whl pyvista
  shift 2
else
  cmake/install-packages.sh --tests
  cmake/install-packages.sh --only python3-pip python3-venv
  /usr/bin/python3 -m venv --system-site-packages "$venv"
  "$venv/bin/pip" install -q 'scikit-build-core>=0.10'
  # From here on nothing comes from the network.
  CMAKE_ARGS="-DPython3_EXECUTABLE=$venv/bin/python ${CMAKE_ARGS:-}" \
    "$venv/bin/pip" install --no-build-isolation --no-deps --no-index . >"$venv/pip.log" 2>&1 || {
    tail -n 30 "$venv/pip.log" >&2
    exit 1
  }
  with_display() { xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$@"; }
fi

unset PYTHONPATH # or a build tree is tested
export LIBGL_ALWAYS_SOFTWARE=1
cd "$venv"
package=$(bin/python -c 'import os, vtkmeasuredbrdf; print(os.path.dirname(vtkmeasuredbrdf.__file__))')
case $package in
  "$venv"/*) ;;
  *) echo "wheel.sh: vtkmeasuredbrdf is imported from $package, not from $venv" >&2; exit 1 ;;
esac
copies=$(find "$package" -name 'libvtkMeasuredBRDF.so*' | wc -l)
[ "$copies" = 1 ] || { echo "wheel.sh: $package holds the library $copies times, expected once" >&2; exit 1; }
du -sh "$package"

with_display bin/python "$root/Examples/Python/measured_sphere.py" -o sphere.png
bin/python - sphere.png <<'END'
import sys
from vtkmodules.vtkIOImage import vtkPNGReader
reader = vtkPNGReader()
reader.SetFileName(sys.argv[1])
reader.Update()
image = reader.GetOutput()
width, height, _ = image.GetDimensions()
center, corner = ([image.GetScalarComponentAsDouble(x, y, 0, c) for c in range(3)]
                  for x, y in ((width // 2, height // 2), (0, 0)))
if corner != [0.0, 0.0, 0.0] or not center[0] > center[2] > 0.0:
    sys.exit(f"wheel.sh: the picture shows {center} in its middle and {corner} in its corner, expected gold on black")
END

# The picture was drawn by what VTK falls back to without a display, with a warning; tests want none.
[ -n "${DISPLAY:-}" ] || export VTK_DEFAULT_OPENGL_WINDOW=vtkEGLRenderWindow
tests=("$@")
[ $# -gt 0 ] || mapfile -t tests < <(cd "$root/Testing/Python" && ls Test*.py)
failed=()
for test in "${tests[@]}"; do
  printf '%s: ' "${test%.py}"
  status=0
  with_display bin/python -B "$root/Testing/Python/${test%.py}.py" >test.log 2>&1 || status=$?
  case $status in
    0) echo passed ;;
    77 | 125) tail -n 1 test.log ;; # why it was skipped
    *)
      echo failed
      tail -n 20 test.log
      failed+=("$test") ;;
  esac
done
[ ${#failed[@]} = 0 ] || { echo "wheel.sh: ${#failed[@]} tests failed: ${failed[*]}" >&2; exit 1; }
