// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The pairs that plans are checked on: where errors are, without a bias, and predictions that hold
// on thousands of other pairs.

#include "HalfVector.h" // for Pi
#include "PlanSearch.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

using measuredbrdf::ChoosePairs;
using measuredbrdf::PlanPairs;

namespace
{
constexpr int Many = 8192;

// A lamp that only normals within 6 degrees of +x see: 1 there, 0 elsewhere.
double GetLamp(vtkDoubleArray* normals, vtkIdType k)
{
  return normals->GetComponent(k, 0) > 0.9945 ? 1.0 : 0.0;
}

vtkNew<vtkDoubleArray> NewRadiance(vtkDoubleArray* normals, double everywhere, double lamp)
{
  vtkNew<vtkDoubleArray> radiance;
  radiance->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < normals->GetNumberOfTuples(); ++k)
  {
    const double value = everywhere + lamp * GetLamp(normals, k);
    radiance->InsertNextTuple3(value, value, value);
  }
  return radiance;
}

// What a weighted sample says that a share of the pixels sees the lamp.
double GetLampShare(const PlanPairs& pairs)
{
  double sum = 0.0;
  double all = 0.0;
  for (std::size_t k = 0; k < pairs.Weights.size(); ++k)
  {
    sum += pairs.Weights[k] * GetLamp(pairs.Normals, static_cast<vtkIdType>(k));
    all += pairs.Weights[k];
  }
  return sum / all;
}

int CountLamp(const PlanPairs& pairs)
{
  int count = 0;
  for (vtkIdType k = 0; k < pairs.Normals->GetNumberOfTuples(); ++k)
  {
    count += GetLamp(pairs.Normals, k) > 0.0 ? 1 : 0;
  }
  return count;
}

PlanPairs DrawMany() { return measuredbrdf::DrawSpherePairs(Many); }
}

//------------------------------------------------------------------------------
// Two methods that differ on a lamp only, which 0.3 % of the pixels see: nearly all pairs that see
// it are chosen, and the weights make up for it.
TEST(PlanSample, LooksWhereMethodsDiffer)
{
  const PlanPairs all = DrawMany();
  const auto coarse = NewRadiance(all.Normals, 1.0, 1.0);
  const auto fine = NewRadiance(all.Normals, 1.0, 3.0);
  const PlanPairs chosen = ChoosePairs(all, coarse, fine, 512);
  EXPECT_NEAR(chosen.Normals->GetNumberOfTuples(), 512, 1);
  EXPECT_EQ(chosen.Views->GetNumberOfTuples(), chosen.Normals->GetNumberOfTuples());
  ASSERT_EQ(static_cast<vtkIdType>(chosen.Weights.size()), chosen.Normals->GetNumberOfTuples());
  std::printf("%d of %d pairs that see the lamp, uniform sample: %.1f\n", CountLamp(chosen),
    CountLamp(all), 512.0 * CountLamp(all) / Many);
  EXPECT_GE(CountLamp(chosen), 0.8 * CountLamp(all));
  const double share = GetLampShare(all);
  EXPECT_NEAR(GetLampShare(chosen), share, 0.05 * share);
  const double weight = std::accumulate(all.Weights.begin(), all.Weights.end(), 0.0);
  EXPECT_NEAR(
    std::accumulate(chosen.Weights.begin(), chosen.Weights.end(), 0.0), weight, 0.05 * weight);
}

//------------------------------------------------------------------------------
// Every pair can be chosen, whatever two methods say; a sample is the same every time.
TEST(PlanSample, LeavesNothingOut)
{
  const PlanPairs all = DrawMany();
  const auto dark = NewRadiance(all.Normals, 0.0, 0.0);
  const auto lit = NewRadiance(all.Normals, 0.0, 0.0);
  const auto isLit = [](vtkDoubleArray* normals, vtkIdType k)
  { return normals->GetComponent(k, 1) > 0.0; };
  for (vtkIdType k = 0; k < Many; ++k)
  {
    lit->SetComponent(k, 0, isLit(all.Normals, k) ? 1.0 : 0.0);
  }
  const PlanPairs chosen = ChoosePairs(all, dark, lit, 512);
  int unlit = 0; // half of a quarter, that goes by weight, and of a fifth, of all alike
  for (vtkIdType k = 0; k < chosen.Normals->GetNumberOfTuples(); ++k)
  {
    unlit += isLit(chosen.Normals, k) ? 0 : 1;
  }
  EXPECT_NEAR(unlit, 0.5 * (0.25 + 0.2) * 512, 0.02 * 512);
  const PlanPairs again = ChoosePairs(all, dark, lit, 512);
  EXPECT_EQ(chosen.Weights, again.Weights);

  const PlanPairs black = ChoosePairs(all, dark, dark, 512);
  EXPECT_NEAR(black.Normals->GetNumberOfTuples(), 512, 1);
  const PlanPairs blind = ChoosePairs(all, nullptr, nullptr, 512);
  EXPECT_NEAR(blind.Normals->GetNumberOfTuples(), 512, 1);
  double weights = 0.0;
  double cosines = 0.0; // a disc's mean is 2/3
  for (vtkIdType k = 0; k < blind.Normals->GetNumberOfTuples(); ++k)
  {
    glm::dvec3 n, o;
    blind.Normals->GetTuple(k, &n.x);
    blind.Views->GetTuple(k, &o.x);
    weights += blind.Weights[static_cast<std::size_t>(k)];
    cosines += blind.Weights[static_cast<std::size_t>(k)] * glm::dot(n, o);
  }
  EXPECT_NEAR(weights, Many, 0.08 * Many);
  EXPECT_NEAR(cosines / weights, 2.0 / 3.0, 0.03);
}

//------------------------------------------------------------------------------
// What the pairs of all views say of single cameras is what these see: an error that grows towards
// grazing views, of light from one side.
TEST(PlanPictures, AreWhatCamerasSee)
{
  const auto getLight = [](const glm::dvec3& normal, const glm::dvec3& view)
  {
    const glm::dvec3 mirror = 2.0 * glm::dot(normal, view) * normal - view;
    return 0.1 + std::max(mirror.x, 0.0);
  };
  const auto getError = [](const glm::dvec3& normal, const glm::dvec3& view)
  { return 0.01 + 0.05 * std::pow(1.0 - glm::dot(normal, view), 2.0); };
  const PlanPairs pairs = DrawMany();
  const std::vector<double> cameras = measuredbrdf::GetPictureCameras();
  ASSERT_EQ(cameras.size(), 3u * 14u);
  EXPECT_EQ(pairs.Cameras, cameras);
  std::vector<double> differences, references;
  for (vtkIdType k = 0; k < Many; ++k)
  {
    const glm::dvec3 normal = glm::make_vec3(pairs.Normals->GetTuple3(k));
    const glm::dvec3 view = glm::make_vec3(pairs.Views->GetTuple3(k));
    const double weight = pairs.Weights[static_cast<std::size_t>(k)];
    references.push_back(weight * getLight(normal, view));
    differences.push_back(weight * getError(normal, view));
  }
  EXPECT_TRUE(measuredbrdf::GetPictureRatios(pairs, 12.0, {}, {}).empty());
  const std::vector<double> ratios =
    measuredbrdf::GetPictureRatios(pairs, 12.0, differences, references);
  ASSERT_EQ(ratios.size(), 14u);
  const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) /
                      std::accumulate(references.begin(), references.end(), 0.0);
  for (std::size_t c = 0; c < ratios.size(); ++c)
  {
    const glm::dvec3 view = glm::make_vec3(&cameras[3 * c]);
    double error = 0.0;
    double light = 0.0;
    for (int k = 0; k < 4000; ++k) // uniform over the disc
    {
      const double r = std::sqrt((k + 0.5) / 4000.0);
      const double turn = 2.4 * k;
      const glm::dvec3 u = glm::normalize(glm::cross(view, glm::dvec3(0.3, 0.8, 0.5)));
      const glm::dvec3 normal = r * (std::cos(turn) * u + std::sin(turn) * glm::cross(view, u)) +
                                std::sqrt(1.0 - r * r) * view;
      error += getError(normal, view);
      light += getLight(normal, view);
    }
    EXPECT_NEAR(ratios[c] * mean * light / error, 1.0, 0.15) << c; // of 0.7 to 1.7
  }
}

//------------------------------------------------------------------------------
// Pairs crowd where they see a lamp, and weights make up for it: shares of pixels whose mirror
// directions are within some angle of it.
TEST(PlanSample, CrowdsAboutLamps)
{
  const glm::dvec3 lamp = glm::normalize(glm::dvec3(0.3, 0.5, -0.4));
  const glm::dvec3 aside = glm::normalize(lamp + glm::dvec3(0.0, 0.0, 0.2)); // overlapping
  const PlanPairs pairs = measuredbrdf::DrawSpherePairs(
    Many, { { lamp, glm::dvec3(5.0) }, { -lamp, glm::dvec3(0.0) }, { aside, glm::dvec3(1.0) } });
  double all = 0.0;
  for (const double weight : pairs.Weights)
  {
    ASSERT_TRUE(std::isfinite(weight));
    EXPECT_GT(weight, 0.0);
    all += weight;
  }
  EXPECT_NEAR(all / Many, 1.0, 0.02);
  double cosines = 0.0;
  for (const double degrees : { 0.2, 1.0, 5.0, 30.0 })
  {
    double share = 0.0;
    int count = 0;
    cosines = 0.0;
    for (vtkIdType k = 0; k < Many; ++k)
    {
      glm::dvec3 n, o;
      pairs.Normals->GetTuple(k, &n.x);
      pairs.Views->GetTuple(k, &o.x);
      const double weight = pairs.Weights[static_cast<std::size_t>(k)];
      EXPECT_GE(glm::dot(n, o), -1e-12);
      cosines += weight * glm::dot(n, o) / all;
      const double apart = glm::length(2.0 * glm::dot(n, o) * n - o - lamp);
      if (apart < 2.0 * std::sin(0.5 * glm::radians(degrees)))
      {
        ++count;
        share += weight / all;
      }
    }
    // Mirror directions of a sphere are uniform.
    const double expected = 0.5 * (1.0 - std::cos(glm::radians(degrees)));
    std::printf("within %g degrees: %d pairs for %.3g of the pixels, expected %.3g\n", degrees,
      count, share, expected);
    EXPECT_NEAR(share, expected, 0.15 * expected);
    EXPECT_GT(count, 300);
  }
  EXPECT_NEAR(cosines, 2.0 / 3.0, 0.02); // a disc's mean
}

//------------------------------------------------------------------------------
// Lamps turn with the environment, and the pairs with them: the same plan, the same figures.
TEST(PlanSample, TurnsWithTheEnvironment)
{
  vtkNew<vtkEnvironment> environment;
  std::vector<float> pixels(3 * 64 * 32, 0.1f);
  std::fill_n(&pixels[3 * (64 * 8 + 20)], 3, 2000.0f);
  environment->SetPixels(64, 32, pixels);
  const auto brdf =
    vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-metallic-paint3"));
  std::vector<std::string> plans;
  std::vector<double> errors;
  for (const double degrees : { 0.0, 40.0 })
  {
    environment->SetRotationY(degrees);
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(brdf);
    planner->SetEnvironment(environment);
    ASSERT_TRUE(planner->Update());
    plans.push_back(planner->GetDescription(planner->GetChoice()));
    errors.push_back(planner->GetPredictedError(planner->GetChoice()));
  }
  EXPECT_EQ(plans[0], plans[1]);
  EXPECT_NEAR(errors[0], errors[1], 1e-3 * errors[0]);
}

//------------------------------------------------------------------------------
// An abort, values that are no numbers, and a task without candidates.
TEST(PlanSample, StopsAndTakesAnything)
{
  const PlanPairs all = DrawMany();
  const auto dark = NewRadiance(all.Normals, 0.0, 0.0);
  const auto broken = NewRadiance(all.Normals, 1.0, 1.0);
  broken->SetComponent(3, 0, std::nan(""));
  broken->SetComponent(4, 1, HUGE_VAL);
  const PlanPairs chosen = ChoosePairs(all, dark, broken, 512);
  EXPECT_NEAR(chosen.Normals->GetNumberOfTuples(), 512, 1);
  for (const double weight : chosen.Weights)
  {
    EXPECT_TRUE(std::isfinite(weight));
  }
  measuredbrdf::PlanTask task;
  std::vector<measuredbrdf::PlanCandidate> none;
  PlanPairs pairs = all;
  task.IsAborted = []() { return true; };
  EXPECT_FALSE(measuredbrdf::SamplePairs(task, none, pairs));
  EXPECT_EQ(pairs.Normals->GetNumberOfTuples(), Many);
  task.IsAborted = []() { return false; };
  ASSERT_TRUE(measuredbrdf::SamplePairs(task, none, pairs));
  EXPECT_NEAR(pairs.Normals->GetNumberOfTuples(), measuredbrdf::PairsToCompare, 1);
}
