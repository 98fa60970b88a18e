// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceHeader.h"

#include "FileBytes.h"
#include "NumberText.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

namespace measuredbrdf
{
namespace
{
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
}

//------------------------------------------------------------------------------
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
std::string MakePlainHeader(const RadianceHeader& header)
{
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(header.NumberOfScanlines) +
         " +X " + std::to_string(header.ScanlineLength) + "\n";
}
} // namespace measuredbrdf
