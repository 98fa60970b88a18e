// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * For what shaders with hidden skies are made. Private to the rendering room.
 */

#ifndef OcclusionLayout_h
#define OcclusionLayout_h

#include "OcclusionLight.h"

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// More materials, mixed in one shader, would need too many varyings.
constexpr std::size_t MaximumOccludedMembers = 4;

/// For each material of a shader; null: it is not occluded.
using OcclusionLights = std::vector<const OcclusionLight*>;

/// Which attributes the buffers have.
struct OcclusionLayout
{
  bool TwoSided = false;
  bool Bounced = false; // what comes back from what is hidden
  bool Kept = false;    // what rests while the light does (OcclusionKept.h)
};

/// What varyings are where nothing is hidden: the logarithm of odds, a lamp's margin.
constexpr const char* OpenOdds = "-8.963"; // brdfSkyOdds(0)
constexpr const char* OpenMargin = "3.0";  // HiddenSky::LargestMargin
} // namespace measuredbrdf

#endif
