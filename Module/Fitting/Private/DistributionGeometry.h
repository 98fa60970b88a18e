// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The positions of the samples in the D-BRDF's tables, shared by the channels.
 */

#ifndef DistributionGeometry_h
#define DistributionGeometry_h

#include "FitSamples.h"
#include "Neighbors.h"

#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace measuredbrdf
{
struct DistributionSize
{
  int NumberOfTheta;
  int NumberOfPhi; // 1: isotropic
  int NumberOfFresnel;
};

/// The unknowns of p are its cells (theta fastest), then the Lambert part.
class DistributionGeometry
{
public:
  DistributionGeometry(const FitSamples& samples, const DistributionSize& size);

  struct Place
  {
    std::array<int, 5> Unknowns; // neighbors in p, then the Lambert part
    std::array<double, 4> Weights;
    Neighbors D;  // in F
    double Scale; // 1 / (4 (cos_i + cos_o - cos_i cos_o))
  };

  int GetNumberOfCells() const { return this->NumberOfCells; }
  int GetNumberOfNeighbors() const { return this->NumberOfNeighbors; } // 2 or, anisotropic, 4
  const Place& GetPlace(std::size_t sample) const { return this->Places[sample]; }

  /// Pairs of neighboring cells, the larger number first.
  const std::vector<std::array<int, 2>>& GetTies() const { return this->Ties; }

  /// Zeros at all pairs of unknowns that a sample or a tie links (lower triangle).
  const Eigen::SparseMatrix<double>& GetPattern() const { return this->Pattern; }

  /// Positions of a sample's unknowns (a, b), b <= a, in the pattern's values; b fastest.
  const int* GetPositions(std::size_t sample) const;

private:
  Place FindPlace(const FitSample& sample, const DistributionSize& size) const;
  void FindTies(int nTheta);
  void MakePattern();
  int FindPosition(int row, int column) const;
  template <typename Use>
  void ForPairs(const Use& use) const;

  int NumberOfCells;
  int NumberOfNeighbors;
  std::vector<Place> Places;
  std::vector<std::array<int, 2>> Ties;
  Eigen::SparseMatrix<double> Pattern;
  std::vector<int> Positions;
};
} // namespace measuredbrdf

#endif
