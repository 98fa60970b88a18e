// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPBRPropertyFitter.h"

#include "HalfVector.h" // for Pi
#include "LowDiscrepancy.h"
#include "PBRShading.h"
#include "vtkBRDF.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkProperty.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkPBRPropertyFitter);

namespace
{
// Rings of pixels, each of the same area on the sphere's disc, and pixels of a ring.
constexpr int NumberOfPBRViews = 12;
constexpr int NumberOfPBRAzimuths = 16;
constexpr int TangentsOfAnisotropic = 4;

// Directions to the light are drawn from the cosine and from GGX lobes of these roughnesses, and
// weighted as one mixture (Veach and Guibas 1995, the balance heuristic): smooth lobes of any width
// between are summed to 1 %.
constexpr std::array<double, 5> LobeRoughnesses = { 0.06, 0.12, 0.25, 0.45, 0.7 };
constexpr int DrawsOfLobe = 192;
constexpr int DrawsOfCosine = 256;

//------------------------------------------------------------------------------
// Density of i where h is drawn from D(h) cos(theta_h) (Walter et al. 2007, equation 38).
double GetLobeDensity(double roughness, double ndh, double hdl)
{
  const double alpha2 = std::pow(roughness, 4);
  const double d = (ndh * alpha2 - ndh) * ndh + 1.0;
  return alpha2 * ndh / (Pi * d * d * 4.0 * std::max(hdl, 1e-9));
}

// Pictures of a sphere under a gray light, drawn by a measured material and by VTK's physically
// based shading with the same quadrature, so that they can be compared.
class PBRPicture
{
public:
  using Light = std::function<double(const glm::dvec3&)>;

  /// The brdf must be prepared. The light is gray radiance by direction, with no details finer than
  /// ten degrees. The sphere is seen from +z.
  PBRPicture(vtkBRDF* brdf, const Light& light)
  {
    for (int k = 0; k < NumberOfPBRViews; ++k)
    {
      this->AddView(std::sqrt(1.0 - (k + 0.5) / NumberOfPBRViews));
      this->AddPixels(k, light);
    }
    this->Draw(brdf);
  }

  /// Base color of least error for the other parameters (of a roughness in hundredths), and that
  /// error: relative L1 over pixels and channels.
  double FitColor(const PBRParameters& parameters, std::array<double, 3>& color)
  {
    constexpr int rounds = 2;
    std::vector<Quadratic> radiance;
    double sum = 0.0;
    // The reflectance at grazing incidence depends on all three channels where F0 is below 2 %:
    // fit, fit again with the one that belongs to the color, and measure with that of the last
    // color.
    double f90 = GetPBRGrazing(parameters, color);
    for (int k = 0; k <= rounds; ++k)
    {
      this->GetRadiance(parameters, f90, radiance);
      sum = 0.0;
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        sum += k < rounds ? this->FitChannel(radiance, channel, color[channel])
                          : this->GetDistance(radiance, channel, color[channel]);
      }
      const double next = GetPBRGrazing(parameters, color);
      if (next == f90)
      {
        break;
      }
      f90 = next;
    }
    return sum > 0.0 ? sum / this->Total : 0.0;
  }

private:
  // A direction to the light adds f * Weight * L to a pixel's radiance.
  struct Direction
  {
    glm::dvec3 Local;
    double Weight;
    double NdH;
    double S; // (1 - H.L)^5
  };
  struct Pixel
  {
    int View;
    std::vector<double> Light; // Weight * L of each of the view's directions
    PBRMoments Diffuse;
  };
  /// Radiance of a pixel as a polynomial of the channel's base color.
  using Quadratic = std::array<double, 3>;

  void AddView(double cosine)
  {
    const glm::dvec3 o(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
    std::vector<Direction> directions;
    const auto add = [&](const glm::dvec3& i)
    {
      if (!(i.z > 1e-6))
      {
        return;
      }
      const glm::dvec3 h = glm::normalize(i + o);
      const double hdl = std::min(glm::dot(h, i), 1.0);
      double density = DrawsOfCosine * i.z / Pi;
      for (const double roughness : LobeRoughnesses)
      {
        density += DrawsOfLobe * GetLobeDensity(roughness, h.z, hdl);
      }
      directions.push_back({ i, i.z / density, h.z, std::pow(1.0 - hdl, 5) });
    };
    for (int k = 0; k < DrawsOfCosine; ++k)
    {
      const double r = std::sqrt((k + 0.5) / DrawsOfCosine);
      const double phi = 2.0 * Pi * RadicalInverse(static_cast<std::uint32_t>(k), 2);
      add({ r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - r * r) });
    }
    for (const double roughness : LobeRoughnesses)
    {
      const double alpha2 = std::pow(roughness, 4);
      for (int k = 0; k < DrawsOfLobe; ++k)
      {
        // Walter et al. 2007, equation 35: tan^2(theta_h) = alpha^2 u / (1 - u).
        const double u = (k + 0.5) / DrawsOfLobe;
        const double z = 1.0 / std::sqrt(1.0 + alpha2 * u / (1.0 - u));
        const double r = std::sqrt(1.0 - z * z);
        const double phi = 2.0 * Pi * RadicalInverse(static_cast<std::uint32_t>(k), 2);
        const glm::dvec3 h(r * std::cos(phi), r * std::sin(phi), z);
        const double hdo = glm::dot(h, o);
        if (hdo > 0.0)
        {
          add(2.0 * hdo * h - o);
        }
      }
    }
    this->ViewCosines.push_back(cosine);
    this->Directions.push_back(std::move(directions));
  }

  void AddPixels(int view, const Light& light)
  {
    const double z = this->ViewCosines[static_cast<std::size_t>(view)];
    const double r = std::sqrt(1.0 - z * z);
    for (int k = 0; k < NumberOfPBRAzimuths; ++k)
    {
      // Rings are turned against each other.
      const double phi = 2.0 * Pi * (k + 0.5 * (view % 2)) / NumberOfPBRAzimuths;
      const glm::dvec3 normal(r * std::cos(phi), r * std::sin(phi), z);
      // The eye at +z lies in the plane of tangent and normal.
      const glm::dvec3 tangent(-z * std::cos(phi), -z * std::sin(phi), r);
      const glm::dvec3 bitangent = glm::cross(normal, tangent);
      Pixel pixel{ view, {}, {} };
      for (const Direction& d : this->Directions[static_cast<std::size_t>(view)])
      {
        const glm::dvec3 world = d.Local.x * tangent + d.Local.y * bitangent + d.Local.z * normal;
        const double value = d.Weight * light(world);
        pixel.Light.push_back(value);
        double power = value / Pi;
        for (double& moment : pixel.Diffuse)
        {
          moment += power;
          power *= d.S;
        }
      }
      this->Pixels.push_back(std::move(pixel));
    }
  }

  void Draw(vtkBRDF* brdf)
  {
    this->NumberOfTangents = brdf->IsIsotropic() ? 1 : TangentsOfAnisotropic;
    const auto tangents = static_cast<std::size_t>(this->NumberOfTangents);
    this->Reference.assign(3 * this->Pixels.size() * tangents, 0.0);
    std::vector<double> f;
    for (int view = 0; view < NumberOfPBRViews; ++view)
    {
      const std::vector<Direction>& directions = this->Directions[static_cast<std::size_t>(view)];
      const double z = this->ViewCosines[static_cast<std::size_t>(view)];
      const double r = std::sqrt(1.0 - z * z);
      for (int tangent = 0; tangent < this->NumberOfTangents; ++tangent)
      {
        const double phi = Pi * tangent / this->NumberOfTangents;
        const double c = std::cos(phi);
        const double s = std::sin(phi);
        const double o[3] = { r * c, r * s, z };
        f.resize(3 * directions.size());
        for (std::size_t k = 0; k < directions.size(); ++k)
        {
          const glm::dvec3& d = directions[k].Local;
          const double i[3] = { c * d.x - s * d.y, s * d.x + c * d.y, d.z };
          brdf->Evaluate(i, o, &f[3 * k]);
        }
        for (std::size_t p = 0; p < this->Pixels.size(); ++p)
        {
          const Pixel& pixel = this->Pixels[p];
          if (pixel.View != view)
          {
            continue;
          }
          double* rgb = &this->Reference[3 * (p * tangents + static_cast<std::size_t>(tangent))];
          for (std::size_t k = 0; k < directions.size(); ++k)
          {
            for (std::size_t channel = 0; channel < 3; ++channel)
            {
              rgb[channel] += pixel.Light[k] * f[3 * k + channel];
            }
          }
        }
      }
    }
    for (const double value : this->Reference)
    {
      this->Total += value;
    }
  }

  const std::vector<PBRMoments>& GetSpecularMoments(double roughness)
  {
    std::vector<PBRMoments>& moments =
      this->SpecularMoments[static_cast<int>(std::lround(100.0 * roughness))];
    if (!moments.empty())
    {
      return moments;
    }
    std::vector<std::vector<double>> lobes(NumberOfPBRViews);
    for (std::size_t view = 0; view < lobes.size(); ++view)
    {
      for (const Direction& d : this->Directions[view])
      {
        lobes[view].push_back(GetPBRLobe(d.NdH, this->ViewCosines[view], d.Local.z, roughness));
      }
    }
    for (const Pixel& pixel : this->Pixels)
    {
      const std::vector<double>& lobe = lobes[static_cast<std::size_t>(pixel.View)];
      const std::vector<Direction>& directions =
        this->Directions[static_cast<std::size_t>(pixel.View)];
      PBRMoments sums{};
      for (std::size_t k = 0; k < lobe.size(); ++k)
      {
        double power = lobe[k] * pixel.Light[k];
        for (double& sum : sums)
        {
          sum += power;
          power *= directions[k].S;
        }
      }
      moments.push_back(sums);
    }
    return moments;
  }

  void GetRadiance(const PBRParameters& parameters, double f90, std::vector<Quadratic>& radiance)
  {
    const std::vector<PBRMoments>& specular = this->GetSpecularMoments(parameters.Roughness);
    const std::vector<PBRMoments>& coat = parameters.CoatStrength > 0.0
                                            ? this->GetSpecularMoments(parameters.CoatRoughness)
                                            : specular; // times a strength of 0
    radiance.resize(this->Pixels.size());
    for (std::size_t p = 0; p < radiance.size(); ++p)
    {
      double at[3];
      for (int k = 0; k < 3; ++k)
      {
        at[k] =
          GetPBRRadiance(parameters, 0.5 * k, f90, this->Pixels[p].Diffuse, specular[p], coat[p]);
      }
      radiance[p] = { at[0], -3.0 * at[0] + 4.0 * at[1] - at[2],
        2.0 * (at[0] - 2.0 * at[1] + at[2]) };
    }
  }

  // Sum |model - reference| of a channel.
  double GetDistance(
    const std::vector<Quadratic>& radiance, std::size_t channel, double color) const
  {
    double sum = 0.0;
    const double* reference = this->Reference.data() + channel;
    for (const Quadratic& q : radiance)
    {
      const double value = q[0] + color * (q[1] + color * q[2]);
      for (int tangent = 0; tangent < this->NumberOfTangents; ++tangent)
      {
        sum += std::abs(value - *reference);
        reference += 3;
      }
    }
    return sum;
  }

  double FitChannel(
    const std::vector<Quadratic>& radiance, std::size_t channel, double& color) const
  {
    constexpr int coarse = 12;
    double least = std::numeric_limits<double>::infinity();
    const auto attempt = [&](double value)
    {
      const double distance = this->GetDistance(radiance, channel, value);
      if (distance < least)
      {
        least = distance;
        color = value;
      }
    };
    for (int k = 0; k <= coarse; ++k)
    {
      attempt(static_cast<double>(k) / coarse);
    }
    for (double step = 0.5 / coarse; step > 5e-4; step *= 0.5)
    {
      const double center = color;
      attempt(std::max(center - step, 0.0));
      attempt(std::min(center + step, 1.0));
    }
    return least;
  }

  std::vector<double> ViewCosines;
  std::vector<std::vector<Direction>> Directions; // by view
  std::vector<Pixel> Pixels;
  int NumberOfTangents = 1;
  std::vector<double> Reference;                          // by pixel, tangent, channel
  double Total = 0.0;                                     // of Reference
  std::map<int, std::vector<PBRMoments>> SpecularMoments; // by roughness in hundredths
};

// Smaller roughness is a mirror to VTK's tables of the light, and 0 divides by 0.
constexpr double LeastRoughness = 0.05;
// What further parameters have to leave of the error to be worth it: not all that draws a property
// knows them.
constexpr double WorthIt = 0.7;

// Which parameters a search may change.
enum Extent
{
  METALLIC_ROUGHNESS,
  WITH_FRESNEL,
  WITH_COAT
};

//------------------------------------------------------------------------------
// What values a search may take beside the ranges of the axes.
struct Limits
{
  double LeastMetallic;
  double MostMetallic;
  double MostRoughness;
  double MostIndex;

  PBRParameters Clamp(PBRParameters parameters) const
  {
    parameters.Metallic = std::clamp(parameters.Metallic, this->LeastMetallic, this->MostMetallic);
    parameters.Roughness = std::min(parameters.Roughness, this->MostRoughness);
    parameters.BaseIOR = std::min(parameters.BaseIOR, this->MostIndex);
    parameters.CoatIOR = std::min(parameters.CoatIOR, this->MostIndex);
    return parameters;
  }
};
const Limits Free = { 0.0, 1.0, 1.0, 3.0 };
const Limits Dielectric = { 0.0, 0.0, 1.0, 2.0 };
const Limits Metal = { 0.3, 1.0, 0.6, 2.0 };
constexpr double WorthMetal = 0.95; // what a metal has to leave of a dielectric's error

//------------------------------------------------------------------------------
struct Candidate
{
  PBRParameters Parameters;
  std::array<double, 3> Color = { 0.5, 0.5, 0.5 };
  double Error = std::numeric_limits<double>::infinity();
};

//------------------------------------------------------------------------------
// What is searched, with its range and the first step of the refinement.
struct Axis
{
  double PBRParameters::*Value;
  double Least;
  double Most;
  double Step;
  Extent From;
};
const std::array<Axis, 7> Axes = { {
  { &PBRParameters::Roughness, LeastRoughness, 1.0, 0.08, METALLIC_ROUGHNESS },
  { &PBRParameters::Metallic, 0.0, 1.0, 0.2, METALLIC_ROUGHNESS },
  { &PBRParameters::BaseIOR, 1.0, 3.0, 0.25, WITH_FRESNEL },
  { &PBRParameters::EdgeTint, 0.0, 1.0, 0.25, WITH_FRESNEL },
  { &PBRParameters::CoatStrength, 0.0, 1.0, 0.25, WITH_COAT },
  { &PBRParameters::CoatRoughness, LeastRoughness, 1.0, 0.08, WITH_COAT },
  { &PBRParameters::CoatIOR, 1.0, 3.0, 0.25, WITH_COAT },
} };

//------------------------------------------------------------------------------
void Keep(Candidate& best, const Candidate& other)
{
  if (other.Error < best.Error)
  {
    best = other;
  }
}

//------------------------------------------------------------------------------
Candidate Try(PBRPicture& picture, const PBRParameters& parameters)
{
  Candidate candidate{ parameters };
  candidate.Error = picture.FitColor(parameters, candidate.Color);
  return candidate;
}

//------------------------------------------------------------------------------
// One parameter at a time, up and down, with steps halved until they are a hundredth.
Candidate Refine(PBRPicture& picture, const Candidate& start, Extent extent, const Limits& limits)
{
  Candidate best = start;
  for (double share = 1.0; share > 0.05; share *= 0.5)
  {
    for (int round = 0; round < 4; ++round)
    {
      const double before = best.Error;
      for (const Axis& axis : Axes)
      {
        for (const double sign : { -1.0, 1.0 })
        {
          Candidate next = best;
          double& value = next.Parameters.*axis.Value;
          value = std::clamp(value + sign * share * axis.Step, axis.Least, axis.Most);
          value = std::round(100.0 * value) / 100.0;
          next.Parameters = limits.Clamp(next.Parameters);
          if (axis.From <= extent && value != best.Parameters.*axis.Value)
          {
            Keep(best, Try(picture, next.Parameters));
          }
        }
      }
      if (best.Error > 0.999 * before)
      {
        break;
      }
    }
  }
  return best;
}

//------------------------------------------------------------------------------
// The best of what the few best starts lead to.
Candidate Search(PBRPicture& picture, const std::vector<PBRParameters>& starts, Extent extent,
  const Limits& limits)
{
  constexpr std::size_t refined = 3;
  std::vector<Candidate> candidates;
  for (const PBRParameters& start : starts)
  {
    candidates.push_back(Try(picture, limits.Clamp(start)));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b) { return a.Error < b.Error; });
  Candidate best;
  for (std::size_t k = 0; k < std::min(refined, candidates.size()); ++k)
  {
    Keep(best, Refine(picture, candidates[k], extent, limits));
  }
  return best;
}

//------------------------------------------------------------------------------
std::vector<PBRParameters> GetStarts(Extent extent, const PBRParameters& before)
{
  // Rough ones first: of equals, where nothing is specular, the first is taken.
  const std::vector<double> any = { 1.0, 0.7, 0.5, 0.35, 0.25, 0.15, 0.07 };
  const std::vector<double> few = { 1.0, 0.5, 0.3, before.Roughness };
  std::vector<PBRParameters> starts;
  for (const double roughness : extent == WITH_COAT ? few : any)
  {
    for (const double metallic : { 0.0, 0.5, 1.0 })
    {
      PBRParameters start;
      start.Roughness = roughness;
      start.Metallic = metallic;
      if (extent == METALLIC_ROUGHNESS)
      {
        starts.push_back(start);
      }
      else if (extent == WITH_FRESNEL)
      {
        for (const double index : { 1.0, 1.5, 2.2 })
        {
          start.BaseIOR = index;
          start.EdgeTint = 0.5;
          starts.push_back(start);
        }
      }
      else
      {
        for (const double coat : { 0.07, 0.2, 0.4 })
        {
          start.CoatStrength = 1.0;
          start.CoatRoughness = coat;
          start.CoatIOR = 1.5;
          starts.push_back(start);
        }
      }
    }
  }
  return starts;
}

//------------------------------------------------------------------------------
// More parameters only where they are worth it.
Candidate SearchWithin(PBRPicture& picture, const Limits& limits)
{
  Candidate best;
  for (const Extent extent : { METALLIC_ROUGHNESS, WITH_FRESNEL, WITH_COAT })
  {
    const Candidate next = Search(picture, GetStarts(extent, best.Parameters), extent, limits);
    if (!(next.Error >= WorthIt * best.Error))
    {
      best = next;
    }
  }
  return best;
}
}

//------------------------------------------------------------------------------
void vtkPBRPropertyFitter::SetBRDF(vtkBRDF* brdf)
{
  if (this->BRDF != brdf)
  {
    this->BRDF = brdf;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkPBRPropertyFitter::GetNeutralRadiance(const double direction[3])
{
  const glm::dvec3 d = glm::normalize(glm::dvec3(direction[0], direction[1], direction[2]));
  // A round lamp of that radius, its edge soft over two degrees.
  const auto lamp = [&d](const glm::dvec3& towards, double degrees)
  {
    const double cosine = std::cos(vtkMath::RadiansFromDegrees(degrees));
    const double edge =
      std::sin(vtkMath::RadiansFromDegrees(degrees)) * vtkMath::RadiansFromDegrees(1.0);
    return 1.0 / (1.0 + std::exp((cosine - glm::dot(d, glm::normalize(towards))) / edge));
  };
  return 0.3 + 0.2 * d.y                                 // floor to ceiling
         + 5.0 * lamp(glm::dvec3(-0.6, 0.7, 0.6), 14.0)  // key
         + 1.0 * lamp(glm::dvec3(1.0, 0.15, 0.4), 25.0)  // fill
         + 2.0 * lamp(glm::dvec3(0.4, 0.4, -1.0), 18.0); // rim
}

//------------------------------------------------------------------------------
bool vtkPBRPropertyFitter::Update()
{
  if (!this->BRDF)
  {
    vtkErrorMacro("There is no material to fit: call SetBRDF first.");
    return false;
  }
  this->BRDF->Prepare();
  PBRPicture picture(this->BRDF, [](const glm::dvec3& d) { return GetNeutralRadiance(&d.x); });
  Candidate best = SearchWithin(picture, Dielectric);
  const Candidate metal = SearchWithin(picture, Metal);
  // One at the least metallic part wants to be none.
  const bool isMetal =
    metal.Parameters.Metallic > Metal.LeastMetallic && metal.Error < WorthMetal * best.Error;
  best = isMetal ? metal : best;
  Candidate closest = best;
  Keep(closest, metal);
  Keep(closest, SearchWithin(picture, Free));
  this->ClosestError = closest.Error;
  best = this->UsualValues ? best : closest;
  std::copy(best.Color.begin(), best.Color.end(), this->BaseColor);
  this->Roughness = best.Parameters.Roughness;
  this->Metallic = best.Parameters.Metallic;
  this->BaseIOR = best.Parameters.BaseIOR;
  this->EdgeTint = best.Parameters.EdgeTint;
  this->CoatStrength = best.Parameters.CoatStrength;
  this->CoatRoughness = best.Parameters.CoatRoughness;
  this->CoatIOR = best.Parameters.CoatIOR;
  this->RelativeError = best.Error;
  return true;
}

//------------------------------------------------------------------------------
void vtkPBRPropertyFitter::Apply(vtkProperty* property)
{
  if (!property)
  {
    vtkErrorMacro("There is no property to set.");
    return;
  }
  property->SetInterpolationToPBR();
  property->SetColor(this->BaseColor);
  property->SetDiffuse(1.0);
  property->SetMetallic(this->Metallic);
  property->SetRoughness(this->Roughness);
  property->SetBaseIOR(this->BaseIOR);
  property->SetEdgeTint(this->EdgeTint, this->EdgeTint, this->EdgeTint);
  property->SetAnisotropy(0.0);
  property->SetCoatStrength(this->CoatStrength);
  property->SetCoatRoughness(this->CoatRoughness);
  property->SetCoatIOR(this->CoatIOR);
  property->SetCoatColor(1.0, 1.0, 1.0);

  // Phong's: the lobe's peak at normal incidence, pi f = F0 / (4 alpha^2), and the exponent of the
  // reflected vector, a quarter of the half vector's 2 / alpha^2 - 2 (Walter et al. 2007).
  const bool coat = this->CoatStrength > 0.5 && this->CoatRoughness < this->Roughness;
  const double roughness = coat ? this->CoatRoughness : this->Roughness;
  const double alpha2 = std::pow(roughness, 4);
  const double base = property->ComputeReflectanceOfBaseLayer();
  double f0[3];
  for (int c = 0; c < 3; ++c)
  {
    f0[c] = coat ? GetPBRReflectance(this->CoatIOR, 1.0)
                 : base + (this->BaseColor[c] - base) * this->Metallic;
  }
  const double most = std::max({ f0[0], f0[1], f0[2] });
  if (most > 0.0)
  {
    property->SetSpecularColor(f0[0] / most, f0[1] / most, f0[2] / most);
  }
  property->SetSpecular(std::min(most / (4.0 * alpha2), 1.0));
  property->SetSpecularPower(std::clamp(0.25 * (2.0 / alpha2 - 2.0), 1.0, 128.0));
}

//------------------------------------------------------------------------------
double vtkPBRPropertyFitter::Fit(vtkBRDF* brdf, vtkProperty* property)
{
  vtkNew<vtkPBRPropertyFitter> fitter;
  fitter->SetBRDF(brdf);
  if (!property || !fitter->Update())
  {
    return -1.0;
  }
  fitter->Apply(property);
  return fitter->GetRelativeError();
}

//------------------------------------------------------------------------------
void vtkPBRPropertyFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "BaseColor: " << this->BaseColor[0] << " " << this->BaseColor[1] << " "
     << this->BaseColor[2] << "\n";
  os << indent << "Roughness: " << this->Roughness << "\n";
  os << indent << "Metallic: " << this->Metallic << "\n";
  os << indent << "BaseIOR: " << this->BaseIOR << "\n";
  os << indent << "EdgeTint: " << this->EdgeTint << "\n";
  os << indent << "CoatStrength: " << this->CoatStrength << "\n";
  os << indent << "CoatRoughness: " << this->CoatRoughness << "\n";
  os << indent << "CoatIOR: " << this->CoatIOR << "\n";
  os << indent << "RelativeError: " << this->RelativeError << "\n";
  os << indent << "UsualValues: " << (this->UsualValues ? "On" : "Off") << "\n";
  os << indent << "ClosestError: " << this->ClosestError << "\n";
}
