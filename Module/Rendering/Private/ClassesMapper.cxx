// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassesMapper.h"

#include "vtkMeasuredBRDFMapperMixin.txx"

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
#include <utility>

namespace measuredbrdf
{
vtkStandardNewMacro(ClassesMapper);

namespace
{
constexpr std::size_t MostShaders = 64; // plans that change over time leave some behind

// Values need not be copied.
template <typename Value>
void Exchange(std::map<const vtkOpenGLHelper*, Value>& values, const vtkOpenGLHelper* a,
  const vtkOpenGLHelper* b)
{
  values[a];
  values[b];
  auto first = values.extract(a);
  auto second = values.extract(b);
  std::swap(first.key(), second.key());
  values.insert(std::move(first));
  values.insert(std::move(second));
}

// The cells of all parts, in their order; the points are the same.
vtkSmartPointer<vtkPolyData> Join(const std::vector<vtkPolyData*>& surfaces)
{
  auto whole = vtkSmartPointer<vtkPolyData>::New();
  whole->SetPoints(surfaces.front()->GetPoints());
  whole->GetPointData()->ShallowCopy(surfaces.front()->GetPointData());
  whole->GetFieldData()->ShallowCopy(surfaces.front()->GetFieldData());
  vtkIdType count = 0;
  for (vtkPolyData* surface : surfaces)
  {
    count += surface->GetNumberOfCells();
  }
  vtkNew<vtkCellArray> polygons;
  vtkCellData* data = whole->GetCellData();
  data->CopyAllOn();
  data->CopyAllocate(surfaces.front()->GetCellData(), count);
  for (vtkPolyData* surface : surfaces)
  {
    data->CopyData(
      surface->GetCellData(), polygons->GetNumberOfCells(), surface->GetNumberOfCells(), 0);
    polygons->Append(surface->GetPolys(), 0);
  }
  whole->SetPolys(polygons);
  return whole;
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
  return property->GetRepresentation() == VTK_SURFACE && !property->GetEdgeVisibility() &&
         !property->GetVertexVisibility();
}

bool ClassesMapper::IsSingle(const MaterialPart& part)
{
  return part.Kind == MixtureKind::Single && part.Members.size() == 1;
}

void ClassesMapper::SetParts(
  const MaterialParts* parts, const std::vector<std::size_t>& numbers, vtkMaterialMap* map)
{
  MaterialPart all;
  std::vector<vtkPolyData*> surfaces;
  for (std::size_t number : numbers)
  {
    const MaterialPart& part = parts->Get()[number];
    all.Members.push_back(part.Members.front());
    surfaces.push_back(part.Surface);
  }
  // Where only settings have changed, buffers stay. Divided data are new objects.
  const bool same = std::equal(this->Classes.begin(), this->Classes.end(), surfaces.begin(),
    surfaces.end(), [](const Class& one, vtkPolyData* surface) { return one.Surface == surface; });
  if (!same)
  {
    this->ReleaseIndices();
    this->Classes.clear();
    for (vtkPolyData* surface : surfaces)
    {
      this->Classes.push_back({ surface, nullptr, 0 });
    }
  }
  all.Surface = same ? vtkSmartPointer<vtkPolyData>(this->GetInput()) : Join(surfaces);
  this->SetPart(parts, std::move(all), map);
}

// Instead of the superclass's, which would be of all classes together.
void ClassesMapper::BuildIBO(vtkRenderer* ren, vtkActor*, vtkPolyData*)
{
  if (this->AreBuilt)
  {
    return;
  }
  this->OwnWindow = vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow());
  int first = 0;
  for (Class& one : this->Classes)
  {
    one.Indices = vtkSmartPointer<vtkOpenGLIndexBufferObject>::New();
    one.Indices->CreateTriangleIndexBuffer(
      one.Surface->GetPolys(), one.Surface->GetPoints(), nullptr, nullptr);
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
    return;
  }
  const Class& shown = this->Classes[static_cast<std::size_t>(material)];
  polygons.IBO = shown.Indices;
  this->PrimitiveIDOffset = shown.FirstPrimitive;
}

void ClassesMapper::RenderPieceDraw(vtkRenderer* ren, vtkActor* actor)
{
  this->Last = nullptr;
  this->Superclass::RenderPieceDraw(ren, actor);
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
  Exchange(this->PrimitiveInfo, &polygons, other.get());
  Exchange(this->ShaderKeys, &polygons, other.get());
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
  const DrawnMaterial* last = this->Last;
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
  if (this->HaveCellScalars || this->HaveCellNormals)
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
  this->UseShadersOf(this->GetShaderKey(&cellBO));
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
