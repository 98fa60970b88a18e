// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AshikhminShirleyLanes.h"

#include "LaneAngles.h"
#include "LanePowers.h"
#include "LaneVectors.h"

#include <algorithm>
#include <limits>

namespace measuredbrdf
{
namespace
{
// 1 - (1 - c/2)^5, without a difference that loses digits at the horizon.
template <typename Number>
MEASUREDBRDF_INLINE void FindDiffuseFactor(const Number& cosine, Number& factor)
{
  const Number x = 0.5f * cosine;
  factor = x * (5.0f - x * (10.0f - x * (10.0f - x * (5.0f - x))));
}
}

// Of each light: its direction, then f.
struct AshikhminShirleyLanes::Steps
{
  float X[Most], Y[Most], Z[Most];
  float Length[Most];    // of light plus view, or its square
  float Refracted[Most]; // DielectricFresnel's g, or its square
  float Colors[3][Most];
};

template <typename Vector>
MEASUREDBRDF_INLINE void AshikhminShirleyLanes::EvaluateAll(
  Steps& steps, int whole, const float view[3], LaneRoots takeRoots) const
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(float));
  for (int k = 0; k < whole; k += width)
  {
    Vector x, y, z, length, sine;
    Load(steps.X + k, x);
    Load(steps.Y + k, y);
    Load(steps.Z + k, z);
    FindSquares(x, y, z, view, length, sine);
    const Vector least = 0.0f * length + LeastLaneSum * LeastLaneSum;
    const Vector zero = 0.0f * length;
    // The half vector's cosine with the view is half of that length.
    const Vector square = length > least ? 0.25f * length : zero + view[2] * view[2];
    const Vector refracted = square + (this->Index * this->Index - 1.0f);
    const Vector positive = refracted > zero ? refracted : zero;
    Store(length, steps.Length + k);
    Store(positive, steps.Refracted + k);
  }
  takeRoots(steps.Length, whole);
  if (this->Index > 0.0f)
  {
    takeRoots(steps.Refracted, whole);
  }
  float viewFactor;
  FindDiffuseFactor(view[2], viewFactor);
  for (int k = 0; k < whole; k += width)
  {
    Vector x, y, z, length, hX, hY, hZ;
    Load(steps.X + k, x);
    Load(steps.Y + k, y);
    Load(steps.Z + k, z);
    Load(steps.Length + k, length);
    FindHalf(x, y, z, view, length, hX, hY, hZ);
    const Vector zero = 0.0f * length;
    const Vector one = zero + 1.0f;
    const Vector least = zero + LeastLaneSum;
    const Vector cosine = length > least ? 0.5f * length : zero + view[2];
    const Vector xSquare = hX * hX;
    const Vector ySquare = hY * hY;
    const Vector sum = xSquare + ySquare;
    Vector ratio, lobe, diffuse;
    FindLogCosineRatio(hZ, sum < one ? sum : one, ratio);
    FindExp(0.5f * (this->Exponents[0] * xSquare + this->Exponents[1] * ySquare) * ratio, lobe);
    const Vector higher = z > zero + view[2] ? z : zero + view[2];
    lobe /= cosine * higher;
    FindDiffuseFactor(z, diffuse);
    diffuse *= viewFactor;
    const Vector rest = cosine < one ? 1.0f - cosine : zero;
    Vector dielectric = zero;
    if (this->Index > 0.0f)
    {
      Vector g;
      Load(steps.Refracted + k, g);
      const Vector a = (g - cosine) / (g + cosine);
      const Vector b = (cosine * (g + cosine) - 1.0f) / (cosine * (g - cosine) + 1.0f);
      dielectric = 0.5f * a * a * (1.0f + b * b);
    }
    const Vector fifth = rest * rest * rest * rest * rest;
    for (int c = 0; c < 3; ++c)
    {
      const Vector schlick = this->Fresnel[c] + (1.0f - this->Fresnel[c]) * fifth;
      const Vector color = this->Specular[c] * lobe * (this->Index > 0.0f ? dielectric : schlick) +
                           this->Diffuse[c] * diffuse;
      const Vector value = color > zero ? color : zero; // not a number: 0
      const Vector largest = zero + std::numeric_limits<float>::max();
      const Vector finite = value <= largest ? value : largest;
      Store(finite, steps.Colors[c] + k);
    }
  }
}

#ifdef MEASUREDBRDF_HAS_VECTORS
MEASUREDBRDF_WIDE void AshikhminShirleyLanes::EvaluateWide(
  Steps& steps, int whole, const float view[3]) const
{
  this->EvaluateAll<Float8>(steps, whole, view, TakeLaneRootsWide);
}
#endif

void AshikhminShirleyLanes::EvaluateMany(int count, const float* const lights[3],
  const double view[3], float* const f[3], VectorForm form) const
{
  const float v[3] = { static_cast<float>(view[0]), static_cast<float>(view[1]),
    static_cast<float>(view[2]) };
  for (int first = 0; first < count; first += Most)
  {
    const int some = std::min(count - first, Most);
    const int whole = (some + 7) / 8 * 8; // the last one once more
    Steps steps;
    float* const to[3] = { steps.X, steps.Y, steps.Z };
    for (int c = 0; c < 3; ++c)
    {
      std::copy_n(lights[c] + first, some, to[c]);
      std::fill(to[c] + some, to[c] + whole, lights[c][first + some - 1]);
    }
    switch (form)
    {
#ifdef MEASUREDBRDF_HAS_VECTORS
      case VectorForm::Wide:
        this->EvaluateWide(steps, whole, v);
        break;
      case VectorForm::Narrow:
        this->EvaluateAll<Float4>(steps, whole, v, TakeLaneRootsNarrow);
        break;
#endif
      default:
        this->EvaluateAll<float>(steps, whole, v, TakeLaneRootsOneByOne);
    }
    for (int c = 0; c < 3; ++c)
    {
      std::copy_n(steps.Colors[c], some, f[c] + first);
    }
  }
}
} // namespace measuredbrdf
