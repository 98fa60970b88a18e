// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanPairs.h"

#include "LowDiscrepancy.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
}

PlanPairs DrawSpherePairs(int count, const double wanted[3])
{
  PlanPairs pairs;
  pairs.Normals = vtkSmartPointer<vtkDoubleArray>::New();
  pairs.Views = vtkSmartPointer<vtkDoubleArray>::New();
  pairs.Normals->SetNumberOfComponents(3);
  pairs.Views->SetNumberOfComponents(3);
  for (int k = 0; k < count; ++k)
  {
    const unsigned int index = static_cast<unsigned int>(k + 1);
    glm::dvec3 view(wanted[0], wanted[1], wanted[2]);
    if (!(glm::length(view) > 0.0))
    {
      const double z = 2.0 * RadicalInverse(index, 5) - 1.0;
      const double phi = 2.0 * Pi * RadicalInverse(index, 7);
      const double s = std::sqrt(std::max(1.0 - z * z, 0.0));
      view = glm::dvec3(s * std::cos(phi), z, s * std::sin(phi));
    }
    view = glm::normalize(view);
    const glm::dvec3 any =
      std::abs(view.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(any, view));
    const glm::dvec3 v = glm::cross(view, u);
    // The view's cosine by the density 2 c of a disc, or by 1 / (2 sqrt(c)).
    const double x = RadicalInverse(index, 2);
    const double c = x < 0.5 ? std::sqrt(2.0 * x) : (2.0 * x - 1.0) * (2.0 * x - 1.0);
    pairs.Weights.push_back(2.0 * c / (c + 0.25 / std::sqrt(std::max(c, 1e-6))));
    const double r = std::sqrt(1.0 - c * c);
    const double phi = 2.0 * Pi * RadicalInverse(index, 3);
    const glm::dvec3 n = r * std::cos(phi) * u + r * std::sin(phi) * v + c * view;
    pairs.Normals->InsertNextTuple(&n.x);
    pairs.Views->InsertNextTuple(&view.x);
  }
  return pairs;
}
} // namespace measuredbrdf
