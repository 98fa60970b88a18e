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

class vtkEnvironment;
class vtkLightSet;
class vtkTexture;
class vtkVarianceLightSetGenerator;

namespace measuredbrdf
{
/// The texture's lat-long image or six cube faces as an environment; null where it has none (no
/// input, faces that are missing, not square or of different sizes).
vtkSmartPointer<vtkEnvironment> FindEnvironment(vtkTexture* texture);

/// The light set that the mapper's settings ask for; null where it cannot be made. The generator is
/// used where a set by variance is not there yet.
vtkSmartPointer<vtkLightSet> FindLightSet(vtkEnvironment* environment, int method, int count,
  unsigned int seed, vtkVarianceLightSetGenerator* variance);

/// Release the environments and light sets that nobody holds any more.
void SweepLights();
} // namespace measuredbrdf

#endif
