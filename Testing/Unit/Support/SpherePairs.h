// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * (normal, view) pairs as spheres show them to distant cameras, radiance for them, and small
 * environments that the exact sum is quick for.
 */

#ifndef SpherePairs_h
#define SpherePairs_h

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkRadianceIntegrator.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

/// The sum over the centers of all texels: each is a light.
inline vtkNew<vtkLightSetRadianceIntegrator> NewExactSum(vtkBRDF* brdf, vtkEnvironment* environment)
{
  vtkEnvironment* texels = environment->GetSubdivided();
  vtkNew<vtkLightSet> lights;
  for (int k = 0; k < texels->GetWidth() * texels->GetHeight(); ++k)
  {
    const int row = k / texels->GetWidth();
    glm::dvec3 direction, rgb;
    texels->GetTexelDirection(k % texels->GetWidth(), row, &direction.x);
    texels->GetPixel(k % texels->GetWidth(), row, &rgb.x);
    rgb *= texels->GetTexelSolidAngle(row);
    lights->AddLight(&direction.x, &rgb.x);
  }
  vtkNew<vtkLightSetRadianceIntegrator> exact;
  exact->SetBRDF(brdf);
  exact->SetEnvironment(environment);
  exact->SetLightSet(lights);
  return exact;
}

struct SpherePairs
{
  vtkNew<vtkDoubleArray> Normals;
  vtkNew<vtkDoubleArray> Views;

  SpherePairs()
  {
    this->Normals->SetNumberOfComponents(3);
    this->Views->SetNumberOfComponents(3);
  }

  void Add(const glm::dvec3& n, const glm::dvec3& v)
  {
    this->Normals->InsertNextTuple(&n.x);
    this->Views->InsertNextTuple(&v.x);
  }

  /// Views from everywhere, normals uniform over the sphere's disc, rim excluded.
  void AddRandom(int count, unsigned int seed = 1)
  {
    std::mt19937 engine(seed);
    const auto uniform = [&engine]() { return engine() * 0x1p-32; };
    for (int k = 0; k < count; ++k)
    {
      const double z = 2.0 * uniform() - 1.0;
      const double turn = 6.283185307179586 * uniform();
      const double s = std::sqrt(1.0 - z * z);
      const glm::dvec3 v(s * std::cos(turn), s * std::sin(turn), z);
      const glm::dvec3 a = glm::normalize(
        glm::cross(v, std::abs(v.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0)));
      const double r = 0.995 * std::sqrt(uniform());
      const double phi = 6.283185307179586 * uniform();
      this->Add(
        r * std::cos(phi) * a + r * std::sin(phi) * glm::cross(v, a) + std::sqrt(1.0 - r * r) * v,
        v);
    }
  }

  /// All of them about the origin.
  void AddTurned(const SpherePairs& others, const glm::dmat3& turn)
  {
    for (vtkIdType k = 0; k < others.Normals->GetNumberOfTuples(); ++k)
    {
      glm::dvec3 n, v;
      others.Normals->GetTuple(k, &n.x);
      others.Views->GetTuple(k, &v.x);
      this->Add(turn * n, turn * v);
    }
  }

  std::vector<glm::dvec3> Integrate(vtkRadianceIntegrator* integrator) const
  {
    vtkNew<vtkDoubleArray> radiance;
    std::vector<glm::dvec3> result;
    EXPECT_TRUE(integrator->Integrate(this->Normals, this->Views, radiance));
    for (vtkIdType k = 0; k < radiance->GetNumberOfTuples(); ++k)
    {
      glm::dvec3 rgb;
      radiance->GetTuple(k, &rgb.x);
      EXPECT_TRUE(std::isfinite(rgb.x + rgb.y + rgb.z) && glm::min(rgb, 0.0) == glm::dvec3(0.0));
      result.push_back(rgb);
    }
    return result;
  }

  std::vector<glm::dvec3> IntegrateExactly(vtkBRDF* brdf, vtkEnvironment* environment) const
  {
    return this->Integrate(NewExactSum(brdf, environment));
  }
};

/// Relative L1 over pairs and channels.
inline double GetRelativeError(
  const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& reference)
{
  EXPECT_EQ(a.size(), reference.size());
  glm::dvec3 difference(0.0), sum(0.0);
  for (std::size_t k = 0; k < std::min(a.size(), reference.size()); ++k)
  {
    difference += glm::abs(a[k] - reference[k]);
    sum += reference[k];
  }
  return (difference.x + difference.y + difference.z) / (sum.x + sum.y + sum.z);
}

/// One normal seen at some polar angles, in degrees, under the same radiance from everywhere: the
/// material's albedo times that.
struct FurnacePairs : SpherePairs
{
  FurnacePairs(vtkBRDF* brdf, double value,
    const std::vector<double>& degrees = { 0.0, 17.0, 41.0, 63.0, 78.0, 85.0, 88.0 })
  {
    brdf->Prepare();
    for (const double angle : degrees)
    {
      const double theta = angle * 3.14159265358979323846 / 180.0;
      const glm::dvec3 o(std::sin(theta), 0.0, std::cos(theta));
      this->Add(glm::dvec3(0.0, 0.0, 1.0), o);
      glm::dvec3 albedo;
      brdf->GetDirectionalAlbedo(&o.x, &albedo.x);
      this->Expected.push_back(value * albedo);
    }
  }

  /// The largest error of a channel relative to what is expected, or to 0.05.
  double GetLargestError(vtkRadianceIntegrator* integrator) const
  {
    const std::vector<glm::dvec3> radiance = this->Integrate(integrator);
    glm::dvec3 largest(0.0);
    for (std::size_t k = 0; k < radiance.size(); ++k)
    {
      const glm::dvec3& expected = this->Expected[k];
      largest = glm::max(largest, glm::abs(radiance[k] - expected) / glm::max(expected, 0.05));
    }
    return std::max({ largest.x, largest.y, largest.z });
  }

  std::vector<glm::dvec3> Expected;
};

/// Turning everything with the environment changes nothing; turning the environment alone does.
inline void ExpectTurnsWithItsEnvironment(
  vtkRadianceIntegrator* integrator, const SpherePairs& pairs, double tolerance = 1e-9)
{
  const glm::dvec3 x = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  const glm::dvec3 y = glm::normalize(glm::cross(x, glm::dvec3(0.9, 0.1, 0.4)));
  const glm::dmat3 turn(x, y, glm::cross(x, y));
  const std::vector<glm::dvec3> before = pairs.Integrate(integrator);
  SpherePairs turned;
  turned.AddTurned(pairs, turn);
  // Rows of the inverse: columns of the turn.
  integrator->GetEnvironment()->SetWorldToEnvironment(&turn[0][0]);
  EXPECT_LT(GetRelativeError(turned.Integrate(integrator), before), tolerance);
  EXPECT_GT(GetRelativeError(pairs.Integrate(integrator), before), 1e-2);
}

/// The same light in width x height texels, which divide the environment's.
inline void ShrinkEnvironment(vtkEnvironment* environment, int width, int height)
{
  const int a = environment->GetWidth() / width;
  const int b = environment->GetHeight() / height;
  std::vector<float> rgb;
  for (int texel = 0; texel < width * height; ++texel)
  {
    glm::dvec4 sum(0.0);
    for (int k = 0; k < a * b; ++k)
    {
      const int row = texel / width * b + k / a;
      glm::dvec3 radiance;
      environment->GetPixel(texel % width * a + k % a, row, &radiance.x);
      sum += environment->GetTexelSolidAngle(row) * glm::dvec4(radiance, 1.0);
    }
    const glm::vec3 mean(sum / sum.w);
    rgb.insert(rgb.end(), &mean.x, &mean.x + 3);
  }
  EXPECT_TRUE(environment->SetPixels(width, height, rgb));
}

/// The procedural sky or hall in 128 x 64 texels.
inline vtkNew<vtkEnvironment> NewSmallEnvironment(bool hall)
{
  vtkNew<vtkEnvironment> environment;
  hall ? environment->SetToProceduralHall() : environment->SetToProceduralSky();
  ShrinkEnvironment(environment, 128, 64);
  return environment;
}

inline vtkNew<vtkEnvironment> NewConstantEnvironment(int width, int height, float value)
{
  vtkNew<vtkEnvironment> environment;
  EXPECT_TRUE(environment->SetPixels(
    width, height, std::vector<float>(3 * std::size_t(width) * std::size_t(height), value)));
  return environment;
}

/// The same sky in so many times more texels.
inline vtkNew<vtkEnvironment> NewUpsampled(vtkEnvironment* environment, int across, int up)
{
  const int width = across * environment->GetWidth();
  const int height = up * environment->GetHeight();
  std::vector<float> rgb;
  for (int k = 0; k < width * height; ++k)
  {
    glm::dvec3 direction, radiance;
    vtkEnvironment::GetDirection(
      (k % width + 0.5) / width, (k / width + 0.5) / height, &direction.x);
    environment->GetRadiance(&direction.x, &radiance.x);
    rgb.insert(rgb.end(), &radiance.x, &radiance.x + 3);
  }
  vtkNew<vtkEnvironment> fine;
  EXPECT_TRUE(fine->SetPixels(width, height, rgb));
  double turn[9];
  environment->GetWorldToEnvironment(turn);
  fine->SetWorldToEnvironment(turn);
  return fine;
}

/// Gloss over a matte base.
inline vtkNew<vtkAshikhminShirleyBRDF> NewCoating(double exponent, double stretch = 1.0)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetDiffuse(0.3, 0.2, 0.1);
  brdf->SetExponents(exponent, stretch * exponent);
  return brdf;
}

#endif
