// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An environment as a few directional lights, for passes that let these cast shadows, and a rest
 * that casts none.
 */

#ifndef StrongLights_h
#define StrongLights_h

#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

struct StrongLights
{
  struct Light
  {
    glm::dvec3 Direction;
    glm::dvec3 Irradiance; // on a surface that faces it
  };
  std::vector<Light> Lights;
  vtkSmartPointer<vtkEnvironment> Rest;
};

namespace stronglights
{
constexpr double ConeDegrees = 10.0;
constexpr int Blocks = 90; // of two degrees, from pole to pole

struct Texel
{
  glm::dvec3 Direction;
  glm::dvec3 Light; // radiance times solid angle
  std::size_t Block;
};

inline std::vector<Texel> ListTexels(vtkEnvironment* environment)
{
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  std::vector<Texel> texels;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      Texel texel;
      environment->GetTexelDirection(x, y, &texel.Direction.x);
      environment->GetPixel(x, y, &texel.Light.x);
      texel.Light *= environment->GetTexelSolidAngle(y);
      texel.Block =
        static_cast<std::size_t>(y * Blocks / height * 2 * Blocks + x * 2 * Blocks / width);
      texels.push_back(texel);
    }
  }
  return texels;
}

// Of the blocks' middles, the axis of the cone that holds most of these blocks' light.
inline glm::dvec3 FindAxis(const std::vector<Texel>& texels)
{
  std::vector<glm::dvec3> axes(2 * Blocks * Blocks);
  std::vector<double> light(axes.size(), 0.0);
  for (std::size_t k = 0; k < axes.size(); ++k)
  {
    vtkEnvironment::GetDirection((static_cast<double>(k % (2 * Blocks)) + 0.5) / (2 * Blocks),
      (static_cast<double>(k / (2 * Blocks)) + 0.5) / Blocks, &axes[k].x);
  }
  for (const Texel& texel : texels)
  {
    light[texel.Block] += vtkEnvironment::GetLuminance(&texel.Light.x);
  }
  const double cosine = std::cos(glm::radians(ConeDegrees));
  const std::size_t rows = static_cast<std::size_t>(ConeDegrees / 180.0 * Blocks) + 1;
  double most = -1.0;
  glm::dvec3 best(0.0, 1.0, 0.0);
  for (std::size_t k = 0; k < axes.size(); ++k)
  {
    const std::size_t row = k / (2 * Blocks);
    const std::size_t first = row > rows ? row - rows : 0;
    const std::size_t last = std::min<std::size_t>(row + rows + 1, Blocks);
    double sum = 0.0;
    for (std::size_t j = first * 2 * Blocks; j < last * 2 * Blocks; ++j)
    {
      sum += glm::dot(axes[j], axes[k]) >= cosine ? light[j] : 0.0;
    }
    if (sum > most)
    {
      most = sum;
      best = axes[k];
    }
  }
  return best;
}

/// The count cones of 10 degrees about a direction that hold the most light, one after the other.
inline StrongLights TakeStrongest(vtkEnvironment* environment, int count)
{
  StrongLights found;
  std::vector<Texel> texels = ListTexels(environment);
  std::vector<float> pixels = environment->GetPixels();
  for (int k = 0; k < count; ++k)
  {
    const glm::dvec3 axis = FindAxis(texels);
    StrongLights::Light light = { axis, glm::dvec3(0.0) };
    glm::dvec3 mean(0.0);
    for (std::size_t t = 0; t < texels.size(); ++t)
    {
      Texel& texel = texels[t];
      if (glm::dot(texel.Direction, axis) >= std::cos(glm::radians(ConeDegrees)))
      {
        light.Irradiance += texel.Light;
        mean += vtkEnvironment::GetLuminance(&texel.Light.x) * texel.Direction;
        texel.Light = glm::dvec3(0.0);
        std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(3 * t), 3, 0.0f);
      }
    }
    light.Direction = glm::length(mean) > 0.0 ? glm::normalize(mean) : axis;
    found.Lights.push_back(light);
  }
  found.Rest = vtkSmartPointer<vtkEnvironment>::New();
  found.Rest->SetPixels(environment->GetWidth(), environment->GetHeight(), pixels);
  return found;
}

/// All light, by median cut (Debevec 2005); count: a power of two.
inline StrongLights TakeAll(vtkEnvironment* environment, int count)
{
  StrongLights found;
  vtkNew<vtkMedianCutLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  generator->Generate(environment, count, lights);
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    StrongLights::Light light;
    lights->GetDirection(k, &light.Direction.x);
    lights->GetIrradiance(k, &light.Irradiance.x);
    found.Lights.push_back(light);
  }
  found.Rest = vtkSmartPointer<vtkEnvironment>::New();
  found.Rest->SetPixels(2, 1, std::vector<float>(6, 0.0f));
  return found;
}
}

#endif
