// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// One evaluation of each representation, and how fast files are read.
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace
{
using Vector = std::array<double, 3>;

// Directions uniform over the upper hemisphere.
std::vector<Vector> NewDirections()
{
  std::mt19937 engine(1);
  std::vector<Vector> directions(1024);
  for (Vector& d : directions)
  {
    const double z = (engine() + 1.0) * 0x1p-32;
    const double phi = 6.283185307179586 * (engine() * 0x1p-32);
    const double r = std::sqrt(1.0 - z * z);
    d = { r * std::cos(phi), r * std::sin(phi), z };
  }
  return directions;
}

void Evaluate(benchmark::State& state, vtkBRDF* brdf)
{
  brdf->Prepare();
  const std::vector<Vector> directions = NewDirections();
  std::size_t k = 0;
  for (auto _ : state)
  {
    double f[3];
    brdf->Evaluate(directions[k % 1024].data(), directions[(7 * k + 3) % 1024].data(), f);
    benchmark::DoNotOptimize(f);
    ++k;
  }
  state.SetItemsProcessed(state.iterations());
}

template <typename BRDF>
void EvaluateAnalytic(benchmark::State& state)
{
  Evaluate(state, vtkNew<BRDF>());
}
BENCHMARK_TEMPLATE(EvaluateAnalytic, vtkLambertBRDF);
BENCHMARK_TEMPLATE(EvaluateAnalytic, vtkBlinnPhongBRDF);
BENCHMARK_TEMPLATE(EvaluateAnalytic, vtkAshikhminShirleyBRDF);

void EvaluateDistribution(benchmark::State& state)
{
  vtkNew<vtkDistributionBRDF> brdf;
  const double f0[3] = { 0.04, 0.04, 0.04 };
  brdf->SetBlinnDistribution(100.0);
  brdf->SetSchlickFresnel(f0);
  Evaluate(state, brdf);
}
BENCHMARK(EvaluateDistribution);

void EvaluateTable(benchmark::State& state)
{
  const int parameterization = static_cast<int>(state.range(0));
  const int size[3] = { 180, 90, 90 };
  vtkNew<vtkTabulatedBRDF> brdf;
  brdf->SetVolume(parameterization, vtkTabulatedBRDF::HALF_TURN, size,
    std::vector<float>(3 * std::size_t(size[0]) * size[1] * size[2], 0.25f));
  Evaluate(state, brdf);
  state.SetLabel(parameterization == vtkTabulatedBRDF::HALF_DIFFERENCE ? "half/difference"
                                                                       : "incident/outgoing");
}
BENCHMARK(EvaluateTable)
  ->Arg(vtkTabulatedBRDF::HALF_DIFFERENCE)
  ->Arg(vtkTabulatedBRDF::INCIDENT_OUTGOING);

const char* const AdaptiveFile = MEASUREDBRDF_SHARED_DATA "/materials/rgl/satin_purple_rgb.bsdf";

void EvaluateAdaptiveWarp(benchmark::State& state)
{
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(AdaptiveFile);
  if (!std::filesystem::exists(AdaptiveFile) || !reader->Read())
  {
    state.SkipWithError("no measured data beside the checkout");
    return;
  }
  Evaluate(state, reader->GetBRDF());
}
BENCHMARK(EvaluateAdaptiveWarp);

// Many pairs: one call for each, one call for all (several threads).
constexpr int Pairs = 1 << 16;
enum Form
{
  SCALAR_LOOP,
  DOUBLE_ARRAYS,
  FLOAT_ARRAYS
};

vtkSmartPointer<vtkDataArray> NewTuples(Form form, std::size_t factor)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(form == FLOAT_ARRAYS ? VTK_FLOAT : VTK_DOUBLE));
  array->SetNumberOfComponents(3);
  const std::vector<Vector> directions = NewDirections();
  for (std::size_t k = 0; k < Pairs; ++k)
  {
    array->InsertNextTuple(directions[(factor * k + factor / 2) % 1024].data());
  }
  return array;
}

void EvaluatePairs(benchmark::State& state, vtkBRDF* brdf)
{
  const char* const labels[] = { "scalar loop", "double arrays", "float arrays" };
  const Form form = static_cast<Form>(state.range(0));
  const auto i = NewTuples(form, 1);
  const auto o = NewTuples(form, 7);
  auto f = vtkSmartPointer<vtkDataArray>::Take(i->NewInstance());
  f->SetNumberOfComponents(3);
  f->SetNumberOfTuples(Pairs);
  brdf->Prepare();
  for (auto _ : state)
  {
    if (form != SCALAR_LOOP)
    {
      brdf->EvaluateArray(i, o, f);
      continue;
    }
    const double* to = vtkDoubleArray::FastDownCast(i)->GetPointer(0);
    const double* from = vtkDoubleArray::FastDownCast(o)->GetPointer(0);
    double* values = vtkDoubleArray::FastDownCast(f)->GetPointer(0);
    for (int k = 0; k < 3 * Pairs; k += 3)
    {
      brdf->Evaluate(to + k, from + k, values + k);
    }
  }
  state.SetItemsProcessed(state.iterations() * Pairs);
  state.SetLabel(labels[form]);
}

void EvaluatePairsLambert(benchmark::State& state)
{
  EvaluatePairs(state, vtkNew<vtkLambertBRDF>());
}
BENCHMARK(EvaluatePairsLambert)
  ->DenseRange(SCALAR_LOOP, FLOAT_ARRAYS)
  ->MeasureProcessCPUTime()
  ->UseRealTime();

void EvaluatePairsEmbedded(benchmark::State& state, const char* name)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
  if (!brdf)
  {
    state.SkipWithError("this build has no such material");
    return;
  }
  EvaluatePairs(state, brdf);
}
BENCHMARK_CAPTURE(EvaluatePairsEmbedded, fit, "gold-paint")
  ->DenseRange(SCALAR_LOOP, FLOAT_ARRAYS)
  ->MeasureProcessCPUTime()
  ->UseRealTime();
BENCHMARK_CAPTURE(EvaluatePairsEmbedded, table, "blue-car-paint")
  ->DenseRange(SCALAR_LOOP, FLOAT_ARRAYS)
  ->MeasureProcessCPUTime()
  ->UseRealTime();

void EvaluatePairsAdaptiveWarp(benchmark::State& state)
{
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(AdaptiveFile);
  if (!std::filesystem::exists(AdaptiveFile) || !reader->Read())
  {
    state.SkipWithError("no measured data beside the checkout");
    return;
  }
  EvaluatePairs(state, reader->GetBRDF());
}
BENCHMARK(EvaluatePairsAdaptiveWarp)
  ->DenseRange(SCALAR_LOOP, FLOAT_ARRAYS)
  ->MeasureProcessCPUTime()
  ->UseRealTime();

// A file of MERL's size (90 x 90 x 180 RGB doubles, 35 MB) with made-up values.
void ReadMERL(benchmark::State& state)
{
  const std::string name =
    (std::filesystem::temp_directory_path() / "vtkMeasuredBRDFBenchmark.binary").string();
  const std::int32_t size[3] = { 90, 90, 180 };
  std::vector<double> values(3 * std::size_t(90) * 90 * 180);
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    values[k] = 1.0 + static_cast<double>(k % 1000);
  }
  {
    std::ofstream file(name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(size), sizeof(size));
    file.write(reinterpret_cast<const char*>(values.data()),
      static_cast<std::streamsize>(values.size() * sizeof(double)));
  }
  for (auto _ : state)
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(name);
    if (!reader->Read())
    {
      state.SkipWithError(reader->GetErrorMessage().c_str());
      break;
    }
  }
  state.SetBytesProcessed(
    state.iterations() * static_cast<std::int64_t>(values.size() * sizeof(double)));
  std::filesystem::remove(name);
}
BENCHMARK(ReadMERL)->UseRealTime()->Unit(benchmark::kMillisecond);

void ReadAdaptiveWarp(benchmark::State& state)
{
  if (!std::filesystem::exists(AdaptiveFile))
  {
    state.SkipWithError("no measured data beside the checkout");
    return;
  }
  for (auto _ : state)
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(AdaptiveFile);
    reader->Read();
  }
  state.SetBytesProcessed(
    state.iterations() * static_cast<std::int64_t>(std::filesystem::file_size(AdaptiveFile)));
}
BENCHMARK(ReadAdaptiveWarp)->UseRealTime()->Unit(benchmark::kMillisecond);
} // namespace
