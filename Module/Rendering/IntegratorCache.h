// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Integrators of a material under an environment, prepared once and shared by all mappers that hold
 * them. Private to the rendering room.
 */

#ifndef IntegratorCache_h
#define IntegratorCache_h

#include "vtkSmartPointer.h"

class vtkBRDF;
class vtkEnvironment;
class vtkTableRadianceIntegrator;

namespace measuredbrdf
{
/// A table of the given size; null where it cannot be made.
vtkSmartPointer<vtkTableRadianceIntegrator> FindTable(
  vtkBRDF* brdf, vtkEnvironment* environment, int rows, int viewAngles, int azimuths);
} // namespace measuredbrdf

#endif
