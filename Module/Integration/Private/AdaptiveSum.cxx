// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AdaptiveSum.h"

#include "HalfVector.h" // for Pi
#include "vtkAdaptiveWarpBRDF.h"

#include <algorithm>
#include <typeinfo>

namespace measuredbrdf
{
namespace
{
constexpr int WidestBase = 16; // squares across the map to begin with
// The radius that a square may keep: that of the solid angle in which a draw is alone, times this,
// and this share of the distance to it.
constexpr double AloneTimes = 2.0; // lobes are as much narrower as the view is lower
constexpr double DistanceShare = 1.0;
// What may be left where a square and its quarters agree by chance: this share of the change, of
// the error of the square that it is a quarter of, and of tolerance times value.
constexpr double LeastRest = 0.05;
constexpr double InheritedShare = 0.03;
constexpr double LeastShare = 3.0;
// Within texels radiance is smooth: what the quarters leave is not left once it is extrapolated.
constexpr double PartRest = 0.15;
constexpr double PeakTimes = 2.0;   // of a square's mean f: less is no hidden peak
constexpr double LargestRest = 1.0; // above, a square tells nothing
// Squares' errors of either sign cancel, but for the part that they have in common.
constexpr double OwnShare = 2.0; // standard deviations
constexpr double CommonShare = 0.1;
constexpr int DividedAtOnce = 4;

double Sum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }
}

double AdaptiveSum::EstimateError() const
{
  return OwnShare * std::sqrt(std::max(this->Squares, 0.0)) +
         CommonShare * std::max(this->Error, 0.0);
}

// Their values, by their middles.
void AdaptiveSum::Evaluate(std::vector<Place>& places)
{
  if (this->Lights.size() < places.size())
  {
    this->Found.resize(places.size());
    this->Lights.resize(places.size());
    this->Irradiances.resize(places.size());
    this->Values.resize(places.size());
  }
  // A loop of its own: processors wait where what was just written in parts is read at once.
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    this->Found[k] = this->Texels->Get(places[k].Level, places[k].X, places[k].Y);
  }
  std::size_t count = 0;
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    Place& place = places[k];
    const TexelTree::Light& light = this->Found[k];
    const glm::dvec3 i = this->Local * light.Direction;
    place.Cosine = i.z;
    place.Value = glm::dvec3(i.z > 0.0 && Sum(light.Irradiance) > 0.0 ? 1.0 : 0.0);
    if (place.Value.x > 0.0)
    {
      this->Lights[count] = i;
      this->Irradiances[count++] = i.z * light.Irradiance;
    }
  }
  if (count == 0)
  {
    return;
  }
  if (this->Measured)
  {
    this->Measured->EvaluateLights(
      static_cast<int>(count), &this->Lights[0].x, &this->View.x, &this->Values[0].x);
  }
  else
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      this->BRDF->Evaluate(&this->Lights[k].x, &this->View.x, &this->Values[k].x);
    }
  }
  std::size_t next = 0;
  for (Place& place : places)
  {
    if (place.Value.x > 0.0)
    {
      place.Value = this->Values[next] * this->Irradiances[next];
      ++next;
    }
  }
}

// What may rise above the horizon where the middle of a square does not: a quarter of its light, as
// high as that quarter's middle can be.
double AdaptiveSum::EstimateRising(const Place& place)
{
  const double radius = this->Texels->GetLargestRadius(place.Level);
  if (place.Cosine > 0.0 || place.Cosine + radius <= 0.0)
  {
    return 0.0;
  }
  const TexelTree::Light light = this->Texels->Get(place.Level, place.X, place.Y);
  glm::dvec3 i = this->Local * light.Direction;
  i.z = 0.5 * (i.z + radius);
  i = glm::normalize(i);
  glm::dvec3 f;
  this->BRDF->Evaluate(&i.x, &this->View.x, &f.x);
  return 0.25 * Sum(i.z * f * light.Irradiance);
}

// What a peak of f adds that lies in the square, but not where its quarters look.
double AdaptiveSum::EstimateHidden(const Square& square, const TexelTree::Light& light) const
{
  const Place& place = square.Whole;
  const double irradiance = Sum(light.Irradiance) / 3.0;
  if (!(irradiance > 0.0))
  {
    return 0.0;
  }
  double radius = 0.0;
  const glm::dvec3 i = this->Local * this->Texels->GetMiddle(place.Level, place.X, place.Y, radius);
  if (!(i.z > 0.0) || radius < ReflectionGuide::Peaks::GetResolution())
  {
    return 0.0;
  }
  double solidAngle = 0.0;
  const double peak = i.z * irradiance * this->Peaks.Get(i, radius, solidAngle);
  const double hidden = peak - PeakTimes * Sum(square.Value);
  return std::max(hidden, 0.0) * std::min(4.0 * solidAngle / (2.0 * radius * radius), 1.0);
}

// Squares of all that is asked for, and of their quarters where a square tells nothing.
void AdaptiveSum::MakeAll()
{
  while (!this->Asked.empty())
  {
    const std::size_t first = this->All.size();
    for (const Place& place : this->Asked)
    {
      if (place.Level == this->Texels->GetLowestLevel())
      {
        this->Total += place.Value;
        continue;
      }
      Square& square = this->All.emplace_back();
      square.Whole = place;
      square.Error = 0.0;
    }
    this->Asked.clear();
    this->Quarters.resize(4 * (this->All.size() - first));
    for (std::size_t k = 0; k < this->Quarters.size(); ++k)
    {
      const Place& whole = this->All[first + k / 4].Whole;
      Place& quarter = this->Quarters[k];
      quarter.Level = whole.Level - 1;
      quarter.X = 2 * whole.X + static_cast<int>(k % 2);
      quarter.Y = 2 * whole.Y + static_cast<int>(k / 2 % 2);
    }
    this->Evaluate(this->Quarters);
    for (std::size_t k = 0; k < this->Quarters.size(); ++k)
    {
      Square& square = this->All[first + k / 4];
      square.Quarters[k % 4] = this->Quarters[k].Value;
      square.Cosines[k % 4] = this->Quarters[k].Cosine;
    }
    for (std::size_t k = first; k < this->All.size(); ++k)
    {
      this->Finish(k);
    }
  }
}

// Value and error from the quarters.
void AdaptiveSum::Finish(std::size_t index)
{
  Square& square = this->All[index];
  const int level = square.Whole.Level;
  square.Value = square.Quarters[0] + square.Quarters[1] + square.Quarters[2] + square.Quarters[3];
  if (level <= 0)
  {
    if (level - 1 > this->Texels->GetLowestLevel()) // else it is as exact as can be
    {
      const glm::dvec3 change = square.Value - square.Whole.Value;
      square.Value = glm::max(square.Value + TexelTree::SmoothRest * change, 0.0);
      square.Error = PartRest * Sum(glm::abs(change)) + this->EstimateRising(square.Whole);
    }
    this->Keep(index);
    return;
  }
  const TexelTree::Light light = this->Texels->Get(level, square.Whole.X, square.Whole.Y);
  if (level - 1 > this->Texels->GetLowestLevel())
  {
    const glm::dvec3 change = square.Value - square.Whole.Value;
    square.Value = glm::max(square.Value + light.Rest * change, 0.0);
    square.Error = std::max(light.Rest, LeastRest) * Sum(glm::abs(change)) +
                   this->EstimateRising(square.Whole) + this->EstimateHidden(square, light);
    square.Error = std::max(square.Error, LeastShare * this->Tolerance * Sum(square.Value));
  }
  // Where nearly all light is in one quarter, that agrees with the square whatever it hides.
  if (light.Rest > LargestRest)
  {
    this->AddQuarters(square);
    return;
  }
  this->Keep(index);
}

void AdaptiveSum::Keep(std::size_t index)
{
  Square& square = this->All[index];
  this->Total += square.Value;
  if (square.Error > 0.0 || Sum(square.Value) > 0.0)
  {
    square.Error = std::max(square.Error, square.Whole.LeastError);
  }
  if (square.Error > 0.0)
  {
    this->Error += square.Error;
    this->Squares += square.Error * square.Error;
    this->Heap.emplace_back(square.Error, index);
    std::push_heap(this->Heap.begin(), this->Heap.end());
  }
}

// Unless it is beyond the map's edge.
void AdaptiveSum::Ask(const Square& square, int quarter)
{
  const Place& whole = square.Whole;
  const int level = whole.Level - 1;
  const int x = 2 * whole.X + quarter % 2;
  const int y = 2 * whole.Y + quarter / 2;
  if (x < this->Texels->GetWidth(level) && y < this->Texels->GetHeight(level))
  {
    Place& place = this->Asked.emplace_back();
    place.Level = level;
    place.X = x;
    place.Y = y;
    place.LeastError = InheritedShare * square.Error;
    place.Value = square.Quarters[quarter];
    place.Cosine = square.Cosines[quarter];
  }
}

void AdaptiveSum::AddQuarters(const Square& square)
{
  for (int k = 0; k < 4; ++k)
  {
    this->Ask(square, k);
  }
}

// Divides where a draw wants smaller squares about it. The draws that the larger square was divided
// for are in Near from the first one on.
void AdaptiveSum::Force(int level, int x, int y, std::size_t first)
{
  if (x >= this->Texels->GetWidth(level) || y >= this->Texels->GetHeight(level))
  {
    return;
  }
  const std::size_t last = this->Near.size();
  if (level > this->Texels->GetLowestLevel())
  {
    double radius = 0.0;
    const glm::dvec3 middle = this->Texels->GetMiddle(level, x, y, radius);
    for (std::size_t k = first; k < last; ++k)
    {
      const Drawn drawn = this->Near[k];
      const glm::dvec3 d = drawn.Direction - middle;
      // The same as radius > drawn.Radius + DistanceShare * max(length(d) - radius, 0).
      const double reach = (radius - drawn.Radius) / DistanceShare;
      if (reach > 0.0 && glm::dot(d, d) < (reach + radius) * (reach + radius))
      {
        this->Near.push_back(drawn);
      }
    }
  }
  if (this->Near.size() == last)
  {
    this->Asked.push_back({ level, x, y, 0.0, glm::dvec3(0.0), 0.0 });
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    this->Force(level - 1, 2 * x + k % 2, 2 * y + k / 2, last);
  }
  this->Near.resize(last);
}

// Squares that are small where the draws are, and large elsewhere.
void AdaptiveSum::Start(const ReflectionGuide& guide)
{
  guide.Draws(this->View, this->Draws);
  this->Near.clear();
  for (const ReflectionGuide::Draw& draw : this->Draws)
  {
    this->Near.push_back({ draw.Direction * this->Local, // transposed: the environment's frame
      AloneTimes * std::sqrt(draw.SolidAngle * this->View.z / Pi) });
  }
  int base = 0;
  while (this->Texels->GetWidth(base) > WidestBase)
  {
    ++base;
  }
  this->Asked.clear();
  for (int y = 0; y < this->Texels->GetHeight(base); ++y)
  {
    for (int x = 0; x < this->Texels->GetWidth(base); ++x)
    {
      this->Force(base, x, y, 0);
    }
  }
  this->Evaluate(this->Asked);
  this->MakeAll();
}

glm::dvec3 AdaptiveSum::Run(const TexelTree& texels, const ReflectionGuide& guide, vtkBRDF* brdf,
  const Frame& frame, const glm::dvec3& view, double tolerance)
{
  this->Texels = &texels;
  this->BRDF = brdf;
  // Subclasses may evaluate another f.
  this->Measured = typeid(*brdf) == typeid(vtkAdaptiveWarpBRDF)
                     ? static_cast<vtkAdaptiveWarpBRDF*>(brdf)
                     : nullptr;
  this->Local = glm::transpose(frame);
  this->View = view;
  this->Tolerance = tolerance;
  this->Peaks = guide.GetPeaks(view);
  this->Total = glm::dvec3(0.0);
  this->Error = 0.0;
  this->Squares = 0.0;
  this->All.clear();
  this->Heap.clear();
  this->Start(guide);
  while (!this->Heap.empty() && this->EstimateError() > tolerance * Sum(this->Total))
  {
    for (int k = 0; k < DividedAtOnce && !this->Heap.empty(); ++k)
    {
      std::pop_heap(this->Heap.begin(), this->Heap.end());
      const Square& square = this->All[this->Heap.back().second];
      this->Heap.pop_back();
      this->Total -= square.Value;
      this->Error -= square.Error;
      this->Squares -= square.Error * square.Error;
      this->AddQuarters(square);
    }
    this->MakeAll();
  }
  return glm::max(this->Total, 0.0);
}
} // namespace measuredbrdf
