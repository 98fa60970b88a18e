// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What vtkMaterialLegendActor consists of on the screen. Private to the rendering component.
 */

#ifndef LegendShapes_h
#define LegendShapes_h

#include "vtkActor2D.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkTexture.h"
#include "vtkTexturedActor2D.h"

#include <string>

class vtkTextActor;
class vtkViewport;

namespace measuredbrdf
{
/// Of a legend's entries: between them, as a share of their size; and of an entry's height, for a
/// name below its sphere.
constexpr double LegendGap = 0.06;
constexpr double LegendNameShare = 0.25;

/// How entries are laid out: in equal cells, in pixels.
struct LegendGrid
{
  int Columns = 1;
  int Rows = 1;
  double Width = 0.0; // of a cell
  double Height = 0.0;
  double Sphere = 0.0; // diameter

  /// The one with the largest spheres.
  static LegendGrid Find(int count, double width, double height, bool horizontal);
};

/// A rectangle in pixels, filled or its edges.
struct LegendRectangle
{
  explicit LegendRectangle(bool filled);
  void Place(double left, double bottom, double right, double top);

  vtkNew<vtkPoints> Points;
  vtkNew<vtkActor2D> Actor;
};

/// A square with a texture.
struct LegendSphere
{
  LegendSphere();
  void Place(double x, double y, double size);

  vtkNew<vtkPoints> Points;
  vtkNew<vtkFloatArray> Coordinates;
  vtkNew<vtkTexture> Texture;
  vtkNew<vtkTexturedActor2D> Actor;
};

/// As much of a text as is not wider, with dots where some is missing.
void CutToWidth(vtkTextActor* actor, const std::string& text, vtkViewport* viewport, double width);
} // namespace measuredbrdf

#endif
