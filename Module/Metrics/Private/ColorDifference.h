// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The visible difference between two colors: CIELAB's Delta E 2000.
 */

#ifndef ColorDifference_h
#define ColorDifference_h

#include <glm/glm.hpp>

namespace measuredbrdf
{
using Color = glm::dvec3;

/// Linear Rec. 709 to XYZ, divided by the XYZ of white (1,1,1), D65; and back.
Color ToRelativeXYZ(const Color& linear);
Color FromRelativeXYZ(const Color& xyz);

/// XYZ, divided by that of white, to CIELAB (CIE 15); L* is in [0,100] up to white.
Color ToLab(const Color& relativeXYZ);

/**
 * CIEDE2000 of two CIELAB colors, k_L = k_C = k_H = 1; a difference of 1 is just visible (CIE
 * 142:2001; branches of the hue as in Sharma, Wu, Dalal 2005).
 */
double GetDeltaE2000(const Color& lab1, const Color& lab2);
} // namespace measuredbrdf

#endif
