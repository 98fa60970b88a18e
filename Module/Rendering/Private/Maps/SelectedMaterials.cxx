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
  if (ready && this->FollowOn(materials, text))
  {
    return;
  }
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

// One after another of the same shader.
bool SelectedMaterials::FollowOn(const DrawnMaterials& materials, const MixtureText& text)
{
  if (this->Materials.size() != 1 || materials.size() != 1 || !(text == this->Mixture) ||
      this->Materials[0]->Key != materials[0]->Key)
  {
    return false;
  }
  std::size_t place = 0;
  for (ShaderTextures* textures : { materials[0]->Material.get(), materials[0]->Radiance.get() })
  {
    if (textures && textures != this->Textures[place])
    {
      textures->ActivateAfter(*this->Textures[place]);
      this->Textures[place] = textures;
    }
    place += textures ? 1 : 0;
  }
  this->Materials = materials;
  return true;
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
