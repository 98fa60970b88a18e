// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The part of vtkMeasuredBRDFMapperMixin that shades with what surfaces hide from themselves.
// vtkMeasuredBRDFMapperMixin.txx includes it before the methods that use it.

#ifndef vtkMeasuredBRDFMapperMixinOcclusion_txx
#define vtkMeasuredBRDFMapperMixinOcclusion_txx

#include "MaterialDrawing.h"
#include "OcclusionPoints.h"
#include "OcclusionShader.h"
#include "ShaderLimits.h"

#include "vtkCamera.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkRenderer.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"

#include <string>
#include <vector>

//------------------------------------------------------------------------------
struct vtkMeasuredBRDFMapperOcclusion
{
  measuredbrdf::OcclusionLights Lights; // none: nothing is hidden
  measuredbrdf::OcclusionLayout Layout;
};

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
  const measuredbrdf::ShaderLimits limits =
    measuredbrdf::ShaderLimits::Read(static_cast<vtkOpenGLRenderer*>(ren)->GetState());
  this->MostAttributes = limits.Attributes;
  this->MostVaryings = limits.Varyings;
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
  const vtkMeasuredBRDFMapperOcclusion occlusion = this->GetOcclusion();
  if (occlusion.Lights.empty())
  {
    return;
  }
  const measuredbrdf::OcclusionText text =
    measuredbrdf::MakeOcclusionText(occlusion.Lights, occlusion.Layout);
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
bool vtkMeasuredBRDFMapperMixin<Base>::MayKeepOcclusion()
{
  return this->Points->IsPossible() && this->Drawing->GetMaterials().size() <= 1 &&
         this->VBOs->GetVBO("brdfSky0")->GetNumberOfTuples() >=
           measuredbrdf::OcclusionPoints::GetLeastPoints();
}

//------------------------------------------------------------------------------
// Whether a vertex shader may read so many attributes, and the stages hand on so much, with what
// the superclass and parts of material maps add.
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::FitsOcclusion(
  const vtkMeasuredBRDFMapperOcclusion& occlusion)
{
  std::size_t own = this->ExtraAttributes.size();
  for (const char* name : { "vertexMC", "normalMC", "scalarColor", "tcoord", "tangentMC" })
  {
    own += this->VBOs->GetNumberOfComponents(name) > 0 ? 1 : 0;
  }
  const measuredbrdf::OcclusionNeeds needs =
    measuredbrdf::CountOcclusionNeeds(occlusion.Lights, occlusion.Layout);
  // Tangents may be handed on twice, as the superclass's and turned by ours.
  return own + needs.Attributes <= this->MostAttributes &&
         4 * (own + 1) + this->VaryingsOfBase + needs.Varyings <= this->MostVaryings;
}

//------------------------------------------------------------------------------
// What the buffers have, or the part of it that the graphics card has room for: without what comes
// back, then of one side, then nothing.
template <class Base>
vtkMeasuredBRDFMapperOcclusion vtkMeasuredBRDFMapperMixin<Base>::GetOcclusion()
{
  vtkMeasuredBRDFMapperOcclusion occlusion;
  occlusion.Lights = this->Drawing->GetSelectedOcclusion(this->HasOcclusion());
  if (occlusion.Lights.empty())
  {
    return occlusion;
  }
  measuredbrdf::OcclusionLayout& layout = occlusion.Layout;
  layout = { this->HasTwoSidedOcclusion(), this->HasOcclusionBounce(), false };
  const char* leftOut = "";
  while (!this->FitsOcclusion(occlusion))
  {
    if (layout.Bounced)
    {
      leftOut = "without what comes back from what is hidden";
      layout.Bounced = false;
    }
    else if (layout.TwoSided)
    {
      leftOut = "as if only one of its sides hid anything";
      layout.TwoSided = false;
    }
    else
    {
      leftOut = "as if it hid nothing from itself";
      occlusion.Lights.clear();
      break;
    }
  }
  if (*leftOut && this->Drawing->WarnOnce(leftOut))
  {
    vtkWarningWithObjectMacro(this->Drawing->GetOwner(),
      << "The surface is drawn " << leftOut << ": shaders of this graphics card may have "
      << this->MostAttributes << " vertex attributes and " << this->MostVaryings
      << " components of varyings.");
  }
  if (!occlusion.Lights.empty() && this->MayKeepOcclusion())
  {
    layout.Kept = true;
    layout.Kept = !measuredbrdf::GetKeptNames(occlusion.Lights, layout).empty() && // of what hides
                  this->FitsOcclusion(occlusion);
  }
  return occlusion;
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::UpdateShaders(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  if (this->UsesMaterial(&cellBO))
  {
    const vtkMeasuredBRDFMapperOcclusion occlusion = this->GetOcclusion();
    if (occlusion.Layout.Kept)
    {
      this->KeepOcclusion(occlusion, ren, actor);
    }
    else
    {
      this->Points->Drop();
    }
  }
  this->Base::UpdateShaders(cellBO, ren, actor);
}

//------------------------------------------------------------------------------
// Before triangles are drawn: what of their points rests while the light does, unless it is kept.
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::KeepOcclusion(
  const vtkMeasuredBRDFMapperOcclusion& occlusion, vtkRenderer* ren, vtkActor* actor)
{
  const auto& [lights, layout] = occlusion;
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
  const auto& [lights, layout] = this->GetOcclusion();
  if (lights.empty())
  {
    return;
  }
  const measuredbrdf::OcclusionAxes axes(ren, actor, this->GetEnvironments());
  const measuredbrdf::OcclusionSides sides = { layout.TwoSided, layout.Bounced,
    this->IsOtherSideClosed, this->LeastOcclusionCosine };
  measuredbrdf::SetOcclusionUniforms(program, lights, sides, axes.ToModel,
    ren->GetActiveCamera()->GetParallelProjection() != 0, axes.ToEnvironment);
}

#endif
