// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An environment and the lights that stand for it, as a picture (the thesis's figures 3.6 to 3.8).
 */

#ifndef LightMap_h
#define LightMap_h

#include "Picture.h"

class vtkEnvironment;
class vtkLightSet;

namespace tool
{
/// The tone-mapped map with the lights and, if asked for, their regions; display light. Its height
/// follows from the map's aspect, from 16 to largestHeight pixels.
Picture DrawLightMap(vtkEnvironment* environment, vtkLightSet* lights, bool regions,
  int previewWidth, int largestHeight);
} // namespace tool

#endif
