// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Materials of one shader as one material, of which each fragment chooses its own by a number.
 * Private to the rendering room.
 *
 * Tables lie in one texture (StackedTables.h), numbers that differ in a small one. What all have
 * in common stays as it is.
 */

#ifndef ClassStack_h
#define ClassStack_h

#include "DrawnMaterial.h"
#include "vtkBRDFShaderInputs.h"

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;

namespace measuredbrdf
{
/// In GLSL. Terms of the material and of the radiance may have the same INSTANCE.
struct StackNames
{
  std::string Number;  // global variable that holds the material's number
  std::string Texture; // of numbers that differ, without INSTANCE
};

/// One term of each of several materials, of the same shader, as one. mostTexels: of a side of a 2D
/// texture and of a 3D one. load: statements that fill the variables that differ. Returns false
/// where the texts or tables do not allow that. The text is that of terms.front().
bool StackTerms(const std::vector<const vtkBRDFShaderInputs::Term*>& terms, const StackNames& names,
  const std::array<int, 2>& mostTexels, vtkBRDFShaderInputs::Term& stacked, std::string& load);

class ClassStack
{
public:
  /// Same key: it is worth trying to stack these.
  static std::string GetKey(const DrawnMaterial& drawn);

  /// Same shape: tables are of one size, so that no memory is lost.
  static std::string GetShape(const DrawnMaterial& drawn);

  /// Returns whether the materials could be stacked; they are of the same key. numbers: that of the
  /// material of each class, from firstClass on; -1: drawn elsewhere. hasOthers: whether polygons
  /// have corners of classes that are drawn elsewhere.
  bool Build(const DrawnMaterials& materials, int firstClass, const std::vector<int>& numbers,
    bool hasOthers, vtkOpenGLRenderWindow* window);

  /// To be drawn in place of all of them.
  const DrawnMaterial& Get() const { return this->Drawn; }

  bool IsIn(vtkOpenGLRenderWindow* window) const;

  /// GLSL that chooses the material: declarations; statements, before the material is evaluated,
  /// that read the class from the float brdfClassHere.
  const std::string& GetDeclarations() const { return this->Declarations; }
  const std::string& GetChoice() const { return this->Choice; }

private:
  using GetForm = std::function<bool(const DrawnMaterial&, vtkBRDFShaderInputs&)>;
  bool BuildForm(const DrawnMaterials& materials, const GetForm& getForm, const StackNames& names,
    vtkOpenGLRenderWindow* window, std::shared_ptr<FormTextures>& textures);

  DrawnMaterial Drawn;
  std::string Declarations;
  std::string Choice;
};
} // namespace measuredbrdf

#endif
