// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassesMapper.h"

#include "ClassTriangles.h"
#include "PartArrays.h"
#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <unordered_set>
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
    this->SetBorders();
    if (this->Borders)
    {
      surfaces.push_back(this->Borders);
    }
    this->StacksOf.Clear();
    this->Stacks = nullptr;
    this->StackIndices.clear();
  }
  this->HasClassWithoutMaterial = std::any_of(parts->Get().begin(), parts->Get().end(),
    [](const MaterialPart& part) { return part.Kind == MixtureKind::Nearest && part.IsRest; });
  all.Surface = same ? vtkSmartPointer<vtkPolyData>(this->GetInput()) : JoinCells(surfaces);
  const bool hasBorders = all.Kind == MixtureKind::Nearest;
  this->SetPart(parts, std::move(all), map);
  if (hasBorders)
  {
    this->MapDataArrayToVertexAttribute(
      partarrays::Class, partarrays::Class, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  }
}

// Each polygon as the first of its classes has it, so that triangles of stacks have numbers by
// which colors and normals of cells are found.
void ClassesMapper::SetBorders()
{
  this->Borders = nullptr;
  this->BorderPolygons.clear();
  std::unordered_set<vtkIdType> known;
  vtkNew<vtkIdList> corners;
  for (const Class& one : this->Classes)
  {
    if (one.Slot < 0)
    {
      continue;
    }
    if (!this->Borders)
    {
      this->Borders = vtkSmartPointer<vtkPolyData>::New();
      this->Borders->SetPoints(one.Surface->GetPoints());
      this->Borders->SetPolys(vtkNew<vtkCellArray>());
      this->Borders->GetCellData()->CopyAllOn();
      this->Borders->GetCellData()->CopyAllocate(one.Surface->GetCellData());
    }
    for (std::size_t k = 0; k < one.Polygons.size(); ++k)
    {
      const auto cell = static_cast<vtkIdType>(k);
      if (known.insert(one.Polygons[k]).second)
      {
        one.Surface->GetPolys()->GetCellAtId(cell, corners);
        this->Borders->GetCellData()->CopyData(
          one.Surface->GetCellData(), cell, this->Borders->GetPolys()->InsertNextCell(corners));
        this->BorderPolygons.push_back(one.Polygons[k]);
      }
    }
  }
}

// Instead of the superclass's, which would be of all classes together.
void ClassesMapper::BuildIBO(vtkRenderer* ren, vtkActor* actor, vtkPolyData* surface)
{
  this->HasEdges = actor->GetProperty()->GetEdgeVisibility();
  if (this->HasEdges) // which edges are those of polygons, by the numbers of all triangles
  {
    this->Superclass::BuildIBO(ren, actor, surface);
  }
  if (this->AreBuilt)
  {
    return;
  }
  this->OwnWindow = vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow());
  int first = 0;
  this->Stacks = nullptr;
  for (Class& one : this->Classes)
  {
    one.FirstPrimitive = first;
    first += CountTriangles(one.Surface);
  }
  this->FirstBorder = first;
  vtkCellArray* all = this->GetInput()->GetPolys();
  this->MayBeNumbered = CountTriangles(this->GetInput()) ==
                        all->GetNumberOfConnectivityIds() - 2 * all->GetNumberOfCells();
  this->MakeAllIndices();
  this->AreBuilt = true;
}

// Of all that each class draws itself, and each stack.
void ClassesMapper::MakeAllIndices()
{
  const auto get = this->AreNumbered ? GetNumberedTriangles : GetTriangles;
  for (Class& one : this->Classes)
  {
    one.Indices = MakeIndices(
      one.Slot < 0 || !this->Stacks
        ? GetTriangles(one.Surface, [](vtkIdType) { return true; })
        : get(one.Surface, [&](vtkIdType k)
            { return this->Stacks->FindStack(one.Polygons[static_cast<std::size_t>(k)]) < 0; }));
  }
  this->StackIndices.clear();
  for (int stack = 0; this->Stacks && stack < static_cast<int>(this->Stacks->Get().size()); ++stack)
  {
    this->StackIndices.push_back(MakeIndices(get(this->Borders,
      [&](vtkIdType k) {
        return this->Stacks->FindStack(this->BorderPolygons[static_cast<std::size_t>(k)]) == stack;
      })));
  }
}

// Views of the same materials have the same stacks.
std::shared_ptr<ClassStacks>& ClassesMapper::FindStacks(
  const Place& place, const DrawnMaterials& materials)
{
  std::shared_ptr<ClassStacks>& own = this->StacksOf[place];
  if (own && own->IsOf(materials, place.first))
  {
    return own;
  }
  for (const auto& [other, stacks] : this->StacksOf)
  {
    if (other.first == place.first && stacks && stacks->IsOf(materials, place.first))
    {
      own = stacks;
      return own;
    }
  }
  if (!own || own.use_count() > (own == this->Stacks ? 2 : 1)) // another view has it, too
  {
    own = std::make_shared<ClassStacks>();
  }
  return own;
}

// Shadows have numbers of each material.
void ClassesMapper::UpdateStacks(vtkRenderer* ren)
{
  std::vector<ClassBorder> borders;
  DrawnMaterials materials;
  const bool may = this->Borders && this->GetMap()->GetStackClasses() && !this->HasOcclusion() &&
                   (this->MayBeNumbered || !this->NeedsNumbers());
  for (std::size_t k = 0; k < this->Classes.size() && may; ++k)
  {
    const Class& one = this->Classes[k];
    if (one.Slot >= 0)
    {
      borders.push_back({ one.Number, &one.Polygons });
      materials.push_back(&this->Drawing->GetMaterials()[k]);
    }
  }
  const Place place(vtkOpenGLRenderWindow::SafeDownCast(ren->GetVTKWindow()), ren);
  if (borders.empty())
  {
    this->StacksOf.RemoveIf([&place](const Place& key, const auto&) { return key == place; });
    if (this->Stacks)
    {
      this->Stacks = nullptr;
      this->MakeAllIndices();
    }
    this->AreBordersLoose = this->GetText() != nullptr && !this->Drawing->IsPending();
    return;
  }
  const std::shared_ptr<ClassStacks>& stacks = this->FindStacks(place, materials);
  if (!stacks->Update(borders, materials, this->HasClassWithoutMaterial, place.first) &&
      this->Stacks == stacks && this->AreNumbered == this->NeedsNumbers())
  {
    return;
  }
  this->Stacks = stacks;
  this->AreNumbered = this->NeedsNumbers();
  // What stands in for plans does not decide.
  this->AreBordersLoose = this->Stacks->AreMostLoose() && !this->Drawing->IsPending();
  this->MakeAllIndices();
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
  this->InStack = false;
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
    const ClassStack& stack = *this->Stacks->Get()[k];
    this->ShowIndices(this->StackIndices[k]);
    this->PrimitiveIDOffset = this->FirstBorder;
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
    AddVarying(
      shaders, { "vec4", MixtureShader::ClassAttribute, std::string("float ") + partarrays::Class,
                 std::string(partarrays::Class) + " * " + partarrays::GetWeights(0) });
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
  if (this->RenderDepth == 0)
  {
    this->Stacks = nullptr;
    this->StacksOf.RemoveIf(
      [window](const Place& place, const auto&) { return place.first == window; });
  }
  this->Superclass::ReleaseGraphicsResources(window);
}
} // namespace measuredbrdf
