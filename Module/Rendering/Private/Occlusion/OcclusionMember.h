// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Text of the vertex shader for one material, from one side of a surface, beside OcclusionShader:
 * what rests while the light does, and what depends on the view. Private to the rendering room.
 */

#ifndef OcclusionMember_h
#define OcclusionMember_h

#include "OcclusionLayout.h"

#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
struct OcclusionMember
{
  /// side: 0, the one that codes of one side are about, or 1.
  OcclusionMember(const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side,
    std::size_t member);

  /// What one side of the surface shows; the other one's names end in "Back".
  static const char* GetSideName(std::size_t side);
  /// How many lamps are tested, and whether what is hidden reflects: varyings are few.
  static std::size_t CountLamps(const OcclusionLights& lights, bool twoSided, std::size_t member);
  static bool Bounces(
    const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t member);

  const OcclusionLight* Light;
  std::size_t Member;
  std::string Side;   // its name
  std::string Number; // of names of the member
  std::string Out;    // the outputs' ending
  std::size_t Lamps;
  bool IsBouncing;

  /// What hands a value to the fragment shader: a type, and a name to which stages add VSOutput.
  struct Varying
  {
    std::string Type;
    std::string Name;
  };
  std::vector<Varying> GetVaryings() const;

  /// Varyings of a point that hides nothing. declare: as variables of the shader.
  std::string MakeOpenCode(bool declare) const;

  ///@{
  /// In turns: the hidden light without panels; where a point hides something at all, how it
  /// differs from the rest, the lobe, panels, lamps.
  std::string MakeLightCode() const;
  std::string MakeContrastCode() const;
  std::string MakeLobeCode() const;
  std::string MakeLampCode() const;
  ///@}
  /// What is interpolated between points, after panels.
  std::string MakeOddsCode() const;

  /// Variables for what rests, of a point that hides nothing.
  std::string DeclareResting() const;

  bool HasPanels() const { return !this->Light->Panels.empty(); }
  bool HasLobe() const { return this->Light->HasLobe; }
  /// Whether a table holds a part of what the lobe shows of tested lamps.
  bool HasTableLamps() const
  {
    return this->HasLobe() && this->Lamps > 0 && !this->Light->LampLight.empty();
  }
  /// Component k of lamps' varyings.
  std::string GetLamp(std::size_t k) const;
};

std::vector<OcclusionMember> GetMembers(
  const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side);

///@{
/// What all materials have in common: attributes, uniforms and functions; a code's normal, and so
/// many of its bytes; what follows from them, and what from the view.
std::string DeclareCodes(const OcclusionLights& lights, const OcclusionLayout& layout);
std::string UnpackNormal(std::size_t side);
std::string UnpackCode(std::size_t side, int bytes);
std::string MakeRestingCommonCode();
std::string MakeViewCommonCode();
///@}
} // namespace measuredbrdf

#endif
