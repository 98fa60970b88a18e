#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
# Installs the distribution's ParaView with what the plugin is built and tested with. ParaView's CMake files look for
# more than paraview-dev depends on; the list is for ParaView 5.11 (Qt 5), 5.13 and 6.1 (Qt 6), and names that a suite does not
# have are left out. Debian 12's python3-paraview and python3-vtk9 exclude each other: nothing is removed, so there this
# works on a machine without python3-vtk9 only.
set -euo pipefail
cd "$(dirname "$0")/../.."
suite=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release 2>/dev/null || true)
packages=(cmake ninja-build g++ libopenimageio-dev openimageio-tools libopenexr-dev libglm-dev nlohmann-json3-dev
  libeigen3-dev libxxhash-dev libgl1-mesa-dri xvfb xauth xdotool imagemagick
  paraview paraview-dev python3-paraview mpi-default-bin mpi-default-dev python3-dev python3-numpy
  libglew-dev libgdal-dev libdouble-conversion-dev liblz4-dev libutfcpp-dev libogg-dev libtheora-dev libavcodec-dev
  libavformat-dev libavutil-dev libswscale-dev libgl2ps-dev libfreetype-dev libopengl-dev libx11-dev)
case $suite in
  bookworm) packages+=(qtbase5-dev libqt5svg5-dev qttools5-dev libqt5opengl5-dev qtxmlpatterns5-dev-tools) ;;
  trixie) packages+=(qt6-base-dev qt6-svg-dev qt6-tools-dev qt6-5compat-dev) ;;
  # From here on ParaView uses the system's VTK.
  *) packages+=(qt6-base-dev qt6-svg-dev qt6-tools-dev qt6-5compat-dev libvtk9-dev libvtk9-qt-dev) ;;
esac
exec cmake/install-packages.sh --only "${packages[@]}"
