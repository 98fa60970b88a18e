// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassStack.h"

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

// Of all materials' tables of one kind together; beyond that each material is drawn by itself.
constexpr std::size_t MostBytes = std::size_t(1) << 28;

std::size_t ReplaceAll(std::string& text, const std::string& from, const std::string& to)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
  {
    text.replace(at, from.size(), to);
    ++count;
  }
  return count;
}

std::size_t Count(const std::string& text, const std::string& part)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
  {
    ++count;
  }
  return count;
}

bool AreEqual(const Texture& a, const Texture& b)
{
  return a.Dimensions == b.Dimensions && a.Data == b.Data && a.SharedExponents == b.SharedExponents;
}

bool AreOfOneShape(const Texture& a, const Texture& b)
{
  return a.Name == b.Name && a.Dimensions == b.Dimensions && a.ThreeD == b.ThreeD &&
         a.Components == b.Components && a.HalfFloat == b.HalfFloat && a.Repeat == b.Repeat &&
         a.Data.size() == b.Data.size() && a.SharedExponents.size() == b.SharedExponents.size();
}

// How many tables lie side by side along y and z.
struct Layout
{
  std::size_t Rows = 1;
  std::size_t Slices = 1;
};

bool FindLayout(const Texture& table, std::size_t count, int most, Layout& layout)
{
  const auto side = static_cast<std::size_t>(most);
  const auto fits = [&](std::size_t axis)
  { return table.Repeat[axis] ? 1 : side / static_cast<std::size_t>(table.Dimensions[axis]); };
  const std::size_t slices = table.ThreeD ? fits(2) : 1;
  layout.Rows = std::min(fits(1), count);
  if (layout.Rows == 0)
  {
    return false;
  }
  layout.Slices = (count + layout.Rows - 1) / layout.Rows;
  return layout.Slices <= slices && layout.Rows * layout.Slices * table.GetBytes() <= MostBytes;
}

// Copies one table's values to its place.
template <typename Value>
void Place(const std::vector<Value>& from, const Texture& table, const Layout& layout,
  std::size_t number, std::vector<Value>& to)
{
  const auto height = static_cast<std::size_t>(table.Dimensions[1]);
  const auto depth = static_cast<std::size_t>(table.Dimensions[2]);
  const std::size_t row = from.size() / (height * depth);
  to.resize(from.size() * layout.Rows * layout.Slices);
  const std::size_t y = number % layout.Rows;
  const std::size_t z = number / layout.Rows;
  for (std::size_t slice = 0; slice < depth && row > 0; ++slice)
  {
    const std::size_t first = ((z * depth + slice) * layout.Rows + y) * height * row;
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(slice * height * row), height * row,
      to.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

std::string Float(std::size_t value) { return std::to_string(value) + ".0"; }

// A coordinate's statement: in texels of the table, clamped, then of all tables.
std::string Shift(const char* axis, int size, std::size_t count, const std::string& place)
{
  const auto texels = static_cast<std::size_t>(size);
  return std::string("  p.") + axis + " = (clamp(p." + axis + " * " + Float(texels) + ", 0.5, " +
         Float(texels) + " - 0.5) + " + Float(texels) + " * " + place + ") / " +
         Float(texels * count) + ";\n";
}

// Functions that read the number's table, to be used instead of the sampler.
std::string DeclareReaders(
  const Texture& table, const Layout& layout, const std::string& name, const std::string& number)
{
  const std::string rows = std::to_string(layout.Rows);
  const std::string y = "(" + number + " % " + rows + ")";
  const std::string z = "(" + number + " / " + rows + ")";
  const std::string height = std::to_string(table.Dimensions[1]);
  const std::string coordinates = table.ThreeD ? "vec3" : "vec2";
  std::string text = "vec4 read_" + name + "(" + coordinates + " p)\n{\n";
  text += layout.Rows > 1 ? Shift("y", table.Dimensions[1], layout.Rows, "float" + y) : "";
  text += layout.Slices > 1 ? Shift("z", table.Dimensions[2], layout.Slices, "float" + z) : "";
  text += "  return textureLod(" + name + ", p, 0.0);\n}\n";
  text += "vec4 read_" + name + "(" + coordinates + " p, float lod)\n{\n  return read_" + name +
          "(p);\n}\n";
  if (!table.ThreeD)
  {
    text += "vec4 fetch_" + name + "(ivec2 at, int lod)\n{\n  return texelFetch(" + name +
            ", at + ivec2(0, " + height + " * " + y + "), lod);\n}\n";
    text += "vec4 profile_" + name + "(float at, int row)\n{\n  return brdfProfile(" + name +
            ", at, row + " + height + " * " + y + ");\n}\n";
  }
  return text;
}

// Every use of a sampler becomes one of these functions; whether there is no other use.
bool UseReaders(std::string& text, const Texture& table, const Layout& layout,
  const std::string& number, std::string& declarations)
{
  const std::string name = table.Name + "INSTANCE";
  const std::string type = table.ThreeD ? "sampler3D" : "sampler2D";
  const std::string declaration = "uniform " + type + " " + name + ";";
  const std::size_t declared = text.find(declaration);
  if (declared == std::string::npos)
  {
    return false;
  }
  std::string size = (table.ThreeD ? "ivec3(" : "ivec2(") + std::to_string(table.Dimensions[0]) +
                     ", " + std::to_string(table.Dimensions[1]);
  size += (table.ThreeD ? ", " + std::to_string(table.Dimensions[2]) : "") + ")";
  ReplaceAll(text, "textureSize(" + name + ", 0)", size);
  ReplaceAll(text, "textureLod(" + name + ", ", "read_" + table.Name + "_(");
  ReplaceAll(text, "texture(" + name + ", ", "read_" + table.Name + "_(");
  if (!table.ThreeD)
  {
    ReplaceAll(text, "texelFetch(" + name + ", ", "fetch_" + table.Name + "_(");
    ReplaceAll(text, "brdfProfile(" + name + ", ", "profile_" + table.Name + "_(");
  }
  if (Count(text, name) != 1)
  {
    return false;
  }
  for (const char* use : { "read_", "fetch_", "profile_" })
  {
    ReplaceAll(text, use + table.Name + "_(", use + name + "(");
  }
  ReplaceAll(text, declaration, "");
  declarations += declaration + "\n" + DeclareReaders(table, layout, name, number);
  return true;
}
}

namespace
{
// Tables that differ, in one texture.
bool StackTextures(const std::vector<const Term*>& terms, const std::string& number,
  const std::array<int, 2>& mostTexels, Term& stacked, std::string& declarations)
{
  for (std::size_t k = 0; k < terms.front()->Textures.size(); ++k)
  {
    const Texture& first = terms.front()->Textures[k];
    const auto all = [&](bool (*compare)(const Texture&, const Texture&))
    {
      return std::all_of(terms.begin(), terms.end(),
        [&](const Term* term) { return compare(term->Textures[k], first); });
    };
    if (!all(AreOfOneShape))
    {
      return false;
    }
    stacked.Textures.push_back(first);
    Layout layout;
    if (all(AreEqual))
    {
      continue;
    }
    if (!FindLayout(first, terms.size(), mostTexels[first.ThreeD ? 1 : 0], layout) ||
        !UseReaders(stacked.Source, first, layout, number, declarations))
    {
      return false;
    }
    Texture& texture = stacked.Textures.back();
    texture.Data.clear();
    texture.SharedExponents.clear();
    for (std::size_t j = 0; j < terms.size(); ++j)
    {
      Place(terms[j]->Textures[k].Data, first, layout, j, texture.Data);
      Place(terms[j]->Textures[k].SharedExponents, first, layout, j, texture.SharedExponents);
    }
    texture.Dimensions[1] *= static_cast<int>(layout.Rows);
    texture.Dimensions[2] *= static_cast<int>(layout.Slices);
  }
  return true;
}

// Numbers that differ, a texel each.
bool StackUniforms(const std::vector<const Term*>& terms, const std::string& number,
  const std::array<int, 2>& mostTexels, const std::string& texture, Term& stacked,
  std::string& declarations, std::string& load)
{
  std::vector<std::size_t> differing;
  for (std::size_t k = 0; k < terms.front()->Uniforms.size(); ++k)
  {
    const Uniform& first = terms.front()->Uniforms[k];
    bool same = true;
    for (const Term* term : terms)
    {
      if (term->Uniforms[k].Name != first.Name ||
          term->Uniforms[k].Values.size() != first.Values.size())
      {
        return false;
      }
      same = same && term->Uniforms[k].Values == first.Values;
    }
    if (same)
    {
      stacked.Uniforms.push_back(first);
      continue;
    }
    const std::string name = first.Name + "INSTANCE";
    const std::string type = first.Values.size() == 1 ? "float " : "vec3 ";
    if (ReplaceAll(stacked.Source, "uniform " + type + name + ";", "") != 1)
    {
      return false;
    }
    declarations += type + name + ";\n";
    load += "  " + name + " = texelFetch(" + texture + "INSTANCE, ivec2(" +
            std::to_string(differing.size()) + ", " + number + "), 0)." +
            (first.Values.size() == 1 ? "r" : "rgb") + ";\n";
    differing.push_back(k);
  }
  if (differing.empty())
  {
    return true;
  }
  Texture numbers;
  numbers.Name = texture;
  numbers.Components = 4;
  numbers.Dimensions = { static_cast<int>(differing.size()), static_cast<int>(terms.size()), 1 };
  for (const Term* term : terms)
  {
    for (std::size_t k : differing)
    {
      std::vector<float> texel = term->Uniforms[k].Values;
      texel.resize(4, 0.0f);
      numbers.Data.insert(numbers.Data.end(), texel.begin(), texel.end());
    }
  }
  declarations += "uniform sampler2D " + texture + "INSTANCE;\n";
  stacked.Textures.push_back(std::move(numbers));
  return std::max(stacked.Textures.back().Dimensions[0], stacked.Textures.back().Dimensions[1]) <=
         mostTexels[0];
}
}

bool StackTerms(const std::vector<const Term*>& terms, const std::string& number,
  const std::array<int, 2>& mostTexels, Term& stacked, std::string& load,
  const std::string& numbers)
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
  std::string declarations;
  if (!StackTextures(terms, number, mostTexels, stacked, declarations) ||
      !StackUniforms(terms, number, mostTexels, numbers, stacked, declarations, load))
  {
    return false;
  }
  stacked.Source = declarations + stacked.Source;
  return true;
}

std::string ClassStack::GetKey(const DrawnMaterial& drawn)
{
  std::string key =
    drawn.Key + "/" + std::to_string(reinterpret_cast<std::uintptr_t>(drawn.Environment.Get()));
  for (const auto& textures : { drawn.Material, drawn.Radiance })
  {
    key += textures ? "/" + textures->GetShape() : "/";
  }
  return key;
}

bool ClassStack::BuildForm(const DrawnMaterials& materials, const GetForm& getForm,
  vtkOpenGLRenderWindow* window, std::shared_ptr<FormTextures>& textures)
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
    // Both forms may have a term of that instance.
    const char* numbers =
      &textures == &this->Drawn.Material ? "brdfStackMaterialNumbers" : "brdfStackRadianceNumbers";
    if (!StackTerms(terms, Number, mostTexels, stacked.Terms.back(), load, numbers))
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
    if (!this->BuildForm(materials, getForm, window, this->Drawn.Material))
    {
      return false;
    }
  }
  if (first.Radiance)
  {
    const auto getForm = [](const DrawnMaterial& drawn, vtkBRDFShaderInputs& form)
    { return drawn.Integrator->GetShaderInputs(form); };
    if (!this->BuildForm(materials, getForm, window, this->Drawn.Radiance))
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
