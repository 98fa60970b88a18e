// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Self-shadowing that a graphics card has no room for, and materials that throw while they are
// drawn: the surface is drawn, and the cause is said once.
#include "EventCounter.h"
#include "MaterialShading.h"
#include "OcclusionTools.h"
#include "RenderFixture.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkCommand.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMaterialMap.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkObjectFactory.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTexture.h"

#include <algorithm>
#include <cmath>
#include <new>

using measuredbrdf::ShaderLimits;

namespace
{
bool ThrowsNow = false;

class Unreliable : public vtkLambertBRDF
{
public:
  static Unreliable* New();
  vtkTypeMacro(Unreliable, vtkLambertBRDF);

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    if (ThrowsNow)
    {
      throw std::bad_alloc();
    }
    this->Superclass::EvaluateAbove(i, o, f);
  }
};
vtkStandardNewMacro(Unreliable);

// A bowl that is seen from both sides, with everything that VTK has attributes for.
vtkSmartPointer<vtkPolyData> MakeRichBowl(bool colors)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(0.9);
  source->SetThetaResolution(40);
  source->SetPhiResolution(24);
  source->SetEndPhi(125.0);
  source->Update();
  vtkSmartPointer<vtkPolyData> bowl = source->GetOutput();
  const vtkIdType points = bowl->GetNumberOfPoints();
  vtkNew<vtkFloatArray> tangents;
  tangents->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("coordinates");
  coordinates->SetNumberOfComponents(2);
  vtkNew<vtkFloatArray> values;
  values->SetName("values");
  for (vtkIdType k = 0; k < points; ++k)
  {
    double p[3];
    bowl->GetPoint(k, p);
    const double across = std::max(std::hypot(p[0], p[1]), 1e-6);
    tangents->InsertNextTuple3(-p[1] / across, p[0] / across, 0.0);
    coordinates->InsertNextTuple2(0.5, 0.5);
    values->InsertNextValue(static_cast<float>(p[2]));
  }
  bowl->GetPointData()->SetTangents(tangents);
  bowl->GetPointData()->SetTCoords(coordinates);
  if (colors)
  {
    bowl->GetPointData()->SetScalars(values);
  }
  return bowl;
}

bool IsDrawn(const FloatImage& image)
{
  const float* middle = image.At(32, 32);
  return middle[0] + middle[1] + middle[2] > 0.01f;
}
}

class LimitsTest : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("hall"));
    this->Brushed->SetExponents(40.0, 10.0);
    vtkNew<vtkImageData> white;
    white->SetDimensions(2, 2, 1);
    white->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    std::fill_n(static_cast<unsigned char*>(white->GetScalarPointer()), 12, 255);
    this->Texture->SetInputData(white);
    this->Actor->SetMapper(this->Mapper);
    this->Actor->SetTexture(this->Texture);
    this->Mapper->SetEnvironment(this->Environment);
    this->Mapper->SetBRDF(this->Brushed);
    this->Mapper->SetIntegrator(this->Lights);
    this->Mapper->SetOcclusionModeToOn();
    this->Mapper->SetOcclusionBounce(true);
    this->Renderer->AddActor(this->Actor);
  }
  void TearDown() override
  {
    ThrowsNow = false;
    ShaderLimits::SetMost(0, 0);
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkAshikhminShirleyBRDF> Brushed;
  vtkNew<vtkLightSetRadianceIntegrator> Lights;
  vtkNew<vtkTexture> Texture;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

// The same picture as a mapper's that was asked for less, in each stage.
TEST_F(LimitsTest, DrawsWhatThereIsRoomFor)
{
  this->Mapper->SetInputData(MakeRichBowl(false));
  this->Actor->SetTexture(nullptr);
  const FloatImage whole = this->RenderLinear();
  const auto render = [this](std::size_t attributes, std::size_t varyings)
  {
    ShaderLimits::SetMost(attributes, varyings);
    this->Mapper->Modified(); // its buffers are built anew
    return this->RenderLinear();
  };
  const WarningTexts warnings(this->Mapper);
  EXPECT_EQ(whole.RGBA, render(16, 0).RGBA);
  EXPECT_TRUE(warnings.Texts.empty());
  const FloatImage dark = render(14, 0);
  EXPECT_EQ(warnings.Texts.size(), 1u);
  EXPECT_NE(dark.RGBA, whole.RGBA);
  const FloatImage open = render(6, 0);
  EXPECT_EQ(warnings.Texts.size(), 2u);
  EXPECT_EQ(open.RGBA, render(16, 30).RGBA);
  EXPECT_EQ(warnings.Texts.size(), 2u);
  const FloatImage side = render(9, 0);
  EXPECT_TRUE(IsDrawn(side));
  EXPECT_EQ(warnings.Texts.size(), 3u);
  this->Mapper->SetOcclusionBounce(false);
  EXPECT_EQ(dark.RGBA, render(0, 0).RGBA);
  this->Mapper->SetOcclusionModeToOff();
  EXPECT_EQ(open.RGBA, render(0, 0).RGBA);
  EXPECT_EQ(warnings.Texts.size(), 3u);
}

// What VTK hands on for clipping planes (six distances) and for edges (three equations), a vector
// of four for each, takes room, too.
TEST_F(LimitsTest, ClippingPlanesAndEdgesTakeVaryings)
{
  this->Mapper->SetInputData(MakeRichBowl(false));
  this->Window->SetSize(256, 256); // so that light shows between edges
  const auto render = [this](std::size_t varyings)
  {
    ShaderLimits::SetMost(0, varyings);
    this->Mapper->Modified(); // its buffers are built anew
    return this->RenderLinear().RGBA;
  };
  const auto find = [&render](std::size_t least) // the fewest that change nothing
  {
    const auto whole = render(0);
    while (render(least) != whole && least < 200)
    {
      least += 4;
    }
    return least;
  };
  const std::size_t alone = find(32);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.0, 0.0, -5.0);
  this->Mapper->AddClippingPlane(plane); // cuts nothing off
  EXPECT_EQ(find(alone), alone + 24);
  this->Actor->GetProperty()->EdgeVisibilityOn();
  EXPECT_EQ(find(alone), alone + 36);
  this->Mapper->RemoveAllClippingPlanes();
  EXPECT_EQ(find(alone), alone + 12);
}

// Nothing of VTK's catches what is thrown while a mapper renders.
TEST_F(LimitsTest, AThrowIsOneErrorAndTheNextRenderWorks)
{
  vtkNew<Unreliable> brdf;
  vtkNew<vtkHybridRadianceIntegrator> table;
  MakeSmall(table.Get());
  this->Mapper->SetInputData(MakeRichBowl(false));
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(table);
  this->Mapper->SetOcclusionModeToOff();
  const FloatImage open = this->RenderLinear();
  const EventCounter errors(this->Mapper, vtkCommand::ErrorEvent);
  ThrowsNow = true;
  this->Mapper->SetOcclusionModeToOn(); // which evaluates the material again
  vtkNew<vtkLight> light;
  this->Renderer->AddLight(light); // by which the superclass draws
  EXPECT_TRUE(IsDrawn(this->RenderLinear()));
  EXPECT_TRUE(IsDrawn(this->RenderLinear()));
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(errors.Text.find("std::bad_alloc"), std::string::npos) << errors.Text;
  this->Renderer->RemoveLight(light);
  ThrowsNow = false;
  const FloatImage hidden = this->RenderLinear();
  EXPECT_TRUE(IsDrawn(hidden));
  EXPECT_NE(hidden.RGBA, open.RGBA);
  EXPECT_EQ(errors.Count, 1);
  ThrowsNow = true;
  this->Mapper->SetOcclusionBounce(false);
  this->RenderLinear(); // the same again is said again
  this->RenderLinear();
  EXPECT_EQ(errors.Count, 2);
  ThrowsNow = false;
  vtkNew<vtkMeasuredBRDFMapper> fresh;
  fresh->SetInputData(this->Mapper->GetInput());
  fresh->SetEnvironment(this->Environment);
  fresh->SetBRDF(brdf);
  fresh->SetIntegrator(table);
  fresh->SetOcclusionModeToOn();
  fresh->SetOcclusionBounce(true);
  this->Actor->SetMapper(fresh);
  EXPECT_EQ(hidden.RGBA, this->RenderLinear().RGBA);
}

// AbortPlanning is about a Render, not about one of its plans.
TEST_F(LimitsTest, AnAbortIsForAllMaterials)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(2, 2);
  plane->Update();
  vtkNew<vtkPolyData> surface;
  surface->ShallowCopy(plane->GetOutput());
  vtkNew<vtkIntArray> classes;
  classes->SetName("class");
  vtkNew<vtkMaterialMap> map;
  map->SetArrayName("class");
  for (int k = 0; k < 4; ++k)
  {
    classes->InsertNextValue(k);
    vtkNew<vtkAshikhminShirleyBRDF> brdf;
    brdf->SetExponents(20.0 + k, 20.0 + k);
    map->AddMaterial(brdf);
  }
  surface->GetCellData()->AddArray(classes);
  this->Mapper->SetInputData(surface);
  this->Mapper->SetBRDF(nullptr);
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetOcclusionModeToOff();
  this->Mapper->SetMaterialMap(map);
  this->Mapper->SetPlanningModeToForeground();
  struct Stop
  {
    static void Now(vtkObject* mapper, unsigned long, void* self, void*)
    {
      int& count = *static_cast<int*>(self);
      if (++count == 1)
      {
        static_cast<vtkMeasuredBRDFMapper*>(mapper)->SetAbortPlanning(true);
      }
    }
  };
  int asked = 0;
  vtkNew<vtkCallbackCommand> stop;
  stop->SetClientData(&asked);
  stop->SetCallback(Stop::Now);
  this->Mapper->AddObserver(vtkCommand::ProgressEvent, stop);
  const EventCounter errors(this->Mapper, vtkCommand::ErrorEvent);
  this->RenderLinear();
  EXPECT_TRUE(this->Mapper->GetAbortPlanning());
  EXPECT_EQ(errors.Count, 4) << errors.Text;
  EXPECT_EQ(this->Mapper->GetCurrentPlanner(), nullptr);
}
