// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartsMapper.h"

#include "vtkActor.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <numeric>

namespace measuredbrdf
{
vtkStandardNewMacro(PartsMapper);

namespace
{
using partarrays::WeightsPerArray;

constexpr std::size_t MostShaders = 64; // plans that change over time leave some behind

// In the fragment shader. VTK's class renames it where there is a geometry shader.
std::string VaryingOf(const std::string& attribute) { return attribute + "VCVSOutput"; }

std::string Weight(int slot) { return "brdfWeights[" + std::to_string(slot) + "]"; }

std::string Texel(std::size_t image) { return "brdfTexel" + std::to_string(image); }

// The triangles as VTK draws them, in the current context.
vtkSmartPointer<vtkOpenGLIndexBufferObject> MakeIndices(vtkPolyData* surface)
{
  std::vector<unsigned int> triangles;
  vtkOpenGLIndexBufferObject::AppendTriangleIndexBuffer(
    triangles, surface->GetPolys(), surface->GetPoints(), 0, nullptr, nullptr);
  auto indices = vtkSmartPointer<vtkOpenGLIndexBufferObject>::New();
  indices->IndexCount = triangles.size();
  if (!triangles.empty())
  {
    indices->Upload(triangles, vtkOpenGLIndexBufferObject::ElementArrayBuffer);
  }
  return indices;
}
}

PartsMapper::PartsMapper()
  : Nothing(vtkSmartPointer<vtkOpenGLIndexBufferObject>::New())
{
  this->Nothing->IndexCount = 0;
}

PartsMapper::~PartsMapper()
{
  this->ReleaseIndices();
  this->InOwnWindow([this]() { this->DropShaders(this->OwnWindow); });
}

// A window that is gone took its objects with it: it had this mapper release them.
template <typename Release>
void PartsMapper::InOwnWindow(const Release& release)
{
  if (this->OwnWindow)
  {
    this->OwnWindow->PushContext();
    release();
    this->OwnWindow->PopContext();
  }
}

void PartsMapper::ReleaseIndices()
{
  this->InOwnWindow(
    [this]()
    {
      for (const Part& part : this->Parts)
      {
        if (part.Indices)
        {
          part.Indices->ReleaseGraphicsResources();
        }
      }
    });
  this->AreBuilt = false;
}

void PartsMapper::SetParts(const MaterialParts* parts, vtkMaterialMap* map, bool colorsOfMap)
{
  this->AreColorsOfMap = colorsOfMap;
  if (this->Map != map)
  {
    this->Images = nullptr;
    this->ImagesOf.Clear();
    this->Map = map;
  }
  this->ImageComponents.clear();
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    this->ImageComponents.push_back(map->GetWeightImage(k)->GetNumberOfScalarComponents());
  }
  // Where only settings have changed, buffers stay.
  if (this->Owner != parts || this->Revision != parts->GetRevision())
  {
    this->ReleaseIndices();
    this->Owner = parts;
    this->Revision = parts->GetRevision();
    this->Parts.clear();
    this->BRDFs = parts->GetBRDFs();
    std::map<vtkBRDF*, std::size_t> places;
    for (std::size_t k = 0; k < this->BRDFs.size(); ++k)
    {
      places[this->BRDFs[k]] = k;
    }
    for (const MaterialPart& data : parts->Get())
    {
      this->Parts.push_back({ data, {}, nullptr, 0 });
      for (vtkBRDF* brdf : data.Members)
      {
        this->Parts.back().Uses.push_back(places[brdf]);
      }
    }
    if (this->BRDFs.empty())
    {
      this->BRDFs.push_back(nullptr);
    }
    this->SetInputDataObject(parts->GetWhole());
  }
  for (const MaterialPart& part : parts->Get())
  {
    for (const auto& [name, type] : this->GetAttributes(part))
    {
      this->MapDataArrayToVertexAttribute(
        name.c_str(), name.c_str(), vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
    }
  }
}

// Vertex attributes of a part's weights: their names and their types in GLSL.
std::vector<std::pair<std::string, std::string>> PartsMapper::GetAttributes(
  const MaterialPart& part) const
{
  std::vector<std::pair<std::string, std::string>> attributes;
  if (part.Kind == MixtureKind::Images)
  {
    attributes.emplace_back(partarrays::Coordinates, "vec2");
  }
  for (int k = 0; part.Kind == MixtureKind::Weights && k * WeightsPerArray < part.NumberOfWeights;
       ++k)
  {
    attributes.emplace_back(partarrays::GetWeights(k), "vec4");
  }
  return attributes;
}

bool PartsMapper::IgnoresScalars()
{
  return this->AreColorsOfMap && this->Shown && !this->Shown->Data.Members.empty();
}

void PartsMapper::BuildIBO(vtkRenderer* ren, vtkActor* actor, vtkPolyData* surface)
{
  this->Superclass::BuildIBO(ren, actor, surface);
  if (this->AreBuilt)
  {
    return;
  }
  this->OwnWindow = vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow());
  // Vertices and lines come first, and each has a number, too.
  int first = static_cast<int>(this->Primitives[PrimitivePoints].IBO->IndexCount +
                               this->Primitives[PrimitiveLines].IBO->IndexCount / 2);
  for (Part& part : this->Parts)
  {
    part.Indices = MakeIndices(part.Data.Surface);
    part.FirstPrimitive = first;
    first += part.Data.HasRest ? 0 : static_cast<int>(part.Indices->IndexCount / 3);
  }
  this->AreBuilt = true;
}

// Negative: all. A number beyond the parts: what no material draws, vertices and lines.
void PartsMapper::ShowOnly(int number)
{
  for (int k = PrimitiveStart; k < PrimitiveEnd; ++k)
  {
    vtkOpenGLHelper& primitive = this->Primitives[k];
    this->Whole[k] = this->Whole[k] ? this->Whole[k] : primitive.IBO;
    primitive.IBO = this->Whole[k];
  }
  this->Shown = nullptr;
  if (number < 0)
  {
    this->Whole.fill(nullptr);
    return;
  }
  if (number >= static_cast<int>(this->Parts.size()))
  {
    this->Primitives[PrimitiveTris].IBO = this->Nothing;
    return;
  }
  for (int k = PrimitiveStart; k < PrimitiveEnd; ++k)
  {
    this->Primitives[k].IBO = this->Nothing;
  }
  this->Shown = &this->Parts[number];
  this->Primitives[PrimitiveTris].IBO = this->Shown->Indices;
  this->PrimitiveIDOffset = this->Shown->FirstPrimitive;
}

bool PartsMapper::ReadyImages(vtkRenderer* ren)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow());
  std::string problem;
  this->Images = FindWeightTextures(this->Map, window, problem);
  this->ImagesOf[window] = this->Images; // they stay while other windows are drawn
  if (!problem.empty())
  {
    this->Drawing->AddFailure("The material map is not drawn: " + problem + ".");
  }
  return problem.empty();
}

void PartsMapper::RenderPieceDraw(vtkRenderer* ren, vtkActor* actor)
{
  const bool images = std::any_of(this->Parts.begin(), this->Parts.end(),
    [](const Part& part) { return part.Data.Kind == MixtureKind::Images; });
  if (images && !this->ReadyImages(ren))
  {
    return;
  }
  const std::vector<DrawnMaterial>& materials = this->Drawing->GetMaterials();
  if (materials.empty())
  {
    this->vtkOpenGLPolyDataMapper::RenderPieceDraw(ren, actor);
    return;
  }
  if (images)
  {
    this->Images->Activate();
  }
  // Those of one shader after the other.
  std::vector<std::pair<std::string, int>> order;
  for (const Part& part : this->Parts)
  {
    std::string key;
    for (std::size_t use : part.Uses)
    {
      key += materials[use].Key + "+";
    }
    order.emplace_back(key, static_cast<int>(order.size()));
  }
  std::sort(order.begin(), order.end());
  for (const auto& [key, number] : order)
  {
    this->ShowOnly(number);
    this->SelectMaterials(this->Parts[number], ren);
    this->vtkOpenGLPolyDataMapper::RenderPieceDraw(ren, actor);
  }
  this->Drawing->Unselect();
  this->ShowOnly(static_cast<int>(this->Parts.size()));
  this->PrimitiveIDOffset = 0;
  this->vtkOpenGLPolyDataMapper::RenderPieceDraw(ren, actor);
  this->ShowOnly(-1);
  if (images)
  {
    this->Images->Deactivate();
  }
  if (this->OtherShaders.size() > MostShaders)
  {
    this->DropShaders(ren->GetVTKWindow());
  }
}

void PartsMapper::SelectMaterials(const Part& part, vtkRenderer* ren)
{
  if (part.Uses.empty())
  {
    this->Drawing->Unselect();
    return;
  }
  if (part.Data.Kind == MixtureKind::Single)
  {
    this->Drawing->Select(part.Uses.front());
    return;
  }
  std::vector<bool> drawn(part.Uses.size(), false);
  std::vector<std::size_t> uses;
  std::vector<int> slots;
  for (std::size_t member : this->ChooseMembers(part, ren))
  {
    drawn[member] = true;
    uses.push_back(part.Uses[member]);
    slots.push_back(static_cast<int>(member));
  }
  MixtureText text = this->MakeMixtureText(part.Data, drawn);
  text.Slots = std::move(slots);
  this->Drawing->SelectMixture(uses, std::move(text));
}

// Those whose textures fit into the units together, of the largest shares of the surface.
std::vector<std::size_t> PartsMapper::ChooseMembers(const Part& part, vtkRenderer* ren)
{
  const std::vector<DrawnMaterial>& materials = this->Drawing->GetMaterials();
  std::vector<std::size_t> order(part.Uses.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    {
      return this->Owner->GetShare(part.Data.Members[a]) >
             this->Owner->GetShare(part.Data.Members[b]);
    });
  std::size_t free = CountTextureUnits(vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow()));
  std::vector<std::size_t> chosen;
  for (std::size_t member : order)
  {
    std::size_t samplers = 0;
    const DrawnMaterial& drawn = materials[part.Uses[member]];
    for (const auto& textures : { drawn.Material, drawn.Radiance })
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
  if (chosen.size() < order.size())
  {
    this->Drawing->WarnOnce(
      "units of a mixture", "Up to " + std::to_string(order.size()) +
                              " materials meet on a part of the surface, more "
                              "than the graphics card's texture units suffice for: the " +
                              std::to_string(chosen.size()) + " that cover most are mixed there.");
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

// VTK's class knows one shader at a time and would make the text of each anew in every frame.
void PartsMapper::UseShadersOf(const std::string& key)
{
  if (key == this->ShadersInUse)
  {
    return;
  }
  std::unique_ptr<vtkOpenGLHelper> other = std::move(this->OtherShaders[key]);
  this->OtherShaders.erase(key);
  if (!other)
  {
    other = std::make_unique<vtkOpenGLHelper>();
  }
  vtkOpenGLHelper& polygons = this->Primitives[PrimitiveTris];
  std::swap(polygons.Program, other->Program);
  std::swap(polygons.VAO, other->VAO);
  std::swap(polygons.ShaderSourceTime, other->ShaderSourceTime);
  std::swap(polygons.AttributeUpdateTime, other->AttributeUpdateTime);
  std::swap(polygons.ShaderChangeValue, other->ShaderChangeValue);
  this->PrimitiveInfo[&polygons];
  this->PrimitiveInfo[other.get()];
  auto first = this->PrimitiveInfo.extract(&polygons); // the values cannot be copied
  auto second = this->PrimitiveInfo.extract(other.get());
  std::swap(first.key(), second.key());
  this->PrimitiveInfo.insert(std::move(first));
  this->PrimitiveInfo.insert(std::move(second));
  std::swap(this->ShaderKeys[&polygons], this->ShaderKeys[other.get()]);
  this->OtherShaders[this->ShadersInUse] = std::move(other);
  this->ShadersInUse = key;
}

void PartsMapper::DropShaders(vtkWindow* window)
{
  for (const auto& [key, helper] : this->OtherShaders)
  {
    helper->ReleaseGraphicsResources(window);
    this->PrimitiveInfo.erase(helper.get());
    this->ShaderKeys.erase(helper.get());
  }
  this->OtherShaders.clear();
}

void PartsMapper::UpdateShaders(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  if (&cellBO == &this->Primitives[PrimitiveTris])
  {
    this->UseShadersOf(this->GetShaderKey(&cellBO) + (this->IsRest(&cellBO) ? "/rest" : ""));
  }
  this->Superclass::UpdateShaders(cellBO, ren, actor);
}

// Whether VTK's class draws the pixels of polygons where no image has a weight.
bool PartsMapper::IsRest(const vtkOpenGLHelper* cellBO) const
{
  return this->Shown && this->Shown->Data.IsRest && cellBO == &this->Primitives[PrimitiveTris];
}

// Vertices and lines do not, nor does what is drawn for a selection.
bool PartsMapper::NeedsWeights(const vtkOpenGLHelper* cellBO) const
{
  return this->Shown && this->Shown->Data.Kind != MixtureKind::Single &&
         (this->UsesMaterial(cellBO) || this->IsRest(cellBO));
}

// The weights go through the shader stages beside the positions, as tangents do.
void PartsMapper::ReplaceShaderPositionVC(Shaders shaders, vtkRenderer* ren, vtkActor* actor)
{
  if (this->NeedsWeights(this->LastBoundBO))
  {
    for (const auto& [name, type] : this->GetAttributes(this->Shown->Data))
    {
      AddAfterTag(
        shaders[vtkShader::Vertex], "//VTK::PositionVC::Dec", "in " + type + " " + name + ";\n");
      PassOn(shaders, type, name + "VC", name);
    }
    if (this->IsRest(this->LastBoundBO))
    {
      const MixtureText text = this->MakeMixtureText(this->Shown->Data, {});
      AddAfterTag(shaders[vtkShader::Fragment], "//VTK::PositionVC::Dec", text.Declarations);
      AddAfterTag(shaders[vtkShader::Fragment], "//VTK::PositionVC::Impl", text.Implementation);
    }
  }
  this->Superclass::ReplaceShaderPositionVC(shaders, ren, actor);
}

void PartsMapper::SetPropertyShaderParameters(
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

void PartsMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cellBO, ren, actor);
  if (this->Style && this->Style->OverridesColor && this->UsesMaterial(&cellBO) &&
      this->Drawing->GetSettings().ScalarColoringMode != 0)
  {
    cellBO.Program->SetUniformi("brdfModulate", 2);
  }
  if (this->Images && this->NeedsWeights(&cellBO))
  {
    this->Images->SetUniforms(cellBO.Program, 0);
  }
}

// Of a weight before weights are divided by their sum; its C++ twin is vtkMaterialMap::GetWeight.
std::string PartsMapper::GetWeightText(const MaterialPart& part, int slot) const
{
  if (part.Kind == MixtureKind::Weights)
  {
    return VaryingOf(partarrays::GetWeights(slot / WeightsPerArray)) + "[" +
           std::to_string(slot % WeightsPerArray) + "]";
  }
  int component = slot < static_cast<int>(part.Components.size()) ? part.Components[slot] : -1;
  std::size_t image = 0;
  while (component >= 0 && component >= this->ImageComponents[image])
  {
    component -= this->ImageComponents[image++];
  }
  return component < 0 ? "0.0" : Texel(image) + "[" + std::to_string(component) + "]";
}

// For the fragment shader, of parts that have weights: declarations, and what fills brdfWeights.
// drawn: which of the part's members have a share; the others' is divided among them. What is not
// this part's is discarded.
MixtureText PartsMapper::MakeMixtureText(
  const MaterialPart& part, const std::vector<bool>& drawn) const
{
  MixtureText text;
  std::string& code = text.Implementation;
  for (const auto& [name, type] : this->GetAttributes(part))
  {
    text.Declarations += "in " + type + " " + VaryingOf(name) + ";\n";
  }
  for (std::size_t k = 0; part.Kind == MixtureKind::Images && k < this->ImageComponents.size(); ++k)
  {
    text.Declarations += "uniform sampler2D " + GetWeightSampler(k) + ";\n";
    code += "  vec4 " + Texel(k) + " = texture(" + GetWeightSampler(k) + ", " +
            VaryingOf(partarrays::Coordinates) + ");\n";
  }
  const int count = part.NumberOfWeights;
  text.Declarations += "float brdfWeights[" + std::to_string(count) + "];\n";
  std::string sum = "0.0";
  int others = -1; // the material where no other has a weight
  for (int slot = 0; slot < count; ++slot)
  {
    const auto place = static_cast<std::size_t>(slot);
    const bool given = place >= drawn.size() || drawn[place];
    const bool isOthers = part.Kind == MixtureKind::Images &&
                          (place >= part.Components.size() || part.Components[place] < 0);
    others = given && (isOthers || others < 0) ? slot : others;
    code += "  " + Weight(slot) + " = " + (given ? this->GetWeightText(part, slot) : "0.0") + ";\n";
    sum += " + " + Weight(slot);
  }
  code += "  float brdfSum = " + sum + ";\n";
  for (int slot = 0; slot < count; ++slot)
  {
    code += "  " + Weight(slot) + " = brdfSum > 0.0 ? " + Weight(slot) +
            " / brdfSum : " + (slot == others ? "1.0" : "0.0") + ";\n";
  }
  if (part.HasRest || part.IsRest)
  {
    code += "  if (" + Weight(count - 1) + (part.HasRest ? " > 0.0" : " <= 0.0") +
            ")\n  {\n    discard;\n  }\n";
  }
  return text;
}

// window need not be the one that was drawn in last.
void PartsMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->ReleaseIndices();
  this->InOwnWindow([this]() { this->DropShaders(this->OwnWindow); });
  this->Superclass::ReleaseGraphicsResources(window);
}
} // namespace measuredbrdf
