// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The shader builder: GLSL text and uniforms for shading with what a surface hides from itself. The
 * vertex shader evaluates a point's horizon code (HorizonCode.h) for each material that meets
 * there; the fragment shader interpolates what it found. Functions whose text is fixed are in
 * shaders/vtkBRDFHiddenSky.glsl and vtkBRDFBouncedLight.glsl.
 */

#ifndef OcclusionShader_h
#define OcclusionShader_h

#include "OcclusionArrays.h"
#include "OcclusionLight.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

class vtkActor;
class vtkEnvironment;
class vtkRenderer;
class vtkShaderProgram;

namespace measuredbrdf
{
/// More materials, mixed in one shader, would need too many varyings.
constexpr std::size_t MaximumOccludedMembers = 4;

/// For each material of a shader; null: it is not occluded.
using OcclusionLights = std::vector<const OcclusionLight*>;

/// Which vertex attributes there are.
struct OcclusionLayout
{
  bool TwoSided = false;
  bool Bounced = false; // what comes back from what is hidden
};

/// Same key, same text. "" without any.
std::string GetOcclusionKey(const OcclusionLights& lights, const OcclusionLayout& layout);

/// Text for each stage; code of the fragment shader goes before anything is integrated.
struct OcclusionText
{
  std::string VertexDeclarations;
  std::string VertexCode;
  std::string GeometryDeclarations;
  std::string GeometryCode;
  std::string FragmentDeclarations;
  std::string FragmentCode;
};
OcclusionText MakeOcclusionText(const OcclusionLights& lights, const OcclusionLayout& layout);

/// Vertex attributes that this text reads, and components of what its stages hand on, in whole
/// vectors of four: not every driver packs them.
struct OcclusionNeeds
{
  std::size_t Attributes = 0;
  std::size_t Varyings = 0;
};
OcclusionNeeds CountOcclusionNeeds(const OcclusionLights& lights, const OcclusionLayout& layout);

/// The macros that the environment's terms of a member use; light null: for no occlusion.
std::string DefineOcclusion(const OcclusionLight* light, std::size_t member);

/// How a surface, the view and environments are turned against each other.
struct OcclusionAxes
{
  OcclusionAxes(
    vtkRenderer* renderer, vtkActor* actor, const std::vector<vtkEnvironment*>& environments);

  glm::dmat3 ToModel; // of directions in view coordinates; it turns, stretches and mirrors
  // From the model's axes, each: the nearest orthogonal matrix, exact for turned, mirrored and
  // evenly scaled actors.
  std::vector<glm::dmat3> ToEnvironment;
};

/// What the buffers hold.
struct OcclusionSides
{
  bool Both = false;
  bool Bounced = false;
  bool IsOtherClosed = true; // one side: whether the other one sees nothing, or all of its sky
  double LeastCosine = 1.0;  // OcclusionArrays'

  /// Null: a surface that sees all of its sky.
  void Add(const OcclusionArrays* arrays)
  {
    this->Both = this->Both || (arrays && arrays->HasBack());
    this->Bounced = this->Bounced || (arrays && arrays->HasBounce());
    this->IsOtherClosed = this->IsOtherClosed && arrays && arrays->IsOtherClosed;
    this->LeastCosine = std::min(this->LeastCosine, arrays ? arrays->LeastCosine : 1.0);
  }
};

/// Uniforms. toModel and toEnvironment: OcclusionAxes'; parallel: the projection.
void SetOcclusionUniforms(vtkShaderProgram* program, const OcclusionLights& lights,
  const OcclusionSides& sides, const glm::dmat3& toModel, bool parallel,
  const std::vector<glm::dmat3>& toEnvironment);
} // namespace measuredbrdf

#endif
