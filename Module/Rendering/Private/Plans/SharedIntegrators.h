// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The integrators that mappers draw with where a program has set one.
 */

#ifndef SharedIntegrators_h
#define SharedIntegrators_h

#include "vtkSmartPointer.h"

class vtkBRDF;
class vtkEnvironment;
class vtkRadianceIntegrator;

namespace measuredbrdf
{
/// The program's integrator itself, where it has this material and environment; else a copy that
/// has them, shared by all mappers that ask for the same. The program's object is never changed.
vtkSmartPointer<vtkRadianceIntegrator> FindIntegrator(
  vtkRadianceIntegrator* wanted, vtkBRDF* brdf, vtkEnvironment* environment);

/// For as long as there is no plan, with suns and lamps as lights: a small table, of more rows for
/// mirror-like materials; a small light set for anisotropic ones. quick: for a short
/// time, so that lights see a coarse table of the material. Not prepared yet.
vtkSmartPointer<vtkRadianceIntegrator> FindStandIn(
  vtkBRDF* brdf, vtkEnvironment* environment, bool quick);

/// Release the copies that no mapper holds any more.
void SweepIntegrators();
} // namespace measuredbrdf

#endif
