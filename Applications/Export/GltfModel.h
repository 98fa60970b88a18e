// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * glTF 2.0's metallic-roughness material with four extensions.
 *
 * The core is appendix B of the specification (Khronos 2021), in its normative form: a mix of a
 * metal and of a dielectric. KHR_materials_specular, _clearcoat, _sheen and _anisotropy are as
 * their specifications define them (all ratified by Khronos).
 */

#ifndef GltfModel_h
#define GltfModel_h

#include "SurfaceModel.h"

namespace tool
{
class GltfModel : public SurfaceModel
{
public:
  static GltfModel* New();
  vtkTypeMacro(GltfModel, SurfaceModel);

  std::string GetTitle() const override { return "glTF metallic-roughness"; }
  const std::vector<ModelParameter>& GetParameters() const override;

protected:
  GltfModel() { this->SetNeutral(); }
  glm::dvec3 Shade(const Directions& directions) const override;

private:
  double GetSpecular(const Directions& directions, double alpha) const;
  double GetSheenScale(const Directions& directions) const;
};

///@{
/// The sheen lobe D V of KHR_materials_sheen (Estevez and Kulla 2017), and its directional albedo
/// by a table that is computed once.
double GetCharlieSheen(double ndl, double ndv, double ndh, double roughness);
double GetCharlieAlbedo(double ndv, double roughness);
///@}
} // namespace tool

#endif
