// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SquareMiddles.h"

#include "LaneVectors.h"
#include "TexelTree.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// So that sums of a few, and their errors, stay finite in single precision.
constexpr float LargestValue = 1e36f;

template <typename Vector>
MEASUREDBRDF_INLINE void TurnMiddles(SquareMiddles& middles, int count, const float rows[9])
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(float));
  for (int k = 0; k < count; k += width)
  {
    Vector x, y, z, irradiance;
    Load(middles.Directions[0] + k, x);
    Load(middles.Directions[1] + k, y);
    Load(middles.Directions[2] + k, z);
    const Vector cosine = rows[6] * x + rows[7] * y + rows[8] * z;
    const Vector along = rows[0] * x + rows[1] * y + rows[2] * z;
    const Vector across = rows[3] * x + rows[4] * y + rows[5] * z;
    Store(cosine, middles.Cosines + k);
    Store(along, middles.Lights[0] + k);
    Store(across, middles.Lights[1] + k);
    Store(cosine, middles.Lights[2] + k);
    for (int c = 0; c < 3; ++c)
    {
      Load(middles.Irradiances[c] + k, irradiance);
      const Vector factor = irradiance * cosine;
      Store(factor, middles.Factors[c] + k);
    }
  }
}

template <typename Vector>
MEASUREDBRDF_INLINE void WeighMiddles(
  const SquareMiddles& middles, float f[3][SquareMiddles::Most], float* const to[3])
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(float));
  for (int c = 0; c < 3; ++c)
  {
    for (int k = 0; k < middles.Counting; k += width)
    {
      Vector value, factor;
      Load(f[c] + k, value);
      Load(middles.Factors[c] + k, factor);
      value *= factor;
      const Vector most = Vector{} + LargestValue;
      const Vector known = value == value ? value : Vector{}; // infinite, of a black channel
      const Vector inside = known < most ? known : most;
      Store(inside, to[c] + k);
    }
  }
}

#ifdef MEASUREDBRDF_HAS_VECTORS
MEASUREDBRDF_WIDE void TurnMiddlesWide(SquareMiddles& middles, int count, const float rows[9])
{
  TurnMiddles<Float8>(middles, count, rows);
}

MEASUREDBRDF_WIDE void WeighMiddlesWide(
  const SquareMiddles& middles, float f[3][SquareMiddles::Most], float* const to[3])
{
  WeighMiddles<Float8>(middles, f, to);
}
#endif
}

void SquareMiddles::SetQuarters(std::size_t at, const TexelTree& texels, int level, int x, int y)
{
  float* const directions[3] = { this->Directions[0] + at, this->Directions[1] + at,
    this->Directions[2] + at };
  float* const irradiances[3] = { this->Irradiances[0] + at, this->Irradiances[1] + at,
    this->Irradiances[2] + at };
  texels.GetQuarters(level, x, y, directions, irradiances);
}

void SquareMiddles::Turn(int count, const float rows[9], VectorForm form)
{
  const int whole = std::min((count + 7) / 8 * 8, Most);
  for (int c = 0; c < 3; ++c)
  {
    std::fill(this->Directions[c] + count, this->Directions[c] + whole, 0.0f);
    std::fill(this->Irradiances[c] + count, this->Irradiances[c] + whole, 0.0f);
  }
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (form == VectorForm::Wide)
  {
    TurnMiddlesWide(*this, whole, rows);
  }
  else if (form == VectorForm::Narrow)
  {
    TurnMiddles<Float4>(*this, whole, rows);
  }
  else
#endif
  {
    static_cast<void>(form);
    TurnMiddles<float>(*this, whole, rows);
  }
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

void SquareMiddles::Weigh(int count, float f[3][Most], VectorForm form)
{
  // All count, or those that do are put to their places thereafter.
  const bool all = this->Counting == count;
  float* const to[3] = { all ? this->Values[0] : f[0], all ? this->Values[1] : f[1],
    all ? this->Values[2] : f[2] };
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (form == VectorForm::Wide)
  {
    WeighMiddlesWide(*this, f, to);
  }
  else if (form == VectorForm::Narrow)
  {
    WeighMiddles<Float4>(*this, f, to);
  }
  else
#endif
  {
    static_cast<void>(form);
    WeighMiddles<float>(*this, f, to);
  }
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
