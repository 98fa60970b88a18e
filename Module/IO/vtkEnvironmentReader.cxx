// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEnvironmentReader.h"

#include "ExrHeader.h"
#include "FileBytes.h"
#include "SRGB.h"
#include "Setters.h"
#include "vtkCallbackCommand.h"
#include "vtkEnvironmentProjection.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <OpenImageIO/imageio.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <fstream>

vtkStandardNewMacro(vtkEnvironmentReader);

namespace
{
using measuredbrdf::FileError;

constexpr std::uint64_t MaximumTexels = std::uint64_t(1) << 28;
constexpr int MaximumSide = 1 << 16;

// Pixels are read in blocks of about this many texels, so that memory follows what the file holds
// and not what its header promises.
constexpr std::uint64_t BlockTexels = std::uint64_t(1) << 20;

// A header that promises more texels than this per byte of its file (beyond a first block) lies.
// Deflate shrinks by 1032 at most; Radiance's runs hold 127 values of a channel in 2 bytes; a
// portable bitmap has 8 texels in a byte.
std::uint64_t GetMaximumTexelsPerByte(const std::string& format)
{
  return format == "pnm" ? 8 : format == "hdr" ? 16 : 1032;
}

//------------------------------------------------------------------------------
// OpenImageIO reports errors by the line.
std::string ToLine(std::string text)
{
  text.erase(text.find_last_not_of("\r\n ") + 1);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

//------------------------------------------------------------------------------
bool IsFloatingPoint(const OIIO::TypeDesc& type)
{
  return type.basetype == OIIO::TypeDesc::HALF || type.basetype == OIIO::TypeDesc::FLOAT ||
         type.basetype == OIIO::TypeDesc::DOUBLE;
}

//------------------------------------------------------------------------------
bool SaysLinear(const OIIO::ImageSpec& spec)
{
  const std::string space =
    vtksys::SystemTools::LowerCase(std::string(spec.get_string_attribute("oiio:ColorSpace")));
  return space == "linear" || space == "scene_linear" || space.compare(0, 4, "lin_") == 0;
}

//------------------------------------------------------------------------------
struct Image
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Pixels; // RGB, row 0 at the bottom
  std::string Notes;
  // Values that were set to 0, of probes that had to be converted.
  vtkIdType NumberOfNegativeValues = 0;
  vtkIdType NumberOfNonFiniteValues = 0;

  void AddNote(const std::string& note) { this->Notes += (this->Notes.empty() ? "" : "\n") + note; }
};

//------------------------------------------------------------------------------
// OpenEXR's attributes allocate when a file is opened.
void CheckAttributes(const std::string& path)
{
  char magic[sizeof(measuredbrdf::ExrMagic)] = "";
  std::ifstream(path, std::ios::binary).read(magic, sizeof(magic) - 1);
  if (std::string(magic) == measuredbrdf::ExrMagic)
  {
    measuredbrdf::CheckExrHeader(measuredbrdf::FileBytes(path), "OpenEXR image");
  }
}

//------------------------------------------------------------------------------
void CheckSize(const std::string& path, const OIIO::ImageSpec& spec, const std::string& format,
  std::uintmax_t fileSize)
{
  const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height);
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
  {
    throw FileError(path + ": image size: found " + size + " x " + std::to_string(spec.depth) +
                    ", " + std::to_string(spec.nchannels) +
                    " channels, expected one slice of at least 1 x 1");
  }
  if (spec.deep)
  {
    throw FileError(path + ": image type: found deep samples, expected one value per texel");
  }
  if (spec.tile_width > 0 &&
      std::uint64_t(spec.tile_width) * std::uint64_t(std::max(spec.tile_height, 1)) > BlockTexels)
  {
    throw FileError(path + ": tile size: found " + std::to_string(spec.tile_width) + " x " +
                    std::to_string(spec.tile_height) + ", expected at most " +
                    std::to_string(BlockTexels) + " texels");
  }
  const std::uint64_t texels = std::uint64_t(spec.width) * std::uint64_t(spec.height);
  if (texels > MaximumTexels)
  {
    throw FileError(path + ": image size: found " + size + ", expected at most " +
                    std::to_string(MaximumTexels) + " texels");
  }
  if (spec.width > MaximumSide || spec.height > MaximumSide)
  {
    throw FileError(path + ": image size: found " + size + ", expected sides of at most " +
                    std::to_string(MaximumSide));
  }
  if (texels > BlockTexels && (texels - BlockTexels) / GetMaximumTexelsPerByte(format) > fileSize)
  {
    throw FileError(path + ": image size: found " + size + ", more than a file of " +
                    std::to_string(fileSize) + " bytes can hold");
  }
}

//------------------------------------------------------------------------------
// Channels 0 to channels - 1 as the first of RGB, top row first.
std::vector<float> ReadPixels(
  const std::string& path, OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int channels)
{
  const bool tiled = spec.tile_width > 0;
  const std::size_t row = std::size_t(spec.width) * 3;
  const std::size_t total = row * spec.height;
  int rows = static_cast<int>(std::max<std::uint64_t>(16, BlockTexels / spec.width));
  if (tiled)
  {
    rows = (rows + spec.tile_height - 1) / spec.tile_height * spec.tile_height;
  }
  std::vector<float> pixels;
  for (int y = 0; y < spec.height; y += rows)
  {
    const int end = std::min(y + rows, spec.height);
    pixels.reserve(std::min(total, std::max(2 * pixels.size(), row * end)));
    pixels.resize(row * end);
    float* block = &pixels[row * y];
    const OIIO::stride_t texel = 3 * sizeof(float);
    const bool read =
      tiled ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
                spec.z + 1, 0, channels, OIIO::TypeDesc::FLOAT, block, texel, row * sizeof(float))
            : input.read_scanlines(0, 0, spec.y + y, spec.y + end, spec.z, 0, channels,
                OIIO::TypeDesc::FLOAT, block, texel, row * sizeof(float));
    if (!read)
    {
      const std::string reason = ToLine(input.geterror());
      throw FileError(
        path + ": image pixels: " +
        (reason.empty() ? "rows " + std::to_string(y) + " to " + std::to_string(end - 1) +
                            " could not be read; the file may be cut short"
                        : reason));
    }
  }
  return pixels;
}

//------------------------------------------------------------------------------
Image ReadImage(const std::string& path)
{
  const std::uintmax_t fileSize = measuredbrdf::CheckFile(path);
  CheckAttributes(path);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1); // alpha is dropped, so it must not darken
  auto input = OIIO::ImageInput::open(path, &config);
  if (!input)
  {
    throw FileError(path + ": image header: " + ToLine(OIIO::geterror()));
  }
  const OIIO::ImageSpec spec = input->spec(); // sub-image 0
  CheckSize(path, spec, input->format_name(), fileSize);

  Image image;
  image.Width = spec.width;
  image.Height = spec.height;
  const std::size_t row = std::size_t(spec.width) * 3;
  const int channels = spec.nchannels >= 3 ? 3 : 1;
  image.Pixels = ReadPixels(path, *input, spec, channels);
  input->close();

  std::vector<float>& pixels = image.Pixels;
  if (!IsFloatingPoint(spec.format) && !SaysLinear(spec))
  {
    std::transform(pixels.begin(), pixels.end(), pixels.begin(),
      [](float value) { return static_cast<float>(measuredbrdf::DecodeSRGB(value)); });
    image.AddNote("Integer values were taken as sRGB-encoded and made linear.");
  }
  if (channels == 1)
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
  if (spec.full_width != spec.width || spec.full_height != spec.height)
  {
    image.AddNote("The data window differs from the display window; the data are taken as whole.");
  }
  return image;
}

//------------------------------------------------------------------------------
std::string FormatSize(const Image& image)
{
  return std::to_string(image.Width) + " x " + std::to_string(image.Height);
}

//------------------------------------------------------------------------------
// What an image without a given projection is by its shape.
int DetectProjection(Image& image)
{
  constexpr int smallestFace = 8;
  for (const int projection : { vtkEnvironmentProjection::CUBE_HORIZONTAL_CROSS,
         vtkEnvironmentProjection::CUBE_VERTICAL_CROSS,
         vtkEnvironmentProjection::CUBE_HORIZONTAL_STRIP,
         vtkEnvironmentProjection::CUBE_VERTICAL_STRIP })
  {
    const int longest = std::max(image.Width, image.Height);
    const int faces = projection <= vtkEnvironmentProjection::CUBE_VERTICAL_CROSS ? 4 : 6;
    if (longest >= faces * smallestFace &&
        vtkEnvironmentProjection::FitsSize(projection, image.Width, image.Height))
    {
      image.AddNote("By its size taken as a " +
                    vtkEnvironmentProjection::GetProjectionName(projection) + " of cube faces.");
      return projection;
    }
  }
  return vtkEnvironmentProjection::LAT_LONG;
}

//------------------------------------------------------------------------------
// Run a conversion; its error becomes an exception, its counts go to the image.
template <typename Run>
void Convert(const std::string& path, Image& image, const Run& run)
{
  vtkNew<vtkEnvironmentProjection> converter;
  std::string error;
  vtkNew<vtkCallbackCommand> catcher;
  catcher->SetClientData(&error);
  catcher->SetCallback([](vtkObject*, unsigned long, void* text, void* said)
    { *static_cast<std::string*>(text) = static_cast<const char*>(said); });
  converter->AddObserver(vtkCommand::ErrorEvent, catcher);
  if (!run(converter.Get()))
  {
    throw FileError(path + ": " + error);
  }
  image.NumberOfNegativeValues = converter->GetNumberOfNegativeValues();
  image.NumberOfNonFiniteValues = converter->GetNumberOfNonFiniteValues();
}

//------------------------------------------------------------------------------
void FillFromImage(
  const std::string& path, int projection, bool given, Image& image, vtkEnvironment* environment)
{
  if (projection == vtkEnvironmentProjection::LAT_LONG)
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
  if (!vtkEnvironmentProjection::FitsSize(projection, image.Width, image.Height))
  {
    throw FileError(path + ": image size: found " + FormatSize(image) + ", expected " +
                    vtkEnvironmentProjection::GetExpectedSize(projection) +
                    " for a probe of type " +
                    vtkEnvironmentProjection::GetProjectionName(projection));
  }
  Convert(path, image,
    [&](vtkEnvironmentProjection* converter)
    {
      converter->SetProjection(projection);
      return converter->Convert(image.Width, image.Height, std::move(image.Pixels), environment);
    });
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
void FillFromFaces(const std::string& pattern, Image& first, vtkEnvironment* environment)
{
  const std::vector<std::string> paths = FindFaces(pattern);
  std::vector<std::vector<float>> faces;
  for (const std::string& path : paths)
  {
    Image image = ReadImage(path);
    if (image.Width != image.Height)
    {
      throw FileError(path + ": cube face: found " + FormatSize(image) + ", expected a square");
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
  Convert(pattern, first,
    [&](vtkEnvironmentProjection* converter)
    { return converter->ConvertFaces(first.Width, faces, environment); });
}
}

//------------------------------------------------------------------------------
bool vtkEnvironmentReader::Read()
{
  this->ErrorMessage.clear();
  this->Notes.clear();
  try
  {
    Image image;
    const auto environment = vtkSmartPointer<vtkEnvironment>::New();
    if (this->FileName.find("%s") != std::string::npos)
    {
      FillFromFaces(this->FileName, image, environment);
    }
    else
    {
      image = ReadImage(this->FileName);
      const bool given = this->Projection != AUTOMATIC;
      const int projection = given ? this->Projection : DetectProjection(image);
      FillFromImage(this->FileName, projection, given, image, environment);
    }
    environment->SetName(measuredbrdf::GetFileStem(this->FileName));
    const vtkIdType negative =
      environment->GetNumberOfNegativeValues() + image.NumberOfNegativeValues;
    const vtkIdType nonFinite =
      environment->GetNumberOfNonFiniteValues() + image.NumberOfNonFiniteValues;
    if (negative > 0 || nonFinite > 0)
    {
      image.AddNote(std::to_string(negative) + " negative and " + std::to_string(nonFinite) +
                    " non-finite values were set to 0.");
    }
    this->Notes = image.Notes;
    this->Environment = environment;
    return true;
  }
  catch (const FileError& e)
  {
    this->ErrorMessage = e.what();
  }
  catch (const std::exception& e) // out of memory, say
  {
    this->ErrorMessage = measuredbrdf::ToPrintable(this->FileName + ": " + e.what());
  }
  vtkErrorMacro(<< this->ErrorMessage);
  return false;
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkEnvironmentReader, Projection, int, AUTOMATIC,
  vtkEnvironmentProjection::NUMBER_OF_PROJECTIONS - 1);

//------------------------------------------------------------------------------
void vtkEnvironmentReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << measuredbrdf::ToPrintable(this->FileName) << "\n";
  os << indent << "Projection: " << this->Projection << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "Notes: " << this->Notes << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
}
