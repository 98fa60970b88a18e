// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BsdfXmlParser.h"

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
      this->Block.Offset = static_cast<std::uint64_t>(this->GetXMLByteIndex());
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

  void ReportXmlParseError() override { this->Fail("no well-formed XML"); }

private:
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
      this->ProblemOffset = static_cast<std::uint64_t>(this->GetXMLByteIndex());
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
  const int parsed = parser->Parse(file.GetData(), static_cast<unsigned int>(file.GetSize()));
  if (!parser->Problem.empty() || !parsed)
  {
    reader.FailAt(parser->ProblemOffset, "text",
      parser->Problem.empty() ? "no well-formed XML" : parser->Problem);
  }
  return std::move(parser->Texts);
}
} // namespace measuredbrdf
