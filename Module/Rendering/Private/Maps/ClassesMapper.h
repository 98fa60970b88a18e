// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws all parts of a divided surface that show a single material each.
 *
 * They have the points and the shaders in common. So a further class costs its textures, the
 * numbers in which it differs from the last one, and a draw call, but not what VTK sets for each
 * mapper.
 */

#ifndef ClassesMapper_h
#define ClassesMapper_h

#include "DrawnMaterial.h"
#include "PartMapper.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

class vtkOpenGLHelper;
class vtkOpenGLIndexBufferObject;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace measuredbrdf
{
class ClassesMapper : public PartMapper
{
public:
  static ClassesMapper* New();
  vtkTypeMacro(ClassesMapper, PartMapper);

  /// Whether this mapper can draw an actor's surface: filled polygons, no vertices.
  static bool CanDraw(vtkActor* actor);

  /// Whether it can draw a part.
  static bool IsSingle(const MaterialPart& part);

  /// Draw these from now on: numbers of single parts of all that a map makes.
  void SetParts(
    const MaterialParts* parts, const std::vector<std::size_t>& numbers, vtkMaterialMap* map);

  void RenderPieceDraw(vtkRenderer* ren, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  ClassesMapper();
  ~ClassesMapper() override;

  void BuildIBO(vtkRenderer* ren, vtkActor* actor, vtkPolyData* surface) override;
  void UpdateShaders(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  void ShowOnly(int material) override;
  int GetSlot() const override { return this->Slot; }
  bool HasWeights() const override { return this->Slot >= 0; }

private:
  ClassesMapper(const ClassesMapper&) = delete;
  void operator=(const ClassesMapper&) = delete;

  struct Class
  {
    vtkSmartPointer<vtkPolyData> Surface;
    vtkSmartPointer<vtkOpenGLIndexBufferObject> Indices; // of its triangles
    int FirstPrimitive = 0;                              // counted over all classes
    int Slot = -1;                                       // of a border between classes
  };

  // Deletes OpenGL objects in the window that they are in, whichever is current.
  template <typename Release>
  void InOwnWindow(const Release& release);
  void ReleaseIndices();
  void UseShadersOf(const std::string& key);
  void DropShaders(vtkWindow* window);
  bool FollowOn(vtkShaderProgram* program);

  std::vector<Class> Classes;
  int Slot = -1;                                   // of the class that is shown
  bool AreBuilt = false;                           // the classes' indices
  vtkWeakPointer<vtkOpenGLRenderWindow> OwnWindow; // in which they and the shaders are
  vtkOpenGLIndexBufferObject* Whole = nullptr;     // the superclass's, while a class is shown
  // What the superclass keeps for shaders that are not in use now; the key of the one that is.
  std::map<std::string, std::unique_ptr<vtkOpenGLHelper>> OtherShaders;
  std::string ShadersInUse;
  const DrawnMaterial* Last = nullptr; // whose numbers the program has; null: all are to be set
  bool WasOfBorder = false;            // the same
};
} // namespace measuredbrdf

#endif
