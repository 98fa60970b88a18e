// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Tables of many rows against maps of the sharp part, with lights for lamps in both (but for
// chrome, which is narrower than a lamp): the time to prepare under a known map, the error of a
// thousand pairs of a sphere seen from everywhere, against the reference, and the memory of the
// textures. The table of docs/methods/hybrids.md.
#include "BenchmarkCase.h"
#include "vtkHybridRadianceIntegrator.h"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace
{
void Prepare(benchmark::State& state, const std::shared_ptr<BenchmarkCase>& pair,
  const std::vector<int>& sizes)
{
  vtkSmartPointer<vtkHybridRadianceIntegrator> hybrid;
  for (auto _ : state)
  {
    hybrid = vtkSmartPointer<vtkHybridRadianceIntegrator>::New();
    hybrid->SetSizes(sizes);
    hybrid->SetBRDF(pair->BRDF);
    hybrid->SetEnvironment(pair->Environment);
    hybrid->Prepare();
  }
  vtkNew<vtkDoubleArray> radiance;
  hybrid->Integrate(pair->Normals, pair->Views, radiance);
  state.counters["error_percent"] = 100.0 * pair->GetError(radiance);
  state.counters["MB"] = 1e-6 * static_cast<double>(hybrid->EstimateTextureBytes());
  state.counters["lights"] = hybrid->GetNumberOfLights();
}
}

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  const std::vector<std::vector<int>> candidates = { { 129, 8, 8, 0 }, { 129, 12, 16, 0 },
    { 257, 8, 8, 0 }, { 128, 12, 8, 8 }, { 128, 12, 8, 16 }, { 256, 12, 8, 8 } };
  const struct
  {
    std::string Material;
    std::string Light;
    int Lights; // at most
  } cases[] = { { "rgl/chm_light_blue_rgb.bsdf", "studio.exr", 16 },
    { "rgl/chm_light_blue_rgb.bsdf", "interior.exr", 16 },
    { "rgl/chm_light_blue_rgb.bsdf", "sunset.exr", 16 },
    { "rgl/irid_flake_paint2_rgb.bsdf", "studio.exr", 16 },
    { "rgl/irid_flake_paint2_rgb.bsdf", "interior.exr", 16 },
    { "mbsdf/carpaint_blue.mbsdf", "city.exr", 16 }, { "nickel", "room", 16 },
    { "chrome", "sky", 0 } };
  for (const auto& [material, light, lights] : cases)
  {
    const auto pair = std::make_shared<BenchmarkCase>(material, light);
    if (!pair->BRDF || !pair->Environment)
    {
      continue; // no measured data
    }
    for (std::vector<int> sizes : candidates)
    {
      std::string name = material + " " + light;
      for (std::size_t k = 0; k < sizes.size(); ++k)
      {
        name += (k > 0 ? "," : " ") + std::to_string(sizes[k]);
      }
      sizes.insert(sizes.end(), { lights, 6 }); // lamps of 0.6 degrees
      benchmark::RegisterBenchmark(name.c_str(), Prepare, pair, sizes)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(2);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
}
