// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReflectionSamples.h"

#include "HalfVector.h"
#include "LobeSampler.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Views are denser towards the horizon, where weights change fast: uniform in 1 - sqrt(1 - angle),
// angle in right angles.
double FromAngle(double angle) { return 1.0 - std::sqrt(std::max(1.0 - angle, 0.0)); }

const double LastView = FromAngle(std::acos(MinimumViewCosine) * 2.0 / Pi);

// A Fibonacci lattice (golden ratio), moved off the square's edge. Each point is the one farthest
// from those before it, so that the first ones, too, are spread evenly: they may be drawn alone.
std::vector<glm::dvec2> MakePoints(int count)
{
  std::vector<glm::dvec2> points;
  for (int k = 0; k < count; ++k)
  {
    points.emplace_back((k + 0.5) / count, Wrap01(0.5 + k * GoldenRatio));
  }
  std::vector<double> room(points.size(), 2.0); // squared distance to the nearest one before
  for (std::size_t last = 0; last + 1 < points.size(); ++last)
  {
    std::size_t next = last + 1;
    for (std::size_t k = last + 1; k < points.size(); ++k)
    {
      const glm::dvec2 apart = glm::abs(points[k] - points[last]);
      const glm::dvec2 around = glm::min(apart, 1.0 - apart);
      room[k] = std::min(room[k], glm::dot(around, around));
      next = room[k] > room[next] ? k : next;
    }
    std::swap(points[last + 1], points[next]);
    std::swap(room[last + 1], room[next]);
  }
  return points;
}
}

ReflectionSamples::ReflectionSamples(vtkBRDF* brdf, int count, const std::atomic<bool>& abort)
  : Count(count)
  , Samples(static_cast<std::size_t>(count) * NumberOfViews,
      Sample{ glm::vec3(0.0f, 0.0f, 1.0f), 0.0f, glm::vec3(0.0f), 0.0f })
{
  const std::vector<glm::dvec2> points = MakePoints(count);
  measuredbrdf::ParallelFor(0, NumberOfViews, 1,
    [this, brdf, &points, &abort](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType view = begin; view < end && !abort; ++view)
      {
        this->Tabulate(brdf, points, static_cast<int>(view));
      }
    });
  // Draws that fall below the horizon weigh nothing, but their neighbors fade towards them: these
  // do so where they are.
  for (int k = 0; k < this->Count; ++k)
  {
    for (int view = 1; view < 2 * NumberOfViews; ++view)
    {
      const bool up = view < NumberOfViews;
      const int to = up ? view : 2 * NumberOfViews - 1 - view;
      const int from = std::clamp(up ? to - 1 : to + 1, 0, NumberOfViews - 1);
      Sample& sample = this->Samples[static_cast<std::size_t>(to * this->Count + k)];
      const Sample& other = this->Get(from, k);
      if (sample.Weight == glm::vec3(0.0f) && other.Weight != glm::vec3(0.0f))
      {
        sample.Direction = other.Direction;
        sample.Level = other.Level;
      }
    }
  }
}

void ReflectionSamples::Tabulate(vtkBRDF* brdf, const std::vector<glm::dvec2>& points, int view)
{
  const glm::dvec3 o = GetView(view);
  const LobeSampler lobe(brdf, o, nullptr, Floor);
  const float limit = static_cast<float>(lobe.GetLimit());
  Sample* samples = &this->Samples[static_cast<std::size_t>(view * this->Count)];
  for (int k = 0; k < this->Count; ++k)
  {
    samples[k].Limit = limit;
    if (lobe.IsBlack())
    {
      continue;
    }
    double density = 0.0;
    const glm::dvec3 i = lobe.Sample(points[static_cast<std::size_t>(k)], density);
    if (!(i.z > 0.0) || !(density > 0.0))
    {
      continue;
    }
    density *= this->Count;
    glm::dvec3 f;
    brdf->Evaluate(&i.x, &o.x, &f.x);
    f *= i.z;
    samples[k].Direction = i;
    samples[k].Level = static_cast<float>(-0.5 * std::log2(4.0 * Pi * density));
    samples[k].Weight = f * (GetSharpShare(f, limit) / density);
  }
}

ReflectionSamples::Sample ReflectionSamples::Interpolate(double coordinate, int k) const
{
  const int view = std::clamp(static_cast<int>(coordinate), 0, NumberOfViews - 2);
  const float t = static_cast<float>(std::min(coordinate - view, 1.0));
  const Sample& a = this->Get(view, k);
  const Sample& b = this->Get(view + 1, k);
  return { a.Direction + t * (b.Direction - a.Direction), a.Level + t * (b.Level - a.Level),
    a.Weight + t * (b.Weight - a.Weight), a.Limit + t * (b.Limit - a.Limit) };
}

double ReflectionSamples::GetSharpShare(const glm::dvec3& f, double limit)
{
  return LobeSampler::GetSharpShare(f.x + f.y + f.z, limit);
}

double ReflectionSamples::GetCoordinate(const glm::dvec3& o)
{
  const double angle = std::atan2(std::hypot(o.x, o.y), o.z) * 2.0 / Pi;
  return FromAngle(angle) / LastView * (NumberOfViews - 1);
}

glm::dvec3 ReflectionSamples::GetView(int view)
{
  const double rest = 1.0 - LastView * view / (NumberOfViews - 1);
  const double theta = 0.5 * Pi * (1.0 - rest * rest);
  return glm::dvec3(std::sin(theta), 0.0, std::cos(theta));
}
} // namespace measuredbrdf
