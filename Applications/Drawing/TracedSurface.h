// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The radiance of a picture's pixels with occlusion, by rays, and how much it matters.
 */

#ifndef TracedSurface_h
#define TracedSurface_h

#include "Inputs.h"
#include "Scenes.h"
#include "Surface.h"

#include "vtkOcclusionPredictor.h"
#include "vtkTracedScene.h"

#include <vector>

class vtkBRDF;
class vtkEnvironment;

namespace CLI
{
class App;
}

namespace tool
{
struct TraceOptions
{
  int Samples = 512;
  int Bounces = 0;

  /// Add --samples and --bounces to a subcommand.
  void AddTo(CLI::App* command);
};

/// One value a pixel of a surface; radiance has 3.
struct TracedSurface
{
  std::vector<double> Radiance;
  std::vector<double> Unoccluded; // the reference without occlusion
  double Noise = 0.0;             // vtkTracedRadianceIntegrator::GetNoise
};

/// A mesh alone. Throws Error where it has no triangle.
vtkSmartPointer<vtkTracedScene> MakeTracedScene(vtkPolyData* mesh);

/**
 * Trace the pixels of a surface that a camera sees, which has to be placed for that size
 * (OffscreenScene::PlaceCamera). Pixels whose middle just misses the mesh take the nearest point
 * that does not. Throws Error. Needs an Interruptible.
 */
TracedSurface TraceSurface(vtkTracedScene* traced, vtkBRDF* brdf, vtkEnvironment* environment,
  const OffscreenScene& camera, const Surface& surface, const Size& size,
  const TraceOptions& options);

/// The error of leaving occlusion out, as seen from everywhere. Throws Error.
vtkSmartPointer<vtkOcclusionPredictor> PredictOcclusion(
  vtkTracedScene* traced, vtkBRDF* brdf, vtkEnvironment* environment);
} // namespace tool

#endif
