// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BsdfXmlFile.h"

#include "BsdfXmlParser.h"
#include "BsdfXmlTree.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkBTDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTensorTreeBRDF.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace measuredbrdf
{
namespace
{
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
}

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

vtkStandardNewMacro(BsdfXmlFormat);

//------------------------------------------------------------------------------
std::string BsdfXmlFormat::GetName() { return BsdfXmlFormatName; }

//------------------------------------------------------------------------------
bool BsdfXmlFormat::CanRead(const File& file)
{
  return file.Bytes.substr(0, 4096).find("<WindowElement") != std::string_view::npos;
}

//------------------------------------------------------------------------------
std::vector<std::string> BsdfXmlFormat::GetMaterialNames(const File& file)
{
  try
  {
    return ListSides(ParseBsdfXml(FileBytes::View(file.Path, file.Bytes)));
  }
  catch (const std::exception&)
  {
    return {}; // Read says what is wrong
  }
}

//------------------------------------------------------------------------------
MaterialFile BsdfXmlFormat::DoRead(const FileBytes& file, const std::string& material)
{
  return ReadBsdfXml(file, material);
}
} // namespace measuredbrdf
