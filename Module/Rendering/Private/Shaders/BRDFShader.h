// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Assembly of the fragment shader from the files in shaders.
 */

#ifndef BRDFShader_h
#define BRDFShader_h

#include "OcclusionLight.h"
#include "vtkBRDFShaderInputs.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
/// How the tangent of an anisotropic material is found.
enum class TangentSource
{
  None, // isotropic
  Data,
  Axis
};

/// One of the materials that a shader mixes.
struct ShaderMember
{
  const vtkBRDFShaderInputs* Material;       // null: it is not asked for
  const vtkBRDFShaderInputs* Environment;    // null: there is none
  int Slot = 0;                              // its weight is brdfWeights[Slot]
  const OcclusionLight* Occlusion = nullptr; // null: nothing is hidden
};

/// The number that stands for INSTANCE in the texts and names of a member's first term; the
/// following terms count on.
std::size_t GetFirstInstance(std::size_t member);

/// What is done with samples whose sub-frames add up (SampleSums).
enum class SumStage
{
  None,   // all samples are evaluated at once
  Others, // what is no sample is written instead of the color
  Add,    // a sub-frame's samples are
  Show
};

/// What integrators' texts read of it: BRDF_SAMPLES and BRDF_SAMPLES_SHARE.
std::string GetSamplesText(SumStage stage);

/// Whether a summand is written instead of the color, and the text that does so in the end.
bool IsOfSum(SumStage stage);
std::string GetSumOutput(SumStage stage);

/// Declarations: shared functions, the materials' terms and brdfEvaluate, their environments' terms
/// and brdfEnvironment. Without a material there is no brdfEvaluate. Several members are mixed by
/// brdfWeights, which are declared before.
std::string GetShaderDeclarations(
  const std::vector<ShaderMember>& members, SumStage stage = SumStage::None);

/// The uniform that turns directions from view coordinates to a member's environment.
std::string GetRotationName(std::size_t member);

/// What the body of a shader depends on.
struct ShaderBody
{
  int Complexity = 0; // VTK's for the scene's lights: 0 none, 1 headlight, 2 directional, 3 any
  int LightCount = 0;
  int SuperfluousLight = -1; // one of several that is left out, by its number
  TangentSource Tangents = TangentSource::None;
  bool HasEdges = false;       // VTK's edgeColor and emix are there
  bool HasEdgeOpacity = false; // and edgeOpacity (VTK 9.3)
  bool EdgesAreTubes = false;  // lit as such
  bool HasBlockColors = false; // VTK's OverridesColor is there (composite data)
  bool HasColors = true;       // scalars may color the surface
  bool HasBadNormals = false;  // some are no directions
  SumStage Stage = SumStage::None;
  std::string Weights; // fills brdfWeights, where materials are mixed
};

/// For //VTK::Light::Impl.
std::string GetShaderBody(const ShaderBody& body);
} // namespace measuredbrdf

#endif
