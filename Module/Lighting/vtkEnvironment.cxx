// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEnvironment.h"

#include "HalfVector.h" // for Pi
#include "Neighbors.h"
#include "Printable.h"
#include "RadianceValues.h"
#include "SRGB.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

using measuredbrdf::Pi;

namespace
{
double Smooth(double t)
{
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// exp(x) as a share of radiances of 0.01 and more: below exp(-60) no digit of theirs changes, and
// exp is slow where it underflows.
double GetShare(double x) { return x > -60.0 ? std::exp(x) : 0.0; }

// The hall, in metres around the viewer's eye.
constexpr double HalfWidth = 7.0, Floor = -1.6, Ceiling = 14.0, HalfLength = 24.0;
constexpr double Bay = 6.0; // from window to window

// Distance from the middle of a bay, in [-Bay/2, Bay/2].
double GetBayOffset(double z) { return z - Bay * std::floor(z / Bay + 0.5); }

// Whether a point of a wall (across, up) lies in a window with a round arch, and not on its bars.
bool IsGlass(double across, double up, double halfWidth, double sill, double springing)
{
  if (up < sill || std::abs(across) > halfWidth ||
      (up > springing && std::hypot(across, up - springing) > halfWidth))
  {
    return false;
  }
  const bool mullion = std::abs(across) < 0.06 * halfWidth + 0.03;
  const bool bar = std::abs(std::remainder(up, 1.2)) < 0.05;
  return !mullion && !bar;
}

// Courses of stone.
glm::dvec3 GetStone(double across, double up)
{
  const double course = std::floor(up / 0.6);
  const double shift = 0.5 * std::fmod(std::abs(course), 2.0);
  const double block = std::floor(across / 1.3 + shift);
  const double shade = 0.85 + 0.15 * std::sin(12.9898 * block + 78.233 * course);
  return glm::dvec3(0.050, 0.040, 0.031) * shade;
}

glm::dvec3 GetSideWall(const glm::dvec3& p)
{
  const double across = GetBayOffset(p.z);
  if (IsGlass(across, p.y, 1.0, 3.2, 9.2))
  {
    // The sun stands behind one side, the sky behind the other.
    return p.x < 0.0 ? glm::dvec3(34.0, 25.0, 15.0) : glm::dvec3(5.0, 6.5, 9.0);
  }
  const double pillar = Smooth((std::abs(across) - 2.4) / 0.3);
  return GetStone(p.z, p.y) * (1.0 - 0.6 * pillar) * (0.6 + 0.05 * (p.y - Floor));
}

glm::dvec3 GetEndWall(const glm::dvec3& p)
{
  if (p.z < 0.0) // the choir: three tall bright windows
  {
    const double across = p.x - 3.4 * std::clamp(std::round(p.x / 3.4), -1.0, 1.0);
    if (IsGlass(across, p.y, 1.1, 1.6, 8.5))
    {
      return { 22.0, 23.0, 26.0 };
    }
    return GetStone(p.x, p.y);
  }
  const double r = std::hypot(p.x, p.y - 7.0);
  const double turn = std::atan2(p.y - 7.0, p.x) / (2.0 * Pi);
  if (r < 3.6)
  {
    const bool spoke = std::abs(std::remainder(turn, 1.0 / 12.0)) * r * 2.0 * Pi < 0.09;
    const bool ring = std::abs(r - 1.2) < 0.08 || std::abs(r - 2.6) < 0.08;
    if (spoke || ring)
    {
      return { 0.02, 0.018, 0.016 };
    }
    const double petal = std::floor(turn * 12.0) + (r > 1.2 ? 1.0 : 0.0) + (r > 2.6 ? 1.0 : 0.0);
    const double phase = std::fmod(petal + 24.0, 3.0);
    return phase < 1.0 ? glm::dvec3(26.0, 7.0, 3.0)
                       : (phase < 2.0 ? glm::dvec3(4.0, 9.0, 24.0) : glm::dvec3(24.0, 19.0, 9.0));
  }
  return GetStone(p.x, p.y);
}

glm::dvec3 GetFloor(const glm::dvec3& p)
{
  const bool dark = (static_cast<long>(std::floor(p.x)) + static_cast<long>(std::floor(p.z))) & 1;
  const glm::dvec3 tile = dark ? glm::dvec3(0.045, 0.035, 0.03) : glm::dvec3(0.10, 0.085, 0.07);
  // Sunlight through the windows lies aslant on the tiles.
  const double across = GetBayOffset(p.z - 0.5 * p.x);
  const bool sunny = p.x > 1.6 && p.x < 5.6 && std::abs(across) < 0.9;
  return sunny ? tile * 14.0 : tile;
}

glm::dvec3 GetCeiling(const glm::dvec3& p)
{
  const double rib = std::min(std::abs(GetBayOffset(p.z + 0.5 * Bay)), std::abs(p.x));
  return glm::dvec3(0.030, 0.022, 0.016) * (0.6 + 0.8 * Smooth((0.4 - rib) / 0.2));
}

//------------------------------------------------------------------------------
// A clear sky with a sun over brown ground.
glm::dvec3 GetSkyRadiance(const glm::dvec3& d)
{
  // L(d) = s (zenith + (horizon - zenith) exp(-5 d.y) + sun + glow) + (1 - s) ground, s = 1 above
  // the horizon; sun and glow are lobes a exp(k (d.sun - 1)) of integral 2 pi a/k (Fisher 1953):
  // the sun gives an irradiance of about 6, the blue sky about 1.4.
  const glm::dvec3 zenith(0.16, 0.32, 0.72);
  const glm::dvec3 horizon(0.72, 0.84, 1.0);
  const glm::dvec3 ground(0.21, 0.18, 0.15);
  const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.5, 0.65, 0.6));
  const glm::dvec3 sun = 1430.0 * glm::dvec3(1.0, 0.93, 0.82);
  const glm::dvec3 glow = 0.9 * glm::dvec3(1.0, 0.9, 0.75);
  const double sunSharpness = 1500.0;
  const double glowSharpness = 14.0;
  const double fromSun = glm::dot(d, toSun) - 1.0;
  const glm::dvec3 sky = glm::mix(zenith, horizon, std::exp(-5.0 * std::max(d.y, 0.0))) +
                         sun * GetShare(sunSharpness * fromSun) +
                         glow * std::exp(glowSharpness * fromSun);
  // Sky and ground meet over this much of d.y; a hard edge would alias.
  return glm::mix(ground, sky, Smooth(0.5 + d.y / 0.04));
}

//------------------------------------------------------------------------------
// A dark stone hall with bright arched windows, a rose window and lamps: the kind of light that
// Debevec's Grace Cathedral map made common.
glm::dvec3 GetHallRadiance(const glm::dvec3& d)
{
  const auto reach = [](double component, double low, double high)
  { return component > 1e-12 ? high / component : (component < -1e-12 ? low / component : 1e30); };
  const double x = reach(d.x, -HalfWidth, HalfWidth);
  const double y = reach(d.y, Floor, Ceiling);
  const double z = reach(d.z, -HalfLength, HalfLength);
  const double t = std::min({ x, y, z });
  const glm::dvec3 p = t * d;
  glm::dvec3 radiance =
    t == y ? (d.y < 0.0 ? GetFloor(p) : GetCeiling(p)) : (t == x ? GetSideWall(p) : GetEndWall(p));
  // Lamps under the vault.
  static const glm::dvec3 lamps[] = { glm::normalize(glm::dvec3(0.8, 5.5, -12.0)),
    glm::normalize(glm::dvec3(0.8, 5.5, -5.0)), glm::normalize(glm::dvec3(0.8, 5.5, 6.0)),
    glm::normalize(glm::dvec3(0.8, 5.5, 13.0)) };
  for (const glm::dvec3& lamp : lamps)
  {
    radiance += glm::dvec3(900.0, 620.0, 330.0) * GetShare(6000.0 * (glm::dot(d, lamp) - 1.0));
  }
  return radiance;
}
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
      const glm::vec3 mean(sum / static_cast<double>(samples * samples));
      rgb.insert(rgb.end(), &mean.x, &mean.x + 3);
    }
  }
  return rgb;
}

// Radiance at (u,v) of an environment that is not empty.
glm::dvec3 Interpolate(vtkEnvironment* environment, double u, double v)
{
  const std::vector<float>& pixels = environment->GetPixels();
  const int width = environment->GetWidth();
  return measuredbrdf::InterpolateTexels(width, environment->GetHeight(), u, v,
    [&](std::size_t x, std::size_t y)
    { return glm::dvec3(glm::make_vec3(&pixels[3 * (y * width + x)])); });
}

// Maps of fewer rows are cut up to twice as many at least, and columns alike; but no map grows
// beyond the largest.
constexpr int LeastHeight = 64;
constexpr std::int64_t LargestSubdivided = std::int64_t(1) << 22;
} // namespace

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
      const glm::vec3 radiance(Interpolate(this, (x + 0.5) / width, (y + 0.5) / height));
      rgb.insert(rgb.end(), &radiance.x, &radiance.x + 3);
    }
  }
  this->Subdivided = vtkSmartPointer<vtkEnvironment>::New();
  this->Subdivided->Name = this->Name;
  this->Subdivided->SetPixels(width, height, std::move(rgb));
}

//------------------------------------------------------------------------------
void vtkEnvironment::SetToProceduralSky()
{
  this->SetPixels(256, 128, Draw(256, 128, 1, GetSkyRadiance));
  this->SetName("procedural sky");
}

//------------------------------------------------------------------------------
void vtkEnvironment::SetToProceduralHall()
{
  this->SetPixels(512, 256, Draw(512, 256, 4, GetHallRadiance));
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
  std::copy_n(&(*this->Pixels)[3 * (static_cast<std::size_t>(y) * this->Width + x)], 3, rgb);
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
  const bool isSeen = !this->Pixels->empty() && std::isfinite(u) && std::isfinite(v);
  const glm::dvec3 radiance = isSeen ? Interpolate(this, u, v) : glm::dvec3(0.0);
  std::copy_n(&radiance.x, 3, rgb);
}

//------------------------------------------------------------------------------
void vtkEnvironment::GetTotal(double rgb[3])
{
  if (this->Subdivided)
  {
    return this->Subdivided->GetTotal(rgb);
  }
  glm::dvec3 total(0.0);
  const float* pixel = this->Pixels->data();
  for (int y = 0; y < this->Height; ++y)
  {
    glm::dvec3 row(0.0);
    for (int x = 0; x < this->Width; ++x, pixel += 3)
    {
      row += glm::dvec3(pixel[0], pixel[1], pixel[2]);
    }
    total += row * this->GetTexelSolidAngle(y);
  }
  std::copy_n(&total.x, 3, rgb);
}

//------------------------------------------------------------------------------
double vtkEnvironment::GetLuminance(const double rgb[3]) { return measuredbrdf::GetLuminance(rgb); }

//------------------------------------------------------------------------------
void vtkEnvironment::SetWorldToEnvironment(const double matrix[9])
{
  const glm::dmat3 rows = glm::make_mat3(matrix);
  const glm::dmat3 difference = glm::transpose(rows) * rows - glm::dmat3(1.0);
  const double* first = glm::value_ptr(difference);
  // Written so that NaN is refused too.
  const bool rotation =
    std::all_of(first, first + 9, [](double value) { return std::abs(value) <= 1e-6; });
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
