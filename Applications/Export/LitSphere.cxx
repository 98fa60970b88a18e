// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LitSphere.h"

#include "Lobes.h"
#include "LocalFrame.h"
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
  std::vector<float> pixels;
  for (int y = 0; y < fine->GetHeight(); y += factor)
  {
    for (int x = 0; x < fine->GetWidth(); x += factor)
    {
      glm::dvec3 sum(0.0);
      double area = 0.0;
      for (int k = 0; k < factor * factor; ++k)
      {
        glm::dvec3 rgb;
        fine->GetPixel(x + k % factor, y + k / factor, &rgb.x);
        sum += fine->GetTexelSolidAngle(y + k / factor) * rgb;
        area += fine->GetTexelSolidAngle(y + k / factor);
      }
      const glm::vec3 mean(sum / area);
      pixels.insert(pixels.end(), { mean.x, mean.y, mean.z });
    }
  }
  auto reduced = vtkSmartPointer<vtkEnvironment>::New();
  reduced->SetPixels(fine->GetWidth() / factor, fine->GetHeight() / factor, std::move(pixels));
  return reduced;
}
}

//------------------------------------------------------------------------------
LitSphere::LitSphere(const glm::dvec3& view, bool isotropic)
  : Isotropic(isotropic)
  , NumberOfAzimuths(isotropic ? AzimuthsOfHalf + 1 : 2 * AzimuthsOfHalf)
{
  const glm::dvec3 eye = glm::normalize(view);
  const glm::dvec3 side = glm::normalize(
    glm::cross(std::abs(eye.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0), eye));
  const glm::dvec3 up = glm::cross(eye, side);
  const int pixels = isotropic ? PixelsOfRing : AnisotropicPixelsOfRing;
  for (int ring = 0; ring < NumberOfRings; ++ring)
  {
    const double cosine = std::sqrt(1.0 - (ring + 0.5) / NumberOfRings);
    for (int k = 0; k < pixels; ++k)
    {
      // Rings are turned against each other.
      const glm::dvec3 local =
        measuredbrdf::ToDirection(cosine, 2.0 * Pi * (k + 0.5 * (ring % 2)) / pixels);
      const glm::dvec3 normal = glm::dmat3(side, up, eye) * local;
      // Of isotropic materials any tangent will do: the view's own makes the views of a ring equal.
      const glm::dvec3 tangent =
        glm::normalize(isotropic ? eye - cosine * normal : glm::dvec3(normal.z, 0.0, -normal.x));
      const glm::dmat3 frame(tangent, glm::cross(normal, tangent), normal);
      if (!isotropic || k == 0)
      {
        this->AddView(eye * frame);
      }
      this->Pixels.push_back({ frame, this->Views.size() - 1 });
    }
  }
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> LitSphere::GetNormals() const
{
  std::vector<glm::dvec3> normals;
  for (const Pixel& pixel : this->Pixels)
  {
    normals.push_back(pixel.Frame[2]);
  }
  return normals;
}

//------------------------------------------------------------------------------
void LitSphere::AddView(const glm::dvec3& direction)
{
  LocalView view{ direction, std::atan2(direction.y, direction.x), {}, {} };
  for (int polar = 0; polar < NumberOfPolars; ++polar)
  {
    const double theta = 0.5 * Pi * Square((polar + 0.5) / NumberOfPolars);
    for (int k = 0; k < this->NumberOfAzimuths; ++k)
    {
      const glm::dvec3 half =
        measuredbrdf::ToDirection(std::cos(theta), view.Azimuth + k * Pi / AzimuthsOfHalf);
      const glm::dvec3 light = measuredbrdf::ReflectAbout(direction, half);
      const bool isAbove = light.z >= LeastCosine;
      view.Nodes.push_back(isAbove ? static_cast<int>(view.Lights.size()) : -1);
      if (isAbove)
      {
        view.Lights.emplace_back(light, direction);
      }
    }
  }
  this->Views.push_back(std::move(view));
}

//------------------------------------------------------------------------------
// Bilinear between four nodes, of which those below the horizon take nothing. Where all four lie
// below it, those a row nearer to the normal take the energy.
void LitSphere::Splat(const LocalView& view, const glm::dvec3& light, const glm::dvec3& energy,
  Energies& energies) const
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
  double sum = 0.0;
  for (int row = std::min(static_cast<int>(u), NumberOfPolars - 2); row >= 0 && sum == 0.0; --row)
  {
    int places[4];
    double weights[4];
    for (int k = 0; k < 4; ++k)
    {
      const int polar = row + k / 2;
      const int beside = column + k % 2;
      const int azimuth = this->Isotropic ? std::min(beside, this->NumberOfAzimuths - 1)
                                          : beside % this->NumberOfAzimuths;
      places[k] = view.Nodes[polar * this->NumberOfAzimuths + azimuth];
      weights[k] = places[k] < 0 ? 0.0
                                 : std::max(1.0 - std::abs(u - polar), 1e-9) *
                                     std::max(1.0 - std::abs(v - beside), 1e-9);
      sum += weights[k];
    }
    for (int k = 0; k < 4; ++k)
    {
      if (places[k] >= 0)
      {
        energies.col(places[k]) += weights[k] / sum * Eigen::Map<const Eigen::Array3d>(&energy.x);
      }
    }
  }
}

//------------------------------------------------------------------------------
void LitSphere::AddLight(vtkEnvironment* environment)
{
  const vtkSmartPointer<vtkEnvironment> reduced = Reduce(environment);
  std::vector<Energies> light(this->Pixels.size());
  measuredbrdf::ParallelForEach(this->Pixels.size(),
    [&](std::size_t k)
    {
      const Pixel& pixel = this->Pixels[k];
      const LocalView& view = this->Views[pixel.View];
      light[k].setZero(3, static_cast<Eigen::Index>(view.Lights.size()));
      for (int y = 0; y < reduced->GetHeight(); ++y)
      {
        const double solidAngle = reduced->GetTexelSolidAngle(y);
        for (int x = 0; x < reduced->GetWidth(); ++x)
        {
          glm::dvec3 world, rgb;
          reduced->GetTexelDirection(x, y, &world.x);
          const glm::dvec3 direction = world * pixel.Frame;
          if (direction.z > 0.0)
          {
            reduced->GetPixel(x, y, &rgb.x);
            this->Splat(view, direction, direction.z * solidAngle * rgb, light[k]);
          }
        }
      }
    });
  this->Lights.push_back(std::move(light));
}

//------------------------------------------------------------------------------
// Energies on both sides of the plane of incidence are in one node of an isotropic sphere, so the
// mean of f on both sides counts. Shading models are symmetric, and a fit asks for thousands of
// their sums.
Eigen::Array3Xd LitSphere::Evaluate(vtkBRDF* brdf, const LocalView& view) const
{
  const auto* model = SurfaceModel::SafeDownCast(brdf);
  Eigen::Array3Xd values(3, view.Lights.size());
  Eigen::Index k = 0;
  for (const Directions& directions : view.Lights)
  {
    glm::dvec3 f;
    if (model)
    {
      f = model->EvaluateDirections(directions);
    }
    else
    {
      const glm::dvec3& light = directions.Light;
      brdf->Evaluate(&light.x, &view.Direction.x, &f.x);
      if (this->Isotropic)
      {
        const glm::dvec3 mirrored(light.x, -light.y, light.z); // the view's y is 0
        glm::dvec3 other;
        brdf->Evaluate(&mirrored.x, &view.Direction.x, &other.x);
        f = 0.5 * (f + other);
      }
    }
    values.col(k++) << f.x, f.y, f.z;
  }
  return values;
}

//------------------------------------------------------------------------------
Eigen::ArrayXXd LitSphere::Sum(vtkBRDF* brdf) const
{
  std::vector<Eigen::Array3Xd> values(this->Views.size());
  measuredbrdf::ParallelForEach(
    values.size(), [&](std::size_t k) { values[k] = this->Evaluate(brdf, this->Views[k]); });
  Eigen::ArrayXXd radiance(3 * this->Pixels.size(), this->Lights.size());
  for (Eigen::Index light = 0; light < radiance.cols(); ++light)
  {
    for (std::size_t p = 0; p < this->Pixels.size(); ++p)
    {
      const Eigen::Array3Xd& f = values[this->Pixels[p].View];
      const Energies& energies = this->Lights[light][p];
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      for (Eigen::Index k = 0; k < f.cols(); ++k) // faster than rowwise().sum()
      {
        sum += f.col(k) * energies.col(k);
      }
      radiance.col(light).segment<3>(3 * static_cast<Eigen::Index>(p)) = sum;
    }
  }
  return radiance;
}

//------------------------------------------------------------------------------
glm::dvec3 GetViewDirection(const View& view)
{
  const double azimuth = vtkMath::RadiansFromDegrees(view.Azimuth);
  const double elevation = vtkMath::RadiansFromDegrees(view.Elevation);
  return { std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
    std::cos(elevation) * std::cos(azimuth) };
}

//------------------------------------------------------------------------------
Surface MakeSphereSurface(int size, const View& view)
{
  const double azimuth = vtkMath::RadiansFromDegrees(view.Azimuth);
  const glm::dvec3 eye = GetViewDirection(view);
  const glm::dvec3 right(std::cos(azimuth), 0.0, -std::sin(azimuth));
  const glm::dmat3 frame(right, glm::cross(eye, right), eye);
  Surface surface;
  for (int k = 0; k < size * size; ++k)
  {
    const glm::dvec2 place(
      2.0 * (k % size + 0.5) / size - 1.0, 2.0 * (k / size + 0.5) / size - 1.0);
    const double depth2 = 1.0 - glm::dot(place, place);
    if (depth2 > 0.0)
    {
      const glm::dvec3 normal = frame * glm::dvec3(place, std::sqrt(depth2));
      surface.Pixels.push_back(k);
      surface.Normals.insert(surface.Normals.end(), { normal.x, normal.y, normal.z });
      surface.Views.insert(surface.Views.end(), { eye.x, eye.y, eye.z });
    }
  }
  surface.NumberOfCovered = static_cast<int>(surface.Pixels.size());
  return surface;
}
} // namespace tool
