// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The weights of a material map's images, texel by texel.
 */

#ifndef WeightTexels_h
#define WeightTexels_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkMaterialMap;

namespace measuredbrdf
{
/// What keeps a map from having weights for each texel; "" if nothing.
std::string FindWeightProblem(vtkMaterialMap* map);

/// The map must have no such problem, and must not change meanwhile.
class WeightTexels
{
public:
  explicit WeightTexels(vtkMaterialMap* map);

  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  vtkIdType GetNumberOfTexels() const { return vtkIdType(this->Width) * this->Height; }

  /// The materials' weights there, divided by their sum as vtkMaterialMap has it; all 0 where none
  /// is positive. Any number of threads may ask.
  void Get(vtkIdType texel, double* weights) const;

private:
  struct Image
  {
    vtkSmartPointer<vtkDataArray> Values;
    double Divisor;
  };
  std::vector<Image> Images;
  int Materials = 0;
  int Width = 0;
  int Height = 0;
};
} // namespace measuredbrdf

#endif
