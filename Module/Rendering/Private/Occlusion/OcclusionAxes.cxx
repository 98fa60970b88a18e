// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionAxes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkEnvironment.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderer.h"

#include <Eigen/Dense>

#include <cmath>

namespace measuredbrdf
{
namespace
{
glm::dmat3 GetLinearPart(vtkMatrix4x4* matrix)
{
  glm::dmat3 linear;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      linear[column][row] = matrix->GetElement(row, column);
    }
  }
  return linear;
}

// The orthogonal factor of the polar decomposition.
glm::dmat3 GetNearestOrthogonal(const glm::dmat3& matrix)
{
  Eigen::Matrix3d m;
  for (int k = 0; k < 9; ++k)
  {
    m(k % 3, k / 3) = matrix[k / 3][k % 3];
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d orthogonal = svd.matrixU() * svd.matrixV().transpose();
  glm::dmat3 result;
  for (int k = 0; k < 9; ++k)
  {
    result[k / 3][k % 3] = orthogonal(k % 3, k / 3);
  }
  return result;
}
}

OcclusionAxes::OcclusionAxes(
  vtkRenderer* renderer, vtkActor* actor, const std::vector<vtkEnvironment*>& environments)
{
  const glm::dmat3 toWorld = GetLinearPart(actor->GetMatrix());
  const glm::dmat3 toView =
    GetLinearPart(renderer->GetActiveCamera()->GetModelViewTransformMatrix()) * toWorld;
  const double size = std::cbrt(std::abs(glm::determinant(toView)));
  this->ToModel = size > 0.0 ? size * glm::inverse(toView) : glm::dmat3(1.0);
  const glm::dmat3 turned = GetNearestOrthogonal(toWorld);
  // Rows: right, up, right x up, as VTK's envMatrix has them.
  glm::dmat3 columns;
  const double* right = renderer->GetEnvironmentRight();
  const double* up = renderer->GetEnvironmentUp();
  columns[0] = glm::dvec3(right[0], right[1], right[2]);
  columns[1] = glm::dvec3(up[0], up[1], up[2]);
  columns[2] = glm::cross(columns[0], columns[1]);
  const glm::dmat3 toRenderer = glm::transpose(columns);
  for (vtkEnvironment* environment : environments)
  {
    glm::dmat3 own(1.0);
    if (environment)
    {
      double rows[9];
      environment->GetWorldToEnvironment(rows);
      for (int k = 0; k < 9; ++k)
      {
        own[k % 3][k / 3] = rows[k];
      }
    }
    this->ToEnvironment.push_back(own * toRenderer * turned);
  }
}
} // namespace measuredbrdf
