// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEnvironmentReader.h"

#include "FileBytes.h"
#include "SRGB.h"
#include "vtkObjectFactory.h"

#include <OpenImageIO/imageio.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkEnvironmentReader);

namespace
{
using measuredbrdf::FileError;

constexpr std::uint64_t MaximumTexels = std::uint64_t(1) << 28;

// A header that promises more texels than this per byte of its file (beyond a first million) lies:
// no image format shrinks real images that far. What is promised is not allocated but what arrives:
// the image is read in blocks of rows.
constexpr std::uint64_t MaximumTexelsPerByte = 1024;
constexpr int RowsPerBlock = 64;
constexpr std::uint64_t FreeTexels = std::uint64_t(1) << 20;

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

  void AddNote(const std::string& note) { this->Notes += (this->Notes.empty() ? "" : "\n") + note; }
};

//------------------------------------------------------------------------------
void CheckSize(const std::string& path, const OIIO::ImageSpec& spec, std::uintmax_t fileSize)
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
  const std::uint64_t texels = std::uint64_t(spec.width) * std::uint64_t(spec.height);
  if (texels > MaximumTexels)
  {
    throw FileError(path + ": image size: found " + size + ", expected at most " +
                    std::to_string(MaximumTexels) + " texels");
  }
  if (texels > FreeTexels && (texels - FreeTexels) / MaximumTexelsPerByte > fileSize)
  {
    throw FileError(path + ": image size: found " + size + ", more than a file of " +
                    std::to_string(fileSize) + " bytes can hold");
  }
}

//------------------------------------------------------------------------------
// RGB rows from the top; memory grows with what the file really holds.
std::vector<float> ReadRows(
  const std::string& path, OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int channels)
{
  const std::size_t row = std::size_t(spec.width) * 3;
  const bool tiled = spec.tile_width > 0 && spec.tile_height > 0;
  const int step = tiled ? spec.tile_height : RowsPerBlock;
  std::vector<float> pixels;
  for (int y = 0; y < spec.height; y += step)
  {
    const int end = std::min(y + step, spec.height);
    pixels.resize(row * end);
    float* block = pixels.data() + row * y;
    const OIIO::stride_t texel = 3 * sizeof(float);
    const bool good =
      tiled ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
                spec.z + 1, 0, channels, OIIO::TypeDesc::FLOAT, block, texel, row * sizeof(float))
            : input.read_scanlines(0, 0, spec.y + y, spec.y + end, spec.z, 0, channels,
                OIIO::TypeDesc::FLOAT, block, texel, row * sizeof(float));
    if (!good)
    {
      const std::string reason = input.geterror();
      throw FileError(path + ": image pixels, rows " + std::to_string(y) + " to " +
                      std::to_string(end - 1) + ": " +
                      (reason.empty() ? "the file ends before they do" : reason));
    }
  }
  return pixels;
}

//------------------------------------------------------------------------------
Image ReadImage(const std::string& path)
{
  const std::uintmax_t fileSize = measuredbrdf::CheckFile(path);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1); // alpha is dropped, so it must not darken
  auto input = OIIO::ImageInput::open(path, &config);
  if (!input)
  {
    throw FileError(path + ": image header: " + OIIO::geterror());
  }
  const OIIO::ImageSpec spec = input->spec(); // sub-image 0
  CheckSize(path, spec, fileSize);

  Image image;
  image.Width = spec.width;
  image.Height = spec.height;
  const std::size_t row = std::size_t(spec.width) * 3;
  const int channels = spec.nchannels >= 3 ? 3 : 1;
  image.Pixels = ReadRows(path, *input, spec, channels);
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
    image.AddNote("One channel: taken as grey.");
  }
  // Files begin with the top row.
  for (int y = 0; y < image.Height / 2; ++y)
  {
    std::swap_ranges(pixels.begin() + y * row, pixels.begin() + (y + 1) * row,
      pixels.begin() + (image.Height - 1 - y) * row);
  }
  if (std::uint64_t(image.Width) != 2 * std::uint64_t(image.Height))
  {
    image.AddNote("The size " + std::to_string(image.Width) + " x " + std::to_string(image.Height) +
                  " is not 2:1; it is stretched over the sphere.");
  }
  if (spec.full_width != spec.width || spec.full_height != spec.height)
  {
    image.AddNote("The data window differs from the display window; the data are taken as whole.");
  }
  return image;
}
}

//------------------------------------------------------------------------------
bool vtkEnvironmentReader::Read()
{
  this->ErrorMessage.clear();
  this->Notes.clear();
  try
  {
    Image image = ReadImage(this->FileName);
    const auto environment = vtkSmartPointer<vtkEnvironment>::New();
    if (!environment->SetPixels(image.Width, image.Height, std::move(image.Pixels)))
    {
      throw FileError(this->FileName + ": image pixels: were refused");
    }
    environment->SetName(measuredbrdf::GetFileStem(this->FileName));
    const vtkIdType negative = environment->GetNumberOfNegativeValues();
    const vtkIdType nonFinite = environment->GetNumberOfNonFiniteValues();
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
    this->ErrorMessage = this->FileName + ": " + e.what();
  }
  vtkErrorMacro(<< this->ErrorMessage);
  return false;
}

//------------------------------------------------------------------------------
void vtkEnvironmentReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "Notes: " << this->Notes << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
}
