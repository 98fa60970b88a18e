// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The values of a half/difference-angle table of an isotropic material.
 */

#ifndef HalfDifferenceFill_h
#define HalfDifferenceFill_h

#include <vector>

class vtkBRDF;
class vtkTabulatedBRDF;

namespace measuredbrdf
{
/// Fills output as vtkBRDFResampler describes: dimensions of phi_d, theta_d and theta_h. Where f is
/// the same on both sides of the plane that i and o are mirrored at, as of nearly all isotropic
/// materials, half of the cells are evaluated. wanted, by cell: the others stay 0; null: all. On
/// several threads.
void FillHalfDifference(vtkBRDF* input, bool reciprocal, const int dimensions[3],
  vtkTabulatedBRDF* output, const std::vector<char>* wanted = nullptr);
} // namespace measuredbrdf

#endif
