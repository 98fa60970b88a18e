// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How far two colors are apart for a person: CIELAB's Delta E 2000 and BT.2124's Delta E ITP.
 */

#ifndef ColorDifference_h
#define ColorDifference_h

#include <array>

namespace measuredbrdf
{
using Color = std::array<double, 3>;

/// Linear Rec. 709 -> XYZ over that of white (1,1,1), D65; and back.
Color ToRelativeXYZ(const Color& linear);
Color FromRelativeXYZ(const Color& xyz);

/// XYZ over that of white -> CIELAB (CIE 15), L* in [0,100] up to white.
Color ToLab(const Color& relativeXYZ);

/**
 * CIEDE2000 of two CIELAB colors, k_L = k_C = k_H = 1, 1 about what can just be told apart (CIE
 * 142:2001; branches of the hue as in Sharma, Wu, Dalal 2005).
 */
double GetDeltaE2000(const Color& lab1, const Color& lab2);

/// Delta E ITP (ITU-R BT.2124) of linear Rec. 709 in cd/m2, 1 about what can just be told apart.
double GetDeltaEITP(const Color& linear1, const Color& linear2);
} // namespace measuredbrdf

#endif
