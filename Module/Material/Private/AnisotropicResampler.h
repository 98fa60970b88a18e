// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Measured anisotropic materials as tables for graphics cards. Private to the module.
 */

#ifndef AnisotropicResampler_h
#define AnisotropicResampler_h

#include "vtkAnisotropicTabulatedBRDF.h"
#include "vtkSmartPointer.h"

namespace measuredbrdf
{
/**
 * A table of f cos(theta_o) whose relative L2 error (vtkBRDFResampler::GetRelativeL2Error) is
 * within the tolerance, or the best of seven sizes, the largest of 1.8 million cells (10.6 MB as
 * 16-bit RGB; half as many where half a turn changes nothing). Its ResamplingError holds the error,
 * of pairs that chose nothing.
 */
vtkSmartPointer<vtkAnisotropicTabulatedBRDF> ResampleAnisotropic(vtkBRDF* source, double tolerance);

/// The smallest of these sizes; its error is not measured.
vtkSmartPointer<vtkAnisotropicTabulatedBRDF> ResampleAnisotropicQuickly(vtkBRDF* source);
} // namespace measuredbrdf

#endif
