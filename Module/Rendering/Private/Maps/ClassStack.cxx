// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassStack.h"

#include "StackedTerms.h"
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
constexpr const char* Number = "brdfMaterial"; // in GLSL

// A form is empty where a material has none.
template <typename GetForm>
std::vector<vtkBRDFShaderInputs> GetForms(const DrawnMaterials& materials, const GetForm& getForm)
{
  std::vector<vtkBRDFShaderInputs> forms(materials.size());
  for (std::size_t k = 0; k < materials.size(); ++k)
  {
    if (!getForm(*materials[k], forms[k]))
    {
      return {};
    }
  }
  return forms;
}

std::vector<vtkBRDFShaderInputs> GetMaterialForms(const DrawnMaterials& materials)
{
  return GetForms(materials,
    [](const DrawnMaterial& drawn, vtkBRDFShaderInputs& form)
    {
      if (drawn.Material)
      {
        form.SoftLights = drawn.Integrator && drawn.Integrator->UsesSoftLights();
        drawn.BRDF->GetShaderInputs(form);
      }
      return true;
    });
}

// None at all where one cannot be had any more.
std::vector<vtkBRDFShaderInputs> GetRadianceForms(const DrawnMaterials& materials)
{
  return GetForms(materials, [](const DrawnMaterial& drawn, vtkBRDFShaderInputs& form)
    { return !drawn.Radiance || drawn.Integrator->GetShaderInputs(form); });
}

StackNames GetMaterialNames()
{
  return { Number, "brdfMaterialNumbers", "brdfMaterialHere",
    { { "brdfTerm", "vec3 i, vec3 o", "i, o" },
      { "brdfTermSoft", "vec3 i, vec3 o, float spread", "i, o, spread" } } };
}

StackNames GetRadianceNames()
{
  return { Number, "brdfRadianceNumbers", "brdfRadianceHere",
    { { "brdfEnvironment", "mat3 frame, vec3 o", "frame, o" } } };
}
}

std::string ClassStack::GetKey(const DrawnMaterial& drawn)
{
  return std::to_string(reinterpret_cast<std::uintptr_t>(drawn.Environment.Get())) +
         (drawn.BRDF->IsIsotropic() ? "" : "/anisotropic");
}

std::string ClassStack::GetKind(const DrawnMaterial& drawn)
{
  return drawn.Key + "/" + (drawn.Material ? "material" : "") + (drawn.Radiance ? "/radiance" : "");
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

bool ClassStack::StackForms(const DrawnMaterials& materials, vtkOpenGLRenderWindow* window)
{
  const std::vector<vtkBRDFShaderInputs> materialForms = GetMaterialForms(materials);
  const std::vector<vtkBRDFShaderInputs> radianceForms = GetRadianceForms(materials);
  StackedTerms ofMaterial(GetMaterialNames());
  StackedTerms ofRadiance(GetRadianceNames());
  ofMaterial.Align(materialForms);
  ofRadiance.Align(radianceForms);
  const std::array<int, 2> mostTexels = { vtkTextureObject::GetMaximumTextureSize(window),
    vtkTextureObject::GetMaximumTextureSize3D(window) };
  this->Samplers = ofMaterial.CountSamplers() + ofRadiance.CountSamplers();
  if (radianceForms.empty() || !CheckTextureUnits(this->Samplers, window).empty() ||
      !ofMaterial.Stack(mostTexels) || !ofRadiance.Stack(mostTexels))
  {
    return false;
  }
  const auto upload = [&](StackedTerms& terms, std::shared_ptr<FormTextures>& textures)
  {
    this->Choice += terms.GetLoad();
    for (const vtkBRDFShaderInputs::Term& term : terms.GetForm().Terms)
    {
      this->Drawn.Key += term.Source;
    }
    textures = std::make_shared<FormTextures>(false);
    return textures->Set(std::move(terms.GetForm()), window).empty();
  };
  const auto have = [&materials](std::shared_ptr<FormTextures> DrawnMaterial::*textures)
  {
    return std::any_of(materials.begin(), materials.end(),
      [textures](const DrawnMaterial* drawn) { return drawn->*textures != nullptr; });
  };
  return (!have(&DrawnMaterial::Material) || upload(ofMaterial, this->Drawn.Material)) &&
         (!have(&DrawnMaterial::Radiance) || upload(ofRadiance, this->Drawn.Radiance));
}

bool ClassStack::Fits(vtkOpenGLRenderWindow* window) const
{
  return CheckTextureUnits(this->Samplers, window).empty() &&
         (!this->Drawn.Material || this->Drawn.Material->IsIn(window)) &&
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
  this->Drawn.IsReady = this->StackForms(materials, window);
  // Two stacks of the same text but for their classes have programs of their own.
  this->Drawn.Key += this->Declarations + this->Choice;
  return this->Drawn.IsReady;
}
} // namespace measuredbrdf
