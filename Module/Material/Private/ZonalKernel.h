// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The kernel that blurs a function of theta_h over the sphere of half vectors.
 */

#ifndef ZonalKernel_h
#define ZonalKernel_h

namespace measuredbrdf
{
/// Mean over the azimuth of the von Mises-Fisher distribution of concentration 1/variance about an
/// angle of b from the axis, at an angle of a; times the width sin b of the ring at b. Not
/// normalized.
double GetRingWeight(double a, double b, double variance);

/// Angle beyond which weights are below 1e-7 of the largest.
double GetRingReach(double variance);
} // namespace measuredbrdf

#endif
