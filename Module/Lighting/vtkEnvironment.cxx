// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEnvironment.h"

#include "HalfVector.h" // for Pi
#include "Printable.h"
#include "ProceduralEnvironments.h"
#include "RadianceValues.h"
#include "SRGB.h"
#include "TexelInterpolation.h"
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
#include <cstddef>
#include <cstdint>
#include <iterator>
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
        const int row = k / samples;
        glm::dvec3 d;
        vtkEnvironment::GetDirection(
          (x + (k % samples + 0.5) / samples) / width, (y + (row + 0.5) / samples) / height, &d.x);
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

// Radiance at (u,v) of an environment that is not empty.
void Interpolate(vtkEnvironment* environment, double u, double v, double rgb[3])
{
  const std::size_t width = static_cast<std::size_t>(environment->GetWidth());
  const float* pixels = environment->GetPixels().data();
  measuredbrdf::InterpolateTexels(
    width, static_cast<std::size_t>(environment->GetHeight()), u, v,
    [&](std::size_t x, std::size_t y) { return pixels + 3 * (y * width + x); }, rgb);
}

// Maps of fewer rows are cut up to twice as many at least, and columns alike; but no map grows
// beyond the largest.
constexpr int LeastHeight = 64;
constexpr std::int64_t LargestSubdivided = std::int64_t(1) << 22;
} // namespace

using measuredbrdf::Pi;

vtkStandardNewMacro(vtkEnvironment);

//------------------------------------------------------------------------------
vtkEnvironment::vtkEnvironment()
  : Pixels(std::make_shared<std::vector<float>>())
  , Parts(vtkEnvironment::MakeParts())
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

  vtkFloatArray* floats = vtkArrayDownCast<vtkFloatArray>(scalars);
  if (floats && components == 3 && !sRGB)
  {
    const float* first = floats->GetPointer(0);
    return this->SetPixels(size[0], size[1], std::vector<float>(first, first + 3 * count));
  }
  std::vector<float> rgb;
  const measuredbrdf::BadValues bad = measuredbrdf::DecodeRadiance(scalars, count, sRGB, rgb);
  this->Adopt(size[0], size[1], std::move(rgb), bad.Negative, bad.NotFinite);
  return true;
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
  const measuredbrdf::BadValues bad = measuredbrdf::CleanRadiance(rgb);
  this->Adopt(width, height, std::move(rgb), bad.Negative, bad.NotFinite);
  return true;
}

//------------------------------------------------------------------------------
void vtkEnvironment::Adopt(
  int width, int height, std::vector<float> rgb, vtkIdType negative, vtkIdType notFinite)
{
  this->NumberOfNegativeValues = negative;
  this->NumberOfNonFiniteValues = notFinite;
  this->Width = width;
  this->Height = height;
  this->Pixels = std::make_shared<const std::vector<float>>(std::move(rgb));
  this->Subdivide();
  this->Parts = vtkEnvironment::MakeParts();
  this->PixelsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkEnvironment::Subdivide()
{
  this->Subdivided = nullptr;
  if (this->Width >= 2 * LeastHeight && this->Height >= LeastHeight)
  {
    return;
  }
  std::int64_t most = LargestSubdivided / (std::int64_t(this->Width) * this->Height);
  const auto getParts = [&most](int wanted, int size)
  {
    const std::int64_t parts =
      std::clamp<std::int64_t>((wanted - 1) / size + 1, 1, std::max<std::int64_t>(most, 1));
    most /= parts;
    return static_cast<int>(parts);
  };
  const int across = getParts(4 * LeastHeight, this->Width);
  const int up = getParts(2 * LeastHeight, this->Height);
  if (across == 1 && up == 1)
  {
    return;
  }
  const int width = across * this->Width;
  const int height = up * this->Height;
  std::vector<float> rgb;
  rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      double radiance[3];
      Interpolate(this, (x + 0.5) / width, (y + 0.5) / height, radiance);
      std::copy_n(radiance, 3, std::back_inserter(rgb));
    }
  }
  this->Subdivided = vtkSmartPointer<vtkEnvironment>::New();
  this->Subdivided->Name = this->Name;
  this->Subdivided->SetPixels(width, height, std::move(rgb));
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
  Interpolate(this, u, v, rgb);
}

//------------------------------------------------------------------------------
void vtkEnvironment::GetTotal(double rgb[3])
{
  if (this->Subdivided)
  {
    return this->Subdivided->GetTotal(rgb);
  }
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
double vtkEnvironment::GetLuminance(const double rgb[3]) { return measuredbrdf::GetLuminance(rgb); }

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
  snapshot->Subdivided = this->Subdivided; // replaced, never changed, as the pixels are
  snapshot->PixelsTime.Modified();
  return snapshot;
}

//------------------------------------------------------------------------------
void vtkEnvironment::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Name: " << measuredbrdf::ToPrintable(this->Name) << "\n";
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
