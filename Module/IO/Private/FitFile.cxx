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

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
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
const glm::dvec3 NganScale = { 1.0, 1.15, 1.66 };

struct FitAttribute
{
  std::string Name;
  std::size_t Count; // of numbers
  double Lowest;
  double Highest;
};

// The models, and the attributes that each has.
const FitAttribute Albedo = { "albedo", 3, 0.0, HUGE_VAL };
const FitAttribute Sharpness = { "sharpness", 1, 0.0, 1e6 };
const std::map<std::string, std::vector<FitAttribute>> FitModels = { { "Aggregate", {} },
  { "Lambertian", { Albedo } }, { "NganBlinnPhong", { Albedo, Sharpness } },
  { "NganAshikhminShirley", { Albedo, Sharpness, { "fresnelReflectance", 1, 0.0, 1.0 } } },
  { "LowAshikhminShirley", { Albedo, Sharpness, { "fresnelReflectance", 1, 1.0, 100.0 } } } };

/// Model(attribute = value, ..., Model(...), ...)
struct FitCall
{
  std::string Material; // of a whole entry
  std::string Model;
  int Line = 0;
  std::map<std::string, std::vector<double>> Attributes;
  std::vector<FitCall> Terms; // of Aggregate

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
 * The text taken apart by recursive descent over the grammar. Every method steps over white space
 * and comments first, and throws FileError where the text is not what it reads. Strict: one wrong
 * entry makes the whole text wrong.
 */
class FitFile
{
public:
  explicit FitFile(const FileBytes& file)
    : File(file)
    , Text(SkipByteOrderMark(file.GetView()))
  {
    std::map<std::string, int> lines;
    for (this->SkipSpace(); !this->Text.empty(); this->SkipSpace())
    {
      const int line = this->Line;
      const std::string name = this->ReadName("a material's name");
      const auto [first, isNew] = lines.emplace(name, line);
      if (!isNew)
      {
        this->FailAt(line, "material ", Quote(name), " was already given in line ", first->second);
      }
      this->Expect('=');
      this->Entries.push_back(this->ReadCall(this->ReadName("a model's name")));
      this->Entries.back().Material = name;
    }
    if (this->Entries.empty())
    {
      this->FailAt(this->Line, "no material; expected lines 'name = Aggregate(...)'");
    }
  }

  /// In the order of the text.
  std::vector<std::string> GetNames() const
  {
    std::vector<std::string> names;
    for (const FitCall& entry : this->Entries)
    {
      names.push_back(entry.Material);
    }
    return names;
  }

  /// The material of that name; empty: the only one. Throws where there is no such one.
  MaterialFile GetMaterial(const std::string& name) const
  {
    const std::size_t count = this->Entries.size();
    const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
      [&](const FitCall& entry) { return name.empty() ? count == 1 : entry.Material == name; });
    if (found == this->Entries.end())
    {
      std::string some;
      for (std::size_t k = 0; k < std::min<std::size_t>(3, count); ++k)
      {
        some += (k ? ", " : "") + ToPrintable(this->Entries[k].Material, LongestName);
      }
      throw FileError(this->File.GetPath(), ": ", FitFormatName, ": ",
        name.empty() ? "choose one with #name" : "no material " + Quote(name), " among its ", count,
        " materials (", some, count > 3 ? ", ...)" : ")");
    }
    const FitCall& expression = *found;
    const bool low = expression.Uses("Low");
    const bool ngan =
      expression.Uses("Ngan") || (!low && this->Comments.find("Ngan") != std::string::npos);
    MaterialFile result;
    vtkNew<vtkSumBRDF> sum;
    this->AddTerms(found->Material, expression, ngan ? NganScale : glm::dvec3(1.0), sum, result);
    sum->SetName(found->Material);
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
  template <typename... Pieces>
  [[noreturn]] void FailAt(int line, const Pieces&... what) const
  {
    FailIn(this->File, FitFormatName, Concat("line ", line), what...);
  }

  //----------------------------------------------------------------------------
  void SkipSpace()
  {
    while (!this->Text.empty())
    {
      const char c = this->Text.front();
      if (c == '#')
      {
        const std::size_t end = std::min(this->Text.find('\n'), this->Text.size());
        this->Comments.append(this->Text.substr(1, end - 1));
        this->Text.remove_prefix(end);
        continue;
      }
      if (c != ' ' && c != '\t' && c != '\r' && c != '\n')
      {
        return;
      }
      this->Line += c == '\n';
      this->Text.remove_prefix(1);
    }
  }

  // what: how an error calls it.
  [[noreturn]] void Expected(const std::string& what)
  {
    this->SkipSpace();
    const std::string_view rest = this->Text.substr(0, 24);
    this->FailAt(this->Line, "expected ", what, ", found ",
      rest.empty() ? "the end of the file" : Quote(rest.substr(0, rest.find_first_of("\r\n"))));
  }

  bool Accept(char character)
  {
    this->SkipSpace();
    const bool is = !this->Text.empty() && this->Text.front() == character;
    this->Text.remove_prefix(is ? 1 : 0);
    return is;
  }

  void Expect(char character)
  {
    if (!this->Accept(character))
    {
      this->Expected(std::string{ '\'', character, '\'' });
    }
  }

  std::string ReadName(const std::string& what)
  {
    this->SkipSpace();
    constexpr std::string_view characters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
    const std::string name(this->Text.substr(0, this->Text.find_first_not_of(characters)));
    if (name.empty())
    {
      this->Expected(what);
    }
    this->Text.remove_prefix(name.size());
    return name;
  }

  // What follows a model's name.
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
      if (name[0] >= '0' && name[0] <= '9')
      {
        this->FailAt(
          this->Line, "expected an attribute or a model, found ", Quote(name), DecimalHint);
      }
      if (!this->Accept('='))
      {
        call.Terms.push_back(this->ReadCall(name, depth + 1));
      }
      else if (!call.Attributes.emplace(name, this->ReadValue(name)).second)
      {
        this->FailAt(this->Line, "attribute ", Quote(name), " appears twice");
      }
    } while (this->Accept(','));
    this->Expect(')');
    return call;
  }

  std::vector<double> ReadValue(const std::string& attribute)
  {
    std::vector<double> values;
    const bool isList = this->Accept('[');
    do
    {
      this->Accept('+');
      this->SkipSpace();
      double value = 0.0;
      const std::size_t length = ReadNumber(this->Text, value);
      if (length == 0 || !std::isfinite(value))
      {
        this->Expected("a finite number for attribute " + Quote(attribute));
      }
      this->Text.remove_prefix(length);
      values.push_back(value);
    } while (isList && this->Accept(','));
    if (isList)
    {
      this->Expect(']');
    }
    return values;
  }

  //----------------------------------------------------------------------------
  // Adds the BRDFs of a call to the sum. scale: of albedos; result takes notes.
  void AddTerms(const std::string& material, FitCall call, const glm::dvec3& scale, vtkSumBRDF* sum,
    MaterialFile& result) const
  {
    this->CheckCall(material, call, result);
    for (const FitCall& term : call.Terms)
    {
      this->AddTerms(material, term, scale, sum, result);
    }
    if (call.Model == "Aggregate")
    {
      return;
    }
    const glm::dvec3 albedo = scale * glm::make_vec3(call.Attributes["albedo"].data());
    if (call.Model == "Lambertian")
    {
      vtkNew<vtkLambertBRDF> term;
      term->SetAlbedo(&albedo[0]);
      sum->AddTerm(term);
      return;
    }
    const double exponent = call.Attributes["sharpness"][0];
    if (call.Model == "NganBlinnPhong")
    {
      vtkNew<vtkBlinnPhongBRDF> term;
      term->SetSpecular(&albedo[0]);
      term->SetExponent(exponent);
      sum->AddTerm(term);
      return;
    }
    const double fresnel = call.Attributes["fresnelReflectance"][0];
    vtkNew<vtkAshikhminShirleyBRDF> term;
    term->SetSpecularScale(&albedo[0]);
    term->SetExponents(exponent, exponent);
    if (call.Model == "NganAshikhminShirley")
    {
      term->SetReflectance(fresnel, fresnel, fresnel);
      term->SetFresnelModelToSchlick();
    }
    else
    {
      term->SetIndexOfRefraction(fresnel);
      term->SetFresnelModelToDielectric();
    }
    sum->AddTerm(term);
  }

  // Throws where the model does not exist, has other attributes, or values out of their bounds.
  // What rounding put beyond them is repaired, and noted.
  void CheckCall(const std::string& material, FitCall& call, MaterialFile& result) const
  {
    const auto require = [&](bool condition, const auto&... what)
    {
      if (!condition)
      {
        this->FailAt(call.Line, "material ", Quote(material), ", ",
          ToPrintable(call.Model, LongestName), ": ", what...);
      }
    };
    const auto model = FitModels.find(call.Model);
    require(model != FitModels.end(),
      "unknown model, expected Aggregate, Lambertian, NganBlinnPhong, NganAshikhminShirley or "
      "LowAshikhminShirley");
    const std::vector<FitAttribute>& known = model->second;
    for (const auto& attribute : call.Attributes)
    {
      const bool isKnown = std::any_of(known.begin(), known.end(),
        [&](const FitAttribute& one) { return one.Name == attribute.first; });
      require(isKnown, "unknown attribute ", Quote(attribute.first));
    }
    require(!known.empty() || !call.Terms.empty(), "holds no model, expected at least one");
    require(known.empty() || call.Terms.empty(),
      call.Terms.empty() ? "" : Quote(call.Terms.front().Model), " can't be inside");
    for (const FitAttribute& one : known)
    {
      const auto found = call.Attributes.find(one.Name);
      require(found != call.Attributes.end(), "attribute '", one.Name, "' is missing");
      const std::size_t count = found->second.size();
      require(count == one.Count, "attribute '", one.Name, "' has ", count, " numbers, expected ",
        one.Count, count == 2 * one.Count ? DecimalHint : "");
      for (double& value : found->second)
      {
        const double repaired = std::clamp(value, one.Lowest, one.Highest);
        require(std::abs(value - repaired) <= NoiseOfFigures * std::max(std::abs(repaired), 1.0),
          "attribute '", one.Name, value < 0.0 ? "' is negative: " : "' is ", value, ", expected ",
          one.Lowest,
          one.Highest < HUGE_VAL ? " to " + NumberText(one.Highest) : std::string(" or more"));
        if (value != repaired)
        {
          result.AddNote(Concat(call.Model, ": attribute '", one.Name, "' is ", value, ", beyond ",
            repaired, " by rounding: taken as that."));
          result.NumberOfNegativeValues += value < 0.0;
        }
        value = repaired;
      }
    }
  }

  const FileBytes& File;
  std::string_view Text; // what was not read yet
  int Line = 1;
  std::string Comments; // the text of all of them so far
  std::vector<FitCall> Entries;
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
