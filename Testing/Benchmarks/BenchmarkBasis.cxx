// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Seconds a material by order (argument): projection, acquisition, extrapolation, and evaluations
// of the result. The material is a published fit, isotropic; a brushed lobe for the anisotropic
// form.

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFAcquisition.h"
#include "vtkBasisExtrapolator.h"
#include "vtkBasisProjector.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace
{
vtkSmartPointer<vtkBRDF> MakeMaterial(bool isotropic)
{
  if (isotropic)
  {
    return vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("blue-fabric"));
  }
  auto brushed = vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
  brushed->SetExponents(10.0, 100.0);
  return brushed;
}

vtkSmartPointer<vtkBasisBRDF> Project(vtkBRDF* material, int order)
{
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(material);
  projector->SetBasis(vtkBasisBRDF::ZONAL);
  projector->SetOrder(order);
  projector->SetIncidentZone(9.0, 57.0);
  projector->SetOutgoingZone(9.0, 57.0);
  projector->Project();
  return projector->GetOutput();
}

void RunProjection(benchmark::State& state, bool isotropic)
{
  const auto material = MakeMaterial(isotropic);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(Project(material, static_cast<int>(state.range(0))));
  }
}

void RunAcquisition(benchmark::State& state, bool isotropic)
{
  const auto material = MakeMaterial(isotropic);
  vtkNew<vtkBRDFAcquisition> acquisition;
  acquisition->SetInput(material);
  acquisition->SetOrder(static_cast<int>(state.range(0)));
  acquisition->SetNoise(0.01);
  acquisition->SetBits(12);
  for (auto _ : state)
  {
    acquisition->Acquire();
  }
}

void RunExtrapolation(benchmark::State& state, bool isotropic)
{
  const auto material = MakeMaterial(isotropic);
  const auto zonal = Project(material, static_cast<int>(state.range(0)));
  vtkNew<vtkBasisExtrapolator> extrapolator;
  extrapolator->SetInput(zonal);
  for (auto _ : state)
  {
    extrapolator->Extrapolate();
  }
}

void Projection(benchmark::State& state) { RunProjection(state, true); }
void ProjectionAnisotropic(benchmark::State& state) { RunProjection(state, false); }
void Acquisition(benchmark::State& state) { RunAcquisition(state, true); }
void AcquisitionAnisotropic(benchmark::State& state) { RunAcquisition(state, false); }
void Extrapolation(benchmark::State& state) { RunExtrapolation(state, true); }
void ExtrapolationAnisotropic(benchmark::State& state) { RunExtrapolation(state, false); }

void EvaluateBasisBRDF(benchmark::State& state)
{
  const auto material = Project(MakeMaterial(true), static_cast<int>(state.range(0)));
  material->Prepare();
  double phi = 0.0;
  for (auto _ : state)
  {
    phi += 0.1;
    const double i[3] = { 0.6 * std::cos(phi), 0.6 * std::sin(phi), 0.8 }, o[3] = { 0.3, 0.1, 0.9 };
    double f[3];
    material->Evaluate(i, o, f);
    benchmark::DoNotOptimize(f);
  }
}
}

BENCHMARK(Projection)
  ->Arg(4)
  ->Arg(6)
  ->Arg(12)
  ->Arg(20)
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(ProjectionAnisotropic)->Arg(6)->Arg(12)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(Acquisition)
  ->Arg(4)
  ->Arg(6)
  ->Arg(12)
  ->Arg(20)
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(AcquisitionAnisotropic)->Arg(6)->Arg(12)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(Extrapolation)
  ->Arg(4)
  ->Arg(6)
  ->Arg(12)
  ->Arg(20)
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(ExtrapolationAnisotropic)->Arg(6)->Arg(12)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(EvaluateBasisBRDF)->Arg(2)->Arg(4)->Arg(6)->Arg(8)->Arg(12)->Arg(20);
