// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceMetrics.h"

#include "Flip.h"

#include "vtkDataArray.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkRadianceMetrics);

namespace
{
constexpr double ReferenceLuminance = 100.0; // cd/m2

//------------------------------------------------------------------------------
// Sorts the values. share in [0,1]; linear between neighbours.
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
// Perceptual quantizer of ITU-R BT.2100: cd/m2 -> [0,1].
double EncodePQ(double luminance)
{
  constexpr double m1 = 2610.0 / 16384.0;
  constexpr double m2 = 2523.0 / 4096.0 * 128.0;
  constexpr double c1 = 3424.0 / 4096.0;
  constexpr double c2 = 2413.0 / 4096.0 * 32.0;
  constexpr double c3 = 2392.0 / 4096.0 * 32.0;
  const double y = std::pow(std::clamp(luminance / 10000.0, 0.0, 1.0), m1);
  return std::pow((c1 + c2 * y) / (1.0 + c3 * y), m2);
}

//------------------------------------------------------------------------------
// Linear Rec. 709 in cd/m2 -> ITP of BT.2124: ICtCp of BT.2100 with Ct halved.
std::array<double, 3> ToITP(const double rgb[3])
{
  // Rec. 2020 (ITU-R BT.2087).
  const double r = 0.6274 * rgb[0] + 0.3293 * rgb[1] + 0.0433 * rgb[2];
  const double g = 0.0691 * rgb[0] + 0.9195 * rgb[1] + 0.0114 * rgb[2];
  const double b = 0.0164 * rgb[0] + 0.0880 * rgb[1] + 0.8956 * rgb[2];
  const double l = EncodePQ((1688.0 * r + 2146.0 * g + 262.0 * b) / 4096.0);
  const double m = EncodePQ((683.0 * r + 2951.0 * g + 462.0 * b) / 4096.0);
  const double s = EncodePQ((99.0 * r + 309.0 * g + 3688.0 * b) / 4096.0);
  return { 0.5 * (l + m), 0.5 * (6610.0 * l - 13613.0 * m + 7003.0 * s) / 4096.0,
    (17933.0 * l - 17390.0 * m - 543.0 * s) / 4096.0 };
}

//------------------------------------------------------------------------------
// Delta E ITP of linear radiance times scale.
double GetDeltaE(const double x[3], const double r[3], double scale)
{
  std::array<std::array<double, 3>, 2> itp;
  for (int k = 0; k < 2; ++k)
  {
    const double* from = k == 0 ? x : r;
    const double rgb[3] = { scale * from[0], scale * from[1], scale * from[2] };
    itp[k] = ToITP(rgb);
  }
  return 720.0 * std::hypot(itp[0][0] - itp[1][0], itp[0][1] - itp[1][1], itp[0][2] - itp[1][2]);
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
  double luminance = 0.0;
  double difference = 0.0;
  double squares = 0.0;
  double symmetric = 0.0;
  std::vector<double> relative;
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
    luminance += vtkEnvironment::GetLuminance(r);
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
  double deltaE = 0.0;
  for (vtkIdType k = 0; k < count; ++k)
  {
    radiance->GetTuple(k, x);
    reference->GetTuple(k, r);
    deltaE += GetDeltaE(x, r, ReferenceLuminance * static_cast<double>(count) / luminance);
  }
  const double values = 3.0 * static_cast<double>(count);
  this->RelativeL1 = difference / total;
  this->RelativeRMSE = std::sqrt(squares / values) * values / total;
  this->MedianRelative = GetPercentile(relative, 0.5);
  this->P99Relative = GetPercentile(relative, 0.99);
  this->SMAPE = symmetric / values;
  this->DeltaEITP = deltaE / static_cast<double>(count);
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
  const auto covers = [&](vtkIdType k) { return !coverage || coverage->GetComponent(k, 0) != 0.0; };
  std::vector<double> channels;
  for (vtkIdType k = 0; k < 3 * count; ++k)
  {
    if (covers(k / 3))
    {
      channels.push_back(reference->GetComponent(k / 3, static_cast<int>(k % 3)));
    }
  }
  const double white = GetPercentile(channels, 0.99);
  if (!(white > 0.0))
  {
    vtkErrorMacro("The reference is black: nothing to set the exposure by.");
    return false;
  }
  const auto map = [&](vtkDataArray* array)
  {
    std::vector<double> encoded;
    for (vtkIdType k = 0; k < 3 * count; ++k)
    {
      const double value = array->GetComponent(k / 3, static_cast<int>(k % 3)) / white;
      encoded.push_back(covers(k / 3) ? std::pow(std::min(value, 1.0), 1.0 / 2.2) : 0.0);
    }
    return encoded;
  };
  const std::vector<double> flip =
    measuredbrdf::ComputeFlip(width, height, map(radiance), map(reference));
  double sum = 0.0;
  for (vtkIdType k = 0; k < count; ++k)
  {
    sum += covers(k) ? flip[static_cast<std::size_t>(k)] : 0.0;
  }
  this->FLIP = 3.0 * sum / static_cast<double>(channels.size());
  return true;
}

//------------------------------------------------------------------------------
void vtkRadianceMetrics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RelativeL1: " << this->RelativeL1 << "\n";
  os << indent << "RelativeRMSE: " << this->RelativeRMSE << "\n";
  os << indent << "MedianRelative: " << this->MedianRelative << "\n";
  os << indent << "P99Relative: " << this->P99Relative << "\n";
  os << indent << "SMAPE: " << this->SMAPE << "\n";
  os << indent << "DeltaEITP: " << this->DeltaEITP << "\n";
  os << indent << "FLIP: " << this->FLIP << "\n";
}
