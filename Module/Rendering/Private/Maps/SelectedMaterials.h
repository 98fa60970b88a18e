// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The materials that primitives are being drawn with.
 */

#ifndef SelectedMaterials_h
#define SelectedMaterials_h

#include "DrawnMaterial.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
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
