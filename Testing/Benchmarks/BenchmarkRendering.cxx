// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Frame times of a 500 x 500 view of a sphere: the measured mapper against the number of lights,
// beside the stock mapper with Phong lighting and with PBR under image-based lighting, on the same
// scene in the same run. Thesis mode against the order of the basis and the number of lights (both
// arguments), 125 x 125. Filtered importance sampling against the number of samples, pre-integrated
// bases against the number of functions, tables of radiance. Needs an OpenGL context.
// ns_per_light_pixel: slope per covered pixel.

#include "BrushedMetal.h"
#include "FrameScene.h"
#include "vtkAnisotropicTableRadianceIntegrator.h"
#include "vtkBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTableRadianceIntegrator.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <vector>

namespace
{
struct Scene : FrameScene
{
  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkEnvironment> Sky;
  int Side;

  explicit Scene(int side = 500)
    : FrameScene(side, side, 0.5) // the sphere fills the view
    , Side(side)
  {
    this->Sphere->SetThetaResolution(128);
    this->Sphere->SetPhiResolution(128);
    this->Sky->SetToProceduralSky();
  }

  void Measure(benchmark::State& state, int lights)
  {
    this->Renderer->ResetCameraClippingRange();
    this->Window->Render();
    this->Window->Render();
    for (auto _ : state)
    {
      this->Window->Render();
      this->Window->WaitForCompletion();
    }
    const double pixels = 3.14159265 * 0.25 * this->Side * this->Side;
    state.counters["ns_per_pixel"] =
      benchmark::Counter(pixels * static_cast<double>(state.iterations()) * 1e-9,
        benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    if (lights > 0)
    {
      state.counters["ns_per_light_pixel"] =
        benchmark::Counter(pixels * lights * static_cast<double>(state.iterations()) * 1e-9,
          benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    }
  }
};

void RunMeasured(benchmark::State& state, vtkBRDF* brdf, int lights, int side = 500)
{
  Scene scene(side);
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(scene.Sphere->GetOutputPort());
  mapper->SetBRDF(brdf);
  mapper->SetEnvironment(scene.Sky);
  vtkNew<vtkLightSetRadianceIntegrator> loop;
  loop->SetGenerator(vtkNew<vtkMedianCutLightSetGenerator>());
  loop->SetNumberOfLights(lights);
  mapper->SetIntegrator(loop);
  scene.Actor->SetMapper(mapper);
  scene.Measure(state, lights);
}

void MeasuredLambert(benchmark::State& state)
{
  vtkNew<vtkLambertBRDF> brdf;
  RunMeasured(state, brdf, static_cast<int>(state.range(0)));
}

void MeasuredFit(benchmark::State& state)
{
  auto brdf = GetEmbedded("gold-paint");
  RunMeasured(state, brdf, static_cast<int>(state.range(0)));
}

void MeasuredVolume(benchmark::State& state)
{
  RunMeasured(state, MakeLargeTable(), static_cast<int>(state.range(0)));
}

void MeasuredBasis(benchmark::State& state)
{
  const auto brdf = MakeBasis(static_cast<int>(state.range(0)));
  RunMeasured(state, brdf, static_cast<int>(state.range(1)), 125);
}

// ns_per_light_pixel counts the samples alone.
void MeasuredFiltered(benchmark::State& state)
{
  Scene scene;
  auto brdf = GetEmbedded("gold-paint");
  const int samples = static_cast<int>(state.range(0));
  vtkNew<vtkFilteredRadianceIntegrator> integrator;
  integrator->SetNumberOfSamples(samples);
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(scene.Sphere->GetOutputPort());
  mapper->SetBRDF(brdf);
  mapper->SetEnvironment(scene.Sky);
  mapper->SetIntegrator(integrator);
  scene.Actor->SetMapper(mapper);
  scene.Measure(state, samples);
}

// Rows, view angles, azimuths: more of them cost memory, not time, as long as caches hold them.
void MeasuredTable(benchmark::State& state)
{
  Scene scene;
  auto brdf = GetEmbedded("gold-paint");
  vtkNew<vtkTableRadianceIntegrator> integrator;
  integrator->SetNumberOfRows(static_cast<int>(state.range(0)));
  integrator->SetNumberOfViewAngles(static_cast<int>(state.range(1)));
  integrator->SetNumberOfAzimuths(static_cast<int>(state.range(2)));
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(scene.Sphere->GetOutputPort());
  mapper->SetBRDF(brdf);
  mapper->SetEnvironment(scene.Sky);
  mapper->SetIntegrator(integrator);
  scene.Actor->SetMapper(mapper);
  scene.Measure(state, 0);
  state.counters["bytes"] = static_cast<double>(mapper->GetTextureBytes());
}

// Maps of 128 rows of the sharp part (0: a table), and lights at most: gloss under a hall with
// lamps.
void MeasuredHybrid(benchmark::State& state)
{
  Scene scene;
  auto brdf = GetEmbedded("nickel");
  vtkNew<vtkEnvironment> hall;
  hall->SetToProceduralHall();
  vtkNew<vtkHybridRadianceIntegrator> integrator;
  integrator->SetNumberOfMaps(static_cast<int>(state.range(0)));
  if (state.range(0) > 0)
  {
    integrator->SetSizes({ 128, 12, 8 });
  }
  integrator->SetMaximumNumberOfLights(static_cast<int>(state.range(1)));
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(scene.Sphere->GetOutputPort());
  mapper->SetBRDF(brdf);
  mapper->SetEnvironment(hall);
  mapper->SetIntegrator(integrator);
  scene.Actor->SetMapper(mapper);
  scene.Measure(state, 0);
  integrator->SetBRDF(brdf); // the mapper draws a copy
  integrator->SetEnvironment(hall);
  integrator->Prepare();
  state.counters["lights"] = integrator->GetNumberOfLights();
  state.counters["bytes"] = static_cast<double>(mapper->GetTextureBytes());
}

// Brushed metal: a table (rows, view angles, azimuths, azimuths of the view), or lights (the second
// size is 0).
void MeasuredAnisotropic(benchmark::State& state)
{
  Scene scene;
  vtkSmartPointer<vtkRadianceIntegrator> integrator;
  if (state.range(1) == 0)
  {
    auto lights = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
    lights->SetNumberOfLights(static_cast<int>(state.range(0)));
    lights->SoftLightsOn();
    integrator = lights;
  }
  else
  {
    integrator = vtkSmartPointer<vtkAnisotropicTableRadianceIntegrator>::New();
    std::vector<int> sizes;
    for (int k = 0; k < 4; ++k)
    {
      sizes.push_back(static_cast<int>(state.range(k)));
    }
    integrator->SetSizes(sizes);
  }
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->GlobalWarningDisplayOff(); // the sphere has no tangents
  mapper->SetInputConnection(scene.Sphere->GetOutputPort());
  mapper->SetBRDF(NewBrushedMetal(0.1, 0.4));
  mapper->SetEnvironment(scene.Sky);
  mapper->SetIntegrator(integrator);
  scene.Actor->SetMapper(mapper);
  scene.Measure(state, 0);
  state.counters["bytes"] = static_cast<double>(mapper->GetTextureBytes());
}

void TableSetUp(benchmark::State& state)
{
  auto brdf = GetEmbedded("gold-paint");
  vtkNew<vtkEnvironment> hall;
  hall->SetToProceduralHall();
  vtkNew<vtkTableRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(hall);
  integrator->SetNumberOfRows(static_cast<int>(state.range(0)));
  integrator->SetNumberOfViewAngles(static_cast<int>(state.range(1)));
  integrator->SetNumberOfAzimuths(static_cast<int>(state.range(2)));
  for (auto _ : state)
  {
    integrator->Modified();
    integrator->Prepare();
  }
}

// The material's samples.
void FilteredSetUp(benchmark::State& state)
{
  auto brdf = GetEmbedded("gold-paint");
  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  vtkNew<vtkFilteredRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(sky);
  integrator->Prepare();
  for (auto _ : state)
  {
    brdf->Modified();
    integrator->Prepare();
  }
}

void StockPhong(benchmark::State& state)
{
  Scene scene;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(scene.Sphere->GetOutputPort());
  scene.Actor->SetMapper(mapper);
  scene.Actor->GetProperty()->SetInterpolationToPhong();
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  scene.Renderer->AddLight(headlight);
  scene.Measure(state, 0);
}

void StockPBRWithIBL(benchmark::State& state)
{
  Scene scene;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(scene.Sphere->GetOutputPort());
  scene.Actor->SetMapper(mapper);
  scene.ShadeByPBR(scene.Sky);
  scene.Measure(state, 0);
}
}

BENCHMARK(StockPhong)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(StockPBRWithIBL)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(MeasuredLambert)
  ->Arg(16)
  ->Arg(64)
  ->Arg(256)
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(MeasuredFit)->Arg(16)->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(MeasuredTable)
  ->Args({ 33, 12, 16 })
  ->Args({ 65, 16, 16 })
  ->Args({ 129, 12, 16 })
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(MeasuredHybrid)
  ->ArgsProduct({ { 0, 8, 16 }, { 0, 16 } })
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(MeasuredAnisotropic)
  ->Args({ 17, 8, 16, 8 })
  ->Args({ 33, 6, 24, 6 })
  ->Args({ 33, 8, 32, 8 })
  ->Args({ 16, 0, 0, 0 })
  ->Args({ 64, 0, 0, 0 })
  ->Args({ 256, 0, 0, 0 })
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(TableSetUp)
  ->Args({ 33, 12, 16 })
  ->Args({ 65, 16, 16 })
  ->Args({ 129, 12, 16 })
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(MeasuredFiltered)
  ->RangeMultiplier(2)
  ->Range(16, 128)
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(FilteredSetUp)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(MeasuredVolume)->Arg(16)->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(MeasuredBasis)
  ->ArgsProduct({ { 2, 4, 6, 8, 12 }, { 16, 64, 256 } })
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
