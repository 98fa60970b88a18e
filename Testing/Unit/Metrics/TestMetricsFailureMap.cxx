// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Where one BRDF fails to be another, on materials whose difference is known in closed form.

#include "ErrorCatcher.h"
#include "ExpectStops.h"
#include "TestBasisHelpers.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFFailureMap.h"
#include "vtkBRDFResampler.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <cmath>

#include <gtest/gtest.h>

namespace
{
constexpr double Degree = 3.14159265358979323846 / 180.0;

using testbasis::FunctionBRDF;

double GetPolar(const glm::dvec3& d) { return std::acos(d.z) / Degree; }

// Of i from o, in [0,360).
double GetAzimuth(const glm::dvec3& i, const glm::dvec3& o)
{
  const double phi = (std::atan2(i[1], i[0]) - std::atan2(o[1], o[0])) / Degree;
  return phi < -1e-9 ? phi + 360.0 : phi;
}

double At(vtkImageData* image, int x, int y)
{
  return image->GetScalarComponentAsDouble(x, y, 0, 0);
}
}

TEST(BRDFFailureMap, OfAnEvenFactorIsEven)
{
  vtkNew<vtkLambertBRDF> reference;
  vtkNew<vtkLambertBRDF> darker;
  reference->SetAlbedo(0.5, 0.25, 0.75);
  darker->SetAlbedo(0.4, 0.25, 0.75); // 0.1 of 1.5
  vtkNew<vtkBRDFFailureMap> map;
  map->SetReference(reference);
  map->SetBRDF(darker);
  map->SetNumberOfCells(18);
  ASSERT_TRUE(map->Update());
  EXPECT_NEAR(map->GetRelativeL1(), 1.0 / 15.0, 1e-12);
  int numberOfHalfCells = 0;
  for (int k = 0; k < 18 * 18; ++k)
  {
    EXPECT_NEAR(At(map->GetIncidentOutgoing(), k % 18, k / 18), 1.0 / 15.0, 1e-12);
    const double half = At(map->GetHalfDifference(), k % 18, k / 18);
    if (!std::isnan(half))
    {
      ++numberOfHalfCells;
      EXPECT_NEAR(half, 1.0 / 15.0, 1e-12);
    }
  }
  EXPECT_GT(numberOfHalfCells, 18 * 18 / 2);
  EXPECT_LT(numberOfHalfCells, 18 * 18);
  EXPECT_EQ(map->GetNumberOfWorstAngles(), 5);
  EXPECT_NEAR(map->GetWorstError(4), 1.0 / 15.0, 1e-12);
}

// A spot of error in i, o and azimuth is found where it is, by the share that it has of its ring.
TEST(BRDFFailureMap, FindsTheWorstAngles)
{
  vtkNew<FunctionBRDF> reference;
  vtkNew<FunctionBRDF> spotted;
  for (const bool isotropic : { true, false })
  {
    reference->Function = [](const auto&, const auto&) { return glm::dvec3(2.0); };
    spotted->Function = [](const glm::dvec3& i, const glm::dvec3& o)
    {
      const bool spot = std::abs(GetPolar(i) - 63.0) < 1.0 && std::abs(GetPolar(o) - 21.0) < 1.0 &&
                        std::abs(GetAzimuth(i, o) - 120.0) < 4.0;
      const bool lesser = std::abs(GetPolar(i) - 9.0) < 1.0 && std::abs(GetPolar(o) - 81.0) < 1.0;
      return glm::dvec3(spot ? 8.0 : lesser ? 2.1 : 2.0);
    };
    spotted->Isotropic = isotropic;
    vtkNew<vtkBRDFFailureMap> map;
    map->SetReference(reference);
    map->SetBRDF(spotted);
    map->SetNumberOfCells(45);    // 63 degrees is the center of cell 31
    map->SetNumberOfAzimuths(36); // one of them in the spot
    ASSERT_TRUE(map->Update());
    ASSERT_EQ(map->GetNumberOfWorstAngles(), 2);
    double angles[3];
    map->GetWorstAngles(0, angles);
    EXPECT_NEAR(angles[0], 63.0, 1e-9);
    EXPECT_NEAR(angles[1], 21.0, 1e-9);
    EXPECT_NEAR(angles[2], 120.0, 1e-9);
    EXPECT_NEAR(map->GetWorstError(0), 3.0 / 36.0, 1e-9); // 6 of 2 in one azimuth of 36
    map->GetWorstAngles(1, angles);
    EXPECT_NEAR(angles[0], 9.0, 1e-9);
    EXPECT_NEAR(angles[1], 81.0, 1e-9);
    EXPECT_NEAR(map->GetWorstError(1), 0.05, 1e-9);
    EXPECT_NEAR(At(map->GetIncidentOutgoing(), 31, 10), 3.0 / 36.0, 1e-9);
    EXPECT_EQ(At(map->GetIncidentOutgoing(), 10, 31), 0.0);
    EXPECT_NEAR(map->GetIncidentOutgoing()->GetOrigin()[0], 1.0, 1e-12);
    EXPECT_NEAR(map->GetIncidentOutgoing()->GetSpacing()[0], 2.0, 1e-12);
    map->GetWorstAngles(2, angles);
    EXPECT_EQ(angles[0], 0.0);
    EXPECT_EQ(map->GetWorstError(-1), 0.0);
  }
}

// An error of the highlight only is where theta_h is small, whatever theta_d.
TEST(BRDFFailureMap, HalfDifferenceShowsTheHighlight)
{
  vtkNew<FunctionBRDF> reference;
  vtkNew<FunctionBRDF> wide;
  reference->Function = [](const auto&, const auto&) { return glm::dvec3(1.0); };
  wide->Function = [](const glm::dvec3& i, const glm::dvec3& o)
  { return glm::dvec3(glm::normalize(i + o).z > std::cos(10.0 * Degree) ? 1.5 : 1.0); };
  vtkNew<vtkBRDFFailureMap> map;
  map->SetReference(reference);
  map->SetBRDF(wide);
  map->SetNumberOfCells(30);
  ASSERT_TRUE(map->Update());
  // theta_h = 90 degrees ((x + 0.5) / 30)^2 passes 10 degrees at x = 9.5.
  for (int y = 0; y < 26; ++y)
  {
    EXPECT_NEAR(At(map->GetHalfDifference(), 9, y), 0.5, 1e-12) << y;
    EXPECT_EQ(At(map->GetHalfDifference(), 10, y), 0.0) << y;
  }
  EXPECT_TRUE(std::isnan(At(map->GetHalfDifference(), 29, 29)));
}

// With the azimuth of the whole pair, where a BRDF has one: the mean of 1 + 0.5 cos(2 phi).
TEST(BRDFFailureMap, AveragesAnisotropy)
{
  vtkNew<FunctionBRDF> reference;
  vtkNew<FunctionBRDF> brushed;
  reference->Function = [](const auto&, const auto&) { return glm::dvec3(1.0); };
  brushed->Function = [](const auto&, const glm::dvec3& o)
  { return glm::dvec3(1.0 + 0.5 * std::cos(2.0 * std::atan2(o.y, o.x))); };
  brushed->Isotropic = false;
  vtkNew<vtkBRDFFailureMap> map;
  map->SetReference(reference);
  map->SetBRDF(brushed);
  map->SetNumberOfCells(6);
  ASSERT_TRUE(map->Update());
  EXPECT_NEAR(At(map->GetIncidentOutgoing(), 3, 3), 1.0 / (180.0 * Degree), 2e-3); // 0.5 * 2/pi
}

TEST(BRDFFailureMap, BadInput)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkLambertBRDF> black;
  black->SetAlbedo(0.0, 0.0, 0.0);
  vtkNew<vtkBRDFFailureMap> map;
  ErrorCatcher errors(map);
  EXPECT_FALSE(map->Update());
  map->SetReference(lambert);
  EXPECT_FALSE(map->Update());
  EXPECT_EQ(errors.Take(), 2);
  EXPECT_EQ(map->GetNumberOfWorstAngles(), 0);
  // Nothing is relative to black.
  map->SetReference(black);
  map->SetBRDF(lambert);
  map->SetNumberOfCells(4);
  EXPECT_TRUE(map->Update());
  EXPECT_TRUE(std::isnan(map->GetRelativeL1()));
  EXPECT_TRUE(std::isnan(At(map->GetIncidentOutgoing(), 1, 1)));
  EXPECT_EQ(map->GetNumberOfWorstAngles(), 0);
}

TEST(BRDFFailureMap, StopsWhereItIsAborted)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkBRDFFailureMap> map;
  map->SetReference(lambert);
  map->SetBRDF(lambert);
  ExpectStops(
    map.Get(), [&]() { return map->Update(); },
    [&]() { return map->GetIncidentOutgoing()->GetMTime(); }, 1);
}

// sqrt of the integral over c in [0,1] of (ln(1 + a c / pi) - ln(1 + b c / pi))^2, by quadrature.
TEST(LogCosineDistance, OfLambertMaterials)
{
  vtkNew<vtkLambertBRDF> a;
  vtkNew<vtkLambertBRDF> b;
  a->SetAlbedo(0.8, 0.8, 0.8);
  b->SetAlbedo(0.4, 0.4, 0.4);
  EXPECT_NEAR(vtkBRDFResampler::GetLogCosineDistance(a, b), 0.0644433235, 1e-5);
  EXPECT_NEAR(vtkBRDFResampler::GetLogCosineDistance(b, a), 0.0644433235, 1e-5);
  EXPECT_EQ(vtkBRDFResampler::GetLogCosineDistance(a, a), 0.0);
  b->SetAlbedo(0.8, 0.8, 0.4); // one channel of three
  EXPECT_NEAR(vtkBRDFResampler::GetLogCosineDistance(a, b), 0.0644433235 / std::sqrt(3.0), 1e-5);
  // f c large: a factor is its logarithm, whatever the size. 1/c keeps f c constant.
  vtkNew<FunctionBRDF> bright;
  vtkNew<FunctionBRDF> brighter;
  bright->Function = [](const glm::dvec3& i, const auto&) { return glm::dvec3(1e6 / i.z); };
  brighter->Function = [](const glm::dvec3& i, const auto&) { return glm::dvec3(1.1e6 / i.z); };
  EXPECT_NEAR(vtkBRDFResampler::GetLogCosineDistance(bright, brighter), std::log(1.1), 1e-5);
}
