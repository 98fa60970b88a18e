// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassStacks.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <new>
#include <unordered_map>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Where memory does not suffice, materials stay on their own.
bool TryBuild(ClassStack& stack, const DrawnMaterials& members, int first,
  const std::vector<int>& numbers, bool hasOthers, vtkOpenGLRenderWindow* window)
{
  try
  {
    return stack.Build(members, first, numbers, hasOthers, window);
  }
  catch (const std::bad_alloc&)
  {
    return false;
  }
}
}

ClassStacks::Origin ClassStacks::GetOrigin(const DrawnMaterial& drawn)
{
  const auto time = [](const std::shared_ptr<FormTextures>& textures)
  { return textures ? textures->GetTime() : vtkMTimeType(0); };
  return { drawn.IsReady, drawn.Material.get(), time(drawn.Material), drawn.Radiance.get(),
    time(drawn.Radiance), drawn.Environment.Get() };
}

void ClassStacks::Clear()
{
  this->Known.clear();
  this->Stacks.clear();
  this->StackOf.clear();
  this->StackOfClass.clear();
  this->Rests.clear();
  this->Window = nullptr;
}

bool ClassStacks::Update(const std::vector<ClassBorder>& borders, const DrawnMaterials& materials,
  bool hasOthers, vtkOpenGLRenderWindow* window)
{
  std::vector<Origin> known;
  for (const DrawnMaterial* drawn : materials)
  {
    known.push_back(GetOrigin(*drawn));
  }
  const bool kept = std::all_of(this->Stacks.begin(), this->Stacks.end(),
    [window](const std::unique_ptr<Stack>& stack) { return stack->Materials->IsIn(window); });
  if (known == this->Known && this->Window == window && kept)
  {
    return false;
  }
  this->Clear();
  this->Known = std::move(known);
  this->Window = window;
  this->Group(borders, materials, hasOthers, window);
  this->Distribute(borders);
  return true;
}

std::size_t ClassStacks::CountBytes(std::set<const vtkTextureObject*>& counted) const
{
  std::size_t bytes = 0;
  for (const std::unique_ptr<Stack>& stack : this->Stacks)
  {
    const DrawnMaterial& drawn = stack->Materials->Get();
    for (const std::shared_ptr<FormTextures>& textures : { drawn.Material, drawn.Radiance })
    {
      bytes += textures ? textures->CountBytes(counted) : 0;
    }
  }
  return bytes;
}

bool ClassStacks::Add(const Classes& classes, bool hasOthers, vtkOpenGLRenderWindow* window)
{
  const int first = classes.begin()->first;
  const int last = classes.rbegin()->first;
  DrawnMaterials members;
  std::vector<int> numbers;
  for (int cls = first; cls <= last; ++cls)
  {
    const auto found = classes.find(cls);
    numbers.push_back(found == classes.end() ? -1 : static_cast<int>(members.size()));
    if (found != classes.end())
    {
      members.push_back(found->second);
    }
  }
  auto stack = std::make_unique<Stack>();
  stack->Materials = std::make_unique<ClassStack>();
  if (members.size() < 2 ||
      !TryBuild(*stack->Materials, members, first, numbers, hasOthers, window))
  {
    return false;
  }
  for (const auto& [cls, material] : classes)
  {
    this->StackOfClass[cls] = static_cast<int>(this->Stacks.size());
  }
  this->Stacks.push_back(std::move(stack));
  return true;
}

void ClassStacks::Group(const std::vector<ClassBorder>& borders, const DrawnMaterials& materials,
  bool hasOthers, vtkOpenGLRenderWindow* window)
{
  std::map<std::string, std::map<std::string, Classes>> groups; // by key, then shape
  for (std::size_t k = 0; k < borders.size(); ++k)
  {
    if (materials[k]->IsReady)
    {
      groups[ClassStack::GetKey(*materials[k])][ClassStack::GetShape(*materials[k])]
            [borders[k].Class] = materials[k];
    }
  }
  for (const auto& [key, shapes] : groups)
  {
    Classes all;
    for (const auto& [shape, classes] : shapes)
    {
      all.insert(classes.begin(), classes.end());
    }
    const bool together = this->Add(all, hasOthers, window);
    for (auto it = shapes.begin(); it != shapes.end() && !together && shapes.size() > 1; ++it)
    {
      this->Add(it->second, hasOthers, window);
    }
  }
  for (const ClassBorder& border : borders)
  {
    const auto found = this->StackOfClass.find(border.Class);
    this->StackOf.push_back(found == this->StackOfClass.end() ? -1 : found->second);
  }
}

void ClassStacks::Distribute(const std::vector<ClassBorder>& borders)
{
  constexpr int several = -2;
  std::unordered_map<vtkIdType, int> stackOfPolygon;
  for (std::size_t k = 0; k < borders.size(); ++k)
  {
    for (vtkIdType polygon : *borders[k].Polygons)
    {
      const auto [place, isNew] = stackOfPolygon.try_emplace(polygon, this->StackOf[k]);
      place->second = place->second == this->StackOf[k] ? place->second : several;
    }
  }
  const auto stacked = std::count_if(stackOfPolygon.begin(), stackOfPolygon.end(),
    [](const std::pair<const vtkIdType, int>& polygon) { return polygon.second >= 0; });
  this->MostLoose = 2 * static_cast<std::size_t>(stacked) < stackOfPolygon.size();
  vtkNew<vtkIdList> corners;
  for (const ClassBorder& border : borders)
  {
    this->Rests.push_back(vtkSmartPointer<vtkCellArray>::New());
    for (std::size_t k = 0; k < border.Polygons->size(); ++k)
    {
      border.Surface->GetPolys()->GetCellAtId(static_cast<vtkIdType>(k), corners);
      int& stack = stackOfPolygon[(*border.Polygons)[k]];
      constexpr int drawn = -3;
      if (stack >= 0)
      {
        this->Stacks[static_cast<std::size_t>(stack)]->Polygons->InsertNextCell(corners);
        stack = drawn;
      }
      else if (stack != drawn)
      {
        this->Rests.back()->InsertNextCell(corners);
      }
    }
  }
}
} // namespace measuredbrdf
