// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Values of an image as radiance: +infinity becomes the largest value, negative and other
 * non-finite ones become 0, and all of these are counted.
 */

#ifndef RadianceValues_h
#define RadianceValues_h

#include "vtkType.h" // for vtkIdType

#include <vector>

class vtkDataArray;

namespace measuredbrdf
{
struct BadValues
{
  vtkIdType Negative = 0;
  vtkIdType NotFinite = 0;
};

/// What +infinity is taken as: a half float that is too large is stored so, the sun as a rule. It
/// is the largest half float or, where values are larger, the largest of them: sums of the largest
/// float would be infinite.
float GetLargestValue(const std::vector<float>& values);

/// In threads.
BadValues CleanRadiance(std::vector<float>& values);

/// RGB from the first tuples of an array of any type with 1 (gray), 3 or more components; integers
/// are scaled by their maximum, sRGB is made linear.
BadValues DecodeRadiance(
  vtkDataArray* scalars, vtkIdType numberOfTuples, bool sRGB, std::vector<float>& rgb);
} // namespace measuredbrdf

#endif
