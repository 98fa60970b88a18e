// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material map as files: a description in JSON, weights as PNG images of 16 bits, materials.
 */

#ifndef MaterialMapFiles_h
#define MaterialMapFiles_h

#include "vtkMaterialMap.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tool
{
/**
 * Write FOLDER/map.json and FOLDER/weights-N.png, three materials in each. materials: what the
 * description says of each of them, "material" being a built-in name or a file, which is relative
 * to the folder. facts: what else the description says. Throws Error.
 */
void WriteMaterialMap(vtkMaterialMap* map, const std::string& folder,
  const nlohmann::ordered_json& materials, const nlohmann::ordered_json& facts);

/// Make a folder where there is none. Throws Error.
void MakeFolder(const std::string& path);
} // namespace tool

#endif
