// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaterialMap.h"

#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <utility>

vtkStandardNewMacro(vtkMaterialMap);

//------------------------------------------------------------------------------
vtkMaterialMap::vtkMaterialMap() = default;
vtkMaterialMap::~vtkMaterialMap() = default;

//------------------------------------------------------------------------------
void vtkMaterialMap::SetMode(int mode)
{
  if (mode < CLASSES || mode > TEXTURES)
  {
    measuredbrdfRefuseMacro(Mode, mode, "0 (classes), 1 (values), 2 (weights) or 3 (textures)");
    return;
  }
  measuredbrdfAssignMacro(Mode, mode);
}

//------------------------------------------------------------------------------
void vtkMaterialMap::SetArrayName(const std::string& name)
{
  measuredbrdfAssignMacro(ArrayName, name);
}

//------------------------------------------------------------------------------
void vtkMaterialMap::SetArrayComponent(int component)
{
  if (component < 0)
  {
    measuredbrdfRefuseMacro(ArrayComponent, component, "a component's number from 0");
    return;
  }
  measuredbrdfAssignMacro(ArrayComponent, component);
}

//------------------------------------------------------------------------------
int vtkMaterialMap::Insert(Material material)
{
  if (this->GetNumberOfMaterials() >= MaximumNumberOfMaterials)
  {
    vtkErrorMacro("AddMaterial: there are " << MaximumNumberOfMaterials << " materials, the most.");
    return -1;
  }
  const int index = this->GetNumberOfMaterials();
  const auto place = std::upper_bound(this->ByValue.begin(), this->ByValue.end(), material.Value,
    [this](double value, int k)
    { return value < this->Materials[static_cast<std::size_t>(k)].Value; });
  this->ByValue.insert(place, index);
  this->Materials.push_back(std::move(material));
  this->Modified();
  return index;
}

//------------------------------------------------------------------------------
int vtkMaterialMap::AddMaterial(vtkBRDF* brdf, double value, const std::string& name)
{
  if (!std::isfinite(value))
  {
    vtkErrorMacro("AddMaterial: found the value " << value << ", expected a finite number.");
    return -1;
  }
  const int known = this->FindClass(value);
  if (known < 0)
  {
    return this->Insert({ brdf, value, name, "" });
  }
  Material& material = this->Materials[static_cast<std::size_t>(known)];
  material.BRDF = brdf;
  material.Name = name;
  this->Modified();
  return known;
}

//------------------------------------------------------------------------------
int vtkMaterialMap::AddMaterial(vtkBRDF* brdf, const std::string& name)
{
  double value = 0.0; // classes count on, too
  for (const Material& material : this->Materials)
  {
    value = std::max(value, std::floor(material.Value) + 1.0);
  }
  return this->Insert({ brdf, value, name, "" });
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
vtkMaterialMap::Material* vtkMaterialMap::Find(int index, const char* caller)
{
  if (index >= 0 && index < this->GetNumberOfMaterials())
  {
    return &this->Materials[static_cast<std::size_t>(index)];
  }
  if (caller)
  {
    vtkErrorMacro(<< caller << ": found the number " << index << ", expected one of "
                  << this->GetNumberOfMaterials() << " materials, which count from 0.");
  }
  return nullptr;
}

//------------------------------------------------------------------------------
vtkBRDF* vtkMaterialMap::GetBRDF(int index)
{
  const Material* material = this->Find(index, nullptr);
  return material ? material->BRDF.Get() : nullptr;
}

//------------------------------------------------------------------------------
double vtkMaterialMap::GetValue(int index)
{
  const Material* material = this->Find(index, nullptr);
  return material ? material->Value : 0.0;
}

//------------------------------------------------------------------------------
std::string vtkMaterialMap::GetName(int index)
{
  const Material* material = this->Find(index, nullptr);
  return material ? material->Name : "";
}

//------------------------------------------------------------------------------
std::string vtkMaterialMap::GetWeightArrayName(int index)
{
  const Material* material = this->Find(index, nullptr);
  return material ? material->WeightArrayName : "";
}

//------------------------------------------------------------------------------
void vtkMaterialMap::SetBRDF(int index, vtkBRDF* brdf)
{
  Material* material = this->Find(index, "SetBRDF");
  if (material && material->BRDF != brdf)
  {
    material->BRDF = brdf;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkMaterialMap::SetName(int index, const std::string& name)
{
  Material* material = this->Find(index, "SetName");
  if (material && material->Name != name)
  {
    material->Name = name;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkMaterialMap::SetWeightArrayName(int index, const std::string& name)
{
  Material* material = this->Find(index, "SetWeightArrayName");
  if (material && material->WeightArrayName != name)
  {
    material->WeightArrayName = name;
    this->Modified();
  }
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
  const auto place = std::lower_bound(this->ByValue.begin(), this->ByValue.end(), value,
    [this](int k, double wanted)
    { return this->Materials[static_cast<std::size_t>(k)].Value < wanted; });
  const bool known = place != this->ByValue.end() &&
                     this->Materials[static_cast<std::size_t>(*place)].Value == value;
  return known ? *place : -1;
}

//------------------------------------------------------------------------------
double vtkMaterialMap::GetWeight(int index, double value)
{
  const Material* material = this->Find(index, nullptr);
  if (!material || std::isnan(value))
  {
    return 0.0;
  }
  if (this->Mode == CLASSES || value == material->Value)
  {
    return value == material->Value ? 1.0 : 0.0;
  }
  // The next material towards the value; none: this one is alone.
  const auto place = std::find(this->ByValue.begin(), this->ByValue.end(), index);
  const bool above = value > material->Value;
  if (above ? place + 1 == this->ByValue.end() : place == this->ByValue.begin())
  {
    return 1.0;
  }
  const int next = above ? *(place + 1) : *(place - 1);
  const double distance = this->GetValue(next) - material->Value;
  return std::max(1.0 - (value - material->Value) / distance, 0.0);
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
