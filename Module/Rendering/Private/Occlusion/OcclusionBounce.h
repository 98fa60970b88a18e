// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Shading with what comes back from hidden parts of the sky (BouncedLight.h), beside
 * OcclusionShader: what it needs of a material and its light, and its shader text. Private to the
 * rendering room.
 */

#ifndef OcclusionBounce_h
#define OcclusionBounce_h

#include "SkyHarmonics.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

class vtkShaderProgram;

namespace measuredbrdf
{
/// All that hides is taken to be of the material itself, and to reflect as a Lambert surface with
/// its albedo does.
class OcclusionBounce
{
public:
  static constexpr std::size_t Views = 16; // polar angles of the view, as of OcclusionLobes

  /// lambert: the material's Lambert part at each view, in 1/sr; lobe: the directional albedo of
  /// the rest; light: the whole of it, lamps included, in the environment's frame.
  OcclusionBounce(const std::vector<glm::dvec3>& lambert, const std::vector<glm::dvec3>& lobe,
    const sky::Colors& light);

  /// Hemispherical albedo of the material, at most 1.
  const glm::dvec3& GetAlbedo() const { return this->Albedo; }

  const sky::Colors& GetLight() const { return this->Light; }

  /// What a point reflects of irradiance that comes back: C++ twin of the shader. lambert, lobe: of
  /// the view; share: hidden share of the lobe; hidden: of a uniform sky.
  static glm::dvec3 GetRadiance(const glm::dvec3& irradiance, const glm::dvec3& lambert,
    const glm::dvec3& lobe, double share, double hidden);

  ///@{
  /// Text of the vertex shader: for all members; for each. side: "" or "Back"; share: the hidden
  /// share of the lobe.
  static std::string Declare(bool twoSided);
  static std::string DeclareMember(std::size_t member);
  static std::string MakeMemberCode(
    std::size_t member, const std::string& side, const std::string& share);
  ///@}

  /// toEnvironment: from the model's axes.
  void SetUniforms(
    vtkShaderProgram* program, std::size_t member, const glm::dmat3& toEnvironment) const;

private:
  std::vector<glm::dvec3> Lambert;
  std::vector<glm::dvec3> Lobe;
  glm::dvec3 Albedo;
  sky::Colors Light;
};
} // namespace measuredbrdf

#endif
