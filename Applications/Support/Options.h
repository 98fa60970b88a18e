// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Options that several commands have: sizes, views, and what a picture shows.
 */

#ifndef Options_h
#define Options_h

#include "Inputs.h"

#include "vtkPolyData.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace tool
{
class OffscreenScene;

/// Share of a picture's smaller side that the mesh takes.
constexpr double ViewFill = 0.9;

/// Checks a path: what must end in ".png", say.
CLI::Validator EndsIn(const std::vector<std::string>& endings);

/// Checks a number, which not a number is not.
CLI::Validator Between(double least, double largest);

/// Add --size, WIDTHxHEIGHT, each side in [1, largest].
void AddSizeOption(CLI::App* command, Size& size, int largest, const std::string& help);

/// Add --view, AZIMUTH,ELEVATION[,ANGLE].
void AddViewOption(CLI::App* command, View& view, const std::string& help = "");

/// What a picture shows: a mesh under an environment, from a view.
struct Stage
{
  std::string EnvironmentFile;
  std::string MeshFile; // "": a sphere
  tool::Size Size = { 500, 500 };
  tool::View View = { 30.0, 20.0 };

  /// Add --environment, which must be given, and what AddMeshTo adds.
  void AddTo(CLI::App* command, int largest, const std::string& meshHelp = "Mesh to show it on");

  /// Add --mesh, --size and --view.
  void AddMeshTo(
    CLI::App* command, int largest, const std::string& meshHelp = "Mesh to show it on");

  /// Throws Error.
  vtkSmartPointer<vtkPolyData> LoadMesh() const;

  /// Show the mesh in a scene.
  void Place(OffscreenScene& scene, vtkPolyData* mesh) const;
};
} // namespace tool

#endif
