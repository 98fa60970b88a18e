// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceMetrics.h"

#include "NumberText.h"
#include "ParallelFor.h"
#include "PictureErrors.h"
#include "Refusal.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPictureDifference.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkRadianceMetrics);

namespace
{
constexpr double RelMSEFloor = 0.01; // of the squared mean

//------------------------------------------------------------------------------
// share in [0,1]; linear between neighbors.
double GetPercentile(std::vector<double> values, double share)
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
Colors Read(vtkDataArray* array, const std::string& name)
{
  Require(array && array->GetNumberOfComponents() == 3 && array->GetNumberOfTuples() >= 1,
    "Radiance and reference need 3 components and a tuple at least");
  Colors colors(3, array->GetNumberOfTuples());
  for (vtkIdType k = 0; k < colors.cols(); ++k)
  {
    array->GetTuple(k, &colors(0, k));
    for (const double value : colors.col(k))
    {
      if (!std::isfinite(value) || value < 0.0)
      {
        throw std::runtime_error("The " + name + " is " + NumberText(value) + " at tuple " +
                                 std::to_string(k) + ", which is negative or not finite");
      }
    }
  }
  return colors;
}

std::pair<Colors, Colors> ReadBoth(vtkDataArray* radiance, vtkDataArray* reference)
{
  std::pair<Colors, Colors> both = { Read(radiance, "radiance"), Read(reference, "reference") };
  Require(both.first.cols() == both.second.cols(),
    "The radiance has " + std::to_string(both.first.cols()) + " tuples, its reference " +
      std::to_string(both.second.cols()));
  return both;
}

//------------------------------------------------------------------------------
// Both are black where nothing is covered, and compared elsewhere.
PicturePair MakePair(
  int width, int height, vtkDataArray* radiance, vtkDataArray* reference, vtkDataArray* coverage)
{
  auto [picture, expected] = ReadBoth(radiance, reference);
  const vtkIdType count = picture.cols();
  Require(width >= 1 && height >= 1 && static_cast<vtkIdType>(width) * height == count &&
            (!coverage ||
              (coverage->GetNumberOfTuples() == count && coverage->GetNumberOfComponents() == 1)),
    "Pictures of " + std::to_string(width) + " x " + std::to_string(height) +
      " pixels need as many tuples, and one component of coverage; " + std::to_string(count) +
      " tuples were given");
  Values covered = Values::Ones(count);
  for (vtkIdType k = 0; coverage && k < count; ++k)
  {
    covered[k] = coverage->GetComponent(k, 0) != 0.0 ? 1.0 : 0.0;
  }
  return { width, height, { false, picture.rowwise() * covered, Values::Ones(count) },
    { false, expected.rowwise() * covered, Values::Ones(count) }, covered };
}

//------------------------------------------------------------------------------
// As a display shows them, with white at a radiance.
PicturePair Encode(PicturePair pair, double white)
{
  for (PictureValues* values : { &pair.Picture, &pair.Reference })
  {
    values->IsEncoded = true;
    values->Color = (values->Color / white).min(1.0).pow(1.0 / 2.2);
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
  catch (const std::runtime_error&)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
}
}

//------------------------------------------------------------------------------
bool vtkRadianceMetrics::Compare(vtkDataArray* radiance, vtkDataArray* reference)
{
  return RunGuarded(this, "Compare",
    [&]()
    {
      const auto [x, r] = ReadBoth(radiance, reference);
      const double mean = r.mean();
      Require(mean > 0.0, "The reference is black: no error is relative to it");
      const Colors d = (x - r).abs();
      std::vector<double> relative;
      std::vector<double> differences;
      for (Eigen::Index k = 0; k < d.cols(); ++k)
      {
        differences.push_back(d.col(k).sum() / (3.0 * mean));
        if (r.col(k).sum() > 0.0)
        {
          relative.push_back(d.col(k).sum() / r.col(k).sum());
        }
      }
      this->RelativeL1 = d.mean() / mean;
      this->RelativeRMSE = std::sqrt(d.square().mean()) / mean;
      this->RelMSE = (d.square() / (r.square() + RelMSEFloor * mean * mean)).mean();
      this->MedianRelative = GetPercentile(relative, 0.5);
      this->P99Relative = GetPercentile(relative, 0.99);
      this->Percentile95 = GetPercentile(differences, 0.95);
      this->Percentile99 = GetPercentile(differences, 0.99);
      this->SMAPE = (d > 0.0).select(d / (x + r), 0.0).mean();
    });
}

//------------------------------------------------------------------------------
bool vtkRadianceMetrics::ComparePictures(
  int width, int height, vtkDataArray* radiance, vtkDataArray* reference, vtkDataArray* coverage)
{
  return RunGuarded(this, "ComparePictures",
    [&]()
    {
      const PicturePair pair = MakePair(width, height, radiance, reference, coverage);
      this->Abort = false;
      std::vector<double> channels;
      for (Eigen::Index k = 0; k < pair.Compared.size(); ++k)
      {
        if (pair.Compared[k] > 0.0)
        {
          const double* color = &pair.Reference.Color(0, k);
          channels.insert(channels.end(), color, color + 3);
        }
      }
      const double white = GetPercentile(channels, 0.99);
      Require(white > 0.0, "The reference is black: nothing to set the exposure by");
      const PicturePair encoded = Encode(pair, white);
      const double flip = GetFigure(vtkPictureDifference::FLIP, encoded);
      const auto goOn = [this](double share)
      {
        this->InvokeEvent(vtkCommand::ProgressEvent, &share);
        return !this->Abort;
      };
      const Values largest = ComputeHDRFlip(width, height, pair.Picture.Color, pair.Reference.Color,
        FindExposures(pair.GetLuminances(pair.Reference.Color)), goOn);
      Require(largest.size() > 0 && goOn(1.0), "aborted");
      this->FLIP = flip;
      this->HDRFLIP = pair.GetMean(largest);
      this->SSIM = GetSimilarity(encoded);
      this->DeltaE2000 = GetFigure(vtkPictureDifference::DELTA_E_2000, encoded);
    });
}

//------------------------------------------------------------------------------
double vtkRadianceMetrics::ComputeDeltaE2000(const double lab1[3], const double lab2[3])
{
  return measuredbrdf::GetDeltaE2000(Eigen::Array3d(lab1), Eigen::Array3d(lab2));
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
