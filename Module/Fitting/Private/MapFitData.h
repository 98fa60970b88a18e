// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What goes into the fit of a material map, and what comes out.
 */

#ifndef MapFitData_h
#define MapFitData_h

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace measuredbrdf
{
struct NamedMaterial
{
  vtkSmartPointer<vtkBRDF> BRDF;
  std::string Name;
};

struct MapFitOptions
{
  bool FindsTables = false; // else it chooses from the library
  std::vector<NamedMaterial> Library;
  int Most = 4; // materials
  double Tolerance = 0.02;
  double Compactness = 1e-3;
  double Smoothness = 1e-2;
  std::array<int, 3> TableDimensions = { 8, 16, 64 };
  int SampleTexels = 4096;
  std::size_t MemoryBytes = std::size_t(1) << 30;
  unsigned int Seed = 1;
  std::function<bool(double)> Proceed; // share done; false: stop
};

/// What is known of a material of the result.
struct MapMaterial
{
  NamedMaterial Material;
  double Coverage = 0.0;    // mean of its weights
  double LargestWeight = 0; // of all texels
  double Uncertainty = 0.0; // standard deviation of a weight, where all weights are free
};

struct MapFitResult
{
  bool Stopped = false;
  std::string Problem; // "" if it worked
  int Width = 0;
  int Height = 0;
  std::vector<MapMaterial> Materials;
  std::vector<float> Weights; // [texel][material]; 0 where a texel has no valid photograph
  std::vector<float> Errors;  // of each texel, relative; -1 there
  double MeanError = 0.0;
  double Error95 = 0.0;
  double WorstError = 0.0;
  std::size_t WorstTexel = 0;
  std::size_t TexelsWithoutData = 0;
  std::array<std::uint64_t, 4> PixelCounts{}; // of each PixelState
  double Brightness = 1.0;                    // the factor of all materials that would fit best
  double FactorError = 0.0;                   // of the factorization, before tables; tables only
  double SeenShare = 0.0;                     // of the tables' cells; tables only
  int Iterations = 0;                         // tables only
  bool Converged = true;
  int Passes = 0; // over all photographs
  std::vector<std::string> Findings;
};
} // namespace measuredbrdf

#endif
