// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AdaptiveGroup.h"

#include "AdaptiveRules.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <cstdint>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t DrawStep = 2;
constexpr int SquaresAtOnce = 8;
constexpr float StaleShare = 0.7f; // of the error for which a square was queued
constexpr float LeastKey = 1e-30f;

Fours Sum(const Fours rgb[3]) { return (rgb[0] + rgb[1]) + rgb[2]; }
}

// The values and cosines of so many middles for each pair.
void AdaptiveGroup::Evaluate(int count)
{
  for (int pair = 0; pair < Size; ++pair)
  {
    SquareMiddles& step = this->Steps[pair];
    for (int c = 0; c < 3 && pair > 0; ++c)
    {
      std::copy_n(this->Steps[0].Directions[c], count, step.Directions[c]);
      std::copy_n(this->Steps[0].Irradiances[c], count, step.Irradiances[c]);
    }
    step.Turn(count, this->Rows[pair]);
    this->Evaluations += step.Counting;
    float f[3][SquareMiddles::Most] = {};
    const float* const lights[3] = { step.Lights[0], step.Lights[1], step.Lights[2] };
    float* const to[3] = { f[0], f[1], f[2] };
    this->Lights.Evaluate(step.Counting, lights, this->Pairs[pair].View, to);
    step.Weigh(count, f);
  }
}

// As AdaptiveSum's, for the pairs whose middle does not rise: what the highest of these middles
// may send.
Fours AdaptiveGroup::EstimateRising(const Square& square)
{
  Fours result(0.0f);
  const auto radius = static_cast<float>(this->Texels->GetLargestRadius(square.Level));
  int highest = -1;
  for (int pair = 0; pair < Size; ++pair)
  {
    const float cosine = square.Cosine[pair];
    if (cosine <= 0.0f && cosine + radius > 0.0f &&
        (highest < 0 || cosine > square.Cosine[highest]))
    {
      highest = pair;
    }
  }
  if (highest < 0)
  {
    return result;
  }
  const TexelTree::Light light = this->Texels->Get(square.Level, square.X, square.Y);
  const glm::dvec3 i = AdaptiveRules::Raise(this->Local[highest] * light.Direction, radius);
  glm::dvec3 f;
  this->BRDF->Evaluate(&i.x, &this->Pairs[highest].View.x, &f.x);
  const float rising = AdaptiveRules::GetRising(i.z, glm::dot(f, light.Irradiance));
  for (int pair = 0; pair < Size; ++pair)
  {
    if (square.Cosine[pair] <= 0.0f && square.Cosine[pair] + radius > 0.0f)
    {
      result.Set(pair, rising);
    }
  }
  return result;
}

// As AdaptiveSum's. The first pair's peaks are the others', too, whose mirror directions are within
// the peaks' resolution.
Fours AdaptiveGroup::EstimateHidden(const Square& square) const
{
  if (this->Texels->GetLargestRadius(square.Level) < ReflectionGuide::Peaks::GetResolution())
  {
    return Fours(0.0f);
  }
  const TexelTree::Light light = this->Texels->Get(square.Level, square.X, square.Y);
  const double irradiance = (light.Irradiance.x + light.Irradiance.y + light.Irradiance.z) / 3.0;
  double radius = 0.0;
  const glm::dvec3 i =
    this->Local[0] * this->Texels->GetMiddle(square.Level, square.X, square.Y, radius);
  if (!(irradiance > 0.0) || !(i.z > 0.0) || radius < ReflectionGuide::Peaks::GetResolution())
  {
    return Fours(0.0f);
  }
  double solidAngle = 0.0;
  const double peak = i.z * irradiance * this->Peaks.Get(i, radius, solidAngle);
  const double share = AdaptiveRules::GetHiddenShare(solidAngle, radius);
  const Fours hidden = Fours(static_cast<float>(std::min(peak, AdaptiveRules::LargestEstimate))) -
                       Fours(AdaptiveRules::PeakTimes) * Sum(square.Value);
  return Larger(hidden, Fours(0.0f)) * Fours(static_cast<float>(share));
}

// Quarters of all squares that have none yet, which adds squares where one tells nothing.
void AdaptiveGroup::MakeAll()
{
  while (this->Made < this->Count)
  {
    const std::size_t first = this->Made;
    this->Made = std::min<std::size_t>(first + SquareMiddles::Most / 4, this->Count);
    this->Make(first, this->Made);
  }
}

// The squares from first on, before last: at most SquareMiddles::Most / 4.
void AdaptiveGroup::Make(std::size_t first, std::size_t last)
{
  SquareMiddles& step = this->Steps[0];
  for (std::size_t k = first; k < last; ++k)
  {
    const Square& square = this->All[k];
    step.SetQuarters(4 * (k - first), *this->Texels, square.Level, square.X, square.Y);
  }
  this->Evaluate(static_cast<int>(4 * (last - first)));
  for (std::size_t k = first; k < last; ++k)
  {
    Square& square = this->All[k];
    const std::size_t at = 4 * (k - first);
    for (int pair = 0; pair < Size; ++pair)
    {
      for (int c = 0; c < 3; ++c)
      {
        Load(this->Steps[pair].Values[c] + at, square.Quarters[c][pair].Values);
      }
      Load(this->Steps[pair].Cosines + at, square.Cosines[pair].Values);
    }
    for (int c = 0; c < 3; ++c)
    {
      Transpose(square.Quarters[c]);
    }
    Transpose(square.Cosines);
    this->Finish(k);
  }
}

// Values and errors from the quarters.
void AdaptiveGroup::Finish(std::size_t index)
{
  using Rules = AdaptiveRules;
  Square& square = this->All[index];
  const int level = square.Level;
  Fours change[3];
  Fours changed(0.0f);
  for (int c = 0; c < 3; ++c)
  {
    const Fours* quarters = square.Quarters[c];
    square.Value[c] = (quarters[0] + quarters[1]) + (quarters[2] + quarters[3]);
    change[c] = square.Value[c] - square.Whole[c];
    changed = changed + Absolute(change[c]);
  }
  square.Error = Fours(0.0f);
  if (level - 1 == this->Texels->GetLowestLevel()) // as exact as can be
  {
    this->Keep(index);
    return;
  }
  const float rest =
    level > 0 ? this->Texels->GetRest(level, square.X, square.Y) : Rules::SmoothRest;
  for (int c = 0; c < 3; ++c)
  {
    square.Value[c] = Larger(square.Value[c] + Fours(rest) * change[c], Fours(0.0f));
  }
  const float left = level > 0 ? std::max(rest, Rules::LeastRest) : Rules::PartRest;
  square.Error = Fours(left) * changed + this->EstimateRising(square);
  if (level > 0)
  {
    square.Error = square.Error + this->EstimateHidden(square);
    square.Error = Larger(square.Error,
      Fours(Rules::LeastShare * static_cast<float>(this->Tolerance)) * Sum(square.Value));
  }
  // Where nearly all light is in one quarter, that agrees with the square whatever it hides.
  if (level > 0 && rest > Rules::LargestRest)
  {
    this->AddQuarters(index);
    return;
  }
  this->Keep(index);
}

void AdaptiveGroup::Keep(std::size_t index)
{
  Square& square = this->All[index];
  square.IsCounted = true;
  square.Error =
    Larger(square.Error, WherePositive(square.LeastError, Larger(square.Error, Sum(square.Value))));
  for (int pair = 0; pair < Size; ++pair)
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Totals[c][pair] += square.Value[c][pair];
    }
    const double error = square.Error[pair];
    this->Errors[pair] += error;
    this->Squares[pair] += error * error;
  }
  square.Key = Largest(square.Error);
  if (this->IsQueuing && square.Key > 0.0f)
  {
    square.Key = this->GetKey(square);
    this->Queue.Add(square.Key, static_cast<std::uint32_t>(index));
  }
}

void AdaptiveGroup::TakeOut(const Square& square)
{
  for (int pair = 0; pair < Size; ++pair)
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Totals[c][pair] -= square.Value[c][pair];
    }
    const double error = square.Error[pair];
    this->Errors[pair] -= error;
    this->Squares[pair] -= error * error;
  }
}

float AdaptiveGroup::GetKey(const Square& square) const
{
  const float key = Largest(square.Error * this->Weights);
  return key >= LeastKey ? key : LeastKey; // not a number, too
}

AdaptiveGroup::Square& AdaptiveGroup::Add(int level, int x, int y)
{
  if (this->Count == this->All.size())
  {
    this->All.resize(2 * this->Count + 1024);
  }
  this->Texels->Prefetch(level, x, y);
  Square& square = this->All[this->Count++];
  square.Level = level;
  square.X = x;
  square.Y = y;
  square.IsCounted = false;
  return square;
}

// Unless they are beyond the map's edge. The smallest ones count as they are.
void AdaptiveGroup::AddQuarters(std::size_t index)
{
  const int level = this->All[index].Level - 1;
  const int left = 2 * this->All[index].X;
  const int top = 2 * this->All[index].Y;
  const int width = this->Texels->GetWidth(level);
  const int height = this->Texels->GetHeight(level);
  this->All[index].IsCounted = false;
  for (int k = 0; k < 4; ++k)
  {
    const int x = left + k % 2;
    const int y = top + k / 2;
    if (x >= width || y >= height)
    {
      continue;
    }
    if (level == this->Texels->GetLowestLevel())
    {
      for (int pair = 0; pair < Size; ++pair)
      {
        for (int c = 0; c < 3; ++c)
        {
          this->Totals[c][pair] += this->All[index].Quarters[c][k][pair];
        }
      }
      continue;
    }
    Square& quarter = this->Add(level, x, y);
    const Square& square = this->All[index]; // adding may have moved it
    quarter.LeastError = Fours(AdaptiveRules::InheritedShare) * square.Error;
    quarter.Cosine = square.Cosines[k];
    for (int c = 0; c < 3; ++c)
    {
      quarter.Whole[c] = square.Quarters[c][k];
    }
  }
}

// Squares that are small where the pairs' draws are, half of each, and large elsewhere. A fourth
// would be too few where sharp lobes of low views hardly overlap.
void AdaptiveGroup::Start(const ReflectionGuide& guide)
{
  this->First.Clear();
  for (int pair = 0; pair < Size; ++pair)
  {
    this->First.AddDraws(guide, this->Local[pair], this->Pairs[pair].View,
      static_cast<std::size_t>(pair) % DrawStep, DrawStep);
  }
  const std::vector<FirstSquares::Square>& squares = this->First.Find(*this->Texels);
  for (std::size_t first = 0; first < squares.size(); first += SquareMiddles::Most)
  {
    const int count =
      static_cast<int>(std::min<std::size_t>(squares.size() - first, SquareMiddles::Most));
    for (int k = 0; k < count; ++k)
    {
      const FirstSquares::Square& place = squares[first + static_cast<std::size_t>(k)];
      const TexelTree::Light light = this->Texels->Get(place.Level, place.X, place.Y);
      for (int c = 0; c < 3; ++c)
      {
        this->Steps[0].Directions[c][k] = static_cast<float>(light.Direction[c]);
        this->Steps[0].Irradiances[c][k] = static_cast<float>(light.Irradiance[c]);
      }
    }
    this->Evaluate(count);
    for (int k = 0; k < count; ++k)
    {
      const FirstSquares::Square& place = squares[first + static_cast<std::size_t>(k)];
      const bool isLowest = place.Level == this->Texels->GetLowestLevel();
      Square* square = isLowest ? nullptr : &this->Add(place.Level, place.X, place.Y);
      for (int pair = 0; pair < Size; ++pair)
      {
        const SquareMiddles& step = this->Steps[pair];
        for (int c = 0; c < 3; ++c)
        {
          if (square)
          {
            square->Whole[c].Set(pair, step.Values[c][k]);
          }
          else
          {
            this->Totals[c][pair] += step.Values[c][k];
          }
        }
        if (square)
        {
          square->LeastError.Set(pair, 0.0f);
          square->Cosine.Set(pair, step.Cosines[k]);
        }
      }
    }
  }
  this->IsQueuing = false;
  this->MakeAll();
  this->FindWeights();
  this->IsQueuing = true;
  for (std::size_t k = 0; k < this->Count; ++k)
  {
    Square& square = this->All[k];
    if (square.IsCounted && square.Key > 0.0f)
    {
      square.Key = this->GetKey(square);
      this->Queue.Add(square.Key, static_cast<std::uint32_t>(k));
    }
  }
}

// Whether a pair is not exact enough.
bool AdaptiveGroup::FindWeights()
{
  bool any = false;
  for (int pair = 0; pair < Size; ++pair)
  {
    const double total = this->Totals[0][pair] + this->Totals[1][pair] + this->Totals[2][pair];
    const bool counts = AdaptiveRules::EstimateError(this->Errors[pair], this->Squares[pair]) >
                        this->Tolerance * total;
    this->Weights.Set(pair, counts ? static_cast<float>(1.0 / std::max(total, 1e-30)) : 0.0f);
    any = any || counts;
  }
  return any;
}

void AdaptiveGroup::Run(const TexelTree& texels, const ReflectionGuide& guide, vtkBRDF* brdf,
  const Pair pairs[Size], double tolerance, glm::dvec3 radiance[Size])
{
  this->Texels = &texels;
  this->BRDF = brdf;
  this->Lights = LightLanes(brdf);
  this->Peaks = guide.GetPeaks(pairs[0].View);
  this->Tolerance = tolerance;
  this->Count = 0;
  this->Made = 0;
  this->Evaluations = 0;
  this->Queue.Clear();
  for (int pair = 0; pair < Size; ++pair)
  {
    this->Pairs[pair] = pairs[pair];
    this->Local[pair] = glm::transpose(pairs[pair].Axes);
    for (int k = 0; k < 9; ++k)
    {
      this->Rows[pair][k] = static_cast<float>(pairs[pair].Axes[k / 3][k % 3]);
    }
    this->Errors[pair] = this->Squares[pair] = 0.0;
    this->Totals[0][pair] = this->Totals[1][pair] = this->Totals[2][pair] = 0.0;
  }
  this->Start(guide);
  while (
    !this->Queue.IsEmpty() && this->Count < AdaptiveRules::MostSquaresOfFour && this->FindWeights())
  {
    for (int k = 0; k < SquaresAtOnce && !this->Queue.IsEmpty();)
    {
      const std::uint32_t index = this->Queue.Take();
      Square& square = this->All[index];
      const float key = this->GetKey(square);
      if (key < StaleShare * square.Key) // it was queued for a pair that is exact by now
      {
        square.Key = key;
        this->Queue.Add(key, index);
        continue;
      }
      this->TakeOut(square);
      this->AddQuarters(index);
      ++k;
    }
    this->MakeAll();
  }
  for (int pair = 0; pair < Size; ++pair)
  {
    for (int c = 0; c < 3; ++c)
    {
      radiance[pair][c] = std::max(this->Totals[c][pair], 0.0);
    }
  }
}
} // namespace measuredbrdf
