// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Names of the point arrays of a surface's parts, and of the vertex attributes that they become.
 * Private to the rendering room.
 */

#ifndef PartArrays_h
#define PartArrays_h

#include <string>

namespace measuredbrdf
{
namespace partarrays
{
/// Weights in an array: components of a vertex attribute.
constexpr int WeightsPerGroup = 4;

/// The weights of slots from WeightsPerGroup times group on.
inline std::string GetWeights(int group) { return "brdfWeights" + std::to_string(group); }

/// A number of the class of a point.
constexpr const char* Class = "brdfClassOfPoint";

/// The place on a map's scale of values: 0 is its first, 1 its last.
constexpr const char* Value = "brdfValue";

/// Texture coordinates of weights in images.
constexpr const char* Coordinates = "brdfCoordinates";
} // namespace partarrays
} // namespace measuredbrdf

#endif
