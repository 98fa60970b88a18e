// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The coordinates in which vtkAdaptiveWarpBRDF's tables are looked up, of many lights and one view
 * at a time, where nothing depends on the light's azimuth. Private to the module.
 */

#ifndef WarpAngles_h
#define WarpAngles_h

#include "HalfVector.h"
#include "WideVectors.h"

namespace measuredbrdf
{
/// Of each light: theta_i, and by the tables' units theta_i, theta_h and phi_h - phi_i.
struct WarpAngles
{
  static constexpr int Most = 64;
  double Theta[Most];
  double UnitTheta[Most];
  double UnitThetaH[Most];
  double UnitPhiH[Most]; // in [0,1]
};

/// lights: 3 each, unit vectors like the view, at most WarpAngles::Most. To 1e-10 rad. form: one
/// that the processor has.
void FindWarpAngles(int count, const double* lights, const double view[3], WarpAngles& angles,
  VectorForm form = GetWidestForm());
} // namespace measuredbrdf

#endif
