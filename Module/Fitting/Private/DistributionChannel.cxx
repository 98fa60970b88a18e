// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DistributionChannel.h"

#include "NonNegativeLeastSquares.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// The changes of neighboring cells are tied by this share of what the data say about the better
// known of them: cells that no sample touches move with their neighbors, and where the data are
// fitted nothing moves.
constexpr double Tie = 1e-3;

double FresnelAt(const DistributionGeometry::Place& place, const Eigen::VectorXd& f)
{
  return (1.0 - place.D.Weight) * f[place.D.First] + place.D.Weight * f[place.D.Second];
}
}

//------------------------------------------------------------------------------
DistributionChannel::DistributionChannel(const FitSamples& samples,
  const DistributionGeometry& geometry, const Eigen::MatrixXd& basis, bool tieFresnel, int channel)
  : Samples(samples)
  , Geometry(geometry)
  , Basis(basis)
  , TieFresnel(tieFresnel)
  , Index(channel)
{
}

//------------------------------------------------------------------------------
void DistributionChannel::Sweep()
{
  this->SolveDistribution();
  this->SolveFresnel();
}

//------------------------------------------------------------------------------
double DistributionChannel::DistributionAt(
  const DistributionGeometry::Place& place, const Eigen::VectorXd& p) const
{
  double value = 0.0;
  for (int k = 0; k < this->Geometry.GetNumberOfNeighbors(); ++k)
  {
    value += place.Weights[k] * p[place.Unknowns[k]];
  }
  return value;
}

//------------------------------------------------------------------------------
double DistributionChannel::MeanSquare(const DistributionTables& tables) const
{
  const FitLoss& loss = this->Samples.GetLoss();
  double sum = 0.0;
  for (std::size_t k = 0; k < this->Samples.size(); ++k)
  {
    const FitSample& sample = this->Samples[k];
    const DistributionGeometry::Place& place = this->Geometry.GetPlace(k);
    const double f = tables.Lambert + this->DistributionAt(place, tables.P) *
                                        FresnelAt(place, tables.F) * place.Scale;
    const double t = loss.Value(f, sample.I.z) - loss.Value(sample.F[this->Index], sample.I.z);
    sum += sample.Weight * t * t / 3.0;
  }
  return sum;
}

//------------------------------------------------------------------------------
// Weight and right-hand side of the linearized least squares at a sample.
void DistributionChannel::Linearize(
  const FitSample& sample, double f, double& weight, double& target) const
{
  const FitLoss& loss = this->Samples.GetLoss();
  const double slope = loss.Slope(f, sample.I.z);
  const double t = loss.Value(sample.F[this->Index], sample.I.z) - loss.Value(f, sample.I.z);
  weight = sample.Weight * slope * slope;
  target = f + t / slope;
}

//------------------------------------------------------------------------------
void DistributionChannel::SolveDistribution()
{
  const int n = this->Geometry.GetNumberOfNeighbors();
  const int cells = this->Geometry.GetNumberOfCells();
  const DistributionTables& now = this->Tables;
  Eigen::SparseMatrix<double> H = this->Geometry.GetPattern();
  Eigen::VectorXd g = Eigen::VectorXd::Zero(cells + 1);
  for (std::size_t k = 0; k < this->Samples.size(); ++k)
  {
    const DistributionGeometry::Place& place = this->Geometry.GetPlace(k);
    const double factor = FresnelAt(place, now.F) * place.Scale;
    double weight, target;
    this->Linearize(
      this->Samples[k], now.Lambert + this->DistributionAt(place, now.P) * factor, weight, target);
    double row[5];
    for (int a = 0; a <= n; ++a)
    {
      row[a] = a < n ? factor * place.Weights[a] : 1.0;
      g[place.Unknowns[a]] += weight * target * row[a];
    }
    const int* position = this->Geometry.GetPositions(k);
    for (int a = 0; a <= n; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        H.valuePtr()[*position++] += weight * row[a] * row[b];
      }
    }
  }
  const Eigen::VectorXd known = H.diagonal();
  const double least = 1e-12 * known.mean();
  for (const auto& tie : this->Geometry.GetTies())
  {
    const double strength = Tie * std::max({ known[tie[0]], known[tie[1]], least });
    const double pull = strength * (now.P[tie[0]] - now.P[tie[1]]);
    H.coeffRef(tie[0], tie[0]) += strength;
    H.coeffRef(tie[1], tie[1]) += strength;
    H.coeffRef(tie[0], tie[1]) -= strength;
    g[tie[0]] += pull;
    g[tie[1]] -= pull;
  }
  Eigen::VectorXd x(cells + 1);
  x << now.P, now.Lambert;
  SolveNonNegative(H, g, x);
  this->Search({ x.head(cells), now.F, x[cells] });
}

//------------------------------------------------------------------------------
void DistributionChannel::SolveFresnel()
{
  const Eigen::Index n = this->Basis.rows();
  const Eigen::Index columns = this->Basis.cols();
  const DistributionTables& now = this->Tables;
  // Over the table's samples first (and the Lambert part last), then over the basis.
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + 1, n + 1);
  Eigen::VectorXd m = Eigen::VectorXd::Zero(n + 1);
  for (std::size_t k = 0; k < this->Samples.size(); ++k)
  {
    const DistributionGeometry::Place& place = this->Geometry.GetPlace(k);
    const double factor = this->DistributionAt(place, now.P) * place.Scale;
    double weight, target;
    this->Linearize(
      this->Samples[k], now.Lambert + FresnelAt(place, now.F) * factor, weight, target);
    const Eigen::Index unknowns[3] = { place.D.First, place.D.Second, n };
    const double row[3] = { factor * (1.0 - place.D.Weight), factor * place.D.Weight, 1.0 };
    for (int a = 0; a < 3; ++a)
    {
      m[unknowns[a]] += weight * target * row[a];
      for (int b = 0; b < 3; ++b)
      {
        M(unknowns[a], unknowns[b]) += weight * row[a] * row[b];
      }
    }
  }
  const Eigen::VectorXd known = M.diagonal();
  const double least = 1e-12 * known.head(n).mean();
  for (Eigen::Index k = 0; this->TieFresnel && k + 1 < n; ++k)
  {
    const double strength = Tie * std::max({ known[k], known[k + 1], least });
    const double pull = strength * (now.F[k] - now.F[k + 1]);
    M(k, k) += strength;
    M(k + 1, k + 1) += strength;
    M(k, k + 1) -= strength;
    M(k + 1, k) -= strength;
    m[k] += pull;
    m[k + 1] -= pull;
  }
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n + 1, columns + 1);
  B.topLeftCorner(n, columns) = this->Basis;
  B(n, columns) = 1.0;
  const Eigen::MatrixXd H = B.transpose() * M * B;
  Eigen::VectorXd x = Eigen::VectorXd::Ones(columns + 1);
  SolveNonNegative(H.sparseView(), B.transpose() * m, x);
  this->Search({ now.P, this->Basis * x.head(columns), x[columns] });
}

//------------------------------------------------------------------------------
// All the way to the goal, or half, ..., or nowhere: means of valid tables are valid.
void DistributionChannel::Search(const DistributionTables& goal)
{
  const DistributionTables from = this->Tables;
  const double now = this->MeanSquare(from);
  for (double t = 1.0; t > 0.01; t *= 0.5)
  {
    const DistributionTables next = { (1.0 - t) * from.P + t * goal.P,
      (1.0 - t) * from.F + t * goal.F, (1.0 - t) * from.Lambert + t * goal.Lambert };
    if (this->MeanSquare(next) < now)
    {
      this->Tables = next;
      return;
    }
  }
}
} // namespace measuredbrdf
