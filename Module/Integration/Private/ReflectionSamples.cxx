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

namespace measuredbrdf
{
namespace
{
// Views are denser towards the horizon, where weights change fast: uniform in 1 - sqrt(1 - angle),
// angle in right angles.
double FromAngle(double angle) { return 1.0 - std::sqrt(std::max(1.0 - angle, 0.0)); }


const double LastView = FromAngle(std::acos(MinimumViewCosine) * 2.0 / Pi);

// Point k of count of a Fibonacci lattice (golden ratio), moved off the square's edge.
glm::dvec2 GetPoint(int k, int count)
{
  return glm::dvec2((k + 0.5) / count, Wrap01(0.5 + k * 0.6180339887498949));
}
}

ReflectionSamples::ReflectionSamples(vtkBRDF* brdf, int count, const std::atomic<bool>& abort)
  : Count(count)
  , Samples(static_cast<std::size_t>(count) * NumberOfViews,
      Sample{ glm::vec3(0.0f, 0.0f, 1.0f), 0.0f, glm::vec3(0.0f), 0.0f })
{
  measuredbrdf::ParallelFor(0, NumberOfViews, 1,
    [this, brdf, &abort](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType view = begin; view < end && !abort; ++view)
      {
        this->Tabulate(brdf, static_cast<int>(view));
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

void ReflectionSamples::Tabulate(vtkBRDF* brdf, int view)
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
    const glm::dvec3 i = lobe.Sample(GetPoint(k, this->Count), density);
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
