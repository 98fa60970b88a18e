// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The mapper as a citizen of VTK: what changes when, and what stays as the stock mapper has it.

#include "EventCounter.h"
#include "RenderFixture.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkBasisBRDF.h"
#include "vtkBasisProjector.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkExactRadianceIntegrator.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
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
#include "vtkOpenGLHelper.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRadiancePlanner.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
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

double GetLargestDifference(const FloatImage& a, const FloatImage& b)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < a.RGBA.size(); ++k)
  {
    largest = std::max<double>(largest, std::abs(a.RGBA[k] - b.RGBA[k]));
  }
  return largest;
}

/// Pixels that are not background (alpha 0 in the float framebuffer is not kept, so: any color).
std::vector<bool> GetCoverage(const FloatImage& image)
{
  std::vector<bool> covered;
  for (std::size_t k = 0; k < image.RGBA.size(); k += 4)
  {
    covered.push_back(image.RGBA[k] + image.RGBA[k + 1] + image.RGBA[k + 2] > 0.0f);
  }
  return covered;
}

class Mapper : public RenderFixture
{
protected:
  void SetUp() override
  {
    RenderFixture::SetUp();
    if (IsSkipped())
    {
      return;
    }
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
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  this->Renderer->AddLight(headlight);
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
  EXPECT_EQ(this->Measured->GetMaterialDescription(), "");
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
    const FloatImage image = this->RenderLinear();
    const float* pixel = image.At(32, 32);
    EXPECT_NEAR(pixel[0], 0.9 / pi * cosine * scale, 2e-3 * scale);
    EXPECT_NEAR(pixel[1], 0.6 / pi * cosine * scale * 0.5, 2e-3 * scale);
    EXPECT_NEAR(pixel[2], 0.0, 1e-6);
  };
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  headlight->SetDiffuseColor(1.0, 0.5, 0.0);
  headlight->SetIntensity(2.0);
  check(headlight, 1.0, 2.0);

  vtkNew<vtkLight> directional;
  directional->SetLightTypeToSceneLight();
  directional->SetDiffuseColor(1.0, 0.5, 0.0);
  directional->SetPosition(3.0, 0.0, 4.0);
  directional->SetFocalPoint(0.0, 0.0, 0.0);
  check(directional, 0.8, 1.0);

  vtkNew<vtkLight> camera;
  camera->SetLightTypeToCameraLight();
  camera->SetDiffuseColor(1.0, 0.5, 0.0);
  camera->SetPosition(0.0, 1.0, 1.0); // 45 degrees above the line of sight
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  check(camera, std::sqrt(0.5), 1.0);

  vtkNew<vtkLight> positional;
  positional->SetLightTypeToSceneLight();
  positional->PositionalOn();
  positional->SetConeAngle(180.0);
  positional->SetDiffuseColor(1.0, 0.5, 0.0);
  positional->SetPosition(3.0, 0.0, 4.0);
  positional->SetAttenuationValues(0.0, 0.0, 1.0); // 1/d^2, d = 5
  positional->SetIntensity(25.0);
  check(positional, 0.8, 1.0);

  vtkNew<vtkLight> spot;
  spot->SetLightTypeToSceneLight();
  spot->PositionalOn();
  spot->SetDiffuseColor(1.0, 0.5, 0.0);
  spot->SetPosition(0.0, 0.0, 2.0);
  spot->SetFocalPoint(0.0, 0.0, 0.0);
  spot->SetConeAngle(10.0);
  spot->SetExponent(0.0);
  check(spot, 1.0, 1.0);
  const FloatImage image = this->RenderLinear();
  EXPECT_EQ(image.At(48, 32)[0], 0.0f); // half the plane's width off axis: outside the cone

  // Two lights at once add up.
  this->Renderer->AddLight(headlight);
  const FloatImage both = this->RenderLinear();
  EXPECT_NEAR(both.At(32, 32)[0], 3.0 * 0.9 / pi, 5e-3);
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
  int warnings = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&warnings);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  this->Measured->AddObserver(vtkCommand::WarningEvent, counter);
  EXPECT_EQ(this->RenderLinear().At(32, 32)[1], 0.0f);
  this->RenderLinear();
  EXPECT_EQ(warnings, 1);
}

// An environment, a directional and a positional light at once: the sum of the three.
TEST_F(Mapper, EnvironmentAndSceneLightsAddUp)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1.0, -1.0, 0.0);
  plane->SetPoint1(1.0, -1.0, 0.0);
  plane->SetPoint2(-1.0, 1.0, 0.0);
  this->Measured->SetInputConnection(plane->GetOutputPort());
  this->Measured->SetBRDF(this->Phong);
  const vtkSmartPointer<vtkEnvironment> environment = MakeEnvironment();
  this->Measured->SetEnvironment(environment);
  vtkNew<vtkLight> directional;
  directional->SetLightTypeToSceneLight();
  directional->SetDiffuseColor(1.0, 0.5, 0.25);
  directional->SetIntensity(3.0);
  directional->SetPosition(3.0, 0.0, 4.0);
  directional->SetFocalPoint(0.0, 0.0, 0.0);
  this->Renderer->AddLight(directional);
  vtkNew<vtkLight> positional;
  positional->SetLightTypeToSceneLight();
  positional->PositionalOn();
  positional->SetConeAngle(180.0);
  positional->SetDiffuseColor(0.25, 0.5, 1.0);
  positional->SetPosition(-0.5, 0.7, 1.5);
  positional->SetAttenuationValues(0.0, 0.0, 1.0);
  positional->SetIntensity(8.0);
  this->Renderer->AddLight(positional);
  const FloatImage image = this->RenderLinear();

  const double normal[3] = { 0.0, 0.0, 1.0 }; // the view too
  vtkNew<vtkDoubleArray> normals, views, radiance;
  normals->SetNumberOfComponents(3);
  views->SetNumberOfComponents(3);
  normals->InsertNextTuple(normal);
  views->InsertNextTuple(normal);
  vtkNew<vtkLightSetRadianceIntegrator> integrator;
  integrator->SetBRDF(this->Phong);
  integrator->SetEnvironment(environment);
  integrator->SetLightSet(this->Measured->GetCurrentLightSet());
  ASSERT_TRUE(integrator->Integrate(normals, views, radiance));
  double worst = 0.0;
  for (int y = 4; y < 64; y += 8)
  {
    for (int x = 4; x < 64; x += 8)
    {
      const glm::dvec3 point((x + 0.5) / 32.0 - 1.0, (y + 0.5) / 32.0 - 1.0, 0.0);
      const glm::dvec3 sun(0.6, 0.0, 0.8);
      const glm::dvec3 way = glm::dvec3(-0.5, 0.7, 1.5) - point;
      const glm::dvec3 lamp = glm::normalize(way);
      double sunValue[3];
      double lampValue[3];
      this->Phong->Evaluate(&sun.x, normal, sunValue);
      this->Phong->Evaluate(&lamp.x, normal, lampValue);
      for (int c = 0; c < 3; ++c)
      {
        const double expected =
          radiance->GetComponent(0, c) +
          sunValue[c] * sun.z * 3.0 * directional->GetDiffuseColor()[c] +
          lampValue[c] * lamp.z * 8.0 / glm::dot(way, way) * positional->GetDiffuseColor()[c];
        worst = std::max(worst, std::abs(image.At(x, y)[c] - expected) / expected);
      }
    }
  }
  std::cout << "largest relative difference " << worst << "\n";
  EXPECT_LT(worst, 1e-4);
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

// Towards the exact reference as N grows, on a sphere's pixels.
TEST_F(Mapper, ConvergesToTheExactReference)
{
  vtkSmartPointer<vtkEnvironment> environment = MakeEnvironment(128, 64);
  this->Measured->SetBRDF(this->Phong);
  this->Measured->SetEnvironment(environment);
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkDoubleArray> ns, vs, exact;
  ns->SetNumberOfComponents(3);
  vs->SetNumberOfComponents(3);
  this->Measured->SetInputConnection(plane->GetOutputPort());
  const int poses = 12;
  const auto pose = [this](int k)
  {
    this->Actor->SetOrientation(0.0, 0.0, 0.0);
    this->Actor->RotateX(11.0 * (k - 6));
    this->Actor->RotateY(17.0 * ((k * 5) % 7 - 3));
  };
  for (int k = 0; k < poses; ++k)
  {
    pose(k);
    vtkNew<vtkTransform> transform;
    transform->SetMatrix(this->Actor->GetMatrix());
    double normal[3] = { 0.0, 0.0, 1.0 };
    transform->TransformNormal(normal, normal);
    ns->InsertNextTuple(normal);
    vs->InsertNextTuple3(0.0, 0.0, 1.0);
  }
  vtkNew<vtkExactRadianceIntegrator> reference;
  reference->SetBRDF(this->Phong);
  reference->SetEnvironment(environment);
  ASSERT_TRUE(reference->Integrate(ns, vs, exact));
  const vtkSmartPointer<vtkLightSetGenerator> generators[] = {
    vtkSmartPointer<vtkMedianCutLightSetGenerator>::New(),
    vtkSmartPointer<vtkImportanceLightSetGenerator>::New()
  };
  for (const auto& generator : generators)
  {
    this->Measured->Lights->SetGenerator(generator);
    double first = 0.0, last = 0.0;
    for (const int lights : { 16, 64, 256, 1024, 4096 })
    {
      this->Measured->Lights->SetNumberOfLights(lights);
      double error = 0.0, total = 0.0;
      for (int k = 0; k < poses; ++k)
      {
        pose(k);
        const FloatImage image = this->RenderLinear();
        for (int c = 0; c < 3; ++c)
        {
          error += std::abs(image.At(32, 32)[c] - exact->GetComponent(k, c));
          total += exact->GetComponent(k, c);
        }
      }
      last = error / total;
      first = lights == 16 ? last : first;
      std::cout << generator->GetClassName() << " " << lights << " lights: relative L1 " << last
                << "\n";
    }
    EXPECT_LT(last, 0.02);
    EXPECT_LT(last, 0.5 * first);
  }
}

TEST_F(Mapper, WhiteFurnace)
{
  std::vector<float> ones(3 * 32 * 16, 1.0f);
  vtkNew<vtkEnvironment> white;
  white->SetPixels(32, 16, ones);
  this->Measured->SetEnvironment(white);
  this->Measured->Lights->SetNumberOfLights(512);
  this->Measured->SetBRDF(this->Lambert);
  this->Lambert->SetAlbedo(1.0, 0.5, 0.25);
  const FloatImage image = this->RenderLinear();
  for (const int x : { 12, 32, 50 })
  {
    EXPECT_NEAR(image.At(x, 32)[0], 1.0, 0.02);
    EXPECT_NEAR(image.At(x, 32)[1], 0.5, 0.01);
  }
}

// A basis pair in white light shows its directional albedo, whatever the basis.
TEST_F(Mapper, WhiteFurnaceOfBases)
{
  vtkNew<vtkEnvironment> white;
  white->SetPixels(64, 32, std::vector<float>(3 * 64 * 32, 1.0f));
  this->Measured->SetEnvironment(white);
  this->Measured->Lights->SetNumberOfLights(128);
  this->Phong->SetExponent(8.0);
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(this->Phong);
  projector->SetOrder(3);
  for (int basis = vtkBasisBRDF::SPHERICAL_HARMONICS; basis <= vtkBasisBRDF::LEGENDRE_FOURIER;
       ++basis)
  {
    projector->SetBasis(basis);
    ASSERT_TRUE(projector->Project());
    vtkBasisBRDF* brdf = projector->GetOutput();
    this->Measured->SetBRDF(brdf);
    const FloatImage image = this->RenderLinear();
    // The middle of the sphere faces the viewer.
    const double up[3] = { 0.0, 0.0, 1.0 };
    double albedo[3];
    brdf->GetDirectionalAlbedo(up, albedo);
    EXPECT_GT(albedo[0], 0.01);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(image.At(32, 32)[c] / albedo[c], 1.0, 0.03)
        << vtkBasisBRDF::GetBasisName(basis) << " " << c;
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
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  this->Renderer->AddLight(headlight);
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

TEST_F(Mapper, CoverageIsStock)
{
  this->Measured->SetBRDF(this->Lambert);
  this->Measured->SetEnvironment(MakeOctants());
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  this->Renderer->AddLight(headlight);
  const auto check = [this](const char* what)
  {
    const std::vector<bool> measured = GetCoverage(this->RenderWith(this->Measured));
    const std::vector<bool> stock = GetCoverage(this->RenderWith(this->Stock));
    EXPECT_EQ(measured, stock) << what;
    EXPECT_GT(std::count(stock.begin(), stock.end(), true), 50) << what;
  };
  check("surface");
  vtkNew<vtkPlane> plane;
  plane->SetNormal(1.0, 0.3, 0.2);
  this->Measured->AddClippingPlane(plane);
  this->Stock->AddClippingPlane(plane);
  check("clipping plane");
  this->Measured->RemoveAllClippingPlanes();
  this->Stock->RemoveAllClippingPlanes();
  this->Actor->GetProperty()->SetInterpolationToFlat();
  check("flat");
  this->Actor->GetProperty()->SetInterpolationToGouraud();
  check("Gouraud");
  this->Actor->GetProperty()->BackfaceCullingOn();
  check("back faces culled");
  this->Actor->GetProperty()->BackfaceCullingOff();

  // These are the superclass's business to the last bit.
  this->Actor->GetProperty()->SetRepresentationToWireframe();
  EXPECT_EQ(
    GetLargestDifference(this->RenderWith(this->Measured), this->RenderWith(this->Stock)), 0.0);
  this->Actor->GetProperty()->SetRepresentationToPoints();
  EXPECT_EQ(
    GetLargestDifference(this->RenderWith(this->Measured), this->RenderWith(this->Stock)), 0.0);
  this->Actor->GetProperty()->SetRepresentationToSurface();
  this->Actor->GetProperty()->LightingOff();
  EXPECT_EQ(
    GetLargestDifference(this->RenderWith(this->Measured), this->RenderWith(this->Stock)), 0.0);
}

TEST_F(Mapper, EdgesAndOpacity)
{
  this->Measured->SetBRDF(this->Lambert);
  this->Measured->SetEnvironment(MakeOctants());
  this->Sphere->SetThetaResolution(12);
  this->Sphere->SetPhiResolution(12);
  const auto countRed = [](const FloatImage& image)
  {
    int red = 0;
    for (std::size_t k = 0; k < image.RGBA.size(); k += 4)
    {
      red += image.RGBA[k] > 0.9f && image.RGBA[k + 1] < 0.1f && image.RGBA[k + 2] < 0.1f;
    }
    return red;
  };
  this->Actor->GetProperty()->EdgeVisibilityOn();
  this->Actor->GetProperty()->SetEdgeColor(1.0, 0.0, 0.0);
  EXPECT_GT(countRed(this->RenderEncoded()), 100);
  this->Actor->GetProperty()->EdgeVisibilityOff();
  EXPECT_EQ(countRed(this->RenderEncoded()), 0);

  // Half opaque over a black background: half the encoded value.
  const FloatImage opaque = this->RenderEncoded();
  this->Actor->GetProperty()->SetOpacity(0.5);
  this->Actor->GetProperty()->BackfaceCullingOn();
  const FloatImage half = this->RenderEncoded();
  EXPECT_NEAR(half.At(32, 32)[0], 0.5f * opaque.At(32, 32)[0], 2e-3);
  this->Actor->GetProperty()->SetOpacity(1.0);
}

TEST_F(Mapper, Picking)
{
  this->Measured->SetBRDF(this->Lambert);
  this->Measured->SetEnvironment(MakeOctants());
  const auto pick = [this](vtkPolyDataMapper* mapper)
  {
    this->Renderer->SetPass(nullptr);
    this->Actor->SetMapper(mapper);
    this->Window->Render();
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(this->Renderer);
    selector->SetArea(0, 0, 63, 63);
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
    vtkSmartPointer<vtkSelection> selection =
      vtkSmartPointer<vtkSelection>::Take(selector->Select());
    std::set<vtkIdType> ids;
    for (unsigned int k = 0; k < selection->GetNumberOfNodes(); ++k)
    {
      vtkDataArray* list = vtkDataArray::SafeDownCast(selection->GetNode(k)->GetSelectionList());
      for (vtkIdType id = 0; list && id < list->GetNumberOfTuples(); ++id)
      {
        ids.insert(static_cast<vtkIdType>(list->GetComponent(id, 0)));
      }
    }
    return ids;
  };
  const std::set<vtkIdType> stock = pick(this->Stock);
  EXPECT_GT(stock.size(), 500u);
  EXPECT_EQ(pick(this->Measured), stock);
}

TEST_F(Mapper, NormalsOfEveryKind)
{
  // A plane lit from the front: same radiance with point normals, cell normals and none; the same
  // from behind, where VTK turns normals to the viewer.
  vtkNew<vtkPlaneSource> plane;
  this->Measured->SetBRDF(this->Lambert);
  this->Measured->SetEnvironment(MakeOctants());
  double values[4];
  for (int kind = 0; kind < 4; ++kind)
  {
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputConnection(plane->GetOutputPort());
    normals->SetComputePointNormals(kind == 0 || kind == 3);
    normals->SetComputeCellNormals(kind == 1);
    normals->SetFlipNormals(kind == 3);
    normals->Update();
    vtkNew<vtkPolyData> data;
    data->ShallowCopy(normals->GetOutput());
    if (kind == 1 || kind == 2)
    {
      data->GetPointData()->SetNormals(nullptr);
    }
    this->Measured->SetInputDataObject(data);
    values[kind] = this->RenderLinear().At(32, 32)[1];
    EXPECT_GT(values[kind], 0.05) << kind;
  }
  EXPECT_NEAR(values[1], values[0], 1e-5);
  EXPECT_NEAR(values[2], values[0], 1e-4);
  EXPECT_NEAR(values[3], values[0], 1e-5);
}

TEST_F(Mapper, ScalarsModulate)
{
  this->Sphere->Update();
  vtkNew<vtkPolyData> data;
  data->ShallowCopy(this->Sphere->GetOutput());
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
  {
    colors->InsertNextTuple3(255, 0, 0);
  }
  data->GetPointData()->SetScalars(colors);
  this->Measured->SetInputDataObject(data);
  this->Measured->SetBRDF(this->Lambert);
  this->Measured->SetEnvironment(MakeOctants());
  const FloatImage image = this->RenderLinear();
  EXPECT_GT(image.At(32, 32)[0], 0.05f);
  EXPECT_EQ(image.At(32, 32)[1], 0.0f);
  this->Measured->SetScalarColoringMode(vtkMeasuredBRDFMapper::IGNORE_SCALARS);
  EXPECT_GT(this->RenderLinear().At(32, 32)[1], 0.05f);
  // Without scalars the property's color does not dim a measured material.
  this->Measured->SetScalarColoringMode(vtkMeasuredBRDFMapper::MODULATE);
  this->Measured->ScalarVisibilityOff();
  this->Actor->GetProperty()->SetColor(0.1, 0.1, 0.1);
  EXPECT_NEAR(this->RenderLinear().At(32, 32)[0], image.At(32, 32)[0], 1e-5);
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

TEST_F(Mapper, CopiesAndPrints)
{
  this->Measured->SetBRDF(this->Phong);
  this->Measured->Lights->SetNumberOfLights(32);
  vtkNew<vtkMeasuredBRDFMapper> copy;
  copy->ShallowCopy(this->Measured);
  EXPECT_EQ(copy->GetBRDF(), this->Phong.Get());
  EXPECT_EQ(copy->GetIntegrator(), this->Measured->Lights.Get());
  std::ostringstream text;
  copy->Print(text);
  EXPECT_NE(text.str().find("ErrorTolerance: 0.02"), std::string::npos);
}

TEST_F(Mapper, WarnsOncePerCause)
{
  int warnings = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&warnings);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  this->Measured->AddObserver(vtkCommand::WarningEvent, count);
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
  EXPECT_EQ(warnings, 0);
  EXPECT_EQ(errors.Count, 1) << errors.Text;
  EXPECT_NE(errors.Text.find("power of two"), std::string::npos) << errors.Text;
  this->Measured->Lights->SetNumberOfLights(64);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->RenderEncoded();
  }
  EXPECT_EQ(warnings, 1);
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
  void SetUp() override
  {
    Mapper::SetUp();
    if (IsSkipped())
    {
      return;
    }
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
      vtkNew<vtkDoubleArray> normals, views, radiance;
      normals->SetNumberOfComponents(3);
      views->SetNumberOfComponents(3);
      normals->InsertNextTuple(normal);
      views->InsertNextTuple3(0.0, 0.0, 1.0);
      const FloatImage image = this->RenderLinear();
      ASSERT_TRUE(integrator->Integrate(normals, views, radiance));
      for (int c = 0; c < 3; ++c)
      {
        const double expected = radiance->GetComponent(0, c);
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
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  headlight->SetDiffuseColor(1.0, 0.5, 0.25);
  headlight->SetIntensity(2.0);
  this->Renderer->AddLight(headlight);
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

TEST_F(Auto, AnisotropicMaterialsArePlanned)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(5.0, 20.0);
  this->Measured->SetBRDF(brushed);
  EventCounter warnings(this->Measured, vtkCommand::WarningEvent); // there are no tangents
  EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  const FloatImage image = this->RenderLinear();
  EXPECT_GT(image.At(32, 32)[0], 0.01f);
  const std::string plan = this->Measured->GetPlan();
  EXPECT_TRUE(plan.find("anisotropic-table, ") == 0 || plan.find("hybrid, ") == 0) << plan;
  EXPECT_EQ(errors.Count, 0);
  // And back.
  this->Measured->SetBRDF(this->Phong);
  this->RenderLinear();
  EXPECT_EQ(this->Measured->GetPlan().find("table, "), 0u) << this->Measured->GetPlan();
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

// Lights, a light set of one's own, and plans again.
TEST_F(Auto, MethodsBackAndForth)
{
  const FloatImage planned = this->RenderEncoded();
  const std::string plan = this->Measured->GetPlan();
  this->Measured->SetIntegrator(this->Measured->Lights);
  this->Measured->Lights->SetNumberOfLights(4);
  const FloatImage four = this->RenderEncoded();
  EXPECT_GT(GetLargestDifference(four, planned), 1e-2);
  EXPECT_EQ(this->Measured->GetPlan(), "");
  ASSERT_TRUE(this->Measured->GetCurrentLightSet());
  EXPECT_EQ(this->Measured->GetCurrentLightSet()->GetNumberOfLights(), 4);
  this->Measured->SetIntegrator(nullptr);
  EXPECT_EQ(GetLargestDifference(this->RenderEncoded(), planned), 0.0);
  EXPECT_EQ(this->Measured->GetPlan().substr(0, 20), plan.substr(0, 20));
  EXPECT_EQ(this->Measured->GetCurrentLightSet(), nullptr);

  vtkNew<vtkLightSet> lights;
  const double direction[3] = { 0.0, 0.0, 1.0 };
  const double irradiance[3] = { 0.3, 0.2, 0.1 };
  lights->AddLight(direction, irradiance);
  this->Measured->Lights->SetLightSet(lights);
  this->Measured->SetIntegrator(this->Measured->Lights);
  EXPECT_GT(GetLargestDifference(this->RenderEncoded(), planned), 1e-2);
  EXPECT_EQ(this->Measured->GetPlan(), "");
  EXPECT_EQ(this->Measured->GetCurrentLightSet(), lights.Get());
  this->Measured->SetIntegrator(nullptr);
  EXPECT_EQ(GetLargestDifference(this->RenderEncoded(), planned), 0.0);

  vtkNew<vtkMeasuredBRDFMapper> copy;
  this->Measured->SetErrorTolerance(0.04);
  this->Measured->SetIntegrator(this->Measured->Lights);
  copy->ShallowCopy(this->Measured);
  EXPECT_EQ(copy->GetErrorTolerance(), 0.04);
  EXPECT_EQ(copy->GetIntegrator(), this->Measured->Lights.Get());
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
  EXPECT_EQ(standIn->GetNumberOfRows(), 33);
  EXPECT_EQ(this->RenderEncoded().RGBA, stopped.RGBA);
  EXPECT_EQ(errors.Count, 1);
  this->Measured->RemoveObserver(tag);
  this->Measured->SetErrorTolerance(0.003);
  EXPECT_GT(GetLargestDifference(this->RenderEncoded(), stopped), 1e-3);
  ASSERT_TRUE(this->Measured->GetCurrentPlanner());
  EXPECT_EQ(this->Measured->GetCurrentPlanner()->GetPlan(), this->Measured->GetPlan());
}

// What PlanForView plans with: normals that face the camera, in proportion to their pixels.
TEST_F(Auto, VisiblePairs)
{
  this->RenderEncoded();
  vtkNew<vtkDoubleArray> normals, views;
  this->Measured->GetVisiblePairs(this->Renderer, this->Actor, normals, views);
  ASSERT_GE(normals->GetNumberOfTuples(), 16);
  ASSERT_EQ(views->GetNumberOfTuples(), normals->GetNumberOfTuples());
  int front = 0;
  for (vtkIdType k = 0; k < normals->GetNumberOfTuples(); ++k)
  {
    double n[3], v[3];
    normals->GetTuple(k, n);
    views->GetTuple(k, v);
    EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1.0, 1e-6);
    front += n[0] * v[0] + n[1] * v[1] + n[2] * v[2] > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(front, normals->GetNumberOfTuples());
  vtkNew<vtkRadiancePlanner> planner;
  EXPECT_TRUE(planner->SetPairs(normals, views));
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
