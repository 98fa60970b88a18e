#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Looks for common misspellings in all text: codespell, set up by .codespellrc. Installs it where it is missing.
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake/install-packages.sh --only codespell
codespell
echo "No misspelling found."
