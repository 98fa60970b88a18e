// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPBRPropertyFitter.h"

#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "PBRShading.h"
#include "vtkBRDF.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkProperty.h"

#include <Eigen/Core>
#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

using Moments = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>; // by pixel: PBRMoments

// Pictures of a sphere under a gray light, drawn by a measured material and by VTK's physically
// based shading with the same quadrature, so that they can be compared. The sphere is seen from +z.
class PBRPicture
{
public:
  /// The brdf must be prepared. light(direction): gray radiance, with no details finer than ten
  /// degrees.
  template <typename Light>
  PBRPicture(vtkBRDF* brdf, const Light& light)
    : NumberOfTangents(brdf->IsIsotropic() ? 1 : TangentsOfAnisotropic)
    , Diffuse(NumberOfPixels, 4)
    , Reference(NumberOfPixels, 3 * this->NumberOfTangents)
  {
    for (int k = 0; k < NumberOfPBRViews; ++k)
    {
      View& view = this->Views[k];
      view.Cosine = std::sqrt(1.0 - (k + 0.5) / NumberOfPBRViews);
      AddDirections(view);
      view.Light.resize(NumberOfPBRAzimuths, static_cast<Eigen::Index>(view.Directions.size()));
      for (int pixel = 0; pixel < NumberOfPBRAzimuths; ++pixel)
      {
        AddLight(view, pixel, 2.0 * Pi * (pixel + 0.5 * (k % 2)) / NumberOfPBRAzimuths, light);
      }
      this->Diffuse.middleRows(k * NumberOfPBRAzimuths, NumberOfPBRAzimuths) =
        view.Light * view.Powers / Pi;
      this->Draw(brdf, k);
    }
  }

  /// Base color of least error for the other parameters (of a roughness in hundredths), and that
  /// error: relative L1 over pixels and channels.
  double FitColor(const PBRParameters& parameters, std::array<double, 3>& color)
  {
    constexpr int rounds = 2;
    double sum = 0.0;
    // The reflectance at grazing incidence depends on all three channels where F0 is below 2 %:
    // fit, fit again with the one that belongs to the color, and measure with that of the last
    // color.
    double f90 = GetPBRGrazing(parameters, color);
    for (int k = 0; k <= rounds; ++k)
    {
      const Eigen::MatrixX3d radiance = this->GetRadiance(parameters, f90);
      sum = 0.0;
      for (int channel = 0; channel < 3; ++channel)
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
    return sum > 0.0 ? sum / this->Reference.sum() : 0.0;
  }

private:
  static constexpr int NumberOfPixels = NumberOfPBRViews * NumberOfPBRAzimuths;

  // Pixels of a ring: they see the sphere at the same angle, and their directions to the light are
  // the same in the local frame whose x axis lies in the plane of the normal and the eye.
  struct View
  {
    double Cosine;
    std::vector<glm::dvec3> Directions;
    std::vector<double> Weights; // f * weight * radiance is what a direction adds
    std::vector<double> NdH;
    Moments Powers;        // by direction: (1 - H.L)^(5 n), n = 0 to 3
    Eigen::MatrixXd Light; // pixels x directions: weight * radiance
  };

  static void AddDirections(View& view)
  {
    const glm::dvec3 o(std::sqrt(1.0 - view.Cosine * view.Cosine), 0.0, view.Cosine);
    std::vector<double> powers;
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
      view.Directions.push_back(i);
      view.Weights.push_back(i.z / density);
      view.NdH.push_back(h.z);
      const double s = std::pow(1.0 - hdl, 5);
      powers.insert(powers.end(), { 1.0, s, s * s, s * s * s });
    };
    for (int k = 0; k < DrawsOfCosine; ++k)
    {
      glm::dvec3 i;
      SampleCosine(
        (k + 0.5) / DrawsOfCosine, RadicalInverse(static_cast<std::uint32_t>(k), 2), &i.x);
      add(i);
    }
    for (const double roughness : LobeRoughnesses)
    {
      const double alpha2 = std::pow(roughness, 4);
      for (int k = 0; k < DrawsOfLobe; ++k)
      {
        // Walter et al. 2007, equation 35: tan^2(theta_h) = alpha^2 u / (1 - u).
        const double u = (k + 0.5) / DrawsOfLobe;
        const double phi = 2.0 * Pi * RadicalInverse(static_cast<std::uint32_t>(k), 2);
        const glm::dvec3 h = ToDirection(1.0 / std::sqrt(1.0 + alpha2 * u / (1.0 - u)), phi);
        if (glm::dot(h, o) > 0.0)
        {
          add(ReflectAbout(o, h));
        }
      }
    }
    view.Powers =
      Eigen::Map<Moments>(powers.data(), static_cast<Eigen::Index>(powers.size()) / 4, 4);
  }

  // Of the pixel at that azimuth of the sphere. Its tangent points towards the eye.
  template <typename Light>
  static void AddLight(View& view, int pixel, double phi, const Light& light)
  {
    const glm::dvec3 normal = ToDirection(view.Cosine, phi);
    const glm::dvec3 tangent(-view.Cosine * std::cos(phi), -view.Cosine * std::sin(phi),
      std::sqrt(1.0 - view.Cosine * view.Cosine));
    const glm::dmat3 frame(tangent, glm::cross(normal, tangent), normal);
    for (std::size_t k = 0; k < view.Directions.size(); ++k)
    {
      view.Light(pixel, static_cast<Eigen::Index>(k)) =
        view.Weights[k] * light(frame * view.Directions[k]);
    }
  }

  // The reference's pixels of a ring, for each tangent.
  void Draw(vtkBRDF* brdf, int k)
  {
    const View& view = this->Views[k];
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> f(view.Directions.size(), 3);
    for (int tangent = 0; tangent < this->NumberOfTangents; ++tangent)
    {
      const double phi = Pi * tangent / this->NumberOfTangents;
      const double c = std::cos(phi), s = std::sin(phi);
      const glm::dvec3 o = ToDirection(view.Cosine, phi);
      for (std::size_t d = 0; d < view.Directions.size(); ++d)
      {
        const glm::dvec3& local = view.Directions[d];
        const glm::dvec3 i(c * local.x - s * local.y, s * local.x + c * local.y, local.z);
        brdf->Evaluate(&i.x, &o.x, &f(static_cast<Eigen::Index>(d), 0));
      }
      this->Reference.block<NumberOfPBRAzimuths, 3>(k * NumberOfPBRAzimuths, 3 * tangent) =
        view.Light * f;
    }
  }

  const Moments& GetSpecularMoments(double roughness)
  {
    Moments& moments = this->SpecularMoments[static_cast<int>(std::lround(100.0 * roughness))];
    if (moments.size() > 0)
    {
      return moments;
    }
    moments.resize(NumberOfPixels, 4);
    for (int k = 0; k < NumberOfPBRViews; ++k)
    {
      const View& view = this->Views[k];
      Eigen::VectorXd lobe(view.Directions.size());
      for (std::size_t d = 0; d < view.Directions.size(); ++d)
      {
        lobe[static_cast<Eigen::Index>(d)] =
          GetPBRLobe(view.NdH[d], view.Cosine, view.Directions[d].z, roughness);
      }
      moments.middleRows(k * NumberOfPBRAzimuths, NumberOfPBRAzimuths) =
        view.Light * lobe.asDiagonal() * view.Powers;
    }
    return moments;
  }

  // By pixel: the radiance as a polynomial of the channel's base color.
  Eigen::MatrixX3d GetRadiance(const PBRParameters& parameters, double f90)
  {
    const Moments& specular = this->GetSpecularMoments(parameters.Roughness);
    const Moments& coat = parameters.CoatStrength > 0.0
                            ? this->GetSpecularMoments(parameters.CoatRoughness)
                            : specular; // times a strength of 0
    const auto get = [](const Moments& moments, int pixel)
    {
      PBRMoments own;
      std::copy_n(&moments(pixel, 0), 4, own.begin());
      return own;
    };
    Eigen::MatrixX3d radiance(NumberOfPixels, 3);
    for (int p = 0; p < NumberOfPixels; ++p)
    {
      double at[3];
      for (int k = 0; k < 3; ++k)
      {
        at[k] = GetPBRRadiance(
          parameters, 0.5 * k, f90, get(this->Diffuse, p), get(specular, p), get(coat, p));
      }
      radiance.row(p) << at[0], -3.0 * at[0] + 4.0 * at[1] - at[2],
        2.0 * (at[0] - 2.0 * at[1] + at[2]);
    }
    return radiance;
  }

  // Sum |model - reference| of a channel.
  double GetDistance(const Eigen::MatrixX3d& radiance, int channel, double color) const
  {
    const Eigen::VectorXd model = radiance * Eigen::Vector3d(1.0, color, color * color);
    double sum = 0.0;
    for (int tangent = 0; tangent < this->NumberOfTangents; ++tangent)
    {
      sum += (model - this->Reference.col(3 * tangent + channel)).cwiseAbs().sum();
    }
    return sum;
  }

  double FitChannel(const Eigen::MatrixX3d& radiance, int channel, double& color) const
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

  int NumberOfTangents;
  std::array<View, NumberOfPBRViews> Views;
  Moments Diffuse;
  Eigen::MatrixXd Reference;              // pixels x (tangent, channel)
  std::map<int, Moments> SpecularMoments; // by roughness in hundredths
};

// Smaller roughness is a mirror to VTK's tables of the light, and 0 divides by 0.
constexpr double LeastRoughness = 0.05;
// What further parameters have to leave of the error to be worth it: not all that draws a property
// knows them.
constexpr double WorthIt = 0.7;

// What a search may change: each extent knows all parameters of the one before, too.
enum Extent
{
  METALLIC_ROUGHNESS,
  WITH_FRESNEL,
  WITH_COAT
};

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

struct Candidate
{
  PBRParameters Parameters;
  std::array<double, 3> Color = { 0.5, 0.5, 0.5 };
  double Error = std::numeric_limits<double>::infinity();
};

// What is searched, with its range and the first step of the refinement.
struct Axis
{
  double PBRParameters::*Value;
  double Least;
  double Most;
  double Step;
  Extent From;
};
const Axis Axes[] = {
  { &PBRParameters::Roughness, LeastRoughness, 1.0, 0.08, METALLIC_ROUGHNESS },
  { &PBRParameters::Metallic, 0.0, 1.0, 0.2, METALLIC_ROUGHNESS },
  { &PBRParameters::BaseIOR, 1.0, 3.0, 0.25, WITH_FRESNEL },
  { &PBRParameters::EdgeTint, 0.0, 1.0, 0.25, WITH_FRESNEL },
  { &PBRParameters::CoatStrength, 0.0, 1.0, 0.25, WITH_COAT },
  { &PBRParameters::CoatRoughness, LeastRoughness, 1.0, 0.08, WITH_COAT },
  { &PBRParameters::CoatIOR, 1.0, 3.0, 0.25, WITH_COAT },
};

void Keep(Candidate& best, const Candidate& other)
{
  if (other.Error < best.Error)
  {
    best = other;
  }
}

Candidate Try(PBRPicture& picture, const PBRParameters& parameters)
{
  Candidate candidate{ parameters };
  candidate.Error = picture.FitColor(parameters, candidate.Color);
  return candidate;
}

// One parameter at a time, up and down, with steps halved until they are a hundredth.
Candidate Refine(PBRPicture& picture, const Candidate& start, Extent extent, const Limits& limits)
{
  Candidate best = start;
  for (double share = 1.0; share > 0.05; share *= 0.5)
  {
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 4 && best.Error <= 0.999 * before; ++round)
    {
      before = best.Error;
      for (const Axis& axis : Axes)
      {
        for (const double sign : { -1.0, 1.0 })
        {
          PBRParameters next = best.Parameters;
          double& value = next.*axis.Value;
          value = std::clamp(value + sign * share * axis.Step, axis.Least, axis.Most);
          value = std::round(100.0 * value) / 100.0;
          next = limits.Clamp(next);
          if (axis.From <= extent && value != best.Parameters.*axis.Value)
          {
            Keep(best, Try(picture, next));
          }
        }
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
  const std::vector<double> indices = { 1.0, 1.5, 2.2 }, coats = { 0.07, 0.2, 0.4 }, one = { 0.0 };
  std::vector<PBRParameters> starts;
  for (const double roughness : extent == WITH_COAT ? few : any)
  {
    for (const double metallic : { 0.0, 0.5, 1.0 })
    {
      for (const double third : extent == WITH_FRESNEL ? indices
                                : extent == WITH_COAT  ? coats
                                                       : one)
      {
        PBRParameters start;
        start.Roughness = roughness;
        start.Metallic = metallic;
        if (extent == WITH_FRESNEL)
        {
          start.BaseIOR = third;
          start.EdgeTint = 0.5;
        }
        else if (extent == WITH_COAT)
        {
          start.CoatStrength = 1.0;
          start.CoatRoughness = third;
          start.CoatIOR = 1.5;
        }
        starts.push_back(start);
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
