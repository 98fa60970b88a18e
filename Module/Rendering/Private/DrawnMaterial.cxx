// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DrawnMaterial.h"

#include <cstddef>
#include <set>

namespace measuredbrdf
{
std::string DescribePlans(const DrawnMaterials& materials)
{
  std::string text;
  std::set<vtkRadiancePlanner*> said;
  for (const DrawnMaterial* drawn : materials)
  {
    if (drawn->Plan && said.insert(drawn->Plan).second)
    {
      text += (text.empty() ? "" : "\n") + drawn->Plan->GetPlan();
    }
  }
  return text;
}

vtkIdType CountTextureBytes(const DrawnMaterials& materials)
{
  std::set<const FormTextures*> counted;
  std::size_t bytes = 0;
  for (const DrawnMaterial* drawn : materials)
  {
    for (const std::shared_ptr<FormTextures>& textures : { drawn->Material, drawn->Radiance })
    {
      bytes += textures && counted.insert(textures.get()).second ? textures->GetBytes() : 0;
    }
  }
  return static_cast<vtkIdType>(bytes);
}

const vtkBRDFShaderInputs* FindMaterialForm(const DrawnMaterials& materials)
{
  for (const DrawnMaterial* drawn : materials)
  {
    if (drawn->Material)
    {
      return &drawn->Material->GetForm();
    }
  }
  return nullptr;
}

vtkRadiancePlanner* FindPlanner(const DrawnMaterials& materials)
{
  for (const DrawnMaterial* drawn : materials)
  {
    if (drawn->Plan)
    {
      return drawn->Plan;
    }
  }
  return nullptr;
}

vtkRadianceIntegrator* FindIntegrator(const DrawnMaterials& materials)
{
  for (const DrawnMaterial* drawn : materials)
  {
    if (drawn->Integrator)
    {
      return drawn->Integrator;
    }
  }
  return nullptr;
}

} // namespace measuredbrdf
