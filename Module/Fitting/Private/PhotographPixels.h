// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A photograph as linear values, with what each pixel is good for.
 */

#ifndef PhotographPixels_h
#define PhotographPixels_h

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkPhotographSet;

namespace measuredbrdf
{
enum class PixelState : std::uint8_t
{
  Valid,
  Saturated,
  Black,
  Invalid // not finite
};

struct PhotographPixels
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Values;      // RGB, linear, row 0 at the bottom; 0 where a pixel is not valid
  std::vector<PixelState> States; // of each pixel

  std::array<std::uint64_t, 4> CountStates() const;
};

/// Make a photograph's picture and decode it. Returns "", or what is wrong, without its name.
std::string ReadPhotograph(vtkPhotographSet* set, int index, PhotographPixels& pixels);
} // namespace measuredbrdf

#endif
