// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a pixel costs: its fetches and arithmetic, times those of a table's pixel.
 *
 * Measured in nanoseconds on Mesa's llvmpipe, on 2 cores, from whole spheres
 * (docs/methods/pixel-cost.md). They only order the candidates of a planner. A graphics card has
 * other shares: an NVIDIA H200 has 0.7 for a pixel without its table, 0.3 for a light, 0.7 for a
 * sample, 0.3 for a function and 0.2 for a map (docs/graphics-card.md).
 */

#ifndef PixelCosts_h
#define PixelCosts_h

namespace measuredbrdf
{
namespace PixelCosts
{
constexpr double Table = 1.0;               // with the pixel itself
constexpr double Nanosecond = 1.0 / 107.0;  // of the 107 that it takes
constexpr double Pixel = 55.0 * Nanosecond; // without a table
constexpr double Light = 20.0 * Nanosecond; // each, and likewise
constexpr double Sample = 28.0 * Nanosecond;
constexpr double Function = 12.0 * Nanosecond;
constexpr double Tiles = 0.05; // of a table: a fetch more
constexpr double Map = 7.0 * Nanosecond;
} // namespace PixelCosts
} // namespace measuredbrdf

#endif
