// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Maps from simulated photographs against the samples that were photographed: prints the tables of
// docs/svbrdf.md. usage: BenchmarkMaterialMapFitting [library|tables|size]

#include "MappedSample.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace
{
const std::vector<std::string> Samples[] = { { "nickel", "red-fabric2", "blue-rubber" },
  { "gold-paint", "delrin", "white-marble", "hematite" },
  { "blue-fabric", "pink-felt", "yellow-matte-plastic" } };

double FitInSeconds(vtkMaterialMapFitter* fitter) // CPU time
{
  const std::clock_t begin = std::clock();
  if (!fitter->Fit())
  {
    std::exit(1);
  }
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void PrintLibrary()
{
  std::printf("sample | photographs | noise | error of a texel, mean | 95 %% | mean difference of "
              "weights | CPU s\n");
  for (const auto& names : Samples)
  {
    const auto original = NewMappedSample(names, 32);
    for (const int count : { 20, 100, 400 })
    {
      for (const double noise : { 0.0, 0.005, 0.02 })
      {
        const auto photographs = NewPhotographs(original, count, 0.0);
        photographs->Noise = noise;
        vtkNew<vtkMaterialMapFitter> fitter;
        fitter->SetPhotographs(photographs);
        fitter->SetMaximumNumberOfMaterials(8);
        AddLibrary(fitter);
        const double seconds = FitInSeconds(fitter);
        const WeightDifference difference = CompareWeights(fitter->GetOutput(), original);
        std::printf("%s ... | %d | %g | %.5f | %.5f | %.5f | %.2f\n", names[0].c_str(), count,
          noise, fitter->GetMeanError(), fitter->GetError95(),
          difference.AreOthers ? -1.0 : difference.Mean, seconds);
        std::fflush(stdout);
      }
    }
  }
}

void PrintTables()
{
  std::printf(
    "sample | directions | photographs | noise | factors | error of a texel, mean | 95 %% "
    "| unseen, anywhere | unseen, near the mirror direction | seen | CPU s\n");
  for (const auto& names : Samples)
  {
    const auto original = NewMappedSample(names, 24);
    for (const bool half : { false, true })
    {
      for (const int count : { 100, 400 })
      {
        for (const double noise : { 0.0, 0.01 })
        {
          vtkNew<SimulatedPhotographs> photographs;
          photographs->Map = original;
          photographs->Noise = noise;
          half ? photographs->AddHalfVectorDirections(count, 0.0)
               : photographs->AddBonnDirections(count, 0.0);
          vtkNew<vtkMaterialMapFitter> fitter;
          fitter->SetPhotographs(photographs);
          fitter->SetMethodToTables();
          fitter->SetMaximumNumberOfMaterials(static_cast<int>(names.size()));
          const double seconds = FitInSeconds(fitter);
          std::printf("%s ... | %s | %d | %g | %.4f | %.4f | %.4f | %.4f | %.4f | %.3f | %.2f\n",
            names[0].c_str(), half ? "half vector" : "Bonn", count, noise,
            fitter->GetFactorizationError(), fitter->GetMeanError(), fitter->GetError95(),
            ComparePhotographs(fitter->GetOutput(), original, false),
            ComparePhotographs(fitter->GetOutput(), original, true), fitter->GetSeenShare(),
            seconds);
          std::fflush(stdout);
        }
      }
    }
  }
}

void PrintSize()
{
  std::printf("texels | photographs | method | CPU s of the fit | of the photographs\n");
  for (const int side : { 128, 256 })
  {
    const auto original = NewMappedSample(Samples[0], side);
    const auto photographs = NewPhotographs(original, 100, 0.0);
    const std::clock_t begin = std::clock();
    for (int k = 0; k < 100; ++k)
    {
      vtkSmartPointer<vtkImageData>::Take(photographs->NewPicture(k));
    }
    const double simulated = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    for (const int method : { vtkMaterialMapFitter::LIBRARY, vtkMaterialMapFitter::TABLES })
    {
      vtkNew<vtkMaterialMapFitter> fitter;
      fitter->SetPhotographs(photographs);
      fitter->SetMethod(method);
      fitter->SetMaximumNumberOfMaterials(3);
      AddLibrary(fitter);
      const double seconds = FitInSeconds(fitter);
      std::printf("%d x %d | 100 | %s | %.2f | %.2f\n", side, side,
        method == vtkMaterialMapFitter::LIBRARY ? "library" : "tables", seconds - 2.0 * simulated,
        2.0 * simulated); // photographs are read twice
      std::fflush(stdout);
    }
  }
}
}

int main(int argc, char* argv[])
{
  const std::string wanted = argc > 1 ? argv[1] : "";
  if (wanted.empty() || wanted == "library")
  {
    PrintLibrary();
  }
  if (wanted.empty() || wanted == "tables")
  {
    PrintTables();
  }
  if (wanted.empty() || wanted == "size")
  {
    PrintSize();
  }
  return 0;
}
