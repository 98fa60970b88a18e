// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "NamedMap.h"

#include "MaterialFiles.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <ostream>

namespace measuredmaterials
{
namespace
{
constexpr int Weights = 3;
constexpr int Textures = 4;

//------------------------------------------------------------------------------
bool HasArray(vtkDataSet* data, const std::string& name)
{
  return data->GetPointData()->HasArray(name.c_str()) ||
         data->GetCellData()->HasArray(name.c_str());
}
}

//------------------------------------------------------------------------------
void NamedMap::Find(vtkMultiProcessController* controller, const Say& say)
{
  this->FoundMaterials.clear();
  for (const auto& [value, name] : this->Materials)
  {
    const Found<vtkBRDF> found = FindMaterial(name, controller);
    say(found.Error);
    this->FoundMaterials.push_back(found.Object);
  }
  this->FoundImages.clear();
  for (const std::string& path : this->Images)
  {
    const Found<vtkImageData> found = FindWeightImage(path, controller);
    say(found.Error);
    this->FoundImages.push_back(found.Object);
  }
  this->IsChanged = true;
}

//------------------------------------------------------------------------------
void NamedMap::DropMaterials()
{
  std::fill(this->FoundMaterials.begin(), this->FoundMaterials.end(), nullptr);
  this->IsChanged = true;
}

//------------------------------------------------------------------------------
bool NamedMap::HasWeights() const { return this->Mode == Weights || this->Mode == Textures; }

//------------------------------------------------------------------------------
vtkMaterialMap* NamedMap::Get(const Say& say)
{
  if (!this->IsChanged)
  {
    return this->Map;
  }
  this->IsChanged = false;
  this->Map = nullptr;
  if (this->Mode == 0)
  {
    return nullptr;
  }
  bool isWhole = true;
  std::map<double, std::pair<vtkBRDF*, std::string>> rows;
  for (std::size_t k = 0; k < std::min(this->Materials.size(), this->FoundMaterials.size()); ++k)
  {
    const auto& [value, name] = this->Materials[k];
    double number = 0.0; // not by strtod, which follows the host's locale
    const char* const end = value.data() + value.size();
    const auto read = std::from_chars(value.data(), end, number);
    const bool isNumber = read.ec == std::errc() && read.ptr == end && std::isfinite(number);
    if (!isNumber && !value.empty())
    {
      say("Map Materials: found \"" + value + "\", expected a number.");
      isWhole = false;
    }
    else if (this->FoundMaterials[k]) // what cannot be read has been said
    {
      rows[number] = { this->FoundMaterials[k], name };
    }
    else
    {
      isWhole = false;
    }
  }
  const int modes[] = { vtkMaterialMap::CLASSES, vtkMaterialMap::VALUES, vtkMaterialMap::WEIGHTS,
    vtkMaterialMap::TEXTURES };
  auto map = vtkSmartPointer<vtkMaterialMap>::New();
  map->SetMode(modes[this->Mode - 1]);
  map->SetArrayName(this->Array);
  for (const auto& [number, row] : rows)
  {
    map->AddMaterial(row.first, number, row.second);
  }
  for (vtkImageData* image : this->FoundImages)
  {
    if (image && this->Mode == Textures)
    {
      map->AddWeightImage(image);
    }
    isWhole = isWhole && (image || this->Mode != Textures);
  }
  // One that is left out would give its weights to the others.
  this->Map = isWhole || !this->HasWeights() ? map : nullptr;
  return this->Map;
}

//------------------------------------------------------------------------------
bool NamedMap::CanRead(vtkDataObject* data) const
{
  const auto canRead = [this](vtkDataObject* block)
  {
    auto* surface = vtkDataSet::SafeDownCast(block);
    return !surface || surface->GetNumberOfCells() == 0 ||
           (this->Mode == Textures ? surface->GetPointData()->GetTCoords() != nullptr
                                   : HasArray(surface, this->Array));
  };
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  if (!blocks)
  {
    return data && canRead(data);
  }
  const auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  bool all = true;
  for (it->InitTraversal(); all && !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    all = canRead(it->GetCurrentDataObject());
  }
  return all;
}

//------------------------------------------------------------------------------
void NamedMap::Print(std::ostream& os, const std::string& indent) const
{
  os << indent << "MaterialMapMode: " << this->Mode << "\n";
  os << indent << "MaterialMapArray: " << this->Array << "\n";
  for (const auto& [value, material] : this->Materials)
  {
    os << indent << "MapMaterial: " << value << " " << material << "\n";
  }
  for (const std::string& path : this->Images)
  {
    os << indent << "WeightImage: " << path << "\n";
  }
}
} // namespace measuredmaterials
