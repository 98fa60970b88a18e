// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How far two colours are apart for a person: CIELAB's Delta E 2000 and BT.2124's Delta E ITP.
 */

#ifndef ColourDifference_h
#define ColourDifference_h

#include <array>

namespace measuredbrdf
{
using Colour = std::array<double, 3>;

/// Linear Rec. 709 -> XYZ over that of white (1,1,1), D65; and back.
Colour ToRelativeXYZ(const Colour& linear);
Colour FromRelativeXYZ(const Colour& xyz);

/// XYZ over that of white -> CIELAB (CIE 15), L* in [0,100] up to white.
Colour ToLab(const Colour& relativeXYZ);

/**
 * CIEDE2000 of two CIELAB colours, k_L = k_C = k_H = 1, 1 about what can just be told apart (CIE
 * 142:2001; branches of the hue as in Sharma, Wu, Dalal 2005).
 */
double GetDeltaE2000(const Colour& lab1, const Colour& lab2);

/// Delta E ITP (ITU-R BT.2124) of linear Rec. 709 in cd/m2, 1 about what can just be told apart.
double GetDeltaEITP(const Colour& linear1, const Colour& linear2);
} // namespace measuredbrdf

#endif
