// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The normal equations of many texels' weights, summed up while photographs go by one at a time.
 */

#ifndef TexelSums_h
#define TexelSums_h

#include "LinearLeastSquares.h"
#include "PhotographPixels.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace measuredbrdf
{
/// A pixel's linear value of each material in each photograph, divided by the photograph's scale of
/// errors: 3 rows (RGB) a photograph, a column for each material.
struct MaterialValues
{
  Eigen::MatrixXd Values;
  std::vector<double> Scales; // of each photograph: its unit of error, as a linear value

  int GetNumberOfPhotographs() const { return static_cast<int>(this->Scales.size()); }
  Eigen::Index GetNumberOfMaterials() const { return this->Values.cols(); }

  /// Some of the materials.
  MaterialValues Select(const std::vector<int>& materials) const;
};

/**
 * For each texel t and its valid photographs: H = sum m m', g = sum m b, and sum b^2, where m are
 * the materials' values and b is the pixel's. H is the same for all texels but for their masked
 * photographs, which are kept as bits.
 */
class TexelSums
{
public:
  /// texels: their numbers in the pictures.
  TexelSums(const MaterialValues& materials, std::vector<std::size_t> texels);

  /// Bytes that each texel takes.
  static std::size_t GetBytesPerTexel(Eigen::Index materials, int photographs);

  /// Add the next photograph, on several threads.
  void Add(int photograph, const PhotographPixels& pixels);

  int GetNumberOfMaterials() const
  {
    return static_cast<int>(this->Materials.GetNumberOfMaterials());
  }
  std::size_t GetNumberOfTexels() const { return this->Texels.size(); }
  std::size_t GetTexel(std::size_t k) const { return this->Texels[k]; }

  /// Of the materials at some of the columns. Fewer than MaximumNumberOfUnknowns.
  SmallMatrix GetMatrix(std::size_t k, const std::vector<int>& columns) const;
  SmallVector GetRight(std::size_t k, const std::vector<int>& columns) const;
  double GetSquares(std::size_t k) const { return this->Squares[k]; }

  /// Valid photographs of a texel.
  int GetNumberOfPhotographs(std::size_t k) const;

private:
  bool IsMasked(std::size_t k, int photograph) const
  {
    const auto bit = static_cast<std::size_t>(photograph);
    return !this->Masks.empty() &&
           (this->Masks[k * this->WordsPerTexel + bit / 64] >> (bit % 64) & 1u) != 0;
  }

  const MaterialValues& Materials;
  std::vector<std::size_t> Texels;
  Eigen::MatrixXd Matrix;            // of all photographs
  Eigen::MatrixXd Right;             // [material, texel]
  std::vector<double> Squares;       // of each texel
  std::vector<std::uint64_t> Masks;  // of each texel; empty while nothing is masked
  std::vector<std::uint32_t> Masked; // how many photographs of each texel
  std::size_t WordsPerTexel;
};
} // namespace measuredbrdf

#endif
