// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Lobes, slices and images of materials that are given by a formula.

#include "ErrorCatcher.h"
#include "TestBasisHelpers.h"

#include "vtkBRDFImageSource.h"
#include "vtkBRDFLobeSource.h"
#include "vtkBRDFSliceSource.h"
#include "vtkBTDF.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkLambertBRDF.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <new>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace
{
constexpr double Degree = 3.14159265358979323846 / 180.0;

// A function of a pair, 1, 2 and 3 times in the channels.
vtkSmartPointer<testbasis::FunctionBRDF> MakeMaterial(
  const std::function<double(const glm::dvec3& i, const glm::dvec3& o)>& formula)
{
  auto brdf = vtkSmartPointer<testbasis::FunctionBRDF>::New();
  brdf->Function = [formula](const glm::dvec3& i, const glm::dvec3& o)
  { return formula(i, o) * glm::dvec3(1.0, 2.0, 3.0); };
  return brdf;
}

constexpr double LuminanceOf123 = 0.2126 + 2.0 * 0.7152 + 3.0 * 0.0722;

// Polar angle of h, angle of i from h, both in degrees, and h's azimuth.
struct Angles
{
  double ThetaH;
  double ThetaD;
  double PhiH;
};

Angles GetAngles(const glm::dvec3& i, const glm::dvec3& o)
{
  const glm::dvec3 h = glm::normalize(i + o);
  return { std::acos(std::min(h.z, 1.0)) / Degree,
    std::acos(std::min(glm::dot(h, i), 1.0)) / Degree, std::atan2(h.y, h.x) / Degree };
}

// Of pyramids from the origin over the cells from the first one on: negative where they face
// inwards.
double GetVolume(vtkPolyData* lobe, vtkIdType first)
{
  double volume = 0.0;
  for (vtkIdType k = first; k < lobe->GetNumberOfCells(); ++k)
  {
    vtkIdType count;
    const vtkIdType* points;
    lobe->GetCellPoints(k, count, points);
    for (vtkIdType t = 1; t + 1 < count; ++t)
    {
      glm::dvec3 a, b, c;
      lobe->GetPoint(points[0], &a.x);
      lobe->GetPoint(points[t], &b.x);
      lobe->GetPoint(points[t + 1], &c.x);
      volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
  }
  return volume;
}

double GetColumn(vtkTable* table, vtkIdType row, const char* name)
{
  return table->GetValueByName(row, name).ToDouble();
}
}

//------------------------------------------------------------------------------
TEST(LobeSource, PointsLieAsFarAsTheLightThatIsReflectedTheirWay)
{
  const auto brdf = MakeMaterial(
    [](const glm::dvec3& i, const glm::dvec3& o) { return 1.0 + 0.5 * o[0] + 0.25 * o[1] * i[2]; });
  vtkNew<vtkBRDFLobeSource> source;
  source->SetBRDF(brdf);
  source->SetThetaI(60.0);
  source->SetPhiI(200.0);
  source->SetRadialResolution(20);
  source->SetCircularResolution(30);
  source->SetScaleFactor(3.0);
  source->Update();

  vtkPolyData* lobe = source->GetOutput();
  ASSERT_EQ(lobe->GetNumberOfPoints(), 1 + 20 * 30);
  vtkDataArray* f = lobe->GetPointData()->GetArray("BRDF");
  vtkDataArray* radiance = lobe->GetPointData()->GetArray("Radiance");
  vtkDataArray* direction = lobe->GetPointData()->GetArray("Direction");
  vtkDataArray* luminance = lobe->GetPointData()->GetScalars();
  ASSERT_TRUE(f && radiance && direction && luminance);
  EXPECT_STREQ(luminance->GetName(), "Luminance");
  const glm::dvec3 i = FromDegrees(60.0, 200.0);
  int aboveHorizon = 0;
  for (vtkIdType k = 0; k < lobe->GetNumberOfPoints(); ++k)
  {
    glm::dvec3 o, place;
    direction->GetTuple(k, &o.x);
    lobe->GetPoint(k, &place.x);
    EXPECT_NEAR(glm::length(o), 1.0, 1e-6);
    EXPECT_GE(o.z, 0.0);
    aboveHorizon += o.z > 0.0 ? 1 : 0;
    const double expected = o.z > 1e-6 ? brdf->Function(i, o).x : 0.0;
    EXPECT_NEAR(f->GetComponent(k, 2), 3.0 * expected, 1e-5) << k;
    EXPECT_NEAR(radiance->GetComponent(k, 1), 2.0 * 0.5 * expected, 1e-5) << k;
    EXPECT_NEAR(luminance->GetTuple1(k), LuminanceOf123 * 0.5 * expected, 1e-5) << k;
    EXPECT_LT(glm::distance(place, 3.0 * LuminanceOf123 * 0.5 * expected * o), 2e-5) << k;
  }
  EXPECT_GE(aboveHorizon, 1 + 19 * 30);
  // The first point is the mirror direction's.
  EXPECT_NEAR(direction->GetComponent(0, 0), -i[0], 1e-6);
  EXPECT_NEAR(direction->GetComponent(0, 1), -i[1], 1e-6);
}

//------------------------------------------------------------------------------
TEST(LobeSource, TheSurfaceIsClosedAndFacesOutwards)
{
  vtkNew<vtkLambertBRDF> brdf;
  for (const double theta : { 0.0, 45.0, 89.0 })
  {
    vtkNew<vtkBRDFLobeSource> source;
    source->SetBRDF(brdf);
    source->SetThetaI(theta);
    source->SetRadialResolution(128);
    source->SetCircularResolution(256);
    source->NormalizeOn();
    source->Update();
    vtkPolyData* lobe = source->GetOutput();
    // Together half a unit ball, since a Lambert surface reflects alike in all directions.
    const double volume = GetVolume(lobe, 0);
    // The last ring lies in the origin: beyond the one before it, at (127/128)^2 90 degrees, the
    // ball is missing, sin(1.4 degrees) = 2.4 % of it.
    EXPECT_NEAR(volume, 2.0 / 3.0 * 180.0 * Degree, 0.06) << theta;
    EXPECT_LT(volume, 2.0 / 3.0 * 180.0 * Degree) << theta;

    // The rim's points coincide; every other edge has two cells.
    std::map<std::pair<vtkIdType, vtkIdType>, int> edges;
    const vtkIdType firstOfRim = 1 + 127 * 256;
    for (vtkIdType k = 0; k < lobe->GetNumberOfCells(); ++k)
    {
      vtkIdType count;
      const vtkIdType* points;
      lobe->GetCellPoints(k, count, points);
      for (vtkIdType p = 0; p < count; ++p)
      {
        const vtkIdType a = std::min(points[p], firstOfRim);
        const vtkIdType b = std::min(points[(p + 1) % count], firstOfRim);
        if (a != b)
        {
          ++edges[{ std::min(a, b), std::max(a, b) }];
        }
      }
    }
    EXPECT_TRUE(
      std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 2; }))
      << theta;
  }
}

//------------------------------------------------------------------------------
// A diffuse sheet: below the surface a second lobe of half the size, with normals outwards.
TEST(LobeSource, TransmissionIsBelowTheSurface)
{
  const auto brdf = MakeMaterial([](const glm::dvec3&, const glm::dvec3&) { return 0.2; });
  const auto folded =
    MakeMaterial([](const glm::dvec3& i, const glm::dvec3& o) { return 0.1 * (i[0] > o[0]); });
  vtkNew<vtkBTDF> transmission;
  transmission->SetFolded(vtkBTDF::FRONT, folded);
  vtkNew<vtkBRDFLobeSource> source;
  source->SetBRDF(brdf);
  source->SetThetaI(30.0);
  source->SetPhiI(0.0);
  source->SetRadialResolution(32);
  source->SetCircularResolution(64);
  source->Update();
  const vtkIdType above = source->GetOutput()->GetNumberOfPoints();
  EXPECT_FALSE(source->GetOutput()->GetPointData()->HasArray("Transmitted"));
  source->SetTransmission(transmission);
  source->Update();
  vtkPolyData* lobe = source->GetOutput();
  ASSERT_EQ(lobe->GetNumberOfPoints(), 2 * above);
  vtkDataArray* directions = lobe->GetPointData()->GetArray("Direction");
  vtkDataArray* transmitted = lobe->GetPointData()->GetArray("Transmitted");
  vtkDataArray* luminances = lobe->GetPointData()->GetArray("Luminance");
  ASSERT_TRUE(transmitted);
  const double cosine = std::cos(30.0 * Degree);
  for (vtkIdType k = 0; k < above; ++k)
  {
    glm::dvec3 up, down, point;
    directions->GetTuple(k, &up.x);
    directions->GetTuple(above + k, &down.x);
    EXPECT_EQ(down, glm::dvec3(up.x, up.y, -up.z));
    EXPECT_EQ(transmitted->GetTuple1(k), 0.0);
    EXPECT_EQ(transmitted->GetTuple1(above + k), 1.0);
    if (down.z < -1e-6 && std::abs(down.x - 0.5) > 1e-6)
    {
      const double expected = down.x < 0.5 ? 0.1 * cosine * LuminanceOf123 : 0.0;
      EXPECT_NEAR(luminances->GetTuple1(above + k), expected, 1e-6);
      lobe->GetPoint(above + k, &point.x);
      EXPECT_NEAR(glm::dot(point, down), expected, 1e-6);
    }
  }
  // Where light goes straight on.
  EXPECT_NEAR(directions->GetComponent(above, 0), -0.5, 1e-6);
  EXPECT_NEAR(directions->GetComponent(above, 2), -cosine, 1e-6);
  EXPECT_GT(GetVolume(lobe, lobe->GetNumberOfCells() / 2), 0.001); // faces outwards
  // One scale for both: the reflection is the farthest.
  source->NormalizeOn();
  source->Update();
  double point[3];
  source->GetOutput()->GetPoint(above, point);
  EXPECT_NEAR(vtkMath::Norm(point), 0.5, 1e-5);
}

//------------------------------------------------------------------------------
TEST(LobeSource, LogarithmsAndNormalizedSizes)
{
  const auto brdf =
    MakeMaterial([](const glm::dvec3&, const glm::dvec3& o) { return o[0] > 0.0 ? 40.0 : 0.01; });
  vtkNew<vtkBRDFLobeSource> source;
  source->SetBRDF(brdf);
  source->SetScalingToLogarithmic();
  source->SetScaleFactor(2.0);
  source->Update();
  double place[3];
  source->GetOutput()->GetPoint(0, place);
  const double luminance = 40.0 * LuminanceOf123 * std::cos(45.0 * Degree);
  EXPECT_NEAR(vtkMath::Norm(place), 2.0 * std::log(1.0 + 100.0 * luminance), 1e-5);
  source->NormalizeOn();
  source->Update();
  source->GetOutput()->GetPoint(0, place);
  EXPECT_NEAR(vtkMath::Norm(place), 2.0, 1e-6);

  // A black material has a lobe of no size.
  brdf->Function = [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec3(0.0); };
  brdf->Modified();
  source->Update();
  double bounds[6];
  source->GetOutput()->GetBounds(bounds);
  EXPECT_EQ(bounds[5], 0.0);
}

//------------------------------------------------------------------------------
TEST(SliceSource, RowsHoldTheirAnglesAndValues)
{
  const auto brdf = MakeMaterial(
    [](const glm::dvec3& i, const glm::dvec3& o)
    {
      const Angles angles = GetAngles(i, o);
      return 1000.0 * angles.ThetaH + angles.ThetaD + 0.001 * std::abs(angles.PhiH);
    });
  vtkNew<vtkBRDFSliceSource> source;
  source->SetBRDF(brdf);
  source->SetThetaHRange(5.0, 65.0);
  source->SetNumberOfThetaH(4);
  source->SetThetaDRange(50.0, 10.0);
  source->SetNumberOfThetaD(3);
  source->SetPhiDRange(0.0, 90.0);
  source->SetNumberOfPhiD(2);
  source->SetPhiH(30.0);
  source->Update();
  vtkTable* table = source->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows(), 4 * 3 * 2);
  int below = 0;
  for (vtkIdType row = 0; row < 24; ++row)
  {
    const double thetaH = 5.0 + 20.0 * static_cast<double>(row / 6);
    const double thetaD = 50.0 - 20.0 * static_cast<double>(row / 2 % 3);
    const double phiD = row % 2 == 0 ? 0.0 : 90.0;
    EXPECT_NEAR(GetColumn(table, row, "theta_h"), thetaH, 1e-9);
    EXPECT_NEAR(GetColumn(table, row, "theta_d"), thetaD, 1e-9);
    EXPECT_NEAR(GetColumn(table, row, "phi_d"), phiD, 1e-9);
    // In one plane (phi_d = 0) the lower direction is theta_h + theta_d from the normal.
    const bool valid = phiD > 0.0 || thetaH + thetaD < 90.0;
    below += valid ? 0 : 1;
    EXPECT_EQ(GetColumn(table, row, "vtkValidPointMask"), valid ? 1.0 : 0.0) << row;
    const double expected = valid ? 1000.0 * thetaH + thetaD + 0.030 : 0.0;
    EXPECT_NEAR(GetColumn(table, row, "red"), expected, 1e-4) << row;
    EXPECT_NEAR(GetColumn(table, row, "blue"), 3.0 * expected, 1e-4) << row;
    EXPECT_NEAR(GetColumn(table, row, "luminance"), LuminanceOf123 * expected, 1e-3) << row;
  }
  EXPECT_GT(below, 0);
  // As MERL's, close together at the start of the range.
  source->UseThetaHSquaredOn();
  source->Update();
  EXPECT_NEAR(GetColumn(table, 6, "theta_h"), 5.0 + 60.0 / 9.0, 1e-12);
}

//------------------------------------------------------------------------------
TEST(SliceSource, TooManyRowsAreRefused)
{
  vtkNew<vtkLambertBRDF> brdf;
  vtkNew<vtkBRDFSliceSource> source;
  source->SetBRDF(brdf);
  source->SetNumberOfThetaH(100000);
  source->SetNumberOfThetaD(100000);
  ErrorCatcher errors(source);
  ErrorCatcher executive(source->GetExecutive());
  source->Update();
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_NE(errors.GetText().find("1e+07"), std::string::npos) << errors.GetText();
  EXPECT_EQ(source->GetOutput()->GetNumberOfRows(), 0);
  source->SetThetaDRange(0.0, 91.0);
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_EQ(source->GetThetaDRange()[1], 90.0);
}

//------------------------------------------------------------------------------
TEST(ImageSource, PixelsAreTheSlicesOfBurley)
{
  const auto brdf = MakeMaterial(
    [](const glm::dvec3& i, const glm::dvec3& o)
    {
      const Angles angles = GetAngles(i, o);
      return 1000.0 * angles.ThetaH + angles.ThetaD;
    });
  vtkNew<vtkBRDFImageSource> source;
  source->SetBRDF(brdf);
  source->SetResolution(9);
  source->Update();
  vtkImageData* image = source->GetOutput();
  ASSERT_EQ(image->GetNumberOfPoints(), 81);
  EXPECT_EQ(image->GetSpacing()[0], 10.0);
  EXPECT_EQ(image->GetOrigin()[1], 5.0);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  EXPECT_STREQ(values->GetName(), "BRDF");
  for (vtkIdType k = 0; k < 81; ++k)
  {
    double place[3];
    image->GetPoint(k, place);
    EXPECT_NEAR(values->GetComponent(k, 0), 1000.0 * place[0] + place[1], 0.05) << k;
    EXPECT_NEAR(values->GetComponent(k, 1), 2000.0 * place[0] + 2.0 * place[1], 0.1) << k;
  }
  source->UseThetaHSquaredOn();
  source->Update();
  EXPECT_NEAR(values->GetComponent(0, 0), 1000.0 * 5.0 * 5.0 / 90.0 + 5.0, 0.05);
  // In one plane the corner beyond theta_h + theta_d = 90 degrees is below the horizon.
  source->UseThetaHSquaredOff();
  source->SetPhiD(0.0);
  source->Update();
  values = source->GetOutput()->GetPointData()->GetScalars();
  EXPECT_GT(values->GetComponent(7 + 0 * 9, 0), 0.0);
  EXPECT_EQ(values->GetComponent(8 + 1 * 9, 0), 0.0);
}

namespace
{
class NoMemoryForImages : public vtkBRDFImageSource
{
public:
  static NoMemoryForImages* New();
  vtkTypeMacro(NoMemoryForImages, vtkBRDFImageSource);

protected:
  using vtkBRDFImageSource::AllocateOutputData;
  vtkImageData* AllocateOutputData(vtkDataObject*, vtkInformation*) override
  {
    throw std::bad_alloc();
  }
};
vtkStandardNewMacro(NoMemoryForImages);
}

//------------------------------------------------------------------------------
TEST(Sources, NoMemoryForAnImageIsAnError)
{
  vtkNew<NoMemoryForImages> source;
  ErrorCatcher errors(source);
  source->Update();
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_NE(errors.GetText().find("std::bad_alloc"), std::string::npos) << errors.GetText();
}

//------------------------------------------------------------------------------
TEST(Sources, FollowTheirMaterialAndSayWhenThereIsNone)
{
  vtkNew<vtkLambertBRDF> brdf;
  brdf->SetAlbedo(0.5, 0.5, 0.5);
  vtkNew<vtkBRDFLobeSource> lobe;
  vtkNew<vtkBRDFSliceSource> slice;
  vtkNew<vtkBRDFImageSource> image;
  for (vtkAlgorithm* source : std::initializer_list<vtkAlgorithm*>{ lobe, slice, image })
  {
    ErrorCatcher errors(source);
    ErrorCatcher executive(source->GetExecutive());
    source->Update();
    EXPECT_EQ(errors.Take(), 1) << source->GetClassName();
  }
  EXPECT_EQ(lobe->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(slice->GetOutput()->GetNumberOfRows(), 0);

  lobe->SetBRDF(brdf);
  slice->SetBRDF(brdf);
  image->SetBRDF(brdf);
  const auto get = [&]()
  {
    lobe->Update();
    slice->Update();
    image->Update();
    return std::array<double, 3>{ lobe->GetOutput()->GetPointData()->GetArray("BRDF")->GetComponent(
                                    0, 0),
      GetColumn(slice->GetOutput(), 0, "red"),
      image->GetOutput()->GetPointData()->GetScalars()->GetComponent(0, 0) };
  };
  for (const double albedo : { 0.5, 0.25 })
  {
    brdf->SetAlbedo(albedo, albedo, albedo);
    for (const double value : get())
    {
      EXPECT_NEAR(value, albedo / (180.0 * Degree), 1e-7);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Sources, OneOfSeveralProcessesHasThem)
{
  vtkNew<vtkLambertBRDF> brdf;
  vtkNew<vtkBRDFLobeSource> lobe;
  lobe->SetBRDF(brdf);
  lobe->UpdatePiece(1, 2, 0);
  EXPECT_EQ(lobe->GetOutput()->GetNumberOfPoints(), 0);
  vtkNew<vtkBRDFSliceSource> slice;
  slice->SetBRDF(brdf);
  slice->UpdatePiece(1, 2, 0);
  EXPECT_EQ(slice->GetOutput()->GetNumberOfRows(), 0);
}
