// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a pixel's cost is measured on. Private to the rendering room and its benchmarks.
 */

#ifndef SquareLayers_h
#define SquareLayers_h

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cmath>

namespace measuredbrdf
{
/// Layers of a rectangle 2 high and 2 width wide, each nearer than the one before, so that all are
/// shaded; with the normals of a sphere's front, so that neighbors fetch what neighbors do.
inline vtkSmartPointer<vtkPolyData> MakeSquareLayers(int layers, double width = 1.0)
{
  constexpr int divisions = 16; // so that normals vary
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkCellArray> cells;
  normals->SetNumberOfComponents(3);
  for (int layer = 0; layer < layers; ++layer)
  {
    const vtkIdType first = points->GetNumberOfPoints();
    for (int k = 0; k < (divisions + 1) * (divisions + 1); ++k)
    {
      const double x = 2.0 * (k % (divisions + 1)) / divisions - 1.0;
      const double y = 2.0 * (k / (divisions + 1)) / divisions - 1.0;
      points->InsertNextPoint(width * x, y, static_cast<double>(layer) / layers);
      normals->InsertNextTuple3(0.7 * x, 0.7 * y, std::sqrt(1.0 - 0.49 * (x * x + y * y)));
    }
    for (vtkIdType k = 0; k < divisions * divisions; ++k)
    {
      const vtkIdType corner = first + k / divisions * (divisions + 1) + k % divisions;
      const vtkIdType quad[] = { corner, corner + 1, corner + divisions + 2,
        corner + divisions + 1 };
      cells->InsertNextCell(4, quad);
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->GetPointData()->SetNormals(normals);
  surface->SetPolys(cells);
  return surface;
}
} // namespace measuredbrdf

#endif
