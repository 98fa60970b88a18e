// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What stands in for the first plan (SharedIntegrators.h): CPU and wall time of all that is done on
// the processor for the first picture of a new material under a known map, but for the shader's
// compilation, and the error of 150 pairs of a sphere seen from everywhere against the reference.
// And the CPU time of the form for shaders that the plan takes instead. The figures of
// docs/methods/planner.md, for the pairs of docs/results.md.
// Arguments: parts of names of materials and maps ("" for all).
#include "BenchmarkCase.h"
#include "SharedIntegrators.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkRadianceIntegrator.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace
{
constexpr double WantedWall = 50.0; // ms

double GetCPU() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double GetWall()
{
  return std::chrono::duration<double, std::milli>(
    std::chrono::steady_clock::now().time_since_epoch())
    .count();
}

// What a mapper does of it, with a light in the scene.
vtkSmartPointer<vtkRadianceIntegrator> MakeStandIn(vtkBRDF* brdf, vtkEnvironment* environment)
{
  vtkSmartPointer<vtkRadianceIntegrator> standIn =
    measuredbrdf::FindStandIn(brdf, environment, true);
  standIn->Prepare();
  vtkBRDFShaderInputs radiance, material;
  standIn->GetShaderInputs(radiance);
  standIn->GetBRDF()->GetShaderInputs(material);
  return standIn;
}

struct Column
{
  double Sum = 0.0;
  double Largest = 0.0;
  void Add(double value)
  {
    this->Sum += value;
    this->Largest = std::max(this->Largest, value);
  }
};
}

int main(int argc, char** argv)
{
  const std::string onlyMaterial = argc > 1 ? argv[1] : "";
  const std::string onlyLight = argc > 2 ? argv[2] : "";
  std::vector<std::string> materials = { "mbsdf/carpaint_red.mbsdf", "mbsdf/carpaint_blue.mbsdf" };
  for (const char* name : { "chm_light_blue", "irid_flake_paint2", "vch_ultra_pink",
         "cc_ibiza_sunset", "colodur_azure_4e", "satin_purple", "ilm_l3_37_matte", "leaf_maple",
         "cardboard", "paper_blue", "acrylic_felt_pink", "acrylic_felt_white" })
  {
    materials.push_back("rgl/" + std::string(name) + "_rgb.bsdf");
  }
  for (const char* name :
    { "nickel", "gold-metallic-paint3", "gold-paint", "violet-rubber", "blue-fabric", "pink-felt" })
  {
    materials.push_back(name);
  }
  Column errors, cpu, wall, forms;
  int pairs = 0;
  int quick = 0; // within WantedWall
  for (const char* light : { "studio.exr", "interior.exr", "city.exr", "sunset.exr", "forest.exr",
         "pmndrs_sunrise.hdr", "courtyard.exr", "rooitou_park_1k.hdr" })
  {
    if (std::string(light).find(onlyLight) == std::string::npos)
    {
      continue;
    }
    const auto environment = BenchmarkCase::FindEnvironment(light);
    if (!environment)
    {
      continue; // no measured data
    }
    for (const char* other : { "gold-paint", "nickel" }) // the map is known then
    {
      MakeStandIn(BenchmarkCase::FindBRDF(other), environment);
    }
    for (const std::string& material : materials)
    {
      const auto brdf = material.find(onlyMaterial) != std::string::npos
                          ? BenchmarkCase::FindBRDF(material)
                          : nullptr;
      if (!brdf)
      {
        continue;
      }
      const double cpuBefore = GetCPU();
      const double wallBefore = GetWall();
      const auto standIn = MakeStandIn(brdf, environment);
      const double cpuTime = GetCPU() - cpuBefore;
      const double wallTime = GetWall() - wallBefore;
      vtkNew<vtkDoubleArray> normals, views, reference, radiance;
      AddEverywherePairs(150, normals, views);
      vtkNew<vtkAdaptiveRadianceIntegrator> adaptive;
      adaptive->SetBRDF(brdf);
      adaptive->SetEnvironment(environment);
      adaptive->Integrate(normals, views, reference);
      standIn->Integrate(normals, views, radiance);
      double difference = 0.0;
      double sum = 0.0;
      for (vtkIdType k = 0; k < radiance->GetNumberOfValues(); ++k)
      {
        difference += std::abs(radiance->GetValue(k) - reference->GetValue(k));
        sum += reference->GetValue(k);
      }
      const double formBefore = GetCPU();
      brdf->GetRenderable();
      const double formTime = GetCPU() - formBefore;
      ++pairs;
      quick += wallTime <= WantedWall ? 1 : 0;
      errors.Add(100.0 * difference / sum);
      cpu.Add(cpuTime);
      wall.Add(wallTime);
      forms.Add(formTime);
      std::printf("%-32s %-18s %5.1f %%  %4.0f ms CPU  %4.0f ms wall  later form %5.0f ms CPU\n",
        material.c_str(), light, 100.0 * difference / sum, cpuTime, wallTime, formTime);
      std::fflush(stdout);
    }
  }
  std::printf("%d pairs, mean and largest: error %.2f %.1f %%, CPU %.0f %.0f ms, "
              "wall %.0f %.0f ms (%d within %.0f), later form %.0f %.0f ms CPU\n",
    pairs, errors.Sum / pairs, errors.Largest, cpu.Sum / pairs, cpu.Largest, wall.Sum / pairs,
    wall.Largest, quick, WantedWall, forms.Sum / pairs, forms.Largest);
}
