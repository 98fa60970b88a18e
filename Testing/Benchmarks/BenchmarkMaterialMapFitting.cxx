// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Maps from simulated photographs against the samples that were photographed: prints the tables of
// docs/svbrdf.md. usage: BenchmarkMaterialMapFitting [library|tables|size]

#include "MappedSample.h"

#include "vtkBRDF.h"
#include "vtkDataArray.h"
#include "vtkMaterialMapFitter.h"
#include "vtkPointData.h"

#include <cstdio>
#include <ctime>
#include <random>

namespace
{
const std::vector<std::string> Samples[] = { { "nickel", "red-fabric2", "blue-rubber" },
  { "gold-paint", "delrin", "white-marble", "hematite" },
  { "blue-fabric", "pink-felt", "yellow-matte-plastic" } };

//------------------------------------------------------------------------------
/// Relative L1 difference of the photographs that two maps give, at directions up to 60 degrees
/// that no fit has: half of them anywhere, half near the mirror direction. Photographs count alike.
double Compare(vtkMaterialMap* found, vtkMaterialMap* original, bool mirror)
{
  vtkNew<vtkSimulatedPhotographSet> sets[2];
  sets[0]->SetMaterialMap(found);
  sets[1]->SetMaterialMap(original);
  std::mt19937 random(3);
  const auto number = [&](double from, double to)
  { return from + (to - from) * static_cast<double>(random()) * 0x1p-32; };
  for (int k = 0; k < 100; ++k)
  {
    double light[3], view[3];
    const double theta = number(0.0, 60.0), phi = number(0.0, 360.0);
    vtkPhotographSet::GetDirection(theta, phi, light);
    vtkPhotographSet::GetDirection(mirror ? theta + number(0.0, 8.0) : number(0.0, 60.0),
      mirror ? phi + number(175.0, 185.0) : number(0.0, 360.0), view);
    sets[0]->AddDirections(light, view);
    sets[1]->AddDirections(light, view);
  }
  double sum = 0.0;
  for (int k = 0; k < 100; ++k)
  {
    const auto a = vtkSmartPointer<vtkImageData>::Take(sets[0]->NewPicture(k));
    const auto b = vtkSmartPointer<vtkImageData>::Take(sets[1]->NewPicture(k));
    vtkDataArray* x = a->GetPointData()->GetScalars();
    vtkDataArray* r = b->GetPointData()->GetScalars();
    double difference = 0.0, whole = 0.0;
    for (vtkIdType texel = 0; texel < x->GetNumberOfTuples(); ++texel)
    {
      for (int c = 0; c < 3; ++c)
      {
        difference += std::abs(x->GetComponent(texel, c) - r->GetComponent(texel, c));
        whole += r->GetComponent(texel, c);
      }
    }
    sum += difference / whole / 100.0;
  }
  return sum;
}

//------------------------------------------------------------------------------
double FitInSeconds(vtkMaterialMapFitter* fitter) // CPU time
{
  const std::clock_t begin = std::clock();
  if (!fitter->Fit())
  {
    std::exit(1);
  }
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

//------------------------------------------------------------------------------
void AddLibrary(vtkMaterialMapFitter* fitter)
{
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    fitter->AddMaterial(brdf, name);
  }
}

//------------------------------------------------------------------------------
/// Mean difference of weights; -1 where the materials are not the sample's.
double CompareWeights(vtkMaterialMap* found, vtkMaterialMap* original)
{
  double sum = 0.0;
  const int texels = static_cast<int>(original->GetWeightImage(0)->GetNumberOfPoints());
  for (int k = 0; k < original->GetNumberOfMaterials(); ++k)
  {
    int number = 0;
    while (number < found->GetNumberOfMaterials() && found->GetName(number) != original->GetName(k))
    {
      ++number;
    }
    for (int texel = 0; texel < texels && number < found->GetNumberOfMaterials(); ++texel)
    {
      sum += std::abs(GetWeight(found, number, texel) - GetWeight(original, k, texel));
    }
    if (number == found->GetNumberOfMaterials())
    {
      return -1.0;
    }
  }
  return found->GetNumberOfMaterials() == original->GetNumberOfMaterials()
           ? sum / texels / original->GetNumberOfMaterials()
           : -1.0;
}

//------------------------------------------------------------------------------
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
        photographs->SetNoise(noise);
        vtkNew<vtkMaterialMapFitter> fitter;
        fitter->SetPhotographs(photographs);
        fitter->SetMaximumNumberOfMaterials(8);
        AddLibrary(fitter);
        const double seconds = FitInSeconds(fitter);
        std::printf("%s ... | %d | %g | %.5f | %.5f | %.5f | %.2f\n", names[0].c_str(), count,
          noise, fitter->GetMeanError(), fitter->GetError95(),
          CompareWeights(fitter->GetOutput(), original), seconds);
        std::fflush(stdout);
      }
    }
  }
}

//------------------------------------------------------------------------------
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
          vtkNew<vtkSimulatedPhotographSet> photographs;
          photographs->SetMaterialMap(original);
          photographs->SetNoise(noise);
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
            Compare(fitter->GetOutput(), original, false),
            Compare(fitter->GetOutput(), original, true), fitter->GetSeenShare(), seconds);
          std::fflush(stdout);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
void PrintSize()
{
  std::printf("texels | photographs | method | passes | CPU s of the fit | of the photographs\n");
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
      std::printf("%d x %d | 100 | %s | %d | %.2f | %.2f\n", side, side,
        method == vtkMaterialMapFitter::LIBRARY ? "library" : "tables", fitter->GetNumberOfPasses(),
        seconds - simulated * fitter->GetNumberOfPasses(), simulated * fitter->GetNumberOfPasses());
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
