// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MapArrays.h"

#include "vtkCellData.h"
#include "vtkMaterialMap.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace measuredbrdf
{
namespace
{
vtkDataArray* Look(vtkDataSetAttributes* data, const std::string& name)
{
  return name.empty() ? data->GetScalars() : data->GetArray(name.c_str());
}

std::string Quote(const std::string& name)
{
  return name.empty() ? "active scalars" : "array \"" + name + "\"";
}
}

std::string MapArray::Check(int component, vtkIdType tuples, const std::string& name)
{
  if (component >= this->Array->GetNumberOfComponents())
  {
    return "it reads component " + std::to_string(component) + " of the " + Quote(name) +
           ", which has " + std::to_string(this->Array->GetNumberOfComponents());
  }
  if (this->Array->GetNumberOfTuples() < tuples)
  {
    return "the " + Quote(name) + " has " + std::to_string(this->Array->GetNumberOfTuples()) +
           " tuples for " + std::to_string(tuples) + (this->OfCells ? " cells" : " points");
  }
  this->Component = component;
  return "";
}

std::string MapArray::Find(vtkPolyData* input, vtkMaterialMap* map)
{
  const std::string name = map->GetArrayName();
  this->Array = Look(input->GetPointData(), name);
  this->OfCells = !this->Array;
  if (this->OfCells)
  {
    this->Array = Look(input->GetCellData(), name);
  }
  if (!this->Array)
  {
    return name.empty() ? "the surface has no active scalars"
                        : "the surface has no point or cell array \"" + name + "\" of numbers";
  }
  return this->Check(map->GetArrayComponent(),
    this->OfCells ? input->GetNumberOfCells() : input->GetNumberOfPoints(), name);
}

std::string MapArray::FindWeights(vtkPolyData* input, vtkMaterialMap* map, int material)
{
  const std::string own = map->GetWeightArrayName(material);
  const std::string name = own.empty() ? map->GetArrayName() : own;
  this->Array = Look(input->GetPointData(), name);
  if (!this->Array)
  {
    return name.empty() ? "the surface's points have no active scalars"
                        : "the surface has no point array \"" + name + "\" of numbers";
  }
  return this->Check(own.empty() ? material : 0, input->GetNumberOfPoints(), name);
}

bool MapArray::IsRead(vtkPolyData* input, vtkMaterialMap* map, vtkAbstractArray* array)
{
  const int mode = map->GetMode();
  if (!array || mode == vtkMaterialMap::TEXTURES)
  {
    return false;
  }
  MapArray own;
  if (mode != vtkMaterialMap::WEIGHTS)
  {
    return own.Find(input, map).empty() && own.GetArray() == array;
  }
  for (int k = 0; k < map->GetNumberOfMaterials(); ++k)
  {
    if (own.FindWeights(input, map, k).empty() && own.GetArray() == array)
    {
      return true;
    }
  }
  return false;
}
} // namespace measuredbrdf
