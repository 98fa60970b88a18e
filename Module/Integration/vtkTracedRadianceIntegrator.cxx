// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTracedRadianceIntegrator.h"

#include "DirectionPairs.h"
#include "Distribution.h"
#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "ScopedErrorCapture.h"
#include "Setters.h"
#include "TexelTree.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDF.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTracedScene.h"
#include "vtkTracedSurfaces.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace measuredbrdf
{
namespace
{
// The mean over a texel of what is interpolated linearly between the middles of it and its
// neighbors.
constexpr double OwnShare = 0.75;
constexpr double NeighborShare = 0.125;
// Below this cosine of the latitude, next to a pole, densities per solid angle end.
constexpr double LeastCosine = 1e-6;

// Of the draws: by the sky's radiance, by the material, and by the cosine, which leaves no
// direction out.
enum Strategy
{
  ByLight,
  ByMaterial,
  ByCosine
};
constexpr std::array<double, 3> Shares = { 0.5, 0.375, 0.125 };

// splitmix64 (Steele, Lea, Flood 2014): a different stream for each key.
std::uint64_t Mix(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

double ToUnit(std::uint64_t x) { return static_cast<double>(x >> 11) * 0x1p-53; }
}

// Directions of the world in proportion to the light that comes from there.
class SkySampler
{
public:
  // The environment must stay, and its rotation is taken as it is now.
  explicit SkySampler(vtkEnvironment* environment)
    : Environment(environment)
    , Width(static_cast<std::size_t>(environment->GetWidth()))
    , Height(static_cast<std::size_t>(environment->GetHeight()))
  {
    double m[9];
    environment->GetWorldToEnvironment(m);
    this->ToEnvironment = glm::transpose(glm::make_mat3(m)); // glm takes columns
    const std::vector<float>& pixels = environment->GetPixels();
    std::vector<double> sums(this->Width * this->Height); // of the channels, mixed along rows
    const auto sum = [&](std::size_t x, std::size_t y)
    { return Sum(glm::dvec3(glm::make_vec3(&pixels[3 * (y * this->Width + x)]))); };
    for (std::size_t k = 0; k < sums.size(); ++k)
    {
      const std::size_t x = k % this->Width;
      const std::size_t y = k / this->Width;
      sums[k] = OwnShare * sum(x, y) +
                NeighborShare *
                  (sum((x + this->Width - 1) % this->Width, y) + sum((x + 1) % this->Width, y));
    }
    std::vector<double> weights(sums.size());
    for (std::size_t k = 0; k < sums.size(); ++k)
    {
      const std::size_t x = k % this->Width;
      const std::size_t y = k / this->Width;
      const std::size_t below = y > 0 ? y - 1 : 0;
      const std::size_t above = std::min(y + 1, this->Height - 1);
      weights[k] = environment->GetTexelSolidAngle(static_cast<int>(y)) *
                   (OwnShare * sums[k] + NeighborShare * (sums[below * this->Width + x] +
                                                           sums[above * this->Width + x]));
    }
    this->Texels = Distribution2D(weights, this->Width, this->Height);
  }

  // Whether there is no light at all: then nothing can be drawn.
  bool IsBlack() const { return this->Texels.IsZero(); }

  glm::dvec3 Sample(const glm::dvec2& u) const
  {
    std::size_t x = 0, y = 0;
    double inX = 0.0, inY = 0.0;
    this->Texels.Invert(u.x, u.y, x, y, inX, inY);
    glm::dvec3 d;
    vtkEnvironment::GetDirection((static_cast<double>(x) + inX) / static_cast<double>(this->Width),
      (static_cast<double>(y) + inY) / static_cast<double>(this->Height), &d.x);
    return d * this->ToEnvironment; // transposed: back to the world
  }

  // In 1/sr.
  double GetDensity(const glm::dvec3& direction) const
  {
    const glm::dvec3 d = this->ToEnvironment * direction;
    double u = 0.0, v = 0.0;
    vtkEnvironment::GetCoordinates(&d.x, u, v);
    const double width = static_cast<double>(this->Width);
    const double height = static_cast<double>(this->Height);
    const auto x = static_cast<std::size_t>(std::clamp(std::floor(u * width), 0.0, width - 1.0));
    const auto y = static_cast<std::size_t>(std::clamp(std::floor(v * height), 0.0, height - 1.0));
    const double cosine = std::max(std::sqrt(std::max(1.0 - d.y * d.y, 0.0)), LeastCosine);
    return this->Texels.GetProbability(x, y) * width * height / (2.0 * Pi * Pi * cosine);
  }

  glm::dvec3 GetRadiance(const glm::dvec3& direction) const
  {
    const glm::dvec3 d = this->ToEnvironment * direction;
    glm::dvec3 radiance;
    this->Environment->GetRadiance(&d.x, &radiance.x);
    return radiance;
  }

  static double Sum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }

private:
  vtkEnvironment* Environment;
  glm::dmat3 ToEnvironment;
  std::size_t Width;
  std::size_t Height;
  Distribution2D Texels;
};

class TracedRadiance
{
public:
  struct Settings
  {
    int Samples;
    int Bounces;
    std::uint32_t Seed;
  };

  // materials: of each surface; all prepared.
  TracedRadiance(
    const vtkTracedSurfaces& scene, vtkEnvironment* environment, std::vector<vtkBRDF*> materials)
    : Scene(scene)
    , Sky(environment)
    , Materials(std::move(materials))
  {
  }

  // Sums over samples; two independent halves, for the noise.
  struct Sums
  {
    std::array<glm::dvec3, 2> Open{ glm::dvec3(0.0), glm::dvec3(0.0) };    // if nothing were hidden
    std::array<glm::dvec3, 2> Visible{ glm::dvec3(0.0), glm::dvec3(0.0) }; // from the sky
    std::array<glm::dvec3, 2> Bounced{ glm::dvec3(0.0), glm::dvec3(0.0) }; // from what hides it
  };

  // A point with a material, a frame about its shading normal and a unit view in it.
  struct Receiver
  {
    SurfacePoint Point;
    vtkBRDF* Material;
    Frame Local;
    glm::dvec3 View;

    Receiver(const SurfacePoint& point, vtkBRDF* material, const glm::dvec3& view,
      const glm::dvec3& tangent)
      : Point(point)
      , Material(material)
      , Local(FrameAbout(point.Normal, tangent))
      , View(LiftView(ToLocal(this->Local, view)))
    {
    }
    glm::dvec3 Evaluate(const glm::dvec3& light) const
    {
      glm::dvec3 f;
      this->Material->Evaluate(&light.x, &this->View.x, &f.x);
      return f * light.z;
    }
  };

  // index: of the point, which has samples of its own.
  Sums Sample(const Receiver& receiver, std::uint32_t index, const Settings& settings) const
  {
    const std::uint64_t key = Mix(Mix(settings.Seed) + index);
    std::array<int, 3> counts{};
    counts[ByLight] =
      this->Sky.IsBlack() ? 0 : static_cast<int>(std::round(Shares[ByLight] * settings.Samples));
    counts[ByMaterial] = static_cast<int>(std::round(Shares[ByMaterial] * settings.Samples));
    counts[ByCosine] = std::max(settings.Samples - counts[ByLight] - counts[ByMaterial], 1);
    const double total = counts[ByLight] + counts[ByMaterial] + counts[ByCosine];
    const std::array<double, 3> shares = { counts[ByLight] / total, counts[ByMaterial] / total,
      counts[ByCosine] / total };
    Sums sums;
    for (std::size_t s = 0; s < 3; ++s)
    {
      for (int k = 0; k < counts[s]; ++k)
      {
        // Each half of a strategy's points is spread as evenly as the whole.
        const std::size_t half = k % 2;
        const std::uint64_t shift = Mix(key + 2 * s + half);
        const auto point = static_cast<std::uint32_t>(k / 2 + 1);
        const glm::dvec2 u(Wrap01(RadicalInverse(point, 2) + ToUnit(shift)),
          Wrap01(RadicalInverse(point, 3) + ToUnit(Mix(shift))));
        Draw draw;
        const double density = this->MakeDraw(receiver, static_cast<Strategy>(s), u, draw)
                                 ? this->GetDensity(receiver, draw, shares)
                                 : 0.0;
        if (density > 0.0)
        {
          this->Add(receiver, draw, 1.0 / (density * total), settings.Bounces, Mix(shift + point),
            half, sums);
        }
      }
    }
    return sums;
  }

private:
  struct Draw
  {
    glm::dvec3 Direction; // world
    glm::dvec3 Local;
  };

  // Whether it is above the horizon.
  bool MakeDraw(const Receiver& receiver, Strategy strategy, const glm::dvec2& u, Draw& draw) const
  {
    if (strategy == ByLight)
    {
      draw.Direction = this->Sky.Sample(u);
      draw.Local = ToLocal(receiver.Local, draw.Direction);
      return draw.Local.z > 0.0;
    }
    if (strategy == ByCosine)
    {
      SampleCosine(u.x, u.y, &draw.Local.x);
    }
    else if (!receiver.Material->Sample(&receiver.View.x, u.x, u.y, &draw.Local.x))
    {
      return false;
    }
    draw.Direction = receiver.Local * draw.Local;
    return draw.Local.z > 0.0;
  }

  double GetDensity(
    const Receiver& receiver, const Draw& draw, const std::array<double, 3>& shares) const
  {
    double density = shares[ByCosine] * draw.Local.z / Pi;
    if (shares[ByLight] > 0.0)
    {
      density += shares[ByLight] * this->Sky.GetDensity(draw.Direction);
    }
    const double material = receiver.Material->Pdf(&draw.Local.x, &receiver.View.x);
    return density + shares[ByMaterial] * (std::isfinite(material) ? material : 0.0);
  }

  // weight: solid angle that the direction stands for, in sr.
  void Add(const Receiver& receiver, const Draw& draw, double weight, int bounces,
    std::uint64_t path, std::size_t half, Sums& sums) const
  {
    const glm::dvec3 f = weight * receiver.Evaluate(draw.Local);
    const glm::dvec3 open = f * this->Sky.GetRadiance(draw.Direction);
    if (f == glm::dvec3(0.0) || (bounces == 0 && open == glm::dvec3(0.0)))
    {
      return;
    }
    sums.Open[half] += open;
    SurfacePoint hit;
    if (bounces > 0 && this->Scene.CastFrom(receiver.Point, draw.Direction, hit))
    {
      sums.Bounced[half] += f * this->Follow(hit, -draw.Direction, bounces, path);
    }
    else if (bounces > 0 || !this->Scene.IsHidden(receiver.Point, draw.Direction))
    {
      sums.Visible[half] += open;
    }
  }

  // One path from a point that a ray has met: an estimate of the radiance towards where it came
  // from.
  glm::dvec3 Follow(SurfacePoint point, glm::dvec3 view, int bounces, std::uint64_t path) const
  {
    glm::dvec3 share(1.0);
    const std::array<double, 3> shares =
      this->Sky.IsBlack() ? std::array<double, 3>{ 0.0, 0.5, 0.5 } : Shares;
    const auto getNext = [&path]() { return ToUnit(path = Mix(path)); };
    for (int k = 0; k < bounces; ++k)
    {
      const Receiver receiver(point, this->Materials[point.Surface], view, glm::dvec3(0.0));
      const double choice = getNext();
      const double first = getNext();
      const double second = getNext();
      const Strategy strategy = choice < shares[ByLight]                        ? ByLight
                                : choice < shares[ByLight] + shares[ByMaterial] ? ByMaterial
                                                                                : ByCosine;
      Draw draw;
      if (!this->MakeDraw(receiver, strategy, { first, second }, draw))
      {
        break;
      }
      const double density = this->GetDensity(receiver, draw, shares);
      share *= receiver.Evaluate(draw.Local) / density;
      if (!(density > 0.0) || share == glm::dvec3(0.0))
      {
        break;
      }
      if (!this->Scene.CastFrom(point, draw.Direction, point))
      {
        return share * this->Sky.GetRadiance(draw.Direction);
      }
      view = -draw.Direction;
    }
    return glm::dvec3(0.0);
  }

  const vtkTracedSurfaces& Scene;
  SkySampler Sky;
  std::vector<vtkBRDF*> Materials;
};
} // namespace measuredbrdf

namespace
{
using measuredbrdf::SurfacePoint;
using measuredbrdf::TracedRadiance;

constexpr int FewestSamples = 8;
constexpr int MostSamples = 1 << 24;
constexpr int MostBounces = 1000;
constexpr double OpenShare = 0.5; // of the progress, where the reference is integrated first

bool Fits(vtkDataArray* array, int components, vtkIdType count)
{
  return array && array->GetNumberOfComponents() == components &&
         array->GetNumberOfTuples() == count;
}

// Unit length; zero where that is not possible.
glm::dvec3 GetUnit(vtkDataArray* array, vtkIdType k)
{
  const glm::dvec3 d = measuredbrdf::GetDirection(array, k);
  return measuredbrdf::IsFiniteDirection(d) ? measuredbrdf::NormalizeAny(d) : glm::dvec3(0.0);
}

void Put(const std::vector<glm::dvec3>& values, vtkDataArray* array)
{
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    array->SetTuple(static_cast<vtkIdType>(k), &values[k].x);
  }
  array->Modified();
}

// What samples say of light that is known as a whole: the visible share of it, channel by channel.
glm::dvec3 GetVisible(const glm::dvec3& whole, const glm::dvec3& open, const glm::dvec3& visible)
{
  const double all = open.x + open.y + open.z;
  const double share = all > 0.0 ? (visible.x + visible.y + visible.z) / all : 1.0;
  glm::dvec3 result;
  for (int c = 0; c < 3; ++c)
  {
    result[c] = whole[c] * (open[c] > 0.0 ? visible[c] / open[c] : share);
  }
  return result;
}
} // namespace

/// One call of Integrate.
struct vtkTracedRadianceIntegrator::Run
{
  std::vector<TracedRadiance::Receiver> Receivers; // null material: nothing to integrate
  std::unique_ptr<TracedRadiance> Tracer;
  std::vector<glm::dvec3> Open; // by the reference; empty: from the samples
  std::vector<glm::dvec3> Radiance;
  std::vector<glm::dvec3> Unoccluded;
  std::vector<glm::dvec3> Errors;
};

vtkStandardNewMacro(vtkTracedRadianceIntegrator);

//------------------------------------------------------------------------------
vtkTracedRadianceIntegrator::vtkTracedRadianceIntegrator() = default;
vtkTracedRadianceIntegrator::~vtkTracedRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkCxxSetSmartPointerMacro(vtkTracedRadianceIntegrator, Scene, vtkTracedScene);
vtkCxxSetSmartPointerMacro(vtkTracedRadianceIntegrator, BRDF, vtkBRDF);
vtkCxxSetSmartPointerMacro(vtkTracedRadianceIntegrator, Environment, vtkEnvironment);
measuredbrdfSetClampedMacro(
  vtkTracedRadianceIntegrator, NumberOfSamples, int, FewestSamples, MostSamples);
measuredbrdfSetClampedMacro(vtkTracedRadianceIntegrator, NumberOfBounces, int, 0, MostBounces);

//------------------------------------------------------------------------------
vtkTracedScene* vtkTracedRadianceIntegrator::GetScene() { return this->Scene; }
vtkBRDF* vtkTracedRadianceIntegrator::GetBRDF() { return this->BRDF; }
vtkEnvironment* vtkTracedRadianceIntegrator::GetEnvironment() { return this->Environment; }

//------------------------------------------------------------------------------
void vtkTracedRadianceIntegrator::SetSurfaceBRDF(int surface, vtkBRDF* brdf)
{
  if (brdf)
  {
    this->SurfaceBRDFs[surface] = brdf;
  }
  else
  {
    this->SurfaceBRDFs.erase(surface);
  }
  this->Modified();
}

//------------------------------------------------------------------------------
vtkBRDF* vtkTracedRadianceIntegrator::GetSurfaceBRDF(int surface)
{
  const auto own = this->SurfaceBRDFs.find(surface);
  return own != this->SurfaceBRDFs.end() ? own->second : this->BRDF;
}

//------------------------------------------------------------------------------
bool vtkTracedRadianceIntegrator::Report(double progress)
{
  this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
  return !this->Abort;
}

//------------------------------------------------------------------------------
bool vtkTracedRadianceIntegrator::Check(
  vtkPolyData* points, vtkDataArray* views, vtkDataArray* tangents)
{
  if (!this->Scene || !this->Environment || this->Environment->GetPixels().empty())
  {
    vtkErrorMacro("Integrate: there is no scene or no environment, or the environment is empty.");
    return false;
  }
  for (int k = 0; k < std::max(this->Scene->GetNumberOfSurfaces(), 1); ++k)
  {
    if (!this->GetSurfaceBRDF(k))
    {
      vtkErrorMacro("Integrate: surface " << k << " has no BRDF.");
      return false;
    }
  }
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  if (!points || !Fits(views, 3, count) || (tangents && !Fits(tangents, 3, count)) ||
      !Fits(points->GetPointData()->GetNormals(), 3, count))
  {
    vtkErrorMacro("Integrate: points with normals, as many views and, if any, tangents are needed, "
                  "with 3 components each.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkTracedRadianceIntegrator::Integrate(vtkPolyData* points, vtkDataArray* views,
  vtkDataArray* radiance, vtkDataArray* unoccluded, vtkDataArray* tangents)
{
  this->Abort = false;
  if (!radiance || !this->Check(points, views, tangents))
  {
    if (!radiance)
    {
      vtkErrorMacro("Integrate: radiance is needed.");
    }
    return false;
  }
  std::vector<vtkBRDF*> materials;
  for (int k = 0; k < std::max(this->Scene->GetNumberOfSurfaces(), 1); ++k)
  {
    materials.push_back(this->GetSurfaceBRDF(k));
    materials.back()->Prepare();
  }
  Run run;
  run.Tracer =
    std::make_unique<TracedRadiance>(this->Scene->GetSurfaces(), this->Environment, materials);
  vtkPointData* data = points->GetPointData();
  const vtkIdType count = points->GetNumberOfPoints();
  vtkDataArray* facets = data->GetArray("FacetNormals");
  vtkDataArray* surfaces = data->GetArray("Surface");
  for (vtkIdType k = 0; k < count; ++k)
  {
    SurfacePoint point;
    points->GetPoint(k, &point.Position.x);
    point.Normal = GetUnit(data->GetNormals(), k);
    point.Facet = Fits(facets, 3, count) ? GetUnit(facets, k) : point.Normal;
    const double surface = Fits(surfaces, 1, count) ? surfaces->GetTuple1(k) : 0.0;
    const glm::dvec3 view = GetUnit(views, k);
    const bool valid = surface >= 0.0 && surface < static_cast<double>(materials.size()) &&
                       point.Normal != glm::dvec3(0.0) && view != glm::dvec3(0.0) &&
                       std::isfinite(glm::dot(point.Position, point.Position));
    vtkBRDF* material = valid ? materials[surface] : nullptr;
    run.Receivers.emplace_back(point, material, view, GetUnit(tangents, k));
  }
  if ((!this->UnoccludedReference || this->IntegrateOpen(run)) && this->Trace(run))
  {
    Put(run.Radiance, radiance);
    if (unoccluded)
    {
      Put(run.Unoccluded, unoccluded);
    }
    return true;
  }
  vtkErrorMacro("Integrate: aborted.");
  return false;
}

//------------------------------------------------------------------------------
// The reference without occlusion, material by material.
bool vtkTracedRadianceIntegrator::IntegrateOpen(Run& run)
{
  run.Open.assign(run.Receivers.size(), glm::dvec3(0.0));
  std::map<vtkBRDF*, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < run.Receivers.size(); ++k)
  {
    if (run.Receivers[k].Material)
    {
      groups[run.Receivers[k].Material].push_back(k);
    }
  }
  double done = 0.0;
  for (const auto& [material, members] : groups)
  {
    vtkNew<vtkAdaptiveRadianceIntegrator> reference;
    reference->SetBRDF(material);
    reference->SetEnvironment(this->Environment);
    const double share =
      OpenShare * static_cast<double>(members.size()) / static_cast<double>(run.Receivers.size());
    struct Follower
    {
      vtkTracedRadianceIntegrator* Whole;
      double Done;
      double Share;
      void Take(vtkObject* caller, unsigned long, void* progress)
      {
        static_cast<vtkRadianceIntegrator*>(caller)->SetAbort(
          !this->Whole->Report(this->Done + this->Share * *static_cast<double*>(progress)));
      }
    } follower{ this, done, share };
    reference->AddObserver(vtkCommand::ProgressEvent, &follower, &Follower::Take);
    std::vector<glm::dvec3> normals, views, tangents;
    for (const std::size_t k : members)
    {
      const TracedRadiance::Receiver& receiver = run.Receivers[k];
      normals.push_back(receiver.Point.Normal);
      views.push_back(receiver.Local * receiver.View);
      tangents.push_back(receiver.Local[0]);
    }
    vtkNew<vtkDoubleArray> arrays[4];
    Put(normals, arrays[0]);
    Put(views, arrays[1]);
    Put(tangents, arrays[2]);
    const measuredbrdf::ScopedErrorCapture aborted(reference); // Integrate says it
    if (!reference->Integrate(arrays[0], arrays[1], arrays[3], arrays[2]))
    {
      return false;
    }
    for (std::size_t k = 0; k < members.size(); ++k)
    {
      arrays[3]->GetTuple(static_cast<vtkIdType>(k), &run.Open[members[k]].x);
    }
    done += share;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkTracedRadianceIntegrator::Trace(Run& run)
{
  const std::size_t count = run.Receivers.size();
  run.Radiance.assign(count, glm::dvec3(0.0));
  run.Unoccluded.assign(count, glm::dvec3(0.0));
  run.Errors.assign(count, glm::dvec3(0.0));
  const TracedRadiance::Settings settings{ this->NumberOfSamples, this->NumberOfBounces,
    static_cast<std::uint32_t>(this->Seed) };
  const auto integrate = [&](std::size_t k)
  {
    const TracedRadiance::Receiver& receiver = run.Receivers[k];
    if (!receiver.Material)
    {
      return;
    }
    const auto index = static_cast<std::uint32_t>(k);
    const TracedRadiance::Sums sums = run.Tracer->Sample(receiver, index, settings);
    const bool open = !run.Open.empty();
    const glm::dvec3 all = sums.Open[0] + sums.Open[1];
    const glm::dvec3 visible = sums.Visible[0] + sums.Visible[1];
    run.Unoccluded[k] = open ? run.Open[k] : all;
    run.Radiance[k] =
      sums.Bounced[0] + sums.Bounced[1] + (open ? GetVisible(run.Open[k], all, visible) : visible);
    glm::dvec3 halves[2];
    for (std::size_t h = 0; h < 2; ++h)
    {
      halves[h] =
        2.0 * sums.Bounced[h] +
        (open ? GetVisible(run.Open[k], sums.Open[h], sums.Visible[h]) : 2.0 * sums.Visible[h]);
    }
    run.Errors[k] = 0.5 * glm::abs(halves[0] - halves[1]);
  };
  const double begun = run.Open.empty() ? 0.0 : OpenShare;
  const auto traceBatch = [&](vtkIdType first, vtkIdType size)
  {
    measuredbrdf::ParallelFor(first, first + size,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end && !this->Abort; ++k)
        {
          integrate(static_cast<std::size_t>(k));
        }
      });
  };
  if (!measuredbrdf::WorkInBatches(static_cast<vtkIdType>(count), traceBatch,
        [&](double share) { return this->Report(begun + (1.0 - begun) * share); }))
  {
    return false;
  }
  const auto sum = [](const std::vector<glm::dvec3>& values)
  {
    const glm::dvec3 all = std::accumulate(values.begin(), values.end(), glm::dvec3(0.0));
    return all.x + all.y + all.z;
  };
  const double radiance = sum(run.Radiance);
  this->Noise = radiance > 0.0 ? sum(run.Errors) / radiance : 0.0;
  return true;
}

//------------------------------------------------------------------------------
void vtkTracedRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scene: " << this->Scene.Get() << "\n";
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "SurfaceBRDFs: " << this->SurfaceBRDFs.size() << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "NumberOfBounces: " << this->NumberOfBounces << "\n";
  os << indent << "UnoccludedReference: " << (this->UnoccludedReference ? "On" : "Off") << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Noise: " << this->Noise << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
}
