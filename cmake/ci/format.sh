#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Are all files laid out as .clang-format and .editorconfig say? Installs clang-format-14 where it is missing.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake/install-packages.sh --only clang-format-14 python3-minimal

status=0
cmake/check-style.sh clang-format-14 || status=1 # 125, not installed, is a failure here
python3 cmake/ci/check_text.py || status=1
[ "$status" -ne 0 ] || echo "The layout is right."
exit "$status"
