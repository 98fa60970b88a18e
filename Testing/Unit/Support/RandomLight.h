// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Random numbers and environments, the same on every machine; and the same light in another unit.
 */

#ifndef RandomLight_h
#define RandomLight_h

#include "vtkEnvironment.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

/// In [0,1).
inline double Uniform(std::mt19937& engine) { return engine() * 0x1p-32; }

/// Values over five decades.
inline void SetRandom(vtkEnvironment* environment, int width, int height, unsigned int seed = 1)
{
  std::mt19937 engine(seed);
  std::vector<float> rgb(3 * std::size_t(width) * height);
  for (float& value : rgb)
  {
    value = static_cast<float>(std::exp(12.0 * Uniform(engine) - 8.0));
  }
  ASSERT_TRUE(environment->SetPixels(width, height, rgb));
}

/// What a map's radiance is multiplied by, 7e-9 to 1e8: maps are in cd/m2, in counts or relative to
/// white. Powers of two leave every digit as it is, so that nothing else may change.
constexpr double LightUnits[] = { 0x1p-27, 0x1p27 };

inline vtkSmartPointer<vtkEnvironment> NewScaledLight(vtkEnvironment* environment, double factor)
{
  std::vector<float> pixels = environment->GetPixels();
  for (float& value : pixels)
  {
    value = static_cast<float>(factor * static_cast<double>(value));
  }
  auto scaled = vtkSmartPointer<vtkEnvironment>::New();
  scaled->SetPixels(environment->GetWidth(), environment->GetHeight(), std::move(pixels));
  scaled->SetName(environment->GetName());
  return scaled;
}

#endif
