// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEnvironmentReader.h"

#include "FileBytes.h"
#include "ImageFile.h"
#include "LightProbe.h"
#include "SRGB.h"
#include "Setters.h"
#include "vtkObjectFactory.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

vtkStandardNewMacro(vtkEnvironmentReader);

namespace
{
using namespace measuredbrdf;

// The maps know the projections by these numbers.
static_assert(
  static_cast<int>(Projection::LatLong) == vtkEnvironmentReader::LAT_LONG &&
  static_cast<int>(Projection::VerticalStrip) == vtkEnvironmentReader::CUBE_VERTICAL_STRIP);

//------------------------------------------------------------------------------
// Linear RGB, row 0 at the bottom.
ImageFile ReadLinear(const std::string& path, const std::string& layer)
{
  ImageFile image = ReadImageFile(path, false, layer);
  std::vector<float>& pixels = image.Pixels;
  std::vector<std::string> notes;
  if (image.IsEncoded)
  {
    std::transform(pixels.begin(), pixels.end(), pixels.begin(),
      [](float value) { return static_cast<float>(DecodeSRGB(value)); });
    notes.emplace_back("Integer values were taken as sRGB-encoded and made linear.");
  }
  if (image.IsGray)
  {
    notes.emplace_back("One channel: taken as gray.");
  }
  image.Notes.insert(image.Notes.begin(), notes.begin(), notes.end());
  const std::ptrdiff_t row = std::ptrdiff_t(3) * image.Width;
  for (int y = 0; y < image.Height / 2; ++y)
  {
    std::swap_ranges(pixels.begin() + y * row, pixels.begin() + (y + 1) * row,
      pixels.begin() + (image.Height - 1 - y) * row);
  }
  return image;
}

std::string FormatSize(const ImageFile& image) { return Concat(image.Width, " x ", image.Height); }

//------------------------------------------------------------------------------
// What an image without a given projection is by its shape.
Projection DetectProjection(ImageFile& image)
{
  if (image.Envmap != ImageEnvmap::None)
  {
    return image.Envmap == ImageEnvmap::Cube ? Projection::VerticalStrip : Projection::LatLong;
  }
  constexpr int smallestFace = 8;
  for (const Projection projection : { Projection::HorizontalCross, Projection::VerticalCross,
         Projection::HorizontalStrip, Projection::VerticalStrip })
  {
    const int longest = std::max(image.Width, image.Height);
    const int faces = projection <= Projection::VerticalCross ? 4 : 6;
    if (longest >= faces * smallestFace && FitsProjection(projection, image.Width, image.Height))
    {
      image.Notes.push_back(
        "By its size taken as a " + GetProjectionName(projection) + " of cube faces.");
      return projection;
    }
  }
  return Projection::LatLong;
}

//------------------------------------------------------------------------------
// OpenEXR's envmap attribute says where the axes are (ImfEnvmap.h); elsewhere images follow VTK.
void AlignWithAxes(Projection projection, ImageFile& image)
{
  const std::ptrdiff_t row = std::ptrdiff_t(3) * image.Width;
  const auto begin = image.Pixels.begin();
  if (image.Envmap == ImageEnvmap::Cube && projection == Projection::VerticalStrip &&
      std::int64_t(image.Height) == 6 * std::int64_t(image.Width))
  {
    // The last two faces are +z and -z as they are seen there; in OpenGL's cubes, what is seen
    // towards -z comes first.
    const std::ptrdiff_t face = row * image.Width;
    std::swap_ranges(begin, begin + face, begin + face);
  }
  else if (image.Envmap == ImageEnvmap::LatLong && projection == Projection::LatLong)
  {
    // The center is +z and +x is in the middle of the left half; here, the center is +x.
    const std::ptrdiff_t quarter = 3 * ((std::ptrdiff_t(image.Width) + 2) / 4);
    for (auto at = begin; at != image.Pixels.end(); at += row)
    {
      std::rotate(at, at + (row - quarter), at + row);
    }
  }
}

//------------------------------------------------------------------------------
// Returns what was set to 0 of a probe that had to be converted.
BadValues FillFromImage(const std::string& path, Projection projection, bool given,
  ImageFile& image, vtkEnvironment* environment)
{
  if (projection != Projection::LatLong)
  {
    Require(FitsProjection(projection, image.Width, image.Height), path, ": image size: found ",
      FormatSize(image), ", expected ", GetExpectedSize(projection), " for a probe of type ",
      GetProjectionName(projection));
    const auto bad =
      ConvertProbe(projection, image.Width, image.Height, std::move(image.Pixels), environment);
    Require(bad.has_value(), path, ": image pixels: were refused");
    return *bad;
  }
  if (std::int64_t(image.Width) != 2 * std::int64_t(image.Height))
  {
    image.Notes.push_back(
      "The size " + FormatSize(image) + " is not 2:1; it is stretched over the sphere.");
  }
  if (image.Width == image.Height && !given)
  {
    image.Notes.emplace_back(
      "Square images are often angular maps or mirror balls: say so if it is one.");
  }
  Require(environment->SetPixels(image.Width, image.Height, std::move(image.Pixels)), path,
    ": image pixels: were refused");
  return {};
}

//------------------------------------------------------------------------------
// The six files that a pattern stands for: the set of names whose first file is there.
std::vector<std::string> FindFaces(const std::string& pattern)
{
  static const std::vector<std::string> names[] = { { "px", "nx", "py", "ny", "pz", "nz" },
    { "posx", "negx", "posy", "negy", "posz", "negz" },
    { "right", "left", "top", "bottom", "front", "back" } };
  const std::size_t at = pattern.find("%s");
  for (const std::vector<std::string>& set : names)
  {
    std::vector<std::string> paths;
    for (const std::string& name : set)
    {
      paths.push_back(pattern.substr(0, at) + name + pattern.substr(at + 2));
    }
    if (vtksys::SystemTools::FileExists(paths.front(), true))
    {
      return paths;
    }
  }
  throw FileError(pattern, ": cube faces: found no file with %s replaced by px, posx or right");
}

//------------------------------------------------------------------------------
// first: what is noted of it. Returns what was set to 0.
BadValues FillFromFaces(const std::string& pattern, const std::string& layer, ImageFile& first,
  vtkEnvironment* environment)
{
  const std::vector<std::string> paths = FindFaces(pattern);
  std::vector<std::vector<float>> faces;
  for (const std::string& path : paths)
  {
    ImageFile image = ReadLinear(path, layer);
    const auto require = [&](bool condition, const auto&... expected) {
      Require(
        condition, path, ": cube face: found ", FormatSize(image), ", expected ", expected...);
    };
    constexpr std::int64_t most = MaximumProbeTexels / 6;
    require(image.Width == image.Height, "a square");
    require(std::int64_t(image.Width) * image.Height <= most, "six faces of at most ", most,
      " texels each");
    require(faces.empty() || image.Width == first.Width, FormatSize(first), " as ", paths.front());
    faces.push_back(std::move(image.Pixels));
    if (faces.size() == 1)
    {
      first = std::move(image);
    }
  }
  const auto bad = ConvertCubeFaces(first.Width, faces, environment);
  Require(bad.has_value(), pattern, ": image pixels: were refused");
  return *bad;
}
}

//------------------------------------------------------------------------------
bool vtkEnvironmentReader::Read()
{
  this->ErrorMessage.clear();
  this->Notes.clear();
  const bool done = measuredbrdf::CatchFileError(this->FileName, this->ErrorMessage,
    [&]()
    {
      ImageFile image;
      BadValues bad;
      const auto environment = vtkSmartPointer<vtkEnvironment>::New();
      if (this->FileName.find("%s") != std::string::npos &&
          !vtksys::SystemTools::FileExists(this->FileName)) // "80%sky.hdr" is a name, too
      {
        bad = FillFromFaces(this->FileName, this->Layer, image, environment);
      }
      else
      {
        image = ReadLinear(this->FileName, this->Layer);
        const bool given = this->Projection != AUTOMATIC;
        const auto projection =
          given ? static_cast<measuredbrdf::Projection>(this->Projection) : DetectProjection(image);
        AlignWithAxes(projection, image);
        bad = FillFromImage(this->FileName, projection, given, image, environment);
      }
      environment->SetName(GetFileStem(this->FileName));
      const vtkIdType negative = environment->GetNumberOfNegativeValues() + bad.Negative;
      const vtkIdType nonFinite = environment->GetNumberOfNonFiniteValues() + bad.NotFinite;
      if (negative > 0 || nonFinite > 0)
      {
        image.Notes.push_back(
          Concat(negative, " negative and ", nonFinite, " non-finite values were set to 0."));
      }
      this->Notes = image.JoinNotes();
      this->Environment = environment;
    });
  if (!done)
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  return done;
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkEnvironmentReader, Projection, int, AUTOMATIC, CUBE_VERTICAL_STRIP);

//------------------------------------------------------------------------------
void vtkEnvironmentReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << measuredbrdf::ToPrintable(this->FileName) << "\n";
  os << indent << "Projection: " << this->Projection << "\n";
  os << indent << "Layer: " << measuredbrdf::ToPrintable(this->Layer) << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "Notes: " << this->Notes << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
}
