// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DrawnMaterial.h"

#include "NumberText.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

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
} // namespace measuredbrdf
