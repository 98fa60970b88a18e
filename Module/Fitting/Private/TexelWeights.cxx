// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TexelWeights.h"

#include "ParallelFor.h"
#include "vtkPhotographSet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace measuredbrdf
{
MaterialValues MaterialValues::Select(const std::vector<int>& materials) const
{
  MaterialValues some;
  some.Scales = this->Scales;
  some.Values.resize(this->Values.rows(), static_cast<Eigen::Index>(materials.size()));
  for (std::size_t k = 0; k < materials.size(); ++k)
  {
    some.Values.col(static_cast<Eigen::Index>(k)) = this->Values.col(materials[k]);
  }
  return some;
}

TexelSums::TexelSums(const MaterialValues& materials, std::vector<std::size_t> texels)
  : Materials(materials)
  , Texels(std::move(texels))
  , Matrix(materials.Values.transpose() * materials.Values)
  , Right(Eigen::MatrixXd::Zero(
      materials.GetNumberOfMaterials(), static_cast<Eigen::Index>(this->Texels.size())))
  , Squares(this->Texels.size(), 0.0)
  , Masked(this->Texels.size(), 0)
  , WordsPerTexel((static_cast<std::size_t>(materials.GetNumberOfPhotographs()) + 63) / 64)
{
}

std::size_t TexelSums::GetBytesPerTexel(Eigen::Index materials, int photographs)
{
  const std::size_t words = (static_cast<std::size_t>(photographs) + 63) / 64;
  return 8 * (static_cast<std::size_t>(materials) + 1 + words + 1) + 4;
}

void TexelSums::Add(int photograph, const PhotographPixels& pixels)
{
  const auto bit = static_cast<std::size_t>(photograph);
  const bool masks = std::any_of(this->Texels.begin(), this->Texels.end(),
    [&](std::size_t texel) { return pixels.States[texel] != PixelState::Valid; });
  if (masks && this->Masks.empty())
  {
    this->Masks.assign(this->WordsPerTexel * this->Texels.size(), 0);
  }
  const Eigen::MatrixXd rows = this->Materials.Values.middleRows<3>(3 * photograph).transpose();
  const double inverse = 1.0 / this->Materials.Scales[bit];
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(this->Texels.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      {
        const std::size_t texel = this->Texels[k];
        if (pixels.States[texel] != PixelState::Valid)
        {
          this->Masks[k * this->WordsPerTexel + bit / 64] |= std::uint64_t(1) << (bit % 64);
          ++this->Masked[k];
          continue;
        }
        const Eigen::Vector3d value =
          Eigen::Map<const Eigen::Vector3f>(&pixels.Values[3 * texel]).cast<double>() * inverse;
        this->Right.col(static_cast<Eigen::Index>(k)).noalias() += rows * value;
        this->Squares[k] += value.squaredNorm();
      }
    });
}

SmallMatrix TexelSums::GetMatrix(std::size_t k, const std::vector<int>& columns) const
{
  const auto n = static_cast<Eigen::Index>(columns.size());
  const int photographs = this->Materials.GetNumberOfPhotographs();
  // The sum of the valid ones, or all but the masked ones: what is less work.
  const bool subtract = 2 * this->Masked[k] <= static_cast<std::uint32_t>(photographs);
  SmallMatrix matrix = SmallMatrix::Zero(n, n);
  for (Eigen::Index a = 0; a < n && subtract; ++a)
  {
    for (Eigen::Index b = 0; b < n; ++b)
    {
      matrix(a, b) =
        this->Matrix(columns[static_cast<std::size_t>(a)], columns[static_cast<std::size_t>(b)]);
    }
  }
  for (int p = 0; p<photographs&& this->Masked[k]> 0; ++p)
  {
    if (this->IsMasked(k, p) != subtract)
    {
      continue;
    }
    for (int c = 0; c < 3; ++c)
    {
      SmallVector row(n);
      for (Eigen::Index a = 0; a < n; ++a)
      {
        row[a] = this->Materials.Values(3 * p + c, columns[static_cast<std::size_t>(a)]);
      }
      matrix += (subtract ? -1.0 : 1.0) * row * row.transpose();
    }
  }
  return matrix;
}

SmallVector TexelSums::GetRight(std::size_t k, const std::vector<int>& columns) const
{
  SmallVector right(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t a = 0; a < columns.size(); ++a)
  {
    right[static_cast<Eigen::Index>(a)] = this->Right(columns[a], static_cast<Eigen::Index>(k));
  }
  return right;
}

int TexelSums::GetNumberOfPhotographs(std::size_t k) const
{
  return this->Materials.GetNumberOfPhotographs() - static_cast<int>(this->Masked[k]);
}

MaterialValues EvaluateMaterials(vtkPhotographSet* set, const std::vector<NamedMaterial>& materials,
  const std::vector<double>& scales)
{
  const int photographs = set->GetNumberOfPhotographs();
  MaterialValues result;
  result.Values.resize(3 * photographs, static_cast<Eigen::Index>(materials.size()));
  result.Scales = scales;
  for (const NamedMaterial& material : materials)
  {
    material.BRDF->Prepare();
  }
  for (int k = 0; k < photographs; ++k)
  {
    double light[3], view[3];
    set->GetLight(k, light);
    set->GetView(k, view);
    const double scale = set->GetScale(k);
    double logarithms = 0.0;
    for (std::size_t m = 0; m < materials.size(); ++m)
    {
      double f[3];
      materials[m].BRDF->Evaluate(light, view, f);
      for (int c = 0; c < 3; ++c)
      {
        result.Values(3 * k + c, static_cast<Eigen::Index>(m)) = scale * f[c];
        logarithms += std::log(scale * f[c] + NoiseFloor);
      }
    }
    if (scales.empty())
    {
      result.Scales.push_back(std::exp(
        logarithms / (3.0 * static_cast<double>(std::max<std::size_t>(materials.size(), 1)))));
    }
    result.Values.middleRows<3>(3 * k) /= result.Scales[static_cast<std::size_t>(k)];
  }
  return result;
}

namespace
{
constexpr int MostRounds = 8;         // of exchanges
constexpr double Exchange = 1e-3;     // an exchange must lower the sum by this share
constexpr double NothingLeft = 1e-14; // of the sum of squares: rounding

class Selection
{
public:
  Selection(const TexelSums& sums, const SelectionOptions& options, int materials)
    : Sums(sums)
    , Options(options)
    , Materials(materials)
  {
    for (std::size_t k = 0; k < sums.GetNumberOfTexels(); ++k)
    {
      this->Squares += sums.GetSquares(k);
    }
  }

  std::vector<int> Run()
  {
    while (static_cast<int>(this->Chosen.size()) < std::min(this->Options.Most, this->Materials))
    {
      double error = 0.0;
      const std::vector<int> best = this->FindBest(this->Chosen.size(), error);
      if (best.empty())
      {
        return {};
      }
      if (!this->Chosen.empty() && error >= (1.0 - this->Options.Tolerance) * this->Error)
      {
        break; // it does not pay
      }
      this->Chosen = best;
      this->Error = error;
      if (this->Error <= NothingLeft * this->Squares)
      {
        break;
      }
    }
    for (int round = 0; round < MostRounds && this->Improve(); ++round)
    {
    }
    this->RemoveIdle();
    std::sort(this->Chosen.begin(), this->Chosen.end());
    return this->IsStopped ? std::vector<int>() : this->Chosen;
  }

private:
  // Texels in a fixed order, so that the sum does not depend on threads.
  double GetError(const std::vector<int>& columns) const
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < this->Sums.GetNumberOfTexels(); ++k)
    {
      sum += SolveTexel(this->Sums, k, columns).Residual;
    }
    return sum;
  }

  // The errors of many sets, a thread for some of them.
  std::vector<double> GetErrors(const std::vector<std::vector<int>>& sets)
  {
    std::vector<double> errors(sets.size());
    constexpr std::size_t batch = 32; // so that Proceed is asked now and then
    for (std::size_t first = 0; first < sets.size() && !this->IsStopped; first += batch)
    {
      measuredbrdf::ParallelFor(static_cast<vtkIdType>(first),
        static_cast<vtkIdType>(std::min(first + batch, sets.size())), 1,
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType k = begin; k < end; ++k)
          {
            errors[static_cast<std::size_t>(k)] = this->GetError(sets[static_cast<std::size_t>(k)]);
          }
        });
      const double share = static_cast<double>(this->Chosen.size()) / this->Options.Most;
      this->IsStopped = !this->Options.Proceed(std::min(share, 1.0));
    }
    return errors;
  }

  // Of the sets in which another material stands at a place, behind the last one to add it, the one
  // that leaves least, which error says; empty if it was stopped or there is none.
  std::vector<int> FindBest(std::size_t place, double& error)
  {
    std::vector<std::vector<int>> sets;
    for (int k = 0; k < this->Materials; ++k)
    {
      if (std::find(this->Chosen.begin(), this->Chosen.end(), k) == this->Chosen.end())
      {
        sets.push_back(this->Chosen);
        sets.back().resize(std::max(this->Chosen.size(), place + 1));
        sets.back()[place] = k;
      }
    }
    const std::vector<double> errors = this->GetErrors(sets);
    if (this->IsStopped || errors.empty())
    {
      return {};
    }
    const auto best = std::min_element(errors.begin(), errors.end());
    error = *best;
    return sets[static_cast<std::size_t>(best - errors.begin())];
  }

  // Exchange one material where that helps.
  bool Improve()
  {
    for (std::size_t place = 0; place < this->Chosen.size(); ++place)
    {
      double error = 0.0;
      const std::vector<int> best = this->FindBest(place, error);
      if (best.empty())
      {
        return false;
      }
      if (error < (1.0 - Exchange) * this->Error - NothingLeft * this->Squares)
      {
        this->Error = error;
        this->Chosen = best;
        return true;
      }
    }
    return false;
  }

  // What earlier choices no longer need.
  void RemoveIdle()
  {
    for (std::size_t place = 0; place < this->Chosen.size() && this->Chosen.size() > 1;)
    {
      std::vector<int> without = this->Chosen;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(place));
      const double error = this->GetError(without);
      if ((1.0 - this->Options.Tolerance) * error <= this->Error + NothingLeft * this->Squares)
      {
        this->Chosen = without;
        this->Error = error;
      }
      else
      {
        ++place;
      }
    }
  }

  const TexelSums& Sums;
  const SelectionOptions& Options;
  int Materials;
  std::vector<int> Chosen;
  double Squares = 0.0;
  double Error = std::numeric_limits<double>::infinity();
  bool IsStopped = false;
};
}

WeightSolution SolveTexel(const TexelSums& sums, std::size_t k, const std::vector<int>& columns)
{
  WeightSolution solution;
  if (sums.GetNumberOfPhotographs(k) == 0)
  {
    solution.Weights = SmallVector::Zero(static_cast<Eigen::Index>(columns.size()));
    return solution;
  }
  const SmallMatrix matrix = sums.GetMatrix(k, columns);
  const SmallVector right = sums.GetRight(k, columns);
  solution.Weights = SolveConstrained(matrix, right, UnknownsAre::Shares);
  const double residual = sums.GetSquares(k) - 2.0 * right.dot(solution.Weights) +
                          solution.Weights.dot(matrix * solution.Weights);
  solution.Residual = std::max(residual, 0.0); // rounding
  return solution;
}

std::vector<int> SelectMaterials(const TexelSums& sums, const SelectionOptions& options)
{
  const int materials = sums.GetNumberOfMaterials();
  bool any = false;
  for (std::size_t k = 0; k < sums.GetNumberOfTexels(); ++k)
  {
    any = any || sums.GetNumberOfPhotographs(k) > 0;
  }
  return any ? Selection(sums, options, materials).Run() : std::vector<int>();
}
} // namespace measuredbrdf
