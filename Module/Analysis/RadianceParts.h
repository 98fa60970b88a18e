// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What tables of radiance of one material under one environment have in common, whatever their
 * sizes: a planner, which tries many, has it made once. Private to the module.
 */

#ifndef RadianceParts_h
#define RadianceParts_h

#include "EnvironmentHarmonics.h"
#include "KernelHarmonics.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <atomic>
#include <map>
#include <memory>
#include <utility>
#include <vector>

class vtkBRDF;
class vtkEnvironment;
class vtkLightSet;

namespace measuredbrdf
{
/// For one material under one environment (and what its lamps leave), while neither changes; not
/// for two threads at a time. Some 10 MB: not to be kept with a plan.
class RadianceParts
{
public:
  RadianceParts();
  ~RadianceParts();

  /// An environment's lamps as lights (null: none), and what they leave.
  struct Lamps
  {
    vtkSmartPointer<vtkLightSet> Lights;
    vtkSmartPointer<vtkEnvironment> Rest;
  };
  /// BrightTexels::FindLamps.
  const Lamps& GetLamps(vtkEnvironment* environment, double angle, int maximum);

  /// Up to the given degree at least.
  const EnvironmentHarmonics& GetHarmonics(vtkEnvironment* environment, int degree);

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

private:
  static void Make(vtkBRDF* brdf, const std::vector<double>& angles, int resolution,
    const std::atomic<bool>& abort, Kernels& kernels);

  std::map<std::pair<double, int>, Lamps> LampsOf;
  std::map<vtkEnvironment*, std::unique_ptr<EnvironmentHarmonics>> Harmonics;
  std::map<std::pair<int, int>, Kernels> KernelsOf; // angles, resolution
  Kernels Profile;
};
} // namespace measuredbrdf

#endif
