// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What surfaces hide from themselves sends light back: the error of drawing it black, and with one
// bounce (SetOcclusionBounce), against traced light with one bounce; and the time of a frame.
// Meshes x materials x maps, a line of CSV for each. Needs an OpenGL context.
//
// The truth of a pixel is what the mapper draws without occlusion, times the visible share of its
// light (OcclusionTruth.h), plus what vtkTracedRadianceIntegrator finds with a bounce and not
// without, from the same samples: errors are those of occlusion alone. Two seeds tell its noise.
#include "FloatWindow.h"
#include "OcclusionMeshes.h"
#include "OcclusionTruth.h"
#include "vtkDoubleArray.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTracedRadianceIntegrator.h"
#include "vtkTracedScene.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace occlusiontruth;
using namespace measuredbrdf;

namespace
{
std::vector<Material> MakeBounceMaterials()
{
  std::vector<Material> materials;
  const glm::dvec3 albedos[] = { glm::dvec3(1.0), glm::dvec3(0.5), glm::dvec3(0.7, 0.3, 0.1) };
  const char* const names[] = { "white", "grey", "orange" };
  for (int k = 0; k < 3; ++k)
  {
    vtkNew<vtkLambertBRDF> matte;
    matte->SetAlbedo(albedos[k].x, albedos[k].y, albedos[k].z);
    materials.push_back({ names[k], matte });
  }
  for (const Material& material : MakeMaterials())
  {
    if (material.Name == "blinn50" || material.Name == "satin_purple")
    {
      materials.push_back(material);
    }
  }
  return materials;
}

// What one bounce adds at pixels, by samples; the second half of them for the noise.
struct TracedBounce
{
  std::vector<glm::dvec3> Radiance;
  double Noise = 0.0; // sum of standard errors

  TracedBounce(vtkPolyData* hits, vtkDataArray* views, vtkTracedRadianceIntegrator* integrator)
    : Radiance(static_cast<std::size_t>(hits->GetNumberOfPoints()), glm::dvec3(0.0))
  {
    std::vector<glm::dvec3> halves[2];
    for (int seed = 0; seed < 2; ++seed)
    {
      vtkNew<vtkDoubleArray> radiance[2];
      integrator->SetSeed(seed);
      for (int bounces = 0; bounces < 2; ++bounces)
      {
        integrator->SetNumberOfBounces(bounces);
        integrator->Integrate(hits, views, radiance[bounces]);
      }
      for (std::size_t k = 0; k < this->Radiance.size(); ++k)
      {
        glm::dvec3 values[2];
        radiance[0]->GetTuple(static_cast<vtkIdType>(k), &values[0].x);
        radiance[1]->GetTuple(static_cast<vtkIdType>(k), &values[1].x);
        halves[seed].push_back(values[1] - values[0]);
        this->Radiance[k] += 0.5 * halves[seed].back();
      }
    }
    for (std::size_t k = 0; k < this->Radiance.size(); ++k)
    {
      this->Noise += 0.5 * Sum(halves[0][k] - halves[1][k]);
    }
  }
};

struct Bench
{
  std::vector<Material> Materials;
  std::vector<Map> Maps;
  int NumberOfPixels = 150;
  int Samples = 1024;
  int Rounds = 0;
  std::string Pictures;

  // Over pictures: black, bounce.
  std::array<double, 2> Sums{};
  std::array<double, 2> Worst{};
  int Count = 0;
  int Worse = 0;

  void Measure(const std::string& mesh);
};

// Drawn by the mapper with occlusion off, black, and with a bounce.
struct Drawings
{
  FloatPicture Pictures[3];
  double Frames[3] = { 0.0, 0.0, 0.0 };

  Drawings(vtkMeasuredBRDFMapper* mapper, FloatWindow& window, int rounds)
  {
    for (int mode = 0; mode < 3; ++mode)
    {
      Set(mapper, mode);
      this->Pictures[mode] = window.Render();
    }
    for (int round = 0; round < 3 * rounds; ++round)
    {
      Set(mapper, round % 3);
      window.Draw();
      const double start = GetSeconds();
      window.Draw();
      window.Draw();
      const double seconds = 0.5 * (GetSeconds() - start);
      double& least = this->Frames[round % 3];
      least = round < 3 ? seconds : std::min(least, seconds);
    }
  }

private:
  static void Set(vtkMeasuredBRDFMapper* mapper, int mode)
  {
    mapper->SetOcclusionMode(mode > 0 ? 1 : 0);
    mapper->SetOcclusionBounce(mode == 2);
  }
};

void Bench::Measure(const std::string& mesh)
{
  const auto surface = MakeOcclusionMesh(mesh);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputData(surface);
  filter->BothSidesOn();
  const double begun = GetSeconds();
  filter->Update();
  const double traced = GetSeconds();
  filter->BounceOn();
  filter->Update();
  const double bounced = GetSeconds();
  SurfaceTracer tracer;
  tracer.AddSurface(surface);
  tracer.Build();
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(filter->GetOutputPort());
  FloatWindow window(mapper, surface);
  std::vector<Pixel> pixels = FindPixels(surface, tracer, window, this->NumberOfPixels);
  TracePixels(tracer, pixels);
  vtkNew<vtkTracedScene> scene;
  scene->AddSurface(surface);
  vtkNew<vtkDoubleArray> rays[3]; // origins, directions, views
  for (const auto& array : { rays[0].Get(), rays[1].Get(), rays[2].Get() })
  {
    array->SetNumberOfComponents(3);
  }
  for (const Pixel& pixel : pixels)
  {
    glm::dvec3 eye, direction;
    window.GetRay(pixel.X, pixel.Y, &eye.x, &direction.x);
    rays[0]->InsertNextTuple(&eye.x);
    rays[1]->InsertNextTuple(&direction.x);
    rays[2]->InsertNextTuple(&pixel.View.x);
  }
  vtkNew<vtkPolyData> hits;
  scene->CastRays(rays[0], rays[1], hits);
  for (const Material& material : this->Materials)
  {
    const auto kernels = MakeKernels(material.BRDF, pixels);
    for (const Map& map : this->Maps)
    {
      vtkNew<vtkHybridRadianceIntegrator> integrator;
      integrator->SetLightAngle(LampDegrees);
      mapper->SetBRDF(material.BRDF);
      mapper->SetEnvironment(map.Environment);
      mapper->SetIntegrator(integrator);
      const Drawings drawn(mapper, window, this->Rounds);
      vtkNew<vtkTracedRadianceIntegrator> reference;
      reference->SetScene(scene);
      reference->SetBRDF(material.BRDF);
      reference->SetEnvironment(map.Environment);
      reference->SetNumberOfSamples(this->Samples / 2);
      reference->UnoccludedReferenceOff();
      const TracedBounce bounce(hits, rays[2], reference);
      std::array<double, 2> errors{};
      double all = 0.0;
      for (std::size_t k = 0; k < pixels.size(); ++k)
      {
        const auto get = [&](int mode)
        { return drawn.Pictures[mode].Get(pixels[k].X, pixels[k].Y); };
        const glm::dvec3 visible = get(0) * GetShares(pixels[k], kernels[k], map).Visible;
        const glm::dvec3 truth = visible + bounce.Radiance[k];
        all += Sum(truth);
        errors[0] += Sum(get(1) - truth);
        errors[1] += Sum(get(2) - truth);
      }
      std::printf("%s,%lld,%.2f,%.2f,%s,%s,%.2f,%.2f,%.2f,%.1f,%.1f,%.1f\n", mesh.c_str(),
        static_cast<long long>(surface->GetNumberOfPoints()), traced - begun, bounced - traced,
        material.Name.c_str(), map.Name.c_str(), 100.0 * bounce.Noise / all,
        100.0 * errors[0] / all, 100.0 * errors[1] / all, 1e3 * drawn.Frames[0],
        1e3 * drawn.Frames[1], 1e3 * drawn.Frames[2]);
      std::fflush(stdout);
      for (std::size_t k = 0; k < errors.size(); ++k)
      {
        this->Sums[k] += errors[k] / all;
        this->Worst[k] = std::max(this->Worst[k], errors[k] / all);
      }
      this->Worse += errors[1] > errors[0] ? 1 : 0;
      ++this->Count;
      if (!this->Pictures.empty())
      {
        const std::string file = this->Pictures + "/" + mesh + "-" + material.Name + "-" +
                                 map.Name.substr(0, map.Name.find('.'));
        drawn.Pictures[0].Write(file + "-off.png");
        drawn.Pictures[1].Write(file + "-black.png");
        drawn.Pictures[2].Write(file + "-bounce.png");
      }
    }
  }
}
}

int main(int argc, char** argv)
{
  std::vector<std::string> meshes = { "gear", "isosurface", "knob", "molecule" };
  std::vector<std::string> maps = { "city.exr", "interior.exr", "studio.exr" };
  std::vector<std::string> materials;
  Bench bench;
  CLI::App app("One bounce of what surfaces hide from themselves.");
  app.add_option("--meshes", meshes, "Those of the default, bumps, torus, or .vtp files");
  app.add_option("--materials", materials, "Some of white, grey, orange, blinn50, satin_purple");
  app.add_option("--maps", maps, "Files of the data folder, or embedded names");
  app.add_option("--pixels", bench.NumberOfPixels, "Of each picture");
  app.add_option("--samples", bench.Samples, "Traced directions of each pixel");
  app.add_option("--rounds", bench.Rounds, "Of frames for times; 0: none");
  app.add_option("--pictures", bench.Pictures, "Folder for pictures");
  CLI11_PARSE(app, argc, argv);

  for (const std::string& name : maps)
  {
    if (auto environment = BenchmarkCase::FindEnvironment(name))
    {
      bench.Maps.push_back(MakeMap(name, environment));
    }
  }
  for (const Material& material : MakeBounceMaterials())
  {
    if (materials.empty() ||
        std::find(materials.begin(), materials.end(), material.Name) != materials.end())
    {
      bench.Materials.push_back(material);
    }
  }
  vtkObject::GlobalWarningDisplayOn(); // readers turn it off
  std::printf("mesh,points,trace s,bounce s,material,map,noise %%,black %%,bounce %%,frame off ms,"
              "frame black ms,frame bounce ms\n");
  for (const std::string& mesh : meshes)
  {
    bench.Measure(mesh);
  }
  std::printf(
    "mean,%.2f,%.2f", 100.0 * bench.Sums[0] / bench.Count, 100.0 * bench.Sums[1] / bench.Count);
  std::printf("\nworst,%.2f,%.2f\nworse than black,%d of %d\n", 100.0 * bench.Worst[0],
    100.0 * bench.Worst[1], bench.Worse, bench.Count);
  return 0;
}
