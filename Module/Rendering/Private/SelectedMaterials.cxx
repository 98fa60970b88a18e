// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SelectedMaterials.h"

#include <algorithm>
#include <utility>

namespace measuredbrdf
{
void SelectedMaterials::Set(const DrawnMaterials& materials, MixtureText text)
{
  this->Clear();
  const bool ready = std::all_of(
    materials.begin(), materials.end(), [](const DrawnMaterial* drawn) { return drawn->IsReady; });
  if (!ready)
  {
    return;
  }
  this->Materials = materials;
  this->Mixture = std::move(text);
  for (const std::shared_ptr<FormTextures>& textures : this->GetTextures())
  {
    textures->Activate();
  }
}

void SelectedMaterials::Clear()
{
  for (const std::shared_ptr<FormTextures>& textures : this->GetTextures())
  {
    textures->Deactivate();
  }
  this->Materials.clear();
  this->Mixture = {};
}

// Textures that several share once.
std::vector<std::shared_ptr<FormTextures>> SelectedMaterials::GetTextures() const
{
  std::vector<std::shared_ptr<FormTextures>> all;
  for (const DrawnMaterial* drawn : this->Materials)
  {
    for (const std::shared_ptr<FormTextures>& textures : { drawn->Material, drawn->Radiance })
    {
      if (textures && std::find(all.begin(), all.end(), textures) == all.end())
      {
        all.push_back(textures);
      }
    }
  }
  return all;
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
