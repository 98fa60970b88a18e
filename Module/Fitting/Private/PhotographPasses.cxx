// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PhotographPasses.h"

#include "SRGB.h"
#include "ScopedErrorCapture.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPhotographSet.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Beyond this a value is as good as infinite: its square must fit into a double, and it into a
// float after any curve.
constexpr double LargestValue = 1e12;

bool IsFloat(int type) { return type == VTK_FLOAT || type == VTK_DOUBLE; }

// From stored values (integers: shares of their largest) to linear ones.
class Decoder
{
public:
  Decoder(vtkPhotographSet* set, bool isFloat)
    : Set(set)
    , Transfer(set->GetTransfer())
    , HasLevels(!isFloat || set->GetLevelsForFloats())
    , Black(set->GetBlackLevel())
    , Saturation(set->GetSaturationLevel())
  {
    if (this->Transfer == vtkPhotographSet::AUTOMATIC)
    {
      this->Transfer = isFloat ? vtkPhotographSet::LINEAR : vtkPhotographSet::SRGB;
    }
  }

  PixelState GetState(const double rgb[3]) const
  {
    const double largest = std::abs(rgb[0]) + std::abs(rgb[1]) + std::abs(rgb[2]);
    if (!(largest <= LargestValue)) // NaN, too
    {
      return PixelState::Invalid;
    }
    const double most = std::max({ rgb[0], rgb[1], rgb[2] });
    if (this->HasLevels && most >= this->Saturation)
    {
      return PixelState::Saturated;
    }
    return this->HasLevels && most <= this->Black ? PixelState::Black : PixelState::Valid;
  }

  float GetLinear(double stored) const
  {
    if (this->Transfer == vtkPhotographSet::LINEAR)
    {
      return static_cast<float>(stored);
    }
    // Negative values, which noise makes, mirror the curve.
    const double magnitude = std::abs(stored);
    const double linear = this->Transfer == vtkPhotographSet::SRGB
                            ? DecodeSRGB(magnitude)
                            : std::pow(magnitude, this->Set->GetGamma());
    return static_cast<float>(std::copysign(std::min(linear, LargestValue), stored));
  }

private:
  vtkPhotographSet* Set;
  int Transfer;
  bool HasLevels;
  double Black;
  double Saturation;
};

std::string FormatSize(int width, int height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}

// What keeps a picture from being a photograph; "" if nothing.
std::string FindPictureProblem(vtkImageData* picture)
{
  const int* size = picture->GetDimensions();
  vtkDataArray* values = picture->GetPointData()->GetScalars();
  if (!values || size[0] < 1 || size[1] < 1 || size[2] != 1)
  {
    return "size: found " + FormatSize(size[0], size[1]) + " x " + std::to_string(size[2]) +
           (values ? "" : " without values") + ", expected a picture of one slice";
  }
  const int components = values->GetNumberOfComponents();
  if (components != 1 && components != 3 && components != 4)
  {
    return "found " + std::to_string(components) + " components, expected 1, 3 or 4";
  }
  const int type = values->GetDataType();
  if (!IsFloat(type) && type != VTK_UNSIGNED_CHAR && type != VTK_UNSIGNED_SHORT &&
      type != VTK_UNSIGNED_INT)
  {
    return "found values of type " + std::string(values->GetDataTypeAsString()) +
           ", expected unsigned integers or floats";
  }
  return "";
}
}

PhotographPasses::PhotographPasses(vtkPhotographSet* set, std::function<bool(double)> report)
  : Set(set)
  , Report(std::move(report))
{
  const PhotographPixels first = this->Read(0);
  this->Width = first.Width;
  this->Height = first.Height;
}

PhotographPixels PhotographPasses::Read(int index) const
{
  const ScopedErrorCapture error(this->Set);
  const auto picture = vtkSmartPointer<vtkImageData>::Take(this->Set->NewPicture(index));
  std::string problem = picture                   ? FindPictureProblem(picture)
                        : error.GetText().empty() ? "there is no picture"
                                                  : error.GetText();
  PhotographPixels pixels;
  pixels.Width = picture ? picture->GetDimensions()[0] : 0;
  pixels.Height = picture ? picture->GetDimensions()[1] : 0;
  if (problem.empty() && this->Width > 0 &&
      (pixels.Width != this->Width || pixels.Height != this->Height))
  {
    problem = "size: found " + FormatSize(pixels.Width, pixels.Height) +
              ", expected the first photograph's " + FormatSize(this->Width, this->Height);
  }
  if (!problem.empty())
  {
    const std::string given = this->Set->GetName(index);
    const std::string name = given.empty() ? "photograph " + std::to_string(index) : given;
    const bool isNamed = problem.find(name) != std::string::npos;
    throw std::runtime_error(isNamed ? problem : name + ": " + problem);
  }
  vtkDataArray* values = picture->GetPointData()->GetScalars();
  const bool isFloat = IsFloat(values->GetDataType());
  const double divisor = isFloat ? 1.0 : values->GetDataTypeMax();
  const bool isGray = values->GetNumberOfComponents() == 1;
  const Decoder decoder(this->Set, isFloat);
  std::vector<float> table; // of each code, where there are few
  for (double code = 0.0; divisor <= 65535.0 && !isFloat && code <= divisor; ++code)
  {
    table.push_back(decoder.GetLinear(code / divisor));
  }
  for (vtkIdType k = 0; k < values->GetNumberOfTuples(); ++k)
  {
    double rgb[3];
    for (int c = 0; c < 3; ++c)
    {
      rgb[c] = values->GetComponent(k, isGray ? 0 : c) / divisor;
    }
    pixels.States.push_back(decoder.GetState(rgb));
    for (const double value : rgb)
    {
      pixels.Values.push_back(pixels.States.back() != PixelState::Valid ? 0.0f
                              : table.empty()
                                ? decoder.GetLinear(value)
                                : table[static_cast<std::size_t>(std::lround(value * divisor))]);
    }
  }
  return pixels;
}

void PhotographPasses::Run(
  double from, double to, const std::function<void(int, const PhotographPixels&)>& use)
{
  this->PixelCounts.fill(0);
  const int count = this->Set->GetNumberOfPhotographs();
  for (int k = 0; k < count; ++k)
  {
    this->Proceed(from + (to - from) * k / count);
    const PhotographPixels pixels = this->Read(k);
    for (const PixelState state : pixels.States)
    {
      ++this->PixelCounts[static_cast<std::size_t>(state)];
    }
    use(k, pixels);
  }
}

void PhotographPasses::Proceed(double share) const
{
  if (!this->Report(share))
  {
    throw MapFitStopped();
  }
}
} // namespace measuredbrdf
