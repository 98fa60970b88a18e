#!/bin/bash
# Installs the Debian packages that are missing, as root or through sudo. Nothing is downloaded when all are there.
# Nothing is removed either: a package that conflicts with what is installed is left out, with apt-get's reason.
# Where that cannot be done it says what is needed and leaves the verdict to the build.
#
#   cmake/install-packages.sh [--tests]             --tests: also what only the tests need
#   cmake/install-packages.sh --only PACKAGE...     these and nothing else
set -u
packages=(cmake ninja-build g++ libvtk9-dev python3-vtk9 libopenimageio-dev openimageio-tools libopenexr-dev
  libglm-dev nlohmann-json3-dev libeigen3-dev libceres-dev libcli11-dev libgl1-mesa-dri xvfb xauth)
size=" (500 to 1100 MB download on a bare system)"
case ${1:-} in
  --tests) packages+=(libgtest-dev libbenchmark-dev python3-numpy) ;;
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

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  say "All there already."
  exit 0
fi

as_root=()
if [ "$(id -u)" != 0 ]; then
  if ! command -v sudo >/dev/null; then
    say "Packages are missing, and there is neither root nor sudo to install them. As root, run"
    say "  apt-get install --no-install-recommends ${missing[*]}"
    say "Going on with what is there."
    exit 0
  fi
  as_root=(sudo)
fi
as_root+=(env DEBIAN_FRONTEND=noninteractive)

cd "$(dirname "$0")/.." && mkdir -p build || exit 1
log=build/packages.log
: >"$log"
say "Installing ${missing[*]} and what they need$size; log: $log ..."
"${as_root[@]}" apt-get update -q >>"$log" 2>&1 ||
  say "The package lists could not be refreshed ($(grep -m 1 '^[WE]:' "$log")); trying with those at hand."

unknown=()
known=()
for package in "${missing[@]}"; do
  if apt-cache show "$package" >/dev/null 2>&1; then known+=("$package"); else unknown+=("$package"); fi
done
[ ${#unknown[@]} -eq 0 ] ||
  say "Not offered by this system's package sources: ${unknown[*]}. Going on without; add a source that has them if the build stops."
if [ ${#known[@]} -gt 0 ] &&
  ! "${as_root[@]}" apt-get install -q -y --no-remove --no-install-recommends -o Dpkg::Use-Pty=0 "${known[@]}" >>"$log" 2>&1 </dev/null; then
  say "Could not be installed: ${known[*]}. What apt-get said:"
  grep -E '^[WE]:|^ .* : ' "$log" | tail -n 8
  say "Going on with what is there."
fi
exit 0
