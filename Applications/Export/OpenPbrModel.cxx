// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OpenPbrModel.h"

#include "Lobes.h"
#include "MaterialXLobes.h"

#include "vtkObjectFactory.h"

#include <algorithm>

namespace tool
{
namespace
{
// Where the values of a parameter begin.
enum Value : std::size_t
{
  BaseColor = 0,
  Metalness = 3,
  Roughness = 4,
  SpecularWeight = 5,
  SpecularColor = 6,
  SpecularIndex = 9,
  Coat = 10,
  CoatRoughness = 11,
  CoatIndex = 12,
  Fuzz = 13,
  FuzzColor = 14,
  FuzzRoughness = 17,
  Anisotropy = 18,
  Rotation = 19
};
}

vtkStandardNewMacro(OpenPbrModel);

//------------------------------------------------------------------------------
const std::vector<ModelParameter>& OpenPbrModel::GetParameters() const
{
  // base_weight is written as 1: it only scales base_color. The rotation, in turns, is no input of
  // the node: files turn its tangent.
  static const std::vector<ModelParameter> parameters = { { "base_color", 3, 0.0, 1.0, 0.8,
                                                            Feature::Core, {} },
    { "base_metalness", 1, 0.0, 1.0, 0.0, Feature::Core, Metals },
    { "specular_roughness", 1, 0.05, 1.0, 0.3, Feature::Core, Roughnesses },
    { "specular_weight", 1, 0.0, 1.0, 1.0, Feature::Specular, { 0.9 } },
    { "specular_color", 3, 0.0, 1.0, 1.0, Feature::Specular, { 0.8 } },
    { "specular_ior", 1, 1.0, 3.0, 1.5, Feature::Specular, { 1.5, 2.0 }, 2.0 },
    { "coat_weight", 1, 0.0, 1.0, 0.0, Feature::Coat, { 0.5 } },
    { "coat_roughness", 1, 0.05, 1.0, 0.0, Feature::Coat, { 0.12, 0.35 } },
    { "coat_ior", 1, 1.0, 3.0, 1.6, Feature::Coat, { 1.6 }, 2.0 },
    { "fuzz_weight", 1, 0.0, 1.0, 0.0, Feature::Sheen, { 0.2 } },
    { "fuzz_color", 3, 0.0, 1.0, 1.0, Feature::Sheen, { 0.5 } },
    { "fuzz_roughness", 1, 0.05, 1.0, 0.5, Feature::Sheen, { 0.3, 0.7 } },
    { "specular_roughness_anisotropy", 1, 0.0, 0.98, 0.0, Feature::Anisotropy, { 0.4 } },
    { "tangent_rotation", 1, 0.0, 0.5, 0.0, Feature::Anisotropy, { 0.03, 0.27 } } };
  return parameters;
}

//------------------------------------------------------------------------------
// The base looks rougher through a rough coat.
double OpenPbrModel::GetRoughness() const
{
  const double own = this->Values[Roughness];
  const double coated = std::pow(
    std::min(2.0 * std::pow(this->Values[CoatRoughness], 4) + std::pow(own, 4), 1.0), 0.25);
  return own + (coated - own) * this->Values[Coat];
}

//------------------------------------------------------------------------------
// The index relative to the coat's, and scaled for the reflectance that specular_weight asks for.
double OpenPbrModel::GetIndex() const
{
  const double own = this->Values[SpecularIndex];
  const double ratio = own / this->Values[CoatIndex];
  const double eta = own + (std::max(ratio, 1.0 / ratio) - own) * this->Values[Coat];
  const double f0 =
    std::clamp(this->Values[SpecularWeight] * ReflectanceOfIndex(eta), 0.0, 0.99999);
  const double root = std::copysign(std::sqrt(f0), eta - 1.0);
  return (1.0 + root) / (1.0 - root);
}

//------------------------------------------------------------------------------
// Light that the coat reflects back onto the base.
glm::dvec3 OpenPbrModel::GetDarkening() const
{
  const double index = this->Values[CoatIndex];
  const double back = 1.0 - (1.0 - ReflectanceOfIndex(index)) / (index * index);
  const glm::dvec3 base = this->ColorAt(BaseColor);
  const glm::dvec3 albedo =
    glm::mix(base, base * this->Values[SpecularWeight], this->Values[Metalness]);
  const glm::dvec3 darkening = glm::dvec3(1.0 - back) / (glm::dvec3(1.0) - albedo * back);
  return glm::mix(glm::dvec3(1.0), darkening, this->Values[Coat]);
}

//------------------------------------------------------------------------------
glm::dvec3 OpenPbrModel::Shade(const Directions& directions) const
{
  const double anisotropy = this->Values[Anisotropy];
  // In turns, clockwise about the normal: MaterialX' rotate3d turns so.
  const double angle = anisotropy > 0.0 ? -2.0 * Pi * this->Values[Rotation] : 0.0;
  const Directions d = angle == 0.0
                         ? directions
                         : Directions(Turn(directions.Light, angle), Turn(directions.View, angle));
  const Widths widths = GetOpenPbrWidths(this->GetRoughness(), anisotropy);
  const glm::dvec3 base = this->ColorAt(BaseColor);
  const glm::dvec3 specularColor = this->ColorAt(SpecularColor);
  const double weight = this->Values[SpecularWeight];

  // The diffuse part at base_diffuse_roughness 0: Lambert.
  glm::dvec3 f = Over(GetDielectric(d, 1.0, specularColor, this->GetIndex(), widths), base / Pi);
  const double metalness = this->Values[Metalness];
  if (metalness > 0.0)
  {
    f = glm::mix(f, GetSchlickMetal(d, weight, base, weight * specularColor, widths), metalness);
  }
  const double coatWeight = this->Values[Coat];
  if (coatWeight > 0.0)
  {
    const Layer coat = GetDielectric(d, coatWeight, glm::dvec3(1.0), this->Values[CoatIndex],
      GetOpenPbrWidths(this->Values[CoatRoughness], 0.0));
    f = Over(coat, f * glm::clamp(this->GetDarkening(), 0.0, 1.0));
  }
  return Over(
    GetZeltnerSheen(d, this->Values[Fuzz], this->ColorAt(FuzzColor), this->Values[FuzzRoughness]),
    f);
}
} // namespace tool
