// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Autodesk's standard surface (Georgiev, Portsmouth, Zap, Renaud, Hughes 2019), the parts that
 * reflect, as the graph of MaterialX 1.39 (bxdf/standard_surface.mtlx, node definition 1.0.1)
 * builds it: metal or (sheen, diffuse) below a dielectric, all below a coat.
 */

#ifndef StandardSurfaceModel_h
#define StandardSurfaceModel_h

#include "SurfaceModel.h"

namespace tool
{
class StandardSurfaceModel : public SurfaceModel
{
public:
  static StandardSurfaceModel* New();
  vtkTypeMacro(StandardSurfaceModel, SurfaceModel);

  std::string GetTitle() const override { return "standard_surface"; }
  const std::vector<ModelParameter>& GetParameters() const override;

protected:
  StandardSurfaceModel() { this->SetNeutral(); }
  glm::dvec3 Shade(const Directions& directions) const override;
};
} // namespace tool

#endif
