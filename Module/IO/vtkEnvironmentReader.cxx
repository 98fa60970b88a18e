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
using measuredbrdf::BadValues;
using measuredbrdf::FileError;
using measuredbrdf::Projection;

// The maps know the projections by these numbers.
static_assert(
  static_cast<int>(Projection::LatLong) == vtkEnvironmentReader::LAT_LONG &&
  static_cast<int>(Projection::VerticalStrip) == vtkEnvironmentReader::CUBE_VERTICAL_STRIP);

//------------------------------------------------------------------------------
struct Image
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Pixels; // RGB, row 0 at the bottom
  measuredbrdf::ImageEnvmap Envmap = measuredbrdf::ImageEnvmap::None;
  std::string Notes;
  BadValues Bad; // set to 0, of probes that had to be converted

  void AddNote(const std::string& note) { this->Notes += (this->Notes.empty() ? "" : "\n") + note; }
};

//------------------------------------------------------------------------------
Image ReadImage(const std::string& path, const std::string& layer)
{
  measuredbrdf::ImageFile file =
    measuredbrdf::ReadImageFile(path, measuredbrdf::ImageValues::Color, layer);

  Image image;
  image.Width = file.Width;
  image.Height = file.Height;
  image.Pixels = std::move(file.Pixels);
  const std::size_t row = std::size_t(image.Width) * 3;
  std::vector<float>& pixels = image.Pixels;
  if (file.IsEncoded)
  {
    std::transform(pixels.begin(), pixels.end(), pixels.begin(),
      [](float value) { return static_cast<float>(measuredbrdf::DecodeSRGB(value)); });
    image.AddNote("Integer values were taken as sRGB-encoded and made linear.");
  }
  if (file.Channels == 1)
  {
    for (std::size_t k = 0; k < pixels.size(); k += 3)
    {
      pixels[k + 1] = pixels[k + 2] = pixels[k];
    }
    image.AddNote("One channel: taken as gray.");
  }
  // Files begin with the top row.
  for (int y = 0; y < image.Height / 2; ++y)
  {
    std::swap_ranges(pixels.begin() + y * row, pixels.begin() + (y + 1) * row,
      pixels.begin() + (image.Height - 1 - y) * row);
  }
  for (const std::string& note : file.Notes)
  {
    image.AddNote(note);
  }
  image.Envmap = file.Envmap;
  return image;
}

//------------------------------------------------------------------------------
std::string FormatSize(const Image& image)
{
  return std::to_string(image.Width) + " x " + std::to_string(image.Height);
}

//------------------------------------------------------------------------------
// What an image without a given projection is by its shape.
Projection DetectProjection(Image& image)
{
  if (image.Envmap == measuredbrdf::ImageEnvmap::Cube)
  {
    return Projection::VerticalStrip;
  }
  if (image.Envmap == measuredbrdf::ImageEnvmap::LatLong)
  {
    return Projection::LatLong;
  }
  constexpr int smallestFace = 8;
  for (const Projection projection : { Projection::HorizontalCross, Projection::VerticalCross,
         Projection::HorizontalStrip, Projection::VerticalStrip })
  {
    const int longest = std::max(image.Width, image.Height);
    const int faces = projection <= Projection::VerticalCross ? 4 : 6;
    if (longest >= faces * smallestFace && FitsProjection(projection, image.Width, image.Height))
    {
      image.AddNote("By its size taken as a " + GetProjectionName(projection) + " of cube faces.");
      return projection;
    }
  }
  return Projection::LatLong;
}

//------------------------------------------------------------------------------
// OpenEXR's envmap attribute says where the axes are (ImfEnvmap.h); elsewhere images follow VTK.
void AlignWithAxes(Projection projection, Image& image)
{
  const auto row = 3 * static_cast<std::ptrdiff_t>(image.Width);
  if (image.Envmap == measuredbrdf::ImageEnvmap::Cube && projection == Projection::VerticalStrip)
  {
    // The last two faces are +z and -z as they are seen there; in OpenGL's cubes, what is seen
    // towards -z comes first.
    const auto face = row * image.Width;
    if (std::int64_t(image.Height) == 6 * std::int64_t(image.Width))
    {
      std::swap_ranges(
        image.Pixels.begin(), image.Pixels.begin() + face, image.Pixels.begin() + face);
    }
  }
  else if (image.Envmap == measuredbrdf::ImageEnvmap::LatLong && projection == Projection::LatLong)
  {
    // The center is +z and +x is in the middle of the left half; here, the center is +x.
    const std::ptrdiff_t quarter = 3 * ((static_cast<std::ptrdiff_t>(image.Width) + 2) / 4);
    for (auto at = image.Pixels.begin(); at != image.Pixels.end(); at += row)
    {
      std::rotate(at, at + (row - quarter), at + row);
    }
  }
}

//------------------------------------------------------------------------------
BadValues GetRepaired(const std::string& path, const std::optional<BadValues>& converted)
{
  if (!converted)
  {
    throw FileError(path + ": image pixels: were refused");
  }
  return *converted;
}

//------------------------------------------------------------------------------
void FillFromImage(const std::string& path, Projection projection, bool given, Image& image,
  vtkEnvironment* environment)
{
  if (projection == Projection::LatLong)
  {
    if (std::uint64_t(image.Width) != 2 * std::uint64_t(image.Height))
    {
      image.AddNote(
        "The size " + FormatSize(image) + " is not 2:1; it is stretched over the sphere.");
    }
    if (image.Width == image.Height && !given)
    {
      image.AddNote("Square images are often angular maps or mirror balls: say so if it is one.");
    }
    if (!environment->SetPixels(image.Width, image.Height, std::move(image.Pixels)))
    {
      throw FileError(path + ": image pixels: were refused");
    }
    return;
  }
  if (!FitsProjection(projection, image.Width, image.Height))
  {
    throw FileError(path + ": image size: found " + FormatSize(image) + ", expected " +
                    GetExpectedSize(projection) + " for a probe of type " +
                    GetProjectionName(projection));
  }
  image.Bad = GetRepaired(path,
    ConvertProbe(projection, image.Width, image.Height, std::move(image.Pixels), environment));
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
  throw FileError(pattern + ": cube faces: found no file with %s replaced by px, posx or right");
}

//------------------------------------------------------------------------------
void FillFromFaces(
  const std::string& pattern, const std::string& layer, Image& first, vtkEnvironment* environment)
{
  const std::vector<std::string> paths = FindFaces(pattern);
  std::vector<std::vector<float>> faces;
  for (const std::string& path : paths)
  {
    Image image = ReadImage(path, layer);
    if (image.Width != image.Height)
    {
      throw FileError(path + ": cube face: found " + FormatSize(image) + ", expected a square");
    }
    constexpr std::int64_t most = measuredbrdf::MaximumProbeTexels / 6;
    if (std::int64_t(image.Width) * image.Height > most)
    {
      throw FileError(path + ": cube face: found " + FormatSize(image) +
                      ", expected six faces of at most " + std::to_string(most) + " texels each");
    }
    faces.push_back(std::move(image.Pixels));
    if (faces.size() == 1)
    {
      first = std::move(image);
    }
    else if (image.Width != first.Width)
    {
      throw FileError(path + ": cube face: found " + FormatSize(image) + ", expected " +
                      FormatSize(first) + " as " + paths.front());
    }
  }
  first.Bad = GetRepaired(pattern, measuredbrdf::ConvertCubeFaces(first.Width, faces, environment));
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
      Image image;
      const auto environment = vtkSmartPointer<vtkEnvironment>::New();
      if (this->FileName.find("%s") != std::string::npos &&
          !vtksys::SystemTools::FileExists(this->FileName)) // "80%sky.hdr" is a name, too
      {
        FillFromFaces(this->FileName, this->Layer, image, environment);
      }
      else
      {
        image = ReadImage(this->FileName, this->Layer);
        const bool given = this->Projection != AUTOMATIC;
        const auto projection =
          given ? static_cast<::Projection>(this->Projection) : DetectProjection(image);
        AlignWithAxes(projection, image);
        FillFromImage(this->FileName, projection, given, image, environment);
      }
      environment->SetName(measuredbrdf::GetFileStem(this->FileName));
      const vtkIdType negative = environment->GetNumberOfNegativeValues() + image.Bad.Negative;
      const vtkIdType nonFinite = environment->GetNumberOfNonFiniteValues() + image.Bad.NotFinite;
      if (negative > 0 || nonFinite > 0)
      {
        image.AddNote(std::to_string(negative) + " negative and " + std::to_string(nonFinite) +
                      " non-finite values were set to 0.");
      }
      this->Notes = image.Notes;
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
