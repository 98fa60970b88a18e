// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WeightTexels.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkPointData.h"

#include <cmath>

namespace measuredbrdf
{
namespace
{
std::string FormatSize(const int dimensions[3])
{
  return std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]);
}
}

//------------------------------------------------------------------------------
std::string FindWeightProblem(vtkMaterialMap* map)
{
  if (map->GetMode() != vtkMaterialMap::TEXTURES || map->GetNumberOfWeightImages() == 0)
  {
    return "the material map has no weight images";
  }
  int components = 0;
  const int* first = map->GetWeightImage(0)->GetDimensions();
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    vtkImageData* image = map->GetWeightImage(k);
    const int* size = image->GetDimensions();
    vtkDataArray* values = image->GetPointData()->GetScalars();
    if (!values || image->GetNumberOfPoints() == 0 || size[2] != 1)
    {
      return "weight image " + std::to_string(k) + " has no values, or more than one slice";
    }
    if (size[0] != first[0] || size[1] != first[1])
    {
      return "weight image " + std::to_string(k) + ": found " + FormatSize(size) +
             " texels, expected the first image's " + FormatSize(first);
    }
    components += values->GetNumberOfComponents();
  }
  if (map->GetNumberOfMaterials() == 0 || components < map->GetNumberOfMaterials())
  {
    return std::to_string(map->GetNumberOfMaterials()) + " materials with " +
           std::to_string(components) +
           " components of weight images; expected a component for each";
  }
  return std::string();
}

//------------------------------------------------------------------------------
WeightTexels::WeightTexels(vtkMaterialMap* map)
  : Materials(map->GetNumberOfMaterials())
  , Width(map->GetWeightImage(0)->GetDimensions()[0])
  , Height(map->GetWeightImage(0)->GetDimensions()[1])
{
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    vtkDataArray* values = map->GetWeightImage(k)->GetPointData()->GetScalars();
    const bool isInteger =
      values->GetDataType() != VTK_FLOAT && values->GetDataType() != VTK_DOUBLE;
    this->Images.push_back({ values, isInteger ? values->GetDataTypeMax() : 1.0 });
  }
}

//------------------------------------------------------------------------------
void WeightTexels::Get(vtkIdType texel, double* weights) const
{
  int material = 0;
  double sum = 0.0;
  for (const Image& image : this->Images)
  {
    for (int c = 0; c < image.Values->GetNumberOfComponents() && material < this->Materials; ++c)
    {
      const double weight = image.Values->GetComponent(texel, c) / image.Divisor;
      weights[material] = std::isfinite(weight) && weight > 0.0 ? weight : 0.0;
      sum += weights[material++];
    }
  }
  for (int k = 0; k < this->Materials && sum > 0.0; ++k)
  {
    weights[k] /= sum;
  }
}
} // namespace measuredbrdf
