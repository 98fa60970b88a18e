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
    : Gamma(set->GetGamma())
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

  double GetLinear(double stored) const
  {
    if (this->Transfer == vtkPhotographSet::LINEAR)
    {
      return stored;
    }
    // Negative values, which noise makes, mirror the curve.
    const double magnitude = std::abs(stored);
    const double linear = this->Transfer == vtkPhotographSet::SRGB
                            ? DecodeSRGB(magnitude)
                            : std::pow(magnitude, this->Gamma);
    return std::copysign(std::min(linear, LargestValue), stored);
  }

  // Of each code; empty for types of more than 16 bits.
  std::vector<float> MakeTable(int type) const
  {
    const std::size_t codes = type == VTK_UNSIGNED_CHAR ? 256 : 65536;
    std::vector<float> table;
    for (std::size_t k = 0; k < codes && (type == VTK_UNSIGNED_CHAR || type == VTK_UNSIGNED_SHORT);
         ++k)
    {
      table.push_back(static_cast<float>(
        this->GetLinear(static_cast<double>(k) / static_cast<double>(codes - 1))));
    }
    return table;
  }

private:
  double Gamma;
  int Transfer;
  bool HasLevels;
  double Black;
  double Saturation;
};

std::string FindPictureProblem(vtkImageData* picture)
{
  const int* size = picture->GetDimensions();
  vtkDataArray* values = picture->GetPointData()->GetScalars();
  if (!values || size[0] < 1 || size[1] < 1 || size[2] != 1)
  {
    return "size: found " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
           std::to_string(size[2]) + (values ? "" : " without values") +
           ", expected a picture of one slice";
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
  return std::string();
}

std::string FormatSize(int width, int height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}
}

std::array<std::uint64_t, 4> PhotographPixels::CountStates() const
{
  std::array<std::uint64_t, 4> counts{};
  for (const PixelState state : this->States)
  {
    ++counts[static_cast<std::size_t>(state)];
  }
  return counts;
}

std::string ReadPhotograph(vtkPhotographSet* set, int index, PhotographPixels& pixels)
{
  const ScopedErrorCapture error(set);
  const auto picture = vtkSmartPointer<vtkImageData>::Take(set->NewPicture(index));
  if (!picture)
  {
    return error.GetText().empty() ? "there is no picture" : error.GetText();
  }
  const std::string problem = FindPictureProblem(picture);
  if (!problem.empty())
  {
    return problem;
  }
  vtkDataArray* values = picture->GetPointData()->GetScalars();
  const bool isFloat = IsFloat(values->GetDataType());
  const double divisor = isFloat ? 1.0 : values->GetDataTypeMax();
  const int components = values->GetNumberOfComponents();
  const Decoder decoder(set, isFloat);
  const std::vector<float> table = decoder.MakeTable(values->GetDataType());
  const vtkIdType count = values->GetNumberOfTuples();
  pixels.Width = picture->GetDimensions()[0];
  pixels.Height = picture->GetDimensions()[1];
  pixels.Values.assign(3 * static_cast<std::size_t>(count), 0.0f);
  pixels.States.assign(static_cast<std::size_t>(count), PixelState::Valid);
  for (vtkIdType k = 0; k < count; ++k)
  {
    double rgb[3];
    for (int c = 0; c < 3; ++c)
    {
      rgb[c] = values->GetComponent(k, components == 1 ? 0 : c) / divisor;
    }
    const PixelState state = decoder.GetState(rgb);
    pixels.States[static_cast<std::size_t>(k)] = state;
    for (int c = 0; c < 3 && state == PixelState::Valid; ++c)
    {
      pixels.Values[3 * static_cast<std::size_t>(k) + static_cast<std::size_t>(c)] =
        table.empty() ? static_cast<float>(decoder.GetLinear(rgb[c]))
                      : table[static_cast<std::size_t>(std::lround(rgb[c] * divisor))];
    }
  }
  return std::string();
}

PhotographPasses::PhotographPasses(vtkPhotographSet* set, std::function<bool(double)> proceed)
  : Set(set)
  , Report(std::move(proceed))
{
}

void PhotographPasses::Read(int index, PhotographPixels& pixels) const
{
  const std::string problem = ReadPhotograph(this->Set, index, pixels);
  if (problem.empty())
  {
    return;
  }
  const std::string name = this->Set->GetName(index);
  const bool named = !name.empty() && problem.find(name) != std::string::npos;
  throw PhotographError(
    (named ? "" : (name.empty() ? "photograph " + std::to_string(index) : name) + ": ") + problem);
}

void PhotographPasses::Open()
{
  PhotographPixels pixels;
  this->Read(0, pixels);
  this->Width = pixels.Width;
  this->Height = pixels.Height;
}

bool PhotographPasses::Run(
  double from, double to, const std::function<void(int, const PhotographPixels&)>& use)
{
  const int count = this->Set->GetNumberOfPhotographs();
  PhotographPixels pixels;
  for (int k = 0; k < count; ++k)
  {
    if (!this->Proceed(from + (to - from) * k / count))
    {
      return false;
    }
    this->Read(k, pixels);
    if (pixels.Width != this->Width || pixels.Height != this->Height)
    {
      const std::string name = this->Set->GetName(k);
      throw PhotographError((name.empty() ? "photograph " + std::to_string(k) : name) +
                            ": size: found " + FormatSize(pixels.Width, pixels.Height) +
                            ", expected the first photograph's " +
                            FormatSize(this->Width, this->Height));
    }
    if (this->NumberOfPasses == 0)
    {
      const auto counts = pixels.CountStates();
      std::transform(counts.begin(), counts.end(), this->PixelCounts.begin(),
        this->PixelCounts.begin(), std::plus<std::uint64_t>());
    }
    use(k, pixels);
  }
  ++this->NumberOfPasses;
  return true;
}

bool PhotographPasses::Proceed(double share)
{
  this->Stopped = this->Stopped || !this->Report(share);
  return !this->Stopped;
}
} // namespace measuredbrdf
