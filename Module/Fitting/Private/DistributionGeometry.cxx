// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DistributionGeometry.h"

#include "HalfVector.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
//------------------------------------------------------------------------------
DistributionGeometry::DistributionGeometry(const FitSamples& samples, const DistributionSize& size)
  : NumberOfCells(size.NumberOfTheta * size.NumberOfPhi)
  , NumberOfNeighbors(size.NumberOfPhi > 1 ? 4 : 2)
{
  for (const FitSample& sample : samples)
  {
    this->Places.push_back(this->FindPlace(sample, size));
  }
  this->FindTies(size.NumberOfTheta);
  this->MakePattern();
}

//------------------------------------------------------------------------------
DistributionGeometry::Place DistributionGeometry::FindPlace(
  const FitSample& sample, const DistributionSize& size) const
{
  const HalfDifference angles = ToHalfDifference(sample.I, sample.O);
  const Neighbors t = ClampedNeighbors(ThetaHToUnit(angles.ThetaH), size.NumberOfTheta);
  const Neighbors p =
    PeriodicNeighbors(std::atan2(sample.H.y, sample.H.x) / (2.0 * Pi), size.NumberOfPhi);
  Place place;
  place.D = ClampedNeighbors(angles.ThetaD * (2.0 / Pi), size.NumberOfFresnel);
  place.Scale = 0.25 / (sample.I.z + sample.O.z - sample.I.z * sample.O.z);
  place.Unknowns.fill(this->NumberOfCells);
  place.Weights.fill(0.0);
  for (int k = 0; k < this->NumberOfNeighbors; ++k)
  {
    const bool second = k >= 2; // along phi
    const double share = this->NumberOfNeighbors == 2 ? 1.0 : (second ? p.Weight : 1.0 - p.Weight);
    place.Unknowns[k] =
      (second ? p.Second : p.First) * size.NumberOfTheta + (k % 2 == 0 ? t.First : t.Second);
    place.Weights[k] = share * (k % 2 == 0 ? 1.0 - t.Weight : t.Weight);
  }
  return place;
}

//------------------------------------------------------------------------------
void DistributionGeometry::FindTies(int nTheta)
{
  for (int cell = 0; cell < this->NumberOfCells; ++cell)
  {
    const int beside = (cell + nTheta) % this->NumberOfCells;
    if (cell % nTheta + 1 < nTheta)
    {
      this->Ties.push_back({ cell + 1, cell });
    }
    if (beside != cell)
    {
      this->Ties.push_back({ std::max(cell, beside), std::min(cell, beside) });
    }
  }
}

//------------------------------------------------------------------------------
void DistributionGeometry::MakePattern()
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k <= this->NumberOfCells; ++k)
  {
    entries.emplace_back(k, k, 0.0);
  }
  for (const auto& tie : this->Ties)
  {
    entries.emplace_back(tie[0], tie[1], 0.0);
  }
  this->ForPairs([&entries](int row, int column) { entries.emplace_back(row, column, 0.0); });
  this->Pattern.resize(this->NumberOfCells + 1, this->NumberOfCells + 1);
  this->Pattern.setFromTriplets(entries.begin(), entries.end());
  this->ForPairs(
    [this](int row, int column) { this->Positions.push_back(this->FindPosition(row, column)); });
}

//------------------------------------------------------------------------------
const int* DistributionGeometry::GetPositions(std::size_t sample) const
{
  const int pairs = (this->NumberOfNeighbors + 1) * (this->NumberOfNeighbors + 2) / 2;
  return &this->Positions[sample * static_cast<std::size_t>(pairs)];
}

//------------------------------------------------------------------------------
int DistributionGeometry::FindPosition(int row, int column) const
{
  const int* rows = this->Pattern.innerIndexPtr();
  const int* columns = this->Pattern.outerIndexPtr();
  return static_cast<int>(
    std::lower_bound(rows + columns[column], rows + columns[column + 1], row) - rows);
}

//------------------------------------------------------------------------------
template <typename Use>
void DistributionGeometry::ForPairs(const Use& use) const
{
  for (const Place& place : this->Places)
  {
    for (int a = 0; a <= this->NumberOfNeighbors; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        use(std::max(place.Unknowns[a], place.Unknowns[b]),
          std::min(place.Unknowns[a], place.Unknowns[b]));
      }
    }
  }
}
} // namespace measuredbrdf
