// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The drawings of all mappers that there are, so that one can plan for the others of a renderer.
 * Private to the rendering room.
 */

#ifndef Drawings_h
#define Drawings_h

#include <map>
#include <mutex>

class vtkObject;

namespace measuredbrdf
{
class MaterialDrawing;

/// Any thread may call these methods.
class Drawings
{
public:
  static Drawings& Get();

  void Add(vtkObject* mapper, MaterialDrawing* drawing);
  void Remove(vtkObject* mapper, MaterialDrawing* drawing);

  /// Null: the mapper draws no materials.
  MaterialDrawing* Find(vtkObject* mapper);

private:
  std::mutex Mutex;
  std::map<vtkObject*, MaterialDrawing*> ByMapper;
};
} // namespace measuredbrdf

#endif
