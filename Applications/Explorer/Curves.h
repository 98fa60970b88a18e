// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the charts of a material show: f along lines of directions, and its albedo. Without Qt.
 */

#ifndef Curves_h
#define Curves_h

#include "vtkBRDF.h"
#include "vtkBTDF.h"

#include <array>
#include <cstddef>
#include <vector>

namespace explorer
{
/// Values over angles: linear RGB.
struct Curve
{
  std::vector<double> Degrees;
  std::vector<std::array<double, 3>> Values;
};

///@{
/// f in 1/sr over theta_h, theta_d or phi_d (which: 0, 1, 2) through the angles at (degrees), the
/// directions above the horizon (Rusinkiewicz 1998).
Curve SampleSlice(vtkBRDF* brdf, int which, const std::array<double, 3>& at);
///@}

/**
 * f in 1/sr in the plane of incidence of light from theta_i, phi_i (degrees): over the angle from
 * the normal, which is negative on the light's side. Densest about the mirror direction, theta_i.
 * With transmission it goes on below the surface, from 90 to 180 and from -180 to -90, densest
 * where light goes straight on, at 180 - theta_i.
 */
Curve SamplePlaneOfIncidence(
  vtkBRDF* brdf, double thetaI, double phiI, vtkBTDF* transmission = nullptr);

/// The albedo over the angle of view, as tool::InspectMaterial measures it. Takes a while. Throws
/// tool::Error.
Curve SampleAlbedo(vtkBRDF* brdf);

/// What is seen of a white sky on the other side, over the angle of view: tool::InspectMaterial's
/// angles.
Curve SampleTransmittance(vtkBTDF* transmission);
} // namespace explorer

#endif
