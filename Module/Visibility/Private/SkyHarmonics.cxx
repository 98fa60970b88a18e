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

struct Band
{
  Eigen::MatrixXd FromValues; // at the directions
};

// Least squares: more directions than functions, but for the last degree.
std::vector<Band> MakeBands(const std::vector<glm::dvec3>& directions)
{
  std::vector<Band> bands;
  for (int l = 0; l <= Degree; ++l)
  {
    Eigen::MatrixXd values(Width, 2 * l + 1);
    for (int k = 0; k < Width; ++k)
    {
      const Values at = Evaluate(directions[k]);
      for (int m = 0; m < 2 * l + 1; ++m)
      {
        values(k, m) = at[l * l + m];
      }
    }
    bands.push_back({ values.completeOrthogonalDecomposition().pseudoInverse() });
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
  static const auto& bands = *new std::vector<Band>(MakeBands(directions));
  Colors result;
  std::array<Values, Width> turned;
  for (std::size_t k = 0; k < directions.size(); ++k)
  {
    turned[k] = Evaluate(r * directions[k]);
  }
  for (int l = 0; l <= Degree; ++l)
  {
    for (int m = 0; m < 2 * l + 1; ++m)
    {
      glm::dvec3 sum(0.0);
      for (int k = 0; k < Width; ++k)
      {
        glm::dvec3 value(0.0);
        for (int n = 0; n < 2 * l + 1; ++n)
        {
          const auto at = static_cast<std::size_t>(l * l + n);
          value += turned[k][at] * light[at];
        }
        sum += bands[l].FromValues(m, k) * value;
      }
      result[l * l + m] = sum;
    }
  }
  return result;
}
} // namespace sky
} // namespace measuredbrdf
