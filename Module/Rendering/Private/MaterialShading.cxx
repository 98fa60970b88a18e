// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialShading.h"

#include "BRDFShader.h"
#include "OcclusionShader.h"
#include "RenderPassQueries.h"
#include "TextureEnvironment.h"

#include "vtkActor.h"
#include "vtkBRDF.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkEnvironment.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLRenderUtilities.h" // VTK's OpenGL, whichever library it loads it with
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkShaderProgram.h"
#include "vtkTexture.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t Unlimited = std::numeric_limits<std::size_t>::max();
std::atomic<std::size_t> LargestAttributes{ Unlimited };
std::atomic<std::size_t> LargestVaryings{ Unlimited };

void ReadLimit(vtkOpenGLState* state, unsigned int name, std::size_t& limit)
{
  int value = 0;
  state->vtkglGetIntegerv(name, &value);
  limit = value > 0 ? static_cast<std::size_t>(value) : limit;
}

// What VTK's mapper hands to its subclasses only: pointers to members that are named through a
// subclass reach them in any of its objects.
class Inside : public vtkOpenGLPolyDataMapper
{
public:
  static auto& GetPrimitives(vtkOpenGLPolyDataMapper* mapper)
  {
    return mapper->*(&Inside::Primitives);
  }
  static vtkOpenGLHelper* GetLastBound(vtkOpenGLPolyDataMapper* mapper)
  {
    return mapper->*(&Inside::LastBoundBO);
  }
  static auto& GetInfo(vtkOpenGLPolyDataMapper* mapper, const vtkOpenGLHelper* cellBO)
  {
    return (mapper->*(&Inside::PrimitiveInfo))[cellBO];
  }
  static bool DrawsOwnPrimitives(vtkOpenGLPolyDataMapper* mapper)
  {
    return !(mapper->*(&Inside::DrawingSelection)) && !(mapper->*(&Inside::DrawingVertices));
  }
  static bool HasCellScalars(vtkOpenGLPolyDataMapper* mapper)
  {
    return mapper->*(&Inside::HaveCellScalars);
  }
  static std::size_t CountExtraAttributes(vtkOpenGLPolyDataMapper* mapper)
  {
    return (mapper->*(&Inside::ExtraAttributes)).size();
  }
  static bool DrawsEdges(vtkOpenGLPolyDataMapper* mapper, vtkRenderer* ren, vtkActor* actor)
  {
    return (mapper->*(&Inside::DrawingEdges))(ren, actor);
  }
  static auto FindTextures(vtkOpenGLPolyDataMapper* mapper, vtkActor* actor)
  {
    return (mapper->*(&Inside::GetTextures))(actor);
  }
  static void RestartPrimitives(vtkOpenGLPolyDataMapper* mapper)
  {
    mapper->*(&Inside::PrimitiveIDOffset) = 0;
  }
};

// Of a vertex array: the tuples that have a value which is not finite or, as directions, no length.
vtkIdType CountBadTuples(vtkDataArray* array, bool areDirections = false)
{
  vtkIdType bad = 0;
  std::vector<double> tuple(array ? static_cast<std::size_t>(array->GetNumberOfComponents()) : 0);
  for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
  {
    array->GetTuple(k, tuple.data());
    double sum = 0.0;
    bool any = false;
    for (const double value : tuple)
    {
      sum += value * 0.0; // NaN where a value is not finite
      any = any || value != 0.0;
    }
    bad += sum == 0.0 && (any || !areDirections) ? 0 : 1;
  }
  return bad;
}

// As VTK's shaders have it: cameras of headsets have a matrix for each eye.
void FindWorldToView(vtkRenderer* renderer, vtkMatrix4x4* toView)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  auto* openGL = vtkOpenGLCamera::SafeDownCast(camera);
  if (!openGL)
  {
    toView->DeepCopy(camera->GetModelViewTransformMatrix());
    return;
  }
  vtkMatrix4x4 *worldToView, *viewToDisplay, *worldToDisplay;
  vtkMatrix3x3* normals;
  openGL->GetKeyMatrices(renderer, worldToView, normals, viewToDisplay, worldToDisplay);
  vtkMatrix4x4::Transpose(worldToView, toView); // OpenGL's order
}

// From view coordinates to the environment's own axes. One matrix, because a fragment's directions
// are turned where software renderers pay for each multiplication.
glm::mat3 GetViewToEnvironment(vtkRenderer* renderer, vtkEnvironment* environment)
{
  const vtkNew<vtkMatrix4x4> toView;
  FindWorldToView(renderer, toView);
  const glm::dmat3 viewToWorld(glm::make_mat4(toView->GetData())); // rows: the transpose
  return GetWorldToEnvironment(renderer, environment) * viewToWorld;
}

// slots: none where there is one material.
std::vector<ShaderMember> GetShaderMembers(
  const DrawnMaterials& materials, const std::vector<int>& slots, const OcclusionLights& lights)
{
  std::vector<ShaderMember> members;
  for (std::size_t k = 0; k < materials.size(); ++k)
  {
    const DrawnMaterial& drawn = *materials[k];
    members.push_back({ drawn.Material ? &drawn.Material->GetInputs() : nullptr,
      drawn.Radiance ? &drawn.Radiance->GetInputs() : nullptr, k < slots.size() ? slots[k] : 0,
      k < lights.size() ? lights[k] : nullptr });
  }
  return members;
}

bool AreAllEvaluated(const std::vector<ShaderMember>& members)
{
  return std::all_of(members.begin(), members.end(),
    [](const ShaderMember& member) { return member.Material != nullptr; });
}

bool Contains(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}
}

void AddAfterTag(vtkShader* shader, const std::string& tag, const std::string& lines)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, tag, tag + "\n" + lines, false);
  shader->SetSource(source);
}

ShaderLimits ShaderLimits::Read(vtkOpenGLState* state)
{
  ShaderLimits limits;
  ReadLimit(state, GL_MAX_VERTEX_ATTRIBS, limits.Attributes);
  ReadLimit(state, GL_MAX_VARYING_COMPONENTS, limits.Varyings);
  limits.Attributes = std::min<std::size_t>(limits.Attributes, LargestAttributes);
  limits.Varyings = std::min<std::size_t>(limits.Varyings, LargestVaryings);
  return limits;
}

void ShaderLimits::SetMost(std::size_t attributes, std::size_t varyings)
{
  LargestAttributes = attributes > 0 ? attributes : Unlimited;
  LargestVaryings = varyings > 0 ? varyings : Unlimited;
}

MaterialShading::MaterialShading(
  vtkOpenGLPolyDataMapper* mapper, std::shared_ptr<MaterialDrawing> drawing)
  : Drawing(std::move(drawing))
  , Mapper(mapper)
{
}

MaterialShading::~MaterialShading()
{
  if (this->Drawing)
  {
    this->Drawing->Forget(this->Mapper);
  }
}

void MaterialShading::DrawPiece(const Step& render, const Step& finish)
{
  const Restored inside(this->RenderDepth);
  ++this->RenderDepth;
  this->IsPlain = false;
  for (bool tries = true; tries;)
  {
    this->HasStarted = false;
    if (this->Drawing->Try(render))
    {
      return;
    }
    this->BuiltOcclusionMode = -1; // buffers may be half built
    this->ShaderKeys.clear();      // and shaders
    if (this->HasStarted)
    {
      this->ShowOnly(-1);
      finish();
    }
    tries = !this->IsPlain;
    this->IsPlain = true;
  }
}

void MaterialShading::StartPiece(
  vtkRenderer* ren, vtkActor* actor, const Step& start, const Step& draw)
{
  if (!this->IsPlain)
  {
    this->Drawing->BeginFrame(ren, actor, this->Mapper, this->GetBRDFs());
  }
  // Each distance and each edge's equation takes a vector of four. (DrawingEdges would want
  // buffers.)
  vtkProperty* property = actor->GetProperty();
  const bool edges = property->GetEdgeVisibility() && property->GetRepresentation() == VTK_SURFACE;
  this->VaryingsOfBase =
    4 * ((this->Mapper->GetNumberOfClippingPlanes() > 0 ? 6 : 0) + (edges ? 3 : 0));
  start();
  this->HasStarted = true;
  this->Drawing->AddSamples(ren, actor, this->Mapper,
    [&]()
    {
      Inside::RestartPrimitives(this->Mapper);
      draw();
    });
  Inside::RestartPrimitives(this->Mapper);
}

void MaterialShading::DrawMaterials(const Step& draw)
{
  const std::vector<DrawnMaterial>& materials = this->Drawing->GetMaterials();
  if (materials.empty())
  {
    draw();
    return;
  }
  // Those of one shader after the other.
  std::vector<std::size_t> order(materials.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&materials](std::size_t a, std::size_t b) { return materials[a].Key < materials[b].Key; });
  for (std::size_t material : order)
  {
    this->ShowOnly(static_cast<int>(material));
    this->Drawing->Select(material);
    draw();
  }
  this->Drawing->Unselect();
  this->ShowOnly(-1);
}

void MaterialShading::FinishPiece(const Step& finish)
{
  this->Drawing->EndFrame();
  finish();
}

void MaterialShading::ReleaseMaterials(vtkWindow* window)
{
  // From inside of RenderPiece VTK's class lets go of one window since another draws: the textures
  // of the first stay, for its next frame.
  if (this->Drawing && this->RenderDepth == 0)
  {
    this->Drawing->ReleaseGraphicsResources(window, this->Mapper);
  }
}

bool MaterialShading::AreBuffersOutdated() const
{
  return this->BuiltOcclusionMode != this->Drawing->GetSettings().OcclusionMode ||
         this->BuiltOcclusionBounce != this->Drawing->GetSettings().OcclusionBounce ||
         this->BuiltTracedOcclusion != this->Drawing->GetTracedOcclusion(this->Mapper);
}

void MaterialShading::PrepareBuffers(vtkRenderer* ren)
{
  this->BuiltOcclusionMode = this->Drawing->GetSettings().OcclusionMode;
  this->BuiltOcclusionBounce = this->Drawing->GetSettings().OcclusionBounce;
  this->BuiltTracedOcclusion = this->Drawing->GetTracedOcclusion(this->Mapper);
  this->Limits = ShaderLimits::Read(static_cast<vtkOpenGLRenderer*>(ren)->GetState());
  this->Drawing->BeginOcclusion(this->Mapper);
  this->HasBadNormals = false;
  this->AddOcclusion(ren);
}

void MaterialShading::AddOcclusion(vtkRenderer* ren)
{
  vtkPolyData* surface = this->Mapper->CurrentInput;
  this->CheckVertices(surface);
  const auto arrays = this->Drawing->FindOcclusion(surface, this->Mapper, this->IsPart());
  this->Sides = {};
  this->Sides.Add(arrays.get());
  this->Occlusion = { arrays ? *arrays : OcclusionArrays() };
  this->Occlusion.front().ForEachAttribute([&](const std::string& name, vtkDataArray* values)
    { this->Mapper->GetVBOs()->CacheDataArray(name.c_str(), values, ren, VTK_FLOAT); });
}

void MaterialShading::CheckVertices(vtkPolyData* surface)
{
  if (!surface)
  {
    return;
  }
  vtkPointData* points = surface->GetPointData();
  vtkDataArray* normals = points->GetNormals();
  const vtkIdType bad =
    CountBadTuples(normals ? normals : surface->GetCellData()->GetNormals(), true);
  this->HasBadNormals = this->HasBadNormals || bad > 0;
  std::string text;
  const auto add = [&text](vtkIdType count, const char* words)
  {
    if (count > 0)
    {
      text += (text.empty() ? "" : "; ") + std::to_string(count) + words;
    }
  };
  add(
    bad, " of the surface's normals are not finite or have no length: facets there have their own");
  add(CountBadTuples(points->GetTangents()),
    " of its tangents are not finite: any direction is taken there");
  add(CountBadTuples(points->GetTCoords()), " of its texture coordinates are not finite");
  add(surface->GetPoints() ? CountBadTuples(surface->GetPoints()->GetData()) : 0,
    " of its points are not finite: their polygons are not drawn");
  if (!text.empty() && !this->Drawing->GetMaterials().empty())
  {
    this->Drawing->WarnOnce("vertices", text + ".");
  }
}

bool MaterialShading::HasBuffer(const char* name, int components) const
{
  return this->Mapper->GetVBOs()->GetNumberOfComponents(name) == components;
}

bool MaterialShading::HasTangents() const { return this->HasBuffer("tangentMC", 3); }

bool MaterialShading::HasScalarColors()
{
  return this->Mapper->GetScalarVisibility() && !this->IgnoresScalars() &&
         (!this->HasBuffer("scalarColor", 0) || Inside::HasCellScalars(this->Mapper) ||
           this->Mapper->GetColorTextureMap());
}

bool MaterialShading::UsesMaterial(const vtkOpenGLHelper* cellBO) const
{
  if (this->Drawing->GetSelected().IsEmpty() || !Inside::DrawsOwnPrimitives(this->Mapper))
  {
    return false;
  }
  const auto& primitives = Inside::GetPrimitives(this->Mapper);
  return cellBO == &primitives[vtkOpenGLPolyDataMapper::PrimitiveTris] ||
         cellBO == &primitives[vtkOpenGLPolyDataMapper::PrimitiveTriStrips];
}

std::string MaterialShading::GetShaderKey(const vtkOpenGLHelper* cellBO)
{
  if (!this->UsesMaterial(cellBO))
  {
    return "";
  }
  const SurfaceOcclusion occlusion = this->GetOcclusion();
  const char* const stages[] = { "", "/others", "/add", "/show" };
  return this->Drawing->GetSelected().GetKey() +
         stages[static_cast<int>(this->Drawing->GetSums().GetStage())] +
         (this->HasTangents() ? "/tangents" : "") + (this->HasScalarColors() ? "/colors" : "") +
         (this->HasBadNormals ? "/bad normals" : "") +
         GetOcclusionKey(occlusion.Lights, occlusion.Layout);
}

int MaterialShading::FindSuperfluousLight(vtkRenderer* ren) const
{
  return measuredbrdf::FindSuperfluousLight(
    ren, this->Drawing->GetSelected().Get().front()->Integrator != nullptr); // all or none
}

bool MaterialShading::AreShadersOutdated(const vtkOpenGLHelper& cellBO, vtkRenderer* ren)
{
  std::string key = this->GetShaderKey(&cellBO);
  if (!key.empty())
  {
    key += "/without light " + std::to_string(this->FindSuperfluousLight(ren));
  }
  std::string& last = this->ShaderKeys[&cellBO];
  const bool changed = key != last;
  last = std::move(key);
  return changed;
}

void MaterialShading::ReplaceValues(Shaders shaders, vtkActor* actor, const Step& replace)
{
  const vtkOpenGLHelper* cellBO = Inside::GetLastBound(this->Mapper);
  if (!this->UsesMaterial(cellBO))
  {
    replace();
    return;
  }
  // VTK's mapper declares normals and positions for lit primitives only; an environment lights
  // scenes without a single vtkLight. An int (VTK < 9.4) or the enum that followed.
  auto& complexity = Inside::GetInfo(this->Mapper, cellBO).LastLightComplexity;
  this->LightComplexity = static_cast<int>(complexity);
  const Restored own(complexity);
  complexity = static_cast<std::decay_t<decltype(complexity)>>(std::max(this->LightComplexity, 1));
  replace();
  // VTK's mapper multiplies encoded radiance by the actor's texture.
  std::string fs = shaders[vtkShader::Fragment]->GetSource();
  for (const auto& texture : Inside::FindTextures(this->Mapper, actor))
  {
    if (texture.first->GetUseSRGBColorSpace() && !texture.first->GetCubeMap())
    {
      vtkShaderProgram::Substitute(
        fs, "= texture(" + texture.second + ", ", "= brdfDisplayTexel(" + texture.second + ", ");
    }
  }
  shaders[vtkShader::Fragment]->SetSource(fs);
}

void MaterialShading::PassOn(
  Shaders shaders, const std::string& type, const std::string& name, const std::string& value)
{
  const std::string declarations = "//VTK::PositionVC::Dec";
  const std::string code = "//VTK::PositionVC::Impl";
  vtkShader* vertex = shaders[vtkShader::Vertex];
  vtkShader* geometry = shaders[vtkShader::Geometry];
  AddAfterTag(vertex, declarations, "out " + type + " " + name + "VSOutput;\n");
  AddAfterTag(vertex, code, "  " + name + "VSOutput = " + value + ";\n");
  AddAfterTag(geometry, declarations,
    "in " + type + " " + name + "VSOutput[];\nout " + type + " " + name + "GSOutput;\n");
  AddAfterTag(geometry, code, "  " + name + "GSOutput = " + name + "VSOutput[i];\n");
}

void MaterialShading::PassTangentsOn(Shaders shaders) const
{
  const bool declared = Contains(shaders[vtkShader::Vertex]->GetSource(), "in vec3 tangentMC;");
  AddAfterTag(shaders[vtkShader::Vertex], "//VTK::PositionVC::Dec",
    std::string("uniform mat3 brdfTangentMatrix;\n") + (declared ? "" : "in vec3 tangentMC;\n"));
  PassOn(shaders, "vec3", "brdfTangentVC", "brdfTangentMatrix * tangentMC");
}

bool MaterialShading::ReplaceLight(Shaders shaders, vtkRenderer* ren, vtkActor* actor)
{
  const vtkOpenGLHelper* cellBO = Inside::GetLastBound(this->Mapper);
  if (!this->UsesMaterial(cellBO))
  {
    return false;
  }
  this->WarnOfTextures(actor);
  const SelectedMaterials& selected = this->Drawing->GetSelected();
  ShaderBody body;
  if (selected.AreAnyAnisotropic())
  {
    body.Tangents = this->HasTangents() ? TangentSource::Data : TangentSource::Axis;
    if (this->HasTangents())
    {
      this->PassTangentsOn(shaders);
    }
    else
    {
      this->Drawing->WarnOnce("tangents",
        "The material is anisotropic but the polydata has no float point tangents "
        "(PointData::SetTangents, or vtkPolyDataTangents for texture coordinates): they turn about "
        "the environment's up axis.");
    }
  }
  const auto& [lights, layout] = this->GetOcclusion();
  OcclusionText occlusion;
  if (!lights.empty())
  {
    occlusion = MakeOcclusionText(lights, layout);
    vtkShader* vertex = shaders[vtkShader::Vertex];
    vtkShader* geometry = shaders[vtkShader::Geometry];
    AddAfterTag(vertex, "//VTK::PositionVC::Dec", occlusion.VertexDeclarations);
    AddAfterTag(vertex, "//VTK::PositionVC::Impl", occlusion.VertexCode);
    AddAfterTag(geometry, "//VTK::PositionVC::Dec", occlusion.GeometryDeclarations);
    AddAfterTag(geometry, "//VTK::PositionVC::Impl", occlusion.GeometryCode);
  }
  const MixtureText& mixture = selected.GetMixture();
  const std::vector<ShaderMember> members = GetShaderMembers(selected.Get(), mixture.Slots, lights);
  std::string fs = shaders[vtkShader::Fragment]->GetSource();
  const SumStage stage = this->Drawing->GetSums().GetStage();
  std::string declarations =
    body.Tangents == TangentSource::Data ? "in vec3 brdfTangentVCVSOutput;\n" : "";
  declarations +=
    occlusion.FragmentDeclarations + mixture.Declarations + GetShaderDeclarations(members, stage);
  if (Contains(fs, "anisotropyUniform"))
  {
    // VTK's mapper turned the tangents by a PBR property's anisotropy, with what its lights would
    // have declared.
    declarations += "uniform float anisotropyUniform;\nconst float PI = 3.14159265359;\n";
  }
  const std::string uniforms(static_cast<vtkOpenGLRenderer*>(ren)->GetLightingUniforms());
  vtkShaderProgram::Substitute(fs, "//VTK::Light::Dec", uniforms + "\n" + declarations, false);
  body.Weights = occlusion.FragmentCode + mixture.Implementation;
  body.SuperfluousLight = this->FindSuperfluousLight(ren);
  body.LightCount = Inside::GetInfo(this->Mapper, cellBO).LastLightCount;
  // Image-based lighting counts as a light in VTK 9.6; here it is none.
  const bool adds = IsOfSum(stage);
  const bool lit = AreAllEvaluated(members) && !adds &&
                   body.LightCount > (body.SuperfluousLight >= 0 ? 1 : 0) &&
                   this->Drawing->GetSettings().UseSceneLights;
  body.Complexity = lit ? this->LightComplexity : 0;
  body.Stage = stage;
  body.HasBadNormals = this->HasBadNormals;
  body.HasEdges = Inside::DrawsEdges(this->Mapper, ren, actor);
  body.HasEdgeOpacity = Contains(fs, "uniform float edgeOpacity");
  body.EdgesAreTubes = Contains(fs, "vec3 tnorm"); // as VTK's mapper bent normals
  body.HasBlockColors = Contains(fs, "uniform bool OverridesColor");
  body.HasColors = this->HasScalarColors() || this->IsPart(); // which serves all blocks
  vtkShaderProgram::Substitute(fs, "//VTK::Light::Impl", GetShaderBody(body), false);
  if (adds) // whatever else writes a color
  {
    vtkShaderProgram::Substitute(
      fs, "//VTK::Coincident::Impl", "//VTK::Coincident::Impl\n" + GetSumOutput(stage), false);
  }
  shaders[vtkShader::Fragment]->SetSource(fs);
  return true;
}

void MaterialShading::WarnOfTextures(vtkActor* actor)
{
  const auto textures = Inside::FindTextures(this->Mapper, actor);
  for (const char* name :
    { "albedoTex", "materialTex", "emissiveTex", "anisotropyTex", "coatNormalTex" })
  {
    if (std::any_of(textures.begin(), textures.end(),
          [name](const auto& texture) { return texture.second == name; }))
    {
      this->Drawing->WarnOnce(name,
        "The property's texture " + std::string(name) +
          " has no effect: the surface reflects as the measured material does. An actor's own "
          "texture and scalars multiply its radiance.");
    }
  }
}

void MaterialShading::SetMapperUniforms(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  if (!this->UsesMaterial(&cellBO))
  {
    return;
  }
  vtkShaderProgram* program = cellBO.Program;
  const DrawnMaterials& materials = this->Drawing->GetSelected().Get();
  for (std::size_t k = 0; k < materials.size(); ++k)
  {
    for (const auto& textures : { materials[k]->Material, materials[k]->Radiance })
    {
      if (textures)
      {
        textures->SetUniforms(program, GetFirstInstance(k));
      }
    }
    glm::mat3 rotation = GetViewToEnvironment(ren, materials[k]->Environment);
    program->SetUniformMatrix3x3(GetRotationName(k).c_str(), &rotation[0].x);
  }
  if (program->IsUniformUsed("brdfTangentMatrix"))
  {
    // Tangents are directions of the surface: they turn and stretch with it, as normals do not.
    vtkNew<vtkMatrix4x4> toView;
    vtkMatrix4x4::Multiply4x4(
      ren->GetActiveCamera()->GetModelViewTransformMatrix(), actor->GetMatrix(), toView);
    glm::mat3 matrix(glm::transpose(glm::make_mat4(toView->GetData())));
    program->SetUniformMatrix3x3("brdfTangentMatrix", &matrix[0].x);
  }
  this->Drawing->GetSums().SetUniforms(program);
  this->SetOcclusionUniforms(program, ren, actor);
  const bool modulate = this->Drawing->GetSettings().ScalarColoringMode != 0;
  program->SetUniformi("brdfModulate", modulate ? (this->HasScalarColors() ? 2 : 1) : 0);
}

void MaterialShading::SetPropertyUniforms(vtkOpenGLHelper& cellBO, vtkActor* actor)
{
  if (!this->UsesMaterial(&cellBO))
  {
    return;
  }
  // The measured material has no coefficient for VTK's "diffuse" part.
  cellBO.Program->SetUniformf("diffuseIntensity", 1.0f);
  if (vtkProperty* back = actor->GetBackfaceProperty())
  {
    // VTK's mapper sets these where its own lighting reads them.
    cellBO.Program->SetUniformf("opacityUniformBF", static_cast<float>(back->GetOpacity()));
    cellBO.Program->SetUniform3f("diffuseColorUniformBF", back->GetDiffuseColor());
    cellBO.Program->SetUniformf("diffuseIntensityBF", 1.0f);
  }
}

// Whether a vertex shader may read so many attributes, and the stages hand on so much, with what
// VTK's mapper and parts of material maps add.
bool MaterialShading::FitsOcclusion(const SurfaceOcclusion& occlusion) const
{
  std::size_t own = Inside::CountExtraAttributes(this->Mapper);
  for (const char* name : { "vertexMC", "normalMC", "scalarColor", "tcoord", "tangentMC" })
  {
    own += this->HasBuffer(name, 0) ? 0 : 1;
  }
  const OcclusionNeeds needs = CountOcclusionNeeds(occlusion.Lights, occlusion.Layout);
  // Tangents may be handed on twice, as VTK's and turned by ours.
  return own + needs.Attributes <= this->Limits.Attributes &&
         4 * (own + 1) + this->VaryingsOfBase + needs.Varyings <= this->Limits.Varyings;
}

// What the buffers have, or the part of it that the graphics card has room for: without what comes
// back, then of one side, then nothing.
MaterialShading::SurfaceOcclusion MaterialShading::GetOcclusion()
{
  SurfaceOcclusion occlusion;
  occlusion.Lights = this->Drawing->GetSelectedOcclusion(this->HasOcclusion());
  if (occlusion.Lights.empty())
  {
    return occlusion;
  }
  OcclusionLayout& layout = occlusion.Layout;
  layout = { this->HasBuffer("brdfSkyBack0", 4), this->HasBuffer("brdfBounce", 3) };
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
  if (*leftOut)
  {
    this->Drawing->WarnOnce(leftOut,
      "The surface is drawn " + std::string(leftOut) + ": shaders of this graphics card may have " +
        std::to_string(this->Limits.Attributes) + " vertex attributes and " +
        std::to_string(this->Limits.Varyings) + " components of varyings.");
  }
  return occlusion;
}

void MaterialShading::SetOcclusionUniforms(
  vtkShaderProgram* program, vtkRenderer* ren, vtkActor* actor)
{
  const auto& [lights, layout] = this->GetOcclusion();
  if (lights.empty())
  {
    return;
  }
  std::vector<vtkEnvironment*> environments;
  for (const DrawnMaterial* drawn : this->Drawing->GetSelected().Get())
  {
    environments.push_back(drawn->Environment);
  }
  const OcclusionAxes axes(ren, actor, environments);
  OcclusionSides sides = this->Sides;
  sides.Both = layout.TwoSided; // what there is room for
  sides.Bounced = layout.Bounced;
  measuredbrdf::SetOcclusionUniforms(program, lights, sides, axes.ToModel,
    ren->GetActiveCamera()->GetParallelProjection() != 0, axes.ToEnvironment);
}
} // namespace measuredbrdf
