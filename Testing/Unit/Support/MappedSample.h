// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A flat sample whose materials and weights are known, to be photographed and found again.
 */

#ifndef MappedSample_h
#define MappedSample_h

#include "vtkEmbeddedMaterials.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkNew.h"
#include "vtkSimulatedPhotographSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

/// Built-in materials in weights that vary smoothly and reach 1 somewhere for each of them.
inline vtkSmartPointer<vtkMaterialMap> NewMappedSample(
  const std::vector<std::string>& names, int side, double largest = 1.0)
{
  auto map = vtkSmartPointer<vtkMaterialMap>::New();
  map->SetModeToTextures();
  const int materials = static_cast<int>(names.size());
  for (const std::string& name : names)
  {
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    map->AddMaterial(brdf, name);
  }
  for (int first = 0; first < materials; first += 4)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(side, side, 1);
    image->AllocateScalars(VTK_FLOAT, std::min(4, materials - first));
    auto* values = static_cast<float*>(image->GetScalarPointer());
    for (int texel = 0; texel < side * side; ++texel)
    {
      // Materials are the corners of a polygon; a texel's weight falls with its distance to them.
      const double x = (texel % side + 0.5) / side - 0.5, y = (texel / side + 0.5) / side - 0.5;
      std::vector<double> weights;
      double sum = 0.0;
      for (int k = 0; k < materials; ++k)
      {
        const double angle = 2.0 * 3.14159265358979 * (k + 0.3) / materials;
        const double distance = std::hypot(x - 0.4 * std::cos(angle), y - 0.4 * std::sin(angle));
        weights.push_back(std::pow(std::max(0.45 - distance, 0.0), 2));
        sum += weights.back();
      }
      for (int k = first; k < std::min(first + 4, materials); ++k)
      {
        const double even = 1.0 / materials;
        const double weight = sum > 0.0 ? weights[static_cast<std::size_t>(k)] / sum : even;
        *values++ = static_cast<float>(largest * weight + (1.0 - largest) * even);
      }
    }
    map->AddWeightImage(image);
  }
  return map;
}

/// Its photographs under pairs of the Bonn database's directions.
inline vtkSmartPointer<vtkSimulatedPhotographSet> NewPhotographs(
  vtkMaterialMap* map, int count, double exposure = 1.0)
{
  auto photographs = vtkSmartPointer<vtkSimulatedPhotographSet>::New();
  photographs->SetMaterialMap(map);
  photographs->AddBonnDirections(count, exposure);
  return photographs;
}

/// A weight of a map, at a texel.
inline double GetWeight(vtkMaterialMap* map, int material, int texel)
{
  vtkImageData* image = map->GetWeightImage(material / 4);
  const int width = image->GetDimensions()[0];
  return image->GetScalarComponentAsDouble(texel % width, texel / width, 0, material % 4);
}

#endif
