// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One mesh with one measured material, rendered off screen into a float picture.
 */

#ifndef Scene_h
#define Scene_h

#include "Inputs.h"
#include "Methods.h"
#include "OffscreenScene.h"
#include "vtkMeasuredBRDFMapper.h"

#include <cstddef>
#include <memory>
#include <string>

class vtkMeasuredBRDFMapper;
class vtkRadianceIntegrator;

namespace tool
{
class ProgressBar;

class Scene : public OffscreenScene
{
public:
  Scene();
  ~Scene() override;

  void SetMaterial(vtkBRDF* brdf);

  /// The environment and what integrates it; null: what the mapper plans. Planning shows a progress
  /// bar, and Ctrl-C stops it where there is an Interruptible.
  void SetLight(vtkEnvironment* environment, vtkRadianceIntegrator* integrator);
  void SetLight(vtkEnvironment* environment, const LightSetOptions& lights);

  /// These lights instead of what SetLight has set, until null is set.
  void SetLightSet(vtkLightSet* lights);

  /// How what the mesh hides of the environment is drawn, where another way than the mapper's
  /// default is wanted; black, or with a bounce. References have nothing hidden: what is compared
  /// with them is drawn with OCCLUSION_OFF.
  void ModelOcclusion(vtkMeasuredBRDFMapper::OcclusionModeType mode, bool bounce);

  /// How the mapper plans.
  void SetPlan(const PlanOptions& options);

  /// Draw a first frame of the size that is open. Of a planned method, its integrator and its
  /// planner are those that were drawn. Throws Error.
  void Begin(Method& method, vtkEnvironment* environment, const PlanOptions& options);

  /// What the mapper says that it has planned for the last frame, and of what the mesh hides.
  std::string GetPlan();

  /// Draw with the method that Begin has found, and with what the mesh hides as in that frame, also
  /// where the picture's size would be planned for anew.
  void HoldPlan(const Method& method, vtkEnvironment* environment);

  /// What a picture of that size shows, as the mapper plans for it.
  void Look(int width, int height, VisiblePairs& seen);

  std::size_t GetTextureBytes();

private:
  explicit Scene(vtkMeasuredBRDFMapper* mapper);
  void OnProgress(vtkObject*, unsigned long, void* share);

  vtkSmartPointer<vtkMeasuredBRDFMapper> Mapper;
  vtkSmartPointer<vtkRadianceIntegrator> Integrator; // of SetLight
  std::unique_ptr<ProgressBar> Bar;
};

/// Put the scene over a backdrop; both scaled by exposure. Alpha becomes 1.
void ComposeOver(
  Picture& picture, const OffscreenScene& scene, const Backdrop& backdrop, double exposure);
} // namespace tool

#endif
