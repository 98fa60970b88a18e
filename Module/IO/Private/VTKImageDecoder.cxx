// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// DecodeImage where there is no OpenImageIO: by the libraries that VTK's readers use. vtkPNGReader
// crashes at the first error in a file, and of 16-bit or float colors vtkTIFFReader copies three
// bytes a texel: these two are not used themselves.
#include "ImageFile.h"

#include "FileBytes.h"
#include "ScopedErrorCapture.h"
#include "vtkImageData.h"
#include "vtkJPEGReader.h"
#include "vtkNew.h"

#include <vtk_png.h>
#include <vtk_tiff.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

namespace measuredbrdf
{
namespace
{
// The next texels, as this machine has numbers: integers, or floats of 32 bits.
void AddTexels(
  const void* data, std::size_t texels, std::size_t channels, int bits, DecodedImage& image)
{
  std::vector<float> texel(channels);
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t k = 0; k < texels; ++k)
  {
    for (float& value : texel)
    {
      std::uint16_t word = *bytes;
      std::memcpy(&word, bytes, bits == 16 ? 2 : 0);
      value = float(word) * (bits == 8 ? 1.0f / 255.0f : 1.0f / 65535.0f); // as OpenImageIO does
      std::memcpy(&value, bytes, bits == 32 ? 4 : 0);
      bytes += bits / 8;
    }
    image.AddTexel(texel.data());
  }
}

//------------------------------------------------------------------------------
struct Png
{
  explicit Png(const std::string& path)
    : Bytes(path)
  {
  }
  ~Png() { png_destroy_read_struct(&this->File, &this->Info, nullptr); }

  // libpng leaves by longjmp where something is wrong: call has nothing that has to be destroyed.
  template <typename Function>
  void Call(const Function& call)
  {
    const bool failed = setjmp(png_jmpbuf(this->File)) != 0;
    Require(!failed, this->Bytes.GetPath(), ": image pixels: ", this->Error);
    call(this->File, this->Info);
  }

  FileBytes Bytes;
  std::string_view Rest = Bytes.GetView();
  png_structp File = nullptr;
  png_infop Info = nullptr;
  std::string Error;
};

DecodedImage ReadPng(const ImageSource& source)
{
  Png png(source.Path);
  png.File = png_create_read_struct(
    PNG_LIBPNG_VER_STRING, &png,
    [](png_structp file, png_const_charp text)
    {
      static_cast<Png*>(png_get_error_ptr(file))->Error = text;
      png_longjmp(file, 1);
    },
    [](png_structp, png_const_charp) {});
  png.Info = png.File ? png_create_info_struct(png.File) : nullptr;
  Require(png.Info, source.Path, ": image header: out of memory");
  png.Call(
    [&png](png_structp file, png_infop info)
    {
      png_set_read_fn(file, &png,
        [](png_structp from, png_bytep out, std::size_t count)
        {
          std::string_view& rest = static_cast<Png*>(png_get_io_ptr(from))->Rest;
          if (count > rest.size())
          {
            png_error(from, "the file ends early");
          }
          std::memcpy(out, rest.data(), count);
          rest.remove_prefix(count);
        });
      // Of what may be large when it is inflated, nothing is needed.
      const auto* needed = reinterpret_cast<png_const_bytep>("gAMA\0sRGB");
      png_set_keep_unknown_chunks(file, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
      png_set_keep_unknown_chunks(file, PNG_HANDLE_CHUNK_AS_DEFAULT, needed, 2);
      png_read_info(file, info);
    });
  const auto width = png_get_image_width(png.File, png.Info);
  const auto height = png_get_image_height(png.File, png.Info);
  CheckImageSize(source.Path, *source.Format, { double(width), double(height) }, source.FileSize);
  png.Call(
    [](png_structp file, png_infop info)
    {
      png_set_expand(file); // palettes, fewer bits than 8, one color as transparent
#ifndef VTK_WORDS_BIGENDIAN
      png_set_swap(file);
#endif
      png_set_interlace_handling(file);
      png_read_update_info(file, info);
    });

  const int channels = png_get_channels(png.File, png.Info);
  const int bits = png_get_bit_depth(png.File, png.Info);
  DecodedImage image(source, int(width), int(height), channels <= 2, channels % 2 == 0);
  double gamma = 0.0;
  const bool saysGamma = png_get_valid(png.File, png.Info, PNG_INFO_sRGB) == 0 &&
                         png_get_gAMA(png.File, png.Info, &gamma) != 0 && gamma > 0.0;
  image.IsInteger = true;
  image.IsEncoded = !saysGamma || std::lround(100.0 / gamma) != 100;
  image.HasBytes = bits == 8;
  // Row by row, so that memory follows what the file holds; passes over an image need all of it.
  const std::uint32_t passes =
    png_get_interlace_type(png.File, png.Info) == PNG_INTERLACE_NONE ? 1 : 7;
  const std::size_t row = png_get_rowbytes(png.File, png.Info);
  std::vector<unsigned char> rows(passes > 1 ? row * height : row);
  for (std::uint32_t k = 0; k < passes * height; ++k)
  {
    unsigned char* at = &rows[passes > 1 ? row * (k % height) : 0];
    png.Call([at](png_structp file, png_infop) { png_read_row(file, at, nullptr); });
    AddTexels(at, k < (passes - 1) * height ? 0 : width, std::size_t(channels), bits, image);
  }
  return image;
}

//------------------------------------------------------------------------------
DecodedImage ReadJpeg(const ImageSource& source)
{
  vtkNew<vtkJPEGReader> reader;
  const ScopedErrorCapture errors(reader);
  const ScopedErrorCapture reasons(reader, vtkCommand::WarningEvent);
  reader->SetFileName(source.Path.c_str());
  reader->UpdateInformation();
  const int* extent = reader->GetDataExtent();
  const int channels = reader->GetNumberOfScalarComponents();
  CheckImageSize(
    source.Path, *source.Format, { extent[1] + 1.0, extent[3] + 1.0 }, source.FileSize);
  Require(channels == 1 || channels == 3, source.Path, ": image channels: found ", channels,
    ", expected gray or RGB");
  reader->Update();
  Require(reader->GetErrorCode() == 0 && errors.GetText().empty(), source.Path,
    ": image pixels: cannot be read: ", reasons.GetText());
  DecodedImage image(source, extent[1] + 1, extent[3] + 1, channels == 1, false);
  image.IsInteger = image.IsEncoded = image.HasBytes = true;
  for (int y = extent[3]; y >= 0; --y)
  {
    AddTexels(reader->GetOutput()->GetScalarPointer(0, y, 0), std::size_t(image.Width),
      std::size_t(channels), 8, image);
  }
  return image;
}

//------------------------------------------------------------------------------
int KeepMessage(TIFF*, void* kept, const char*, const char* format, va_list arguments)
{
  char text[256];
  std::vsnprintf(text, sizeof(text), format, arguments);
  *static_cast<std::string*>(kept) = text;
  return 1; // nothing else is to be done with it
}

DecodedImage ReadTiff(const ImageSource& source)
{
  std::string error;
  std::string warning;
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, KeepMessage, &error);
  TIFFOpenOptionsSetWarningHandlerExtR(options, KeepMessage, &warning);
  const std::unique_ptr<TIFF, void (*)(TIFF*)> owner(
    TIFFOpenExt(source.Path.c_str(), "rm", options), TIFFClose); // m: not mapped into memory
  TIFFOpenOptionsFree(options);
  TIFF* file = owner.get();
  Require(file, source.Path, ": image header: ", error);

  const auto get = [file](std::uint32_t tag, auto value)
  {
    TIFFGetFieldDefaulted(file, tag, &value);
    return value;
  };
  const auto width = get(TIFFTAG_IMAGEWIDTH, std::uint32_t(0));
  const auto height = get(TIFFTAG_IMAGELENGTH, std::uint32_t(0));
  const bool isTiled = TIFFIsTiled(file) != 0;
  const auto blockWidth = isTiled ? get(TIFFTAG_TILEWIDTH, std::uint32_t(0)) : width;
  const auto blockHeight = isTiled ? get(TIFFTAG_TILELENGTH, std::uint32_t(0)) : 1;
  const auto channels = get(TIFFTAG_SAMPLESPERPIXEL, std::uint16_t(0));
  CheckImageSize(source.Path, *source.Format,
    { double(width), double(height), double(channels), isTiled ? double(blockWidth) : 0.0,
      isTiled ? double(blockHeight) : 0.0 },
    source.FileSize);
  const auto bits = get(TIFFTAG_BITSPERSAMPLE, std::uint16_t(0));
  const auto type = get(TIFFTAG_SAMPLEFORMAT, std::uint16_t(0));
  const auto meaning = get(TIFFTAG_PHOTOMETRIC, std::uint16_t(0));
  const auto planes = get(TIFFTAG_PLANARCONFIG, std::uint16_t(0));
  const int colors = meaning == PHOTOMETRIC_RGB ? 3 : 1;
  const bool isInteger = type == SAMPLEFORMAT_UINT && (bits == 8 || bits == 16);
  const std::size_t texel = std::size_t(channels) * bits / 8;
  Require((isInteger || (type == SAMPLEFORMAT_IEEEFP && bits == 32)) && channels >= colors &&
            (colors == 3 || meaning == PHOTOMETRIC_MINISBLACK) &&
            (channels == 1 || planes == PLANARCONFIG_CONTIG) && blockWidth > 0 && blockHeight > 0 &&
            texel * blockWidth * blockHeight ==
              std::size_t(isTiled ? TIFFTileSize(file) : TIFFScanlineSize(file)),
    source.Path, ": image type: found ", channels, " channels of ", bits, " bits, SampleFormat ",
    type, ", PhotometricInterpretation ", meaning, ", PlanarConfiguration ", planes,
    ", expected gray or RGB, of 8 or 16 bits or floats of 32, interleaved");
  std::uint16_t extra = 0;
  std::uint16_t* extraTypes = nullptr;
  TIFFGetFieldDefaulted(file, TIFFTAG_EXTRASAMPLES, &extra, &extraTypes);
  const bool hasAlpha = channels > colors && extra > 0 && extraTypes[0] != EXTRASAMPLE_UNSPECIFIED;

  DecodedImage image(source, int(width), int(height), colors == 1, hasAlpha);
  image.IsInteger = image.IsEncoded = isInteger;
  image.HasBytes = bits == 8;
  image.Orientation = get(TIFFTAG_ORIENTATION, std::uint16_t(0));
  if (TIFFLastDirectory(file) == 0)
  {
    image.Notes.push_back(SeveralImagesNote);
  }
  // Rows, or rows of tiles, so that memory follows what the file holds.
  std::vector<unsigned char> block(texel * blockWidth * blockHeight);
  std::vector<unsigned char> rows(texel * width * blockHeight);
  for (std::uint32_t y = 0; y < height; y += blockHeight)
  {
    for (std::uint32_t x = 0; x < width; x += blockWidth)
    {
      const bool isRead = isTiled ? TIFFReadTile(file, block.data(), x, y, 0, 0) >= 0
                                  : TIFFReadScanline(file, block.data(), y, 0) >= 0;
      Require(isRead, source.Path, ": image pixels: ", error);
      for (std::size_t k = 0; k < blockHeight; ++k)
      {
        std::copy_n(&block[texel * blockWidth * k], texel * std::min(blockWidth, width - x),
          &rows[texel * (width * k + x)]);
      }
    }
    AddTexels(
      rows.data(), std::size_t(width) * std::min(blockHeight, height - y), channels, bits, image);
  }
  return image;
}
}

//------------------------------------------------------------------------------
DecodedImage DecodeImage(const ImageSource& source)
{
  const ImageFormat& format = *source.Format;
  Require(format.Is("png") || format.Is("jpeg") || format.Is("tiff"), source.Path, ": ",
    format.Name,
    " files are read by OpenImageIO, which this build has not (MEASUREDBRDF_WITH_OPENIMAGEIO)");
  return format.Is("png")    ? ReadPng(source)
         : format.Is("jpeg") ? ReadJpeg(source)
                             : ReadTiff(source);
}
} // namespace measuredbrdf
