// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The coordinates in which vtkAdaptiveWarpBRDF's tables are looked up, of many lights and one view,
 * where nothing depends on the light's azimuth. In single precision, one light beside the other, so
 * that vectors of any width take them. Private to the module.
 */

#ifndef WarpLanes_h
#define WarpLanes_h

#include "WideVectors.h"

namespace measuredbrdf
{
/// Of each light: theta_i, and by the tables' units theta_i, theta_h and phi_h - phi_i.
struct WarpLanes
{
  static constexpr int Most = 64; // a multiple of every vector's width
  float Theta[Most];
  float UnitTheta[Most];
  float UnitThetaH[Most];
  float UnitPhiH[Most]; // in [0,1]
};

/// lights: x, y and z of unit vectors above the horizon, 1 to WarpLanes::Most. To 1e-6 rad;
/// where the half vector is nearly the normal, its azimuth is less exact. Lanes behind the last
/// light are filled up to a multiple of 16. form: one that the processor has.
void FindWarpLanes(int count, const float* const lights[3], const double view[3], WarpLanes& lanes,
  VectorForm form = GetWidestForm());
} // namespace measuredbrdf

#endif
