// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MagmaColors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t Last = 17;
constexpr unsigned char Colors[Last + 1][3] = { { 0, 0, 4 }, { 9, 7, 32 }, { 26, 16, 66 },
  { 49, 17, 101 }, { 74, 16, 121 }, { 98, 25, 128 }, { 121, 34, 130 }, { 145, 43, 129 },
  { 170, 51, 125 }, { 194, 59, 117 }, { 217, 70, 107 }, { 236, 88, 96 }, { 247, 114, 92 },
  { 252, 142, 100 }, { 254, 170, 116 }, { 254, 198, 138 }, { 253, 226, 163 }, { 252, 253, 191 } };
}

//------------------------------------------------------------------------------
std::array<unsigned char, 3> GetMagmaColor(double value)
{
  const double at = std::clamp(value, 0.0, 1.0) * Last;
  const std::size_t k = std::min(static_cast<std::size_t>(at), Last - 1);
  const double weight = at - static_cast<double>(k);
  std::array<unsigned char, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
  {
    const double mixed = Colors[k][c] + weight * (Colors[k + 1][c] - Colors[k][c]);
    color[c] = static_cast<unsigned char>(std::lround(mixed));
  }
  return color;
}
} // namespace measuredbrdf
