// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPBRPropertyFitter.h"

#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
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
// Parameters other than the base color, with vtkProperty's names and ranges.
enum Axis
{
  ROUGHNESS,
  METALLIC,
  BASE_IOR,
  EDGE_TINT,
  COAT_STRENGTH,
  COAT_ROUGHNESS,
  COAT_IOR,
  NUMBER_OF_AXES
};
using Parameters = Eigen::Array<double, NUMBER_OF_AXES, 1>;

// VTK's physically based shading of one light, as in its fragment shader (VTK 9.1 to 9.6,
// vtkPBRFunctions.glsl and vtkOpenGLPolyDataMapper::ReplaceShaderLight): GGX (Walter et al. 2007)
// with the height-correlated Smith term (Heitz 2014), Schlick's Fresnel term (1994), a Lambertian
// base, and a clear coat. Everything but the distribution is a polynomial in s = (1 - H.L)^5, so
// that the radiance of a surface follows from a few moments of the light: the integrals of
// lobe * s^n * L * cos, n = 0 to 3. Of the diffuse part the lobe is 1 / pi.

double GetAlphaSquared(double roughness) { return std::pow(roughness, 4); }

// GGX times pi / alpha^2.
double GetDistribution(double ndh, double alpha2)
{
  const double d = (ndh * alpha2 - ndh) * ndh + 1.0;
  return 1.0 / (d * d);
}

// D V of a lobe: f is D V times the Fresnel term. VTK's V takes roughness^2 where Heitz has
// alpha^2 = roughness^4; this function follows VTK.
double GetLobe(double ndh, double ndv, double ndl, double roughness)
{
  const double alpha2 = GetAlphaSquared(roughness);
  const double a2 = roughness * roughness;
  const double smith =
    ndl * std::sqrt(a2 + ndv * (ndv - a2 * ndv)) + ndv * std::sqrt(a2 + ndl * (ndl - a2 * ndl));
  return alpha2 / Pi * GetDistribution(ndh, alpha2) * 0.5 / std::max(smith, 1e-12);
}

// Density of i where h is drawn from D(h) cos(theta_h) (Walter et al. 2007, equation 38).
double GetLobeDensity(double roughness, double ndh, double hdl)
{
  const double alpha2 = GetAlphaSquared(roughness);
  return alpha2 / Pi * GetDistribution(ndh, alpha2) * ndh / (4.0 * std::max(hdl, 1e-9));
}

// Of the base layer.
double GetReflectance(const Parameters& p)
{
  return vtkProperty::ComputeReflectanceFromIOR(p[BASE_IOR], 1.0) * (1.0 - p[COAT_STRENGTH]) +
         vtkProperty::ComputeReflectanceFromIOR(p[BASE_IOR], p[COAT_IOR]) * p[COAT_STRENGTH];
}

// Reflectance at grazing incidence: of metals the edge tint, else low where F0 is below 2 %.
double GetGrazing(const Parameters& p, const Eigen::Array3d& baseColor)
{
  const double base = GetReflectance(p);
  const double sum = (base + (baseColor - base) * p[METALLIC]).sum();
  const double f90 = std::clamp(50.0 * 0.33 * sum, 0.0, 1.0);
  return f90 + (p[EDGE_TINT] - f90) * p[METALLIC];
}

// What the moments of a light are multiplied with, of one channel of base color c.
struct Shading
{
  Eigen::Vector4d Diffuse, Base, Coat;

  Shading(const Parameters& p, double c, double f90)
  {
    const double base = GetReflectance(p);
    const double f0 = base + (c - base) * p[METALLIC];
    const double df = f90 - f0; // F = f0 + df s
    const double q = p[COAT_STRENGTH];
    const double coatF0 = vtkProperty::ComputeReflectanceFromIOR(p[COAT_IOR], 1.0);
    const double e = 1.0 - q * coatF0; // 1 - Fc = e - v s
    const double v = q * (1.0 - coatF0);
    this->Diffuse << (1.0 - f0) * e, -(1.0 - f0) * v - df * e, df * v, 0.0;
    this->Diffuse *= (1.0 - p[METALLIC]) * c;
    this->Base << f0 * e * e, df * e * e - 2.0 * e * v * f0, f0 * v * v - 2.0 * e * v * df,
      df * v * v;
    this->Coat << q * coatF0, q * (1.0 - coatF0), 0.0, 0.0;
  }
};

// The neutral light: gray radiance from a direction; +y up, the picture is seen from +z.
double GetNeutralRadiance(const glm::dvec3& d)
{
  // A round lamp of that radius, its edge soft over two degrees.
  const auto lamp = [&d](const glm::dvec3& towards, double degrees)
  {
    const double angle = vtkMath::RadiansFromDegrees(degrees);
    const double edge = std::sin(angle) * vtkMath::RadiansFromDegrees(1.0);
    return 1.0 / (1.0 + std::exp((std::cos(angle) - glm::dot(d, glm::normalize(towards))) / edge));
  };
  return 0.3 + 0.2 * d.y                                 // floor to ceiling
         + 5.0 * lamp(glm::dvec3(-0.6, 0.7, 0.6), 14.0)  // key
         + 1.0 * lamp(glm::dvec3(1.0, 0.15, 0.4), 25.0)  // fill
         + 2.0 * lamp(glm::dvec3(0.4, 0.4, -1.0), 18.0); // rim
}

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

using Moments = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>; // by pixel

// Pictures of a sphere under the neutral light, drawn by a measured material and by VTK's
// physically based shading with the same quadrature, so that they can be compared. The sphere is
// seen from +z.
class PBRPicture
{
public:
  /// The brdf must be prepared.
  explicit PBRPicture(vtkBRDF* brdf)
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
        AddLight(view, pixel, 2.0 * Pi * (pixel + 0.5 * (k % 2)) / NumberOfPBRAzimuths);
      }
      this->Diffuse.middleRows(k * NumberOfPBRAzimuths, NumberOfPBRAzimuths) =
        view.Light * view.Powers / Pi;
      this->Draw(brdf, k);
    }
  }

  /// Base color of least error for the other parameters (of a roughness in hundredths), and that
  /// error: relative L1 over pixels and channels.
  double FitColor(const Parameters& parameters, Eigen::Array3d& color)
  {
    constexpr int rounds = 2;
    double sum = 0.0;
    // The reflectance at grazing incidence depends on all three channels where F0 is below 2 %:
    // fit, fit again with the one that belongs to the color, and measure with that of the last
    // color.
    double f90 = GetGrazing(parameters, color);
    for (int k = 0; k <= rounds; ++k)
    {
      const Eigen::MatrixX3d radiance = this->GetRadiance(parameters, f90);
      sum = 0.0;
      for (int channel = 0; channel < 3; ++channel)
      {
        sum += k < rounds ? this->FitChannel(radiance, channel, color[channel])
                          : this->GetDistance(radiance, channel, color[channel]);
      }
      const double next = GetGrazing(parameters, color);
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
      const double alpha2 = GetAlphaSquared(roughness);
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
  static void AddLight(View& view, int pixel, double phi)
  {
    const glm::dvec3 normal = ToDirection(view.Cosine, phi);
    const glm::dvec3 tangent(-view.Cosine * std::cos(phi), -view.Cosine * std::sin(phi),
      std::sqrt(1.0 - view.Cosine * view.Cosine));
    const glm::dmat3 frame(tangent, glm::cross(normal, tangent), normal);
    for (std::size_t k = 0; k < view.Directions.size(); ++k)
    {
      view.Light(pixel, static_cast<Eigen::Index>(k)) =
        view.Weights[k] * GetNeutralRadiance(frame * view.Directions[k]);
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
      const glm::dvec3 x = ToDirection(0.0, phi), o = ToDirection(view.Cosine, phi);
      const glm::dmat3 turn(x, glm::dvec3(-x.y, x.x, 0.0), glm::dvec3(0.0, 0.0, 1.0));
      for (std::size_t d = 0; d < view.Directions.size(); ++d)
      {
        const glm::dvec3 i = turn * view.Directions[d];
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
          GetLobe(view.NdH[d], view.Cosine, view.Directions[d].z, roughness);
      }
      moments.middleRows(k * NumberOfPBRAzimuths, NumberOfPBRAzimuths) =
        view.Light * lobe.asDiagonal() * view.Powers;
    }
    return moments;
  }

  // By pixel: the radiance as a polynomial of the channel's base color.
  Eigen::MatrixX3d GetRadiance(const Parameters& parameters, double f90)
  {
    const Moments& base = this->GetSpecularMoments(parameters[ROUGHNESS]);
    const Moments& coat = parameters[COAT_STRENGTH] > 0.0
                            ? this->GetSpecularMoments(parameters[COAT_ROUGHNESS])
                            : base; // times a strength of 0
    Eigen::MatrixX3d at(NumberOfPixels, 3);
    for (int k = 0; k < 3; ++k)
    {
      const Shading shading(parameters, 0.5 * k, f90);
      at.col(k) = this->Diffuse * shading.Diffuse + base * shading.Base + coat * shading.Coat;
    }
    Eigen::Matrix3d toPolynomial; // of values at 0, 1/2 and 1
    toPolynomial << 1.0, -3.0, 2.0, 0.0, 4.0, -4.0, 0.0, -1.0, 2.0;
    return at * toPolynomial;
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
constexpr double WorthMetal = 0.95; // what a metal has to leave of a dielectric's error

// What a search may change: so many of the axes.
constexpr int MetallicRoughness = 2, WithFresnel = 4, WithCoat = 7;

// What values a search may take.
struct Limits
{
  Parameters Least, Most;

  Limits(double leastMetallic, double mostMetallic, double mostRoughness, double mostIndex)
  {
    this->Least << LeastRoughness, leastMetallic, 1.0, 0.0, 0.0, LeastRoughness, 1.0;
    this->Most << mostRoughness, mostMetallic, mostIndex, 1.0, 1.0, 1.0, mostIndex;
  }
};

struct Candidate
{
  Parameters Values = Parameters::Zero();
  Eigen::Array3d Color = Eigen::Array3d::Constant(0.5);
  double Error = std::numeric_limits<double>::infinity();

  Candidate() = default;
  Candidate(PBRPicture& picture, const Parameters& values)
    : Values(values)
    , Error(picture.FitColor(values, this->Color))
  {
  }

  bool operator<(const Candidate& other) const { return this->Error < other.Error; }
};

// One parameter at a time, up and down, with steps halved until they are a hundredth.
Candidate Refine(PBRPicture& picture, const Candidate& start, int extent, const Limits& limits)
{
  constexpr double steps[NUMBER_OF_AXES] = { 0.08, 0.2, 0.25, 0.25, 0.25, 0.08, 0.25 };
  Candidate best = start;
  for (double share = 1.0; share > 0.05; share *= 0.5)
  {
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 4 && best.Error <= 0.999 * before; ++round)
    {
      before = best.Error;
      for (int k = 0; k < 2 * extent; ++k)
      {
        const int axis = k / 2;
        const double step = (k % 2 == 0 ? -share : share) * steps[axis];
        Parameters next = best.Values;
        next[axis] = std::clamp(next[axis] + step, limits.Least[axis], limits.Most[axis]);
        next[axis] = std::round(100.0 * next[axis]) / 100.0;
        if (next[axis] != best.Values[axis])
        {
          best = std::min(best, Candidate(picture, next));
        }
      }
    }
  }
  return best;
}

// The values that a search of so many of the axes begins with. before: the best roughness of fewer.
std::vector<Parameters> GetStarts(int extent, double before)
{
  // Rough ones first: of equals, where nothing is specular, the first is taken.
  const std::vector<double> any = { 1.0, 0.7, 0.5, 0.35, 0.25, 0.15, 0.07 };
  const std::vector<double> few = { 1.0, 0.5, 0.3, before };
  const std::vector<double> indices = { 1.0, 1.5, 2.2 }, coats = { 0.07, 0.2, 0.4 };
  std::vector<Parameters> starts;
  for (const double roughness : extent == WithCoat ? few : any)
  {
    for (const double metallic : { 0.0, 0.5, 1.0 })
    {
      Parameters start;
      start << roughness, metallic, 1.5, 1.0, 0.0, 0.0, 2.0; // VTK's defaults
      for (std::size_t k = 0; k < (extent == MetallicRoughness ? 1 : indices.size()); ++k)
      {
        if (extent == WithFresnel)
        {
          start.segment<2>(BASE_IOR) << indices[k], 0.5;
        }
        else if (extent == WithCoat)
        {
          start.tail<3>() << 1.0, coats[k], 1.5;
        }
        starts.push_back(start);
      }
    }
  }
  return starts;
}

//------------------------------------------------------------------------------
// The best of what the few best starts lead to.
Candidate Search(PBRPicture& picture, double before, int extent, const Limits& limits)
{
  constexpr std::size_t refined = 3;
  std::vector<Candidate> candidates;
  for (Parameters start : GetStarts(extent, before))
  {
    start.head(extent) =
      start.head(extent).max(limits.Least.head(extent)).min(limits.Most.head(extent));
    candidates.emplace_back(picture, start);
  }
  std::stable_sort(candidates.begin(), candidates.end());
  Candidate best;
  for (std::size_t k = 0; k < refined; ++k)
  {
    if (k == 0 || (candidates[k].Values != candidates[k - 1].Values).any())
    {
      best = std::min(best, Refine(picture, candidates[k], extent, limits));
    }
  }
  return best;
}

//------------------------------------------------------------------------------
// More parameters only where they are worth it.
Candidate SearchWithin(PBRPicture& picture, const Limits& limits)
{
  Candidate best;
  for (const int extent : { MetallicRoughness, WithFresnel, WithCoat })
  {
    const Candidate next = Search(picture, best.Values[ROUGHNESS], extent, limits);
    if (!(next.Error >= WorthIt * best.Error))
    {
      best = next;
    }
  }
  return best;
}
}

//------------------------------------------------------------------------------
void vtkPBRPropertyFitter::SetBRDF(vtkBRDF* brdf) { measuredbrdfAssignMacro(BRDF, brdf); }

//------------------------------------------------------------------------------
void vtkPBRPropertyFitter::SetToNeutralStudio(vtkEnvironment* environment, int rows)
{
  if (!environment)
  {
    return;
  }
  rows = std::clamp(rows, 1, 2048);
  std::vector<float> pixels;
  for (int k = 0; k < 2 * rows * rows; ++k)
  {
    glm::dvec3 d;
    vtkEnvironment::GetDirection(
      (k % (2 * rows) + 0.5) / (2 * rows), (k / (2 * rows) + 0.5) / rows, &d.x);
    pixels.insert(pixels.end(), 3, static_cast<float>(GetNeutralRadiance(d)));
  }
  environment->SetPixels(2 * rows, rows, std::move(pixels));
  environment->SetName("neutral studio");
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
  PBRPicture picture(this->BRDF);
  const double leastMetallic = 0.3;
  Candidate best = SearchWithin(picture, Limits(0.0, 0.0, 1.0, 2.0)); // a dielectric
  const Candidate metal = SearchWithin(picture, Limits(leastMetallic, 1.0, 0.6, 2.0));
  // One at the least metallic part wants to be none.
  const bool isMetal =
    metal.Values[METALLIC] > leastMetallic && metal.Error < WorthMetal * best.Error;
  best = isMetal ? metal : best;
  const Candidate closest =
    std::min({ best, metal, SearchWithin(picture, Limits(0.0, 1.0, 1.0, 3.0)) });
  this->ClosestError = closest.Error;
  best = this->UsualValues ? best : closest;
  std::copy_n(best.Color.data(), 3, this->BaseColor);
  this->Roughness = best.Values[ROUGHNESS];
  this->Metallic = best.Values[METALLIC];
  this->BaseIOR = best.Values[BASE_IOR];
  this->EdgeTint = best.Values[EDGE_TINT];
  this->CoatStrength = best.Values[COAT_STRENGTH];
  this->CoatRoughness = best.Values[COAT_ROUGHNESS];
  this->CoatIOR = best.Values[COAT_IOR];
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
  const double alpha2 = GetAlphaSquared(coat ? this->CoatRoughness : this->Roughness);
  const double base = property->ComputeReflectanceOfBaseLayer();
  Eigen::Array3d f0 = Eigen::Map<const Eigen::Array3d>(this->BaseColor);
  f0 = base + (f0 - base) * this->Metallic;
  if (coat)
  {
    f0.setConstant(vtkProperty::ComputeReflectanceFromIOR(this->CoatIOR, 1.0));
  }
  const double most = f0.maxCoeff();
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
