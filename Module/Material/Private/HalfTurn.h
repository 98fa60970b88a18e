// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Whether an anisotropic material repeats itself.
 */

#ifndef HalfTurn_h
#define HalfTurn_h

class vtkBRDF;

namespace measuredbrdf
{
/// Whether f is the same where the sample is turned by half a turn about its normal, by 128 pairs
/// of directions: brushed metal is; cloth with a nap is not.
bool IsSameAfterHalfATurn(vtkBRDF* brdf);
} // namespace measuredbrdf

#endif
