// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The reference radiance of pixels together with their neighbors, which takes less time.
 */

#ifndef PixelBlocks_h
#define PixelBlocks_h

#include "Surface.h"

#include <cstddef>
#include <functional>
#include <vector>

class vtkAdaptiveRadianceIntegrator;

namespace tool
{
/**
 * Of some pixels of a surface in a picture of that width: 3 doubles each. The blocks of 2 x 2
 * pixels in which they lie are integrated as a whole, each once, and always the same ones: a
 * pixel's radiance does not depend on which others are asked for. places: the surface's pixel at
 * each place of the picture, -1 where there is none. Of an isotropic material. show gets the share
 * done. Throws Error. Needs an Interruptible.
 */
std::vector<double> IntegrateInBlocks(vtkAdaptiveRadianceIntegrator* integrator,
  const Surface& surface, int width, const std::vector<int>& places, const std::vector<int>& pixels,
  const std::function<void(double)>& show);

/// The same of each pixel by itself. Of any material.
std::vector<double> IntegratePixels(vtkAdaptiveRadianceIntegrator* integrator,
  const Surface& surface, const std::vector<int>& pixels, const std::function<void(double)>& show);

/// How many pixels these blocks hold, any that are not covered among them.
std::size_t CountInBlocks(const Surface& surface, int width, const std::vector<int>& pixels);
} // namespace tool

#endif
