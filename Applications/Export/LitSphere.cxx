// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LitSphere.h"

#include "Lobes.h"
#include "ParallelFor.h"

#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace tool
{
namespace
{
// Rings of pixels, each of the same area on the sphere's disc, and pixels of a ring.
constexpr int NumberOfRings = 12;
constexpr int PixelsOfRing = 16;
constexpr int AnisotropicPixelsOfRing = 8; // each has a view of its own
// Nodes in theta_h, and in phi_h over half a turn.
constexpr int NumberOfPolars = 40;
constexpr int AzimuthsOfHalf = 12;
constexpr double LeastCosine = 1e-3; // of a node's direction

//------------------------------------------------------------------------------
glm::dvec3 GetDirection(double polar, double azimuth)
{
  return { std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
    std::cos(polar) };
}

//------------------------------------------------------------------------------
// The rows that a texel's energy is summed in: those of the map's own texels, or fewer.
vtkSmartPointer<vtkEnvironment> Reduce(vtkEnvironment* environment)
{
  constexpr int rows = 128;
  vtkEnvironment* fine = environment->GetSubdivided();
  const int factor = fine->GetHeight() / rows;
  if (factor < 2 || fine->GetHeight() % factor != 0 || fine->GetWidth() % factor != 0)
  {
    return fine;
  }
  const int width = fine->GetWidth() / factor;
  const int height = fine->GetHeight() / factor;
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      glm::dvec3 sum(0.0);
      double area = 0.0;
      for (int k = 0; k < factor * factor; ++k)
      {
        const int row = y * factor + k / factor;
        glm::dvec3 rgb;
        fine->GetPixel(x * factor + k % factor, row, &rgb.x);
        sum += fine->GetTexelSolidAngle(row) * rgb;
        area += fine->GetTexelSolidAngle(row);
      }
      for (int c = 0; c < 3; ++c)
      {
        pixels.push_back(static_cast<float>(sum[c] / area));
      }
    }
  }
  auto reduced = vtkSmartPointer<vtkEnvironment>::New();
  reduced->SetPixels(width, height, std::move(pixels));
  return reduced;
}
}

//------------------------------------------------------------------------------
LitSphere::LitSphere(const std::array<double, 3>& view, bool isotropic)
  : Isotropic(isotropic)
  , NumberOfAzimuths(isotropic ? AzimuthsOfHalf + 1 : 2 * AzimuthsOfHalf)
{
  const glm::dvec3 eye = glm::normalize(glm::dvec3(view[0], view[1], view[2]));
  const glm::dvec3 side = glm::normalize(
    glm::cross(std::abs(eye.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0), eye));
  const glm::dvec3 up = glm::cross(eye, side);
  const int pixels = isotropic ? PixelsOfRing : AnisotropicPixelsOfRing;
  for (int ring = 0; ring < NumberOfRings; ++ring)
  {
    const double cosine = std::sqrt(1.0 - (ring + 0.5) / NumberOfRings);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    for (int k = 0; k < pixels; ++k)
    {
      // Rings are turned against each other.
      const double phi = 2.0 * Pi * (k + 0.5 * (ring % 2)) / pixels;
      const glm::dvec3 normal = cosine * eye + sine * (std::cos(phi) * side + std::sin(phi) * up);
      // Of isotropic materials any tangent will do: the view's own makes the views of a ring equal.
      const glm::dvec3 along =
        isotropic ? eye - cosine * normal : glm::dvec3(normal.z, 0.0, -normal.x);
      const glm::dvec3 tangent = glm::normalize(along);
      const glm::dmat3 frame(tangent, glm::cross(normal, tangent), normal);
      const bool known = isotropic && k > 0;
      this->Pixels.push_back(
        { frame, known ? this->Views.size() - 1 : this->AddView(eye * frame) });
    }
  }
}

//------------------------------------------------------------------------------
std::size_t LitSphere::AddView(const glm::dvec3& direction)
{
  View view{ direction, std::atan2(direction.y, direction.x), {}, {} };
  const double step = Pi / AzimuthsOfHalf;
  for (int polar = 0; polar < NumberOfPolars; ++polar)
  {
    const double theta = 0.5 * Pi * Square((polar + 0.5) / NumberOfPolars);
    for (int k = 0; k < this->NumberOfAzimuths; ++k)
    {
      const glm::dvec3 half = GetDirection(theta, view.Azimuth + k * step);
      const glm::dvec3 light = 2.0 * glm::dot(half, direction) * half - direction;
      const bool isAbove = light.z >= LeastCosine;
      view.Nodes.push_back(isAbove ? static_cast<std::ptrdiff_t>(view.Lights.size()) : -1);
      if (isAbove)
      {
        view.Lights.emplace_back(light, direction);
      }
    }
  }
  this->Views.push_back(std::move(view));
  return this->Views.size() - 1;
}

//------------------------------------------------------------------------------
// Bilinear between four nodes, of which those below the horizon take nothing.
void LitSphere::Splat(
  const View& view, const glm::dvec3& light, const glm::dvec3& energy, Energies& energies) const
{
  const glm::dvec3 half = glm::normalize(light + view.Direction);
  const double theta = std::acos(std::min(half.z, 1.0));
  double phi = std::atan2(half.y, half.x) - view.Azimuth;
  phi = this->Isotropic ? std::abs(std::remainder(phi, 2.0 * Pi))
                        : phi - 2.0 * Pi * std::floor(phi / (2.0 * Pi));
  const double u =
    std::clamp(NumberOfPolars * std::sqrt(theta / (0.5 * Pi)) - 0.5, 0.0, NumberOfPolars - 1.0);
  const double v = phi * AzimuthsOfHalf / Pi;
  const int column = static_cast<int>(v);
  for (int row = std::min(static_cast<int>(u), NumberOfPolars - 2); row >= 0; --row)
  {
    std::array<std::ptrdiff_t, 4> places;
    std::array<double, 4> weights;
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k)
    {
      const int polar = row + static_cast<int>(k / 2);
      int azimuth = column + static_cast<int>(k % 2);
      azimuth = this->Isotropic ? std::min(azimuth, this->NumberOfAzimuths - 1)
                                : azimuth % this->NumberOfAzimuths;
      places[k] = view.Nodes[static_cast<std::size_t>(polar * this->NumberOfAzimuths + azimuth)];
      weights[k] = places[k] >= 0
                     ? std::max(1.0 - std::abs(u - polar), 1e-9) *
                         std::max(1.0 - std::abs(v - column - static_cast<double>(k % 2)), 1e-9)
                     : 0.0;
      sum += weights[k];
    }
    for (std::size_t k = 0; k < 4 && sum > 0.0; ++k)
    {
      if (places[k] >= 0)
      {
        energies[static_cast<std::size_t>(places[k])] += weights[k] / sum * energy;
      }
    }
    if (sum > 0.0)
    {
      return;
    }
  }
}

//------------------------------------------------------------------------------
void LitSphere::Collect(vtkEnvironment* environment, const Pixel& pixel, Energies& energies) const
{
  const View& view = this->Views[pixel.View];
  energies.assign(view.Lights.size(), glm::dvec3(0.0));
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    const double solidAngle = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      glm::dvec3 direction;
      environment->GetTexelDirection(x, y, &direction.x);
      const glm::dvec3 light = direction * pixel.Frame;
      if (light.z > 0.0)
      {
        glm::dvec3 rgb;
        environment->GetPixel(x, y, &rgb.x);
        this->Splat(view, light, light.z * solidAngle * rgb, energies);
      }
    }
  }
}

//------------------------------------------------------------------------------
void LitSphere::AddLight(vtkEnvironment* environment)
{
  const vtkSmartPointer<vtkEnvironment> reduced = Reduce(environment);
  std::vector<Energies> energies(this->Pixels.size());
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(this->Pixels.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      {
        this->Collect(reduced, this->Pixels[k], energies[k]);
      }
    });
  this->Lights.push_back(std::move(energies));
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> LitSphere::Evaluate(vtkBRDF* brdf, const View& view) const
{
  std::vector<glm::dvec3> values;
  values.reserve(view.Lights.size());
  if (const auto* model = SurfaceModel::SafeDownCast(brdf)) // a fit asks for thousands of sums
  {
    for (const Directions& directions : view.Lights)
    {
      values.push_back(model->EvaluateDirections(directions));
    }
    return values;
  }
  for (const Directions& directions : view.Lights)
  {
    const glm::dvec3& light = directions.Light;
    glm::dvec3 f;
    brdf->Evaluate(&light.x, &view.Direction.x, &f.x);
    if (this->Isotropic)
    {
      // Energies on both sides of the plane of incidence are in one node; shading models are
      // symmetric.
      const glm::dvec3 mirrored(light.x, -light.y, light.z); // the view's y is 0
      glm::dvec3 other;
      brdf->Evaluate(&mirrored.x, &view.Direction.x, &other.x);
      f = 0.5 * (f + other);
    }
    values.push_back(f);
  }
  return values;
}

//------------------------------------------------------------------------------
std::vector<double> LitSphere::Sum(vtkBRDF* brdf) const
{
  std::vector<std::vector<glm::dvec3>> values(this->Views.size());
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(values.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      {
        values[k] = this->Evaluate(brdf, this->Views[k]);
      }
    });
  std::vector<double> radiance;
  for (const std::vector<Energies>& light : this->Lights)
  {
    for (std::size_t p = 0; p < light.size(); ++p)
    {
      const std::vector<glm::dvec3>& f = values[this->Pixels[p].View];
      glm::dvec3 sum(0.0);
      for (std::size_t k = 0; k < f.size(); ++k)
      {
        sum += f[k] * light[p][k];
      }
      radiance.insert(radiance.end(), { sum.x, sum.y, sum.z });
    }
  }
  return radiance;
}

//------------------------------------------------------------------------------
std::array<double, 3> GetViewDirection(const View& view)
{
  const double azimuth = vtkMath::RadiansFromDegrees(view.Azimuth);
  const double elevation = vtkMath::RadiansFromDegrees(view.Elevation);
  return { std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
    std::cos(elevation) * std::cos(azimuth) };
}

//------------------------------------------------------------------------------
Surface MakeSphereSurface(int size, const View& view)
{
  const std::array<double, 3> eye = GetViewDirection(view);
  const double azimuth = vtkMath::RadiansFromDegrees(view.Azimuth);
  const double right[3] = { std::cos(azimuth), 0.0, -std::sin(azimuth) };
  double up[3];
  vtkMath::Cross(eye.data(), right, up);
  Surface surface;
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const double u = 2.0 * (x + 0.5) / size - 1.0;
      const double v = 2.0 * (y + 0.5) / size - 1.0;
      const double depth2 = 1.0 - u * u - v * v;
      if (depth2 <= 0.0)
      {
        continue;
      }
      surface.Pixels.push_back(y * size + x);
      for (std::size_t c = 0; c < 3; ++c)
      {
        surface.Normals.push_back(u * right[c] + v * up[c] + std::sqrt(depth2) * eye[c]);
        surface.Views.push_back(eye[c]);
      }
    }
  }
  surface.NumberOfCovered = static_cast<int>(surface.Pixels.size());
  return surface;
}
} // namespace tool
