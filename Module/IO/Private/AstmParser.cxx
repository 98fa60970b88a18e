// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AstmParser.h"

#include "NumberText.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t MostColumns = 4096 + 4;
constexpr std::size_t LongestHeader = 65536; // bytes
constexpr std::string_view Blanks = " \t\r";

std::string_view Trim(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(Blanks);
  return first == std::string_view::npos
           ? std::string_view()
           : text.substr(first, text.find_last_not_of(Blanks) - first + 1);
}

// The value of a line "KEY value", or null where it has another key.
bool HasKey(std::string_view line, std::string_view key, std::string_view& value)
{
  if (line.substr(0, key.size()) != key ||
      (line.size() > key.size() && Blanks.find(line[key.size()]) == std::string_view::npos))
  {
    return false;
  }
  value = Trim(line.substr(key.size()));
  return true;
}

// Up to the separator, which is stepped over with it.
std::string_view Take(std::string_view& text, char separator)
{
  const std::size_t length = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return part;
}

void SkipMark(std::string_view& text) // of byte order
{
  if (text.substr(0, 3) == "\xef\xbb\xbf")
  {
    text.remove_prefix(3);
  }
}

class TextParser
{
public:
  TextParser(const FileBytes& file, const char* format)
    : Path(file.GetPath())
    , Format(format)
    , Rest(file.GetView())
  {
    SkipMark(this->Rest);
  }

  AstmTexts Parse(bool onlyHeader)
  {
    this->ReadHeader();
    if (!onlyHeader)
    {
      this->ReadRows();
    }
    return std::move(this->Texts);
  }

private:
  [[noreturn]] void Fail(const std::string& field, const std::string& what) const
  {
    throw FileError(this->Path + ": " + this->Format + ", line " + std::to_string(this->Line) +
                    ", " + field + ": " + what);
  }

  std::string_view TakeLine()
  {
    ++this->Line;
    return Trim(Take(this->Rest, '\n'));
  }

  void ReadHeader()
  {
    const std::size_t whole = this->Rest.size();
    while (!this->Rest.empty() && whole - this->Rest.size() < LongestHeader)
    {
      const std::string_view line = this->TakeLine();
      std::string_view value;
      if (HasKey(line, "VARS", value))
      {
        this->ReadColumns(value);
        return;
      }
      if (HasKey(line, "NUM_POINTS", value))
      {
        double points = 0.0;
        if (!ParseNumber(value, points) || points < 1.0 || points != std::floor(points))
        {
          this->Fail("NUM_POINTS", "found " + Quote(value) + ", expected a whole number from 1");
        }
        this->Points = points;
      }
      else if (!line.empty())
      {
        this->Texts.Header.emplace_back(line);
      }
    }
    this->Fail("VARS", "no such line in the first " + std::to_string(LongestHeader) +
                         " bytes, expected the names of the columns");
  }

  void ReadColumns(std::string_view names)
  {
    while (!names.empty())
    {
      const std::string_view name = Trim(Take(names, ','));
      if (name.empty() || this->Texts.Columns.size() == MostColumns)
      {
        this->Fail(
          "VARS", "expected 1 to " + std::to_string(MostColumns) + " names with commas between");
      }
      this->Texts.Columns.emplace_back(name);
    }
    if (this->Texts.Columns.empty())
    {
      this->Fail("VARS", "names no column");
    }
  }

  void ReadRows()
  {
    const std::size_t columns = this->Texts.Columns.size();
    while (!this->Rest.empty())
    {
      std::string_view line = this->TakeLine();
      // What editors and transfers add at the end.
      if (line.find_first_not_of(std::string_view("\0\x1a", 2)) == std::string_view::npos)
      {
        continue;
      }
      std::size_t count = 0;
      for (; !line.empty(); ++count)
      {
        const std::string_view word = Trim(Take(line, ','));
        double number = 0.0;
        if (!ParseNumber(word, number))
        {
          this->Fail("number " + std::to_string(count + 1),
            "found " + Quote(word) + ", expected a finite number");
        }
        if (count < columns)
        {
          this->Texts.Numbers.push_back(number);
        }
      }
      this->Texts.Lines.push_back(this->Line);
      if (count != columns)
      {
        this->Fail("row", "found " + std::to_string(count) + " numbers, expected the " +
                            std::to_string(columns) + " that VARS names");
      }
    }
    const std::size_t rows = this->Texts.GetNumberOfRows();
    if (rows == 0 || (this->Points > 0.0 && this->Points != static_cast<double>(rows)))
    {
      const std::string points = this->Points > 0.0 ? NumberText(this->Points, 15) : "at least 1";
      this->Fail("end", "found " + std::to_string(rows) + " rows, expected " + points +
                          (this->Points > 0.0 ? " (NUM_POINTS)" : ""));
    }
  }

  std::string Path;
  std::string Format;
  std::string_view Rest;
  std::size_t Line = 0;
  double Points = 0.0; // 0: not said
  AstmTexts Texts;
};
}

//------------------------------------------------------------------------------
bool HasAstmColumns(std::string_view text)
{
  std::string_view rest = text.substr(0, LongestHeader);
  SkipMark(rest);
  while (!rest.empty())
  {
    std::string_view value;
    if (HasKey(Trim(Take(rest, '\n')), "VARS", value) &&
        value.find("theta_") != std::string_view::npos)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
AstmTexts ParseAstm(const FileBytes& file, const char* format, bool onlyHeader)
{
  return TextParser(file, format).Parse(onlyHeader);
}
} // namespace measuredbrdf
