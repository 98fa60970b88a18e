// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexFactorization.h"

#include "LinearLeastSquares.h"
#include "ParallelFor.h"
#include "SymmetricEigen.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <random>

namespace measuredbrdf
{
namespace
{
constexpr double Negligible = 1e-9; // change of the sum of squares, as a share of all squares
constexpr int Oversampling = 6;     // columns of the range finder beyond the materials
constexpr Eigen::Index Block = 64;  // rows or texels that a thread takes at once

//------------------------------------------------------------------------------
// function(first, count) for blocks of [0, n); what a block computes does not depend on threads.
template <typename Function>
void ForBlocks(Eigen::Index n, const Function& function)
{
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>((n + Block - 1) / Block), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType b = begin; b < end; ++b)
      {
        const Eigen::Index first = static_cast<Eigen::Index>(b) * Block;
        function(first, std::min(Block, n - first));
      }
    });
}

//------------------------------------------------------------------------------
// The texels' coordinates in the affine subspace of the largest variance, which averages noise
// away: a randomized range finder with one power iteration (Halko, Martinsson, Tropp 2011).
Eigen::MatrixXd Project(const Eigen::MatrixXf& data, int dimensions, unsigned int seed)
{
  const Eigen::VectorXf mean = data.rowwise().mean();
  const Eigen::Index columns =
    std::min<Eigen::Index>({ dimensions + Oversampling, data.rows(), data.cols() });
  std::mt19937 random(seed);
  Eigen::MatrixXf start(data.cols(), columns);
  for (Eigen::Index k = 0; k < start.size(); ++k)
  {
    start.data()[k] = static_cast<float>(static_cast<double>(random()) * 0x1p-32 - 0.5);
  }
  const auto center = [&](const Eigen::MatrixXf& right) -> Eigen::MatrixXf
  { return data * right - mean * right.colwise().sum(); };
  const auto transpose = [&](const Eigen::MatrixXf& left) -> Eigen::MatrixXf
  {
    const Eigen::RowVectorXf shift = mean.transpose() * left;
    return (data.transpose() * left).rowwise() - shift;
  };
  const auto orthonormalize = [&](const Eigen::MatrixXf& matrix) -> Eigen::MatrixXf
  {
    const Eigen::HouseholderQR<Eigen::MatrixXf> qr(matrix);
    return qr.householderQ() * Eigen::MatrixXf::Identity(matrix.rows(), columns);
  };
  const Eigen::MatrixXf first = orthonormalize(center(start));
  const Eigen::MatrixXf range = orthonormalize(center(transpose(first)));
  const Eigen::MatrixXd coordinates = transpose(range).cast<double>(); // [texel, column]
  const SymmetricEigen eigen(coordinates.transpose() * coordinates);
  const Eigen::Index kept = std::min<Eigen::Index>(dimensions, columns);
  return (coordinates * eigen.Vectors.rightCols(kept)).transpose();
}

//------------------------------------------------------------------------------
// The texels that lie farthest apart.
std::vector<Eigen::Index> FindCorners(const Eigen::MatrixXf& data, int count, unsigned int seed)
{
  Eigen::MatrixXd points = Project(data, std::max(count - 1, 1), seed);
  std::vector<Eigen::Index> corners(1);
  points.colwise().squaredNorm().maxCoeff(&corners[0]); // from the mean, which is 0
  const Eigen::VectorXd origin = points.col(corners[0]);
  points.colwise() -= origin;
  while (static_cast<int>(corners.size()) < count)
  {
    Eigen::Index next = 0;
    const double square = points.colwise().squaredNorm().maxCoeff(&next);
    corners.push_back(next);
    if (square > 0.0)
    {
      const Eigen::VectorXd axis = points.col(next) / std::sqrt(square);
      const Eigen::RowVectorXd along = axis.transpose() * points;
      points -= axis * along;
    }
  }
  return corners;
}

//------------------------------------------------------------------------------
class Alternation
{
public:
  Alternation(const Eigen::MatrixXf& data, const std::vector<unsigned char>& mask,
    const FactorizationOptions& options)
    : Data(data)
    , Mask(mask)
    , Options(options)
  {
    const std::vector<Eigen::Index> corners = FindCorners(data, options.Materials, options.Seed);
    this->Result.Values.resize(data.rows(), options.Materials);
    for (int k = 0; k < options.Materials; ++k)
    {
      this->Result.Values.col(k) =
        data.col(corners[static_cast<std::size_t>(k)]).cast<double>().cwiseMax(0.0);
    }
    this->Result.Weights = Eigen::MatrixXd::Zero(options.Materials, data.cols());
  }

  Factorization Run()
  {
    this->SolveWeights();
    double before = this->ImputeAndMeasure();
    for (int k = 0; k < this->Options.MostIterations && !this->Result.Converged; ++k)
    {
      if (!this->Options.Proceed(static_cast<double>(k) / this->Options.MostIterations))
      {
        this->Result.Stopped = true;
        return this->Result;
      }
      this->SolveValues();
      this->SolveWeights();
      const double after = this->ImputeAndMeasure();
      this->Result.Iterations = k + 1;
      this->Result.Converged =
        std::abs(before - after) <= this->Options.Tolerance * before + Negligible * this->Squares;
      before = after;
    }
    this->Result.RelativeError = this->Squares > 0.0 ? std::sqrt(before / this->Squares) : 0.0;
    return this->Result;
  }

private:
  // Each row's values, given the weights.
  void SolveValues()
  {
    const int n = this->Options.Materials;
    SmallMatrix matrix = this->Result.Weights * this->Result.Weights.transpose();
    // The quadratic form of the sum over pairs of (v_a - v_b)^2 is n I - 11'.
    const double pairs = std::max(0.5 * n * (n - 1), 1.0);
    const double strength =
      this->Options.Compactness * static_cast<double>(this->Data.cols()) / pairs;
    matrix += strength * (n * SmallMatrix::Identity(n, n) - SmallMatrix::Ones(n, n));
    ForBlocks(this->Data.rows(),
      [&](Eigen::Index first, Eigen::Index count)
      {
        const Eigen::MatrixXd rows = this->Data.middleRows(first, count).transpose().cast<double>();
        const Eigen::MatrixXd right = this->Result.Weights * rows;
        for (Eigen::Index k = 0; k < count; ++k)
        {
          const SmallVector g = right.col(k);
          this->Result.Values.row(first + k) =
            SolveConstrained(matrix, g, UnknownsAre::NonNegative).transpose();
        }
      });
  }

  // Each texel's weights, given the values.
  void SolveWeights()
  {
    const SmallMatrix matrix = this->Result.Values.transpose() * this->Result.Values;
    ForBlocks(this->Data.cols(),
      [&](Eigen::Index first, Eigen::Index count)
      {
        const Eigen::MatrixXd columns = this->Data.middleCols(first, count).cast<double>();
        const Eigen::MatrixXd right = this->Result.Values.transpose() * columns;
        for (Eigen::Index k = 0; k < count; ++k)
        {
          const SmallVector g = right.col(k);
          this->Result.Weights.col(first + k) = SolveConstrained(matrix, g, UnknownsAre::Shares);
        }
      });
  }

  // The sum of squares that is left at valid entries; the others take the model's values.
  double ImputeAndMeasure()
  {
    const auto blocks = static_cast<std::size_t>((this->Data.cols() + Block - 1) / Block);
    std::vector<double> left(blocks, 0.0), all(blocks, 0.0);
    const Eigen::Index photographs = this->Data.rows() / 3;
    ForBlocks(this->Data.cols(),
      [&](Eigen::Index first, Eigen::Index count)
      {
        const auto block = static_cast<std::size_t>(first / Block);
        const Eigen::MatrixXd model =
          this->Result.Values * this->Result.Weights.middleCols(first, count);
        for (Eigen::Index k = 0; k < count; ++k)
        {
          for (Eigen::Index row = 0; row < this->Data.rows(); ++row)
          {
            float& value = this->Data(row, first + k);
            const auto at = static_cast<std::size_t>((first + k) * photographs + row / 3);
            if (!this->Mask.empty() && this->Mask[at] != 0)
            {
              value = static_cast<float>(model(row, k));
              continue;
            }
            const double difference = value - model(row, k);
            left[block] += difference * difference;
            all[block] += static_cast<double>(value) * value;
          }
        }
      });
    double sum = 0.0;
    this->Squares = 0.0;
    for (std::size_t k = 0; k < blocks; ++k)
    {
      sum += left[k];
      this->Squares += all[k];
    }
    return sum;
  }

  Eigen::MatrixXf Data;
  const std::vector<unsigned char>& Mask;
  const FactorizationOptions& Options;
  double Squares = 0.0;
  Factorization Result;
};
}

//------------------------------------------------------------------------------
Factorization Factorize(const Eigen::MatrixXf& data, const std::vector<unsigned char>& mask,
  const FactorizationOptions& options)
{
  return Alternation(data, mask, options).Run();
}
} // namespace measuredbrdf
