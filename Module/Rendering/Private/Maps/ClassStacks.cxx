// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClassStacks.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <numeric>
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
  this->StackOfPolygon.clear();
  this->Window = nullptr;
}

bool ClassStacks::IsOf(const DrawnMaterials& materials, vtkOpenGLRenderWindow* window) const
{
  const auto isKnown = [](const DrawnMaterial* drawn, const Origin& origin)
  { return GetOrigin(*drawn) == origin; };
  return this->Window == window &&
         std::equal(
           materials.begin(), materials.end(), this->Known.begin(), this->Known.end(), isKnown) &&
         std::all_of(this->Stacks.begin(), this->Stacks.end(),
           [window](const std::unique_ptr<ClassStack>& stack) { return stack->Fits(window); });
}

bool ClassStacks::Update(const std::vector<ClassBorder>& borders, const DrawnMaterials& materials,
  bool hasOthers, vtkOpenGLRenderWindow* window)
{
  if (this->IsOf(materials, window))
  {
    return false;
  }
  this->Clear();
  for (const DrawnMaterial* drawn : materials)
  {
    this->Known.push_back(GetOrigin(*drawn));
  }
  this->Window = window;
  this->Group(borders, materials, hasOthers, window);
  this->Distribute(borders);
  return true;
}

std::size_t ClassStacks::CountBytes(std::set<const vtkTextureObject*>& counted) const
{
  std::size_t bytes = 0;
  for (const std::unique_ptr<ClassStack>& stack : this->Stacks)
  {
    const DrawnMaterial& drawn = stack->Get();
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
  auto stack = std::make_unique<ClassStack>();
  if (members.size() < 2 || !TryBuild(*stack, members, first, numbers, hasOthers, window))
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

void ClassStacks::AddKinds(
  std::vector<const Kind*> kinds, bool hasOthers, vtkOpenGLRenderWindow* window)
{
  while (!kinds.empty())
  {
    std::size_t count = kinds.size();
    bool together = false;
    for (; count > 0 && !together; count = together ? count : count / 2) // each try copies tables
    {
      Classes all;
      for (std::size_t k = 0; k < count; ++k)
      {
        for (const auto& [shape, classes] : *kinds[k])
        {
          all.insert(classes.begin(), classes.end());
        }
      }
      together = this->Add(all, hasOthers, window);
    }
    const Kind& largest = *kinds.front();
    for (auto it = largest.begin(); it != largest.end() && !together && largest.size() > 1; ++it)
    {
      this->Add(it->second, hasOthers, window);
    }
    kinds.erase(kinds.begin(), kinds.begin() + static_cast<std::ptrdiff_t>(together ? count : 1));
  }
}

void ClassStacks::Group(const std::vector<ClassBorder>& borders, const DrawnMaterials& materials,
  bool hasOthers, vtkOpenGLRenderWindow* window)
{
  std::map<std::string, std::map<std::string, Kind>> groups; // by key, then kind
  for (std::size_t k = 0; k < borders.size(); ++k)
  {
    const DrawnMaterial& drawn = *materials[k];
    if (drawn.IsReady)
    {
      groups[ClassStack::GetKey(drawn)][ClassStack::GetKind(drawn)][ClassStack::GetShape(drawn)]
            [borders[k].Class] = &drawn;
    }
  }
  for (const auto& [key, ofKey] : groups)
  {
    std::vector<const Kind*> kinds;
    for (const auto& [name, kind] : ofKey)
    {
      kinds.push_back(&kind);
    }
    const auto count = [](const Kind* kind)
    {
      return std::accumulate(kind->begin(), kind->end(), std::size_t(0),
        [](std::size_t sum, const auto& shape) { return sum + shape.second.size(); });
    };
    std::stable_sort(kinds.begin(), kinds.end(),
      [&count](const Kind* a, const Kind* b) { return count(a) > count(b); });
    this->AddKinds(std::move(kinds), hasOthers, window);
  }
  for (const ClassBorder& border : borders)
  {
    const auto found = this->StackOfClass.find(border.Class);
    this->StackOf.push_back(found == this->StackOfClass.end() ? -1 : found->second);
  }
}

void ClassStacks::Distribute(const std::vector<ClassBorder>& borders)
{
  for (std::size_t k = 0; k < borders.size(); ++k)
  {
    for (vtkIdType polygon : *borders[k].Polygons)
    {
      const auto [place, isNew] = this->StackOfPolygon.try_emplace(polygon, this->StackOf[k]);
      place->second = place->second == this->StackOf[k] ? place->second : -1;
    }
  }
  const auto stacked = std::count_if(this->StackOfPolygon.begin(), this->StackOfPolygon.end(),
    [](const std::pair<const vtkIdType, int>& polygon) { return polygon.second >= 0; });
  this->MostLoose = 2 * static_cast<std::size_t>(stacked) < this->StackOfPolygon.size();
}
} // namespace measuredbrdf
