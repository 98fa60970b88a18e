// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// How long it takes to evaluate many pairs of directions: in a loop, and by one call, which may use
// several threads.
#include "BenchmarkCase.h"
#include "vtkDoubleArray.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
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

constexpr int Pairs = 1 << 16;

vtkSmartPointer<vtkDataArray> NewTuples(int type, std::size_t factor)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetNumberOfComponents(3);
  const std::vector<Vector> directions = NewDirections();
  for (std::size_t k = 0; k < Pairs; ++k)
  {
    array->InsertNextTuple(directions[(factor * k + factor / 2) % 1024].data());
  }
  return array;
}

// The type of the arrays; VTK_VOID: one call for each pair.
void EvaluatePairs(benchmark::State& state, const std::string& name, int type)
{
  const vtkSmartPointer<vtkBRDF> brdf = name == "Lambert"
                                          ? vtkSmartPointer<vtkBRDF>(vtkNew<vtkLambertBRDF>())
                                          : BenchmarkCase::FindBRDF(name);
  if (!brdf)
  {
    state.SkipWithError("there is no such material here");
    return;
  }
  const auto i = NewTuples(type == VTK_VOID ? VTK_DOUBLE : type, 1);
  const auto o = NewTuples(type == VTK_VOID ? VTK_DOUBLE : type, 7);
  auto f = vtkSmartPointer<vtkDataArray>::Take(i->NewInstance());
  f->SetNumberOfComponents(3);
  f->SetNumberOfTuples(Pairs);
  brdf->Prepare();
  for (auto _ : state)
  {
    if (type != VTK_VOID)
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
}

[[maybe_unused]] const bool Registered = []()
{
  for (const std::string name :
    { "Lambert", "gold-paint", "blue-car-paint", "rgl/satin_purple_rgb.bsdf" })
  {
    for (const auto& [type, form] : { std::pair(VTK_VOID, "scalar loop"),
           std::pair(VTK_DOUBLE, "double arrays"), std::pair(VTK_FLOAT, "float arrays") })
    {
      benchmark::RegisterBenchmark(
        ("EvaluatePairs/" + name + "/" + form).c_str(), EvaluatePairs, name, type)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
    }
  }
  return true;
}();
} // namespace
