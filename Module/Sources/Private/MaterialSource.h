// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the sources of a material's data have in common.
 */

#ifndef MaterialSource_h
#define MaterialSource_h

#include "HalfVector.h"
#include "SRGB.h"

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/type_ptr.hpp>
#include <glm/gtx/rotate_vector.hpp>

#include <algorithm>

namespace measuredbrdf
{
inline vtkMTimeType GetLatestTime(vtkMTimeType time, vtkBRDF* brdf)
{
  return brdf ? std::max(time, brdf->GetMTime()) : time;
}

template <typename Array>
vtkSmartPointer<Array> NewArray(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/**
 * f at the angles of Rusinkiewicz 1998, in degrees, with phi_h, which counts for anisotropic
 * materials. Returns whether i and o are above the horizon; f is 0 where one is not.
 */
inline bool EvaluateHalfDifference(
  vtkBRDF* brdf, double thetaH, double thetaD, double phiD, double phiH, double f[3])
{
  glm::dvec3 i, o;
  FromHalfDifference({ ToRadians(thetaH), ToRadians(thetaD), ToRadians(phiD) }, i, o);
  i = glm::rotateZ(i, ToRadians(phiH));
  o = glm::rotateZ(o, ToRadians(phiH));
  brdf->Evaluate(glm::value_ptr(i), glm::value_ptr(o), f);
  // Angles of 90 degrees leave a rounding error above the horizon.
  if (i.z > 1e-9 && o.z > 1e-9)
  {
    return true;
  }
  f[0] = f[1] = f[2] = 0.0;
  return false;
}
} // namespace measuredbrdf

#endif
