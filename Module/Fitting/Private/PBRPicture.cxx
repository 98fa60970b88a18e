// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PBRPicture.h"

#include "HalfVector.h" // for Pi
#include "LowDiscrepancy.h"
#include "vtkBRDF.h"

#include <limits>

namespace measuredbrdf
{
namespace
{
// Rings of pixels, each of the same area on the sphere's disc, and pixels of a ring.
constexpr int NumberOfViews = 12;
constexpr int NumberOfAzimuths = 16;
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
}

//------------------------------------------------------------------------------
PBRPicture::PBRPicture(vtkBRDF* brdf, const Light& light)
{
  for (int k = 0; k < NumberOfViews; ++k)
  {
    this->AddView(std::sqrt(1.0 - (k + 0.5) / NumberOfViews));
    this->AddPixels(k, light);
  }
  this->Draw(brdf);
}

//------------------------------------------------------------------------------
void PBRPicture::AddView(double cosine)
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

//------------------------------------------------------------------------------
void PBRPicture::AddPixels(int view, const Light& light)
{
  const double z = this->ViewCosines[static_cast<std::size_t>(view)];
  const double r = std::sqrt(1.0 - z * z);
  for (int k = 0; k < NumberOfAzimuths; ++k)
  {
    // Rings are turned against each other.
    const double phi = 2.0 * Pi * (k + 0.5 * (view % 2)) / NumberOfAzimuths;
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

//------------------------------------------------------------------------------
void PBRPicture::Draw(vtkBRDF* brdf)
{
  this->NumberOfTangents = brdf->IsIsotropic() ? 1 : TangentsOfAnisotropic;
  const auto tangents = static_cast<std::size_t>(this->NumberOfTangents);
  this->Reference.assign(3 * this->Pixels.size() * tangents, 0.0);
  std::vector<double> f;
  for (int view = 0; view < NumberOfViews; ++view)
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

//------------------------------------------------------------------------------
const std::vector<PBRMoments>& PBRPicture::GetSpecularMoments(double roughness)
{
  std::vector<PBRMoments>& moments =
    this->SpecularMoments[static_cast<int>(std::lround(100.0 * roughness))];
  if (!moments.empty())
  {
    return moments;
  }
  std::vector<std::vector<double>> lobes(NumberOfViews);
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

//------------------------------------------------------------------------------
void PBRPicture::GetRadiance(
  const PBRParameters& parameters, double f90, std::vector<Quadratic>& radiance)
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

//------------------------------------------------------------------------------
// Sum |model - reference| of a channel.
double PBRPicture::GetDistance(
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

//------------------------------------------------------------------------------
double PBRPicture::FitChannel(
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

//------------------------------------------------------------------------------
double PBRPicture::FitColor(const PBRParameters& parameters, std::array<double, 3>& color)
{
  constexpr int rounds = 2;
  std::vector<Quadratic> radiance;
  double sum = 0.0;
  // The reflectance at grazing incidence depends on all three channels where F0 is below 2 %: fit,
  // fit again with the one that belongs to the color, and measure with that of the last color.
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
} // namespace measuredbrdf
