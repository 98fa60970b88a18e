// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a picture shows between the points that a plan for it is given.

#include "HalfVector.h" // for Pi
#include "PlanPairs.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numeric>
#include <vector>

using measuredbrdf::PlanPairs;
using measuredbrdf::PlanPoints;

namespace
{
constexpr int Side = 24;
constexpr double Step = 4.0 * measuredbrdf::Pi / 180.0;

glm::dvec3 GetNormal(double x, double y) { return glm::normalize(glm::dvec3(x, y, 1.0)); }

// Slopes in rows, seen from one side.
PlanPairs MakeRows()
{
  PlanPairs given = measuredbrdf::MakeEmptyPairs();
  for (int k = 0; k < Side * Side; ++k)
  {
    const glm::dvec3 n = GetNormal(Step * (k % Side) - 0.7, Step * (k / Side) - 0.7);
    given.Normals->InsertNextTuple(&n.x);
    given.Views->InsertNextTuple3(0.0, 0.0, 1.0);
  }
  return given;
}

// In steps from the first row and column.
glm::dvec2 GetPlace(const PlanPairs& pairs, vtkIdType k)
{
  const glm::dvec3 n = glm::make_vec3(pairs.Normals->GetTuple(k));
  return (glm::dvec2(n) / n.z + 0.7) / Step;
}

constexpr double Spot = 0.3; // of a step

// A lamp that is seen in a spot.
std::vector<double> GetLights(const PlanPairs& pairs, const glm::dvec2& lamp)
{
  std::vector<double> lights;
  for (vtkIdType k = 0; k < pairs.Normals->GetNumberOfTuples(); ++k)
  {
    const double away = glm::length(GetPlace(pairs, k) - lamp) / Spot;
    lights.push_back(std::exp(-away * away));
  }
  return lights;
}

void Append(const PlanPairs& from, PlanPairs& to)
{
  for (vtkIdType k = 0; k < from.Normals->GetNumberOfTuples(); ++k)
  {
    to.Normals->InsertNextTuple(from.Normals->GetTuple(k));
    to.Views->InsertNextTuple(from.Views->GetTuple(k));
  }
}
}

//------------------------------------------------------------------------------
// A picture has more pixels than a plan is given: normals 4 degrees apart come within 1.2 of all
// that lie between, a plate stays flat, and a pair without neighbors stays alone. Those at an edge
// are not drawn inside: half of what belongs to them is outside.
TEST(PlanPoints, HaveOthersBetween)
{
  PlanPairs given = MakeRows();
  given.Normals->InsertNextTuple3(0.0, -1.0, 0.0);
  given.Views->InsertNextTuple3(0.0, -1.0, 0.0);
  EXPECT_EQ(PlanPoints(given).DrawAlike(16).Normals->GetNumberOfTuples(), Side * Side + 1);
  constexpr vtkIdType count = 12000;
  const PlanPairs all = PlanPoints(given).DrawAlike(count);
  ASSERT_GE(all.Normals->GetNumberOfTuples(), count);
  ASSERT_EQ(all.Views->GetNumberOfTuples(), all.Normals->GetNumberOfTuples());
  EXPECT_TRUE(all.Weights.empty());
  int alone = 0;
  int outside = 0; // of the first column
  std::vector<glm::dvec3> normals;
  for (vtkIdType k = 0; k < all.Normals->GetNumberOfTuples(); ++k)
  {
    normals.push_back(glm::make_vec3(all.Normals->GetTuple(k)));
    EXPECT_NEAR(glm::length(normals.back()), 1.0, 1e-12);
    const bool isAlone = normals.back().y < -0.99;
    alone += isAlone ? 1 : 0;
    EXPECT_NEAR(all.Views->GetComponent(k, 2), isAlone ? 0.0 : 1.0, 1e-12);
    EXPECT_GT(normals.back().z, isAlone ? -1e-12 : 0.5);
    outside += !isAlone && normals.back().x / normals.back().z < -0.7 ? 1 : 0;
  }
  EXPECT_EQ(alone, static_cast<int>(normals.size()) / (Side * Side + 1));
  const double edge = static_cast<double>(normals.size()) / Side;
  std::printf("%d outside, %.0f belong to the edge\n", outside, edge);
  EXPECT_NEAR(outside / edge, 0.5, 0.15);
  double farthest = 0.0;
  for (int k = 0; k < 400; ++k)
  {
    const glm::dvec3 wanted = GetNormal(-0.5 + 0.05 * (k % 20), -0.5 + 0.05 * (k / 20));
    double least = 10.0;
    for (const glm::dvec3& n : normals)
    {
      least = std::min(least, glm::length(n - wanted));
    }
    farthest = std::max(farthest, least);
  }
  std::printf("at most %.2f degrees away\n", farthest * 180.0 / measuredbrdf::Pi);
  EXPECT_LT(farthest, 1.2 * measuredbrdf::Pi / 180.0);
}

//------------------------------------------------------------------------------
// What all points have around them is spread evenly: no more close to the points than in the middle
// between them, or a lamp that a point happens to see would count for too much.
TEST(PlanPoints, AreNoCentersOfCrowds)
{
  PlanPairs all = PlanPoints(MakeRows()).DrawAlike(100000);
  int close = 0;
  int inside = 0;
  for (vtkIdType k = Side * Side; k < all.Normals->GetNumberOfTuples(); ++k) // not the points
  {
    const glm::dvec2 place = GetPlace(all, k);
    if (std::min(place.x, place.y) > 3.5 && std::max(place.x, place.y) < Side - 4.5)
    {
      const glm::dvec2 away = glm::abs(place - glm::round(place));
      close += std::max(away.x, away.y) < 0.15 ? 1 : 0;
      ++inside;
    }
  }
  const double share = static_cast<double>(close) / inside;
  std::printf("%.4f of %d are close\n", share, inside);
  EXPECT_NEAR(share, 0.09, 0.006);
}

//------------------------------------------------------------------------------
// More are drawn where a lamp is, which few of the points see, and their weights make up for it:
// its light's error is less than a third of what it is without, and its mean over many lamps is
// within 13 %.
TEST(PlanPoints, CrowdWhereItVaries)
{
  const double expected = measuredbrdf::Pi * Spot * Spot;
  constexpr int more = 500;
  constexpr int lamps = 120;
  double sum = 0.0;
  double squares = 0.0;
  double before = 0.0; // squares of what pairs around all alike say
  for (int lamp = 0; lamp < lamps; ++lamp)
  {
    const glm::dvec2 place(8.0 + 0.0437 * lamp, 9.0 + 0.0713 * lamp);
    PlanPoints points(MakeRows());
    PlanPairs all = points.DrawAlike(3 * Side * Side);
    std::vector<double> lights = GetLights(all, place);
    before += std::pow(std::accumulate(lights.begin(), lights.end(), 0.0) / 3.0 - expected, 2.0);
    const std::vector<double> even(lights.size(), 0.3); // whose squares are rounded
    EXPECT_EQ(points.DrawWhereItVaries(even, even, more).Normals->GetNumberOfTuples(), 0);
    for (int round = 0; round < 2; ++round)
    {
      const PlanPairs drawn =
        points.DrawWhereItVaries(std::vector<double>(lights.size(), 0.3), lights, more);
      EXPECT_NEAR(drawn.Normals->GetNumberOfTuples(), more, 1);
      int close = 0;
      for (vtkIdType k = 0; k < drawn.Normals->GetNumberOfTuples(); ++k)
      {
        close += glm::length(GetPlace(drawn, k) - place) < 4.0 ? 1 : 0;
      }
      EXPECT_GT(close, 0.8 * more);
      Append(drawn, all);
      lights = GetLights(all, place);
    }
    points.Weigh(all);
    ASSERT_EQ(all.Weights.size(), lights.size());
    ASSERT_EQ(all.Points.size(), lights.size());
    EXPECT_NEAR(std::accumulate(all.Weights.begin(), all.Weights.end(), 0.0), Side * Side, 1e-6);
    EXPECT_LT(*std::max_element(all.Points.begin(), all.Points.end()),
      static_cast<std::size_t>(Side * Side));
    const double light = std::inner_product(lights.begin(), lights.end(), all.Weights.begin(), 0.0);
    sum += light / lamps;
    squares += std::pow(light - expected, 2.0);
  }
  std::printf("light %.4f +- %.4f, expected %.4f; without +- %.4f\n", sum,
    std::sqrt(squares / lamps), expected, std::sqrt(before / lamps));
  EXPECT_NEAR(sum, expected, 0.13 * expected);
  EXPECT_LT(squares, 0.3 * 0.3 * before);
}
