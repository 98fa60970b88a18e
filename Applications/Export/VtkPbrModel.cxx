// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VtkPbrModel.h"

#include "Lobes.h"

#include "vtkObjectFactory.h"

#include <algorithm>

namespace tool
{
namespace
{
// Where the values of a parameter begin.
enum Value : std::size_t
{
  Color = 0,
  Metallic = 3,
  Roughness = 4,
  BaseIndex = 5,
  EdgeTint = 6,
  CoatStrength = 9,
  CoatRoughness = 10,
  CoatIndex = 11,
  Anisotropy = 12,
  Rotation = 13
};

//------------------------------------------------------------------------------
// SpecularIsotropic without F: the shadowing takes roughness^2 where Heitz has alpha^2.
double GetPbrLobe(const Directions& d, double roughness)
{
  const double alpha = roughness * roughness;
  return DistributeGGX(d.Half, alpha, alpha) * ShadowTogether(d.NdL, d.NdV, alpha);
}

//------------------------------------------------------------------------------
// vtkProperty::ComputeReflectanceFromIOR.
double GetReflectance(double to, double from) { return Square((to - from) / (to + from)); }
}

vtkStandardNewMacro(VtkPbrModel);

//------------------------------------------------------------------------------
const std::vector<ModelParameter>& VtkPbrModel::GetParameters() const
{
  static const std::vector<ModelParameter> parameters = { { "Color", 3, 0.0, 1.0, 1.0,
                                                            Feature::Core, {} },
    { "Metallic", 1, 0.0, 1.0, 0.0, Feature::Core, Metals },
    { "Roughness", 1, 0.05, 1.0, 0.5, Feature::Core, Roughnesses },
    { "BaseIOR", 1, 1.0, 3.0, 1.5, Feature::Specular, { 1.4, 2.0 }, 2.0 },
    { "EdgeTint", 3, 0.0, 1.0, 1.0, Feature::Specular, { 0.8, 0.3 } },
    { "CoatStrength", 1, 0.0, 1.0, 0.0, Feature::Coat, { 0.5 } },
    { "CoatRoughness", 1, 0.05, 1.0, 0.0, Feature::Coat, { 0.12, 0.35 } },
    { "CoatIOR", 1, 1.0, 3.0, 2.0, Feature::Coat, { 1.5 }, 2.0 },
    { "Anisotropy", 1, 0.0, 1.0, 0.0, Feature::Anisotropy, { 0.4 } },
    { "AnisotropyRotation", 1, 0.0, 0.5, 0.0, Feature::Anisotropy, { 0.03, 0.27 } } };
  return parameters;
}

//------------------------------------------------------------------------------
double VtkPbrModel::GetBaseLobe(const Directions& d) const
{
  const double roughness = this->Values[Roughness];
  const double anisotropy = this->Values[Anisotropy];
  if (anisotropy == 0.0)
  {
    return GetPbrLobe(d, roughness);
  }
  const double angle = 2.0 * Pi * this->Values[Rotation];
  const Directions turned(Turn(d.Light, angle), Turn(d.View, angle));
  const double aspect = std::sqrt(1.0 - 0.9 * anisotropy); // Burley 2012
  const double x = std::max(roughness * roughness / aspect, 0.001);
  const double y = std::max(roughness * roughness * aspect, 0.001);
  return DistributeGGX(turned.Half, x, y) * ShadowTogether(turned, x, y);
}

//------------------------------------------------------------------------------
glm::dvec3 VtkPbrModel::Shade(const Directions& d) const
{
  const glm::dvec3 color = this->ColorAt(Color);
  const double metallic = this->Values[Metallic];
  const double strength = this->Values[CoatStrength];
  const double index = this->Values[BaseIndex];
  const double coatIndex = this->Values[CoatIndex];
  // vtkProperty::ComputeReflectanceOfBaseLayer.
  const double base =
    GetReflectance(index, 1.0) * (1.0 - strength) + GetReflectance(index, coatIndex) * strength;
  const glm::dvec3 f0 = glm::mix(glm::dvec3(base), color, metallic);
  const double grazing = std::clamp(50.0 * 0.33 * (f0.x + f0.y + f0.z), 0.0, 1.0);
  const glm::dvec3 f90 = glm::mix(glm::dvec3(grazing), this->ColorAt(EdgeTint), metallic);
  const double s = Schlick(d.VdH);
  const glm::dvec3 fresnel = f0 + (f90 - f0) * s;
  const glm::dvec3 diffuse = (1.0 - metallic) / Pi * (glm::dvec3(1.0) - fresnel) * color;
  const glm::dvec3 specular = fresnel * this->GetBaseLobe(d);
  if (strength == 0.0)
  {
    return diffuse + specular;
  }
  const double coatF0 = GetReflectance(coatIndex, 1.0);
  const double coat = strength * (coatF0 + (1.0 - coatF0) * s);
  return diffuse * (1.0 - coat) + specular * Square(1.0 - coat) +
         glm::dvec3(coat * GetPbrLobe(d, this->Values[CoatRoughness]));
}
} // namespace tool
