// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What surfaces hide from themselves: the error of drawing without it, with a factor of ambient
// occlusion, with vtkSurfaceVisibilityFilter's arrays (black) and with --bounce also with one
// bounce (SetOcclusionBounce), over meshes x materials x maps; and the time of a frame. A line of
// CSV for each. Needs an OpenGL context.
//
// The truth of a pixel is what the mapper draws without occlusion, times the visible share of its
// light (OcclusionTruth.h). With --bounce, what vtkTracedRadianceIntegrator finds with a bounce and
// not without comes to it, from the same samples; two seeds tell its noise. So errors are those of
// occlusion alone.
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

namespace
{
struct Options
{
  std::vector<std::string> Meshes, Maps, Materials;
  bool Bounce = false;
  int Pixels = 300;
  int Samples = 1024;
  int Rays = 0;
  int Rounds = 0;
  std::string Pictures;
};

/// What is drawn: without occlusion, with it, and with a bounce.
enum Mode
{
  Off,
  Black,
  Bounced
};

/// Sums over pictures of the errors off, ambient, black and bounced.
struct Totals
{
  std::array<double, 4> Sums{}, Worst{};
  int Count = 0;
  int Worse = 0; // pictures whose last mode is further off than the first that it is to mend
};

// What one bounce adds at pixels, and the sum of its standard errors.
struct TracedBounce
{
  std::vector<glm::dvec3> Radiance;
  double Noise = 0.0;

  explicit TracedBounce(std::size_t count)
    : Radiance(count, glm::dvec3(0.0))
  {
  }

  void Trace(vtkPolyData* hits, vtkDataArray* views, vtkTracedRadianceIntegrator* integrator)
  {
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
        const glm::dvec3 half = values[1] - values[0];
        this->Noise += seed == 1 ? 0.5 * Sum(this->Radiance[k] - half) : 0.0;
        this->Radiance[k] = seed == 0 ? half : 0.5 * (this->Radiance[k] + half);
      }
    }
  }
};

void SetMode(vtkMeasuredBRDFMapper* mapper, int mode)
{
  mapper->SetOcclusionMode(mode == Off ? 0 : 1);
  mapper->SetOcclusionBounce(mode == Bounced);
}

/// The least time of a frame by each mode, of as many rounds.
std::array<double, 3> TimeFrames(
  vtkMeasuredBRDFMapper* mapper, FloatWindow& window, const Options& options)
{
  std::array<double, 3> frames{};
  for (int round = 0; round < options.Rounds; ++round)
  {
    for (const int mode : { Off, Black, Bounced })
    {
      if (mode == Bounced && !options.Bounce)
      {
        continue;
      }
      SetMode(mapper, mode);
      window.Draw();
      const double start = GetSeconds();
      window.Draw();
      window.Draw();
      const double seconds = 0.5 * (GetSeconds() - start);
      double& least = frames[static_cast<std::size_t>(mode)];
      least = round == 0 ? seconds : std::min(least, seconds);
    }
  }
  return frames;
}

void Measure(const std::string& name, const std::vector<Material>& materials,
  const std::vector<Map>& maps, const Options& options, Totals& totals)
{
  const auto surface = MakeOcclusionMesh(name);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputData(surface);
  filter->SetBothSides(options.Bounce);
  if (options.Rays > 0)
  {
    filter->SetNumberOfRays(options.Rays);
  }
  const double begun = GetSeconds();
  filter->Update();
  const double traced = GetSeconds();
  filter->SetBounce(options.Bounce);
  filter->Update();
  const double bounced = GetSeconds();
  SurfaceTracer tracer;
  tracer.AddSurface(surface);
  tracer.Build();
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(filter->GetOutputPort());
  FloatWindow window(mapper, surface);
  std::vector<Pixel> pixels = FindPixels(surface, tracer, window, options.Pixels);
  TracePixels(tracer, pixels);
  vtkNew<vtkTracedScene> scene;
  scene->AddSurface(surface);
  vtkNew<vtkDoubleArray> rays[3]; // origins, directions, views
  for (const auto& array : rays)
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
  for (const Material& material : materials)
  {
    const auto kernels = MakeKernels(material.BRDF, pixels);
    for (const Map& map : maps)
    {
      vtkNew<vtkHybridRadianceIntegrator> integrator;
      integrator->SetLightAngle(LampDegrees);
      mapper->SetBRDF(material.BRDF);
      mapper->SetEnvironment(map.Environment);
      mapper->SetIntegrator(integrator);
      TracedBounce bounce(pixels.size());
      if (options.Bounce)
      {
        vtkNew<vtkTracedRadianceIntegrator> reference;
        reference->SetScene(scene);
        reference->SetBRDF(material.BRDF);
        reference->SetEnvironment(map.Environment);
        reference->SetNumberOfSamples(options.Samples / 2);
        reference->UnoccludedReferenceOff();
        bounce.Trace(hits, rays[2], reference);
      }
      FloatPicture pictures[3];
      for (int mode = 0; mode <= (options.Bounce ? Bounced : Black); ++mode)
      {
        SetMode(mapper, mode);
        pictures[mode] = window.Render();
        if (!options.Pictures.empty())
        {
          const char* const endings[] = { "-off.png", "-black.png", "-bounce.png" };
          pictures[mode].Write(options.Pictures + "/" + name + "-" + material.Name + "-" +
                               map.Name.substr(0, map.Name.find('.')) + endings[mode]);
        }
      }
      std::array<double, 4> errors{};
      double all = 0.0;
      for (std::size_t k = 0; k < pixels.size(); ++k)
      {
        const auto get = [&](int mode) { return pictures[mode].Get(pixels[k].X, pixels[k].Y); };
        const Shares shares = GetShares(pixels[k], kernels[k], map);
        const glm::dvec3 truth = get(Off) * shares.Visible + bounce.Radiance[k];
        all += Sum(truth);
        errors[0] += Sum(get(Off) - truth);
        errors[1] += Sum(get(Off) * shares.Open - truth);
        errors[2] += Sum(get(Black) - truth);
        errors[3] += options.Bounce ? Sum(get(Bounced) - truth) : 0.0;
      }
      std::printf("%s,%lld,%.2f,%.2f,%s,%s,%.2f", name.c_str(),
        static_cast<long long>(surface->GetNumberOfPoints()), traced - begun, bounced - traced,
        material.Name.c_str(), map.Name.c_str(), 100.0 * bounce.Noise / all);
      for (std::size_t k = 0; k < errors.size(); ++k)
      {
        errors[k] /= all;
        std::printf(",%.2f", 100.0 * errors[k]);
        totals.Sums[k] += errors[k];
        totals.Worst[k] = std::max(totals.Worst[k], errors[k]);
      }
      for (const double seconds : TimeFrames(mapper, window, options))
      {
        std::printf(",%.1f", 1e3 * seconds);
      }
      std::printf("\n");
      std::fflush(stdout);
      totals.Worse += options.Bounce ? errors[3] > errors[2] : errors[2] > errors[0];
      ++totals.Count;
    }
  }
}

/// The names that were asked for, or these.
std::vector<std::string> Choose(
  const std::vector<std::string>& asked, const std::vector<std::string>& usual)
{
  return asked.empty() ? usual : asked;
}
}

int main(int argc, char** argv)
{
  Options options;
  CLI::App app("The error of what surfaces hide from themselves.");
  app.add_flag("--bounce", options.Bounce, "Compare with traced light that bounces once");
  app.add_option("--meshes", options.Meshes,
    "bumps, fine-bumps, gear, isosurface, knob, molecule, torus, or .vtp files with point normals");
  app.add_option("--maps", options.Maps, "Files of the data folder, or embedded names");
  app.add_option("--materials", options.Materials, "Names of materials");
  app.add_option("--pixels", options.Pixels, "Of each picture");
  app.add_option("--samples", options.Samples, "Traced directions of each pixel, for a bounce");
  app.add_option("--rays", options.Rays, "From each point; 0: as the filter has it");
  app.add_option("--rounds", options.Rounds, "Of frames for times; 0: none");
  app.add_option("--pictures", options.Pictures, "Folder for pictures");
  CLI11_PARSE(app, argc, argv);
  using Names = std::vector<std::string>;
  const bool bounce = options.Bounce;
  const Names meshes = Choose(
    options.Meshes, bounce ? Names{ "gear", "isosurface", "knob", "molecule" }
                           : Names{ "bumps", "gear", "isosurface", "knob", "molecule", "torus" });
  const Names maps =
    Choose(options.Maps, bounce ? Names{ "city.exr", "interior.exr", "studio.exr" }
                                : Names{ "city.exr", "courtyard.exr", "interior.exr", "studio.exr",
                                    "sunset.exr", "pmndrs_sunrise.hdr" });
  const Names names = Choose(options.Materials,
    bounce
      ? Names{ "lambert", "grey", "orange", "blinn50", "satin_purple" }
      : Names{ "lambert", "blinn50", "blinn400", "cardboard", "satin_purple", "vch_ultra_pink" });
  std::vector<Map> environments;
  for (const std::string& name : maps)
  {
    if (auto environment = BenchmarkCase::FindEnvironment(name))
    {
      environments.push_back(MakeMap(name, environment));
    }
  }
  std::vector<Material> materials = MakeMaterials();
  const auto isLeftOut = [&names](const Material& material)
  { return std::find(names.begin(), names.end(), material.Name) == names.end(); };
  materials.erase(std::remove_if(materials.begin(), materials.end(), isLeftOut), materials.end());
  vtkObject::GlobalWarningDisplayOn(); // readers turn it off
  std::printf("mesh,points,trace s,bounce s,material,map,noise %%,off %%,ambient %%,black %%,"
              "bounce %%,frame off ms,frame black ms,frame bounce ms\n");
  Totals totals;
  for (const std::string& mesh : meshes)
  {
    Measure(mesh, materials, environments, options, totals);
  }
  for (const bool worst : { false, true })
  {
    std::printf(worst ? "worst,,,,,," : "mean,,,,,,");
    for (std::size_t k = 0; k < totals.Sums.size(); ++k)
    {
      std::printf(",%.2f", 100.0 * (worst ? totals.Worst[k] : totals.Sums[k] / totals.Count));
    }
    std::printf("\n");
  }
  std::printf("worse than %s,%d of %d\n", bounce ? "black" : "off", totals.Worse, totals.Count);
  return 0;
}
