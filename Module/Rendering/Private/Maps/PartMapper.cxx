// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartMapper.h"

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
  const bool mixed = this->Part.Kind != MixtureKind::Single;
  this->Text = mixed ? std::make_unique<MixtureShader>(this->Part, this->ImageComponents) : nullptr;
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
  for (std::size_t k = 0; mixed && k < this->Text->GetAttributes().size(); ++k)
  {
    const char* name = this->Text->GetAttributes()[k].first.c_str();
    this->MapDataArrayToVertexAttribute(name, name, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
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
  if (this->Text && !this->Part.Members.empty() && !this->Drawing->GetMaterials().empty())
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
  MixtureText text;
  for (std::size_t member : chosen)
  {
    drawn[member] = true;
    if (this->Part.Kind != MixtureKind::Nearest)
    {
      text.Slots.push_back(static_cast<int>(member));
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
  text.Declarations = this->Text->GetDeclarations();
  text.Implementation = this->Text->GetImplementation(drawn);
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
    for (const auto& [name, type] : this->Text->GetAttributes())
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
      add(vtkShader::Fragment, "Dec", this->Text->GetDeclarations());
      add(vtkShader::Fragment, "Impl", this->Text->GetImplementation({}));
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
} // namespace measuredbrdf
