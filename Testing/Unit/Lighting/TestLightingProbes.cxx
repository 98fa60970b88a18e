// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "RandomLight.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentProjection.h"
#include "vtkEnvironmentReader.h"
#include "vtkImageData.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

using measuredbrdf::Pi;

namespace
{
using P = vtkEnvironmentProjection;
using Direction = std::array<double, 3>;

constexpr int Projections[] = { P::LAT_LONG, P::ANGULAR_MAP, P::MIRROR_BALL,
  P::CUBE_HORIZONTAL_CROSS, P::CUBE_VERTICAL_CROSS, P::CUBE_HORIZONTAL_STRIP,
  P::CUBE_VERTICAL_STRIP };

struct Size
{
  int Width;
  int Height;
};

// About as many texels over the sphere as a lat-long image of the given rows.
Size GetSize(int projection, int rows)
{
  const int face = std::max(1, static_cast<int>(std::lround(rows / std::sqrt(3.0))));
  const int disc = std::max(1, static_cast<int>(std::lround(rows * std::sqrt(8.0 / Pi))));
  switch (projection)
  {
    case P::LAT_LONG:
      return { 2 * rows, rows };
    case P::CUBE_HORIZONTAL_CROSS:
      return { 4 * face, 3 * face };
    case P::CUBE_VERTICAL_CROSS:
      return { 3 * face, 4 * face };
    case P::CUBE_HORIZONTAL_STRIP:
      return { 6 * face, face };
    case P::CUBE_VERTICAL_STRIP:
      return { face, 6 * face };
    default:
      return { disc, disc };
  }
}

Direction DrawDirection(std::mt19937& engine)
{
  const double y = 2.0 * Uniform(engine) - 1.0;
  const double phi = 2.0 * Pi * Uniform(engine);
  const double s = std::sqrt(1.0 - y * y);
  return { s * std::cos(phi), y, s * std::sin(phi) };
}

double Distance(const Direction& a, const Direction& b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Smooth, without symmetries, 3 different channels.
float GetSmooth(const Direction& d, int c)
{
  const double v = 1.0 + 0.4 * d[c] + 0.3 * d[0] * d[1] - 0.2 * d[1] * d[2] +
                   std::exp(4.0 * (0.6 * d[0] + 0.48 * d[1] - 0.64 * d[2] - 1.0));
  return static_cast<float>(v);
}

vtkSmartPointer<vtkEnvironment> MakeSmooth(int rows)
{
  std::vector<float> rgb;
  for (int y = 0; y < rows; ++y)
  {
    for (int x = 0; x < 2 * rows; ++x)
    {
      Direction d;
      vtkEnvironment::GetDirection((x + 0.5) / (2 * rows), (y + 0.5) / rows, d.data());
      rgb.insert(rgb.end(), { GetSmooth(d, 0), GetSmooth(d, 1), GetSmooth(d, 2) });
    }
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  EXPECT_TRUE(environment->SetPixels(2 * rows, rows, rgb));
  return environment;
}

std::vector<float> GetPixels(vtkImageData* image)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  std::vector<float> rgb;
  for (vtkIdType k = 0; k < scalars->GetNumberOfTuples(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      rgb.push_back(static_cast<float>(scalars->GetComponent(k, c)));
    }
  }
  return rgb;
}

vtkSmartPointer<vtkEnvironment> Convert(
  int projection, const Size& size, const std::vector<float>& rgb, int rows = 0)
{
  vtkNew<P> converter;
  converter->SetProjection(projection);
  converter->SetHeight(rows);
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  EXPECT_TRUE(converter->Convert(size.Width, size.Height, rgb, environment));
  return environment;
}

std::vector<float> Project(vtkEnvironment* environment, int projection, const Size& size)
{
  vtkNew<P> converter;
  converter->SetProjection(projection);
  const auto image =
    vtkSmartPointer<vtkImageData>::Take(converter->NewProbe(environment, size.Width, size.Height));
  return image ? GetPixels(image) : std::vector<float>();
}

// Texel by texel, whatever is between them.
double GetTotalOfTexels(vtkEnvironment* environment)
{
  double total = 0.0;
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      double rgb[3];
      environment->GetPixel(x, y, rgb);
      total += environment->GetTexelSolidAngle(y) * (rgb[0] + rgb[1] + rgb[2]);
    }
  }
  return total;
}

double GetProbeTotal(int projection, const Size& size, const std::vector<float>& rgb)
{
  double total = 0.0;
  for (int y = 0; y < size.Height; ++y)
  {
    for (int x = 0; x < size.Width; ++x)
    {
      const std::size_t k = 3 * (std::size_t(y) * size.Width + x);
      total += P::GetTexelSolidAngle(projection, size.Width, size.Height, x, y) *
               (double(rgb[k]) + rgb[k + 1] + rgb[k + 2]);
    }
  }
  return total;
}

// Integral of |a - b| over that of b.
double GetRelativeL1(vtkEnvironment* a, vtkEnvironment* b)
{
  EXPECT_EQ(a->GetWidth(), b->GetWidth());
  EXPECT_EQ(a->GetHeight(), b->GetHeight());
  double error = 0.0;
  double total = 0.0;
  for (int y = 0; y < a->GetHeight(); ++y)
  {
    for (int x = 0; x < a->GetWidth(); ++x)
    {
      double va[3];
      double vb[3];
      a->GetPixel(x, y, va);
      b->GetPixel(x, y, vb);
      for (int c = 0; c < 3; ++c)
      {
        error += a->GetTexelSolidAngle(y) * std::abs(va[c] - vb[c]);
        total += a->GetTexelSolidAngle(y) * vb[c];
      }
    }
  }
  return error / total;
}

// A real photograph, half its size (512 x 256), or null.
vtkSmartPointer<vtkEnvironment> ReadStudio()
{
  const std::string path = std::string(MEASUREDBRDF_SHARED_DATA) + "/environments/studio.exr";
  if (!std::filesystem::exists(path))
  {
    return nullptr;
  }
  vtkNew<vtkEnvironmentReader> reader;
  reader->SetFileName(path);
  EXPECT_TRUE(reader->Read());
  vtkEnvironment* whole = reader->GetEnvironment();
  const auto half =
    Convert(P::LAT_LONG, { whole->GetWidth(), whole->GetHeight() }, whole->GetPixels(), 256);
  EXPECT_NEAR(GetTotalOfTexels(half) / GetTotalOfTexels(whole), 1.0, 1e-6);
  return half;
}
} // namespace

//------------------------------------------------------------------------------
TEST(Probes, MapsAreInverse)
{
  for (const int projection : Projections)
  {
    SCOPED_TRACE(P::GetProjectionName(projection));
    std::mt19937 engine(11);
    double worst = 0.0;
    for (int k = 0; k < 20000; ++k)
    {
      const Direction d = DrawDirection(engine);
      double u;
      double v;
      ASSERT_TRUE(P::GetCoordinates(projection, d.data(), u, v));
      Direction back;
      ASSERT_TRUE(P::GetDirection(projection, u, v, back.data()));
      EXPECT_NEAR(vtkMath::Norm(back.data()), 1.0, 1e-14);
      worst = std::max(worst, Distance(d, back));
      // The length of a direction does not matter.
      const double scale = k % 2 ? 1e-300 : 1e300;
      const Direction scaled = { scale * d[0], scale * d[1], scale * d[2] };
      double us;
      double vs;
      ASSERT_TRUE(P::GetCoordinates(projection, scaled.data(), us, vs));
      ASSERT_NEAR(us, u, 1e-12);
      ASSERT_NEAR(vs, v, 1e-12);
    }
    EXPECT_LT(worst, 1e-12);
  }
}

//------------------------------------------------------------------------------
TEST(Probes, NothingOutside)
{
  double d[3];
  EXPECT_FALSE(P::GetDirection(P::ANGULAR_MAP, 0.05, 0.05, d));
  EXPECT_FALSE(P::GetDirection(P::MIRROR_BALL, 0.99, 0.99, d));
  EXPECT_FALSE(P::GetDirection(P::CUBE_HORIZONTAL_CROSS, 0.1, 0.9, d));
  EXPECT_FALSE(P::GetDirection(P::CUBE_VERTICAL_CROSS, 0.1, 0.4, d));
  EXPECT_FALSE(P::GetDirection(P::LAT_LONG, 1.1, 0.5, d));
  EXPECT_FALSE(P::GetDirection(P::LAT_LONG, std::nan(""), 0.5, d));
  EXPECT_FALSE(P::GetDirection(99, 0.5, 0.5, d));
  EXPECT_EQ(d[0], 0.0);
  EXPECT_EQ(P::GetJacobian(P::ANGULAR_MAP, 0.05, 0.05), 0.0);
  const double inf = std::numeric_limits<double>::infinity();
  double u;
  double v;
  for (const Direction& bad :
    { Direction{ 0, 0, 0 }, Direction{ inf, 0, 0 }, Direction{ 0, -inf, 1 },
      Direction{ 0, std::nan(""), 1 }, Direction{ std::nan(""), 0, 0 } })
  {
    EXPECT_FALSE(P::GetCoordinates(P::ANGULAR_MAP, bad.data(), u, v));
    EXPECT_EQ(u, 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(Probes, JacobianIsTheDerivative)
{
  std::mt19937 engine(5);
  for (const int projection : Projections)
  {
    SCOPED_TRACE(P::GetProjectionName(projection));
    int tried = 0;
    while (tried < 2000)
    {
      const double u = Uniform(engine);
      const double v = Uniform(engine);
      const double h = 1e-5;
      Direction d[5];
      const bool inside = P::GetDirection(projection, u, v, d[0].data()) &&
                          P::GetDirection(projection, u + h, v, d[1].data()) &&
                          P::GetDirection(projection, u - h, v, d[2].data()) &&
                          P::GetDirection(projection, u, v + h, d[3].data()) &&
                          P::GetDirection(projection, u, v - h, d[4].data());
      const double r = std::hypot(2.0 * u - 1.0, 2.0 * v - 1.0);
      const bool rim = projection == P::MIRROR_BALL && r > 0.99; // derivatives grow without bound
      if (!inside || rim || Distance(d[1], d[2]) > 0.01 || Distance(d[3], d[4]) > 0.01)
      {
        continue;
      }
      ++tried;
      Direction du;
      Direction dv;
      for (int c = 0; c < 3; ++c)
      {
        du[c] = (d[1][c] - d[2][c]) / (2.0 * h);
        dv[c] = (d[3][c] - d[4][c]) / (2.0 * h);
      }
      Direction cross;
      vtkMath::Cross(du.data(), dv.data(), cross.data());
      const double jacobian = P::GetJacobian(projection, u, v);
      ASSERT_NEAR(vtkMath::Norm(cross.data()), jacobian, 1e-4 * jacobian + 1e-5);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Probes, SolidAnglesAddUpToTheSphere)
{
  for (const int projection : Projections)
  {
    for (const int rows : { 1, 2, 3, 5, 32, 101 })
    {
      const Size size = GetSize(projection, rows);
      const std::vector<float> ones(3 * std::size_t(size.Width) * size.Height, 1.0f);
      EXPECT_NEAR(GetProbeTotal(projection, size, ones) / 3.0, 4.0 * Pi, 1e-11)
        << P::GetProjectionName(projection) << " " << size.Width << " x " << size.Height;
    }
    // Texels against the midpoint rule over 64 x 64 points of each.
    const Size size = GetSize(projection, 6);
    for (int y = 0; y < size.Height; ++y)
    {
      for (int x = 0; x < size.Width; ++x)
      {
        double sum = 0.0;
        for (int k = 0; k < 64 * 64; ++k)
        {
          sum += P::GetJacobian(projection, (x + (k % 64 + 0.5) / 64.0) / size.Width,
            (y + (k / 64 + 0.5) / 64.0) / size.Height);
        }
        sum /= 64.0 * 64.0 * size.Width * size.Height;
        const bool rim = projection == P::ANGULAR_MAP || projection == P::MIRROR_BALL;
        ASSERT_NEAR(
          P::GetTexelSolidAngle(projection, size.Width, size.Height, x, y), sum, rim ? 2e-3 : 1e-4)
          << P::GetProjectionName(projection) << " " << x << ", " << y;
      }
    }
  }
  EXPECT_EQ(P::GetTexelSolidAngle(P::ANGULAR_MAP, 4, 4, 4, 0), 0.0);
  EXPECT_EQ(P::GetTexelSolidAngle(P::CUBE_HORIZONTAL_CROSS, 8, 6, 0, 0), 0.0);
}

//------------------------------------------------------------------------------
// The conventions, written out: where the axes are in each image.
TEST(Probes, Orientation)
{
  struct
  {
    int Projection;
    double U, V;
    Direction D;
  } const cases[] = {
    // Debevec's angular map: forward in the middle, sideways at half the radius.
    { P::ANGULAR_MAP, 0.5, 0.5, { 0, 0, -1 } },
    { P::ANGULAR_MAP, 0.75, 0.5, { 1, 0, 0 } },
    { P::ANGULAR_MAP, 0.25, 0.5, { -1, 0, 0 } },
    { P::ANGULAR_MAP, 0.5, 0.75, { 0, 1, 0 } },
    { P::ANGULAR_MAP, 0.5, 0.25, { 0, -1, 0 } },
    { P::ANGULAR_MAP, 1.0, 0.5, { 0, 0, 1 } },
    // The ball's middle shows the camera; 45 degrees on the ball mirror to 90.
    { P::MIRROR_BALL, 0.5, 0.5, { 0, 0, 1 } },
    { P::MIRROR_BALL, 0.5 + 0.25 * std::sqrt(2.0), 0.5, { 1, 0, 0 } },
    { P::MIRROR_BALL, 0.5, 0.5 + 0.25 * std::sqrt(2.0), { 0, 1, 0 } },
    { P::MIRROR_BALL, 0.5, 0.5 - 0.25 * std::sqrt(2.0), { 0, -1, 0 } },
    { P::MIRROR_BALL, 1.0, 0.5, { 0, 0, -1 } },
    { P::CUBE_HORIZONTAL_CROSS, 0.375, 0.5, { 0, 0, -1 } },
    { P::CUBE_HORIZONTAL_CROSS, 0.625, 0.5, { 1, 0, 0 } },
    { P::CUBE_HORIZONTAL_CROSS, 0.125, 0.5, { -1, 0, 0 } },
    { P::CUBE_HORIZONTAL_CROSS, 0.875, 0.5, { 0, 0, 1 } },
    { P::CUBE_HORIZONTAL_CROSS, 0.375, 5.0 / 6.0, { 0, 1, 0 } },
    { P::CUBE_HORIZONTAL_CROSS, 0.375, 1.0 / 6.0, { 0, -1, 0 } },
    { P::CUBE_VERTICAL_CROSS, 0.5, 0.625, { 0, 0, -1 } },
    { P::CUBE_VERTICAL_CROSS, 5.0 / 6.0, 0.625, { 1, 0, 0 } },
    { P::CUBE_VERTICAL_CROSS, 1.0 / 6.0, 0.625, { -1, 0, 0 } },
    { P::CUBE_VERTICAL_CROSS, 0.5, 0.875, { 0, 1, 0 } },
    { P::CUBE_VERTICAL_CROSS, 0.5, 0.375, { 0, -1, 0 } },
    { P::CUBE_VERTICAL_CROSS, 0.5, 0.125, { 0, 0, 1 } },
    { P::CUBE_HORIZONTAL_STRIP, 0.5 / 6.0, 0.5, { 1, 0, 0 } },
    { P::CUBE_HORIZONTAL_STRIP, 1.5 / 6.0, 0.5, { -1, 0, 0 } },
    { P::CUBE_HORIZONTAL_STRIP, 2.5 / 6.0, 0.5, { 0, 1, 0 } },
    { P::CUBE_HORIZONTAL_STRIP, 3.5 / 6.0, 0.5, { 0, -1, 0 } },
    { P::CUBE_HORIZONTAL_STRIP, 4.5 / 6.0, 0.5, { 0, 0, -1 } },
    { P::CUBE_HORIZONTAL_STRIP, 5.5 / 6.0, 0.5, { 0, 0, 1 } },
    { P::CUBE_VERTICAL_STRIP, 0.5, 5.5 / 6.0, { 1, 0, 0 } },
    { P::CUBE_VERTICAL_STRIP, 0.5, 0.5 / 6.0, { 0, 0, 1 } },
    { P::LAT_LONG, 0.25, 0.5, { 0, 0, -1 } },
  };
  for (const auto& c : cases)
  {
    Direction d;
    ASSERT_TRUE(P::GetDirection(c.Projection, c.U, c.V, d.data()));
    // The mirror ball's rim magnifies the last digit.
    EXPECT_LT(Distance(d, c.D), 1e-7)
      << P::GetProjectionName(c.Projection) << " " << c.U << ", " << c.V;
  }
  // No image is mirrored: about forward, right in the image is +x, up is +y. Crosses are continuous
  // across the edges that their faces share.
  for (const int projection : { P::CUBE_HORIZONTAL_CROSS, P::CUBE_VERTICAL_CROSS })
  {
    const double columns = projection == P::CUBE_HORIZONTAL_CROSS ? 4.0 : 3.0;
    const double rows = 7.0 - columns;
    std::vector<std::array<double, 2>> edges = { { 1.0, 1.5 }, { 2.0, 1.5 }, { 1.5, 1.0 },
      { 1.5, 2.0 } };
    edges.push_back(
      columns == 4.0 ? std::array<double, 2>{ 3.0, 1.7 } : std::array<double, 2>{ 1.7, 3.0 });
    for (const auto& edge : edges)
    {
      const bool upright = edge[0] == std::floor(edge[0]);
      const double e = 1e-6;
      Direction a;
      Direction b;
      ASSERT_TRUE(P::GetDirection(projection, (edge[0] - (upright ? e : 0.0)) / columns,
        1.0 - (edge[1] - (upright ? 0.0 : e)) / rows, a.data()));
      ASSERT_TRUE(P::GetDirection(projection, (edge[0] + (upright ? e : 0.0)) / columns,
        1.0 - (edge[1] + (upright ? 0.0 : e)) / rows, b.data()));
      EXPECT_LT(Distance(a, b), 1e-5) << edge[0] << ", " << edge[1];
    }
  }
}

//------------------------------------------------------------------------------
// OpenGL's table of cube faces (s to the right, t down; 3.2 core, table 3.19), with z turned round.
TEST(Probes, CubeFacesAreOpenGLs)
{
  std::mt19937 engine(8);
  for (int face = 0; face < 6; ++face)
  {
    for (int k = 0; k < 100; ++k)
    {
      const double s = Uniform(engine);
      const double t = Uniform(engine);
      Direction d;
      ASSERT_TRUE(P::GetDirection(P::CUBE_HORIZONTAL_STRIP, (face + s) / 6.0, 1.0 - t, d.data()));
      const Direction r = { d[0], d[1], -d[2] };
      const double sc[6] = { -r[2], r[2], r[0], r[0], r[0], -r[0] };
      const double tc[6] = { -r[1], -r[1], r[2], -r[2], -r[1], -r[1] };
      const double ma = (face % 2 ? -1.0 : 1.0) * r[face / 2];
      EXPECT_GE(ma, std::max({ std::abs(r[0]), std::abs(r[1]), std::abs(r[2]) }));
      EXPECT_NEAR(0.5 * (sc[face] / ma + 1.0), s, 1e-12);
      EXPECT_NEAR(0.5 * (tc[face] / ma + 1.0), t, 1e-12);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Probes, ConstantStaysConstant)
{
  for (const int projection : Projections)
  {
    SCOPED_TRACE(P::GetProjectionName(projection));
    for (const int rows : { 1, 2, 7, 40 })
    {
      for (const int target : { 1, 3, 16, 61 })
      {
        const Size size = GetSize(projection, rows);
        // Garbage outside the disc or beside the cross must not matter.
        std::vector<float> rgb;
        for (int k = 0; k < size.Width * size.Height; ++k)
        {
          double ignored[3];
          const bool shown = P::GetDirection(projection, (k % size.Width + 0.5) / size.Width,
            (k / size.Width + 0.5) / size.Height, ignored);
          const float bad = k % 2 ? -7.0f : std::numeric_limits<float>::quiet_NaN();
          rgb.insert(rgb.end(), 3, shown ? 3.0f : bad);
        }
        const auto environment = Convert(projection, size, rgb, target);
        EXPECT_EQ(environment->GetHeight(), target);
        for (const float value : environment->GetPixels())
        {
          ASSERT_NEAR(value, 3.0f, 1e-6f) << rows << " to " << target;
        }
        vtkNew<vtkEnvironment> constant;
        constant->SetPixels(
          2 * target, target, std::vector<float>(3 * 2 * std::size_t(target) * target, 3.0f));
        const std::vector<float> probe = Project(constant, projection, size);
        for (int k = 0; k < size.Width * size.Height; ++k)
        {
          const int x = k % size.Width;
          const int y = k / size.Width;
          const double omega = P::GetTexelSolidAngle(projection, size.Width, size.Height, x, y);
          if (probe[3 * std::size_t(k)] == 0.0f)
          {
            // At most slivers at rims stay black.
            ASSERT_LT(omega, 0.01 * 4.0 * Pi / (size.Width * size.Height)) << x << ", " << y;
            continue;
          }
          ASSERT_NEAR(probe[3 * std::size_t(k)], 3.0f, 1e-6f) << x << ", " << y;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Random texels over five decades, and a single one: shrunk, kept and magnified. Coarse, so that
// errors show; away from the one direction that is smeared over a disc's rim.
TEST(Probes, EnergyIsKept)
{
  for (const int projection : Projections)
  {
    double worst = 0.0;
    double worstSingle = 0.0;
    for (const double scale : { 0.21, 1.0, 3.3 })
    {
      const int rows = 24;
      const Size size = GetSize(projection, static_cast<int>(rows * scale));
      std::mt19937 engine(17);
      for (int run = 0; run < 8; ++run)
      {
        std::vector<float> rgb(3 * 2 * rows * rows, run == 0 ? 0.0f : 1e-3f);
        for (float& value : rgb)
        {
          value = run == 0 ? static_cast<float>(std::exp(12.0 * Uniform(engine) - 8.0)) : value;
        }
        std::size_t bright = engine() % (2 * rows * rows);
        for (std::size_t k = 0; k < rgb.size() / 3; ++k)
        {
          Direction d;
          vtkEnvironment::GetDirection(
            (k % (2 * rows) + 0.5) / (2 * rows), (k / (2 * rows) + 0.5) / rows, d.data());
          const bool smeared = (projection == P::ANGULAR_MAP && d[2] > 0.9) ||
                               (projection == P::MIRROR_BALL && d[2] < -0.9);
          if (smeared)
          {
            std::fill_n(&rgb[3 * k], 3, 0.0f);
            bright += bright == k;
          }
        }
        if (run > 0)
        {
          rgb[3 * bright] = 222208.0f;
        }
        vtkNew<vtkEnvironment> environment;
        ASSERT_TRUE(environment->SetPixels(2 * rows, rows, rgb));
        const std::vector<float> probe = Project(environment, projection, size);
        const double expected = GetTotalOfTexels(environment);
        const double out = std::abs(GetProbeTotal(projection, size, probe) / expected - 1.0);
        (run == 0 ? worst : worstSingle) = std::max(run == 0 ? worst : worstSingle, out);
      }
      for (int run = 0; run < 8; ++run)
      {
        std::vector<float> rgb(3 * std::size_t(size.Width) * size.Height, 1e-3f);
        for (std::size_t k = 0; run == 0 && k < rgb.size(); ++k)
        {
          rgb[k] = static_cast<float>(std::exp(12.0 * Uniform(engine) - 8.0));
        }
        // Away from rims: texels there are taken or left by their centers, and stand for those
        // left.
        const std::size_t texels = rgb.size() / 3;
        double omega = 0.0;
        for (std::size_t k = 0; k < texels; ++k)
        {
          const int x = static_cast<int>(k % size.Width);
          const int y = static_cast<int>(k / size.Width);
          const double r =
            std::hypot(2.0 * (x + 0.5) / size.Width - 1.0, 2.0 * (y + 0.5) / size.Height - 1.0);
          const bool disc = projection == P::ANGULAR_MAP || projection == P::MIRROR_BALL;
          const bool whole =
            P::GetTexelSolidAngle(projection, size.Width, size.Height, x, y) > 0.0 &&
            !(disc && r > 1.0 - 5.0 / size.Width);
          if (!whole)
          {
            std::fill_n(&rgb[3 * k], 3, 0.0f);
          }
          else if (run > 0 && omega == 0.0 && engine() % (texels - k) < 3)
          {
            rgb[3 * k] = 222208.0f;
            omega = 1.0;
          }
        }
        const auto environment = Convert(projection, size, rgb, rows);
        const double expected = GetProbeTotal(projection, size, rgb);
        const double in = std::abs(GetTotalOfTexels(environment) / expected - 1.0);
        (run == 0 ? worst : worstSingle) = std::max(run == 0 ? worst : worstSingle, in);
      }
    }
    std::cout << P::GetProjectionName(projection) << ": energy is kept to " << worst
              << " (random texels), " << worstSingle << " (one texel)\n";
    EXPECT_LT(worst, 1e-3) << P::GetProjectionName(projection);
    EXPECT_LT(worstSingle, 2e-2) << P::GetProjectionName(projection);
  }
}

//------------------------------------------------------------------------------
// One texel of a lat-long image lands where the map says, and comes back from there.
TEST(Probes, DirectionsLandInTheirTexel)
{
  const int rows = 30;
  for (const int projection : Projections)
  {
    SCOPED_TRACE(P::GetProjectionName(projection));
    const Size size = GetSize(projection, rows);
    std::mt19937 engine(2);
    for (int run = 0; run < 12; ++run)
    {
      const Direction d = DrawDirection(engine);
      double u;
      double v;
      P::GetCoordinates(projection, d.data(), u, v);
      const int x = static_cast<int>(u * size.Width);
      const int y = static_cast<int>(v * size.Height);
      Direction center;
      if (!P::GetDirection(
            projection, (x + 0.5) / size.Width, (y + 0.5) / size.Height, center.data()))
      {
        continue;
      }
      std::vector<float> rgb(3 * std::size_t(size.Width) * size.Height, 0.0f);
      rgb[3 * (std::size_t(y) * size.Width + x) + 1] = 1.0f;
      const auto environment = Convert(projection, size, rgb, 4 * rows);
      double value[3];
      environment->GetRadiance(center.data(), value);
      // Not all: stretched texels next to a disc's rim share the target's texel with others.
      EXPECT_GT(value[1], 0.3);
      EXPECT_EQ(value[0], 0.0);
      const Direction opposite = { -center[0], -center[1], -center[2] };
      environment->GetRadiance(opposite.data(), value);
      EXPECT_EQ(value[1], 0.0);
      // And from a fine lat-long map into the probe.
      const std::vector<float> probe = Project(environment, projection, size);
      EXPECT_GT(probe[3 * (std::size_t(y) * size.Width + x) + 1], 0.3);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Probes, RoundTripOfASmoothMap)
{
  const int rows = 128;
  const auto original = MakeSmooth(rows);
  for (const int projection : Projections)
  {
    const std::string name = P::GetProjectionName(projection);
    const Size size = GetSize(projection, rows);
    const std::vector<float> probe = Project(original, projection, size);
    // Against the function itself.
    double worst = 0.0;
    for (int y = 0; y < size.Height; ++y)
    {
      for (int x = 0; x < size.Width; ++x)
      {
        Direction d;
        if (P::GetDirection(projection, (x + 0.5) / size.Width, (y + 0.5) / size.Height, d.data()))
        {
          for (int c = 0; c < 3; ++c)
          {
            const double expected = GetSmooth(d, c);
            const double got = probe[3 * (std::size_t(y) * size.Width + x) + c];
            worst = std::max(worst, std::abs(got - expected) / expected);
          }
        }
      }
    }
    const auto back = Convert(projection, size, probe, rows);
    const double error = GetRelativeL1(back, original);
    const double energy = std::abs(GetTotalOfTexels(back) / GetTotalOfTexels(original) - 1.0);
    std::cout << name << " " << size.Width << " x " << size.Height << ": largest error of a texel "
              << worst << "; back: relative L1 " << error << ", energy " << energy << "\n";
    EXPECT_LT(worst, 0.1) << name;
    EXPECT_LT(error, 5e-3) << name;
    EXPECT_LT(energy, 1e-4) << name;
  }
}

//------------------------------------------------------------------------------
TEST(Probes, RoundTripOfAPhotograph)
{
  const auto studio = ReadStudio();
  if (!studio)
  {
    GTEST_SKIP() << "skipped: no real data at " << MEASUREDBRDF_SHARED_DATA;
  }
  // At the photograph's own resolution and at twice that (a texel of the probe is then a quarter).
  for (const int projection : Projections)
  {
    const std::string name = P::GetProjectionName(projection);
    for (const int rows : { 256, 512 })
    {
      const bool duplicate = projection == P::CUBE_HORIZONTAL_STRIP ||
                             projection == P::CUBE_VERTICAL_STRIP ||
                             projection == P::CUBE_VERTICAL_CROSS;
      if ((duplicate || projection == P::LAT_LONG) && rows > 256)
      {
        continue;
      }
      const Size size = GetSize(projection, rows);
      const std::vector<float> probe = Project(studio, projection, size);
      const auto back = Convert(projection, size, probe, 256);
      const double error = GetRelativeL1(back, studio);
      const double energy = std::abs(GetTotalOfTexels(back) / GetTotalOfTexels(studio) - 1.0);
      std::cout << name << " " << size.Width << " x " << size.Height << ": relative L1 " << error
                << ", energy " << energy << "\n";
      RecordProperty(name + " " + std::to_string(rows) + " L1", std::to_string(error));
      RecordProperty(name + " " + std::to_string(rows) + " energy", std::to_string(energy));
      EXPECT_LT(error, rows == 256 ? 0.2 : 0.1) << name;
      EXPECT_LT(energy, 5e-4) << name;
    }
  }
}

//------------------------------------------------------------------------------
// Lights from the converted probe light a ball as those from the original do.
TEST(Probes, LightsFromProbes)
{
  vtkSmartPointer<vtkEnvironment> original = ReadStudio();
  if (!original)
  {
    original = MakeSmooth(128);
  }
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkBlinnPhongBRDF> phong;
  phong->SetExponent(20.0);
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> views;
  normals->SetNumberOfComponents(3);
  views->SetNumberOfComponents(3);
  std::mt19937 engine(4);
  for (int k = 0; k < 200; ++k)
  {
    Direction n = DrawDirection(engine);
    n[2] = std::abs(n[2]);
    normals->InsertNextTuple(n.data());
    views->InsertNextTuple3(0.0, 0.0, 1.0);
  }
  const auto light = [&](vtkEnvironment* environment, vtkBRDF* brdf)
  {
    vtkNew<vtkMedianCutLightSetGenerator> generator;
    vtkNew<vtkLightSet> lights;
    EXPECT_TRUE(generator->Generate(environment, 1024, lights));
    vtkNew<vtkLightSetRadianceIntegrator> integrator;
    integrator->SetBRDF(brdf);
    integrator->SetEnvironment(environment);
    integrator->SetLightSet(lights);
    auto radiance = vtkSmartPointer<vtkDoubleArray>::New();
    EXPECT_TRUE(integrator->Integrate(normals, views, radiance));
    return radiance;
  };
  for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(lambert), static_cast<vtkBRDF*>(phong) })
  {
    const auto expected = light(original, brdf);
    for (const int projection : { P::ANGULAR_MAP, P::MIRROR_BALL, P::CUBE_HORIZONTAL_CROSS })
    {
      const Size size = GetSize(projection, original->GetHeight());
      const auto converted = Convert(projection, size, Project(original, projection, size));
      const auto found = light(converted, brdf);
      double error = 0.0;
      double total = 0.0;
      for (vtkIdType k = 0; k < expected->GetNumberOfTuples(); ++k)
      {
        for (int c = 0; c < 3; ++c)
        {
          error += std::abs(found->GetComponent(k, c) - expected->GetComponent(k, c));
          total += expected->GetComponent(k, c);
        }
      }
      std::cout << brdf->GetClassName() << " under " << P::GetProjectionName(projection)
                << ": relative L1 " << error / total << "\n";
      EXPECT_LT(error / total, brdf == lambert ? 0.002 : 0.02);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Probes, RepairsAndCounts)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  vtkNew<P> converter;
  converter->SetProjection(P::MIRROR_BALL);
  vtkNew<vtkEnvironment> environment;
  std::vector<float> rgb(3 * 16 * 16, 1.0f);
  rgb[0] = nan; // a corner: outside
  rgb[3 * (8 * 16 + 8)] = nan;
  rgb[3 * (8 * 16 + 9) + 1] = -inf;
  rgb[3 * (8 * 16 + 11)] = inf;
  rgb[3 * (8 * 16 + 10) + 2] = -2.0f;
  ASSERT_TRUE(converter->Convert(16, 16, rgb, environment));
  EXPECT_EQ(converter->GetNumberOfNonFiniteValues(), 3);
  EXPECT_EQ(converter->GetNumberOfNegativeValues(), 1);
  EXPECT_EQ(environment->GetNumberOfNonFiniteValues(), 0);
  const auto& pixels = environment->GetPixels();
  EXPECT_GE(*std::min_element(pixels.begin(), pixels.end()), 0.0f);
  const float most = *std::max_element(pixels.begin(), pixels.end());
  EXPECT_GT(most, 1000.0f);
  EXPECT_LE(most, 65504.1f);
  // Lat-long images go through untouched but for those.
  converter->SetProjection(P::LAT_LONG);
  ASSERT_TRUE(converter->Convert(2, 1, { 1.0f, -1.0f, nan, 4.0f, 5.0f, 6.0f }, environment));
  EXPECT_EQ(environment->GetPixels(), (std::vector<float>{ 1.0f, 0.0f, 0.0f, 4.0f, 5.0f, 6.0f }));
  EXPECT_EQ(converter->GetNumberOfNegativeValues(), 1);
}

//------------------------------------------------------------------------------
TEST(Probes, SixFaces)
{
  // Each face its number, row 0 (the bottom) twice that.
  const int size = 8;
  std::vector<std::vector<float>> faces;
  for (int face = 0; face < 6; ++face)
  {
    faces.emplace_back(3 * size * size, face + 1.0f);
    std::fill_n(faces.back().begin(), 3 * size, 10.0f * (face + 1.0f));
  }
  vtkNew<P> converter;
  converter->SetHeight(256);
  converter->SetProjection(P::MIRROR_BALL);
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(converter->ConvertFaces(size, faces, environment));
  EXPECT_EQ(converter->GetProjection(), P::MIRROR_BALL);
  const Direction axes[6] = { { 1, 0.1, 0.1 }, { -1, 0.1, 0.1 }, { 0.1, 1, 0.1 }, { 0.1, -1, 0.1 },
    { 0.1, 0.1, -1 }, { 0.1, 0.1, 1 } };
  // The bottom edges: down of sides; towards forward of +y; towards backward of -y.
  const Direction bottoms[6] = { { 1, -0.95, 0.1 }, { -1, -0.95, 0.1 }, { 0.1, 1, -0.95 },
    { 0.1, -1, 0.95 }, { 0.1, -0.95, -1 }, { 0.1, -0.95, 1 } };
  for (int face = 0; face < 6; ++face)
  {
    double value[3];
    environment->GetRadiance(axes[face].data(), value);
    EXPECT_NEAR(value[0], face + 1.0, 1e-5) << face;
    environment->GetRadiance(bottoms[face].data(), value);
    EXPECT_NEAR(value[0], 10.0 * (face + 1.0), 1e-4) << face;
  }
}

//------------------------------------------------------------------------------
TEST(Probes, DefaultHeightKeepsTheResolution)
{
  for (const int projection : Projections)
  {
    const Size size = GetSize(projection, 100);
    EXPECT_NEAR(P::GetLatLongHeight(projection, size.Width, size.Height), 100, 1);
  }
  EXPECT_EQ(P::GetLatLongHeight(P::MIRROR_BALL, 1, 1), 1);
}

//------------------------------------------------------------------------------
TEST(Probes, Refuses)
{
  vtkNew<P> converter;
  vtkNew<vtkEnvironment> environment;
  ErrorCatcher errors(converter);
  ASSERT_TRUE(environment->SetPixels(2, 1, std::vector<float>(6, 5.0f)));
  const auto refused =
    [&](int projection, int width, int height, std::size_t count, const std::string& word)
  {
    converter->SetProjection(projection);
    EXPECT_FALSE(converter->Convert(width, height, std::vector<float>(count, 1.0f), environment));
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_NE(errors.GetText().find(word), std::string::npos) << errors.GetText();
    EXPECT_EQ(environment->GetPixels(), std::vector<float>(6, 5.0f));
  };
  refused(P::ANGULAR_MAP, 4, 3, 36, "angular map");
  refused(P::MIRROR_BALL, 4, 5, 60, "4 x 5");
  refused(P::CUBE_HORIZONTAL_CROSS, 3, 4, 36, "4 square faces");
  refused(P::CUBE_HORIZONTAL_CROSS, 8, 3, 72, "horizontal cross");
  refused(P::CUBE_VERTICAL_CROSS, 4, 3, 36, "vertical cross");
  refused(P::CUBE_HORIZONTAL_STRIP, 6, 2, 36, "horizontal strip");
  refused(P::CUBE_VERTICAL_STRIP, 6, 1, 18, "vertical strip");
  refused(P::LAT_LONG, 0, 1, 0, "0 x 1");
  refused(P::LAT_LONG, -2, -1, 6, "-2 x -1");
  refused(P::ANGULAR_MAP, 4, 4, 47, "47 values");
  refused(P::ANGULAR_MAP, 1 << 20, 1 << 20, 3, "at most");
  converter->SetHeight(8);
  for (const int height : { -1, 11586, 20000 })
  {
    converter->SetHeight(height);
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_NE(errors.GetText().find("found " + std::to_string(height)), std::string::npos);
    EXPECT_EQ(converter->GetHeight(), 8);
  }
  converter->SetHeight(0);

  converter->SetProjection(-1);
  converter->SetProjection(P::NUMBER_OF_PROJECTIONS);
  EXPECT_EQ(errors.Take(), 2);
  EXPECT_EQ(converter->GetProjection(), P::ANGULAR_MAP);
  EXPECT_FALSE(converter->Convert(1, 1, { 1.0f, 1.0f, 1.0f }, nullptr));
  std::vector<std::vector<float>> faces(6, std::vector<float>(12, 1.0f));
  EXPECT_FALSE(converter->ConvertFaces(3, faces, environment));
  faces[2].pop_back();
  EXPECT_FALSE(converter->ConvertFaces(2, faces, environment));
  faces.pop_back();
  EXPECT_FALSE(converter->ConvertFaces(2, faces, environment));
  EXPECT_EQ(errors.Take(), 4);

  EXPECT_EQ(converter->NewProbe(nullptr, 4, 4), nullptr);
  vtkNew<vtkEnvironment> empty;
  EXPECT_EQ(converter->NewProbe(empty, 4, 4), nullptr);
  EXPECT_EQ(converter->NewProbe(environment, 4, 5), nullptr);
  EXPECT_EQ(converter->NewProbe(environment, 1 << 15, 1 << 15), nullptr);
  EXPECT_EQ(errors.Take(), 4);
  EXPECT_EQ(P::GetProjectionName(99), "");
  EXPECT_EQ(P::GetExpectedSize(-1), "");
}

//------------------------------------------------------------------------------
TEST(Probes, TellsProgressAndStops)
{
  vtkNew<P> converter;
  converter->SetProjection(P::ANGULAR_MAP);
  converter->SetHeight(400);
  struct RunWithProgress
  {
    vtkEnvironmentProjection* Converter;
    std::vector<double> Progress;
    bool Stop;
  } watch = { converter, {}, false };
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&watch);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* data, void* progress)
    {
      auto* w = static_cast<RunWithProgress*>(data);
      w->Progress.push_back(*static_cast<double*>(progress));
      w->Converter->SetAbort(w->Stop);
    });
  converter->AddObserver(vtkCommand::ProgressEvent, command);
  vtkNew<vtkEnvironment> environment;
  const std::vector<float> rgb(3 * 64 * 64, 1.0f);
  ASSERT_TRUE(converter->Convert(64, 64, rgb, environment));
  EXPECT_GT(watch.Progress.size(), 2u);
  EXPECT_TRUE(std::is_sorted(watch.Progress.begin(), watch.Progress.end()));
  EXPECT_EQ(watch.Progress.back(), 1.0);

  watch.Progress.clear();
  watch.Stop = true;
  ErrorCatcher errors(converter);
  const vtkMTimeType before = environment->GetPixelsMTime();
  EXPECT_FALSE(converter->Convert(64, 64, rgb, environment));
  EXPECT_EQ(watch.Progress.size(), 1u);
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_EQ(environment->GetPixelsMTime(), before);
  EXPECT_EQ(converter->NewProbe(environment, 600, 600), nullptr);
  EXPECT_EQ(errors.Take(), 1);
}
