// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * VTK's physically based shading of one light, as in its fragment shader (VTK 9.1 to 9.6:
 * vtkPBRFunctions.glsl and vtkOpenGLPolyDataMapper::ReplaceShaderLight). Image-based lighting
 * approximates the sum of this over all directions.
 */

#ifndef VtkPbrModel_h
#define VtkPbrModel_h

#include "SurfaceModel.h"

namespace tool
{
class VtkPbrModel : public SurfaceModel
{
public:
  static VtkPbrModel* New();
  vtkTypeMacro(VtkPbrModel, SurfaceModel);

  std::string GetTitle() const override { return "VTK's PBR"; }
  const std::vector<ModelParameter>& GetParameters() const override;

protected:
  VtkPbrModel() { this->SetNeutral(); }
  glm::dvec3 Shade(const Directions& directions) const override;

private:
  double GetBaseLobe(const Directions& directions) const;
};
} // namespace tool

#endif
