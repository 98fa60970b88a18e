// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pixels of a surface against the reference: what `compare` and `chart` measure.
 */

#ifndef Measuring_h
#define Measuring_h

#include "Inputs.h"
#include "Picture.h"
#include "Surface.h"

#include "vtkRadianceMetrics.h"

#include <functional>
#include <string>
#include <vector>

class vtkBRDF;
class vtkEnvironment;

namespace tool
{
/// The surface's pixels as pixels of a small picture: one each of its grid.
struct Grid
{
  Grid(const Surface& surface, const Size& size);

  /// Linear RGB, 3 doubles a pixel of the surface; alpha 1 where there is one.
  Picture Draw(const std::vector<double>& rgb) const;

  const tool::Surface& Surface;
  int ImageWidth;
  int Width;
  int Height;
};

/// A figure of vtkRadianceMetrics: the one whose name a report gives it.
struct Metric
{
  std::string Name;
  std::string Label; // for people
  bool Relative;     // a share, shown in percent
  std::function<double(vtkRadianceMetrics*)> Get;
};

/// Those that a report holds; relative_l1, which tolerances are about, is the first.
const std::vector<Metric>& GetMetrics();

/// Compare radiance of a surface's pixels with a reference, 3 doubles each. Throws Error. Needs an
/// Interruptible.
void Measure(vtkRadianceMetrics* metrics, const Grid& grid, const std::vector<double>& rgb,
  const std::vector<double>& reference);

/// The reference radiance of a surface's pixels, 3 doubles each, under a progress bar. Throws
/// Error. Needs an Interruptible.
std::vector<double> IntegrateReference(
  vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface);

///@{
/// Figures for people, with 3 digits: a share in percent, a time in milliseconds.
std::string FormatPercent(double share);
std::string FormatMilliseconds(double value);
///@}
} // namespace tool

#endif
