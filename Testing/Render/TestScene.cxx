// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What the rest of a VTK scene does with a measured surface: textures, colors, tangents, PBR
// properties, back faces, texture units, redraw, edges, other people's shader replacements.
#include "EventCounter.h"
#include "RenderFixture.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkShaderProperty.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"
#include "vtkTexture.h"
#include "vtkTransform.h"

#include <array>
#include <string>

namespace
{
constexpr double Albedo = 0.6;

/// A square that fills the picture, seen head-on, under light of radiance 1 from everywhere.
class Scene : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->Plane->SetOrigin(-1.0, -1.0, 0.0);
    this->Plane->SetPoint1(1.0, -1.0, 0.0);
    this->Plane->SetPoint2(-1.0, 1.0, 0.0);
    this->Plane->Update();
    this->Data->ShallowCopy(this->Plane->GetOutput());
    this->White->SetPixels(32, 16, std::vector<float>(3 * 32 * 16, 1.0f));
    this->Lambert->SetAlbedo(Albedo, Albedo, Albedo);
    this->Measured->SetInputData(this->Data);
    this->Measured->SetBRDF(this->Lambert);
    this->Measured->SetEnvironment(this->White);
    this->Actor->SetMapper(this->Measured);
    this->Renderer->AddActor(this->Actor);
  }

  /// Linear RGB of the middle, which is white furnace times what colors it.
  std::array<float, 3> RenderMiddle()
  {
    const FloatImage image = this->RenderLinear();
    const float* pixel = image.At(32, 32);
    return { pixel[0], pixel[1], pixel[2] };
  }

  static vtkSmartPointer<vtkTexture> MakeTexture(unsigned char r, unsigned char g, unsigned char b)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(2, 2, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* values = static_cast<unsigned char*>(image->GetScalarPointer());
    for (int k = 0; k < 4; ++k)
    {
      values[3 * k] = r;
      values[3 * k + 1] = g;
      values[3 * k + 2] = b;
    }
    auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(image);
    return texture;
  }

  void AddTangents(double x, double y, double z)
  {
    vtkNew<vtkFloatArray> tangents;
    tangents->SetNumberOfComponents(3);
    for (vtkIdType k = 0; k < this->Data->GetNumberOfPoints(); ++k)
    {
      tangents->InsertNextTuple3(x, y, z);
    }
    this->Data->GetPointData()->SetTangents(tangents);
  }

  vtkNew<vtkPlaneSource> Plane;
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkEnvironment> White;
  vtkNew<vtkLambertBRDF> Lambert;
  vtkNew<vtkMeasuredBRDFMapper> Measured;
  vtkNew<vtkActor> Actor;
};

double Decode(double display) { return std::pow(display, 2.2); }
}

// The actor's texture multiplies radiance, as what it is: display colors, or, where it says so,
// sRGB, which OpenGL makes linear.
TEST_F(Scene, TexturesMultiplyLinearly)
{
  vtkSmartPointer<vtkTexture> texture = MakeTexture(255, 188, 0);
  this->Actor->SetTexture(texture);
  std::array<float, 3> middle = this->RenderMiddle();
  EXPECT_NEAR(middle[0], Albedo, 2e-3);
  EXPECT_NEAR(middle[1], Albedo * Decode(188.0 / 255.0), 2e-3);
  EXPECT_NEAR(middle[2], 0.0, 1e-6);

  texture = MakeTexture(255, 188, 0);
  texture->UseSRGBColorSpaceOn();
  this->Actor->SetTexture(texture);
  middle = this->RenderMiddle();
  EXPECT_NEAR(middle[0], Albedo, 2e-3);
  EXPECT_NEAR(middle[1], Albedo * 0.5029, 4e-3); // sRGB's 188
  EXPECT_NEAR(middle[2], 0.0, 1e-6);
}

// Textures of VTK's PBR that cannot color a measured material say so once.
TEST_F(Scene, TexturesWithoutEffectSaySo)
{
  this->Actor->GetProperty()->SetInterpolationToPBR();
  vtkSmartPointer<vtkTexture> base = MakeTexture(10, 20, 30);
  base->UseSRGBColorSpaceOn();
  this->Actor->GetProperty()->SetBaseColorTexture(base);
  this->Actor->GetProperty()->SetORMTexture(MakeTexture(1, 2, 3));
  EventCounter warnings(this->Measured, vtkCommand::WarningEvent);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->Actor->GetProperty()->SetRoughness(0.1 * frame); // a new shader each time
    EXPECT_NEAR(this->RenderMiddle()[2], Albedo, 2e-3);
  }
  EXPECT_EQ(warnings.Count, 2) << warnings.Text;
}

// Tangents are directions of the surface: a shear turns them, not as normals turn.
TEST_F(Scene, TangentsFollowTheActor)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(400.0, 2.0);
  brushed->SetSpecularScale(1.0, 1.0, 1.0);
  this->Measured->SetBRDF(brushed);
  this->Measured->SetEnvironment(nullptr);
  this->AddSceneLight(2.0, 1.0, 5.0);

  // Stretched by 3 along x, a diagonal tangent lies along (3, 1).
  this->AddTangents(1.0, 1.0, 0.0);
  vtkNew<vtkTransform> stretch;
  stretch->Scale(3.0, 1.0, 1.0);
  this->Actor->SetUserTransform(stretch);
  const std::array<float, 3> stretched = this->RenderMiddle();

  this->Actor->SetUserTransform(nullptr);
  this->AddTangents(3.0, 1.0, 0.0);
  const std::array<float, 3> expected = this->RenderMiddle();
  this->AddTangents(1.0, 3.0, 0.0); // where a normal would point
  const std::array<float, 3> wrong = this->RenderMiddle();
  ASSERT_GT(std::abs(expected[0] - wrong[0]), 0.05f * expected[0]);
  EXPECT_NEAR(stretched[0], expected[0], 1e-3f * expected[0]);
}

// More textures than a graphics card binds at once: one error, and VTK's own shading.
TEST_F(Scene, TooManyTextures)
{
  vtkNew<vtkSumBRDF> sum;
  const int dimensions[3] = { 2, 2, 2 };
  for (int k = 0; k < 33; ++k)
  {
    vtkNew<vtkTabulatedBRDF> table;
    table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions,
      std::vector<float>(24, 0.001f));
    sum->AddTerm(table);
  }
  this->AddHeadlight();
  this->Measured->SetEnvironment(nullptr);
  this->Measured->SetBRDF(sum);
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  for (int frame = 0; frame < 3; ++frame)
  {
    EXPECT_GT(this->RenderMiddle()[0], 0.5f); // the property's white
  }
  EXPECT_EQ(errors.Count, 1) << errors.Text;
  EXPECT_NE(errors.Text.find("texture units"), std::string::npos) << errors.Text;
}

// What draws only what changed asks props when they did; buffers and shaders are another matter.
TEST_F(Scene, RedrawTimeFollowsAppearance)
{
  this->RenderEncoded();
  const auto changes = [this](const char* what, const auto& change)
  {
    const vtkMTimeType before = this->Actor->GetRedrawMTime();
    EXPECT_EQ(this->Actor->GetRedrawMTime(), before) << what;
    change();
    EXPECT_GT(this->Actor->GetRedrawMTime(), before) << what;
  };
  changes("material", [this]() { this->Lambert->SetAlbedo(0.2, 0.2, 0.2); });
  changes("environment", [this]() { this->White->SetRotationY(20.0); });
  changes("tolerance", [this]() { this->Measured->SetErrorTolerance(0.1); });
  changes("another material",
    [this]()
    {
      vtkNew<vtkLambertBRDF> other;
      this->Measured->SetBRDF(other);
    });
  changes("no environment", [this]() { this->Measured->SetEnvironment(nullptr); });
}

// A failure is said and tried once, not in every frame; what changed is tried anew.
TEST_F(Scene, TexturesThatLightNothing)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(8, 4, 1);
  image->AllocateScalars(VTK_FLOAT, 2);
  std::fill_n(static_cast<float*>(image->GetScalarPointer()), 64, 1.0f);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  this->Measured->SetEnvironment(nullptr);
  this->Renderer->SetEnvironmentTexture(texture);
  EventCounter warnings(this->Measured, vtkCommand::WarningEvent);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->RenderEncoded();
  }
  EXPECT_EQ(warnings.Count, 1) << warnings.Text;
  EXPECT_NE(warnings.Text.find("2 components"), std::string::npos) << warnings.Text;
}

// Mappers that hold the same material and environment draw with the same textures.
TEST_F(Scene, LightsAreUploadedOnce)
{
  this->Measured->SetIntegrator(vtkNew<vtkLightSetRadianceIntegrator>());
  const auto countTextures = [this]()
  {
    // OpenGL hands out names one after the other.
    vtkNew<vtkTextureObject> probe;
    probe->SetContext(vtkOpenGLRenderWindow::SafeDownCast(this->Window));
    probe->Create2D(1, 1, 4, VTK_FLOAT, false);
    return probe->GetHandle();
  };
  this->RenderEncoded();
  const unsigned int before = countTextures();
  std::vector<vtkSmartPointer<vtkActor>> actors;
  for (int k = 0; k < 20; ++k)
  {
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    mapper->ShallowCopy(this->Measured);
    actors.push_back(vtkSmartPointer<vtkActor>::New());
    actors.back()->SetMapper(mapper);
    this->Renderer->AddActor(actors.back());
  }
  this->RenderEncoded();
  EXPECT_LE(countTextures(), before + 3);
}

// A user's own lines after the lighting may read what VTK's lighting would have left there.
TEST_F(Scene, ReplacementsReadWhatStockShadersHave)
{
  this->AddHeadlight();
  this->Actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", false,
    "//VTK::Light::Impl\n"
    "  gl_FragData[0] = vec4(0.5 * (diffuse + specular), opacity);\n",
    false);
  const double encoded = std::pow(Albedo + Albedo / 3.14159265, 1.0 / 2.2);
  EXPECT_NEAR(this->RenderEncoded().At(32, 32)[0], 0.5 * encoded, 2e-3);
}
