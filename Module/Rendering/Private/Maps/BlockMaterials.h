// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which material each block of a composite data set has.
 */

#ifndef BlockMaterials_h
#define BlockMaterials_h

#include "vtkType.h"

#include <string>
#include <unordered_map>

class vtkBRDF;
class vtkDataObject;
class vtkPolyData;

namespace measuredbrdf
{
struct MaterialSettings;

class BlockMaterials
{
public:
  /// Look at the data and the settings, if they changed. Returns what the settings name that the
  /// data do not have, in words, or "".
  std::string Update(vtkDataObject* data, const MaterialSettings& settings);

  struct Material
  {
    vtkBRDF* BRDF = nullptr; // null: none
    bool IsOwn = false;      // of the block or one above it, not the mapper's
  };

  /// The material of a block.
  Material Get(vtkPolyData* block) const
  {
    const auto found = this->Materials.find(block);
    return found == this->Materials.end() ? Material() : found->second;
  }

  const std::unordered_map<vtkPolyData*, Material>& GetAll() const { return this->Materials; }

  /// Rises with each change.
  unsigned long GetRevision() const { return this->Revision; }

private:
  std::unordered_map<vtkPolyData*, Material> Materials;
  vtkDataObject* Data = nullptr;
  vtkMTimeType DataTime = 0;
  vtkMTimeType SettingsTime = 0;
  unsigned long Revision = 0;
};
} // namespace measuredbrdf

#endif
