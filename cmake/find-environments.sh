#!/bin/bash
# Prints the folder with Blender's eight CC0 HDR environments (studio.exr, sunset.exr, ...), or nothing. Where the
# package blender-data is not installed, only these files are taken out of it, into build/environments.
set -u
cd "$(dirname "$0")/.." || exit 1

installed=/usr/share/blender/datafiles/studiolights/world
own=$PWD/build/environments
for folder in "$installed" "$own"; do
  [ -f "$folder/studio.exr" ] && echo "$folder" && exit 0
done
command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || exit 0

echo "Fetching the HDR environments from the package blender-data (30 to 50 MB, once) ..." >&2
scratch=$(mktemp -d) || exit 0
trap 'rm -rf "$scratch"' EXIT
[ "$(id -u)" = 0 ] && chmod 755 "$scratch" && chown _apt "$scratch" 2>/dev/null # apt downloads as this user
if ! (cd "$scratch" && apt-get download -q blender-data) >"$scratch/log" 2>&1; then
  # The lists may be missing or older than what the server still has.
  as_root=()
  [ "$(id -u)" = 0 ] || as_root=(sudo -n)
  "${as_root[@]}" apt-get update -q >>"$scratch/log" 2>&1
  (cd "$scratch" && apt-get download -q blender-data) >>"$scratch/log" 2>&1
fi
if package=$(ls "$scratch"/blender-data_*.deb 2>/dev/null) &&
  dpkg-deb --fsys-tarfile "$package" | tar -x -C "$scratch" --wildcards "*/studiolights/world/*.exr" 2>>"$scratch/log"; then
  mkdir -p "$own"
  find "$scratch" -path '*/studiolights/world/*.exr' -exec mv -f {} "$own/" \;
fi
if [ -f "$own/studio.exr" ]; then
  echo "$own"
else
  echo "blender-data could not be had ($(grep -m 1 '^[WE]:' "$scratch/log" || echo "no such files in it"))." >&2
fi
exit 0
