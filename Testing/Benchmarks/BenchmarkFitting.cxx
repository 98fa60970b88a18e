// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Seconds per material of each fit, with its residual and relative L2 error.
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkAshikhminShirleyBRDFFitter.h"
#include "vtkBRDFReader.h"
#include "vtkBlinnPhongBRDFFitter.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkNew.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

namespace
{
// A name of an embedded material, "analytic", "anisotropic", or a file under the shared materials.
vtkSmartPointer<vtkBRDF> NewMaterial(const std::string& name)
{
  if (name == "analytic" || name == "anisotropic")
  {
    auto brdf = vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
    brdf->SetExponents(name == "analytic" ? 200.0 : 20.0, 200.0);
    return brdf;
  }
  const std::string path = std::string(MEASUREDBRDF_SHARED_DATA "/materials/") + name;
  if (!std::filesystem::is_regular_file(path))
  {
    return vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
  }
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(path);
  reader->Read();
  return reader->GetBRDF();
}

void Run(benchmark::State& state, vtkBRDFFitter* fitter, const std::string& material)
{
  const vtkSmartPointer<vtkBRDF> input = NewMaterial(material);
  if (!input)
  {
    state.SkipWithError("no such material, or no measured data beside the checkout");
    return;
  }
  fitter->SetInput(input);
  for (auto _ : state)
  {
    fitter->Fit();
  }
  state.counters["residual"] = fitter->GetResidual();
  state.counters["relativeL2"] = fitter->GetRelativeL2Error();
  state.counters["iterations"] = fitter->GetNumberOfIterations();
}

void FitDistribution(benchmark::State& state, const char* material)
{
  Run(state, vtkNew<vtkDistributionBRDFFitter>(), material);
}

void FitAshikhminShirley(benchmark::State& state, const char* material)
{
  vtkNew<vtkAshikhminShirleyBRDFFitter> fitter;
  fitter->SetNumberOfLobes(static_cast<int>(state.range(0)));
  Run(state, fitter, material);
}

void FitBlinnPhong(benchmark::State& state, const char* material)
{
  Run(state, vtkNew<vtkBlinnPhongBRDFFitter>(), material);
}

#define FIT_BENCHMARKS(name, material)                                                         \
  BENCHMARK_CAPTURE(FitDistribution, name, material)->UseRealTime()->Unit(benchmark::kSecond); \
  BENCHMARK_CAPTURE(FitAshikhminShirley, name, material)                                       \
    ->DenseRange(1, 3)                                                                         \
    ->UseRealTime()                                                                            \
    ->Unit(benchmark::kSecond);                                                                \
  BENCHMARK_CAPTURE(FitBlinnPhong, name, material)->UseRealTime()->Unit(benchmark::kSecond)

FIT_BENCHMARKS(analytic, "analytic");
FIT_BENCHMARKS(anisotropic, "anisotropic");
FIT_BENCHMARKS(gold_paint, "gold-paint");
FIT_BENCHMARKS(blue_fabric, "blue-fabric");
FIT_BENCHMARKS(satin_purple, "rgl/satin_purple_rgb.bsdf");
FIT_BENCHMARKS(carpaint_blue, "mbsdf/carpaint_blue.mbsdf");
} // namespace
