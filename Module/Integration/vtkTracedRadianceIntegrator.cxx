// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTracedRadianceIntegrator.h"

#include "DirectionPairs.h"
#include "Distribution.h"
#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "Setters.h"
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
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace measuredbrdf
{
namespace
{
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
using Shares = std::array<double, 3>;
constexpr Shares UsualShares = { 0.5, 0.375, 0.125 };

// splitmix64 (Steele, Lea, Flood 2014): a different stream for each key.
std::uint64_t Mix(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

double ToUnit(std::uint64_t x) { return static_cast<double>(x >> 11) * 0x1p-53; }

double Sum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }
}

// Directions of the world in proportion to the light that comes from there.
class SkySampler
{
public:
  // The environment must stay, and its rotation is taken as it is now.
  explicit SkySampler(vtkEnvironment* environment)
    : Environment(environment)
    , Width(environment->GetWidth())
    , Height(environment->GetHeight())
  {
    double m[9];
    environment->GetWorldToEnvironment(m);
    this->ToEnvironment = glm::transpose(glm::make_mat3(m)); // glm takes columns
    std::vector<double> weights;
    for (int y = 0; y < this->Height; ++y)
    {
      for (int x = 0; x < this->Width; ++x)
      {
        weights.push_back(environment->GetTexelSolidAngle(y) * this->GetMean(x, y));
      }
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
    vtkEnvironment::GetDirection((x + inX) / this->Width, (y + inY) / this->Height, &d.x);
    return d * this->ToEnvironment; // transposed: back to the world
  }

  // In 1/sr.
  double GetDensity(const glm::dvec3& direction) const
  {
    const glm::dvec3 d = this->ToEnvironment * direction;
    double u = 0.0, v = 0.0;
    vtkEnvironment::GetCoordinates(&d.x, u, v);
    const int x = std::clamp(static_cast<int>(std::floor(u * this->Width)), 0, this->Width - 1);
    const int y = std::clamp(static_cast<int>(std::floor(v * this->Height)), 0, this->Height - 1);
    const double cosine = std::max(std::sqrt(std::max(1.0 - d.y * d.y, 0.0)), LeastCosine);
    return this->Texels.GetProbability(x, y) * this->Width * this->Height /
           (2.0 * Pi * Pi * cosine);
  }

  glm::dvec3 GetRadiance(const glm::dvec3& direction) const
  {
    const glm::dvec3 d = this->ToEnvironment * direction;
    glm::dvec3 radiance;
    this->Environment->GetRadiance(&d.x, &radiance.x);
    return radiance;
  }

private:
  // Over a texel, of what is interpolated linearly between the middles of it and its neighbors.
  double GetMean(int x, int y) const
  {
    double mean = 0.0;
    for (int k = 0; k < 9; ++k)
    {
      const int across = (x + k % 3 - 1 + this->Width) % this->Width;
      const int down = std::clamp(y + k / 3 - 1, 0, this->Height - 1);
      const std::size_t texel = static_cast<std::size_t>(down) * this->Width + across;
      const float* rgb = &this->Environment->GetPixels()[3 * texel];
      mean += (k % 3 == 1 ? 0.75 : 0.125) * (k / 3 == 1 ? 0.75 : 0.125) *
              Sum(glm::dvec3(glm::make_vec3(rgb)));
    }
    return mean;
  }

  vtkEnvironment* Environment;
  glm::dmat3 ToEnvironment;
  int Width;
  int Height;
  Distribution2D Texels;
};

// A point with a material, a frame about its shading normal and a unit view in it.
struct Receiver
{
  SurfacePoint Point;
  vtkBRDF* Material; // null: nothing to integrate
  Frame Local;
  glm::dvec3 View;

  Receiver(
    const SurfacePoint& point, vtkBRDF* material, const glm::dvec3& view, const glm::dvec3& tangent)
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

class TracedRadiance
{
public:
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
    glm::dvec3 Open{ 0.0 };    // if nothing were hidden
    glm::dvec3 Visible{ 0.0 }; // from the sky
    glm::dvec3 Bounced{ 0.0 }; // from what hides it
  };
  using Halves = std::array<Sums, 2>;

  // key: of the point, which has samples of its own.
  Halves Sample(const Receiver& receiver, std::uint64_t key, int samples, int bounces) const
  {
    std::array<int, 3> counts{};
    counts[ByLight] =
      this->Sky.IsBlack() ? 0 : static_cast<int>(std::round(UsualShares[ByLight] * samples));
    counts[ByMaterial] = static_cast<int>(std::round(UsualShares[ByMaterial] * samples));
    counts[ByCosine] = std::max(samples - counts[ByLight] - counts[ByMaterial], 1);
    const double total = counts[ByLight] + counts[ByMaterial] + counts[ByCosine];
    const Shares shares = { counts[ByLight] / total, counts[ByMaterial] / total,
      counts[ByCosine] / total };
    Halves sums;
    for (int s = 0; s < 3; ++s)
    {
      for (int k = 0; k < counts[s]; ++k)
      {
        // Each half of a strategy's points is spread as evenly as the whole.
        const std::uint64_t shift = Mix(key + 2 * s + k % 2);
        const auto point = static_cast<std::uint32_t>(k / 2 + 1);
        const glm::dvec2 u(Wrap01(RadicalInverse(point, 2) + ToUnit(shift)),
          Wrap01(RadicalInverse(point, 3) + ToUnit(Mix(shift))));
        Draw draw;
        if (this->MakeDraw(receiver, static_cast<Strategy>(s), u, shares, draw))
        {
          this->Add(
            receiver, draw, 1.0 / (draw.Density * total), bounces, Mix(shift + point), sums[k % 2]);
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
    double Density; // of all strategies, by their shares, in 1/sr
  };

  // Whether it is above the horizon, where it has a density.
  bool MakeDraw(const Receiver& receiver, Strategy strategy, const glm::dvec2& u,
    const Shares& shares, Draw& draw) const
  {
    if (strategy == ByLight)
    {
      draw.Direction = this->Sky.Sample(u);
      draw.Local = ToLocal(receiver.Local, draw.Direction);
    }
    else
    {
      draw.Local = glm::dvec3(0.0);
      if (strategy == ByCosine)
      {
        SampleCosine(u.x, u.y, &draw.Local.x);
      }
      else if (!receiver.Material->Sample(&receiver.View.x, u.x, u.y, &draw.Local.x))
      {
        return false;
      }
      draw.Direction = receiver.Local * draw.Local;
    }
    if (!(draw.Local.z > 0.0))
    {
      return false;
    }
    const double material = receiver.Material->Pdf(&draw.Local.x, &receiver.View.x);
    draw.Density =
      shares[ByCosine] * draw.Local.z / Pi +
      (shares[ByLight] > 0.0 ? shares[ByLight] * this->Sky.GetDensity(draw.Direction) : 0.0) +
      shares[ByMaterial] * (std::isfinite(material) ? material : 0.0);
    return draw.Density > 0.0;
  }

  // weight: solid angle that the direction stands for, in sr.
  void Add(const Receiver& receiver, const Draw& draw, double weight, int bounces,
    std::uint64_t path, Sums& sums) const
  {
    const glm::dvec3 f = weight * receiver.Evaluate(draw.Local);
    const glm::dvec3 open = f * this->Sky.GetRadiance(draw.Direction);
    if (f == glm::dvec3(0.0) || (bounces == 0 && open == glm::dvec3(0.0)))
    {
      return;
    }
    sums.Open += open;
    SurfacePoint hit;
    if (bounces > 0 && this->Scene.CastFrom(receiver.Point, draw.Direction, hit))
    {
      sums.Bounced += f * this->Follow(hit, -draw.Direction, bounces, path);
    }
    else if (bounces > 0 || !this->Scene.IsHidden(receiver.Point, draw.Direction))
    {
      sums.Visible += open;
    }
  }

  // One path from a point that a ray has met: an estimate of the radiance towards where it came
  // from.
  glm::dvec3 Follow(SurfacePoint point, glm::dvec3 view, int bounces, std::uint64_t path) const
  {
    glm::dvec3 share(1.0);
    const Shares shares = this->Sky.IsBlack() ? Shares{ 0.0, 0.5, 0.5 } : UsualShares;
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
      if (!this->MakeDraw(receiver, strategy, { first, second }, shares, draw))
      {
        break;
      }
      share *= receiver.Evaluate(draw.Local) / draw.Density;
      if (share == glm::dvec3(0.0))
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

using namespace measuredbrdf;

namespace
{
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
  const glm::dvec3 d = GetDirection(array, k);
  return IsFiniteDirection(d) ? NormalizeAny(d) : glm::dvec3(0.0);
}

void Put(const std::vector<glm::dvec3>& values, vtkDataArray* array)
{
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    array->SetTuple(k, &values[k].x);
  }
  array->Modified();
}

// What samples say of light that is known as a whole: the visible share of it, channel by channel.
glm::dvec3 GetVisible(const glm::dvec3& whole, const glm::dvec3& open, const glm::dvec3& visible)
{
  const double share = Sum(open) > 0.0 ? Sum(visible) / Sum(open) : 1.0;
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
  std::vector<Receiver> Receivers;
  std::unique_ptr<TracedRadiance> Tracer;
  std::vector<glm::dvec3> Open; // by the reference; empty: from the samples
  std::vector<glm::dvec3> Radiance;
  std::vector<glm::dvec3> Unoccluded;
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
// What is missing or does not match, or "".
std::string vtkTracedRadianceIntegrator::FindProblem(
  vtkPolyData* points, vtkDataArray* views, vtkDataArray* tangents)
{
  if (!this->Scene || !this->Environment || this->Environment->GetPixels().empty())
  {
    return "there is no scene or no environment, or the environment is empty.";
  }
  for (int k = 0; k < std::max(this->Scene->GetNumberOfSurfaces(), 1); ++k)
  {
    if (!this->GetSurfaceBRDF(k))
    {
      return "surface " + std::to_string(k) + " has no BRDF.";
    }
  }
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  const bool fit = points && Fits(views, 3, count) && (!tangents || Fits(tangents, 3, count)) &&
                   Fits(points->GetPointData()->GetNormals(), 3, count);
  return fit ? ""
             : "points with normals, as many views and, if any, tangents are needed, with 3 "
               "components each.";
}

//------------------------------------------------------------------------------
bool vtkTracedRadianceIntegrator::Integrate(vtkPolyData* points, vtkDataArray* views,
  vtkDataArray* radiance, vtkDataArray* unoccluded, vtkDataArray* tangents)
{
  this->Abort = false;
  const std::string problem =
    radiance ? this->FindProblem(points, views, tangents) : "radiance is needed.";
  if (!problem.empty())
  {
    vtkErrorMacro("Integrate: " << problem);
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
  if ((this->UnoccludedReference && !this->IntegrateOpen(run)) || !this->Trace(run))
  {
    vtkErrorMacro("Integrate: aborted.");
    return false;
  }
  Put(run.Radiance, radiance);
  if (unoccluded)
  {
    Put(run.Unoccluded, unoccluded);
  }
  return true;
}

//------------------------------------------------------------------------------
// The reference without occlusion, material by material. False where it was aborted.
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
  for (const auto& group : groups)
  {
    const std::vector<std::size_t>& members = group.second;
    vtkNew<vtkAdaptiveRadianceIntegrator> reference;
    reference->SetBRDF(group.first);
    reference->SetEnvironment(this->Environment);
    const double share = OpenShare * members.size() / run.Receivers.size();
    const auto integrate = [&](vtkIdType first, vtkIdType size)
    {
      std::vector<glm::dvec3> normals, views, tangents;
      for (vtkIdType k = first; k < first + size; ++k)
      {
        const Receiver& receiver = run.Receivers[members[k]];
        normals.push_back(receiver.Point.Normal);
        views.push_back(receiver.Local * receiver.View);
        tangents.push_back(receiver.Local[0]);
      }
      vtkNew<vtkDoubleArray> arrays[4];
      Put(normals, arrays[0]);
      Put(views, arrays[1]);
      Put(tangents, arrays[2]);
      reference->Integrate(arrays[0], arrays[1], arrays[3], arrays[2]);
      for (vtkIdType k = 0; k < size; ++k)
      {
        arrays[3]->GetTuple(k, &run.Open[members[first + k]].x);
      }
    };
    if (!WorkInBatches(members.size(), integrate,
          [&](double part) { return this->Report(done + share * part); }))
    {
      return false;
    }
    done += share;
  }
  return true;
}

//------------------------------------------------------------------------------
// False where it was aborted.
bool vtkTracedRadianceIntegrator::Trace(Run& run)
{
  const std::size_t count = run.Receivers.size();
  run.Radiance.assign(count, glm::dvec3(0.0));
  run.Unoccluded.assign(count, glm::dvec3(0.0));
  std::vector<glm::dvec3> errors(count, glm::dvec3(0.0));
  const bool isKnown = !run.Open.empty();
  const auto integrate = [&](vtkIdType k)
  {
    if (!run.Receivers[k].Material)
    {
      return;
    }
    const std::uint64_t key =
      Mix(Mix(static_cast<std::uint32_t>(this->Seed)) + static_cast<std::uint32_t>(k));
    const auto [a, b] =
      run.Tracer->Sample(run.Receivers[k], key, this->NumberOfSamples, this->NumberOfBounces);
    // times: how often the samples must be taken to be all.
    const auto getRadiance = [&](const TracedRadiance::Sums& sums, double times)
    {
      return times * sums.Bounced +
             (isKnown ? GetVisible(run.Open[k], sums.Open, sums.Visible) : times * sums.Visible);
    };
    const TracedRadiance::Sums all{ a.Open + b.Open, a.Visible + b.Visible, a.Bounced + b.Bounced };
    run.Unoccluded[k] = isKnown ? run.Open[k] : all.Open;
    run.Radiance[k] = getRadiance(all, 1.0);
    errors[k] = 0.5 * glm::abs(getRadiance(a, 2.0) - getRadiance(b, 2.0));
  };
  const double begun = isKnown ? OpenShare : 0.0;
  const auto traceBatch = [&](vtkIdType first, vtkIdType size)
  {
    ParallelForEach(
      size, [&](vtkIdType k) { integrate(first + k); }, &this->Abort, 0);
  };
  if (!WorkInBatches(count, traceBatch,
        [&](double share) { return this->Report(begun + (1.0 - begun) * share); }))
  {
    return false;
  }
  const auto sum = [](const std::vector<glm::dvec3>& values)
  { return Sum(std::accumulate(values.begin(), values.end(), glm::dvec3(0.0))); };
  const double radiance = sum(run.Radiance);
  this->Noise = radiance > 0.0 ? sum(errors) / radiance : 0.0;
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
