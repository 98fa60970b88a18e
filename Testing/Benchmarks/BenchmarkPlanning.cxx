// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Plans of many materials under one environment: time, and bytes on the heap as C++ counts them.
#include "../Unit/Support/HeapCounter.h"
#include "vtkBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

namespace
{
// A bright room in which the sun shines.
vtkSmartPointer<vtkEnvironment> NewSunny(int width)
{
  const int height = width / 2;
  vtkNew<vtkEnvironment> hall;
  hall->SetToProceduralHall();
  std::vector<float> rgb;
  rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const bool isSun = std::abs(y - height * 2 / 3) < 2 && std::abs(x - width / 3) < 2;
      double pixel[3];
      hall->GetPixel(x * hall->GetWidth() / width, y * hall->GetHeight() / height, pixel);
      for (const double value : pixel)
      {
        rgb.push_back(isSun ? 2e5f : static_cast<float>(0.3 + 0.05 * value));
      }
    }
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  environment->SetPixels(width, height, std::move(rgb));
  return environment;
}

vtkSmartPointer<vtkRadiancePlanner> NewPlan(vtkBRDF* brdf, vtkEnvironment* environment)
{
  auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
  planner->SetBRDF(brdf);
  planner->SetEnvironment(vtkSmartPointer<vtkEnvironment>::Take(environment->NewSnapshot()));
  planner->Update();
  return planner;
}

vtkSmartPointer<vtkBRDF> NewEmbedded(const char* name)
{
  auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
  brdf->Prepare();
  return brdf;
}

// The first plan of a map, and one of another material, beside the map's pixels.
void PlanMemory(benchmark::State& state)
{
  const int width = static_cast<int>(state.range(0));
  const double texels = 0.5 * width * width;
  const auto first = NewEmbedded("violet-rubber");
  const auto second = NewEmbedded("gold-paint");
  for (auto _ : state)
  {
    const auto environment = NewSunny(width);
    const long before = heap::Bytes;
    heap::Peak = before;
    const auto plan = NewPlan(first, environment);
    const long between = heap::Bytes;
    const auto next = NewPlan(second, environment);
    state.counters["peak_bytes_a_texel"] = static_cast<double>(heap::Peak - before) / texels;
    state.counters["first_MB"] = 1e-6 * static_cast<double>(between - before);
    state.counters["next_MB"] = 1e-6 * static_cast<double>(heap::Bytes - between);
    state.counters["next_texture_MB"] =
      1e-6 * static_cast<double>(next->GetTextureBytes(next->GetChoice()));
  }
}
BENCHMARK(PlanMemory)
  ->Arg(2048)
  ->Arg(4096)
  ->Arg(8192)
  ->Iterations(1)
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

// One plan after the other.
void Plans(benchmark::State& state)
{
  std::vector<vtkSmartPointer<vtkBRDF>> materials;
  for (int k = 0; k < state.range(0); ++k)
  {
    auto brdf = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
    brdf->SetSpecular(0.3, 0.3, 0.2);
    brdf->SetExponent(5.0 + k);
    materials.push_back(brdf);
  }
  for (auto _ : state)
  {
    vtkNew<vtkEnvironment> environment;
    environment->SetToProceduralHall();
    std::vector<vtkSmartPointer<vtkRadiancePlanner>> plans;
    for (const auto& material : materials)
    {
      plans.push_back(NewPlan(material, environment));
    }
  }
}
BENCHMARK(Plans)->Arg(1)->Arg(100)->Iterations(1)->MeasureProcessCPUTime()->UseRealTime()->Unit(
  benchmark::kMillisecond);
} // namespace
