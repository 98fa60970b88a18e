// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * BSDF XML files of WINDOW (Lawrence Berkeley National Laboratory) and Radiance: matrices over
 * angle bases (Klems 1994), and tensor trees (Ward et al. 2012). Reflection is read of one side,
 * transmission of both.
 */

#include "MaterialFormat.h"
#include "NumberText.h"
#include "ScopedErrorCapture.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkBTDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTensorTreeBRDF.h"
#include "vtkXMLParser.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr const char* BsdfXmlFormatName = "BSDF XML";

struct BsdfXmlRing
{
  std::string Lower; // degrees
  std::string Upper;
  std::string Patches;
};

struct BsdfXmlBasis
{
  std::string Name;
  std::vector<BsdfXmlRing> Rings;
};

/// A WavelengthDataBlock, with the wavelength around it.
struct BsdfXmlBlock
{
  std::string Wavelength;
  std::string Direction; // "Reflection Back"
  std::string ColumnBasis;
  std::string RowBasis;
  std::string Values;
  std::uint64_t Offset = 0; // of the values in the file
};

struct BsdfXmlTexts
{
  std::string Name;
  std::string Manufacturer;
  std::string Structure; // "Columns", "Rows", "TensorTree3", "TensorTree4"
  int Layers = 0;        // what is above is of the first
  std::vector<BsdfXmlBasis> Bases;
  std::vector<BsdfXmlBlock> Blocks; // of visible light
  int NumberOfBlocks = 0;           // of all
  std::string Note;                 // of what was left out before the XML
};

// Whether two words are the same but for upper and lower case, as Radiance compares them.
bool IsSameWord(const std::string& a, const std::string& b)
{
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [lower](char x, char y) { return lower(x) == lower(y); });
}

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
    const ScopedErrorCapture error(this);
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
    }
    else if (element == "WavelengthDataBlock")
    {
      ++this->Texts.NumberOfBlocks;
      if (IsWanted(this->Block, this->Wavelength))
      {
        this->Block.Wavelength = this->Wavelength;
        this->Texts.Blocks.push_back(std::move(this->Block));
      }
      this->Block = {};
    }
    else if (std::string* const text = this->FindText(element))
    {
      *text = Trim(this->Text);
    }
  }

  // Where an element's text belongs, or null.
  std::string* FindText(const std::string& element)
  {
    BsdfXmlBasis* const basis = this->Texts.Bases.empty() ? nullptr : &this->Texts.Bases.back();
    BsdfXmlRing* const ring = basis && !basis->Rings.empty() ? &basis->Rings.back() : nullptr;
    const std::pair<const char*, std::string*> places[] = { { "Wavelength", &this->Wavelength },
      { "WavelengthDataDirection", &this->Block.Direction },
      { "ColumnAngleBasis", &this->Block.ColumnBasis }, { "RowAngleBasis", &this->Block.RowBasis },
      { "IncidentDataStructure", &this->Texts.Structure },
      { "Name", this->IsIn("Material") ? &this->Texts.Name : nullptr },
      { "Manufacturer", &this->Texts.Manufacturer },
      { "AngleBasisName", basis ? &basis->Name : nullptr },
      { "LowerTheta", ring ? &ring->Lower : nullptr },
      { "UpperTheta", ring ? &ring->Upper : nullptr },
      { "nPhis", ring ? &ring->Patches : nullptr } };
    const auto* const found = std::find_if(std::begin(places), std::end(places),
      [&element](const auto& place) { return element == place.first; });
    return found == std::end(places) ? nullptr : found->second;
  }

  std::vector<std::string> Path;
  std::string Text;
  std::string Wavelength;
  BsdfXmlBlock Block;
};

vtkStandardNewMacro(XmlParser);

// "line 3, column 14", counted from 1 in bytes.
std::string DescribeLine(std::string_view text, std::uint64_t offset)
{
  const std::string_view before =
    text.substr(0, static_cast<std::size_t>(std::min<std::uint64_t>(offset, text.size())));
  const std::size_t line = before.rfind('\n');
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
         ", column " +
         std::to_string(line == std::string_view::npos ? before.size() + 1 : before.size() - line);
}

// Throws FileError where it is no well-formed XML, has a document type of its own, or is not a
// WindowElement.
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

constexpr std::size_t DeepestBrace = 32;

using Tree = vtkTensorTreeBRDF::Tree;

// What stands between a pair of braces, so far.
struct Group
{
  std::vector<int> Children;
  std::vector<float> Values;
};

// The power of two whose power of `dimensions` is count, or 0.
int FindSide(std::size_t count, int dimensions)
{
  for (int side = 1; side <= 1024; side *= 2)
  {
    if (static_cast<std::size_t>(std::llround(std::pow(side, dimensions))) == count)
    {
      return side;
    }
  }
  return 0;
}

// The group as the tree's last node.
void Close(const Group& group, Tree& tree)
{
  if (!group.Children.empty())
  {
    if (!group.Values.empty() || group.Children.size() != std::size_t(1) << tree.Dimensions)
    {
      throw std::runtime_error("a branch has " + std::to_string(group.Children.size()) +
                               " children and " + std::to_string(group.Values.size()) +
                               " values, expected " + std::to_string(1 << tree.Dimensions) +
                               " children");
    }
    tree.Nodes.push_back({ 0, static_cast<int>(tree.Children.size()) });
    tree.Children.insert(tree.Children.end(), group.Children.begin(), group.Children.end());
    return;
  }
  const int side = FindSide(group.Values.size(), tree.Dimensions);
  if (side == 0)
  {
    throw std::runtime_error("a leaf has " + std::to_string(group.Values.size()) +
                             " values, expected a power of two along each of " +
                             std::to_string(tree.Dimensions) + " axes");
  }
  tree.Nodes.push_back({ side, static_cast<int>(tree.Values.size()) });
  tree.Values.insert(tree.Values.end(), group.Values.begin(), group.Values.end());
}

// The next number or brace, off the front; empty at the end. White space and commas lie between.
std::string_view TakeBsdfWord(std::string_view& text)
{
  constexpr std::string_view between = " \t\r\n,";
  constexpr std::string_view end = " \t\r\n,{}";
  text.remove_prefix(std::min(text.find_first_not_of(between), text.size()));
  const bool brace = !text.empty() && (text.front() == '{' || text.front() == '}');
  const std::size_t length = brace ? 1 : std::min(text.find_first_of(end), text.size());
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

// A whole word as a finite number, whatever the locale; false for any other.
bool ToBsdfNumber(std::string_view word, double& number)
{
  return ParseNumber(word, number) && std::abs(number) < 1e30;
}

// The first two whole numbers with nothing but a comma between; "" if there are none.
std::string FindDecimalComma(std::string_view text)
{
  constexpr std::string_view digits = "0123456789";
  const auto isDigit = [&](std::size_t at)
  { return at < text.size() && digits.find(text[at]) != std::string_view::npos; };
  for (std::size_t at = text.find(','); at != std::string_view::npos; at = text.find(',', at + 1))
  {
    if (at > 0 && isDigit(at - 1) && isDigit(at + 1))
    {
      const std::size_t before = text.find_last_not_of(digits, at - 1);
      const std::size_t first = before == std::string_view::npos ? 0 : before + 1;
      const std::size_t last = std::min(text.find_first_not_of(digits, at + 1), text.size());
      const bool hasPoint = (first > 0 && text[first - 1] == '.') ||
                            (last < text.size() && (text[last] == '.' || text[last] == ','));
      if (!hasPoint)
      {
        return std::string(text.substr(first, std::min<std::size_t>(last - first, 40)));
      }
    }
  }
  return "";
}

// A tree from nested braces. Throws std::runtime_error that says what is wrong with it.
Tree ParseBsdfTree(std::string_view text, int dimensions)
{
  Tree tree;
  tree.Dimensions = dimensions;
  std::vector<Group> open;
  bool closed = false;
  for (std::string_view word = TakeBsdfWord(text); !word.empty(); word = TakeBsdfWord(text))
  {
    if (closed)
    {
      throw std::runtime_error("more follows the tree");
    }
    if (word == "{")
    {
      if (open.size() == DeepestBrace)
      {
        throw std::runtime_error("braces are nested too deeply");
      }
      open.emplace_back();
      continue;
    }
    double number = 0.0;
    if (open.empty() || (word != "}" && !ToBsdfNumber(word, number)))
    {
      throw std::runtime_error(
        "found '" + std::string(word.substr(0, 40)) + "', expected a brace or a number in braces");
    }
    if (word != "}")
    {
      open.back().Values.push_back(static_cast<float>(number));
      continue;
    }
    Close(open.back(), tree);
    open.pop_back();
    closed = open.empty();
    if (!closed)
    {
      open.back().Children.push_back(static_cast<int>(tree.Nodes.size()) - 1);
    }
  }
  if (!closed)
  {
    throw std::runtime_error("found " + std::to_string(open.size()) + " braces open at the end");
  }
  return tree;
}

using Basis = vtkAngleBasisBRDF::Basis;

constexpr double AngleTolerance = 1e-3; // degrees

// The sides as Radiance calls them, and as the files do, which look from the other side. And what
// Radiance takes for light on the side: it evaluates with the view as the direction of incidence.
struct Side
{
  const char* Name;
  const char* Direction;
  const char* Transmission;
};
constexpr Side Sides[] = { { "front", "Reflection Back", "Transmission Front" },
  { "back", "Reflection Front", "Transmission Back" } };

struct Source
{
  ByteReader Reader;
  BsdfXmlTexts Texts;

  [[noreturn]] void Fail(const std::string& field, const std::string& what) const
  {
    this->Reader.FailAt(0, field, what);
  }

  /// Of a block's values; commas separate these, but some programs write them into numbers.
  [[noreturn]] void FailIn(
    const BsdfXmlBlock& block, const std::string& field, const std::string& what) const
  {
    const std::string comma = FindDecimalComma(block.Values);
    this->Reader.FailAt(block.Offset,
      field + ", " + DescribeLine(this->Reader.GetFile().GetView(), block.Offset),
      what + (comma.empty() ? ""
                            : "; are decimal commas written, as in " + Quote(comma) +
                                "? Numbers have a decimal point"));
  }
};

double ToNumber(const Source& source, const std::string& field, const std::string& text)
{
  double number = 0.0;
  if (!ToBsdfNumber(text, number))
  {
    source.Fail(field, "found " + Quote(text) + ", expected a number");
  }
  return number;
}

Basis MakeBasis(const Source& source, const std::string& name)
{
  const auto found = std::find_if(source.Texts.Bases.begin(), source.Texts.Bases.end(),
    [&name](const BsdfXmlBasis& basis) { return basis.Name == name; });
  if (found == source.Texts.Bases.end() || found->Rings.empty())
  {
    source.Fail("AngleBasis", "the file does not define " + Quote(name));
  }
  Basis basis;
  double lower = 0.0;
  for (const BsdfXmlRing& ring : found->Rings)
  {
    const std::string field = "ring " + std::to_string(basis.Patches.size()) + " of " + Quote(name);
    if (std::abs(ToNumber(source, field + ", LowerTheta", ring.Lower) - lower) > AngleTolerance)
    {
      source.Fail(
        field, "LowerTheta is " + Quote(ring.Lower) + ", expected where the ring before it ends");
    }
    lower = ToNumber(source, field + ", UpperTheta", ring.Upper);
    const double patches = ToNumber(source, field + ", nPhis", ring.Patches);
    if (!(patches >= 1.0) || patches > vtkAngleBasisBRDF::MaximumPatches ||
        patches != std::floor(patches))
    {
      source.Fail(field, "nPhis is " + Quote(ring.Patches) + ", expected a whole number from 1");
    }
    basis.UpperTheta.push_back(static_cast<float>(lower));
    basis.Patches.push_back(static_cast<int>(patches));
    if (basis.GetNumberOfPatches() > vtkAngleBasisBRDF::MaximumPatches)
    {
      source.Fail("AngleBasis " + Quote(name),
        "expected at most " + std::to_string(int(vtkAngleBasisBRDF::MaximumPatches)) + " patches");
    }
  }
  return basis;
}

// Exactly so many; a word that is no number is named.
std::vector<float> ReadValues(const Source& source, const BsdfXmlBlock& block, std::size_t expected)
{
  const std::string field = "ScatteringData of " + Quote(block.Direction);
  std::vector<float> values;
  std::string_view rest = block.Values;
  for (std::string_view word = TakeBsdfWord(rest); !word.empty(); word = TakeBsdfWord(rest))
  {
    double number = 0.0;
    if (!ToBsdfNumber(word, number))
    {
      source.FailIn(block, field,
        "value " + std::to_string(values.size()) + ": found " + Quote(std::string(word)) +
          ", expected a number");
    }
    if (values.size() == expected)
    {
      source.FailIn(
        block, field, "found more than the " + std::to_string(expected) + " values expected");
    }
    values.push_back(static_cast<float>(number));
  }
  if (values.size() != expected)
  {
    source.FailIn(block, field,
      "found " + std::to_string(values.size()) + " values, expected " + std::to_string(expected));
  }
  return values;
}

const BsdfXmlBlock* FindBlock(
  const BsdfXmlTexts& texts, const std::string& direction, const std::string& wavelength)
{
  const auto found = std::find_if(texts.Blocks.begin(), texts.Blocks.end(),
    [&](const BsdfXmlBlock& block)
    { return IsSameWord(block.Direction, direction) && IsSameWord(block.Wavelength, wavelength); });
  return found == texts.Blocks.end() ? nullptr : &*found;
}

std::vector<std::string> ListSides(const BsdfXmlTexts& texts)
{
  std::vector<std::string> names;
  for (const Side& side : Sides)
  {
    if (FindBlock(texts, side.Direction, "Visible"))
    {
      names.emplace_back(side.Name);
    }
  }
  return names;
}

// The sides without reflection are sides of a transmission.
const Side& ChooseSide(const Source& source, const std::string& material)
{
  std::vector<std::string> names = ListSides(source.Texts);
  if (names.empty() && source.Texts.Blocks.empty())
  {
    source.Fail("WavelengthDataDirection", "found " + std::to_string(source.Texts.NumberOfBlocks) +
                                             " blocks, none of them of visible light");
  }
  if (names.empty())
  {
    names = { Sides[0].Name, Sides[1].Name };
  }
  const std::string& wanted = material.empty() ? names.front() : material;
  if (std::find(names.begin(), names.end(), wanted) == names.end())
  {
    source.Fail("material", "there is no reflection of " + Quote("#" + wanted) + ", only of " +
                              Quote("#" + names.front()) +
                              (names.size() > 1 ? " and " + Quote("#" + names[1]) : ""));
  }
  return wanted == Sides[0].Name ? Sides[0] : Sides[1];
}

// In the order of the material's matrix: a row for each patch of the light.
std::vector<float> ReadMatrix(
  const Source& source, const BsdfXmlBlock& block, std::size_t rows, std::size_t columns)
{
  std::vector<float> values = ReadValues(source, block, rows * columns);
  if (IsSameWord(source.Texts.Structure, "Rows"))
  {
    std::vector<float> turned(values.size());
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      turned[k] = values[k % columns * rows + k / columns];
    }
    values.swap(turned);
  }
  return values;
}

// CIE XYZ to linear sRGB (IEC 61966-2-1). X = Y = Z is gray, as in Radiance: equal energy, adapted
// to D65 (Bradford; Lam 1985).
std::array<float, 3> ToRGB(double x, double y, double z)
{
  return { static_cast<float>(3.1462519 * x - 1.6661246 * y - 0.4801273 * z),
    static_cast<float>(-0.9955355 * x + 1.9557639 * y + 0.0397716 * z),
    static_cast<float>(0.0635979 * x - 0.2145965 * y + 1.1509987 * z) };
}

// Values as they are in the file.
struct Scattering
{
  vtkSmartPointer<vtkBRDF> BRDF; // of transmission: folded
  vtkIdType Negative = 0;
  bool HasColor = false;
};

Scattering ReadBases(const Source& source, const BsdfXmlBlock& visible)
{
  const Basis light = MakeBasis(source, visible.RowBasis);
  const Basis view = MakeBasis(source, visible.ColumnBasis);
  const std::size_t rows = static_cast<std::size_t>(light.GetNumberOfPatches());
  const std::size_t columns = static_cast<std::size_t>(view.GetNumberOfPatches());
  const std::vector<float> y = ReadMatrix(source, visible, rows, columns);
  const BsdfXmlBlock* red = FindBlock(source.Texts, visible.Direction, "CIE-X");
  const BsdfXmlBlock* blue = FindBlock(source.Texts, visible.Direction, "CIE-Z");
  Scattering result;
  result.HasColor = red && blue;
  std::vector<float> rgb;
  if (result.HasColor)
  {
    const std::vector<float> x = ReadMatrix(source, *red, rows, columns);
    const std::vector<float> z = ReadMatrix(source, *blue, rows, columns);
    for (std::size_t k = 0; k < y.size(); ++k)
    {
      const std::array<float, 3> color = ToRGB(x[k], y[k], z[k]);
      rgb.insert(rgb.end(), color.begin(), color.end());
    }
  }
  else
  {
    for (const float value : y)
    {
      rgb.insert(rgb.end(), 3, value);
    }
  }
  const std::vector<float>& counted = result.HasColor ? rgb : y;
  result.Negative =
    std::count_if(counted.begin(), counted.end(), [](float value) { return value < 0.0f; });
  auto brdf = vtkSmartPointer<vtkAngleBasisBRDF>::New();
  const std::string problem = brdf->SetMatrix(light, view, std::move(rgb));
  if (!problem.empty())
  {
    source.Fail("AngleBasis", problem);
  }
  result.BRDF = brdf;
  return result;
}

Scattering ReadTree(const Source& source, const BsdfXmlBlock& visible)
{
  Scattering result;
  const std::string field = "ScatteringData of " + Quote(visible.Direction);
  auto brdf = vtkSmartPointer<vtkTensorTreeBRDF>::New();
  std::string problem;
  try
  {
    const auto tree =
      ParseBsdfTree(visible.Values, IsSameWord(source.Texts.Structure, "TensorTree3") ? 3 : 4);
    result.Negative = std::count_if(
      tree.Values.begin(), tree.Values.end(), [](float value) { return value < 0.0f; });
    problem = brdf->SetTree(tree);
  }
  catch (const std::runtime_error& e)
  {
    problem = e.what();
  }
  if (!problem.empty())
  {
    source.FailIn(visible, field, problem);
  }
  result.BRDF = brdf;
  return result;
}

bool IsTree(const BsdfXmlTexts& texts)
{
  return IsSameWord(texts.Structure, "TensorTree3") || IsSameWord(texts.Structure, "TensorTree4");
}

Scattering ReadBlock(const Source& source, const BsdfXmlBlock& visible)
{
  return IsTree(source.Texts) ? ReadTree(source, visible) : ReadBases(source, visible);
}

void ReadReflection(const Source& source, const Side& side, MaterialFile& result)
{
  const BsdfXmlBlock* visible = FindBlock(source.Texts, side.Direction, "Visible");
  if (!visible)
  {
    return;
  }
  const Scattering read = ReadBlock(source, *visible);
  result.BRDF = read.BRDF;
  result.NumberOfNegativeValues = read.Negative;
  if (!read.HasColor)
  {
    result.AddNote(IsTree(source.Texts)
                     ? "Values are of visible light; a tree's colors are not read."
                     : "The file holds no color: values are of visible light.");
  }
  result.AddNote("The side that Radiance calls " + std::string(side.Name) + ", in the file '" +
                 side.Direction + "'.");
}

// In the frame of the side.
void ReadTransmission(const Source& source, const Side& side, MaterialFile& result)
{
  for (const Side& lit : Sides)
  {
    const BsdfXmlBlock* visible = FindBlock(source.Texts, lit.Transmission, "Visible");
    if (!visible)
    {
      continue;
    }
    const Scattering read = ReadBlock(source, *visible);
    if (!result.Transmission)
    {
      result.Transmission = vtkSmartPointer<vtkBTDF>::New();
    }
    result.Transmission->SetFolded(&lit == &side ? vtkBTDF::FRONT : vtkBTDF::BACK, read.BRDF);
    if (read.Negative > 0)
    {
      result.AddNote("Negative values of " + Quote(visible->Direction) +
                     ", which count as 0: " + std::to_string(read.Negative) + ".");
    }
  }
  if (result.Transmission)
  {
    result.AddNote("Transmission is read, too. Pictures show reflection only.");
  }
}

// material: "front" or "back", as Radiance calls the sides (the file says the opposite); empty:
// front, or the side that the file has. A file of transmission only gives no BRDF.
MaterialFile ReadBsdfXml(const FileBytes& file, const std::string& material)
{
  const Source source{ ByteReader(file, BsdfXmlFormatName), ParseBsdfXml(file) };
  const BsdfXmlTexts& texts = source.Texts;
  const std::string& structure = texts.Structure;
  if (!IsTree(texts) && !IsSameWord(structure, "Columns") && !IsSameWord(structure, "Rows"))
  {
    source.Fail("IncidentDataStructure",
      "found " + Quote(structure) + ", expected 'Columns', 'Rows', 'TensorTree3' or 'TensorTree4'");
  }
  const Side& side = ChooseSide(source, material);
  MaterialFile result;
  ReadReflection(source, side, result);
  ReadTransmission(source, side, result);
  if (!texts.Note.empty())
  {
    result.AddNote(texts.Note);
  }
  if (texts.Layers > 1)
  {
    result.AddNote("The first of " + std::to_string(texts.Layers) + " layers.");
  }
  if (!result.BRDF && !result.Transmission)
  {
    source.Fail("Wavelength", "found no block of 'Visible'");
  }
  if (!result.BRDF)
  {
    return result; // the reader says so
  }
  const bool named = !texts.Name.empty() && texts.Name != "Name"; // genBSDF's own
  result.BRDF->SetName(named ? texts.Name : GetFileStem(file.GetPath()));
  result.BRDF->SetSource("BSDF XML file " + GetFileTitle(file.GetPath()));
  return result;
}
}

const MaterialFormat BsdfXmlFormat = { BsdfXmlFormatName,
  "Radiance and WINDOW BSDF .xml (FILE.xml#front or #back)", ".xml",
  [](const vtkBRDFFormat::File& file)
  { return file.Bytes.substr(0, 4096).find("<WindowElement") != std::string_view::npos; },
  ReadBsdfXml, [](const FileBytes& file) { return ListSides(ParseBsdfXml(file)); } };
} // namespace measuredbrdf
