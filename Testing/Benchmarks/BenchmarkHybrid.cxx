// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Tables of many rows against maps of the sharp part, with lights for lamps in both (but for
// chrome, which is narrower than a lamp): the time to prepare under a known map, the error of a
// thousand pairs of a sphere seen from everywhere, against the reference, and the memory of the
// textures. The table of docs/methods.md.
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDFReader.h"
#include "vtkDoubleArray.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace
{
const std::string Data = MEASUREDBRDF_SHARED_DATA;

// A material under an environment, and what pairs reflect.
struct Case
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkNew<vtkDoubleArray> Normals, Views, Reference;

  // Files of the data folder, or embedded ones.
  Case(const std::string& material, const std::string& light)
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(Data + "/materials/" + material);
    vtkNew<vtkEnvironmentReader> map;
    map->SetFileName(Data + "/environments/" + light);
    for (vtkObject* object : { static_cast<vtkObject*>(reader), static_cast<vtkObject*>(map) })
    {
      object->GlobalWarningDisplayOff();
    }
    if (material.find('.') == std::string::npos)
    {
      this->BRDF = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(material));
    }
    else if (reader->Read())
    {
      this->BRDF = reader->GetBRDF();
    }
    if (light.find('.') == std::string::npos)
    {
      this->Environment =
        vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(light));
    }
    else if (map->Read())
    {
      this->Environment = map->GetEnvironment();
    }
    if (this->BRDF && this->Environment)
    {
      this->SetPairs(1000);
      vtkNew<vtkAdaptiveRadianceIntegrator> reference;
      reference->SetBRDF(this->BRDF);
      reference->SetEnvironment(this->Environment);
      reference->Integrate(this->Normals, this->Views, this->Reference);
    }
  }

  // Views over the sphere of directions, and for each a point of the disc that it shows:
  // sunflowers.
  void SetPairs(int pairs)
  {
    this->Normals->SetNumberOfComponents(3);
    this->Views->SetNumberOfComponents(3);
    for (int k = 0; k < pairs; ++k)
    {
      const double y = 1.0 - (2.0 * k + 1.0) / pairs;
      const double s = std::sqrt(1.0 - y * y);
      const double around = 2.399963229728653 * k;
      const double view[3] = { s * std::cos(around), y, s * std::sin(around) };
      double u[3], v[3];
      vtkMath::Perpendiculars(view, u, v, 0.0);
      const double r = std::sqrt(std::fmod((k + 0.5) * 0.6180339887498949, 1.0));
      const double phi = 2.0 * vtkMath::Pi() * std::fmod(k * 0.7548776662466927, 1.0);
      double normal[3];
      for (int c = 0; c < 3; ++c)
      {
        normal[c] =
          r * std::cos(phi) * u[c] + r * std::sin(phi) * v[c] + std::sqrt(1.0 - r * r) * view[c];
      }
      this->Normals->InsertNextTuple(normal);
      this->Views->InsertNextTuple(view);
    }
  }

  // Relative L1.
  double GetError(vtkDoubleArray* radiance) const
  {
    double difference = 0.0;
    double sum = 0.0;
    for (vtkIdType k = 0; k < radiance->GetNumberOfValues(); ++k)
    {
      difference += std::abs(radiance->GetValue(k) - this->Reference->GetValue(k));
      sum += this->Reference->GetValue(k);
    }
    return difference / sum;
  }
};

void Prepare(
  benchmark::State& state, const std::shared_ptr<Case>& pair, const std::vector<int>& sizes)
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
    const auto pair = std::make_shared<Case>(material, light);
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
