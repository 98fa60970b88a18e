// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material in a frame, those that primitives are being drawn with, and what mappers report of the
 * last frame.
 */

#ifndef DrawnMaterial_h
#define DrawnMaterial_h

#include "ShaderTextures.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// What a material is drawn with in one renderer.
struct DrawnMaterial
{
  vtkBRDF* Source = nullptr;                         // the material, only compared
  vtkSmartPointer<vtkBRDF> BRDF;                     // the material or, of a plan, its snapshot
  vtkSmartPointer<vtkRadianceIntegrator> Integrator; // of the environment's light; null: none
  vtkSmartPointer<vtkEnvironment> Environment;       // the one whose rotation applies
  std::shared_ptr<ShaderTextures> Material; // null where the shader has no use for the BRDF itself
  std::shared_ptr<ShaderTextures> Radiance; // null without environment
  vtkSmartPointer<vtkRadiancePlanner> Plan; // null without one
  std::string Key;                          // same key, same shader text
  bool IsReady = false;                     // else the superclass draws
};

using DrawnMaterials = std::vector<const DrawnMaterial*>;

/// The plans, a line each.
std::string DescribePlans(const DrawnMaterials& materials);

/// A line on the predicted error of a surface of several materials; "" if it is negative.
std::string DescribeMixture(double error);

/// Of the textures in use that are not counted yet.
vtkIdType CountTextureBytes(
  const DrawnMaterials& materials, std::set<const vtkTextureObject*>& counted);

/// What get finds of the first material that has it; null where none has.
template <typename Get>
auto FindFirst(const DrawnMaterials& materials, const Get& get) -> decltype(get(*materials.front()))
{
  for (const DrawnMaterial* drawn : materials)
  {
    if (auto* found = get(*drawn))
    {
      return found;
    }
  }
  return nullptr;
}
/// What the fragment shader needs to mix materials.
struct MixtureText
{
  std::string Declarations;
  std::string Implementation;
  std::vector<int> Slots; // of the materials' weights; none: there is one material
};

class SelectedMaterials
{
public:
  /// These from now on, mixed as the text says where there are several; their textures are bound.
  /// None where one of them is not ready.
  void Set(const DrawnMaterials& materials, MixtureText text);
  void Clear();

  const DrawnMaterials& Get() const { return this->Materials; }
  bool IsEmpty() const { return this->Materials.empty(); }

  /// How they are mixed.
  const MixtureText& GetMixture() const { return this->Mixture; }

  /// Same key, same shader text.
  std::string GetKey() const;

  bool AreAnyAnisotropic() const;

private:
  DrawnMaterials Materials;
  std::vector<ShaderTextures*> Textures; // of the materials, those that several share once
  MixtureText Mixture;
};
} // namespace measuredbrdf

#endif
