// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Borders between classes of points, drawn at once. Private to
 * the rendering room.
 *
 * Where all classes that meet in a polygon are in one ClassStack, the polygon is drawn once, and
 * each pixel finds its material. Elsewhere it is drawn for each class, which discards the others'
 * pixels.
 */

#ifndef ClassStacks_h
#define ClassStacks_h

#include "ClassStack.h"
#include "vtkType.h"

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <unordered_map>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace measuredbrdf
{
/// A class where it meets others.
struct ClassBorder
{
  int Class = 0;
  const std::vector<vtkIdType>* Polygons = nullptr; // numbers of its polygons
};

class ClassStacks
{
public:
  /// Whether these are the materials that the stacks were made of, and the stacks can be drawn.
  bool IsOf(const DrawnMaterials& materials, vtkOpenGLRenderWindow* window) const;

  /// Bring up to date; materials: of each border. hasOthers: whether polygons have corners of
  /// classes that are no borders here, because they have no material. Returns whether anything
  /// changed.
  bool Update(const std::vector<ClassBorder>& borders, const DrawnMaterials& materials,
    bool hasOthers, vtkOpenGLRenderWindow* window);

  void Clear();

  const std::vector<std::unique_ptr<ClassStack>>& Get() const { return this->Stacks; }

  /// Of the stacks' textures that are not counted yet.
  std::size_t CountBytes(std::set<const vtkTextureObject*>& counted) const;

  /// Whether stacks draw less than half of the polygons.
  bool AreMostLoose() const { return this->MostLoose; }

  /// The stack that draws a polygon; -1: none does.
  int FindStack(vtkIdType polygon) const
  {
    const auto found = this->StackOfPolygon.find(polygon);
    return found == this->StackOfPolygon.end() ? -1 : found->second;
  }

private:
  using Classes = std::map<int, const DrawnMaterial*>;

  // Returns whether these could be stacked.
  bool Add(const Classes& classes, bool hasOthers, vtkOpenGLRenderWindow* window);

  // All of one key or, where that cannot be, as many kinds as can; of a kind, all of one shape.
  void Group(const std::vector<ClassBorder>& borders, const DrawnMaterials& materials,
    bool hasOthers, vtkOpenGLRenderWindow* window);
  using Kind = std::map<std::string, Classes>; // by shape
  void AddKinds(std::vector<const Kind*> kinds, bool hasOthers, vtkOpenGLRenderWindow* window);
  void Distribute(const std::vector<ClassBorder>& borders);

  // What a stack was made of; a text that changes has new textures or a new time.
  using Origin =
    std::tuple<bool, const void*, vtkMTimeType, const void*, vtkMTimeType, const void*>;
  static Origin GetOrigin(const DrawnMaterial& drawn);

  std::vector<Origin> Known;
  const void* Window = nullptr; // only compared
  std::vector<std::unique_ptr<ClassStack>> Stacks;
  bool MostLoose = false;
  std::map<int, int> StackOfClass;
  std::vector<int> StackOf;                          // of each border; -1: none
  std::unordered_map<vtkIdType, int> StackOfPolygon; // -1: none
};
} // namespace measuredbrdf

#endif
