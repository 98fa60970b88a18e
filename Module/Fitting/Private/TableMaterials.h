// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Materials found in photographs, as tables.
 */

#ifndef TableMaterials_h
#define TableMaterials_h

#include "ConvexFactorization.h"
#include "TexelWeights.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

class vtkPhotographSet;

namespace measuredbrdf
{
/// A sample of texels is factored; each material's values in the photographs become a table.
class TableMaterials
{
public:
  TableMaterials(vtkPhotographSet* set, const MapFitOptions& options, std::size_t sampleSize);

  /// Take the sample's texels from a photograph; all photographs must be added.
  void Add(int photograph, const PhotographPixels& pixels, const std::vector<std::size_t>& sample);

  /// Returns what keeps it from working, "" if nothing or if it was stopped.
  std::string Find(const std::function<bool(double)>& proceed);

  const std::vector<NamedMaterial>& GetMaterials() const { return this->Materials; }
  const Factorization& GetFactorization() const { return this->Factors; }
  double GetSeenShare() const { return this->SeenShare; }

  /// Each photograph's unit of error: the mean of its valid pixels plus NoiseFloor.
  const std::vector<double>& GetScales() const { return this->Scales; }

private:
  std::string MakeTables();

  vtkPhotographSet* Set;
  const MapFitOptions& Options;
  Eigen::MatrixXf Data;            // [3 photograph + channel, texel]
  std::vector<unsigned char> Mask; // [texel][photograph]
  std::vector<double> Means;       // of the valid pixels of each photograph, linear; -1: none
  std::vector<double> Scales;
  bool HasMasked = false;
  Factorization Factors;
  double SeenShare = 0.0;
  std::vector<NamedMaterial> Materials;
};
} // namespace measuredbrdf

#endif
