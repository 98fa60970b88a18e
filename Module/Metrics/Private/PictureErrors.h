// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Two pictures of the same size as numbers, where they are compared, and figures of their errors,
 * each with its map.
 */

#ifndef PictureErrors_h
#define PictureErrors_h

#include <cstddef>
#include <string>
#include <vector>

class vtkImageData;

namespace measuredbrdf
{
/// A picture's values: integers as shares of their largest value, floats as they are.
struct PictureValues
{
  bool IsEncoded = false;       // integers, sRGB-encoded; floats are linear
  std::vector<double> Color;    // RGB
  std::vector<double> Alpha;    // of each pixel; 1 where the picture has none
  bool HasTransparency = false; // an alpha is not 1

  /// Linear RGB in front of a gray background, of 0 or 1.
  std::vector<double> GetLinear(double background) const;

  /// The same as displayed: clamped to [0,1], and sRGB-encoded.
  std::vector<double> GetDisplayed(double background) const;

  /// The same display light, in linear [0,1].
  std::vector<double> GetDisplayedLight(double background) const;

private:
  std::vector<double> Show(double background, double (*convert)(double, bool isEncoded)) const;
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
  std::vector<std::size_t> Compared; // pixels

  double GetMean(const std::vector<double>& map) const;
};

/// Throws std::invalid_argument, which says what is wrong with which picture.
PicturePair MakePicturePair(
  vtkImageData* picture, vtkImageData* reference, const PictureArea& area);

struct PictureError
{
  double Value = 0.0;
  std::vector<double> Map; // the error of each pixel; 0 where nothing is compared
};

/// A figure of two pictures.
struct PictureMetric
{
  const char* Name;
  bool IsSimilarity;       // larger is better
  double DefaultThreshold; // the value still taken for equal
  double Brightest;        // error of the brightest color of its map
  /// In front of a background of 0 or 1. Throws std::invalid_argument.
  PictureError (*Compute)(const PicturePair& pair, double background);
};

/// All of them, in the order of vtkPictureDifference's numbers.
const std::vector<PictureMetric>& GetPictureMetrics();

/// The error over a black and over a white background, where the pictures let one through: the
/// larger of both. Throws std::invalid_argument.
PictureError ComputePictureError(const PictureMetric& metric, const PicturePair& pair);
} // namespace measuredbrdf

#endif
