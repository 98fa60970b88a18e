// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What may stand in for the first plan: CPU time to prepare it under a known map, the error of 150
// pairs of a sphere seen from everywhere against the reference, and the time that lights add where
// the material is resampled for them ("A": samples made with all evaluations). The table of
// docs/methods.md, for the pairs of docs/results.md.
// Arguments: parts of names of materials and maps ("" for all).
#include "BenchmarkCase.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"

#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

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
  const auto now = []() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  for (const char* light :
    { "studio.exr", "interior.exr", "city.exr", "sunset.exr", "forest.exr", "pmndrs_sunrise.hdr" })
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
    for (const std::string& material : materials)
    {
      if (material.find(onlyMaterial) == std::string::npos)
      {
        continue;
      }
      vtkNew<vtkDoubleArray> normals, views, reference;
      AddEverywherePairs(150, normals, views);
      std::printf("%-32s %-12s", material.c_str(), light);
      // A new material for each method: nothing is known of it.
      for (const int samples : { -1, 32, 48, 64 })
      {
        for (const bool quick : { true, false })
        {
          if (!quick && samples != 64)
          {
            continue;
          }
          const auto prepare = [&](vtkBRDF* brdf)
          {
            vtkSmartPointer<vtkRadianceIntegrator> made;
            if (samples < 0)
            {
              vtkNew<vtkHybridRadianceIntegrator> table;
              table->SetSizes({ 33, 8, 8 });
              made = table;
            }
            else
            {
              vtkNew<vtkFilteredRadianceIntegrator> filtered;
              filtered->SetNumberOfSamples(samples);
              filtered->SetQuick(quick);
              made = filtered;
            }
            made->SetBRDF(brdf);
            made->SetEnvironment(environment);
            made->Prepare();
            return made;
          };
          static const auto other = BenchmarkCase::FindBRDF("gold-paint");
          prepare(other); // the map is known then
          const auto brdf = BenchmarkCase::FindBRDF(material);
          const double begin = now();
          const auto integrator = prepare(brdf);
          const double middle = now();
          if (integrator->UsesBRDFOnGPU())
          {
            brdf->GetRenderable();
          }
          const double end = now();
          if (reference->GetNumberOfTuples() == 0)
          {
            vtkNew<vtkAdaptiveRadianceIntegrator> adaptive;
            adaptive->SetBRDF(brdf);
            adaptive->SetEnvironment(environment);
            adaptive->Integrate(normals, views, reference);
          }
          vtkNew<vtkDoubleArray> radiance;
          integrator->Integrate(normals, views, radiance);
          double difference = 0.0;
          double sum = 0.0;
          for (vtkIdType k = 0; k < radiance->GetNumberOfValues(); ++k)
          {
            difference += std::abs(radiance->GetValue(k) - reference->GetValue(k));
            sum += reference->GetValue(k);
          }
          std::printf(" | %3d%s %5.1f%% %4.0f+%4.0f ms", samples, quick ? " " : "A",
            100.0 * difference / sum, middle - begin, end - middle);
        }
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}
