// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Tables of brushed metal against sums over soft lights: the time to prepare, the error of a
// thousand pairs of a sphere seen from everywhere, against the reference, the memory of the
// textures. The table of docs/methods/anisotropic.md; BenchmarkFrames has the frames.
#include "BenchmarkCase.h"
#include "BrushedMetal.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkTableRadianceIntegrator.h"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace
{
// One size: lights.
void Prepare(benchmark::State& state, const std::shared_ptr<BenchmarkCase>& pair,
  const std::vector<int>& sizes)
{
  vtkSmartPointer<vtkRadianceIntegrator> integrator;
  for (auto _ : state)
  {
    if (sizes.size() == 1)
    {
      auto lights = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
      lights->SoftLightsOn();
      integrator = lights;
    }
    else
    {
      integrator = vtkSmartPointer<vtkTableRadianceIntegrator>::New();
    }
    integrator->SetSizes(sizes);
    integrator->SetBRDF(pair->BRDF);
    integrator->SetEnvironment(pair->Environment);
    integrator->Prepare();
  }
  vtkNew<vtkDoubleArray> radiance;
  integrator->Integrate(pair->Normals, pair->Views, radiance);
  state.counters["error_percent"] = 100.0 * pair->GetError(radiance);
  state.counters["MB"] = 1e-6 * static_cast<double>(integrator->EstimateTextureBytes());
}
}

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  const std::vector<std::vector<int>> candidates = { { 17, 8, 16, 8 }, { 25, 8, 20, 8 },
    { 33, 6, 24, 6 }, { 33, 8, 32, 8 }, { 49, 8, 32, 8 }, { 16 }, { 32 }, { 64 }, { 128 },
    { 256 } };
  const double widths[][2] = { { 0.2, 0.5 }, { 0.1, 0.4 }, { 0.05, 0.3 } };
  for (const auto& [along, across] : widths)
  {
    for (const std::string light : { "room", "sky", "studio.exr", "interior.exr", "city.exr",
           "forest.exr", "sunset.exr", "pmndrs_sunrise.hdr" })
    {
      const auto pair = std::make_shared<BenchmarkCase>(NewBrushedMetal(along, across), light);
      if (!pair->Environment)
      {
        continue; // no measured data
      }
      for (const std::vector<int>& sizes : candidates)
      {
        std::string name = std::to_string(along).substr(0, 4) + "," +
                           std::to_string(across).substr(0, 3) + " " + light;
        for (std::size_t k = 0; k < sizes.size(); ++k)
        {
          name += (k > 0 ? "," : " ") + std::to_string(sizes[k]);
        }
        benchmark::RegisterBenchmark(name.c_str(), Prepare, pair, sizes)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1);
      }
    }
  }
  benchmark::RunSpecifiedBenchmarks();
}
