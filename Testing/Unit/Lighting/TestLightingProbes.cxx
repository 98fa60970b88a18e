// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HalfVector.h" // for Pi
#include "LightProbe.h"
#include "RandomLight.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace measuredbrdf;

namespace
{
using P = Projection;

constexpr P Projections[] = { P::AngularMap, P::MirrorBall, P::HorizontalCross, P::VerticalCross,
  P::HorizontalStrip, P::VerticalStrip };

struct ProbeSize
{
  int Width;
  int Height;
  std::size_t GetTexels() const { return std::size_t(this->Width) * std::size_t(this->Height); }
  glm::dvec2 GetCenter(std::size_t texel) const
  {
    return { (static_cast<double>(texel % this->Width) + 0.5) / this->Width,
      (static_cast<double>(texel / this->Width) + 0.5) / this->Height };
  }
};

// About as many texels over the sphere as a lat-long image of the given rows.
ProbeSize GetProbeSize(P projection, int rows)
{
  const int face = std::max(1, static_cast<int>(std::lround(rows / std::sqrt(3.0))));
  const int disc = std::max(1, static_cast<int>(std::lround(rows * std::sqrt(8.0 / Pi))));
  switch (projection)
  {
    case P::HorizontalCross:
      return { 4 * face, 3 * face };
    case P::VerticalCross:
      return { 3 * face, 4 * face };
    case P::HorizontalStrip:
      return { 6 * face, face };
    case P::VerticalStrip:
      return { face, 6 * face };
    default:
      return { disc, disc };
  }
}

glm::dvec3 DrawDirection(std::mt19937& engine)
{
  const double y = 2.0 * Uniform(engine) - 1.0;
  const double phi = 2.0 * Pi * Uniform(engine);
  const double s = std::sqrt(1.0 - y * y);
  return { s * std::cos(phi), y, s * std::sin(phi) };
}

// Smooth, without symmetries, 3 different channels.
float GetSmooth(const glm::dvec3& d, int c)
{
  return static_cast<float>(1.0 + 0.4 * d[c] + 0.3 * d[0] * d[1] - 0.2 * d[1] * d[2] +
                            std::exp(4.0 * (0.6 * d[0] + 0.48 * d[1] - 0.64 * d[2] - 1.0)));
}

vtkSmartPointer<vtkEnvironment> Convert(
  P projection, const ProbeSize& size, const std::vector<float>& rgb, int rows = 0)
{
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  EXPECT_TRUE(ConvertProbe(projection, size.Width, size.Height, rgb, environment, rows));
  return environment;
}

// Texel by texel, whatever is between them.
double GetTotalOfTexels(vtkEnvironment* environment)
{
  const std::vector<float>& pixels = environment->GetPixels();
  double total = 0.0;
  for (std::size_t k = 0; k < pixels.size(); ++k)
  {
    const auto row = static_cast<int>(k / 3) / environment->GetWidth();
    total += environment->GetTexelSolidAngle(row) * pixels[k];
  }
  return total;
}

// The solid angle that a texel shows: the midpoint rule over 16 x 16 points of it.
double GetTexelSolidAngle(P projection, const ProbeSize& size, std::size_t texel)
{
  constexpr int side = 16;
  const glm::dvec2 extent(1.0 / size.Width, 1.0 / size.Height);
  const glm::dvec2 corner = size.GetCenter(texel) - 0.5 * extent;
  double sum = 0.0;
  for (int k = 0; k < side * side; ++k)
  {
    const glm::dvec2 at =
      corner + extent * (glm::dvec2(k % side, k / side) + 0.5) / static_cast<double>(side);
    glm::dvec3 ignored;
    sum += MapToDirection(projection, at, ignored) ? GetSolidAngleDensity(projection, at) : 0.0;
  }
  return sum * extent.x * extent.y / (side * side);
}
} // namespace

//------------------------------------------------------------------------------
TEST(Probes, MapsAreInverse)
{
  for (const P projection : Projections)
  {
    SCOPED_TRACE(GetProjectionName(projection));
    std::mt19937 engine(11);
    for (int k = 0; k < 5000; ++k)
    {
      const glm::dvec3 d = DrawDirection(engine);
      const glm::dvec2 uv = MapToImage(projection, 1e-30 * d); // of any length
      glm::dvec3 back;
      ASSERT_TRUE(MapToDirection(projection, uv, back));
      ASSERT_LT(glm::distance(d, back), 1e-12);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Probes, NothingOutside)
{
  glm::dvec3 d;
  EXPECT_FALSE(MapToDirection(P::AngularMap, { 0.05, 0.05 }, d));
  EXPECT_FALSE(MapToDirection(P::MirrorBall, { 0.99, 0.99 }, d));
  EXPECT_FALSE(MapToDirection(P::HorizontalCross, { 0.1, 0.9 }, d));
  EXPECT_FALSE(MapToDirection(P::VerticalCross, { 0.1, 0.4 }, d));
  EXPECT_EQ(d, glm::dvec3(0.0));
  EXPECT_EQ(GetSolidAngleDensity(P::HorizontalCross, { 0.1, 0.9 }), 0.0);
}

//------------------------------------------------------------------------------
TEST(Probes, DensityIsTheJacobian)
{
  std::mt19937 engine(5);
  const double h = 1e-5;
  for (const P projection : Projections)
  {
    SCOPED_TRACE(GetProjectionName(projection));
    for (int tried = 0; tried < 1000;)
    {
      const glm::dvec2 uv(Uniform(engine), Uniform(engine));
      glm::dvec3 left, right, below, above;
      const bool inside = MapToDirection(projection, uv + glm::dvec2(h, 0.0), right) &&
                          MapToDirection(projection, uv - glm::dvec2(h, 0.0), left) &&
                          MapToDirection(projection, uv + glm::dvec2(0.0, h), above) &&
                          MapToDirection(projection, uv - glm::dvec2(0.0, h), below);
      // Derivatives grow without bound at a mirror ball's rim.
      const bool rim =
        projection == P::MirrorBall && glm::length(2.0 * uv - glm::dvec2(1.0)) > 0.99;
      if (inside && !rim && glm::distance(left, right) < 0.01 && glm::distance(below, above) < 0.01)
      {
        ++tried;
        const double jacobian =
          glm::length(glm::cross(right - left, above - below)) / (4.0 * h * h);
        ASSERT_NEAR(jacobian, GetSolidAngleDensity(projection, uv), 1e-4 * jacobian + 1e-5);
      }
    }
  }
}

//------------------------------------------------------------------------------
// The conventions, written out: where the axes are in each image.
TEST(Probes, Orientation)
{
  struct
  {
    P Where;
    double U, V;
    glm::dvec3 D;
  } const cases[] = {
    // Debevec's angular map: forward in the middle, sideways at half the radius.
    { P::AngularMap, 0.5, 0.5, { 0, 0, -1 } },
    { P::AngularMap, 0.75, 0.5, { 1, 0, 0 } },
    { P::AngularMap, 0.25, 0.5, { -1, 0, 0 } },
    { P::AngularMap, 0.5, 0.75, { 0, 1, 0 } },
    { P::AngularMap, 0.5, 0.25, { 0, -1, 0 } },
    { P::AngularMap, 1.0, 0.5, { 0, 0, 1 } },
    // The ball's middle shows the camera; 45 degrees on the ball mirror to 90.
    { P::MirrorBall, 0.5, 0.5, { 0, 0, 1 } },
    { P::MirrorBall, 0.5 + 0.25 * std::sqrt(2.0), 0.5, { 1, 0, 0 } },
    { P::MirrorBall, 0.5, 0.5 + 0.25 * std::sqrt(2.0), { 0, 1, 0 } },
    { P::MirrorBall, 0.5, 0.5 - 0.25 * std::sqrt(2.0), { 0, -1, 0 } },
    { P::MirrorBall, 1.0, 0.5, { 0, 0, -1 } },
    { P::HorizontalCross, 0.375, 0.5, { 0, 0, -1 } },
    { P::HorizontalCross, 0.625, 0.5, { 1, 0, 0 } },
    { P::HorizontalCross, 0.125, 0.5, { -1, 0, 0 } },
    { P::HorizontalCross, 0.875, 0.5, { 0, 0, 1 } },
    { P::HorizontalCross, 0.375, 5.0 / 6.0, { 0, 1, 0 } },
    { P::HorizontalCross, 0.375, 1.0 / 6.0, { 0, -1, 0 } },
    { P::VerticalCross, 0.5, 0.625, { 0, 0, -1 } },
    { P::VerticalCross, 5.0 / 6.0, 0.625, { 1, 0, 0 } },
    { P::VerticalCross, 1.0 / 6.0, 0.625, { -1, 0, 0 } },
    { P::VerticalCross, 0.5, 0.875, { 0, 1, 0 } },
    { P::VerticalCross, 0.5, 0.375, { 0, -1, 0 } },
    { P::VerticalCross, 0.5, 0.125, { 0, 0, 1 } },
    { P::HorizontalStrip, 0.5 / 6.0, 0.5, { 1, 0, 0 } },
    { P::VerticalStrip, 0.5, 5.5 / 6.0, { 1, 0, 0 } },
    { P::VerticalStrip, 0.5, 0.5 / 6.0, { 0, 0, 1 } },
  };
  for (const auto& c : cases)
  {
    glm::dvec3 d;
    ASSERT_TRUE(MapToDirection(c.Where, { c.U, c.V }, d));
    // The mirror ball's rim magnifies the last digit.
    EXPECT_LT(glm::distance(d, c.D), 1e-7)
      << GetProjectionName(c.Where) << " " << c.U << ", " << c.V;
  }
}

//------------------------------------------------------------------------------
// OpenGL's table of cube faces (s to the right, t down; 3.2 core, table 3.19), with z turned round.
TEST(Probes, CubeFacesAreOpenGLs)
{
  std::mt19937 engine(8);
  for (int k = 0; k < 600; ++k)
  {
    const int face = k % 6;
    const double s = Uniform(engine);
    const double t = Uniform(engine);
    glm::dvec3 r;
    ASSERT_TRUE(MapToDirection(P::HorizontalStrip, { (face + s) / 6.0, 1.0 - t }, r));
    r.z = -r.z;
    const double sc[6] = { -r[2], r[2], r[0], r[0], r[0], -r[0] };
    const double tc[6] = { -r[1], -r[1], r[2], -r[2], -r[1], -r[1] };
    const double ma = (face % 2 ? -1.0 : 1.0) * r[face / 2];
    EXPECT_GE(ma, std::max({ std::abs(r[0]), std::abs(r[1]), std::abs(r[2]) }));
    EXPECT_NEAR(0.5 * (sc[face] / ma + 1.0), s, 1e-12);
    EXPECT_NEAR(0.5 * (tc[face] / ma + 1.0), t, 1e-12);
  }
}

//------------------------------------------------------------------------------
// Garbage outside the disc or beside the cross does not matter.
TEST(Probes, ConstantStaysConstant)
{
  for (const P projection : Projections)
  {
    SCOPED_TRACE(GetProjectionName(projection));
    for (const int rows : { 1, 2, 7, 40 })
    {
      const ProbeSize size = GetProbeSize(projection, rows);
      std::vector<float> rgb;
      for (std::size_t k = 0; k < size.GetTexels(); ++k)
      {
        glm::dvec3 ignored;
        const float bad = k % 2 ? -7.0f : std::numeric_limits<float>::quiet_NaN();
        rgb.insert(
          rgb.end(), 3, MapToDirection(projection, size.GetCenter(k), ignored) ? 3.0f : bad);
      }
      for (const int target : { 1, 3, 16, 61 })
      {
        const auto environment = Convert(projection, size, rgb, target);
        EXPECT_EQ(environment->GetHeight(), target);
        for (const float value : environment->GetPixels())
        {
          ASSERT_NEAR(value, 3.0f, 1e-6f) << rows << " to " << target;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Random texels over five decades, and a single one: shrunk, kept and magnified. Coarse, so that
// errors show; away from rims, where texels are taken or left by their centers.
TEST(Probes, EnergyIsKept)
{
  constexpr int rows = 24;
  for (const P projection : Projections)
  {
    const bool isDisc = projection == P::AngularMap || projection == P::MirrorBall;
    for (const double scale : { 0.5, 1.0, 3.3 })
    {
      const ProbeSize size = GetProbeSize(projection, static_cast<int>(rows * scale));
      const auto isAway = [&](std::size_t k)
      {
        glm::dvec3 d;
        return MapToDirection(projection, size.GetCenter(k), d) &&
               !(isDisc && glm::length(2.0 * size.GetCenter(k) - 1.0) > 0.6);
      };
      std::mt19937 engine(17);
      for (int run = 0; run < 8; ++run)
      {
        std::vector<float> rgb(3 * size.GetTexels(), 0.0f);
        std::size_t bright = engine() % size.GetTexels();
        while (!isAway(bright))
        {
          bright = (bright + 1) % size.GetTexels();
        }
        double expected = 0.0;
        for (std::size_t k = 0; k < size.GetTexels(); ++k)
        {
          const bool random = run == 0 && isAway(k);
          rgb[3 * k] = random ? static_cast<float>(std::exp(12.0 * Uniform(engine) - 8.0))
                              : (run > 0 && k == bright ? 222208.0f : 0.0f);
          expected +=
            rgb[3 * k] > 0.0f ? rgb[3 * k] * GetTexelSolidAngle(projection, size, k) : 0.0;
        }
        const double found = GetTotalOfTexels(Convert(projection, size, rgb, rows));
        EXPECT_NEAR(found / expected, 1.0, run == 0 ? 3e-3 : 2e-2)
          << GetProjectionName(projection) << ", " << size.Width << " x " << size.Height;
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(Probes, ASmoothSkyIsItself)
{
  constexpr int rows = 128;
  for (const P projection : Projections)
  {
    const ProbeSize size = GetProbeSize(projection, rows);
    std::vector<float> rgb;
    for (std::size_t k = 0; k < size.GetTexels(); ++k)
    {
      glm::dvec3 d;
      MapToDirection(projection, size.GetCenter(k), d);
      rgb.insert(rgb.end(), { GetSmooth(d, 0), GetSmooth(d, 1), GetSmooth(d, 2) });
    }
    const auto environment = Convert(projection, size, rgb);
    EXPECT_NEAR(environment->GetHeight(), rows, 1); // the resolution is kept
    double worst = 0.0;
    for (std::size_t k = 0; k < environment->GetPixels().size(); ++k)
    {
      const int texel = static_cast<int>(k / 3), width = environment->GetWidth();
      glm::dvec3 d;
      environment->GetTexelDirection(texel % width, texel / width, &d.x);
      const double expected = GetSmooth(d, static_cast<int>(k % 3));
      worst = std::max(worst, std::abs(environment->GetPixels()[k] / expected - 1.0));
    }
    // A mirror ball's rim shows what is straight behind it on few texels.
    EXPECT_LT(worst, projection == P::MirrorBall ? 0.3 : 0.1) << GetProjectionName(projection);
  }
}

//------------------------------------------------------------------------------
TEST(Probes, RepairsAndCounts)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  std::vector<float> rgb(3 * 16 * 16, 1.0f);
  rgb[0] = nan; // a corner: outside
  rgb[3 * (8 * 16 + 8)] = nan;
  rgb[3 * (8 * 16 + 9) + 1] = -inf;
  rgb[3 * (8 * 16 + 11)] = inf;
  rgb[3 * (8 * 16 + 10) + 2] = -2.0f;
  vtkNew<vtkEnvironment> environment;
  const BadValues bad = ConvertProbe(P::MirrorBall, 16, 16, rgb, environment).value();
  EXPECT_EQ(bad.NotFinite, 3);
  EXPECT_EQ(bad.Negative, 1);
  EXPECT_EQ(environment->GetNumberOfNonFiniteValues(), 0);
  const auto& pixels = environment->GetPixels();
  EXPECT_GE(*std::min_element(pixels.begin(), pixels.end()), 0.0f);
  const float most = *std::max_element(pixels.begin(), pixels.end());
  EXPECT_GT(most, 1000.0f);
  EXPECT_LE(most, 65504.1f);
}

//------------------------------------------------------------------------------
TEST(Probes, SixFaces)
{
  // Each face its number, row 0 (the bottom) ten times that.
  const int size = 8;
  std::vector<std::vector<float>> faces;
  for (int face = 0; face < 6; ++face)
  {
    faces.emplace_back(3 * size * size, face + 1.0f);
    std::fill_n(faces.back().begin(), 3 * size, 10.0f * (face + 1.0f));
  }
  vtkNew<vtkEnvironment> environment;
  EXPECT_FALSE(ConvertCubeFaces(size + 1, faces, environment));
  EXPECT_FALSE(ConvertCubeFaces(size, { faces[0] }, environment));
  EXPECT_FALSE(ConvertProbe(P::VerticalStrip, size, 6 * size, faces[0], environment));
  EXPECT_EQ(environment->GetWidth(), 0);
  EXPECT_TRUE(ConvertCubeFaces(size, faces, environment, 256));
  const double axes[6][3] = { { 1, 0.1, 0.1 }, { -1, 0.1, 0.1 }, { 0.1, 1, 0.1 }, { 0.1, -1, 0.1 },
    { 0.1, 0.1, -1 }, { 0.1, 0.1, 1 } };
  // The bottom edges: down of sides; towards forward of +y; towards backward of -y.
  const double bottoms[6][3] = { { 1, -0.95, 0.1 }, { -1, -0.95, 0.1 }, { 0.1, 1, -0.95 },
    { 0.1, -1, 0.95 }, { 0.1, -0.95, -1 }, { 0.1, -0.95, 1 } };
  for (int face = 0; face < 6; ++face)
  {
    double value[3];
    environment->GetRadiance(axes[face], value);
    EXPECT_NEAR(value[0], face + 1.0, 1e-3 * (face + 1.0)) << face;
    environment->GetRadiance(bottoms[face], value);
    EXPECT_NEAR(value[0], 10.0 * (face + 1.0), 1e-2 * (face + 1.0)) << face;
  }
}
