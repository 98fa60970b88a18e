// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TexelSums.h"

#include "ParallelFor.h"

#include <algorithm>
#include <utility>

namespace measuredbrdf
{
//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
std::size_t TexelSums::GetBytesPerTexel(Eigen::Index materials, int photographs)
{
  const std::size_t words = (static_cast<std::size_t>(photographs) + 63) / 64;
  return 8 * (static_cast<std::size_t>(materials) + 1 + words + 1) + 4;
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
SmallVector TexelSums::GetRight(std::size_t k, const std::vector<int>& columns) const
{
  SmallVector right(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t a = 0; a < columns.size(); ++a)
  {
    right[static_cast<Eigen::Index>(a)] = this->Right(columns[a], static_cast<Eigen::Index>(k));
  }
  return right;
}

//------------------------------------------------------------------------------
int TexelSums::GetNumberOfPhotographs(std::size_t k) const
{
  return this->Materials.GetNumberOfPhotographs() - static_cast<int>(this->Masked[k]);
}
} // namespace measuredbrdf
