// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lists.h"

#include "ModelMaterials.h"
#include "State.h"

#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"

#include <algorithm>
#include <filesystem>

namespace
{
//------------------------------------------------------------------------------
explorer::Item MakeFileItem(const std::string& file)
{
  return { file, std::filesystem::path(file).filename().string(), "Files", file };
}
}

namespace explorer
{
//------------------------------------------------------------------------------
bool IsEmbeddedMaterial(const std::string& name)
{
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    if (vtkEmbeddedMaterials::GetName(k) == name)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool IsEmbeddedEnvironment(const std::string& name)
{
  for (int k = 0; k < vtkEmbeddedEnvironments::GetNumberOfEnvironments(); ++k)
  {
    if (vtkEmbeddedEnvironments::GetName(k) == name)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
std::vector<Item> ListMaterials(const std::vector<std::string>& opened)
{
  std::vector<Item> items;
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    items.push_back(
      { name, name, vtkEmbeddedMaterials::GetKind(k), vtkEmbeddedMaterials::GetSource(k) });
  }
  std::stable_sort(
    items.begin(), items.end(), [](const Item& a, const Item& b) { return a.Kind < b.Kind; });
  std::vector<Item> files;
  for (const std::string& file : opened)
  {
    files.push_back(MakeFileItem(file));
  }
  const std::vector<Item> models = ListModels();
  files.insert(files.end(), models.begin(), models.end());
  files.insert(files.end(), items.begin(), items.end());
  return files;
}

//------------------------------------------------------------------------------
std::vector<Item> ListEnvironments(const std::vector<std::string>& opened)
{
  std::vector<Item> items;
  for (int k = 0; k < vtkEmbeddedEnvironments::GetNumberOfEnvironments(); ++k)
  {
    const std::string name = vtkEmbeddedEnvironments::GetName(k);
    items.push_back({ name, name, "Built-in", vtkEmbeddedEnvironments::GetSource(k) });
  }
  items.push_back({ DirectionalLightName, "Directional light", "Built-in",
    "One light from one direction; its direction and irradiance are in the Light tab" });
  for (const std::string& file : opened)
  {
    items.push_back(MakeFileItem(file));
  }
  return items;
}

//------------------------------------------------------------------------------
std::vector<Item> ListMeshes(const std::string& opened)
{
  std::vector<Item> items = { { "sphere", "Sphere", "Built-in", "A unit sphere" },
    { "ball-on-foot", "Ball on foot", "Built-in",
      "The gallery's piece: a ball on a fluted foot" } };
  if (opened.find_first_of("/.") != std::string::npos)
  {
    items.push_back(MakeFileItem(opened));
  }
  return items;
}
} // namespace explorer
