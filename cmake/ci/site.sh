#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds the documentation site, build/site/html/index.html, and checks every link in it and in the Markdown pages.
#
#   cmake/ci/site.sh [--build | --python FOLDER]
#
#   --build          build the Python package first (in build-site), for its page
#   --python FOLDER  where the built package is; default: build/lib/python3/dist-packages, where it exists
#
# Without the Python package its page says that it is left out.
set -euo pipefail
cd "$(dirname "$0")/../.."

python_folder=build/lib/python3/dist-packages
build=0
case ${1:-} in
  --build) build=1 ;;
  --python) python_folder=${2:?--python needs a folder} ;;
  '') ;;
  *) echo "usage: cmake/ci/site.sh [--build | --python FOLDER]" >&2; exit 2 ;;
esac

cmake/install-packages.sh --only doxygen python3-minimal
site=build/site
rm -rf "$site"
mkdir -p "$site/html"

if [ "$build" = 1 ]; then
  cmake/install-packages.sh
  mkdir -p build-site
  cmake --preset release -B build-site -DMEASUREDBRDF_BUILD_TOOL=OFF -DPython3_EXECUTABLE=/usr/bin/python3 \
    >build-site/configure.log 2>&1 || { tail -n 30 build-site/configure.log >&2; exit 1; }
  cmake --build build-site
  python_folder=$(find "$PWD/build-site/lib" -type d -name vtkmeasuredbrdf -path '*python*' -printf '%h\n' | head -n 1)
fi

python3 docs/site/check_links.py
python3 docs/site/prepare_pages.py "$site/pages" "$site/html/source"

# VTK's Python modules belong to one interpreter, which need not be the first on the PATH.
page=$site/pages/python_api.md
if ! PYTHONPATH=$python_folder /usr/bin/python3 docs/site/python_api.py "$page"; then
  [ "$build" = 0 ] || exit 1
  echo "The Python API is left out: build the package first, or give --build."
  printf '# Python API\n\nLeft out: the package was not built where this site was made.\n' >"$page"
fi
sed -i '1s/$/ {#python_api}/' "$page"

PROJECT_NUMBER=$(sed -n 's/^project(.* VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
export PROJECT_NUMBER
status=0
doxygen docs/site/Doxyfile
if [ -s "$site/warnings.txt" ]; then
  sed "s|^$PWD/||" "$site/warnings.txt"
  echo "site.sh: Doxygen warned of the above" >&2
  status=1
fi
python3 docs/site/check_links.py "$site/html" || status=1
[ "$status" -ne 0 ] || echo "The site: $site/html/index.html"
exit "$status"
