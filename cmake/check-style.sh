#!/bin/bash
# Do all C++ files look as .clang-format says? usage: cmake/check-style.sh [CLANG_FORMAT]
# Only version 14 is asked: others lay out the same rules differently. 125: it is not here, nothing was checked.
set -u
cd "$(dirname "$0")/.." || exit 1
clang_format=${1:-clang-format-14}
if ! command -v "$clang_format" >/dev/null; then
  echo "Skipped: the style check needs clang-format-14"
  exit 125
fi
find Module Applications Examples Hosts Testing -name '*.h' -o -name '*.cxx' | sort |
  xargs "$clang_format" --dry-run -Werror
