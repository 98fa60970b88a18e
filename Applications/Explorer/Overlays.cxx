// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Overlays.h"

#include "Picture.h"

#include "vtkCellArray.h"
#include "vtkCoordinate.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkProperty2D.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTexturedActor2D.h"

#include <cmath>

namespace explorer
{
//------------------------------------------------------------------------------
ImageQuad::ImageQuad(vtkRenderer* renderer)
{
  this->Points->SetNumberOfPoints(4);
  this->Coordinates->SetNumberOfComponents(2);
  this->Coordinates->SetNumberOfTuples(4);
  vtkNew<vtkCellArray> cells;
  const vtkIdType corners[4] = { 0, 1, 2, 3 };
  cells->InsertNextCell(4, corners);
  this->Data->SetPoints(this->Points);
  this->Data->SetPolys(cells);
  this->Data->GetPointData()->SetTCoords(this->Coordinates);
  this->Texture->SetColorModeToDirectScalars();
  this->Texture->InterpolateOn();
  this->Actor->SetMapper(MakeViewportMapper(this->Data));
  this->Actor->SetTexture(this->Texture);
  this->Actor->SetLayerNumber(0);
  this->Actor->VisibilityOff();
  this->SetSpan(0.0, 1.0);
  renderer->AddViewProp(this->Actor);
}

//------------------------------------------------------------------------------
ImageQuad::~ImageQuad() = default;

//------------------------------------------------------------------------------
void ImageQuad::SetImage(vtkImageData* image)
{
  this->Filled = image != nullptr;
  if (image)
  {
    this->Texture->SetInputData(image);
  }
}

//------------------------------------------------------------------------------
void ImageQuad::SetSpan(double begin, double end)
{
  const double corners[4][2] = { { begin, 0.0 }, { end, 0.0 }, { end, 1.0 }, { begin, 1.0 } };
  for (int k = 0; k < 4; ++k)
  {
    this->Points->SetPoint(k, corners[k][0], corners[k][1], 0.0);
    this->Coordinates->SetTuple(k, corners[k]);
  }
  this->Points->Modified();
  this->Coordinates->Modified();
  this->Data->Modified();
}

//------------------------------------------------------------------------------
void ImageQuad::SetVisible(bool visible) { this->Actor->SetVisibility(visible && this->Filled); }

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyDataMapper2D> MakeViewportMapper(vtkPolyData* data)
{
  vtkNew<vtkCoordinate> coordinate;
  coordinate->SetCoordinateSystemToNormalizedViewport();
  auto mapper = vtkSmartPointer<vtkPolyDataMapper2D>::New();
  mapper->SetInputData(data);
  mapper->SetTransformCoordinate(coordinate);
  return mapper;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkScalarBarActor> MakeErrorLegend()
{
  auto legend = vtkSmartPointer<vtkScalarBarActor>::New();
  vtkNew<vtkLookupTable> table;
  const auto colors = tool::MakeErrorColors();
  constexpr int entries = 256;
  table->SetNumberOfTableValues(entries);
  table->SetScaleToLog10();
  table->SetTableRange(std::pow(10.0, tool::LowestError + 2.0), 100.0); // percent
  for (int k = 0; k < entries; ++k)
  {
    double rgb[3];
    colors->GetColor(
      tool::LowestError + (tool::HighestError - tool::LowestError) * (k + 0.5) / entries, rgb);
    table->SetTableValue(k, rgb[0], rgb[1], rgb[2]);
  }
  legend->SetLookupTable(table);
  legend->SetTitle("error, % of mean");
  legend->SetNumberOfLabels(4);
  legend->SetLabelFormat("%g");
  legend->SetUnconstrainedFontSize(true);
  legend->GetLabelTextProperty()->SetFontSize(14);
  legend->GetTitleTextProperty()->SetFontSize(14);
  for (vtkTextProperty* text : { legend->GetLabelTextProperty(), legend->GetTitleTextProperty() })
  {
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
  }
  legend->SetOrientationToHorizontal();
  legend->SetTextPositionToPrecedeScalarBar(); // the labels below the bar, the title below them
  legend->SetPosition(0.25, 0.02);
  legend->SetPosition2(0.5, 0.12);
  legend->DrawBackgroundOn();
  legend->GetBackgroundProperty()->SetColor(0.16, 0.165, 0.175);
  legend->GetBackgroundProperty()->SetOpacity(0.8);
  return legend;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSky()
{
  constexpr int columns = 96;
  constexpr int rows = 48;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> quads;
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (int y = 0; y <= rows; ++y)
  {
    for (int x = 0; x <= columns; ++x)
    {
      const double u = static_cast<double>(x) / columns;
      const double v = static_cast<double>(y) / rows;
      double direction[3];
      vtkEnvironment::GetDirection(u, v, direction);
      points->InsertNextPoint(direction);
      coordinates->InsertNextTuple2(u, v);
      if (x < columns && y < rows)
      {
        const vtkIdType corner = y * (columns + 1) + x;
        const vtkIdType quad[4] = { corner, corner + 1, corner + columns + 2,
          corner + columns + 1 };
        quads->InsertNextCell(4, quad);
      }
    }
  }
  auto sky = vtkSmartPointer<vtkPolyData>::New();
  sky->SetPoints(points);
  sky->SetPolys(quads);
  sky->GetPointData()->SetTCoords(coordinates);
  return sky;
}
} // namespace explorer
