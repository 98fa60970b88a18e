// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One mesh with one measured material, rendered off screen into a float picture.
 */

#ifndef Scene_h
#define Scene_h

#include "Inputs.h"
#include "OffscreenScene.h"

#include <cstddef>

class vtkMeasuredBRDFMapper;
class vtkRadianceIntegrator;

namespace tool
{
class Scene : public OffscreenScene
{
public:
  Scene();
  ~Scene() override;

  void SetMaterial(vtkBRDF* brdf);
  void SetLight(vtkEnvironment* environment, const LightSetOptions& lights);

  /// These lights instead of an environment's, until null is set.
  void SetLightSet(vtkLightSet* lights);

  /// The environment, integrated by this one instead of a light set, until null is set.
  void SetLight(vtkEnvironment* environment, vtkRadianceIntegrator* integrator);

  std::size_t GetTextureBytes();

private:
  explicit Scene(vtkMeasuredBRDFMapper* mapper);

  vtkSmartPointer<vtkMeasuredBRDFMapper> Mapper;
};

/// Put the scene over a backdrop; both scaled by exposure. Alpha becomes 1.
void ComposeOver(
  Picture& picture, const OffscreenScene& scene, const Backdrop& backdrop, double exposure);
} // namespace tool

#endif
