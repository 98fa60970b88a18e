// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartMapper.h"

#include "PartSurfaces.h"
#include "PolygonMaterials.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyData.h"

#include <numeric>

namespace measuredbrdf
{
vtkStandardNewMacro(PartMapper);

namespace
{
using partarrays::WeightsPerGroup;

// In the fragment shader. The superclass renames it where there is a geometry shader.
std::string VaryingOf(const std::string& attribute) { return attribute + "VCVSOutput"; }

std::string Weight(int slot) { return "brdfWeights[" + std::to_string(slot) + "]"; }

std::string Texel(std::size_t image) { return "brdfTexel" + std::to_string(image); }

// Vertex attributes of a part's weights: their names, which are also those of the part's point
// arrays, and their types in GLSL.
std::vector<std::pair<std::string, std::string>> GetAttributes(const MaterialPart& part)
{
  std::vector<std::pair<std::string, std::string>> attributes;
  switch (part.Kind)
  {
    case MixtureKind::Single:
      break;
    case MixtureKind::Value:
      attributes.emplace_back(partarrays::Value, "float");
      break;
    case MixtureKind::Images:
      attributes.emplace_back(partarrays::Coordinates, "vec2");
      break;
    default:
      for (int first = 0; first < part.NumberOfWeights; first += WeightsPerGroup)
      {
        attributes.emplace_back(partarrays::GetWeights(first / WeightsPerGroup), "vec4");
      }
  }
  return attributes;
}
}

void PartMapper::SetPart(const MaterialParts* parts, MaterialPart part, vtkMaterialMap* map)
{
  this->Parts = parts;
  this->Part = std::move(part);
  if (this->Part.Kind != MixtureKind::Images || this->Map != map)
  {
    this->Images = nullptr;
    this->ImagesOf.Clear();
  }
  this->Map = map;
  this->ImageComponents.clear();
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    this->ImageComponents.push_back(map->GetWeightImage(k)->GetNumberOfScalarComponents());
  }
  this->Attributes = GetAttributes(this->Part);
  this->Uses.clear();
  for (vtkBRDF* brdf : this->Part.Members)
  {
    this->Uses.emplace_back(brdf, parts->GetSurfaces(brdf));
  }
  if (this->Uses.empty())
  {
    this->Uses.push_back({ nullptr, {} });
  }
  this->SetInputDataObject(this->Part.Surface);
  for (const auto& [name, type] : this->Attributes)
  {
    this->MapDataArrayToVertexAttribute(
      name.c_str(), name.c_str(), vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  }
}

void PartMapper::RenderPieceDraw(vtkRenderer* ren, vtkActor* actor)
{
  const bool images = this->Part.Kind == MixtureKind::Images;
  if (images)
  {
    auto* window = vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow());
    this->Images = WeightTextures::Find(this->Map, window);
    this->ImagesOf[window] = this->Images; // they stay while other windows are drawn
    const std::string problem = this->Images->Update(this->Map, window);
    if (!problem.empty())
    {
      if (this->Drawing->WarnOnce(problem))
      {
        vtkErrorWithObjectMacro(
          this->Drawing->GetOwner(), << "The material map is not drawn: " << problem << ".");
      }
      return;
    }
    this->Images->Activate();
  }
  if (!this->Attributes.empty() && !this->Part.Members.empty() &&
      !this->Drawing->GetMaterials().empty())
  {
    this->DrawMixture(ren, actor);
  }
  else
  {
    this->Superclass::RenderPieceDraw(ren, actor);
  }
  if (images)
  {
    this->Images->Deactivate();
  }
}

// Those whose textures fit into the units together, of the largest shares of the surface.
std::vector<std::size_t> PartMapper::ChooseMembers(vtkRenderer* ren)
{
  const std::vector<DrawnMaterial>& materials = this->Drawing->GetMaterials();
  std::vector<std::size_t> order(materials.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [this](std::size_t a, std::size_t b)
    {
      return this->Parts->GetShare(this->Part.Members[a]) >
             this->Parts->GetShare(this->Part.Members[b]);
    });
  std::size_t free = CountTextureUnits(vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow()));
  std::vector<std::size_t> chosen;
  for (std::size_t member : order)
  {
    std::size_t samplers = 0;
    for (const auto& textures : { materials[member].Material, materials[member].Radiance })
    {
      samplers += textures ? textures->GetNumberOfSamplers() : 0;
    }
    if (samplers > free)
    {
      break;
    }
    free -= samplers;
    chosen.push_back(member);
  }
  if (chosen.size() < materials.size() && this->Drawing->WarnOnce("units of a mixture"))
  {
    vtkWarningWithObjectMacro(this->Drawing->GetOwner(),
      << "Up to " << materials.size() << " materials meet on a part of the surface, more than the "
      << "graphics card's texture units suffice for: the " << chosen.size()
      << " that cover most are mixed there.");
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

void PartMapper::DrawMixture(vtkRenderer* ren, vtkActor* actor)
{
  const std::vector<std::size_t> chosen = this->ChooseMembers(ren);
  std::vector<bool> drawn(this->Part.Members.size(), false);
  std::vector<int> slots;
  for (std::size_t member : chosen)
  {
    drawn[member] = true;
    if (this->Part.Kind != MixtureKind::Nearest)
    {
      slots.push_back(static_cast<int>(member));
    }
  }
  // Hats of those that are drawn: they end at the next one of these.
  std::vector<double> knots;
  for (std::size_t k = 0; k < chosen.size() && !this->Part.Knots.empty(); ++k)
  {
    knots.push_back(this->Part.Knots[chosen[k]]);
  }
  this->Hats.clear();
  for (std::size_t k = 0; k < knots.size(); ++k)
  {
    this->Hats.emplace_back(chosen[k], MakeHat(knots, k));
  }
  MixtureText text = this->MakeMixtureText(drawn);
  text.Slots = std::move(slots);
  this->Drawing->SelectMixture(chosen, std::move(text));
  this->vtkOpenGLPolyDataMapper::RenderPieceDraw(ren, actor);
  this->Drawing->Unselect();
}

// Whether the superclass draws the pixels of polygons where a material is not.
bool PartMapper::IsOthers(const vtkOpenGLHelper* cellBO)
{
  return (this->Part.IsRest || this->GetSlot() >= 0) && !this->UsesMaterial(cellBO) &&
         cellBO == &this->Primitives[PrimitiveTris];
}

// Vertices and lines do not, nor does what is drawn for a selection.
bool PartMapper::NeedsWeights(const vtkOpenGLHelper* cellBO)
{
  return this->HasWeights() && (this->UsesMaterial(cellBO) || this->IsOthers(cellBO));
}

// The weights go through the shader stages beside the positions, as tangents do.
void PartMapper::ReplaceShaderPositionVC(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor)
{
  const auto add = [&shaders](
                     vtkShader::Type stage, const std::string& place, const std::string& text)
  {
    std::string source = shaders[stage]->GetSource();
    const std::string mark = "//VTK::PositionVC::" + place;
    vtkShaderProgram::Substitute(source, mark, mark + "\n" + text, false);
    shaders[stage]->SetSource(source);
  };
  if (this->NeedsWeights(this->LastBoundBO))
  {
    for (const auto& [name, type] : this->Attributes)
    {
      const std::string vertex = name + "VCVSOutput";
      const std::string geometry = name + "VCGSOutput";
      add(vtkShader::Vertex, "Dec",
        "in " + type + " " + name + ";\nout " + type + " " + vertex + ";\n");
      add(vtkShader::Vertex, "Impl", "  " + vertex + " = " + name + ";\n");
      add(vtkShader::Geometry, "Dec",
        "in " + type + " " + vertex + "[];\nout " + type + " " + geometry + ";\n");
      add(vtkShader::Geometry, "Impl", "  " + geometry + " = " + vertex + "[i];\n");
    }
    if (this->IsOthers(this->LastBoundBO))
    {
      const MixtureText text = this->MakeMixtureText({});
      add(vtkShader::Fragment, "Dec", text.Declarations);
      add(vtkShader::Fragment, "Impl", text.Implementation);
    }
  }
  this->Superclass::ReplaceShaderPositionVC(shaders, ren, actor);
}

void PartMapper::SetPropertyShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  this->Superclass::SetPropertyShaderParameters(cellBO, ren, actor);
  if (this->Style)
  {
    cellBO.Program->SetUniformf("opacityUniform", static_cast<float>(this->Style->Opacity));
    cellBO.Program->SetUniform3f("ambientColorUniform", this->Style->AmbientColor);
    cellBO.Program->SetUniform3f("diffuseColorUniform", this->Style->DiffuseColor);
  }
}

void PartMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, ren, actor);
  if (this->Style && this->Style->OverridesColor && this->UsesMaterial(&cellBO) &&
      this->Drawing->GetSettings().ScalarColoringMode != 0)
  {
    cellBO.Program->SetUniformi("brdfModulate", 2);
  }
  if (!this->NeedsWeights(&cellBO))
  {
    return;
  }
  for (const auto& [member, hat] : this->Hats)
  {
    cellBO.Program->SetUniform4f(("brdfHat" + std::to_string(member)).c_str(), hat.data());
  }
  if (this->GetSlot() >= 0)
  {
    cellBO.Program->SetUniformi("brdfSlot", this->GetSlot());
  }
  if (this->Part.IsBand)
  {
    cellBO.Program->SetUniform2f("brdfBand", this->Part.Band.data());
  }
  if (this->Images)
  {
    this->Images->SetUniforms(cellBO.Program);
  }
}

std::string PartMapper::GetWeightDeclarations() const
{
  std::string text;
  for (const auto& [name, type] : this->Attributes)
  {
    text += "in " + type + " " + VaryingOf(name) + ";\n";
  }
  for (std::size_t k = 0; k < this->Part.Knots.size(); ++k)
  {
    text += "uniform vec4 brdfHat" + std::to_string(k) + ";\n";
  }
  text += this->Part.IsBand ? "uniform vec2 brdfBand;\n" : "";
  for (std::size_t k = 0;
       this->Part.Kind == MixtureKind::Images && k < this->ImageComponents.size(); ++k)
  {
    text += "uniform sampler2D " + WeightTextures::GetSampler(k) + ";\n";
  }
  if (this->Part.Kind == MixtureKind::Nearest)
  {
    return text + "uniform int brdfSlot;\n";
  }
  return text + "float brdfWeights[" + std::to_string(this->Part.NumberOfWeights) + "];\n";
}

// Of a slot, before all are divided by their sum.
std::string PartMapper::GetWeightText(int slot) const
{
  const std::string number = std::to_string(slot);
  switch (this->Part.Kind)
  {
    case MixtureKind::Value:
      return "clamp(min(brdfHat" + number + ".x + brdfHat" + number + ".y * brdfAt, brdfHat" +
             number + ".z + brdfHat" + number + ".w * brdfAt), 0.0, 1.0)";
    case MixtureKind::Images:
    {
      const auto place = static_cast<std::size_t>(slot);
      int component = place < this->Part.Components.size() ? this->Part.Components[place] : -1;
      std::size_t image = 0;
      while (component >= 0 && component >= this->ImageComponents[image])
      {
        component -= this->ImageComponents[image++];
      }
      return component < 0 ? "0.0" : Texel(image) + "[" + std::to_string(component) + "]";
    }
    default:
      return VaryingOf(partarrays::GetWeights(slot / WeightsPerGroup)) + "[" +
             std::to_string(slot % WeightsPerGroup) + "]";
  }
}

// C++ twins: vtkMaterialMap::GetWeight and linear interpolation.
MixtureText PartMapper::MakeMixtureText(const std::vector<bool>& drawn) const
{
  return { this->GetWeightDeclarations(), this->GetWeightCode(drawn), {} };
}

std::string PartMapper::GetWeightCode(const std::vector<bool>& drawn) const
{
  if (this->Part.Kind == MixtureKind::Nearest)
  {
    // Of several weights that are the largest the first one counts, so that each pixel is of one
    // part.
    std::string nearest =
      "  int brdfNearest = 0;\n  float brdfMost = " + this->GetWeightText(0) + ";\n";
    for (int slot = 1; slot < this->Part.NumberOfWeights; ++slot)
    {
      const std::string weight = this->GetWeightText(slot);
      nearest += "  brdfNearest = " + weight + " > brdfMost ? " + std::to_string(slot) +
                 " : brdfNearest;\n  brdfMost = max(brdfMost, " + weight + ");\n";
    }
    return nearest + "  if (brdfNearest != brdfSlot)\n  {\n    discard;\n  }\n";
  }
  const int count = this->Part.NumberOfWeights;
  std::string text;
  if (this->Part.Kind == MixtureKind::Value)
  {
    text += "  float brdfAt = " + VaryingOf(partarrays::Value) + ";\n";
    text += this->Part.IsBand
              ? "  if (brdfAt < brdfBand.x || brdfAt >= brdfBand.y)\n  {\n    discard;\n  }\n"
              : "";
  }
  for (std::size_t k = 0;
       this->Part.Kind == MixtureKind::Images && k < this->ImageComponents.size(); ++k)
  {
    text += "  vec4 " + Texel(k) + " = texture(" + WeightTextures::GetSampler(k) + ", " +
            VaryingOf(partarrays::Coordinates) + ");\n";
  }
  std::string sum = "0.0";
  int others = -1; // the material where no other has a weight
  for (int slot = 0; slot < count; ++slot)
  {
    const auto place = static_cast<std::size_t>(slot);
    const bool given = place >= drawn.size() || drawn[place];
    const bool ofImages = this->Part.Kind == MixtureKind::Images;
    const bool isOthers =
      ofImages && (place >= this->Part.Components.size() || this->Part.Components[place] < 0);
    others = given && (isOthers || others < 0) ? slot : others;
    text += "  " + Weight(slot) + " = " + (given ? this->GetWeightText(slot) : "0.0") + ";\n";
    sum += " + " + Weight(slot);
  }
  text += "  float brdfSum = " + sum + ";\n";
  for (int slot = 0; slot < count; ++slot)
  {
    text += "  " + Weight(slot) + " = brdfSum > 0.0 ? " + Weight(slot) +
            " / brdfSum : " + (slot == others ? "1.0" : "0.0") + ";\n";
  }
  if (this->Part.HasRest || this->Part.IsRest)
  {
    text += "  if (" + Weight(count - 1) + (this->Part.HasRest ? " > 0.0" : " <= 0.0") +
            ")\n  {\n    discard;\n  }\n";
  }
  return text;
}
} // namespace measuredbrdf
