// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The adaptive sum, over pixels of a sphere's picture: time of a pair and of a picture, and how far
// the pairs are from sums of a tolerance ten times smaller. Wall-clock time: it uses threads.
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDFReader.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkNew.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace
{
const std::string Data = MEASUREDBRDF_SHARED_DATA;

// Points of the disc that a sphere covers, seen from afar along (1, 0.4, 2).
void SetSphere(int pairs, vtkDoubleArray* normals, vtkDoubleArray* views)
{
  const double view[3] = { 0.440225, 0.17609, 0.880451 };
  const double right[3] = { 0.894427, 0.0, -0.447214 };
  const double up[3] = { -0.0787497, 0.984374, -0.1574994 };
  for (vtkDoubleArray* array : { normals, views })
  {
    array->SetNumberOfComponents(3);
  }
  for (int k = 0; k < pairs; ++k)
  {
    const double r = std::sqrt((k + 0.5) / pairs);
    const double angle = 2.399963229728653 * k; // a sunflower's
    const double x = r * std::cos(angle);
    const double y = r * std::sin(angle);
    const double z = std::sqrt(1.0 - r * r);
    double normal[3];
    for (int c = 0; c < 3; ++c)
    {
      normal[c] = x * right[c] + y * up[c] + z * view[c];
    }
    normals->InsertNextTuple(normal);
    views->InsertNextTuple(view);
  }
}

// Channels' absolute differences over their sum: the largest of all pairs.
double GetLargestError(vtkDoubleArray* radiance, vtkDoubleArray* reference)
{
  double largest = 0.0;
  for (vtkIdType k = 0; k < reference->GetNumberOfTuples(); ++k)
  {
    double difference = 0.0;
    double sum = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      difference += std::abs(radiance->GetComponent(k, c) - reference->GetComponent(k, c));
      sum += reference->GetComponent(k, c);
    }
    largest = std::max(largest, sum > 0.0 ? difference / sum : 0.0);
  }
  return largest;
}

void SumAdaptively(benchmark::State& state, const char* material, const char* light)
{
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(Data + "/materials/rgl/" + material + "_rgb.bsdf");
  vtkNew<vtkEnvironmentReader> environment;
  environment->SetFileName(Data + "/environments/" + light + ".exr");
  reader->GlobalWarningDisplayOff();
  if (!reader->Read() || !environment->Read())
  {
    state.SkipWithError("no measured data");
    return;
  }
  constexpr int pairs = 512;
  vtkNew<vtkDoubleArray> normals, views, radiance, reference;
  SetSphere(pairs, normals, views);
  vtkNew<vtkAdaptiveRadianceIntegrator> adaptive;
  adaptive->SetBRDF(reader->GetBRDF());
  adaptive->SetEnvironment(environment->GetEnvironment());
  adaptive->Prepare();
  for (auto _ : state)
  {
    adaptive->Integrate(normals, views, radiance);
  }
  adaptive->SetTolerance(0.1 * adaptive->GetTolerance());
  adaptive->Integrate(normals, views, reference);
  state.counters["error_percent"] = 100.0 * GetLargestError(radiance, reference);
  // 500 x 500 pixels, of which the sphere covers pi/4.
  state.counters["picture_s"] = benchmark::Counter(pairs / (500.0 * 500.0 * 0.785),
    benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
#define SUM_ADAPTIVELY(material)                                               \
  BENCHMARK_CAPTURE(SumAdaptively, material / studio, #material, "studio")     \
    ->UseRealTime()                                                            \
    ->Unit(benchmark::kMillisecond);                                           \
  BENCHMARK_CAPTURE(SumAdaptively, material / interior, #material, "interior") \
    ->UseRealTime()                                                            \
    ->Unit(benchmark::kMillisecond);                                           \
  BENCHMARK_CAPTURE(SumAdaptively, material / sunset, #material, "sunset")     \
    ->UseRealTime()                                                            \
    ->Unit(benchmark::kMillisecond)
SUM_ADAPTIVELY(acrylic_felt_white);
SUM_ADAPTIVELY(cc_ibiza_sunset);
SUM_ADAPTIVELY(satin_purple);
SUM_ADAPTIVELY(irid_flake_paint2);
SUM_ADAPTIVELY(chm_light_blue);
} // namespace
