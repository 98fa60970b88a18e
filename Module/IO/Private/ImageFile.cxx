// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFile.h"

#include "ExrHeader.h"
#include "FileBytes.h"
#include "ImageFormats.h"
#include "NumberText.h"
#include "RadianceValues.h"
#include "vtkImageData.h"

#include <glm/glm.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
/// CIE 1931 x and y of red, green, blue and white, in this order: as in OpenEXR's attribute and in
/// Radiance's PRIMARIES.
using Chromaticities = std::array<double, 8>;

/// Rec. ITU-R BT.709: those of all colors in this library.
constexpr Chromaticities Rec709 = { 0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290 };

/// CIE XYZ as a color space: its white is X = Y = Z.
constexpr Chromaticities CieXyz = { 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0 };

// What rounding in headers leaves: Radiance's own primaries differ by 0.01.
constexpr double HeaderRounding = 1e-3;
constexpr double LeastDeterminant = 1e-6;

//------------------------------------------------------------------------------
glm::dvec3 ToXyz(double x, double y) { return glm::dvec3(x, y, 1.0 - x - y); }

//------------------------------------------------------------------------------
glm::dmat3 GetPrimaries(const Chromaticities& c)
{
  return glm::dmat3(ToXyz(c[0], c[1]), ToXyz(c[2], c[3]), ToXyz(c[4], c[5])); // columns
}

//------------------------------------------------------------------------------
glm::dvec3 GetWhite(const Chromaticities& c) { return ToXyz(c[6], c[7]) / c[7]; }

//------------------------------------------------------------------------------
// SMPTE RP 177-1993, 3.3: the primaries' columns scaled so that (1, 1, 1) is the white of Y = 1.
glm::dmat3 GetToXyz(const Chromaticities& c)
{
  const glm::dmat3 primaries = GetPrimaries(c);
  const glm::dvec3 scale = glm::inverse(primaries) * GetWhite(c);
  return glm::dmat3(primaries[0] * scale[0], primaries[1] * scale[1], primaries[2] * scale[2]);
}

//------------------------------------------------------------------------------
// The linear Bradford transform (Lam 1985; ICC.1:2022, E.3): from XYZ seen under one white to XYZ
// seen under another.
glm::dmat3 GetAdaptation(const glm::dvec3& from, const glm::dvec3& to)
{
  const glm::dmat3 cones = glm::transpose(
    glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296)); // rows
  const glm::dvec3 gain = (cones * to) / (cones * from);
  const glm::dmat3 scale(gain.x, 0.0, 0.0, 0.0, gain.y, 0.0, 0.0, 0.0, gain.z);
  return glm::inverse(cones) * scale * cones;
}

//------------------------------------------------------------------------------
// Whether they are Rec. 709's, but for rounding.
bool IsRec709(const Chromaticities& chromaticities)
{
  return std::equal(chromaticities.begin(), chromaticities.end(), Rec709.begin(),
    [](double a, double b) { return std::abs(a - b) <= HeaderRounding; });
}

//------------------------------------------------------------------------------
// Whether they span colors: finite, not on a line, and a white within them.
bool SpanColors(const Chromaticities& chromaticities)
{
  if (!std::all_of(chromaticities.begin(), chromaticities.end(),
        [](double value) { return std::isfinite(value) && std::abs(value) < 1e3; }) ||
      chromaticities[7] < HeaderRounding ||
      std::abs(glm::determinant(GetPrimaries(chromaticities))) < LeastDeterminant)
  {
    return false;
  }
  const glm::dvec3 shares = glm::inverse(GetPrimaries(chromaticities)) * GetWhite(chromaticities);
  return shares.x > 0.0 && shares.y > 0.0 && shares.z > 0.0;
}

//------------------------------------------------------------------------------
// From RGB of chromaticities that span colors to RGB of Rec. 709, white to white.
glm::dmat3 GetToRec709(const Chromaticities& from)
{
  return glm::inverse(GetToXyz(Rec709)) * GetAdaptation(GetWhite(from), GetWhite(Rec709)) *
         GetToXyz(from);
}
// The header of a picture of Radiance's (.hdr, .pic), which OpenImageIO drops or reads otherwise on
// every version: all of exposure, color correction, primaries, XYZ, and the order of the scanlines.
struct RadianceHeader
{
  // Scanlines as they are stored.
  int ScanlineLength = 0;
  int NumberOfScanlines = 0;
  int Orientation = 1; // as EXIF numbers it
  // What to divide the values by: the products of all EXPOSURE and COLORCORR lines.
  std::array<double, 3> Exposure = { 1.0, 1.0, 1.0 };
  std::optional<Chromaticities> Primaries; // where the header says them
  std::size_t Size = 0;                    // bytes before the pixels
};

using HeaderLine = std::string_view;

//------------------------------------------------------------------------------
class HeaderLines
{
public:
  explicit HeaderLines(const FileBytes& file)
    : File(file)
  {
  }

  std::size_t GetOffset() const { return this->Next; }

  // The next line, without its end.
  HeaderLine Take()
  {
    this->Begin = this->Next;
    const HeaderLine rest = this->File.GetView().substr(this->Begin);
    const std::size_t length = rest.find('\n');
    if (length == HeaderLine::npos)
    {
      this->Fail("header", "has no end");
    }
    this->Next += length + 1;
    const bool isDos = length > 0 && rest[length - 1] == '\r';
    return rest.substr(0, length - (isDos ? 1 : 0));
  }

  [[noreturn]] void Fail(const std::string& field, const std::string& what) const
  {
    throw FileError(this->File.GetPath() + ": image header, " + field + " at byte " +
                    std::to_string(this->Begin) + ": " + what);
  }

private:
  const FileBytes& File;
  std::size_t Begin = 0; // of the line that was taken last
  std::size_t Next = 0;
};

//------------------------------------------------------------------------------
// Words between blanks.
std::vector<HeaderLine> SplitWords(HeaderLine text)
{
  constexpr HeaderLine blanks = " \t";
  std::vector<HeaderLine> words;
  for (std::size_t begin = text.find_first_not_of(blanks); begin != HeaderLine::npos;)
  {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  return words;
}

//------------------------------------------------------------------------------
// The numbers of a line such as "EXPOSURE= 2.5", as many as the field has.
std::vector<double> TakeNumbers(
  const HeaderLines& lines, const std::string& field, HeaderLine text, int count)
{
  std::vector<double> numbers;
  for (const HeaderLine word : SplitWords(text))
  {
    double number = 0.0;
    if (!ParseNumber(word, number))
    {
      break;
    }
    numbers.push_back(number);
  }
  if (numbers.size() != static_cast<std::size_t>(count))
  {
    lines.Fail(field, "found " + Quote(std::string(text)) + ", expected " + std::to_string(count) +
                        (count == 1 ? " number" : " numbers"));
  }
  return numbers;
}

//------------------------------------------------------------------------------
// Radiance's picture file format, "file formats", radiance-online.org: values were multiplied by
// each EXPOSURE and COLORCORR.
void TakeFactors(const HeaderLines& lines, const std::string& field, HeaderLine text, int count,
  std::array<double, 3>& product)
{
  const std::vector<double> factors = TakeNumbers(lines, field, text, count);
  for (std::size_t c = 0; c < 3; ++c)
  {
    const double factor = factors[c % factors.size()];
    product[c] *= factor;
    if (!(factor > 0.0) || !(product[c] >= 1e-30 && product[c] <= 1e30))
    {
      lines.Fail(field, "found " + Quote(std::string(text)) +
                          ", expected positive numbers whose product is from 1e-30 to 1e30");
    }
  }
}

//------------------------------------------------------------------------------
// "-Y 512 +X 1024": the first axis goes from scanline to scanline, the second along each. -Y: the
// first is the top one; +X: the first is the left one.
bool ParseResolution(HeaderLine text, RadianceHeader& header)
{
  const std::vector<HeaderLine> words = SplitWords(text);
  const auto isAxis = [&words](std::size_t k, char axis)
  { return words[k].size() == 2 && HeaderLine("+-").find(words[k][0]) < 2 && words[k][1] == axis; };
  const auto take = [&words](std::size_t k, int& value)
  {
    const char* end = words[k].data() + words[k].size();
    const auto read = std::from_chars(words[k].data(), end, value);
    return read.ec == std::errc() && read.ptr == end && value > 0;
  };
  if (words.size() != 4 || !take(1, header.NumberOfScanlines) || !take(3, header.ScanlineLength))
  {
    return false;
  }
  const bool rows = isAxis(0, 'Y') && isAxis(2, 'X');
  if (!rows && !(isAxis(0, 'X') && isAxis(2, 'Y')))
  {
    return false;
  }
  const bool top = words[rows ? 0 : 2][0] == '-';
  const bool left = words[rows ? 2 : 0][0] == '+';
  // EXIF 2.32, tag 274: 1 to 4 begin at the top left, top right, bottom right, bottom left; 5 to 8,
  // whose scanlines are columns, at the left top, right top, right bottom, left bottom.
  const int corner = top ? (left ? 0 : 1) : (left ? 3 : 2);
  header.Orientation = (rows ? 1 : 5) + corner;
  return true;
}

//------------------------------------------------------------------------------
// Of a file that begins with "#?". Throws FileError.
RadianceHeader ParseRadianceHeader(const FileBytes& file)
{
  RadianceHeader header;
  HeaderLines lines(file);
  bool isXyz = false;
  for (HeaderLine line = lines.Take(); !line.empty(); line = lines.Take())
  {
    // Lines that begin with a blank belong to pictures that this one was made of.
    const std::size_t equals = line.find('=');
    const HeaderLine name = line.substr(0, equals);
    const HeaderLine value = equals == HeaderLine::npos ? HeaderLine() : line.substr(equals + 1);
    if (name == "EXPOSURE")
    {
      TakeFactors(lines, "EXPOSURE", value, 1, header.Exposure);
    }
    else if (name == "COLORCORR")
    {
      TakeFactors(lines, "COLORCORR", value, 3, header.Exposure);
    }
    else if (name == "PRIMARIES")
    {
      const std::vector<double> numbers = TakeNumbers(lines, "PRIMARIES", value, 8);
      header.Primaries.reset(); // all zero, as some programs write, says nothing
      if (std::any_of(numbers.begin(), numbers.end(), [](double number) { return number != 0.0; }))
      {
        header.Primaries.emplace();
        std::copy(numbers.begin(), numbers.end(), header.Primaries->begin());
      }
    }
    else if (name == "FORMAT")
    {
      const std::vector<HeaderLine> words = SplitWords(value);
      isXyz = words.size() == 1 && words[0] == "32-bit_rle_xyze";
      if (!isXyz && !(words.size() == 1 && words[0] == "32-bit_rle_rgbe"))
      {
        lines.Fail("FORMAT",
          "found " + Quote(std::string(value)) + ", expected 32-bit_rle_rgbe or 32-bit_rle_xyze");
      }
    }
  }
  if (isXyz)
  {
    header.Primaries = CieXyz;
  }
  const HeaderLine resolution = lines.Take();
  if (!ParseResolution(resolution, header))
  {
    lines.Fail("resolution",
      "found " + Quote(std::string(resolution)) + ", expected a line such as '-Y 512 +X 1024'");
  }
  header.Size = lines.GetOffset();
  return header;
}

//------------------------------------------------------------------------------
// A header that says nothing but the size, for OpenImageIO.
std::string MakePlainHeader(const RadianceHeader& header)
{
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(header.NumberOfScanlines) +
         " +X " + std::to_string(header.ScanlineLength) + "\n";
}
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
