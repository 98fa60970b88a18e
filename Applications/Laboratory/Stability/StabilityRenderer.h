// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The stage of stability cases that draw: every part within reach, and what the shader wrote is
 * looked at before anything is mended.
 */

#ifndef StabilityRenderer_h
#define StabilityRenderer_h

#include "Scenes.h"
#include "Stability.h"
#include "StabilityTools.h"

#include "vtkMeasuredBRDFMapper.h"

class vtkActor;
class vtkRenderer;

namespace tool::stability
{
class StabilityRenderer : public OffscreenScene
{
public:
  /// A unit sphere; the context learns the renderer's name.
  explicit StabilityRenderer(Context& context);

  vtkMeasuredBRDFMapper* GetMapper() { return this->Mapper; }
  vtkActor* GetActor() { return this->Actor; }
  vtkRenderer* GetRenderer() { return this->Renderer; }

  /// The integrator, its material and its environment.
  void SetIntegrator(vtkRadianceIntegrator* integrator);

  /// Radiance, with the camera placed as SetView said, or as it is. Throws Error.
  Picture Draw(int size);
  Picture DrawAsIs(int width, int height);

  /// How many values of the last picture were negative or not finite.
  double GetNumberOfBad() const { return this->NumberOfBad; }

private:
  StabilityRenderer(Context& context, vtkMeasuredBRDFMapper* mapper);

  vtkSmartPointer<vtkMeasuredBRDFMapper> Mapper;
  double NumberOfBad = 0.0;
};

/// A sphere's picture by each method, and by the reference, under one exposure.
Picture MakeSphereSheet(Context& context, const std::string& title, vtkBRDF* brdf,
  vtkEnvironment* environment, const std::vector<MethodUnderTest>& contenders);

/// Covered pixels' radiance; and mean |a - b| / mean b over pixels that both cover.
std::vector<double> GetCovered(const Picture& picture);
double GetPictureDifference(const Picture& a, const Picture& b);
} // namespace tool::stability

#endif
