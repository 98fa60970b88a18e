// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * BSDF XML files of WINDOW (Lawrence Berkeley National Laboratory) and Radiance: matrices over
 * angle bases (Klems 1994), and tensor trees (Ward et al. 2012). Reflection is read of one side,
 * transmission of both.
 */

#include "MaterialFormat.h"
#include "ScopedErrorCapture.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkBTDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTensorTreeBRDF.h"
#include "vtkXMLParser.h"

#include <vtksys/SystemTools.hxx>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr const char* BsdfXmlFormatName = "BSDF XML";
constexpr std::size_t DeepestElement = 64;
constexpr std::size_t MostElements = 1000000;
constexpr std::size_t DeepestBrace = 32;
constexpr double AngleTolerance = 1e-3; // degrees
constexpr std::string_view White = " \t\r\n";

// Radiance compares words without regard to upper and lower case.
bool IsSameWord(const std::string& a, const std::string& b)
{
  return vtksys::SystemTools::LowerCase(a) == vtksys::SystemTools::LowerCase(b);
}

std::string Trim(std::string_view text)
{
  const std::size_t first = std::min(text.find_first_not_of(White), text.size());
  return std::string(text.substr(first, text.find_last_not_of(White) + 1 - first));
}

//------------------------------------------------------------------------------
// Of a list of all elements in the order in which they begin.
struct Element
{
  std::string Name;
  std::string Text;
  std::uint64_t Offset = 0; // in the file
  std::size_t Size = 0;     // how many elements are in it, at any depth: they follow it

  /// All elements of that name in this one.
  std::vector<const Element*> FindAll(const std::string& name) const
  {
    std::vector<const Element*> found;
    for (const Element* element = this + 1; element <= this + this->Size; ++element)
    {
      if (element->Name == name)
      {
        found.push_back(element);
      }
    }
    return found;
  }

  /// The first one's text; "" where there is none.
  std::string GetText(const std::string& name) const
  {
    const std::vector<const Element*> found = this->FindAll(name);
    return found.empty() ? "" : Trim(found.front()->Text);
  }
};

// Makes the list. The first problem counts; after it nothing is kept.
class XmlParser : public vtkXMLParser
{
public:
  static XmlParser* New();
  vtkTypeMacro(XmlParser, vtkXMLParser);

  std::vector<Element> Elements;
  std::string Problem;
  std::uint64_t ProblemOffset = 0;
  std::uint64_t Start = 0; // of the XML in the file

protected:
  void StartElement(const char* name, const char**) override
  {
    if (this->Open.size() >= DeepestElement) // a search in each element would take for ever
    {
      this->Fail("elements are nested too deeply");
    }
    if (this->Elements.size() >= MostElements)
    {
      this->Fail("found more than " + std::to_string(MostElements) + " elements");
    }
    if (this->Elements.empty() && std::string(name) != "WindowElement")
    {
      this->Fail("the root is " + Quote(name) + ", expected 'WindowElement'");
    }
    if (this->Problem.empty())
    {
      this->Open.push_back(this->Elements.size());
      this->Elements.push_back({ name, "", this->GetPlace(), 0 });
    }
  }

  void CharacterDataHandler(const char* data, int length) override
  {
    if (this->Problem.empty() && !this->Open.empty())
    {
      this->Elements[this->Open.back()].Text.append(data, static_cast<std::size_t>(length));
    }
  }

  void EndElement(const char*) override
  {
    if (this->Problem.empty() && !this->Open.empty())
    {
      this->Elements[this->Open.back()].Size = this->Elements.size() - 1 - this->Open.back();
      this->Open.pop_back();
    }
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

  // No exception may pass through the parser, which is written in C.
  void Fail(const std::string& problem)
  {
    if (this->Problem.empty())
    {
      this->Problem = problem;
      this->ProblemOffset = this->GetPlace();
    }
  }

  std::vector<std::size_t> Open; // places in the list
};

vtkStandardNewMacro(XmlParser);

// "line 3, column 14", counted from 1 in bytes.
std::string DescribeLine(std::string_view text, std::uint64_t offset)
{
  const std::string_view before =
    text.substr(0, static_cast<std::size_t>(std::min<std::uint64_t>(offset, text.size())));
  const std::size_t line = before.rfind('\n') + 1; // npos + 1 is 0
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
         ", column " + std::to_string(before.size() - line + 1);
}

// Where the XML begins: programs such as Radiance's genBSDF may leave lines of their own before it.
std::size_t FindXmlStart(std::string_view text)
{
  const std::size_t start = std::min(text.find("<?xml"), text.find("<WindowElement"));
  const std::string_view before = text.substr(0, std::min(start, text.size()));
  const std::size_t first = before.find_first_not_of(White);
  const bool isXml = start == std::string_view::npos || before == "\xef\xbb\xbf" ||
                     (first != std::string_view::npos && before[first] == '<');
  return isXml ? 0 : start;
}

// Throws FileError where it is no well-formed XML, has a document type of its own, or is not a
// WindowElement.
std::vector<Element> ParseBsdfXml(const ByteReader& reader)
{
  const std::string_view bytes = reader.GetFile().GetView();
  // A document type may define texts that grow without bound.
  const std::size_t type = bytes.find("<!DOCTYPE");
  const std::size_t zero = bytes.find('\0');
  if (type != std::string_view::npos)
  {
    reader.FailAt(type, "document type", "found one, expected none");
  }
  if (zero != std::string_view::npos)
  {
    reader.FailAt(zero, "text", "found a zero byte, expected UTF-8");
  }
  reader.Require(bytes.size() <= std::numeric_limits<int>::max(), "file", "found ", bytes.size(),
    " bytes, expected 2 GB at most");
  vtkNew<XmlParser> parser;
  const std::size_t start = FindXmlStart(bytes);
  parser->Start = start;
  const int parsed =
    parser->Parse(bytes.data() + start, static_cast<unsigned int>(bytes.size() - start));
  if (!parser->Problem.empty() || !parsed)
  {
    std::size_t at = std::min(static_cast<std::size_t>(parser->ProblemOffset), bytes.size());
    // The parser names the place behind an ampersand that begins no entity.
    const bool isAmpersand = at > 0 && bytes[at - 1] == '&';
    at -= isAmpersand ? 1 : 0;
    const std::string_view there = bytes.substr(at, 24);
    reader.FailAt(at, "text, " + DescribeLine(bytes, at),
      parser->Problem.empty() ? "no well-formed XML" : parser->Problem,
      there.empty() ? ", at the end" : ", found " + Quote(there.substr(0, there.find('\n'))),
      isAmpersand ? ", expected '&amp;' for an ampersand" : "");
  }
  return std::move(parser->Elements);
}

//------------------------------------------------------------------------------
// The next number or brace, off the front; empty at the end. White space and commas lie between.
std::string_view TakeWord(std::string_view& text)
{
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n,"), text.size()));
  const bool brace = !text.empty() && (text.front() == '{' || text.front() == '}');
  const std::size_t length = brace ? 1 : std::min(text.find_first_of(" \t\r\n,{}"), text.size());
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

// A whole word as a finite number, whatever the locale; false for any other.
bool ToNumber(std::string_view word, double& number)
{
  return ParseNumber(word, number) && std::abs(number) < 1e30;
}

//------------------------------------------------------------------------------
using Tree = vtkTensorTreeBRDF::Tree;

// What stands between a pair of braces, so far.
struct Group
{
  std::vector<int> Children;
  std::vector<float> Values;
};

// The group as the tree's last node.
void Close(const Group& group, Tree& tree)
{
  const std::size_t children = group.Children.size();
  const std::size_t values = group.Values.size();
  if (children > 0)
  {
    Require(values == 0 && children == std::size_t(1) << tree.Dimensions, "a branch has ", children,
      " children and ", values, " values, expected ", 1 << tree.Dimensions, " children");
    tree.Nodes.push_back({ 0, static_cast<int>(tree.Children.size()) });
    tree.Children.insert(tree.Children.end(), group.Children.begin(), group.Children.end());
    return;
  }
  int bits = 0; // along each axis
  while (values > std::size_t(1) << (bits * tree.Dimensions))
  {
    ++bits;
  }
  Require(values == std::size_t(1) << (bits * tree.Dimensions), "a leaf has ", values,
    " values, expected a power of two along each of ", tree.Dimensions, " axes");
  tree.Nodes.push_back({ 1 << bits, static_cast<int>(tree.Values.size()) });
  tree.Values.insert(tree.Values.end(), group.Values.begin(), group.Values.end());
}

// A tree from nested braces. Throws FileError that says what is wrong with it.
Tree ParseBsdfTree(std::string_view text, int dimensions)
{
  Tree tree;
  tree.Dimensions = dimensions;
  std::vector<Group> open;
  bool closed = false;
  for (std::string_view word = TakeWord(text); !word.empty(); word = TakeWord(text))
  {
    double number = 0.0;
    Require(!closed, "more follows the tree");
    if (word == "{")
    {
      Require(open.size() < DeepestBrace, "braces are nested too deeply");
      open.emplace_back();
    }
    else if (open.empty() || (word != "}" && !ToNumber(word, number)))
    {
      throw FileError("found ", Quote(word), ", expected a brace or a number in braces");
    }
    else if (word != "}")
    {
      open.back().Values.push_back(static_cast<float>(number));
    }
    else
    {
      Close(open.back(), tree);
      open.pop_back();
      closed = open.empty();
      if (!closed)
      {
        open.back().Children.push_back(static_cast<int>(tree.Nodes.size()) - 1);
      }
    }
  }
  Require(closed, "found ", open.size(), " braces open at the end");
  return tree;
}

//------------------------------------------------------------------------------
// The sides as Radiance calls them, and as the files do, which look from the other side. And what
// Radiance takes for light on the side: it evaluates with the view as the direction of incidence.
struct BsdfSide
{
  const char* Name;
  const char* Direction;
  const char* Transmission;
};
constexpr BsdfSide Sides[] = { { "front", "Reflection Back", "Transmission Front" },
  { "back", "Reflection Front", "Transmission Back" } };

// A WavelengthDataBlock, with the wavelength around it.
struct BsdfBlock
{
  std::string Wavelength;
  std::string Direction; // "Reflection Back"
  std::string ColumnBasis;
  std::string RowBasis;
  std::string_view Values;
  std::uint64_t Offset; // of the values in the file

  std::string GetField() const { return "ScatteringData of " + Quote(this->Direction); }
};

// Values as they are in the file.
struct Scattering
{
  vtkSmartPointer<vtkBRDF> BRDF; // of transmission: folded
  vtkIdType Negative = 0;
  bool HasColor = false;
};

// CIE XYZ to linear sRGB (IEC 61966-2-1), a row for each channel. X = Y = Z is gray, as in
// Radiance: equal energy, adapted to D65 (Bradford; Lam 1985).
const glm::dmat3 EqualEnergyToRGB = glm::transpose(glm::dmat3(3.1462519, -1.6661246, -0.4801273,
  -0.9955355, 1.9557639, 0.0397716, 0.0635979, -0.2145965, 1.1509987));

vtkIdType CountNegative(const std::vector<float>& values)
{
  return std::count_if(values.begin(), values.end(), [](float value) { return value < 0.0f; });
}

//------------------------------------------------------------------------------
class BsdfXmlFile
{
public:
  explicit BsdfXmlFile(const FileBytes& file)
    : Reader(file, BsdfXmlFormatName)
    , Elements(ParseBsdfXml(this->Reader))
    , Layers(this->Elements.front().FindAll("Layer"))
    , Layer(this->Layers.empty() ? this->Elements.front() : *this->Layers.front())
    , Structure(this->Layer.GetText("IncidentDataStructure"))
    , TreeAxes(IsSameWord(this->Structure, "TensorTree3")   ? 3
               : IsSameWord(this->Structure, "TensorTree4") ? 4
                                                            : 0)
  {
    for (const Element* data : this->Layer.FindAll("WavelengthData"))
    {
      for (const Element* block : data->FindAll("WavelengthDataBlock"))
      {
        const std::vector<const Element*> values = block->FindAll("ScatteringData");
        this->Blocks.push_back(
          { data->GetText("Wavelength"), block->GetText("WavelengthDataDirection"),
            block->GetText("ColumnAngleBasis"), block->GetText("RowAngleBasis"),
            values.empty() ? std::string_view() : std::string_view(values.front()->Text),
            values.empty() ? block->Offset : values.front()->Offset });
      }
    }
  }

  // Sides whose reflection of visible light the file has.
  std::vector<std::string> ListSides() const
  {
    std::vector<std::string> names;
    for (const BsdfSide& side : Sides)
    {
      if (this->FindBlock(side.Direction, "Visible"))
      {
        names.emplace_back(side.Name);
      }
    }
    return names;
  }

  // material: "front" or "back", as Radiance calls the sides (the file says the opposite); empty:
  // front, or the side that the file has. A file of transmission only gives no BRDF.
  MaterialFile Read(const std::string& material) const
  {
    this->Reader.Require(this->TreeAxes > 0 || IsSameWord(this->Structure, "Columns") ||
                           IsSameWord(this->Structure, "Rows"),
      "IncidentDataStructure", "found ", Quote(this->Structure),
      ", expected 'Columns', 'Rows', 'TensorTree3' or 'TensorTree4'");
    const BsdfSide& side = this->ChooseSide(material);
    MaterialFile result;
    this->ReadReflection(side, result);
    this->ReadTransmission(side, result);
    const std::string_view bytes = this->Reader.GetFile().GetView();
    const std::size_t start = FindXmlStart(bytes);
    if (start > 0)
    {
      const std::string chatter = Trim(bytes.substr(0, std::min<std::size_t>(start, 60)));
      result.AddNote(Concat("The ", start, " bytes before the XML begins are left out",
        chatter.empty() ? "." : ": " + Quote(chatter) + "."));
    }
    if (this->Layers.size() > 1)
    {
      result.AddNote(Concat("The first of ", this->Layers.size(), " layers."));
    }
    if (result.BRDF)
    {
      NameAfterFile(result, this->Reader.GetFile(), "BSDF XML");
      const std::vector<const Element*> materials = this->Layer.FindAll("Material");
      const std::string name = materials.empty() ? "" : materials.front()->GetText("Name");
      if (!name.empty() && name != "Name") // genBSDF's own
      {
        result.BRDF->SetName(name);
      }
    }
    return result; // without BRDF, the reader says so
  }

private:
  template <typename... Pieces>
  void RequireIn(const BsdfBlock& block, bool condition, const Pieces&... what) const
  {
    if (!condition)
    {
      // Commas separate the values; what reads like two may have been one with a decimal comma.
      const bool isWhole = block.Values.find('.') == std::string_view::npos;
      this->Reader.FailAt(block.Offset,
        block.GetField() + ", " + DescribeLine(this->Reader.GetFile().GetView(), block.Offset),
        what...,
        isWhole && block.Values.find(',') < block.Values.size()
          ? "; are decimal commas written? Numbers have a decimal point"
          : "");
    }
  }

  const BsdfBlock* FindBlock(const std::string& direction, const std::string& wavelength) const
  {
    const auto found = std::find_if(this->Blocks.begin(), this->Blocks.end(),
      [&](const BsdfBlock& block) {
        return IsSameWord(block.Direction, direction) && IsSameWord(block.Wavelength, wavelength);
      });
    return found == this->Blocks.end() ? nullptr : &*found;
  }

  // The sides without reflection are sides of a transmission.
  const BsdfSide& ChooseSide(const std::string& material) const
  {
    std::vector<std::string> names = this->ListSides();
    this->Reader.Require(!names.empty() || this->FindBlock(Sides[0].Transmission, "Visible") ||
                           this->FindBlock(Sides[1].Transmission, "Visible"),
      "WavelengthDataDirection", "found ", this->Blocks.size(),
      " blocks, none of them of visible light");
    if (names.empty())
    {
      names = { Sides[0].Name, Sides[1].Name };
    }
    const std::string& wanted = material.empty() ? names.front() : material;
    this->Reader.Require(std::find(names.begin(), names.end(), wanted) != names.end(), "material",
      "there is no reflection of ", Quote("#" + wanted), ", only of ", Quote("#" + names.front()),
      names.size() > 1 ? " and " + Quote("#" + names[1]) : std::string());
    return wanted == Sides[0].Name ? Sides[0] : Sides[1];
  }

  vtkAngleBasisBRDF::Basis MakeBasis(const std::string& name) const
  {
    std::vector<const Element*> rings;
    for (const Element* basis : this->Layer.FindAll("AngleBasis"))
    {
      if (rings.empty() && basis->GetText("AngleBasisName") == name)
      {
        rings = basis->FindAll("AngleBasisBlock");
      }
    }
    this->Reader.Require(!rings.empty(), "AngleBasis", "the file does not define ", Quote(name));
    vtkAngleBasisBRDF::Basis basis;
    constexpr int most = vtkAngleBasisBRDF::MaximumPatches;
    int sum = 0;
    double lower = 0.0;
    for (const Element* ring : rings)
    {
      const std::string field = Concat("ring ", basis.Patches.size(), " of ", Quote(name));
      const auto get = [&](const char* element)
      {
        double number = 0.0;
        const std::string text = ring->GetText(element);
        this->Reader.Require(ToNumber(text, number), field + ", " + element, "found ", Quote(text),
          ", expected a number");
        return number;
      };
      const double begin = get("LowerTheta");
      this->Reader.Require(std::abs(begin - lower) <= AngleTolerance, field, "LowerTheta is ",
        begin, ", expected where the ring before it ends");
      lower = get("UpperTheta");
      const double patches = get("nPhis");
      this->Reader.Require(patches >= 1.0 && patches <= most && patches == std::floor(patches),
        field, "nPhis is ", patches, ", expected a whole number from 1");
      basis.UpperTheta.push_back(static_cast<float>(lower));
      basis.Patches.push_back(static_cast<int>(patches));
      sum += basis.Patches.back();
      this->Reader.Require(
        sum <= most, "AngleBasis " + Quote(name), "expected at most ", most, " patches");
    }
    return basis;
  }

  // In the order of the material's matrix: a row for each patch of the light.
  std::vector<float> ReadMatrix(const BsdfBlock& block, std::size_t rows, std::size_t columns) const
  {
    const std::size_t expected = rows * columns;
    std::vector<float> values;
    std::string_view rest = block.Values;
    for (std::string_view word = TakeWord(rest); !word.empty(); word = TakeWord(rest))
    {
      double number = 0.0;
      if (!ToNumber(word, number))
      {
        this->RequireIn(
          block, false, "value ", values.size(), ": found ", Quote(word), ", expected a number");
      }
      this->RequireIn(
        block, values.size() < expected, "found more than the ", expected, " values expected");
      values.push_back(static_cast<float>(number));
    }
    this->RequireIn(
      block, values.size() == expected, "found ", values.size(), " values, expected ", expected);
    if (IsSameWord(this->Structure, "Rows"))
    {
      std::vector<float> turned;
      for (std::size_t k = 0; k < expected; ++k)
      {
        turned.push_back(values[k % columns * rows + k / columns]);
      }
      values.swap(turned);
    }
    return values;
  }

  Scattering ReadBases(const BsdfBlock& visible) const
  {
    const auto light = this->MakeBasis(visible.RowBasis);
    const auto view = this->MakeBasis(visible.ColumnBasis);
    const auto read = [&](const BsdfBlock& block)
    {
      return this->ReadMatrix(block, static_cast<std::size_t>(light.GetNumberOfPatches()),
        static_cast<std::size_t>(view.GetNumberOfPatches()));
    };
    const std::vector<float> y = read(visible);
    const BsdfBlock* red = this->FindBlock(visible.Direction, "CIE-X");
    const BsdfBlock* blue = this->FindBlock(visible.Direction, "CIE-Z");
    Scattering result;
    result.HasColor = red && blue;
    const std::vector<float> x = result.HasColor ? read(*red) : y;
    const std::vector<float> z = result.HasColor ? read(*blue) : y;
    std::vector<float> rgb;
    for (std::size_t k = 0; k < y.size(); ++k)
    {
      const glm::vec3 color = result.HasColor
                                ? glm::vec3(EqualEnergyToRGB * glm::dvec3(x[k], y[k], z[k]))
                                : glm::vec3(y[k]);
      rgb.insert(rgb.end(), &color.x, &color.x + 3);
    }
    result.Negative = CountNegative(result.HasColor ? rgb : y);
    auto brdf = vtkSmartPointer<vtkAngleBasisBRDF>::New();
    const std::string problem = brdf->SetMatrix(light, view, std::move(rgb));
    this->Reader.Require(problem.empty(), "AngleBasis", problem);
    result.BRDF = brdf;
    return result;
  }

  Scattering ReadTree(const BsdfBlock& visible) const
  {
    Scattering result;
    auto brdf = vtkSmartPointer<vtkTensorTreeBRDF>::New();
    std::string problem;
    try
    {
      const Tree tree = ParseBsdfTree(visible.Values, this->TreeAxes);
      result.Negative = CountNegative(tree.Values);
      problem = brdf->SetTree(tree);
    }
    catch (const FileError& e)
    {
      problem = e.what();
    }
    this->RequireIn(visible, problem.empty(), problem);
    result.BRDF = brdf;
    return result;
  }

  Scattering ReadBlock(const BsdfBlock& visible) const
  {
    return this->TreeAxes > 0 ? this->ReadTree(visible) : this->ReadBases(visible);
  }

  void ReadReflection(const BsdfSide& side, MaterialFile& result) const
  {
    const BsdfBlock* visible = this->FindBlock(side.Direction, "Visible");
    if (!visible)
    {
      return;
    }
    const Scattering read = this->ReadBlock(*visible);
    result.BRDF = read.BRDF;
    result.NumberOfNegativeValues = read.Negative;
    if (!read.HasColor)
    {
      result.AddNote(this->TreeAxes > 0
                       ? "Values are of visible light; a tree's colors are not read."
                       : "The file holds no color: values are of visible light.");
    }
    result.AddNote(
      Concat("The side that Radiance calls ", side.Name, ", in the file '", side.Direction, "'."));
  }

  // In the frame of the side.
  void ReadTransmission(const BsdfSide& side, MaterialFile& result) const
  {
    for (const BsdfSide& lit : Sides)
    {
      const BsdfBlock* visible = this->FindBlock(lit.Transmission, "Visible");
      if (!visible)
      {
        continue;
      }
      const Scattering read = this->ReadBlock(*visible);
      if (!result.Transmission)
      {
        result.Transmission = vtkSmartPointer<vtkBTDF>::New();
      }
      result.Transmission->SetFolded(&lit == &side ? vtkBTDF::FRONT : vtkBTDF::BACK, read.BRDF);
      if (read.Negative > 0)
      {
        result.AddNote(Concat("Negative values of ", Quote(visible->Direction),
          ", which count as 0: ", read.Negative, "."));
      }
    }
    if (result.Transmission)
    {
      result.AddNote("Transmission is read, too. Pictures show reflection only.");
    }
  }

  ByteReader Reader;
  std::vector<Element> Elements; // the root first
  std::vector<const Element*> Layers;
  const Element& Layer; // the first one, or the root
  std::string Structure;
  int TreeAxes; // 0: no tree
  std::vector<BsdfBlock> Blocks;
};
}

const MaterialFormat BsdfXmlFormat = { BsdfXmlFormatName,
  "Radiance and WINDOW BSDF .xml (FILE.xml#front or #back)", ".xml",
  [](const vtkBRDFFormat::File& file)
  { return file.Bytes.substr(0, 4096).find("<WindowElement") != std::string_view::npos; },
  [](const FileBytes& file, const std::string& material)
  { return BsdfXmlFile(file).Read(material); },
  [](const FileBytes& file) { return BsdfXmlFile(file).ListSides(); } };
} // namespace measuredbrdf
