// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEnvironmentProjection.h"

#include "ConservativeRemap.h"
#include "ParallelFor.h"
#include "ProjectionMaps.h"
#include "Projections.h"
#include "RadianceValues.h"
#include "Setters.h"

#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <utility>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkEnvironmentProjection);

// The maps know the projections by these numbers.
static_assert(static_cast<int>(vtkEnvironmentProjection::LAT_LONG) == Projections::LAT_LONG);
static_assert(static_cast<int>(vtkEnvironmentProjection::ANGULAR_MAP) == Projections::ANGULAR_MAP);
static_assert(static_cast<int>(vtkEnvironmentProjection::MIRROR_BALL) == Projections::MIRROR_BALL);
static_assert(static_cast<int>(vtkEnvironmentProjection::CUBE_HORIZONTAL_CROSS) ==
              Projections::CUBE_HORIZONTAL_CROSS);
static_assert(static_cast<int>(vtkEnvironmentProjection::CUBE_VERTICAL_CROSS) ==
              Projections::CUBE_VERTICAL_CROSS);
static_assert(static_cast<int>(vtkEnvironmentProjection::CUBE_HORIZONTAL_STRIP) ==
              Projections::CUBE_HORIZONTAL_STRIP);
static_assert(static_cast<int>(vtkEnvironmentProjection::CUBE_VERTICAL_STRIP) ==
              Projections::CUBE_VERTICAL_STRIP);

namespace
{
constexpr std::int64_t MaximumTexels = std::int64_t(1) << 28;
constexpr int MaximumHeight = 11585; // with twice as many columns

// About as many texels between two looks at the abort flag.
constexpr int BatchTexels = 1 << 16;

struct ProjectionInfo
{
  const char* Name;
  const char* Size;
};

constexpr ProjectionInfo ProjectionInfos[vtkEnvironmentProjection::NUMBER_OF_PROJECTIONS] = {
  { "lat-long", "any size" },
  { "angular map", "as many columns as rows" },
  { "mirror ball", "as many columns as rows" },
  { "horizontal cross", "4 square faces wide, 3 high" },
  { "vertical cross", "3 square faces wide, 4 high" },
  { "horizontal strip", "6 square faces wide, 1 high" },
  { "vertical strip", "1 square face wide, 6 high" },
};

//------------------------------------------------------------------------------
bool IsProjection(int projection)
{
  return projection >= 0 && projection < vtkEnvironmentProjection::NUMBER_OF_PROJECTIONS;
}

//------------------------------------------------------------------------------
// The center of the nearest texel whose center the disc holds lies in that of the returned point.
glm::dvec2 DrawIn(const glm::dvec2& uv, int size)
{
  const glm::dvec2 p = 2.0 * uv - 1.0;
  const double r = glm::length(p);
  const double limit = std::max(1.0 - std::sqrt(2.0) / size, 0.0); // half a texel's diagonal
  return r > limit ? 0.5 + 0.5 * limit / r * p : uv;
}
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(
  vtkEnvironmentProjection, Projection, int, LAT_LONG, NUMBER_OF_PROJECTIONS - 1);

//------------------------------------------------------------------------------
std::string vtkEnvironmentProjection::GetProjectionName(int projection)
{
  return IsProjection(projection) ? ProjectionInfos[projection].Name : "";
}

//------------------------------------------------------------------------------
std::string vtkEnvironmentProjection::GetExpectedSize(int projection)
{
  return IsProjection(projection) ? ProjectionInfos[projection].Size : "";
}

//------------------------------------------------------------------------------
bool vtkEnvironmentProjection::FitsSize(int projection, int width, int height)
{
  if (!IsProjection(projection) || width < 1 || height < 1)
  {
    return false;
  }
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    return width % layout->Columns == 0 && height % layout->Rows == 0 &&
           width / layout->Columns == height / layout->Rows;
  }
  return projection == LAT_LONG || width == height;
}

//------------------------------------------------------------------------------
bool vtkEnvironmentProjection::GetDirection(int projection, double u, double v, double direction[3])
{
  glm::dvec3 d(0.0);
  // Written so that NaN is refused too.
  const bool inside = u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0;
  const bool shown = IsProjection(projection) && inside && MapToDirection(projection, { u, v }, d);
  std::copy(&d.x, &d.x + 3, direction);
  return shown;
}

//------------------------------------------------------------------------------
bool vtkEnvironmentProjection::GetCoordinates(
  int projection, const double direction[3], double& u, double& v)
{
  u = v = 0.0;
  const double largest =
    std::max({ std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2]) });
  const double sum = direction[0] + direction[1] + direction[2];
  if (!IsProjection(projection) || !(largest > 0.0) || !std::isfinite(largest) || std::isnan(sum))
  {
    return false;
  }
  // Scaled, so that no finite length over- or underflows.
  const glm::dvec3 d(direction[0] / largest, direction[1] / largest, direction[2] / largest);
  const glm::dvec2 uv = MapToImage(projection, d);
  u = uv.x;
  v = uv.y;
  return true;
}

//------------------------------------------------------------------------------
double vtkEnvironmentProjection::GetJacobian(int projection, double u, double v)
{
  double ignored[3];
  return GetDirection(projection, u, v, ignored) ? GetDensity(projection, { u, v }) : 0.0;
}

//------------------------------------------------------------------------------
double vtkEnvironmentProjection::GetTexelSolidAngle(
  int projection, int width, int height, int x, int y)
{
  if (!IsProjection(projection) || x < 0 || y < 0 || x >= width || y >= height)
  {
    return 0.0;
  }
  return GetSolidAngle(projection, width, height, x, y);
}

//------------------------------------------------------------------------------
int vtkEnvironmentProjection::GetLatLongHeight(int projection, int width, int height)
{
  double texels = static_cast<double>(width) * height;
  if (const CubeLayout* layout = GetCubeLayout(projection))
  {
    texels *= 6.0 / (layout->Columns * layout->Rows);
  }
  else if (IsDisc(projection))
  {
    texels *= std::atan(1.0); // pi/4
  }
  return std::max(1, static_cast<int>(std::lround(std::sqrt(0.5 * texels))));
}

//------------------------------------------------------------------------------
bool vtkEnvironmentProjection::Convert(
  int width, int height, std::vector<float> rgb, vtkEnvironment* output)
{
  this->Abort = false;
  if (!output)
  {
    vtkErrorMacro("Convert: there is no output.");
    return false;
  }
  if (!FitsSize(this->Projection, width, height))
  {
    vtkErrorMacro("Convert: the size " << width << " x " << height << " is not that of a "
                                       << GetProjectionName(this->Projection) << ": expected "
                                       << GetExpectedSize(this->Projection) << ".");
    return false;
  }
  const std::int64_t texels = std::int64_t(width) * height;
  if (texels > MaximumTexels || rgb.size() != 3 * static_cast<std::size_t>(texels))
  {
    vtkErrorMacro("Convert: " << rgb.size() << " values are not RGB for " << width << " x "
                              << height << " texels, at most " << MaximumTexels << ".");
    return false;
  }
  this->Repair(this->Projection, width, height, rgb);
  if (this->Projection == LAT_LONG && this->Height == 0)
  {
    return output->SetPixels(width, height, std::move(rgb));
  }
  const int rows =
    this->Height > 0 ? this->Height : GetLatLongHeight(this->Projection, width, height);
  std::vector<float> result;
  return this->Resample(this->Projection, width, height, rgb, LAT_LONG, 2 * rows, rows, result) &&
         output->SetPixels(2 * rows, rows, std::move(result));
}

//------------------------------------------------------------------------------
bool vtkEnvironmentProjection::ConvertFaces(
  int size, const std::vector<std::vector<float>>& faces, vtkEnvironment* output)
{
  bool whole = faces.size() == 6 && size > 0 && std::int64_t(size) * size <= MaximumTexels / 6;
  for (const std::vector<float>& face : faces)
  {
    whole = whole && face.size() == 3 * static_cast<std::size_t>(size) * size;
  }
  if (!whole)
  {
    vtkErrorMacro("ConvertFaces: expected six faces of RGB for "
                  << size << " x " << size << " texels, at most " << MaximumTexels / 6 << " each.");
    return false;
  }
  // A vertical strip: +x at the top, -z in the first rows.
  std::vector<float> strip;
  strip.reserve(6 * faces[0].size());
  for (auto face = faces.rbegin(); face != faces.rend(); ++face)
  {
    strip.insert(strip.end(), face->begin(), face->end());
  }
  const int projection = std::exchange(this->Projection, CUBE_VERTICAL_STRIP);
  const bool converted = this->Convert(size, 6 * size, std::move(strip), output);
  this->Projection = projection;
  return converted;
}

//------------------------------------------------------------------------------
vtkImageData* vtkEnvironmentProjection::NewProbe(vtkEnvironment* environment, int width, int height)
{
  this->Abort = false;
  if (!environment || environment->GetPixels().empty())
  {
    vtkErrorMacro("NewProbe: there is no environment, or it is empty.");
    return nullptr;
  }
  if (!FitsSize(this->Projection, width, height) || std::int64_t(width) * height > MaximumTexels)
  {
    vtkErrorMacro("NewProbe: the size " << width << " x " << height << " is not that of a "
                                        << GetProjectionName(this->Projection) << ": expected "
                                        << GetExpectedSize(this->Projection) << ", at most "
                                        << MaximumTexels << " texels.");
    return nullptr;
  }
  std::vector<float> result;
  if (!this->Resample(LAT_LONG, environment->GetWidth(), environment->GetHeight(),
        environment->GetPixels(), this->Projection, width, height, result))
  {
    return nullptr;
  }
  vtkNew<vtkEnvironment> image;
  image->SetPixels(width, height, std::move(result));
  return image->NewImageData();
}

//------------------------------------------------------------------------------
// Bad values become 0, or the largest; rim texels whose center lies outside the disc take a
// neighbor's value.
void vtkEnvironmentProjection::Repair(
  int projection, int width, int height, std::vector<float>& rgb)
{
  const auto shows = [&](int x, int y)
  {
    const glm::dvec2 at((x + 0.5) / width, (y + 0.5) / height);
    glm::dvec3 ignored;
    return IsDisc(projection) ? MapToDirection(projection, at, ignored)
                              : !ShowsNothing(projection, at, at);
  };
  const float largest = GetLargestValue(rgb);
  std::atomic<vtkIdType> negative(0);
  std::atomic<vtkIdType> notFinite(0);
  measuredbrdf::ParallelFor(0, height,
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkIdType found[2] = { 0, 0 };
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      {
        float* value = &rgb[3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
        for (int x = 0; x < width; ++x)
        {
          const bool shown = shows(x, y);
          for (int c = 0; c < 3; ++c, ++value)
          {
            const bool finite = std::isfinite(*value);
            found[0] += shown && finite && *value < 0.0f;
            found[1] += shown && !finite;
            *value = shown && *value > 0.0f ? std::min(*value, largest) : 0.0f;
          }
        }
      }
      negative += found[0];
      notFinite += found[1];
    });
  this->NumberOfNegativeValues = negative;
  this->NumberOfNonFiniteValues = notFinite;
  for (int y = 0; IsDisc(projection) && y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      if (!shows(x, y))
      {
        const glm::dvec2 uv = DrawIn({ (x + 0.5) / width, (y + 0.5) / height }, width);
        const std::size_t from =
          static_cast<std::size_t>(uv.y * height) * width + static_cast<std::size_t>(uv.x * width);
        std::copy_n(&rgb[3 * from], 3, &rgb[3 * (static_cast<std::size_t>(y) * width + x)]);
      }
    }
  }
}

//------------------------------------------------------------------------------
bool vtkEnvironmentProjection::Resample(int sourceProjection, int sourceWidth, int sourceHeight,
  const std::vector<float>& source, int projection, int width, int height,
  std::vector<float>& result)
{
  const ConservativeRemap remap(
    { sourceProjection, sourceWidth, sourceHeight }, source, { projection, width, height });
  result.assign(3 * static_cast<std::size_t>(width) * height, 0.0f);
  const int batch = std::max(1, BatchTexels / width);
  for (int first = 0; first < height; first += batch)
  {
    const int last = std::min(first + batch, height);
    measuredbrdf::ParallelFor(static_cast<vtkIdType>(first) * width,
      static_cast<vtkIdType>(last) * width,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end && !this->Abort; ++k)
        {
          const glm::dvec3 mean =
            remap.GetMean(static_cast<int>(k % width), static_cast<int>(k / width));
          for (int c = 0; c < 3; ++c)
          {
            result[3 * static_cast<std::size_t>(k) + c] = static_cast<float>(mean[c]);
          }
        }
      });
    double progress = static_cast<double>(last) / height;
    this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
    if (this->Abort)
    {
      vtkErrorMacro("Conversion: aborted.");
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkEnvironmentProjection, Height, int, 0, MaximumHeight);

//------------------------------------------------------------------------------
void vtkEnvironmentProjection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Projection: " << GetProjectionName(this->Projection) << "\n";
  os << indent << "Height: " << this->Height << "\n";
  os << indent << "NumberOfNegativeValues: " << this->NumberOfNegativeValues << "\n";
  os << indent << "NumberOfNonFiniteValues: " << this->NumberOfNonFiniteValues << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
}
