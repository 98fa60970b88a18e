// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SquareMiddles.h"

#include "Lanes.h"
#include "TexelTree.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// So that sums of a few, and their errors, stay finite in single precision.
constexpr float LargestValue = 1e36f;
}

void SquareMiddles::SetQuarters(std::size_t at, const TexelTree& texels, int level, int x, int y)
{
  float* const directions[3] = { this->Directions[0] + at, this->Directions[1] + at,
    this->Directions[2] + at };
  float* const irradiances[3] = { this->Irradiances[0] + at, this->Irradiances[1] + at,
    this->Irradiances[2] + at };
  texels.GetQuarters(level, x, y, directions, irradiances);
}

void SquareMiddles::Turn(int count, const float rows[9])
{
  const int whole = std::min((count + 7) / 8 * 8, Most);
  for (int c = 0; c < 3; ++c)
  {
    std::fill(this->Directions[c] + count, this->Directions[c] + whole, 0.0f);
    std::fill(this->Irradiances[c] + count, this->Irradiances[c] + whole, 0.0f);
  }
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      for (int k = 0; k < whole; k += LaneCount)
      {
        const auto x = Load<Floats>(this->Directions[0] + k);
        const auto y = Load<Floats>(this->Directions[1] + k);
        const auto z = Load<Floats>(this->Directions[2] + k);
        const Floats cosine = rows[6] * x + rows[7] * y + rows[8] * z;
        Store(cosine, this->Cosines + k);
        Store(rows[0] * x + rows[1] * y + rows[2] * z, this->Lights[0] + k);
        Store(rows[3] * x + rows[4] * y + rows[5] * z, this->Lights[1] + k);
        Store(cosine, this->Lights[2] + k);
        for (int c = 0; c < 3; ++c)
        {
          Store(Load<Floats>(this->Irradiances[c] + k) * cosine, this->Factors[c] + k);
        }
      }
    });
  // No branch: which ones count is a matter of chance.
  this->Counting = 0;
  for (int k = 0; k < count; ++k)
  {
    this->Numbers[this->Counting] = k;
    const float sum = this->Irradiances[0][k] + this->Irradiances[1][k] + this->Irradiances[2][k];
    this->Counting += static_cast<int>(this->Cosines[k] > 0.0f) & static_cast<int>(sum > 0.0f);
  }
  for (int c = 0; c < 3 && this->Counting < count; ++c)
  {
    for (int k = 0; k < this->Counting; ++k)
    {
      this->Lights[c][k] = this->Lights[c][this->Numbers[k]];
      this->Factors[c][k] = this->Factors[c][this->Numbers[k]];
    }
  }
}

void SquareMiddles::Weigh(int count, float f[3][Most])
{
  // All count, or those that do are put to their places thereafter.
  const bool all = this->Counting == count;
  float* const to[3] = { all ? this->Values[0] : f[0], all ? this->Values[1] : f[1],
    all ? this->Values[2] : f[2] };
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      for (int c = 0; c < 3; ++c)
      {
        for (int k = 0; k < this->Counting; k += LaneCount)
        {
          const Floats value = Load<Floats>(f[c] + k) * Load<Floats>(this->Factors[c] + k);
          const Floats known = value == value ? value : Floats{}; // infinite, of a black channel
          Store(Smaller(known, Fill(LargestValue)), to[c] + k);
        }
      }
    });
  for (int c = 0; c < 3 && !all; ++c)
  {
    std::fill_n(this->Values[c], count, 0.0f);
    for (int k = 0; k < this->Counting; ++k)
    {
      this->Values[c][this->Numbers[k]] = f[c][k];
    }
  }
}
} // namespace measuredbrdf
