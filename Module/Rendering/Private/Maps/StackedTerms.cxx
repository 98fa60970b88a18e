// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StackedTerms.h"

#include "ReplacedText.h"
#include "StackNumbers.h"
#include "StackedTables.h"

#include <algorithm>
#include <map>

namespace measuredbrdf
{
namespace
{
using Term = vtkBRDFShaderInputs::Term;
using Texture = vtkBRDFShaderInputs::Texture;
using Uniform = vtkBRDFShaderInputs::Uniform;

bool AreEqual(const Texture& a, const Texture& b)
{
  return a.Dimensions == b.Dimensions && a.Data == b.Data && a.SharedExponents == b.SharedExponents;
}

// Of the same kind: they differ in sizes of tables and in numbers only.
std::string GetKind(const Term& term)
{
  std::string kind = term.Source + "\n/" + term.SoftSource;
  for (const vtkBRDFShaderInputs::Constant& constant : term.Constants)
  {
    kind += "\n/" + constant.Name + "=" + constant.Value;
  }
  for (const Uniform& uniform : term.Uniforms)
  {
    kind += "\n/" + uniform.Name + std::to_string(uniform.Values.size());
  }
  for (const Texture& texture : term.Textures)
  {
    kind += "\n/" + texture.Name + std::to_string(texture.Components);
    for (bool is : { texture.ThreeD, texture.HalfFloat, !texture.SharedExponents.empty(),
           texture.Repeat[0], texture.Repeat[1], texture.Repeat[2] })
    {
      kind += is ? "+" : "-";
    }
  }
  return kind;
}

std::vector<std::size_t> GetMaterials(const std::vector<const Term*>& terms)
{
  std::vector<std::size_t> materials;
  for (std::size_t k = 0; k < terms.size(); ++k)
  {
    if (terms[k])
    {
      materials.push_back(k);
    }
  }
  return materials;
}
}

void StackedTerms::Align(const std::vector<vtkBRDFShaderInputs>& forms)
{
  this->Aligned.clear();
  std::map<std::pair<std::string, int>, std::size_t> places;
  for (std::size_t k = 0; k < forms.size(); ++k)
  {
    std::map<std::string, int> before; // a material may have several of a kind
    for (const Term& term : forms[k].Terms)
    {
      const std::string kind = GetKind(term);
      const auto [place, isNew] =
        places.try_emplace({ kind, before[kind]++ }, this->Aligned.size());
      if (isNew)
      {
        this->Aligned.emplace_back(forms.size(), nullptr);
      }
      this->Aligned[place->second][k] = &term;
    }
  }
}

std::size_t StackedTerms::CountSamplers() const
{
  std::size_t samplers = this->Aligned.empty() ? 0 : 1; // numbers
  for (const Terms& terms : this->Aligned)
  {
    samplers += terms[GetMaterials(terms).front()]->Textures.size();
  }
  return samplers;
}

bool StackedTerms::Stack(const std::array<int, 2>& mostTexels)
{
  this->Form = {};
  this->Load.clear();
  if (this->Aligned.empty())
  {
    return true;
  }
  StackNumbers numbers(this->Names.Texture, this->Names.Number, this->Aligned.front().size());
  for (const Terms& terms : this->Aligned)
  {
    if (!this->StackTerm(terms, mostTexels, numbers))
    {
      return false;
    }
  }
  return numbers.Finish(mostTexels[0], this->Form.Terms.front());
}

void StackedTerms::AddNumber(const std::string& name, const Terms& terms,
  const std::vector<std::vector<float>>& values, Text& text, StackNumbers& numbers) const
{
  text.Declarations += StackNumbers::Declare(name + "INSTANCE", values.front());
  text.Load += "  " + numbers.Add(name + "INSTANCE", GetMaterials(terms), values);
}

bool StackedTerms::StackTerm(
  const Terms& terms, const std::array<int, 2>& mostTexels, StackNumbers& numbers)
{
  const std::vector<std::size_t> materials = GetMaterials(terms);
  const Term& first = *terms[materials.front()];
  Term stacked;
  stacked.Shader = first.Shader;
  stacked.IsTested = first.IsTested;
  // Both texts in one, which may use all samplers: constants in it are replaced here.
  stacked.Source = first.Source + first.SoftSource;
  for (const vtkBRDFShaderInputs::Constant& constant : first.Constants)
  {
    ReplaceAll(stacked.Source, constant.Name, constant.Value);
  }
  Text text;
  if (!this->StackTextures(terms, mostTexels, stacked, text, numbers) ||
      !this->StackUniforms(terms, stacked, text, numbers))
  {
    return false;
  }
  if (materials.size() < terms.size())
  {
    const std::string here = this->Names.Here + "INSTANCE";
    const std::vector<std::vector<float>> ones(materials.size(), { 1.0f });
    text.Load = "  " + numbers.Add(here, materials, ones) + "  for (int once = 0; once < int(" +
                here + "); ++once)\n  {\n" + text.Load + "  }\n";
    if (!this->SkipElsewhere(stacked, text))
    {
      return false;
    }
  }
  ReplaceAll(text.Load, "INSTANCE", std::to_string(this->Form.Terms.size()));
  this->Load += text.Load;
  stacked.Source = text.Declarations + stacked.Source;
  this->Form.Terms.push_back(std::move(stacked));
  return true;
}

// A loop that may end at once and not a condition: software renderers (Mesa's llvmpipe) run both
// sides of conditions.
bool StackedTerms::SkipElsewhere(Term& stacked, Text& text) const
{
  const std::string here = this->Names.Here + "INSTANCE";
  text.Declarations += "float " + here + ";\n";
  bool any = false;
  for (const StackNames::Function& function : this->Names.Functions)
  {
    const std::string name = function.Name + "INSTANCE";
    const std::string own = function.Name + "HereINSTANCE";
    if (ReplaceAll(stacked.Source, name + "(", own + "(") > 0)
    {
      any = true;
      stacked.Source += "\nvec3 " + name + "(" + function.Parameters +
                        ")\n{\n  vec3 sum = vec3(0.0);\n  for (int once = 0; once < int(" + here +
                        "); ++once)\n  {\n    sum += " + own + "(" + function.Arguments +
                        ");\n  }\n  return sum;\n}\n";
    }
  }
  return any;
}

// Tables that differ, in one texture.
bool StackedTerms::StackTextures(const Terms& terms, const std::array<int, 2>& mostTexels,
  Term& stacked, Text& text, StackNumbers& numbers)
{
  const std::vector<std::size_t> materials = GetMaterials(terms);
  for (std::size_t k = 0; k < terms[materials.front()]->Textures.size(); ++k)
  {
    const Texture& first = terms[materials.front()]->Textures[k];
    std::vector<const Texture*> tables;
    for (std::size_t material : materials)
    {
      tables.push_back(&terms[material]->Textures[k]);
    }
    if (std::all_of(tables.begin(), tables.end(),
          [&first](const Texture* table) { return AreEqual(*table, first); }))
    {
      stacked.Textures.push_back(first);
      continue;
    }
    StackedTables together;
    if (!together.Arrange(tables, mostTexels[first.ThreeD ? 1 : 0]))
    {
      return false;
    }
    std::string readers;
    if (!together.UseReaders(stacked.Source, readers))
    {
      return false;
    }
    stacked.Textures.push_back(together.Fill());
    for (const StackedTables::Number& where : together.GetNumbers())
    {
      this->AddNumber(where.Name, terms, where.Values, text, numbers);
    }
    text.Declarations += readers;
  }
  return true;
}

bool StackedTerms::StackUniforms(
  const Terms& terms, Term& stacked, Text& text, StackNumbers& numbers)
{
  const std::vector<std::size_t> materials = GetMaterials(terms);
  for (std::size_t k = 0; k < terms[materials.front()]->Uniforms.size(); ++k)
  {
    const Uniform& first = terms[materials.front()]->Uniforms[k];
    std::vector<std::vector<float>> values;
    for (std::size_t material : materials)
    {
      values.push_back(terms[material]->Uniforms[k].Values);
    }
    if (std::all_of(values.begin(), values.end(),
          [&first](const std::vector<float>& value) { return value == first.Values; }))
    {
      stacked.Uniforms.push_back(first);
      continue;
    }
    const std::string type = first.Values.size() == 1 ? "float " : "vec3 ";
    if (ReplaceAll(stacked.Source, "uniform " + type + first.Name + "INSTANCE;", "") != 1)
    {
      return false;
    }
    this->AddNumber(first.Name, terms, values, text, numbers);
  }
  return true;
}
} // namespace measuredbrdf
