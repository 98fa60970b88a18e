// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReflectionIntegral.h"

#include "HemisphereIntegral.h"
#include "vtkAngleBasisBRDF.h"

namespace measuredbrdf
{
glm::dvec3 IntegrateReflection(
  vtkBRDF* brdf, const glm::dvec3& given, IntegralOver over, double tolerance)
{
  const bool views = over == IntegralOver::Views;
  if (auto* matrix = vtkAngleBasisBRDF::SafeDownCast(brdf))
  {
    glm::dvec3 sum;
    matrix->SumPatches(&given.x, views, &sum.x);
    return sum;
  }
  return IntegrateBRDF(brdf, given, views, tolerance);
}
} // namespace measuredbrdf
