// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PictureErrors.h"

#include "ColorDifference.h"
#include "Flip.h"
#include "PicturePair.h"
#include "StructuralSimilarity.h"

#include "vtkEnvironment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace measuredbrdf
{
namespace
{
//------------------------------------------------------------------------------
PictureError ComputeDisplayedFlip(const PicturePair& pair, double background)
{
  PictureError error;
  error.Map = ComputeFlip(pair.Width, pair.Height, pair.Picture.GetDisplayedLight(background),
    pair.Reference.GetDisplayedLight(background));
  error.Value = pair.GetMean(error.Map);
  return error;
}

//------------------------------------------------------------------------------
[[noreturn]] void RefuseBlack(const char* metric)
{
  throw std::invalid_argument(
    std::string("reference: it is black, and ") + metric + " is relative to its light");
}

//------------------------------------------------------------------------------
PictureError ComputeRadianceFlip(const PicturePair& pair, double background)
{
  const std::vector<double> picture = pair.Picture.GetLinear(background);
  const std::vector<double> reference = pair.Reference.GetLinear(background);
  std::vector<double> luminances;
  for (const std::size_t k : pair.Compared)
  {
    luminances.push_back(vtkEnvironment::GetLuminance(&reference[3 * k]));
  }
  PictureError error;
  error.Map.assign(reference.size() / 3, 0.0);
  if (picture == reference)
  {
    return error; // however black
  }
  if (!(*std::max_element(luminances.begin(), luminances.end()) > 0.0))
  {
    RefuseBlack("hdr_flip");
  }
  error.Map = ComputeHDRFlip(
    pair.Width, pair.Height, picture, reference, FindExposures(std::move(luminances)));
  error.Value = pair.GetMean(error.Map);
  return error;
}

//------------------------------------------------------------------------------
Plane GetLuma(const PicturePair& pair, const std::vector<double>& displayed)
{
  Plane plane{ pair.Width, pair.Height, {} };
  for (std::size_t k = 0; k < displayed.size(); k += 3)
  {
    plane.Values.push_back(vtkEnvironment::GetLuminance(&displayed[k]));
  }
  return plane;
}

//------------------------------------------------------------------------------
PictureError ComputeStructuralSimilarity(const PicturePair& pair, double background)
{
  const Plane similarity = ComputeSimilarity(GetLuma(pair, pair.Picture.GetDisplayed(background)),
    GetLuma(pair, pair.Reference.GetDisplayed(background)));
  PictureError error;
  error.Map.assign(similarity.Values.size(), 0.0);
  const auto isInside = [](int at, int size)
  { return at >= SimilarityRadius && at < size - SimilarityRadius; };
  double sum = 0.0;
  std::size_t count = 0;
  for (const std::size_t k : pair.Compared)
  {
    const auto width = static_cast<std::size_t>(pair.Width);
    if (isInside(static_cast<int>(k % width), pair.Width) &&
        isInside(static_cast<int>(k / width), pair.Height))
    {
      sum += similarity.Values[k];
      ++count;
      error.Map[k] = 1.0 - similarity.Values[k];
    }
  }
  if (count == 0)
  {
    throw std::invalid_argument(
      "ssim: no compared pixel has a window of 11 x 11 pixels around it within the picture");
  }
  error.Value = sum / static_cast<double>(count);
  return error;
}

//------------------------------------------------------------------------------
PictureError ComputeColorDifference(const PicturePair& pair, double background)
{
  const std::vector<double> picture = pair.Picture.GetDisplayedLight(background);
  const std::vector<double> reference = pair.Reference.GetDisplayedLight(background);
  const auto getLab = [](const std::vector<double>& linear, std::size_t k) {
    return ToLab(ToRelativeXYZ({ linear[3 * k], linear[3 * k + 1], linear[3 * k + 2] }));
  };
  PictureError error;
  error.Map.assign(reference.size() / 3, 0.0);
  for (const std::size_t k : pair.Compared)
  {
    error.Map[k] = GetDeltaE2000(getLab(picture, k), getLab(reference, k));
  }
  error.Value = pair.GetMean(error.Map);
  return error;
}

//------------------------------------------------------------------------------
PictureError ComputeRelativeL1(const PicturePair& pair, double background)
{
  const std::vector<double> picture = pair.Picture.GetLinear(background);
  const std::vector<double> reference = pair.Reference.GetLinear(background);
  PictureError error;
  error.Map.assign(reference.size() / 3, 0.0);
  double light = 0.0;
  for (const std::size_t k : pair.Compared)
  {
    for (std::size_t c = 3 * k; c < 3 * k + 3; ++c)
    {
      light += reference[c];
      error.Map[k] += std::abs(picture[c] - reference[c]);
    }
  }
  const double mean = light / static_cast<double>(pair.Compared.size());
  if (mean > 0.0)
  {
    for (double& value : error.Map)
    {
      value /= mean;
    }
  }
  else if (picture != reference)
  {
    RefuseBlack("relative_l1");
  }
  error.Value = pair.GetMean(error.Map);
  return error;
}

//------------------------------------------------------------------------------
// Of the stored values: the background plays no part.
PictureError ComputeLargestDifference(const PicturePair& pair, double)
{
  if (pair.Picture.IsEncoded != pair.Reference.IsEncoded)
  {
    throw std::invalid_argument("max_difference: it compares stored values, and one picture holds "
                                "integers, the other floats");
  }
  PictureError error;
  error.Map.assign(pair.Reference.Alpha.size(), 0.0);
  for (const std::size_t k : pair.Compared)
  {
    double& largest = error.Map[k];
    largest = std::abs(pair.Picture.Alpha[k] - pair.Reference.Alpha[k]);
    for (std::size_t c = 3 * k; c < 3 * k + 3; ++c)
    {
      largest = std::max(largest, std::abs(pair.Picture.Color[c] - pair.Reference.Color[c]));
    }
    error.Value = std::max(error.Value, largest);
  }
  return error;
}
}

//------------------------------------------------------------------------------
const std::vector<PictureMetric>& GetPictureMetrics()
{
  // docs/image-tests.md says where the thresholds come from.
  static const std::vector<PictureMetric> metrics = { { "flip", false, 0.01, 1.0,
                                                        ComputeDisplayedFlip },
    { "hdr_flip", false, 0.01, 1.0, ComputeRadianceFlip },
    { "ssim", true, 0.99, 1.0, ComputeStructuralSimilarity },
    { "delta_e_2000", false, 0.1, 10.0, ComputeColorDifference },
    { "relative_l1", false, 0.005, 1.0, ComputeRelativeL1 },
    { "max_difference", false, 0.0, 1.0, ComputeLargestDifference } };
  return metrics;
}

//------------------------------------------------------------------------------
PictureError ComputePictureError(const PictureMetric& metric, const PicturePair& pair)
{
  PictureError error = metric.Compute(pair, 0.0);
  if (pair.Picture.HasTransparency || pair.Reference.HasTransparency)
  {
    PictureError onWhite = metric.Compute(pair, 1.0);
    if (metric.IsSimilarity ? onWhite.Value < error.Value : onWhite.Value > error.Value)
    {
      return onWhite;
    }
  }
  return error;
}
} // namespace measuredbrdf
