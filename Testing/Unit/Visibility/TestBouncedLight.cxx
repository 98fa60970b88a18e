// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// One bounce of what is hidden: its code, and what vtkSurfaceVisibilityFilter finds, against traced
// light.
#include "HalfVector.h"
#include "HorizonLight.h"
#include "SkyHarmonics.h"
#include "TraceSurface.h"
#include "vtkSurfaceVisibilityFilter.h"

#include "vtkCallbackCommand.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkReverseSense.h"
#include "vtkSphereSource.h"
#include "vtkTracedRadianceIntegrator.h"
#include "vtkTracedScene.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

using measuredbrdf::BouncedLight;
using measuredbrdf::HorizonLight;
namespace sky = measuredbrdf::sky;

namespace
{
using measuredbrdf::Pi;

// A hollow that is open upwards and lit inside, points and normals within.
vtkSmartPointer<vtkPolyData> MakeHollow(double endPhi)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(32);
  source->SetPhiResolution(20);
  source->SetStartPhi(180.0 - endPhi);
  source->SetEndPhi(180.0);
  vtkNew<vtkReverseSense> inwards;
  inwards->SetInputConnection(source->GetOutputPort());
  inwards->ReverseNormalsOn();
  inwards->Update();
  return inwards->GetOutput();
}

vtkUnsignedCharArray* GetBounced(vtkPolyData* surface, const std::string& suffix = "")
{
  return GetBytes(surface, vtkSurfaceVisibilityFilter::GetBouncedLightArrayName() + suffix);
}

BouncedLight GetBounce(vtkPolyData* surface, vtkIdType point, const std::string& suffix = "")
{
  BouncedLight::Code code;
  std::copy_n(GetBounced(surface, suffix)->GetPointer(point * BouncedLight::Bytes),
    BouncedLight::Bytes, code.begin());
  return BouncedLight(code);
}

bool AreEqual(vtkUnsignedCharArray* a, vtkUnsignedCharArray* b)
{
  return a && b && a->GetNumberOfValues() == b->GetNumberOfValues() &&
         std::memcmp(a->GetPointer(0), b->GetPointer(0),
           static_cast<std::size_t>(a->GetNumberOfValues())) == 0;
}
}

// Steps: half of one of each byte; never more than there is.
TEST(BouncedLight, CodesKeepTransfers)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int k = 0; k < 200; ++k)
  {
    // A few lamps, which no sum of the bytes' ranges leaves out.
    BouncedLight::Transfer transfer{};
    for (int lamp = 0; lamp < 1 + k % 3; ++lamp)
    {
      const double z = 2.0 * uniform(generator) - 1.0;
      const double turn = 2.0 * Pi * uniform(generator);
      const double s = std::sqrt(1.0 - z * z);
      const sky::Values values = sky::Evaluate({ s * std::cos(turn), s * std::sin(turn), z });
      const double strength = std::pow(uniform(generator), 4.0);
      for (std::size_t j = 0; j < transfer.size(); ++j)
      {
        transfer[j] += strength * values[j];
      }
    }
    const BouncedLight kept(BouncedLight::Encode(transfer));
    const double step = 2.0 * BouncedLight::RootStep * std::sqrt(transfer[0]);
    EXPECT_LE(kept.GetTransfer()[0], transfer[0] * (1.0 + 1e-12));
    EXPECT_GT(kept.GetTransfer()[0], transfer[0] - step);
    for (std::size_t j = 1; j < transfer.size(); ++j)
    {
      EXPECT_NEAR(kept.GetTransfer()[j], transfer[j],
        2.24 * step + 0.51 * BouncedLight::RatioStep * transfer[0]);
    }
  }
  sky::Colors light;
  light.fill(glm::dvec3(1.0));
  EXPECT_EQ(BouncedLight(BouncedLight::MakeDark()).GetIrradiance(light), glm::dvec3(0.0));
  // Whatever the bytes are, light is neither negative nor endless.
  BouncedLight::Code code;
  code.fill(255);
  EXPECT_LT(BouncedLight(code).GetIrradiance(light).x, 100.0);
  light.fill(glm::dvec3(-1.0));
  EXPECT_EQ(BouncedLight(code).GetIrradiance(light), glm::dvec3(0.0));
}

// A hollow of albedo 1 under a uniform sky: lighter with the bounce, never lighter than the sky.
TEST(BouncedLight, HollowsGetLighterAndNeverLighterThanTheSky)
{
  for (const double endPhi : { 90.0, 150.0, 172.0 })
  {
    vtkNew<vtkSurfaceVisibilityFilter> filter;
    filter->BounceOn();
    const auto hollow = MakeHollow(endPhi);
    vtkPolyData* surface = Trace(filter, hollow);
    const double uniform = std::sqrt(4.0 * Pi); // first harmonic of a sky of radiance 1
    double visible = 0.0;
    double bounced = 0.0;
    for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
    {
      const double direct = 1.0 - HorizonLight(GetCode(surface, k)).GetHiddenCosine();
      const double bounce = GetBounce(surface, k).GetTransfer()[0] * uniform / Pi;
      EXPECT_LE(direct + bounce, 1.0 + 1e-9) << endPhi << " " << k;
      EXPECT_GE(bounce, 0.0);
      visible += direct / static_cast<double>(surface->GetNumberOfPoints());
      bounced += bounce / static_cast<double>(surface->GetNumberOfPoints());
    }
    // In a sphere all points see the same of the opening, and of the rest: the share of the whole
    // area. Then the bounce is (1 - v) v.
    const double open = 0.5 * (1.0 - std::cos((180.0 - endPhi) * Pi / 180.0));
    EXPECT_NEAR(visible, open, 0.03) << endPhi;
    EXPECT_NEAR(bounced, visible * (1.0 - visible), 0.1 * visible) << endPhi;
  }
}

// Under light of degree 0 to 2, against traced light with one bounce.
TEST(BouncedLight, BouncesAreThoseOfTracedLight)
{
  const auto hollow = MakeHollow(120.0);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetNumberOfRays(256);
  filter->BounceOn();
  vtkPolyData* surface = Trace(filter, hollow);
  vtkNew<vtkEnvironment> environment;
  const int width = 32;
  std::vector<float> pixels;
  sky::Colors light;
  light.fill(glm::dvec3(0.0));
  for (int k = 0; k < width * width / 2; ++k)
  {
    glm::dvec3 d;
    vtkEnvironment::GetDirection((k % width + 0.5) / width, (k / width + 0.5) / (width / 2), &d.x);
    const glm::vec3 radiance(1.0 + d.x, 1.0 + d.z, 1.0 + 2.0 * d.y * d.z);
    pixels.insert(pixels.end(), &radiance.x, &radiance.x + 3);
    const sky::Values values = sky::Evaluate(d);
    const double solidAngle = 2.0 * Pi / width * 2.0 * std::sin(Pi / width) * std::hypot(d.x, d.z);
    for (std::size_t j = 0; j < values.size(); ++j)
    {
      light[j] += values[j] * solidAngle * glm::dvec3(radiance);
    }
  }
  environment->SetPixels(width, width / 2, pixels);
  vtkNew<vtkTracedScene> scene;
  scene->AddSurface(hollow);
  vtkNew<vtkLambertBRDF> white;
  white->SetAlbedo(1.0, 1.0, 1.0);
  vtkNew<vtkTracedRadianceIntegrator> reference;
  reference->SetScene(scene);
  reference->SetBRDF(white);
  reference->SetEnvironment(environment);
  reference->UnoccludedReferenceOff();
  vtkNew<vtkPoints> positions;
  vtkNew<vtkDoubleArray> views; // along the normals
  views->SetNumberOfComponents(3);
  constexpr vtkIdType step = 11; // of points
  for (vtkIdType k = 0; k < hollow->GetNumberOfPoints(); k += step)
  {
    glm::dvec3 p;
    hollow->GetPoint(k, &p.x);
    p *= 0.99; // a little inside: the facets are chords
    positions->InsertNextPoint(&p.x);
    views->InsertNextTuple(hollow->GetPointData()->GetNormals()->GetTuple(k));
  }
  vtkNew<vtkPolyData> points;
  points->SetPoints(positions);
  points->GetPointData()->SetNormals(views);
  vtkNew<vtkDoubleArray> radiance[2];
  reference->SetNumberOfSamples(8192);
  for (int bounces = 0; bounces < 2; ++bounces)
  {
    reference->SetNumberOfBounces(bounces);
    ASSERT_TRUE(reference->Integrate(points, views, radiance[bounces]));
  }
  double difference = 0.0;
  double traced = 0.0;
  double bias = 0.0;
  double visible = 0.0;
  for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k)
  {
    const glm::dvec3 found = GetBounce(surface, step * k).GetIrradiance(light) / Pi;
    for (int c = 0; c < 3; ++c)
    {
      const double direct = radiance[0]->GetComponent(k, c);
      const double wanted = radiance[1]->GetComponent(k, c) - direct;
      difference += std::abs(found[c] - wanted);
      traced += wanted;
      bias += found[c] - wanted;
      visible += direct;
    }
  }
  EXPECT_GT(traced, 0.2 * visible);
  EXPECT_LT(std::abs(bias), 0.03 * traced);
  EXPECT_LT(difference, 0.05 * traced); // most of it is the reference's noise
}

// The bounce comes on top of what is known; off, the output has none.
TEST(BouncedLight, IsTracedOnTopOfTheSky)
{
  const auto hollow = MakeHollow(120.0);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  vtkNew<vtkPolyData> without;
  without->DeepCopy(Trace(filter, hollow));
  EXPECT_FALSE(GetBounced(without));
  filter->BounceOn();
  filter->BothSidesOn();
  vtkNew<vtkPolyData> with;
  with->DeepCopy(Trace(filter, hollow));
  EXPECT_EQ(filter->GetNumberOfTraces(), 2);
  for (const char* name : { vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName(),
         vtkSurfaceVisibilityFilter::GetHiddenLightArrayName() })
  {
    EXPECT_TRUE(AreEqual(GetBytes(with, name), GetBytes(without, name)));
  }
  EXPECT_TRUE(GetBounced(with));
  // The outside of the hollow is convex.
  ASSERT_TRUE(GetBounced(with, "Back"));
  double largest = 0.0;
  for (vtkIdType k = 0; k < with->GetNumberOfPoints(); ++k)
  {
    largest = std::max(largest, GetBounce(with, k, "Back").GetTransfer()[0]);
  }
  EXPECT_LT(largest, 0.02);
  filter->BounceOff();
  EXPECT_FALSE(GetBounced(Trace(filter, hollow)));
  filter->BounceOn();
  EXPECT_TRUE(AreEqual(GetBounced(Trace(filter, hollow)), GetBounced(with)));
  EXPECT_EQ(filter->GetNumberOfTraces(), 2); // all of it was known
  // In two blocks, which reflect each other's light.
  vtkNew<vtkSurfaceVisibilityFilter> whole;
  whole->BounceOn();
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(4, 4);
  plane->Update();
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.0, 0.0, 0.4);
  ball->SetRadius(0.2);
  ball->Update();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, plane->GetOutput());
  blocks->SetBlock(1, ball->GetOutput());
  whole->SetInputDataObject(blocks);
  whole->Update();
  auto* out = vtkMultiBlockDataSet::SafeDownCast(whole->GetOutputDataObject(0));
  auto* floor = vtkPolyData::SafeDownCast(out->GetBlock(0));
  double middle[3] = { 0.0, 0.0, 0.0 };
  EXPECT_GT(GetBounce(floor, floor->FindPoint(middle)).GetTransfer()[0], 0.01);
  // An occluder reflects nothing, whether or not the surface hides itself.
  for (const bool self : { true, false })
  {
    vtkNew<vtkSurfaceVisibilityFilter> occluded;
    occluded->BounceOn();
    occluded->SetSelfOcclusion(self);
    occluded->AddOccluder(ball->GetOutput());
    vtkPolyData* dark = Trace(occluded, plane->GetOutput());
    EXPECT_GT(HorizonLight(GetCode(dark, dark->FindPoint(middle))).GetHiddenCosine(), 0.05);
    EXPECT_EQ(GetBounce(dark, dark->FindPoint(middle)).GetTransfer()[0], 0.0);
  }
}

// What an input has of an earlier run is not passed on beside new arrays, which have the key.
TEST(BouncedLight, OfAnEarlierRunGoes)
{
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->BothSidesOn();
  filter->BounceOn();
  vtkNew<vtkPolyData> old;
  old->DeepCopy(Trace(filter, MakeHollow(90.0)));
  vtkNew<vtkSurfaceVisibilityFilter> again;
  vtkPolyData* anew = Trace(again, old);
  EXPECT_FALSE(GetBounced(anew));
  EXPECT_FALSE(GetBounced(anew, "Back"));
  EXPECT_EQ(
    anew->GetPointData()->GetNumberOfArrays(), old->GetPointData()->GetNumberOfArrays() - 4);
  EXPECT_TRUE(GetBounced(old));
}
