// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityTask.h"

#include "LocalFrame.h"
#include "ParallelFor.h"
#include "SurfacePoints.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// Of each thread between two reports of progress: some 50 ms. Whoever stops a trace waits that long
// at most.
constexpr vtkIdType RaysPerReport = 1 << 16;

vtkSmartPointer<vtkUnsignedCharArray> MakeBytes(vtkIdType points, int components)
{
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(points);
  return array;
}

// Just above the triangle beside a point, on one of its sides (1: that of its normal; or -1).
glm::dvec3 Leave(const SurfaceTracer& tracer, const SurfaceVertex& point, double side)
{
  return point.Origin + side * tracer.GetOffset() * point.FaceNormal;
}

// The code of a point's side. hidden: memory for its rays. Two passes over the same points give the
// same bytes: threads share nothing but the tracer.
HorizonCode::Code TracePoint(const SurfaceTracer& tracer, double farthest,
  const HorizonCode::Rays& rays, const SurfaceVertex& point, double side, std::vector<char>& hidden)
{
  const glm::dvec3 normal = side * point.Normal;
  if (glm::dot(normal, normal) == 0.0)
  {
    return HorizonCode::MakeOpen({ 0.0, 0.0, 1.0 });
  }
  std::uint8_t packed[3];
  HorizonCode::PackNormal(normal, packed);
  const glm::dmat3 frame = FrameAbout(HorizonCode::UnpackNormal(packed));
  const glm::dvec3 origin = Leave(tracer, point, side);
  const auto test = [&](const glm::dvec3& direction)
  { return tracer.IsOccluded(origin, frame * direction, farthest); };
  hidden.clear();
  for (const glm::dvec3& direction : rays.GetDirections())
  {
    hidden.push_back(test(direction) ? 1 : 0);
  }
  return HorizonCode::Encode(normal, rays, hidden, test);
}

// The irradiance at what a ray has met, on the side that it came from.
BounceCode::Transfer GetVisible(const std::vector<SurfaceArrays>& surfaces,
  const SurfaceTracer::Hit& hit, const glm::dvec3& direction)
{
  BounceCode::Transfer sum{};
  const auto surface = static_cast<std::size_t>(hit.Surface);
  if (surface >= surfaces.size())
  {
    return sum; // an occluder, of which nothing is known: it stays dark
  }
  const std::vector<SideArrays>& sides = surfaces[surface].Sides;
  HorizonCode::Code codes[3];
  glm::dvec3 normal(0.0);
  for (int k = 0; k < 3; ++k)
  {
    codes[k] = sides[0].Get(hit.Points[k]);
    normal += HorizonCode::UnpackNormal(codes[k].data());
  }
  const bool isBack =
    (glm::dot(normal, hit.Normal) > 0.0) == (glm::dot(hit.Normal, direction) > 0.0);
  if (isBack && sides.size() < 2)
  {
    return sum;
  }
  for (int k = 0; k < 3; ++k)
  {
    const BounceCode::Transfer corner =
      BounceCode::GetVisible(isBack ? sides[1].Get(hit.Points[k]) : codes[k]);
    for (std::size_t j = 0; j < sum.size(); ++j)
    {
      sum[j] += hit.Barycentrics[k] * corner[j];
    }
  }
  return sum;
}

// What comes back to a point's side with this code from the surfaces that hide the sky from it,
// whose arrays say what each of their points sees.
BounceCode::Code TraceBounced(const SurfaceTracer& tracer, double farthest,
  const HorizonCode::Rays& rays, const std::vector<SurfaceArrays>& surfaces,
  const SurfaceVertex& point, double side, const HorizonCode::Code& code)
{
  const double hidden = HorizonCode::GetHiddenCosine(code);
  if (hidden <= 0.0 || glm::dot(point.Normal, point.Normal) == 0.0)
  {
    return BounceCode::MakeDark();
  }
  const glm::dmat3 frame = FrameAbout(HorizonCode::UnpackNormal(code.data()));
  const glm::dvec3 origin = Leave(tracer, point, side);
  BounceCode::Transfer sum{};
  double met = 0.0;
  for (const glm::dvec3& ray : rays.GetDirections())
  {
    const glm::dvec3 direction = frame * ray;
    if (const auto hit = tracer.Intersect(origin, direction, farthest))
    {
      const BounceCode::Transfer visible = GetVisible(surfaces, *hit, direction);
      for (std::size_t j = 0; j < sum.size(); ++j)
      {
        sum[j] += ray.z * visible[j];
      }
      met += ray.z;
    }
  }
  // The mean over what these rays meet, of the share that all rays found to be hidden.
  for (double& value : sum)
  {
    value *= met > 0.0 ? hidden / met : 0.0;
  }
  return BounceCode::Encode(sum);
}

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
    hidden.push_back(HorizonCode::GetHiddenCosine(side.Get(k)));
    sources.push_back(k);
  }
  const auto isMoreHidden = [&hidden](vtkIdType a, vtkIdType b) { return hidden[a] > hidden[b]; };
  const auto isBuried = [&hidden](vtkIdType k) { return hidden[k] > buried; };
  ForEachFace(surface, Faces::Polygons,
    [&](const vtkIdType* corners, vtkIdType count, vtkIdType)
    {
      vtkIdType nearest = -1;
      for (vtkIdType k = 0; k < count; ++k)
      {
        if (!isBuried(corners[k]) && (nearest < 0 || isMoreHidden(corners[k], nearest)))
        {
          nearest = corners[k];
        }
      }
      for (vtkIdType k = 0; nearest >= 0 && k < count; ++k)
      {
        vtkIdType& source = sources[corners[k]];
        if (isBuried(corners[k]) && (source == corners[k] || isMoreHidden(nearest, source)))
        {
          source = nearest;
        }
      }
    });
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    if (sources[k] != k)
    {
      side.Set(k, side.Get(sources[k]));
      side.Sources[k] = sources[k];
    }
  }
}
}

HorizonCode::Code SideArrays::Get(vtkIdType point) const
{
  HorizonCode::Code code;
  std::copy_n(this->Sky->GetPointer(point * HorizonCode::SectorBytes), HorizonCode::SectorBytes,
    code.begin());
  std::copy_n(this->Light->GetPointer(point * HorizonCode::TransferBytes),
    HorizonCode::TransferBytes, code.begin() + HorizonCode::SectorBytes);
  return code;
}

void SideArrays::Set(vtkIdType point, const HorizonCode::Code& code) const
{
  std::copy_n(code.begin(), HorizonCode::SectorBytes,
    this->Sky->GetPointer(point * HorizonCode::SectorBytes));
  std::copy_n(code.begin() + HorizonCode::SectorBytes, HorizonCode::TransferBytes,
    this->Light->GetPointer(point * HorizonCode::TransferBytes));
}

bool TraceVisibility(const SurfaceTracer& tracer, const std::vector<vtkPolyData*>& surfaces,
  const VisibilitySettings& settings, const std::function<bool(double)>& report,
  std::vector<SurfaceArrays>& traced)
{
  vtkIdType all = 1, done = 0;
  for (vtkPolyData* surface : surfaces)
  {
    all +=
      ((settings.WithSky ? 1 : 0) + (settings.WithBounce ? 1 : 0)) * surface->GetNumberOfPoints();
  }
  // Returns whether it was not stopped. visit runs on several threads.
  const auto forEach = [&](vtkIdType count, const auto& visit)
  {
    const vtkIdType chunk = RaysPerReport * GetNumberOfThreads() / settings.NumberOfRays;
    bool goesOn = true;
    for (vtkIdType first = 0; first < count && goesOn; first += chunk)
    {
      const vtkIdType size = std::min(chunk, count - first);
      ParallelForEach(
        size, [&](vtkIdType k) { visit(first + k); }, nullptr, 0);
      done += size;
      goesOn = report(static_cast<double>(done) / static_cast<double>(all));
    }
    return goesOn;
  };
  const auto getSign = [](std::size_t side) { return side == 0 ? 1.0 : -1.0; };

  const HorizonCode::Rays rays(settings.NumberOfRays / HorizonCode::Sectors);
  for (std::size_t s = 0; s < surfaces.size() && settings.WithSky; ++s)
  {
    SurfaceArrays arrays;
    arrays.Key = GetSurfaceKey(surfaces[s]);
    const vtkIdType count = surfaces[s]->GetNumberOfPoints();
    const std::vector<SurfaceVertex> points = FindSurfacePoints(surfaces[s]);
    for (int side = 0; side < (settings.BothSides ? 2 : 1); ++side)
    {
      arrays.Sides.push_back({ MakeBytes(count, HorizonCode::SectorBytes),
        MakeBytes(count, HorizonCode::TransferBytes), nullptr, {} });
    }
    const auto visit = [&](vtkIdType k)
    {
      thread_local std::vector<char> hidden;
      for (std::size_t side = 0; side < arrays.Sides.size(); ++side)
      {
        arrays.Sides[side].Set(
          k, TracePoint(tracer, settings.Farthest, rays, points[k], getSign(side), hidden));
      }
    };
    if (!forEach(count, visit))
    {
      return false;
    }
    for (SideArrays& side : arrays.Sides)
    {
      OpenBuriedPoints(surfaces[s], side);
    }
    traced.push_back(std::move(arrays));
  }

  // Half of the rays: what they add up varies less than what is hidden.
  const HorizonCode::Rays fewer(std::max(settings.NumberOfRays / HorizonCode::Sectors / 2, 4));
  static const std::vector<SurfaceArrays> none;
  const std::vector<SurfaceArrays>& known = settings.SelfOcclusion ? traced : none;
  for (std::size_t s = 0; s < surfaces.size() && settings.WithBounce; ++s)
  {
    const vtkIdType count = surfaces[s]->GetNumberOfPoints();
    const std::vector<SurfaceVertex> points = FindSurfacePoints(surfaces[s]);
    std::vector<SideArrays>& sides = traced[s].Sides;
    for (SideArrays& side : sides)
    {
      side.Bounced = MakeBytes(count, BounceCode::Bytes);
    }
    const auto visit = [&](vtkIdType k)
    {
      for (std::size_t side = 0; side < sides.size(); ++side)
      {
        const auto source = sides[side].Sources.find(k); // a buried point has another's
        const vtkIdType from = source == sides[side].Sources.end() ? k : source->second;
        const BounceCode::Code code = TraceBounced(tracer, settings.Farthest, fewer, known,
          points[from], getSign(side), sides[side].Get(from));
        std::copy(code.begin(), code.end(), sides[side].Bounced->GetPointer(k * BounceCode::Bytes));
      }
    };
    if (!forEach(count, visit))
    {
      return false;
    }
  }
  return true;
}
} // namespace measuredbrdf
