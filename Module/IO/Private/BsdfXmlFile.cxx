// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * BSDF XML files of WINDOW (Lawrence Berkeley National Laboratory) and Radiance: matrices over
 * angle bases (Klems 1994), and tensor trees (Ward et al. 2012). Reflection is read of one side,
 * transmission of both.
 */

#include "MaterialFormat.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkBTDF.h"
#include "vtkTensorTreeBRDF.h"

#include <vtk_pugixml.h>
#include <vtksys/SystemTools.hxx>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr const char* BsdfXmlFormatName = "BSDF XML";
constexpr int DeepestElement = 64;
constexpr std::ptrdiff_t MostTags = 2000000;
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
using Element = pugi::xml_node;

/// All elements of that name in this one, at any depth.
std::vector<Element> FindAll(const Element& element, const std::string& name)
{
  std::vector<Element> found;
  for (const pugi::xpath_node& each : element.select_nodes((".//" + name).c_str()))
  {
    found.push_back(each.node());
  }
  return found;
}

/// An element's own text; comments may divide it.
std::string GetText(const Element& element)
{
  std::string text;
  for (const Element& part : element)
  {
    text += part.type() == pugi::node_element ? "" : part.value();
  }
  return text;
}

/// The trimmed text of the first element of that name in this one; "" where there is none.
std::string GetText(const Element& element, const std::string& name)
{
  return Trim(GetText(element.select_node((".//" + name).c_str()).node()));
}

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

// Finds elements that are nested too deeply, for a search in each of them would take for ever, and
// ampersands in texts that begin no entity, which pugixml takes.
struct Check : pugi::xml_tree_walker
{
  bool for_each(Element& node) override
  {
    this->Place = node.offset_debug();
    std::string_view text = node.type() == pugi::node_pcdata ? this->Xml.substr(this->Place) : "";
    text = text.substr(0, text.find('<'));
    for (auto at = text.find('&'); at < text.size(); at = text.find('&', at + 1))
    {
      if (std::none_of(std::begin(Entities), std::end(Entities),
            [&](const std::string_view name) { return text.substr(at + 1, name.size()) == name; }))
      {
        this->Place += static_cast<std::ptrdiff_t>(at);
        this->Problem = "no well-formed XML: expected '&amp;' for an ampersand";
        return false;
      }
    }
    this->Problem = this->depth() < DeepestElement ? "" : "elements are nested too deeply";
    return this->Problem.empty();
  }

  static constexpr std::string_view Entities[] = { "amp;", "lt;", "gt;", "quot;", "apos;", "#" };
  std::string_view Xml;
  std::ptrdiff_t Place = 0;
  std::string Problem;
};

// Throws FileError where it is no well-formed XML, has a document type of its own, or is not a
// WindowElement. start: of the XML in the file.
void ParseBsdfXml(const ByteReader& reader, std::size_t start, pugi::xml_document& document)
{
  const std::string_view bytes = reader.GetFile().GetView();
  const auto requireNone = [&](std::size_t at, const char* field, const char* what)
  {
    if (at != std::string_view::npos)
    {
      reader.FailAt(at, field, "found ", what);
    }
  };
  // A document type may define texts that grow without bound.
  requireNone(bytes.find("<!DOCTYPE"), "document type", "one, expected none");
  requireNone(bytes.find('\0'), "text", "a zero byte, expected UTF-8");
  reader.Require(std::count(bytes.begin(), bytes.end(), '<') <= MostTags, "text",
    "found more than ", MostTags, " tags");
  const auto require = [&](bool condition, std::ptrdiff_t offset, const std::string& problem)
  {
    if (!condition)
    {
      const std::size_t at = std::min(start + static_cast<std::size_t>(offset), bytes.size());
      const std::string_view there = bytes.substr(at, 24);
      reader.FailAt(at, "text, " + DescribeLine(bytes, at), problem,
        there.empty() ? ", at the end" : ", found " + Quote(there.substr(0, there.find('\n'))));
    }
  };
  const pugi::xml_parse_result result = document.load_buffer(
    bytes.data() + start, bytes.size() - start, pugi::parse_default, pugi::encoding_utf8);
  require(result, result.offset, Concat("no well-formed XML: ", result.description()));
  const Element root = document.document_element();
  require(std::string_view(root.name()) == "WindowElement",
    std::max<std::ptrdiff_t>(root.offset_debug() - 1, 0),
    "the root is " + Quote(root.name()) + ", expected 'WindowElement'");
  require(!root.next_sibling(), std::max<std::ptrdiff_t>(root.next_sibling().offset_debug() - 1, 0),
    "no well-formed XML: found a second root");
  Check check;
  check.Xml = bytes.substr(start);
  const bool isGood = document.traverse(check); // before its place is asked for
  require(isGood, check.Place, check.Problem);
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
  Element Values;
  std::uint64_t Offset; // of the values in the file
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
    , Start(FindXmlStart(file.GetView()))
  {
    ParseBsdfXml(this->Reader, this->Start, this->Document);
    const Element root = this->Document.document_element();
    const std::vector<Element> layers = FindAll(root, "Layer");
    this->NumberOfLayers = layers.size();
    this->Layer = layers.empty() ? root : layers.front();
    this->Structure = GetText(this->Layer, "IncidentDataStructure");
    this->TreeAxes = IsSameWord(this->Structure, "TensorTree3")   ? 3
                     : IsSameWord(this->Structure, "TensorTree4") ? 4
                                                                  : 0;
    for (const Element& data : FindAll(this->Layer, "WavelengthData"))
    {
      const std::string wavelength = GetText(data, "Wavelength");
      for (const Element& block : FindAll(data, "WavelengthDataBlock"))
      {
        const Element values = block.select_node(".//ScatteringData").node();
        const Element place = values ? values : block;
        this->Blocks.push_back({ wavelength, GetText(block, "WavelengthDataDirection"),
          GetText(block, "ColumnAngleBasis"), GetText(block, "RowAngleBasis"), values,
          this->Start + static_cast<std::uint64_t>(place.offset_debug()) - 1 });
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
    if (this->Start > 0)
    {
      const std::string_view bytes = this->Reader.GetFile().GetView();
      const std::string chatter = Trim(bytes.substr(0, std::min<std::size_t>(this->Start, 60)));
      result.AddNote(Concat("The ", this->Start, " bytes before the XML begins are left out",
        chatter.empty() ? "." : ": " + Quote(chatter) + "."));
    }
    if (this->NumberOfLayers > 1)
    {
      result.AddNote(Concat("The first of ", this->NumberOfLayers, " layers."));
    }
    if (result.BRDF)
    {
      NameAfterFile(result, this->Reader.GetFile(), "BSDF XML");
      const std::string name = GetText(this->Layer, "Material//Name");
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
      const std::string values = GetText(block.Values);
      this->Reader.FailAt(block.Offset,
        "ScatteringData of " + Quote(block.Direction) + ", " +
          DescribeLine(this->Reader.GetFile().GetView(), block.Offset),
        what...,
        values.find('.') == std::string::npos && values.find(',') != std::string::npos
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
    std::vector<Element> rings;
    for (const Element& basis : FindAll(this->Layer, "AngleBasis"))
    {
      if (rings.empty() && GetText(basis, "AngleBasisName") == name)
      {
        rings = FindAll(basis, "AngleBasisBlock");
      }
    }
    this->Reader.Require(!rings.empty(), "AngleBasis", "the file does not define ", Quote(name));
    vtkAngleBasisBRDF::Basis basis;
    constexpr int most = vtkAngleBasisBRDF::MaximumPatches;
    int sum = 0;
    double lower = 0.0;
    for (const Element& ring : rings)
    {
      const std::string field = Concat("ring ", basis.Patches.size(), " of ", Quote(name));
      const auto get = [&](const char* element)
      {
        double number = 0.0;
        const std::string text = GetText(ring, element);
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
    const std::string text = GetText(block.Values);
    std::string_view rest = text;
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

  bool HasColor(const BsdfBlock& visible) const
  {
    return this->TreeAxes == 0 && this->FindBlock(visible.Direction, "CIE-X") &&
           this->FindBlock(visible.Direction, "CIE-Z");
  }

  vtkSmartPointer<vtkBRDF> ReadBases(const BsdfBlock& visible, vtkIdType& negative) const
  {
    const auto light = this->MakeBasis(visible.RowBasis);
    const auto view = this->MakeBasis(visible.ColumnBasis);
    const bool hasColor = this->HasColor(visible);
    const auto read = [&](const char* wavelength)
    {
      return this->ReadMatrix(hasColor ? *this->FindBlock(visible.Direction, wavelength) : visible,
        static_cast<std::size_t>(light.GetNumberOfPatches()),
        static_cast<std::size_t>(view.GetNumberOfPatches()));
    };
    const std::vector<float> y = read("Visible");
    const std::vector<float> x = hasColor ? read("CIE-X") : y;
    const std::vector<float> z = hasColor ? read("CIE-Z") : y;
    std::vector<float> rgb;
    for (std::size_t k = 0; k < y.size(); ++k)
    {
      const glm::vec3 color =
        hasColor ? glm::vec3(EqualEnergyToRGB * glm::dvec3(x[k], y[k], z[k])) : glm::vec3(y[k]);
      rgb.insert(rgb.end(), &color.x, &color.x + 3);
    }
    negative = CountNegative(hasColor ? rgb : y);
    auto brdf = vtkSmartPointer<vtkAngleBasisBRDF>::New();
    const std::string problem = brdf->SetMatrix(light, view, std::move(rgb));
    this->Reader.Require(problem.empty(), "AngleBasis", problem);
    return brdf;
  }

  // The values of a block as they are in the file; of transmission: folded.
  vtkSmartPointer<vtkBRDF> ReadBlock(const BsdfBlock& visible, vtkIdType& negative) const
  {
    if (this->TreeAxes == 0)
    {
      return this->ReadBases(visible, negative);
    }
    auto brdf = vtkSmartPointer<vtkTensorTreeBRDF>::New();
    std::string problem;
    try
    {
      const Tree tree = ParseBsdfTree(GetText(visible.Values), this->TreeAxes);
      negative = CountNegative(tree.Values);
      problem = brdf->SetTree(tree);
    }
    catch (const FileError& e)
    {
      problem = e.what();
    }
    this->RequireIn(visible, problem.empty(), problem);
    return brdf;
  }

  void ReadReflection(const BsdfSide& side, MaterialFile& result) const
  {
    const BsdfBlock* visible = this->FindBlock(side.Direction, "Visible");
    if (!visible)
    {
      return;
    }
    result.BRDF = this->ReadBlock(*visible, result.NumberOfNegativeValues);
    if (!this->HasColor(*visible))
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
      vtkIdType negative = 0;
      const auto folded = this->ReadBlock(*visible, negative);
      if (!result.Transmission)
      {
        result.Transmission = vtkSmartPointer<vtkBTDF>::New();
      }
      result.Transmission->SetFolded(&lit == &side ? vtkBTDF::FRONT : vtkBTDF::BACK, folded);
      if (negative > 0)
      {
        result.AddNote(Concat(
          "Negative values of ", Quote(visible->Direction), ", which count as 0: ", negative, "."));
      }
    }
    if (result.Transmission)
    {
      result.AddNote("Transmission is read, too. Pictures show reflection only.");
    }
  }

  ByteReader Reader;
  std::size_t Start; // of the XML in the file
  pugi::xml_document Document;
  std::size_t NumberOfLayers = 0;
  Element Layer; // the first one, or the root
  std::string Structure;
  int TreeAxes = 0; // 0: no tree
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
