// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The pixels of a sphere that is seen from far away, without a display.
 */

#ifndef SpherePicture_h
#define SpherePicture_h

#include "Sizes.h"
#include "Surface.h"

#include <array>

namespace tool
{
/// The direction to the viewer of an azimuth and an elevation, as OffscreenScene::SetView has them.
std::array<double, 3> GetViewDirection(const View& view);

/// Every pixel of a square picture of that size that a sphere covers, which touches its sides.
Surface MakeSphereSurface(int size, const View& view);
} // namespace tool

#endif
