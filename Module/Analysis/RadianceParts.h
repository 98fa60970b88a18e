// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What tables of radiance of one material have in common, whatever their sizes and the light: a
 * planner, which tries many, has it made once. Private to the module.
 */

#ifndef RadianceParts_h
#define RadianceParts_h

#include "KernelHarmonics.h"
#include "KernelLayers.h"

#include <atomic>
#include <map>
#include <memory>
#include <utility>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
/// For one material while it does not change; not for two threads at a time.
class RadianceParts
{
public:
  RadianceParts();
  ~RadianceParts();

  /// Kernels at so many view angles, evenly spaced from 0 to LastView, which is the lowest view
  /// that is told apart. Null ones where it was aborted.
  using Kernels = std::vector<std::unique_ptr<KernelHarmonics>>;
  const Kernels& GetKernels(
    vtkBRDF* brdf, int angles, int resolution, const std::atomic<bool>& abort);
  static double GetLastView();

  /// The same at the ProfileSize view angles of a profile, which crowd towards the horizon.
  static constexpr int ProfileSize = 64;
  static double GetProfileAngle(int index);
  const Kernels& GetProfile(vtkBRDF* brdf, const std::atomic<bool>& abort);

  /// The material's views, to be cut into layers.
  const KernelViews& GetViews(vtkBRDF* brdf);

private:
  static void Make(vtkBRDF* brdf, const std::vector<double>& angles, int resolution,
    const std::atomic<bool>& abort, Kernels& kernels);

  std::map<std::pair<int, int>, Kernels> KernelsOf; // angles, resolution
  Kernels Profile;
  std::unique_ptr<KernelViews> Views;
};
} // namespace measuredbrdf

#endif
