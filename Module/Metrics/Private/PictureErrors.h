// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Two pictures of the same size as numbers, where they are compared, and figures of their errors,
 * each with its map.
 */

#ifndef PictureErrors_h
#define PictureErrors_h

#include "PerceivedErrors.h"

#include <vector>

class vtkImageData;

namespace measuredbrdf
{
/// A picture's values: integers as shares of their largest value, floats as they are.
struct PictureValues
{
  bool IsEncoded = false; // integers, sRGB-encoded; floats are linear
  Colors Color;
  Values Alpha; // of each pixel; 1 where the picture has none

  bool HasTransparency() const { return (this->Alpha < 1.0).any(); }

  /// Linear RGB in front of a gray background, of 0 or 1.
  Colors GetLinear(double background) const;

  /// The same as displayed: clamped to [0,1], and sRGB-encoded.
  Colors GetDisplayed(double background) const;

  /// The same display light, in linear [0,1].
  Colors GetDisplayedLight(double background) const;

private:
  Colors Show(double background) const;
};

/// Which pixels count.
struct PictureArea
{
  int Border = 0;
  vtkImageData* Mask = nullptr;
  bool IgnoreAlpha = false;
};

struct PicturePair
{
  int Width = 0;
  int Height = 0;
  PictureValues Picture; // the reference's values where nothing is compared
  PictureValues Reference;
  Values Compared; // of each pixel: 1, or 0 where nothing is compared

  double GetMean(const Values& map) const
  {
    return (map * this->Compared).sum() / this->Compared.sum();
  }
  /// The luminances of compared pixels.
  std::vector<double> GetLuminances(const Colors& linear) const;
};

/// Throws std::runtime_error, which says what is wrong with which picture.
PicturePair MakePicturePair(
  vtkImageData* picture, vtkImageData* reference, const PictureArea& area);

struct PictureError
{
  double Value = 0.0;
  Values Map; // the error of each pixel; 0 where nothing is compared
};

/// A figure of two pictures.
struct PictureMetric
{
  const char* Name;
  bool IsSimilarity;       // larger is better
  double DefaultThreshold; // the value still taken for equal
  double Brightest;        // error of the brightest color of its map
  /// In front of a background of 0 or 1. Throws std::runtime_error.
  PictureError (*Compute)(const PicturePair& pair, double background);
};

/// All of them, in the order of vtkPictureDifference's numbers.
const std::vector<PictureMetric>& GetPictureMetrics();

/// The error over a black and over a white background, where the pictures let one through: the
/// larger of both. Throws std::runtime_error.
PictureError ComputePictureError(const PictureMetric& metric, const PicturePair& pair);
} // namespace measuredbrdf

#endif
