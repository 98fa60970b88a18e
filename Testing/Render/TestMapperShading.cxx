// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Shading against closed forms at values where no factor is 1: lights, scalars, grazing views,
// tangents; and a copy that forgets nothing.

#include "EventCounter.h"
#include "RenderFixture.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBasisBRDF.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataTangents.h"
#include "vtkProperty.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <limits>
#include <map>
#include <sstream>
#include <string>

namespace
{
const double pi = 3.141592653589793;

class MapperShading : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->Plane->SetOrigin(-1.0, -1.0, 0.0);
    this->Plane->SetPoint1(1.0, -1.0, 0.0);
    this->Plane->SetPoint2(-1.0, 1.0, 0.0);
    this->Mapper->SetInputConnection(this->Plane->GetOutputPort());
    this->Lights->SetGenerator(vtkNew<vtkMedianCutLightSetGenerator>());
    this->Mapper->SetIntegrator(this->Lights);
    this->Mapper->SetBRDF(this->Lambert);
    this->Lambert->SetAlbedo(0.9, 0.6, 0.3);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
  }

  /// A quad across the window with one normal and, if wanted, one tangent.
  void SetQuad(const double normal[3], const double* tangent = nullptr)
  {
    this->Plane->Update();
    vtkNew<vtkPolyData> data;
    data->SetPoints(this->Plane->GetOutput()->GetPoints());
    data->SetPolys(this->Plane->GetOutput()->GetPolys());
    const auto repeat = [](const double* vector)
    {
      vtkNew<vtkFloatArray> array;
      array->SetNumberOfComponents(3);
      for (int corner = 0; corner < 4; ++corner)
      {
        array->InsertNextTuple(vector);
      }
      return vtkSmartPointer<vtkFloatArray>(array);
    };
    data->GetPointData()->SetNormals(repeat(normal));
    if (tangent)
    {
      data->GetPointData()->SetTangents(repeat(tangent));
    }
    this->Mapper->SetInputDataObject(data);
  }

  static vtkSmartPointer<vtkEnvironment> MakeConstant(float radiance)
  {
    auto environment = vtkSmartPointer<vtkEnvironment>::New();
    environment->SetPixels(64, 32, std::vector<float>(3 * 64 * 32, radiance));
    return environment;
  }

  vtkNew<vtkPlaneSource> Plane;
  vtkNew<vtkLightSetRadianceIntegrator> Lights; // what the mapper draws
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkLambertBRDF> Lambert;
};

/// "Name: value" lines of what the mapper prints beyond its superclass.
std::map<std::string, std::string> GetProperties(vtkMeasuredBRDFMapper* mapper)
{
  std::ostringstream text;
  mapper->Print(text);
  std::istringstream lines(text.str());
  std::map<std::string, std::string> properties;
  bool own = false;
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t begin = line.find_first_not_of(' ');
    const std::size_t colon = line.find(": ");
    own = own || line.compare(begin == std::string::npos ? 0 : begin, 6, "BRDF: ") == 0;
    if (own && colon != std::string::npos)
    {
      properties[line.substr(begin, colon - begin)] = line.substr(colon + 2);
    }
  }
  return properties;
}
}

// A surface whose data hold what is no direction is drawn without black places, and one warning
// says how many there are.
TEST_F(MapperShading, NormalsThatAreNoneAreTheFacets)
{
  const double towards[3] = { 0.0, 0.0, 1.0 };
  const double tangent[3] = { 1.0, 0.0, 0.0 };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto GetRed = [this]() { return 255.0 * this->RenderEncoded().At(32, 32)[0]; };
  const double infinite = std::numeric_limits<double>::infinity();
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  this->Mapper->SetEnvironment(MakeConstant(0.5f));
  for (const bool anisotropic : { false, true })
  {
    this->Mapper->SetBRDF(anisotropic ? static_cast<vtkBRDF*>(brushed) : this->Lambert.Get());
    this->SetQuad(towards, tangent);
    const double expected = GetRed();
    ASSERT_GT(expected, 20.0);
    for (const auto& bad :
      { std::array<double, 3>{ nan, 0.0, 1.0 }, std::array<double, 3>{ 0.0, 0.0, 0.0 },
        std::array<double, 3>{ infinite, 0.0, 0.0 }, std::array<double, 3>{ nan, nan, nan } })
    {
      vtkNew<vtkMeasuredBRDFMapper> mapper;
      mapper->ShallowCopy(this->Mapper);
      EventCounter warnings(mapper, vtkCommand::WarningEvent);
      this->SetQuad(bad.data(), anisotropic ? bad.data() : tangent);
      mapper->SetInputDataObject(this->Mapper->GetInputDataObject(0, 0));
      this->Actor->SetMapper(mapper);
      EXPECT_NEAR(GetRed(), expected, 1.0) << bad[0] << " " << bad[1];
      EXPECT_NEAR(GetRed(), expected, 1.0);
      EXPECT_EQ(warnings.Count, 1);
      EXPECT_NE(warnings.Text.find("4 of the surface's normals"), std::string::npos)
        << warnings.Text;
      this->Actor->SetMapper(this->Mapper);
    }
  }
}

// A plane tilted by 60 degrees under a light at the camera.
TEST_F(MapperShading, HeadlightOnATiltedPlane)
{
  this->Actor->RotateX(60.0);
  this->AddHeadlight(2.0, 1.0, 0.5, 0.25);
  const FloatImage image = this->RenderLinear();
  EXPECT_NEAR(image.At(32, 32)[0], 2.0 * 0.9 / pi * 0.5, 2e-3);
  EXPECT_NEAR(image.At(32, 32)[1], 1.0 * 0.6 / pi * 0.5, 2e-3);
  EXPECT_NEAR(image.At(32, 32)[2], 0.5 * 0.3 / pi * 0.5, 2e-3);
}

// The environment alone where the scene's lights are not wanted, by a method that evaluates the
// BRDF on the GPU and by one that does not; back and forth without a change of anything else.
TEST_F(MapperShading, SceneLightsCanBeLeftOut)
{
  this->AddHeadlight();
  this->Mapper->SetEnvironment(MakeConstant(0.5f));
  for (vtkRadianceIntegrator* integrator : { static_cast<vtkRadianceIntegrator*>(this->Lights),
         static_cast<vtkRadianceIntegrator*>(nullptr) })
  {
    this->Mapper->SetIntegrator(integrator);
    for (const bool lights : { true, false, true })
    {
      this->Mapper->SetUseSceneLights(lights);
      const double expected = 0.9 * (0.5 + (lights ? 1.0 / pi : 0.0));
      EXPECT_NEAR(this->RenderLinear().At(32, 32)[0], expected, 0.01) << lights;
    }
  }
}

// Where an environment lights the material, the headlight that VTK creates for a scene without
// lights adds nothing, whatever its place among other lights; the program's own lights do. Without
// an environment it is all the light there is.
TEST_F(MapperShading, LightThatVTKCreated)
{
  const auto expect = [this](double light, int line)
  { EXPECT_NEAR(this->RenderLinear().At(32, 32)[0], 0.9 * light, 0.01) << "line " << line; };
  vtkNew<vtkLight> own; // a headlight like VTK's, of another intensity
  own->SetLightTypeToHeadlight();
  own->SetIntensity(2.0);
  vtkLightCollection* lights = this->Renderer->GetLights();
  this->Mapper->SetIntegrator(nullptr); // planned methods evaluate the BRDF for lights only
  this->Mapper->SetEnvironment(MakeConstant(0.25f));
  this->Renderer->SetAutomaticLightCreation(true);
  expect(0.25, __LINE__);
  ASSERT_EQ(lights->GetNumberOfItems(), 1);
  auto* created = vtkLight::SafeDownCast(lights->GetItemAsObject(0));

  this->Renderer->AddLight(own); // after VTK's
  expect(0.25 + 2.0 / pi, __LINE__);
  this->Renderer->RemoveLight(created);
  this->Renderer->AddLight(created); // no other number and kind of lights; but the order
  expect(0.25 + 2.0 / pi, __LINE__);
  created->SwitchOff();
  expect(0.25 + 2.0 / pi, __LINE__);
  own->SwitchOff();
  created->SwitchOn();
  expect(0.25, __LINE__);
  this->Mapper->SetEnvironment(nullptr);
  expect(1.0 / pi, __LINE__);
  this->Mapper->SetEnvironment(MakeConstant(0.25f));
  expect(0.25, __LINE__);

  // In a composite mapper, and by a method that evaluates the BRDF.
  this->Plane->Update();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, this->Plane->GetOutput());
  vtkNew<vtkCompositeMeasuredBRDFMapper> composite;
  composite->SetInputDataObject(blocks);
  composite->SetBRDF(this->Lambert);
  composite->SetEnvironment(MakeConstant(0.25f));
  this->Actor->SetMapper(composite);
  expect(0.25, __LINE__);
  composite->SetIntegrator(this->Lights);
  expect(0.25, __LINE__);
  own->SwitchOn();
  expect(0.25 + 2.0 / pi, __LINE__);

  // VTK's for another renderer, whose lights this one shares.
  vtkNew<vtkRenderer> other;
  this->Window->AddRenderer(other);
  this->Window->Render();
  ASSERT_EQ(other->GetLights()->GetNumberOfItems(), 1);
  this->Renderer->SetLightCollection(other->GetLights());
  expect(0.25, __LINE__);
}

// Off a spot's axis: exponent, and each term of the attenuation, at a distance that is not 1.
TEST_F(MapperShading, SpotOffItsAxis)
{
  const auto spot = this->AddSceneLight(0.0, 0.0, 2.0, 60.0);
  spot->SetIntensity(10.0);
  const double attenuations[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (const double exponent : { 0.0, 1.0, 8.0 })
  {
    for (const double* a : attenuations)
    {
      spot->SetExponent(exponent);
      spot->SetAttenuationValues(a[0], a[1], a[2]);
      const FloatImage image = this->RenderLinear();
      for (const int x : { 32, 48, 60 })
      {
        const double px = (x + 0.5) / 32.0 - 1.0;
        const double py = 0.5 / 32.0;
        const double distance = std::sqrt(px * px + py * py + 4.0);
        const double cosine = 2.0 / distance; // of both angles
        const double expected = 10.0 * 0.9 / pi * cosine * std::pow(cosine, exponent) /
                                (a[0] + a[1] * distance + a[2] * distance * distance);
        EXPECT_NEAR(image.At(x, 32)[0], expected, 2e-3 * expected)
          << "exponent " << exponent << ", attenuation " << a[0] << a[1] << a[2] << ", pixel " << x;
      }
    }
  }
}

// Half-gray scalars: (128/255)^2.2 of the light, as VTK's PBR takes colors.
TEST_F(MapperShading, HalfGrayScalars)
{
  const double normal[3] = { 0.0, 0.0, 1.0 };
  this->SetQuad(normal);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (int k = 0; k < 4; ++k)
  {
    colors->InsertNextTuple3(128, 64, 255);
  }
  vtkPolyData::SafeDownCast(this->Mapper->GetInputDataObject(0, 0))
    ->GetPointData()
    ->SetScalars(colors);
  this->Mapper->SetEnvironment(MakeConstant(1.0f));
  this->Lights->SetNumberOfLights(1024);
  this->Mapper->SetScalarColoringMode(vtkMeasuredBRDFMapper::IGNORE_SCALARS);
  const FloatImage plain = this->RenderLinear();
  this->Mapper->SetScalarColoringMode(vtkMeasuredBRDFMapper::MODULATE);
  const FloatImage gray = this->RenderLinear();
  const double scalars[3] = { 128.0 / 255.0, 64.0 / 255.0, 1.0 };
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(
      gray.At(32, 32)[c] / plain.At(32, 32)[c], std::pow(scalars[c], 2.2), 1e-3 * scalars[c]);
  }
}

// Normals that are almost, or more than, at right angles to the view, set on purpose: both light
// loops shade as if the view's cosine were 0.02 at least.
TEST_F(MapperShading, GrazingViews)
{
  // f = 1 / cos(theta_o), so that the view's cosine shows.
  vtkNew<vtkBasisBRDF> brdf;
  const double whole[2] = { 0.0, 90.0 };
  const double constant = std::sqrt(4.0 * pi); // of the first harmonic: a sum of 1
  ASSERT_EQ(brdf->SetCoefficients(vtkBasisBRDF::SPHERICAL_HARMONICS, 0, whole, whole, 2, 1,
              std::vector<float>(6, static_cast<float>(constant))),
    "");
  brdf->OutgoingCosineOn();
  this->Mapper->SetBRDF(brdf);
  vtkNew<vtkLightSet> lights;
  const double irradiance[3] = { 0.05, 0.04, 0.03 };
  const double from[3] = { 0.8, 0.0, 0.6 };
  lights->AddLight(from, irradiance);
  this->Lights->SetLightSet(lights);
  vtkNew<vtkLightSetRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetLightSet(lights);
  integrator->SetEnvironment(MakeConstant(1.0f));
  for (const double z : { 0.1, 0.04, 0.03, 0.01, -0.01, -0.1 })
  {
    const double normal[3] = { std::sqrt(1.0 - z * z), 0.0, z };
    this->SetQuad(normal);
    const FloatImage image = this->RenderLinear();
    const double view[3] = { 0.0, 0.0, 1.0 };
    const double radiance = IntegrateOne(integrator, normal, view)[0];
    const double cosine = normal[0] * from[0] + z * from[2];
    const double expected = irradiance[0] * cosine / std::max(z, 0.02);
    EXPECT_NEAR(image.At(32, 32)[0], expected, 2e-3 * expected) << "GPU, z = " << z;
    // Nothing is seen from below, in C++: there are no interpolated normals.
    EXPECT_NEAR(radiance, z > 0.0 ? expected : 0.0, 1e-6) << "C++, z = " << z;
  }
}

// A light of negative intensity takes away from the environment's, down to 0 in each channel, and
// from 0 no power is taken that would be NaN.
TEST_F(MapperShading, NegativeLightsEndAtZero)
{
  this->Mapper->SetEnvironment(MakeConstant(0.5f));
  const FloatImage before = this->RenderLinear();
  const auto dark = this->AddHeadlight(-50.0);
  for (int channel = 0; channel < 3; ++channel)
  {
    dark->SetDiffuseColor(channel == 0, channel == 1, channel == 2);
    const FloatImage image = this->RenderEncoded();
    for (int c = 0; c < 3; ++c)
    {
      const float value = image.At(32, 32)[c];
      if (c == channel)
      {
        EXPECT_EQ(value, 0.0f) << "channel " << c;
      }
      else
      {
        EXPECT_NEAR(std::pow(value, 2.2f), before.At(32, 32)[c], 1e-4) << "channel " << c;
      }
    }
  }
}

// A material that half a turn changes: one order of a harmonic along the tangent, with a table over
// the view's azimuth.
TEST_F(MapperShading, TheTangentsDirectionCounts)
{
  // Order 1: k = 0 constant, k = 1 ~ y, k = 3 ~ x (l = 1, m = -1 and 1). Azimuths: anisotropic.
  vtkNew<vtkBasisBRDF> brdf;
  const double whole[2] = { 0.0, 90.0 };
  const int functions = 4, nTheta = 2, nPhi = 4;
  std::vector<float> rgb(3 * functions * nTheta * nPhi, 0.0f);
  const auto set = [&](int k, float value)
  { std::fill_n(rgb.begin() + 3 * k * nTheta * nPhi, 3 * nTheta * nPhi, value); };
  set(0, 1.0f);
  set(1, 0.3f);
  set(3, 0.5f);
  ASSERT_EQ(
    brdf->SetCoefficients(vtkBasisBRDF::SPHERICAL_HARMONICS, 1, whole, whole, nTheta, nPhi, rgb),
    "");
  ASSERT_FALSE(brdf->IsIsotropic());
  this->Mapper->SetBRDF(brdf);
  const double from[3] = { 0.48, 0.36, 0.8 };
  const double irradiance[3] = { 1.0, 1.0, 1.0 };
  vtkNew<vtkLightSet> lights;
  lights->AddLight(from, irradiance);
  this->Lights->SetLightSet(lights);
  const double normal[3] = { 0.0, 0.0, 1.0 };
  const double tangents[4][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } };
  float seen[4];
  for (int k = 0; k < 4; ++k)
  {
    const double* t = tangents[k];
    this->SetQuad(normal, t);
    seen[k] = this->RenderLinear().At(32, 32)[0];
    // The light in the frame (tangent, normal x tangent, normal).
    const double local[3] = { from[0] * t[0] + from[1] * t[1], from[1] * t[0] - from[0] * t[1],
      from[2] };
    double f[3];
    brdf->Evaluate(local, normal, f);
    EXPECT_NEAR(seen[k], f[0] * from[2], 2e-3 * f[0]) << "tangent " << k;
  }
  EXPECT_GT(std::abs(seen[0] - seen[1]), 0.05 * seen[0]);
  EXPECT_GT(std::abs(seen[2] - seen[3]), 0.05 * seen[2]);

  // Without tangents they go around the environment's up axis: y x z = x.
  this->SetQuad(normal);
  EXPECT_NEAR(this->RenderLinear().At(32, 32)[0], seen[0], 2e-3 * seen[0]);
}

// Tangents by VTK's filter, and a vector field that is named: the table sees both.
TEST_F(MapperShading, TangentsFromTextureCoordinatesAndFields)
{
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(100.0, 10.0);
  vtkNew<vtkEnvironment> hall;
  hall->SetToProceduralHall();
  vtkNew<vtkTableRadianceIntegrator> table;
  ASSERT_TRUE(table->SetSizes({ 17, 4, 8, 4 }));
  this->Mapper->SetIntegrator(table);
  this->Mapper->SetBRDF(brushed);
  this->Mapper->SetEnvironment(hall);
  table->SetBRDF(brushed);
  table->SetEnvironment(hall);
  const double normal[3] = { 0.6, 0.0, 0.8 };
  const double along[3] = { 0.8, 0.0, -0.6 };
  const double across[3] = { 0.0, 1.0, 0.0 };
  const auto getExpected = [&](const double* tangent)
  {
    const double view[3] = { 0.0, 0.0, 1.0 };
    return IntegrateOne(table, normal, view, tangent)[0];
  };
  ASSERT_GT(std::abs(getExpected(along) - getExpected(across)), 0.05 * getExpected(along));

  // Texture coordinates run along x and y of the quad, which has other normals than its own.
  this->SetQuad(normal);
  vtkPolyData* quad = this->Mapper->GetInput();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (int corner = 0; corner < 4; ++corner)
  {
    const double* p = quad->GetPoint(corner);
    coordinates->InsertNextTuple2(p[0], p[1]);
  }
  quad->GetPointData()->SetTCoords(coordinates);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(quad);
  vtkNew<vtkPolyDataTangents> tangents;
  tangents->SetInputConnection(triangles->GetOutputPort());
  this->Mapper->SetInputConnection(tangents->GetOutputPort());
  double expected = getExpected(along);
  EXPECT_NEAR(this->RenderLinear().At(32, 32)[0], expected, 2e-3 * expected);

  vtkNew<vtkFloatArray> field;
  field->SetName("fiber direction");
  field->SetNumberOfComponents(3);
  for (int corner = 0; corner < 4; ++corner)
  {
    field->InsertNextTuple3(0.0, 7.0, 3.0); // of any length, not along the surface
  }
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(quad);
  mesh->GetPointData()->AddArray(field);
  mesh->GetPointData()->SetActiveTangents("fiber direction");
  this->Mapper->SetInputDataObject(mesh);
  const double leaning[3] = { 0.0, 7.0, 3.0 };
  expected = getExpected(leaning);
  EXPECT_NEAR(this->RenderLinear().At(32, 32)[0], expected, 2e-3 * expected);
}
