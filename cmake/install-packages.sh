#!/bin/bash
# Installs the Debian packages that are missing, as root or through sudo. Nothing is downloaded when all are there.
# Nothing is removed either: a package that conflicts with what is installed is left out, with apt-get's reason.
# Where that cannot be done it says what is needed and leaves the verdict to the build.
#
#   cmake/install-packages.sh [--tests]             --tests: also what only the tests need
#   cmake/install-packages.sh --only PACKAGE...     these and nothing else
set -u
packages=(cmake ninja-build g++ libvtk9-dev python3-vtk9 libopenimageio-dev openimageio-tools libopenexr-dev
  libglm-dev nlohmann-json3-dev libeigen3-dev libxxhash-dev libceres-dev libcli11-dev
  libcurl4-openssl-dev libssl-dev libgl1-mesa-dri xvfb xauth)
optional=()
size=" (500 to 1100 MB download on a bare system)"
case ${1:-} in
  --tests)
    packages+=(libgtest-dev python3-numpy locales)
    # python3-pyvista where the suite has it: Debian 13 and later. The Qt widget brings the Qt that VTK was built with.
    optional=(python3-pyvista libvtk9-qt-dev) ;;
  --only)
    shift
    packages=("$@")
    size= ;;
esac

say() { printf '%s\n' "$*"; }

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  say "This is no Debian-like system, so nothing is installed. Needed (Debian's names): ${packages[*]}."
  say "Going on with what is there."
  exit 0
fi

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }
is_offered() { apt-cache show "$1" >/dev/null 2>&1; }

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
wanted=()
for package in "${optional[@]}"; do
  if ! is_installed "$package" && is_offered "$package"; then wanted+=("$package"); fi
done
if [ ${#missing[@]} -eq 0 ] && [ ${#wanted[@]} -eq 0 ]; then
  say "All there already."
  exit 0
fi

as_root=()
if [ "$(id -u)" != 0 ]; then
  if ! command -v sudo >/dev/null; then
    say "Packages are missing, and there is neither root nor sudo to install them. As root, run"
    say "  apt-get install --no-install-recommends ${missing[*]} ${wanted[*]}"
    say "Going on with what is there."
    exit 0
  fi
  as_root=(sudo)
fi
as_root+=(env DEBIAN_FRONTEND=noninteractive)

cd "$(dirname "$0")/.." && mkdir -p build || exit 1
log=build/packages.log
: >"$log"
try() { # PACKAGE...: all of them, or none
  "${as_root[@]}" apt-get install -q -y --no-remove --no-install-recommends -o Dpkg::Use-Pty=0 "$@" >>"$log" 2>&1 </dev/null
}
install() {
  local before
  before=$(wc -l <"$log")
  try "$@" ||
    {
      say "Could not be installed: $*. What apt-get said:"
      tail -n "+$((before + 1))" "$log" | grep -E '^[WE]:|^ .* : ' | tail -n 8
      say "Going on with what is there."
    }
}
[ ${#missing[@]} -eq 0 ] || say "Installing ${missing[*]} and what they need$size; log: $log ..."
"${as_root[@]}" apt-get update -q >>"$log" 2>&1 ||
  say "The package lists could not be refreshed ($(grep -m 1 '^[WE]:' "$log")); trying with those at hand."

unknown=()
known=()
for package in "${missing[@]}"; do
  if is_offered "$package"; then known+=("$package"); else unknown+=("$package"); fi
done
[ ${#unknown[@]} -eq 0 ] ||
  say "Not offered by this system's package sources: ${unknown[*]}. Going on without; add a source that has them if the build stops."
offered=()
for package in "${optional[@]}"; do
  if ! is_installed "$package" && is_offered "$package"; then offered+=("$package"); fi
done
# All at once where that can be done, which is sooner. Else the optional ones one by one and last: none is worth a build.
[ ${#known[@]} -gt 0 ] && [ ${#offered[@]} -gt 0 ] && try "${known[@]}" "${offered[@]}" && exit 0
[ ${#known[@]} -eq 0 ] || install "${known[@]}"
for package in "${offered[@]}"; do
  if ! is_installed "$package"; then
    say "Installing $package, which some tests use ..."
    install "$package"
  fi
done
exit 0
