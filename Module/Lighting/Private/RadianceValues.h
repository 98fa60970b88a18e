// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Values of an image as radiance: negative and non-finite ones become 0 and are counted. Private to
 * the module.
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

/// In threads.
BadValues CleanRadiance(std::vector<float>& values);

/// RGB from the first tuples of an array of any type with 1 (gray), 3 or more components; integers
/// are scaled by their maximum, sRGB is made linear.
BadValues DecodeRadiance(
  vtkDataArray* scalars, vtkIdType numberOfTuples, bool sRGB, std::vector<float>& rgb);
} // namespace measuredbrdf

#endif
