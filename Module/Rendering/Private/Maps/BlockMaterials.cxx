// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockMaterials.h"

#include "MaterialSettings.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"

#include <set>

namespace measuredbrdf
{
namespace
{
// Walks down the tree as VTK counts: the root is 0, missing children count.
struct Walk
{
  void Visit(vtkDataObject* data, const char* name, BlockMaterials::Material material)
  {
    const unsigned int index = this->Next++;
    const auto byName =
      name ? this->Settings.BlocksByName.find(name) : this->Settings.BlocksByName.end();
    if (byName != this->Settings.BlocksByName.end())
    {
      material = { byName->second, true };
      this->Found.insert(name);
    }
    const auto byIndex = this->Settings.BlocksByIndex.find(index);
    if (byIndex != this->Settings.BlocksByIndex.end())
    {
      material = { byIndex->second, true };
    }
    if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
    {
      for (const auto child : vtk::Range(tree, vtk::DataObjectTreeOptions::None))
      {
        const char* childName =
          child.HasMetaData() ? child.GetMetaData()->Get(vtkCompositeDataSet::NAME()) : nullptr;
        this->Visit(child.GetDataObject(), childName, material);
      }
    }
    else if (auto* surface = vtkPolyData::SafeDownCast(data))
    {
      this->Materials[surface] = material;
    }
  }

  std::string GetMissing() const
  {
    std::string missing;
    const auto add = [&missing](const std::string& text)
    { missing += (missing.empty() ? "" : ", ") + text; };
    for (const auto& [index, brdf] : this->Settings.BlocksByIndex)
    {
      if (index >= this->Next)
      {
        add("index " + std::to_string(index));
      }
    }
    for (const auto& [name, brdf] : this->Settings.BlocksByName)
    {
      if (this->Found.count(name) == 0)
      {
        add("name \"" + name + "\"");
      }
    }
    return missing;
  }

  const MaterialSettings& Settings;
  std::unordered_map<vtkPolyData*, BlockMaterials::Material>& Materials;
  std::set<std::string> Found;
  unsigned int Next;
};
}

std::string BlockMaterials::Update(vtkDataObject* data, const MaterialSettings& settings)
{
  if (data == this->Data && data->GetMTime() == this->DataTime &&
      settings.Time.GetMTime() == this->SettingsTime)
  {
    return "";
  }
  this->Data = data;
  this->DataTime = data->GetMTime();
  this->SettingsTime = settings.Time.GetMTime();
  ++this->Revision;
  this->Materials.clear();
  Walk walk{ settings, this->Materials, {}, 0 };
  walk.Visit(data, nullptr, { settings.BRDF, false });
  return walk.GetMissing();
}
} // namespace measuredbrdf
