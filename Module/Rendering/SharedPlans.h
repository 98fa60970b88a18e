// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Plans of a material under an environment, made once and shared by all mappers that hold them.
 * Private to the rendering room.
 */

#ifndef SharedPlans_h
#define SharedPlans_h

#include "vtkSmartPointer.h"

class vtkBRDF;
class vtkEnvironment;
class vtkRadiancePlanner;

namespace measuredbrdf
{
/// The plan, with an integrator to take from it; null where there is none.
vtkSmartPointer<vtkRadiancePlanner> FindPlan(
  vtkBRDF* brdf, vtkEnvironment* environment, double tolerance);
} // namespace measuredbrdf

#endif
