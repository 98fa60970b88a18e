// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The one way to read an image file: environments, pictures, photographs and weights.
 *
 * 1. ImageFormats.cxx finds the format by the file's content, never by its name, and checks the
 *    size before anything of that size is allocated. OpenImageIO knows some 30 formats more, for
 *    films and scanners, whose readers would meet files of any origin.
 * 2. The pixels are read as they are stored: of OpenEXR by ExrImageFile.cxx, of Radiance HDR by
 *    ImageFile.cxx. Of the other formats by OpenImageIO, in ImageDecoder.cxx. That brings many
 *    libraries along: on Debian some 200. A program that reads no image should not load them, so a
 *    shared build makes a plugin of it, which ImagePlugin.cxx loads when the first such image is
 *    read. A build without OpenImageIO has VTKImageDecoder.cxx instead, for PNG, JPEG and TIFF.
 * 3. ImageFile.cxx makes them what the header says that is to be seen: turned, cut to the display
 *    window, divided by the exposure, in Rec. 709.
 */

#ifndef ImageFile_h
#define ImageFile_h

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

class vtkImageData;

namespace measuredbrdf
{
/// What OpenEXR's envmap attribute says that an image is.
enum class ImageEnvmap
{
  None,
  LatLong,
  Cube
};

struct ImageFile
{
  int Width = 0;
  int Height = 0;
  bool IsGray = false;    // one channel: red, green and blue are the same
  int ValuesPerTexel = 3; // 4 where alpha was asked for
  bool HasAlpha = false;  // the fourth value, where it was asked for
  bool IsEncoded = false; // integers that are not said to be linear
  bool IsInteger = false; // else floats
  bool HasBytes = false;  // integers of 8 bits
  ImageEnvmap Envmap = ImageEnvmap::None;
  std::vector<std::string> Notes; // for people: what was chosen or lost
  std::vector<float> Pixels;      // ValuesPerTexel for each; top row first

  /// A line for each note.
  std::string JoinNotes() const
  {
    std::string lines;
    for (const std::string& note : this->Notes)
    {
      lines += (lines.empty() ? "" : "\n") + note;
    }
    return lines;
  }
};

/**
 * Read an image of the file. Memory follows what the file holds, not what its header promises.
 * alpha: of integers it is not multiplied into the colors; OpenEXR's colors keep it. layer: the
 * layer or part of an OpenEXR file; empty: the one named Combined, else the channels R, G and B
 * without a name, else the first layer. Throws FileError.
 */
ImageFile ReadImageFile(const std::string& path, bool alpha = false, const std::string& layer = "");

/// The image as VTK has images, row 0 at the bottom: RGB, with alpha where the file has it.
/// isInteger: as unsigned char or unsigned short, else as floats. keepsGray: gray stays one
/// component.
vtkSmartPointer<vtkImageData> MakeImageData(
  const ImageFile& file, bool isInteger, bool keepsGray = false);

//------------------------------------------------------------------------------
// Formats.

struct ImageFormat
{
  const char* Name;   // for people
  const char* Reader; // OpenImageIO's name
  // A header that promises more texels than this per byte of its file (beyond a first block) lies.
  double TexelsPerByte;

  bool Is(std::string_view reader) const { return reader == this->Reader; }
};

/// The format of the file, which is there and not empty. Throws FileError, with the list of the
/// formats, where it is none of them.
const ImageFormat& RecognizeImage(const std::string& path);

/// The numbers that a header says of an image's size, before anything is allocated.
struct ImageSize
{
  double Width = 0;
  double Height = 0;
  double Channels = 1;
  double TileWidth = 0; // 0: no tiles
  double TileHeight = 0;
  int Orientation = 1; // as EXIF numbers it
};

/// Images are read in blocks of about this many texels of up to four channels.
constexpr double BlockTexels = 1 << 20;

/// How many times four channels a texel has: what a texel counts in a block.
double GetTexelWeight(double channels);

/// Throws FileError where a size is not positive, too large, or more than fileSize bytes can hold.
void CheckImageSize(const std::string& path, const ImageFormat& format, const ImageSize& size,
  std::uintmax_t fileSize);

/// The same for the formats whose readers allocate the whole image as they open it: JPEG and BMP.
/// Returns the orientation of JPEG, else 1.
int CheckStoredSize(const std::string& path, const ImageFormat& format, std::uintmax_t fileSize);

//------------------------------------------------------------------------------
// Pixels as they are stored.

/// What to decode.
struct ImageSource
{
  std::string Path;
  std::uintmax_t FileSize = 0;
  const ImageFormat* Format = nullptr;
  bool Alpha = false;
  std::string Layer;
};

/// An image as it is stored, and what its header says.
struct DecodedImage : ImageFile
{
  DecodedImage() = default;

  /// Without texels: storage for them is reserved, not touched.
  DecodedImage(const ImageSource& source, int width, int height, bool isGray, bool hasAlpha)
  {
    this->Width = this->DisplayWidth = width;
    this->Height = this->DisplayHeight = height;
    this->IsGray = isGray;
    this->ValuesPerTexel = source.Alpha ? 4 : 3;
    this->HasAlpha = source.Alpha && hasAlpha;
    this->Pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                         static_cast<std::size_t>(this->ValuesPerTexel));
  }

  /// Channels of the next texel: gray, or red, green and blue; then alpha, if the image has it.
  void AddTexel(const float* channels)
  {
    const int colors = this->IsGray ? 1 : 3;
    for (int k = 0; k < this->ValuesPerTexel; ++k)
    {
      this->Pixels.push_back(k < 3            ? channels[this->IsGray ? 0 : k]
                             : this->HasAlpha ? channels[colors]
                                              : 0.0f);
    }
  }

  int Left = 0; // the first texel's place in the display window; may be outside
  int Top = 0;
  int DisplayWidth = 0;
  int DisplayHeight = 0;
  int Orientation = 1;                // as EXIF numbers it
  std::vector<double> Chromaticities; // empty, or 8: ImageFile.cxx
};

constexpr const char SeveralImagesNote[] =
  "The file holds several images: the first one was taken.";

///@{
/// Throws FileError. DecodeImage: of all formats but OpenEXR and Radiance HDR.
DecodedImage DecodeExrImage(const ImageSource& source);
DecodedImage DecodeImage(const ImageSource& source);
///@}

/// What the plugin exports: the same; returns false, with the error, in place of throwing.
using DecodeImageInPlugin = bool(
  const ImageSource& source, DecodedImage& image, std::string& error);
constexpr const char DecodeImageSymbol[] = "vtkMeasuredBRDFDecodeImage";
} // namespace measuredbrdf

#endif
