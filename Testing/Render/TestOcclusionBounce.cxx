// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// One bounce of what surfaces hide from themselves (SetOcclusionBounce): the shaders against
// their reference in C++, pictures against traced light, and bad arrays.
#include "OcclusionReference.h"
#include "OcclusionShader.h"
#include "OcclusionTools.h"
#include "RenderFixture.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkDoubleArray.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkFloatArray.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkIntArray.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialMap.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTracedRadianceIntegrator.h"
#include "vtkTracedScene.h"
#include "vtkUnsignedCharArray.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using measuredbrdf::BouncedLight;
using measuredbrdf::HorizonLight;

namespace
{

// A hollow that is open towards the camera, at +z; its points and normals are inside.
vtkSmartPointer<vtkPolyData> MakeHollow(double endPhi = 125.0)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(0.9);
  source->SetThetaResolution(40);
  source->SetPhiResolution(24);
  source->SetStartPhi(180.0 - endPhi);
  source->SetEndPhi(180.0);
  vtkNew<vtkReverseSense> inwards;
  inwards->SetInputConnection(source->GetOutputPort());
  inwards->ReverseNormalsOn();
  inwards->Update();
  return inwards->GetOutput();
}

const char* const BouncedName = vtkSurfaceVisibilityFilter::GetBouncedLightArrayName();
}

class BounceTest : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("hall"));
    this->Filter->BounceOn();
    this->Filter->SetInputData(MakeHollow());
    this->Filter->Update();
    this->Surface->DeepCopy(this->Filter->GetOutputDataObject(0));
    this->Brdf->SetAlbedo(0.9, 0.6, 0.3);
    MakeSmall(this->Table.Get());
    this->Mapper->SetInputData(this->Surface);
    this->Mapper->SetEnvironment(this->Environment);
    this->Mapper->SetBRDF(this->Brdf);
    this->Mapper->SetIntegrator(this->Table);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
  }

  glm::dvec3 RenderAt(int x, int y)
  {
    const FloatImage image = this->RenderLinear();
    const float* pixel = image.At(x, y);
    return { pixel[0], pixel[1], pixel[2] };
  }

  glm::dvec3 RenderMiddle(bool bounce)
  {
    this->Mapper->SetOcclusionBounce(bounce);
    return this->RenderAt(32, 32);
  }

  static double Compare(const FloatImage& one, const FloatImage& other)
  {
    double largest = 0.0;
    for (std::size_t k = 0; k < one.RGBA.size(); ++k)
    {
      largest = std::max<double>(
        largest, std::abs(one.RGBA[k] - other.RGBA[k]) / std::max(one.RGBA[k], 1e-3f));
    }
    return largest;
  }

  /// All points like one of them, so that interpolation changes nothing.
  void SpreadPoint(vtkIdType point)
  {
    for (const char* name : { vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName(),
           vtkSurfaceVisibilityFilter::GetHiddenLightArrayName(), BouncedName })
    {
      vtkUnsignedCharArray* bytes = GetBytes(this->Surface, name);
      for (vtkIdType k = 0; k < bytes->GetNumberOfTuples(); ++k)
      {
        bytes->SetTuple(k, point, bytes);
      }
    }
  }

  /// What the C++ forms add at a point.
  glm::dvec3 GetAdded(vtkBRDF* brdf, vtkRadianceIntegrator* integrator, vtkIdType point)
  {
    const measuredbrdf::OcclusionLight light(brdf, this->Environment, integrator, true);
    const measuredbrdf::OcclusionAxes axes(this->Renderer, this->Actor, { this->Environment });
    BouncedLight::Code bounced;
    std::copy_n(GetBytes(this->Surface, BouncedName)->GetPointer(point * BouncedLight::Bytes),
      BouncedLight::Bytes, bounced.begin());
    glm::dvec3 view;
    this->Renderer->GetActiveCamera()->GetPosition(&view.x);
    return GetReferenceBounce(light, HorizonLight(GetCode(this->Surface, point)),
      BouncedLight(bounced), glm::normalize(view), axes.ToEnvironment[0]);
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkSurfaceVisibilityFilter> Filter;
  vtkNew<vtkPolyData> Surface;
  vtkNew<vtkLambertBRDF> Brdf;
  vtkNew<vtkTableRadianceIntegrator> Table;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

// Matte and glossy materials, methods that tell the lobe apart and one that does not, lamps of
// their own: what the picture gains is what C++ says, from several views and rotations.
TEST_F(BounceTest, ShadersAgreeWithTheCppForms)
{
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetSpecular(0.5, 0.5, 0.4);
  gloss->SetExponent(30.0);
  vtkNew<vtkHybridRadianceIntegrator> hybrid;
  MakeSmall(hybrid.Get());
  hybrid->SetMaximumNumberOfLights(2);
  vtkNew<vtkFilteredRadianceIntegrator> filtered;
  filtered->SetNumberOfSamples(8);
  this->SpreadPoint(400); // at one side, halfway down
  double largest = 0.0;
  for (const auto& [brdf, integrator] :
    std::vector<std::pair<vtkBRDF*, vtkRadianceIntegrator*>>{
      { this->Brdf, this->Table }, { gloss, this->Table }, { gloss, hybrid }, { gloss, filtered } })
  {
    this->Mapper->SetBRDF(brdf);
    this->Mapper->SetIntegrator(integrator);
    for (const double turn : { 0.0, 130.0 })
    {
      this->Environment->SetRotationY(turn);
      this->Renderer->GetActiveCamera()->SetPosition(0.04 * turn / 10.0, 0.3, 5.0);
      const glm::dvec3 black = this->RenderMiddle(false);
      const glm::dvec3 bounce = this->RenderMiddle(true);
      const glm::dvec3 added = this->GetAdded(brdf, integrator, 400);
      EXPECT_LT(glm::length(bounce - black - added), 2e-3 * glm::length(bounce))
        << integrator->GetClassName() << " " << turn << ": " << added.x << " "
        << (bounce - black).x;
      largest = std::max(largest, glm::length(added) / glm::length(bounce));
    }
  }
  EXPECT_GT(largest, 0.1);
}

// A picture against traced light with one bounce: 140 pixels of a ball in a hollow. The map is
// smooth: hard panels are benchmarks' matter.
TEST_F(BounceTest, PicturesComeNearTracedLight)
{
  std::vector<float> texels;
  for (int y = 0; y < 16; ++y)
  {
    for (int x = 0; x < 32; ++x)
    {
      glm::dvec3 d;
      vtkEnvironment::GetDirection((x + 0.5) / 32.0, (y + 0.5) / 16.0, &d.x);
      for (const double radiance :
        { 1.1 + d.x, 1.0 + 0.7 * d.y + 0.5 * d.z * d.z, 1.0 - d.x * d.y })
      {
        texels.push_back(static_cast<float>(radiance));
      }
    }
  }
  this->Environment->SetPixels(32, 16, texels);
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.35);
  ball->SetCenter(0.2, 0.0, -0.3);
  ball->SetThetaResolution(40);
  ball->SetPhiResolution(30);
  ball->Update();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeHollow());
  blocks->SetBlock(1, ball->GetOutput());
  vtkNew<vtkCompositeMeasuredBRDFMapper> composite;
  composite->SetInputDataObject(blocks);
  composite->SetBRDF(this->Brdf);
  composite->SetIntegrator(this->Table);
  composite->SetEnvironment(this->Environment);
  this->Table->SetNumberOfRows(65);
  this->Actor->SetMapper(composite);
  vtkNew<vtkTracedScene> scene;
  scene->AddSurface(vtkPolyData::SafeDownCast(blocks->GetBlock(0)));
  scene->AddSurface(ball->GetOutput());
  vtkNew<vtkDoubleArray> origins, directions, views, traced;
  for (vtkDoubleArray* array : { origins.Get(), directions.Get(), views.Get() })
  {
    array->SetNumberOfComponents(3);
  }
  std::vector<std::pair<int, int>> pixels;
  for (int y = 10; y < 54; y += 3)
  {
    for (int x = 10; x < 54; x += 3)
    {
      if (std::hypot(x - 31.5, y - 31.5) < 20.0)
      {
        pixels.emplace_back(x, y);
        origins->InsertNextTuple3((x + 0.5) / 32.0 - 1.0, (y + 0.5) / 32.0 - 1.0, 5.0);
        directions->InsertNextTuple3(0.0, 0.0, -1.0);
        views->InsertNextTuple3(0.0, 0.0, 1.0);
      }
    }
  }
  vtkNew<vtkPolyData> hits;
  ASSERT_TRUE(scene->CastRays(origins, directions, hits));
  vtkNew<vtkTracedRadianceIntegrator> reference;
  reference->SetScene(scene);
  reference->SetBRDF(this->Brdf);
  reference->SetEnvironment(this->Environment);
  reference->SetNumberOfBounces(1);
  reference->SetNumberOfSamples(1024);
  ASSERT_TRUE(reference->Integrate(hits, views, traced));
  const auto getError = [&](int mode, bool bounce)
  {
    composite->SetOcclusionMode(mode);
    composite->SetOcclusionBounce(bounce);
    const FloatImage image = this->RenderLinear();
    double error = 0.0;
    double all = 0.0;
    for (std::size_t k = 0; k < pixels.size(); ++k)
    {
      for (int c = 0; c < 3; ++c)
      {
        const double wanted = traced->GetComponent(static_cast<vtkIdType>(k), c);
        error += std::abs(image.At(pixels[k].first, pixels[k].second)[c] - wanted);
        all += wanted;
      }
    }
    return error / all;
  };
  EXPECT_GT(getError(0, false), 0.4);
  EXPECT_GT(getError(2, false), 0.15);
  EXPECT_LT(getError(2, true), 0.05);
}

// Composites, with blocks without a bounce, material maps and the mapper's own arrays show the
// same; and it can be turned off and on again.
TEST_F(BounceTest, AllMappersDrawTheSame)
{
  const glm::dvec3 black = this->RenderMiddle(false);
  const glm::dvec3 bounce = this->RenderMiddle(true);
  EXPECT_GT(bounce.x, 1.1 * black.x);
  EXPECT_LT(glm::length(this->RenderMiddle(false) - black), 1e-6);
  EXPECT_LT(glm::length(this->RenderMiddle(true) - bounce), 1e-6);
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkSphereSource> dot;
  dot->SetCenter(0.95, 0.95, 0.0);
  dot->SetRadius(0.05);
  dot->Update();
  blocks->SetBlock(0, dot->GetOutput());
  blocks->SetBlock(1, this->Surface);
  vtkNew<vtkCompositeMeasuredBRDFMapper> composite;
  composite->SetInputDataObject(blocks);
  composite->SetBRDF(this->Brdf);
  composite->SetIntegrator(this->Table);
  composite->SetEnvironment(this->Environment);
  this->Actor->SetMapper(composite);
  EXPECT_FALSE(composite->GetOcclusionBounce());
  EXPECT_LT(glm::length(this->RenderAt(32, 32) - black), 1e-4 * black.x);
  composite->OcclusionBounceOn();
  EXPECT_LT(glm::length(this->RenderAt(32, 32) - bounce), 1e-4 * black.x);
  composite->OcclusionBounceOff();
  EXPECT_LT(glm::length(this->RenderAt(32, 32) - black), 1e-4 * black.x);
  // A material map over what has arrays, and over what the mapper traces.
  vtkNew<vtkPolyData> mapped;
  mapped->DeepCopy(this->Surface);
  vtkNew<vtkIntArray> classes;
  classes->SetName("class");
  for (vtkIdType cell = 0; cell < mapped->GetNumberOfCells(); ++cell)
  {
    classes->InsertNextValue(cell % 2);
  }
  mapped->GetCellData()->AddArray(classes);
  vtkNew<vtkLambertBRDF> same;
  same->SetAlbedo(0.9, 0.6, 0.3);
  vtkNew<vtkMaterialMap> map;
  map->SetArrayName("class");
  map->AddMaterial(this->Brdf, 0.0);
  map->AddMaterial(same, 1.0);
  this->Actor->SetMapper(this->Mapper);
  this->Mapper->SetMaterialMap(map);
  this->Mapper->SetInputData(mapped);
  EXPECT_LT(glm::length(this->RenderMiddle(true) - bounce), 1e-4 * black.x);
  for (const char* name : { vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName(),
         vtkSurfaceVisibilityFilter::GetHiddenLightArrayName(), BouncedName })
  {
    mapped->GetPointData()->RemoveArray(name);
  }
  mapped->Modified();
  this->Mapper->SetOcclusionModeToOn();
  EXPECT_LT(glm::length(this->RenderMiddle(false) - black), 0.02 * black.x);
  EXPECT_LT(glm::length(this->RenderMiddle(true) - bounce), 0.02 * black.x);
}

// What the mapper decides to trace by itself has a bounce where it is asked for, and the plan says
// so.
TEST_F(BounceTest, AutoTracesItAndThePlanSaysSo)
{
  this->Mapper->SetInputData(MakeHollow());
  this->Mapper->SetIntegrator(nullptr);
  const glm::dvec3 black = this->RenderMiddle(false);
  EXPECT_EQ(this->Mapper->GetPlan().find("bounce"), std::string::npos) << this->Mapper->GetPlan();
  const glm::dvec3 bounce = this->RenderMiddle(true);
  EXPECT_GT(bounce.x, 1.1 * black.x);
  EXPECT_NE(this->Mapper->GetPlan().find(", modeled; one bounce modeled"), std::string::npos)
    << this->Mapper->GetPlan();
  EXPECT_LT(glm::length(this->RenderMiddle(false) - black), 1e-5);
  EXPECT_EQ(this->Mapper->GetPlan().find("bounce"), std::string::npos);
  this->Mapper->SetOcclusionModeToOff();
  this->RenderMiddle(true);
  EXPECT_EQ(this->Mapper->GetPlan().find("bounce"), std::string::npos);
}

// Arrays without a bounce, of another type, with numbers that are none, or of another size: one
// warning, drawn black.
TEST_F(BounceTest, BadArraysAreSaidOnceAndNotUsed)
{
  const FloatImage black = this->RenderLinear();
  this->Mapper->OcclusionBounceOn();
  vtkNew<vtkPolyData> good;
  good->DeepCopy(this->Surface);
  const auto expectBlack = [&](const char* words)
  {
    WarningTexts warnings(this->Mapper);
    this->Surface->Modified();
    EXPECT_LT(Compare(black, this->RenderLinear()), 1e-5) << words;
    this->RenderLinear();
    ASSERT_EQ(warnings.Texts.size(), 1u) << words;
    EXPECT_NE(warnings.Texts[0].find(words), std::string::npos) << warnings.Texts[0];
    EXPECT_NE(warnings.Texts[0].find("without a bounce"), std::string::npos);
  };
  this->Surface->GetPointData()->RemoveArray(BouncedName);
  expectBlack("is missing");
  vtkNew<vtkFloatArray> numbers;
  numbers->SetName(BouncedName);
  numbers->SetNumberOfComponents(BouncedLight::Bytes);
  numbers->SetNumberOfTuples(this->Surface->GetNumberOfPoints());
  numbers->Fill(std::numeric_limits<double>::quiet_NaN());
  this->Surface->GetPointData()->AddArray(numbers);
  expectBlack("is of type float");
  this->Surface->DeepCopy(good);
  GetBytes(this->Surface, BouncedName)->SetNumberOfTuples(3);
  expectBlack("has 3 tuples");
  this->Surface->DeepCopy(good); // and good ones count again
  WarningTexts warnings(this->Mapper);
  EXPECT_GT(Compare(black, this->RenderLinear()), 0.05);
  EXPECT_TRUE(warnings.Texts.empty());
}
