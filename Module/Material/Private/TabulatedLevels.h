// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A half/difference volume at growing widths along theta_h, for soft lights. Private to the
 * material room.
 */

#ifndef TabulatedLevels_h
#define TabulatedLevels_h

#include "Neighbors.h"

#include <array>
#include <vector>

namespace measuredbrdf
{
/**
 * Level k is the volume's values, for every phi_d and theta_d, convolved over the sphere of half
 * vectors with a von Mises-Fisher distribution of variance (1/kappa) s (2^k - 1), s the variance of
 * the volume's own lobe: each level is twice as wide (in variance) as the one before. Between
 * levels: linear. Level 0 is the volume itself and not held here.
 *
 * Wide levels need few samples: four levels have the same number along theta_h, the next four
 * half of it; phi_d and theta_d are averaged to steps of at least 5 and 2 degrees. The levels are
 * stacked along theta_h in one volume.
 */
class TabulatedLevels
{
public:
  /// volume: RGB triples over (phi_d, theta_d, theta_h) as vtkTabulatedBRDF holds them, NaN:
  /// invalid.
  TabulatedLevels(
    const std::array<int, 3>& dimensions, bool halfTurn, const std::vector<float>& volume);

  /// Number of levels without level 0; 1 to 20.
  int GetNumberOfLevels() const { return this->NumberOfLevels; }

  double GetOwnVariance() const { return this->OwnVariance; }

  /// Samples of level 1 along theta_h.
  int GetFirstCount() const { return this->FirstCount; }

  ///@{
  /// Levels 1, 2, ... along the third axis; RGB triples, NaN: invalid.
  const std::array<int, 3>& GetDimensions() const { return this->Dimensions; }
  const std::vector<float>& GetVolume() const { return this->Volume; }
  ///@}

  /// The levels around a variance >= 0 in h.
  Neighbors FindLevels(double variance) const;

  /// The samples of a level >= 1 around theta_h in table coordinates, as indices of the third axis.
  Neighbors FindSlices(int level, double u) const;

private:
  int GetCount(int level) const { return this->FirstCount >> ((level - 1) / 4); }
  int GetOffset(int level) const;

  int NumberOfLevels = 1;
  int FirstCount = 1;
  double OwnVariance = 1.0;
  std::array<int, 3> Dimensions;
  std::vector<float> Volume;
};
} // namespace measuredbrdf

#endif
