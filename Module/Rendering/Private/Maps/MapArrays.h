// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An array that a material map reads. Private to the rendering room.
 */

#ifndef MapArrays_h
#define MapArrays_h

#include "vtkDataArray.h"

#include <string>

class vtkMaterialMap;
class vtkPolyData;

namespace measuredbrdf
{
class MapArray
{
public:
  ///@{
  /// The array of classes or values; of a material's weights. Returns why there is none, or "".
  std::string Find(vtkPolyData* input, vtkMaterialMap* map);
  std::string FindWeights(vtkPolyData* input, vtkMaterialMap* map, int material);
  ///@}

  /// Whether an array is among those that the map reads of this surface.
  static bool IsRead(vtkPolyData* input, vtkMaterialMap* map, vtkAbstractArray* array);

  bool IsOfCells() const { return this->OfCells; }
  double Get(vtkIdType tuple) const { return this->Array->GetComponent(tuple, this->Component); }
  vtkDataArray* GetArray() const { return this->Array; }

private:
  std::string Check(int component, vtkIdType tuples, const std::string& name);

  vtkDataArray* Array = nullptr;
  int Component = 0;
  bool OfCells = false;
};
} // namespace measuredbrdf

#endif
