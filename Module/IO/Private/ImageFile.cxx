// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFile.h"

#include "FileBytes.h"
#include "RadianceValues.h"
#include "vtkImageData.h"

#include <glm/glm.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace measuredbrdf
{
namespace
{
/// CIE 1931 x and y of red, green, blue and white, in this order: as in OpenEXR's attribute and in
/// Radiance's PRIMARIES.
using Chromaticities = std::vector<double>;

/// Rec. ITU-R BT.709: those of all colors in this library.
const Chromaticities Rec709 = { 0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290 };

/// CIE XYZ as a color space: its white is X = Y = Z.
const Chromaticities CieXyz = { 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0 };

// What rounding in headers leaves: Radiance's own primaries differ by 0.01.
constexpr double HeaderRounding = 1e-3;
constexpr double LeastDeterminant = 1e-6;

// A display window without data costs no bytes of a file: it may have this many texels anyway.
constexpr double FreeTexels = 1 << 24;

//------------------------------------------------------------------------------
glm::dvec3 ToXyz(double x, double y) { return { x, y, 1.0 - x - y }; }

glm::dmat3 GetPrimaries(const Chromaticities& c)
{
  return glm::dmat3(ToXyz(c[0], c[1]), ToXyz(c[2], c[3]), ToXyz(c[4], c[5])); // columns
}

glm::dvec3 GetWhite(const Chromaticities& c) { return ToXyz(c[6], c[7]) / c[7]; }

glm::dmat3 Scale(const glm::dvec3& s) { return { s.x, 0, 0, 0, s.y, 0, 0, 0, s.z }; }

// SMPTE RP 177-1993, 3.3: the primaries' columns scaled so that (1, 1, 1) is the white of Y = 1.
glm::dmat3 GetToXyz(const Chromaticities& c)
{
  return GetPrimaries(c) * Scale(glm::inverse(GetPrimaries(c)) * GetWhite(c));
}

// The linear Bradford transform (Lam 1985; ICC.1:2022, E.3): from XYZ seen under one white to XYZ
// seen under another.
glm::dmat3 GetAdaptation(const glm::dvec3& from, const glm::dvec3& to)
{
  const glm::dmat3 cones = glm::transpose(
    glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296)); // rows
  return glm::inverse(cones) * Scale((cones * to) / (cones * from)) * cones;
}

// From RGB of chromaticities that span colors to RGB of Rec. 709, white to white.
glm::dmat3 GetToRec709(const Chromaticities& from)
{
  return glm::inverse(GetToXyz(Rec709)) * GetAdaptation(GetWhite(from), GetWhite(Rec709)) *
         GetToXyz(from);
}

// Whether they are finite, not on a line, and the white is within them.
bool SpanColors(const Chromaticities& c)
{
  const auto isUsable = [](double value) { return std::isfinite(value) && std::abs(value) < 1e3; };
  if (!std::all_of(c.begin(), c.end(), isUsable) || c[7] < HeaderRounding ||
      std::abs(glm::determinant(GetPrimaries(c))) < LeastDeterminant)
  {
    return false;
  }
  const glm::dvec3 shares = glm::inverse(GetPrimaries(c)) * GetWhite(c);
  return std::min({ shares.x, shares.y, shares.z }) > 0.0;
}

//------------------------------------------------------------------------------
// A picture of Radiance's (.hdr, .pic): its header, then scanline by scanline.
class RadiancePicture
{
public:
  // Of a file that begins with "#?". Throws FileError.
  explicit RadiancePicture(const FileBytes& file)
    : Reader(file, "image")
  {
    bool isXyz = false;
    for (std::string_view line = this->TakeLine(); !line.empty(); line = this->TakeLine())
    {
      // Lines that begin with a blank belong to pictures that this one was made of.
      const std::size_t equals = std::min(line.find('='), line.size());
      const std::string name(line.substr(0, equals));
      const std::string_view value = line.substr(std::min(equals + 1, line.size()));
      if (name == "EXPOSURE" || name == "COLORCORR")
      {
        this->TakeFactors(name, value, name == "EXPOSURE" ? 1 : 3);
      }
      else if (name == "PRIMARIES")
      {
        this->Primaries = this->TakeNumbers(name, value, 8);
        if (this->Primaries == std::vector<double>(8, 0.0))
        {
          this->Primaries.clear(); // all zero, as some programs write, says nothing
        }
      }
      else if (name == "FORMAT")
      {
        const std::vector<std::string> words = SplitWords(value);
        isXyz = words == std::vector<std::string>{ "32-bit_rle_xyze" };
        this->Require(isXyz || words == std::vector<std::string>{ "32-bit_rle_rgbe" }, name, value,
          "32-bit_rle_rgbe or 32-bit_rle_xyze");
      }
    }
    if (isXyz)
    {
      this->Primaries = CieXyz;
    }
    this->TakeResolution(this->TakeLine());
  }

  // Scanlines as they are stored.
  int ScanlineLength = 0;
  int NumberOfScanlines = 0;
  int Orientation = 1; // as EXIF numbers it
  // What to divide the values by: the products of all EXPOSURE and COLORCORR lines.
  glm::dvec3 Exposure = glm::dvec3(1.0);
  Chromaticities Primaries; // empty: the header does not say them

  // The next scanline, four bytes a texel. Radiance's picture file format: since 1991, channels lie
  // one after the other, in runs. The texels' runs of before are not known here.
  void TakeScanline(std::vector<unsigned char>& line)
  {
    const std::size_t length = line.size() / 4;
    const auto take = [this](std::size_t count)
    { return reinterpret_cast<const unsigned char*>(this->Reader.Take(count, "scanline")); };
    const unsigned char* texel = take(4);
    if (length < 8 || length > 0x7fff || texel[0] != 2 || texel[1] != 2 || texel[2] > 0x7f)
    {
      take(line.size() - 4); // which lies behind it
      std::copy_n(texel, line.size(), line.begin());
      return;
    }
    this->Reader.Require(std::size_t(texel[2] << 8 | texel[3]) == length, "scanline", "found ",
      texel[2] << 8 | texel[3], " texels, expected ", length);
    for (std::size_t channel = 0; channel < 4; ++channel)
    {
      for (std::size_t x = 0; x < length;)
      {
        const std::size_t code = *take(1);
        const bool isRun = code > 128;
        const std::size_t count = isRun ? code - 128 : code;
        this->Reader.Require(count >= 1 && count <= length - x, "scanline", "found a run of ",
          count, " texels where ", length - x, " are left");
        const unsigned char* bytes = take(isRun ? 1 : count);
        for (std::size_t k = 0; k < count; ++k, ++x)
        {
          line[4 * x + channel] = bytes[isRun ? 0 : k];
        }
      }
    }
  }

private:
  void Require(bool condition, const std::string& field, std::string_view found,
    const std::string& expected) const
  {
    if (!condition)
    {
      this->Reader.FailAt(this->Begin, field, "found ", Quote(found), ", expected ", expected);
    }
  }

  // The next line, without its end.
  std::string_view TakeLine()
  {
    this->Begin = this->Reader.GetOffset();
    const std::string_view line = this->Reader.TakeUntil('\n', "header", "has no end");
    return line.substr(0, !line.empty() && line.back() == '\r' ? line.size() - 1 : line.size());
  }

  static std::vector<std::string> SplitWords(std::string_view text)
  {
    std::istringstream rest{ std::string(text) };
    return { std::istream_iterator<std::string>(rest), {} };
  }

  // The numbers of a line such as "EXPOSURE= 2.5", as many as the field has.
  std::vector<double> TakeNumbers(
    const std::string& field, std::string_view text, std::size_t count) const
  {
    const std::vector<std::string> words = SplitWords(text);
    std::vector<double> numbers(words.size());
    const bool areNumbers = std::equal(words.begin(), words.end(), numbers.begin(), ParseNumber);
    this->Require(areNumbers && numbers.size() == count, field, text,
      Concat(count, count == 1 ? " number" : " numbers"));
    return numbers;
  }

  // Radiance's picture file format, "file formats", radiance-online.org: values were multiplied by
  // each EXPOSURE and COLORCORR.
  void TakeFactors(const std::string& field, std::string_view text, std::size_t count)
  {
    const std::vector<double> n = this->TakeNumbers(field, text, count);
    const glm::dvec3 factors = count == 1 ? glm::dvec3(n[0]) : glm::dvec3(n[0], n[1], n[2]);
    this->Exposure *= factors;
    for (int c = 0; c < 3; ++c)
    {
      this->Require(factors[c] > 0.0 && this->Exposure[c] >= 1e-30 && this->Exposure[c] <= 1e30,
        field, text, "positive numbers whose product is from 1e-30 to 1e30");
    }
  }

  // "-Y 512 +X 1024": the first axis goes from scanline to scanline, the second along each. -Y: the
  // first is the top one; +X: the first is the left one.
  void TakeResolution(std::string_view text)
  {
    static const std::regex pattern(
      " *([-+])([XY]) +([1-9][0-9]{0,8}) +([-+])([XY]) +([1-9][0-9]{0,8}) *");
    constexpr std::size_t longest = 80;
    const std::string line(text.substr(0, longest + 1));
    std::smatch found;
    const bool isGood =
      line.size() <= longest && std::regex_match(line, found, pattern) && found[2] != found[5];
    this->Require(isGood, "resolution", text, "a line such as '-Y 512 +X 1024'");
    this->NumberOfScanlines = std::stoi(found[3]);
    this->ScanlineLength = std::stoi(found[6]);
    const bool rows = found[2] == "Y";
    const bool top = found[rows ? 1 : 4] == "-";
    const bool left = found[rows ? 4 : 1] == "+";
    // EXIF 2.32, tag 274: 1 to 4 begin at the top left, top right, bottom right, bottom left; 5 to
    // 8, whose scanlines are columns, at the left top, right top, right bottom, left bottom.
    const int corner = top ? (left ? 0 : 1) : (left ? 3 : 2);
    this->Orientation = (rows ? 1 : 5) + corner;
  }

  ByteReader Reader;
  std::size_t Begin = 0; // of the line that was taken last
};

//------------------------------------------------------------------------------
// Makes the picture that is to be seen: the data window's texels in a display window that is black
// elsewhere, turned as EXIF 2.32, tag 274 (TIFF 6.0, Orientation) says, by which side of the
// picture the stored row 0 and column 0 are.
void Arrange(const ImageSource& source, DecodedImage& image)
{
  const glm::ivec2 window(image.DisplayWidth, image.DisplayHeight);
  const bool isWhole =
    image.Left == 0 && image.Top == 0 && window == glm::ivec2(image.Width, image.Height);
  const int turn = image.Orientation >= 1 && image.Orientation <= 8 ? image.Orientation - 1 : 0;
  if (isWhole && turn == 0)
  {
    return;
  }
  Require(window.x >= 1 && window.y >= 1, source.Path, ": display window: found ", window.x, " x ",
    window.y, " pixels, expected at least 1 x 1");
  if (!isWhole && double(window.x) * window.y > FreeTexels)
  {
    CheckImageSize(source.Path + ": display window", *source.Format,
      { double(window.x), double(window.y) }, source.FileSize);
  }
  const bool columns = turn >= 4; // stored rows are columns of the picture
  const bool right = turn % 4 == 1 || turn % 4 == 2;
  const bool bottom = turn % 4 >= 2;
  const int width = columns ? window.y : window.x;
  const int height = columns ? window.x : window.y;
  const auto values = static_cast<std::size_t>(image.ValuesPerTexel);
  const std::size_t stored = image.Pixels.size() / values;
  const std::size_t shown = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::size_t inside = 0;
  std::vector<float> pixels;
  pixels.reserve(values * shown);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const int across = right ? width - 1 - x : x;
      const int down = bottom ? height - 1 - y : y;
      const glm::i64vec2 from =
        (columns ? glm::i64vec2(down, across) : glm::i64vec2(across, down)) -
        glm::i64vec2(image.Left, image.Top);
      if (from.x < 0 || from.y < 0 || from.x >= image.Width || from.y >= image.Height)
      {
        pixels.insert(pixels.end(), values, 0.0f);
        continue;
      }
      const float* texel =
        &image.Pixels[static_cast<std::size_t>(from.y * image.Width + from.x) * values];
      pixels.insert(pixels.end(), texel, texel + values);
      ++inside;
    }
  }
  image.Pixels.swap(pixels);
  image.Width = width;
  image.Height = height;
  if (shown > inside)
  {
    image.Notes.push_back(Concat("The data window leaves ", shown - inside,
      " texels of the display window free: they are black."));
  }
  if (stored > inside)
  {
    image.Notes.push_back(
      Concat(stored - inside, " texels outside the display window were left out."));
  }
}

//------------------------------------------------------------------------------
// Before colors change: infinite times 0 is no number.
void LimitValues(DecodedImage& image)
{
  const float largest = GetLargestValue(image.Pixels);
  const auto values = static_cast<std::size_t>(image.ValuesPerTexel);
  std::size_t count = 0;
  for (std::size_t k = 0; k < image.Pixels.size(); ++k)
  {
    if (image.Pixels[k] > largest && k % values < 3)
    {
      image.Pixels[k] = largest;
      count += image.IsGray && k % values > 0 ? 0 : 1; // a gray value stands three times
    }
  }
  if (count > 0)
  {
    image.Notes.push_back(Concat(count,
      count == 1 ? " value of +infinity was" : " values of +infinity were", " taken as ", largest,
      ", the largest ", largest > 65504.0f ? "value of the file." : "half float."));
  }
}

//------------------------------------------------------------------------------
void Transform(const glm::dmat3& matrix, DecodedImage& image)
{
  const auto values = static_cast<std::size_t>(image.ValuesPerTexel);
  for (std::size_t k = 0; k + 2 < image.Pixels.size(); k += values)
  {
    float* texel = &image.Pixels[k];
    const glm::vec3 rgb = matrix * glm::dvec3(texel[0], texel[1], texel[2]);
    std::copy_n(&rgb[0], 3, texel);
  }
}

void ConvertColors(const std::string& path, DecodedImage& image)
{
  const Chromaticities& from = image.Chromaticities;
  std::string found;
  for (const double value : from)
  {
    found += " " + NumberText(value);
  }
  Require(SpanColors(from), path, ": image header, chromaticities: found", found,
    ", expected x and y of red, green, blue and of a white between them");
  const bool isRec709 = std::equal(from.begin(), from.end(), Rec709.begin(),
    [](double a, double b) { return std::abs(a - b) <= HeaderRounding; });
  // Encoded integers are display values by another name: their readers take them as sRGB.
  if (!image.IsGray && !image.IsEncoded && !isRec709)
  {
    Transform(GetToRec709(from), image);
  }
}

//------------------------------------------------------------------------------
// Ward 1991, "Real pixels" (Graphics Gems II): a mantissa for each channel, and their exponent.
DecodedImage ReadRadiancePicture(const ImageSource& source)
{
  const FileBytes file(source.Path);
  RadiancePicture picture(file);
  CheckImageSize(source.Path, *source.Format,
    { double(picture.ScanlineLength), double(picture.NumberOfScanlines), 3 }, source.FileSize);
  DecodedImage image(source, picture.ScanlineLength, picture.NumberOfScanlines, false, false);
  image.Orientation = picture.Orientation;
  image.Chromaticities = picture.Primaries;
  std::vector<unsigned char> line(4 * static_cast<std::size_t>(image.Width));
  for (int y = 0; y < image.Height; ++y)
  {
    picture.TakeScanline(line);
    for (std::size_t k = 0; k < line.size(); k += 4)
    {
      const float scale = line[k + 3] == 0 ? 0.0f : std::ldexp(1.0f, line[k + 3] - 136);
      const float texel[3] = { scale * line[k], scale * line[k + 1], scale * line[k + 2] };
      image.AddTexel(texel);
    }
  }
  if (picture.Exposure != glm::dvec3(1.0))
  {
    Transform(Scale(1.0 / picture.Exposure), image);
  }
  return image;
}

//------------------------------------------------------------------------------
// Top row first -> bottom row first.
template <typename Value>
void FillScalars(const ImageFile& file, double scale, int colors, Value* values)
{
  for (int y = file.Height - 1; y >= 0; --y)
  {
    const auto width = static_cast<std::size_t>(file.Width);
    for (std::size_t x = 0; x < width; ++x)
    {
      const std::size_t at = static_cast<std::size_t>(y) * width + x;
      const float* texel = &file.Pixels[static_cast<std::size_t>(file.ValuesPerTexel) * at];
      for (int c = 0; c < colors + (file.HasAlpha ? 1 : 0); ++c)
      {
        const float value = texel[c == colors ? 3 : c];
        *values++ = static_cast<Value>(scale > 1.0 ? std::lround(scale * value) : value);
      }
    }
  }
}
}

//------------------------------------------------------------------------------
ImageFile ReadImageFile(const std::string& path, bool alpha, const std::string& layer)
{
  ImageSource source;
  source.Path = path;
  source.FileSize = CheckFile(path);
  source.Format = &RecognizeImage(path);
  source.Alpha = alpha;
  source.Layer = layer;
  Require(layer.empty() || source.Format->Is("openexr"), path, ": layer: found none, expected ",
    Quote(layer));
  const int orientation = CheckStoredSize(path, *source.Format, source.FileSize);

  DecodedImage image = source.Format->Is("openexr") ? DecodeExrImage(source)
                       : source.Format->Is("hdr")   ? ReadRadiancePicture(source)
                                                    : DecodeImage(source);
  image.Orientation = source.Format->Is("jpeg") ? orientation : image.Orientation;
  LimitValues(image);
  if (image.Chromaticities.size() == Rec709.size())
  {
    ConvertColors(path, image);
  }
  Arrange(source, image);
  return image;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeImageData(const ImageFile& file, bool isInteger, bool keepsGray)
{
  const int colors = keepsGray && file.IsGray ? 1 : 3;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(file.Width, file.Height, 1);
  image->AllocateScalars(!isInteger      ? VTK_FLOAT
                         : file.HasBytes ? VTK_UNSIGNED_CHAR
                                         : VTK_UNSIGNED_SHORT,
    colors + (file.HasAlpha ? 1 : 0));
  const double scale = !isInteger ? 1.0 : file.HasBytes ? 255.0 : 65535.0;
  switch (image->GetScalarType())
  {
    vtkTemplateMacro(
      FillScalars(file, scale, colors, static_cast<VTK_TT*>(image->GetScalarPointer())));
  }
  return image;
}
} // namespace measuredbrdf
