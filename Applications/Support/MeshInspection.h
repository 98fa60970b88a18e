// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What `info` says of a mesh: what it hides of the environment.
 */

#ifndef MeshInspection_h
#define MeshInspection_h

#include <nlohmann/json.hpp>

#include <string>

namespace tool
{
/// Points, triangles, bounds, and the predicted error of leaving occlusion out, for a matte and a
/// glossy material under each built-in map: what `info MESH --json` prints. Throws Error.
nlohmann::ordered_json InspectMesh(const std::string& file);

/// The same for people: what `info MESH` prints.
std::string FormatMeshInspection(const nlohmann::ordered_json& info);
} // namespace tool

#endif
