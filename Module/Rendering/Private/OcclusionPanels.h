// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Shader text and uniforms of the map's bright panels, beside OcclusionShader. Private to the
 * rendering room.
 */

#ifndef OcclusionPanels_h
#define OcclusionPanels_h

#include "EnvironmentPanels.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

class vtkShaderProgram;

namespace measuredbrdf
{
/// Text of the vertex shader for member m, after the rest of the light: each panel on its own. out:
/// the outputs' ending; panels: their number.
std::string MakePanelCode(const std::string& m, const std::string& out, std::size_t panels);

std::string DeclarePanels(const std::string& m, std::size_t panels);

/// toEnvironment: from the model's axes.
void SetPanels(vtkShaderProgram* program, const std::string& number,
  const std::vector<EnvironmentPanels::Panel>& panels, const glm::dmat3& toEnvironment);
} // namespace measuredbrdf

#endif
