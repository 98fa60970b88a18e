// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PictureErrors.h"

#include "ColorDifference.h"
#include "Flip.h"
#include "NumberText.h"
#include "SRGB.h"
#include "vtkDataArray.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace measuredbrdf
{
namespace
{
// FLIP takes some 200 bytes for each.
constexpr vtkIdType MaximumPixels = vtkIdType(1) << 25;
constexpr double MaskThreshold = 0.5;

//------------------------------------------------------------------------------
[[noreturn]] void Refuse(const std::string& name, const std::string& problem)
{
  throw std::invalid_argument(name + ": " + problem);
}

//------------------------------------------------------------------------------
std::string FormatSize(const int* dimensions)
{
  return std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]);
}

//------------------------------------------------------------------------------
// The largest value of a type of integers; 0 for floats.
double GetLargest(const std::string& name, vtkDataArray* scalars)
{
  switch (scalars->GetDataType())
  {
    case VTK_UNSIGNED_CHAR:
      return 255.0;
    case VTK_UNSIGNED_SHORT:
      return 65535.0;
    case VTK_FLOAT:
    case VTK_DOUBLE:
      return 0.0;
    default:
      Refuse(name, std::string("type of values: found ") + scalars->GetDataTypeAsString() +
                     ", expected unsigned char, unsigned short, float or double");
  }
}

//------------------------------------------------------------------------------
vtkDataArray* GetScalars(const std::string& name, vtkImageData* image)
{
  if (!image)
  {
    Refuse(name, "there is none");
  }
  const int* size = image->GetDimensions();
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (!scalars || size[0] < 1 || size[1] < 1 || size[2] != 1 ||
      scalars->GetNumberOfTuples() != static_cast<vtkIdType>(size[0]) * size[1])
  {
    Refuse(name, "expected an image of one slice with a value for each pixel");
  }
  if (scalars->GetNumberOfTuples() > MaximumPixels)
  {
    Refuse(name, "size: found " + FormatSize(size) + ", expected at most " +
                   std::to_string(MaximumPixels) + " pixels");
  }
  if (scalars->GetNumberOfComponents() > 4)
  {
    Refuse(name, "channels: found " + std::to_string(scalars->GetNumberOfComponents()) +
                   ", expected 1 to 4: gray, gray and alpha, RGB, RGBA");
  }
  return scalars;
}

//------------------------------------------------------------------------------
PictureValues ReadValues(const std::string& name, vtkImageData* image, bool ignoreAlpha)
{
  vtkDataArray* scalars = GetScalars(name, image);
  const double largest = GetLargest(name, scalars);
  const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
  const int components = scalars->GetNumberOfComponents();
  const int colors = components < 3 ? 1 : 3;
  const int width = image->GetDimensions()[0];
  PictureValues values;
  values.IsEncoded = largest > 0.0;
  values.Color.reserve(3 * static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  values.Alpha.reserve(static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  double tuple[4];
  for (vtkIdType k = 0; k < scalars->GetNumberOfTuples(); ++k)
  {
    scalars->GetTuple(k, tuple);
    for (int c = 0; c < components; ++c)
    {
      if (!std::isfinite(tuple[c]) || tuple[c] < 0.0)
      {
        Refuse(name, "pixel (" + std::to_string(k % width) + ", " + std::to_string(k / width) +
                       ") from the bottom left, channel " + std::to_string(c) + ": found " +
                       NumberText(tuple[c]) + ", expected a finite value of at least 0");
      }
    }
    for (int c = 0; c < 3; ++c)
    {
      values.Color.push_back(scale * tuple[c % colors]);
    }
    const bool opaque = ignoreAlpha || components == colors;
    values.Alpha.push_back(opaque ? 1.0 : std::min(1.0, scale * tuple[colors]));
    values.HasTransparency = values.HasTransparency || values.Alpha.back() < 1.0;
  }
  return values;
}

//------------------------------------------------------------------------------
std::vector<std::size_t> FindCompared(const int* size, const PictureArea& area)
{
  vtkDataArray* mask = nullptr;
  double least = 0.0;
  if (area.Mask)
  {
    mask = GetScalars("mask", area.Mask);
    const int* found = area.Mask->GetDimensions();
    if (!std::equal(size, size + 2, found))
    {
      Refuse("mask",
        "size: found " + FormatSize(found) + ", expected " + FormatSize(size) + " as the pictures");
    }
    const double largest = GetLargest("mask", mask);
    least = MaskThreshold * (largest > 0.0 ? largest : 1.0);
  }
  std::vector<std::size_t> compared;
  for (int y = area.Border; y < size[1] - area.Border; ++y)
  {
    for (int x = area.Border; x < size[0] - area.Border; ++x)
    {
      const vtkIdType k = static_cast<vtkIdType>(y) * size[0] + x;
      if (!mask || mask->GetComponent(k, 0) >= least)
      {
        compared.push_back(static_cast<std::size_t>(k));
      }
    }
  }
  if (compared.empty())
  {
    throw std::invalid_argument("the border and the mask leave no pixel to compare");
  }
  return compared;
}
}

//------------------------------------------------------------------------------
std::vector<double> PictureValues::Show(double background, double (*convert)(double, bool)) const
{
  std::vector<double> values = this->Color;
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    if (this->HasTransparency)
    {
      const double alpha = this->Alpha[k / 3];
      values[k] = (this->IsEncoded ? alpha * values[k] : values[k]) + (1.0 - alpha) * background;
    }
    values[k] = convert(values[k], this->IsEncoded);
  }
  return values;
}

//------------------------------------------------------------------------------
std::vector<double> PictureValues::GetLinear(double background) const
{
  return this->Show(
    background, [](double value, bool isEncoded) { return isEncoded ? DecodeSRGB(value) : value; });
}

//------------------------------------------------------------------------------
std::vector<double> PictureValues::GetDisplayed(double background) const
{
  return this->Show(background, [](double value, bool isEncoded)
    { return isEncoded ? value : EncodeSRGB(std::min(value, 1.0)); });
}

//------------------------------------------------------------------------------
std::vector<double> PictureValues::GetDisplayedLight(double background) const
{
  return this->Show(background, [](double value, bool isEncoded)
    { return std::min(isEncoded ? DecodeSRGB(value) : value, 1.0); });
}

//------------------------------------------------------------------------------
double PicturePair::GetMean(const std::vector<double>& map) const
{
  double sum = 0.0;
  for (const std::size_t k : this->Compared)
  {
    sum += map[k];
  }
  return sum / static_cast<double>(this->Compared.size());
}

//------------------------------------------------------------------------------
PicturePair MakePicturePair(vtkImageData* picture, vtkImageData* reference, const PictureArea& area)
{
  GetScalars("picture", picture);
  GetScalars("reference", reference);
  const int* size = reference->GetDimensions();
  if (!std::equal(size, size + 2, picture->GetDimensions()))
  {
    Refuse("picture", "size: found " + FormatSize(picture->GetDimensions()) + ", expected " +
                        FormatSize(size) + " as the reference");
  }
  PicturePair pair;
  pair.Width = size[0];
  pair.Height = size[1];
  pair.Picture = ReadValues("picture", picture, area.IgnoreAlpha);
  pair.Reference = ReadValues("reference", reference, area.IgnoreAlpha);
  pair.Compared = FindCompared(size, area);
  // What is not compared must not show in the filters of its neighbors.
  std::vector<bool> isCompared(pair.Reference.Alpha.size(), false);
  for (const std::size_t k : pair.Compared)
  {
    isCompared[k] = true;
  }
  pair.Picture.HasTransparency |= pair.Reference.HasTransparency;
  const bool alike = pair.Picture.IsEncoded == pair.Reference.IsEncoded;
  for (std::size_t k = 0; k < isCompared.size(); ++k)
  {
    if (isCompared[k])
    {
      continue;
    }
    pair.Picture.Alpha[k] = pair.Reference.Alpha[k];
    for (std::size_t c = 3 * k; c < 3 * k + 3; ++c)
    {
      const double value = pair.Reference.Color[c];
      pair.Picture.Color[c] = alike                    ? value
                              : pair.Picture.IsEncoded ? EncodeSRGB(std::min(value, 1.0))
                                                       : DecodeSRGB(value);
    }
  }
  return pair;
}

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
  Plane plane(pair.Width, pair.Height);
  for (std::size_t k = 0; k < displayed.size() / 3; ++k)
  {
    plane.data()[k] = vtkEnvironment::GetLuminance(&displayed[3 * k]);
  }
  return plane;
}

//------------------------------------------------------------------------------
PictureError ComputeStructuralSimilarity(const PicturePair& pair, double background)
{
  const Plane similarity = ComputeSimilarity(GetLuma(pair, pair.Picture.GetDisplayed(background)),
    GetLuma(pair, pair.Reference.GetDisplayed(background)));
  PictureError error;
  error.Map.assign(static_cast<std::size_t>(similarity.size()), 0.0);
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
      sum += similarity.data()[k];
      ++count;
      error.Map[k] = 1.0 - similarity.data()[k];
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
  const auto getLab = [](const std::vector<double>& linear, std::size_t k)
  { return ToLab(ToRelativeXYZ(glm::make_vec3(&linear[3 * k]))); };
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
