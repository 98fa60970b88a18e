// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PreviewSurfaceModel.h"

#include "Lobes.h"

#include "vtkObjectFactory.h"

namespace tool
{
namespace
{
// Where the values of a parameter begin.
enum Value : std::size_t
{
  DiffuseColor = 0,
  Metallic = 3,
  Roughness = 4,
  Index = 5,
  Clearcoat = 6,
  ClearcoatRoughness = 7
};

//------------------------------------------------------------------------------
// GGX with Schlick's form of Smith's shadowing (Karis 2013), k = alpha / 2.
double GetPreviewLobe(const Directions& d, double roughness)
{
  const double alpha = roughness * roughness;
  const double k = 0.5 * alpha;
  const auto part = [k](double c) { return c * (1.0 - k) + k; };
  return DistributeGGX(d.Half, alpha, alpha) / (4.0 * part(d.NdL) * part(d.NdV));
}
}

vtkStandardNewMacro(PreviewSurfaceModel);

//------------------------------------------------------------------------------
const std::vector<ModelParameter>& PreviewSurfaceModel::GetParameters() const
{
  static const std::vector<ModelParameter> parameters = { { "diffuseColor", 3, 0.0, 1.0, 0.18,
                                                            Feature::Core, {} },
    { "metallic", 1, 0.0, 1.0, 0.0, Feature::Core, Metals },
    { "roughness", 1, 0.05, 1.0, 0.5, Feature::Core, Roughnesses },
    { "ior", 1, 1.0, 3.0, 1.5, Feature::Specular, { 1.3, 2.0 }, 2.0 },
    { "clearcoat", 1, 0.0, 1.0, 0.0, Feature::Coat, { 0.5 } },
    { "clearcoatRoughness", 1, 0.05, 1.0, 0.01, Feature::Coat, { 0.12, 0.35 } } };
  return parameters;
}

//------------------------------------------------------------------------------
glm::dvec3 PreviewSurfaceModel::Shade(const Directions& d) const
{
  const glm::dvec3 color = this->ColorAt(DiffuseColor);
  const double metallic = this->Values[Metallic];
  const double reflectance = ReflectanceOfIndex(this->Values[Index]);
  const double s = Schlick(d.VdH);
  const glm::dvec3 f90 = glm::mix(glm::dvec3(1.0), color, metallic);
  const glm::dvec3 f0 = glm::mix(reflectance * f90, f90, metallic);
  const glm::dvec3 fresnel = glm::mix(f0, f90, s);
  const glm::dvec3 diffuse = color * ((1.0 - metallic) / Pi) * (glm::dvec3(1.0) - fresnel);
  glm::dvec3 f = diffuse + fresnel * GetPreviewLobe(d, this->Values[Roughness]);
  const double coat = this->Values[Clearcoat];
  if (coat > 0.0)
  {
    f += glm::dvec3(coat * (reflectance + (1.0 - reflectance) * s) *
                    GetPreviewLobe(d, this->Values[ClearcoatRoughness]));
  }
  return f;
}
} // namespace tool
