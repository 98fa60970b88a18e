// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Whether a table can hold what a material reflects far from the mirror direction.
 */

#ifndef TailRegularity_h
#define TailRegularity_h

class vtkBRDF;

namespace measuredbrdf
{
/// How far f cos(theta_i) of an isotropic material, 12 degrees and more from the mirror direction,
/// is from the mean of its values at views 3.75 degrees to either side, mirrored about the plane of
/// incidence: the sum of differences by the sum of values, 0 for the smoothest. Noise from cell to
/// cell and lobes without that symmetry have a large one. A thousand evaluations of f, the same
/// ones each time.
double GetTailIrregularity(vtkBRDF* brdf);
} // namespace measuredbrdf

#endif
