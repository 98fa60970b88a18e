// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SkyHarmonics.h"

#include <Eigen/Dense>

#include <cmath>
#include <vector>

namespace measuredbrdf
{
namespace sky
{
namespace
{
constexpr int Width = 2 * Degree + 1; // functions of the last degree

// Directions about an axis that is no axis of the functions: their matrices are well conditioned.
std::vector<glm::dvec3> MakeDirections()
{
  const double golden = 2.39996322972865332; // angle, in radians
  std::vector<glm::dvec3> directions;
  for (int k = 0; k < Width; ++k)
  {
    const double z = 1.0 - (k + 0.5) / Width;
    const double s = std::sqrt(1.0 - z * z);
    directions.emplace_back(s * std::cos(golden * k + 0.3), s * std::sin(golden * k + 0.3), z);
  }
  return directions;
}

// All functions at the directions, turned: a row each.
using Turned = Eigen::Matrix<double, Width, Harmonics>;

Turned EvaluateAll(const std::vector<glm::dvec3>& directions, const glm::dmat3& turn)
{
  Turned values;
  for (int k = 0; k < Width; ++k)
  {
    const Values at = Evaluate(turn * directions[k]);
    values.row(k) = Eigen::Map<const Eigen::Matrix<double, 1, Harmonics>>(at.data());
  }
  return values;
}

// Of each degree: its functions' coefficients from values at the directions, by least squares.
// There are more directions than functions, but for the last degree.
std::vector<Eigen::MatrixXd> MakeBands(const std::vector<glm::dvec3>& directions)
{
  std::vector<Eigen::MatrixXd> bands;
  const Turned values = EvaluateAll(directions, glm::dmat3(1.0));
  for (int l = 0; l <= Degree; ++l)
  {
    const Eigen::MatrixXd own = values.middleCols(l * l, 2 * l + 1);
    bands.push_back(own.completeOrthogonalDecomposition().pseudoInverse());
  }
  return bands;
}
}

Values GetCosineTransfer(const glm::dvec3& n)
{
  constexpr double pi = 3.14159265358979323846;
  constexpr double bands[] = { pi, 2.0 * pi / 3.0, pi / 4.0, 0.0, -pi / 24.0 };
  Values values = Evaluate(n);
  for (int l = 0; l <= Degree; ++l)
  {
    for (int m = 0; m < 2 * l + 1; ++m)
    {
      values[l * l + m] *= bands[l];
    }
  }
  return values;
}

Colors Rotate(const Colors& light, const glm::dmat3& r)
{
  // Threads may use them until the very end.
  static const auto& directions = *new std::vector<glm::dvec3>(MakeDirections());
  static const auto& bands = *new std::vector<Eigen::MatrixXd>(MakeBands(directions));
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>; // of colors
  const Turned turned = EvaluateAll(directions, r);
  Colors result;
  for (int l = 0; l <= Degree; ++l)
  {
    const int count = 2 * l + 1;
    Eigen::Map<Rows>(&result[l * l].x, count, 3) =
      bands[l] * turned.middleCols(l * l, count) *
      Eigen::Map<const Rows>(&light[l * l].x, count, 3);
  }
  return result;
}
} // namespace sky
} // namespace measuredbrdf
