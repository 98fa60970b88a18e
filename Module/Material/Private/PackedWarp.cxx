// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PackedWarp.h"

#include "LaneVectors.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace measuredbrdf
{
namespace
{

// Four and eight numbers of one light, without vectors.
template <int Count>
struct Some
{
  float Values[Count];
  float operator[](int k) const { return this->Values[k]; }
};

template <int Count>
MEASUREDBRDF_INLINE void MixIn(Some<Count>& a, const Some<Count>& b, float weight)
{
  for (int k = 0; k < Count; ++k)
  {
    a.Values[k] += weight * (b.Values[k] - a.Values[k]);
  }
}

#ifdef MEASUREDBRDF_HAS_VECTORS
MEASUREDBRDF_INLINE void MixIn(Float4& a, const Float4& b, float weight) { a += weight * (b - a); }
MEASUREDBRDF_INLINE void MixIn(Float8& a, const Float8& b, float weight) { a += weight * (b - a); }
#endif

// Of two slices.
template <typename Vector>
MEASUREDBRDF_INLINE void LoadMixed(
  const float* values, std::size_t next, float weight, Vector& vector)
{
  Vector other;
  Load(values, vector);
  Load(values + next, other);
  MixIn(vector, other, weight);
}

// Places between the nodes of an axis.
template <typename Vector>
MEASUREDBRDF_INLINE void StorePlaces(const Vector& unit, int nodes, int* first, float* fraction)
{
  using Integers = typename LaneIntegers<Vector>::Type;
  const Vector zero = {};
  const Vector one = zero + 1.0f;
  const Integers last = Integers{} + (nodes - 2);
  const Vector positive = unit > zero ? unit : zero; // not a number: 0
  const Vector position = (positive < one ? positive : one) * static_cast<float>(nodes - 1);
  Integers whole;
  Convert(position, whole);
  const Integers number = whole < last ? whole : last;
  Vector begin;
  Convert(number, begin);
  const Vector rest = position - begin;
  Store(number, first);
  Store(rest, fraction);
}
}

// What each light needs on its way through the tables, one light beside the other.
struct PackedWarp::Steps
{
  int At[WarpLanes::Most]; // the slice
  float Weight[WarpLanes::Most];
  int Column[WarpLanes::Most], Row[WarpLanes::Most]; // in the warp, then in the colors
  float Across[WarpLanes::Most], Down[WarpLanes::Most];
  int NormalColumn[WarpLanes::Most], NormalRow[WarpLanes::Most], AreaColumn[WarpLanes::Most];
  float NormalAcross[WarpLanes::Most], NormalDown[WarpLanes::Most], AreaAcross[WarpLanes::Most];
  float Densities[2][WarpLanes::Most],
    Along[WarpLanes::Most]; // of a row: beside each other, the integral before
  float Totals[2][WarpLanes::Most], Before[WarpLanes::Most]; // of rows
  float Normal[4][WarpLanes::Most], Area[2][WarpLanes::Most];
  float Colors[3][WarpLanes::Most];
};

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

// Slices, and where to look in the warp, the normals' density and sigma.
template <typename Vector>
MEASUREDBRDF_INLINE void PackedWarp::Place(const WarpLanes& lanes, Steps& steps, int k) const
{
  using Integers = typename LaneIntegers<Vector>::Type;
  Vector theta, unit;
  Load(lanes.Theta + k, theta);
  const Vector zero = {};
  const Vector one = zero + 1.0f;
  Vector begin = zero + this->Thetas[0];
  Vector inverse = zero + (this->Inverses.empty() ? 0.0f : this->Inverses[0]);
  Integers at = {};
  for (std::size_t s = 1; s + 1 < this->Thetas.size(); ++s)
  {
    const Vector node = zero + this->Thetas[s];
    const Integers number = Integers{} + static_cast<int>(s);
    const Vector step = zero + this->Inverses[s];
    at = theta >= node ? number : at;
    inverse = theta >= node ? step : inverse;
    begin = theta >= node ? node : begin;
  }
  Vector weight = (theta - begin) * inverse;
  weight = weight > zero ? weight : zero;
  weight = weight < one ? weight : one;
  Store(at, steps.At + k);
  Store(weight, steps.Weight + k);
  Load(lanes.UnitThetaH + k, unit);
  StorePlaces(unit, this->Warp.Width, steps.Column + k, steps.Across + k);
  StorePlaces(unit, this->Normal.Width, steps.NormalColumn + k, steps.NormalAcross + k);
  Load(lanes.UnitPhiH + k, unit);
  StorePlaces(unit, this->Warp.Height, steps.Row + k, steps.Down + k);
  StorePlaces(unit, this->Normal.Height, steps.NormalRow + k, steps.NormalDown + k);
  Load(lanes.UnitTheta + k, unit);
  StorePlaces(unit, this->SigmaWidth, steps.AreaColumn + k, steps.AreaAcross + k);
}

// What the warp and the normals' tables hold about one light.
template <typename Four>
MEASUREDBRDF_INLINE void PackedWarp::LookUpWarp(Steps& steps, int k) const
{
  const std::size_t width = 2 * static_cast<std::size_t>(this->Warp.Width);
  const std::size_t slice = width * static_cast<std::size_t>(this->Warp.Height);
  const std::size_t rows = 2 * static_cast<std::size_t>(this->Warp.Height);
  const std::size_t next = this->Thetas.size() > 1 ? 1 : 0;
  const auto at = static_cast<std::size_t>(steps.At[k]);
  const auto y = static_cast<std::size_t>(steps.Row[k]);
  const float weight = steps.Weight[k];
  const float* node =
    &this->Nodes[at * slice + y * width + 2 * static_cast<std::size_t>(steps.Column[k])];
  Four row, nextRow, totals; // no loop, no array: they stay in registers
  LoadMixed(node, next * slice, weight, row);
  LoadMixed(node + width, next * slice, weight, nextRow);
  MixIn(row, nextRow, steps.Down[k]);
  LoadMixed(&this->Rows[at * rows + 2 * y], next * rows, weight, totals);
  steps.Densities[0][k] = row[0];
  steps.Along[k] = row[1];
  steps.Densities[1][k] = row[2];
  steps.Totals[0][k] = totals[0];
  steps.Before[k] = totals[1];
  steps.Totals[1][k] = totals[2];
  if (this->Jacobian)
  {
    const auto normalWidth = static_cast<std::size_t>(this->Normal.Width);
    const float* density = &this->Ndf[static_cast<std::size_t>(steps.NormalRow[k]) * normalWidth +
                                      static_cast<std::size_t>(steps.NormalColumn[k])];
    const float* area = &this->Sigma[static_cast<std::size_t>(steps.AreaColumn[k])];
    steps.Normal[0][k] = density[0];
    steps.Normal[1][k] = density[1];
    steps.Normal[2][k] = density[normalWidth];
    steps.Normal[3][k] = density[normalWidth + 1];
    steps.Area[0][k] = area[0];
    steps.Area[1][k] = area[1];
  }
}

// The inverse of the warp, as BilinearWarp::Invert, and where that is among the colors.
template <typename Vector>
MEASUREDBRDF_INLINE void PackedWarp::Invert(Steps& steps, int k) const
{
  const Vector zero = {};
  Vector first, second, along, across, down, total, nextTotal, before;
  Load(steps.Densities[0] + k, first);
  Load(steps.Densities[1] + k, second);
  Load(steps.Along + k, along);
  Load(steps.Across + k, across);
  Load(steps.Down + k, down);
  Load(steps.Totals[0] + k, total);
  Load(steps.Totals[1] + k, nextTotal);
  Load(steps.Before + k, before);
  along += across * (first + 0.5f * across * (second - first));
  before += down * (total + 0.5f * down * (nextTotal - total));
  const Vector whole = total + down * (nextTotal - total);
  const Vector unit = whole > zero ? along / whole : zero;
  StorePlaces(unit, this->Color.Width, steps.Column + k, steps.Across + k);
  StorePlaces(before, this->Color.Height, steps.Row + k, steps.Down + k);
}

template <typename Four, typename Eight>
MEASUREDBRDF_INLINE void PackedWarp::LookUpColors(Steps& steps, int k) const
{
  const std::size_t width = 4 * static_cast<std::size_t>(this->Color.Width);
  const std::size_t slice = width * static_cast<std::size_t>(this->Color.Height);
  const std::size_t next = this->Thetas.size() > 1 ? slice : 0;
  const float weight = steps.Weight[k];
  const float* color = &this->Colors[static_cast<std::size_t>(steps.At[k]) * slice +
                                     static_cast<std::size_t>(steps.Row[k]) * width +
                                     4 * static_cast<std::size_t>(steps.Column[k])];
  Eight upper, lower;
  LoadMixed(color, next, weight, upper);
  LoadMixed(color + width, next, weight, lower);
  MixIn(upper, lower, steps.Down[k]);
  Four halves[2];
  Load(reinterpret_cast<const float*>(&upper), halves);
  MixIn(halves[0], halves[1], steps.Across[k]);
  for (int c = 0; c < 3; ++c)
  {
    steps.Colors[c][k] = halves[0][c];
  }
}

template <typename Vector>
MEASUREDBRDF_INLINE void PackedWarp::Scale(
  Steps& steps, float cosine, float* const f[3], int k) const
{
  const Vector zero = {};
  const Vector largest = zero + std::numeric_limits<float>::max();
  Vector scale = zero + 1.0f / cosine;
  if (this->Jacobian)
  {
    Vector across, down, areaAcross, corners[4], area, nextArea;
    Load(steps.NormalAcross + k, across);
    Load(steps.NormalDown + k, down);
    Load(steps.AreaAcross + k, areaAcross);
    for (int corner = 0; corner < 4; ++corner)
    {
      Load(steps.Normal[corner] + k, corners[corner]);
    }
    Load(steps.Area[0] + k, area);
    Load(steps.Area[1] + k, nextArea);
    const Vector above = corners[0] + across * (corners[1] - corners[0]);
    const Vector below = corners[2] + across * (corners[3] - corners[2]);
    scale *= (above + down * (below - above)) / (4.0f * (area + areaAcross * (nextArea - area)));
  }
  for (int c = 0; c < 3; ++c)
  {
    Vector color;
    Load(steps.Colors[c] + k, color);
    const Vector value = color > zero ? color * scale : zero; // not a number: 0
    const Vector finite = value <= largest ? value : zero;
    Store(finite, f[c] + k);
  }
}

template <typename Vector, typename Four, typename Eight>
MEASUREDBRDF_INLINE void PackedWarp::EvaluateAll(
  int count, const WarpLanes& lanes, float cosine, float* const f[3]) const
{
  constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(float));
  const int whole = (count + width - 1) / width * width;
  Steps steps;
  for (int k = 0; k < whole; k += width)
  {
    this->Place<Vector>(lanes, steps, k);
  }
  for (int k = 0; k < whole; ++k)
  {
    this->LookUpWarp<Four>(steps, k);
  }
  for (int k = 0; k < whole; k += width)
  {
    this->Invert<Vector>(steps, k);
  }
  for (int k = 0; k < whole; ++k)
  {
    this->LookUpColors<Four, Eight>(steps, k);
  }
  for (int k = 0; k < whole; k += width)
  {
    this->Scale<Vector>(steps, cosine, f, k);
  }
}

#ifdef MEASUREDBRDF_HAS_VECTORS
MEASUREDBRDF_WIDE void PackedWarp::EvaluateWide(
  int count, const WarpLanes& lanes, float cosine, float* const f[3]) const
{
  this->EvaluateAll<Float8, Float4, Float8>(count, lanes, cosine, f);
}
#endif

void PackedWarp::Evaluate(
  int count, const WarpLanes& lanes, double cosine, float* const f[3], VectorForm form) const
{
  const auto c = static_cast<float>(cosine);
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (form == VectorForm::Wide)
  {
    return this->EvaluateWide(count, lanes, c, f);
  }
  if (form == VectorForm::Narrow)
  {
    return this->EvaluateAll<Float4, Float4, Float8>(count, lanes, c, f);
  }
#endif
  static_cast<void>(form);
  this->EvaluateAll<float, Some<4>, Some<8>>(count, lanes, c, f);
}
} // namespace measuredbrdf
