// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEnvironment.h"

#include "SRGB.h"

#include "EnvironmentParts.h"
#include "HalfVector.h" // for Pi
#include "ProceduralEnvironments.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace
{
// RGB of a formula, each texel the mean of samples x samples points.
std::vector<float> Draw(
  int width, int height, int samples, glm::dvec3 (*radiance)(const glm::dvec3&))
{
  std::vector<float> rgb;
  rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      glm::dvec3 sum(0.0);
      for (int k = 0; k < samples * samples; ++k)
      {
        glm::dvec3 d;
        vtkEnvironment::GetDirection((x + (k % samples + 0.5) / samples) / width,
          (y + (k / samples + 0.5) / samples) / height, &d.x);
        sum += radiance(d);
      }
      for (int c = 0; c < 3; ++c)
      {
        rgb.push_back(static_cast<float>(sum[c] / (samples * samples)));
      }
    }
  }
  return rgb;
}
} // namespace

using measuredbrdf::Pi;

vtkStandardNewMacro(vtkEnvironment);

//------------------------------------------------------------------------------
vtkEnvironment::vtkEnvironment()
  : Pixels(std::make_shared<std::vector<float>>())
  , Parts(std::make_shared<measuredbrdf::EnvironmentParts>())
{
}

//------------------------------------------------------------------------------
vtkEnvironment::~vtkEnvironment() = default;

//------------------------------------------------------------------------------
bool vtkEnvironment::SetImage(vtkImageData* image, bool sRGB)
{
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!scalars)
  {
    vtkErrorMacro("SetImage: no image, or an image without point scalars.");
    return false;
  }
  int size[3];
  image->GetDimensions(size);
  const int components = scalars->GetNumberOfComponents();
  if (size[0] < 1 || size[1] < 1 || size[2] != 1 ||
      (components != 1 && components != 3 && components != 4))
  {
    vtkErrorMacro("SetImage: expected one slice with 1, 3 or 4 components, got "
                  << size[0] << " x " << size[1] << " x " << size[2] << " with " << components
                  << " components.");
    return false;
  }
  const vtkIdType count = static_cast<vtkIdType>(size[0]) * size[1];
  if (scalars->GetNumberOfTuples() < count)
  {
    vtkErrorMacro("SetImage: the image has " << scalars->GetNumberOfTuples() << " scalars, "
                                             << count << " are needed.");
    return false;
  }

  const int type = scalars->GetDataType();
  const double scale =
    type == VTK_FLOAT || type == VTK_DOUBLE ? 1.0 : 1.0 / scalars->GetDataTypeMax();
  std::vector<float> rgb(3 * static_cast<std::size_t>(count));
  for (vtkIdType k = 0; k < count; ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      double value = scalars->GetComponent(k, components == 1 ? 0 : c) * scale;
      value = sRGB && value > 0.0 ? measuredbrdf::DecodeSRGB(value) : value;
      // Beyond float's range counts as infinite.
      const bool fits = std::abs(value) <= std::numeric_limits<float>::max();
      rgb[3 * static_cast<std::size_t>(k) + c] =
        fits ? static_cast<float>(value) : std::numeric_limits<float>::infinity();
    }
  }
  return this->SetPixels(size[0], size[1], std::move(rgb));
}

//------------------------------------------------------------------------------
bool vtkEnvironment::SetPixels(int width, int height, std::vector<float> rgb)
{
  if (width < 1 || height < 1 || rgb.size() % 3 != 0 ||
      rgb.size() / 3 / width != std::size_t(height) || rgb.size() / 3 % width != 0)
  {
    vtkErrorMacro("SetPixels: " << rgb.size() << " values are not RGB for " << width << " x "
                                << height << " texels.");
    return false;
  }
  this->NumberOfNegativeValues = 0;
  this->NumberOfNonFiniteValues = 0;
  for (float& value : rgb)
  {
    if (!std::isfinite(value))
    {
      ++this->NumberOfNonFiniteValues;
      value = 0.0f;
    }
    else if (value < 0.0f)
    {
      ++this->NumberOfNegativeValues;
      value = 0.0f;
    }
  }
  this->Width = width;
  this->Height = height;
  this->Pixels = std::make_shared<const std::vector<float>>(std::move(rgb));
  this->Parts = std::make_shared<measuredbrdf::EnvironmentParts>();
  this->PixelsTime.Modified();
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
void vtkEnvironment::SetToProceduralSky()
{
  this->SetPixels(256, 128, Draw(256, 128, 1, measuredbrdf::GetSkyRadiance));
  this->SetName("procedural sky");
}

//------------------------------------------------------------------------------
void vtkEnvironment::SetToProceduralHall()
{
  this->SetPixels(512, 256, Draw(512, 256, 4, measuredbrdf::GetHallRadiance));
  this->SetName("procedural hall");
}

//------------------------------------------------------------------------------
void vtkEnvironment::GetPixel(int x, int y, double rgb[3])
{
  if (x < 0 || x >= this->Width || y < 0 || y >= this->Height)
  {
    std::fill(rgb, rgb + 3, 0.0);
    return;
  }
  const std::size_t k = 3 * (static_cast<std::size_t>(y) * this->Width + x);
  for (int c = 0; c < 3; ++c)
  {
    rgb[c] = (*this->Pixels)[k + c];
  }
}

//------------------------------------------------------------------------------
void vtkEnvironment::GetTexelDirection(int x, int y, double direction[3])
{
  vtkEnvironment::GetDirection((x + 0.5) / this->Width, (y + 0.5) / this->Height, direction);
}

//------------------------------------------------------------------------------
void vtkEnvironment::GetDirection(double u, double v, double direction[3])
{
  const double phi = 2.0 * Pi * (u - 0.5);
  const double latitude = Pi * (v - 0.5);
  direction[0] = std::cos(latitude) * std::cos(phi);
  direction[1] = std::sin(latitude);
  direction[2] = std::cos(latitude) * std::sin(phi);
}

//------------------------------------------------------------------------------
void vtkEnvironment::GetCoordinates(const double direction[3], double& u, double& v)
{
  u = std::atan2(direction[2], direction[0]) / (2.0 * Pi) + 0.5;
  // asin(y) without its loss of digits at the poles, and for any length.
  v = std::atan2(direction[1], std::hypot(direction[0], direction[2])) / Pi + 0.5;
}

//------------------------------------------------------------------------------
double vtkEnvironment::GetTexelSolidAngle(int y)
{
  if (y < 0 || y >= this->Height)
  {
    return 0.0;
  }
  // dphi (cos theta0 - cos theta1) as a product, which keeps its digits at the poles.
  return 2.0 * Pi / this->Width * 2.0 * std::sin(Pi / (2.0 * this->Height)) *
         std::sin(Pi * (y + 0.5) / this->Height);
}

//------------------------------------------------------------------------------
void vtkEnvironment::GetRadiance(const double direction[3], double rgb[3])
{
  double u;
  double v;
  vtkEnvironment::GetCoordinates(direction, u, v);
  if (this->Pixels->empty() || !std::isfinite(u) || !std::isfinite(v))
  {
    std::fill(rgb, rgb + 3, 0.0);
    return;
  }
  this->GetPixel(std::clamp(static_cast<int>(u * this->Width), 0, this->Width - 1),
    std::clamp(static_cast<int>(v * this->Height), 0, this->Height - 1), rgb);
}

//------------------------------------------------------------------------------
void vtkEnvironment::GetTotal(double rgb[3])
{
  std::fill(rgb, rgb + 3, 0.0);
  const float* pixel = this->Pixels->data();
  for (int y = 0; y < this->Height; ++y)
  {
    double row[3] = { 0.0, 0.0, 0.0 };
    for (int x = 0; x < this->Width; ++x, pixel += 3)
    {
      row[0] += pixel[0];
      row[1] += pixel[1];
      row[2] += pixel[2];
    }
    const double solidAngle = this->GetTexelSolidAngle(y);
    for (int c = 0; c < 3; ++c)
    {
      rgb[c] += row[c] * solidAngle;
    }
  }
}

//------------------------------------------------------------------------------
double vtkEnvironment::GetLuminance(const double rgb[3])
{
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

//------------------------------------------------------------------------------
void vtkEnvironment::SetWorldToEnvironment(const double matrix[9])
{
  const glm::dvec3 rows[3] = { { matrix[0], matrix[1], matrix[2] },
    { matrix[3], matrix[4], matrix[5] }, { matrix[6], matrix[7], matrix[8] } };
  bool rotation = true;
  for (int j = 0; j < 3; ++j)
  {
    for (int k = 0; k < 3; ++k)
    {
      // Written so that NaN is refused too.
      rotation = rotation && std::abs(glm::dot(rows[j], rows[k]) - (j == k ? 1.0 : 0.0)) <= 1e-6;
    }
  }
  if (!rotation || glm::dot(glm::cross(rows[0], rows[1]), rows[2]) < 0.0)
  {
    vtkErrorMacro("SetWorldToEnvironment: the matrix is not a rotation.");
    return;
  }
  if (!std::equal(matrix, matrix + 9, this->WorldToEnvironment))
  {
    std::copy(matrix, matrix + 9, this->WorldToEnvironment);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkEnvironment::GetWorldToEnvironment(double matrix[9])
{
  std::copy(this->WorldToEnvironment, this->WorldToEnvironment + 9, matrix);
}

//------------------------------------------------------------------------------
void vtkEnvironment::SetRotationY(double degrees)
{
  // The environment turns by +angle, so world directions turn back by it.
  const double angle = vtkMath::RadiansFromDegrees(degrees);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double matrix[9] = { c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c };
  this->SetWorldToEnvironment(matrix);
}

//------------------------------------------------------------------------------
vtkImageData* vtkEnvironment::NewImageData()
{
  vtkNew<vtkFloatArray> radiance;
  radiance->SetName("Radiance");
  radiance->SetNumberOfComponents(3);
  radiance->SetNumberOfTuples(static_cast<vtkIdType>(this->Pixels->size() / 3));
  std::copy(this->Pixels->begin(), this->Pixels->end(), radiance->GetPointer(0));

  vtkImageData* image = vtkImageData::New();
  image->SetDimensions(this->Width, this->Height, this->Pixels->empty() ? 0 : 1);
  image->GetPointData()->SetScalars(radiance);
  return image;
}

//------------------------------------------------------------------------------
vtkEnvironment* vtkEnvironment::NewSnapshot()
{
  vtkEnvironment* snapshot = vtkEnvironment::New();
  snapshot->Name = this->Name;
  snapshot->Width = this->Width;
  snapshot->Height = this->Height;
  snapshot->Pixels = this->Pixels;
  snapshot->Parts = this->Parts;
  snapshot->NumberOfNegativeValues = this->NumberOfNegativeValues;
  snapshot->NumberOfNonFiniteValues = this->NumberOfNonFiniteValues;
  std::copy_n(this->WorldToEnvironment, 9, snapshot->WorldToEnvironment);
  snapshot->PixelsTime.Modified();
  return snapshot;
}

//------------------------------------------------------------------------------
void vtkEnvironment::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Name: " << this->Name << "\n";
  os << indent << "Width: " << this->Width << "\n";
  os << indent << "Height: " << this->Height << "\n";
  os << indent << "NumberOfNegativeValues: " << this->NumberOfNegativeValues << "\n";
  os << indent << "NumberOfNonFiniteValues: " << this->NumberOfNonFiniteValues << "\n";
  os << indent << "PixelsMTime: " << this->PixelsTime.GetMTime() << "\n";
  os << indent << "WorldToEnvironment:";
  for (double element : this->WorldToEnvironment)
  {
    os << " " << element;
  }
  os << "\n";
}
