// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Materials found in photographs, as tables.
 */

#ifndef TableMaterials_h
#define TableMaterials_h

#include "TexelWeights.h"

#include <array>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// As vtkMaterialMapFitter has them.
struct TableOptions
{
  int Materials;
  unsigned int Seed;
  double Smoothness;
  std::array<int, 3> Dimensions;
};

struct TableMaterials
{
  std::vector<NamedMaterial> Materials;
  std::vector<double> Scales; // each photograph's unit of error: the mean of its valid pixels plus
                              // NoiseFloor
  double FactorError = 0.0;
  int Iterations = 0;
  bool Converged = false;
  double SeenShare = 0.0; // of the tables' cells
};

/// A sample of texels is factored; each material's values in the photographs become a table.
/// Progress goes to 0.6. Throws what passes do, and std::runtime_error.
TableMaterials FindTableMaterials(vtkPhotographSet* photographs, const TableOptions& options,
  PhotographPasses& passes, const std::vector<std::size_t>& sample);
} // namespace measuredbrdf

#endif
