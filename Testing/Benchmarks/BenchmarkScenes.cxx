// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Many actors and many blocks: frame times of measured materials beside the stock mappers with PBR
// under image-based light, of one scene, in one run, frames taken in turns; first frames with many
// materials; what a further material and a further environment keep in memory. Prints the tables of
// docs/scenes.md. Needs an OpenGL context.
//
//   BenchmarkScenes [ROUNDS]      frames of each kind in turns (default 15)

#include "FrameScene.h"
#include "vtkActor.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCamera.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkCompositePolyDataMapper2.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkSumBRDF.h"
#include "vtkTexture.h"
#include "vtkVersion.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace
{
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
using StockComposite = vtkCompositePolyDataMapper2;
#else
using StockComposite = vtkCompositePolyDataMapper;
#endif

double GetHeapMegabytes() { return 1e-6 * static_cast<double>(mallinfo2().uordblks); }

vtkSmartPointer<vtkPolyData> MakeOneOfMany(int index, int side)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(index % side, index / side, 0.0);
  sphere->SetRadius(0.45);
  sphere->SetThetaResolution(16);
  sphere->SetPhiResolution(16);
  sphere->Update();
  return sphere->GetOutput();
}

/// From matte to satin.
std::vector<vtkSmartPointer<vtkBRDF>> MakeMaterials(int count)
{
  return ::MakeMaterials(count, [count](int k) { return 5.0 + 15.0 * k / count; });
}

/// A camera that sees side x side units, and light from a built-in hall.
struct Scene : FrameScene
{
  explicit Scene(int side)
    : FrameScene(500, 500, 0.5 * side)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetFocalPoint(0.5 * (side - 1), 0.5 * (side - 1), 0.0);
    camera->SetPosition(0.5 * (side - 1), 0.5 * (side - 1), 10.0);
    this->Renderer->RemoveActor(this->Actor); // there are many
    vtkNew<vtkEnvironment> hall;
    hall->SetToProceduralHall();
    this->ShadeByPBR(hall);
    this->Renderer->UseImageBasedLightingOff();
  }

  void Add(vtkMapper* mapper, bool pbr)
  {
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    if (pbr)
    {
      actor->GetProperty()->SetInterpolationToPBR();
      actor->GetProperty()->SetRoughness(0.4);
      this->Renderer->UseImageBasedLightingOn();
    }
    this->Renderer->AddActor(actor);
  }
};

/// First frames and medians of later ones, taken in turns.
struct Times
{
  std::vector<double> First;
  std::vector<double> Frame;
};
Times Measure(const std::vector<std::unique_ptr<Scene>>& scenes, int rounds)
{
  Times times;
  std::vector<std::vector<double>> frames(scenes.size());
  for (const auto& scene : scenes)
  {
    times.First.push_back(scene->Draw());
  }
  for (int round = 0; round < rounds; ++round)
  {
    for (std::size_t k = 0; k < scenes.size(); ++k)
    {
      frames[k].push_back(scenes[k]->Draw());
    }
  }
  for (const std::vector<double>& values : frames)
  {
    times.Frame.push_back(GetMedian(values));
  }
  return times;
}

void MeasureActors(int count, int rounds)
{
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  const auto materials = MakeMaterials(1);
  std::vector<std::unique_ptr<Scene>> scenes;
  for (int kind = 0; kind < 3; ++kind)
  {
    scenes.push_back(std::make_unique<Scene>(side));
    vtkNew<vtkLightSetRadianceIntegrator> lights;
    lights->SetNumberOfLights(16);
    for (int k = 0; k < count; ++k)
    {
      vtkSmartPointer<vtkPolyDataMapper> mapper;
      if (kind == 0)
      {
        mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
      }
      else
      {
        vtkNew<vtkMeasuredBRDFMapper> measured;
        measured->SetBRDF(materials[0]);
        measured->SetIntegrator(kind == 1 ? nullptr : lights.Get());
        mapper = measured.Get();
      }
      mapper->SetInputData(MakeOneOfMany(k, side));
      scenes.back()->Add(mapper, kind == 0);
    }
  }
  const Times times = Measure(scenes, rounds);
  std::printf("| %d actor%s | %.1f | %.1f | **%.2f** | %.1f | %.2f |\n", count,
    count == 1 ? "" : "s", times.Frame[0], times.Frame[1], times.Frame[1] / times.Frame[0],
    times.Frame[2], times.Frame[2] / times.Frame[0]);
}

void MeasureBlocks(int count, int rounds)
{
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  const auto materials = MakeMaterials(10);
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int k = 0; k < count; ++k)
  {
    blocks->SetBlock(static_cast<unsigned int>(k), MakeOneOfMany(k, side));
  }
  std::vector<std::unique_ptr<Scene>> scenes;
  for (int kind = 0; kind < 3; ++kind)
  {
    scenes.push_back(std::make_unique<Scene>(side));
    if (kind == 0)
    {
      vtkNew<StockComposite> mapper;
      mapper->SetInputDataObject(blocks);
      scenes.back()->Add(mapper, true);
      continue;
    }
    vtkNew<vtkCompositeMeasuredBRDFMapper> mapper;
    mapper->SetInputDataObject(blocks);
    mapper->SetBRDF(materials[0]);
    for (int k = 0; kind == 2 && k < count; ++k)
    {
      mapper->SetBlockBRDF(static_cast<unsigned int>(k) + 1, materials[k % 10]);
    }
    scenes.back()->Add(mapper, false);
  }
  const Times times = Measure(scenes, rounds);
  std::printf(
    "| %d blocks, 1 material / 10 materials | %.1f | %.1f / %.1f | **%.2f / %.2f** | | |\n", count,
    times.Frame[0], times.Frame[1], times.Frame[2], times.Frame[1] / times.Frame[0],
    times.Frame[2] / times.Frame[0]);
}

// Every one with a plan of its own.
void MeasureMaterials(int count)
{
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  const auto materials = MakeMaterials(count);
  Scene scene(side);
  const auto add = [&](int k)
  {
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    mapper->SetBRDF(materials[k]);
    mapper->SetInputData(MakeOneOfMany(k, side));
    scene.Add(mapper, false);
  };
  for (int k = 0; k < count; ++k)
  {
    add(k);
  }
  const double first = scene.Draw();
  auto* changed = vtkSumBRDF::SafeDownCast(materials[0]);
  vtkBlinnPhongBRDF::SafeDownCast(changed->GetTerm(1))->SetExponent(12.3);
  const double again = scene.Draw();
  std::printf(
    "| %d material%s | %.2f | %.0f |\n", count, count == 1 ? "" : "s", 1e-3 * first, again);
}

void MeasureMemory(int width)
{
  vtkNew<vtkEnvironment> environment;
  {
    std::vector<float> rgb(3 * static_cast<std::size_t>(width) * (width / 2));
    for (std::size_t k = 0; k < rgb.size(); ++k)
    {
      rgb[k] =
        0.5f + 0.4f * static_cast<float>(std::sin(0.001 * static_cast<double>(k / 3 % width)));
    }
    const std::size_t sun = 3 * (static_cast<std::size_t>(width / 3) * width + width / 3);
    rgb[sun] = rgb[sun + 1] = rgb[sun + 2] = 5e4f;
    environment->SetPixels(width, width / 2, rgb);
  }
  const auto materials = MakeMaterials(6);
  Scene scene(3);
  std::vector<double> heap = { GetHeapMegabytes() };
  double tables = 0.0;
  for (int k = 0; k < 6; ++k)
  {
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    mapper->SetBRDF(materials[k]);
    mapper->SetEnvironment(environment);
    mapper->SetInputData(MakeOneOfMany(k, 3));
    scene.Add(mapper, false);
    scene.Draw();
    tables = 1e-6 * static_cast<double>(mapper->GetTextureBytes());
    heap.push_back(GetHeapMegabytes());
  }
  const double pixels = 1e-6 * 12.0 * width * (width / 2);
  std::printf("| %d x %d (%.0f MB) | %.1f | %.2f | %.2f |\n", width, width / 2, pixels,
    heap[1] - heap[0], (heap[6] - heap[2]) / 4.0, tables);
}
} // namespace

int main(int argc, char* argv[])
{
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  std::printf("VTK %s, frame times in ms, medians of %d frames taken in turns\n\n",
    vtkVersion::GetVTKVersion(), rounds);
  std::printf("| scene | stock PBR, image-based light | AUTO | ratio | 16 lights | ratio |\n"
              "|---|---|---|---|---|---|\n");
  for (int count : { 1, 100, 1000, 2000 })
  {
    MeasureActors(count, rounds);
    std::fflush(stdout);
  }
  MeasureBlocks(10000, rounds);
  std::printf(
    "\n| different materials | first frame (s) | frame after one change (ms) |\n|---|---|---|\n");
  for (int count : { 1, 10, 100 })
  {
    MeasureMaterials(count);
    std::fflush(stdout);
  }
  std::printf(
    "\n| environment with a sun (its pixels) | heap after the first material (MB) | for each "
    "further material (MB) | its textures (MB) |\n|---|---|---|---|\n");
  for (int width : { 1024, 4096 })
  {
    MeasureMemory(width);
    std::fflush(stdout);
  }
  return EXIT_SUCCESS;
}
