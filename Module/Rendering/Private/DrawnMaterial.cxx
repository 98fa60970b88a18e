// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DrawnMaterial.h"

#include "NumberText.h"

#include <algorithm>
#include <utility>

namespace measuredbrdf
{
std::string DescribePlans(const DrawnMaterials& materials)
{
  std::vector<std::string> lines;
  std::set<vtkRadiancePlanner*> said;
  for (const DrawnMaterial* drawn : materials)
  {
    if (drawn->Plan && said.insert(drawn->Plan).second)
    {
      lines.push_back(drawn->Plan->GetPlan());
    }
  }
  // Materials are drawn in an order of the superclass's own, which may be another in each run.
  std::sort(lines.begin(), lines.end());
  std::string text;
  for (const std::string& line : lines)
  {
    text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

std::string DescribeMixture(double error)
{
  if (error < 0.0)
  {
    return "";
  }
  return "\nmaterials of the map together: predicted error " + NumberText(100.0 * error, 2) + " %";
}

vtkIdType CountTextureBytes(
  const DrawnMaterials& materials, std::set<const vtkTextureObject*>& counted)
{
  std::size_t bytes = 0;
  for (const DrawnMaterial* drawn : materials)
  {
    for (const std::shared_ptr<ShaderTextures>& textures : { drawn->Material, drawn->Radiance })
    {
      bytes += textures ? textures->CountBytes(counted) : 0;
    }
  }
  return static_cast<vtkIdType>(bytes);
}

void SelectedMaterials::Set(const DrawnMaterials& materials, MixtureText text)
{
  const bool ready = std::all_of(
    materials.begin(), materials.end(), [](const DrawnMaterial* drawn) { return drawn->IsReady; });
  this->Clear();
  if (!ready)
  {
    return;
  }
  this->Materials = materials;
  this->Mixture = std::move(text);
  for (const DrawnMaterial* drawn : this->Materials)
  {
    for (ShaderTextures* textures : { drawn->Material.get(), drawn->Radiance.get() })
    {
      if (textures &&
          std::find(this->Textures.begin(), this->Textures.end(), textures) == this->Textures.end())
      {
        this->Textures.push_back(textures);
        textures->Activate();
      }
    }
  }
}

void SelectedMaterials::Clear()
{
  for (ShaderTextures* textures : this->Textures)
  {
    textures->Deactivate();
  }
  this->Textures.clear();
  this->Materials.clear();
  this->Mixture = {};
}

std::string SelectedMaterials::GetKey() const
{
  std::string key;
  for (const DrawnMaterial* drawn : this->Materials)
  {
    key += (key.empty() ? "" : "+") + drawn->Key;
  }
  return key + this->Mixture.Declarations + this->Mixture.Implementation;
}

bool SelectedMaterials::AreAnyAnisotropic() const
{
  return std::any_of(this->Materials.begin(), this->Materials.end(),
    [](const DrawnMaterial* drawn) { return !drawn->BRDF->IsIsotropic(); });
}
} // namespace measuredbrdf
