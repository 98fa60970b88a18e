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

  /// Kernels at so many view angles, evenly spaced from 0 to KernelViews' last. Null ones where it
  /// was aborted.
  using Kernels = std::vector<std::unique_ptr<KernelHarmonics>>;
  const Kernels& GetKernels(
    vtkBRDF* brdf, int angles, int resolution, const std::atomic<bool>& abort);

  /// The material's views: for a profile, and to be cut into layers.
  const KernelViews& GetViews(vtkBRDF* brdf);

private:
  std::map<std::pair<int, int>, Kernels> KernelsOf; // angles, resolution
  std::unique_ptr<KernelViews> Views;
};
} // namespace measuredbrdf

#endif
