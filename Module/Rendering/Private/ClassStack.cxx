// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassStack.h"

#include "ReplacedText.h"
#include "StackedTables.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace measuredbrdf
{
namespace
{
using Term = vtkBRDFShaderInputs::Term;
using Texture = vtkBRDFShaderInputs::Texture;
using Uniform = vtkBRDFShaderInputs::Uniform;

constexpr const char* Number = "brdfMaterial"; // in GLSL

bool AreEqual(const Texture& a, const Texture& b)
{
  return a.Dimensions == b.Dimensions && a.Data == b.Data && a.SharedExponents == b.SharedExponents;
}

// Sizes may differ.
bool AreOfOneFormat(const Texture& a, const Texture& b)
{
  return a.Name == b.Name && a.ThreeD == b.ThreeD && a.Components == b.Components &&
         a.HalfFloat == b.HalfFloat && a.Repeat == b.Repeat &&
         a.SharedExponents.empty() == b.SharedExponents.empty();
}

// Numbers that differ, a texel each.
class Numbers
{
public:
  /// names: of the texture, and of the global variable with the material's number.
  explicit Numbers(const StackNames& names)
    : Names(names)
  {
  }

  /// values: of each material, one or three.
  void Add(const std::string& name, std::vector<std::vector<float>> values)
  {
    const std::string type = values.front().size() == 1 ? "float " : "vec3 ";
    this->Declarations += type + name + "INSTANCE;\n";
    this->Load += "  " + name + "INSTANCE = texelFetch(" + this->Names.Texture +
                  "INSTANCE, ivec2(" + std::to_string(this->Columns.size()) + ", " +
                  this->Names.Number + "), 0)." + (values.front().size() == 1 ? "r" : "rgb") +
                  ";\n";
    this->Columns.push_back(std::move(values));
  }

  bool Finish(std::size_t materials, int mostTexels, Term& stacked)
  {
    if (this->Columns.empty())
    {
      return true;
    }
    Texture texture;
    texture.Name = this->Names.Texture;
    texture.Components = 4;
    texture.Dimensions = { static_cast<int>(this->Columns.size()), static_cast<int>(materials), 1 };
    for (std::size_t k = 0; k < materials; ++k)
    {
      for (const std::vector<std::vector<float>>& column : this->Columns)
      {
        std::vector<float> texel = column[k];
        texel.resize(4, 0.0f);
        texture.Data.insert(texture.Data.end(), texel.begin(), texel.end());
      }
    }
    this->Declarations += "uniform sampler2D " + this->Names.Texture + "INSTANCE;\n";
    const bool fits = std::max(texture.Dimensions[0], texture.Dimensions[1]) <= mostTexels;
    stacked.Textures.push_back(std::move(texture));
    return fits;
  }

  std::string Declarations;
  std::string Load;

private:
  const StackNames& Names;
  std::vector<std::vector<std::vector<float>>> Columns;
};

// Tables that differ, in one texture.
bool StackTextures(const std::vector<const Term*>& terms, const std::array<int, 2>& mostTexels,
  Term& stacked, std::string& readers, Numbers& numbers)
{
  for (std::size_t k = 0; k < terms.front()->Textures.size(); ++k)
  {
    const Texture& first = terms.front()->Textures[k];
    std::vector<const Texture*> tables;
    for (const Term* term : terms)
    {
      if (!AreOfOneFormat(term->Textures[k], first))
      {
        return false;
      }
      tables.push_back(&term->Textures[k]);
    }
    if (std::all_of(tables.begin(), tables.end(),
          [&first](const Texture* table) { return AreEqual(*table, first); }))
    {
      stacked.Textures.push_back(first);
      continue;
    }
    StackedTables together;
    if (!together.Arrange(tables, mostTexels[first.ThreeD ? 1 : 0]) ||
        !together.UseReaders(stacked.Source, readers))
    {
      return false;
    }
    stacked.Textures.push_back(together.Fill());
    for (StackedTables::Number& where : together.GetNumbers())
    {
      numbers.Add(where.Name, std::move(where.Values));
    }
  }
  return true;
}

bool StackUniforms(const std::vector<const Term*>& terms, Term& stacked, Numbers& numbers)
{
  for (std::size_t k = 0; k < terms.front()->Uniforms.size(); ++k)
  {
    const Uniform& first = terms.front()->Uniforms[k];
    std::vector<std::vector<float>> values;
    for (const Term* term : terms)
    {
      if (term->Uniforms[k].Name != first.Name ||
          term->Uniforms[k].Values.size() != first.Values.size())
      {
        return false;
      }
      values.push_back(term->Uniforms[k].Values);
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
    numbers.Add(first.Name, std::move(values));
  }
  return true;
}
}

bool StackTerms(const std::vector<const Term*>& terms, const StackNames& names,
  const std::array<int, 2>& mostTexels, Term& stacked, std::string& load)
{
  const Term& first = *terms.front();
  const bool alike = std::all_of(terms.begin(), terms.end(),
    [&first](const Term* term)
    {
      return term->Source == first.Source && term->SoftSource == first.SoftSource &&
             term->Textures.size() == first.Textures.size() &&
             term->Uniforms.size() == first.Uniforms.size() &&
             std::equal(term->Constants.begin(), term->Constants.end(), first.Constants.begin(),
               first.Constants.end(),
               [](const auto& a, const auto& b) { return a.Name == b.Name && a.Value == b.Value; });
    });
  if (!alike)
  {
    return false;
  }
  stacked.Shader = first.Shader;
  stacked.IsTested = first.IsTested;
  // Both texts in one, which may use all samplers: constants in it are replaced here.
  stacked.Source = first.Source + first.SoftSource;
  for (const vtkBRDFShaderInputs::Constant& constant : first.Constants)
  {
    ReplaceAll(stacked.Source, constant.Name, constant.Value);
  }
  Numbers numbers(names);
  std::string readers;
  if (!StackTextures(terms, mostTexels, stacked, readers, numbers) ||
      !StackUniforms(terms, stacked, numbers) ||
      !numbers.Finish(terms.size(), mostTexels[0], stacked))
  {
    return false;
  }
  load = numbers.Load;
  stacked.Source = numbers.Declarations + readers + stacked.Source;
  return true;
}

std::string ClassStack::GetKey(const DrawnMaterial& drawn)
{
  return drawn.Key + "/" +
         std::to_string(reinterpret_cast<std::uintptr_t>(drawn.Environment.Get())) + "/" +
         (drawn.Material ? "material" : "") + (drawn.Radiance ? "/radiance" : "");
}

std::string ClassStack::GetShape(const DrawnMaterial& drawn)
{
  std::string shape;
  for (const auto& textures : { drawn.Material, drawn.Radiance })
  {
    shape += textures ? "/" + textures->GetShape() : "/";
  }
  return shape;
}

bool ClassStack::BuildForm(const DrawnMaterials& materials, const GetForm& getForm,
  const StackNames& names, vtkOpenGLRenderWindow* window, std::shared_ptr<FormTextures>& textures)
{
  std::vector<vtkBRDFShaderInputs> forms(materials.size());
  for (std::size_t k = 0; k < materials.size(); ++k)
  {
    if (!getForm(*materials[k], forms[k]) || forms[k].Terms.size() != forms.front().Terms.size())
    {
      return false;
    }
  }
  const std::array<int, 2> mostTexels = { vtkTextureObject::GetMaximumTextureSize(window),
    vtkTextureObject::GetMaximumTextureSize3D(window) };
  vtkBRDFShaderInputs stacked;
  for (std::size_t term = 0; term < forms.front().Terms.size(); ++term)
  {
    std::vector<const Term*> terms;
    for (const vtkBRDFShaderInputs& form : forms)
    {
      terms.push_back(&form.Terms[term]);
    }
    stacked.Terms.emplace_back();
    std::string load;
    if (!StackTerms(terms, names, mostTexels, stacked.Terms.back(), load))
    {
      return false;
    }
    ReplaceAll(load, "INSTANCE", std::to_string(term));
    this->Choice += load;
  }
  for (const Term& term : stacked.Terms)
  {
    this->Drawn.Key += term.Source;
  }
  textures = std::make_shared<FormTextures>(false);
  return textures->Set(std::move(stacked), window).empty();
}

bool ClassStack::IsIn(vtkOpenGLRenderWindow* window) const
{
  return (!this->Drawn.Material || this->Drawn.Material->IsIn(window)) &&
         (!this->Drawn.Radiance || this->Drawn.Radiance->IsIn(window));
}

bool ClassStack::Build(const DrawnMaterials& materials, int firstClass,
  const std::vector<int>& numbers, bool hasOthers, vtkOpenGLRenderWindow* window)
{
  this->Declarations = std::string("int ") + Number + " = 0;\n";
  this->Choice = std::string("  ") + Number + " = int(brdfClassHere + 0.5) - " +
                 std::to_string(firstClass) + ";\n";
  if (hasOthers)
  {
    this->Choice += std::string("  if (") + Number + " < 0 || " + Number +
                    " >= " + std::to_string(numbers.size()) + ")\n  {\n    discard;\n  }\n";
  }
  if (numbers.size() > materials.size()) // classes of other materials lie between
  {
    std::string list;
    for (int number : numbers)
    {
      list += (list.empty() ? "" : ", ") + std::to_string(number);
    }
    const std::string type = "int[" + std::to_string(numbers.size()) + "]";
    this->Declarations += "const " + type + " brdfMaterials = " + type + "(" + list + ");\n";
    this->Choice += std::string("  ") + Number + " = brdfMaterials[" + Number + "];\n";
    this->Choice +=
      hasOthers ? std::string("  if (") + Number + " < 0)\n  {\n    discard;\n  }\n" : "";
  }
  const DrawnMaterial& first = *materials.front();
  this->Drawn.Source = first.Source;
  this->Drawn.BRDF = first.BRDF;
  this->Drawn.Environment = first.Environment;
  this->Drawn.Key = "stack/";
  if (first.Material)
  {
    const bool soft = first.Integrator && first.Integrator->UsesSoftLights();
    const auto getForm = [soft](const DrawnMaterial& drawn, vtkBRDFShaderInputs& form)
    {
      form.SoftLights = soft;
      drawn.BRDF->GetShaderInputs(form);
      return true;
    };
    if (!this->BuildForm(
          materials, getForm, { Number, "brdfMaterialNumbers" }, window, this->Drawn.Material))
    {
      return false;
    }
  }
  if (first.Radiance)
  {
    const auto getForm = [](const DrawnMaterial& drawn, vtkBRDFShaderInputs& form)
    { return drawn.Integrator->GetShaderInputs(form); };
    if (!this->BuildForm(
          materials, getForm, { Number, "brdfRadianceNumbers" }, window, this->Drawn.Radiance))
    {
      return false;
    }
  }
  std::size_t samplers = 0;
  for (const auto& textures : { this->Drawn.Material, this->Drawn.Radiance })
  {
    samplers += textures ? textures->GetNumberOfSamplers() : 0;
  }
  // Two stacks of the same text but for their classes have programs of their own.
  this->Drawn.Key += this->Declarations + this->Choice;
  this->Drawn.IsReady = CheckTextureUnits(samplers, window).empty();
  return this->Drawn.IsReady;
}
} // namespace measuredbrdf
