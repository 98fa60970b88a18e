// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Shading with what surfaces hide from themselves: the shaders against HorizonLight in C++, and the
// mappers' use of vtkSurfaceVisibilityFilter's arrays.
#include "AutomaticOcclusion.h"
#include "EnvironmentPrecomputation.h"
#include "OcclusionArrays.h"
#include "OcclusionReference.h"
#include "OcclusionShader.h"
#include "OcclusionTools.h"
#include "RenderFixture.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkFieldData.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkFloatArray.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkIntArray.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialMap.h"
#include "vtkMath.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkOutputWindow.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkStringOutputWindow.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkUnsignedCharArray.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using measuredbrdf::HorizonLight;

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
vtkSmartPointer<vtkPolyData> MakeBowl()
{
  vtkNew<vtkSphereSource> bowl;
  bowl->SetRadius(0.9);
  bowl->SetThetaResolution(40);
  bowl->SetPhiResolution(24);
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

// Without occluders the same arrays change no pixel.
TEST_F(OcclusionTest, OpenSurfacesStayAsTheyAre)
{
  this->Filter->RemoveAllOccluders();
  this->Filter->Update();
  this->Mapper->SetInputData(vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0)));
  vtkNew<vtkBlinnPhongBRDF> brdf;
  this->Mapper->SetBRDF(brdf);
  const auto hybrid = MakeIntegrator<vtkHybridRadianceIntegrator>();
  this->Mapper->SetIntegrator(hybrid);
  const glm::dvec3 off = this->RenderMiddle(0);
  EXPECT_LT(glm::length(off - this->RenderMiddle(1)), 1e-5 * glm::length(off));
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

// On request the mapper traces what has no arrays.
TEST_F(OcclusionTest, OnTracesWhatHasNoArrays)
{
  vtkNew<vtkSphereSource> lid; // above a square
  lid->SetCenter(0.5, 0.0, 0.35);
  lid->SetRadius(0.3);
  vtkNew<vtkMultiBlockDataSet> blocks;
  lid->Update();
  blocks->SetBlock(0, MakeSquare());
  blocks->SetBlock(1, lid->GetOutput());
  vtkNew<vtkLambertBRDF> brdf;
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  vtkNew<vtkCompositeMeasuredBRDFMapper> composite;
  composite->SetInputDataObject(blocks);
  composite->SetBRDF(brdf);
  composite->SetIntegrator(table);
  composite->SetEnvironment(this->Environment);
  this->Actor->SetMapper(composite);
  const glm::dvec3 off = ToVector(this->RenderLinear().At(32, 32)); // auto: there are no arrays
  composite->SetOcclusionModeToOn();
  const glm::dvec3 on = ToVector(this->RenderLinear().At(32, 32));
  EXPECT_LT(on.x, 0.98 * off.x);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputDataObject(blocks);
  composite->SetInputConnection(filter->GetOutputPort());
  composite->SetOcclusionModeToAuto();
  EXPECT_LT(glm::length(ToVector(this->RenderLinear().At(32, 32)) - on), 1e-5 * off.x);
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

// On traces what a material map divides before it is divided.
TEST_F(OcclusionTest, OnTracesSurfacesOfSeveralMaterials)
{
  const auto bowl = MakeBowl();
  vtkNew<vtkIntArray> classes;
  classes->SetName("class");
  for (vtkIdType cell = 0; cell < bowl->GetNumberOfCells(); ++cell)
  {
    classes->InsertNextValue(cell % 2);
  }
  bowl->GetCellData()->AddArray(classes);
  vtkNew<vtkLambertBRDF> brdf;
  vtkNew<vtkLambertBRDF> same;
  vtkNew<vtkMaterialMap> map;
  map->SetArrayName("class");
  map->AddMaterial(brdf, 0.0);
  map->AddMaterial(same, 1.0);
  const auto table = MakeIntegrator<vtkTableRadianceIntegrator>();
  this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, -5.0); // into it
  this->Mapper->SetBRDF(brdf);
  this->Mapper->SetIntegrator(table);
  this->Mapper->SetInputData(bowl);
  const glm::dvec3 off = this->RenderMiddle(0);
  const glm::dvec3 on = this->RenderMiddle(2);
  EXPECT_LT(on.x, 0.7 * off.x);
  this->Mapper->SetMaterialMap(map);
  EXPECT_LT(glm::length(this->RenderMiddle(2) - on), 1e-4 * off.x);
  EXPECT_LT(glm::length(this->RenderMiddle(0) - off), 1e-4 * off.x);
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
  EXPECT_FALSE(arrays->HasBack);
  EXPECT_TRUE(arrays->IsOtherClosed);
  // Triangles and normals of a ball of 8 x 8 are up to 26 degrees apart.
  EXPECT_LT(arrays->LeastCosine, -0.1);
  EXPECT_GT(arrays->LeastCosine, -0.6);
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
    WarningTexts warnings(this->Mapper);
    EXPECT_LT(glm::length(this->RenderMiddle(1) - off), 1e-5 * off.x) << words;
    this->RenderMiddle(1);
    ASSERT_EQ(warnings.Texts.size(), 1u) << words;
    EXPECT_NE(warnings.Texts[0].find(words), std::string::npos) << warnings.Texts[0];
  };
  vtkNew<vtkPolyData> good;
  good->DeepCopy(this->Surface);
  this->Surface->GetPoints()->SetPoint(0, -0.8, -0.9, 0.0);
  this->Surface->GetPoints()->Modified();
  this->Surface->Modified();
  expectOff("have changed");
  this->Surface->DeepCopy(good);
  this->Surface->GetPointData()->GetNormals()->SetTuple3(0, 0.6, 0.0, 0.8);
  this->Surface->GetPointData()->GetNormals()->Modified();
  this->Surface->Modified();
  EXPECT_LT(glm::length(this->RenderMiddle(1) - off), 1e-5 * off.x); // warned of already
  this->Surface->DeepCopy(good);
  auto* key = vtkStringArray::SafeDownCast(
    this->Surface->GetFieldData()->GetAbstractArray(vtkSurfaceVisibilityFilter::GetKeyArrayName()));
  key->SetValue(0, "3" + std::string(key->GetValue(0)).substr(1)); // of an older version
  this->Surface->Modified();
  expectOff("of this version");
  this->Surface->DeepCopy(good);
  this->Surface->GetPointData()->RemoveArray(vtkSurfaceVisibilityFilter::GetHiddenLightArrayName());
  expectOff("is missing");
  this->Surface->DeepCopy(good);
  GetBytes(this->Surface, vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName())
    ->SetNumberOfTuples(3);
  expectOff("has 3 tuples");
  this->Surface->DeepCopy(good);
  vtkNew<vtkFloatArray> numbers;
  numbers->DeepCopy(this->Surface->GetPointData()->GetArray("MeasuredBRDFHiddenLight"));
  numbers->Fill(std::numeric_limits<double>::quiet_NaN());
  this->Surface->GetPointData()->AddArray(numbers); // in place of the bytes
  expectOff("is of type float");
}
