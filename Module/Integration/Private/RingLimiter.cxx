// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RingLimiter.h"

#include "Lanes.h"
#include "ParallelFor.h"

#include <algorithm>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr float LeastShare = 0.75f; // of the blur's least

// A map whose rows have room for the neighbors left and right of their ends, and for what whole
// vectors read and write beyond.
class RingGrid
{
public:
  RingGrid(std::size_t rows, std::size_t width)
    : Rows(rows)
    , Width(width)
    , Stride(width + Before + Beyond)
    , Values(rows * this->Stride, 0.0f)
  {
  }

  float* GetRow(std::size_t row) { return &this->Values[row * this->Stride + Before]; }

  // Rows go around.
  void FillEnds(std::size_t row)
  {
    float* const of = this->GetRow(row);
    std::copy_n(of + this->Width - 3, 3, of - 3);
    std::copy_n(of, 3, of + this->Width);
  }

  // Beyond a pole the meridian opposite goes on.
  std::vector<float> GetBeyondPole(std::size_t row)
  {
    const std::size_t half = this->Width / 6 * 3;
    std::vector<float> turned(this->Width + Beyond, 0.0f);
    const float* const of = this->GetRow(row);
    std::rotate_copy(of, of + half, of + this->Width, turned.begin());
    return turned;
  }

  std::size_t Rows;
  std::size_t Width; // numbers

private:
  static constexpr std::size_t Before = 8;
  static constexpr std::size_t Beyond = 16;
  std::size_t Stride;
  std::vector<float> Values;
};

// Calls combine(a, b, c) with each value between its neighbors left and right, then above and
// below. second: room.
template <typename Combine>
MEASUREDBRDF_INLINE void CombineNeighbors(RingGrid& first, RingGrid& second, const Combine& combine)
{
  const std::size_t width = first.Width;
  const auto combineRows = [&](const float* a, const float* b, const float* c, float* out)
                             MEASUREDBRDF_INLINED
  {
    for (std::size_t k = 0; k < width; k += LaneCount)
    {
      Store(combine(Load<Floats>(a + k), Load<Floats>(b + k), Load<Floats>(c + k)), out + k);
    }
  };
  for (std::size_t row = 0; row < first.Rows; ++row)
  {
    first.FillEnds(row);
    const float* const of = first.GetRow(row);
    combineRows(of - 3, of, of + 3, second.GetRow(row));
  }
  const std::size_t last = first.Rows - 1;
  const std::vector<float> above = second.GetBeyondPole(1);
  const std::vector<float> below = second.GetBeyondPole(last - 1);
  for (std::size_t row = 0; row <= last; ++row)
  {
    combineRows(row > 0 ? second.GetRow(row - 1) : above.data(), second.GetRow(row),
      row < last ? second.GetRow(row + 1) : below.data(), first.GetRow(row));
  }
}
}

void LiftDarkRingsOfMap(float* radiance, std::size_t rows, std::size_t columns)
{
  RingGrid first(rows, 3 * columns), second(rows, 3 * columns);
  for (std::size_t row = 0; row < rows; ++row)
  {
    const float* const of = radiance + row * first.Width;
    std::transform(
      of, of + first.Width, first.GetRow(row), [](float value) { return std::max(value, 0.0f); });
  }
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      for (int pass = 0; pass < 2; ++pass)
      {
        CombineNeighbors(first, second,
          [](Floats a, Floats b, Floats c) MEASUREDBRDF_INLINED
          { return 0.25f * (a + c) + 0.5f * b; });
      }
      for (int pass = 0; pass < 2; ++pass) // as far as the blur reaches: edges do not bleed
      {
        CombineNeighbors(first, second,
          [](Floats a, Floats b, Floats c) MEASUREDBRDF_INLINED
          { return Smaller(Smaller(a, b), c); });
      }
    });
  for (std::size_t row = 0; row < rows; ++row)
  {
    // Where that is 0 all around is negative: f is less than the Lambert part.
    float* const of = radiance + row * first.Width;
    std::transform(first.GetRow(row), first.GetRow(row) + first.Width, of, of,
      [](float least, float value)
      { return least > 0.0f ? std::max(value, LeastShare * least) : value; });
  }
}

void LiftDarkRings(std::vector<float>& radiance, std::size_t rows, std::size_t columns)
{
  const std::size_t size = 3 * rows * columns;
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(radiance.size() / size), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        LiftDarkRingsOfMap(&radiance[static_cast<std::size_t>(k) * size], rows, columns);
      }
    });
}
} // namespace measuredbrdf
