// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Random numbers and environments, the same on every machine.
 */

#ifndef RandomLight_h
#define RandomLight_h

#include "vtkEnvironment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
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

#endif
