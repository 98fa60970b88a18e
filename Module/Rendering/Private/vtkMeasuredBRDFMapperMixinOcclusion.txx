// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The part of vtkMeasuredBRDFMapperMixin that shades with what surfaces hide from themselves.
// vtkMeasuredBRDFMapperMixin.txx includes it after the class.

#ifndef vtkMeasuredBRDFMapperMixinOcclusion_txx
#define vtkMeasuredBRDFMapperMixinOcclusion_txx

#include "MaterialDrawing.h"
#include "OcclusionAxes.h"
#include "OcclusionKept.h"
#include "OcclusionPoints.h"
#include "OcclusionShader.h"

#include "vtkCamera.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkRenderer.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"

#include <string>
#include <vector>

//------------------------------------------------------------------------------
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::GetNeedToRebuildBufferObjects(
  vtkRenderer* ren, vtkActor* actor)
{
  return this->Base::GetNeedToRebuildBufferObjects(ren, actor) ||
         this->BuiltOcclusionMode != this->Drawing->GetSettings().OcclusionMode ||
         this->BuiltOcclusionBounce != this->Drawing->GetSettings().OcclusionBounce ||
         this->BuiltTracedOcclusion != this->Drawing->GetTracedOcclusion(this);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::BuildBufferObjects(vtkRenderer* ren, vtkActor* actor)
{
  this->BuiltOcclusionMode = this->Drawing->GetSettings().OcclusionMode;
  this->BuiltOcclusionBounce = this->Drawing->GetSettings().OcclusionBounce;
  this->BuiltTracedOcclusion = this->Drawing->GetTracedOcclusion(this);
  this->OcclusionTime.Modified();
  this->Drawing->BeginOcclusion(this);
  this->HasBadNormals = false;
  this->AddOcclusion(ren);
  this->Base::BuildBufferObjects(ren, actor);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::AddOcclusion(vtkRenderer* ren)
{
  this->CheckVertices(this->CurrentInput);
  const auto arrays = this->Drawing->FindOcclusion(this->CurrentInput, this, this->IsPart());
  this->LeastOcclusionCosine = arrays ? arrays->LeastCosine : 1.0;
  this->IsOtherSideClosed = arrays && arrays->IsOtherClosed;
  for (std::size_t k = 0; k < measuredbrdf::OcclusionArrays::Attributes; ++k)
  {
    const std::string number = std::to_string(k);
    this->VBOs->CacheDataArray(
      ("brdfSky" + number).c_str(), arrays ? arrays->Front[k].Get() : nullptr, ren, VTK_FLOAT);
    this->VBOs->CacheDataArray(("brdfSkyBack" + number).c_str(),
      arrays && arrays->HasBack ? arrays->Back[k].Get() : nullptr, ren, VTK_FLOAT);
  }
  const bool bounced = arrays && arrays->HasBounce;
  this->VBOs->CacheDataArray(
    "brdfBounce", bounced ? arrays->BounceFront.Get() : nullptr, ren, VTK_FLOAT);
  this->VBOs->CacheDataArray(
    "brdfBounceBack", bounced ? arrays->BounceBack.Get() : nullptr, ren, VTK_FLOAT);
}

//------------------------------------------------------------------------------
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::HasOcclusion()
{
  return this->VBOs->GetNumberOfComponents("brdfSky0") == 4;
}

//------------------------------------------------------------------------------
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::HasTwoSidedOcclusion()
{
  return this->VBOs->GetNumberOfComponents("brdfSkyBack0") == 4;
}

//------------------------------------------------------------------------------
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::HasOcclusionBounce()
{
  return this->VBOs->GetNumberOfComponents("brdfBounce") == 3;
}

//------------------------------------------------------------------------------
// Through the stages beside the positions (their tags are still there); the fragment shader's part
// comes with the lights.
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::ReplaceShaderOcclusion(Shaders shaders)
{
  const measuredbrdf::OcclusionLights lights =
    this->Drawing->GetSelectedOcclusion(this->HasOcclusion());
  if (lights.empty())
  {
    return;
  }
  const measuredbrdf::OcclusionText text = measuredbrdf::MakeOcclusionText(
    lights, { this->HasTwoSidedOcclusion(), this->HasOcclusionBounce(), this->KeepsOcclusion() });
  const auto add = [&shaders](vtkShader::Type stage, const char* tag, const std::string& lines)
  {
    std::string source = shaders[stage]->GetSource();
    vtkShaderProgram::Substitute(source, tag, std::string(tag) + "\n" + lines, false);
    shaders[stage]->SetSource(source);
  };
  add(vtkShader::Vertex, "//VTK::PositionVC::Dec", text.VertexDeclarations);
  add(vtkShader::Vertex, "//VTK::PositionVC::Impl", text.VertexCode);
  add(vtkShader::Geometry, "//VTK::PositionVC::Dec", text.GeometryDeclarations);
  add(vtkShader::Geometry, "//VTK::PositionVC::Impl", text.GeometryCode);
}

//------------------------------------------------------------------------------
// Whether the light's part of the shader is made for each point beforehand: of one material, since
// each of several would make it for all points.
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::KeepsOcclusion()
{
  if (!this->HasOcclusion() || !this->Points->IsPossible() ||
      this->Drawing->GetMaterials().size() > 1 ||
      this->VBOs->GetVBO("brdfSky0")->GetNumberOfTuples() <
        measuredbrdf::OcclusionPoints::GetLeastPoints())
  {
    return false;
  }
  const measuredbrdf::OcclusionLights lights = this->Drawing->GetSelectedOcclusion(true);
  const measuredbrdf::OcclusionLayout layout = { this->HasTwoSidedOcclusion(),
    this->HasOcclusionBounce(), true };
  if (lights.empty() || measuredbrdf::GetKeptNames(lights, layout).empty())
  {
    return false; // nothing is hidden of scene lights
  }
  std::size_t attributes = this->ExtraAttributes.size();
  for (const char* name : { "vertexMC", "normalMC", "scalarColor", "tcoord", "tangentMC" })
  {
    attributes += this->VBOs->GetNumberOfComponents(name) > 0 ? 1 : 0;
  }
  attributes += measuredbrdf::CountKeptAttributes(lights, layout);
  return attributes <= measuredbrdf::OcclusionPoints::MostAttributes;
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::UpdateShaders(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  if (this->UsesMaterial(&cellBO) && this->KeepsOcclusion())
  {
    this->KeepOcclusion(ren, actor);
  }
  else if (this->UsesMaterial(&cellBO))
  {
    this->Points->Drop();
  }
  this->Base::UpdateShaders(cellBO, ren, actor);
}

//------------------------------------------------------------------------------
// Before triangles are drawn: what of their points rests while the light does, unless it is kept.
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::KeepOcclusion(vtkRenderer* ren, vtkActor* actor)
{
  const measuredbrdf::OcclusionLights lights = this->Drawing->GetSelectedOcclusion(true);
  const measuredbrdf::OcclusionLayout layout = { this->HasTwoSidedOcclusion(),
    this->HasOcclusionBounce(), true };
  const measuredbrdf::OcclusionAxes axes(ren, actor, this->GetEnvironments());
  const measuredbrdf::OcclusionPoints::Question question = { ren, actor,
    measuredbrdf::GetKeptInputs(lights, layout, axes.ToEnvironment), this->OcclusionTime };
  if (this->Points->Find(lights, layout, question))
  {
    return;
  }
  vtkShaderProgram* program = this->Points->Begin(
    vtkOpenGLRenderWindow::SafeDownCast(ren->GetRenderWindow()), this->VBOs, lights, layout);
  if (program) // if not, each drawn triangle makes it
  {
    this->SetOcclusionParameters(program, ren, actor);
    this->Points->Make(this->VBOs->GetVBO("brdfSky0")->GetNumberOfTuples(), question);
  }
}

//------------------------------------------------------------------------------
template <class Base>
std::vector<vtkEnvironment*> vtkMeasuredBRDFMapperMixin<Base>::GetEnvironments()
{
  std::vector<vtkEnvironment*> environments;
  for (const measuredbrdf::DrawnMaterial* drawn : this->Drawing->GetSelected().Get())
  {
    environments.push_back(drawn->Environment);
  }
  return environments;
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::SetOcclusionParameters(
  vtkShaderProgram* program, vtkRenderer* ren, vtkActor* actor)
{
  const measuredbrdf::OcclusionLights lights =
    this->Drawing->GetSelectedOcclusion(this->HasOcclusion());
  if (lights.empty())
  {
    return;
  }
  const measuredbrdf::OcclusionAxes axes(ren, actor, this->GetEnvironments());
  const measuredbrdf::OcclusionSides sides = { this->HasTwoSidedOcclusion(),
    this->HasOcclusionBounce(), this->IsOtherSideClosed, this->LeastOcclusionCosine };
  measuredbrdf::SetOcclusionUniforms(program, lights, sides, axes.ToModel,
    ren->GetActiveCamera()->GetParallelProjection() != 0, axes.ToEnvironment);
}

#endif
