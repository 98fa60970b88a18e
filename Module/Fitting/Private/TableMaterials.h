// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Materials found in photographs, as tables.
 */

#ifndef TableMaterials_h
#define TableMaterials_h

#include "TexelWeights.h"

#include <Eigen/Core>

#include <array>
#include <functional>
#include <vector>

namespace measuredbrdf
{
/// As vtkMaterialMapFitter has them.
struct TableOptions
{
  int Materials;
  unsigned int Seed;
  double Compactness;
  double Smoothness;
  std::array<int, 3> Dimensions;
};

/// A sample of texels is factored; each material's values in the photographs become a table.
class TableMaterials
{
public:
  TableMaterials(
    vtkPhotographSet* photographs, const TableOptions& options, std::size_t sampleSize);

  /// Take the sample's texels from a photograph; all photographs must be added.
  void Add(int photograph, const PhotographPixels& pixels, const std::vector<std::size_t>& sample);

  /// proceed: called with the share done; may throw. Throws MapFitError.
  void Find(const std::function<void(double)>& proceed);

  std::vector<NamedMaterial> Materials;
  std::vector<double> Scales; // each photograph's unit of error: the mean of its valid pixels plus
                              // NoiseFloor
  double FactorError = 0.0;
  int Iterations = 0;
  bool Converged = false;
  double SeenShare = 0.0; // of the tables' cells

private:
  void MakeTables(const Eigen::MatrixXd& values);

  vtkPhotographSet* Photographs;
  TableOptions Options;
  Eigen::MatrixXf Data;            // [3 photograph + channel, texel]
  std::vector<unsigned char> Mask; // [texel][photograph], not 0 where data say nothing
  std::vector<double> Means;       // of the valid pixels of each photograph, linear; -1: none
};
} // namespace measuredbrdf

#endif
