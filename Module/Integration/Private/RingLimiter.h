// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Takes the dark rings about lamps out of maps of radiance.
 */

#ifndef RingLimiter_h
#define RingLimiter_h

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/**
 * What a lobe narrower than a map's texels reflects of a lamp overshoots, and beside the lamp it
 * may fall far below what is around, even below 0. A binomial blur of what is positive shows what
 * is around: values below three quarters of its least within two texels are lifted there, as
 * limiters do in transport schemes (Zalesak 1979). Where radiance is resolved that changes next
 * to nothing.
 *
 * radiance: RGB, maps of rows x columns behind each other, columns around.
 */
void LiftDarkRings(std::vector<float>& radiance, std::size_t rows, std::size_t columns);

/// The same of one map, on this thread. Four nodes away from the first and the last rows and
/// columns it does not count what lies beyond these.
void LiftDarkRingsOfMap(float* radiance, std::size_t rows, std::size_t columns);
} // namespace measuredbrdf

#endif
