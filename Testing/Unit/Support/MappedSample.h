// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A flat sample whose materials and weights are known, to be photographed and found again.
 */

#ifndef MappedSample_h
#define MappedSample_h

#include "SimulatedPhotographs.h"
#include "vtkBRDF.h"
#include "vtkDataArray.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkMaterialMapFitter.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <random>
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
inline vtkSmartPointer<SimulatedPhotographs> NewPhotographs(
  vtkMaterialMap* map, int count, double exposure = 1.0)
{
  auto photographs = vtkSmartPointer<SimulatedPhotographs>::New();
  photographs->Map = map;
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

/// All built-in materials.
inline void AddLibrary(vtkMaterialMapFitter* fitter)
{
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    fitter->AddMaterial(brdf, name);
  }
}

/// Differences of weights, by the materials' names.
struct WeightDifference
{
  double Largest = 0.0;
  double Mean = 0.0;
  bool AreOthers = false; // the materials are not the original's
};

inline WeightDifference CompareWeights(vtkMaterialMap* found, vtkMaterialMap* original)
{
  WeightDifference result;
  result.AreOthers = found->GetNumberOfMaterials() != original->GetNumberOfMaterials();
  const int texels = static_cast<int>(original->GetWeightImage(0)->GetNumberOfPoints());
  for (int k = 0; k < original->GetNumberOfMaterials(); ++k)
  {
    int number = 0;
    while (number < found->GetNumberOfMaterials() && found->GetName(number) != original->GetName(k))
    {
      ++number;
    }
    const bool has = number < found->GetNumberOfMaterials();
    result.AreOthers = result.AreOthers || !has;
    for (int texel = 0; texel < texels; ++texel)
    {
      const double weight = has ? GetWeight(found, number, texel) : 0.0;
      const double difference = std::abs(weight - GetWeight(original, k, texel));
      result.Largest = std::max(result.Largest, difference);
      result.Mean += difference / (texels * original->GetNumberOfMaterials());
    }
  }
  return result;
}

/// Relative L1 difference of the photographs that two maps give, at directions up to 60 degrees
/// that no fit has: anywhere, or near the mirror direction. Photographs count alike.
inline double ComparePhotographs(vtkMaterialMap* found, vtkMaterialMap* original, bool mirror)
{
  constexpr int count = 100;
  vtkNew<SimulatedPhotographs> sets[2];
  sets[0]->Map = found;
  sets[1]->Map = original;
  std::mt19937 random(3);
  const auto number = [&](double from, double to)
  { return from + (to - from) * static_cast<double>(random()) * 0x1p-32; };
  double sum = 0.0;
  for (int k = 0; k < count; ++k)
  {
    double light[3], view[3];
    const double theta = number(0.0, 60.0), phi = number(0.0, 360.0);
    vtkPhotographSet::GetDirection(theta, phi, light);
    vtkPhotographSet::GetDirection(mirror ? theta + number(0.0, 8.0) : number(0.0, 60.0),
      mirror ? phi + number(175.0, 185.0) : number(0.0, 360.0), view);
    vtkSmartPointer<vtkImageData> pictures[2];
    for (int of = 0; of < 2; ++of)
    {
      sets[of]->Add(light, view);
      pictures[of].TakeReference(sets[of]->NewPicture(k));
    }
    vtkDataArray* x = pictures[0]->GetPointData()->GetScalars();
    vtkDataArray* r = pictures[1]->GetPointData()->GetScalars();
    double difference = 0.0, whole = 0.0;
    for (vtkIdType texel = 0; texel < x->GetNumberOfTuples(); ++texel)
    {
      for (int c = 0; c < 3; ++c)
      {
        difference += std::abs(x->GetComponent(texel, c) - r->GetComponent(texel, c));
        whole += r->GetComponent(texel, c);
      }
    }
    sum += difference / whole / count;
  }
  return sum;
}

#endif
