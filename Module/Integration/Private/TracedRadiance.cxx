// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TracedRadiance.h"

#include "HalfVector.h" // for Pi, cosine samples
#include "LowDiscrepancy.h"
#include "TexelDirections.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
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
