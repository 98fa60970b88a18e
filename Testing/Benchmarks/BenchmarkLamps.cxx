// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What the parts of a lamp's picture cost: one at a time is exact. Of 2000 pairs that are drawn
// about the lamps and weighted to be even, relative L1 in percent of all radiance. The figures of
// docs/methods/lamps.md.
//
// usage: BenchmarkLamps MATERIAL ENVIRONMENT [DEGREES OF A LAMP]
#include "BenchmarkCase.h"
#include "EnvironmentPrecomputation.h"
#include "HalfVector.h" // for Pi
#include "Lamps.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "vtkSMPTools.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

using namespace measuredbrdf;

namespace
{
constexpr int NumberOfPairs = 2000;
constexpr int RestPairs = 500;
constexpr int PointsOfTexel = 12; // along each axis
constexpr int PointsOfNormal = 12;
constexpr double EvenShare = 0.3;                                               // of pairs
constexpr double Widths[] = { ToRadians(0.6), ToRadians(2.0), ToRadians(8.0) }; // of the others

using Parts = std::vector<ExtractedEmitters::Part>;

struct Pair
{
  glm::dvec3 Normal, View;
  double Weight;
};

// Mirror directions are even over the sphere where views and the points that they show are. Some
// are drawn from von Mises-Fisher distributions about the lamps.
std::vector<Pair> DrawPairs(const std::vector<ExtractedEmitters::Light>& lamps)
{
  std::vector<Pair> pairs;
  const double share = (1.0 - EvenShare) / (3.0 * static_cast<double>(lamps.size()));
  for (std::uint32_t n = 1; n <= NumberOfPairs; ++n)
  {
    const glm::dvec3 view =
      ToDirection(1.0 - 2.0 * RadicalInverse(n, 2), 2.0 * Pi * RadicalInverse(n, 3));
    const double u = RadicalInverse(n, 5);
    const double turn = 2.0 * Pi * RadicalInverse(n, 7);
    const double choice = (RadicalInverse(n, 11) - EvenShare) / share;
    glm::dvec3 mirror = ToDirection(1.0 - 2.0 * u, turn);
    if (choice >= 0.0)
    {
      const std::size_t k = std::min(static_cast<std::size_t>(choice), 3 * lamps.size() - 1);
      const double width = Widths[k % 3];
      const double kappa = 1.0 / (width * width);
      const double cosine = 1.0 + std::log(u + (1.0 - u) * std::exp(-2.0 * kappa)) / kappa;
      mirror = FrameAbout(lamps[k / 3].Direction) * ToDirection(cosine, turn);
    }
    double density = EvenShare / (4.0 * Pi);
    for (const ExtractedEmitters::Light& lamp : lamps)
    {
      for (const double width : Widths)
      {
        const double kappa = 1.0 / (width * width);
        density += share * kappa / (2.0 * Pi * (1.0 - std::exp(-2.0 * kappa))) *
                   std::exp(kappa * (glm::dot(mirror, lamp.Direction) - 1.0));
      }
    }
    pairs.push_back({ glm::normalize(view + mirror), view, 1.0 / (4.0 * Pi * density) });
  }
  return pairs;
}

std::vector<glm::dvec3> Sum(const std::vector<Pair>& pairs, vtkBRDF* brdf, const Parts& parts)
{
  std::vector<glm::dvec3> sums(pairs.size(), glm::dvec3(0.0));
  vtkSMPTools::For(0, static_cast<vtkIdType>(pairs.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (std::size_t k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      {
        const Frame frame = FrameAbout(pairs[k].Normal);
        const glm::dvec3 view = LiftView(ToLocal(frame, pairs[k].View));
        for (const ExtractedEmitters::Part& part : parts)
        {
          const glm::dvec3 light = ToLocal(frame, part.Direction);
          glm::dvec3 f(0.0);
          brdf->Evaluate(&light.x, &view.x, &f.x);
          sums[k] += f * part.Irradiance * std::max(light.z, 0.0);
        }
      }
    });
  return sums;
}

// What the texels show between their neighbors' centers, as points.
Parts GetAreas(vtkEnvironment* map, const TexelChanges& rest, Parts& centers)
{
  Parts areas;
  const int width = map->GetWidth();
  for (const TexelChanges::Texel& texel : rest.Texels)
  {
    const int x = static_cast<int>(texel.Index) % width;
    const int y = static_cast<int>(texel.Index) / width;
    const auto direct = [&](int column, int row)
    {
      glm::dvec3 direction;
      map->GetTexelDirection((column + width) % width, row, &direction.x);
      return direction;
    };
    const float* rgb = &map->GetPixels()[3 * texel.Index];
    const glm::dvec3 radiance = glm::dvec3(rgb[0], rgb[1], rgb[2]) - glm::dvec3(texel.Radiance);
    centers.push_back({ direct(x, y), radiance * map->GetTexelSolidAngle(y), 0.0 });
    for (int k = 0; k < PointsOfTexel * PointsOfTexel; ++k)
    {
      const double u = (2.0 * (k % PointsOfTexel) + 1.0) / PointsOfTexel - 1.0;
      const double v = (2.0 * (k / PointsOfTexel) + 1.0) / PointsOfTexel - 1.0;
      const int column = x + (u > 0.0 ? 1 : -1);
      const int row = y + (v > 0.0 ? 1 : -1);
      const glm::dvec3 direction =
        glm::normalize(glm::mix(glm::mix(direct(x, y), direct(column, y), std::abs(u)),
          glm::mix(direct(x, row), direct(column, row), std::abs(u)), std::abs(v)));
      const double weight =
        (1.0 - std::abs(u)) * (1.0 - std::abs(v)) * 4.0 / (PointsOfTexel * PointsOfTexel);
      areas.push_back({ direction, weight * centers.back().Irradiance, 0.0 });
    }
  }
  return areas;
}

// Normal distributions of one variance, as points.
Parts GetNormals(const Parts& parts, double spread)
{
  Parts normals;
  for (const ExtractedEmitters::Part& part : parts)
  {
    const Frame frame = FrameAbout(part.Direction);
    const std::size_t first = normals.size();
    double sum = 0.0;
    for (int k = 0; k < PointsOfNormal * PointsOfNormal; ++k)
    {
      const double x = 3.0 * ((2.0 * (k % PointsOfNormal) + 1.0) / PointsOfNormal - 1.0);
      const double y = 3.0 * ((2.0 * (k / PointsOfNormal) + 1.0) / PointsOfNormal - 1.0);
      const double weight = std::exp(-0.5 * (x * x + y * y));
      const glm::dvec3 away = std::sqrt(spread) * glm::dvec3(x, y, 0.0);
      normals.push_back(
        { glm::normalize(part.Direction + frame * away), weight * part.Irradiance, 0.0 });
      sum += weight;
    }
    for (std::size_t k = first; k < normals.size(); ++k)
    {
      normals[k].Irradiance /= sum;
    }
  }
  return normals;
}

// Mean radiance of what the lamps leave.
double GetRestMean(vtkBRDF* brdf, vtkEnvironment* map, const TexelChanges& changes)
{
  vtkNew<vtkEnvironment> rest;
  std::vector<float> pixels = map->GetPixels();
  for (const TexelChanges::Texel& texel : changes.Texels)
  {
    std::copy_n(&texel.Radiance.x, 3, &pixels[3 * texel.Index]);
  }
  rest->SetPixels(map->GetWidth(), map->GetHeight(), pixels);
  vtkNew<vtkDoubleArray> normals, views, radiance;
  AddEverywherePairs(RestPairs, normals, views);
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(brdf);
  reference->SetEnvironment(rest);
  reference->Integrate(normals, views, radiance);
  double sum = 0.0;
  for (vtkIdType k = 0; k < radiance->GetNumberOfValues(); ++k)
  {
    sum += radiance->GetValue(k) / (3.0 * RestPairs);
  }
  return sum;
}
}

int main(int argc, char** argv)
{
  const auto brdf = argc > 2 ? BenchmarkCase::FindBRDF(argv[1]) : nullptr;
  const auto environment = argc > 2 ? BenchmarkCase::FindEnvironment(argv[2]) : nullptr;
  if (!brdf || !environment)
  {
    std::fprintf(stderr, "usage: BenchmarkLamps MATERIAL ENVIRONMENT [DEGREES OF A LAMP]\n");
    return 1;
  }
  brdf->Prepare();
  const auto lamps = environment->GetParts().GetLamps(
    environment, ToRadians(argc > 3 ? std::atof(argv[3]) : 0.6), 16, []() { return true; });
  if (lamps->Lights.empty())
  {
    std::fprintf(stderr, "There are no lamps.\n");
    return 1;
  }
  vtkEnvironment* map = environment->GetSubdivided();
  Parts centers;
  const Parts areas = GetAreas(map, *lamps->Rest, centers);
  const Parts points(lamps->Lights.begin(), lamps->Lights.end());
  Parts all;
  for (const ExtractedEmitters::Light& lamp : lamps->Lights)
  {
    all.insert(all.end(), lamp.Parts.begin(), lamp.Parts.end());
  }
  const std::vector<Pair> pairs = DrawPairs(lamps->Lights);
  const auto exact = Sum(pairs, brdf, areas);
  double mean = GetRestMean(brdf, map, *lamps->Rest);
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    mean += pairs[k].Weight * (exact[k].x + exact[k].y + exact[k].z) / (3.0 * NumberOfPairs);
  }
  const auto report = [&](const char* name, vtkBRDF* form, const Parts& lights)
  {
    form->Prepare();
    const auto sums = Sum(pairs, form, lights);
    double difference = 0.0;
    for (std::size_t k = 0; k < pairs.size(); ++k)
    {
      const glm::dvec3 away = glm::abs(sums[k] - exact[k]);
      difference += pairs[k].Weight * (away.x + away.y + away.z) / (3.0 * NumberOfPairs);
    }
    std::printf("%-50s %.2f %%\n", name, 100.0 * difference / mean);
  };
  std::printf("%zu lamps of %.3f degrees, %zu parts of %.3f\n", points.size(),
    ToDegrees(std::sqrt(lamps->Spread)), all.size(), ToDegrees(std::sqrt(lamps->SpreadOfParts)));
  report("points, the form for shaders", brdf->GetRenderable(), points);
  report("points, f itself", brdf, points);
  report("centers of texels, f itself", brdf, centers);
  report("light between texels, the form for shaders", brdf->GetRenderable(), areas);
  report("normal distributions, f itself", brdf, GetNormals(points, lamps->Spread));
  report("normal distributions, the table of means", LampBRDF::Make(brdf, lamps->Spread), points);
  report("parts, the table of means", LampBRDF::Make(brdf, lamps->SpreadOfParts), all);
  return 0;
}
