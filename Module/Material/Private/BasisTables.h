// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What sums over basis functions are evaluated from. Private to the material room.
 */

#ifndef BasisTables_h
#define BasisTables_h

#include "BasisFunctions.h"
#include "vtkBRDFShaderInputs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// Two neighboring samples of an axis and the weight of the second.
struct Interval
{
  int First;
  int Second;
  double Weight;
};

/// Samples at u = k / (n-1).
inline Interval OnAxis(double u, int n)
{
  const double x = std::clamp(u, 0.0, 1.0) * (n - 1);
  const int first = std::min(static_cast<int>(x), n - 2);
  return { first, first + 1, x - first };
}

/// Samples at u = k / n, periodic.
inline Interval OnCircle(double u, int n)
{
  const double x = (u - std::floor(u)) * n;
  const int first = static_cast<int>(x) % n;
  return { first, (first + 1) % n, x - std::floor(x) };
}

/// Four neighbors in the basis table and their weights.
struct BasisCorners
{
  const float* Rows[4];
  double Weights[4];

  double Interpolate(std::size_t k) const
  {
    return this->Weights[0] * this->Rows[0][k] + this->Weights[1] * this->Rows[1][k] +
           this->Weights[2] * this->Rows[2][k] + this->Weights[3] * this->Rows[3][k];
  }
};

/// Values of all basis functions at equal steps of acos(x) and of the azimuth, and coefficients,
/// both with k fastest.
struct BasisTables
{
  /**
   * gammaRange: acos(x) at the last row. tolerance: relative error of the interpolated sums, which
   * sets the steps. coefficients: RGB triples, k slowest, as vtkBasisBRDF holds them.
   */
  BasisTables(const BasisFunctions& functions, double gammaRange, double tolerance,
    const std::vector<float>& coefficients);

  BasisCorners GetCorners(double x, double turn) const
  {
    const Interval g = OnAxis(std::acos(x) / this->GammaRange, this->NumberOfGamma);
    const Interval p = OnCircle(turn, this->NumberOfPhi);
    const auto row = [this](int gamma, int phi)
    {
      const std::size_t k =
        static_cast<std::size_t>(gamma) * static_cast<std::size_t>(this->NumberOfPhi) +
        static_cast<std::size_t>(phi);
      return &this->Basis[k * static_cast<std::size_t>(this->Functions.GetNumberOfFunctions())];
    };
    return { { row(g.First, p.First), row(g.First, p.Second), row(g.Second, p.First),
               row(g.Second, p.Second) },
      { (1.0 - g.Weight) * (1.0 - p.Weight), (1.0 - g.Weight) * p.Weight,
        g.Weight * (1.0 - p.Weight), g.Weight * p.Weight } };
  }

  /// Adds weight times the sum of basis functions with the coefficients of one sample of o.
  void AddView(int view, const BasisCorners& corners, double weight, double f[3]) const;

  /**
   * interpolation: relative L2 error of the sums by the basis table's steps, directions weighted by
   * the cosine. amplification: how much independent rounding errors of the stored values grow in
   * the sum, sqrt(sum (C_k B_k)^2) / |sum C_k B_k|, RMS.
   */
  void Measure(double& interpolation, double& amplification) const;

  /// Upper bounds of what the sums are, over a divisor: sum |C_k| max |B_k|.
  void GetBounds(double divisor, double upper[3]) const;

  /// The basis values for a shader, k slowest.
  vtkBRDFShaderInputs::Texture MakeTexture(bool halfFloat) const;

  BasisFunctions Functions;
  double GammaRange;
  int NumberOfGamma;
  int NumberOfPhi;
  std::vector<float> Basis;        // [gamma][phi][k]
  std::vector<float> Coefficients; // [theta_o][phi_o][channel][k]
};

/// Coefficients as vtkBasisBRDF holds them for a shader, times `scale`, which uses the range of
/// 16-bit floats.
vtkBRDFShaderInputs::Texture MakeCoefficientTexture(
  const std::vector<float>& coefficients, int nPhi, int nTheta, bool halfFloat, float& scale);
} // namespace measuredbrdf

#endif
