// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTracedRadianceIntegrator.h"

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
#include "vtkCallbackCommand.h"
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

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

namespace measuredbrdf
{
class SkySampler
{
public:
  /// World directions; the environment must stay, and its rotation is taken as it is now.
  explicit SkySampler(vtkEnvironment* environment);

  /// Whether there is no light at all: then nothing can be drawn.
  bool IsBlack() const { return this->Texels.IsZero(); }

  /// Unit direction from two uniform numbers.
  glm::dvec3 Sample(const glm::dvec2& u) const;

  /// Its density in 1/sr, and the radiance from there.
  double GetDensity(const glm::dvec3& direction) const;
  glm::dvec3 GetRadiance(const glm::dvec3& direction) const;

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

  /// materials: of each surface; all prepared.
  TracedRadiance(
    const vtkTracedSurfaces& scene, vtkEnvironment* environment, std::vector<vtkBRDF*> materials)
    : Scene(scene)
    , Sky(environment)
    , Environment(environment)
    , Materials(std::move(materials))
  {
  }

  /// Sums over samples; two independent halves, for the noise.
  struct Sums
  {
    std::array<glm::dvec3, 2> Open{ glm::dvec3(0.0), glm::dvec3(0.0) };    // if nothing were hidden
    std::array<glm::dvec3, 2> Visible{ glm::dvec3(0.0), glm::dvec3(0.0) }; // from the sky
    std::array<glm::dvec3, 2> Bounced{ glm::dvec3(0.0), glm::dvec3(0.0) }; // from what hides it
  };

  /// A point with a material, a frame about its shading normal and a unit view in it.
  struct Receiver
  {
    SurfacePoint Point;
    vtkBRDF* Material;
    Frame Local;
    glm::dvec3 View;
  };
  Receiver MakeReceiver(const SurfacePoint& point, vtkBRDF* material, const glm::dvec3& view,
    const glm::dvec3& tangent) const;

  /// By samples. index: of the point, which has samples of its own.
  Sums Sample(const Receiver& receiver, std::uint32_t index, const Settings& settings) const;

  /// By the centers of all texels (of vtkEnvironment::GetSubdivided).
  Sums SumTexels(const Receiver& receiver, std::uint32_t index, const Settings& settings) const;

private:
  struct Draw
  {
    glm::dvec3 Direction; // world
    glm::dvec3 Local;
  };
  enum Strategy
  {
    ByLight,
    ByMaterial,
    ByCosine
  };
  bool DrawDirection(
    const Receiver& receiver, Strategy strategy, const glm::dvec2& u, Draw& draw) const;
  double GetDensity(
    const Receiver& receiver, const Draw& draw, const std::array<double, 3>& shares) const;
  void Add(const Receiver& receiver, const Draw& draw, double weight, int bounces,
    std::uint64_t path, Sums& sums, std::size_t half) const;
  glm::dvec3 Follow(SurfacePoint point, glm::dvec3 view, int bounces, std::uint64_t path) const;

  const vtkTracedSurfaces& Scene;
  SkySampler Sky;
  vtkEnvironment* Environment;
  std::vector<vtkBRDF*> Materials;
};

namespace
{
// The mean over a texel of what is interpolated linearly between the middles of it and its
// neighbors.
constexpr double OwnShare = 0.75;
constexpr double NeighborShare = 0.125;
// Below this cosine of the latitude, next to a pole, densities per solid angle end.
constexpr double LeastCosine = 1e-6;

glm::dmat3 GetTurn(vtkEnvironment* environment)
{
  double m[9];
  environment->GetWorldToEnvironment(m);
  return glm::dmat3(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]); // glm takes columns
}
} // namespace

//------------------------------------------------------------------------------
SkySampler::SkySampler(vtkEnvironment* environment)
  : Environment(environment)
  , ToEnvironment(GetTurn(environment))
  , Width(static_cast<std::size_t>(environment->GetWidth()))
  , Height(static_cast<std::size_t>(environment->GetHeight()))
{
  const std::vector<float>& pixels = environment->GetPixels();
  std::vector<double> sums(this->Width * this->Height); // of the channels, mixed along rows
  const auto sum = [&](std::size_t x, std::size_t y)
  {
    const float* p = &pixels[3 * (y * this->Width + x)];
    return static_cast<double>(p[0]) + static_cast<double>(p[1]) + static_cast<double>(p[2]);
  };
  for (std::size_t y = 0; y < this->Height; ++y)
  {
    for (std::size_t x = 0; x < this->Width; ++x)
    {
      const std::size_t left = x > 0 ? x - 1 : this->Width - 1;
      const std::size_t right = x + 1 < this->Width ? x + 1 : 0;
      sums[y * this->Width + x] =
        OwnShare * sum(x, y) + NeighborShare * (sum(left, y) + sum(right, y));
    }
  }
  std::vector<double> weights(sums.size());
  for (std::size_t y = 0; y < this->Height; ++y)
  {
    const std::size_t below = y > 0 ? y - 1 : 0;
    const std::size_t above = std::min(y + 1, this->Height - 1);
    const double solidAngle = environment->GetTexelSolidAngle(static_cast<int>(y));
    for (std::size_t x = 0; x < this->Width; ++x)
    {
      weights[y * this->Width + x] =
        solidAngle *
        (OwnShare * sums[y * this->Width + x] +
          NeighborShare * (sums[below * this->Width + x] + sums[above * this->Width + x]));
    }
  }
  this->Texels = Distribution2D(weights, this->Width, this->Height);
}

//------------------------------------------------------------------------------
glm::dvec3 SkySampler::Sample(const glm::dvec2& u) const
{
  std::size_t x = 0;
  std::size_t y = 0;
  double inX = 0.0;
  double inY = 0.0;
  this->Texels.Invert(u.x, u.y, x, y, inX, inY);
  glm::dvec3 d;
  vtkEnvironment::GetDirection((static_cast<double>(x) + inX) / static_cast<double>(this->Width),
    (static_cast<double>(y) + inY) / static_cast<double>(this->Height), &d.x);
  return d * this->ToEnvironment; // transposed: back to the world
}

//------------------------------------------------------------------------------
double SkySampler::GetDensity(const glm::dvec3& direction) const
{
  const glm::dvec3 d = this->ToEnvironment * direction;
  double u = 0.0;
  double v = 0.0;
  vtkEnvironment::GetCoordinates(&d.x, u, v);
  const double width = static_cast<double>(this->Width);
  const double height = static_cast<double>(this->Height);
  const auto x = static_cast<std::size_t>(std::clamp(std::floor(u * width), 0.0, width - 1.0));
  const auto y = static_cast<std::size_t>(std::clamp(std::floor(v * height), 0.0, height - 1.0));
  const double cosine = std::max(std::sqrt(std::max(1.0 - d.y * d.y, 0.0)), LeastCosine);
  return this->Texels.GetProbability(x, y) * width * height / (2.0 * Pi * Pi * cosine);
}

//------------------------------------------------------------------------------
glm::dvec3 SkySampler::GetRadiance(const glm::dvec3& direction) const
{
  const glm::dvec3 d = this->ToEnvironment * direction;
  glm::dvec3 radiance;
  this->Environment->GetRadiance(&d.x, &radiance.x);
  return radiance;
}

namespace
{
// Of the draws: by the sky's radiance, by the material, by the cosine, which leaves no direction
// out.
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

bool IsZero(const glm::dvec3& v) { return v.x == 0.0 && v.y == 0.0 && v.z == 0.0; }
} // namespace

//------------------------------------------------------------------------------
TracedRadiance::Receiver TracedRadiance::MakeReceiver(const SurfacePoint& point, vtkBRDF* material,
  const glm::dvec3& view, const glm::dvec3& tangent) const
{
  Receiver receiver{ point, material, FrameAbout(point.Normal, tangent), glm::dvec3(0.0) };
  receiver.View = LiftView(ToLocal(receiver.Local, view));
  return receiver;
}

//------------------------------------------------------------------------------
bool TracedRadiance::DrawDirection(
  const Receiver& receiver, Strategy strategy, const glm::dvec2& u, Draw& draw) const
{
  if (strategy == ByLight)
  {
    draw.Direction = this->Sky.Sample(u);
    draw.Local = ToLocal(receiver.Local, draw.Direction);
    return draw.Local.z > 0.0;
  }
  if (strategy == ByMaterial)
  {
    if (!receiver.Material->Sample(&receiver.View.x, u.x, u.y, &draw.Local.x))
    {
      return false;
    }
  }
  else
  {
    const double radius = std::sqrt(u.x);
    draw.Local = glm::dvec3(radius * std::cos(2.0 * Pi * u.y), radius * std::sin(2.0 * Pi * u.y),
      std::sqrt(std::max(1.0 - u.x, 0.0)));
  }
  draw.Direction = receiver.Local * draw.Local;
  return draw.Local.z > 0.0;
}

//------------------------------------------------------------------------------
double TracedRadiance::GetDensity(
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

//------------------------------------------------------------------------------
// weight: solid angle that the direction stands for, in sr.
void TracedRadiance::Add(const Receiver& receiver, const Draw& draw, double weight, int bounces,
  std::uint64_t path, Sums& sums, std::size_t half) const
{
  glm::dvec3 f;
  receiver.Material->Evaluate(&draw.Local.x, &receiver.View.x, &f.x);
  f *= weight * draw.Local.z;
  const glm::dvec3 open = f * this->Sky.GetRadiance(draw.Direction);
  if (IsZero(f) || (bounces == 0 && IsZero(open)))
  {
    return;
  }
  sums.Open[half] += open;
  if (bounces == 0)
  {
    if (!this->Scene.IsHidden(receiver.Point, draw.Direction))
    {
      sums.Visible[half] += open;
    }
    return;
  }
  SurfacePoint hit;
  if (this->Scene.CastFrom(receiver.Point, draw.Direction, hit))
  {
    sums.Bounced[half] += f * this->Follow(hit, -draw.Direction, bounces, path);
  }
  else
  {
    sums.Visible[half] += open;
  }
}

//------------------------------------------------------------------------------
// One path from a point that a ray has met: an estimate of the radiance towards where it came from.
glm::dvec3 TracedRadiance::Follow(
  SurfacePoint point, glm::dvec3 view, int bounces, std::uint64_t path) const
{
  glm::dvec3 share(1.0);
  std::array<double, 3> shares = Shares;
  if (this->Sky.IsBlack())
  {
    shares = { 0.0, 0.5, 0.5 };
  }
  for (int k = 0; k < bounces; ++k)
  {
    const Receiver receiver = this->MakeReceiver(
      point, this->Materials[static_cast<std::size_t>(point.Surface)], view, glm::dvec3(0.0));
    path = Mix(path);
    const double choice = ToUnit(path);
    path = Mix(path);
    glm::dvec2 u;
    u.x = ToUnit(path);
    path = Mix(path);
    u.y = ToUnit(path);
    const Strategy strategy = choice < shares[ByLight]                        ? ByLight
                              : choice < shares[ByLight] + shares[ByMaterial] ? ByMaterial
                                                                              : ByCosine;
    Draw draw;
    if (!this->DrawDirection(receiver, strategy, u, draw))
    {
      break;
    }
    const double density = this->GetDensity(receiver, draw, shares);
    glm::dvec3 f;
    receiver.Material->Evaluate(&draw.Local.x, &receiver.View.x, &f.x);
    share *= f * draw.Local.z / density;
    if (!(density > 0.0) || IsZero(share))
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

//------------------------------------------------------------------------------
TracedRadiance::Sums TracedRadiance::Sample(
  const Receiver& receiver, std::uint32_t index, const Settings& settings) const
{
  const std::uint64_t key = Mix(Mix(settings.Seed) + index);
  std::array<int, 3> counts{};
  counts[ByLight] =
    this->Sky.IsBlack() ? 0 : static_cast<int>(std::round(Shares[ByLight] * settings.Samples));
  counts[ByMaterial] = static_cast<int>(std::round(Shares[ByMaterial] * settings.Samples));
  counts[ByCosine] = std::max(settings.Samples - counts[ByLight] - counts[ByMaterial], 1);
  const double total = counts[ByLight] + counts[ByMaterial] + counts[ByCosine];
  std::array<double, 3> shares{};
  for (std::size_t s = 0; s < 3; ++s)
  {
    shares[s] = counts[s] / total;
  }
  Sums sums;
  for (std::size_t s = 0; s < 3; ++s)
  {
    for (int k = 0; k < counts[s]; ++k)
    {
      // Each half of a strategy's points is spread as evenly as the whole.
      const std::size_t half = static_cast<std::size_t>(k % 2);
      const std::uint64_t shift = Mix(key + 2 * s + half);
      const auto point = static_cast<std::uint32_t>(k / 2 + 1);
      const glm::dvec2 u(Wrap01(RadicalInverse(point, 2) + ToUnit(shift)),
        Wrap01(RadicalInverse(point, 3) + ToUnit(Mix(shift))));
      Draw draw;
      if (this->DrawDirection(receiver, static_cast<Strategy>(s), u, draw))
      {
        const double density = this->GetDensity(receiver, draw, shares);
        if (density > 0.0)
        {
          this->Add(receiver, draw, 1.0 / (density * total), settings.Bounces, Mix(shift + point),
            sums, half);
        }
      }
    }
  }
  return sums;
}

//------------------------------------------------------------------------------
TracedRadiance::Sums TracedRadiance::SumTexels(
  const Receiver& receiver, std::uint32_t index, const Settings& settings) const
{
  vtkEnvironment* environment = this->Environment->GetSubdivided();
  const TexelDirections directions(environment->GetWidth(), environment->GetHeight());
  double m[9];
  this->Environment->GetWorldToEnvironment(m);
  const glm::dmat3 toWorld(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]); // transposed
  Sums sums;
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      Draw draw;
      draw.Direction = toWorld * directions.Get(x, y);
      draw.Local = ToLocal(receiver.Local, draw.Direction);
      if (draw.Local.z > 0.0)
      {
        const auto texel = static_cast<std::uint64_t>(y) * 1000003u + static_cast<std::uint64_t>(x);
        this->Add(receiver, draw, environment->GetTexelSolidAngle(y), settings.Bounces,
          Mix(Mix(settings.Seed + texel) + index), sums, static_cast<std::size_t>(x % 2));
      }
    }
  }
  return sums;
}
} // namespace measuredbrdf

namespace
{
using measuredbrdf::SurfacePoint;
using measuredbrdf::TracedRadiance;

constexpr int FewestSamples = 8;
constexpr int MostSamples = 1 << 24;
constexpr int MostBounces = 1000;
// What the calling thread waits for between two looks at the abort flag and the progress.
constexpr std::chrono::milliseconds BatchTime(100);
constexpr double OpenShare = 0.5; // of the progress, where the reference is integrated first

bool Fits(vtkDataArray* array, int components, vtkIdType count)
{
  return array && array->GetNumberOfComponents() == components &&
         array->GetNumberOfTuples() == count;
}

// Unit length; zero where that is not possible.
glm::dvec3 GetUnit(vtkDataArray* array, vtkIdType k)
{
  glm::dvec3 d(0.0);
  if (array)
  {
    array->GetTuple(k, &d.x);
  }
  const double largest = std::max({ std::abs(d.x), std::abs(d.y), std::abs(d.z) });
  return largest > 0.0 && std::isfinite(d.x + d.y + d.z) ? glm::normalize(d / largest)
                                                         : glm::dvec3(0.0);
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

double Sum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }

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
  std::vector<TracedRadiance::Receiver> Receivers; // null material: nothing to integrate
  std::unique_ptr<TracedRadiance> Tracer;
  std::vector<glm::dvec3> Open; // by the reference; empty: from the samples
  std::vector<glm::dvec3> Radiance;
  std::vector<glm::dvec3> Unoccluded;
  std::vector<double> Errors;
};

vtkStandardNewMacro(vtkTracedRadianceIntegrator);

//------------------------------------------------------------------------------
vtkTracedRadianceIntegrator::vtkTracedRadianceIntegrator() = default;
vtkTracedRadianceIntegrator::~vtkTracedRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkCxxSetSmartPointerMacro(vtkTracedRadianceIntegrator, Scene, vtkTracedScene);
vtkCxxSetSmartPointerMacro(vtkTracedRadianceIntegrator, BRDF, vtkBRDF);
vtkCxxSetSmartPointerMacro(vtkTracedRadianceIntegrator, Environment, vtkEnvironment);
measuredbrdfSetClampedMacro(vtkTracedRadianceIntegrator, NumberOfBounces, int, 0, MostBounces);

//------------------------------------------------------------------------------
void vtkTracedRadianceIntegrator::SetNumberOfSamples(int value)
{
  const int taken = value == 0 ? 0 : std::clamp(value, FewestSamples, MostSamples);
  if (taken != value)
  {
    vtkWarningMacro("SetNumberOfSamples: " << value << " is neither 0 nor from " << FewestSamples
                                           << " to " << MostSamples << "; " << taken
                                           << " is taken.");
  }
  if (this->NumberOfSamples != taken)
  {
    this->NumberOfSamples = taken;
    this->Modified();
  }
}

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
    vtkBRDF* material = valid ? materials[static_cast<std::size_t>(surface)] : nullptr;
    run.Receivers.push_back(run.Tracer->MakeReceiver(point, material, view, GetUnit(tangents, k)));
  }
  if (!(this->UnoccludedReference && this->NumberOfSamples > 0 && !this->IntegrateOpen(run)) &&
      this->Trace(run))
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
    const auto follow = [&](double progress) { return this->Report(done + share * progress); };
    using Follow = decltype(follow);
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(const_cast<void*>(static_cast<const void*>(&follow)));
    command->SetCallback(
      [](vtkObject* caller, unsigned long, void* self, void* progress)
      {
        static_cast<vtkRadianceIntegrator*>(caller)->SetAbort(
          !(*static_cast<Follow*>(self))(*static_cast<double*>(progress)));
      });
    reference->AddObserver(vtkCommand::ProgressEvent, command);
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec3> views;
    std::vector<glm::dvec3> tangents;
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
  run.Errors.assign(count, 0.0);
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
    const TracedRadiance::Sums sums = settings.Samples > 0
                                        ? run.Tracer->Sample(receiver, index, settings)
                                        : run.Tracer->SumTexels(receiver, index, settings);
    const bool open = !run.Open.empty();
    run.Unoccluded[k] = open ? run.Open[k] : sums.Open[0] + sums.Open[1];
    const glm::dvec3 visible = sums.Visible[0] + sums.Visible[1];
    run.Radiance[k] =
      sums.Bounced[0] + sums.Bounced[1] +
      (open ? GetVisible(run.Open[k], sums.Open[0] + sums.Open[1], visible) : visible);
    glm::dvec3 halves[2];
    for (std::size_t h = 0; h < 2; ++h)
    {
      halves[h] =
        2.0 * sums.Bounced[h] +
        (open ? GetVisible(run.Open[k], sums.Open[h], sums.Visible[h]) : 2.0 * sums.Visible[h]);
    }
    run.Errors[k] = settings.Samples > 0 ? 0.5 * Sum(glm::abs(halves[0] - halves[1])) : 0.0;
  };
  const double begun = run.Open.empty() ? 0.0 : OpenShare;
  std::size_t batch = 1;
  for (std::size_t first = 0; first < count;)
  {
    const std::size_t size = std::min(batch, count - first);
    const auto start = std::chrono::steady_clock::now();
    measuredbrdf::ParallelFor(static_cast<vtkIdType>(first), static_cast<vtkIdType>(first + size),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end && !this->Abort; ++k)
        {
          integrate(static_cast<std::size_t>(k));
        }
      });
    first += size;
    if (std::chrono::steady_clock::now() - start < BatchTime / 2)
    {
      batch *= 2;
    }
    const double share = static_cast<double>(first) / static_cast<double>(count);
    if (!this->Report(begun + (1.0 - begun) * share))
    {
      return false;
    }
  }
  double error = 0.0;
  double radiance = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    error += run.Errors[k];
    radiance += Sum(run.Radiance[k]);
  }
  this->Noise = radiance > 0.0 ? error / radiance : 0.0;
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
