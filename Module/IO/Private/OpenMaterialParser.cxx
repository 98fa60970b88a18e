// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OpenMaterialParser.h"

#include <nlohmann/json.hpp>

#include <string>

namespace measuredbrdf
{
namespace
{
using Json = nlohmann::json;

constexpr std::size_t DeepestLevel = 32;
constexpr std::size_t RowSize = 5;
constexpr std::size_t LongestText = 1000; // of the metadata, in bytes

const char* const TableName = "lookupTable";

/// Takes what is known, wherever it stands in the right place, and steps over everything else.
class Handler : public nlohmann::json_sax<Json>
{
public:
  explicit Handler(const FileBytes& file)
    : Reader(file, OpenMaterialFormatName)
  {
  }

  OpenMaterialTexts Texts;
  bool HasBrdf = false;
  bool HasReadings = false;

  [[noreturn]] void Fail(const std::string& field, const std::string& what) const
  {
    throw FileError(this->Reader.GetFile().GetPath() + ": " + OpenMaterialFormatName + ", " +
                    field + ": " + what);
  }

  bool null() override
  {
    this->Add(0.0, true);
    return true;
  }
  bool boolean(bool) override { return this->Refuse("a truth value"); }
  bool number_integer(std::int64_t value) override { return this->Add(double(value), false); }
  bool number_unsigned(std::uint64_t value) override { return this->Add(double(value), false); }
  bool number_float(double value, const std::string&) override { return this->Add(value, false); }
  bool binary(Json::binary_t&) override { return this->Refuse("bytes"); }

  bool string(std::string& value) override
  {
    const bool isListed = this->Levels.size() == 3 && this->Levels[2] == Array;
    if (this->Top == "metadata" && (this->Levels.size() == 2 || isListed))
    {
      std::string& text = this->Texts.Metadata[this->Second];
      if (text.size() + value.size() < LongestText)
      {
        text += (text.empty() ? "" : ", ") + value;
      }
    }
    return this->Refuse("a text");
  }

  bool key(std::string& name) override
  {
    if (this->Levels.size() == 1)
    {
      this->Top = name;
    }
    else if (this->Levels.size() == 2)
    {
      this->Second = name;
      if (this->Top == "metadata" && this->Texts.Metadata.size() >= DeepestLevel)
      {
        this->Second.clear(); // more names than the format has: left out together
      }
    }
    return true;
  }

  bool start_object(std::size_t) override
  {
    this->Refuse("an object");
    if (this->Levels.size() == 1 && this->Top == "brdf")
    {
      this->HasBrdf = true;
    }
    return this->Enter(Object);
  }
  bool end_object() override { return this->Leave(); }

  bool start_array(std::size_t) override
  {
    if (this->Levels.size() == 2 && this->IsIn(TableName))
    {
      if (this->HasReadings)
      {
        this->Fail(TableName, "appears twice");
      }
      this->HasReadings = true;
    }
    else if (this->IsInRow())
    {
      this->Refuse("a list");
    }
    else if (this->IsInTable())
    {
      this->Count = 0;
      this->HasNull = false;
    }
    return this->Enter(Array);
  }

  bool end_array() override
  {
    if (this->IsInRow())
    {
      if (this->Count != RowSize)
      {
        this->Fail(this->GetRow(), "found " + std::to_string(this->Count) +
                                     " numbers, expected 5: wavelength, three angles, value");
      }
      if (this->HasNull)
      {
        ++this->Texts.Nulls;
      }
      else
      {
        this->Texts.Rows.push_back(this->Row);
      }
    }
    return this->Leave();
  }

  bool parse_error(
    std::size_t position, const std::string&, const nlohmann::detail::exception& problem) override
  {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..."
    const std::string text = problem.what();
    const std::size_t bracket = text.find("] ");
    this->Reader.FailAt(
      position, "JSON", bracket == std::string::npos ? text : text.substr(bracket + 2));
  }

private:
  enum Level : char
  {
    Object,
    Array
  };

  bool IsIn(const char* name) const { return this->Top == "brdf" && this->Second == name; }
  bool IsInTable() const
  {
    return this->Levels.size() == 3 && this->Levels[2] == Array && this->IsIn(TableName);
  }
  bool IsInRow() const
  {
    return this->Levels.size() == 4 && this->Levels[2] == Array && this->IsIn(TableName);
  }
  std::string GetRow() const
  {
    return std::string(TableName) + ", row " +
           std::to_string(this->Texts.Rows.size() + this->Texts.Nulls + 1);
  }

  // What must not be among the table's numbers.
  bool Refuse(const char* what) const
  {
    if (this->IsInRow() || this->IsInTable())
    {
      this->Fail(this->GetRow(), std::string("found ") + what + ", expected five numbers");
    }
    return true;
  }

  bool Add(double value, bool isNull)
  {
    if (this->IsInRow())
    {
      if (this->Count < RowSize)
      {
        this->Row[this->Count] = value;
      }
      ++this->Count;
      this->HasNull = this->HasNull || isNull;
    }
    else if (this->IsInTable())
    {
      this->Refuse("a number alone");
    }
    else if (this->Levels.size() == 3 && this->IsIn("wavelengths") && !isNull)
    {
      this->Texts.Wavelengths.push_back(value);
    }
    return true;
  }

  bool Enter(Level level)
  {
    if (this->Levels.size() == DeepestLevel)
    {
      this->Fail("JSON", "is nested deeper than " + std::to_string(DeepestLevel) + " levels");
    }
    this->Levels.push_back(level);
    return true;
  }

  bool Leave()
  {
    this->Levels.pop_back();
    if (this->Levels.size() < 3)
    {
      (this->Levels.size() < 2 ? this->Top : this->Second).clear();
    }
    return true;
  }

  ByteReader Reader;
  std::vector<Level> Levels; // of which the place is inside
  std::string Top;           // key in the file's object
  std::string Second;        // key in that
  std::array<double, RowSize> Row = {};
  std::size_t Count = 0; // of the row's numbers
  bool HasNull = false;
};
}

//------------------------------------------------------------------------------
OpenMaterialTexts ParseOpenMaterial(const FileBytes& file)
{
  Handler handler(file);
  const char* bytes = file.GetData();
  Json::sax_parse(bytes, bytes + file.GetSize(), &handler);
  if (!handler.HasBrdf)
  {
    handler.Fail("brdf",
      "is missing: expected the look-up table of a BRDF (NAME_brdf.xompt), not another property");
  }
  if (!handler.HasReadings)
  {
    handler.Fail(TableName, "is missing in 'brdf'");
  }
  return std::move(handler.Texts);
}
} // namespace measuredbrdf
