// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PackedWarp.h"

#include "LaneMath.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace measuredbrdf
{
namespace
{
// A weighted mean of what two slices or rows hold, `next` numbers apart.
template <typename Vector>
MEASUREDBRDF_INLINE Vector LoadMixed(const float* values, std::ptrdiff_t next, float weight)
{
  const Vector first = Load<Vector>(values);
  return first + weight * (Load<Vector>(values + next) - first);
}

// Places between the nodes of an axis.
struct LanePlaces
{
  Integers First;
  Floats Fraction;
};

MEASUREDBRDF_INLINE LanePlaces FindPlaces(Floats unit, int nodes)
{
  const Floats inside = Smaller(Larger(unit, Floats{}), Fill(1.0f)); // not a number: 0
  const Floats position = inside * static_cast<float>(nodes - 1);
  const Integers whole = ToIntegers(position);
  const Integers first = whole < nodes - 2 ? whole : Integers{} + (nodes - 2);
  return { first, position - ToFloats(first) };
}

// Of several lights: the coordinates in which the tables are looked up, and what is found there.
struct WarpState : LaneState
{
  LaneDirections Half;
  Floats Theta;                                   // theta_i in radians
  Floats UnitTheta, UnitThetaH, UnitPhiH;         // in the tables' units; of phi_h - phi_i
  Integers Slice;                                 // the first of those about theta_i
  Floats Weight;                                  // of the second
  LanePlaces Column, Row;                         // in the warp, then among the colors
  Float4 Densities[LaneCount], Totals[LaneCount]; // a light's nodes and rows of the warp
};

MEASUREDBRDF_INLINE void FindCoordinates(WarpState& s)
{
  const LaneDirections normal{ Floats{}, Floats{}, Fill(1.0f) };
  const Floats theta = FindQuarterTurns(FindHalfDistance(s.Light, normal));
  s.Theta = theta * static_cast<float>(0.5 * Pi);
  s.UnitTheta = SquareRoot(theta);
  s.UnitThetaH = SquareRoot(FindQuarterTurns(FindHalfDistance(s.Half, normal)));
  // The azimuth of h from that of the light, which is 0 for an upright light.
  const Floats size = s.Light.X * s.Light.X + s.Light.Y * s.Light.Y;
  const Floats fromX = size > 0.0f ? s.Light.X : Fill(1.0f);
  const Floats along = fromX * s.Half.X + s.Light.Y * s.Half.Y;
  const Floats across = fromX * s.Half.Y - s.Light.Y * s.Half.X;
  const Floats phi = FindTurns(along, across);
  s.UnitPhiH = across < 0.0f ? 0.5f - phi : 0.5f + phi;
}
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

// f cos(theta_o) = rgb(s) ndf(h) / (4 sigma(i)), s = vndf^-1(h; i), as in vtkAdaptiveWarpBRDF.
void PackedWarp::Evaluate(
  int count, const float* const lights[3], const double view[3], float* const f[3]) const
{
  const std::ptrdiff_t warpWidth = 2 * this->Warp.Width;
  const std::ptrdiff_t warpRows = 2 * this->Warp.Height;
  const std::ptrdiff_t warpSlice = warpWidth * this->Warp.Height;
  const std::ptrdiff_t colorWidth = 4 * this->Color.Width;
  const std::ptrdiff_t colorSlice = colorWidth * this->Color.Height;
  const std::ptrdiff_t next = this->Thetas.size() > 1 ? 1 : 0; // slice

  const auto findHalf = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    Floats cosine;
    s.Half = FindHalf(s.Light, FillDirections(view), cosine);
  };

  const auto findPlaces = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    FindCoordinates(s);
    Floats begin = Fill(this->Thetas[0]);
    Floats inverse = Fill(this->Inverses.empty() ? 0.0f : this->Inverses[0]);
    s.Slice = Integers{};
    for (std::size_t k = 1; k + 1 < this->Thetas.size(); ++k)
    {
      const Integers isBeyond = s.Theta >= this->Thetas[k];
      s.Slice = isBeyond ? Integers{} + static_cast<int>(k) : s.Slice;
      inverse = isBeyond ? Fill(this->Inverses[k]) : inverse;
      begin = isBeyond ? Fill(this->Thetas[k]) : begin;
    }
    s.Weight = Smaller(Larger((s.Theta - begin) * inverse, Floats{}), Fill(1.0f));
    s.Column = FindPlaces(s.UnitThetaH, this->Warp.Width);
    s.Row = FindPlaces(s.UnitPhiH, this->Warp.Height);
  };

  const auto lookUpWarp = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    for (int k = 0; k < LaneCount; ++k)
    {
      const std::ptrdiff_t slice = s.Slice[k];
      const std::ptrdiff_t row = s.Row.First[k];
      const float weight = s.Weight[k];
      const float* const node =
        this->Nodes.data() + slice * warpSlice + row * warpWidth + 2 * s.Column.First[k];
      const Float4 upper = LoadMixed<Float4>(node, next * warpSlice, weight);
      const Float4 lower = LoadMixed<Float4>(node + warpWidth, next * warpSlice, weight);
      s.Densities[k] = upper + s.Row.Fraction[k] * (lower - upper);
      s.Totals[k] =
        LoadMixed<Float4>(this->Rows.data() + slice * warpRows + 2 * row, next * warpRows, weight);
    }
  };

  // As BilinearWarp::Invert: from a row's densities beside the half vector, their integral up to
  // there, and the integrals of that row, of the next one and of all before.
  const auto invert = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    Floats densities[4], totals[4];
    Transpose(s.Densities, densities);
    Transpose(s.Totals, totals);
    const Floats across = s.Column.Fraction;
    const Floats along =
      densities[1] + across * (densities[0] + 0.5f * across * (densities[2] - densities[0]));
    const Floats down = s.Row.Fraction;
    const Floats before = totals[1] + down * (totals[0] + 0.5f * down * (totals[2] - totals[0]));
    const Floats whole = totals[0] + down * (totals[2] - totals[0]);
    s.Column = FindPlaces(whole > 0.0f ? along / whole : Floats{}, this->Color.Width);
    s.Row = FindPlaces(before, this->Color.Height);
  };

  const auto lookUpColors = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    Float4 colors[LaneCount];
    for (int k = 0; k < LaneCount; ++k)
    {
      const float* const at = this->Colors.data() + s.Slice[k] * colorSlice +
                              s.Row.First[k] * colorWidth + 4 * s.Column.First[k];
      const Float8 upper = LoadMixed<Float8>(at, next * colorSlice, s.Weight[k]);
      const Float8 lower = LoadMixed<Float8>(at + colorWidth, next * colorSlice, s.Weight[k]);
      const Float8 mixed = upper + s.Row.Fraction[k] * (lower - upper);
      const Float4 left = __builtin_shufflevector(mixed, mixed, 0, 1, 2, 3);
      const Float4 right = __builtin_shufflevector(mixed, mixed, 4, 5, 6, 7);
      colors[k] = left + s.Column.Fraction[k] * (right - left);
    }
    Floats ofColors[4];
    Transpose(colors, ofColors);
    std::copy_n(ofColors, 3, s.Color);
  };

  const auto scaleColors = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    Floats scale = Fill(static_cast<float>(1.0 / view[2]));
    if (this->Jacobian)
    {
      const LanePlaces x = FindPlaces(s.UnitThetaH, this->Normal.Width);
      const LanePlaces y = FindPlaces(s.UnitPhiH, this->Normal.Height);
      const LanePlaces ofSigma = FindPlaces(s.UnitTheta, this->SigmaWidth);
      Float4 corners[LaneCount];
      Floats areas[2];
      for (int k = 0; k < LaneCount; ++k)
      {
        const float* const at =
          this->Ndf.data() + std::ptrdiff_t{ y.First[k] } * this->Normal.Width + x.First[k];
        corners[k] = Float4{ at[0], at[1], at[this->Normal.Width], at[this->Normal.Width + 1] };
        const float* const area = this->Sigma.data() + ofSigma.First[k];
        areas[0][k] = area[0];
        areas[1][k] = area[1];
      }
      Floats c[4];
      Transpose(corners, c);
      const Floats above = c[0] + x.Fraction * (c[1] - c[0]);
      const Floats below = c[2] + x.Fraction * (c[3] - c[2]);
      scale *= (above + y.Fraction * (below - above)) /
               (4.0f * (areas[0] + ofSigma.Fraction * (areas[1] - areas[0])));
    }
    for (Floats& color : s.Color)
    {
      const Floats value = Larger(color, Floats{}) * scale;
      color = value <= std::numeric_limits<float>::max() ? value : Floats{};
    }
  };

  EvaluateLanes<WarpState>(
    count, lights, f, findHalf, findPlaces, lookUpWarp, invert, lookUpColors, scaleColors);
}
} // namespace measuredbrdf
