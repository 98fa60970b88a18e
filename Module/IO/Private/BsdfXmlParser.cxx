// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BsdfXmlParser.h"

#include "TakenError.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkXMLParser.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <limits>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t DeepestElement = 64;

std::string Trim(const std::string& text)
{
  const char* const white = " \t\r\n";
  const std::size_t first = text.find_first_not_of(white);
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(white) - first + 1);
}

// Whether the block says how visible light is reflected or transmitted.
bool IsWanted(const BsdfXmlBlock& block, const std::string& wavelength)
{
  const auto isOneOf = [](const std::string& text, std::initializer_list<const char*> words)
  {
    return std::any_of(
      words.begin(), words.end(), [&text](const char* word) { return IsSameWord(text, word); });
  };
  return isOneOf(block.Direction,
           { "Reflection Front", "Reflection Back", "Transmission Front", "Transmission Back" }) &&
         isOneOf(wavelength, { "Visible", "CIE-X", "CIE-Z" });
}

// Where the XML begins: programs such as Radiance's genBSDF may leave lines of their own before it.
std::size_t FindXmlStart(std::string_view text)
{
  const std::size_t start = std::min(text.find("<?xml"), text.find("<WindowElement"));
  const std::string_view before = text.substr(0, std::min(start, text.size()));
  const std::size_t first = before.find_first_not_of(" \t\r\n");
  const bool isXml = start == std::string_view::npos || before == "\xef\xbb\xbf" ||
                     (first != std::string_view::npos && before[first] == '<');
  return isXml ? 0 : start;
}

// Puts texts where they belong as their elements end. The first problem counts; after it nothing is
// kept.
class XmlParser : public vtkXMLParser
{
public:
  static XmlParser* New();
  vtkTypeMacro(XmlParser, vtkXMLParser);

  BsdfXmlTexts Texts;
  std::string Problem;
  std::uint64_t ProblemOffset = 0;
  std::uint64_t Start = 0; // of the XML in the file

protected:
  void StartElement(const char* name, const char**) override
  {
    if (this->Path.size() >= DeepestElement)
    {
      this->Fail("elements are nested too deeply");
    }
    if (!this->Problem.empty())
    {
      return;
    }
    const std::string element = name;
    if (this->Path.empty() && element != "WindowElement")
    {
      this->Fail("the root is " + Quote(element) + ", expected 'WindowElement'");
    }
    this->Path.push_back(element);
    this->Text.clear();
    if (element == "Layer")
    {
      ++this->Texts.Layers;
    }
    else if (this->IsKept() && element == "AngleBasis" && this->IsIn("DataDefinition"))
    {
      this->Texts.Bases.emplace_back();
    }
    else if (this->IsKept() && element == "AngleBasisBlock" && !this->Texts.Bases.empty())
    {
      this->Texts.Bases.back().Rings.emplace_back();
    }
    else if (element == "WavelengthData")
    {
      this->Wavelength.clear();
    }
    else if (element == "WavelengthDataBlock")
    {
      this->Block = {};
    }
    else if (element == "ScatteringData")
    {
      this->Block.Offset = this->GetPlace();
    }
  }

  void CharacterDataHandler(const char* data, int length) override
  {
    if (this->Problem.empty() && length > 0)
    {
      this->Text.append(data, static_cast<std::size_t>(length));
    }
  }

  void EndElement(const char*) override
  {
    if (!this->Problem.empty() || this->Path.empty())
    {
      return;
    }
    const std::string element = this->Path.back();
    this->Path.pop_back();
    if (this->IsKept())
    {
      this->Take(element);
    }
    this->Text.clear();
  }

  void ReportXmlParseError() override
  {
    const TakenError error(this);
    this->Superclass::ReportXmlParseError(); // "...byte index N: REASON"
    const std::string text = error.GetText();
    this->Fail("no well-formed XML: " +
               text.substr(text.rfind(": ") == std::string::npos ? 0 : text.rfind(": ") + 2));
  }

private:
  std::uint64_t GetPlace()
  {
    return this->Start + static_cast<std::uint64_t>(this->GetXMLByteIndex());
  }

  bool IsKept() const { return this->Texts.Layers <= 1; }
  bool IsIn(const std::string& element) const
  {
    return std::find(this->Path.begin(), this->Path.end(), element) != this->Path.end();
  }

  void Fail(const std::string& problem)
  {
    if (this->Problem.empty())
    {
      this->Problem = problem;
      this->ProblemOffset = this->GetPlace();
    }
  }

  void Take(const std::string& element)
  {
    if (element == "ScatteringData")
    {
      this->Block.Values.swap(this->Text);
      return;
    }
    const std::string text = Trim(this->Text);
    if (element == "WavelengthDataBlock")
    {
      ++this->Texts.NumberOfBlocks;
      if (IsWanted(this->Block, this->Wavelength))
      {
        this->Block.Wavelength = this->Wavelength;
        this->Texts.Blocks.push_back(std::move(this->Block));
      }
      this->Block = {};
    }
    else if (element == "Wavelength")
    {
      this->Wavelength = text;
    }
    else if (element == "WavelengthDataDirection")
    {
      this->Block.Direction = text;
    }
    else if (element == "ColumnAngleBasis")
    {
      this->Block.ColumnBasis = text;
    }
    else if (element == "RowAngleBasis")
    {
      this->Block.RowBasis = text;
    }
    else if (element == "IncidentDataStructure")
    {
      this->Texts.Structure = text;
    }
    else if (element == "Name" && this->IsIn("Material"))
    {
      this->Texts.Name = text;
    }
    else if (element == "Manufacturer")
    {
      this->Texts.Manufacturer = text;
    }
    else
    {
      this->TakeOfBasis(element, text);
    }
  }

  void TakeOfBasis(const std::string& element, const std::string& text)
  {
    if (this->Texts.Bases.empty())
    {
      return;
    }
    BsdfXmlBasis& basis = this->Texts.Bases.back();
    if (element == "AngleBasisName")
    {
      basis.Name = text;
    }
    if (basis.Rings.empty())
    {
      return;
    }
    if (element == "LowerTheta")
    {
      basis.Rings.back().Lower = text;
    }
    else if (element == "UpperTheta")
    {
      basis.Rings.back().Upper = text;
    }
    else if (element == "nPhis")
    {
      basis.Rings.back().Patches = text;
    }
  }

  std::vector<std::string> Path;
  std::string Text;
  std::string Wavelength;
  BsdfXmlBlock Block;
};

vtkStandardNewMacro(XmlParser);
}

bool IsSameWord(const std::string& a, const std::string& b)
{
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [lower](char x, char y) { return lower(x) == lower(y); });
}

std::string DescribeLine(std::string_view text, std::uint64_t offset)
{
  const std::string_view before =
    text.substr(0, static_cast<std::size_t>(std::min<std::uint64_t>(offset, text.size())));
  const std::size_t line = before.rfind('\n');
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
         ", column " +
         std::to_string(line == std::string_view::npos ? before.size() + 1 : before.size() - line);
}

BsdfXmlTexts ParseBsdfXml(const FileBytes& file)
{
  const ByteReader reader(file, BsdfXmlFormatName);
  // A document type may define texts that grow without bound.
  const std::size_t type = file.GetView().find("<!DOCTYPE");
  if (type != std::string_view::npos)
  {
    reader.FailAt(type, "document type", "found one, expected none");
  }
  const std::size_t zero = file.GetView().find('\0');
  if (zero != std::string_view::npos)
  {
    reader.FailAt(zero, "text", "found a zero byte, expected UTF-8");
  }
  if (file.GetSize() > std::numeric_limits<int>::max())
  {
    reader.FailAt(
      0, "file", "found " + std::to_string(file.GetSize()) + " bytes, expected 2 GB at most");
  }
  vtkNew<XmlParser> parser;
  const std::size_t start = FindXmlStart(file.GetView());
  parser->Start = start;
  const int parsed =
    parser->Parse(file.GetData() + start, static_cast<unsigned int>(file.GetSize() - start));
  if (!parser->Problem.empty() || !parsed)
  {
    const std::string problem = parser->Problem.empty() ? "no well-formed XML" : parser->Problem;
    // The parser names the place behind an ampersand that begins no entity.
    const std::size_t end =
      std::min(static_cast<std::size_t>(parser->ProblemOffset), file.GetSize());
    const std::size_t at = end > 0 && file.GetView().substr(end - 1, 1) == "&" ? end - 1 : end;
    const std::string_view there = file.GetView().substr(std::min(at, file.GetSize()), 24);
    reader.FailAt(at, "text, " + DescribeLine(file.GetView(), at),
      problem +
        (there.empty() ? ", at the end"
                       : ", found " + Quote(std::string(there.substr(0, there.find('\n'))))) +
        (there.substr(0, 1) == "&" ? ", expected '&amp;' for an ampersand" : ""));
  }
  if (start > 0)
  {
    const std::string_view chatter = file.GetView().substr(0, std::min<std::size_t>(start, 60));
    parser->Texts.Note = "The " + std::to_string(start) +
                         " bytes before the XML begins are left out" +
                         (chatter.find_first_not_of(" \t\r\n") == std::string_view::npos
                             ? "."
                             : ": " + Quote(Trim(std::string(chatter))) + ".");
  }
  return std::move(parser->Texts);
}
} // namespace measuredbrdf
