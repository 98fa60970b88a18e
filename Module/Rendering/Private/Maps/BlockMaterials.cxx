// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockMaterials.h"

#include "MaterialSettings.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <set>

namespace measuredbrdf
{
namespace
{
// Walks down the tree as VTK counts: the root is 0, missing children count.
class Walk
{
public:
  Walk(const MaterialSettings& settings,
    std::unordered_map<vtkPolyData*, BlockMaterials::Material>& materials)
    : Settings(settings)
    , Materials(materials)
  {
  }

  void Run(vtkDataObject* data)
  {
    auto* tree = vtkDataObjectTree::SafeDownCast(data);
    if (tree && !this->Settings.BlocksByName.empty())
    {
      this->FindNames(tree);
    }
    this->Visit(data, { this->Settings.BRDF, false });
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

private:
  void FindNames(vtkDataObjectTree* tree)
  {
    vtkNew<vtkDataObjectTreeIterator> it;
    it->SetDataSet(tree);
    it->VisitOnlyLeavesOff();
    it->TraverseSubTreeOn();
    it->SkipEmptyNodesOff();
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      const char* name = it->HasCurrentMetaData()
                           ? it->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME())
                           : nullptr;
      const auto found =
        name ? this->Settings.BlocksByName.find(name) : this->Settings.BlocksByName.end();
      if (found != this->Settings.BlocksByName.end())
      {
        this->Named[it->GetCurrentFlatIndex()] = found->second;
        this->Found.insert(name);
      }
    }
  }

  void Visit(vtkDataObject* data, BlockMaterials::Material material)
  {
    const unsigned int index = this->Next++;
    const auto byName = this->Named.find(index);
    if (byName != this->Named.end())
    {
      material = { byName->second, true };
    }
    const auto byIndex = this->Settings.BlocksByIndex.find(index);
    if (byIndex != this->Settings.BlocksByIndex.end())
    {
      material = { byIndex->second, true };
    }
    if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
    {
      for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::None))
      {
        this->Visit(child, material);
      }
    }
    else if (auto* surface = vtkPolyData::SafeDownCast(data))
    {
      this->Materials[surface] = material;
    }
  }

  const MaterialSettings& Settings;
  std::unordered_map<vtkPolyData*, BlockMaterials::Material>& Materials;
  std::unordered_map<unsigned int, vtkBRDF*> Named;
  std::set<std::string> Found;
  unsigned int Next = 0;
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
  Walk walk(settings, this->Materials);
  walk.Run(data);
  return walk.GetMissing();
}
} // namespace measuredbrdf
