// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The same light in another unit.
 */

#ifndef ScaledLight_h
#define ScaledLight_h

#include "vtkEnvironment.h"
#include "vtkSmartPointer.h"

#include <utility>
#include <vector>

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
