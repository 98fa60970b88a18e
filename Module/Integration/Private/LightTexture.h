// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Lights as a shader's input.
 */

#ifndef LightTexture_h
#define LightTexture_h

#include "vtkBRDFShaderInputs.h"

class vtkLightSet;

namespace measuredbrdf
{
/// 1/kappa of a light's own region; 0 for light from the direction itself.
double GetSpread(vtkLightSet* lights, int index);

/// "brdfLights": two texels for each light, direction and 1/kappa, irradiance; at most so many
/// lights in a row.
constexpr int LightsPerRow = 512;
vtkBRDFShaderInputs::Texture MakeLightTexture(vtkLightSet* lights);
} // namespace measuredbrdf

#endif
