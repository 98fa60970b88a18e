// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material in a frame, and what mappers report of the last frame.
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
} // namespace measuredbrdf

#endif
