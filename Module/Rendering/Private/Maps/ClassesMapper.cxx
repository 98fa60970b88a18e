// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassesMapper.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace measuredbrdf
{
vtkStandardNewMacro(ClassesMapper);

namespace
{
constexpr std::size_t MostShaders = 64; // plans that change over time leave some behind

// The cells of all surfaces, in their order. They have the points in common.
vtkSmartPointer<vtkPolyData> JoinCells(const std::vector<vtkPolyData*>& surfaces)
{
  auto whole = vtkSmartPointer<vtkPolyData>::New();
  whole->SetPoints(surfaces.front()->GetPoints());
  whole->GetPointData()->ShallowCopy(surfaces.front()->GetPointData());
  whole->GetFieldData()->ShallowCopy(surfaces.front()->GetFieldData());
  vtkNew<vtkCellArray> polygons;
  vtkCellData* data = whole->GetCellData();
  data->CopyAllOn();
  data->CopyAllocate(surfaces.front()->GetCellData());
  for (vtkPolyData* surface : surfaces)
  {
    data->CopyData(
      surface->GetCellData(), polygons->GetNumberOfCells(), surface->GetNumberOfCells(), 0);
    polygons->Append(surface->GetPolys(), 0);
  }
  whole->SetPolys(polygons);
  return whole;
}

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

ClassesMapper::ClassesMapper() = default;

ClassesMapper::~ClassesMapper()
{
  this->ReleaseIndices();
  this->InOwnWindow([this]() { this->DropShaders(this->OwnWindow); });
}

// A window that is gone took its objects with it: it had this mapper release them.
template <typename Release>
void ClassesMapper::InOwnWindow(const Release& release)
{
  if (this->OwnWindow)
  {
    this->OwnWindow->PushContext();
    release();
    this->OwnWindow->PopContext();
  }
}

void ClassesMapper::ReleaseIndices()
{
  this->InOwnWindow(
    [this]()
    {
      for (const Class& one : this->Classes)
      {
        if (one.Indices)
        {
          one.Indices->ReleaseGraphicsResources();
        }
      }
    });
  this->AreBuilt = false;
}

bool ClassesMapper::CanDraw(vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  return property->GetRepresentation() == VTK_SURFACE && !property->GetVertexVisibility();
}

bool ClassesMapper::IsSingle(const MaterialPart& part)
{
  return part.Members.size() == 1 &&
         (part.Kind == MixtureKind::Single || part.Kind == MixtureKind::Nearest);
}

void ClassesMapper::SetParts(
  const MaterialParts* parts, const std::vector<std::size_t>& numbers, vtkMaterialMap* map)
{
  MaterialPart all;
  std::vector<vtkPolyData*> surfaces;
  std::vector<Class> classes;
  for (std::size_t number : numbers)
  {
    const MaterialPart& part = parts->Get()[number];
    all.Members.push_back(part.Members.front());
    surfaces.push_back(part.Surface);
    classes.emplace_back();
    classes.back().Surface = part.Surface;
    if (part.Kind == MixtureKind::Nearest)
    {
      classes.back().Slot = part.Slot;
      all.Kind = part.Kind;
      all.NumberOfWeights = part.NumberOfWeights;
    }
  }
  // Where only settings have changed, buffers stay. Divided data are new objects.
  const bool same = std::equal(this->Classes.begin(), this->Classes.end(), surfaces.begin(),
    surfaces.end(), [](const Class& one, vtkPolyData* surface) { return one.Surface == surface; });
  if (!same)
  {
    this->ReleaseIndices();
    this->Classes = std::move(classes);
  }
  all.Surface = same ? vtkSmartPointer<vtkPolyData>(this->GetInput()) : JoinCells(surfaces);
  this->SetPart(parts, std::move(all), map);
}

// Instead of the superclass's, which would be of all classes together.
void ClassesMapper::BuildIBO(vtkRenderer* ren, vtkActor* actor, vtkPolyData* surface)
{
  if (actor->GetProperty()->GetEdgeVisibility())
  {
    // Which edges are those of polygons: VTK finds that by the numbers of all triangles.
    this->Superclass::BuildIBO(ren, actor, surface);
  }
  if (this->AreBuilt)
  {
    return;
  }
  this->OwnWindow = vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow());
  int first = 0;
  for (Class& one : this->Classes)
  {
    one.Indices = MakeIndices(one.Surface);
    one.FirstPrimitive = first;
    first += static_cast<int>(one.Indices->IndexCount / 3);
  }
  this->AreBuilt = true;
}

void ClassesMapper::ShowOnly(int material)
{
  vtkOpenGLHelper& polygons = this->Primitives[PrimitiveTris];
  if (!this->Whole)
  {
    this->Whole = polygons.IBO;
  }
  if (material < 0)
  {
    polygons.IBO = this->Whole;
    this->Whole = nullptr;
    this->Slot = -1;
    return;
  }
  const Class& shown = this->Classes[static_cast<std::size_t>(material)];
  polygons.IBO = shown.Indices;
  this->PrimitiveIDOffset = shown.FirstPrimitive;
  this->Slot = shown.Slot;
}

void ClassesMapper::RenderPieceDraw(vtkRenderer* ren, vtkActor* actor)
{
  this->Last = nullptr;
  const std::vector<DrawnMaterial>& materials = this->Drawing->GetMaterials();
  // Those of one shader after the other, borders last.
  std::vector<std::size_t> order(materials.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    {
      const bool aIsBorder = this->Classes[a].Slot >= 0;
      const bool bIsBorder = this->Classes[b].Slot >= 0;
      return aIsBorder == bIsBorder ? materials[a].Key < materials[b].Key : bIsBorder;
    });
  for (std::size_t k : order)
  {
    this->ShowOnly(static_cast<int>(k));
    this->Drawing->SelectMixture(
      { k }, this->Slot >= 0 ? this->MakeMixtureText({}) : MixtureText());
    this->vtkOpenGLPolyDataMapper::RenderPieceDraw(ren, actor);
  }
  this->Drawing->Unselect();
  this->ShowOnly(-1);
  this->Last = nullptr;
  if (this->OtherShaders.size() > MostShaders)
  {
    this->DropShaders(ren->GetVTKWindow());
  }
}

// The superclass knows one shader at a time and would make the text of each anew in every frame.
void ClassesMapper::UseShadersOf(const std::string& key)
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

void ClassesMapper::DropShaders(vtkWindow* window)
{
  for (const auto& [key, helper] : this->OtherShaders)
  {
    helper->ReleaseGraphicsResources(window);
    this->PrimitiveInfo.erase(helper.get());
    this->ShaderKeys.erase(helper.get());
  }
  this->OtherShaders.clear();
}

// A material after another of the same shader: what differs is set, all else is as it was.
bool ClassesMapper::FollowOn(vtkShaderProgram* program)
{
  const DrawnMaterials& selected = this->Drawing->GetSelected().Get();
  const DrawnMaterial* drawn = selected.empty() ? nullptr : selected.front();
  const bool ofBorder = this->Slot >= 0;
  const DrawnMaterial* last = ofBorder == this->WasOfBorder ? this->Last : nullptr;
  this->WasOfBorder = ofBorder;
  this->Last = this->HasOcclusion() ? nullptr : drawn; // shadows have numbers of each material
  if (!last || !this->Last || last->Key != drawn->Key || last->Environment != drawn->Environment)
  {
    return false;
  }
  const std::size_t instance = GetFirstInstance(0);
  if (drawn->Material)
  {
    drawn->Material->SetUniforms(program, instance, last->Material.get());
  }
  if (drawn->Radiance)
  {
    drawn->Radiance->SetUniforms(program, instance, last->Radiance.get());
  }
  if (ofBorder)
  {
    program->SetUniformi("brdfSlot", this->Slot);
  }
  if (program->IsUniformUsed("PrimitiveIDOffset"))
  {
    program->SetUniformi("PrimitiveIDOffset", static_cast<int>(this->PrimitiveIDOffset));
  }
  return true;
}

void ClassesMapper::UpdateShaders(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor)
{
  if (this->FollowOn(cellBO.Program))
  {
    return;
  }
  // Without a material, too, a border needs its weights.
  this->UseShadersOf(this->GetShaderKey(&cellBO) + (this->Slot >= 0 ? "/border" : ""));
  this->Superclass::UpdateShaders(cellBO, ren, actor);
}

// window need not be the one that was drawn in last.
void ClassesMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->ReleaseIndices();
  this->InOwnWindow([this]() { this->DropShaders(this->OwnWindow); });
  this->Superclass::ReleaseGraphicsResources(window);
}
} // namespace measuredbrdf
