// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What BenchmarkOcclusionMethods measured: lines of CSV, their means, and a chart of these.
 */

#ifndef OcclusionMethodRows_h
#define OcclusionMethodRows_h

#include <string>
#include <vector>

struct OcclusionMethodRow
{
  std::string Mesh, Material, Map, Method;
  double Error; // relative L1
  double Frame; // processor time of a frame over that of one without occlusion

  static void PrintHeading();
  void Print() const;
};

/// What Print wrote; other lines are left out.
std::vector<OcclusionMethodRow> ReadOcclusionMethodRows(const std::string& file);

/// Of one mesh, or (no name) of all: the mean error, the worst, and the geometric mean of frames.
struct OcclusionMethodMean
{
  std::string Method, Mesh;
  double Error, Worst, Frame;
  int Count;
};

/// "ssao RADIUS" become one: those of the radius with the least mean error on each mesh.
std::vector<OcclusionMethodMean> GetOcclusionMethodMeans(
  const std::vector<OcclusionMethodRow>& rows);

void PrintOcclusionMethodMeans(const std::vector<OcclusionMethodMean>& means);

/// Error over frame time, STEM.png and STEM.svg: a large dot for a method, small ones for meshes.
void DrawOcclusionMethods(const std::vector<OcclusionMethodMean>& means, const std::string& stem);

#endif
