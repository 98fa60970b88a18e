// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaterialMap.h"

#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

vtkStandardNewMacro(vtkMaterialMap);

//------------------------------------------------------------------------------
vtkMaterialMap::vtkMaterialMap() = default;
vtkMaterialMap::~vtkMaterialMap() = default;

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkMaterialMap, Mode, int, CLASSES, TEXTURES);
measuredbrdfSetInRangeMacro(
  vtkMaterialMap, ArrayComponent, int, 0, std::numeric_limits<int>::max());

//------------------------------------------------------------------------------
void vtkMaterialMap::SetArrayName(const std::string& name)
{
  measuredbrdfAssignMacro(ArrayName, name);
}

//------------------------------------------------------------------------------
int vtkMaterialMap::AddMaterial(vtkBRDF* brdf, double value, const std::string& name)
{
  if (!std::isfinite(value))
  {
    vtkErrorMacro("AddMaterial: found the value " << value << ", expected a finite number.");
    return -1;
  }
  const int count = this->GetNumberOfMaterials();
  int index = this->FindClass(value);
  if (index < 0 && count >= MaximumNumberOfMaterials)
  {
    vtkErrorMacro("AddMaterial: there are " << count << " materials, the most.");
    return -1;
  }
  if (index < 0)
  {
    index = count;
    this->ByValue[value] = index;
    this->Materials.push_back({ nullptr, value, "", "" });
  }
  Material& material = this->Materials[static_cast<std::size_t>(index)];
  material.BRDF = brdf;
  material.Name = name;
  this->Modified();
  return index;
}

//------------------------------------------------------------------------------
int vtkMaterialMap::AddMaterial(vtkBRDF* brdf, const std::string& name)
{
  const double last = this->ByValue.empty() ? -1.0 : this->ByValue.rbegin()->first;
  return this->AddMaterial(brdf, std::max(std::floor(last) + 1.0, 0.0), name); // classes count on
}

//------------------------------------------------------------------------------
int vtkMaterialMap::AddMaterial(vtkBRDF* brdf) { return this->AddMaterial(brdf, std::string()); }

//------------------------------------------------------------------------------
void vtkMaterialMap::RemoveAllMaterials()
{
  if (!this->Materials.empty())
  {
    this->Materials.clear();
    this->ByValue.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const vtkMaterialMap::Material& vtkMaterialMap::Get(int index) const
{
  static const Material none;
  return index >= 0 && index < static_cast<int>(this->Materials.size())
           ? this->Materials[static_cast<std::size_t>(index)]
           : none;
}

//------------------------------------------------------------------------------
vtkBRDF* vtkMaterialMap::GetBRDF(int index) { return this->Get(index).BRDF; }
double vtkMaterialMap::GetValue(int index) { return this->Get(index).Value; }
std::string vtkMaterialMap::GetName(int index) { return this->Get(index).Name; }
std::string vtkMaterialMap::GetWeightArrayName(int index)
{
  return this->Get(index).WeightArrayName;
}

//------------------------------------------------------------------------------
template <typename Member, typename T>
void vtkMaterialMap::Change(int index, Member member, const T& value, const char* caller)
{
  if (index < 0 || index >= this->GetNumberOfMaterials())
  {
    vtkErrorMacro(<< caller << ": found the number " << index << ", expected one of "
                  << this->GetNumberOfMaterials() << " materials, which count from 0.");
    return;
  }
  Material& material = this->Materials[static_cast<std::size_t>(index)];
  if (material.*member != value)
  {
    material.*member = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkMaterialMap::SetBRDF(int index, vtkBRDF* brdf)
{
  this->Change(index, &Material::BRDF, vtkSmartPointer<vtkBRDF>(brdf), "SetBRDF");
}

//------------------------------------------------------------------------------
void vtkMaterialMap::SetName(int index, const std::string& name)
{
  this->Change(index, &Material::Name, name, "SetName");
}

//------------------------------------------------------------------------------
void vtkMaterialMap::SetWeightArrayName(int index, const std::string& name)
{
  this->Change(index, &Material::WeightArrayName, name, "SetWeightArrayName");
}

//------------------------------------------------------------------------------
void vtkMaterialMap::AddWeightImage(vtkImageData* image)
{
  if (!image)
  {
    vtkErrorMacro("AddWeightImage: an image is needed.");
    return;
  }
  this->WeightImages.push_back(image);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkMaterialMap::RemoveAllWeightImages()
{
  if (!this->WeightImages.empty())
  {
    this->WeightImages.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkImageData* vtkMaterialMap::GetWeightImage(int index)
{
  const bool known = index >= 0 && index < this->GetNumberOfWeightImages();
  return known ? this->WeightImages[static_cast<std::size_t>(index)].Get() : nullptr;
}

//------------------------------------------------------------------------------
int vtkMaterialMap::FindClass(double value)
{
  const auto place = std::isnan(value) ? this->ByValue.end() : this->ByValue.find(value);
  return place != this->ByValue.end() ? place->second : -1;
}

//------------------------------------------------------------------------------
double vtkMaterialMap::GetWeight(int index, double value)
{
  if (index < 0 || index >= this->GetNumberOfMaterials() || std::isnan(value))
  {
    return 0.0;
  }
  const double own = this->GetValue(index);
  if (this->Mode == CLASSES || value == own)
  {
    return value == own ? 1.0 : 0.0;
  }
  // The next material towards the value; none: this one is alone.
  const auto place = this->ByValue.find(own);
  const bool above = value > own;
  if (above ? std::next(place) == this->ByValue.end() : place == this->ByValue.begin())
  {
    return 1.0;
  }
  const double next = (above ? std::next(place) : std::prev(place))->first;
  return std::max(1.0 - (value - own) / (next - own), 0.0);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkMaterialMap::GetMTime()
{
  vtkMTimeType time = this->GetDivisionMTime();
  for (const Material& material : this->Materials)
  {
    time = std::max(time, material.BRDF ? material.BRDF->GetMTime() : 0);
  }
  return time;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkMaterialMap::GetDivisionMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkImageData* image : this->WeightImages)
  {
    time = std::max(time, image->GetMTime());
  }
  return time;
}

//------------------------------------------------------------------------------
void vtkMaterialMap::PrintSelf(ostream& os, vtkIndent indent)
{
  const char* const modes[] = { "classes", "values", "weights", "textures" };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mode: " << modes[this->Mode] << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "ArrayComponent: " << this->ArrayComponent << "\n";
  for (const Material& material : this->Materials)
  {
    os << indent << "Material " << material.Value << " \"" << material.Name
       << "\": " << material.BRDF.Get();
    os << (material.WeightArrayName.empty() ? "" : ", weights " + material.WeightArrayName) << "\n";
  }
  os << indent << "WeightImages: " << this->WeightImages.size() << "\n";
  os << indent << "RepeatWeightImages: " << (this->RepeatWeightImages ? "On" : "Off") << "\n";
}
