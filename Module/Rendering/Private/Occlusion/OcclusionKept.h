// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What is kept of each point while its light rests, as vertex attributes: hidden light, panels'
 * hidden shares, lamps' margins. Text of the shader that makes it, beside OcclusionShader, and what
 * it depends on. Private to the rendering room.
 */

#ifndef OcclusionKept_h
#define OcclusionKept_h

#include "OcclusionLayout.h"
#include "OcclusionMember.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// Names of the attributes, of four floats each, and of the outputs that make them.
std::vector<std::string> GetKeptNames(const OcclusionLights& lights, const OcclusionLayout& layout);

/// Attributes that hold codes or what is kept.
std::size_t CountKeptAttributes(const OcclusionLights& lights, const OcclusionLayout& layout);

/// The vertex shader that makes them of a point's code.
std::string MakeKeptShader(const OcclusionLights& lights, const OcclusionLayout& layout);

/// In the shader that draws: variables and varyings out of the attributes.
std::string MakeKeptReading(const OcclusionMember& member);

/// All numbers that they depend on, but for the codes: what is kept under the same ones is good.
std::vector<double> GetKeptInputs(const OcclusionLights& lights, const OcclusionLayout& layout,
  const std::vector<glm::dmat3>& toEnvironment);
} // namespace measuredbrdf

#endif
