// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Error figures of two pictures, each with its map.
 */

#ifndef PictureErrors_h
#define PictureErrors_h

#include <string>
#include <vector>

namespace measuredbrdf
{
struct PicturePair;

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
