// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StandardSurfaceModel.h"

#include "Lobes.h"
#include "MaterialXLobes.h"

#include "vtkObjectFactory.h"

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
  Specular = 5,
  SpecularColor = 6,
  SpecularIndex = 9,
  Coat = 10,
  CoatRoughness = 11,
  CoatIndex = 12,
  Sheen = 13,
  SheenColor = 14,
  SheenRoughness = 17,
  Anisotropy = 18,
  Rotation = 19
};
}

vtkStandardNewMacro(StandardSurfaceModel);

//------------------------------------------------------------------------------
const std::vector<ModelParameter>& StandardSurfaceModel::GetParameters() const
{
  // base is written as 1: it only scales base_color.
  static const std::vector<ModelParameter> parameters = { { "base_color", 3, 0.0, 1.0, 0.8,
                                                            Feature::Core, {} },
    { "metalness", 1, 0.0, 1.0, 0.0, Feature::Core, Metals },
    { "specular_roughness", 1, 0.05, 1.0, 0.2, Feature::Core, Roughnesses },
    { "specular", 1, 0.0, 1.0, 1.0, Feature::Specular, { 0.9 } },
    { "specular_color", 3, 0.0, 1.0, 1.0, Feature::Specular, { 0.8 } },
    { "specular_IOR", 1, 1.0, 3.0, 1.5, Feature::Specular, { 1.5, 2.0 }, 2.0 },
    { "coat", 1, 0.0, 1.0, 0.0, Feature::Coat, { 0.5 } },
    { "coat_roughness", 1, 0.05, 1.0, 0.1, Feature::Coat, { 0.12, 0.35 } },
    { "coat_IOR", 1, 1.0, 3.0, 1.5, Feature::Coat, { 1.5 }, 2.0 },
    { "sheen", 1, 0.0, 1.0, 0.0, Feature::Sheen, { 0.2 } },
    { "sheen_color", 3, 0.0, 1.0, 1.0, Feature::Sheen, { 0.5 } },
    { "sheen_roughness", 1, 0.05, 1.0, 0.3, Feature::Sheen, { 0.3, 0.7 } },
    { "specular_anisotropy", 1, 0.0, 0.98, 0.0, Feature::Anisotropy, { 0.4 } },
    { "specular_rotation", 1, 0.0, 0.5, 0.0, Feature::Anisotropy, { 0.03, 0.27 } } };
  return parameters;
}

//------------------------------------------------------------------------------
glm::dvec3 StandardSurfaceModel::Shade(const Directions& directions) const
{
  const double anisotropy = this->Values[Anisotropy];
  // specular_rotation is in turns, and clockwise about the normal: MaterialX' rotate3d turns so.
  const double angle = anisotropy > 0.0 ? -2.0 * Pi * this->Values[Rotation] : 0.0;
  const Directions d = angle == 0.0
                         ? directions
                         : Directions(Turn(directions.Light, angle), Turn(directions.View, angle));
  const Widths widths = GetStandardWidths(this->Values[Roughness], anisotropy);
  const glm::dvec3 base = this->ColorAt(BaseColor);
  const glm::dvec3 specularColor = this->ColorAt(SpecularColor);
  const double specular = this->Values[Specular];

  const Layer sheen = GetContyKullaSheen(
    d, this->Values[Sheen], this->ColorAt(SheenColor), this->Values[SheenRoughness]);
  const Layer dielectric =
    GetDielectric(d, specular, specularColor, this->Values[SpecularIndex], widths);
  glm::dvec3 f = Over(dielectric, Over(sheen, base / Pi));
  const double metalness = this->Values[Metalness];
  if (metalness > 0.0)
  {
    f = glm::mix(f, GetConductor(d, base, specular * specularColor, widths), metalness);
  }
  const Layer coat = GetDielectric(d, this->Values[Coat], glm::dvec3(1.0), this->Values[CoatIndex],
    GetStandardWidths(this->Values[CoatRoughness], 0.0));
  return Over(coat, f);
}
} // namespace tool
