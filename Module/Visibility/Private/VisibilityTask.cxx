// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityTask.h"

#include "BounceTracer.h"
#include "HiddenSky.h"
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "SurfacePoints.h"
#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <chrono>

namespace measuredbrdf
{
namespace
{
// Between two reports of progress: whoever stops a trace waits that long at most.
constexpr std::chrono::milliseconds ChunkTime(50);
constexpr vtkIdType LeastChunk = 64;
constexpr vtkIdType MostChunk = 1 << 16;

// Two passes over the same points write the same bytes: threads share nothing but the tracer.
struct PointTask
{
  const SurfaceTracer& Tracer;
  const HiddenSky::Rays& Rays;
  double Farthest;

  HiddenSky::Code Trace(const SurfaceVertex& point, double side, std::vector<char>& hidden) const
  {
    const glm::dvec3 normal = side * point.Normal;
    if (glm::dot(normal, normal) == 0.0)
    {
      return HiddenSky::MakeOpen({ 0.0, 0.0, 1.0 });
    }
    std::uint8_t packed[3];
    HiddenSky::PackNormal(normal, packed);
    const glm::dmat3 frame = FrameAbout(HiddenSky::UnpackNormal(packed));
    const glm::dvec3 face = side * point.FaceNormal;
    glm::dvec3 origin;
    this->Tracer.OffsetOrigin(&point.Origin.x, &face.x, &face.x, &origin.x);
    const auto test = [&](const glm::dvec3& direction)
    {
      const glm::dvec3 d = frame * direction;
      return this->Tracer.IsOccluded(&origin.x, &d.x, 0.0, this->Farthest);
    };
    hidden.clear();
    for (const glm::dvec3& direction : this->Rays.GetDirections())
    {
      hidden.push_back(test(direction) ? 1 : 0);
    }
    return HiddenSky::Encode(normal, this->Rays, hidden, test);
  }
};

// Points inside another body see nothing. Where a polygon of theirs sticks out, what is seen of it
// would darken towards them: they take what the most hidden of its other points has, which is the
// nearest to the other body. (The sky of one farther out would shine into the crease.)
void OpenBuriedPoints(vtkPolyData* surface, SideArrays& side)
{
  constexpr double buried = 0.99; // of the irradiance is hidden
  std::vector<double> hidden;
  std::vector<vtkIdType> sources;
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    hidden.push_back(HiddenSky(side.Get(k)).GetHiddenCosine());
    sources.push_back(k);
  }
  const auto isMoreHidden = [&hidden](vtkIdType a, vtkIdType b)
  { return hidden[static_cast<std::size_t>(a)] > hidden[static_cast<std::size_t>(b)]; };
  const auto isBuried = [&hidden](vtkIdType k)
  { return hidden[static_cast<std::size_t>(k)] > buried; };
  vtkNew<vtkIdList> corners;
  for (vtkCellArray* cells : { surface->GetPolys(), surface->GetStrips() })
  {
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(cell, corners);
      if (std::any_of(corners->begin(), corners->end(),
            [&hidden](vtkIdType k) { return k < 0 || k >= static_cast<vtkIdType>(hidden.size()); }))
      {
        continue; // no polygon of this surface
      }
      vtkIdType nearest = -1;
      for (const vtkIdType corner : *corners)
      {
        if (!isBuried(corner) && (nearest < 0 || isMoreHidden(corner, nearest)))
        {
          nearest = corner;
        }
      }
      for (const vtkIdType corner : *corners)
      {
        vtkIdType& source = sources[static_cast<std::size_t>(corner)];
        if (nearest >= 0 && isBuried(corner) && (source == corner || isMoreHidden(nearest, source)))
        {
          source = nearest;
        }
      }
    }
  }
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    if (sources[static_cast<std::size_t>(k)] != k)
    {
      side.Set(k, side.Get(sources[static_cast<std::size_t>(k)]));
      side.Sources[k] = sources[static_cast<std::size_t>(k)];
    }
  }
}
}

VisibilityTask::VisibilityTask(const SurfaceTracer& tracer,
  const std::vector<vtkPolyData*>& surfaces, const Settings& settings, int passes,
  std::function<bool(double)> report)
  : Tracer(tracer)
  , Surfaces(surfaces)
  , Options(settings)
  , Report(std::move(report))
{
  for (vtkPolyData* surface : surfaces)
  {
    this->All += passes * surface->GetNumberOfPoints();
  }
}

// Returns whether it was not stopped. visit runs on several threads.
template <typename Visit>
bool VisibilityTask::ForEach(vtkIdType count, const Visit& visit)
{
  for (vtkIdType first = 0; first < count;)
  {
    const vtkIdType size = std::min(this->Chunk, count - first);
    const auto start = std::chrono::steady_clock::now();
    measuredbrdf::ParallelFor(first, first + size, 64,
      [&visit](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end; ++k)
        {
          visit(k);
        }
      });
    const auto taken = std::chrono::steady_clock::now() - start;
    if (taken > ChunkTime)
    {
      this->Chunk = std::max(this->Chunk / 2, LeastChunk);
    }
    else if (size == this->Chunk && taken < ChunkTime / 2)
    {
      this->Chunk = std::min(2 * this->Chunk, MostChunk);
    }
    first += size;
    this->Done += size;
    if (!this->Report(static_cast<double>(this->Done) / static_cast<double>(this->All)))
    {
      return false;
    }
  }
  return true;
}

bool VisibilityTask::TraceSky(std::vector<SurfaceArrays>& traced)
{
  const HiddenSky::Rays rays(this->Options.NumberOfRays / HiddenSky::Sectors);
  const PointTask task = { this->Tracer, rays, this->Options.Farthest };
  for (vtkPolyData* surface : this->Surfaces)
  {
    SurfaceArrays arrays;
    arrays.Key = GetSurfaceKey(surface);
    const vtkIdType count = surface->GetNumberOfPoints();
    const std::vector<SurfaceVertex> points = FindSurfacePoints(surface);
    for (const SideNames& names : this->Options.Sides)
    {
      arrays.Sides.emplace_back(count, names);
    }
    const bool whole = this->ForEach(count,
      [&](vtkIdType k)
      {
        thread_local std::vector<char> hidden;
        for (std::size_t side = 0; side < arrays.Sides.size(); ++side)
        {
          arrays.Sides[side].Set(
            k, task.Trace(points[static_cast<std::size_t>(k)], side == 0 ? 1.0 : -1.0, hidden));
        }
      });
    if (!whole)
    {
      return false;
    }
    for (SideArrays& side : arrays.Sides)
    {
      OpenBuriedPoints(surface, side);
    }
    traced.push_back(std::move(arrays));
  }
  return true;
}

bool VisibilityTask::TraceBounce(std::vector<SurfaceArrays>& traced)
{
  // Half of the rays: what they add up varies less than what is hidden.
  const int elevations = std::max(this->Options.NumberOfRays / HiddenSky::Sectors / 2, 4);
  static const std::vector<SurfaceArrays> none;
  const BounceTracer bounces(
    this->Tracer, this->Options.SelfOcclusion ? traced : none, elevations, this->Options.Farthest);
  for (std::size_t s = 0; s < this->Surfaces.size(); ++s)
  {
    const std::vector<SurfaceVertex> points = FindSurfacePoints(this->Surfaces[s]);
    std::vector<SideArrays>& sides = traced[s].Sides;
    for (SideArrays& side : sides)
    {
      side.AddBounced();
    }
    const bool whole = this->ForEach(this->Surfaces[s]->GetNumberOfPoints(),
      [&](vtkIdType k)
      {
        for (std::size_t side = 0; side < sides.size(); ++side)
        {
          const auto source = sides[side].Sources.find(k); // a buried point has another's
          const vtkIdType from = source == sides[side].Sources.end() ? k : source->second;
          sides[side].SetBounced(k, bounces.Trace(points[static_cast<std::size_t>(from)],
                                      side == 0 ? 1.0 : -1.0, sides[side].Get(from)));
        }
      });
    if (!whole)
    {
      return false;
    }
  }
  return true;
}
} // namespace measuredbrdf
