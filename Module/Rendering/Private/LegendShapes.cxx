// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LegendShapes.h"

#include "vtkCellArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkTextActor.h"

#include <algorithm>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr double SphereShare = 0.5;  // of an entry's width, at most
constexpr double NarrowShare = 0.25; // the same in several columns
}

LegendGrid LegendGrid::Find(int count, double width, double height, bool horizontal)
{
  LegendGrid best;
  for (int lines = 1; lines <= count; ++lines) // columns, or rows where they stand side by side
  {
    const int others = (count + lines - 1) / lines;
    LegendGrid grid;
    grid.Columns = horizontal ? others : lines;
    grid.Rows = horizontal ? lines : others;
    grid.Width = width / grid.Columns;
    grid.Height = height / grid.Rows;
    grid.Sphere =
      (1.0 - LegendGap) *
      (horizontal ? std::min(grid.Width, (1.0 - LegendNameShare) * grid.Height)
                  : std::min((lines > 1 ? NarrowShare : SphereShare) * grid.Width, grid.Height));
    best = grid.Sphere > best.Sphere ? grid : best;
  }
  return best;
}

LegendRectangle::LegendRectangle(bool filled)
{
  this->Points->SetNumberOfPoints(4);
  const vtkIdType ids[5] = { 0, 1, 2, 3, 0 };
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(filled ? 4 : 5, ids);
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(this->Points);
  if (filled)
  {
    shape->SetPolys(cells);
  }
  else
  {
    shape->SetLines(cells);
  }
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shape);
  this->Actor->SetMapper(mapper);
}

void LegendRectangle::Place(double left, double bottom, double right, double top)
{
  const double corners[4][2] = { { left, bottom }, { right, bottom }, { right, top },
    { left, top } };
  for (vtkIdType k = 0; k < 4; ++k)
  {
    this->Points->SetPoint(k, corners[k][0], corners[k][1], 0.0);
  }
  this->Points->Modified();
}

LegendSphere::LegendSphere()
{
  const float corners[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
  this->Coordinates->SetNumberOfComponents(2);
  for (const float* corner : corners)
  {
    this->Points->InsertNextPoint(0.0, 0.0, 0.0);
    this->Coordinates->InsertNextTuple(corner);
  }
  const vtkIdType ids[4] = { 0, 1, 2, 3 };
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell(4, ids);
  vtkNew<vtkPolyData> square;
  square->SetPoints(this->Points);
  square->SetPolys(polygons);
  square->GetPointData()->SetTCoords(this->Coordinates);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(square);
  this->Texture->InterpolateOn();
  this->Texture->SetColorModeToDirectScalars();
  this->Actor->SetMapper(mapper);
  this->Actor->SetTexture(this->Texture);
}

void LegendSphere::Place(double x, double y, double size)
{
  const double corners[4][2] = { { x, y }, { x + size, y }, { x + size, y + size },
    { x, y + size } };
  for (vtkIdType k = 0; k < 4; ++k)
  {
    this->Points->SetPoint(k, corners[k][0], corners[k][1], 0.0);
  }
  this->Points->Modified();
  this->Points->GetData()->Modified();
}

void CutToWidth(vtkTextActor* actor, const std::string& text, vtkViewport* viewport, double width)
{
  double size[2];
  for (std::size_t length = text.size();; --length)
  {
    while (length > 0 && length < text.size() && (text[length] & 0xC0) == 0x80)
    {
      --length; // within a character of UTF-8
    }
    actor->SetInput((length == text.size() ? text : text.substr(0, length) + "...").c_str());
    actor->GetSize(viewport, size);
    if (size[0] <= width || length == 0)
    {
      return;
    }
  }
}
} // namespace measuredbrdf
