// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Environments of textures, made once and shared by all mappers that hold them, and their axes.
 */

#ifndef TextureEnvironment_h
#define TextureEnvironment_h

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <string>

class vtkEnvironment;
class vtkRenderer;

namespace measuredbrdf
{
/// The lat-long image or the six cube faces of the renderer's environment texture as an
/// environment; null where it has none (no input, faces that are missing, not square or of
/// different sizes), and why. Values are sRGB-encoded where VTK's physically based rendering takes
/// them so. problem: with an environment that is new, what to warn of, or "".
vtkSmartPointer<vtkEnvironment> FindEnvironment(vtkRenderer* renderer, std::string& problem);

/// Turns directions of the world into the renderer's environment, whose axes are right, up and
/// right x up as in VTK's envMatrix, and on into the environment's own axes (null: no further).
glm::dmat3 GetWorldToEnvironment(vtkRenderer* renderer, vtkEnvironment* environment);

/// Release what no mapper holds any more.
void SweepEnvironments();
} // namespace measuredbrdf

#endif
