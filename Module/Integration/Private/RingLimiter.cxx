// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RingLimiter.h"

#include "vtkSMPTools.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
constexpr float LeastShare = 0.75f; // of the blur's least

// Three rows or columns, combined value by value.
template <typename Combine>
void CombineColumns(const std::vector<float>& in, std::size_t columns, std::vector<float>& out,
  const Combine& combine)
{
  const std::size_t width = 3 * columns;
  for (std::size_t first = 0; first < in.size(); first += width)
  {
    for (std::size_t k = 0; k < width; ++k)
    {
      out[first + k] = combine(in[first + (k < 3 ? k + width - 3 : k - 3)], in[first + k],
        in[first + (k + 3 < width ? k + 3 : k + 3 - width)]);
    }
  }
}

// Beyond a pole the meridian opposite goes on.
template <typename Combine>
void CombineRows(const std::vector<float>& in, std::size_t columns, std::vector<float>& out,
  const Combine& combine)
{
  const std::size_t width = 3 * columns;
  const std::size_t half = columns / 2 * 3;
  const std::size_t last = in.size() - width;
  for (std::size_t k = 0; k < in.size(); ++k)
  {
    const std::size_t opposite = (k % width + half) % width;
    out[k] = combine(in[k < width ? width + opposite : k - width], in[k],
      in[k < last ? k + width : last - width + opposite]);
  }
}
}

void LiftDarkRings(std::vector<float>& radiance, std::size_t rows, std::size_t columns)
{
  const std::size_t size = 3 * rows * columns;
  vtkSMPTools::For(0, static_cast<vtkIdType>(radiance.size() / size), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      const auto blur = [](float a, float b, float c) { return 0.25f * (a + c) + 0.5f * b; };
      const auto least = [](float a, float b, float c) { return std::min(std::min(a, b), c); };
      std::vector<float> first(size), second(size);
      for (vtkIdType map = begin; map < end; ++map)
      {
        float* values = &radiance[static_cast<std::size_t>(map) * size];
        std::transform(
          values, values + size, first.begin(), [](float value) { return std::max(value, 0.0f); });
        for (int pass = 0; pass < 2; ++pass)
        {
          CombineColumns(first, columns, second, blur);
          CombineRows(second, columns, first, blur);
        }
        for (int pass = 0; pass < 2; ++pass) // as far as the blur reaches: edges do not bleed
        {
          CombineColumns(first, columns, second, least);
          CombineRows(second, columns, first, least);
        }
        for (std::size_t k = 0; k < size; ++k)
        {
          if (first[k] > 0.0f) // else it is negative all around: f is less than the Lambert part
          {
            values[k] = std::max(values[k], LeastShare * first[k]);
          }
        }
      }
    });
}
} // namespace measuredbrdf
