// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Definitions of vtkMeasuredBRDFMapperMixin, for the files that instantiate it.

#ifndef vtkMeasuredBRDFMapperMixin_txx
#define vtkMeasuredBRDFMapperMixin_txx

#include "vtkMeasuredBRDFMapperMixin.h"

#include "BRDFShader.h"
#include "BadVertices.h"
#include "DrawsColor.h"
#include "EnvironmentRotation.h"
#include "MaterialDrawing.h"
#include "OcclusionPoints.h"
#include "OcclusionShader.h"
#include "RenderScopes.h"

#include "vtkActor.h"
#include "vtkBRDF.h"
#include "vtkCamera.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkProperty.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkTexture.h"

#include <algorithm>
#include <numeric>

namespace measuredbrdf
{
// slots: none where there is one material.
inline std::vector<ShaderMember> GetShaderMembers(
  const DrawnMaterials& materials, const std::vector<int>& slots, const OcclusionLights& lights)
{
  std::vector<ShaderMember> members;
  for (std::size_t k = 0; k < materials.size(); ++k)
  {
    const DrawnMaterial& drawn = *materials[k];
    members.push_back({ drawn.Material ? &drawn.Material->GetForm() : nullptr,
      drawn.Radiance ? &drawn.Radiance->GetForm() : nullptr, k < slots.size() ? slots[k] : 0,
      k < lights.size() ? lights[k] : nullptr });
  }
  return members;
}

inline bool AreAllEvaluated(const std::vector<ShaderMember>& members)
{
  return std::all_of(members.begin(), members.end(),
    [](const ShaderMember& member) { return member.Material != nullptr; });
}

inline bool Contains(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}
} // namespace measuredbrdf

//------------------------------------------------------------------------------
class vtkMeasuredBRDFMapperInternals : public measuredbrdf::MaterialDrawing
{
  using measuredbrdf::MaterialDrawing::MaterialDrawing;
};

#include "vtkMeasuredBRDFMapperMixinOcclusion.txx"

//------------------------------------------------------------------------------
template <class Base>
vtkMeasuredBRDFMapperMixin<Base>::vtkMeasuredBRDFMapperMixin()
  : Points(std::make_unique<vtkMeasuredBRDFMapperPoints>())
{
}

//------------------------------------------------------------------------------
template <class Base>
vtkMeasuredBRDFMapperMixin<Base>::~vtkMeasuredBRDFMapperMixin()
{
  if (this->Drawing)
  {
    this->Drawing->Forget(this);
  }
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::RenderPiece(vtkRenderer* ren, vtkActor* actor)
{
  const measuredbrdf::Depth inside(this->RenderDepth);
  this->IsPlain = false;
  for (bool tries = true; tries;)
  {
    this->HasStarted = false;
    if (this->Drawing->Try([&]() { this->Base::RenderPiece(ren, actor); }))
    {
      return;
    }
    this->BuiltOcclusionMode = -1; // buffers may be half built
    this->ShaderKeys.clear();      // and shaders
    if (this->HasStarted)
    {
      this->ShowOnly(-1);
      this->Base::RenderPieceFinish(ren, actor);
    }
    tries = !this->IsPlain;
    this->IsPlain = true;
  }
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::ReleaseGraphicsResources(vtkWindow* window)
{
  // From inside of RenderPiece the superclass lets go of one window since another draws: the
  // textures of the first stay, for its next frame.
  if (this->Drawing && this->RenderDepth == 0)
  {
    this->Drawing->ReleaseGraphicsResources(window, this);
  }
  this->Points->Release(window);
  this->Base::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::RenderPieceStart(vtkRenderer* ren, vtkActor* actor)
{
  if (!this->IsPlain)
  {
    this->Drawing->BeginFrame(ren, actor, this, this->GetMaterialUses());
  }
  // Each distance and each edge's equation takes a vector of four. (DrawingEdges would want
  // buffers.)
  vtkProperty* property = actor->GetProperty();
  const bool edges = property->GetEdgeVisibility() && property->GetRepresentation() == VTK_SURFACE;
  this->VaryingsOfBase = 4 * ((this->GetNumberOfClippingPlanes() > 0 ? 6 : 0) + (edges ? 3 : 0));
  this->Base::RenderPieceStart(ren, actor);
  this->HasStarted = true;
  this->Drawing->AddSamples(ren, actor, this,
    [&]()
    {
      this->PrimitiveIDOffset = 0;
      this->RenderPieceDraw(ren, actor);
    });
  this->PrimitiveIDOffset = 0;
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::RenderPieceDraw(vtkRenderer* ren, vtkActor* actor)
{
  const std::vector<measuredbrdf::DrawnMaterial>& materials = this->Drawing->GetMaterials();
  if (materials.empty())
  {
    this->Base::RenderPieceDraw(ren, actor);
    return;
  }
  // Those of one shader after the other.
  std::vector<std::size_t> order(materials.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&materials](std::size_t a, std::size_t b)
  { return materials[a].Key < materials[b].Key; };
  if (!std::is_sorted(order.begin(), order.end(), before)) // most often all are of one
  {
    std::stable_sort(order.begin(), order.end(), before);
  }
  for (std::size_t material : order)
  {
    this->ShowOnly(static_cast<int>(material));
    this->Drawing->Select(material);
    this->Base::RenderPieceDraw(ren, actor);
  }
  this->Drawing->Unselect();
  this->ShowOnly(-1);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::RenderPieceFinish(vtkRenderer* ren, vtkActor* actor)
{
  this->Drawing->EndFrame();
  this->Base::RenderPieceFinish(ren, actor);
}

//------------------------------------------------------------------------------
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::UsesMaterial(const vtkOpenGLHelper* cellBO)
{
  if (this->Drawing->GetSelected().IsEmpty() || this->DrawingSelection || this->DrawingVertices)
  {
    return false;
  }
  return cellBO == &this->Primitives[Base::PrimitiveTris] ||
         cellBO == &this->Primitives[Base::PrimitiveTriStrips];
}

//------------------------------------------------------------------------------
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::HasTangents()
{
  return this->VBOs->GetNumberOfComponents("tangentMC") == 3;
}

//------------------------------------------------------------------------------
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::HasScalarColors()
{
  return this->GetScalarVisibility() && !this->IgnoresScalars() &&
         (this->VBOs->GetNumberOfComponents("scalarColor") != 0 || this->HaveCellScalars ||
           this->ColorTextureMap);
}

//------------------------------------------------------------------------------
template <class Base>
std::string vtkMeasuredBRDFMapperMixin<Base>::GetShaderKey(const vtkOpenGLHelper* cellBO)
{
  if (!this->UsesMaterial(cellBO))
  {
    return "";
  }
  const vtkMeasuredBRDFMapperOcclusion occlusion = this->GetOcclusion();
  const char* const stages[] = { "", "/others", "/add", "/show" };
  return this->Drawing->GetSelected().GetKey() +
         stages[static_cast<int>(this->Drawing->GetSums().GetStage())] +
         (this->HasTangents() ? "/tangents" : "") + (this->HasScalarColors() ? "/colors" : "") +
         (this->HasBadNormals ? "/bad normals" : "") +
         measuredbrdf::GetOcclusionKey(occlusion.Lights, occlusion.Layout);
}

//------------------------------------------------------------------------------
template <class Base>
int vtkMeasuredBRDFMapperMixin<Base>::FindSuperfluousLight(vtkRenderer* ren)
{
  return measuredbrdf::FindSuperfluousLight(
    ren, this->Drawing->GetSelected().Get().front()->Integrator != nullptr); // all or none
}

//------------------------------------------------------------------------------
template <class Base>
bool vtkMeasuredBRDFMapperMixin<Base>::GetNeedToRebuildShaders(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  const bool rebuild = this->Base::GetNeedToRebuildShaders(cellBO, ren, actor);
  std::string key = this->GetShaderKey(&cellBO);
  if (!key.empty())
  {
    key += "/without light " + std::to_string(this->FindSuperfluousLight(ren));
  }
  std::string& last = this->ShaderKeys[&cellBO];
  const bool changed = key != last;
  last = std::move(key);
  return rebuild || changed;
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::ReplaceShaderColor(
  Shaders shaders, vtkRenderer* ren, vtkActor* actor)
{
  const measuredbrdf::ForceLit lit(this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity,
    this->UsesMaterial(this->LastBoundBO));
  this->Base::ReplaceShaderColor(shaders, ren, actor);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::ReplaceShaderEdges(
  Shaders shaders, vtkRenderer* ren, vtkActor* actor)
{
  const measuredbrdf::ForceLit lit(this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity,
    this->UsesMaterial(this->LastBoundBO));
  this->Base::ReplaceShaderEdges(shaders, ren, actor);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::ReplaceShaderPositionVC(
  Shaders shaders, vtkRenderer* ren, vtkActor* actor)
{
  const measuredbrdf::ForceLit lit(this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity,
    this->UsesMaterial(this->LastBoundBO));
  this->Base::ReplaceShaderPositionVC(shaders, ren, actor);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::ReplaceShaderNormal(
  Shaders shaders, vtkRenderer* ren, vtkActor* actor)
{
  const bool material = this->UsesMaterial(this->LastBoundBO);
  const measuredbrdf::ForceLit lit(
    this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity, material);
  this->Base::ReplaceShaderNormal(shaders, ren, actor);
  if (material)
  {
    this->ReplaceShaderOcclusion(shaders);
  }
  if (!material || !this->Drawing->GetSelected().AreAnyAnisotropic() || !this->HasTangents())
  {
    return;
  }

  // Tangents through the stages, beside the positions (their tags are still there).
  std::string vs = shaders[vtkShader::Vertex]->GetSource();
  std::string declarations = "out vec3 brdfTangentVCVSOutput;\nuniform mat3 brdfTangentMatrix;\n";
  if (!measuredbrdf::Contains(vs, "in vec3 tangentMC;"))
  {
    declarations += "in vec3 tangentMC;\n";
  }
  vtkShaderProgram::Substitute(
    vs, "//VTK::PositionVC::Dec", "//VTK::PositionVC::Dec\n" + declarations, false);
  vtkShaderProgram::Substitute(vs, "//VTK::PositionVC::Impl",
    "//VTK::PositionVC::Impl\n  brdfTangentVCVSOutput = brdfTangentMatrix * tangentMC;\n", false);
  shaders[vtkShader::Vertex]->SetSource(vs);

  std::string gs = shaders[vtkShader::Geometry]->GetSource();
  vtkShaderProgram::Substitute(gs, "//VTK::PositionVC::Dec",
    "//VTK::PositionVC::Dec\nin vec3 brdfTangentVCVSOutput[];\nout vec3 brdfTangentVCGSOutput;\n",
    false);
  vtkShaderProgram::Substitute(gs, "//VTK::PositionVC::Impl",
    "//VTK::PositionVC::Impl\n  brdfTangentVCGSOutput = brdfTangentVCVSOutput[i];\n", false);
  shaders[vtkShader::Geometry]->SetSource(gs);

  std::string fs = shaders[vtkShader::Fragment]->GetSource();
  vtkShaderProgram::Substitute(
    fs, "//VTK::Light::Dec", "in vec3 brdfTangentVCVSOutput;\n//VTK::Light::Dec", false);
  shaders[vtkShader::Fragment]->SetSource(fs);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::ReplaceShaderLight(
  Shaders shaders, vtkRenderer* ren, vtkActor* actor)
{
  if (!this->UsesMaterial(this->LastBoundBO))
  {
    this->Base::ReplaceShaderLight(shaders, ren, actor);
    return;
  }
  this->WarnOfTextures(actor);
  const auto& [lights, layout] = this->GetOcclusion();
  const measuredbrdf::MixtureText& mixture = this->Drawing->GetSelected().GetMixture();
  const std::vector<measuredbrdf::ShaderMember> members =
    measuredbrdf::GetShaderMembers(this->Drawing->GetSelected().Get(), mixture.Slots, lights);
  std::string fs = shaders[vtkShader::Fragment]->GetSource();
  const measuredbrdf::SumStage stage = this->Drawing->GetSums().GetStage();
  const measuredbrdf::OcclusionText occlusion = lights.empty()
                                                  ? measuredbrdf::OcclusionText()
                                                  : measuredbrdf::MakeOcclusionText(lights, layout);
  std::string declarations = occlusion.FragmentDeclarations + mixture.Declarations +
                             measuredbrdf::GetShaderDeclarations(members, stage);
  if (measuredbrdf::Contains(fs, "anisotropyUniform"))
  {
    // The superclass turned the tangents by a PBR property's anisotropy, with what its lights
    // would have declared.
    declarations += "uniform float anisotropyUniform;\nconst float PI = 3.14159265359;\n";
  }
  const std::string uniforms(static_cast<vtkOpenGLRenderer*>(ren)->GetLightingUniforms());
  vtkShaderProgram::Substitute(fs, "//VTK::Light::Dec", uniforms + "\n" + declarations, false);
  measuredbrdf::ShaderBody body;
  body.Weights = occlusion.FragmentCode + mixture.Implementation;

  if (this->Drawing->GetSelected().AreAnyAnisotropic())
  {
    body.Tangents =
      this->HasTangents() ? measuredbrdf::TangentSource::Data : measuredbrdf::TangentSource::Axis;
    if (!this->HasTangents() && this->Drawing->WarnOnce("tangents"))
    {
      vtkWarningWithObjectMacro(this->Drawing->GetOwner(),
        << "The material is anisotropic but the polydata has no float point tangents "
           "(PointData::SetTangents, or vtkPolyDataTangents for texture coordinates): they turn "
           "about the environment's up axis.");
    }
  }
  const auto& info = this->PrimitiveInfo[this->LastBoundBO];
  body.SuperfluousLight = this->FindSuperfluousLight(ren);
  // Image-based lighting counts as a light in VTK 9.6; here it is none.
  const bool adds = measuredbrdf::IsOfSum(stage);
  const bool lit = measuredbrdf::AreAllEvaluated(members) && !adds &&
                   info.LastLightCount > (body.SuperfluousLight >= 0 ? 1 : 0) &&
                   this->Drawing->GetSettings().UseSceneLights;
  body.Complexity = lit ? static_cast<int>(info.LastLightComplexity) : 0;
  body.LightCount = info.LastLightCount;
  body.Stage = stage;
  body.HasBadNormals = this->HasBadNormals;
  body.HasEdges = this->DrawingEdges(ren, actor);
  body.HasEdgeOpacity = measuredbrdf::Contains(fs, "uniform float edgeOpacity");
  body.EdgesAreTubes = measuredbrdf::Contains(fs, "vec3 tnorm"); // as the superclass bent normals
  body.HasBlockColors = measuredbrdf::Contains(fs, "uniform bool OverridesColor");
  body.HasColors = this->HasScalarColors() || this->IsPart(); // which serves all blocks
  vtkShaderProgram::Substitute(fs, "//VTK::Light::Impl", measuredbrdf::GetShaderBody(body), false);
  if (adds) // whatever else writes a color
  {
    vtkShaderProgram::Substitute(fs, "//VTK::Coincident::Impl",
      "//VTK::Coincident::Impl\n" + measuredbrdf::GetSumOutput(stage), false);
  }
  shaders[vtkShader::Fragment]->SetSource(fs);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::CheckVertices(vtkPolyData* surface)
{
  if (!surface)
  {
    return;
  }
  const measuredbrdf::BadVertices bad(surface);
  this->HasBadNormals = this->HasBadNormals || bad.Normals > 0;
  const std::string text = bad.GetText();
  if (!text.empty() && !this->Drawing->GetMaterials().empty() &&
      this->Drawing->WarnOnce("vertices"))
  {
    vtkWarningWithObjectMacro(this->Drawing->GetOwner(), << text << ".");
  }
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::WarnOfTextures(vtkActor* actor)
{
  for (const char* name :
    { "albedoTex", "materialTex", "emissiveTex", "anisotropyTex", "coatNormalTex" })
  {
    const auto textures = this->GetTextures(actor);
    if (std::any_of(textures.begin(), textures.end(),
          [name](const auto& texture) { return texture.second == name; }) &&
        this->Drawing->WarnOnce(name))
    {
      vtkWarningWithObjectMacro(this->Drawing->GetOwner(),
        << "The property's texture " << name
        << " has no effect: the surface reflects as the measured material does. An actor's own "
           "texture and scalars multiply its radiance.");
    }
  }
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::ReplaceShaderTCoord(
  Shaders shaders, vtkRenderer* ren, vtkActor* actor)
{
  this->Base::ReplaceShaderTCoord(shaders, ren, actor);
  if (!this->UsesMaterial(this->LastBoundBO))
  {
    return;
  }
  // The superclass multiplies encoded radiance by the texture.
  std::string fs = shaders[vtkShader::Fragment]->GetSource();
  for (const auto& texture : this->GetTextures(actor))
  {
    if (texture.first->GetUseSRGBColorSpace() && !texture.first->GetCubeMap())
    {
      vtkShaderProgram::Substitute(
        fs, "= texture(" + texture.second + ", ", "= brdfDisplayTexel(" + texture.second + ", ");
    }
  }
  shaders[vtkShader::Fragment]->SetSource(fs);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  this->Base::SetMapperShaderParameters(cellBO, ren, actor);
  if (!this->UsesMaterial(&cellBO))
  {
    return;
  }
  vtkShaderProgram* program = cellBO.Program;
  vtkNew<vtkMatrix3x3> matrix;
  for (std::size_t k = 0; k < this->Drawing->GetSelected().Get().size(); ++k)
  {
    const measuredbrdf::DrawnMaterial& drawn = *this->Drawing->GetSelected().Get()[k];
    for (const std::shared_ptr<measuredbrdf::FormTextures>& textures :
      { drawn.Material, drawn.Radiance })
    {
      if (textures)
      {
        textures->SetUniforms(program, measuredbrdf::GetFirstInstance(k));
      }
    }
    matrix->DeepCopy(measuredbrdf::GetViewToEnvironment(ren, drawn.Environment).data());
    matrix->Transpose(); // SetUniformMatrix hands over columns
    program->SetUniformMatrix(measuredbrdf::GetRotationName(k).c_str(), matrix);
  }
  if (program->IsUniformUsed("brdfTangentMatrix"))
  {
    // Tangents are directions of the surface: they turn and stretch with it, as normals do not.
    vtkNew<vtkMatrix4x4> toView;
    vtkMatrix4x4::Multiply4x4(
      ren->GetActiveCamera()->GetModelViewTransformMatrix(), actor->GetMatrix(), toView);
    for (int k = 0; k < 9; ++k)
    {
      matrix->SetElement(k % 3, k / 3, toView->GetElement(k / 3, k % 3));
    }
    program->SetUniformMatrix("brdfTangentMatrix", matrix);
  }
  this->Drawing->GetSums().SetUniforms(program);
  this->SetOcclusionParameters(program, ren, actor);
  if (this->GetOcclusion().Layout.Kept)
  {
    this->Points->AddTo(cellBO);
  }
  const bool modulate = this->Drawing->GetSettings().ScalarColoringMode != 0;
  program->SetUniformi("brdfModulate", modulate ? (this->HasScalarColors() ? 2 : 1) : 0);
}

//------------------------------------------------------------------------------
template <class Base>
void vtkMeasuredBRDFMapperMixin<Base>::SetPropertyShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  this->Base::SetPropertyShaderParameters(cellBO, ren, actor);
  if (!this->UsesMaterial(&cellBO))
  {
    return;
  }
  // The measured material has no coefficient for VTK's "diffuse" part.
  cellBO.Program->SetUniformf("diffuseIntensity", 1.0f);
  if (vtkProperty* back = actor->GetBackfaceProperty())
  {
    // The superclass sets these where its own lighting reads them.
    cellBO.Program->SetUniformf("opacityUniformBF", static_cast<float>(back->GetOpacity()));
    cellBO.Program->SetUniform3f("diffuseColorUniformBF", back->GetDiffuseColor());
    cellBO.Program->SetUniformf("diffuseIntensityBF", 1.0f);
  }
}

#endif
