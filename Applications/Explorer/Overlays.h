// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What lies over and behind the mesh in the picture: images, the legend of errors, the sky.
 */

#ifndef Overlays_h
#define Overlays_h

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkSmartPointer.h"

class vtkFloatArray;
class vtkImageData;
class vtkPoints;
class vtkRenderer;
class vtkScalarBarActor;
class vtkTexture;
class vtkTexturedActor2D;

namespace explorer
{
/// An image of the whole view, of which a vertical strip is shown.
class ImageQuad
{
public:
  explicit ImageQuad(vtkRenderer* renderer);
  ~ImageQuad();
  ImageQuad(const ImageQuad&) = delete;
  void operator=(const ImageQuad&) = delete;

  /// RGBA of unsigned char, any size; null: none.
  void SetImage(vtkImageData* image);
  bool HasImage() const { return this->Filled; }

  /// The strip's ends, shares of the view's width.
  void SetSpan(double begin, double end);

  /// Whether the image, where there is one, is shown.
  void SetVisible(bool visible);

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkFloatArray> Coordinates;
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkTexture> Texture;
  vtkNew<vtkTexturedActor2D> Actor;
  bool Filled = false;
};

/// Points of the data are shares of the view's width and height.
vtkSmartPointer<vtkPolyDataMapper2D> MakeViewportMapper(vtkPolyData* data);

/// Of tool::MakeErrorColors, in percent, at the bottom of the view.
vtkSmartPointer<vtkScalarBarActor> MakeErrorLegend();

/// The sphere of all directions of an environment, with its texture coordinates.
vtkSmartPointer<vtkPolyData> MakeSky();
} // namespace explorer

#endif
