// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BadVertices.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cmath>
#include <vector>

namespace measuredbrdf
{
namespace
{
// Whether the values are finite, and, as a direction, of a length.
template <typename T>
bool IsGood(const T* values, int count, bool isDirection)
{
  T sum = 0;
  bool any = false;
  for (int c = 0; c < count; ++c)
  {
    sum += values[c] * T(0); // NaN where a value is not finite
    any = any || values[c] != T(0);
  }
  return sum == T(0) && (any || !isDirection);
}

vtkIdType CountBad(vtkDataArray* array, bool isDirection)
{
  vtkIdType bad = 0;
  const vtkIdType count = array ? array->GetNumberOfTuples() : 0;
  const int components = array ? array->GetNumberOfComponents() : 0;
  auto* floats = vtkFloatArray::FastDownCast(array);
  auto* doubles = vtkDoubleArray::FastDownCast(array);
  std::vector<double> tuple(static_cast<std::size_t>(components));
  for (vtkIdType k = 0; k < count; ++k)
  {
    bool good;
    if (floats)
    {
      good = IsGood(floats->GetPointer(k * components), components, isDirection);
    }
    else if (doubles)
    {
      good = IsGood(doubles->GetPointer(k * components), components, isDirection);
    }
    else
    {
      array->GetTuple(k, tuple.data());
      good = IsGood(tuple.data(), components, isDirection);
    }
    bad += good ? 0 : 1;
  }
  return bad;
}
}

BadVertices::BadVertices(vtkPolyData* surface)
  : Tangents(CountBad(surface->GetPointData()->GetTangents(), false))
  , TextureCoordinates(CountBad(surface->GetPointData()->GetTCoords(), false))
  , Points(surface->GetPoints() ? CountBad(surface->GetPoints()->GetData(), false) : 0)
{
  vtkDataArray* normals = surface->GetPointData()->GetNormals();
  this->Normals = CountBad(normals ? normals : surface->GetCellData()->GetNormals(), true);
}

std::string BadVertices::GetText() const
{
  std::string text;
  const auto add = [&text](vtkIdType count, const char* words)
  {
    if (count > 0)
    {
      text += (text.empty() ? "" : "; ") + std::to_string(count) + words;
    }
  };
  add(this->Normals,
    " of the surface's normals are not finite or have no length: facets there have their own");
  add(this->Tangents, " of its tangents are not finite: any direction is taken there");
  add(this->TextureCoordinates, " of its texture coordinates are not finite");
  add(this->Points, " of its points are not finite: their polygons are not drawn");
  return text;
}
} // namespace measuredbrdf
