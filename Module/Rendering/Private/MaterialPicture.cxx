// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialPicture.h"

#include "vtkBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
vtkSmartPointer<vtkImageData> MakeMaterialPicture(
  vtkBRDF* brdf, vtkEnvironment* environment, int pixels, double tolerance)
{
  vtkNew<vtkRadiancePlanner> planner;
  planner->SetBRDF(brdf);
  planner->SetEnvironment(environment);
  planner->SetErrorTolerance(tolerance);
  if (!planner->Update())
  {
    return nullptr;
  }
  const auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> radiance;
  for (vtkDoubleArray* array : { normals.Get(), views.Get() })
  {
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(pixels) * pixels);
  }
  const double radius = 0.5 * pixels - 1.0; // room for a soft edge
  std::vector<double> coverage;
  for (int y = 0; y < pixels; ++y)
  {
    for (int x = 0; x < pixels; ++x)
    {
      double u = (x + 0.5 - 0.5 * pixels) / radius;
      double v = (y + 0.5 - 0.5 * pixels) / radius;
      const double r = std::hypot(u, v);
      coverage.push_back(std::clamp((1.0 - r) * radius + 0.5, 0.0, 1.0));
      const double inside = std::min(1.0, 0.999 / std::max(r, 1e-9));
      u *= inside;
      v *= inside;
      const vtkIdType k = static_cast<vtkIdType>(y) * pixels + x;
      normals->SetTuple3(k, u, v, std::sqrt(std::max(1.0 - u * u - v * v, 0.0)));
      views->SetTuple3(k, 0.0, 0.0, 1.0);
    }
  }
  if (!integrator || !integrator->Integrate(normals, views, radiance))
  {
    return nullptr;
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(pixels, pixels, 1);
  image->AllocateScalars(VTK_FLOAT, 4);
  auto* rgba = static_cast<float*>(image->GetScalarPointer());
  for (std::size_t k = 0; k < coverage.size(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = radiance->GetComponent(static_cast<vtkIdType>(k), c);
      *rgba++ = static_cast<float>(std::pow(std::max(value, 0.0), 1.0 / 2.2));
    }
    *rgba++ = static_cast<float>(coverage[k]);
  }
  return image;
}
} // namespace measuredbrdf
