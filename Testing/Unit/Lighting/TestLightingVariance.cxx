// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorCatcher.h"
#include "HalfVector.h" // for Pi
#include "RandomLight.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFResampler.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkDistributionBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkExactRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"
#include "vtkVarianceLightSetGenerator.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iostream>
#include <random>
#include <string>
#include <vector>

using measuredbrdf::Pi;

namespace
{
// A light as plain numbers, to compare sets.
using Light = std::array<double, 11>;

std::vector<Light> GetLights(vtkLightSet* lights)
{
  std::vector<Light> all;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    Light light;
    lights->GetDirection(k, &light[0]);
    lights->GetIrradiance(k, &light[3]);
    light[6] = lights->GetSolidAngle(k);
    int region[4];
    EXPECT_TRUE(lights->GetRegion(k, region));
    std::copy_n(region, 4, &light[7]);
    all.push_back(light);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// One bright texel before a background.
void SetSingle(
  vtkEnvironment* environment, int width, int height, int x, int y, float value, float background)
{
  std::vector<float> rgb(3 * std::size_t(width) * height, background);
  std::fill_n(&rgb[3 * (std::size_t(y) * width + x)], 3, value);
  ASSERT_TRUE(environment->SetPixels(width, height, rgb));
}

double GetTotalLuminance(vtkEnvironment* environment)
{
  double total[3];
  environment->GetTotal(total);
  return vtkEnvironment::GetLuminance(total);
}

// Sum of luminance x |direction - centroid|^2 over a region, by the definition: two passes, no
// difference of near numbers.
double GetVariance(vtkEnvironment* environment, const int r[4])
{
  environment = environment->GetSubdivided();
  double energy = 0.0;
  glm::dvec3 centroid(0.0);
  double variance = 0.0;
  for (int pass = 0; pass < 2; ++pass)
  {
    for (int y = r[1]; y < r[3]; ++y)
    {
      for (int x = r[0]; x < r[2]; ++x)
      {
        double rgb[3];
        glm::dvec3 d;
        environment->GetPixel(x, y, rgb);
        environment->GetTexelDirection(x, y, &d.x);
        const double w = vtkEnvironment::GetLuminance(rgb) * environment->GetTexelSolidAngle(y);
        if (pass == 0)
        {
          energy += w;
          centroid += w * d;
        }
        else
        {
          variance += w * glm::dot(d - centroid, d - centroid);
        }
      }
    }
    if (pass == 0 && energy > 0.0)
    {
      centroid /= energy;
    }
  }
  return variance;
}

double GetResidual(vtkEnvironment* environment, vtkLightSet* lights)
{
  double sum = 0.0;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    int region[4];
    EXPECT_TRUE(lights->GetRegion(k, region));
    sum += GetVariance(environment, region);
  }
  return sum / GetTotalLuminance(environment);
}

void ExpectTiling(vtkEnvironment* environment, vtkLightSet* lights)
{
  environment = environment->GetSubdivided();
  std::vector<int> cover(std::size_t(environment->GetWidth()) * environment->GetHeight(), 0);
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    int r[4];
    ASSERT_TRUE(lights->GetRegion(k, r));
    for (int y = r[1]; y < r[3]; ++y)
    {
      for (int x = r[0]; x < r[2]; ++x)
      {
        ++cover[std::size_t(y) * environment->GetWidth() + x];
      }
    }
  }
  EXPECT_EQ(std::count(cover.begin(), cover.end(), 1), std::ptrdiff_t(cover.size()));
}

void ExpectSane(vtkEnvironment* environment, vtkLightSet* lights)
{
  double total[3];
  double sum[3];
  environment->GetTotal(total);
  lights->GetTotal(sum);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(sum[c], total[c], 1e-12 * total[c]);
  }
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    double d[3];
    lights->GetDirection(k, d);
    EXPECT_NEAR(vtkMath::Norm(d), 1.0, 1e-14);
    EXPECT_TRUE(std::isfinite(lights->GetConcentration(k)));
    EXPECT_GE(lights->GetConcentration(k), 0.0);
    EXPECT_GT(lights->GetSolidAngle(k), 0.0);
  }
}

struct Pairs
{
  explicit Pairs(int count)
  {
    std::mt19937 engine(3);
    const auto direction = [&engine]()
    {
      const double z = 2.0 * (engine() * 0x1p-32) - 1.0;
      const double phi = 2.0 * Pi * (engine() * 0x1p-32);
      const double s = std::sqrt(1.0 - z * z);
      return glm::dvec3(s * std::cos(phi), z, s * std::sin(phi));
    };
    this->Normals->SetNumberOfComponents(3);
    this->Views->SetNumberOfComponents(3);
    for (int k = 0; k < count; ++k)
    {
      const glm::dvec3 n = direction();
      const glm::dvec3 v = direction();
      const glm::dvec3 o = glm::normalize((glm::dot(n, v) < 0.0 ? -v : v) + 0.2 * n);
      this->Normals->InsertNextTuple(&n.x);
      this->Views->InsertNextTuple(&o.x);
    }
  }
  vtkNew<vtkDoubleArray> Normals;
  vtkNew<vtkDoubleArray> Views;
};

// Of green, against the exact sum.
struct Errors
{
  double RMS;    // of the difference, relative to the RMS of the exact values
  double Median; // of the relative differences
};

Errors Compare(vtkDoubleArray* exact, vtkRadianceIntegrator* integrator, const Pairs& pairs)
{
  vtkNew<vtkDoubleArray> radiance;
  EXPECT_TRUE(integrator->Integrate(pairs.Normals, pairs.Views, radiance));
  double squares = 0.0;
  double sum = 0.0;
  std::vector<double> relative;
  for (vtkIdType k = 0; k < exact->GetNumberOfTuples(); ++k)
  {
    const double expected = exact->GetComponent(k, 1);
    const double difference = radiance->GetComponent(k, 1) - expected;
    EXPECT_TRUE(std::isfinite(difference));
    squares += difference * difference;
    sum += expected * expected;
    relative.push_back(std::abs(difference) / expected);
  }
  std::nth_element(
    relative.begin(), relative.begin() + std::ptrdiff_t(relative.size() / 2), relative.end());
  return { std::sqrt(squares / sum), relative[relative.size() / 2] };
}
} // namespace

//------------------------------------------------------------------------------
TEST(LightConcentration, FromVariance)
{
  // Of a von Mises-Fisher distribution itself: r = coth(kappa) - 1/kappa, v = 1 - r^2. The closed
  // form is within 4 % of the exact inverse (Banerjee et al. 2005).
  for (double kappa : { 0.5, 2.0, 10.0, 1e3, 1e6 })
  {
    const double r = 1.0 / std::tanh(kappa) - 1.0 / kappa;
    const double v = (1.0 - r) * (1.0 + r);
    EXPECT_NEAR(vtkLightSet::GetConcentrationOfVariance(v), kappa, 0.04 * kappa);
  }
  EXPECT_EQ(vtkLightSet::GetConcentrationOfVariance(0.0), 0.0);
  EXPECT_NEAR(vtkLightSet::GetConcentrationOfVariance(1.0), 3e-3, 1e-8); // all around, not Dirac
}

//------------------------------------------------------------------------------
TEST(Variance, ClosedFormIsTheDefinition)
{
  vtkNew<vtkVarianceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 64, 32);
  for (int count : { 1, 2, 64, 1000 })
  {
    ASSERT_TRUE(generator->Generate(environment, count, lights));
    ASSERT_EQ(lights->GetNumberOfLights(), count);
    EXPECT_NEAR(
      generator->GetResidualVariance(), GetResidual(environment, lights), 1e-14 + 1e-12 / count);
    for (int k = 0; k < count; ++k)
    {
      int r[4];
      ASSERT_TRUE(lights->GetRegion(k, r));
      double e[3];
      lights->GetIrradiance(k, e);
      const double v = GetVariance(environment, r) / vtkEnvironment::GetLuminance(e);
      // One texel: Dirac.
      const double kappa = v < 1e-20 ? 0.0 : vtkLightSet::GetConcentrationOfVariance(v);
      // V/E = 2/kappa comes from a difference of numbers near 1.
      EXPECT_NEAR(lights->GetConcentration(k), kappa, kappa * (1e-8 + 1e-15 * kappa));
    }
    ExpectTiling(environment, lights);
  }
}

//------------------------------------------------------------------------------
TEST(Variance, FirstCutIsTheBestOne)
{
  const int width = 128;
  const int height = 64;
  vtkNew<vtkEnvironment> environment;
  vtkNew<vtkVarianceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  for (unsigned int trial = 0; trial < 6; ++trial)
  {
    SetRandom(environment, width, height, trial);
    double best = 1e30;
    std::array<int, 4> expected = {};
    for (int cut = 1; cut < width + height; ++cut)
    {
      const bool inX = cut < width;
      const std::array<int, 4> first = inX ? std::array<int, 4>{ 0, 0, cut, height }
                                           : std::array<int, 4>{ 0, 0, width, cut - width };
      const std::array<int, 4> second = inX ? std::array<int, 4>{ cut, 0, width, height }
                                            : std::array<int, 4>{ 0, cut - width, width, height };
      const double cost =
        GetVariance(environment, first.data()) + GetVariance(environment, second.data());
      if (cut != width && cost < best)
      {
        best = cost;
        expected = first;
      }
    }
    ASSERT_TRUE(generator->Generate(environment, 2, lights));
    std::array<int, 4> region;
    ASSERT_TRUE(lights->GetRegion(0, region.data()));
    EXPECT_EQ(region, expected);
  }
}

//------------------------------------------------------------------------------
TEST(Variance, KeepsTheEnergy)
{
  vtkNew<vtkVarianceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  const int sizes[][2] = { { 1, 1 }, { 1, 7 }, { 9, 1 }, { 33, 17 }, { 128, 64 } };
  for (const auto& size : sizes)
  {
    vtkNew<vtkEnvironment> environment;
    SetRandom(environment, size[0], size[1]);
    for (int count : { 1, 3, 63, 1000 })
    {
      ASSERT_TRUE(generator->Generate(environment, count, lights));
      EXPECT_LE(lights->GetNumberOfLights(), count);
      ExpectSane(environment, lights);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Variance, SetsAreNested)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 64, 32);
  vtkNew<vtkVarianceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  std::vector<Light> last;
  double residual = 2.0;
  for (int count = 1; count < 100; ++count)
  {
    ASSERT_TRUE(generator->Generate(environment, count, lights));
    const std::vector<Light> now = GetLights(lights);
    std::vector<Light> gone;
    std::vector<Light> come;
    std::set_difference(last.begin(), last.end(), now.begin(), now.end(), std::back_inserter(gone));
    std::set_difference(now.begin(), now.end(), last.begin(), last.end(), std::back_inserter(come));
    if (count > 1)
    {
      EXPECT_EQ(gone.size(), 1u);
      EXPECT_EQ(come.size(), 2u);
    }
    EXPECT_LT(generator->GetResidualVariance(), residual);
    residual = generator->GetResidualVariance();
    last = now;
  }
  // A tree made at once has the same splits as one that grew; sums are added up in another order.
  ASSERT_TRUE(generator->Generate(environment, 1500, lights));
  last = GetLights(lights);
  vtkNew<vtkVarianceLightSetGenerator> once;
  vtkNew<vtkLightSet> other;
  ASSERT_TRUE(once->Generate(environment, 1500, other));
  const std::vector<Light> same = GetLights(other);
  ASSERT_EQ(same.size(), last.size());
  for (std::size_t k = 0; k < same.size(); ++k)
  {
    for (std::size_t c = 0; c < same[k].size(); ++c)
    {
      EXPECT_NEAR(same[k][c], last[k][c], 1e-12);
    }
  }
}

//------------------------------------------------------------------------------
TEST(Variance, NumberForVariance)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  vtkNew<vtkVarianceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  for (double target : { 1.0, 0.05, 0.01, 0.002 })
  {
    const int count = generator->GetNumberOfLightsForVariance(environment, target);
    ASSERT_TRUE(generator->Generate(environment, count, lights));
    EXPECT_LE(generator->GetResidualVariance(), target);
    if (count > 1)
    {
      ASSERT_TRUE(generator->Generate(environment, count - 1, lights));
      EXPECT_GT(generator->GetResidualVariance(), target);
    }
  }
  ASSERT_TRUE(environment->SetPixels(128, 64, std::vector<float>(3 * 128 * 64, 1.0f)));
  EXPECT_EQ(generator->GetNumberOfLightsForVariance(environment, 0.0), 128 * 64);
  ErrorCatcher errors(generator);
  EXPECT_EQ(generator->GetNumberOfLightsForVariance(nullptr, 0.1), 0);
  EXPECT_EQ(generator->GetNumberOfLightsForVariance(environment, -0.1), 0);
  EXPECT_EQ(generator->GetNumberOfLightsForVariance(environment, std::nan("")), 0);
  EXPECT_EQ(errors.Take(), 3);
}

//------------------------------------------------------------------------------
TEST(Variance, FollowsThePixelsNotTheRotation)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 64, 32);
  vtkNew<vtkVarianceLightSetGenerator> generator;
  int trees = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&trees);
  count->SetCallback([](vtkObject*, unsigned long, void* data, void* progress)
    { *static_cast<int*>(data) += *static_cast<double*>(progress) == 0.0; });
  generator->AddObserver(vtkCommand::ProgressEvent, count);
  vtkNew<vtkLightSet> lights;
  ASSERT_TRUE(generator->Generate(environment, 50, lights));
  const std::vector<Light> before = GetLights(lights);
  environment->SetRotationY(33.0);
  ASSERT_TRUE(generator->Generate(environment, 50, lights));
  EXPECT_EQ(GetLights(lights), before);
  ASSERT_TRUE(generator->Generate(environment, 1000, lights));
  EXPECT_EQ(trees, 1);
  SetRandom(environment, 64, 32, 2);
  ASSERT_TRUE(generator->Generate(environment, 50, lights));
  EXPECT_EQ(trees, 2);
  EXPECT_NE(GetLights(lights), before);
}

//------------------------------------------------------------------------------
TEST(Variance, RefusesAndAborts)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 8, 4);
  vtkNew<vtkEnvironment> empty;
  vtkNew<vtkVarianceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  ASSERT_TRUE(generator->Generate(environment, 4, lights));
  ErrorCatcher errors(generator);
  EXPECT_FALSE(generator->Generate(nullptr, 4, lights));
  EXPECT_FALSE(generator->Generate(empty, 4, lights));
  EXPECT_FALSE(generator->Generate(environment, 4, nullptr));
  EXPECT_FALSE(generator->Generate(environment, 0, lights));
  EXPECT_EQ(errors.Take(), 4);

  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* self, unsigned long, void*, void*)
    { static_cast<vtkVarianceLightSetGenerator*>(self)->SetAbort(true); });
  const unsigned long tag = generator->AddObserver(vtkCommand::ProgressEvent, abort);
  SetRandom(environment, 64, 32);
  EXPECT_FALSE(generator->Generate(environment, 64, lights));
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_NE(errors.GetText().find("aborted"), std::string::npos);
  EXPECT_EQ(lights->GetNumberOfLights(), 4);
  generator->RemoveObserver(tag);
  EXPECT_TRUE(generator->Generate(environment, 64, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 64);
}

//------------------------------------------------------------------------------
TEST(Variance, DegenerateEnvironments)
{
  vtkNew<vtkEnvironment> environment;
  vtkNew<vtkLightSet> lights;
  vtkNew<vtkVarianceLightSetGenerator> generator;
  // Black: no lights.
  ASSERT_TRUE(environment->SetPixels(8, 4, std::vector<float>(96, 0.0f)));
  EXPECT_TRUE(generator->Generate(environment, 64, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 0);
  EXPECT_EQ(generator->GetResidualVariance(), 0.0);

  // Uniform: any number, a light a texel at most; a single one still has a direction.
  ASSERT_TRUE(environment->SetPixels(128, 64, std::vector<float>(3 * 128 * 64, 1.0f)));
  for (int count : { 1, 7, 8192, 16384 })
  {
    EXPECT_TRUE(generator->Generate(environment, count, lights));
    EXPECT_EQ(lights->GetNumberOfLights(), std::min(count, 8192));
    ExpectSane(environment, lights);
    EXPECT_EQ(generator->GetResidualVariance() == 0.0, count >= 8192);
  }
  // But large texels are areas: as many lights as are wanted.
  ASSERT_TRUE(environment->SetPixels(8, 4, std::vector<float>(96, 1.0f)));
  EXPECT_TRUE(generator->Generate(environment, 64, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 64);
  ExpectSane(environment, lights);

  // One texel: one light there, Dirac.
  SetSingle(environment, 128, 64, 5, 11, 3.0f, 0.0f);
  EXPECT_TRUE(generator->Generate(environment, 64, lights));
  ASSERT_EQ(lights->GetNumberOfLights(), 1);
  glm::dvec3 center;
  glm::dvec3 d;
  environment->GetTexelDirection(5, 11, &center.x);
  lights->GetDirection(0, &d.x);
  EXPECT_LT(glm::distance(d, center), 1e-14);
  EXPECT_LT(generator->GetResidualVariance(), 1e-14);

  // A sun of the sunrise's radiance before a dim sky: split off, however little area it has.
  SetSingle(environment, 512, 256, 100, 170, 222208.0f, 1e-3f);
  EXPECT_TRUE(generator->Generate(environment, 64, lights));
  EXPECT_EQ(lights->GetNumberOfLights(), 64);
  ExpectSane(environment, lights);
  environment->GetTexelDirection(100, 170, &center.x);
  double nearest = 4.0;
  for (int k = 0; k < 64; ++k)
  {
    lights->GetDirection(k, &d.x);
    nearest = std::min(nearest, glm::distance(d, center));
  }
  EXPECT_LT(nearest, 1e-6);
}

//------------------------------------------------------------------------------
TEST(Variance, RadianceConverges)
{
  // Twice the lights, about half the error: 16 to 1024 lights bring it down by 64 at a rate of 1.
  const Pairs pairs(60);
  vtkNew<vtkMedianCutLightSetGenerator> medianCut;
  vtkNew<vtkVarianceLightSetGenerator> greedy;
  vtkNew<vtkLightSet> lights;
  for (bool hall : { false, true })
  {
    vtkNew<vtkEnvironment> environment;
    if (hall)
    {
      environment->SetToProceduralHall();
    }
    else
    {
      environment->SetToProceduralSky();
    }
    vtkNew<vtkBlinnPhongBRDF> lobe;
    lobe->SetExponent(20.0);
    vtkNew<vtkExactRadianceIntegrator> reference;
    reference->SetBRDF(lobe);
    reference->SetEnvironment(environment);
    vtkNew<vtkDoubleArray> exact;
    ASSERT_TRUE(reference->Integrate(pairs.Normals, pairs.Views, exact));
    vtkNew<vtkLightSetRadianceIntegrator> integrator;
    integrator->SetBRDF(lobe);
    integrator->SetLightSet(lights);
    std::vector<double> errors;
    for (int count : { 16, 64, 256, 1024 })
    {
      ASSERT_TRUE(medianCut->Generate(environment, count, lights));
      const Errors median = Compare(exact, integrator, pairs);
      ASSERT_TRUE(greedy->Generate(environment, count, lights));
      const Errors ours = Compare(exact, integrator, pairs);
      std::cout << (hall ? "hall" : "sky") << ", N = " << count << ", n = 20: RMS/median error "
                << median.RMS << "/" << median.Median << " (median cut), " << ours.RMS << "/"
                << ours.Median << " (greedy), law " << 0.06 * 20.0 * greedy->GetResidualVariance()
                << "\n";
      if (count >= 64)
      {
        EXPECT_LT(ours.RMS, median.RMS / 2.0);
        EXPECT_LT(ours.Median, median.Median / 2.0);
        EXPECT_LT(ours.RMS, 2.0 * 0.06 * 20.0 * greedy->GetResidualVariance());
      }
      errors.push_back(ours.RMS);
    }
    EXPECT_LT(errors.back(), errors.front() / 64.0);
  }
}

//------------------------------------------------------------------------------
TEST(SoftLights, NoSpreadIsHard)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkBlinnPhongBRDF> phong;
  vtkNew<vtkAshikhminShirleyBRDF> shirley;
  vtkNew<vtkDistributionBRDF> distribution;
  vtkNew<vtkBRDFResampler> resampler;
  resampler->SetInput(shirley);
  ASSERT_TRUE(resampler->ResampleTo(8, 8, 20));
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(phong);
  sum->AddTerm(distribution);
  const double i[3] = { 0.1, 0.2, 0.9 };
  const double o[3] = { 0.1, -0.4, 0.8 };
  for (vtkBRDF* brdf : std::initializer_list<vtkBRDF*>{ lambert.Get(), phong.Get(), shirley.Get(),
         distribution.Get(), resampler->GetOutput(), sum.Get() })
  {
    brdf->Prepare();
    double hard[3];
    double soft[3];
    brdf->Evaluate(i, o, hard);
    brdf->EvaluateSoft(i, o, 0.0, soft);
    EXPECT_EQ(soft[1], hard[1]) << brdf->GetClassName();
    brdf->EvaluateSoft(i, o, 1e-9, soft);
    EXPECT_NEAR(soft[1], hard[1], 1e-6 * hard[1]) << brdf->GetClassName();
    brdf->EvaluateSoft(i, o, std::nan(""), soft);
    EXPECT_EQ(soft[1], hard[1]) << brdf->GetClassName();
    for (double spread : { 1e-3, 1.0, 1e300 })
    {
      brdf->EvaluateSoft(i, o, spread, soft);
      EXPECT_TRUE(std::isfinite(soft[1]) && soft[1] >= 0.0) << brdf->GetClassName();
    }
    const double below[3] = { 0.1, 0.2, -0.1 };
    brdf->EvaluateSoft(below, o, 0.1, soft);
    EXPECT_EQ(soft[1], 0.0);
  }
}

//------------------------------------------------------------------------------
TEST(SoftLights, AreTheMeanOverTheLight)
{
  // Against the mean of f over a von Mises-Fisher distribution about i, near the mirror direction
  // of a normal view, where the widths add up exactly for Gaussians.
  vtkNew<vtkBlinnPhongBRDF> phong;
  phong->SetExponent(400.0);
  const double o[3] = { 0.0, 0.0, 1.0 };
  for (double kappa : { 50.0, 200.0, 1000.0 })
  {
    for (double angle : { 0.0, 0.05, 0.1 })
    {
      const double i[3] = { std::sin(angle), 0.0, std::cos(angle) };
      double mean = 0.0;
      constexpr int rings = 200;
      constexpr int spokes = 200;
      for (int a = 0; a < rings; ++a)
      {
        const double c = 1.0 + std::log((a + 0.5) / rings) / kappa; // cosine to i
        const double s = std::sqrt(1.0 - c * c);
        for (int b = 0; b < spokes; ++b)
        {
          const double phi = 2.0 * Pi * (b + 0.5) / spokes;
          const double x = s * std::cos(phi);
          const double d[3] = { x * i[2] + c * i[0], s * std::sin(phi), c * i[2] - x * i[0] };
          double f[3];
          phong->Evaluate(d, o, f);
          mean += f[1] / (rings * spokes);
        }
      }
      double soft[3];
      phong->EvaluateSoft(i, o, 1.0 / kappa, soft);
      EXPECT_NEAR(soft[1], mean, 0.05 * mean) << kappa << " " << angle;
    }
  }
}

//------------------------------------------------------------------------------
TEST(SoftLights, LevelsOfATableAreTheClosedForm)
{
  // The table's p widened on the sphere against the lobe of the widened exponent; F = 1.
  for (double n : { 20.0, 200.0, 2000.0 })
  {
    vtkNew<vtkDistributionBRDF> table;
    table->SetBlinnDistribution(n);
    ASSERT_TRUE(table->SetFresnel(1, { 1.0f, 1.0f, 1.0f }));
    table->Prepare();
    for (double kappa : { 20.0, 200.0, 2e4 })
    {
      const double variance = 1.0 / (4.0 * kappa); // normal view: o.h is nearly 1
      const double widened = 1.0 / (1.0 / n + variance);
      const double peak = (widened + 2.0) / (2.0 * Pi);
      for (double angle : { 0.0, 0.5, 1.0 })
      {
        const double h = angle / std::sqrt(widened); // in widths
        // Both directions tilted by h from the normal: i = o = h.
        const double d[3] = { std::sin(h), 0.0, std::cos(h) };
        double soft[3];
        table->EvaluateSoft(d, d, 1.0 / kappa, soft);
        const double g = 4.0 * (2.0 * d[2] - d[2] * d[2]);
        const double expected = peak * std::pow(d[2], widened) / g;
        EXPECT_NEAR(soft[1], expected, 0.06 * expected) << n << " " << kappa << " " << angle;
      }
    }
  }
}

namespace
{
// The median error of 64 soft lights against that of hard ones, for lobes of exponent n.
using MakeLobes = std::vector<vtkSmartPointer<vtkBRDF>> (*)(double n);

void ExpectSoftLowersTheError(MakeLobes make)
{
  const Pairs pairs(60);
  vtkNew<vtkVarianceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  for (bool hall : { false, true })
  {
    vtkNew<vtkEnvironment> environment;
    if (hall)
    {
      environment->SetToProceduralHall();
    }
    else
    {
      environment->SetToProceduralSky();
    }
    ASSERT_TRUE(generator->Generate(environment, 64, lights));
    for (double n : { 100.0, 500.0 })
    {
      for (vtkBRDF* lobe : make(n))
      {
        vtkNew<vtkExactRadianceIntegrator> reference;
        reference->SetBRDF(lobe);
        reference->SetEnvironment(environment);
        vtkNew<vtkDoubleArray> exact;
        ASSERT_TRUE(reference->Integrate(pairs.Normals, pairs.Views, exact));
        vtkNew<vtkLightSetRadianceIntegrator> integrator;
        integrator->SetBRDF(lobe);
        integrator->SetLightSet(lights);
        const Errors hard = Compare(exact, integrator, pairs);
        integrator->SoftLightsOn();
        const Errors soft = Compare(exact, integrator, pairs);
        std::cout << (hall ? "hall, " : "sky, ") << lobe->GetClassName() << ", N = 64, n = " << n
                  << ": RMS/median error " << hard.RMS << "/" << hard.Median << " hard, "
                  << soft.RMS << "/" << soft.Median << " soft\n";
        EXPECT_LT(soft.Median, hard.Median / 1.5);
        EXPECT_LT(soft.RMS, hard.RMS);
      }
    }
  }
}
}

//------------------------------------------------------------------------------
TEST(SoftLights, LowerTheErrorOfSharpLobes)
{
  ExpectSoftLowersTheError(
    [](double n)
    {
      auto phong = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
      phong->SetExponent(n);
      auto distribution = vtkSmartPointer<vtkDistributionBRDF>::New();
      distribution->SetBlinnDistribution(n);
      return std::vector<vtkSmartPointer<vtkBRDF>>{ phong, distribution };
    });
}

//------------------------------------------------------------------------------
TEST(SoftLights, LowerTheErrorOfTables)
{
  ExpectSoftLowersTheError(
    [](double n)
    {
      vtkNew<vtkDistributionBRDF> distribution;
      distribution->SetBlinnDistribution(n);
      vtkNew<vtkBRDFResampler> resampler;
      resampler->SetInput(distribution);
      EXPECT_TRUE(resampler->ResampleTo(18, 45, 90));
      return std::vector<vtkSmartPointer<vtkBRDF>>{ resampler->GetOutput() };
    });
}
