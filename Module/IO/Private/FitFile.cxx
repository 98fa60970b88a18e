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

bool IsNameCharacter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || c == '.';
}

/// Throws FileError: "PATH: FORMAT, line N: what".
[[noreturn]] void FailAtLine(const std::string& path, int line, const std::string& what)
{
  throw FileError(path + ": " + FitFormatName + ", line " + std::to_string(line) + ": " + what);
}

/// Model(attribute = value, ..., Model(...), ...)
struct FitCall
{
  std::string Model;
  int Line = 0;
  std::map<std::string, std::vector<double>> Attributes;
  std::vector<FitCall> Terms;
};

/**
 * Recursive descent over the grammar. Every method steps over white space and comments first, and
 * throws FileError where the text is not what it reads.
 */
class FitParser
{
public:
  /// Both stay with the caller.
  FitParser(const std::string& path, std::string_view text)
    : Path(path)
    , Text(text)
  {
  }

  int GetLine() const { return this->Line; }

  /// The text of all comments so far.
  const std::string& GetComments() const { return this->Comments; }

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

  FitCall ReadCall(int depth = 0)
  {
    if (depth > DeepestTerm)
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

private:
  void SkipSpace()
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

  bool Accept(char character)
  {
    this->SkipSpace();
    if (this->Place < this->Text.size() && this->Text[this->Place] == character)
    {
      ++this->Place;
      return true;
    }
    return false;
  }

  double ReadNumber(const std::string& attribute)
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

  std::vector<double> ReadValue(const std::string& attribute)
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

  [[noreturn]] void Expected(const std::string& what)
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

  const std::string& Path;
  std::string_view Text;
  std::size_t Place = 0;
  int Line = 1;
  std::string Comments;
  std::size_t CommentsEnd = 0;
};

// Ngan et al. fitted MERL's data without its color scale (1, 1.15, 1.66)/1500 (MerlFile.cxx)
// relative to red, so their figures need it; Low et al. applied it.
constexpr double NganScale[3] = { 1.0, 1.15, 1.66 };

constexpr double Noise = 1e-6; // that figures may lie beyond their bounds by

bool StartsWith(const std::string& text, const std::string& start)
{
  return text.compare(0, start.size(), start) == 0;
}

//------------------------------------------------------------------------------
// Makes BRDFs of calls, scaled by Scale, and complains about what does not fit.
class Builder
{
public:
  /// result takes notes.
  Builder(
    const std::string& path, const std::string& name, const double scale[3], MaterialFile& result)
    : Path(path)
    , Name(name)
    , Result(result)
  {
    std::copy_n(scale, 3, this->Scale);
  }

  void AddTerms(const FitCall& call, vtkSumBRDF* sum) const
  {
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
      double albedo[3];
      this->GetAlbedo(call, albedo);
      term->SetAlbedo(albedo);
      sum->AddTerm(term);
    }
    else if (call.Model == "NganBlinnPhong")
    {
      this->CheckAttributes(call, { "albedo", "sharpness" });
      vtkNew<vtkBlinnPhongBRDF> term;
      double specular[3];
      this->GetAlbedo(call, specular);
      term->SetSpecular(specular);
      term->SetExponent(this->GetNumber(call, "sharpness", 0.0, 1e6));
      sum->AddTerm(term);
    }
    else if (call.Model == "NganAshikhminShirley" || call.Model == "LowAshikhminShirley")
    {
      this->CheckAttributes(call, { "albedo", "fresnelReflectance", "sharpness" });
      vtkNew<vtkAshikhminShirleyBRDF> term;
      double scale[3];
      this->GetAlbedo(call, scale);
      term->SetSpecularScale(scale);
      const double exponent = this->GetNumber(call, "sharpness", 0.0, 1e6);
      term->SetExponents(exponent, exponent);
      if (StartsWith(call.Model, "Ngan"))
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
    FailAtLine(this->Path, call.Line,
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
      this->Complain(call,
        "attribute '" + name + "' has " + std::to_string(found->second.size()) +
          " numbers, expected " + std::to_string(count) +
          (found->second.size() == 2 * count ? " (decimals follow a point, not a comma)" : ""));
    }
    return found->second;
  }

  double GetNumber(
    const FitCall& call, const std::string& name, double lowest, double highest) const
  {
    return this->Repair(call, name, this->GetAttribute(call, name, 1)[0], lowest, highest);
  }

  void GetAlbedo(const FitCall& call, double albedo[3]) const
  {
    const std::vector<double>& values = this->GetAttribute(call, "albedo", 3);
    for (int k = 0; k < 3; ++k)
    {
      albedo[k] = this->Repair(call, "albedo", values[k], 0.0, HUGE_VAL) * this->Scale[k];
    }
  }

  // In bounds, or what rounding put beyond them.
  double Repair(
    const FitCall& call, const std::string& name, double value, double lowest, double highest) const
  {
    const double repaired = std::clamp(value, lowest, highest);
    if (std::abs(value - repaired) > Noise * std::max(std::abs(repaired), 1.0))
    {
      TextStream text;
      text << "attribute '" << name << (value < 0.0 ? "' is negative: " : "' is ") << value
           << ", expected " << lowest;
      text << (highest < HUGE_VAL ? " to " : " or more");
      if (highest < HUGE_VAL)
      {
        text << highest;
      }
      this->Complain(call, text.str());
    }
    if (value != repaired)
    {
      TextStream text;
      text << call.Model << ": attribute '" << name << "' is " << value << ", beyond " << repaired
           << " by rounding: taken as that.";
      this->Result.AddNote(text.str());
      this->Result.NumberOfNegativeValues += value < 0.0;
    }
    return repaired;
  }

  const std::string& Path;
  const std::string& Name;
  MaterialFile& Result;
  double Scale[3];
};

//------------------------------------------------------------------------------
bool AnyModel(const FitCall& call, const std::string& start)
{
  return StartsWith(call.Model, start) ||
         std::any_of(call.Terms.begin(), call.Terms.end(),
           [&](const FitCall& term) { return AnyModel(term, start); });
}

/**
 * The text taken apart. Strict: one wrong entry makes the whole text wrong.
 */
class FitFile
{
public:
  /// path: what errors call the text.
  FitFile(const std::string& path, std::string_view text)
    : Path(path)
  {
    constexpr std::string_view mark = "\xef\xbb\xbf"; // that some editors begin UTF-8 with
    FitParser parser(path, text.substr(0, mark.size()) == mark ? text.substr(mark.size()) : text);
    std::map<std::string, int> lines;
    while (!parser.IsAtEnd())
    {
      Entry entry;
      const int line = parser.GetLine();
      entry.Name = parser.ReadName("a material's name");
      parser.Expect('=');
      entry.Expression = parser.ReadCall();
      const auto inserted = lines.emplace(entry.Name, line);
      if (!inserted.second)
      {
        FailAtLine(path, line,
          "material " + Quote(entry.Name) + " was already given in line " +
            std::to_string(inserted.first->second));
      }
      this->Entries.push_back(std::move(entry));
    }
    if (this->Entries.empty())
    {
      FailAtLine(path, parser.GetLine(), "no material; expected lines 'name = Aggregate(...)'");
    }
    this->Comments = parser.GetComments();
  }

  /// In the order of the text.
  std::vector<std::string> GetNames() const
  {
    std::vector<std::string> names;
    for (const Entry& entry : this->Entries)
    {
      names.push_back(entry.Name);
    }
    return names;
  }

  /// The material of that name; empty: the only one. Throws where there is no such one.
  MaterialFile GetMaterial(const std::string& name) const
  {
    const Entry& entry = this->Find(name);
    const bool ngan =
      AnyModel(entry.Expression, "Ngan") ||
      (!AnyModel(entry.Expression, "Low") && this->Comments.find("Ngan") != std::string::npos);
    const bool low = AnyModel(entry.Expression, "Low");
    const double one[3] = { 1.0, 1.0, 1.0 };

    MaterialFile result;
    vtkNew<vtkSumBRDF> sum;
    Builder(this->Path, entry.Name, ngan ? NganScale : one, result).AddTerms(entry.Expression, sum);
    sum->SetName(entry.Name);

    std::string models;
    for (const FitCall& term : entry.Expression.Terms)
    {
      models += (models.empty() ? "" : " + ") + term.Model;
    }
    sum->SetSource((models.empty() ? entry.Expression.Model : models) + " fit" +
                   (ngan   ? " by Ngan et al. 2005"
                     : low ? " by Low et al. 2012"
                           : "") +
                   ", " + GetFileTitle(this->Path));

    if (ngan)
    {
      result.AddNote("Ngan's figures lack MERL's color scale: albedos were multiplied by 1.00, "
                     "1.15, 1.66 (R, G, B).");
    }
    result.BRDF = sum;
    return result;
  }

private:
  struct Entry
  {
    std::string Name;
    FitCall Expression;
  };

  const Entry& Find(const std::string& name) const
  {
    if (name.empty() && this->Entries.size() == 1)
    {
      return this->Entries.front();
    }
    const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
      [&](const Entry& entry) { return entry.Name == name; });
    if (found != this->Entries.end())
    {
      return *found;
    }
    std::string some;
    for (std::size_t k = 0; k < std::min<std::size_t>(3, this->Entries.size()); ++k)
    {
      some += (k ? ", " : "") + ToPrintable(this->Entries[k].Name, LongestName);
    }
    throw FileError(this->Path + ": " + FitFormatName + ": " +
                    (name.empty() ? "choose one with #name" : "no material " + Quote(name)) +
                    " among its " + std::to_string(this->Entries.size()) + " materials (" + some +
                    (this->Entries.size() > 3 ? ", ...)" : ")"));
  }

  std::string Path;
  std::string Comments;
  std::vector<Entry> Entries;
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
  [](const FileBytes& file, const std::string& name)
  { return FitFile(file.GetPath(), file.GetView()).GetMaterial(name); },
  [](const FileBytes& file) { return FitFile(file.GetPath(), file.GetView()).GetNames(); } };
} // namespace measuredbrdf
