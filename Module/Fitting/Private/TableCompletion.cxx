// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableCompletion.h"

#include "HalfVector.h"
#include "vtkTabulatedBRDF.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
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
}

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
  this->Failed = this->Solver.info() != Eigen::Success;
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
} // namespace measuredbrdf
