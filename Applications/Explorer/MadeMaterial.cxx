// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MadeMaterial.h"

#include "ModelMaterials.h"
#include "SampleTable.h"

namespace
{
//------------------------------------------------------------------------------
explorer::SampleEdits FindEdits(const std::string& file, const explorer::MaterialSettings& settings)
{
  const auto found = settings.Edits.find(file);
  return found == settings.Edits.end() ? explorer::SampleEdits() : found->second;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
bool MadeMaterial::IsAnother(const MaterialSettings& settings) const
{
  return this->Edits != FindEdits(this->Shown.File, settings) ||
         this->Values != FindValues(this->Shown.File, settings.Models);
}

//------------------------------------------------------------------------------
MadeMaterial MakeMaterial(const std::string& file, const MaterialSettings& settings)
{
  return RemakeMaterialOf(LoadMaterial(file, settings.Models), settings);
}

//------------------------------------------------------------------------------
MadeMaterial RemakeMaterialOf(const tool::Material& original, const MaterialSettings& settings)
{
  MadeMaterial made;
  made.Original =
    FindModel(original.File) ? LoadMaterial(original.File, settings.Models) : original;
  made.Values = FindValues(original.File, settings.Models);
  made.Edits = FindEdits(original.File, settings);
  made.Shown = ApplyEdits(made.Original, made.Edits);
  made.Shown.BRDF->Prepare();
  if (made.Shown.Transmission)
  {
    made.Shown.Transmission->Prepare();
  }
  return made;
}
} // namespace explorer
