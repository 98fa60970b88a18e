// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Shading against closed forms at values where no factor is 1: lights, scalars, grazing views,
// tangents; and a copy that forgets nothing.
#include "RandomLight.h"
#include "RenderFixture.h"
#include "SpherePairs.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBasisBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLightCollection.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPBRIrradianceTexture.h"
#include "vtkPBRLUTTexture.h"
#include "vtkPBRPrefilterTexture.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkPolyDataTangents.h"
#include "vtkProperty.h"
#include "vtkSumBRDF.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTriangleFilter.h"

#include <map>

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
    this->Lights->SetGenerator(vtkNew<vtkLightSetGenerator>());
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

//------------------------------------------------------------------------------
// Maps may be in any unit: a factor on the light and its inverse on the exposure leave every
// picture as it is, with what a mesh hides from itself, and of several materials.
namespace
{
// Of both decimal units and powers of two: the lights that stand for a map may be others where its
// digits are rounded otherwise.
constexpr double Units[] = { LightUnits[0], 1e5 };

class LightUnits8Bit : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    // A hollow, which hides itself.
    vtkNew<vtkSphereSource> bowl;
    bowl->SetRadius(0.95);
    bowl->SetThetaResolution(16);
    bowl->SetPhiResolution(12);
    bowl->SetEndPhi(110.0);
    this->Visibility->SetInputConnection(bowl->GetOutputPort());
    this->Visibility->BothSidesOn();
    this->Visibility->BounceOn();
    this->Visibility->Update();
    this->Surface = vtkPolyData::SafeDownCast(this->Visibility->GetOutputDataObject(0));
    this->Hall->SetToProceduralHall();
    ShrinkEnvironment(this->Hall, 64, 32); // planned sooner
    this->Mapper->SetInputData(this->Surface);
    this->Mapper->SetOcclusionModeToOff();
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->GetActiveCamera()->SetPosition(1.0, -2.0, 4.0);
  }

  static vtkSmartPointer<vtkBRDF> NewGlossyCoat(double exponent, double red = 0.8)
  {
    vtkNew<vtkLambertBRDF> base;
    base->SetAlbedo(red, 0.4, 0.2);
    vtkNew<vtkBlinnPhongBRDF> gloss;
    gloss->SetSpecular(0.1, 0.1, 0.1);
    gloss->SetExponent(exponent);
    auto coat = vtkSmartPointer<vtkSumBRDF>::New();
    coat->AddTerm(base);
    coat->AddTerm(gloss);
    return coat;
  }

  /// The picture under the light in each unit, shown with that exposure, is the same.
  void ExpectSamePictures(const std::string& what)
  {
    this->Mapper->SetEnvironment(this->Hall);
    const FloatImage expected = this->RenderLinear();
    float brightest = 0.0f;
    for (const double unit : Units)
    {
      this->Mapper->SetEnvironment(NewScaledLight(this->Hall, unit));
      const FloatImage found = this->RenderLinear();
      long most = 0;
      double off = 0.0;
      double all = 0.0;
      for (std::size_t k = 0; k < expected.RGBA.size(); ++k)
      {
        const float value = expected.RGBA[k];
        brightest = std::max(brightest, value);
        const double scaled = k % 4 == 3 ? found.RGBA[k] : found.RGBA[k] / unit;
        most = std::max(most, std::labs(ToByte(scaled) - ToByte(static_cast<double>(value))));
        off += std::abs(scaled - static_cast<double>(value));
        all += static_cast<double>(value);
      }
      EXPECT_LE(most, 1) << what << ", times " << unit;
      EXPECT_LT(off, 2e-3 * all) << what << ", times " << unit; // highlights, too
    }
    EXPECT_GT(brightest, 0.1f) << what;
  }

  static long ToByte(double radiance)
  {
    return std::lround(255.0 * std::pow(std::clamp(radiance, 0.0, 1.0), 1.0 / 2.2));
  }

  vtkNew<vtkSurfaceVisibilityFilter> Visibility;
  vtkSmartPointer<vtkPolyData> Surface;
  vtkNew<vtkEnvironment> Hall;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};
}

// A plan's, beside what the hollow hides, and what that sends back.
TEST_F(LightUnits8Bit, WithSelfShadowing)
{
  this->Mapper->SetOcclusionModeToOn();
  this->Mapper->SetBRDF(NewGlossyCoat(20000.0, 0.5));
  this->Mapper->OcclusionBounceOn();
  this->ExpectSamePictures("shadowed, with a bounce");
}

TEST_F(LightUnits8Bit, OfMaterialMaps)
{
  constexpr int classes = 4;
  vtkNew<vtkIntArray> array;
  array->SetName("material");
  for (vtkIdType k = 0; k < this->Surface->GetNumberOfCells(); ++k)
  {
    array->InsertNextValue(static_cast<int>(k) % classes);
  }
  this->Surface->GetCellData()->AddArray(array);
  vtkNew<vtkMaterialMap> map;
  map->SetArrayName("material");
  for (int k = 0; k < classes; ++k)
  {
    map->AddMaterial(NewGlossyCoat(20.0 + 60.0 * k, 0.2 * (k + 1)));
  }
  this->Mapper->SetMaterialMap(map);
  this->ExpectSamePictures("classes");
  this->Mapper->SetOcclusionModeToOn();
  this->ExpectSamePictures("classes, shadowed");
}

//------------------------------------------------------------------------------
// What the renderer's environment texture holds, linear or sRGB, by VTK's own shading beside ours.
class TextureEncoding : public RenderFixture
{
protected:
  /// 128 of 255 everywhere, in any type.
  static vtkSmartPointer<vtkTexture> MakeGray(int type, bool cube)
  {
    auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetCubeMap(cube);
    for (int face = 0; face < (cube ? 6 : 1); ++face)
    {
      vtkNew<vtkImageData> image;
      image->SetDimensions(16, cube ? 16 : 8, 1);
      image->AllocateScalars(type, 3);
      const double largest = type == VTK_FLOAT ? 1.0 : type == VTK_UNSIGNED_SHORT ? 65535.0 : 255.0;
      image->GetPointData()->GetScalars()->Fill(largest * 128.0 / 255.0);
      texture->SetInputDataObject(face, image);
    }
    texture->SetColorModeToDirectScalars();
    texture->InterpolateOn();
    texture->MipmapOn();
    return texture;
  }
};

TEST_F(TextureEncoding, IsAsVtkTakesIt)
{
  if (this->IsSkipped())
  {
    return;
  }
  auto* renderer = vtkOpenGLRenderer::SafeDownCast(this->Renderer);
  ASSERT_TRUE(renderer);
  this->Renderer->UseImageBasedLightingOn();
  renderer->GetEnvMapLookupTable()->SetLUTSamples(64);
  renderer->GetEnvMapPrefiltered()->SetPrefilterMaxSamples(64); // the light is uniform
  renderer->GetEnvMapIrradiance()->SetIrradianceSize(8);
  renderer->GetEnvMapIrradiance()->SetIrradianceStep(0.1f);

  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  vtkNew<vtkLambertBRDF> white;
  white->SetAlbedo(1.0, 1.0, 1.0);
  vtkNew<vtkMeasuredBRDFMapper> measured;
  measured->SetInputConnection(sphere->GetOutputPort());
  measured->SetBRDF(white);
  vtkNew<vtkOpenGLPolyDataMapper> stock;
  stock->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->GetProperty()->SetInterpolationToPBR();
  actor->GetProperty()->SetRoughness(1.0);
  this->Renderer->AddActor(actor);

  constexpr double linear = 128.0 / 255.0;
  constexpr double decoded = 0.21586; // IEC 61966-2-1
  const struct
  {
    const char* Name;
    int Type;
    bool Cube, SaysSRGB, UsesSRGB, Harmonics;
    double Expected;
  } cases[] = {
    { "bytes", VTK_UNSIGNED_CHAR, false, false, false, true, decoded },
    { "bytes, isSRGB", VTK_UNSIGNED_CHAR, false, true, false, true, decoded },
    { "bytes, UseSRGBColorSpace", VTK_UNSIGNED_CHAR, false, false, true, true, decoded },
    { "bytes, no harmonics", VTK_UNSIGNED_CHAR, false, false, false, false, linear },
    { "shorts", VTK_UNSIGNED_SHORT, false, false, false, true, linear },
    { "floats", VTK_FLOAT, false, false, false, true, linear },
    { "floats, UseSRGBColorSpace", VTK_FLOAT, false, false, true, true, linear },
    { "floats, isSRGB, no harmonics", VTK_FLOAT, false, true, false, false, decoded },
    { "cube of bytes", VTK_UNSIGNED_CHAR, true, false, false, false, linear },
    { "cube of bytes, isSRGB", VTK_UNSIGNED_CHAR, true, true, false, false, decoded },
    { "cube of bytes, UseSRGBColorSpace", VTK_UNSIGNED_CHAR, true, false, true, false, decoded },
  };
  for (const auto& c : cases)
  {
    SCOPED_TRACE(c.Name);
    const vtkSmartPointer<vtkTexture> texture = MakeGray(c.Type, c.Cube);
    texture->SetUseSRGBColorSpace(c.UsesSRGB);
    renderer->SetUseSphericalHarmonics(c.Harmonics);
    this->Renderer->SetEnvironmentTexture(texture, c.SaysSRGB);
    actor->SetMapper(measured);
    const double ours = this->RenderLinear().At(32, 32)[0];
    EXPECT_NEAR(ours, c.Expected, 0.01 * c.Expected);
    actor->SetMapper(stock);
    const double theirs = this->RenderLinear().At(32, 32)[0];
    // Its specular part is another, and its curve a power of 2.2: both are small beside 2.3.
    EXPECT_NEAR(ours, theirs, 0.15 * theirs);
  }
}

TEST_F(TextureEncoding, WarnsOfBadValues)
{
  if (this->IsSkipped())
  {
    return;
  }
  vtkNew<vtkLambertBRDF> white;
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(vtkNew<vtkSphereSource>()->GetOutputPort());
  mapper->SetBRDF(white);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->Renderer->AddActor(actor);
  EventCounter warnings(mapper, vtkCommand::WarningEvent);
  for (const bool cube : { false, true })
  {
    const vtkSmartPointer<vtkTexture> texture = MakeGray(VTK_FLOAT, cube);
    vtkImageData* image = texture->GetInput();
    image->SetScalarComponentFromFloat(0, 0, 0, 0, std::numeric_limits<float>::infinity());
    image->SetScalarComponentFromFloat(1, 0, 0, 1, -1.0f);
    image->SetScalarComponentFromFloat(2, 0, 0, 2, cube ? -1.0f : 1.0f); // another cause
    this->Renderer->SetEnvironmentTexture(texture);
    this->RenderLinear();
    this->RenderLinear();
    EXPECT_EQ(warnings.Count, cube ? 2 : 1);
    EXPECT_NE(warnings.Text.find(cube ? "texture: 3 of its values" : "texture: 2 of its values"),
      std::string::npos)
      << warnings.Text;
  }
}

//------------------------------------------------------------------------------
// A stock actor with the fitted property, drawn by VTK's own shading, against the measured
// material.
class FittedProperty : public RenderFixture
{
protected:
  /// Mean |a - b| over mean b of what both cover.
  static double Compare(const FloatImage& a, const FloatImage& b)
  {
    double difference = 0.0;
    double sum = 0.0;
    for (int y = 0; y < b.Height; ++y)
    {
      for (int x = 0; x < b.Width; ++x)
      {
        const double dx = 2.0 * (x + 0.5) / b.Width - 1.0;
        const double dy = 2.0 * (y + 0.5) / b.Height - 1.0;
        for (int c = 0; c < 3 && dx * dx + dy * dy < 0.9; ++c) // the rim is not the material's
        {
          difference += std::abs(a.At(x, y)[c] - b.At(x, y)[c]);
          sum += b.At(x, y)[c];
        }
      }
    }
    return difference / sum;
  }
};

TEST_F(FittedProperty, IsNearerThanTheDefault)
{
  if (this->IsSkipped())
  {
    return;
  }
  vtkNew<vtkEnvironment> environment;
  vtkPBRPropertyFitter::SetToNeutralStudio(environment);
  const auto image = vtkSmartPointer<vtkImageData>::Take(environment->NewImageData());
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->SetColorModeToDirectScalars();
  texture->MipmapOn();
  texture->InterpolateOn();
  this->Renderer->UseImageBasedLightingOn();
  this->Renderer->SetEnvironmentTexture(texture);
  // The light is smooth; VTK's 1024 samples take long on a software renderer.
  auto* renderer = vtkOpenGLRenderer::SafeDownCast(this->Renderer);
  ASSERT_TRUE(renderer);
  renderer->GetEnvMapLookupTable()->SetLUTSamples(128);
  renderer->GetEnvMapPrefiltered()->SetPrefilterMaxSamples(128);

  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(96);
  sphere->SetPhiResolution(96);
  vtkNew<vtkMeasuredBRDFMapper> measured;
  measured->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkOpenGLPolyDataMapper> stock;
  stock->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  this->Renderer->AddActor(actor);
  for (const char* name : { "gold-paint", "pink-felt" })
  {
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    measured->SetBRDF(brdf);
    actor->SetMapper(measured);
    vtkNew<vtkProperty> property;
    actor->SetProperty(property);
    const FloatImage exact = this->RenderLinear();

    actor->SetMapper(stock);
    property->SetInterpolationToPBR();
    const double plain = Compare(this->RenderLinear(), exact);
    const double promised = vtkPBRPropertyFitter::Fit(brdf, property);
    const double fitted = Compare(this->RenderLinear(), exact);
    EXPECT_LT(fitted, 0.4 * plain) << name;
    EXPECT_LT(fitted, 0.5) << name;
  }
}

TEST_F(FittedProperty, ByTheMapper)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint"));
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  vtkNew<vtkProperty> property;
  EXPECT_LT(mapper->FitProperty(property), 0.0);
  EXPECT_EQ(property->GetInterpolation(), VTK_GOURAUD);
  mapper->SetBRDF(brdf);
  EXPECT_LT(mapper->FitProperty(nullptr), 0.0);
  const double error = mapper->FitProperty(property);
  EXPECT_GT(error, 0.0);
  EXPECT_LT(error, 0.06);
  EXPECT_EQ(property->GetInterpolation(), VTK_PBR);
}
