// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of several materials: frame times and textures beside one material's, of a sphere of
// 64,000 triangles in 500 x 500 pixels, in one run, frames taken in turns. Times are the CPU's, of
// all threads: a software renderer's, whatever else the machine does. Prints the table of
// docs/maps.md. Needs an OpenGL context.
//
//   BenchmarkMaterialMap [ROUNDS [NAME [PIXELS]]]
//
// ROUNDS: frames of each kind in turns (default 25). NAME: only those of which it is a part, and
// the first. PIXELS: the window's width and height (default 500).

#include "FrameScene.h"
#include "vtkActor.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialMap.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkSumBRDF.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace
{
double GetMilliseconds(std::clock_t start)
{
  return 1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

vtkSmartPointer<vtkPolyData> MakeMappedSphere(int resolution = 180)
{
  const vtkSmartPointer<vtkPolyData> copy = MakeSphere(0.5, resolution);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("coordinates");
  coordinates->SetNumberOfComponents(2);
  for (vtkIdType p = 0; p < copy->GetNumberOfPoints(); ++p)
  {
    const double* at = copy->GetPoint(p);
    coordinates->InsertNextTuple2(at[0] + 0.5, at[1] + 0.5);
  }
  copy->GetPointData()->SetTCoords(coordinates);
  return copy;
}

struct Kind
{
  std::string Name;
  int Meeting; // materials in a pixel
  vtkSmartPointer<vtkMeasuredBRDFMapper> Mapper;
  double First = 0.0;
  double Bytes = 0.0;
  double Least = 1e9;
};

class Benchmark
{
public:
  explicit Benchmark(int pixels)
  {
    this->Environment->SetToProceduralSky();
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(pixels, pixels);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->SetAutomaticLightCreation(false);
    this->Renderer->AddActor(this->Actor);
    this->Materials = MakeMaterials(1024, [](int k) { return 8.0 + 0.1 * (k % 256); });
    this->OtherMaterials = MakeMaterials(64, [](int k) { return std::pow(4.0, 1.0 + k % 6); });
    this->MaterialsInSun = MakeMaterials(64, [](int k) { return 8.0 + 0.1 * k; });
    for (std::size_t k = 0; k < this->MaterialsInSun.size(); ++k)
    {
      auto* material = vtkSumBRDF::SafeDownCast(this->MaterialsInSun[k]);
      if (k % 3 != 0) // gloss or a diffuse part alone: other shaders
      {
        const vtkSmartPointer<vtkBRDF> term = material->GetTerm(static_cast<int>(k % 3) - 1);
        material->RemoveAllTerms();
        material->AddTerm(term);
      }
    }
    std::vector<float> sky(3 * 256 * 128, 0.3f); // with two small suns
    for (const std::size_t sun : { 100 * 256 + 40, 85 * 256 + 150 })
    {
      std::fill_n(sky.begin() + static_cast<std::ptrdiff_t>(3 * sun), 3, 4000.0f);
    }
    this->Suns->SetPixels(256, 128, sky);
  }

  void AddAll(const std::string& wanted)
  {
    this->Wanted = wanted;
    this->Add("one material", 1, MakeMappedSphere(), nullptr);
    this->Kinds.front().Mapper->SetBRDF(this->Materials[0]);
    for (int classes : { 2, 8, 24, 256, 1024 })
    {
      this->AddClasses(classes, true);
    }
    for (int classes : { 8, 64 })
    {
      this->AddClasses(classes, false);
    }
    this->AddColoredClasses(64);
    this->Materials.swap(this->OtherMaterials);
    this->NameEnd = ", tables of 17 to 129 rows";
    this->AddClasses(64, false);
    this->Materials.swap(this->OtherMaterials);
    this->NameEnd.clear();
    this->AddInSun();
    if (Kind* fine = this->Add("one material, as many triangles as 64 classes of points", 1,
          MakeMappedSphere(235), nullptr))
    {
      fine->Mapper->SetBRDF(this->Materials[0]);
    }
    this->AddValues(8);
    for (int weights : { 2, 3, 4 })
    {
      this->AddWeights(weights);
    }
    for (int weights : { 2, 4 })
    {
      this->AddImages(weights);
    }
  }

  // Two suns are lights beside tables, which evaluate materials of three shaders.
  void AddInSun()
  {
    const std::size_t before = this->Kinds.size();
    this->Materials.swap(this->MaterialsInSun);
    this->NameEnd = ", three shaders, suns as lights";
    if (Kind* one = this->Add("one material, suns as lights", 1, MakeMappedSphere(), nullptr))
    {
      one->Mapper->SetBRDF(this->Materials[0]);
    }
    this->AddClasses(64, false);
    for (std::size_t k = before; k < this->Kinds.size(); ++k)
    {
      vtkNew<vtkHybridRadianceIntegrator> hybrid;
      hybrid->SetNumberOfRows(17);
      this->Kinds[k].Mapper->SetEnvironment(this->Suns);
      this->Kinds[k].Mapper->SetIntegrator(hybrid);
    }
    this->NameEnd.clear();
    this->Materials.swap(this->MaterialsInSun);
  }

  void Run(int rounds)
  {
    for (Kind& kind : this->Kinds)
    {
      this->Actor->SetMapper(kind.Mapper);
      this->Renderer->ResetCamera();
      this->Renderer->GetActiveCamera()->Zoom(1.5);
      const std::clock_t start = std::clock();
      this->Window->Render();
      kind.First = GetMilliseconds(start);
      kind.Bytes = static_cast<double>(kind.Mapper->GetTextureBytes());
    }
    for (int round = 0; round < rounds; ++round)
    {
      for (Kind& kind : this->Kinds)
      {
        this->Actor->SetMapper(kind.Mapper);
        this->Window->Render(); // what the last kind left in caches
        const std::clock_t start = std::clock();
        this->Window->Render();
        kind.Least = std::min(kind.Least, GetMilliseconds(start));
      }
    }
    std::printf(
      "| surface | materials in a pixel | frame, ms | times one material | of that times their "
      "number | textures, KB | first frame, s |\n|---|---|---|---|---|---|---|\n");
    for (const Kind& kind : this->Kinds)
    {
      const double ratio = kind.Least / this->Kinds.front().Least;
      std::printf("| %s | %d | %.1f | %.2f | %.2f | %.0f | %.1f |\n", kind.Name.c_str(),
        kind.Meeting, kind.Least, ratio, ratio / kind.Meeting, kind.Bytes / 1024.0,
        kind.First / 1000.0);
    }
  }

private:
  /// Null where it is not wanted.
  Kind* Add(const std::string& name, int meeting, vtkPolyData* surface, vtkMaterialMap* map)
  {
    Kind kind{ name, meeting, vtkSmartPointer<vtkMeasuredBRDFMapper>::New() };
    kind.Mapper->SetInputData(surface);
    kind.Mapper->SetEnvironment(this->Environment);
    kind.Mapper->SetMaterialMap(map);
    if (!this->Kinds.empty() && name.find(this->Wanted) == std::string::npos)
    {
      return nullptr;
    }
    this->Kinds.push_back(kind);
    return &this->Kinds.back();
  }

  vtkSmartPointer<vtkMaterialMap> NewMap(int mode, int materials)
  {
    auto map = vtkSmartPointer<vtkMaterialMap>::New();
    map->SetMode(mode);
    map->SetArrayName("data");
    for (int k = 0; k < materials; ++k)
    {
      map->AddMaterial(this->Materials[static_cast<std::size_t>(k)]);
    }
    return map;
  }

  // Wedges about the z axis.
  Kind* AddClasses(int classes, bool ofCells)
  {
    const vtkSmartPointer<vtkPolyData> sphere = MakeMappedSphere();
    vtkNew<vtkIntArray> array;
    array->SetName("data");
    const vtkIdType count = ofCells ? sphere->GetNumberOfCells() : sphere->GetNumberOfPoints();
    for (vtkIdType k = 0; k < count; ++k)
    {
      double bounds[6];
      double* p = ofCells ? bounds : sphere->GetPoint(k);
      if (ofCells)
      {
        sphere->GetCellBounds(k, bounds);
        bounds[1] = bounds[2];
      }
      // Of many classes, a few triangles in a row each.
      const double turn = classes > 64 ? static_cast<double>(k) / static_cast<double>(count)
                                       : std::atan2(p[1], p[0]) / 6.2831854 + 0.5;
      array->InsertNextValue(std::min(static_cast<int>(turn * classes), classes - 1));
    }
    (ofCells ? static_cast<vtkDataSetAttributes*>(sphere->GetCellData()) : sphere->GetPointData())
      ->AddArray(array);
    return this->Add(
      std::to_string(classes) + " classes of " + (ofCells ? "cells" : "points") + this->NameEnd, 1,
      sphere, this->NewMap(vtkMaterialMap::CLASSES, classes));
  }

  // In white: nothing changes.
  void AddColoredClasses(int classes)
  {
    Kind* kind = this->AddClasses(classes, false);
    if (!kind)
    {
      return;
    }
    kind->Name += ", colors of cells";
    vtkPolyData* sphere = kind->Mapper->GetInput();
    vtkNew<vtkUnsignedCharArray> white;
    white->SetName("white");
    white->SetNumberOfComponents(3);
    white->SetNumberOfTuples(sphere->GetNumberOfCells());
    white->Fill(255.0);
    sphere->GetCellData()->AddArray(white);
    kind->Mapper->SetScalarModeToUseCellFieldData();
    kind->Mapper->SelectColorArray("white");
  }

  void AddValues(int materials)
  {
    const vtkSmartPointer<vtkPolyData> sphere = MakeMappedSphere();
    vtkNew<vtkFloatArray> array;
    array->SetName("data");
    for (vtkIdType p = 0; p < sphere->GetNumberOfPoints(); ++p)
    {
      array->InsertNextValue(static_cast<float>((sphere->GetPoint(p)[0] + 0.5) * (materials - 1)));
    }
    sphere->GetPointData()->AddArray(array);
    this->Add(std::to_string(materials) + " materials on a scale", 2, sphere,
      this->NewMap(vtkMaterialMap::VALUES, materials));
  }

  void AddWeights(int materials)
  {
    const vtkSmartPointer<vtkPolyData> sphere = MakeMappedSphere();
    vtkNew<vtkFloatArray> array;
    array->SetName("data");
    array->SetNumberOfComponents(materials);
    array->SetNumberOfTuples(sphere->GetNumberOfPoints());
    array->FillValue(1.0f);
    sphere->GetPointData()->AddArray(array);
    this->Add(std::to_string(materials) + " weights of points", materials, sphere,
      this->NewMap(vtkMaterialMap::WEIGHTS, materials));
  }

  void AddImages(int materials)
  {
    const auto map = this->NewMap(vtkMaterialMap::TEXTURES, materials);
    vtkNew<vtkImageData> image;
    image->SetDimensions(256, 256, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, materials);
    image->GetPointData()->GetScalars()->Fill(100.0);
    map->AddWeightImage(image);
    this->Add(
      std::to_string(materials) + " weights in an image", materials, MakeMappedSphere(), map);
  }

  vtkNew<vtkEnvironment> Environment;
  vtkNew<vtkEnvironment> Suns;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkActor> Actor;
  std::vector<vtkSmartPointer<vtkBRDF>> Materials;
  std::vector<vtkSmartPointer<vtkBRDF>> OtherMaterials;
  std::vector<vtkSmartPointer<vtkBRDF>> MaterialsInSun;
  std::vector<Kind> Kinds;
  std::string NameEnd;
  std::string Wanted;
};
}

int main(int argc, char* argv[])
{
  Benchmark benchmark(argc > 3 ? std::max(std::atoi(argv[3]), 1) : 500);
  benchmark.AddAll(argc > 2 ? argv[2] : "");
  benchmark.Run(argc > 1 ? std::max(std::atoi(argv[1]), 1) : 25);
  return EXIT_SUCCESS;
}
