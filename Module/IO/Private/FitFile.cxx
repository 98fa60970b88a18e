// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Published fits as text, one material per entry:
 *
 *     # comment
 *     name = Aggregate(Lambertian(albedo = [r, g, b]), Model(attribute = value, ...))
 *
 * Models: Lambertian(albedo); NganBlinnPhong(albedo, sharpness) and
 * NganAshikhminShirley(albedo, fresnelReflectance, sharpness) of Ngan et al. 2005, Schlick's
 * Fresnel term; LowAshikhminShirley(same attributes) of Low et al. 2012, whose fresnelReflectance
 * is an index of refraction for the exact dielectric Fresnel term.
 */

#include "MaterialFormat.h"
#include "NumberText.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSumBRDF.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr const char* FitFormatName = "published fits (text)";
constexpr int DeepestTerm = 16;
constexpr double NoiseOfFigures = 1e-6; // that figures may lie beyond their bounds by
constexpr const char* DecimalHint = " (decimals follow a point, not a comma)";

// Ngan et al. fitted MERL's data without its color scale (1, 1.15, 1.66)/1500 (MerlFile.cxx)
// relative to red, so their figures need it; Low et al. applied it.
constexpr double NganScale[3] = { 1.0, 1.15, 1.66 };

/// Model(attribute = value, ..., Model(...), ...)
struct FitCall
{
  std::string Model;
  int Line = 0;
  std::map<std::string, std::vector<double>> Attributes;
  std::vector<FitCall> Terms;

  /// Whether it or a term of it is a model whose name begins so.
  bool Uses(const std::string& start) const
  {
    return this->Model.compare(0, start.size(), start) == 0 ||
           std::any_of(this->Terms.begin(), this->Terms.end(),
             [&](const FitCall& term) { return term.Uses(start); });
  }
};

//------------------------------------------------------------------------------
/**
 * Recursive descent over the grammar. Every method steps over white space and comments first, and
 * throws FileError where the text is not what it reads.
 */
class FitParser
{
public:
  explicit FitParser(const FileBytes& file)
    : File(file)
    , Text(file.GetView())
  {
    constexpr std::string_view mark = "\xef\xbb\xbf"; // that some editors begin UTF-8 with
    this->Place = this->Text.substr(0, mark.size()) == mark ? mark.size() : 0;
  }

  int Line = 1;
  std::string Comments; // the text of all of them so far

  bool IsAtEnd()
  {
    this->SkipSpace();
    return this->Place >= this->Text.size();
  }

  /// what: how an error calls it.
  std::string ReadName(const std::string& what)
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

  void Expect(char character)
  {
    if (!this->Accept(character))
    {
      this->Expected(std::string("'") + character + "'");
    }
  }

  /// What follows a model's name.
  FitCall ReadCall(const std::string& model, int depth = 0)
  {
    if (depth > DeepestTerm)
    {
      this->FailAt(this->Line, "models are nested too deeply");
    }
    FitCall call;
    call.Model = model;
    call.Line = this->Line;
    this->Expect('(');
    if (this->Accept(')'))
    {
      return call;
    }
    do
    {
      const std::string name = this->ReadName("an attribute or a model");
      if (std::isdigit(static_cast<unsigned char>(name[0])) != 0)
      {
        this->FailAt(
          this->Line, "expected an attribute or a model, found " + Quote(name) + DecimalHint);
      }
      if (!this->Accept('='))
      {
        call.Terms.push_back(this->ReadCall(name, depth + 1));
      }
      else if (!call.Attributes.emplace(name, this->ReadValue(name)).second)
      {
        this->FailAt(this->Line, "attribute " + Quote(name) + " appears twice");
      }
    } while (this->Accept(','));
    this->Expect(')');
    return call;
  }

  /// Throws FileError: "PATH: FORMAT, line N: what".
  [[noreturn]] void FailAt(int line, const std::string& what) const
  {
    FailIn(this->File, FitFormatName, "line " + std::to_string(line), what);
  }

private:
  static bool IsNameCharacter(char c)
  {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  }

  void SkipSpace()
  {
    for (; this->Place < this->Text.size(); ++this->Place)
    {
      const char c = this->Text[this->Place];
      if (c == '#')
      {
        const std::size_t end = std::min(this->Text.find('\n', this->Place), this->Text.size());
        this->Comments.append(this->Text.substr(this->Place + 1, end - this->Place - 1));
        this->Place = end - 1;
      }
      else if (c == '\n')
      {
        ++this->Line;
      }
      else if (c != ' ' && c != '\t' && c != '\r')
      {
        return;
      }
    }
  }

  bool Accept(char character)
  {
    this->SkipSpace();
    const bool is = this->Place < this->Text.size() && this->Text[this->Place] == character;
    this->Place += is ? 1 : 0;
    return is;
  }

  std::vector<double> ReadValue(const std::string& attribute)
  {
    std::vector<double> values;
    const bool isList = this->Accept('[');
    do
    {
      this->Accept('+');
      double value = 0.0;
      this->SkipSpace();
      const char* begin = this->Text.data() + this->Place;
      // Not strtod: its decimal sign follows the locale.
      const auto result = std::from_chars(begin, this->Text.data() + this->Text.size(), value);
      if (result.ec != std::errc() || !std::isfinite(value))
      {
        this->Expected("a finite number for attribute " + Quote(attribute));
      }
      this->Place += static_cast<std::size_t>(result.ptr - begin);
      values.push_back(value);
    } while (isList && this->Accept(','));
    if (isList)
    {
      this->Expect(']');
    }
    return values;
  }

  [[noreturn]] void Expected(const std::string& what)
  {
    this->SkipSpace();
    const std::string_view rest = this->Text.substr(std::min(this->Place, this->Text.size()), 24);
    this->FailAt(this->Line,
      "expected " + what + ", found " +
        (rest.empty() ? "the end of the file" : Quote(rest.substr(0, rest.find_first_of("\r\n")))));
  }

  const FileBytes& File;
  std::string_view Text;
  std::size_t Place = 0;
};

//------------------------------------------------------------------------------
// A material of the text.
struct FitEntry
{
  std::string Name;
  FitCall Expression;
};

// Makes BRDFs of an entry's calls, and complains about what does not fit.
class FitBuilder
{
public:
  /// scale: of albedos; result takes notes.
  FitBuilder(
    const FitParser& parser, const FitEntry& entry, const double scale[3], MaterialFile& result)
    : Parser(parser)
    , Name(entry.Name)
    , Scale(scale)
    , Result(result)
  {
  }

  void AddTerms(const FitCall& call, vtkSumBRDF* sum) const
  {
    const bool isNgan = call.Model == "NganAshikhminShirley";
    if (call.Model == "Aggregate")
    {
      this->CheckAttributes(call, {}, true);
      if (call.Terms.empty())
      {
        this->Complain(call, "holds no model, expected at least one");
      }
      for (const FitCall& term : call.Terms)
      {
        this->AddTerms(term, sum);
      }
    }
    else if (call.Model == "Lambertian")
    {
      this->CheckAttributes(call, { "albedo" });
      vtkNew<vtkLambertBRDF> term;
      term->SetAlbedo(&this->GetAlbedo(call)[0]);
      sum->AddTerm(term);
    }
    else if (call.Model == "NganBlinnPhong")
    {
      this->CheckAttributes(call, { "albedo", "sharpness" });
      vtkNew<vtkBlinnPhongBRDF> term;
      term->SetSpecular(&this->GetAlbedo(call)[0]);
      term->SetExponent(this->GetNumber(call, "sharpness", 0.0, 1e6));
      sum->AddTerm(term);
    }
    else if (isNgan || call.Model == "LowAshikhminShirley")
    {
      this->CheckAttributes(call, { "albedo", "fresnelReflectance", "sharpness" });
      vtkNew<vtkAshikhminShirleyBRDF> term;
      term->SetSpecularScale(&this->GetAlbedo(call)[0]);
      const double exponent = this->GetNumber(call, "sharpness", 0.0, 1e6);
      term->SetExponents(exponent, exponent);
      if (isNgan)
      {
        const double reflectance = this->GetNumber(call, "fresnelReflectance", 0.0, 1.0);
        term->SetReflectance(reflectance, reflectance, reflectance);
        term->SetFresnelModelToSchlick();
      }
      else
      {
        term->SetIndexOfRefraction(this->GetNumber(call, "fresnelReflectance", 1.0, 100.0));
        term->SetFresnelModelToDielectric();
      }
      sum->AddTerm(term);
    }
    else
    {
      this->Complain(call,
        "unknown model, expected Aggregate, Lambertian, NganBlinnPhong, NganAshikhminShirley or "
        "LowAshikhminShirley");
    }
  }

private:
  [[noreturn]] void Complain(const FitCall& call, const std::string& what) const
  {
    this->Parser.FailAt(call.Line,
      "material " + Quote(this->Name) + ", " + ToPrintable(call.Model, LongestName) + ": " + what);
  }

  void CheckAttributes(
    const FitCall& call, const std::vector<std::string>& names, bool hasTerms = false) const
  {
    for (const auto& attribute : call.Attributes)
    {
      if (std::find(names.begin(), names.end(), attribute.first) == names.end())
      {
        this->Complain(call, "unknown attribute " + Quote(attribute.first));
      }
    }
    if (!hasTerms && !call.Terms.empty())
    {
      this->Complain(call, Quote(call.Terms.front().Model) + " can't be inside");
    }
  }

  const std::vector<double>& GetAttribute(
    const FitCall& call, const std::string& name, std::size_t count) const
  {
    const auto found = call.Attributes.find(name);
    if (found == call.Attributes.end())
    {
      this->Complain(call, "attribute '" + name + "' is missing");
    }
    if (found->second.size() != count)
    {
      this->Complain(call, "attribute '" + name + "' has " + std::to_string(found->second.size()) +
                             " numbers, expected " + std::to_string(count) +
                             (found->second.size() == 2 * count ? DecimalHint : ""));
    }
    return found->second;
  }

  double GetNumber(
    const FitCall& call, const std::string& name, double lowest, double highest) const
  {
    return this->Repair(call, name, this->GetAttribute(call, name, 1)[0], lowest, highest);
  }

  glm::dvec3 GetAlbedo(const FitCall& call) const
  {
    const std::vector<double>& values = this->GetAttribute(call, "albedo", 3);
    glm::dvec3 albedo;
    for (int k = 0; k < 3; ++k)
    {
      const double value = values[static_cast<std::size_t>(k)];
      albedo[k] = this->Repair(call, "albedo", value, 0.0, HUGE_VAL) * this->Scale[k];
    }
    return albedo;
  }

  // In bounds, or what rounding put beyond them.
  double Repair(
    const FitCall& call, const std::string& name, double value, double lowest, double highest) const
  {
    const double repaired = std::clamp(value, lowest, highest);
    if (std::abs(value - repaired) > NoiseOfFigures * std::max(std::abs(repaired), 1.0))
    {
      this->Complain(call, "attribute '" + name + (value < 0.0 ? "' is negative: " : "' is ") +
                             NumberText(value) + ", expected " + NumberText(lowest) +
                             (highest < HUGE_VAL ? " to " + NumberText(highest) : " or more"));
    }
    if (value != repaired)
    {
      this->Result.AddNote(call.Model + ": attribute '" + name + "' is " + NumberText(value) +
                           ", beyond " + NumberText(repaired) + " by rounding: taken as that.");
      this->Result.NumberOfNegativeValues += value < 0.0;
    }
    return repaired;
  }

  const FitParser& Parser;
  const std::string& Name;
  const double* Scale;
  MaterialFile& Result;
};

//------------------------------------------------------------------------------
/**
 * The text taken apart. Strict: one wrong entry makes the whole text wrong.
 */
class FitFile
{
public:
  explicit FitFile(const FileBytes& file)
    : File(file)
    , Parser(file)
  {
    std::map<std::string, int> lines;
    while (!this->Parser.IsAtEnd())
    {
      const int line = this->Parser.Line;
      const std::string name = this->Parser.ReadName("a material's name");
      const auto [first, isNew] = lines.emplace(name, line);
      if (!isNew)
      {
        this->Parser.FailAt(line, "material " + Quote(name) + " was already given in line " +
                                    std::to_string(first->second));
      }
      this->Parser.Expect('=');
      const std::string model = this->Parser.ReadName("a model's name");
      this->Entries.push_back({ name, this->Parser.ReadCall(model) });
    }
    if (this->Entries.empty())
    {
      this->Parser.FailAt(this->Parser.Line, "no material; expected lines 'name = Aggregate(...)'");
    }
  }

  /// In the order of the text.
  std::vector<std::string> GetNames() const
  {
    std::vector<std::string> names;
    for (const FitEntry& entry : this->Entries)
    {
      names.push_back(entry.Name);
    }
    return names;
  }

  /// The material of that name; empty: the only one. Throws where there is no such one.
  MaterialFile GetMaterial(const std::string& name) const
  {
    const FitEntry& entry = this->Find(name);
    const FitCall& expression = entry.Expression;
    const bool low = expression.Uses("Low");
    const bool ngan =
      expression.Uses("Ngan") || (!low && this->Parser.Comments.find("Ngan") != std::string::npos);
    const double one[3] = { 1.0, 1.0, 1.0 };
    MaterialFile result;
    vtkNew<vtkSumBRDF> sum;
    FitBuilder(this->Parser, entry, ngan ? NganScale : one, result).AddTerms(expression, sum);
    sum->SetName(entry.Name);
    std::string models;
    for (const FitCall& term : expression.Terms)
    {
      models += (models.empty() ? "" : " + ") + term.Model;
    }
    sum->SetSource((models.empty() ? expression.Model : models) + " fit" +
                   (ngan   ? " by Ngan et al. 2005"
                     : low ? " by Low et al. 2012"
                           : "") +
                   ", " + GetFileTitle(this->File.GetPath()));
    if (ngan)
    {
      result.AddNote("Ngan's figures lack MERL's color scale: albedos were multiplied by 1.00, "
                     "1.15, 1.66 (R, G, B).");
    }
    result.BRDF = sum;
    return result;
  }

private:
  const FitEntry& Find(const std::string& name) const
  {
    const std::size_t count = this->Entries.size();
    const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
      [&](const FitEntry& entry) { return name.empty() ? count == 1 : entry.Name == name; });
    if (found != this->Entries.end())
    {
      return *found;
    }
    std::string some;
    for (std::size_t k = 0; k < std::min<std::size_t>(3, count); ++k)
    {
      some += (k ? ", " : "") + ToPrintable(this->Entries[k].Name, LongestName);
    }
    throw FileError(this->File.GetPath() + ": " + FitFormatName + ": " +
                    (name.empty() ? "choose one with #name" : "no material " + Quote(name)) +
                    " among its " + std::to_string(count) + " materials (" + some +
                    (count > 3 ? ", ...)" : ")"));
  }

  const FileBytes& File;
  FitParser Parser;
  std::vector<FitEntry> Entries;
};

//------------------------------------------------------------------------------
// ASCII or UTF-8 without control characters, judged by the first bytes.
bool CanReadFits(const vtkBRDFFormat::File& file)
{
  const std::string_view start = file.Bytes.substr(0, 4096);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || start[first] == '<' || start[first] == '{')
  {
    return false; // a web page, XML, JSON
  }
  // "name = Model(albedo = ...)" somewhere, and text around it.
  bool isAssigned = file.Bytes.find("albedo") != std::string_view::npos;
  for (std::size_t at = file.Bytes.find('='); at != std::string_view::npos && !isAssigned;
       at = file.Bytes.find('=', at + 1))
  {
    const std::size_t next = file.Bytes.find_first_not_of(" \t\r\n", at + 1);
    isAssigned = next == std::string_view::npos ||
                 std::isalpha(static_cast<unsigned char>(file.Bytes[next])) != 0;
  }
  return isAssigned && IsText(start);
}
}

const MaterialFormat FitFormat = { FitFormatName,
  "published fits in .fit (FITS.fit#NAME for one of several)", ".fit", CanReadFits,
  [](const FileBytes& file, const std::string& name) { return FitFile(file).GetMaterial(name); },
  [](const FileBytes& file) { return FitFile(file).GetNames(); } };
} // namespace measuredbrdf
