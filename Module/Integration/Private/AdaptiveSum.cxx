// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AdaptiveSum.h"

#include "HalfVector.h" // for Pi
#include "LobeSampler.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "TexelTree.h"
#include "vtkBRDF.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace measuredbrdf
{
namespace
{
// So that sums of a few, and their errors, stay finite in single precision.
constexpr float LargestValue = 1e36f;
}

void SquareMiddles::Turn(int count, const float rows[9])
{
  const auto some = [count](float* of) { return Eigen::Map<Eigen::ArrayXf>(of, count); };
  const auto x = some(this->Directions[0]);
  const auto y = some(this->Directions[1]);
  const auto z = some(this->Directions[2]);
  for (int c = 0; c < 3; ++c)
  {
    some(this->Lights[c]) = rows[3 * c] * x + rows[3 * c + 1] * y + rows[3 * c + 2] * z;
  }
  some(this->Cosines) = some(this->Lights[2]);
  for (int c = 0; c < 3; ++c)
  {
    some(this->Factors[c]) = some(this->Irradiances[c]) * some(this->Cosines);
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

void SquareMiddles::Weigh(int count, float f[3][Most])
{
  const auto some = [this](float* of) { return Eigen::Map<Eigen::ArrayXf>(of, this->Counting); };
  for (int c = 0; c < 3; ++c)
  {
    const Eigen::ArrayXf values = some(f[c]) * some(this->Factors[c]);
    some(f[c]) = values.isNaN().select(0.0f, values).min(LargestValue); // infinite f, black light
    std::fill_n(this->Values[c], count, 0.0f);
    for (int k = 0; k < this->Counting; ++k)
    {
      this->Values[c][this->Numbers[k]] = f[c][k];
    }
  }
}

namespace
{
constexpr std::uint32_t NumberOfDraws = 64;
constexpr int NumberOfViews = 48; // over theta_o, denser towards the horizon, where f changes fast
constexpr int PeakViews = 64;

glm::dvec2 GetPoint(std::uint32_t k)
{
  return glm::dvec2((k + 0.5) / NumberOfDraws, RadicalInverse(k, 2));
}

glm::dvec3 GetView(int view)
{
  const double rest = 1.0 - (view + 0.5) / NumberOfViews;
  const double theta = 0.5 * Pi * (1.0 - rest * rest);
  return glm::dvec3(std::sin(theta), 0.0, std::cos(theta));
}

// Peaks lie over a square that the hemisphere fills by area.
constexpr int PeakSize = 64;
constexpr int PeakLevels = 6; // 64, 32, ..., 2
constexpr int PeakCellsOfView = 5460;
constexpr double PeakWidth = 2.50662827 / PeakSize; // of a first cell, in rad: of sqrt(2 Pi)

int GetLevelOffset(int level)
{
  int offset = 0;
  for (int k = 0; k < level; ++k)
  {
    offset += (PeakSize >> k) * (PeakSize >> k);
  }
  return offset;
}
}

ReflectionGuide::ReflectionGuide(vtkBRDF* brdf)
  : BRDF(brdf)
{
  if (!brdf->IsIsotropic())
  {
    return;
  }
  std::vector<std::vector<Draw>> views(NumberOfViews);
  measuredbrdf::ParallelForEach(NumberOfViews,
    [&](int view)
    {
      const glm::dvec3 o = GetView(view);
      const LobeSampler sampler(brdf, o);
      for (std::uint32_t k = 0; k < NumberOfDraws && !sampler.IsBlack(); ++k)
      {
        double density = 0.0;
        const glm::dvec3 i = sampler.Sample(GetPoint(k), density);
        if (i.z > 0.0 && density > 0.0)
        {
          views[view].push_back({ HalfVector(i, o), 1.0 / (NumberOfDraws * density) });
        }
      }
    });
  this->Views = std::move(views);
  this->TabulatePeaks();
}

void ReflectionGuide::TabulatePeaks()
{
  this->PeakCells.resize(static_cast<std::size_t>(PeakViews) * PeakCellsOfView);
  measuredbrdf::ParallelForEach(PeakViews,
    [&](int view)
    {
      const double theta = 0.5 * Pi * (view + 0.5) / PeakViews;
      const double o[3] = { std::sin(theta), 0.0, std::cos(theta) };
      float* fine = &this->PeakCells[static_cast<std::size_t>(view) * PeakCellsOfView];
      for (int k = 0; k < PeakSize * PeakSize; ++k)
      {
        const glm::dvec3 i = SquareToHemisphere(
          (glm::dvec2(k % PeakSize, k / PeakSize) + 0.5) * (2.0 / PeakSize) - 1.0);
        glm::dvec3 f;
        this->BRDF->Evaluate(&i.x, o, &f.x);
        fine[k] = static_cast<float>(f.x + f.y + f.z);
      }
      for (int level = 1; level < PeakLevels; ++level)
      {
        const int size = PeakSize >> level;
        float* coarse = fine + 4 * size * size;
        for (int k = 0; k < size * size; ++k)
        {
          const float* from = fine + 2 * (k / size) * 2 * size + 2 * (k % size);
          coarse[k] =
            std::max(std::max(from[0], from[1]), std::max(from[2 * size], from[2 * size + 1]));
        }
        fine = coarse;
      }
    });
}

ReflectionGuide::Peaks ReflectionGuide::GetPeaks(const glm::dvec3& o) const
{
  Peaks peaks;
  if (!this->PeakCells.empty())
  {
    const int view = static_cast<int>(std::acos(std::min(o.z, 1.0)) / (0.5 * Pi) * PeakViews);
    peaks.Cells = &this->PeakCells[static_cast<std::size_t>(std::clamp(view, 0, PeakViews - 1)) *
                                   PeakCellsOfView];
    const double s = std::hypot(o.x, o.y);
    peaks.Azimuth = s > 0.0 ? glm::dvec2(o.x, o.y) / s : glm::dvec2(1.0, 0.0);
  }
  return peaks;
}

double ReflectionGuide::Peaks::Get(const glm::dvec3& i, double radius, double& solidAngle) const
{
  constexpr double cell = 2.0 * Pi / (PeakSize * PeakSize);
  solidAngle = cell;
  if (!this->Cells)
  {
    return 0.0;
  }
  // Two cells by two of a level whose cells are as wide as the radius, the nearest ones.
  int level = 0;
  for (double width = PeakWidth; level + 1 < PeakLevels && width < radius; width *= 2.0)
  {
    ++level;
  }
  const int size = PeakSize >> level;
  const glm::dvec3 turned(this->Azimuth.x * i.x + this->Azimuth.y * i.y,
    this->Azimuth.x * i.y - this->Azimuth.y * i.x, i.z);
  const glm::dvec2 uv = (HemisphereToSquare(turned) + 1.0) * (0.5 * size) - 0.5;
  const float* cells = this->Cells + GetLevelOffset(level);
  const int x = std::clamp(static_cast<int>(std::floor(uv.x)), 0, size - 2);
  const int y = std::clamp(static_cast<int>(std::floor(uv.y)), 0, size - 2);
  const float* from = cells + y * size + x;
  return std::max(std::max(from[0], from[1]), std::max(from[size], from[size + 1]));
}

void ReflectionGuide::Draws(const glm::dvec3& o, std::vector<Draw>& draws) const
{
  draws.clear();
  if (this->Views.empty())
  {
    for (std::uint32_t k = 0; k < NumberOfDraws; ++k)
    {
      const glm::dvec2 u = GetPoint(k);
      glm::dvec3 i;
      if (this->BRDF->Sample(&o.x, u.x, u.y, &i.x))
      {
        const double density = this->BRDF->Pdf(&i.x, &o.x);
        if (density > 0.0)
        {
          draws.push_back({ i, 1.0 / (NumberOfDraws * density) });
        }
      }
    }
    return;
  }
  const double rest = std::sqrt(std::max(1.0 - std::acos(std::min(o.z, 1.0)) / (0.5 * Pi), 0.0));
  const int view = std::clamp(static_cast<int>(NumberOfViews * (1.0 - rest)), 0, NumberOfViews - 1);
  const double s = std::hypot(o.x, o.y);
  const glm::dvec2 azimuth = s > 0.0 ? glm::dvec2(o) / s : glm::dvec2(1.0, 0.0);
  const glm::dvec3 from = GetView(view);
  const glm::dvec2 turn(s * from.x + o.z * from.z, s * from.z - o.z * from.x); // to the view
  for (const Draw& draw : this->Views[view])
  {
    glm::dvec3 h = draw.Direction;
    if (ReflectAbout(from, h).x > 0.0) // light that is sent back goes with the view
    {
      h = glm::dvec3(turn.x * h.x + turn.y * h.z, h.y, turn.x * h.z - turn.y * h.x);
    }
    const glm::dvec3 i = ReflectAbout( // turned about the normal, to the view's azimuth
      o, { azimuth.x * h.x - azimuth.y * h.y, azimuth.y * h.x + azimuth.x * h.y, h.z });
    if (i.z > 0.0)
    {
      draws.push_back({ i, draw.SolidAngle });
    }
  }
}

namespace
{
constexpr int WidestBase = 16; // squares across the map to begin with
// The radius that a square may keep: that of the solid angle in which a draw is alone, times this,
// and this share of the distance to it.
constexpr double AloneTimes = 2.0; // lobes are as much narrower as the view is lower
constexpr float DistanceShare = 1.0f;
}

// Divides where a draw wants smaller squares about it. The draws that the larger square was divided
// for are in Near from the first one on.
template <int Size>
void AdaptiveSum<Size>::FindPlaces(int level, int x, int y, std::size_t first)
{
  if (x >= this->Texels->GetWidth(level) || y >= this->Texels->GetHeight(level))
  {
    return;
  }
  const std::size_t last = this->Near.size();
  if (level > this->Texels->GetLowestLevel())
  {
    double radius = 0.0;
    const glm::vec3 middle(this->Texels->GetMiddle(level, x, y, radius));
    const auto r = static_cast<float>(radius);
    for (std::size_t k = first; k < last; ++k)
    {
      const Drawn drawn = this->Near[k];
      const glm::vec3 d = drawn.Direction - middle;
      // The same as r > drawn.Radius + DistanceShare * max(length(d) - r, 0).
      const float reach = (r - drawn.Radius) / DistanceShare;
      if (reach > 0.0f && glm::dot(d, d) < (reach + r) * (reach + r))
      {
        this->Near.push_back(drawn);
      }
    }
  }
  if (this->Near.size() == last)
  {
    this->Places.push_back({ level, x, y });
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    this->FindPlaces(level - 1, 2 * x + k % 2, 2 * y + k / 2, last);
  }
  this->Near.resize(last);
}

namespace
{
///@{
/// What may be left where a square and its quarters agree by chance: this share of the change, of
/// the error of the square that it is a quarter of, and of tolerance times value.
constexpr float LeastRest = 0.05f;
constexpr float InheritedShare = 0.03f;
constexpr float LeastErrorShare = 3.0f;
///@}
/// Within texels radiance is smooth: what the quarters leave is not left once it is extrapolated.
constexpr float PartRest = 0.15f;
constexpr float PeakTimes = 2.0f;        // of a square's mean f: less is no hidden peak
constexpr float LargestRest = 1.0f;      // above, a square tells nothing
constexpr double LargestEstimate = 1e36; // which is finite in single precision
constexpr float StaleShare = 0.7f;       // of the error for which a square was queued
constexpr float LeastKey = 1e-30f;

///@{
/// Hostile values never agree with those of their quarters. A tolerance of 1e-5 may take some
/// 300,000 squares of one pair.
constexpr std::size_t MostSquares = 1 << 20;
constexpr std::size_t MostSquaresOfSeveral = 1 << 16;
///@}

float SumOf(const glm::vec3& rgb) { return (rgb.x + rgb.y) + rgb.z; }

// Of the sum of squares' errors, and of the sum of their squares: errors of either sign cancel, but
// for the part that they have in common.
double EstimateError(double errors, double squares)
{
  constexpr double own = 2.0; // standard deviations
  constexpr double common = 0.1;
  return own * std::sqrt(std::max(squares, 0.0)) + common * std::max(errors, 0.0);
}
}

// The values and cosines of so many middles for each pair.
template <int Size>
void AdaptiveSum<Size>::Evaluate(int count)
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

// What may rise above the horizon where a square's middle does not: a quarter of its light, from as
// high as that quarter's middle can be. Of several pairs, what the highest of these middles may
// send.
template <int Size>
void AdaptiveSum<Size>::AddRisingErrors(Square& square)
{
  const auto radius = static_cast<float>(this->Texels->GetLargestRadius(square.Level));
  const auto mayRise = [&](int pair)
  { return square.Of[pair].Cosine <= 0.0f && square.Of[pair].Cosine + radius > 0.0f; };
  int highest = -1;
  for (int pair = 0; pair < Size; ++pair)
  {
    if (mayRise(pair) && (highest < 0 || square.Of[pair].Cosine > square.Of[highest].Cosine))
    {
      highest = pair;
    }
  }
  if (highest < 0)
  {
    return;
  }
  const TexelTree::Light light = this->Texels->Get(square.Level, square.X, square.Y);
  glm::dvec3 i = this->Local[highest] * light.Direction;
  i.z = 0.5 * (i.z + radius);
  i = glm::normalize(i);
  glm::dvec3 f;
  this->BRDF->Evaluate(&i.x, &this->Pairs[highest].View.x, &f.x);
  const auto rising =
    static_cast<float>(std::min(0.25 * i.z * glm::dot(f, light.Irradiance), LargestEstimate));
  for (int pair = 0; pair < Size; ++pair)
  {
    square.Of[pair].Error += mayRise(pair) ? rising : 0.0f;
  }
}

// What a peak of f adds that lies in the square, but not where its quarters look. The first pair's
// peaks are the others', too, whose mirror directions are within the peaks' resolution.
template <int Size>
void AdaptiveSum<Size>::AddHiddenErrors(Square& square) const
{
  constexpr double resolution = ReflectionGuide::Peaks::GetResolution();
  if (this->Texels->GetLargestRadius(square.Level) < resolution)
  {
    return;
  }
  const TexelTree::Light light = this->Texels->Get(square.Level, square.X, square.Y);
  const double irradiance = (light.Irradiance.x + light.Irradiance.y + light.Irradiance.z) / 3.0;
  double radius = 0.0;
  const glm::dvec3 i =
    this->Local[0] * this->Texels->GetMiddle(square.Level, square.X, square.Y, radius);
  if (!(irradiance > 0.0) || !(i.z > 0.0) || radius < resolution)
  {
    return;
  }
  double solidAngle = 0.0;
  const double peak = i.z * irradiance * this->Peaks.Get(i, radius, solidAngle);
  const double share = std::min(2.0 * solidAngle / (radius * radius), 1.0); // filled unseen
  for (auto& of : square.Of)
  {
    const double hidden = peak - PeakTimes * SumOf(of.Value);
    of.Error += hidden > 0.0 ? static_cast<float>(std::min(hidden * share, LargestEstimate)) : 0.0f;
  }
}

// Quarters of all squares that have none yet, which adds squares where one tells nothing.
template <int Size>
void AdaptiveSum<Size>::MakeAll()
{
  while (this->NumberOfMade < this->NumberOfAll)
  {
    const std::size_t first = this->NumberOfMade;
    this->NumberOfMade = std::min<std::size_t>(first + SquareMiddles::Most / 4, this->NumberOfAll);
    this->Make(first, this->NumberOfMade);
  }
}

// The squares from first on, before last: at most SquareMiddles::Most / 4.
template <int Size>
void AdaptiveSum<Size>::Make(std::size_t first, std::size_t last)
{
  for (std::size_t k = first; k < last; ++k)
  {
    const Square& square = this->All[k];
    SquareMiddles& step = this->Steps[0];
    const std::size_t at = 4 * (k - first);
    float* const directions[3] = { step.Directions[0] + at, step.Directions[1] + at,
      step.Directions[2] + at };
    float* const irradiances[3] = { step.Irradiances[0] + at, step.Irradiances[1] + at,
      step.Irradiances[2] + at };
    this->Texels->GetQuarters(square.Level, square.X, square.Y, directions, irradiances);
  }
  this->Evaluate(static_cast<int>(4 * (last - first)));
  for (std::size_t k = first; k < last; ++k)
  {
    const std::size_t at = 4 * (k - first);
    for (int pair = 0; pair < Size; ++pair)
    {
      auto& of = this->All[k].Of[pair];
      for (std::size_t quarter = 0; quarter < 4; ++quarter)
      {
        of.Quarters[quarter] = this->Steps[pair].GetValue(at + quarter);
        of.Cosines[quarter] = this->Steps[pair].Cosines[at + quarter];
      }
    }
    this->Finish(k);
  }
}

// Values and errors from the quarters.
template <int Size>
void AdaptiveSum<Size>::Finish(std::size_t index)
{
  Square& square = this->All[index];
  const int level = square.Level;
  const bool isLast = level - 1 == this->Texels->GetLowestLevel(); // as exact as can be
  const float rest = this->Texels->GetRest(level, square.X, square.Y);
  const float left = level > 0 ? std::max(rest, LeastRest) : PartRest;
  for (auto& of : square.Of)
  {
    const glm::vec3 sum = (of.Quarters[0] + of.Quarters[1]) + (of.Quarters[2] + of.Quarters[3]);
    const glm::vec3 change = sum - of.Whole;
    of.Value = isLast ? sum : glm::max(sum + rest * change, 0.0f);
    of.Error = isLast ? 0.0f : left * SumOf(glm::abs(change));
  }
  if (!isLast)
  {
    this->AddRisingErrors(square);
  }
  if (!isLast && level > 0)
  {
    this->AddHiddenErrors(square);
    const float share = LeastErrorShare * static_cast<float>(this->Tolerance);
    for (auto& of : square.Of)
    {
      of.Error = std::max(of.Error, share * SumOf(of.Value));
    }
    // Where nearly all light is in one quarter, that agrees with the square whatever it hides.
    if (rest > LargestRest)
    {
      this->AddQuarters(index);
      return;
    }
  }
  this->Keep(index);
}

// Counts a square.
template <int Size>
void AdaptiveSum<Size>::Keep(std::size_t index)
{
  Square& square = this->All[index];
  square.Key = 0.0f;
  for (auto& of : square.Of)
  {
    if (of.Error > 0.0f || SumOf(of.Value) > 0.0f)
    {
      of.Error = std::max(of.Error, of.LeastError);
    }
    square.Key = std::max(square.Key, of.Error);
  }
  this->Count(square, 1.0);
  square.IsQueued = square.Key > 0.0f;
  if (this->IsQueuing && square.IsQueued)
  {
    square.Key = this->GetKey(square);
    this->Queue.emplace(square.Key, static_cast<std::uint32_t>(index));
  }
}

// Adds a square to the sums, or takes it out.
template <int Size>
void AdaptiveSum<Size>::Count(const Square& square, double sign)
{
  for (int pair = 0; pair < Size; ++pair)
  {
    const auto& of = square.Of[pair];
    this->Totals[pair] += sign * glm::dvec3(of.Value);
    const double error = of.Error;
    this->Errors[pair] += sign * error;
    this->Squares[pair] += sign * error * error;
  }
}

template <int Size>
float AdaptiveSum<Size>::GetKey(const Square& square) const
{
  float key = LeastKey; // of what is not a number, too
  for (int pair = 0; pair < Size; ++pair)
  {
    key = std::max(key, square.Of[pair].Error * this->Weights[pair]);
  }
  return key;
}

template <int Size>
typename AdaptiveSum<Size>::Square& AdaptiveSum<Size>::Add(int level, int x, int y)
{
  if (this->NumberOfAll == this->All.size())
  {
    this->All.resize(2 * this->NumberOfAll + 1024);
  }
  Square& square = this->All[this->NumberOfAll++];
  square.Level = level;
  square.X = x;
  square.Y = y;
  square.IsQueued = false;
  return square;
}

// Unless they are beyond the map's edge. The smallest ones count as they are.
template <int Size>
void AdaptiveSum<Size>::AddQuarters(std::size_t index)
{
  const int level = this->All[index].Level - 1;
  const int left = 2 * this->All[index].X;
  const int top = 2 * this->All[index].Y;
  this->All[index].IsQueued = false;
  for (int k = 0; k < 4; ++k)
  {
    const int x = left + k % 2;
    const int y = top + k / 2;
    if (x >= this->Texels->GetWidth(level) || y >= this->Texels->GetHeight(level))
    {
      continue;
    }
    if (level == this->Texels->GetLowestLevel())
    {
      for (int pair = 0; pair < Size; ++pair)
      {
        this->Totals[pair] += glm::dvec3(this->All[index].Of[pair].Quarters[k]);
      }
      continue;
    }
    Square& quarter = this->Add(level, x, y);
    const Square& square = this->All[index]; // adding may have moved it
    for (int pair = 0; pair < Size; ++pair)
    {
      const auto& from = square.Of[pair];
      auto& to = quarter.Of[pair];
      to.LeastError = InheritedShare * from.Error;
      to.Cosine = from.Cosines[k];
      to.Whole = from.Quarters[k];
    }
  }
}

// Squares that are small where the pairs' draws are, and large elsewhere. Of several pairs half of
// each one's draws: a fourth would be too few where sharp lobes of low views hardly overlap.
template <int Size>
void AdaptiveSum<Size>::Start(const ReflectionGuide& guide)
{
  constexpr std::size_t step = Size > 1 ? 2 : 1;
  this->Near.clear();
  for (int pair = 0; pair < Size; ++pair)
  {
    const glm::dvec3& view = this->Pairs[pair].View;
    guide.Draws(view, this->Draws);
    for (std::size_t k = static_cast<std::size_t>(pair) % step; k < this->Draws.size(); k += step)
    {
      const ReflectionGuide::Draw& draw = this->Draws[k];
      this->Near.push_back({ glm::vec3(this->Pairs[pair].Axes * draw.Direction),
        static_cast<float>(AloneTimes * std::sqrt(draw.SolidAngle * view.z / Pi)) });
    }
  }
  this->Places.clear();
  int base = 0;
  while (this->Texels->GetWidth(base) > WidestBase)
  {
    ++base;
  }
  for (int k = 0; k < this->Texels->GetWidth(base) * this->Texels->GetHeight(base); ++k)
  {
    this->FindPlaces(base, k % this->Texels->GetWidth(base), k / this->Texels->GetWidth(base), 0);
  }
  const std::vector<Place>& places = this->Places;
  for (std::size_t first = 0; first < places.size(); first += SquareMiddles::Most)
  {
    const std::size_t count = std::min<std::size_t>(places.size() - first, SquareMiddles::Most);
    for (std::size_t k = 0; k < count; ++k)
    {
      const Place& place = places[first + k];
      const TexelTree::Light light = this->Texels->Get(place.Level, place.X, place.Y);
      for (int c = 0; c < 3; ++c)
      {
        this->Steps[0].Directions[c][k] = static_cast<float>(light.Direction[c]);
        this->Steps[0].Irradiances[c][k] = static_cast<float>(light.Irradiance[c]);
      }
    }
    this->Evaluate(static_cast<int>(count));
    for (std::size_t k = 0; k < count; ++k)
    {
      const Place& place = places[first + k];
      const bool isLowest = place.Level == this->Texels->GetLowestLevel(); // counts as it is
      Square* const square = isLowest ? nullptr : &this->Add(place.Level, place.X, place.Y);
      for (int pair = 0; pair < Size; ++pair)
      {
        const SquareMiddles& middles = this->Steps[pair];
        if (square)
        {
          square->Of[pair].LeastError = 0.0f;
          square->Of[pair].Cosine = middles.Cosines[k];
          square->Of[pair].Whole = middles.GetValue(k);
        }
        else
        {
          this->Totals[pair] += glm::dvec3(middles.GetValue(k));
        }
      }
    }
  }
  // Errors weigh by the totals, which are known only then.
  this->IsQueuing = false;
  this->MakeAll();
  this->FindWeights();
  this->IsQueuing = true;
  for (std::size_t k = 0; k < this->NumberOfAll; ++k)
  {
    Square& square = this->All[k];
    if (square.IsQueued)
    {
      square.Key = this->GetKey(square);
      this->Queue.emplace(square.Key, static_cast<std::uint32_t>(k));
    }
  }
}

// Whether a pair is not exact enough.
template <int Size>
bool AdaptiveSum<Size>::FindWeights()
{
  bool any = false;
  for (int pair = 0; pair < Size; ++pair)
  {
    const glm::dvec3& rgb = this->Totals[pair];
    const double total = rgb.x + rgb.y + rgb.z;
    const bool counts =
      EstimateError(this->Errors[pair], this->Squares[pair]) > this->Tolerance * total;
    this->Weights[pair] = counts ? static_cast<float>(1.0 / std::max(total, 1e-30)) : 0.0f;
    any = any || counts;
  }
  return any;
}

template <int Size>
void AdaptiveSum<Size>::Run(const TexelTree& texels, const ReflectionGuide& guide, vtkBRDF* brdf,
  const Pair pairs[Size], double tolerance, glm::dvec3 radiance[Size])
{
  constexpr std::size_t most = Size > 1 ? MostSquaresOfSeveral : MostSquares;
  constexpr int dividedAtOnce = Size > 1 ? 8 : 4;
  this->Texels = &texels;
  this->BRDF = brdf;
  this->Lights = LightLanes(brdf);
  this->Peaks = guide.GetPeaks(pairs[0].View);
  this->Tolerance = tolerance;
  this->NumberOfAll = 0;
  this->NumberOfMade = 0;
  this->Evaluations = 0;
  this->Queue = {};
  for (int pair = 0; pair < Size; ++pair)
  {
    this->Pairs[pair] = pairs[pair];
    this->Local[pair] = glm::transpose(pairs[pair].Axes);
    for (int k = 0; k < 9; ++k)
    {
      this->Rows[pair][k] = static_cast<float>(pairs[pair].Axes[k / 3][k % 3]);
    }
    this->Errors[pair] = this->Squares[pair] = 0.0;
    this->Totals[pair] = glm::dvec3(0.0);
  }
  this->Start(guide);
  while (!this->Queue.empty() && this->NumberOfAll < most && this->FindWeights())
  {
    for (int k = 0; k < dividedAtOnce && !this->Queue.empty();)
    {
      const std::uint32_t index = this->Queue.top().second;
      this->Queue.pop();
      Square& square = this->All[index];
      const float key = this->GetKey(square);
      if (key < StaleShare * square.Key) // it was queued for a pair that is exact by now
      {
        square.Key = key;
        this->Queue.emplace(key, index);
        continue;
      }
      this->Count(square, -1.0);
      this->AddQuarters(index);
      ++k;
    }
    this->MakeAll();
  }
  for (int pair = 0; pair < Size; ++pair)
  {
    radiance[pair] = glm::max(this->Totals[pair], 0.0);
  }
}

template class AdaptiveSum<1>;
template class AdaptiveSum<4>;
} // namespace measuredbrdf
