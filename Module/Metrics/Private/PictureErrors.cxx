// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PictureErrors.h"

#include "NumberText.h"
#include "Refusal.h"
#include "SRGB.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace measuredbrdf
{
namespace
{
// FLIP takes some 200 bytes for each.
constexpr vtkIdType MaximumPixels = vtkIdType(1) << 25;
constexpr double MaskThreshold = 0.5;

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
      throw std::runtime_error(name + ": type of values: found " + scalars->GetDataTypeAsString() +
                               ", expected unsigned char, unsigned short, float or double");
  }
}

//------------------------------------------------------------------------------
vtkDataArray* GetScalars(const std::string& name, vtkImageData* image)
{
  Require(image, name + ": there is none");
  const int* size = image->GetDimensions();
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  Require(scalars && size[0] >= 1 && size[1] >= 1 && size[2] == 1 &&
            scalars->GetNumberOfTuples() == static_cast<vtkIdType>(size[0]) * size[1],
    name + ": expected an image of one slice with a value for each pixel");
  Require(scalars->GetNumberOfTuples() <= MaximumPixels,
    name + ": size: found " + FormatSize(size) + ", expected at most " +
      std::to_string(MaximumPixels) + " pixels");
  Require(scalars->GetNumberOfComponents() <= 4,
    name + ": channels: found " + std::to_string(scalars->GetNumberOfComponents()) +
      ", expected 1 to 4: gray, gray and alpha, RGB, RGBA");
  return scalars;
}

//------------------------------------------------------------------------------
void CheckSize(const std::string& name, vtkImageData* image, const int* size, const char* as)
{
  GetScalars(name, image);
  Require(std::equal(size, size + 2, image->GetDimensions()),
    name + ": size: found " + FormatSize(image->GetDimensions()) + ", expected " +
      FormatSize(size) + " as " + as);
}

//------------------------------------------------------------------------------
PictureValues ReadValues(const std::string& name, vtkImageData* image, bool ignoreAlpha)
{
  vtkDataArray* scalars = GetScalars(name, image);
  const double largest = GetLargest(name, scalars);
  const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
  const int components = scalars->GetNumberOfComponents();
  const int colors = components < 3 ? 1 : 3;
  const vtkIdType count = scalars->GetNumberOfTuples();
  PictureValues values{ largest > 0.0, Colors(3, count), Values::Ones(count) };
  double tuple[4];
  for (vtkIdType k = 0; k < count; ++k)
  {
    scalars->GetTuple(k, tuple);
    const double* bad = std::find_if(
      tuple, tuple + components, [](double v) { return !std::isfinite(v) || v < 0.0; });
    if (bad != tuple + components)
    {
      const int width = image->GetDimensions()[0];
      throw std::runtime_error(name + ": pixel (" + std::to_string(k % width) + ", " +
                               std::to_string(k / width) + ") from the bottom left, channel " +
                               std::to_string(bad - tuple) + ": found " + NumberText(*bad) +
                               ", expected a finite value of at least 0");
    }
    for (int c = 0; c < 3; ++c)
    {
      values.Color(c, k) = scale * tuple[c % colors];
    }
    if (!ignoreAlpha && components > colors)
    {
      values.Alpha[k] = std::min(1.0, scale * tuple[colors]);
    }
  }
  return values;
}

//------------------------------------------------------------------------------
// 1 for each pixel inside a border, 0 on it.
Values MakeInside(int width, int height, int border)
{
  Plane inside = Plane::Zero(width, height);
  const int columns = width - 2 * border;
  const int rows = height - 2 * border;
  if (columns > 0 && rows > 0)
  {
    inside.block(border, border, columns, rows) = 1.0;
  }
  return Eigen::Map<const Values>(inside.data(), inside.size());
}

//------------------------------------------------------------------------------
Values FindCompared(const int* size, const PictureArea& area)
{
  Values compared = MakeInside(size[0], size[1], area.Border);
  if (area.Mask)
  {
    CheckSize("mask", area.Mask, size, "the pictures");
    vtkDataArray* mask = GetScalars("mask", area.Mask);
    const double largest = GetLargest("mask", mask);
    const double least = MaskThreshold * (largest > 0.0 ? largest : 1.0);
    for (Eigen::Index k = 0; k < compared.size(); ++k)
    {
      compared[k] *= mask->GetComponent(k, 0) >= least ? 1.0 : 0.0;
    }
  }
  Require(compared.any(), "the border and the mask leave no pixel to compare");
  return compared;
}

//------------------------------------------------------------------------------
Colors Decode(const Colors& encoded) { return encoded.unaryExpr(&DecodeSRGB); }

Colors Encode(const Colors& linear) { return linear.min(1.0).unaryExpr(&EncodeSRGB); }
}

//------------------------------------------------------------------------------
// Integers' colors are not yet multiplied by alpha; floats' are.
Colors PictureValues::Show(double background) const
{
  if (!this->HasTransparency())
  {
    return this->Color;
  }
  const Colors color = this->IsEncoded ? this->Color.rowwise() * this->Alpha : this->Color;
  return color.rowwise() + (1.0 - this->Alpha) * background;
}

//------------------------------------------------------------------------------
Colors PictureValues::GetLinear(double background) const
{
  return this->IsEncoded ? Decode(this->Show(background)) : this->Show(background);
}

//------------------------------------------------------------------------------
Colors PictureValues::GetDisplayed(double background) const
{
  return this->IsEncoded ? this->Show(background) : Encode(this->Show(background));
}

//------------------------------------------------------------------------------
Colors PictureValues::GetDisplayedLight(double background) const
{
  return this->GetLinear(background).min(1.0);
}

//------------------------------------------------------------------------------
std::vector<double> PicturePair::GetLuminances(const Colors& linear) const
{
  std::vector<double> luminances;
  for (Eigen::Index k = 0; k < linear.cols(); ++k)
  {
    if (this->Compared[k] > 0.0)
    {
      luminances.push_back(GetLuminance(linear.col(k)));
    }
  }
  return luminances;
}

//------------------------------------------------------------------------------
PicturePair MakePicturePair(vtkImageData* picture, vtkImageData* reference, const PictureArea& area)
{
  GetScalars("picture", picture);
  GetScalars("reference", reference);
  const int* size = reference->GetDimensions();
  CheckSize("picture", picture, size, "the reference");
  PicturePair pair{ size[0], size[1], ReadValues("picture", picture, area.IgnoreAlpha),
    ReadValues("reference", reference, area.IgnoreAlpha), FindCompared(size, area) };
  // What is not compared must not show in the filters of its neighbors.
  const Colors same = pair.Picture.IsEncoded == pair.Reference.IsEncoded ? pair.Reference.Color
                      : pair.Picture.IsEncoded ? Encode(pair.Reference.Color)
                                               : Decode(pair.Reference.Color);
  for (Eigen::Index k = 0; k < pair.Compared.size(); ++k)
  {
    if (pair.Compared[k] == 0.0)
    {
      pair.Picture.Alpha[k] = pair.Reference.Alpha[k];
      pair.Picture.Color.col(k) = same.col(k);
    }
  }
  return pair;
}

namespace
{
//------------------------------------------------------------------------------
PictureError TakeMean(const PicturePair& pair, const Values& map)
{
  return { pair.GetMean(map), map * pair.Compared };
}

//------------------------------------------------------------------------------
PictureError ComputeDisplayedFlip(const PicturePair& pair, double background)
{
  return TakeMean(
    pair, ComputeFlip(pair.Width, pair.Height, pair.Picture.GetDisplayedLight(background),
            pair.Reference.GetDisplayedLight(background)));
}

//------------------------------------------------------------------------------
void RequireLight(bool isLit, const std::string& metric)
{
  Require(isLit, "reference: it is black, and " + metric + " is relative to its light");
}

//------------------------------------------------------------------------------
PictureError ComputeRadianceFlip(const PicturePair& pair, double background)
{
  const Colors picture = pair.Picture.GetLinear(background);
  const Colors reference = pair.Reference.GetLinear(background);
  if ((picture == reference).all()) // however black
  {
    return { 0.0, Values::Zero(reference.cols()) };
  }
  const std::vector<double> luminances = pair.GetLuminances(reference);
  RequireLight(*std::max_element(luminances.begin(), luminances.end()) > 0.0, "hdr_flip");
  return TakeMean(
    pair, ComputeHDRFlip(pair.Width, pair.Height, picture, reference, FindExposures(luminances)));
}

//------------------------------------------------------------------------------
Plane GetLuma(const PicturePair& pair, const Colors& displayed)
{
  Plane luma(pair.Width, pair.Height);
  for (Eigen::Index k = 0; k < luma.size(); ++k)
  {
    luma.data()[k] = GetLuminance(displayed.col(k));
  }
  return luma;
}

//------------------------------------------------------------------------------
PictureError ComputeStructuralSimilarity(const PicturePair& pair, double background)
{
  const Plane similarity = ComputeSimilarity(GetLuma(pair, pair.Picture.GetDisplayed(background)),
    GetLuma(pair, pair.Reference.GetDisplayed(background)));
  PicturePair windows{ pair.Width, pair.Height, {}, {},
    pair.Compared * MakeInside(pair.Width, pair.Height, SimilarityRadius) };
  Require(windows.Compared.any(),
    "ssim: no compared pixel has a window of 11 x 11 pixels around it within the picture");
  const PictureError difference =
    TakeMean(windows, 1.0 - Eigen::Map<const Values>(similarity.data(), similarity.size()));
  return { 1.0 - difference.Value, difference.Map };
}

//------------------------------------------------------------------------------
PictureError ComputeColorDifference(const PicturePair& pair, double background)
{
  const Colors picture = ToLab(pair.Picture.GetDisplayedLight(background));
  const Colors reference = ToLab(pair.Reference.GetDisplayedLight(background));
  Values map(reference.cols());
  for (Eigen::Index k = 0; k < map.size(); ++k)
  {
    map[k] = GetDeltaE2000(picture.col(k), reference.col(k));
  }
  return TakeMean(pair, map);
}

//------------------------------------------------------------------------------
PictureError ComputeRelativeL1(const PicturePair& pair, double background)
{
  const Colors reference = pair.Reference.GetLinear(background);
  const Values difference = (pair.Picture.GetLinear(background) - reference).abs().colwise().sum();
  const double mean = pair.GetMean(reference.colwise().sum());
  RequireLight(mean > 0.0 || pair.GetMean(difference) == 0.0, "relative_l1");
  return TakeMean(pair, difference / (mean > 0.0 ? mean : 1.0));
}

//------------------------------------------------------------------------------
// Of the stored values: the background plays no part.
PictureError ComputeLargestDifference(const PicturePair& pair, double)
{
  Require(pair.Picture.IsEncoded == pair.Reference.IsEncoded,
    "max_difference: it compares stored values, and one picture holds integers, the other floats");
  const Values ofColors = (pair.Picture.Color - pair.Reference.Color).abs().colwise().maxCoeff();
  const Values map = (pair.Picture.Alpha - pair.Reference.Alpha).abs().max(ofColors);
  return { (map * pair.Compared).maxCoeff(), map * pair.Compared };
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
  if (pair.Picture.HasTransparency() || pair.Reference.HasTransparency())
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
