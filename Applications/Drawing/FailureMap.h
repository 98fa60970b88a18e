// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The picture of compare --failure-map: at which angles a material or a method fails.
 */

#ifndef FailureMap_h
#define FailureMap_h

#include <string>
#include <vector>

class vtkBRDFFailureMap;

namespace tool
{
/// Error of radiance at the views between two polar angles; shares, relative to the mean radiance
/// there.
struct ViewError
{
  double Begin; // degrees
  double End;
  std::size_t NumberOfPixels;
  double RelativeL1;
  double P99; // 99th percentile of the pixels' own relative errors
};

/// Of radiance and its reference (3 values a pixel), by the angle between normal and view (3 values
/// each), in equal steps; those without a pixel or light are left out.
std::vector<ViewError> MeasureViews(const std::vector<double>& normals,
  const std::vector<double>& views, const std::vector<double>& rgb,
  const std::vector<double>& reference);

/**
 * Both maps of f, in the first of them the places of the worst angles, and the errors of radiance
 * over theta_o, as PNG. Colors: viridis of the logarithm, 0.1 % to 100 % in every picture, so that
 * two of them compare. note: what was compared, below the title. Throws Error.
 */
void WriteFailureMap(const std::string& path, const std::string& title, const std::string& note,
  const std::string& method, vtkBRDFFailureMap* map, const std::vector<ViewError>& views);
} // namespace tool

#endif
