// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An anisotropic material's lobes in a few numbers, over the view's polar angle and azimuth.
 */

#ifndef AnisotropicViews_h
#define AnisotropicViews_h

#include "LobeMeans.h"

#include <glm/glm.hpp>

#include <atomic>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class AnisotropicViews
{
public:
  static constexpr int Angles = 24;   // polar angles; they crowd towards the horizon, as LobeViews'
  static constexpr int Azimuths = 16; // over the period

  /// A view at a polar angle and an azimuth, in radians.
  static glm::dvec3 GetView(double theta, double phi);

  /// Of a prepared BRDF. Of no use where it was aborted.
  AnisotropicViews(vtkBRDF* brdf, const std::atomic<bool>& abort);

  /// How often f repeats itself while the sample is turned once about its normal: 1 or 2.
  int GetPeriods() const { return this->Periods; }

  static double GetAngle(int index);

  /// Of so many azimuths over the period; those of the views where none are said. In radians.
  double GetAzimuth(int index, int count = Azimuths) const;

  const LobeMeans& Get(int angle, int azimuth) const;

private:
  int Periods;
  std::vector<LobeMeans> Means;
};
} // namespace measuredbrdf

#endif
