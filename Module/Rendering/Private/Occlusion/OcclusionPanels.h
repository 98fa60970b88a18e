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
#include "OcclusionMember.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

class vtkShaderProgram;

namespace measuredbrdf
{
/// What panels' hidden shares are for: the lobe of the shader that draws, or to be kept.
enum class PanelUse
{
  Draw,
  Keep
};

/// Text of the vertex shader, after the rest of the light: each panel on its own.
std::string MakePanelCode(const OcclusionMember& member, PanelUse use);

/// The same where hidden shares and light were kept: only the lobe is left.
std::string MakeKeptPanelCode(const OcclusionMember& member);

/// toEnvironment: from the model's axes.
void SetPanels(vtkShaderProgram* program, const std::string& number,
  const std::vector<EnvironmentPanels::Panel>& panels, const glm::dmat3& toEnvironment);
} // namespace measuredbrdf

#endif
