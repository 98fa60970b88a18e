// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Shader text and uniforms for shading with hidden skies. The vertex shader evaluates a point's
 * code for each material; the fragment shader interpolates. Private to the rendering room.
 */

#ifndef OcclusionShader_h
#define OcclusionShader_h

#include "OcclusionArrays.h"
#include "OcclusionLayout.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

class vtkShaderProgram;

namespace measuredbrdf
{
/// Same key, same text. "" without any.
std::string GetOcclusionKey(const OcclusionLights& lights, const OcclusionLayout& layout);

/// In which direction a value goes through the stages.
struct OcclusionText
{
  std::string VertexDeclarations;
  std::string VertexCode;
  std::string GeometryDeclarations;
  std::string GeometryCode;
  std::string FragmentDeclarations;
  std::string FragmentCode; // before anything is integrated
};
/// Vertex attributes that this text reads, and components of what its stages hand on, in whole
/// vectors of four: not every driver packs them.
struct OcclusionNeeds
{
  std::size_t Attributes = 0;
  std::size_t Varyings = 0;
};
OcclusionNeeds CountOcclusionNeeds(const OcclusionLights& lights, const OcclusionLayout& layout);

OcclusionText MakeOcclusionText(const OcclusionLights& lights, const OcclusionLayout& layout);

/// The macros that the environment's terms of a member use; light null: for no occlusion.
std::string DefineOcclusion(const OcclusionLight* light, std::size_t member);

/// What the buffers hold.
struct OcclusionSides
{
  bool Both = false;
  bool Bounced = false;      // what comes back from what is hidden
  bool IsOtherClosed = true; // one side: whether the other one sees nothing, or all of its sky
  double LeastCosine = 1.0;  // OcclusionArrays'

  void Add(const OcclusionArrays& arrays)
  {
    this->Both = this->Both || arrays.HasBack;
    this->Bounced = this->Bounced || arrays.HasBounce;
    this->IsOtherClosed = this->IsOtherClosed && arrays.IsOtherClosed;
    this->LeastCosine = std::min(this->LeastCosine, arrays.LeastCosine);
  }
};

/// Uniforms. toModel: directions of the view's axes to the model's; parallel: the projection;
/// toEnvironment, of each material: the model's axes to the environment's, orthogonal.
void SetOcclusionUniforms(vtkShaderProgram* program, const OcclusionLights& lights,
  const OcclusionSides& sides, const glm::dmat3& toModel, bool parallel,
  const std::vector<glm::dmat3>& toEnvironment);
} // namespace measuredbrdf

#endif
