// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FitParser.h"

#include "FileBytes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace measuredbrdf
{
namespace
{
constexpr int MaximumDepth = 16;

bool IsNameCharacter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || c == '.';
}
}

//------------------------------------------------------------------------------
void FailAtLine(const std::string& path, int line, const std::string& what)
{
  throw FileError(path + ": " + FitFormatName + ", line " + std::to_string(line) + ": " + what);
}

//------------------------------------------------------------------------------
bool FitParser::IsAtEnd()
{
  this->SkipSpace();
  return this->Place >= this->Text.size();
}

//------------------------------------------------------------------------------
std::string FitParser::ReadName(const std::string& what)
{
  this->SkipSpace();
  const std::size_t begin = this->Place;
  while (this->Place < this->Text.size() && IsNameCharacter(this->Text[this->Place]))
  {
    ++this->Place;
  }
  if (this->Place == begin)
  {
    this->Expected(what);
  }
  return std::string(this->Text.substr(begin, this->Place - begin));
}

//------------------------------------------------------------------------------
void FitParser::Expect(char character)
{
  if (!this->Accept(character))
  {
    this->Expected(std::string("'") + character + "'");
  }
}

//------------------------------------------------------------------------------
FitCall FitParser::ReadCall(int depth)
{
  if (depth > MaximumDepth)
  {
    FailAtLine(this->Path, this->Line, "models are nested too deeply");
  }
  FitCall call;
  call.Model = this->ReadName("a model's name");
  call.Line = this->Line;
  this->Expect('(');
  if (this->Accept(')'))
  {
    return call;
  }
  do
  {
    const std::size_t begin = this->Place;
    const int line = this->Line;
    const std::string name = this->ReadName("an attribute or a model");
    if (name[0] >= '0' && name[0] <= '9')
    {
      FailAtLine(this->Path, this->Line,
        "expected an attribute or a model, found " + Quote(name) +
          " (decimals follow a point, not a comma)");
    }
    if (this->Accept('='))
    {
      if (!call.Attributes.emplace(name, this->ReadValue(name)).second)
      {
        FailAtLine(this->Path, this->Line, "attribute " + Quote(name) + " appears twice");
      }
    }
    else
    {
      this->Place = begin;
      this->Line = line;
      call.Terms.push_back(this->ReadCall(depth + 1));
    }
  } while (this->Accept(','));
  this->Expect(')');
  return call;
}

//------------------------------------------------------------------------------
void FitParser::SkipSpace()
{
  for (; this->Place < this->Text.size(); ++this->Place)
  {
    const char c = this->Text[this->Place];
    if (c == '#')
    {
      const std::size_t end = std::min(this->Text.find('\n', this->Place), this->Text.size());
      // A comment inside a call is met twice where ReadCall goes back: taken once.
      if (this->Place >= this->CommentsEnd)
      {
        this->Comments.append(this->Text.substr(this->Place + 1, end - this->Place - 1));
        this->CommentsEnd = end;
      }
      this->Place = end;
      if (end == this->Text.size())
      {
        return;
      }
    }
    if (this->Text[this->Place] == '\n')
    {
      ++this->Line;
    }
    else if (c != ' ' && c != '\t' && c != '\r')
    {
      return;
    }
  }
}

//------------------------------------------------------------------------------
bool FitParser::Accept(char character)
{
  this->SkipSpace();
  if (this->Place < this->Text.size() && this->Text[this->Place] == character)
  {
    ++this->Place;
    return true;
  }
  return false;
}

//------------------------------------------------------------------------------
double FitParser::ReadNumber(const std::string& attribute)
{
  this->SkipSpace();
  this->Place += this->Place < this->Text.size() && this->Text[this->Place] == '+';
  const char* begin = this->Text.data() + this->Place;
  double value = 0.0;
  // Not strtod: its decimal sign follows the locale.
  const auto result = std::from_chars(begin, this->Text.data() + this->Text.size(), value);
  if (result.ec != std::errc() || !std::isfinite(value))
  {
    this->Expected("a finite number for attribute " + Quote(attribute));
  }
  this->Place += static_cast<std::size_t>(result.ptr - begin);
  return value;
}

//------------------------------------------------------------------------------
std::vector<double> FitParser::ReadValue(const std::string& attribute)
{
  std::vector<double> values;
  if (!this->Accept('['))
  {
    values.push_back(this->ReadNumber(attribute));
    return values;
  }
  do
  {
    values.push_back(this->ReadNumber(attribute));
  } while (this->Accept(','));
  this->Expect(']');
  return values;
}

//------------------------------------------------------------------------------
void FitParser::Expected(const std::string& what)
{
  this->SkipSpace();
  std::string found = "the end of the file";
  if (this->Place < this->Text.size())
  {
    const std::string_view rest = this->Text.substr(this->Place, 24);
    found = Quote(rest.substr(0, rest.find_first_of("\r\n")));
  }
  FailAtLine(this->Path, this->Line, "expected " + what + ", found " + found);
}
} // namespace measuredbrdf
