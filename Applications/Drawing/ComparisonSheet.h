// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A method and VTK's shading against the exact sum, as pictures: what `compare` writes.
 */

#ifndef ComparisonSheet_h
#define ComparisonSheet_h

#include "Measuring.h"
#include "Picture.h"

#include <string>
#include <vector>

namespace tool
{
/// What was drawn, and the figures that its caption gives.
struct ComparedPicture
{
  std::string Name;
  Picture Drawn;
  double RelativeL1;
  double Frame; // ms
  double Setup; // ms
};

/**
 * Method, exact sum, signed error and VTK's shading beside each other, as PNG. rgb, reference: the
 * method's and the exact radiance of the grid's pixels, 3 doubles each.
 */
void WriteComparisonSheet(const std::string& path, const std::string& title, const Grid& grid,
  const std::vector<double>& rgb, const std::vector<double>& reference,
  const ComparedPicture& method, const ComparedPicture& stock);
} // namespace tool

#endif
