// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures beside the reference: what `compare` and `export` write.
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
 * Method, reference, signed error and VTK's shading beside each other, as PNG. rgb, reference: the
 * method's and the exact radiance of the grid's pixels, 3 doubles each.
 */
void WriteComparisonSheet(const std::string& path, const std::string& title, const Grid& grid,
  const std::vector<double>& rgb, const std::vector<double>& reference,
  const ComparedPicture& method, const ComparedPicture& stock);
/// A sphere by a material and by what stands for it, under one light.
struct ComparedLight
{
  std::string Name;
  std::vector<double> Reference; // 3 doubles a pixel of the grid
  std::vector<double> Radiance;
  double RelativeL1;
  double Flip;
};

/**
 * A row for each light: the reference, what stands for it (both with the same exposure) and the
 * signed error, as PNG. The grid is a square that the sphere's disc touches.
 */
void WriteLightSheet(const std::string& path, const std::string& title, const std::string& name,
  const Grid& grid, const std::vector<ComparedLight>& lights);
} // namespace tool

#endif
