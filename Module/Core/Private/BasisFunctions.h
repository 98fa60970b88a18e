// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Orthonormal functions over a zone cos(theta) in [Far, Near] of the sphere, all azimuths, and the
 * one form they share: B_lm = radial_lm(x) times 1 (m = 0), sqrt 2 cos(m phi) (m > 0) or
 * sqrt 2 sin(|m| phi) (m < 0), with x = 2 (cos(theta) - Far) / (Near - Far) - 1 in [-1, 1].
 *
 * Spherical harmonics: Near, Far = 1, -1. Hemispherical: 1, 0 (Gautron et al. 2004). Zonal: any two
 * (Ghosh et al. 2007). All three have radial_lm = N_lm P_l^|m|(x), normalized for the zone, without
 * the Condon-Shortley sign. Legendre x Fourier has sqrt((2k+1)/(2 pi height)) P_k(x) with
 * k = l - |m|: it does not vanish at the zone's edges.
 */

#ifndef BasisFunctions_h
#define BasisFunctions_h

#include "HalfVector.h" // Pi

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
struct Quadrature
{
  std::vector<double> Nodes; // descending
  std::vector<double> Weights;
};

/// n >= 1 nodes on [-1, 1], the roots of P_n by Newton's method.
inline Quadrature GaussLegendre(int n)
{
  Quadrature rule;
  for (int k = 0; k < n; ++k)
  {
    double x = std::cos(Pi * (k + 0.75) / (n + 0.5));
    double derivative = 1.0;
    for (int iteration = 0; iteration < 20; ++iteration)
    {
      double p0 = 1.0;
      double p1 = x;
      for (int l = 2; l <= n; ++l)
      {
        const double p2 = ((2.0 * l - 1.0) * x * p1 - (l - 1.0) * p0) / l;
        p0 = p1;
        p1 = p2;
      }
      derivative = n * (x * p1 - p0) / (x * x - 1.0);
      const double step = p1 / derivative;
      x -= step;
      if (std::abs(step) < 1e-15)
      {
        break;
      }
    }
    rule.Nodes.push_back(x);
    rule.Weights.push_back(2.0 / ((1.0 - x * x) * derivative * derivative));
  }
  return rule;
}

class BasisFunctions
{
public:
  BasisFunctions() = default;

  BasisFunctions(bool legendreFourier, int order, double nearCosine, double farCosine)
    : LegendreFourier(legendreFourier)
    , Order(order)
    , Near(nearCosine)
    , Far(farCosine)
  {
  }

  int GetOrder() const { return this->Order; }
  int GetNumberOfFunctions() const { return (this->Order + 1) * (this->Order + 1); }
  double GetNear() const { return this->Near; }
  double GetFar() const { return this->Far; }

  /// Index of (l, m), -l <= m <= l.
  static int Index(int l, int m) { return l * (l + 1) + m; }

  /// Index of (l, m), 0 <= m <= l, in what EvaluateRadial fills.
  static int RadialIndex(int l, int m) { return l * (l + 1) / 2 + m; }
  int GetNumberOfRadials() const { return (this->Order + 1) * (this->Order + 2) / 2; }

  /// x of a direction's cosine, constant beyond the zone.
  double ToX(double cosine) const
  {
    return std::clamp(2.0 * (cosine - this->Far) / (this->Near - this->Far) - 1.0, -1.0, 1.0);
  }
  double ToCosine(double x) const { return this->Far + 0.5 * (x + 1.0) * (this->Near - this->Far); }

  /// radial_lm(x) for 0 <= m <= l <= order, without the azimuth's sqrt 2.
  void EvaluateRadial(double x, double* radial) const
  {
    const double height = this->Near - this->Far;
    const int n = this->Order;
    if (this->LegendreFourier)
    {
      double p0 = 0.0; // P_{k-1}
      double p1 = 1.0; // P_k
      for (int k = 0; k <= n; ++k)
      {
        const double value = std::sqrt((2.0 * k + 1.0) / (2.0 * Pi * height)) * p1;
        for (int m = 0; k + m <= n; ++m)
        {
          radial[RadialIndex(k + m, m)] = value;
        }
        const double p2 = ((2.0 * k + 1.0) * x * p1 - k * p0) / (k + 1.0);
        p0 = p1;
        p1 = p2;
      }
      return;
    }
    // Normalized associated Legendre functions by the stable recurrence in l.
    const double s = std::sqrt(std::max(1.0 - x * x, 0.0));
    double diagonal = std::sqrt(1.0 / (2.0 * Pi * height));
    for (int m = 0; m <= n; ++m)
    {
      if (m > 0)
      {
        diagonal *= s * std::sqrt((2.0 * m + 1.0) / (2.0 * m));
      }
      double before = 0.0;
      double value = diagonal;
      radial[RadialIndex(m, m)] = value;
      double previous = 0.0; // 1 / a_{l-1}
      for (int l = m + 1; l <= n; ++l)
      {
        const double a = std::sqrt((4.0 * l * l - 1.0) / (static_cast<double>(l) * l - m * m));
        const double next = a * (x * value - previous * before);
        previous = 1.0 / a;
        before = value;
        value = next;
        radial[RadialIndex(l, m)] = value;
      }
    }
  }

  /// All functions at cos(theta), phi: GetNumberOfFunctions() values.
  void Evaluate(double cosine, double phi, double* values) const
  {
    std::vector<double> radial(static_cast<std::size_t>(this->GetNumberOfRadials()));
    this->EvaluateRadial(this->ToX(cosine), radial.data());
    for (int m = 0; m <= this->Order; ++m)
    {
      const double c = m > 0 ? std::sqrt(2.0) * std::cos(m * phi) : 1.0;
      const double s = std::sqrt(2.0) * std::sin(m * phi);
      for (int l = m; l <= this->Order; ++l)
      {
        const double r = radial[RadialIndex(l, m)];
        values[Index(l, m)] = r * c;
        if (m > 0)
        {
          values[Index(l, -m)] = r * s;
        }
      }
    }
  }

private:
  bool LegendreFourier = false;
  int Order = 0;
  double Near = 1.0;
  double Far = -1.0;
};
/// radial_lm(x of each cosine): a column per degree l = m ... order.
inline Eigen::MatrixXd MakeRadialMatrix(
  const BasisFunctions& functions, int m, const std::vector<double>& cosines)
{
  const int n = functions.GetOrder();
  Eigen::MatrixXd matrix(cosines.size(), n + 1 - m);
  std::vector<double> radial(functions.GetNumberOfRadials());
  for (std::size_t q = 0; q < cosines.size(); ++q)
  {
    functions.EvaluateRadial(functions.ToX(cosines[q]), radial.data());
    for (int l = m; l <= n; ++l)
    {
      matrix(q, l - m) = radial[BasisFunctions::RadialIndex(l, m)];
    }
  }
  return matrix;
}

/// From samples at the cosines to the coefficients that minimize their weighted squared error plus
/// regularization * (sum of weights) / (4 pi) * sum of (l (l+1))^2 C^2.
inline Eigen::MatrixXd MakeLeastSquares(const BasisFunctions& functions, int m,
  const std::vector<double>& cosines, const std::vector<double>& weights, double regularization)
{
  const Eigen::MatrixXd radial = MakeRadialMatrix(functions, m, cosines);
  const Eigen::Index rows = radial.rows(), columns = radial.cols();
  const Eigen::Map<const Eigen::VectorXd> weight(weights.data(), rows);
  const Eigen::VectorXd root = weight.cwiseSqrt();
  // The penalty as further rows: a QR of this matrix keeps twice the digits of normal equations.
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(rows + columns, columns);
  system.topRows(rows) = root.asDiagonal() * radial;
  for (Eigen::Index column = 0; column < columns; ++column)
  {
    const double l = static_cast<double>(column) + m;
    system(rows + column, column) =
      std::sqrt(regularization * weight.sum() / (4.0 * Pi)) * l * (l + 1.0);
  }
  Eigen::MatrixXd samples = Eigen::MatrixXd::Zero(rows + columns, rows);
  samples.topRows(rows) = root.asDiagonal();
  return system.colPivHouseholderQr().solve(samples);
}
} // namespace measuredbrdf

#endif
