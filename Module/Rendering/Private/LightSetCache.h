// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Environments of textures and light sets of environments, made once and shared by all mappers
 * that hold them. Private to the rendering room.
 */

#ifndef LightSetCache_h
#define LightSetCache_h

#include "vtkSmartPointer.h"

#include <string>

class vtkBRDF;
class vtkEnvironment;
class vtkLightSet;
class vtkLightSetRadianceIntegrator;
class vtkTexture;
class vtkVarianceLightSetGenerator;

namespace measuredbrdf
{
/// The texture's lat-long image or six cube faces as an environment; null where it has none (no
/// input, faces that are missing, not square or of different sizes), and why. What was refused once
/// is not tried again until it changes.
vtkSmartPointer<vtkEnvironment> FindEnvironment(vtkTexture* texture, std::string& problem);

/// The light set that the mapper's settings ask for; null where it cannot be made. The generator is
/// used where a set by variance is not there yet.
vtkSmartPointer<vtkLightSet> FindLightSet(vtkEnvironment* environment, int method, int count,
  unsigned int seed, vtkVarianceLightSetGenerator* variance);

/// The loop over these lights for this material.
vtkSmartPointer<vtkLightSetRadianceIntegrator> FindLightLoop(
  vtkBRDF* brdf, vtkLightSet* lights, bool softLights);

/// Release what no mapper holds any more.
void SweepLights();
} // namespace measuredbrdf

#endif
