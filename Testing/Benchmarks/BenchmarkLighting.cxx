// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Light-set generators and integrators. Wall-clock time: they use threads.
#include "vtkBlinnPhongBRDF.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkExactRadianceIntegrator.h"
#include "vtkImageData.h"
#include "vtkImportanceLightSetGenerator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTabulatedBRDF.h"
#include "vtkVarianceLightSetGenerator.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace
{
// Five decades, no black texel.
void SetRandom(vtkEnvironment* environment, int width, int height)
{
  std::mt19937 engine(1);
  std::vector<float> rgb(3 * std::size_t(width) * height);
  for (float& value : rgb)
  {
    value = static_cast<float>(std::exp(12.0 * engine() * 0x1p-32 - 8.0));
  }
  environment->SetPixels(width, height, std::move(rgb));
}

// What the first sight of a map costs: taking an image's pixels, carrying over a cube map's faces,
// harmonics (a coarse table) of widths that are a power of two, twice a prime, a multiple of a
// prime.
void TakeImage(benchmark::State& state)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4096, 2048, 1);
  image->AllocateScalars(static_cast<int>(state.range(0)), 3);
  image->GetPointData()->GetScalars()->Fill(1.0);
  for (auto _ : state)
  {
    vtkNew<vtkEnvironment> environment;
    environment->SetImage(image, state.range(0) == VTK_UNSIGNED_CHAR);
  }
}
BENCHMARK(TakeImage)
  ->Arg(VTK_UNSIGNED_CHAR)
  ->Arg(VTK_FLOAT)
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

void TabulateWidth(benchmark::State& state)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, static_cast<int>(state.range(0)), static_cast<int>(state.range(0)) / 2);
  vtkNew<vtkLambertBRDF> brdf;
  for (auto _ : state)
  {
    vtkNew<vtkTableRadianceIntegrator> table;
    table->SetBRDF(brdf);
    table->SetEnvironment(environment);
    table->Prepare();
  }
}
BENCHMARK(TabulateWidth)
  ->Arg(2048)
  ->Arg(2038)
  ->Arg(4078)
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

template <typename Generator>
void Generate(benchmark::State& state)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 1024, 512);
  vtkNew<vtkLightSet> lights;
  for (auto _ : state)
  {
    vtkNew<Generator> generator; // one that has nothing made before
    generator->Generate(environment, static_cast<int>(state.range(0)), lights);
  }
}
BENCHMARK_TEMPLATE(Generate, vtkMedianCutLightSetGenerator)
  ->Arg(64)
  ->Arg(1024)
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(Generate, vtkImportanceLightSetGenerator)
  ->Arg(64)
  ->Arg(1024)
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

BENCHMARK_TEMPLATE(Generate, vtkVarianceLightSetGenerator)
  ->Arg(64)
  ->Arg(1024)
  ->Arg(65536)
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);

// Another number of lights from the tree that is there.
void VarianceAgain(benchmark::State& state)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 1024, 512);
  vtkNew<vtkVarianceLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  generator->Generate(environment, 1024, lights);
  for (auto _ : state)
  {
    generator->Generate(environment, static_cast<int>(state.range(0)), lights);
  }
}
BENCHMARK(VarianceAgain)->Arg(64)->Arg(1024)->UseRealTime()->Unit(benchmark::kMillisecond);

// Pairs (n, v) = (direction, the same turned by 40 degrees).
void SetPairs(int count, vtkDoubleArray* normals, vtkDoubleArray* views)
{
  normals->SetNumberOfComponents(3);
  views->SetNumberOfComponents(3);
  for (int k = 0; k < count; ++k)
  {
    normals->InsertNextTuple3(std::cos(k), 0.3, std::sin(k));
    views->InsertNextTuple3(std::cos(k + 0.7), 0.3, std::sin(k + 0.7));
  }
}

void Integrate(benchmark::State& state, vtkRadianceIntegrator* integrator, vtkBRDF* brdf, int pairs,
  double evaluationsPerPair)
{
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> radiance;
  SetPairs(pairs, normals, views);
  integrator->SetBRDF(brdf);
  for (auto _ : state)
  {
    integrator->Integrate(normals, views, radiance);
  }
  state.counters["evaluations"] =
    benchmark::Counter(evaluationsPerPair * pairs, benchmark::Counter::kIsIterationInvariantRate);
}

template <typename BRDF>
vtkNew<BRDF> NewMaterial()
{
  return vtkNew<BRDF>();
}

template <>
vtkNew<vtkTabulatedBRDF> NewMaterial<vtkTabulatedBRDF>()
{
  const int size[3] = { 180, 90, 90 };
  vtkNew<vtkTabulatedBRDF> table;
  table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, size,
    std::vector<float>(3 * std::size_t(size[0]) * size[1] * size[2], 0.25f));
  return table;
}

// Half the sphere's texels are above the horizon: that many evaluations per pair.
template <typename BRDF>
void Exact(benchmark::State& state)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 1024, 512);
  vtkNew<vtkExactRadianceIntegrator> integrator;
  integrator->SetEnvironment(environment);
  Integrate(state, integrator, NewMaterial<BRDF>(), static_cast<int>(state.range(0)), 1024 * 256);
}
BENCHMARK_TEMPLATE(Exact, vtkLambertBRDF)
  ->Arg(1)
  ->Arg(16)
  ->UseRealTime()
  ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(Exact, vtkBlinnPhongBRDF)->Arg(16)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(Exact, vtkTabulatedBRDF)->Arg(16)->UseRealTime()->Unit(benchmark::kMillisecond);

void LightLoop(benchmark::State& state)
{
  vtkNew<vtkEnvironment> environment;
  SetRandom(environment, 256, 128);
  vtkNew<vtkMedianCutLightSetGenerator> generator;
  vtkNew<vtkLightSet> lights;
  generator->Generate(environment, 256, lights);
  vtkNew<vtkLightSetRadianceIntegrator> integrator;
  integrator->SetLightSet(lights);
  Integrate(state, integrator, vtkNew<vtkBlinnPhongBRDF>(), 10000, 128.0);
}
BENCHMARK(LightLoop)->UseRealTime()->Unit(benchmark::kMillisecond);
} // namespace
