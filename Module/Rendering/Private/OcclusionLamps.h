// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Shader text and uniforms of lamps that a table holds in part (LampWindow), beside
 * OcclusionShader. Private to the rendering room.
 */

#ifndef OcclusionLamps_h
#define OcclusionLamps_h

#include <cstddef>
#include <string>

class vtkShaderProgram;

namespace measuredbrdf
{
struct OcclusionLight;

/// Text of the vertex shader for member m, after the lamps' margins: what the table holds of lamps
/// is hidden by these, not by what is hidden of the rest. out: the outputs' ending; lamps: their
/// number; panels: whether there is MakePanelCode's text before.
std::string MakeTableLampCode(
  const std::string& m, const std::string& out, std::size_t lamps, bool panels);

std::string DeclareTableLamps(const std::string& m);

void SetTableLamps(
  vtkShaderProgram* program, const std::string& number, const OcclusionLight& light);
} // namespace measuredbrdf

#endif
