// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Materials as one material, of which each fragment chooses its own by a number (StackedTerms.h).
 * Private to the rendering room.
 */

#ifndef ClassStack_h
#define ClassStack_h

#include "DrawnMaterial.h"

#include <string>
#include <vector>

class vtkOpenGLRenderWindow;

namespace measuredbrdf
{
class ClassStack
{
public:
  /// Same key: it is worth trying to stack these.
  static std::string GetKey(const DrawnMaterial& drawn);

  /// Same kind: these are of one shader, and need no more texture units than one of them.
  static std::string GetKind(const DrawnMaterial& drawn);

  /// Same shape: tables are of one size, so that no memory is lost.
  static std::string GetShape(const DrawnMaterial& drawn);

  /// Returns whether the materials could be stacked; they are of the same key. numbers: that of the
  /// material of each class, from firstClass on; -1: drawn elsewhere. hasOthers: whether polygons
  /// have corners of classes that are drawn elsewhere.
  bool Build(const DrawnMaterials& materials, int firstClass, const std::vector<int>& numbers,
    bool hasOthers, vtkOpenGLRenderWindow* window);

  /// To be drawn in place of all of them.
  const DrawnMaterial& Get() const { return this->Drawn; }

  /// Whether the textures are the window's, and its texture units suffice, of which others take
  /// some: images of actors, shadow maps.
  bool Fits(vtkOpenGLRenderWindow* window) const;

  /// GLSL that chooses the material: declarations; statements, before the material is evaluated,
  /// that read the class from the float brdfClassHere.
  const std::string& GetDeclarations() const { return this->Declarations; }
  const std::string& GetChoice() const { return this->Choice; }

private:
  bool StackForms(const DrawnMaterials& materials, vtkOpenGLRenderWindow* window);

  DrawnMaterial Drawn;
  std::size_t Samplers = 0;
  std::string Declarations;
  std::string Choice;
};
} // namespace measuredbrdf

#endif
