// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PackedWarp.h"

#include "WideVectors.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace measuredbrdf
{
namespace
{
#ifdef MEASUREDBRDF_HAS_VECTORS
using Vector4 = float __attribute__((vector_size(16)));
#endif

// The same without vectors.
struct FourFloats
{
  float Values[4];
  float operator[](int k) const { return this->Values[k]; }
};

template <typename Four>
MEASUREDBRDF_INLINE void Load(const float* values, Four& four)
{
  std::memcpy(&four, values, sizeof(four));
}

MEASUREDBRDF_INLINE float Mix(float a, float b, float weight) { return a + weight * (b - a); }

#ifdef MEASUREDBRDF_HAS_VECTORS
MEASUREDBRDF_INLINE void MixIn(Vector4& a, const Vector4& b, float weight)
{
  a += weight * (b - a);
}
#endif

MEASUREDBRDF_INLINE void MixIn(FourFloats& a, const FourFloats& b, float weight)
{
  for (int k = 0; k < 4; ++k)
  {
    a.Values[k] = Mix(a.Values[k], b.Values[k], weight);
  }
}

// Of two slices.
template <typename Four>
MEASUREDBRDF_INLINE void LoadMixed(const float* values, std::size_t next, float weight, Four& four)
{
  Four other;
  Load(values, four);
  Load(values + next, other);
  MixIn(four, other, weight);
}

MEASUREDBRDF_INLINE void SetChannel(float color, double scale, double& f)
{
  const double value = color > 0.0f ? color * scale : 0.0; // not a number: 0
  f = value <= std::numeric_limits<double>::max() ? value : 0.0;
}

// A place between the nodes of an axis. Double precision: a fraction of a cell is left of it.
struct Place
{
  MEASUREDBRDF_INLINE Place(double unit, int nodes)
  {
    const double positive = unit > 0.0 ? unit : 0.0; // not std::max: no branches
    const double position = (positive < 1.0 ? positive : 1.0) * (nodes - 1);
    const int first = static_cast<int>(position);
    this->First = first < nodes - 2 ? first : nodes - 2;
    this->Fraction = static_cast<float>(position - this->First);
  }
  int First;
  float Fraction;
};
}

PackedWarp::PackedWarp(const Tables& tables)
  : Jacobian(tables.Jacobian)
  , Warp{ tables.Vndf.GetWidth(), tables.Vndf.GetHeight() }
  , Color{ tables.Rgb[0].GetWidth(), tables.Rgb[0].GetHeight() }
  , Normal{ tables.Ndf.GetWidth(), tables.Ndf.GetHeight() }
  , SigmaWidth(tables.Sigma.GetWidth())
  , Thetas(tables.ThetaI)
  , Ndf(tables.Ndf.GetValues().begin(), tables.Ndf.GetValues().end())
  , Sigma(tables.Sigma.GetValues().begin(), tables.Sigma.GetValues().begin() + this->SigmaWidth)
{
  for (std::size_t k = 0; k + 1 < this->Thetas.size(); ++k)
  {
    this->Inverses.push_back(1.0f / (this->Thetas[k + 1] - this->Thetas[k]));
  }
  const std::vector<double>& densities = tables.Vndf.GetValues();
  const std::vector<double>& conditional = tables.Vndf.GetConditional();
  const std::vector<double>& marginal = tables.Vndf.GetMarginal();
  for (std::size_t k = 0; k < densities.size(); ++k)
  {
    this->Nodes.push_back(static_cast<float>(densities[k]));
    this->Nodes.push_back(static_cast<float>(conditional[k]));
  }
  const auto width = static_cast<std::size_t>(this->Warp.Width);
  for (std::size_t k = 0; k < marginal.size(); ++k)
  {
    const auto total = static_cast<float>(conditional[(k + 1) * width - 1]);
    this->Rows.insert(this->Rows.end(), { total, static_cast<float>(marginal[k]) });
  }
  this->Rows.insert(this->Rows.end(), { 0.0f, 0.0f }); // four are loaded
  for (std::size_t k = 0; k < tables.Rgb[0].GetValues().size(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Colors.push_back(static_cast<float>(tables.Rgb[c].GetValues()[k]));
    }
    this->Colors.push_back(0.0f);
  }
}

template <typename Four>
MEASUREDBRDF_INLINE void PackedWarp::EvaluateAll(
  int count, const WarpAngles& angles, double cosine, double* f) const
{
  const std::size_t width = 2 * static_cast<std::size_t>(this->Warp.Width);
  const std::size_t slice = width * static_cast<std::size_t>(this->Warp.Height);
  const std::size_t rows = 2 * static_cast<std::size_t>(this->Warp.Height);
  const std::size_t colorWidth = 4 * static_cast<std::size_t>(this->Color.Width);
  const std::size_t colorSlice = colorWidth * static_cast<std::size_t>(this->Color.Height);
  const std::size_t slices = this->Thetas.size();
  for (int k = 0; k < count; ++k)
  {
    // Between two slices.
    const auto theta = static_cast<float>(angles.Theta[k]);
    std::size_t at = 0;
    for (std::size_t s = 1; s + 1 < slices; ++s)
    {
      at += theta >= this->Thetas[s] ? 1 : 0;
    }
    const std::size_t next = slices > 1 ? 1 : 0;
    const float weight =
      slices > 1 ? std::min(std::max((theta - this->Thetas[at]) * this->Inverses[at], 0.0f), 1.0f)
                 : 0.0f;
    // The inverse of the warp, as BilinearWarp::Invert.
    const Place x(angles.UnitThetaH[k], this->Warp.Width);
    const Place y(angles.UnitPhiH[k], this->Warp.Height);
    const float* node = &this->Nodes[at * slice + static_cast<std::size_t>(y.First) * width +
                                     2 * static_cast<std::size_t>(x.First)];
    Four row, nextRow, totals;
    LoadMixed(node, next * slice, weight, row);
    LoadMixed(node + width, next * slice, weight, nextRow);
    MixIn(row, nextRow, y.Fraction);
    LoadMixed(
      &this->Rows[at * rows + 2 * static_cast<std::size_t>(y.First)], next * rows, weight, totals);
    const float along = x.Fraction * (row[0] + 0.5f * x.Fraction * (row[2] - row[0])) + row[1];
    const float whole = Mix(totals[0], totals[2], y.Fraction);
    const float below =
      y.Fraction * (totals[0] + 0.5f * y.Fraction * (totals[2] - totals[0])) + totals[1];
    // The color there.
    const Place s(whole > 0.0f ? along / whole : 0.0f, this->Color.Width);
    const Place t(below, this->Color.Height);
    const float* color =
      &this->Colors[at * colorSlice + static_cast<std::size_t>(t.First) * colorWidth +
                    4 * static_cast<std::size_t>(s.First)];
    Four rgb, right, lower, lowerRight; // no loop, no array: they stay in registers
    LoadMixed(color, next * colorSlice, weight, rgb);
    LoadMixed(color + 4, next * colorSlice, weight, right);
    LoadMixed(color + colorWidth, next * colorSlice, weight, lower);
    LoadMixed(color + colorWidth + 4, next * colorSlice, weight, lowerRight);
    MixIn(rgb, right, s.Fraction);
    MixIn(lower, lowerRight, s.Fraction);
    MixIn(rgb, lower, t.Fraction);
    double scale = 1.0 / cosine;
    if (this->Jacobian)
    {
      const Place h(angles.UnitThetaH[k], this->Normal.Width);
      const Place v(angles.UnitPhiH[k], this->Normal.Height);
      const float* d =
        &this
           ->Ndf[static_cast<std::size_t>(v.First) * static_cast<std::size_t>(this->Normal.Width) +
                 static_cast<std::size_t>(h.First)];
      const float density = Mix(Mix(d[0], d[1], h.Fraction),
        Mix(d[this->Normal.Width], d[this->Normal.Width + 1], h.Fraction), v.Fraction);
      const Place i(angles.UnitTheta[k], this->SigmaWidth);
      const float* area = &this->Sigma[static_cast<std::size_t>(i.First)];
      scale *= density / (4.0f * Mix(area[0], area[1], i.Fraction));
    }
    SetChannel(rgb[0], scale, f[3 * k]);
    SetChannel(rgb[1], scale, f[3 * k + 1]);
    SetChannel(rgb[2], scale, f[3 * k + 2]);
  }
}

#ifdef MEASUREDBRDF_HAS_VECTORS
__attribute__((target("avx2,fma"))) void PackedWarp::EvaluateWide(
  int count, const WarpAngles& angles, double cosine, double* f) const
{
  this->EvaluateAll<Vector4>(count, angles, cosine, f);
}
#endif

void PackedWarp::Evaluate(
  int count, const WarpAngles& angles, double cosine, double* f, VectorForm form) const
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (form == VectorForm::Wide)
  {
    return this->EvaluateWide(count, angles, cosine, f);
  }
  if (form == VectorForm::Narrow)
  {
    return this->EvaluateAll<Vector4>(count, angles, cosine, f);
  }
#endif
  static_cast<void>(form);
  this->EvaluateAll<FourFloats>(count, angles, cosine, f);
}
} // namespace measuredbrdf
