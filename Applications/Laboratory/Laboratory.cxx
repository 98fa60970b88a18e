// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Laboratory.h"

#include "LocalFrame.h"
#include "Methods.h"
#include "Picture.h"
#include "Tool.h"

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBasisProjector.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkNew.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace laboratory
{
//------------------------------------------------------------------------------
vtkSmartPointer<vtkBasisBRDF> ProjectOnto(
  vtkBRDF* brdf, int basis, int order, const double zone[2], const std::string& name)
{
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(brdf);
  projector->SetBasis(basis);
  projector->SetOrder(order);
  if (basis >= vtkBasisBRDF::ZONAL)
  {
    projector->SetIncidentZone(zone[0], zone[1]);
    projector->SetOutgoingZone(zone[0], zone[1]);
  }
  if (!tool::RunWithProgress(projector.Get(), &vtkBasisProjector::Project, "projecting"))
  {
    throw tool::Error(name + ": projection: " + tool::TakeErrorText());
  }
  return projector->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> FitDistribution(vtkBRDF* brdf, const std::string& name)
{
  vtkNew<vtkDistributionBRDFFitter> fitter;
  fitter->SetInput(brdf);
  if (!tool::RunWithProgress(fitter.Get(), &vtkDistributionBRDFFitter::Fit, "fitting"))
  {
    throw tool::Error(name + ": D-BRDF: " + tool::TakeErrorText());
  }
  return fitter->GetOutput();
}

//------------------------------------------------------------------------------
void Pairs::Add(const glm::dvec3& normal, const glm::dvec3& view)
{
  this->Normals.insert(this->Normals.end(), { normal.x, normal.y, normal.z });
  this->Views.insert(this->Views.end(), { view.x, view.y, view.z });
}

//------------------------------------------------------------------------------
Pairs MakeSpherePairs(int count)
{
  const double azimuth = glm::radians(30.0);
  const double elevation = glm::radians(20.0);
  const glm::dvec3 view(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
    std::cos(elevation) * std::cos(azimuth));
  const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(view);
  Pairs pairs;
  for (int k = 0; k < count; ++k)
  {
    // Sunflower seeds: evenly over the disc, within the rim by a pixel of 500.
    const double r = 0.996 * std::sqrt((k + 0.5) / count);
    const double phi = glm::pi<double>() * (3.0 - std::sqrt(5.0)) * k;
    pairs.Add(frame * measuredbrdf::ToDirection(std::sqrt(1.0 - r * r), phi), view);
  }
  return pairs;
}

//------------------------------------------------------------------------------
Environment MakeEnvironment(
  int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance)
{
  std::vector<float> pixels;
  for (int k = 0; k < width * height; ++k)
  {
    glm::dvec3 direction;
    vtkEnvironment::GetDirection(
      (k % width + 0.5) / width, (k / width + 0.5) / height, &direction.x);
    const glm::vec3 rgb(radiance(direction));
    pixels.insert(pixels.end(), { rgb.r, rgb.g, rgb.b });
  }
  auto environment = Environment::New();
  environment->SetPixels(width, height, std::move(pixels));
  return environment;
}

//------------------------------------------------------------------------------
Environment Shrink(vtkEnvironment* environment, int width)
{
  const int height = std::max(width / 2, 1);
  return environment->GetWidth() <= width || environment->GetHeight() <= height
           ? Environment(environment)
           : tool::Shrink(environment, width, height);
}

//------------------------------------------------------------------------------
Radiance Integrate(vtkRadianceIntegrator* integrator, const Pairs& pairs)
{
  const std::vector<double> values = tool::IntegratePairs(integrator, pairs.Normals, pairs.Views);
  return Eigen::Map<const Radiance>(values.data(), static_cast<Eigen::Index>(values.size()));
}

//------------------------------------------------------------------------------
Radiance IntegrateReference(vtkBRDF* brdf, vtkEnvironment* environment, const Pairs& pairs)
{
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(brdf);
  reference->SetEnvironment(environment);
  reference->SetTolerance(2e-4); // slopes of errors need it
  return Integrate(reference, pairs);
}

//------------------------------------------------------------------------------
double GetRelativeL1(const Radiance& x, const Radiance& reference)
{
  const double difference = (x - reference).abs().sum();
  return difference == 0.0 ? 0.0 : difference / reference.sum();
}
} // namespace laboratory
