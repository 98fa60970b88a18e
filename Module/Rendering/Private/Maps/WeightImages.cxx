// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WeightImages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
vtkDataArray* GetScalars(vtkImageData* image) { return image->GetPointData()->GetScalars(); }

bool IsInteger(int type) { return type != VTK_FLOAT && type != VTK_DOUBLE; }

// warning: what is odd about them.
void Check(vtkMaterialMap* map, std::string& warning)
{
  int components = 0;
  bool anyLeft = false; // weights of no material
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    vtkImageData* image = map->GetWeightImage(k);
    const std::string name = "weight image " + std::to_string(k);
    vtkDataArray* scalars = GetScalars(image);
    int dimensions[3];
    image->GetDimensions(dimensions);
    if (!scalars || dimensions[2] != 1 || image->GetNumberOfPoints() == 0)
    {
      throw MapProblem(name + " is not an image of one slice with scalars");
    }
    if (scalars->GetNumberOfComponents() > 4 ||
        scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
    {
      throw MapProblem(name + " has " + std::to_string(scalars->GetNumberOfComponents()) +
                       " components and " + std::to_string(scalars->GetNumberOfTuples()) +
                       " tuples, expected 1 to 4 components and " +
                       std::to_string(image->GetNumberOfPoints()) + " tuples");
    }
    for (int c = 0; c < scalars->GetNumberOfComponents(); ++c)
    {
      double range[2] = { 0.0, 0.0 };
      if (components++ >= map->GetNumberOfMaterials())
      {
        scalars->GetRange(range, c);
      }
      anyLeft = anyLeft || range[0] != 0.0 || range[1] != 0.0;
    }
  }
  if (components < map->GetNumberOfMaterials())
  {
    throw MapProblem("its weight images have " + std::to_string(components) + " components for " +
                     std::to_string(map->GetNumberOfMaterials()) + " materials");
  }
  if (anyLeft) // image files often have three components for two materials
  {
    warning = "the last " + std::to_string(components - map->GetNumberOfMaterials()) +
              " components of the weight images belong to no material";
  }
}

// Values as floats, at least 0; bad is raised by the number of others.
std::vector<float> GetValues(vtkImageData* image, std::size_t& bad)
{
  vtkDataArray* scalars = GetScalars(image);
  const int components = scalars->GetNumberOfComponents();
  const double scale = IsInteger(scalars->GetDataType()) ? 1.0 / scalars->GetDataTypeMax() : 1.0;
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(scalars->GetNumberOfValues()));
  for (vtkIdType p = 0; p < scalars->GetNumberOfTuples(); ++p)
  {
    for (int c = 0; c < components; ++c)
    {
      const double value = scale * scalars->GetComponent(p, c);
      const bool good = value >= 0.0 && value <= VTK_FLOAT_MAX;
      bad += good ? 0 : 1;
      values.push_back(good ? static_cast<float>(value) : 0.0f);
    }
  }
  return values;
}
}

// Weights are looked at in the texels of a grid as fine as the finest image, each at the nearest
// texel of the others.
std::vector<double> MeasureWeightImages(vtkMaterialMap* map, std::string& warning)
{
  Check(map, warning);
  int width = 0;
  int height = 0;
  std::size_t bad = 0;
  std::vector<std::vector<float>> values;
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    const int* size = map->GetWeightImage(k)->GetDimensions();
    width = std::max(width, size[0]);
    height = std::max(height, size[1]);
    values.push_back(GetValues(map->GetWeightImage(k), bad));
  }
  const std::size_t materials = map->GetNumberOfMaterials();
  std::vector<double> means(materials + 1, 0.0);
  std::vector<double> weights(materials + 1, 0.0);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      std::size_t material = 0;
      double sum = 0.0;
      for (std::size_t k = 0; k < values.size(); ++k)
      {
        vtkImageData* image = map->GetWeightImage(static_cast<int>(k));
        const int* size = image->GetDimensions();
        const std::size_t components = GetScalars(image)->GetNumberOfComponents();
        const std::size_t column = (2 * x + 1) * size[0] / (2 * width);
        const std::size_t row = (2 * y + 1) * size[1] / (2 * height);
        for (std::size_t c = 0; c < components && material < materials; ++c)
        {
          weights[++material] = values[k][(row * size[0] + column) * components + c];
          sum += weights[material];
        }
      }
      means[0] += sum > 0.0 ? 0.0 : 1.0;
      for (std::size_t k = 1; k <= materials && sum > 0.0; ++k)
      {
        means[k] += weights[k] / sum;
      }
    }
  }
  for (double& mean : means)
  {
    mean /= static_cast<double>(width) * height;
  }
  if (bad > 0)
  {
    warning += (warning.empty() ? "" : "; ") + std::to_string(bad) +
               " weights in images are negative, infinite or NaN and count as 0";
  }
  return means;
}

std::shared_ptr<ShaderTextures> FindWeightTextures(
  vtkMaterialMap* map, vtkOpenGLRenderWindow* window, std::string& problem)
{
  const auto make = [map](vtkBRDFShaderInputs& inputs)
  {
    for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
    {
      vtkImageData* image = map->GetWeightImage(k);
      const bool repeats = map->GetRepeatWeightImages();
      std::size_t bad = 0; // reported when the surface was divided
      vtkBRDFShaderInputs::Texture texture;
      texture.Name = "brdfWeightImage"; // a term each, which numbers the samplers
      image->GetDimensions(texture.Dimensions.data());
      texture.Components = GetScalars(image)->GetNumberOfComponents();
      texture.Repeat = { repeats, repeats, false };
      texture.Mipmaps = true;
      texture.Data = GetValues(image, bad);
      inputs.Terms.emplace_back().Textures.push_back(std::move(texture));
    }
    return std::string();
  };
  return ShaderTextures::Find(map, map->GetDivisionMTime(), false, window, make, problem);
}
} // namespace measuredbrdf
