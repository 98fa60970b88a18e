// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEmbeddedMaterials.h"

#include "EmbeddedCarPaint.h" // made of EmbeddedCarPaint.exr
#include "EmbeddedFits.h"     // made of EmbeddedFits.fit
#include "MaterialFormat.h"
#include "Printable.h"
#include "Registry.h"
#include "vtkBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <vector>

vtkStandardNewMacro(vtkEmbeddedMaterials);

namespace
{
struct Material
{
  const char* Name; // in EmbeddedFits.fit, or CarPaint
  const char* Kind;
};

// The measurement, whose file names its source.
const char* const CarPaint = "blue-car-paint";

const std::vector<Material> Materials = {
  { "blue-fabric", "fabric" },
  { "pink-fabric2", "fabric" },
  { "gold-metallic-paint3", "metallic paint" },
  { "gold-paint", "paint" },
  { "green-metallic-paint", "metallic paint" },
  { "violet-rubber", "rubber" },
  { "red-fabric2", "fabric" },
  { "nickel", "metal" },
  { "chrome", "metal" },
  { "brass", "metal" },
  { "alum-bronze", "metal" },
  { "silver-metallic-paint", "metallic paint" },
  { "gold-metallic-paint", "metallic paint" },
  { "blue-metallic-paint", "metallic paint" },
  { "delrin", "plastic" },
  { "pvc", "plastic" },
  { "yellow-matte-plastic", "plastic" },
  { "violet-acrylic", "plastic" },
  { "blue-rubber", "rubber" },
  { "pink-felt", "felt" },
  { "white-marble", "stone" },
  { "hematite", "stone" },
  { "cherry-235", "wood" },
  { CarPaint, "car paint" },
};

vtkSmartPointer<vtkBRDF> MakeMaterial(const std::string& name)
{
  if (name == CarPaint)
  {
    const auto file = measuredbrdf::FileBytes::View("embedded " + name,
      std::string_view(reinterpret_cast<const char*>(EmbeddedCarPaint), sizeof(EmbeddedCarPaint)));
    return measuredbrdf::ExrMaterialFormat.Read(file, "").BRDF;
  }
  const auto fits = measuredbrdf::FileBytes::View("embedded materials", EmbeddedFits);
  const vtkSmartPointer<vtkBRDF> brdf = measuredbrdf::FitFormat.Read(fits, name).BRDF;
  brdf->SetSource("MERL sample " + name + ", " + brdf->GetSource());
  return brdf;
}
}

//------------------------------------------------------------------------------
int vtkEmbeddedMaterials::GetNumberOfMaterials() { return static_cast<int>(Materials.size()); }

//------------------------------------------------------------------------------
std::string vtkEmbeddedMaterials::GetName(int index)
{
  return index >= 0 && index < GetNumberOfMaterials() ? Materials[index].Name : "";
}

//------------------------------------------------------------------------------
std::string vtkEmbeddedMaterials::GetKind(int index)
{
  return index >= 0 && index < GetNumberOfMaterials() ? Materials[index].Kind : "";
}

//------------------------------------------------------------------------------
std::string vtkEmbeddedMaterials::GetSource(int index)
{
  if (index < 0 || index >= GetNumberOfMaterials())
  {
    return "";
  }
  return MakeMaterial(Materials[index].Name)->GetSource();
}

//------------------------------------------------------------------------------
vtkBRDF* vtkEmbeddedMaterials::NewBRDF(const std::string& name)
{
  const bool known = std::any_of(Materials.begin(), Materials.end(),
    [&](const Material& material) { return name == material.Name; });
  if (!known)
  {
    const vtkNew<vtkEmbeddedMaterials> self; // an object to complain
    vtkErrorWithObjectMacro(self.Get(),
      "NewBRDF: there is no embedded material "
        << measuredbrdf::Quote(name) << ", only "
        << measuredbrdf::JoinNames(
             Materials, [](const Material& material) { return measuredbrdf::Quote(material.Name); })
        << ".");
    return nullptr;
  }
  const vtkSmartPointer<vtkBRDF> brdf = MakeMaterial(name);
  brdf->Register(nullptr); // the caller's
  return brdf;
}

//------------------------------------------------------------------------------
void vtkEmbeddedMaterials::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfMaterials: " << GetNumberOfMaterials() << "\n";
}
