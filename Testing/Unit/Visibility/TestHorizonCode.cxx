// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Codes of hidden skies against closed forms.
#include "HalfVector.h"
#include "HorizonLight.h"
#include "LocalFrame.h"

#include <glm/glm.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace
{
using measuredbrdf::HorizonLight;
namespace sky = measuredbrdf::sky;

using measuredbrdf::Pi;

glm::dvec3 RandomDirection(std::mt19937& generator)
{
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(generator), normal(generator), normal(generator)));
}

// The code of a point about which `isHidden(direction in the code's frame)`.
template <typename IsHidden>
HorizonLight::Code Encode(const glm::dvec3& normal, int elevations, const IsHidden& isHidden)
{
  const HorizonLight::Rays rays(elevations);
  std::vector<char> hidden;
  for (const glm::dvec3& d : rays.GetDirections())
  {
    hidden.push_back(isHidden(d) ? 1 : 0);
  }
  return HorizonLight::Encode(normal, rays, hidden, isHidden);
}

// Light of random harmonics.
sky::Colors RandomLight(std::mt19937& generator)
{
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  sky::Colors light;
  for (glm::dvec3& color : light)
  {
    color = { value(generator), value(generator), value(generator) };
  }
  return light;
}

glm::dvec3 At(double degrees, double z)
{
  const double azimuth = degrees * Pi / 180.0;
  const double s = std::sqrt(1.0 - z * z);
  return { s * std::cos(azimuth), s * std::sin(azimuth), z };
}

glm::dvec3 GetRadiance(const sky::Colors& light, const glm::dvec3& d)
{
  const sky::Values values = sky::Evaluate(d);
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    sum += values[k] * light[k];
  }
  return sum;
}

TEST(HorizonLight, HarmonicsAreOrthonormal)
{
  // Rays of both hemispheres; 4096 of them integrate products of degree 8 to 1e-3.
  const HorizonLight::Rays rays(256);
  std::vector<std::vector<double>> products(
    sky::Harmonics, std::vector<double>(sky::Harmonics, 0.0));
  for (glm::dvec3 d : rays.GetDirections())
  {
    for (int side = 0; side < 2; ++side, d = -d)
    {
      const sky::Values values = sky::Evaluate(d);
      for (std::size_t a = 0; a < values.size(); ++a)
      {
        for (std::size_t b = 0; b < values.size(); ++b)
        {
          products[a][b] += values[a] * values[b] * rays.GetSolidAngle();
        }
      }
    }
  }
  for (std::size_t a = 0; a < sky::Harmonics; ++a)
  {
    for (std::size_t b = 0; b < sky::Harmonics; ++b)
    {
      EXPECT_NEAR(products[a][b], a == b ? 1.0 : 0.0, 5e-3) << a << ", " << b;
    }
  }
}

TEST(HorizonLight, RotatesLight)
{
  std::mt19937 generator(3);
  for (int k = 0; k < 20; ++k)
  {
    const sky::Colors light = RandomLight(generator);
    glm::dmat3 r = measuredbrdf::FrameAbout(RandomDirection(generator));
    r = k % 2 ? r : glm::dmat3(-r[0], r[1], r[2]); // mirrors, too
    const sky::Colors turned = sky::Rotate(light, r);
    const glm::dvec3 d = RandomDirection(generator);
    EXPECT_LT(glm::length(GetRadiance(turned, d) - GetRadiance(light, r * d)), 1e-9);
  }
}

TEST(HorizonLight, KeepsNormals)
{
  std::mt19937 generator(4);
  for (int k = 0; k < 1000; ++k)
  {
    const glm::dvec3 normal = RandomDirection(generator);
    std::uint8_t bytes[3];
    HorizonLight::PackNormal(normal, bytes);
    EXPECT_GT(glm::dot(normal, HorizonLight::UnpackNormal(bytes)), std::cos(1e-3));
  }
}

// A wall hides half of the sky: half of the irradiance from a uniform sky.
TEST(HorizonLight, AWallHidesHalf)
{
  const glm::dvec3 normal(0.0, 0.0, 1.0);
  // x < 0 about the frame's own axes, which are the world's here; the wall lies between sectors
  // of the rays as in their middles.
  const HorizonLight wall(Encode(normal, 16, [](const glm::dvec3& d) { return d.x < 0.0; }));
  EXPECT_NEAR(wall.GetHiddenCosine(), 0.5, 0.02);
  EXPECT_NEAR(
    wall.GetHiddenShare(4.0 * normal), 0.5, 0.06); // sectors cut in half count at the horizon
  EXPECT_NEAR(wall.GetHiddenShare(30.0 * glm::normalize(glm::dvec3(-1.0, 0.0, 1.0))), 1.0, 0.02);
  EXPECT_NEAR(wall.GetHiddenShare(30.0 * glm::normalize(glm::dvec3(1.0, 0.0, 1.0))), 0.0, 0.02);
  EXPECT_EQ(wall.GetVisibleLamp(glm::normalize(glm::dvec3(-1.0, 0.1, 0.5))), 0.0);
  EXPECT_EQ(wall.GetVisibleLamp(glm::normalize(glm::dvec3(1.0, 0.1, 0.5))), 1.0);
  for (const double radius : { 1e-3, 0.05, 0.2 })
  {
    EXPECT_NEAR(wall.GetHiddenPanel(glm::normalize(glm::dvec3(-1.0, 0.0, 0.5)), radius), 1.0, 0.02);
    EXPECT_NEAR(wall.GetHiddenPanel(glm::normalize(glm::dvec3(1.0, 0.0, 0.5)), radius), 0.0, 0.02);
    EXPECT_NEAR(wall.GetHiddenPanel(normal, radius), 0.5, 0.07);
    EXPECT_EQ(wall.GetHiddenPanel({ 0.0, 0.0, -1.0 }, radius), 0.0); // it never rises
  }
}

// Up to an elevation all around, as in the middle of a crater: cos^2 of it is hidden... of a
// uniform sky sin^2 of the elevation is.
TEST(HorizonLight, ACraterHidesTheLowSky)
{
  const double sine = 0.5;
  const HorizonLight crater(
    Encode({ 0.6, 0.0, 0.8 }, 16, [&](const glm::dvec3& d) { return d.z < sine; }));
  EXPECT_NEAR(crater.GetHiddenCosine(), sine * sine, 0.01);
  const glm::dvec3 normal = crater.GetNormal();
  // The share of cos theta exp(kappa cos theta) below the angle, in closed form. The lobe without
  // its cosine would have 0.38, 0.12 and 3e-4.
  for (const double kappa : { 1.0, 4.0, 16.0 })
  {
    const auto integral = [kappa](double z) { return std::exp(kappa * z) * (z - 1.0 / kappa); };
    const double expected = (integral(sine) - integral(0.0)) / (integral(1.0) - integral(0.0));
    EXPECT_NEAR(crater.GetHiddenShare(kappa * normal), expected, 0.01) << kappa;
  }
  EXPECT_EQ(crater.GetVisibleLamp(normal), 1.0);
  // A panel across the crater's edge: half of its height is hidden, and less of its irradiance.
  const glm::dvec3 across = glm::normalize(glm::dvec3(-0.8, 0.0, 0.6));
  const auto at = [&](double z) { return z * normal + std::sqrt(1.0 - z * z) * across; };
  EXPECT_NEAR(crater.GetHiddenPanel(at(sine), 0.14), 0.46, 0.03);
  EXPECT_NEAR(crater.GetHiddenPanel(at(sine - 0.15), 0.14), 1.0, 0.02);
  EXPECT_NEAR(crater.GetHiddenPanel(at(sine + 0.15), 0.14), 0.0, 0.02);
}

// A body that floats above a third of the horizon: beside it, where sectors are empty, it does not
// come down.
TEST(HorizonLight, FloatingBodiesEndBetweenSectors)
{
  const HorizonLight sky(Encode({ 0.0, 0.0, 1.0 }, 16,
    [](const glm::dvec3& d) { return d.z > 0.5 && d.z < 0.7 && d.x > 0.5; }));
  for (double degrees = -180.0; degrees < 180.0; degrees += 5.0)
  {
    for (const double z : { 0.3, 0.4, 0.8, 0.9 })
    {
      const glm::dvec3 d = At(degrees, z);
      EXPECT_EQ(sky.GetVisibleLamp(d), 1.0) << degrees << ", " << z;
      EXPECT_EQ(sky.GetHiddenPanel(d, 0.085), 0.0) << degrees << ", " << z;
    }
  }
}

// In a hollow the near wall and the one opposite hide, and their edges meet where it is narrow.
TEST(HorizonLight, HollowsHideFromBothSides)
{
  const auto isHidden = [](const glm::dvec3& d)
  { return 2.0 * d.z * d.x < 0.6; }; // sin(2 elevation) cos(azimuth): the rim of a sphere
  const HorizonLight hollow(Encode({ 0.0, 0.0, 1.0 }, 8, isHidden));
  double wrong = 0.0;
  double all = 0.0;
  for (double degrees = 0.0; degrees < 360.0; degrees += 1.5)
  {
    for (double z = 0.01; z < 1.0; z += 0.02)
    {
      const glm::dvec3 d = At(degrees, z);
      all += isHidden(d) ? 0.0 : 1.0;
      wrong += std::abs(hollow.GetVisibleLamp(d) - (isHidden(d) ? 0.0 : 1.0));
    }
  }
  EXPECT_LT(wrong / all, 0.2); // 0.13; with one hidden interval a sector 0.4
  // Lobes and panels: against sums over directions.
  for (const glm::dvec3& d : { glm::dvec3(0.6, 0.0, 0.8), glm::dvec3(0.8, 0.3, 0.52),
         glm::dvec3(0.2, 0.1, 0.97), glm::dvec3(-0.7, 0.0, 0.7) })
  {
    const glm::dvec3 axis = glm::normalize(d);
    for (const double kappa : { 4.0, 20.0 })
    {
      double lobe = 0.0;
      double hidden = 0.0;
      for (int k = 0; k < 200 * 400; ++k)
      {
        const double z = (k / 400 + 0.5) / 200.0;
        const glm::dvec3 at = At(360.0 * (k % 400) / 400.0, z);
        const double part = z * std::exp(kappa * (glm::dot(at, axis) - 1.0));
        lobe += part;
        hidden += isHidden(at) ? part : 0.0;
      }
      EXPECT_NEAR(hollow.GetHiddenShare(kappa * axis), hidden / lobe, 0.15) << kappa;
      EXPECT_NEAR(hollow.GetHiddenPanel(axis, std::sqrt(3.0 / kappa)), hidden / lobe, 0.2) << kappa;
    }
  }
}

// A cave's mouth with a sill below the lowest rays of every other sector: its edge does not jump
// between sectors.
TEST(HorizonLight, SillsOfOpeningsHideTheHorizon)
{
  const HorizonLight cave(Encode({ 0.0, 0.0, 1.0 }, 8,
    [](const glm::dvec3& d) { return d.x < 0.2 || d.z < 0.06 || d.z > 0.7; }));
  for (double degrees = -40.0; degrees <= 40.0; degrees += 5.0)
  {
    EXPECT_LT(cave.GetLampMargin(At(degrees, 0.01)), 0.0) << degrees;
    EXPECT_EQ(cave.GetVisibleLamp(At(degrees, 0.3)), 1.0) << degrees;
    EXPECT_EQ(cave.GetVisibleLamp(At(degrees, 0.9)), 0.0) << degrees;
  }
}

// A slit that is narrower than a byte's step is nothing, not an open sky.
TEST(HorizonLight, NarrowSlitsAreDark)
{
  const HorizonLight slit(Encode(
    { 0.0, 0.0, 1.0 }, 256, [](const glm::dvec3& d) { return d.z < 0.5015 || d.z > 0.5025; }));
  EXPECT_LT(slit.GetVisibleLamp({ 0.0, 0.0, 1.0 }), 0.01);
  EXPECT_LT(slit.GetVisibleLamp({ std::sqrt(0.91), 0.0, 0.3 }), 0.01);
  EXPECT_GT(slit.GetHiddenShare({ 0.0, 0.0, 8.0 }), 0.98);
}
}
