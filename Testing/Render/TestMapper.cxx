// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The mapper as a citizen of VTK: what changes when, and what stays as the stock mapper has it.
#include "../Unit/Support/AnisotropicWarp.h"
#include "../Unit/Support/GatedBRDF.h"
#include "../Unit/Support/SpherePairs.h"
#include "RenderFixture.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkHardwareSelector.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkSelection.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkShadowMapPass.h"
#include "vtkSkybox.h"
#include "vtkTabulatedBRDF.h"
#include "vtkTransform.h"

#include <glm/glm.hpp>

#include <atomic>
#include <new>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>

namespace
{
/// Lets tests see what VTK keeps protected.
class OpenMapper : public vtkMeasuredBRDFMapper
{
public:
  static OpenMapper* New();
  vtkTypeMacro(OpenMapper, vtkMeasuredBRDFMapper);
  int Builds = 0;
  OpenMapper()
  {
    this->Lights->SetGenerator(vtkNew<vtkLightSetGenerator>());
    this->SetIntegrator(this->Lights);
  }
  vtkNew<vtkLightSetRadianceIntegrator> Lights; // what it draws, until SetIntegrator
  vtkLightSet* GetCurrentLightSet()
  {
    auto* lights = vtkLightSetRadianceIntegrator::SafeDownCast(this->GetCurrentIntegrator());
    return lights ? lights->GetCurrentLightSet() : nullptr;
  }
  std::string GetFragmentShader()
  {
    return this->Primitives[PrimitiveTris].Program->GetFragmentShader()->GetSource();
  }

protected:
  void BuildShaders(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override
  {
    ++this->Builds;
    this->Superclass::BuildShaders(shaders, ren, act);
  }
};
vtkStandardNewMacro(OpenMapper);

/// A colored map with a few bright spots, without symmetries.
vtkSmartPointer<vtkEnvironment> MakeEnvironment(int width = 64, int height = 32)
{
  std::mt19937 random(3);
  std::vector<float> rgb;
  for (int k = 0; k < width * height; ++k)
  {
    const float v = static_cast<float>(random() % 1000) / 1000.0f;
    const float spot = random() % 97 == 0 ? 40.0f : 0.0f;
    rgb.insert(rgb.end(), { v + spot, 0.5f * v + spot, 0.3f + 0.2f * v });
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  environment->SetPixels(width, height, rgb);
  return environment;
}

/// Radiance that differs between every octant, so that a wrong axis shows.
vtkSmartPointer<vtkEnvironment> MakeOctants(float scale = 1.0f)
{
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  std::vector<float> rgb;
  for (int y = 0; y < 16; ++y)
  {
    for (int x = 0; x < 32; ++x)
    {
      rgb.push_back(scale * (0.1f + 0.9f * (y >= 8)));
      rgb.push_back(scale * (0.1f + 0.9f * (x >= 16)));
      rgb.push_back(scale * (0.1f + 0.9f * (x % 16 >= 8)));
    }
  }
  environment->SetPixels(32, 16, rgb);
  return environment;
}

vtkSmartPointer<vtkTexture> MakeTexture(vtkEnvironment* environment)
{
  auto image = vtkSmartPointer<vtkImageData>::Take(environment->NewImageData());
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->SetColorModeToDirectScalars();
  texture->MipmapOn();
  texture->InterpolateOn();
  return texture;
}

class Mapper : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->Sphere->SetThetaResolution(48);
    this->Sphere->SetPhiResolution(48);
    this->Sphere->SetRadius(0.9);
    this->Measured->SetInputConnection(this->Sphere->GetOutputPort());
    this->Stock->SetInputConnection(this->Sphere->GetOutputPort());
    this->Actor->SetMapper(this->Measured);
    this->Renderer->AddActor(this->Actor);
    this->Phong->SetSpecular(0.3, 0.2, 0.1);
    this->Phong->SetExponent(20.0);
  }

  FloatImage RenderWith(vtkPolyDataMapper* mapper)
  {
    this->Actor->SetMapper(mapper);
    return this->RenderEncoded();
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<OpenMapper> Measured;
  vtkNew<vtkPolyDataMapper> Stock;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkLambertBRDF> Lambert;
  vtkNew<vtkBlinnPhongBRDF> Phong;
};
}

TEST_F(Mapper, WithoutMaterialIsStock)
{
  this->AddHeadlight();
  this->Actor->GetProperty()->SetColor(0.8, 0.5, 0.2);
  this->Actor->GetProperty()->SetSpecular(0.4);
  EXPECT_EQ(
    GetLargestDifference(this->RenderWith(this->Measured), this->RenderWith(this->Stock)), 0.0);
  // Also after a material came and went.
  this->Measured->SetBRDF(this->Lambert);
  EXPECT_GT(
    GetLargestDifference(this->RenderWith(this->Measured), this->RenderWith(this->Stock)), 0.01);
  this->Measured->SetBRDF(nullptr);
  EXPECT_EQ(
    GetLargestDifference(this->RenderWith(this->Measured), this->RenderWith(this->Stock)), 0.0);
  EXPECT_EQ(this->Measured->GetTextureBytes(), 0);
}

TEST_F(Mapper, SceneLights)
{
  // A plane facing the camera: the center pixel's radiance in closed form.
  vtkNew<vtkPlaneSource> plane;
  this->Measured->SetInputConnection(plane->GetOutputPort());
  this->Measured->SetBRDF(this->Lambert);
  this->Lambert->SetAlbedo(0.9, 0.6, 0.3);
  const double pi = 3.141592653589793;
  const auto check = [&](vtkLight* light, double cosine, double scale)
  {
    this->Renderer->RemoveAllLights();
    this->Renderer->AddLight(light);
    light->SetDiffuseColor(1.0, 0.5, 0.0);
    const FloatImage image = this->RenderLinear();
    const float* pixel = image.At(32, 32);
    EXPECT_NEAR(pixel[0], 0.9 / pi * cosine * scale, 2e-3 * scale);
    EXPECT_NEAR(pixel[1], 0.6 / pi * cosine * scale * 0.5, 2e-3 * scale);
    EXPECT_NEAR(pixel[2], 0.0, 1e-6);
  };
  const auto headlight = this->AddHeadlight(2.0);
  check(headlight, 1.0, 2.0);
  check(this->AddSceneLight(3.0, 0.0, 4.0), 0.8, 1.0);
  const auto camera = this->AddSceneLight(0.0, 1.0, 1.0); // 45 degrees above the line of sight
  camera->SetLightTypeToCameraLight();
  check(camera, std::sqrt(0.5), 1.0);
  const auto positional = this->AddSceneLight(3.0, 0.0, 4.0, 180.0);
  positional->SetAttenuationValues(0.0, 0.0, 1.0); // 1/d^2, d = 5
  positional->SetIntensity(25.0);
  check(positional, 0.8, 1.0);
  const auto spot = this->AddSceneLight(0.0, 0.0, 2.0, 10.0);
  spot->SetExponent(0.0);
  check(spot, 1.0, 1.0);
  const FloatImage image = this->RenderLinear();
  EXPECT_EQ(image.At(48, 32)[0], 0.0f); // half the plane's width off axis: outside the cone

  // Two lights at once add up.
  this->Renderer->AddLight(headlight);
  EXPECT_NEAR(this->RenderLinear().At(32, 32)[0], 3.0 * 0.9 / pi, 5e-3);
}

// A cube map of the renderer lights from where vtkSkybox shows its faces (that changed between VTK
// versions), and is converted once.
TEST_F(Mapper, CubeMapTexture)
{
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->CubeMapOn();
  texture->SetColorModeToDirectScalars();
  const float colors[6][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 0 }, { 1, 0, 1 },
    { 0, 1, 1 } };
  for (int face = 0; face < 6; ++face)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(16, 16, 1);
    image->AllocateScalars(VTK_FLOAT, 3);
    for (int k = 0; k < 256; ++k)
    {
      // The first rows are brighter: which way up a face is counts, too.
      for (int c = 0; c < 3; ++c)
      {
        image->SetScalarComponentFromFloat(
          k % 16, k / 16, 0, c, (k < 128 ? 1.0f : 0.25f) * colors[face][c]);
      }
    }
    texture->SetInputDataObject(face, image);
  }
  this->Measured->SetBRDF(this->Lambert);
  this->Measured->Lights->SetNumberOfLights(1024);
  this->Renderer->SetEnvironmentTexture(texture);
  const FloatImage lit = this->RenderLinear();
  EXPECT_GT(lit.At(32, 32)[0] + lit.At(32, 32)[1] + lit.At(32, 32)[2], 0.5f);
  vtkLightSet* lights = this->Measured->GetCurrentLightSet();
  this->RenderLinear();
  EXPECT_EQ(this->Measured->GetCurrentLightSet(), lights);

  vtkNew<vtkSkybox> sky;
  sky->SetTexture(texture);
  sky->SetProjectionToCube();
  this->Renderer->RemoveActor(this->Actor);
  this->Renderer->AddActor(sky);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->ParallelProjectionOff();
  camera->SetPosition(0.0, 0.0, 0.0);
  for (int axis = 0; axis < 6; ++axis)
  {
    double d[3] = { 0.0, 0.0, 0.0 };
    d[axis / 2] = axis % 2 ? -1.0 : 1.0;
    camera->SetFocalPoint(d);
    camera->SetViewUp(0.0, axis / 2 == 1 ? 0.0 : 1.0, axis / 2 == 1 ? 1.0 : 0.0);
    camera->SetClippingRange(0.1, 20.0);
    camera->SetViewAngle(90.0);
    const FloatImage view = this->RenderEncoded();
    // Light from within 20 degrees of there has the color that is seen there.
    double sum[3] = { 0.0, 0.0, 0.0 };
    double halves[2] = { 0.0, 0.0 }; // towards the view's up, and down
    for (int k = 0; k < lights->GetNumberOfLights(); ++k)
    {
      double from[3];
      double irradiance[3];
      lights->GetDirection(k, from);
      lights->GetIrradiance(k, irradiance);
      for (int c = 0; vtkMath::Dot(from, d) > 0.94 && c < 3; ++c)
      {
        sum[c] += irradiance[c];
        halves[vtkMath::Dot(from, camera->GetViewUp()) > 0.0 ? 0 : 1] += irradiance[c];
      }
    }
    const double largest = std::max({ sum[0], sum[1], sum[2] });
    EXPECT_GT(largest, 0.0) << axis;
    const auto shade = [&view](int y)
    { return view.At(32, y)[0] + view.At(32, y)[1] + view.At(32, y)[2]; };
    EXPECT_EQ(halves[0] > halves[1], shade(40) > shade(24)) << axis;
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(sum[c] / largest, view.At(32, 40)[c] > 0.1f ? 1.0 : 0.0, 0.05)
        << "axis " << axis << ", channel " << c;
    }
  }
  this->Renderer->RemoveActor(sky);
  this->Renderer->AddActor(this->Actor);

  // A face of another size lights nothing, with one warning, whatever its values are.
  vtkNew<vtkImageData> small;
  small->SetDimensions(8, 8, 1);
  small->AllocateScalars(VTK_FLOAT, 3);
  for (int k = 0; k < 192; ++k)
  {
    small->SetScalarComponentFromFloat(k / 3 % 8, k / 24, 0, k % 3, -1.0f);
  }
  texture->SetInputDataObject(3, small);
  EventCounter warnings(this->Measured, vtkCommand::WarningEvent);
  EXPECT_EQ(this->RenderLinear().At(32, 32)[1], 0.0f);
  this->RenderLinear();
  EXPECT_EQ(warnings.Count, 1);
}

// Pixels of a tilted plane against the CPU sum over the same lights: rotated, scaled actor,
// perspective or parallel camera away from the axes, rotated environment.
TEST_F(Mapper, LightSetMatchesCpuPerPixel)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1.0, -1.0, 0.0);
  plane->SetPoint1(1.0, -1.0, 0.0);
  plane->SetPoint2(-1.0, 1.0, 0.0);
  vtkNew<vtkPolyDataNormals> normals; // float normals, like real meshes
  normals->SetInputConnection(plane->GetOutputPort());
  this->Measured->SetInputConnection(normals->GetOutputPort());
  this->Measured->SetBRDF(this->Phong);
  vtkSmartPointer<vtkEnvironment> environment = MakeEnvironment();
  environment->SetRotationY(35.0);
  this->Measured->SetEnvironment(environment);
  this->Actor->SetScale(1.5, 0.7, 1.3);
  this->Actor->RotateY(30.0);
  this->Actor->RotateX(-25.0);
  this->Actor->SetPosition(0.1, -0.05, 0.2);
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(this->Actor->GetMatrix());
  double normal[3] = { 0.0, 0.0, 1.0 };
  transform->TransformNormal(normal, normal);

  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(1.0, 0.7, 4.0);
  camera->SetViewAngle(20.0);
  for (const bool parallel : { false, true })
  {
    vtkNew<vtkLightSetGenerator> medianCut, importance;
    importance->SetMethodToImportance();
    for (vtkLightSetGenerator* generator :
      std::initializer_list<vtkLightSetGenerator*>{ medianCut, importance, nullptr })
    {
      const bool soft = !generator; // by variance
      this->Measured->Lights->SetGenerator(generator);
      this->Measured->Lights->SetSoftLights(soft);
      camera->SetParallelProjection(parallel);
      const FloatImage image = this->RenderLinear();

      const glm::dvec3 eye(1.0, 0.7, 4.0);
      const glm::dvec3 forward = glm::normalize(-eye);
      const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
      const glm::dvec3 up = glm::cross(right, forward);
      const glm::dvec3 n(normal[0], normal[1], normal[2]);
      const glm::dvec3 anchor(0.1, -0.05, 0.2);
      const double tangent = std::tan(0.5 * 20.0 * 3.141592653589793 / 180.0);
      vtkNew<vtkDoubleArray> ns, vs, radiance;
      ns->SetNumberOfComponents(3);
      vs->SetNumberOfComponents(3);
      std::vector<const float*> pixels;
      for (int y = 16; y < 48; ++y)
      {
        for (int x = 16; x < 48; ++x)
        {
          const double px = (x + 0.5) / 32.0 - 1.0, py = (y + 0.5) / 32.0 - 1.0;
          glm::dvec3 view = -forward;
          if (!parallel)
          {
            const glm::dvec3 ray = forward + tangent * (px * right + py * up);
            const glm::dvec3 hit = eye + ray * (glm::dot(anchor - eye, n) / glm::dot(ray, n));
            view = glm::normalize(eye - hit);
          }
          ns->InsertNextTuple3(n.x, n.y, n.z);
          vs->InsertNextTuple3(view.x, view.y, view.z);
          pixels.push_back(image.At(x, y));
        }
      }
      vtkNew<vtkLightSetRadianceIntegrator> integrator;
      integrator->SetBRDF(this->Phong);
      integrator->SetEnvironment(environment);
      integrator->SetLightSet(this->Measured->GetCurrentLightSet());
      integrator->SetSoftLights(soft);
      ASSERT_TRUE(integrator->Integrate(ns, vs, radiance));
      double worst = 0.0;
      for (std::size_t k = 0; k < pixels.size(); ++k)
      {
        for (int c = 0; c < 3; ++c)
        {
          const double expected = radiance->GetComponent(static_cast<vtkIdType>(k), c);
          worst = std::max(worst, std::abs(pixels[k][c] - expected) / expected);
        }
      }
      std::cout << (parallel ? "parallel" : "perspective")
                << (soft ? ", soft lights" : ", hard lights") << ": largest relative difference "
                << worst << "\n";
      EXPECT_LT(worst, 1e-4);
    }
  }
}

// What changes shows at the next Render; no new shader where a uniform will do.
TEST_F(Mapper, RebuildsExactlyWhenItMust)
{
  vtkSmartPointer<vtkEnvironment> environment = MakeOctants();
  this->Measured->SetEnvironment(environment);
  this->Measured->SetBRDF(this->Phong);
  FloatImage last = this->RenderEncoded();
  const int builds = this->Measured->Builds;
  const auto expectChange = [&](const char* what, int newBuilds)
  {
    const int before = this->Measured->Builds;
    const FloatImage now = this->RenderEncoded();
    EXPECT_GT(GetLargestDifference(now, last), 1e-3) << what;
    EXPECT_EQ(this->Measured->Builds - before, newBuilds) << what;
    last = now;
  };
  EXPECT_EQ(GetLargestDifference(this->RenderEncoded(), last), 0.0);
  EXPECT_EQ(this->Measured->Builds, builds);

  this->Phong->SetExponent(3.0);
  expectChange("a parameter of the material", 0);
  this->Measured->Lights->SetNumberOfLights(4);
  expectChange("the number of lights", 0);
  vtkNew<vtkLightSetGenerator> importance;
  importance->SetMethodToImportance();
  this->Measured->Lights->SetGenerator(importance);
  expectChange("the method", 0);
  importance->SetSeed(5);
  expectChange("the seed", 0);
  this->Measured->Lights->SetGenerator(nullptr);
  expectChange("the method", 0);
  this->Measured->Lights->SetNumberOfLights(3);
  expectChange("the number of lights", 0);
  vtkLightSet* sameLights = this->Measured->GetCurrentLightSet();
  EXPECT_EQ(sameLights->GetNumberOfLights(), 3);
  this->Measured->Lights->SoftLightsOn();
  expectChange("soft lights", 1);
  environment->SetRotationY(90.0);
  expectChange("the environment's rotation", 0);
  EXPECT_EQ(this->Measured->GetCurrentLightSet(), sameLights);
  this->Measured->Lights->SoftLightsOff();
  expectChange("hard lights", 1);
  double right[3] = { 0.0, 0.0, 1.0 };
  this->Renderer->SetEnvironmentRight(right);
  expectChange("the renderer's environment frame", 0);
  environment->SetPixels(32, 16, MakeOctants(3.0f)->GetPixels());
  expectChange("the environment's pixels", 0);
  this->Measured->SetEnvironment(MakeEnvironment());
  expectChange("another environment", 0);
  vtkNew<vtkBlinnPhongBRDF> other;
  this->Measured->SetBRDF(other);
  expectChange("another material of the same kind", 0);
  this->Measured->SetBRDF(this->Lambert);
  expectChange("another kind of material", 1);
  vtkNew<vtkLightSet> lights;
  const double direction[3] = { 0.0, 0.0, 1.0 };
  const double irradiance[3] = { 0.3, 0.2, 0.1 };
  lights->AddLight(direction, irradiance);
  this->Measured->Lights->SetLightSet(lights);
  expectChange("a light set", 0);
  lights->AddLight(direction, irradiance);
  expectChange("a light more in it", 0);
  this->AddHeadlight();
  expectChange("a light in the scene", 1);

  // A texture of the renderer whose image changes.
  this->Measured->Lights->SetLightSet(nullptr);
  this->Measured->SetEnvironment(nullptr);
  vtkSmartPointer<vtkTexture> texture = MakeTexture(MakeOctants());
  this->Renderer->SetEnvironmentTexture(texture);
  last = this->RenderEncoded();
  vtkImageData* image = texture->GetInput();
  float* values = static_cast<float*>(image->GetScalarPointer());
  std::fill(values, values + 3 * 32 * 16, 2.0f);
  image->Modified();
  const FloatImage now = this->RenderEncoded();
  EXPECT_GT(GetLargestDifference(now, last), 1e-3);
}

// Tables are uploaded at several widths for soft lights, and for nobody else.
TEST_F(Mapper, SoftLightsOfTablesCostHardOnesNothing)
{
  this->Phong->SetExponent(100.0);
  vtkNew<vtkBRDFResampler> resampler;
  resampler->SetInput(this->Phong);
  ASSERT_TRUE(resampler->ResampleTo(8, 16, 40));
  this->Measured->SetBRDF(resampler->GetOutput());
  this->Measured->SetEnvironment(MakeOctants());
  this->Measured->Lights->SetGenerator(nullptr);
  const FloatImage hard = this->RenderLinear();
  const vtkIdType bytes = this->Measured->GetTextureBytes();
  EXPECT_EQ(this->Measured->GetFragmentShader().find("brdfLevels"), std::string::npos);
  this->Measured->Lights->SoftLightsOn();
  EXPECT_GT(GetLargestDifference(this->RenderLinear(), hard), 1e-3);
  EXPECT_GT(this->Measured->GetTextureBytes(), bytes);
  EXPECT_NE(this->Measured->GetFragmentShader().find("brdfLevels"), std::string::npos);
  this->Measured->Lights->SoftLightsOff();
  EXPECT_EQ(GetLargestDifference(this->RenderLinear(), hard), 0.0);
  EXPECT_EQ(this->Measured->GetTextureBytes(), bytes);
}

TEST_F(Mapper, RotatingEverythingChangesNothing)
{
  this->Measured->SetBRDF(this->Phong);
  vtkSmartPointer<vtkEnvironment> environment = MakeEnvironment();
  this->Measured->SetEnvironment(environment);
  this->Measured->Lights->SetNumberOfLights(256);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->ParallelProjectionOff();
  camera->SetViewAngle(25.0);
  this->Actor->SetScale(1.0, 0.6, 0.8);
  const FloatImage before = this->RenderEncoded();
  for (const double angle : { 30.0, 137.0, 250.0 })
  {
    // Camera and object turn by `angle` about +y, the environment with them.
    vtkNew<vtkTransform> turn;
    turn->RotateY(angle);
    double eye[3] = { 0.0, 0.0, 5.0 };
    turn->TransformPoint(eye, eye);
    camera->SetPosition(eye);
    this->Actor->SetOrientation(0.0, angle, 0.0);
    environment->SetRotationY(angle);
    EXPECT_LT(GetLargestDifference(this->RenderEncoded(), before), 1.0 / 255.0) << angle;
    // The same by the renderer's own axes.
    environment->SetRotationY(0.0);
    double right[3] = { 1.0, 0.0, 0.0 };
    turn->TransformVector(right, right);
    this->Renderer->SetEnvironmentRight(right);
    EXPECT_LT(GetLargestDifference(this->RenderEncoded(), before), 1.0 / 255.0) << angle;
    right[0] = 1.0;
    right[1] = right[2] = 0.0;
    this->Renderer->SetEnvironmentRight(right);
  }
}

TEST_F(Mapper, ManyLightsAndHugeValues)
{
  // A sun of 2e5 x the mean, above half float's range; 8192 lights.
  vtkSmartPointer<vtkEnvironment> environment = MakeEnvironment(256, 128);
  std::vector<float> rgb = environment->GetPixels();
  rgb[3 * (90 * 256 + 30)] = 222208.0f;
  environment->SetPixels(256, 128, rgb);
  this->Measured->SetEnvironment(environment);
  this->Measured->SetBRDF(this->Phong);
  this->Measured->Lights->SetNumberOfLights(8192);
  const FloatImage image = this->RenderEncoded();
  for (float v : image.RGBA)
  {
    ASSERT_TRUE(std::isfinite(v) && v >= 0.0f);
  }
  EXPECT_GT(this->Measured->GetCurrentLightSet()->GetNumberOfLights(), 4096);
  EXPECT_GT(image.At(32, 32)[0], 0.0f);
}

TEST_F(Mapper, SecondWindowAndRelease)
{
  this->Measured->SetBRDF(this->Phong);
  this->Measured->SetEnvironment(MakeOctants());
  const FloatImage first = this->RenderEncoded();
  {
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkRenderer> renderer;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(64, 64);
    window->AddRenderer(renderer);
    renderer->SetAutomaticLightCreation(false);
    renderer->AddActor(this->Actor);
    renderer->SetActiveCamera(this->Renderer->GetActiveCamera());
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetRGBACharPixelData(0, 0, 63, 63, 0, pixels);
    const double shown = pixels->GetComponent(32 * 64 + 32, 1) / 255.0;
    EXPECT_NEAR(shown, std::min(first.At(32, 32)[1], 1.0f), 2.0 / 255.0);
    renderer->RemoveActor(this->Actor);
    this->Measured->ReleaseGraphicsResources(window);
  }
  EXPECT_EQ(GetLargestDifference(this->RenderEncoded(), first), 0.0);
  this->Measured->ReleaseGraphicsResources(this->Window);
  this->Measured->ReleaseGraphicsResources(this->Window);
  EXPECT_EQ(GetLargestDifference(this->RenderEncoded(), first), 0.0);
}

TEST_F(Mapper, ShaderTextIsWhole)
{
  this->Measured->SetBRDF(this->Phong);
  this->Measured->SetEnvironment(MakeOctants());
  this->RenderEncoded();
  const std::string text = this->Measured->GetFragmentShader();
  EXPECT_NE(text.find("brdfMember0Environment(brdfViewToEnvironment"), std::string::npos);
  // Nothing of scalars where there are none: software renderers run both sides of conditions.
  for (const char* left : { "//VTK::MeasuredBRDF", "INSTANCE", "brdfModulate > 1" })
  {
    EXPECT_EQ(text.find(left), std::string::npos) << left;
  }
}

TEST_F(Mapper, WarnsOncePerCause)
{
  EventCounter warnings(this->Measured, vtkCommand::WarningEvent);
  vtkNew<vtkAshikhminShirleyBRDF> anisotropic;
  anisotropic->SetExponents(10.0, 200.0);
  this->Measured->SetBRDF(anisotropic); // a sphere source has no tangents
  this->Measured->SetEnvironment(MakeOctants());
  this->Measured->Lights->SetNumberOfLights(48); // not a power of two
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->RenderEncoded();
  }
  EXPECT_EQ(warnings.Count, 0);
  EXPECT_EQ(errors.Count, 1) << errors.Text;
  EXPECT_NE(errors.Text.find("power of two"), std::string::npos) << errors.Text;
  this->Measured->Lights->SetNumberOfLights(64);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->RenderEncoded();
  }
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_EQ(errors.Count, 1);
}

namespace
{
/// Counts evaluations: what planning costs and a frame must not.
class CountingPhong : public vtkBlinnPhongBRDF
{
public:
  static CountingPhong* New();
  vtkTypeMacro(CountingPhong, vtkBlinnPhongBRDF);
  int Take() { return this->Count.exchange(0); }

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    ++this->Count;
    this->Superclass::EvaluateAbove(i, o, f);
  }
  std::atomic<int> Count{ 0 };
};
vtkStandardNewMacro(CountingPhong);

/// The mapper as it comes: integration planned.
class Auto : public Mapper
{
protected:
  void SetUpScene() override
  {
    Mapper::SetUpScene();
    this->Measured->SetIntegrator(nullptr);
    this->Phong->SetExponent(10.0);
    this->Measured->SetBRDF(this->Phong);
    this->Measured->SetEnvironment(this->Light);
  }

  vtkSmartPointer<vtkEnvironment> Light = MakeEnvironment();
};
}

// Planning is for the first frame; others with the same material and light take the plan over.
TEST_F(Auto, PlansOnce)
{
  vtkNew<CountingPhong> counting;
  counting->SetExponent(10.0);
  this->Measured->SetBRDF(counting);
  EXPECT_EQ(this->Measured->GetPlan(), "");
  const FloatImage first = this->RenderEncoded();
  const std::string plan = this->Measured->GetPlan();
  EXPECT_NE(plan, "");
  EXPECT_GT(counting->Take(), 1000);
  EXPECT_EQ(GetLargestDifference(this->RenderEncoded(), first), 0.0);
  EXPECT_EQ(counting->Take(), 0) << "a second frame";
  const int builds = this->Measured->Builds;

  vtkNew<OpenMapper> other;
  other->SetIntegrator(nullptr);
  other->SetInputConnection(this->Sphere->GetOutputPort());
  other->SetBRDF(counting);
  other->SetEnvironment(this->Light);
  EXPECT_EQ(GetLargestDifference(this->RenderWith(other), first), 0.0);
  EXPECT_EQ(counting->Take(), 0) << "another mapper";
  EXPECT_EQ(other->GetPlan(), plan);

  // A turn of the light costs nothing.
  this->Light->SetRotationY(70.0);
  const FloatImage turned = this->RenderWith(this->Measured);
  EXPECT_GT(GetLargestDifference(turned, first), 1e-2);
  EXPECT_EQ(counting->Take(), 0) << "a rotation";
  EXPECT_EQ(this->Measured->GetPlan(), plan);
  EXPECT_EQ(this->Measured->Builds, builds);

  // Changes show at the next Render.
  counting->SetExponent(4.0);
  const FloatImage rougher = this->RenderEncoded();
  EXPECT_GT(GetLargestDifference(rougher, turned), 1e-2);
  EXPECT_GT(counting->Take(), 1000);
  this->Light->SetPixels(32, 16, MakeOctants()->GetPixels());
  EXPECT_GT(GetLargestDifference(this->RenderEncoded(), rougher), 1e-2);
  EXPECT_GT(counting->Take(), 1000);
  EXPECT_EQ(this->Measured->Builds, builds);
  this->RenderEncoded();
  EXPECT_EQ(counting->Take(), 0);
}

TEST_F(Auto, TolerancesAreClampedWithAWarning)
{
  EventCounter warnings(this->Measured, vtkCommand::WarningEvent);
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  this->Measured->SetErrorTolerance(0.03);
  EXPECT_EQ(warnings.Count, 0);
  this->Measured->SetErrorTolerance(0.0);
  EXPECT_EQ(this->Measured->GetErrorTolerance(), 1e-3);
  this->Measured->SetErrorTolerance(5.0);
  EXPECT_EQ(this->Measured->GetErrorTolerance(), 1.0);
  EXPECT_EQ(warnings.Count, 2);
  EXPECT_NE(warnings.Text.find("is taken"), std::string::npos);
  EXPECT_EQ(errors.Count, 0);

  // What is no number, and what is no mode, leaves things as they are.
  this->Measured->SetErrorTolerance(std::nan(""));
  EXPECT_EQ(this->Measured->GetErrorTolerance(), 1.0);
  this->Measured->SetPlanningMode(3);
  this->Measured->SetScalarColoringMode(2);
  EXPECT_EQ(errors.Count, 3);
}

// Maps of the sharp part cannot hold an anisotropic material: said once, drawn as the superclass
// does, mended by taking either away.
TEST_F(Auto, AnIntegratorThatRefuses)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(5.0, 20.0);
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetNumberOfRows(9);
  table->SetNumberOfMaps(2);
  this->Measured->SetBRDF(brushed);
  this->Measured->SetIntegrator(table);
  EventCounter warnings(this->Measured, vtkCommand::WarningEvent); // there are no tangents
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  EventCounter reasons(table, vtkCommand::ErrorEvent); // the mapper gives the reason
  for (int frame = 0; frame < 3; ++frame)
  {
    this->RenderEncoded();
  }
  EXPECT_EQ(errors.Count, 1) << errors.Text;
  EXPECT_NE(errors.Text.find("isotropic"), std::string::npos) << errors.Text;
  EXPECT_EQ(reasons.Count, 0) << reasons.Text;
  this->Measured->SetBRDF(this->Phong);
  EXPECT_GT(this->RenderLinear().At(32, 32)[0], 0.01f);
  EXPECT_EQ(this->Measured->GetPlan(), "");
  this->Measured->SetIntegrator(nullptr);
  this->Measured->SetBRDF(brushed);
  EXPECT_GT(this->RenderLinear().At(32, 32)[0], 0.01f);
  EXPECT_EQ(errors.Count, 1) << errors.Text;
  EXPECT_EQ(reasons.Count, 0) << reasons.Text;
}

// The program's integrator stays as it is, whatever draws by it.
TEST_F(Auto, OneIntegratorServesManyMaterials)
{
  const auto drawBy = [this](vtkBRDF* brdf, vtkRadianceIntegrator* integrator)
  {
    this->Measured->SetBRDF(brdf);
    this->Measured->SetIntegrator(integrator);
    return this->RenderEncoded();
  };
  vtkNew<vtkTableRadianceIntegrator> shared;
  shared->SetNumberOfRows(17);
  const vtkMTimeType time = shared->GetMTime();
  for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(this->Phong), static_cast<vtkBRDF*>(this->Lambert) })
  {
    vtkNew<vtkTableRadianceIntegrator> own;
    own->SetNumberOfRows(17);
    own->SetBRDF(brdf);
    own->SetEnvironment(this->Light);
    const FloatImage expected = drawBy(brdf, own);
    EXPECT_EQ(this->Measured->GetCurrentIntegrator(), own.Get()); // drawn as it is
    EXPECT_EQ(drawBy(brdf, shared).RGBA, expected.RGBA);
    EXPECT_NE(this->Measured->GetCurrentIntegrator(), shared.Get());
  }
  EXPECT_EQ(shared->GetMTime(), time);
  EXPECT_EQ(shared->GetBRDF(), nullptr);
  EXPECT_EQ(shared->GetEnvironment(), nullptr);

  // Mappers with one material share the copy; a property that changes shows in the next frame.
  vtkRadianceIntegrator* copy = this->Measured->GetCurrentIntegrator();
  vtkNew<OpenMapper> other;
  other->SetInputConnection(this->Sphere->GetOutputPort());
  other->SetBRDF(this->Lambert);
  other->SetEnvironment(this->Light);
  other->SetIntegrator(shared);
  this->RenderWith(other);
  EXPECT_EQ(other->GetCurrentIntegrator(), copy);
  this->Actor->SetMapper(this->Measured);
  const FloatImage before = drawBy(this->Phong, shared);
  shared->SetNumberOfRows(9);
  EXPECT_GT(GetLargestDifference(this->RenderEncoded(), before), 1e-4);
}

// An observer stops what Render plans: a small table stands in until something changes.
TEST_F(Auto, PlanningCanBeStopped)
{
  struct Stopper
  {
    vtkMeasuredBRDFMapper* Mapper;
    int Calls = 0;
    void Stop(vtkObject*, unsigned long, void* share)
    {
      if (*static_cast<double*>(share) < 1.0)
      {
        ++this->Calls;
        this->Mapper->SetAbortPlanning(true);
      }
    }
  } stopper{ this->Measured };
  this->Measured->SetErrorTolerance(0.002); // several candidates
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  const unsigned long tag =
    this->Measured->AddObserver(vtkCommand::ProgressEvent, &stopper, &Stopper::Stop);
  const FloatImage stopped = this->RenderEncoded();
  EXPECT_EQ(stopper.Calls, 1);
  EXPECT_EQ(errors.Count, 1) << errors.Text;
  EXPECT_NE(errors.Text.find("aborted"), std::string::npos) << errors.Text;
  EXPECT_EQ(this->Measured->GetPlan(), "");
  EXPECT_EQ(this->Measured->GetCurrentPlanner(), nullptr);
  auto* standIn = vtkHybridRadianceIntegrator::SafeDownCast(this->Measured->GetCurrentIntegrator());
  ASSERT_TRUE(standIn);
  EXPECT_EQ(standIn->GetNumberOfRows(), 65);
  EXPECT_EQ(this->RenderEncoded().RGBA, stopped.RGBA);
  EXPECT_EQ(errors.Count, 1);
  this->Measured->RemoveObserver(tag);
  this->Measured->SetErrorTolerance(0.003);
  EXPECT_GT(GetLargestDifference(this->RenderEncoded(), stopped), 1e-3);
  ASSERT_TRUE(this->Measured->GetCurrentPlanner());
  EXPECT_EQ(this->Measured->GetCurrentPlanner()->GetPlan(), this->Measured->GetPlan());
}

// Light comes and goes: black, none, another.
TEST_F(Auto, BlackAndEmptyEnvironments)
{
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  const FloatImage first = this->RenderEncoded();
  vtkNew<vtkEnvironment> black;
  black->SetPixels(16, 8, std::vector<float>(3 * 16 * 8, 0.0f));
  this->Measured->SetEnvironment(black);
  EXPECT_EQ(this->RenderLinear().At(32, 32)[0], 0.0f);
  this->Measured->SetEnvironment(vtkNew<vtkEnvironment>());
  EXPECT_EQ(this->RenderLinear().At(32, 32)[0], 0.0f);
  EXPECT_EQ(this->Measured->GetPlan(), "");
  this->Measured->SetEnvironment(this->Light);
  EXPECT_EQ(GetLargestDifference(this->RenderEncoded(), first), 0.0);
  EXPECT_EQ(errors.Count, 0) << errors.Text;
}

//------------------------------------------------------------------------------
// What the mapper shows while a plan is made on a thread.
namespace
{
class Background : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->Sky->SetToProceduralSky();
    this->BRDF->SetSpecular(0.4, 0.3, 0.2);
    this->BRDF->SetExponent(5.0);
    this->Measured->SetInputConnection(this->Sphere->GetOutputPort());
    this->Measured->SetBRDF(this->BRDF);
    this->Measured->SetEnvironment(this->Sky);
    this->Measured->SetErrorTolerance(0.05);
    this->Actor->SetMapper(this->Measured);
    this->Renderer->AddActor(this->Actor);
    this->AddHeadlight();
  }
  void TearDown() override { this->BRDF->Door->OpenUp(); }

  /// Through a mapper that knows nothing of what was before.
  FloatImage RenderAnew()
  {
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    mapper->SetInputConnection(this->Sphere->GetOutputPort());
    mapper->SetBRDF(this->Measured->GetBRDF());
    mapper->SetEnvironment(this->Measured->GetEnvironment());
    mapper->SetErrorTolerance(this->Measured->GetErrorTolerance());
    this->Actor->SetMapper(mapper);
    const FloatImage image = this->RenderEncoded();
    this->Actor->SetMapper(this->Measured);
    return image;
  }

  bool WaitUntilReady()
  {
    return WaitUntil([this]() { return this->Measured->GetPlanReady(); });
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkEnvironment> Sky;
  vtkNew<GatedBRDF> BRDF;
  vtkNew<vtkMeasuredBRDFMapper> Measured;
  vtkNew<vtkActor> Actor;
};
}

TEST_F(Background, OldPicturesUntilTheNewPlanIsMade)
{
  EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  this->Measured->SetPlanningModeToBackground();
  const FloatImage old = this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_EQ(old.RGBA, this->RenderAnew().RGBA);
  EXPECT_EQ(plans.Count, 1);

  this->BRDF->Door->Close();
  this->BRDF->SetExponent(50.0);
  this->BRDF->SetSpecular(0.1, 0.2, 0.9);
  this->Sky->SetPixels(2, 1, { 1.0f, 0.2f, 0.1f, 0.3f, 1.0f, 0.2f });
  for (int frame = 0; frame < 3; ++frame)
  {
    EXPECT_EQ(this->RenderEncoded().RGBA, old.RGBA);
    EXPECT_TRUE(this->Measured->GetPlanPending());
    EXPECT_FALSE(this->Measured->GetPlanReady());
  }
  EXPECT_EQ(plans.Count, 1);

  // The light that is shown still turns.
  this->Sky->SetRotationY(90.0);
  EXPECT_NE(this->RenderEncoded().RGBA, old.RGBA);
  this->Sky->SetRotationY(0.0);
  EXPECT_EQ(this->RenderEncoded().RGBA, old.RGBA);

  this->BRDF->Door->OpenUp();
  ASSERT_TRUE(this->WaitUntilReady());
  const FloatImage now = this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_EQ(plans.Count, 2);
  EXPECT_NE(now.RGBA, old.RGBA);
  EXPECT_EQ(now.RGBA, this->RenderAnew().RGBA);
}

// Also where the shader changes in between, and with it what the material needs of the data.
TEST_F(Background, AnotherKindOfMaterial)
{
  this->Measured->SetPlanningModeToBackground();
  const FloatImage old = this->RenderEncoded();
  const std::string plan = this->Measured->GetPlan();
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(3.0, 30.0);
  this->Measured->SetBRDF(brushed);
  this->Measured->GlobalWarningDisplayOff(); // of tangents
  EXPECT_EQ(this->RenderEncoded().RGBA, old.RGBA);
  EXPECT_EQ(this->Measured->GetPlan(), plan);
  ASSERT_TRUE(this->WaitUntilReady());
  const FloatImage now = this->RenderEncoded();
  EXPECT_EQ(now.RGBA, this->RenderAnew().RGBA);
  EXPECT_NE(this->Measured->GetPlan(), plan);
  this->Measured->GlobalWarningDisplayOn();
}

namespace
{
// Panels with hard edges in the dark, none of which is a lamp, in 256 x 128 texels.
void SetToPanels(vtkEnvironment* environment)
{
  const int corners[][4] = { { 10, 30, 60, 50 }, { 80, 110, 55, 75 }, { 140, 180, 20, 45 },
    { 200, 215, 40, 80 }, { 60, 75, 10, 30 }, { 150, 160, 85, 105 } };
  std::vector<float> pixels(3 * 256 * 128, 0.02f);
  for (const auto& panel : corners)
  {
    for (int y = panel[2]; y < panel[3]; ++y)
    {
      std::fill(&pixels[3 * (256 * y + panel[0])], &pixels[3 * (256 * y + panel[1])], 4.0f);
    }
  }
  environment->SetPixels(256, 128, pixels);
}

// Relative L1, as what stands in for plans is judged.
double GetErrorEverywhere(vtkRadianceIntegrator* integrator)
{
  SpherePairs pairs;
  pairs.AddRandom(300);
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(integrator->GetBRDF());
  reference->SetEnvironment(integrator->GetEnvironment());
  return GetRelativeError(pairs.Integrate(integrator), pairs.Integrate(reference));
}
}

// With 33 rows, chrome has 23 % error here.
TEST_F(Background, StandInsForMirrorLikeMaterialsUnderPanels)
{
  vtkNew<vtkEnvironment> panels;
  SetToPanels(panels);
  this->Measured->SetEnvironment(panels);
  this->Measured->SetPlanningModeToBackgroundFromStart();
  for (const char* name : { "nickel", "chrome" })
  {
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    this->Measured->SetBRDF(brdf);
    this->RenderEncoded();
    EXPECT_TRUE(this->Measured->GetPlanPending());
    vtkRadianceIntegrator* standIn = this->Measured->GetCurrentIntegrator();
    ASSERT_TRUE(standIn);
    const double error = GetErrorEverywhere(standIn);
    std::cout << name << ": error " << error << "\n";
    EXPECT_LT(error, 0.15) << name;
  }
}

// A material that shaders evaluate in a resampled form is drawn by a coarse one until the plan is
// made, and then as if nothing had stood in.
TEST_F(Background, ACoarseFormForShadersUntilThePlan)
{
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetReflectance(0.3, 0.2, 0.1);
  gloss->SetDiffuse(0.1, 0.2, 0.3);
  gloss->SetExponents(80.0, 80.0);
  vtkNew<vtkAdaptiveWarpBRDF> warp;
  ASSERT_EQ(warp->SetTables(MakeAnisotropicTables(gloss, { 16, 1, 1, 65 })), "");
  vtkNew<vtkEnvironment> lamp;
  SetToPanels(lamp);
  std::vector<float> pixels(lamp->GetPixels());
  std::fill_n(&pixels[3 * (256 * 40 + 120)], 3, 3e4f);
  lamp->SetPixels(256, 128, pixels);
  this->Measured->SetBRDF(warp);
  this->Measured->SetEnvironment(lamp);
  this->Measured->SetErrorTolerance(0.02);
  this->Measured->SetPlanningModeToBackgroundFromStart();
  const FloatImage first = this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  auto* standIn = vtkHybridRadianceIntegrator::SafeDownCast(this->Measured->GetCurrentIntegrator());
  ASSERT_TRUE(standIn);
  EXPECT_EQ(standIn->GetNumberOfLights(), 1);
  EXPECT_NE(standIn->GetBRDF(), warp.Get()); // but of the same values, which the error is against
  auto* table = vtkTabulatedBRDF::SafeDownCast(standIn->GetBRDF()->GetRenderable());
  ASSERT_TRUE(table);
  EXPECT_EQ(table->GetResamplingError(), 0.0); // which nobody measures
  const std::size_t cells = table->GetVolume().size();
  EXPECT_LT(cells, 3u * 40000u);
  const double error = GetErrorEverywhere(standIn);
  std::cout << "error under a lamp: " << error << "\n";
  EXPECT_LT(error, 0.1);

  ASSERT_TRUE(this->WaitUntilReady());
  const FloatImage planned = this->RenderEncoded();
  EXPECT_NE(planned.RGBA, first.RGBA);
  vtkRadianceIntegrator* current = this->Measured->GetCurrentIntegrator();
  auto* finer = vtkTabulatedBRDF::SafeDownCast(current->GetBRDF()->GetRenderable());
  ASSERT_TRUE(finer);
  EXPECT_GT(finer->GetVolume().size(), cells);
  EXPECT_GT(finer->GetResamplingError(), 0.0);
  // Objects that have no plan yet, planned for before they are drawn.
  vtkNew<vtkAdaptiveWarpBRDF> same;
  ASSERT_EQ(same->SetTables(MakeAnisotropicTables(gloss, { 16, 1, 1, 65 })), "");
  vtkNew<vtkEnvironment> sameLamp;
  sameLamp->SetPixels(256, 128, pixels);
  this->Measured->SetBRDF(same);
  this->Measured->SetEnvironment(sameLamp);
  this->Measured->SetPlanningModeToForeground();
  EXPECT_EQ(planned.RGBA, this->RenderEncoded().RGBA);
}

// The plan is for what the first picture shows, and for another view when that is asked for.
TEST_F(Background, PlansForTheView)
{
  EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 1);
  const std::string everywhere = this->Measured->GetPlan();
  camera->Azimuth(90.0);
  this->Measured->PlanForViewOn();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 2);
  const std::string here = this->Measured->GetPlan();
  EXPECT_NE(here, everywhere);
  camera->Azimuth(60.0);
  this->Sky->SetRotationY(90.0);
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 2) << "it follows no camera";
  EXPECT_EQ(this->Measured->GetPlan(), here);
  this->Measured->PlanForViewOn();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 3);
  EXPECT_NE(this->Measured->GetPlan(), here);
  this->Measured->PlanForViewOff();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 4);
  const auto cut = [](const std::string& plan) { return plan.substr(0, plan.find(", error")); };
  EXPECT_EQ(cut(this->Measured->GetPlan()), cut(everywhere));
  camera->SetFocalPoint(50.0, 0.0, 0.0); // out of view
  this->Measured->PlanForViewOn();
  this->RenderEncoded();
  EXPECT_EQ(plans.Count, 4);
}

//------------------------------------------------------------------------------
// What stands in for the first plan in the background: what is asked of a material for it, when,
// and how often.
namespace
{
// What a material and its snapshots were asked for, on the thread that draws or apart.
struct Asked
{
  struct Side
  {
    std::atomic<int> Prepared{ 0 };
    std::atomic<int> Forms{ 0 };
    bool Fails = false; // Prepare
  };
  Side Here, Apart;
  std::thread::id Drawing = std::this_thread::get_id();
  Gate Door; // of the other threads' Prepare
  Side& Get() { return std::this_thread::get_id() == this->Drawing ? this->Here : this->Apart; }
};

// A program's own class, which says what shaders evaluate and nothing of a quick form.
class AskedBRDF : public vtkBlinnPhongBRDF
{
public:
  static AskedBRDF* New();
  vtkTypeMacro(AskedBRDF, vtkBlinnPhongBRDF);
  void Prepare() override
  {
    Asked::Side& side = this->Record->Get();
    ++side.Prepared;
    if (&side == &this->Record->Apart)
    {
      this->Record->Door.Pass();
    }
    if (side.Fails)
    {
      throw std::runtime_error("its own trouble");
    }
  }
  vtkBRDF* GetRenderable() override
  {
    ++this->Record->Get().Forms;
    return this;
  }
  std::shared_ptr<Asked> Record = std::make_shared<Asked>();

protected:
  vtkBRDF* NewCopy() override
  {
    AskedBRDF* copy = AskedBRDF::New();
    copy->Record = this->Record;
    copy->SetExponent(this->GetExponent());
    copy->SetSpecular(this->GetSpecular());
    return copy;
  }
};
vtkStandardNewMacro(AskedBRDF);

class StandIns : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->Sky->SetPixels(2, 1, { 1.0f, 0.2f, 0.1f, 0.3f, 1.0f, 0.2f }); // no lamp
    this->BRDF->SetExponent(5.0);
    this->BRDF->SetSpecular(0.4, 0.3, 0.2);
    this->Measured->SetInputConnection(this->Sphere->GetOutputPort());
    this->Measured->SetBRDF(this->BRDF);
    this->Measured->SetEnvironment(this->Sky);
    this->Measured->SetErrorTolerance(0.05);
    this->Measured->SetPlanningModeToBackgroundFromStart();
    this->Actor->SetMapper(this->Measured);
    this->Renderer->AddActor(this->Actor);
  }
  void TearDown() override { this->Record().Door.OpenUp(); }

  Asked& Record() { return *this->BRDF->Record; }

  void WaitUntilReady()
  {
    this->Record().Door.OpenUp();
    ASSERT_TRUE(WaitUntil([this]() { return this->Measured->GetPlanReady(); }));
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkEnvironment> Sky;
  vtkNew<AskedBRDF> BRDF;
  vtkNew<vtkMeasuredBRDFMapper> Measured;
  vtkNew<vtkActor> Actor;
};
}

TEST_F(StandIns, NoFormWhereNoLightNeedsIt)
{
  this->Record().Door.Close();
  this->RenderEncoded();
  this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  EXPECT_EQ(this->Record().Here.Forms, 0);
  this->WaitUntilReady();
  this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_EQ(this->Record().Here.Forms, 0);
  EXPECT_EQ(this->Record().Apart.Forms, 0);
}

// The stand-in takes its form from a light's first frame on; whoever plans makes the plan's.
TEST_F(StandIns, LightsThatComeWhileAPlanIsMade)
{
  this->Record().Door.Close();
  const FloatImage dark = this->RenderEncoded();
  EXPECT_EQ(this->Record().Here.Forms, 0);
  this->AddHeadlight();
  const FloatImage lit = this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  EXPECT_NE(lit.RGBA, dark.RGBA);
  EXPECT_GT(this->Record().Here.Forms, 0);
  EXPECT_EQ(this->Record().Apart.Forms, 0);
  this->WaitUntilReady();
  EXPECT_GT(this->Record().Apart.Forms, 0);
  this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
}

// It says why, once, and is drawn by what stood in, which is not made again in every frame.
TEST_F(StandIns, PlansThatFail)
{
  this->AddHeadlight();
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  this->Record().Apart.Fails = true;
  this->Record().Door.Close();
  const FloatImage coarse = this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  EXPECT_EQ(errors.Count, 0);
  this->WaitUntilReady();
  const FloatImage failed = this->RenderEncoded();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(errors.Text.find("its own trouble"), std::string::npos) << errors.Text;
  EXPECT_EQ(this->Measured->GetPlan(), "");
  EXPECT_TRUE(this->Measured->GetCurrentIntegrator());
  EXPECT_LT(GetLargestDifference(failed, coarse), 0.02);
  const int here = this->Record().Here.Prepared;
  const int apart = this->Record().Apart.Prepared;
  EXPECT_EQ(this->RenderEncoded().RGBA, failed.RGBA);
  EXPECT_EQ(this->Record().Here.Prepared, here);
  EXPECT_EQ(this->Record().Apart.Prepared, apart);
  EXPECT_EQ(errors.Count, 1);

  this->Record().Apart.Fails = false; // and the material changes
  this->BRDF->SetExponent(6.0);
  this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  this->WaitUntilReady();
  this->RenderEncoded();
  EXPECT_NE(this->Measured->GetPlan(), "");
  EXPECT_EQ(errors.Count, 1);
}

// What cannot stand in is tried once, not in every frame of a plan's time.
TEST_F(StandIns, ThoseThatFailAreTriedOnce)
{
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  this->Record().Here.Fails = true;
  this->Record().Door.Close();
  this->RenderEncoded();
  EXPECT_TRUE(this->Measured->GetPlanPending());
  const int first = this->Record().Here.Prepared;
  EXPECT_LE(first, 2); // by what tells whether it is mirror-like, and by its table
  for (int frame = 0; frame < 3; ++frame)
  {
    this->RenderEncoded();
  }
  EXPECT_EQ(this->Record().Here.Prepared, first);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(errors.Text.find("its own trouble"), std::string::npos) << errors.Text;
  this->Record().Here.Fails = false;
  this->WaitUntilReady();
  this->RenderEncoded();
  EXPECT_NE(this->Measured->GetPlan(), "");
  EXPECT_EQ(errors.Count, 1);
}

//------------------------------------------------------------------------------
// One mapper in several viewports, windows and passes: each gets its own plan, and only those that
// show colors get any.
namespace
{
class Views : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->BRDF->SetSpecular(0.4, 0.3, 0.2);
    this->BRDF->SetExponent(5.0);
    this->Measured->SetInputConnection(this->Sphere->GetOutputPort());
    this->Measured->SetBRDF(this->BRDF);
    this->Measured->SetErrorTolerance(0.3);
    this->Actor->SetMapper(this->Measured);
    this->Renderer->AddActor(this->Actor);
    for (int k = 0; k < 2; ++k)
    {
      // Red from one side, blue from the other; or green from above.
      vtkNew<vtkFloatArray> radiance;
      radiance->SetNumberOfComponents(3);
      for (int texel = 0; texel < 16 * 8; ++texel)
      {
        const float side = texel % 16 < 8 ? 1.0f : 0.1f;
        const float above = texel / 16 >= 4 ? 1.0f : 0.05f;
        const float rgb[2][3] = { { side, 0.2f, 1.1f - side }, { 0.1f, above, 0.1f } };
        radiance->InsertNextTuple(rgb[k]);
      }
      vtkNew<vtkImageData> image;
      image->SetDimensions(16, 8, 1);
      image->GetPointData()->SetScalars(radiance);
      this->Textures[k]->SetInputData(image);
      this->Textures[k]->MipmapOn();
      this->Textures[k]->InterpolateOn();
    }
  }
  void TearDown() override { this->BRDF->Door->OpenUp(); }

  static std::vector<unsigned char> Read(vtkRenderWindow* window)
  {
    vtkNew<vtkUnsignedCharArray> pixels;
    const int* size = window->GetSize();
    window->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }

  static void SetUpWindow(vtkRenderWindow* window)
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(64, 64);
  }

  void SetUpRenderer(vtkRenderer* renderer, vtkTexture* light, vtkActor* actor)
  {
    renderer->SetAutomaticLightCreation(false);
    renderer->SetActiveCamera(this->Renderer->GetActiveCamera());
    renderer->SetEnvironmentTexture(light);
    renderer->AddActor(actor);
  }

  /// What a fresh mapper shows under this light.
  std::vector<unsigned char> RenderAlone(vtkTexture* light)
  {
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    vtkNew<vtkActor> actor;
    SetUpWindow(window);
    window->SetSize(32, 64);
    window->AddRenderer(renderer);
    mapper->ShallowCopy(this->Measured);
    actor->SetMapper(mapper);
    this->SetUpRenderer(renderer, light, actor);
    window->Render();
    return Read(window);
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<GatedBRDF> BRDF;
  vtkNew<vtkMeasuredBRDFMapper> Measured;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkTexture> Textures[2];
};
}

//------------------------------------------------------------------------------
TEST_F(Views, TwoViewportsTwoLights)
{
  const std::vector<unsigned char> alone[2] = { this->RenderAlone(this->Textures[0]),
    this->RenderAlone(this->Textures[1]) };
  ASSERT_NE(alone[0], alone[1]);
  vtkNew<vtkRenderer> right;
  this->Window->AddRenderer(right);
  this->Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  right->SetViewport(0.5, 0.0, 1.0, 1.0);
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  this->SetUpRenderer(right, this->Textures[1], this->Actor);
  const EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  for (const bool background : { false, true })
  {
    this->Measured->SetPlanningMode(
      background ? vtkMeasuredBRDFMapper::BACKGROUND : vtkMeasuredBRDFMapper::FOREGROUND);
    this->Window->Render();
    while (this->Measured->GetPlanPending())
    {
      ASSERT_TRUE(WaitUntil([this]() { return this->Measured->GetPlanReady(); }));
      this->Window->Render();
    }
    EXPECT_EQ(plans.Count, 2); // what was planned in the foreground serves in the background, too
    this->BRDF->Door->TakePasses();
    for (int frame = 0; frame < 3; ++frame)
    {
      this->Window->Render();
      EXPECT_EQ(this->BRDF->Door->TakePasses(), 0);
      const std::vector<unsigned char> both = Read(this->Window);
      int wrong = 0;
      for (std::size_t k = 0; k < both.size(); ++k)
      {
        const std::size_t x = k / 4 % 64;
        wrong += both[k] != alone[x / 32][(k / 256 * 32 + x % 32) * 4 + k % 4] ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0);
    }
  }
  this->Window->RemoveRenderer(right);
}

//------------------------------------------------------------------------------
// A mapper's buffers go whenever another window draws it; what is in the making stays.
TEST_F(Views, TwoWindowsGetTheirBackgroundPlan)
{
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  SetUpWindow(window);
  window->AddRenderer(renderer);
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  this->SetUpRenderer(renderer, this->Textures[0], this->Actor);
  this->Measured->SetPlanningModeToBackground();
  this->Window->Render();
  window->Render();
  const std::string old = this->Measured->GetPlan();
  this->BRDF->Door->Close();
  this->BRDF->SetExponent(40.0);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->Window->Render();
    window->Render();
  }
  ASSERT_TRUE(WaitUntil([this]() { return this->BRDF->Door->IsAwaited(); }));
  EXPECT_EQ(this->Measured->GetPlan(), old);
  this->BRDF->Door->SettlePasses();
  // As many frames as it takes, in either window, do not begin it anew.
  this->Window->Render();
  window->Render();
  EXPECT_EQ(this->BRDF->Door->TakePasses(), 0);
  this->BRDF->Door->OpenUp();
  ASSERT_TRUE(WaitUntil([this]() { return this->Measured->GetPlanReady(); }));
  this->Window->Render();
  window->Render();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_NE(this->Measured->GetPlan(), old);
  renderer->RemoveActor(this->Actor);
}

//------------------------------------------------------------------------------
TEST_F(Views, ShadowMapsNeedNoPlans)
{
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  this->AddSceneLight(8.0, 2.0, 0.0, 40.0); // from the side

  vtkNew<vtkShadowMapPass> shadows;
  this->Passes->RemoveAllItems();
  this->Passes->AddItem(shadows->GetShadowMapBakerPass());
  this->Passes->AddItem(shadows);
  this->Renderer->SetPass(this->CameraPass);
  const EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->Actor->SetPosition(0.01 * frame, 0.0, 0.0); // or the maps stay as they are
    this->Window->Render();
    EXPECT_EQ(plans.Count, 1) << frame;
  }
}

//------------------------------------------------------------------------------
TEST_F(Views, SelectionNeedsNoPlans)
{
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  const EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  this->Window->SetSize(64, 64);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->Renderer);
  selector->SetArea(0, 0, 63, 63);
  this->Actor->VisibilityOff(); // the first frame makes the window
  this->Window->Render();
  this->Actor->VisibilityOn();
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  EXPECT_EQ(selection->GetNumberOfNodes(), 1u);
  EXPECT_EQ(plans.Count, 0);
  EXPECT_EQ(this->Measured->GetTextureBytes(), 0);
  this->Window->Render();
  EXPECT_EQ(plans.Count, 1);
  const vtkIdType bytes = this->Measured->GetTextureBytes();
  const auto again = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  EXPECT_EQ(again->GetNumberOfNodes(), 1u);
  EXPECT_EQ(plans.Count, 1);
  EXPECT_EQ(this->Measured->GetTextureBytes(), bytes);
}

//------------------------------------------------------------------------------
// A wireframe's surface that only hides lines.
TEST_F(Views, HiddenLinesNeedNoPlans)
{
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  this->Renderer->UseHiddenLineRemovalOn();
  this->Actor->GetProperty()->SetRepresentationToWireframe();
  vtkNew<vtkActor> plain; // of another mapper, drawn as it is
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(this->Sphere->GetOutputPort());
  mapper->SetBRDF(this->BRDF);
  mapper->SetErrorTolerance(0.3);
  plain->SetMapper(mapper);
  this->Renderer->AddActor(plain);
  const EventCounter plans(mapper, vtkCommand::UpdateDataEvent);
  const EventCounter none(this->Measured, vtkCommand::UpdateDataEvent);
  this->Window->Render();
  EXPECT_EQ(plans.Count, 1);
  EXPECT_EQ(none.Count, 0);
}

namespace
{
/// Has no memory.
class Hungry : public vtkBlinnPhongBRDF
{
public:
  static Hungry* New();
  vtkTypeMacro(Hungry, vtkBlinnPhongBRDF);
  bool IsIsotropic() override
  {
    ++this->Asked;
    throw std::bad_alloc();
  }
  void GetShaderInputs(vtkBRDFShaderInputs&) override
  {
    ++this->Asked;
    throw std::bad_alloc();
  }
  int Asked = 0;
};
vtkStandardNewMacro(Hungry);
}

//------------------------------------------------------------------------------
TEST_F(Views, WithoutMemoryRenderSaysSoOnce)
{
  vtkNew<Hungry> hungry;
  this->Measured->SetBRDF(hungry);
  const EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  for (const bool lit : { true, false })
  {
    // Planning, or the material's own textures for a light.
    if (!lit)
    {
      this->AddHeadlight();
    }
    this->Renderer->SetEnvironmentTexture(lit ? this->Textures[0].Get() : nullptr);
    ASSERT_NO_THROW(this->Window->Render());
    const int count = errors.Count;
    const int asked = hungry->Asked;
    EXPECT_GE(count, 1);
    for (int frame = 0; frame < 3; ++frame)
    {
      ASSERT_NO_THROW(this->Window->Render());
    }
    EXPECT_EQ(errors.Count, count);
    EXPECT_EQ(hungry->Asked, asked);
  }
  // Drawn as the superclass does.
  const std::vector<unsigned char> shown = Read(this->Window);
  this->Measured->SetBRDF(nullptr);
  this->Window->Render();
  EXPECT_EQ(Read(this->Window), shown);
}
