// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Shader text and uniforms of lamps that a table holds in part (LampWindow), beside
 * OcclusionShader. Private to the rendering room.
 */

#ifndef OcclusionLamps_h
#define OcclusionLamps_h

#include <string>

class vtkShaderProgram;

namespace measuredbrdf
{
struct OcclusionLight;
struct OcclusionMember;

/// Text of the vertex shader, after panels and the lamps' margins: what the table holds of lamps is
/// hidden by these, not by what is hidden of the rest.
std::string MakeTableLampCode(const OcclusionMember& member);

/// The uniforms of that text.
void SetTableLamps(
  vtkShaderProgram* program, const std::string& number, const OcclusionLight& light);
} // namespace measuredbrdf

#endif
