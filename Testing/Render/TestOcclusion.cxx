// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Shading with what surfaces hide from themselves: the shaders against HorizonLight in C++, and the
// mappers' use of vtkSurfaceVisibilityFilter's arrays.
#include "AutomaticOcclusion.h"
#include "EnvironmentPrecomputation.h"
#include "MaterialShading.h"
#include "OcclusionArrays.h"
#include "OcclusionReference.h"
#include "OcclusionShader.h"
#include "OcclusionTools.h"
#include "RenderFixture.h"
#include "SharedTrace.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkCell.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkFieldData.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkOutputWindow.h"
#include "vtkPlane.h"
#include "vtkPolyDataNormals.h"
#include "vtkReverseSense.h"
#include "vtkStringArray.h"
#include "vtkStringOutputWindow.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <atomic>
#include <chrono>
#include <functional>
#include <new>
#include <random>
#include <thread>
#include <utility>

using measuredbrdf::AutomaticOcclusion;
using measuredbrdf::BouncedLight;
using measuredbrdf::HorizonLight;
using measuredbrdf::ShaderLimits;
using measuredbrdf::SharedTrace;

namespace
{
// A square that faces the camera beside a tilted wall.
vtkSmartPointer<vtkPolyData> MakeSquare(double half = 0.9, int resolution = 2)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-half, -half, 0.0);
  source->SetPoint1(half, -half, 0.0);
  source->SetPoint2(-half, half, 0.0);
  source->SetResolution(resolution, resolution);
  source->Update();
  return source->GetOutput();
}

// A hollow that is open downwards.
vtkSmartPointer<vtkPolyData> MakeBowl(int steps = 20, double x = 0.0, double radius = 0.9)
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetCenter(x, 0.0, 0.0);
  bowl->SetRadius(radius);
  bowl->SetThetaResolution(2 * steps);
  bowl->SetPhiResolution(steps);
  bowl->SetEndPhi(115.0);
  bowl->Update();
  return bowl->GetOutput();
}

// All points like this one, so that interpolation between them changes nothing.
void SpreadCode(vtkPolyData* surface, vtkIdType point)
{
  for (const char* name : { vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName(),
         vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() })
  {
    vtkUnsignedCharArray* bytes = GetBytes(surface, name);
    for (vtkIdType k = 0; k < bytes->GetNumberOfTuples(); ++k)
    {
      bytes->SetTuple(k, point, bytes);
    }
  }
}

vtkSmartPointer<vtkBRDF> MakeGloss(double exponent)
{
  auto brdf = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  brdf->SetSpecular(0.5, 0.5, 0.5);
  brdf->SetExponent(exponent);
  return brdf;
}

template <typename Integrator>
vtkSmartPointer<Integrator> MakeIntegrator()
{
  auto integrator = vtkSmartPointer<Integrator>::New();
  MakeSmall(integrator.Get());
  return integrator;
}

// Of a matte surface, in 1/sr.
glm::dvec3 GetReflectance(vtkBRDF* brdf)
{
  const double up[3] = { 0.0, 0.0, 1.0 };
  glm::dvec3 f;
  brdf->Evaluate(up, up, &f.x);
  return f;
}

glm::dvec3 ToVector(const float* pixel) { return { pixel[0], pixel[1], pixel[2] }; }
}

class OcclusionTest : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("sky"));
    // Two blocks above the square, seen from its middle to one side.
    this->Filter->AddOccluder(MakeBlock({ -1.2, 0.3, 0.7 }, 0.5));
    this->Filter->AddOccluder(MakeBlock({ 1.0, 1.0, 0.2 }, 0.9));
    this->Filter->SetInputData(MakeSquare());
    this->Filter->Update();
    this->Surface->DeepCopy(this->Filter->GetOutputDataObject(0));
    this->Mapper->SetInputData(this->Surface);
    this->Mapper->SetEnvironment(this->Environment);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
  }

  static vtkSmartPointer<vtkPolyData> MakeBlock(const glm::dvec3& center, double radius)
  {
    vtkNew<vtkSphereSource> source;
    source->SetCenter(center.x, center.y, center.z);
    source->SetRadius(radius);
    source->SetThetaResolution(20);
    source->SetPhiResolution(20);
    source->Update();
    return source->GetOutput();
  }

  glm::dvec3 RenderMiddle(int mode)
  {
    this->Mapper->SetOcclusionMode(mode);
    return ToVector(this->RenderLinear().At(32, 32));
  }

  /// What the C++ forms say, in the model's axes.
  struct Expected
  {
    glm::dvec3 HiddenIrradiance, HiddenLight;
    std::vector<double> Lamps;
  };
  Expected Evaluate(vtkBRDF* brdf, vtkRadianceIntegrator* integrator, const glm::dvec3& view)
  {
    const measuredbrdf::OcclusionLight light(brdf, this->Environment, integrator);
    const measuredbrdf::OcclusionAxes axes(this->Renderer, this->Actor, { this->Environment });
    const HorizonLight sky(GetCode(this->Surface, 4));
    const ReferenceHidden hidden = GetReferenceHidden(light, sky, view, axes.ToEnvironment[0]);
    Expected expected = { hidden.Irradiance, hidden.Lobe, {} };
    for (const glm::dvec3& lamp : light.Lamps)
    {
      expected.Lamps.push_back(sky.GetVisibleLamp(glm::transpose(axes.ToEnvironment[0]) * lamp));
    }
    return expected;
  }

  /// The camera at an angle from the square's normal.
  void Tilt(double degrees)
  {
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 5.0);
    this->Renderer->GetActiveCamera()->SetViewUp(0.0, 1.0, 0.0);
    this->Renderer->GetActiveCamera()->Azimuth(degrees);
    this->Renderer->ResetCameraClippingRange();
  }

  /// What is hidden of the square's sky all around: up to a sine of elevation to the right, and
  /// another elsewhere.
  void SetHorizons(double sine, double right)
  {
    vtkUnsignedCharArray* bytes =
      GetBytes(this->Surface, vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName());
    for (vtkIdType point = 0; point < bytes->GetNumberOfTuples(); ++point)
    {
      const double high = this->Surface->GetPoint(point)[0] > 0.1 ? right : sine;
      for (int s = 0; s < HorizonLight::Sectors; ++s)
      {
        bytes->SetTypedComponent(point, 3 + 2 * s, 0);
        bytes->SetTypedComponent(
          point, 4 + 2 * s, static_cast<unsigned char>(std::lround(255.0 * high)));
      }
    }
    bytes->Modified();
    this->Surface->Modified();
  }

  /// What was hidden is visible, and the other way round: sectors have openings then, as in
  /// hollows.
  void TurnInsideOut()
  {
    const HorizonLight::Rays rays(8);
    const HorizonLight::Code all = HorizonLight::Encode({ 0.0, 0.0, 1.0 }, rays,
      std::vector<char>(rays.GetDirections().size(), 1), [](const glm::dvec3&) { return true; });
    vtkUnsignedCharArray* sky =
      GetBytes(this->Surface, vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName());
    vtkUnsignedCharArray* light =
      GetBytes(this->Surface, vtkSurfaceVisibilityFilter::GetHiddenLightArrayName());
    for (vtkIdType point = 0; point < sky->GetNumberOfTuples(); ++point)
    {
      unsigned char* bounds = sky->GetPointer(point * HorizonLight::SectorBytes) + 3;
      for (int s = 0; s < HorizonLight::Sectors; ++s)
      {
        std::swap(bounds[2 * s], bounds[2 * s + 1]);
      }
      unsigned char* transfer = light->GetPointer(point * HorizonLight::TransferBytes);
      for (int j = 0; j < HorizonLight::TransferBytes; ++j)
      {
        const int whole = all[HorizonLight::SectorBytes + j];
        transfer[j] = static_cast<unsigned char>(
          std::clamp(HorizonLight::OpenTransfer + whole - transfer[j], 0, 255));
      }
    }
    sky->Modified();
    light->Modified();
    this->Surface->Modified();
  }

  glm::dvec3 GetView() const
  {
    glm::dvec3 p;
    this->Renderer->GetActiveCamera()->GetPosition(&p.x);
    return glm::normalize(p);
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkSurfaceVisibilityFilter> Filter;
  vtkNew<vtkPolyData> Surface;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

// A matte surface: the picture lacks albedo / pi times the hidden irradiance.
TEST_F(OcclusionTest, MatteSurfacesLackTheHiddenIrradiance)
{
  SpreadCode(this->Surface, 4);
  vtkNew<vtkLambertBRDF> brdf;
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(table);
  const glm::dvec3 f = GetReflectance(brdf);
  double largest = 0.0;
  for (const double rotation : { 0.0, 100.0, 200.0 })
  {
    this->Environment->SetRotationY(rotation);
    const glm::dvec3 off = this->RenderMiddle(0);
    const glm::dvec3 on = this->RenderMiddle(1);
    const Expected expected = this->Evaluate(brdf, table, this->GetView());
    const glm::dvec3 wanted = off - f * expected.HiddenIrradiance;
    EXPECT_LT(glm::length(on - wanted), 2e-3 * glm::length(off)) << rotation;
    largest = std::max(largest, glm::length(off - on) / glm::length(off));
  }
  EXPECT_GT(largest, 0.02);
}

// A glossy one: a share of its lobe's light, per channel, from several views.
TEST_F(OcclusionTest, LobesLackTheirHiddenShare)
{
  SpreadCode(this->Surface, 4);
  const auto brdf = MakeGloss(40.0);
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(table);
  double largest[2] = { 0.0, 0.0 }; // hidden between bounds, visible between them
  double least = 1.0;
  for (const double degrees : { 0.0, 35.0, -35.0, 60.0, -60.0 })
  {
    for (const bool isOpening : { false, true })
    {
      this->Tilt(degrees);
      const glm::dvec3 off = this->RenderMiddle(0);
      const glm::dvec3 on = this->RenderMiddle(1);
      const Expected expected = this->Evaluate(brdf, table, this->GetView());
      EXPECT_LT(glm::length(on - off * (1.0 - expected.HiddenLight)), 3e-3 * glm::length(off))
        << degrees << ", " << isOpening;
      largest[isOpening ? 1 : 0] = std::max(largest[isOpening ? 1 : 0], expected.HiddenLight.x);
      least = isOpening ? std::min(least, expected.HiddenLight.x) : least;
      this->TurnInsideOut();
    }
  }
  EXPECT_GT(largest[0], 0.1);
  EXPECT_GT(largest[1], 0.5);
  EXPECT_LT(least, 0.95);
}

// The lobe of a material is cos(theta) exp(p . d): it has the kernel's mean direction, also where
// the horizon cuts it off, and its integral is that of the function.
TEST_F(OcclusionTest, LobesHaveTheKernelsMean)
{
  vtkNew<vtkLambertBRDF> matte; // whole, as one lobe: p is 0
  const measuredbrdf::OcclusionLobes flat = measuredbrdf::FindOcclusionLobes(matte, true);
  for (const auto& lobe : flat)
  {
    EXPECT_LT(std::hypot(lobe.Across, lobe.Along), 0.05);
    EXPECT_NEAR(lobe.Integral, vtkMath::Pi(), 0.1);
  }
  const auto gloss = MakeGloss(20.0);
  const measuredbrdf::OcclusionLobes lobes = measuredbrdf::FindOcclusionLobes(gloss, false);
  for (const double degrees : { 0.0, 30.0, 60.0, 80.0 })
  {
    const double theta = vtkMath::RadiansFromDegrees(degrees);
    const glm::dvec3 view(std::sin(theta), 0.0, std::cos(theta));
    const ReferenceLobe lobe(lobes, { 0.0, 0.0, 1.0 }, view);
    const glm::dvec3 slope = lobe.Slope;
    glm::dvec3 kernel(0.0);
    glm::dvec3 model(0.0);
    double energy = 0.0;
    double integral = 0.0;
    constexpr int rows = 200;
    for (int k = 0; k < rows * rows; ++k)
    {
      const double z = (k / rows + 0.5) / rows; // cells of equal area
      const double azimuth = 2.0 * vtkMath::Pi() * (k % rows + 0.5) / rows;
      const double s = std::sqrt(1.0 - z * z);
      const glm::dvec3 d(s * std::cos(azimuth), s * std::sin(azimuth), z);
      double f[3];
      gloss->Evaluate(&d.x, &view.x, f);
      const double part = z * std::exp(glm::dot(slope, d) - glm::length(slope));
      kernel += f[0] * z * d;
      energy += f[0] * z;
      model += part * d;
      integral += part;
    }
    EXPECT_LT(glm::length(model / integral - kernel / energy), 0.01) << degrees;
    EXPECT_NEAR(lobe.Lobe.Integral * rows * rows / (2.0 * vtkMath::Pi() * integral), 1.0, 0.05)
      << degrees;
  }
}

// Lamps on their own: what a hybrid shows more than its rest is what of them is visible.
TEST_F(OcclusionTest, LampsAreHiddenOneByOne)
{
  SpreadCode(this->Surface, 4);
  vtkNew<vtkLambertBRDF> brdf;
  const auto hybrid = MakeIntegrator<vtkHybridRadianceIntegrator>();
  hybrid->SetMaximumNumberOfLights(2); // so few are evaluated everywhere
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(hybrid);
  const glm::dvec3 f = GetReflectance(brdf);
  const auto lamps = this->Environment->GetParts().GetLamps(this->Environment,
    vtkMath::RadiansFromDegrees(hybrid->GetLightAngle()), hybrid->GetMaximumNumberOfLights(),
    []() { return true; });
  int dark[2] = { 0, 0 }; // hidden between bounds, visible between them
  int lit[2] = { 0, 0 };
  for (double rotation = 0.0; rotation < 720.0; rotation += 60.0)
  {
    this->Environment->SetRotationY(rotation);
    if (rotation == 360.0)
    {
      this->TurnInsideOut();
    }
    const glm::dvec3 off = this->RenderMiddle(0);
    const glm::dvec3 on = this->RenderMiddle(1);
    const Expected expected = this->Evaluate(brdf, hybrid, this->GetView());
    ASSERT_EQ(expected.Lamps.size(), lamps->Lights.size());
    glm::dvec3 hidden = expected.HiddenIrradiance;
    const measuredbrdf::OcclusionAxes axes(this->Renderer, this->Actor, { this->Environment });
    for (std::size_t k = 0; k < lamps->Lights.size(); ++k)
    {
      const double cosine = (glm::transpose(axes.ToEnvironment[0]) * lamps->Lights[k].Direction).z;
      hidden += (1.0 - expected.Lamps[k]) * std::max(cosine, 0.0) * lamps->Lights[k].Irradiance;
      dark[rotation < 360.0 ? 0 : 1] += cosine > 0.0 && expected.Lamps[k] < 0.5 ? 1 : 0;
      lit[rotation < 360.0 ? 0 : 1] += cosine > 0.0 && expected.Lamps[k] > 0.5 ? 1 : 0;
    }
    const glm::dvec3 wanted = off - f * hidden;
    EXPECT_LT(glm::length(on - wanted), 3e-3 * glm::length(off)) << rotation;
  }
  for (const int kind : { 0, 1 })
  {
    EXPECT_GT(lit[kind], 0) << kind;
    EXPECT_GT(dark[kind], 0) << kind;
  }
}

// What a table holds of lamps beside a lobe's axis goes with these, not with the rest of the sky:
// three lamps about the normal, a horizon just above them or just below.
TEST_F(OcclusionTest, LampsBesideTheAxisTakeTheirPartOfTheLobe)
{
  SpreadCode(this->Surface, 4);
  this->Tilt(0.0);
  constexpr double sine = 0.62; // 52 degrees from the axis: outside of the window
  std::vector<float> pixels(3 * 128 * 64, 0.02f);
  const measuredbrdf::OcclusionAxes axes(this->Renderer, this->Actor, { this->Environment });
  for (int k = 0; k < 3; ++k)
  {
    const double azimuth = 0.3 + 2.0 * vtkMath::Pi() * k / 3.0;
    const double across = std::sqrt(1.0 - sine * sine);
    const glm::dvec3 d = axes.ToEnvironment[0] *
                         glm::dvec3(across * std::cos(azimuth), across * std::sin(azimuth), sine);
    double u, v;
    vtkEnvironment::GetCoordinates(&d.x, u, v);
    const int texel = 128 * static_cast<int>(64.0 * v) + static_cast<int>(128.0 * u);
    std::fill_n(pixels.begin() + 3 * texel, 3, 1000.0f);
  }
  this->Environment->SetPixels(128, 64, pixels);
  const auto brdf = MakeGloss(5.0);
  const auto hybrid = MakeIntegrator<vtkHybridRadianceIntegrator>();
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(hybrid);
  const glm::dvec3 off = this->RenderMiddle(0);
  const measuredbrdf::OcclusionLight light(brdf, this->Environment, hybrid);
  ASSERT_EQ(light.LampLight.size(), 3u);
  for (const double height : { 0.12, -0.12 })
  {
    this->SetHorizons(sine + height, sine + height);
    const glm::dvec3 on = this->RenderMiddle(1);
    const Expected expected = this->Evaluate(brdf, hybrid, this->GetView());
    EXPECT_LT(glm::length(on - off * (1.0 - expected.HiddenLight)), 3e-3 * glm::length(off))
      << height;
    // Hidden as the rest is, 30 % would be left behind the upper horizon.
    EXPECT_NEAR(on.y / off.y, height > 0.0 ? 0.0 : 1.0, 0.1) << height;
  }
}

// Between points the place of a shadow's edge is interpolated, not what is visible: a lamp just
// behind the horizon of one point, far above that of the next one, is visible halfway.
TEST_F(OcclusionTest, ShadowEdgesCrossTriangles)
{
  std::vector<float> pixels(3 * 128 * 64, 0.02f);
  for (int c = 0; c < 3; ++c)
  {
    pixels[3 * (128 * 24 + 40) + c] = 2000.0f;
  }
  this->Environment->SetPixels(128, 64, pixels);
  vtkNew<vtkLambertBRDF> brdf;
  const auto hybrid = MakeIntegrator<vtkHybridRadianceIntegrator>();
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(hybrid);
  const measuredbrdf::OcclusionLight light(brdf, this->Environment, hybrid);
  ASSERT_EQ(light.Lamps.size(), 1u);
  double sine = -1.0;
  for (double rotation = 0.0; sine < 0.4 && rotation < 360.0; rotation += 10.0)
  {
    this->Environment->SetRotationY(rotation);
    const measuredbrdf::OcclusionAxes turned(this->Renderer, this->Actor, { this->Environment });
    sine = (glm::transpose(turned.ToEnvironment[0]) * light.Lamps[0]).z;
  }
  ASSERT_GT(sine, 0.4);
  ASSERT_LT(sine, 0.9);
  // Horizons all around: half a width above the lamp to the right, elsewhere far below or above it.
  const auto render = [&](double margin)
  {
    this->SetHorizons(sine - 0.04 * margin, sine + 0.5 * 0.04);
    this->Mapper->SetOcclusionMode(1);
    return this->RenderLinear();
  };
  this->Tilt(0.0);
  const FloatImage open = render(2.5);
  const FloatImage closed = render(-2.5);
  // Two fifths of the way to the right, the margin is 1.3; of what is visible, 0.6 would be.
  EXPECT_GT(open.At(40, 32)[0], 0.97 * open.At(32, 32)[0]);
  EXPECT_LT(closed.At(40, 32)[0], 0.3 * open.At(32, 32)[0]);
}

// Likewise the odds of what is hidden of a lobe.
TEST_F(OcclusionTest, OddsOfLobesAreInterpolated)
{
  const auto brdf = MakeGloss(40.0);
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  this->Environment->SetPixels(4, 2, std::vector<float>(24, 0.5f));
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(table);
  this->SetHorizons(0.62, 0.99);
  this->Tilt(0.0);
  this->Mapper->SetOcclusionMode(0);
  const FloatImage off = this->RenderLinear();
  this->Mapper->SetOcclusionMode(1);
  const FloatImage on = this->RenderLinear();
  const measuredbrdf::OcclusionLight light(brdf, this->Environment, table);
  const measuredbrdf::OcclusionAxes axes(this->Renderer, this->Actor, { this->Environment });
  const auto getHidden = [&](vtkIdType point)
  {
    const glm::dvec3 view = 5.0 * this->GetView() - glm::make_vec3(this->Surface->GetPoint(point));
    const HorizonLight sky(GetCode(this->Surface, point));
    return GetReferenceHidden(light, sky, glm::normalize(view), axes.ToEnvironment[0]).Lobe.x;
  };
  const double few = getHidden(4);
  const double many = getHidden(5);
  ASSERT_GT(many - few, 0.3);
  const auto column = [&](double x)
  {
    this->Renderer->SetWorldPoint(x, 0.0, 0.0, 1.0);
    this->Renderer->WorldToDisplay();
    return this->Renderer->GetDisplayPoint()[0];
  };
  const double across = (40.5 - column(0.0)) / (column(0.9) - column(0.0));
  const auto odds = [](double share)
  { return std::log((0.002 + 0.996 * share) / (0.998 - 0.996 * share)); };
  const double between = (1.0 - across) * odds(few) + across * odds(many);
  const double wanted = (1.0 / (1.0 + std::exp(-between)) - 0.002) / 0.996;
  EXPECT_NEAR(1.0 - on.At(40, 32)[0] / off.At(40, 32)[0], wanted, 0.02);
  EXPECT_GT(few + across * (many - few), wanted + 0.1); // between the shares
}

// Large panels: each is hidden on its own, of matte surfaces and in lobes.
TEST_F(OcclusionTest, PanelsAreHiddenOneByOne)
{
  SpreadCode(this->Surface, 4);
  std::vector<float> pixels(3 * 64 * 32, 0.05f);
  for (const auto& [row, column] : { std::pair(8, 5), std::pair(11, 20), std::pair(6, 43) })
  {
    for (int k = 0; k < 16; ++k)
    {
      const int at = 3 * (64 * (row + k / 4) + column + k % 4);
      pixels[at] = 8.0f;
      pixels[at + 1] = 6.0f;
      pixels[at + 2] = static_cast<float>(row);
    }
  }
  this->Environment->SetPixels(64, 32, pixels);
  vtkNew<vtkLambertBRDF> matte;
  const auto gloss = MakeGloss(20.0);
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  ASSERT_GE(measuredbrdf::OcclusionLight(matte, this->Environment, table).Panels.size(), 3u);
  const glm::dvec3 f = GetReflectance(matte);
  double largest[2] = { 0.0, 0.0 }; // hidden between bounds, visible between them
  for (const double rotation : { 0.0, 60.0, 150.0, 270.0, 360.0, 420.0, 510.0 })
  {
    if (rotation == 360.0)
    {
      this->TurnInsideOut();
    }
    this->Tilt(0.2 * std::fmod(rotation, 360.0) - 20.0);
    this->Environment->SetRotationY(rotation);
    this->Mapper->SetBRDF(matte);
    this->Mapper->SetIntegrator(table);
    const glm::dvec3 off = this->RenderMiddle(0);
    const glm::dvec3 on = this->RenderMiddle(1);
    const Expected expected = this->Evaluate(matte, table, this->GetView());
    const glm::dvec3 wanted = off - f * expected.HiddenIrradiance;
    EXPECT_LT(glm::length(on - wanted), 2e-3 * glm::length(off)) << rotation;
    double& most = largest[rotation < 360.0 ? 0 : 1];
    most = std::max(most, glm::length(off - on) / glm::length(off));
    const auto other = MakeIntegrator<vtkTableRadianceIntegrator>();
    this->Mapper->SetBRDF(gloss);
    this->Mapper->SetIntegrator(other);
    const glm::dvec3 shiny = this->RenderMiddle(0);
    const glm::dvec3 left =
      shiny * (1.0 - this->Evaluate(gloss, other, this->GetView()).HiddenLight);
    EXPECT_LT(glm::length(this->RenderMiddle(1) - left), 3e-3 * glm::length(shiny)) << rotation;
  }
  EXPECT_GT(largest[0], 0.1);
  EXPECT_GT(largest[1], 0.3);
  // What sectors hide and harmonics do not are slivers, which hide no panel.
  GetBytes(this->Surface, vtkSurfaceVisibilityFilter::GetHiddenLightArrayName())
    ->Fill(HorizonLight::OpenTransfer);
  this->SetHorizons(0.9, 0.9);
  this->Mapper->SetBRDF(matte);
  this->Mapper->SetIntegrator(table);
  const glm::dvec3 open = this->RenderMiddle(0);
  EXPECT_LT(glm::length(this->RenderMiddle(1) - open), 1e-3 * glm::length(open));
}

// Other methods take all that is reflected as one lobe, which of a matte surface is a cosine: it
// loses about what the matte part of a table does.
TEST_F(OcclusionTest, OtherMethodsAreDarkened)
{
  vtkNew<vtkLambertBRDF> brdf;
  this->Mapper->SetBRDF(brdf);
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  this->Mapper->SetIntegrator(table);
  const double all = this->RenderMiddle(0).x;
  const double left = this->RenderMiddle(1).x / all;
  vtkNew<vtkFilteredRadianceIntegrator> filtered;
  this->Mapper->SetIntegrator(filtered);
  const glm::dvec3 off = this->RenderMiddle(0);
  const glm::dvec3 on = this->RenderMiddle(1);
  EXPECT_LT(on.x, 0.97 * off.x);
  EXPECT_NEAR(on.x / off.x, left, 0.05);
}

// A turned, mirrored and stretched actor under a turned environment shows what the same surface
// shows that was moved before it was traced.
TEST_F(OcclusionTest, ActorsMayBeTurnedMirroredAndScaled)
{
  SpreadCode(this->Surface, 4);
  vtkNew<vtkLambertBRDF> brdf;
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(table);
  const glm::dvec3 before = this->RenderMiddle(1);
  const glm::dvec3 off = this->RenderMiddle(0);
  // Half a turn of all about the view's axis: surface, light, and nothing else.
  this->Actor->RotateZ(180.0);
  this->Actor->SetScale(0.5);
  this->Renderer->SetEnvironmentUp(0.0, -1.0, 0.0);
  this->Renderer->SetEnvironmentRight(-1.0, 0.0, 0.0);
  EXPECT_GT(glm::length(off - before), 0.01 * glm::length(off));
  EXPECT_LT(glm::length(this->RenderMiddle(1) - before), 1e-3 * glm::length(off));
  // A mirror image, left for right, of a surface whose corners run the other way round: VTK takes
  // other mirrored surfaces for seen from behind.
  vtkNew<vtkReverseSense> reversed;
  reversed->SetInputData(MakeSquare());
  reversed->Update();
  this->Filter->SetInputData(reversed->GetOutput());
  this->Filter->Update();
  this->Surface->DeepCopy(this->Filter->GetOutputDataObject(0));
  SpreadCode(this->Surface, 4);
  this->Actor->SetOrientation(0.0, 0.0, 0.0);
  this->Actor->SetScale(-1.0, 1.0, 1.0);
  this->Renderer->SetEnvironmentUp(0.0, 1.0, 0.0);
  this->Renderer->SetEnvironmentRight(1.0, 0.0, 0.0);
  const glm::dvec3 mirrored = this->RenderMiddle(1);
  const glm::dvec3 lit = this->RenderMiddle(0);
  EXPECT_GT(glm::length(lit - mirrored), 0.01 * glm::length(lit));
  const measuredbrdf::OcclusionLight light(brdf, this->Environment, table);
  const measuredbrdf::OcclusionAxes axes(this->Renderer, this->Actor, { this->Environment });
  const glm::dvec3 f = GetReflectance(brdf);
  const glm::dvec3 hidden = HorizonLight(GetCode(this->Surface, 4))
                              .GetHiddenIrradiance(light.GetLight(axes.ToEnvironment[0]));
  EXPECT_LT(glm::length(lit - f * hidden - mirrored), 2e-3 * glm::length(lit));
}

// A bowl, seen from outside, hides nothing there and much inside. Each triangle shows its own side,
// also at the outline, where the normals of its points face different ways; whichever way normals
// and corners run. And from inside.
TEST_F(OcclusionTest, NormalsMayPointEitherWay)
{
  const auto bowl = MakeBowl();
  vtkNew<vtkReverseSense> reversed;
  reversed->SetInputData(bowl);
  reversed->ReverseNormalsOn();
  reversed->Update();
  vtkNew<vtkLambertBRDF> brdf;
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(table);
  const auto render = [&](vtkPolyData* surface, int mode, double side)
  {
    this->Mapper->SetInputData(surface);
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 5.0 * side);
    this->Mapper->SetOcclusionMode(mode);
    return this->RenderLinear();
  };
  const auto compare = [](const FloatImage& one, const FloatImage& other)
  {
    double largest = 0.0;
    for (std::size_t k = 0; k < one.RGBA.size(); k += 4)
    {
      const double scale = std::max(one.RGBA[k], 1e-3f);
      largest = std::max(largest, std::abs(one.RGBA[k] - other.RGBA[k]) / scale);
    }
    return largest;
  };
  FloatImage inside;
  for (vtkPolyData* surface : { bowl.Get(), reversed->GetOutput() })
  {
    const FloatImage open = render(surface, 0, 1.0);
    EXPECT_GT(open.At(32, 32)[0], 0.1f);
    EXPECT_LT(compare(open, render(surface, 2, 1.0)), 0.02);
    const FloatImage within = render(surface, 2, -1.0);
    EXPECT_LT(within.At(32, 32)[0], 0.5f * render(surface, 0, -1.0).At(32, 32)[0]);
    EXPECT_LT(inside.RGBA.empty() ? 0.0 : compare(inside, within), 0.03);
    inside = within;
  }
}

// Auto makes the arrays where leaving occlusion out costs more than the tolerance leaves, and says
// so.
TEST_F(OcclusionTest, AutoModelsWhatIsWorthIt)
{
  const auto bowl = MakeBowl();
  vtkNew<vtkLambertBRDF> brdf;
  this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, -5.0); // into it
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetInputData(bowl);
  const glm::dvec3 off = this->RenderMiddle(0);
  EXPECT_EQ(this->Mapper->GetPlan().find("unoccluded"), std::string::npos);
  const glm::dvec3 on = this->RenderMiddle(2);
  EXPECT_LT(on.x, 0.7 * off.x);
  EXPECT_LT(glm::length(this->RenderMiddle(1) - on), 1e-5 * off.x);
  const std::string plan = this->Mapper->GetPlan();
  EXPECT_NE(plan.find("; unoccluded light: "), std::string::npos) << plan;
  EXPECT_NE(plan.find(", modeled"), std::string::npos) << plan;
  // A rotation changes nothing about it.
  this->Environment->SetRotationY(40.0);
  EXPECT_LT(this->RenderMiddle(1).x, 0.8 * off.x);
  EXPECT_EQ(this->Mapper->GetPlan(), plan);
  this->Environment->SetRotationY(0.0);
  // Not for a hand-set method, and not where the tolerance allows for it.
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  this->Mapper->SetIntegrator(table);
  EXPECT_GT(this->RenderMiddle(1).x, 0.9 * off.x);
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetErrorTolerance(1.0);
  EXPECT_GT(this->RenderMiddle(1).x, 0.9 * off.x);
  EXPECT_NE(this->Mapper->GetPlan().find("within the tolerance"), std::string::npos);
  // A ball hides nothing.
  vtkNew<vtkSphereSource> ball;
  this->Mapper->SetErrorTolerance(0.02);
  this->Mapper->SetInputConnection(ball->GetOutputPort());
  this->RenderMiddle(1);
  EXPECT_EQ(this->Mapper->GetPlan().find("unoccluded"), std::string::npos)
    << this->Mapper->GetPlan();
}

// On a thread the same arrays are made, and a surface that never rests is left alone.
TEST_F(OcclusionTest, ForecastsFollowTheSurface)
{
  const auto bowl = MakeBowl();
  vtkNew<vtkLambertBRDF> brdf;
  measuredbrdf::OcclusionQuestion question;
  question.Input = bowl;
  question.Materials.push_back(
    { brdf.Get(), this->Environment, this->Environment->GetPixelsMTime(), 0.01 });
  measuredbrdf::AutomaticOcclusion here;
  here.Update(question);
  EXPECT_FALSE(here.IsPending());
  ASSERT_TRUE(here.GetTraced());
  EXPECT_GT(here.GetError(), 0.1);
  measuredbrdf::AutomaticOcclusion there;
  question.InBackground = true;
  there.Update(question);
  EXPECT_FALSE(there.GetTraced());
  EXPECT_TRUE(there.IsPending());
  while (there.IsPending())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    there.Update(question);
  }
  ASSERT_TRUE(there.GetTraced());
  EXPECT_EQ(there.GetText(), here.GetText());
  EXPECT_EQ(GetCode(vtkPolyData::SafeDownCast(there.GetTraced()), 77),
    GetCode(vtkPolyData::SafeDownCast(here.GetTraced()), 77));
  // Other colors on the same points are no other surface.
  question.InBackground = false;
  vtkDataObject* traced = here.GetTraced();
  vtkNew<vtkPolyData> same;
  same->DeepCopy(bowl);
  question.Input = same;
  here.Update(question);
  EXPECT_EQ(here.GetTraced(), traced);
  // Two views with different questions, in turns: each is answered once, the arrays serve both.
  vtkNew<vtkLambertBRDF> second;
  measuredbrdf::OcclusionQuestion other = question;
  other.Materials[0].BRDF = second;
  here.Update(other);
  EXPECT_EQ(here.GetTraced(), traced);
  question.InBackground = true;
  here.Update(question);
  EXPECT_FALSE(here.IsPending());
  EXPECT_EQ(here.GetTraced(), traced);
  question.InBackground = false;
  for (int frame = 0; frame < 6; ++frame)
  {
    same->GetPoints()->SetPoint(0, 0.0, 0.0, 0.9 + 0.001 * frame);
    same->GetPoints()->Modified();
    here.Update(question);
    EXPECT_EQ(here.GetTraced() != nullptr, frame < 4) << frame;
  }
  EXPECT_NE(here.GetText().find("while the surface changes"), std::string::npos);
  here.Update(question); // it rests
  EXPECT_TRUE(here.GetTraced());
}

// Layers of translucent surfaces, in a window that goes before the mapper.
TEST_F(OcclusionTest, PeelingReportsNothing)
{
  vtkNew<vtkStringOutputWindow> messages;
  vtkOutputWindow::SetInstance(messages);
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetUseDepthPeeling(true);
    renderer->SetMaximumNumberOfPeels(4);
    renderer->AddActor(this->Actor);
    this->Actor->GetProperty()->SetOpacity(0.5);
    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetAlphaBitPlanes(1);
    window->SetSize(32, 32);
    window->AddRenderer(renderer);
    window->Render();
    window->Render();
  }
  this->RenderLinear();
  vtkOutputWindow::SetInstance(nullptr);
  EXPECT_EQ(messages->GetOutput(), "");
}

// A side that sees nothing of the sky, as the inside of a closed surface, costs nothing.
TEST_F(OcclusionTest, ClosedSidesAreLeftOut)
{
  vtkNew<vtkSphereSource> ball;
  vtkNew<vtkReverseSense> reversed;
  reversed->SetInputConnection(ball->GetOutputPort());
  reversed->ReverseNormalsOn();
  this->Filter->RemoveAllOccluders();
  this->Filter->BothSidesOn();
  this->Filter->SetInputConnection(reversed->GetOutputPort());
  this->Filter->Update();
  std::string problem;
  const auto arrays = measuredbrdf::OcclusionArrays::Read(
    vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0)), false, false, problem);
  ASSERT_TRUE(arrays) << problem;
  EXPECT_FALSE(arrays->HasBack());
  EXPECT_TRUE(arrays->IsOtherClosed);
  // Triangles and normals of a ball of 8 x 8 are up to 26 degrees apart.
  EXPECT_LT(arrays->LeastCosine, -0.1);
  EXPECT_GT(arrays->LeastCosine, -0.6);
}

// Bytes of anything: no pixel is negative or not finite, and nothing is warned of.
TEST_F(OcclusionTest, AnyBytesGiveAPicture)
{
  std::mt19937 generator(5);
  const auto brdf = MakeGloss(40.0);
  const auto hybrid = MakeIntegrator<vtkHybridRadianceIntegrator>();
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(hybrid);
  const EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
  for (int k = 0; k < 3; ++k)
  {
    for (const char* name : { vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName(),
           vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() })
    {
      vtkUnsignedCharArray* bytes = GetBytes(this->Surface, name);
      for (vtkIdType v = 0; v < bytes->GetNumberOfValues(); ++v)
      {
        bytes->SetValue(v, k == 0 ? 255 : static_cast<unsigned char>(generator() % 256));
      }
      bytes->Modified();
    }
    this->Surface->Modified();
    for (const float value : this->RenderEncoded().RGBA)
    {
      ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << k;
    }
  }
  EXPECT_EQ(warnings.Count, 0);
}

// Arrays of another shape, type or size: one warning, drawn without.
TEST_F(OcclusionTest, BadArraysAreSaidOnceAndNotUsed)
{
  vtkNew<vtkLambertBRDF> brdf;
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(table);
  const glm::dvec3 off = this->RenderMiddle(0);
  const auto expectOff = [&](const char* words)
  {
    EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
    EXPECT_LT(glm::length(this->RenderMiddle(1) - off), 1e-5 * off.x) << words;
    this->RenderMiddle(1);
    ASSERT_EQ(warnings.Texts.size(), 1u) << words;
    EXPECT_NE(warnings.Texts[0].find(words), std::string::npos) << warnings.Texts[0];
  };
  vtkNew<vtkPolyData> good;
  good->DeepCopy(this->Surface);
  const char* const sky = vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName();
  const char* const light = vtkSurfaceVisibilityFilter::GetHiddenLightArrayName();
  const std::pair<const char*, std::function<void(vtkPolyData*)>> faults[] = {
    { "have changed",
      [](vtkPolyData* surface) { surface->GetPoints()->SetPoint(0, -0.8, -0.9, 0.0); } },
    { "of this version",
      [](vtkPolyData* surface)
      {
        auto* key = vtkStringArray::SafeDownCast(
          surface->GetFieldData()->GetAbstractArray(vtkSurfaceVisibilityFilter::GetKeyArrayName()));
        key->SetValue(0, "3" + std::string(key->GetValue(0)).substr(1)); // an older one
      } },
    { "is missing", [=](vtkPolyData* surface) { surface->GetPointData()->RemoveArray(light); } },
    { "has 3 tuples", [=](vtkPolyData* surface) { GetBytes(surface, sky)->SetNumberOfTuples(3); } },
    { "is of type float",
      [=](vtkPolyData* surface)
      {
        vtkNew<vtkFloatArray> numbers;
        numbers->DeepCopy(surface->GetPointData()->GetArray(light));
        numbers->Fill(std::numeric_limits<double>::quiet_NaN());
        surface->GetPointData()->AddArray(numbers); // in place of the bytes
      } }
  };
  for (const auto& [words, spoil] : faults)
  {
    this->Surface->DeepCopy(good);
    spoil(this->Surface);
    this->Surface->GetPoints()->Modified();
    this->Surface->Modified();
    expectOff(words);
  }
}

//------------------------------------------------------------------------------
// Hidden skies of composite data: some blocks have vtkSurfaceVisibilityFilter's arrays, others do
// not; and many blocks.
namespace
{
// Blocks that count how often they are listed.
class CountedBlocks : public vtkMultiBlockDataSet
{
public:
  static CountedBlocks* New();
  vtkTypeMacro(CountedBlocks, vtkMultiBlockDataSet);
  vtkCompositeDataIterator* NewIterator() override
  {
    ++Listings;
    return this->Superclass::NewIterator();
  }
  static int Listings;
};

int CountedBlocks::Listings = 0;
vtkStandardNewMacro(CountedBlocks);

vtkSmartPointer<CountedBlocks> MakeTriangles(int count)
{
  auto blocks = vtkSmartPointer<CountedBlocks>::New();
  for (int k = 0; k < count; ++k)
  {
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(k % 100, k / 100, 0.0);
    points->InsertNextPoint(k % 100 + 0.9, k / 100, 0.0);
    points->InsertNextPoint(k % 100, k / 100 + 0.9, 0.0);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1, 2 });
    vtkNew<vtkPolyData> triangle;
    triangle->SetPoints(points);
    triangle->SetPolys(cells);
    blocks->SetBlock(static_cast<unsigned int>(k), triangle);
  }
  return blocks;
}
}

class OcclusionBlocks : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("sky"));
    this->Mapper->SetBRDF(this->BRDF);
    this->Mapper->SetEnvironment(this->Environment);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, -5.0); // into the hollows
  }

  /// In the middle of either bowl.
  struct Pair
  {
    float Given;
    float Bare;
  };
  Pair Show(int mode, vtkPolyData* given, vtkPolyData* bare)
  {
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, given);
    blocks->SetBlock(1, bare);
    blocks->SetBlock(3, vtkNew<vtkPolyData>()); // counts for nothing
    this->Mapper->SetInputDataObject(blocks);
    this->Mapper->SetOcclusionMode(mode);
    this->Renderer->ResetCameraClippingRange();
    const FloatImage picture = this->RenderLinear();
    // x = -0.5 lies to the right, as seen from below.
    return { picture.At(48, 32)[0], picture.At(16, 32)[0] };
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkLambertBRDF> BRDF;
  vtkNew<vtkCompositeMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

// Each block with its own arrays where it has some, here of a bowl behind a lid; the others as the
// mode says. The plan says how many have some.
TEST_F(OcclusionBlocks, SomeHaveArrays)
{
  const auto one = MakeBowl(20, -0.5, 0.42);
  const auto other = MakeBowl(20, 0.5, 0.42);
  vtkNew<vtkSphereSource> lid;
  lid->SetCenter(-0.5, 0.0, -0.9);
  lid->SetRadius(0.6);
  lid->Update();
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputData(one);
  filter->BothSidesOn();
  filter->AddOccluder(lid->GetOutput());
  filter->Update();
  auto* given = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  const auto plan = [this]() { return this->Mapper->GetPlan(); };
  const auto has = [&plan](const std::string& text)
  { return plan().find(text) != std::string::npos; };

  const Pair off = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_OFF, given, other);
  EXPECT_FALSE(has("hidden sky")) << plan();
  const Pair traced = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ON, one, other);
  EXPECT_FALSE(has("hidden sky")) << plan();
  ASSERT_GT(off.Given, 0.05f);
  EXPECT_LT(traced.Bare, 0.8f * off.Bare);

  const Pair arrays = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ARRAYS, given, other);
  EXPECT_LT(arrays.Given, 0.8f * traced.Given); // behind the lid
  EXPECT_NEAR(arrays.Bare, off.Bare, 1e-5f);
  EXPECT_TRUE(has("; hidden sky is given for 1 of 2 blocks, left out of the others")) << plan();

  const Pair on = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ON, given, other);
  EXPECT_NEAR(on.Given, arrays.Given, 1e-5f);
  EXPECT_NEAR(on.Bare, traced.Bare, 1e-5f);
  EXPECT_TRUE(has("; hidden sky is given for 1 of 2 blocks, traced for the others")) << plan();

  const Pair automatic = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_AUTO, given, other);
  EXPECT_NEAR(automatic.Given, arrays.Given, 1e-5f);
  EXPECT_NEAR(automatic.Bare, traced.Bare, 1e-5f);
  EXPECT_TRUE(has("%), modeled; hidden sky is given for 1 of 2 blocks")) << plan();
  EXPECT_EQ(plan().find("hidden sky"), plan().rfind("hidden sky")) << plan();

  // Arrays that are of another surface by now.
  vtkNew<vtkPolyData> moved;
  moved->DeepCopy(given);
  double point[3];
  moved->GetPoint(0, point);
  moved->GetPoints()->SetPoint(0, point[0], point[1], point[2] + 1e-4);
  this->Mapper->GlobalWarningDisplayOff();
  const Pair stale = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ARRAYS, moved, other);
  this->Mapper->GlobalWarningDisplayOn();
  EXPECT_NEAR(stale.Given, off.Given, 1e-3f);
  this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ARRAYS, given, other);

  vtkNew<vtkTableRadianceIntegrator> table; // nothing is predicted for it
  this->Mapper->SetIntegrator(table);
  const Pair bySet = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_AUTO, given, other);
  EXPECT_LT(bySet.Given, 0.9f * traced.Given);
  EXPECT_GT(bySet.Bare, 0.9f * off.Bare);
  EXPECT_TRUE(has("left out of the others")) << plan();
}

// A block that moves shows on the others.
TEST_F(OcclusionBlocks, OneThatMovesShowsOnTheOthers)
{
  const auto bowl = MakeBowl(20, -0.5, 0.42);
  vtkNew<vtkSphereSource> source;
  source->SetRadius(0.5);
  source->SetCenter(-0.5, 0.7, -0.5);
  source->Update();
  vtkSmartPointer<vtkPolyData> ball = source->GetOutput();
  const float beside = this->Show(vtkMeasuredBRDFMapper::OCCLUSION_ON, bowl, ball).Given;
  for (vtkIdType k = 0; k < ball->GetNumberOfPoints(); ++k)
  {
    ball->GetPoints()->SetPoint(k, 0.0, 0.0, 5.0);
  }
  ball->GetPoints()->Modified();
  EXPECT_GT(this->RenderLinear().At(48, 32)[0], 1.01f * beside);
}

// A thousand blocks are listed as often as ten.
TEST_F(OcclusionBlocks, ManyAreListedOnce)
{
  std::vector<int> listings;
  this->Mapper->SetOcclusionModeToOn();
  for (const int count : { 10, 1000 })
  {
    this->Mapper->SetInputDataObject(MakeTriangles(count));
    CountedBlocks::Listings = 0;
    this->RenderLinear();
    listings.push_back(CountedBlocks::Listings);
  }
  EXPECT_EQ(listings[0], listings[1]);
}

//------------------------------------------------------------------------------
// One bounce of what surfaces hide from themselves (SetOcclusionBounce): the shaders against
// their reference in C++, pictures against traced light, and bad arrays.
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
  this->Mapper->SetBRDF(nullptr); // which would stand in for a map that does not fit
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
    EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
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
  EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
  EXPECT_GT(Compare(black, this->RenderLinear()), 0.05);
  EXPECT_TRUE(warnings.Texts.empty());
}

//------------------------------------------------------------------------------
// Self-shadowing that a graphics card has no room for, and materials that throw while they are
// drawn: the surface is drawn, and the cause is said once.
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
  const EventCounter warnings(this->Mapper, vtkCommand::WarningEvent);
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
  EXPECT_EQ(find(alone + 20), alone + 24);
  this->Actor->GetProperty()->EdgeVisibilityOn();
  EXPECT_EQ(find(alone + 32), alone + 36);
  this->Mapper->RemoveAllClippingPlanes();
  EXPECT_EQ(find(alone + 8), alone + 12);
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

//------------------------------------------------------------------------------
// One trace for all mappers that show a surface, and traces that nobody waits for any more.
namespace
{
bool GoOn() { return true; }

bool HasArrays(vtkDataObject* data)
{
  auto* surface = vtkPolyData::SafeDownCast(data);
  return surface && GetBytes(surface, vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName());
}
}

class SharedTraceTest : public RenderFixture
{
protected:
  void SetUp() override
  {
    this->RenderFixture::SetUp();
    this->Environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("sky"));
    MakeSmall(this->Table.Get());
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, -5.0); // into the hollow
  }

  // What one more mapper shows of a surface.
  vtkSmartPointer<vtkMeasuredBRDFMapper> Show(
    vtkPolyData* surface, bool bounce, FloatImage& picture)
  {
    auto mapper = vtkSmartPointer<vtkMeasuredBRDFMapper>::New();
    mapper->SetInputData(surface);
    mapper->SetBRDF(this->BRDF);
    mapper->SetEnvironment(this->Environment);
    mapper->SetIntegrator(this->Table);
    mapper->SetOcclusionModeToOn();
    mapper->SetOcclusionBounce(bounce);
    this->ShowAgain(mapper, picture);
    return mapper;
  }

  void ShowAgain(vtkMeasuredBRDFMapper* mapper, FloatImage& picture)
  {
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    this->Renderer->ResetCameraClippingRange();
    picture = this->RenderLinear();
    this->Renderer->RemoveActor(actor);
  }

  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkLambertBRDF> BRDF;
  vtkNew<vtkTableRadianceIntegrator> Table;
};

// The same object, a copy of it, and another surface; then with what comes back.
TEST_F(SharedTraceTest, MappersOfOneSurfaceTraceOnce)
{
  const auto bowl = MakeBowl(12);
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(bowl);
  FloatImage pictures[4];
  {
    const auto first = this->Show(bowl, false, pictures[0]);
    const auto second = this->Show(bowl, false, pictures[1]);
    const auto third = this->Show(copy, false, pictures[2]);
    EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 1);
    EXPECT_EQ(SharedTrace::Find(bowl), SharedTrace::Find(copy));
    EXPECT_EQ(pictures[0].RGBA, pictures[1].RGBA);
    EXPECT_EQ(pictures[0].RGBA, pictures[2].RGBA);
    const auto bouncing = this->Show(bowl, true, pictures[3]);
    EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 2);
    EXPECT_GT(pictures[3].At(32, 32)[0], 1.02f * pictures[0].At(32, 32)[0]);
    const auto other = MakeBowl(13);
    const auto fourth = this->Show(other, false, pictures[1]);
    EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 2);
    EXPECT_EQ(SharedTrace::Find(other)->GetNumberOfTraces(), 1);
  }
  // Nobody has it any more.
  EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 0);
}

// Arrays of a filter with occluders are those of its own output, for nobody else.
TEST_F(SharedTraceTest, OccludersAreNotShared)
{
  const auto bowl = MakeBowl(12);
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.0, 0.0, -1.2);
  ball->SetRadius(0.7);
  ball->Update();
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputData(bowl);
  filter->BothSidesOn();
  filter->AddOccluder(ball->GetOutput());
  filter->Update();
  FloatImage alone, beside, again;
  const auto first = this->Show(bowl, false, alone);
  const auto second =
    this->Show(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0)), false, beside);
  const auto third = this->Show(bowl, false, again);
  EXPECT_LT(beside.At(32, 32)[0], 0.8f * alone.At(32, 32)[0]);
  EXPECT_EQ(alone.RGBA, again.RGBA);
  EXPECT_EQ(SharedTrace::Find(bowl)->GetNumberOfTraces(), 1);
}

// Two surfaces of the same points, which are the newest of both.
TEST_F(SharedTraceTest, SurfacesThatSharePointsKeepApart)
{
  const auto bowl = MakeBowl(12);
  vtkNew<vtkPolyData> part; // the rim
  part->ShallowCopy(bowl);
  vtkNew<vtkCellArray> polygons;
  for (vtkIdType cell = bowl->GetNumberOfCells() / 2; cell < bowl->GetNumberOfCells(); ++cell)
  {
    polygons->InsertNextCell(bowl->GetCell(cell));
  }
  part->SetPolys(polygons);
  FloatImage alone, whole, changed;
  this->Show(part, false, alone);
  bowl->GetPoints()->Modified();
  ASSERT_EQ(bowl->GetMTime(), part->GetMTime());
  const auto mapper = this->Show(bowl, false, whole);
  mapper->SetInputData(part);
  this->ShowAgain(mapper, changed);
  EXPECT_NE(whole.RGBA, alone.RGBA);
  EXPECT_EQ(changed.RGBA, alone.RGBA);
}

// Threads that ask at once, a question that nobody waits for, and one from inside of the trace.
TEST_F(SharedTraceTest, ThreadsWaitForOneAnother)
{
  const auto bowl = MakeBowl(60);
  const auto trace = SharedTrace::Find(bowl);
  EXPECT_EQ(trace->Attach(bowl, false, []() { return false; }), nullptr);
  EXPECT_EQ(trace->GetNumberOfTraces(), 0);
  {
    const auto small = MakeBowl(8);
    const auto stopped = SharedTrace::Find(small);
    EXPECT_EQ(stopped->Attach(small, false, []() { return false; }), nullptr);
    EXPECT_TRUE(HasArrays(stopped->Attach(small, false, GoOn)));
  }
  vtkSmartPointer<vtkDataObject> results[2];
  std::atomic<bool> began{ false };
  std::thread threads[2];
  for (int k = 0; k < 2; ++k)
  {
    threads[k] = std::thread(
      [&, k]()
      {
        results[k] = trace->Attach(bowl, false,
          [&]()
          {
            began = true;
            return true;
          });
      });
  }
  while (!began)
  {
    std::this_thread::yield();
  }
  EXPECT_EQ(trace->Attach(bowl, true, []() { return false; }), nullptr);
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(trace->GetNumberOfTraces(), 1);
  ASSERT_TRUE(HasArrays(results[0]));
  EXPECT_EQ(GetBytes(vtkPolyData::SafeDownCast(results[0]),
              vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()),
    GetBytes(
      vtkPolyData::SafeDownCast(results[1]), vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()));
  const auto other = MakeBowl(8);
  const auto inside = SharedTrace::Find(other);
  int asked = 0;
  EXPECT_TRUE(HasArrays(inside->Attach(other, false,
    [&]()
    {
      asked += HasArrays(inside->Attach(other, false, GoOn)) ? 1 : 0;
      return true;
    })));
  EXPECT_GT(asked, 0);
  EXPECT_EQ(inside->GetNumberOfTraces(), 1);
}

// A forecast that goes stops its thread, whatever that does: tens of milliseconds on each core, and
// a tenth of a second to build what rays meet. All of it takes 25 s of processor time.
TEST_F(SharedTraceTest, ForecastsStopWhenTheyGo)
{
  const auto bowl = MakeBowl(250);
  measuredbrdf::OcclusionQuestion question;
  question.Input = bowl;
  question.Materials.push_back(
    { this->BRDF.Get(), this->Environment, this->Environment->GetPixelsMTime(), 0.01 });
  question.InBackground = true;
  const auto trace = SharedTrace::Find(bowl);
  for (const double work : { 0.0, 0.1, 0.3, 2.0 }) // seconds of processor time: the last one traces
  {
    auto forecast = std::make_unique<AutomaticOcclusion>();
    const int holders = this->BRDF->GetReferenceCount();
    const double start = GetProcessorTime();
    forecast->Update(question);
    ASSERT_TRUE(forecast->IsPending());
    while (GetProcessorTime() < start + work && !forecast->IsReady())
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_FALSE(forecast->IsReady()) << work;
    const double before = GetProcessorTime();
    forecast.reset(); // which does not wait for its thread
    while (this->BRDF->GetReferenceCount() > holders)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    const double stopped = GetProcessorTime() - before;
    EXPECT_LT(stopped, 0.4 + 0.1 * std::thread::hardware_concurrency()) << work;
  }
  EXPECT_EQ(trace->GetNumberOfTraces(), 0);
}
