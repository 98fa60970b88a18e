// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentRotation.h"

#include "vtkCamera.h"
#include "vtkEnvironment.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLCamera.h"
#include "vtkRenderer.h"

namespace measuredbrdf
{
namespace
{
// As VTK's shaders have it: cameras of headsets have a matrix for each eye.
void FindWorldToView(vtkRenderer* renderer, vtkMatrix4x4* toView)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  auto* openGL = vtkOpenGLCamera::SafeDownCast(camera);
  if (!openGL)
  {
    toView->DeepCopy(camera->GetModelViewTransformMatrix());
    return;
  }
  vtkMatrix4x4 *worldToView, *viewToDisplay, *worldToDisplay;
  vtkMatrix3x3* normals;
  openGL->GetKeyMatrices(renderer, worldToView, normals, viewToDisplay, worldToDisplay);
  vtkMatrix4x4::Transpose(worldToView, toView); // OpenGL's order
}
}

std::array<double, 9> GetViewToEnvironment(vtkRenderer* renderer, vtkEnvironment* environment)
{
  double own[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  if (environment)
  {
    environment->GetWorldToEnvironment(&own[0][0]);
  }
  // Rows of VTK's envMatrix: right, up and right x up, in view coordinates.
  double axes[3][3];
  renderer->GetEnvironmentRight(axes[0]);
  renderer->GetEnvironmentUp(axes[1]);
  vtkMath::Cross(axes[0], axes[1], axes[2]);
  const vtkNew<vtkMatrix4x4> toView;
  FindWorldToView(renderer, toView);
  double turned[3][3] = {};
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      for (int k = 0; k < 3; ++k)
      {
        turned[row][column] += toView->GetElement(column, k) * axes[row][k];
      }
    }
  }
  double product[3][3];
  vtkMath::Multiply3x3(own, turned, product);
  std::array<double, 9> rows;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    rows[k] = product[k / 3][k % 3];
  }
  return rows;
}
} // namespace measuredbrdf
