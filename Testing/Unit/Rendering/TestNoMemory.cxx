// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Memory that runs out while a surface is divided, at any large allocation.
#include "MaterialParts.h"
#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialMap.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <new>
#include <string>

namespace
{
// Bytes. Destructors of VTK's, which no exception may leave, need fewer.
constexpr std::size_t Large = 1000;
thread_local long Left = std::numeric_limits<long>::max(); // large allocations that succeed

void* AllocateOrThrow(std::size_t size)
{
  Left -= size >= Large ? 1 : 0;
  void* memory = Left >= 0 || size < Large ? std::malloc(size > 0 ? size : 1) : nullptr;
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}
}

void* operator new(std::size_t size) { return AllocateOrThrow(size); }
void* operator new[](std::size_t size) { return AllocateOrThrow(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

TEST(NoMemory, ADivisionIsTriedAgain)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(64, 64);
  plane->Update();
  vtkNew<vtkPolyData> surface;
  surface->ShallowCopy(plane->GetOutput());
  vtkNew<vtkIntArray> classes;
  classes->SetName("class");
  for (int k = 0; k < 64 * 64; ++k)
  {
    classes->InsertNextValue(k % 2);
  }
  surface->GetCellData()->AddArray(classes);
  vtkNew<vtkMaterialMap> map;
  vtkNew<vtkLambertBRDF> materials[2];
  map->SetArrayName("class");
  map->AddMaterial(materials[0]);
  map->AddMaterial(materials[1]);

  measuredbrdf::MaterialParts parts;
  std::string warning;
  int failures = 0;
  for (long allowed = 0; allowed < 1000; ++allowed)
  {
    parts.Clear();
    Left = allowed;
    std::string problem;
    try
    {
      problem = parts.Update(surface, map, nullptr, warning);
    }
    catch (const std::bad_alloc&) // before or after it divides: nothing has been kept
    {
      problem = "std::bad_alloc";
    }
    Left = std::numeric_limits<long>::max();
    if (problem.empty())
    {
      break;
    }
    ++failures;
    EXPECT_EQ(problem, "std::bad_alloc") << allowed;
    ASSERT_EQ(parts.Update(surface, map, nullptr, warning), "") << allowed;
    EXPECT_FALSE(parts.HasFailed());
    EXPECT_EQ(parts.Get().size(), 2u) << allowed;
    EXPECT_EQ(parts.GetBRDFs().size(), 2u) << allowed;
  }
  EXPECT_GT(failures, 5);
}
