// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PhotographFit.h"

#include "HalfVector.h"
#include "Neighbors.h"
#include "ParallelFor.h"
#include "vtkPhotographSet.h"
#include "vtkTabulatedBRDF.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int MostIterations = 200;
constexpr double ConvergedChange = 1e-5; // relative, of the sum of squares
constexpr double Negligible = 1e-9;      // change of the sum of squares, as a share of all squares
// Mixtures alone do not say how far beyond them the pure materials lie; without this, noise drives
// them outward.
constexpr double Compactness = 1e-3;
constexpr int Oversampling = 6;    // columns of the range finder beyond the materials
constexpr Eigen::Index Block = 64; // rows or texels that a thread takes at once

using Flags = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

//------------------------------------------------------------------------------
// function(first, count) for blocks of [0, n); what a block computes does not depend on threads.
template <typename Function>
void ForBlocks(Eigen::Index n, const Function& function)
{
  ParallelForEach((n + Block - 1) / Block,
    [&](Eigen::Index b) { function(b * Block, std::min(Block, n - b * Block)); });
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
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(coordinates.transpose() * coordinates);
  const Eigen::Index kept = std::min<Eigen::Index>(dimensions, columns);
  return (coordinates * eigen.eigenvectors().rightCols(kept)).transpose();
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
/**
 * data, [row, texel] with three rows a photograph, as values times weights. Some are not valid:
 * they say nothing. Alternating constrained least squares (Lawrence et al. 2006, section 4), from
 * the texels that lie farthest apart: the successive projection algorithm (Gillis and Vavasis 2014)
 * in the affine subspace of the largest variance. Entries that are not valid take the model's
 * values in each round.
 *
 * Larger simplices around the data fit them as well, so materials are drawn together: Compactness
 * times the number of texels times the mean squared distance between materials is added to the sum
 * of squares (Berman et al. 2004, "ICE: a statistical approach to identifying endmembers"). The
 * same input and seed give the same bits on any number of threads.
 */
class Alternation
{
public:
  Eigen::MatrixXd Values; // [row, material], >= 0
  double RelativeError = 0.0;
  int Iterations = 0;
  bool Converged = false;

  Alternation(Eigen::MatrixXf& data, const Flags& valid, int materials, unsigned int seed)
    : Data(data)
    , Valid(valid)
    , Materials(materials)
  {
    this->Values.resize(data.rows(), materials);
    this->Weights = Eigen::MatrixXd::Zero(materials, data.cols());
    int k = 0;
    for (const Eigen::Index corner : FindCorners(data, materials, seed))
    {
      this->Values.col(k++) = data.col(corner).cast<double>().cwiseMax(0.0);
    }
  }

  void Run(const std::function<void(double)>& proceed)
  {
    this->SolveWeights();
    double before = this->ImputeAndMeasure();
    while (this->Iterations < MostIterations && !this->Converged)
    {
      proceed(static_cast<double>(this->Iterations++) / MostIterations);
      this->SolveValues();
      this->SolveWeights();
      const double after = this->ImputeAndMeasure();
      this->Converged =
        std::abs(before - after) <= ConvergedChange * before + Negligible * this->Squares;
      before = after;
    }
    this->RelativeError = this->Squares > 0.0 ? std::sqrt(before / this->Squares) : 0.0;
  }

private:
  // Each row's values, given the weights.
  void SolveValues()
  {
    const int n = this->Materials;
    SmallMatrix matrix = this->Weights * this->Weights.transpose();
    // The quadratic form of the sum over pairs of (v_a - v_b)^2 is n I - 11'.
    const double pairs = std::max(0.5 * n * (n - 1), 1.0);
    const double strength = Compactness * static_cast<double>(this->Data.cols()) / pairs;
    matrix += strength * (n * SmallMatrix::Identity(n, n) - SmallMatrix::Ones(n, n));
    ForBlocks(this->Data.rows(),
      [&](Eigen::Index first, Eigen::Index count)
      {
        const Eigen::MatrixXd rows = this->Data.middleRows(first, count).transpose().cast<double>();
        const Eigen::MatrixXd right = this->Weights * rows;
        for (Eigen::Index k = 0; k < count; ++k)
        {
          const SmallVector g = right.col(k);
          this->Values.row(first + k) =
            SolveConstrained(matrix, g, UnknownsAre::NonNegative).transpose();
        }
      });
  }

  // Each texel's weights, given the values.
  void SolveWeights()
  {
    const SmallMatrix matrix = this->Values.transpose() * this->Values;
    ForBlocks(this->Data.cols(),
      [&](Eigen::Index first, Eigen::Index count)
      {
        const Eigen::MatrixXd columns = this->Data.middleCols(first, count).cast<double>();
        const Eigen::MatrixXd right = this->Values.transpose() * columns;
        for (Eigen::Index k = 0; k < count; ++k)
        {
          const SmallVector g = right.col(k);
          this->Weights.col(first + k) = SolveConstrained(matrix, g, UnknownsAre::Shares);
        }
      });
  }

  // The sum of squares that is left at valid entries; the others take the model's values.
  double ImputeAndMeasure()
  {
    Eigen::Array2Xd sums = Eigen::Array2Xd::Zero(2, (this->Data.cols() + Block - 1) / Block);
    ForBlocks(this->Data.cols(),
      [&](Eigen::Index first, Eigen::Index count)
      {
        auto data = this->Data.middleCols(first, count).array();
        const auto valid = this->Valid.middleCols(first, count);
        const Eigen::ArrayXXd model =
          (this->Values * this->Weights.middleCols(first, count)).array();
        const Eigen::ArrayXXd left = valid.select(data.cast<double>() - model, 0.0);
        const Eigen::ArrayXXd all = valid.select(data.cast<double>(), 0.0);
        sums.col(first / Block) << left.square().sum(), all.square().sum();
        const Eigen::ArrayXXf imputed = valid.select(data, model.cast<float>());
        data = imputed;
      });
    this->Squares = sums.row(1).sum();
    return sums.row(0).sum();
  }

  Eigen::MatrixXf& Data; // entries that are not valid become the model's
  const Flags& Valid;
  int Materials;
  double Squares = 0.0;
  Eigen::MatrixXd Weights; // [material, texel], >= 0, sums of 1
};

constexpr int Refinements = 6;

// Strengths of the second differences along phi_d, theta_d and theta_h: f depends most on theta_h.
constexpr double Strengths[3] = { 1.0, 1.0, 0.05 };
// Of first differences: where nothing is seen, f is drawn towards a constant, not along a line.
constexpr double Flatness = 2e-3;
// phi_d says little where theta_h or theta_d is small: its differences count more there.
constexpr double MostAzimuthal = 100.0;

//------------------------------------------------------------------------------
// Of a cell's center. The logarithm of a Gaussian lobe about the normal is linear in it: what lies
// between two polar angles that are seen is drawn towards such a lobe.
double SquareOfThetaH(int cell, int n)
{
  return std::pow(0.5 * Pi, 2) * std::pow((cell + 0.5) / n, 4);
}

/// A pair of directions at which values are known, and how much they count.
struct TablePoint
{
  double I[3];
  double O[3];
  double Weight;
};

/**
 * Tables of vtkTabulatedBRDF's form HALF_DIFFERENCE and HALF_TURN, mirror-symmetric in phi_d. In
 * the logarithm, which keeps values positive and lobes smooth, a table minimizes the weighted
 * squared differences at the points plus squared second differences along the axes. One sparse
 * Cholesky factorization (Eigen) serves for all tables. A table's values between its cells are
 * interpolated as vtkTabulatedBRDF does, which is linear in the value, not in its logarithm: the
 * differences that this leaves are smoothed and added again, some times over (iterated Tikhonov
 * regularization, King and Chillingworth 1979).
 */
class TableCompletion
{
public:
  /// Cells along phi_d, theta_d and theta_h. smoothness > 0: weight of the second differences.
  TableCompletion(
    const std::vector<TablePoint>& points, const std::array<int, 3>& dimensions, double smoothness)
    : Dimensions(dimensions)
    , Weights(2 * static_cast<Eigen::Index>(points.size()))
  {
    Triplets entries;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      this->AddPoint(points[k], 2 * static_cast<int>(k), entries);
      this->Weights.segment<2>(2 * static_cast<Eigen::Index>(k)).setConstant(points[k].Weight);
    }
    const double mean = this->Weights.mean();
    this->Weights /= mean > 0.0 ? mean : 1.0;
    this->Interpolation.resize(this->Weights.size(), dimensions[0] * dimensions[1] * dimensions[2]);
    this->Interpolation.setFromTriplets(entries.begin(), entries.end());
    const Matrix weighted = this->Weights.asDiagonal() * this->Interpolation;
    this->Gram = this->Interpolation.transpose() * weighted;
    const Matrix system = this->Gram + smoothness * this->MakeRoughness();
    this->Solver.compute(system);
    if (this->Solver.info() != Eigen::Success)
    {
      throw std::runtime_error("the tables' equations have no solution");
    }
  }

  /**
   * The cells' values, phi_d fastest, from the points' values >= 0. All lie between the least and
   * the largest of these.
   */
  Eigen::VectorXd Complete(const std::vector<double>& values) const
  {
    const double largest = *std::max_element(values.begin(), values.end());
    const double floor = std::max(1e-6 * largest, 1e-9);
    Eigen::VectorXd target(this->Interpolation.rows());
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      target.segment<2>(2 * static_cast<Eigen::Index>(k))
        .setConstant(std::log(std::max(values[k], floor)));
    }
    const double least = target.minCoeff(), most = target.maxCoeff(), mean = target.mean();
    const auto smooth = [this](const Eigen::VectorXd& differences) -> Eigen::VectorXd
    {
      const Eigen::VectorXd weighted = this->Weights.cwiseProduct(differences);
      const Eigen::VectorXd right = this->Interpolation.transpose() * weighted;
      return this->Solver.solve(right);
    };
    Eigen::VectorXd cells = Eigen::VectorXd::Constant(this->Interpolation.cols(), mean);
    cells += smooth((target.array() - mean).matrix());
    for (int k = 0; k < Refinements; ++k)
    {
      cells = cells.cwiseMax(least).cwiseMin(most);
      const Eigen::VectorXd exponentials = cells.array().exp().matrix();
      const Eigen::VectorXd model = this->Interpolation * exponentials;
      cells += smooth(target - model.array().log().matrix());
    }
    return cells.cwiseMax(least).cwiseMin(most).array().exp().matrix();
  }

  /// Share of the cells above the horizon that some point touches.
  double GetSeenShare() const
  {
    int above = 0, seen = 0;
    const int nx = this->Dimensions[0], ny = this->Dimensions[1];
    for (int cell = 0; cell < nx * ny * this->Dimensions[2]; ++cell)
    {
      double i[3], o[3];
      const bool counts = vtkTabulatedBRDF::GetCellDirections(vtkTabulatedBRDF::HALF_DIFFERENCE,
        vtkTabulatedBRDF::HALF_TURN, this->Dimensions.data(), cell % nx, cell / nx % ny,
        cell / (nx * ny), i, o);
      above += counts ? 1 : 0;
      seen += counts && this->Gram.coeff(cell, cell) > 0.0 ? 1 : 0;
    }
    return above > 0 ? static_cast<double>(seen) / above : 0.0;
  }

private:
  using Matrix = Eigen::SparseMatrix<double>;
  using Triplets = std::vector<Eigen::Triplet<double>>;

  // The point and its mirror image.
  void AddPoint(const TablePoint& point, int row, Triplets& entries) const
  {
    const auto [nx, ny, nz] = this->Dimensions;
    const HalfDifference angles =
      ToHalfDifference(glm::make_vec3(point.I), glm::make_vec3(point.O));
    const Neighbors y = ClampedNeighbors(angles.ThetaD * (2.0 / Pi), ny);
    const Neighbors z = ClampedNeighbors(ThetaHToUnit(angles.ThetaH), nz);
    for (int mirror = 0; mirror < 2; ++mirror)
    {
      const Neighbors x = PeriodicNeighbors((mirror == 0 ? 1.0 : -1.0) * angles.PhiD / Pi, nx);
      for (int corner = 0; corner < 8; ++corner)
      {
        const bool a = (corner & 1) != 0, b = (corner & 2) != 0, c = (corner & 4) != 0;
        const double weight = (a ? x.Weight : 1.0 - x.Weight) * (b ? y.Weight : 1.0 - y.Weight) *
                              (c ? z.Weight : 1.0 - z.Weight);
        const int cell = (a ? x.Second : x.First) +
                         nx * ((b ? y.Second : y.First) + ny * (c ? z.Second : z.First));
        if (weight > 0.0)
        {
          entries.emplace_back(row + mirror, cell, weight);
        }
      }
    }
  }

  // The quadratic form of all first and second differences.
  Matrix MakeRoughness() const
  {
    const auto [nx, ny, nz] = this->Dimensions;
    Triplets entries;
    // The square of a sum of cells' values times factors.
    const auto add = [&entries](const std::vector<std::pair<int, double>>& cells, double strength)
    {
      for (const auto& [a, first] : cells)
      {
        for (const auto& [b, second] : cells)
        {
          entries.emplace_back(a, b, strength * first * second);
        }
      }
    };
    for (int here = 0; here < nx * ny * nz; ++here)
    {
      const int x = here % nx, y = here / nx % ny, z = here / (nx * ny);
      const double sines =
        std::sin(std::sqrt(SquareOfThetaH(z, nz))) * std::sin(0.5 * Pi * (y + 0.5) / ny);
      const double azimuthal = std::min(1.0 / (sines * sines), MostAzimuthal);
      const int next = here - x + (x + 1) % nx, second = here - x + (x + 2) % nx;
      add({ { here, 1.0 }, { next, -1.0 } }, Flatness * azimuthal);
      add({ { here, 1.0 }, { next, -2.0 }, { second, 1.0 } }, Strengths[0] * azimuthal);
      if (y + 1 < ny)
      {
        add({ { here, 1.0 }, { here + nx, -1.0 } }, Flatness);
      }
      if (y + 2 < ny)
      {
        add({ { here, 1.0 }, { here + nx, -2.0 }, { here + 2 * nx, 1.0 } }, Strengths[1]);
      }
      if (z + 1 < nz)
      {
        add({ { here, 1.0 }, { here + nx * ny, -1.0 } }, Flatness);
      }
      if (z + 2 < nz)
      {
        // The middle one lies at a share of the way between the others.
        const double share = (SquareOfThetaH(z + 1, nz) - SquareOfThetaH(z, nz)) /
                             (SquareOfThetaH(z + 2, nz) - SquareOfThetaH(z, nz));
        add({ { here, 2.0 * (1.0 - share) }, { here + nx * ny, -2.0 },
              { here + 2 * nx * ny, 2.0 * share } },
          Strengths[2]);
      }
    }
    Matrix roughness(nx * ny * nz, nx * ny * nz);
    roughness.setFromTriplets(entries.begin(), entries.end());
    return roughness;
  }

  std::array<int, 3> Dimensions;
  Matrix Interpolation;    // two rows for each point: it and its mirror image
  Eigen::VectorXd Weights; // of the rows
  Matrix Gram;
  Eigen::SimplicialLDLT<Matrix> Solver;
};

// means: of the valid pixels of each photograph, linear; -1: none.
void MakeTables(vtkPhotographSet* photographs, const TableOptions& options,
  const std::vector<double>& means, const Eigen::MatrixXd& factors, TableMaterials& found)
{
  std::vector<TablePoint> points;
  std::vector<int> seen; // the points' photographs
  for (std::size_t k = 0; k < means.size(); ++k)
  {
    if (means[k] >= 0.0)
    {
      seen.push_back(static_cast<int>(k));
      TablePoint point;
      photographs->GetLight(seen.back(), point.I);
      photographs->GetView(seen.back(), point.O);
      // A logarithm's error is that of the value over the value.
      point.Weight = std::max(std::pow(means[k] / found.Scales[k], 2), 1e-6);
      points.push_back(point);
    }
  }
  const TableCompletion completion(points, options.Dimensions, options.Smoothness);
  found.SeenShare = completion.GetSeenShare();
  for (Eigen::Index m = 0; m < factors.cols(); ++m)
  {
    std::vector<float> volume;
    for (int c = 0; c < 3; ++c)
    {
      std::vector<double> values;
      for (const int k : seen)
      {
        values.push_back(factors(3 * k + c, m) * found.Scales[static_cast<std::size_t>(k)] /
                         photographs->GetScale(k));
      }
      const Eigen::VectorXd cells = completion.Complete(values);
      volume.resize(3 * static_cast<std::size_t>(cells.size()));
      for (Eigen::Index cell = 0; cell < cells.size(); ++cell)
      {
        volume[static_cast<std::size_t>(3 * cell + c)] = static_cast<float>(cells[cell]);
      }
    }
    const auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
    if (!table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN,
          options.Dimensions.data(), std::move(volume)))
    {
      throw std::runtime_error("a table was refused");
    }
    const std::string name = "material " + std::to_string(m + 1);
    table->SetName(name);
    table->SetSource("found in " + std::to_string(seen.size()) + " photographs");
    found.Materials.emplace_back(table, name);
  }
}
}

//------------------------------------------------------------------------------
TableMaterials FindTableMaterials(vtkPhotographSet* photographs, const TableOptions& options,
  PhotographPasses& passes, const std::vector<std::size_t>& sample)
{
  const auto count = static_cast<std::size_t>(photographs->GetNumberOfPhotographs());
  Eigen::MatrixXf data(3 * count, sample.size()); // [3 photograph + channel, texel]
  Flags valid(3 * count, sample.size());
  std::vector<double> means(count, -1.0);
  TableMaterials found;
  found.Scales.assign(count, NoiseFloor);
  const auto add = [&](int photograph, const PhotographPixels& pixels)
  {
    auto rows = data.middleRows<3>(3 * photograph);
    auto flags = valid.middleRows<3>(3 * photograph);
    Eigen::Index k = 0;
    for (const std::size_t texel : sample)
    {
      flags.col(k).setConstant(pixels.States[texel] == PixelState::Valid);
      rows.col(k++) = Eigen::Map<const Eigen::Vector3f>(&pixels.Values[3 * texel]);
    }
    if (flags.any())
    {
      // Values that are not valid are 0. The photograph's mean is the first guess for them.
      const double mean = rows.cast<double>().sum() / static_cast<double>(flags.count());
      means[static_cast<std::size_t>(photograph)] = std::max(mean, 0.0);
      found.Scales[static_cast<std::size_t>(photograph)] += std::max(mean, 0.0);
      const Eigen::Array3Xf guessed =
        flags.select(rows.array(), static_cast<float>(std::max(mean, 0.0)));
      rows = guessed.matrix();
    }
  };
  passes.Run(0.0, 0.3, add);
  if (*std::max_element(means.begin(), means.end()) < 0.0)
  {
    throw std::runtime_error("no pixel is valid: all are saturated, black or not finite");
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    data.middleRows<3>(3 * static_cast<Eigen::Index>(k)) /= static_cast<float>(found.Scales[k]);
  }
  Alternation factors(data, valid, options.Materials, options.Seed);
  factors.Run([&](double share) { passes.Proceed(0.3 + 0.3 * share); });
  found.FactorError = factors.RelativeError;
  found.Iterations = factors.Iterations;
  found.Converged = factors.Converged;
  MakeTables(photographs, options, means, factors.Values, found);
  return found;
}
} // namespace measuredbrdf
