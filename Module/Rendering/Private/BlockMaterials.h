// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which material each block of a composite data set has. Private to the rendering room.
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

  /// The material of a block; null: none.
  vtkBRDF* Get(vtkPolyData* block) const
  {
    const auto found = this->Materials.find(block);
    return found == this->Materials.end() ? nullptr : found->second;
  }

  /// Rises with each change.
  unsigned long GetRevision() const { return this->Revision; }

private:
  std::unordered_map<vtkPolyData*, vtkBRDF*> Materials;
  vtkDataObject* Data = nullptr;
  vtkMTimeType DataTime = 0;
  vtkMTimeType SettingsTime = 0;
  unsigned long Revision = 0;
};
} // namespace measuredbrdf

#endif
