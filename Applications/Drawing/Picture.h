// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures in linear light on the CPU: composing, tone mapping, text with VTK's own font, the
 * colors of errors, writing.
 */

#ifndef Picture_h
#define Picture_h

#include "SRGB.h"

#include "vtkColorTransferFunction.h"
#include "vtkEnvironment.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

class vtkImageData;

namespace tool
{
using RGB = glm::dvec3;

/// Linear RGBA (color not multiplied by alpha), row 0 at the bottom.
struct Picture
{
  Picture(int width, int height)
    : Width(width)
    , Height(height)
    , Pixels(4 * static_cast<std::size_t>(width) * height, 0.0f)
  {
  }

  glm::vec4& At(int x, int y)
  {
    return reinterpret_cast<glm::vec4&>(
      this->Pixels[4 * (static_cast<std::size_t>(y) * this->Width + x)]);
  }
  const glm::vec4& At(int x, int y) const { return const_cast<Picture*>(this)->At(x, y); }

  /// Cover the pixel's color by rgb, by a share alpha. Outside the picture: nothing.
  void Blend(int x, int y, const RGB& rgb, double alpha);

  int Width;
  int Height;
  std::vector<float> Pixels;
};

/**
 * Linear light -> display light in [0,1]: as it is up to 0.7, above it rolled off smoothly, so that
 * highlights keep their shape; 1 is only reached in the limit.
 */
double RollOff(double linear);

/// The display value in [0,1] of display light as the mapper writes it: linear^(1/2.2).
double EncodeGamma(double linear);

/// The same as sRGB displays take it.
using measuredbrdf::EncodeSRGB;

/// Mean of factor x factor blocks.
Picture Downsample(const Picture& picture, int factor);

///@{
/**
 * Write RGB as 8-bit PNG (encode: display light in [0,1] -> code in [0,1]), or RGBA as 32-bit float
 * OpenEXR. Whole or not at all; throws Error.
 */
void WritePNG(const std::string& path, const Picture& picture, double (*encode)(double));
void WritePNG(const std::string& path, vtkImageData* image); // as it is
void WriteEXR(const std::string& path, const Picture& picture);
///@}

/// What is seen behind a mesh: an environment, darker or brighter than it is.
struct Backdrop
{
  vtkSmartPointer<vtkEnvironment> Environment;
  double Factor = 1.0;

  /// Radiance in a direction of the environment's frame, interpolated between its texels.
  RGB Look(const glm::dvec3& direction) const;

  /// All directions as a lat-long picture.
  Picture Draw(int width, int height) const;
};

/// The means of an environment over blocks of texels, so that there are about so many.
vtkSmartPointer<vtkEnvironment> Shrink(vtkEnvironment* environment, int width, int height);

/// The environment blurred and darkened: it steps back behind the objects.
Backdrop MakeQuietBackdrop(vtkEnvironment* environment);

/// Draw one line with its lower left corner at (x, y); size is the font's, in pixels. Throws Error.
void DrawText(
  Picture& picture, int x, int y, const std::string& text, int size, bool bold, const RGB& color);

/// Width of a line in pixels.
int MeasureText(const std::string& text, int size, bool bold);

/// Text cut to a width in pixels, with "..." where something is missing.
std::string Fit(const std::string& text, int size, bool bold, int width);

/// Text broken between words into lines of a width, at most so many; the last one is cut to fit.
std::vector<std::string> Wrap(const std::string& text, int size, int width, int lines);

constexpr double LowestError = -3.0; // 0.1 %, as a decimal logarithm
constexpr double HighestError = 0.0; // 100 %

/// Viridis over the decimal logarithm of the error; light gray below its range.
vtkSmartPointer<vtkColorTransferFunction> MakeErrorColors();
} // namespace tool

#endif
