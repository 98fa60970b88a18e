// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceValues.h"

#include "ParallelFor.h"
#include "SRGB.h"
#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayAccessor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>

namespace measuredbrdf
{
namespace
{
float Clean(float value, BadValues& found)
{
  // In this order: NaN fails it, too.
  if (value >= 0.0f && value <= std::numeric_limits<float>::max())
  {
    return value;
  }
  ++(std::isfinite(value) ? found.Negative : found.NotFinite);
  return value > 0.0f ? value : 0.0f;
}

// What Clean left of +infinity.
void LimitInfinite(std::vector<float>& values, const BadValues& bad)
{
  const float largest = bad.NotFinite > 0 ? GetLargestValue(values) : 0.0f;
  for (std::size_t k = 0; bad.NotFinite > 0 && k < values.size(); ++k)
  {
    values[k] = std::min(values[k], largest);
  }
}

// part(begin, end, found) over all values, in threads: the sum of what they found.
template <typename Part>
BadValues ForValues(std::size_t count, Part&& part)
{
  std::atomic<vtkIdType> negative(0);
  std::atomic<vtkIdType> notFinite(0);
  ParallelFor(0, static_cast<vtkIdType>(count), 1 << 16,
    [&](vtkIdType begin, vtkIdType end)
    {
      BadValues found;
      part(static_cast<std::size_t>(begin), static_cast<std::size_t>(end), found);
      negative += found.Negative;
      notFinite += found.NotFinite;
    });
  return { negative, notFinite };
}

// An image's scalars to clean RGB, for arrays of any kind.
struct Decoder
{
  vtkIdType Count;
  bool SRGB;
  float* Out;
  BadValues Bad;

  template <typename Array>
  void operator()(Array* array)
  {
    using Value = typename vtkDataArrayAccessor<Array>::APIType;
    const int type = array->GetDataType();
    const double scale =
      type == VTK_FLOAT || type == VTK_DOUBLE ? 1.0 : 1.0 / array->GetDataTypeMax();
    const auto decode = [this, scale](Value raw)
    {
      const double value = static_cast<double>(raw) * scale;
      return this->SRGB && value > 0.0 ? DecodeSRGB(value) : value;
    };
    // Few values: each but once.
    std::vector<float> table;
    if (type == VTK_UNSIGNED_CHAR || type == VTK_UNSIGNED_SHORT)
    {
      for (double raw = 0.0; raw <= array->GetDataTypeMax(); ++raw)
      {
        table.push_back(static_cast<float>(decode(static_cast<Value>(raw))));
      }
    }
    const int gray = array->GetNumberOfComponents() == 1 ? 0 : 1;
    this->Bad = ForValues(static_cast<std::size_t>(this->Count),
      [&, gray](std::size_t begin, std::size_t end, BadValues& found)
      {
        const vtkDataArrayAccessor<Array> values(array);
        for (std::size_t k = begin; k < end; ++k)
        {
          for (int c = 0; c < 3; ++c)
          {
            const Value raw = values.Get(static_cast<vtkIdType>(k), gray * c);
            if (!table.empty())
            {
              this->Out[3 * k + c] = table[static_cast<std::size_t>(raw)];
              continue;
            }
            const double value = decode(raw);
            // Beyond float's range counts as infinite.
            using Limits = std::numeric_limits<float>;
            const bool fits = std::abs(value) <= Limits::max();
            this->Out[3 * k + c] =
              Clean(fits ? static_cast<float>(value)
                         : (value > 0.0 ? Limits::infinity() : Limits::quiet_NaN()),
                found);
          }
        }
      });
  }
};
}

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
  const BadValues bad = ForValues(values.size(),
    [&values](std::size_t begin, std::size_t end, BadValues& found)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        values[k] = Clean(values[k], found);
      }
    });
  LimitInfinite(values, bad);
  return bad;
}

BadValues DecodeRadiance(
  vtkDataArray* scalars, vtkIdType numberOfTuples, bool sRGB, std::vector<float>& rgb)
{
  rgb.resize(3 * static_cast<std::size_t>(numberOfTuples));
  Decoder decoder{ numberOfTuples, sRGB, rgb.data(), {} };
  if (!vtkArrayDispatch::Dispatch::Execute(scalars, decoder))
  {
    decoder(scalars);
  }
  LimitInfinite(rgb, decoder.Bad);
  return decoder.Bad;
}
} // namespace measuredbrdf
