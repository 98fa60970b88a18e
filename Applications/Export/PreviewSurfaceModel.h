// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * UsdPreviewSurface with the metallic workflow (UsdPreviewSurface specification 2.6). The
 * specification names the inputs and leaves the formulas to the renderer; these are of the shader
 * that OpenUSD publishes, usdShaders/shaders/previewSurface.glslfx (Pixar), without the constant
 * 0.001 that it adds against divisions by zero.
 */

#ifndef PreviewSurfaceModel_h
#define PreviewSurfaceModel_h

#include "SurfaceModel.h"

namespace tool
{
class PreviewSurfaceModel : public SurfaceModel
{
public:
  static PreviewSurfaceModel* New();
  vtkTypeMacro(PreviewSurfaceModel, SurfaceModel);

  std::string GetTitle() const override { return "UsdPreviewSurface"; }
  const std::vector<ModelParameter>& GetParameters() const override;

protected:
  PreviewSurfaceModel() { this->SetNeutral(); }
  glm::dvec3 Shade(const Directions& directions) const override;
};
} // namespace tool

#endif
