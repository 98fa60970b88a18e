// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Colors of relative errors, the same in every picture, so that two of them compare.
 */

#ifndef ErrorColors_h
#define ErrorColors_h

#include "vtkColorTransferFunction.h"
#include "vtkSmartPointer.h"

namespace tool
{
constexpr double LowestError = -3.0; // 0.1 %, as a decimal logarithm
constexpr double HighestError = 0.0; // 100 %

/// Viridis over the decimal logarithm of the error; light gray below its range.
vtkSmartPointer<vtkColorTransferFunction> MakeErrorColors();
} // namespace tool

#endif
