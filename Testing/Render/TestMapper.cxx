// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The mapper as a citizen of VTK: what changes when, and what stays as the stock mapper has it.

#include "EventCounter.h"
#include "RenderFixture.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkImageData.h"
#include "vtkImportanceLightSetGenerator.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRadiancePlanner.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkSkybox.h"
#include "vtkSphereSource.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <glm/glm.hpp>

#include <atomic>
#include <random>
#include <set>

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
    this->Lights->SetGenerator(vtkNew<vtkMedianCutLightSetGenerator>());
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

TEST_F(Mapper, EnvironmentWithoutSceneLights)
{
  this->Measured->SetBRDF(this->Lambert);
  this->Measured->SetEnvironment(MakeOctants());
  const FloatImage own = this->RenderLinear();
  EXPECT_GT(own.At(32, 32)[0], 0.1f);
  // The renderer's texture gives the same, and needs no flag.
  this->Measured->SetEnvironment(nullptr);
  this->Renderer->SetEnvironmentTexture(MakeTexture(MakeOctants()));
  const FloatImage texture = this->RenderLinear();
  EXPECT_LT(GetLargestDifference(own, texture), 1e-6);
  this->Renderer->SetEnvironmentTexture(nullptr);
  EXPECT_EQ(this->RenderLinear().At(32, 32)[0], 0.0f);
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
    const vtkSmartPointer<vtkLightSetGenerator> generators[] = {
      vtkSmartPointer<vtkMedianCutLightSetGenerator>::New(),
      vtkSmartPointer<vtkImportanceLightSetGenerator>::New(), nullptr
    };
    for (const auto& generator : generators)
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
  vtkNew<vtkImportanceLightSetGenerator> importance;
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

// Tilted planes, one pixel each, against the C++ of what the planner chooses.
TEST_F(Auto, MatchesThePlannedIntegrator)
{
  vtkNew<vtkPlaneSource> plane;
  this->Measured->SetInputConnection(plane->GetOutputPort());
  this->Light->SetRotationY(35.0);
  this->Phong->SetExponent(60.0);
  std::string last;
  for (const double tolerance : { 0.2, 0.01 })
  {
    this->Measured->SetErrorTolerance(tolerance);
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(this->Phong);
    planner->SetEnvironment(this->Light);
    planner->SetErrorTolerance(tolerance);
    ASSERT_TRUE(planner->Update());
    auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
    double worst = 0.0;
    for (int k = 0; k < 12; ++k)
    {
      this->Actor->SetOrientation(11.0 * (k - 6), 17.0 * ((k * 5) % 7 - 3), 0.0);
      vtkNew<vtkTransform> transform;
      transform->SetMatrix(this->Actor->GetMatrix());
      double normal[3] = { 0.0, 0.0, 1.0 };
      transform->TransformNormal(normal, normal);
      const double view[3] = { 0.0, 0.0, 1.0 };
      const FloatImage image = this->RenderLinear();
      const std::array<double, 3> radiance = IntegrateOne(integrator, normal, view);
      for (int c = 0; c < 3; ++c)
      {
        const double expected = radiance[static_cast<std::size_t>(c)];
        EXPECT_GT(expected, 0.0);
        worst = std::max(worst, std::abs(image.At(32, 32)[c] - expected) / expected);
      }
    }
    std::cout << "largest relative difference " << worst << "; " << this->Measured->GetPlan()
              << "\n";
    EXPECT_LT(worst, std::max(2e-3, 4.0 * this->GetWeightStep()));
    EXPECT_NE(this->Measured->GetPlan().find("table, "), std::string::npos);
    EXPECT_NE(this->Measured->GetPlan().substr(0, 20), last); // another size
    last = this->Measured->GetPlan().substr(0, 20);
    EXPECT_EQ(this->Measured->GetCurrentLightSet(), nullptr);
  }
  // A mapper fresh from New plans, too.
  const FloatImage planned = this->RenderLinear();
  vtkNew<vtkMeasuredBRDFMapper> plain;
  EXPECT_EQ(plain->GetIntegrator(), nullptr);
  plain->SetInputConnection(plane->GetOutputPort());
  plain->SetBRDF(this->Phong);
  plain->SetEnvironment(this->Light);
  plain->SetErrorTolerance(0.01);
  this->Actor->SetMapper(plain);
  EXPECT_EQ(GetLargestDifference(this->RenderLinear(), planned), 0.0);
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

TEST_F(Auto, AddsUpWithSceneLights)
{
  const FloatImage environment = this->RenderLinear();
  this->AddHeadlight(2.0, 1.0, 0.5, 0.25);
  const FloatImage both = this->RenderLinear();
  this->Measured->SetEnvironment(nullptr);
  const FloatImage light = this->RenderLinear();
  EXPECT_EQ(this->Measured->GetPlan(), "");
  EXPECT_GT(light.At(32, 32)[0], 0.05f);
  double worst = 0.0;
  for (int k = 0; k < 64 * 64 * 4; ++k)
  {
    if (k % 4 != 3)
    {
      worst = std::max<double>(worst, std::abs(both.RGBA[k] - environment.RGBA[k] - light.RGBA[k]));
    }
  }
  std::cout << "largest difference " << worst << "\n";
  EXPECT_LT(worst, 1e-5);
  // Neither environment nor light: black.
  this->Renderer->RemoveAllLights();
  EXPECT_EQ(this->RenderLinear().At(32, 32)[0], 0.0f);
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

// A table cannot hold an anisotropic material: said once, drawn as the superclass does, mended by
// taking either away.
TEST_F(Auto, AnIntegratorThatRefuses)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(5.0, 20.0);
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetNumberOfRows(9);
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
