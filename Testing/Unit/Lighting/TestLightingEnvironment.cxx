// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "vtkDataArray.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

using measuredbrdf::Pi;

//------------------------------------------------------------------------------
TEST(Environment, SolidAnglesAddUpToTheSphere)
{
  const int sizes[][2] = { { 1, 1 }, { 2, 1 }, { 1, 2 }, { 7, 5 }, { 64, 33 }, { 1024, 512 } };
  for (const auto& size : sizes)
  {
    vtkNew<vtkEnvironment> environment;
    ASSERT_TRUE(environment->SetPixels(
      size[0], size[1], std::vector<float>(3 * std::size_t(size[0]) * size[1], 1.0f)));
    double sum = 0.0;
    for (int y = 0; y < size[1]; ++y)
    {
      sum += size[0] * environment->GetTexelSolidAngle(y);
      // The definition: dphi (cos theta0 - cos theta1).
      const double direct =
        2.0 * Pi / size[0] * (std::cos(Pi * y / size[1]) - std::cos(Pi * (y + 1) / size[1]));
      EXPECT_NEAR(environment->GetTexelSolidAngle(y), direct, 1e-14);
    }
    EXPECT_NEAR(sum, 4.0 * Pi, 1e-12) << size[0] << " x " << size[1];
    double total[3];
    environment->GetTotal(total);
    EXPECT_NEAR(total[1], 4.0 * Pi, 1e-12);
  }
  vtkNew<vtkEnvironment> empty;
  EXPECT_EQ(empty->GetTexelSolidAngle(0), 0.0);
}

//------------------------------------------------------------------------------
TEST(Environment, DirectionsFollowVTKsImageBasedLighting)
{
  const struct
  {
    glm::dvec3 Direction;
    double U, V;
  } cases[] = { { { 1, 0, 0 }, 0.5, 0.5 }, { { 0, 0, 1 }, 0.75, 0.5 }, { { 0, 0, -1 }, 0.25, 0.5 },
    { { 0, 1, 0 }, 0.5, 1.0 }, { { 0, -1, 0 }, 0.5, 0.0 },
    { { std::sqrt(0.5), std::sqrt(0.5), 0 }, 0.5, 0.75 } };
  for (const auto& c : cases)
  {
    double u, v;
    vtkEnvironment::GetCoordinates(&c.Direction.x, u, v);
    EXPECT_NEAR(u, c.U, 1e-15);
    EXPECT_NEAR(v, c.V, 1e-15);
    glm::dvec3 back;
    vtkEnvironment::GetDirection(c.U, c.V, &back.x);
    EXPECT_LT(glm::distance(back, c.Direction), 2e-15);
  }
}

//------------------------------------------------------------------------------
TEST(Environment, TexelDirectionsFindTheirTexel)
{
  const int width = 13;
  const int height = 9;
  std::vector<float> rgb;
  for (int k = 0; k < width * height; ++k)
  {
    rgb.insert(rgb.end(), { float(k), float(2 * k), float(3 * k) });
  }
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetPixels(width, height, rgb));
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      double d[3];
      environment->GetTexelDirection(x, y, d);
      EXPECT_NEAR(vtkMath::Norm(d), 1.0, 1e-15);
      double u;
      double v;
      vtkEnvironment::GetCoordinates(d, u, v);
      EXPECT_NEAR(u, (x + 0.5) / width, 1e-14);
      EXPECT_NEAR(v, (y + 0.5) / height, 1e-14);
      double value[3];
      environment->GetRadiance(d, value);
      EXPECT_NEAR(value[0], y * width + x, 1e-12);
      EXPECT_NEAR(value[2], 3 * (y * width + x), 1e-12);
    }
  }
  // Nonsense is black.
  double value[3];
  const double nonsense[3] = { std::nan(""), 0.0, 0.0 };
  environment->GetRadiance(nonsense, value);
  EXPECT_EQ(value[0], 0.0);
  environment->GetPixel(width, 0, value);
  EXPECT_EQ(value[0], 0.0);
}

//------------------------------------------------------------------------------
TEST(Environment, InterpolatesBetweenTexels)
{
  vtkNew<vtkEnvironment> environment;
  std::vector<float> rgb;
  for (int k = 0; k < 6; ++k) // 3 x 2
  {
    rgb.insert(rgb.end(), { float(k * k), 1.0f, 0.0f });
  }
  ASSERT_TRUE(environment->SetPixels(3, 2, rgb));
  const auto get = [&](double u, double v)
  {
    double d[3], value[3];
    vtkEnvironment::GetDirection(u, v, d);
    environment->GetRadiance(d, value);
    EXPECT_NEAR(value[1], 1.0, 1e-12);
    return value[0];
  };
  EXPECT_NEAR(get(1.0 / 3.0, 0.25), 0.5, 1e-12); // between 0 and 1
  EXPECT_NEAR(get(0.5, 0.5), 8.5, 1e-12);        // between 1 and 16
  EXPECT_NEAR(get(0.25, 0.5), 5.5, 1e-12);       // 3/4 of 0 and 9, 1/4 of 1 and 16
  EXPECT_NEAR(get(1.0, 0.75), 17.0, 1e-12);      // the seam: between 25 and 9
  EXPECT_NEAR(get(0.0, 0.75), 17.0, 1e-12);
  EXPECT_NEAR(get(0.5, 0.99), 16.0, 1e-12); // towards the poles
  EXPECT_NEAR(get(0.5, 0.01), 1.0, 1e-12);
  // A map of one texel is the same everywhere.
  ASSERT_TRUE(environment->SetPixels(1, 1, { 5.0f, 1.0f, 0.0f }));
  EXPECT_EQ(get(0.1, 0.9), 5.0);
}

//------------------------------------------------------------------------------
TEST(Environment, RepairsAndCounts)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  vtkNew<vtkEnvironment> environment;
  const vtkMTimeType before = environment->GetPixelsMTime();
  ASSERT_TRUE(environment->SetPixels(2, 1, { 1.0f, -2.0f, nan, inf, -inf, 3.0f }));
  EXPECT_GT(environment->GetPixelsMTime(), before);
  EXPECT_EQ(environment->GetNumberOfNegativeValues(), 1);
  EXPECT_EQ(environment->GetNumberOfNonFiniteValues(), 3);
  EXPECT_EQ(
    environment->GetPixels(), (std::vector<float>{ 1.0f, 0.0f, 0.0f, 65504.0f, 0.0f, 3.0f }));
  ASSERT_TRUE(environment->SetPixels(1, 1, { 7e5f, inf, 3.0f })); // as in files
  EXPECT_EQ(environment->GetPixels(), (std::vector<float>{ 7e5f, 7e5f, 3.0f }));
  EXPECT_EQ(environment->GetNumberOfNonFiniteValues(), 1);
  // Counts are about what was set last.
  ASSERT_TRUE(environment->SetPixels(1, 1, { 1.0f, 2.0f, 3.0f }));
  EXPECT_EQ(environment->GetNumberOfNegativeValues(), 0);
  EXPECT_EQ(environment->GetNumberOfNonFiniteValues(), 0);
}

//------------------------------------------------------------------------------
TEST(Environment, RefusesSizesThatDoNotMatch)
{
  vtkNew<vtkEnvironment> environment;
  ErrorCatcher errors(environment);
  ASSERT_TRUE(environment->SetPixels(1, 1, { 1.0f, 2.0f, 3.0f }));
  EXPECT_FALSE(environment->SetPixels(2, 2, std::vector<float>(9, 1.0f)));
  EXPECT_FALSE(environment->SetPixels(0, 0, {}));
  EXPECT_FALSE(environment->SetPixels(-1, -1, { 1.0f, 2.0f, 3.0f }));
  EXPECT_FALSE(environment->SetPixels(1 << 30, 1 << 30, { 1.0f, 2.0f, 3.0f }));
  EXPECT_EQ(errors.Take(), 4);
  EXPECT_FALSE(environment->SetImage(nullptr));
  vtkNew<vtkImageData> image;
  EXPECT_FALSE(environment->SetImage(image));
  image->SetDimensions(2, 2, 2);
  image->AllocateScalars(VTK_FLOAT, 3);
  EXPECT_FALSE(environment->SetImage(image));
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_FLOAT, 2);
  EXPECT_FALSE(environment->SetImage(image));
  EXPECT_EQ(errors.Take(), 4);
  EXPECT_EQ(environment->GetPixels(), (std::vector<float>{ 1.0f, 2.0f, 3.0f }));
}

//------------------------------------------------------------------------------
TEST(Environment, TakesImagesOfAnyType)
{
  // Value 0.5 of the type's range (floats: itself), as the middle one of 3 components.
  struct
  {
    int Type;
    double Stored, Expected, Tolerance;
  } const cases[] = { { VTK_UNSIGNED_CHAR, 51, 0.2, 1e-7 },
    { VTK_UNSIGNED_SHORT, 13107, 0.2, 1e-7 }, { VTK_SHORT, 32767, 1.0, 1e-7 },
    { VTK_UNSIGNED_INT, 4294967295.0, 1.0, 1e-7 }, { VTK_FLOAT, 222208.0, 222208.0, 0.0 },
    { VTK_DOUBLE, 1234.5, 1234.5, 0.0 } };
  for (const auto& c : cases)
  {
    for (int components : { 1, 3, 4 })
    {
      vtkNew<vtkImageData> image;
      image->SetDimensions(3, 2, 1);
      image->AllocateScalars(c.Type, components);
      image->GetPointData()->GetScalars()->Fill(0.0);
      image->SetScalarComponentFromDouble(2, 1, 0, components == 1 ? 0 : 1, c.Stored);
      vtkNew<vtkEnvironment> environment;
      ASSERT_TRUE(environment->SetImage(image));
      ASSERT_EQ(environment->GetWidth(), 3);
      ASSERT_EQ(environment->GetHeight(), 2);
      double rgb[3];
      environment->GetPixel(2, 1, rgb);
      EXPECT_NEAR(rgb[1], c.Expected, c.Tolerance) << "type " << c.Type;
      EXPECT_EQ(rgb[0], components == 1 ? rgb[1] : 0.0);
      environment->GetPixel(0, 0, rgb);
      EXPECT_EQ(rgb[1], 0.0);
    }
  }
  // Doubles beyond float's range are infinite, and so repaired.
  vtkNew<vtkImageData> image;
  image->SetDimensions(1, 1, 1);
  image->AllocateScalars(VTK_DOUBLE, 3);
  image->SetScalarComponentFromDouble(0, 0, 0, 0, 1e300);
  image->SetScalarComponentFromDouble(0, 0, 0, 1, -1.0);
  image->SetScalarComponentFromDouble(0, 0, 0, 2, 2.0);
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetImage(image));
  EXPECT_EQ(environment->GetNumberOfNonFiniteValues(), 1);
  EXPECT_EQ(environment->GetNumberOfNegativeValues(), 1);
  EXPECT_EQ(environment->GetPixels(), (std::vector<float>{ 65504.0f, 0.0f, 2.0f }));
}

namespace
{
// Counts the reads that cost a virtual call each.
class CountingArray : public vtkFloatArray
{
public:
  static CountingArray* New();
  vtkTypeMacro(CountingArray, vtkFloatArray);

  double GetComponent(vtkIdType tuple, int component) override
  {
    ++this->Reads;
    return this->Superclass::GetComponent(tuple, component);
  }
  std::atomic<vtkIdType> Reads{ 0 };
};
vtkStandardNewMacro(CountingArray);
}

//------------------------------------------------------------------------------
// A renderer waits for it: no virtual call a component; and no bad value is lost between threads.
TEST(Environment, ReadsWholeArrays)
{
  constexpr vtkIdType width = 600, height = 300;
  for (const int components : { 1, 3, 4 })
  {
    for (const bool sRGB : { false, true })
    {
      vtkNew<CountingArray> array;
      array->SetNumberOfComponents(components);
      array->SetNumberOfTuples(width * height);
      for (vtkIdType k = 0; k < width * height * components; ++k)
      {
        array->SetValue(k, k % 1000 == 7 ? -1.0f : k % 1000 == 8 ? NAN : 0.5f);
      }
      vtkNew<vtkImageData> image;
      image->SetDimensions(width, height, 1);
      image->GetPointData()->SetScalars(array);
      vtkNew<vtkEnvironment> environment;
      ASSERT_TRUE(environment->SetImage(image, sRGB));
      EXPECT_EQ(array->Reads, 0);
      // Gray counts thrice, alpha never.
      vtkIdType negative = 0;
      vtkIdType notFinite = 0;
      for (vtkIdType k = 0; k < width * height * components; ++k)
      {
        const int times = components == 1 ? 3 : (k % components < 3 ? 1 : 0);
        negative += k % 1000 == 7 ? times : 0;
        notFinite += k % 1000 == 8 ? times : 0;
      }
      EXPECT_EQ(environment->GetNumberOfNegativeValues(), negative);
      EXPECT_EQ(environment->GetNumberOfNonFiniteValues(), notFinite);
      EXPECT_NEAR(environment->GetPixels().back(), sRGB ? 0.214041f : 0.5f, 1e-6f);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Environment, DecodesSRGB)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  const double stored[4] = { 0, 10, 128, 255 };
  // 10/255/12.92; ((128/255 + .055)/1.055)^2.4.
  const double linear[4] = { 0.0, 0.003035269835488375, 0.21586050011389926, 1.0 };
  for (int k = 0; k < 4; ++k)
  {
    image->SetScalarComponentFromDouble(k, 0, 0, 0, stored[k]);
  }
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetImage(image, true));
  for (int k = 0; k < 4; ++k)
  {
    double rgb[3];
    environment->GetPixel(k, 0, rgb);
    EXPECT_NEAR(rgb[0], linear[k], 1e-7);
  }
}

//------------------------------------------------------------------------------
TEST(Environment, ImageDataRoundTrip)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  const auto image = vtkSmartPointer<vtkImageData>::Take(environment->NewImageData());
  vtkNew<vtkEnvironment> copy;
  ASSERT_TRUE(copy->SetImage(image));
  EXPECT_EQ(copy->GetWidth(), 256);
  EXPECT_EQ(copy->GetHeight(), 128);
  EXPECT_EQ(copy->GetPixels(), environment->GetPixels());

  vtkNew<vtkEnvironment> empty;
  const auto nothing = vtkSmartPointer<vtkImageData>::Take(empty->NewImageData());
  EXPECT_EQ(nothing->GetNumberOfPoints(), 0);
}

//------------------------------------------------------------------------------
TEST(Environment, ProceduralSkyIsASkyWithASun)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  const auto get = [&](double x, double y, double z)
  {
    const double direction[3] = { x, y, z };
    std::array<double, 3> rgb;
    environment->GetRadiance(direction, rgb.data());
    return rgb;
  };
  const auto zenith = get(0.0, 1.0, 0.0), ground = get(0.0, -1.0, 0.0);
  EXPECT_GT(zenith[2], zenith[0]);
  EXPECT_GT(ground[0], ground[2]);
  EXPECT_GT(get(0.5, 0.65, 0.6)[0], 1000.0);
}

//------------------------------------------------------------------------------
TEST(Environment, Rotation)
{
  vtkNew<vtkEnvironment> environment;
  ErrorCatcher errors(environment);
  ASSERT_TRUE(environment->SetPixels(1, 1, { 1.0f, 1.0f, 1.0f }));
  const vtkMTimeType pixels = environment->GetPixelsMTime();
  const vtkMTimeType all = environment->GetMTime();

  // Turned by 90 degrees, counterclockwise from above: what was seen towards +x is now towards -z.
  environment->SetRotationY(90.0);
  double m[9];
  environment->GetWorldToEnvironment(m);
  const glm::dvec3 d = -glm::dvec3(m[2], m[5], m[8]); // of world's -z
  EXPECT_LT(glm::distance(d, glm::dvec3(1.0, 0.0, 0.0)), 1e-15);
  EXPECT_EQ(environment->GetPixelsMTime(), pixels);
  EXPECT_GT(environment->GetMTime(), all);

  const double scaled[9] = { 2, 0, 0, 0, 1, 0, 0, 0, 1 };
  const double mirror[9] = { 1, 0, 0, 0, 1, 0, 0, 0, -1 };
  const double nan[9] = { std::nan(""), 0, 0, 0, 1, 0, 0, 0, 1 };
  environment->SetWorldToEnvironment(scaled);
  environment->SetWorldToEnvironment(mirror);
  environment->SetWorldToEnvironment(nan);
  environment->SetRotationY(std::numeric_limits<double>::infinity());
  EXPECT_EQ(errors.Take(), 4);
  double kept[9];
  environment->GetWorldToEnvironment(kept);
  EXPECT_TRUE(std::equal(m, m + 9, kept));
}
