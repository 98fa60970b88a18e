// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassesMapper.h"

#include "vtkMeasuredBRDFMapperMixin.txx"

#include "PartArrays.h"
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
      for (const auto& indices : this->StackIndices)
      {
        indices->ReleaseGraphicsResources();
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
      classes.back().Number = part.Class;
      classes.back().Polygons = part.Polygons;
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
    this->StacksOf.clear();
    this->Stacks = nullptr;
    this->StackIndices.clear();
  }
  this->HasClassWithoutMaterial = std::any_of(parts->Get().begin(), parts->Get().end(),
    [](const MaterialPart& part) { return part.Kind == MixtureKind::Nearest && part.IsRest; });
  all.Surface = same ? vtkSmartPointer<vtkPolyData>(this->GetInput()) : Join(surfaces);
  const bool hasBorders = all.Kind == MixtureKind::Nearest;
  this->SetPart(parts, std::move(all), map);
  if (hasBorders)
  {
    this->MapDataArrayToVertexAttribute(
      partarrays::Class, partarrays::Class, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  }
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
  this->Stacks = nullptr;
  for (Class& one : this->Classes)
  {
    one.Indices = this->MakeIndices(one.Surface->GetPolys());
    one.FirstPrimitive = first;
    first += static_cast<int>(one.Indices->IndexCount / 3);
  }
  this->AreBuilt = true;
}

vtkSmartPointer<vtkOpenGLIndexBufferObject> ClassesMapper::MakeIndices(vtkCellArray* polygons)
{
  auto indices = vtkSmartPointer<vtkOpenGLIndexBufferObject>::New();
  indices->CreateTriangleIndexBuffer(polygons, this->GetInput()->GetPoints(), nullptr, nullptr);
  return indices;
}

// Colors and normals of cells are found by the number of a triangle, which stacks would change;
// shadows have numbers of each material.
void ClassesMapper::UpdateStacks(vtkRenderer* ren)
{
  std::vector<ClassBorder> borders;
  std::vector<std::size_t> places;
  DrawnMaterials materials;
  const bool may = !this->HaveCellScalars && !this->HaveCellNormals && !this->HasOcclusion();
  for (std::size_t k = 0; k < this->Classes.size() && may; ++k)
  {
    const Class& one = this->Classes[k];
    if (one.Slot >= 0)
    {
      borders.push_back({ one.Number, one.Surface, &one.Polygons });
      materials.push_back(&this->Drawing->GetMaterials()[k]);
      places.push_back(k);
    }
  }
  if (borders.empty())
  {
    for (std::size_t k = 0; k < this->Classes.size() && this->Stacks; ++k)
    {
      this->Classes[k].Indices = this->MakeIndices(this->Classes[k].Surface->GetPolys());
    }
    this->Stacks = nullptr;
    this->AreBordersLoose = this->GetText() != nullptr && !this->Drawing->IsPending();
    return;
  }
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow());
  std::unique_ptr<ClassStacks>& stacks = this->StacksOf[window];
  if (!stacks)
  {
    stacks = std::make_unique<ClassStacks>();
  }
  if (!stacks->Update(borders, materials, this->HasClassWithoutMaterial, window) &&
      this->Stacks == stacks.get())
  {
    return;
  }
  this->Stacks = stacks.get();
  // What stands in for plans does not decide.
  this->AreBordersLoose = this->Stacks->AreMostLoose() && !this->Drawing->IsPending();
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    this->Classes[places[k]].Indices = this->MakeIndices(this->Stacks->GetRest(k));
  }
  this->StackIndices.clear();
  for (const std::unique_ptr<ClassStacks::Stack>& stack : this->Stacks->Get())
  {
    this->StackIndices.push_back(this->MakeIndices(stack->Polygons));
  }
}

// Null: those of the superclass again.
void ClassesMapper::ShowIndices(vtkOpenGLIndexBufferObject* indices)
{
  vtkOpenGLHelper& polygons = this->Primitives[PrimitiveTris];
  if (!this->Whole)
  {
    this->Whole = polygons.IBO;
  }
  polygons.IBO = indices ? indices : this->Whole;
  this->Whole = indices ? this->Whole : nullptr;
}

void ClassesMapper::ShowOnly(int material)
{
  if (material < 0)
  {
    this->ShowIndices(nullptr);
    this->Slot = -1;
    return;
  }
  const Class& shown = this->Classes[static_cast<std::size_t>(material)];
  this->ShowIndices(shown.Indices);
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
  this->UpdateStacks(ren);
  for (std::size_t k : order)
  {
    this->DrawClass(k, ren, actor);
  }
  this->DrawStacks(ren, actor);
  this->Drawing->Unselect();
  this->ShowOnly(-1);
  this->Last = nullptr;
  if (this->OtherShaders.size() > MostShaders)
  {
    this->DropShaders(ren->GetVTKWindow());
  }
}

void ClassesMapper::DrawClass(std::size_t number, vtkRenderer* ren, vtkActor* actor)
{
  if (this->Classes[number].Indices->IndexCount == 0) // stacks draw all of it
  {
    return;
  }
  this->ShowOnly(static_cast<int>(number));
  MixtureText text;
  if (this->Slot >= 0)
  {
    text = { this->GetText()->GetDeclarations(), this->GetText()->GetImplementation({}), {} };
  }
  this->Drawing->SelectMixture({ number }, std::move(text));
  this->vtkOpenGLPolyDataMapper::RenderPieceDraw(ren, actor);
}

void ClassesMapper::DrawStacks(vtkRenderer* ren, vtkActor* actor)
{
  this->InStack = true;
  this->Slot = -1;
  for (std::size_t k = 0; this->Stacks && k < this->Stacks->Get().size(); ++k)
  {
    const ClassStack& stack = *this->Stacks->Get()[k]->Materials;
    this->ShowIndices(this->StackIndices[k]);
    this->Drawing->SelectMaterial(
      stack.Get(), { this->GetText()->GetStackDeclarations() + stack.GetDeclarations(),
                     this->GetText()->GetStackImplementation() + stack.GetChoice(), {} });
    this->vtkOpenGLPolyDataMapper::RenderPieceDraw(ren, actor);
  }
  this->InStack = false;
}

// Each slot has its class times its weight, so that their quotient is the class all over a polygon.
void ClassesMapper::ReplaceShaderPositionVC(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor)
{
  if (this->InStack && this->UsesMaterial(this->LastBoundBO))
  {
    const std::string name = MixtureShader::ClassAttribute;
    std::string vertex = shaders[vtkShader::Vertex]->GetSource();
    vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Dec",
      std::string("//VTK::PositionVC::Dec\nin float ") + partarrays::Class + ";\nout vec4 " + name +
        "VCVSOutput;\n",
      false);
    vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Impl",
      "//VTK::PositionVC::Impl\n  " + name + "VCVSOutput = " + partarrays::Class + " * " +
        partarrays::GetWeights(0) + ";\n",
      false);
    shaders[vtkShader::Vertex]->SetSource(vertex);
  }
  this->Superclass::ReplaceShaderPositionVC(shaders, ren, actor);
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
  // Without a material, too, a border needs its weights.
  this->UseShadersOf(this->GetShaderKey(&cellBO) + (this->Slot >= 0 ? "/border" : ""));
  this->Superclass::UpdateShaders(cellBO, ren, actor);
}

// window need not be the one that was drawn in last.
void ClassesMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->ReleaseIndices();
  this->InOwnWindow([this]() { this->DropShaders(this->OwnWindow); });
  if (this->RenderDepth == 0)
  {
    this->Stacks = nullptr;
    this->StacksOf.erase(vtkOpenGLRenderWindow::SafeDownCast(window));
  }
  this->Superclass::ReleaseGraphicsResources(window);
}
} // namespace measuredbrdf
