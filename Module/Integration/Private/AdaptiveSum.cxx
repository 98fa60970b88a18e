// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AdaptiveSum.h"

#include "AdaptiveRules.h"
#include "vtkBRDF.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
constexpr int DividedAtOnce = 4;
using Rules = AdaptiveRules;

double Sum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }
float Sum(const glm::vec3& rgb) { return rgb.x + rgb.y + rgb.z; }
}

// Values and cosines of so many middles.
void AdaptiveSum::Evaluate(int count)
{
  SquareMiddles& step = this->Step;
  step.Turn(count, this->Rows);
  this->Evaluations += step.Counting;
  float f[3][SquareMiddles::Most] = {};
  const float* const lights[3] = { step.Lights[0], step.Lights[1], step.Lights[2] };
  float* const to[3] = { f[0], f[1], f[2] };
  this->Lights.Evaluate(step.Counting, lights, this->View, to);
  step.Weigh(count, f);
}

// Values of all that is asked for, by their middles.
void AdaptiveSum::EvaluatePlaces()
{
  SquareMiddles& step = this->Step;
  for (std::size_t first = 0; first < this->Asked.size(); first += SquareMiddles::Most)
  {
    const int count =
      static_cast<int>(std::min<std::size_t>(this->Asked.size() - first, SquareMiddles::Most));
    for (int k = 0; k < count; ++k)
    {
      const Place& place = this->Asked[first + static_cast<std::size_t>(k)];
      const TexelTree::Light light = this->Texels->Get(place.Level, place.X, place.Y);
      for (int c = 0; c < 3; ++c)
      {
        step.Directions[c][k] = static_cast<float>(light.Direction[c]);
        step.Irradiances[c][k] = static_cast<float>(light.Irradiance[c]);
      }
    }
    this->Evaluate(count);
    for (int k = 0; k < count; ++k)
    {
      Place& place = this->Asked[first + static_cast<std::size_t>(k)];
      place.Cosine = step.Cosines[k];
      place.Value = glm::vec3(step.Values[0][k], step.Values[1][k], step.Values[2][k]);
    }
  }
}

// What may rise above the horizon where the middle of a square does not.
float AdaptiveSum::EstimateRising(const Place& place)
{
  const double radius = this->Texels->GetLargestRadius(place.Level);
  if (place.Cosine > 0.0 || place.Cosine + radius <= 0.0)
  {
    return 0.0f;
  }
  const TexelTree::Light light = this->Texels->Get(place.Level, place.X, place.Y);
  const glm::dvec3 i = Rules::Raise(this->Local * light.Direction, radius);
  glm::dvec3 f;
  this->BRDF->Evaluate(&i.x, &this->View.x, &f.x);
  return Rules::GetRising(i.z, glm::dot(f, light.Irradiance));
}

// What a peak of f adds that lies in the square, but not where its quarters look.
float AdaptiveSum::EstimateHidden(const Square& square) const
{
  const Place& place = square.Whole;
  if (this->Texels->GetLargestRadius(place.Level) < ReflectionGuide::Peaks::GetResolution())
  {
    return 0.0f;
  }
  const TexelTree::Light light = this->Texels->Get(place.Level, place.X, place.Y);
  const double irradiance = Sum(light.Irradiance) / 3.0;
  double radius = 0.0;
  const glm::dvec3 i = this->Local * this->Texels->GetMiddle(place.Level, place.X, place.Y, radius);
  if (!(irradiance > 0.0) || !(i.z > 0.0) || radius < ReflectionGuide::Peaks::GetResolution())
  {
    return 0.0f;
  }
  double solidAngle = 0.0;
  const double peak = i.z * irradiance * this->Peaks.Get(i, radius, solidAngle);
  const double hidden = peak - Rules::PeakTimes * Sum(square.Value);
  return hidden > 0.0
           ? static_cast<float>(
               std::min(hidden * Rules::GetHiddenShare(solidAngle, radius), Rules::LargestEstimate))
           : 0.0f;
}

// Quarters of all squares that have none yet, which adds squares where one tells nothing.
void AdaptiveSum::MakeAll()
{
  while (this->Made < this->Count)
  {
    const std::size_t first = this->Made;
    this->Made = std::min<std::size_t>(first + SquareMiddles::Most / 4, this->Count);
    this->Make(first, this->Made);
  }
}

// The squares from first on, before last: at most SquareMiddles::Most / 4.
void AdaptiveSum::Make(std::size_t first, std::size_t last)
{
  SquareMiddles& step = this->Step;
  for (std::size_t k = first; k < last; ++k)
  {
    const Place& whole = this->All[k].Whole;
    step.SetQuarters(4 * (k - first), *this->Texels, whole.Level, whole.X, whole.Y);
  }
  this->Evaluate(static_cast<int>(4 * (last - first)));
  for (std::size_t k = first; k < last; ++k)
  {
    Square& square = this->All[k];
    const std::size_t at = 4 * (k - first);
    for (int c = 0; c < 3; ++c)
    {
      std::copy_n(step.Values[c] + at, 4, square.Quarters[c]);
    }
    std::copy_n(step.Cosines + at, 4, square.Cosines);
    this->Finish(k);
  }
}

// Value and error from the quarters.
void AdaptiveSum::Finish(std::size_t index)
{
  Square& square = this->All[index];
  const int level = square.Whole.Level;
  for (int c = 0; c < 3; ++c)
  {
    const float* quarters = square.Quarters[c];
    square.Value[c] = (quarters[0] + quarters[1]) + (quarters[2] + quarters[3]);
  }
  square.Error = 0.0f;
  const bool isLast = level - 1 == this->Texels->GetLowestLevel(); // as exact as can be
  const glm::vec3 change = square.Value - square.Whole.Value;
  const float changed = Sum(glm::abs(change));
  if (level <= 0)
  {
    if (!isLast)
    {
      square.Value = glm::max(square.Value + Rules::SmoothRest * change, 0.0f);
      square.Error = Rules::PartRest * changed + this->EstimateRising(square.Whole);
    }
    this->Keep(index);
    return;
  }
  const float rest = this->Texels->GetRest(level, square.Whole.X, square.Whole.Y);
  if (!isLast)
  {
    square.Value = glm::max(square.Value + rest * change, 0.0f);
    square.Error = std::max(rest, Rules::LeastRest) * changed + this->EstimateRising(square.Whole) +
                   this->EstimateHidden(square);
    square.Error = std::max(
      square.Error, Rules::LeastShare * static_cast<float>(this->Tolerance) * Sum(square.Value));
  }
  // Where nearly all light is in one quarter, that agrees with the square whatever it hides.
  if (rest > Rules::LargestRest)
  {
    this->AddQuarters(index);
    return;
  }
  this->Keep(index);
}

void AdaptiveSum::Keep(std::size_t index)
{
  Square& square = this->All[index];
  this->Total += square.Value;
  if (square.Error > 0.0f || Sum(square.Value) > 0.0f)
  {
    square.Error = std::max(square.Error, square.Whole.LeastError);
  }
  if (square.Error > 0.0f)
  {
    const double error = square.Error;
    this->Error += error;
    this->Squares += error * error;
    this->Queue.Add(square.Error, static_cast<std::uint32_t>(index));
  }
}

// A square to be made; the smallest ones count as they are.
void AdaptiveSum::Add(const Place& place)
{
  if (place.Level == this->Texels->GetLowestLevel())
  {
    this->Total += place.Value;
    return;
  }
  if (this->Count == this->All.size())
  {
    this->All.resize(2 * this->Count + 1024);
  }
  this->Texels->Prefetch(place.Level, place.X, place.Y);
  this->All[this->Count++].Whole = place;
}

// Unless they are beyond the map's edge.
void AdaptiveSum::AddQuarters(std::size_t index)
{
  const Square square = this->All[index]; // more of them may move it
  const Place& whole = square.Whole;
  const int level = whole.Level - 1;
  const int width = this->Texels->GetWidth(level);
  const int height = this->Texels->GetHeight(level);
  for (int k = 0; k < 4; ++k)
  {
    const int x = 2 * whole.X + k % 2;
    const int y = 2 * whole.Y + k / 2;
    if (x < width && y < height)
    {
      this->Add({ level, x, y, Rules::InheritedShare * square.Error,
        glm::vec3(square.Quarters[0][k], square.Quarters[1][k], square.Quarters[2][k]),
        square.Cosines[k] });
    }
  }
}

// Squares that are small where the draws are, and large elsewhere.
void AdaptiveSum::Start(const ReflectionGuide& guide)
{
  this->First.Clear();
  this->First.AddDraws(guide, this->Local, this->View);
  this->Asked.clear();
  for (const FirstSquares::Square& square : this->First.Find(*this->Texels))
  {
    this->Asked.push_back({ square.Level, square.X, square.Y, 0.0f, glm::vec3(0.0f), 0.0f });
  }
  this->EvaluatePlaces();
  for (const Place& place : this->Asked)
  {
    this->Add(place);
  }
  this->MakeAll();
}

glm::dvec3 AdaptiveSum::Run(const TexelTree& texels, const ReflectionGuide& guide, vtkBRDF* brdf,
  const Frame& frame, const glm::dvec3& view, double tolerance)
{
  this->Texels = &texels;
  this->BRDF = brdf;
  this->Lights = LightLanes(brdf);
  this->Local = glm::transpose(frame);
  for (int k = 0; k < 9; ++k)
  {
    this->Rows[k] = static_cast<float>(frame[k / 3][k % 3]);
  }
  this->View = view;
  this->Tolerance = tolerance;
  this->Peaks = guide.GetPeaks(view);
  this->Total = glm::dvec3(0.0);
  this->Error = 0.0;
  this->Squares = 0.0;
  this->Count = 0;
  this->Made = 0;
  this->Evaluations = 0;
  this->Queue.Clear();
  this->Start(guide);
  while (!this->Queue.IsEmpty() && this->Count < Rules::MostSquares &&
         Rules::EstimateError(this->Error, this->Squares) > tolerance * Sum(this->Total))
  {
    for (int k = 0; k < DividedAtOnce && !this->Queue.IsEmpty(); ++k)
    {
      const std::size_t index = this->Queue.Take();
      const Square& square = this->All[index];
      const double error = square.Error;
      this->Total -= square.Value;
      this->Error -= error;
      this->Squares -= error * error;
      this->AddQuarters(index);
    }
    this->MakeAll();
  }
  return glm::max(this->Total, 0.0);
}
} // namespace measuredbrdf
