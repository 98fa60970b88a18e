// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * CIE 1931 XYZ and linear RGB with the primaries of ITU-R BT.709 (sRGB, IEC 61966-2-1), whose white
 * is D65.
 */

#ifndef XYZColor_h
#define XYZColor_h

namespace measuredbrdf
{
constexpr double RGBToXYZ[3][3] = { { 0.4123907993, 0.3575843394, 0.1804807884 },
  { 0.2126390059, 0.7151686788, 0.0721923154 }, { 0.0193308187, 0.1191947798, 0.9505321522 } };
constexpr double XYZToRGB[3][3] = { { 3.2409699419, -1.5373831776, -0.4986107603 },
  { -0.9692436363, 1.8759675015, 0.0415550574 }, { 0.0556300797, -0.2039769589, 1.0569715142 } };
} // namespace measuredbrdf

#endif
