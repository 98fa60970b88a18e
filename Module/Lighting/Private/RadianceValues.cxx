// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceValues.h"

#include "ParallelFor.h"
#include "SRGB.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace measuredbrdf
{
float GetLargestValue(const std::vector<float>& values)
{
  float largest = 65504.0f;
  for (const float value : values)
  {
    largest = std::isfinite(value) ? std::max(largest, value) : largest;
  }
  return largest;
}

BadValues CleanRadiance(std::vector<float>& values)
{
  std::atomic<vtkIdType> negative(0);
  std::atomic<vtkIdType> notFinite(0);
  ParallelFor(0, static_cast<vtkIdType>(values.size()), 1 << 16,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        const float value = values[k];
        // In this order: NaN fails it, too.
        if (!(value >= 0.0f && value <= std::numeric_limits<float>::max()))
        {
          ++(std::isfinite(value) ? negative : notFinite);
          values[k] = value > 0.0f ? value : 0.0f;
        }
      }
    });
  if (notFinite > 0)
  {
    const float largest = GetLargestValue(values);
    std::replace_if(
      values.begin(), values.end(), [largest](float value) { return value > largest; }, largest);
  }
  return { negative, notFinite };
}

BadValues DecodeRadiance(
  vtkDataArray* scalars, vtkIdType numberOfTuples, bool sRGB, std::vector<float>& rgb)
{
  const int type = scalars->GetDataType();
  const double largest = scalars->GetDataTypeMax();
  const double scale = type == VTK_FLOAT || type == VTK_DOUBLE ? 1.0 : 1.0 / largest;
  const auto decode = [sRGB, scale](float raw)
  {
    const double value = raw * scale;
    return static_cast<float>(sRGB && value > 0.0 ? DecodeSRGB(value) : value);
  };
  std::vector<float> table; // of the values where there are few: each is decoded but once
  if (type == VTK_UNSIGNED_CHAR || type == VTK_UNSIGNED_SHORT)
  {
    for (float raw = 0.0f; raw <= largest; ++raw)
    {
      table.push_back(decode(raw));
    }
  }
  rgb.resize(3 * static_cast<std::size_t>(numberOfTuples));
  const int components = scalars->GetNumberOfComponents();
  ParallelFor(0, numberOfTuples, 1 << 14,
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkNew<vtkFloatArray> part; // doubles beyond its range become infinite
      part->SetNumberOfComponents(components);
      part->SetNumberOfTuples(end - begin);
      scalars->GetTuples(begin, end - 1, part);
      for (vtkIdType k = 3 * begin; k < 3 * end; ++k)
      {
        const int component = components == 1 ? 0 : static_cast<int>(k % 3);
        const float raw = part->GetTypedComponent(k / 3 - begin, component);
        rgb[k] = table.empty() ? decode(raw) : table[static_cast<std::size_t>(raw)];
      }
    });
  return CleanRadiance(rgb);
}
} // namespace measuredbrdf
