// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFile.h"

#include "Chromaticities.h"
#include "ExrHeader.h"
#include "FileBytes.h"
#include "ImageFormats.h"
#include "NumberText.h"
#include "RadianceHeader.h"
#include "RadianceValues.h"
#include "vtkImageData.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
namespace
{
// A display window without data costs no bytes of a file: it may have this many texels anyway.
constexpr std::int64_t FreeTexels = std::int64_t(1) << 24;

//------------------------------------------------------------------------------
std::size_t GetValuesPerTexel(ImageValues values)
{
  return values == ImageValues::ColorAndAlpha ? 4 : 3;
}

//------------------------------------------------------------------------------
// The texels of the data window, in a display window that is black elsewhere.
void ShowWindow(const ImageSource& source, DecodedImage& image)
{
  if (image.Left == 0 && image.Top == 0 && image.Width == image.DisplayWidth &&
      image.Height == image.DisplayHeight)
  {
    return;
  }
  const ImageSize size = { image.DisplayWidth, image.DisplayHeight };
  if (image.DisplayWidth < 1 || image.DisplayHeight < 1)
  {
    throw FileError(source.Path + ": display window: found " + std::to_string(image.DisplayWidth) +
                    " x " + std::to_string(image.DisplayHeight) +
                    " pixels, expected at least 1 x 1");
  }
  if (size.Width > FreeTexels || size.Height > FreeTexels || size.Width * size.Height > FreeTexels)
  {
    CheckImageSize(source.Path + ": display window", *source.Format, size, source.FileSize);
  }
  const int left = std::max(image.Left, 0);
  const int top = std::max(image.Top, 0);
  const auto right = static_cast<int>(
    std::min<std::int64_t>(std::int64_t(image.Left) + image.Width, image.DisplayWidth));
  const auto bottom = static_cast<int>(
    std::min<std::int64_t>(std::int64_t(image.Top) + image.Height, image.DisplayHeight));
  const std::size_t values = GetValuesPerTexel(source.Values);
  const std::size_t row = values * static_cast<std::size_t>(image.DisplayWidth);
  std::vector<float> shown(row * static_cast<std::size_t>(image.DisplayHeight), 0.0f);
  for (int y = top; y < bottom && left < right; ++y)
  {
    const auto from =
      static_cast<std::size_t>(y - image.Top) * static_cast<std::size_t>(image.Width) +
      static_cast<std::size_t>(left - image.Left);
    std::copy_n(image.Pixels.begin() + static_cast<std::ptrdiff_t>(values * from),
      values * static_cast<std::size_t>(right - left),
      shown.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(y) +
                                                  values * static_cast<std::size_t>(left)));
  }
  const std::int64_t inside =
    left < right && top < bottom ? std::int64_t(right - left) * (bottom - top) : 0;
  const std::int64_t black = std::int64_t(image.DisplayWidth) * image.DisplayHeight - inside;
  const std::int64_t lost = std::int64_t(image.Width) * image.Height - inside;
  if (black > 0)
  {
    image.Notes.push_back("The data window leaves " + std::to_string(black) +
                          " texels of the display window free: they are black.");
  }
  if (lost > 0)
  {
    image.Notes.push_back(
      std::to_string(lost) + " texels outside the display window were left out.");
  }
  image.Pixels.swap(shown);
  image.Width = image.DisplayWidth;
  image.Height = image.DisplayHeight;
}

//------------------------------------------------------------------------------
// Before colors and orientation change: infinite times 0 is no number.
void LimitValues(std::size_t values, DecodedImage& image)
{
  const float largest = GetLargestValue(image.Pixels);
  std::size_t count = 0;
  for (std::size_t k = 0; k < image.Pixels.size(); ++k)
  {
    if (image.Pixels[k] > largest && k % values < static_cast<std::size_t>(image.Channels))
    {
      image.Pixels[k] = largest;
      ++count;
    }
  }
  if (count == 0)
  {
    return;
  }
  image.Notes.push_back(std::to_string(count) +
                        (count == 1 ? " value of +infinity was" : " values of +infinity were") +
                        " taken as " + NumberText(largest) + ", the largest " +
                        (largest > 65504.0f ? "value of the file." : "half float."));
}

//------------------------------------------------------------------------------
void Transform(std::size_t values, const glm::dmat3& matrix, DecodedImage& image)
{
  for (std::size_t k = 0; k + 2 < image.Pixels.size(); k += values)
  {
    float* texel = &image.Pixels[k];
    const glm::dvec3 rgb = matrix * glm::dvec3(texel[0], texel[1], texel[2]);
    for (int c = 0; c < 3; ++c)
    {
      texel[c] = static_cast<float>(rgb[c]);
    }
  }
}

//------------------------------------------------------------------------------
void ConvertColors(const ImageSource& source, const Chromaticities& from, DecodedImage& image)
{
  if (!SpanColors(from))
  {
    std::string found;
    for (const double value : from)
    {
      found += (found.empty() ? "" : " ") + NumberText(value);
    }
    throw FileError(source.Path + ": image header, chromaticities: found " + found +
                    ", expected x and y of red, green, blue and of a white between them");
  }
  // Encoded integers are display values by another name: their readers take them as sRGB.
  if (image.Channels == 3 && !image.IsEncoded && !IsRec709(from))
  {
    Transform(GetValuesPerTexel(source.Values), GetToRec709(from), image);
  }
}

//------------------------------------------------------------------------------
// EXIF 2.32, tag 274 (TIFF 6.0, Orientation): which side of the picture the stored row 0 and column
// 0 are.
void Turn(std::size_t values, DecodedImage& image)
{
  const int turn = image.Orientation - 1;
  if (turn < 1 || turn > 7)
  {
    return;
  }
  const bool columns = turn >= 4; // stored rows are columns of the picture
  const bool right = turn % 4 == 1 || turn % 4 == 2;
  const bool bottom = turn % 4 >= 2;
  const int width = columns ? image.Height : image.Width;
  const int height = columns ? image.Width : image.Height;
  std::vector<float> turned;
  turned.reserve(image.Pixels.size());
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const int across = right ? width - 1 - x : x;
      const int down = bottom ? height - 1 - y : y;
      const auto stored =
        static_cast<std::size_t>(columns ? across : down) * static_cast<std::size_t>(image.Width) +
        static_cast<std::size_t>(columns ? down : across);
      const auto texel = image.Pixels.begin() + static_cast<std::ptrdiff_t>(values * stored);
      turned.insert(turned.end(), texel, texel + static_cast<std::ptrdiff_t>(values));
    }
  }
  image.Pixels.swap(turned);
  image.Width = width;
  image.Height = height;
}

//------------------------------------------------------------------------------
// OpenImageIO gets the pixels behind a header that says their size alone.
DecodedImage ReadRadiancePicture(ImageSource& source)
{
  const FileBytes file(source.Path);
  const RadianceHeader header = ParseRadianceHeader(file);
  const ImageSize size = { header.ScanlineLength, header.NumberOfScanlines, 3 };
  CheckImageSize(source.Path, *source.Format, size, source.FileSize);
  std::string bytes = MakePlainHeader(header);
  bytes += file.GetView().substr(header.Size);
  source.Bytes = bytes;
  DecodedImage image = DecodeImage(source);
  image.Orientation = header.Orientation;
  const std::array<double, 3>& exposure = header.Exposure;
  if (exposure != std::array<double, 3>{ 1.0, 1.0, 1.0 })
  {
    Transform(GetValuesPerTexel(source.Values),
      glm::dmat3(1.0 / exposure[0], 0, 0, 0, 1.0 / exposure[1], 0, 0, 0, 1.0 / exposure[2]), image);
  }
  image.Chromaticities.clear();
  if (header.Primaries)
  {
    image.Chromaticities.assign(header.Primaries->begin(), header.Primaries->end());
  }
  return image;
}

//------------------------------------------------------------------------------
// Top row first -> bottom row first.
template <typename Value>
void FillScalars(const ImageFile& file, double scale, int colors, void* scalars)
{
  auto* values = static_cast<Value*>(scalars);
  const auto width = static_cast<std::size_t>(file.Width);
  const std::size_t texels = width * static_cast<std::size_t>(file.Height);
  const std::size_t stored = file.Pixels.size() / texels;
  for (int y = file.Height - 1; y >= 0; --y)
  {
    for (std::size_t x = 0; x < width; ++x)
    {
      const float* texel = &file.Pixels[stored * (static_cast<std::size_t>(y) * width + x)];
      for (int c = 0; c < colors + (file.HasAlpha ? 1 : 0); ++c)
      {
        // Alpha follows the color's values.
        const float value = texel[c == colors ? file.Channels : c % file.Channels];
        *values++ = static_cast<Value>(scale > 1.0 ? std::lround(scale * value) : value);
      }
    }
  }
}
}

//------------------------------------------------------------------------------
ImageFile ReadImageFile(const std::string& path, ImageValues values, const std::string& layer)
{
  ImageSource source;
  source.Path = path;
  source.FileSize = CheckFile(path);
  source.Format = &RecognizeImage(path);
  source.Values = values;
  source.Layer = layer;
  CheckExrImage(path);
  CheckStoredSize(path, *source.Format, source.FileSize);

  DecodedImage image =
    IsImageFormat(*source.Format, "hdr") ? ReadRadiancePicture(source) : DecodeImage(source);
  ShowWindow(source, image);
  LimitValues(GetValuesPerTexel(values), image);
  if (image.Chromaticities.size() == Rec709.size())
  {
    Chromaticities from = {};
    std::copy(image.Chromaticities.begin(), image.Chromaticities.end(), from.begin());
    ConvertColors(source, from, image);
  }
  Turn(GetValuesPerTexel(values), image);
  return image;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeImageData(const ImageFile& file, bool isInteger, bool keepsGray)
{
  const int colors = keepsGray && file.Channels == 1 ? 1 : 3;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(file.Width, file.Height, 1);
  image->AllocateScalars(!isInteger      ? VTK_FLOAT
                         : file.HasBytes ? VTK_UNSIGNED_CHAR
                                         : VTK_UNSIGNED_SHORT,
    colors + (file.HasAlpha ? 1 : 0));
  void* scalars = image->GetScalarPointer();
  if (!isInteger)
  {
    FillScalars<float>(file, 1.0, colors, scalars);
  }
  else if (file.HasBytes)
  {
    FillScalars<unsigned char>(file, 255.0, colors, scalars);
  }
  else
  {
    FillScalars<unsigned short>(file, 65535.0, colors, scalars);
  }
  return image;
}
} // namespace measuredbrdf
