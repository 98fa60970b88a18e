// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SelectedMaterials.h"

#include <algorithm>
#include <utility>

namespace measuredbrdf
{
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
