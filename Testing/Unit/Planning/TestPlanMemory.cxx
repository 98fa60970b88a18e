// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What plans take and keep, and what those of one environment share.

#include "EnvironmentPrecomputation.h"
#include "vtkBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// Counts what C++ code of this program and of its libraries has on the heap: this operator new
// replaces all others.
namespace heap
{
inline std::atomic<long> Bytes{ 0 };
inline std::atomic<long> Peak{ 0 };

inline void* Allocate(std::size_t size, std::size_t alignment = 0)
{
  void* block = alignment > 0 ? std::aligned_alloc(alignment, (size / alignment + 1) * alignment)
                              : std::malloc(size);
  if (!block)
  {
    throw std::bad_alloc();
  }
  const long now = Bytes += static_cast<long>(malloc_usable_size(block));
  for (long peak = Peak; now > peak && !Peak.compare_exchange_weak(peak, now);)
  {
  }
  return block;
}

inline void Free(void* block)
{
  if (block)
  {
    Bytes -= static_cast<long>(malloc_usable_size(block));
    std::free(block);
  }
}
} // namespace heap

void* operator new(std::size_t size) { return heap::Allocate(size); }
void* operator new[](std::size_t size) { return heap::Allocate(size); }
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return heap::Allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment)
{
  return heap::Allocate(size, static_cast<std::size_t>(alignment));
}
// Those that do not throw, too: the library's allocate elsewhere under the address sanitizer.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  try
  {
    return heap::Allocate(size);
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
}
void* operator new[](std::size_t size, const std::nothrow_t& nothrow) noexcept
{
  return operator new(size, nothrow);
}
void operator delete(void* block) noexcept { heap::Free(block); }
void operator delete[](void* block) noexcept { heap::Free(block); }
void operator delete(void* block, std::size_t) noexcept { heap::Free(block); }
void operator delete[](void* block, std::size_t) noexcept { heap::Free(block); }
void operator delete(void* block, std::align_val_t) noexcept { heap::Free(block); }
void operator delete[](void* block, std::align_val_t) noexcept { heap::Free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { heap::Free(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { heap::Free(block); }

namespace
{
using measuredbrdf::ConcurrentCache;

// A sun of 3 x 3 texels above a smooth sky.
vtkSmartPointer<vtkEnvironment> NewSunny(int width, int height)
{
  std::vector<float> rgb(3 * static_cast<std::size_t>(width * height));
  for (std::size_t k = 0; k < rgb.size(); ++k)
  {
    rgb[k] = 0.3f + 0.2f * static_cast<float>(k) / static_cast<float>(rgb.size());
  }
  for (int texel = 0; texel < 9; ++texel)
  {
    const int k = (height * 2 / 3 + texel / 3) * width + width / 3 + texel % 3;
    rgb[3 * static_cast<std::size_t>(k)] = rgb[3 * static_cast<std::size_t>(k) + 1] = 2e5f;
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  EXPECT_TRUE(environment->SetPixels(width, height, std::move(rgb)));
  return environment;
}

vtkSmartPointer<vtkRadiancePlanner> NewPlan(vtkBRDF* brdf, vtkEnvironment* environment)
{
  auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
  planner->SetBRDF(brdf);
  planner->SetEnvironment(
    vtkSmartPointer<vtkEnvironment>::Take(environment->NewSnapshot())); // as mappers plan
  EXPECT_TRUE(planner->Update());
  return planner;
}
} // namespace

//------------------------------------------------------------------------------
TEST(PlanMemory, BelongsToTheEnvironment)
{
  constexpr int width = 2048, height = 1024;
  constexpr double texels = 1.0 * width * height;
  std::vector<vtkSmartPointer<vtkBRDF>> materials;
  for (const char* name : { "violet-rubber", "gold-paint", "blue-fabric" })
  {
    materials.push_back(vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name)));
    ASSERT_TRUE(materials.back());
    materials.back()->Prepare();
  }
  NewPlan(materials[0], NewSunny(64, 32)); // what is made but once in a program
  const long before = heap::Bytes;
  auto environment = NewSunny(width, height);
  const long pixels = heap::Bytes - before;
  EXPECT_LT(pixels, 1.01 * 12 * texels);

  std::vector<vtkSmartPointer<vtkRadiancePlanner>> plans;
  for (const auto& material : materials)
  {
    const long start = heap::Bytes;
    heap::Peak = start;
    plans.push_back(NewPlan(material, environment));
    const long kept = heap::Bytes - start;
    const long peak = heap::Peak - start;
    // In 32 bits here, in 16 on the graphics card.
    const vtkIdType tables = 2 * plans.back()->GetTextureBytes(plans.back()->GetChoice());
    EXPECT_LT(peak, 16 * texels);
    if (plans.size() > 1)
    {
      EXPECT_LT(kept, tables + 1000000);
    }
  }
  // All goes with the last of them, but for what plans of these materials have in common: at most
  // 16 MB in a program, however many materials there are.
  plans.clear();
  const long shared = heap::Bytes - before - pixels;
  EXPECT_GT(shared, 100000);
  EXPECT_LT(shared, 8 * texels);
  environment = nullptr;
  // Views and kernels at 8 and 12 view angles of each, 1.2 MB, and 0.7 MB of harmonics, some of 24
  // view angles.
  EXPECT_LT(heap::Bytes - before, 100000 + 3 * 1900000);
}

//------------------------------------------------------------------------------
// Other pixels forget what was made of these; snapshots of these keep it.
TEST(PlanMemory, GoesWithThePixels)
{
  const auto material =
    vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("violet-rubber"));
  NewPlan(material, NewSunny(128, 64)); // what a program makes once, and keeps of the material
  const auto environment = NewSunny(128, 64);
  const auto snapshot = vtkSmartPointer<vtkEnvironment>::Take(environment->NewSnapshot());
  EXPECT_EQ(&environment->GetParts(), &snapshot->GetParts());
  const long before = heap::Bytes;
  NewPlan(material, snapshot);
  EXPECT_GT(heap::Bytes - before, 500000);
  const std::vector<float> others(3 * 128 * 64, 1.0f);
  environment->SetPixels(128, 64, others);
  EXPECT_NE(&environment->GetParts(), &snapshot->GetParts());
  EXPECT_GT(heap::Bytes - before, 500000);
  snapshot->SetPixels(128, 64, others);
  EXPECT_LT(heap::Bytes - before, 300000); // two of those, for one, and others
}

//------------------------------------------------------------------------------
TEST(ConcurrentCache, ByWhoeverAsksFirst)
{
  ConcurrentCache<int, int> values;
  std::atomic<int> made{ 0 };
  std::atomic<int> asked{ 0 };
  std::vector<std::shared_ptr<const int>> results(4);
  std::vector<std::thread> threads;
  for (std::shared_ptr<const int>& result : results)
  {
    threads.emplace_back(
      [&]()
      {
        result = values.Get(
          7,
          [&]()
          {
            ++asked;
            return true;
          },
          [&]()
          {
            ++made;
            while (asked < 3) // all others wait
            {
              std::this_thread::yield();
            }
            return std::make_shared<int>(42);
          });
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(made, 1);
  for (const std::shared_ptr<const int>& result : results)
  {
    ASSERT_TRUE(result);
    EXPECT_EQ(result, results[0]);
  }
}

//------------------------------------------------------------------------------
TEST(ConcurrentCache, SomebodyElseWhereTheFirstStops)
{
  ConcurrentCache<int, int> values;
  const auto always = []() { return true; };
  // One that waits need not wait for ever.
  std::atomic<bool> making{ false };
  std::atomic<bool> stop{ false };
  std::thread first(
    [&]()
    {
      values.Get(1, always,
        [&]() -> std::shared_ptr<int>
        {
          making = true;
          while (!stop)
          {
            std::this_thread::yield();
          }
          return nullptr;
        });
    });
  while (!making)
  {
    std::this_thread::yield();
  }
  EXPECT_FALSE(values.Get(
    1, []() { return false; }, []() { return std::make_shared<int>(1); }));
  stop = true;
  first.join();
  const auto fail = []() -> std::shared_ptr<int> { throw std::runtime_error("no memory, say"); };
  EXPECT_THROW(values.Get(1, always, fail), std::runtime_error);
  EXPECT_EQ(*values.Get(1, always, []() { return std::make_shared<int>(2); }), 2);
  EXPECT_EQ(*values.Get(1, always, fail), 2);
}
