// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * OpenPBR Surface 1.1 (Academy Software Foundation 2024), the parts that reflect, as the graph of
 * MaterialX 1.39 (bxdf/open_pbr_surface.mtlx) builds it: metal or diffuse below a dielectric, a
 * coat that darkens and roughens what is below, fuzz on top.
 */

#ifndef OpenPbrModel_h
#define OpenPbrModel_h

#include "SurfaceModel.h"

namespace tool
{
class OpenPbrModel : public SurfaceModel
{
public:
  static OpenPbrModel* New();
  vtkTypeMacro(OpenPbrModel, SurfaceModel);

  std::string GetTitle() const override { return "open_pbr_surface"; }
  const std::vector<ModelParameter>& GetParameters() const override;

protected:
  OpenPbrModel() { this->SetNeutral(); }
  glm::dvec3 Shade(const Directions& directions) const override;

private:
  double GetRoughness() const;
  double GetIndex() const;
  glm::dvec3 GetDarkening() const;
};
} // namespace tool

#endif
