#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Installs the distribution's ParaView, builds the plugin, and runs its tests without a display: in one process, as
# pvbatch on 1, 2 and 4 ranks, as a client with a parallel server and with a tiled display, and in ParaView's window.
# Pictures are left in output/paraview.
#
#   Hosts/ParaView/test.sh [TEST...]     names of the functions run_* in Testing/run.sh; default: all
set -euo pipefail
cd "$(dirname "$0")/../.."
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
export LIBGL_ALWAYS_SOFTWARE=1 QT_QPA_PLATFORM=offscreen

step() { printf '\n== %s\n' "$*"; }

step "1/3 packages"
Hosts/ParaView/install-packages.sh

step "2/3 build"
build=build-paraview
mkdir -p "$build"
if ! cmake -S Hosts/ParaView -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DMEASUREDBRDF_WARNINGS_AS_ERRORS=ON >"$build/configure.log" 2>&1; then
  tail -n 30 "$build/configure.log" >&2
  exit 1
fi
cmake --build "$build"

step "3/3 tests"
exec Hosts/ParaView/Testing/run.sh "$build" "$@"
