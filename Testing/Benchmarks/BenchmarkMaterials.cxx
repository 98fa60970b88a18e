// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// How long it takes to evaluate materials: one pair of directions after the other, and many pairs
// by one call, which may use several threads.
#include "BenchmarkCase.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"

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

vtkSmartPointer<vtkBRDF> NewTable(int parameterization)
{
  const int size[3] = { 180, 90, 90 };
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  table->SetVolume(parameterization, vtkTabulatedBRDF::HALF_TURN, size,
    std::vector<float>(3 * std::size_t(size[0]) * size[1] * size[2], 0.25f));
  return table;
}

// Models and tables of MERL's size, embedded materials, or a file of the data folder; null where
// this build or this machine has none.
vtkSmartPointer<vtkBRDF> NewMaterial(const std::string& name)
{
  if (name == "Lambert")
  {
    return vtkSmartPointer<vtkLambertBRDF>::New();
  }
  if (name == "Blinn-Phong")
  {
    return vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  }
  if (name == "Ashikhmin-Shirley")
  {
    return vtkSmartPointer<vtkAshikhminShirleyBRDF>::New();
  }
  if (name == "distribution")
  {
    auto brdf = vtkSmartPointer<vtkDistributionBRDF>::New();
    const double f0[3] = { 0.04, 0.04, 0.04 };
    brdf->SetBlinnDistribution(100.0);
    brdf->SetSchlickFresnel(f0);
    return brdf;
  }
  if (name == "half/difference")
  {
    return NewTable(vtkTabulatedBRDF::HALF_DIFFERENCE);
  }
  if (name == "incident/outgoing")
  {
    return NewTable(vtkTabulatedBRDF::INCIDENT_OUTGOING);
  }
  return BenchmarkCase::FindBRDF(name);
}

void Evaluate(benchmark::State& state, const std::string& name)
{
  const vtkSmartPointer<vtkBRDF> brdf = NewMaterial(name);
  if (!brdf)
  {
    state.SkipWithError("there is no such material here");
    return;
  }
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
  const vtkSmartPointer<vtkBRDF> brdf = NewMaterial(name);
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
  for (const std::string name : { "Lambert", "Blinn-Phong", "Ashikhmin-Shirley", "distribution",
         "half/difference", "incident/outgoing", "rgl/satin_purple_rgb.bsdf" })
  {
    benchmark::RegisterBenchmark(("Evaluate/" + name).c_str(), Evaluate, name);
  }
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
