// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableMaterials.h"

#include "HalfVector.h"
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
#include <random>
#include <string>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int MostIterations = 200;
constexpr double ConvergedChange = 1e-5; // relative, of the sum of squares
constexpr double Negligible = 1e-9;      // change of the sum of squares, as a share of all squares
constexpr int Oversampling = 6;          // columns of the range finder beyond the materials
constexpr Eigen::Index Block = 64;       // rows or texels that a thread takes at once

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
struct Factorization
{
  Eigen::MatrixXd Values;  // [row, material], >= 0
  Eigen::MatrixXd Weights; // [material, texel], >= 0, sums of 1
  double RelativeError = 0.0;
  int Iterations = 0;
  bool Converged = false;
};

/**
 * data, [row, texel] with three rows a photograph, as values times weights. mask is not 0 where
 * data say nothing: [texel][photograph]. Alternating constrained least squares (Lawrence et al.
 * 2006, section 4), from the texels that lie farthest apart: the successive projection algorithm
 * (Gillis and Vavasis 2014) in the affine subspace of the largest variance. Masked entries take the
 * model's values in each round.
 *
 * Larger simplices around the data fit them as well, so materials are drawn together: compactness
 * times the number of texels times the mean squared distance between materials is added to the sum
 * of squares (Berman et al. 2004, "ICE: a statistical approach to identifying endmembers"). The
 * same input and seed give the same bits on any number of threads.
 */
class Alternation
{
public:
  Alternation(Eigen::MatrixXf& data, const std::vector<unsigned char>& mask, int materials,
    double compactness, unsigned int seed)
    : Data(data)
    , Mask(mask)
    , Materials(materials)
    , Compactness(compactness)
  {
    this->Result.Values.resize(data.rows(), materials);
    this->Result.Weights = Eigen::MatrixXd::Zero(materials, data.cols());
    int k = 0;
    for (const Eigen::Index corner : FindCorners(data, materials, seed))
    {
      this->Result.Values.col(k++) = data.col(corner).cast<double>().cwiseMax(0.0);
    }
  }

  Factorization Run(const std::function<void(double)>& proceed)
  {
    this->SolveWeights();
    double before = this->ImputeAndMeasure();
    for (int k = 0; k < MostIterations && !this->Result.Converged; ++k)
    {
      proceed(static_cast<double>(k) / MostIterations);
      this->SolveValues();
      this->SolveWeights();
      const double after = this->ImputeAndMeasure();
      this->Result.Iterations = k + 1;
      this->Result.Converged =
        std::abs(before - after) <= ConvergedChange * before + Negligible * this->Squares;
      before = after;
    }
    this->Result.RelativeError = this->Squares > 0.0 ? std::sqrt(before / this->Squares) : 0.0;
    return this->Result;
  }

private:
  // Each row's values, given the weights.
  void SolveValues()
  {
    const int n = this->Materials;
    SmallMatrix matrix = this->Result.Weights * this->Result.Weights.transpose();
    // The quadratic form of the sum over pairs of (v_a - v_b)^2 is n I - 11'.
    const double pairs = std::max(0.5 * n * (n - 1), 1.0);
    const double strength = this->Compactness * static_cast<double>(this->Data.cols()) / pairs;
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
            if (this->Mask[at] != 0)
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

  Eigen::MatrixXf& Data; // masked entries become the model's
  const std::vector<unsigned char>& Mask;
  int Materials;
  double Compactness;
  double Squares = 0.0;
  Factorization Result;
};

constexpr int Refinements = 6;

// Strengths of the second differences along phi_d, theta_d and theta_h: f depends most on theta_h.
constexpr double Strengths[3] = { 1.0, 1.0, 0.05 };
// Of first differences: where nothing is seen, f is drawn towards a constant, not along a line.
constexpr double Flatness = 2e-3;
// phi_d says little where theta_h or theta_d is small: its differences count more there.
constexpr double MostAzimuthal = 100.0;

//------------------------------------------------------------------------------
// Two neighbors on an axis of n cells, as vtkTabulatedBRDF has them.
struct CellPair
{
  int Index[2];
  double Weight[2];
};

CellPair FindCells(double unit, int n, bool periodic)
{
  const double x = periodic ? unit * n - 0.5 : std::clamp(unit * n - 0.5, 0.0, n - 1.0);
  const double base = std::floor(x);
  const int first = static_cast<int>(base);
  const auto wrap = [n, periodic](int k)
  { return periodic ? (k % n + n) % n : std::min(k, n - 1); };
  return { { wrap(first), wrap(first + 1) }, { 1.0 - (x - base), x - base } };
}

//------------------------------------------------------------------------------
// Of a cell's center. The logarithm of a Gaussian lobe about the normal is linear in it: what lies
// between two polar angles that are seen is drawn towards such a lobe.
double SquareOfThetaH(int cell, int n)
{
  return std::pow(0.5 * Pi, 2) * std::pow((cell + 0.5) / n, 4);
}

//------------------------------------------------------------------------------
// The square of a difference of neighboring cells.
class Differences
{
public:
  explicit Differences(std::size_t cells) { this->Entries.reserve(40 * cells); }

  void AddFirst(int a, int b, double strength) { this->Add({ a, b }, { 1.0, -1.0 }, strength); }
  // b lies at a share of the way from a to c.
  void AddSecond(int a, int b, int c, double share, double strength)
  {
    this->Add({ a, b, c }, { 2.0 * (1.0 - share), -2.0, 2.0 * share }, strength);
  }

  std::vector<Eigen::Triplet<double>> Entries;

private:
  void Add(std::initializer_list<int> cells, std::initializer_list<double> factors, double strength)
  {
    for (std::size_t a = 0; a < cells.size(); ++a)
    {
      for (std::size_t b = 0; b < cells.size(); ++b)
      {
        this->Entries.emplace_back(
          cells.begin()[a], cells.begin()[b], strength * factors.begin()[a] * factors.begin()[b]);
      }
    }
  }
};

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
    const std::vector<TablePoint>& points, const std::array<int, 3>& dimensions, double smoothness);

  /**
   * The cells' values, phi_d fastest, from the points' values >= 0. All lie between the least and
   * the largest of these.
   */
  std::vector<double> Complete(const std::vector<double>& values) const;

  /// Share of the cells above the horizon that some point touches.
  double GetSeenShare() const { return this->SeenShare; }

private:
  using Matrix = Eigen::SparseMatrix<double>;
  void AddPoint(
    const TablePoint& point, int row, std::vector<Eigen::Triplet<double>>& entries) const;
  Matrix MakeRoughness() const;
  double FindSeenShare(const Matrix& gram) const;

  std::array<int, 3> Dimensions;
  Matrix Interpolation;    // two rows for each point: it and its mirror image
  Eigen::VectorXd Weights; // of the rows
  Eigen::SimplicialLDLT<Matrix> Solver;
  double SeenShare = 0.0;
};
//------------------------------------------------------------------------------
TableCompletion::TableCompletion(
  const std::vector<TablePoint>& points, const std::array<int, 3>& dimensions, double smoothness)
  : Dimensions(dimensions)
{
  std::vector<Eigen::Triplet<double>> entries;
  this->Weights.resize(2 * static_cast<Eigen::Index>(points.size()));
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
  const Matrix gram = this->Interpolation.transpose() * weighted;
  this->SeenShare = this->FindSeenShare(gram);
  const Matrix system = gram + smoothness * this->MakeRoughness();
  this->Solver.compute(system);
  if (this->Solver.info() != Eigen::Success)
  {
    throw MapFitError("the tables' equations have no solution");
  }
}

//------------------------------------------------------------------------------
void TableCompletion::AddPoint(
  const TablePoint& point, int row, std::vector<Eigen::Triplet<double>>& entries) const
{
  const HalfDifference angles = ToHalfDifference(glm::make_vec3(point.I), glm::make_vec3(point.O));
  const CellPair y = FindCells(angles.ThetaD * (2.0 / Pi), this->Dimensions[1], false);
  const CellPair z = FindCells(ThetaHToUnit(angles.ThetaH), this->Dimensions[2], false);
  for (int mirror = 0; mirror < 2; ++mirror)
  {
    const double phi = mirror == 0 ? angles.PhiD : -angles.PhiD;
    const CellPair x = FindCells(phi / Pi, this->Dimensions[0], true);
    for (int corner = 0; corner < 8; ++corner)
    {
      const int a = corner & 1, b = (corner >> 1) & 1, c = corner >> 2;
      const double weight = x.Weight[a] * y.Weight[b] * z.Weight[c];
      if (weight > 0.0)
      {
        const int cell =
          x.Index[a] + this->Dimensions[0] * (y.Index[b] + this->Dimensions[1] * z.Index[c]);
        entries.emplace_back(row + mirror, cell, weight);
      }
    }
  }
}

//------------------------------------------------------------------------------
TableCompletion::Matrix TableCompletion::MakeRoughness() const
{
  const int nx = this->Dimensions[0], ny = this->Dimensions[1], nz = this->Dimensions[2];
  const auto size = static_cast<std::size_t>(nx * ny * nz);
  Differences differences(size);
  for (int z = 0; z < nz; ++z)
  {
    const double thetaH = std::sqrt(SquareOfThetaH(z, nz));
    for (int y = 0; y < ny; ++y)
    {
      const double sines = std::sin(thetaH) * std::sin(0.5 * Pi * (y + 0.5) / ny);
      const double azimuthal = std::min(1.0 / (sines * sines), MostAzimuthal);
      for (int x = 0; x < nx; ++x)
      {
        const auto cell = [&](int dx, int dy, int dz)
        { return (x + dx) % nx + nx * (y + dy + ny * (z + dz)); };
        const int here = cell(0, 0, 0);
        differences.AddFirst(here, cell(1, 0, 0), Flatness * azimuthal);
        differences.AddSecond(here, cell(1, 0, 0), cell(2, 0, 0), 0.5, Strengths[0] * azimuthal);
        if (y + 1 < ny)
        {
          differences.AddFirst(here, cell(0, 1, 0), Flatness);
        }
        if (y + 2 < ny)
        {
          differences.AddSecond(here, cell(0, 1, 0), cell(0, 2, 0), 0.5, Strengths[1]);
        }
        if (z + 1 < nz)
        {
          differences.AddFirst(here, cell(0, 0, 1), Flatness);
        }
        if (z + 2 < nz)
        {
          const double share = (SquareOfThetaH(z + 1, nz) - SquareOfThetaH(z, nz)) /
                               (SquareOfThetaH(z + 2, nz) - SquareOfThetaH(z, nz));
          differences.AddSecond(here, cell(0, 0, 1), cell(0, 0, 2), share, Strengths[2]);
        }
      }
    }
  }
  Matrix roughness(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  roughness.setFromTriplets(differences.Entries.begin(), differences.Entries.end());
  return roughness;
}

//------------------------------------------------------------------------------
double TableCompletion::FindSeenShare(const Matrix& gram) const
{
  int above = 0, seen = 0, cell = 0;
  for (int z = 0; z < this->Dimensions[2]; ++z)
  {
    for (int y = 0; y < this->Dimensions[1]; ++y)
    {
      for (int x = 0; x < this->Dimensions[0]; ++x, ++cell)
      {
        double i[3], o[3];
        const bool counts = vtkTabulatedBRDF::GetCellDirections(vtkTabulatedBRDF::HALF_DIFFERENCE,
          vtkTabulatedBRDF::HALF_TURN, this->Dimensions.data(), x, y, z, i, o);
        above += counts ? 1 : 0;
        seen += counts && gram.coeff(cell, cell) > 0.0 ? 1 : 0;
      }
    }
  }
  return above > 0 ? static_cast<double>(seen) / above : 0.0;
}

//------------------------------------------------------------------------------
std::vector<double> TableCompletion::Complete(const std::vector<double>& values) const
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
  const Eigen::VectorXd result = cells.cwiseMax(least).cwiseMin(most).array().exp().matrix();
  return std::vector<double>(result.data(), result.data() + result.size());
}
}

//------------------------------------------------------------------------------
TableMaterials::TableMaterials(
  vtkPhotographSet* photographs, const TableOptions& options, std::size_t sampleSize)
  : Photographs(photographs)
  , Options(options)
  , Means(static_cast<std::size_t>(photographs->GetNumberOfPhotographs()), -1.0)
{
  const std::size_t count = this->Means.size();
  this->Data.resize(static_cast<Eigen::Index>(3 * count), static_cast<Eigen::Index>(sampleSize));
  this->Mask.assign(sampleSize * count, 0);
  this->Scales.assign(count, NoiseFloor);
}

//------------------------------------------------------------------------------
void TableMaterials::Add(
  int photograph, const PhotographPixels& pixels, const std::vector<std::size_t>& sample)
{
  const auto number = static_cast<std::size_t>(photograph);
  double sum = 0.0;
  std::size_t valid = 0;
  for (std::size_t k = 0; k < sample.size(); ++k)
  {
    const float* value = &pixels.Values[3 * sample[k]];
    const bool isValid = pixels.States[sample[k]] == PixelState::Valid;
    this->Mask[k * this->Means.size() + number] = isValid ? 0 : 1;
    valid += isValid ? 1 : 0;
    for (int c = 0; c < 3; ++c)
    {
      this->Data(3 * photograph + c, static_cast<Eigen::Index>(k)) = value[c];
      sum += value[c];
    }
  }
  if (valid > 0)
  {
    this->Means[number] = std::max(sum / (3.0 * static_cast<double>(valid)), 0.0);
    this->Scales[number] = this->Means[number] + NoiseFloor;
    // Where data say nothing, the photograph's mean is the first guess.
    for (std::size_t k = 0; k < sample.size(); ++k)
    {
      if (this->Mask[k * this->Means.size() + number] != 0)
      {
        this->Data.block<3, 1>(3 * photograph, static_cast<Eigen::Index>(k))
          .setConstant(static_cast<float>(this->Means[number]));
      }
    }
  }
}

//------------------------------------------------------------------------------
void TableMaterials::Find(const std::function<void(double)>& proceed)
{
  if (std::all_of(this->Means.begin(), this->Means.end(), [](double mean) { return mean < 0.0; }))
  {
    throw MapFitError("no pixel is valid: all are saturated, black or not finite");
  }
  for (std::size_t k = 0; k < this->Scales.size(); ++k)
  {
    this->Data.middleRows<3>(3 * static_cast<Eigen::Index>(k)) /=
      static_cast<float>(this->Scales[k]);
  }
  const Factorization factors = Alternation(
    this->Data, this->Mask, this->Options.Materials, this->Options.Compactness, this->Options.Seed)
                                  .Run(proceed);
  this->FactorError = factors.RelativeError;
  this->Iterations = factors.Iterations;
  this->Converged = factors.Converged;
  this->MakeTables(factors.Values);
}

//------------------------------------------------------------------------------
void TableMaterials::MakeTables(const Eigen::MatrixXd& factors)
{
  std::vector<TablePoint> points;
  std::vector<int> seen; // the points' photographs
  for (std::size_t k = 0; k < this->Means.size(); ++k)
  {
    if (this->Means[k] >= 0.0)
    {
      seen.push_back(static_cast<int>(k));
      TablePoint point;
      this->Photographs->GetLight(seen.back(), point.I);
      this->Photographs->GetView(seen.back(), point.O);
      // A logarithm's error is that of the value over the value.
      point.Weight = std::max(std::pow(this->Means[k] / this->Scales[k], 2), 1e-6);
      points.push_back(point);
    }
  }
  const std::array<int, 3>& dimensions = this->Options.Dimensions;
  const TableCompletion completion(points, dimensions, this->Options.Smoothness);
  this->SeenShare = completion.GetSeenShare();
  for (Eigen::Index m = 0; m < factors.cols(); ++m)
  {
    std::vector<float> volume;
    for (int c = 0; c < 3; ++c)
    {
      std::vector<double> values;
      for (const int k : seen)
      {
        values.push_back(factors(3 * k + c, m) * this->Scales[static_cast<std::size_t>(k)] /
                         this->Photographs->GetScale(k));
      }
      const std::vector<double> cells = completion.Complete(values);
      volume.resize(3 * cells.size());
      for (std::size_t cell = 0; cell < cells.size(); ++cell)
      {
        volume[3 * cell + static_cast<std::size_t>(c)] = static_cast<float>(cells[cell]);
      }
    }
    const auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
    if (!table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN,
          dimensions.data(), std::move(volume)))
    {
      throw MapFitError("a table was refused");
    }
    const std::string name = "material " + std::to_string(m + 1);
    table->SetName(name);
    table->SetSource("found in " + std::to_string(seen.size()) + " photographs");
    this->Materials.emplace_back(table, name);
  }
}
} // namespace measuredbrdf
