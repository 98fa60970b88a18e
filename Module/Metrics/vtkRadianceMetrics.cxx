// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceMetrics.h"

#include "ColorDifference.h"
#include "Flip.h"
#include "PictureErrors.h"

#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"
#include "vtkPictureDifference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkRadianceMetrics);

namespace
{
constexpr double RelMSEFloor = 0.01; // of the squared mean

//------------------------------------------------------------------------------
// Sorts the values. share in [0,1]; linear between neighbors.
double GetPercentile(std::vector<double>& values, double share)
{
  if (values.empty())
  {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto k = static_cast<std::size_t>(at);
  const double next = values[std::min(k + 1, values.size() - 1)];
  return values[k] + (at - static_cast<double>(k)) * (next - values[k]);
}

//------------------------------------------------------------------------------
// Both are black where nothing is covered, and compared elsewhere.
PicturePair MakePair(
  int width, int height, vtkDataArray* radiance, vtkDataArray* reference, vtkDataArray* coverage)
{
  PicturePair pair;
  pair.Width = width;
  pair.Height = height;
  for (vtkIdType k = 0; k < reference->GetNumberOfTuples(); ++k)
  {
    const bool covered = !coverage || coverage->GetComponent(k, 0) != 0.0;
    for (int c = 0; c < 3; ++c)
    {
      pair.Picture.Color.push_back(covered ? radiance->GetComponent(k, c) : 0.0);
      pair.Reference.Color.push_back(covered ? reference->GetComponent(k, c) : 0.0);
    }
    if (covered)
    {
      pair.Compared.push_back(static_cast<std::size_t>(k));
    }
  }
  return pair;
}

//------------------------------------------------------------------------------
// As a display shows them, with white at a radiance.
PicturePair Encode(PicturePair pair, double white)
{
  for (PictureValues* values : { &pair.Picture, &pair.Reference })
  {
    values->IsEncoded = true;
    for (double& value : values->Color)
    {
      value = std::pow(std::min(value / white, 1.0), 1.0 / 2.2);
    }
  }
  return pair;
}

//------------------------------------------------------------------------------
double GetFigure(int metric, const PicturePair& pair)
{
  return ComputePictureError(GetPictureMetrics()[static_cast<std::size_t>(metric)], pair).Value;
}

//------------------------------------------------------------------------------
// Not a number where no window lies within the picture.
double GetSimilarity(const PicturePair& pair)
{
  try
  {
    return GetFigure(vtkPictureDifference::SSIM, pair);
  }
  catch (const std::invalid_argument&)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
}
}

//------------------------------------------------------------------------------
bool vtkRadianceMetrics::Check(vtkDataArray* radiance, vtkDataArray* reference)
{
  for (vtkDataArray* array : { radiance, reference })
  {
    if (!array || array->GetNumberOfComponents() != 3 || array->GetNumberOfTuples() < 1)
    {
      vtkErrorMacro("Radiance and reference need 3 components and a tuple at least.");
      return false;
    }
    for (vtkIdType k = 0; k < 3 * array->GetNumberOfTuples(); ++k)
    {
      const double value = array->GetComponent(k / 3, static_cast<int>(k % 3));
      if (!std::isfinite(value) || value < 0.0)
      {
        vtkErrorMacro("The " << (array == reference ? "reference" : "radiance") << " is " << value
                             << " at tuple " << k / 3 << ", which is negative or not finite.");
        return false;
      }
    }
  }
  if (radiance->GetNumberOfTuples() != reference->GetNumberOfTuples())
  {
    vtkErrorMacro("The radiance has " << radiance->GetNumberOfTuples() << " tuples, its reference "
                                      << reference->GetNumberOfTuples() << ".");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadianceMetrics::Compare(vtkDataArray* radiance, vtkDataArray* reference)
{
  if (!this->Check(radiance, reference))
  {
    return false;
  }
  const vtkIdType count = reference->GetNumberOfTuples();
  double total = 0.0;
  double difference = 0.0;
  double squares = 0.0;
  double symmetric = 0.0;
  std::vector<double> relative;
  std::vector<double> differences;
  double x[3];
  double r[3];
  for (vtkIdType k = 0; k < count; ++k)
  {
    radiance->GetTuple(k, x);
    reference->GetTuple(k, r);
    double pixel = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      const double d = std::abs(x[c] - r[c]);
      pixel += d;
      squares += d * d;
      symmetric += d > 0.0 ? d / (x[c] + r[c]) : 0.0;
    }
    const double sum = r[0] + r[1] + r[2];
    total += sum;
    difference += pixel;
    differences.push_back(pixel);
    if (sum > 0.0)
    {
      relative.push_back(pixel / sum);
    }
  }
  if (!(total > 0.0))
  {
    vtkErrorMacro("The reference is black: no error is relative to it.");
    return false;
  }
  const double values = 3.0 * static_cast<double>(count);
  const double floor = RelMSEFloor * total * total / (values * values);
  double relativeSquares = 0.0;
  for (vtkIdType k = 0; k < count; ++k)
  {
    radiance->GetTuple(k, x);
    reference->GetTuple(k, r);
    for (int c = 0; c < 3; ++c)
    {
      const double d = x[c] - r[c];
      relativeSquares += d * d / (r[c] * r[c] + floor);
    }
  }
  this->RelativeL1 = difference / total;
  this->RelativeRMSE = std::sqrt(squares / values) * values / total;
  this->RelMSE = relativeSquares / values;
  this->MedianRelative = GetPercentile(relative, 0.5);
  this->P99Relative = GetPercentile(relative, 0.99);
  const double mean = total / static_cast<double>(count);
  this->Percentile95 = GetPercentile(differences, 0.95) / mean;
  this->Percentile99 = GetPercentile(differences, 0.99) / mean;
  this->SMAPE = symmetric / values;
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadianceMetrics::ComparePictures(
  int width, int height, vtkDataArray* radiance, vtkDataArray* reference, vtkDataArray* coverage)
{
  if (!this->Check(radiance, reference))
  {
    return false;
  }
  const vtkIdType count = reference->GetNumberOfTuples();
  if (width < 1 || height < 1 || static_cast<vtkIdType>(width) * height != count ||
      (coverage &&
        (coverage->GetNumberOfTuples() != count || coverage->GetNumberOfComponents() != 1)))
  {
    vtkErrorMacro("Pictures of " << width << " x " << height
                                 << " pixels need as many tuples, and one component of coverage; "
                                 << count << " tuples were given.");
    return false;
  }
  this->Abort = false;
  const PicturePair pair = MakePair(width, height, radiance, reference, coverage);
  std::vector<double> channels;
  std::vector<double> luminances;
  for (const std::size_t k : pair.Compared)
  {
    const double* color = &pair.Reference.Color[3 * k];
    channels.insert(channels.end(), color, color + 3);
    luminances.push_back(vtkEnvironment::GetLuminance(color));
  }
  const double white = GetPercentile(channels, 0.99);
  if (!(white > 0.0))
  {
    vtkErrorMacro("The reference is black: nothing to set the exposure by.");
    return false;
  }
  const PicturePair encoded = Encode(pair, white);
  const double flip = GetFigure(vtkPictureDifference::FLIP, encoded);
  const std::vector<double> largest = ComputeHDRFlip(width, height, pair.Picture.Color,
    pair.Reference.Color, FindExposures(std::move(luminances)),
    [this](double share) { return this->ReportProgress(share); });
  if (largest.empty() || !this->ReportProgress(1.0))
  {
    return false;
  }
  this->FLIP = flip;
  this->HDRFLIP = pair.GetMean(largest);
  this->SSIM = GetSimilarity(encoded);
  this->DeltaE2000 = GetFigure(vtkPictureDifference::DELTA_E_2000, encoded);
  return true;
}

//------------------------------------------------------------------------------
bool vtkRadianceMetrics::ReportProgress(double share)
{
  this->InvokeEvent(vtkCommand::ProgressEvent, &share);
  if (this->Abort)
  {
    vtkErrorMacro("ComparePictures was aborted.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
double vtkRadianceMetrics::ComputeDeltaE2000(const double lab1[3], const double lab2[3])
{
  return measuredbrdf::GetDeltaE2000({ lab1[0], lab1[1], lab1[2] }, { lab2[0], lab2[1], lab2[2] });
}

//------------------------------------------------------------------------------
void vtkRadianceMetrics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const std::pair<const char*, double> figures[] = { { "RelativeL1", this->RelativeL1 },
    { "RelativeRMSE", this->RelativeRMSE }, { "RelMSE", this->RelMSE },
    { "MedianRelative", this->MedianRelative }, { "P99Relative", this->P99Relative },
    { "Percentile95", this->Percentile95 }, { "Percentile99", this->Percentile99 },
    { "SMAPE", this->SMAPE }, { "FLIP", this->FLIP }, { "HDRFLIP", this->HDRFLIP },
    { "SSIM", this->SSIM }, { "DeltaE2000", this->DeltaE2000 } };
  for (const auto& [name, value] : figures)
  {
    os << indent << name << ": " << value << "\n";
  }
}
