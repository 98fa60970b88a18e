// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What surfaces hide from themselves: the error of drawing without it, with a factor of ambient
// occlusion, and with vtkSurfaceVisibilityFilter's arrays, against traced light (no bounce), over
// meshes x materials x maps; and the time of a frame. A line of CSV for each. Needs an OpenGL
// context. Errors are those of occlusion alone (OcclusionTruth.h).
#include "FloatWindow.h"
#include "OcclusionMeshes.h"
#include "OcclusionTruth.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkPolyData.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace occlusiontruth;

namespace
{
struct Errors
{
  double Off = 0.0, Ambient = 0.0, On = 0.0, All = 0.0;
};

Errors Compare(const std::vector<Pixel>& pixels, const std::vector<std::vector<glm::vec3>>& kernels,
  const Map& map, const FloatPicture& off, const FloatPicture& on)
{
  Errors errors;
  for (std::size_t k = 0; k < pixels.size(); ++k)
  {
    const Shares shares = GetShares(pixels[k], kernels[k], map);
    const glm::dvec3 drawn = off.Get(pixels[k].X, pixels[k].Y);
    const glm::dvec3 truth = drawn * shares.Visible;
    errors.All += Sum(truth);
    errors.Off += Sum(drawn - truth);
    errors.Ambient += Sum(drawn * shares.Open - truth);
    errors.On += Sum(on.Get(pixels[k].X, pixels[k].Y) - truth);
  }
  return errors;
}

}

int main(int argc, char** argv)
{
  std::vector<std::string> meshes = { "bumps", "gear", "isosurface", "knob", "molecule", "torus" };
  std::vector<std::string> maps = { "city.exr", "courtyard.exr", "interior.exr", "studio.exr",
    "sunset.exr", "pmndrs_sunrise.hdr" };
  int pixelCount = 300;
  int rounds = 0;
  int rays = 0;
  std::string pictures;
  std::vector<std::string> names;
  CLI::App app("The error of what surfaces hide from themselves.");
  app.add_option("--meshes", meshes, "Those of the default, or .vtp files with point normals");
  app.add_option("--maps", maps, "Files of the data folder, or embedded names");
  app.add_option("--materials", names, "Names of materials; none: all");
  app.add_option("--pixels", pixelCount, "Of each picture");
  app.add_option("--rays", rays, "From each point; 0: as the filter has it");
  app.add_option("--rounds", rounds, "Of frames for times; 0: none");
  app.add_option("--pictures", pictures, "Folder for pictures");
  CLI11_PARSE(app, argc, argv);

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
  { return !names.empty() && std::find(names.begin(), names.end(), material.Name) == names.end(); };
  materials.erase(std::remove_if(materials.begin(), materials.end(), isLeftOut), materials.end());
  vtkObject::GlobalWarningDisplayOn(); // readers turn it off
  std::printf("mesh,points,trace s,material,map,off %%,ambient %%,on %%,frame off ms,frame on "
              "ms\n");
  double sums[3] = { 0.0, 0.0, 0.0 };
  double worst[3] = { 0.0, 0.0, 0.0 };
  int worse = 0;
  int count = 0;
  for (const std::string& name : meshes)
  {
    const auto surface = MakeOcclusionMesh(name);
    vtkNew<vtkSurfaceVisibilityFilter> filter;
    filter->SetInputData(surface);
    if (rays > 0)
    {
      filter->SetNumberOfRays(rays);
    }
    const double before = GetSeconds();
    filter->Update();
    const double seconds = GetSeconds() - before;
    SurfaceTracer tracer;
    tracer.AddSurface(surface);
    tracer.Build();
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    mapper->SetInputConnection(filter->GetOutputPort());
    FloatWindow window(mapper, surface);
    std::vector<Pixel> pixels = FindPixels(surface, tracer, window, pixelCount);
    TracePixels(tracer, pixels);
    for (const Material& material : materials)
    {
      const auto kernels = MakeKernels(material.BRDF, pixels);
      for (const Map& map : environments)
      {
        vtkNew<vtkHybridRadianceIntegrator> integrator;
        integrator->SetLightAngle(LampDegrees);
        mapper->SetBRDF(material.BRDF);
        mapper->SetEnvironment(map.Environment);
        mapper->SetIntegrator(integrator);
        mapper->SetOcclusionModeToOff();
        const FloatPicture off = window.Render();
        mapper->SetOcclusionModeToAuto();
        const FloatPicture on = window.Render();
        const Errors errors = Compare(pixels, kernels, map, off, on);
        const double values[3] = { errors.Off / errors.All, errors.Ambient / errors.All,
          errors.On / errors.All };
        double frames[2] = { rounds > 0 ? HUGE_VAL : 0.0, rounds > 0 ? HUGE_VAL : 0.0 };
        for (int round = 0; round < 2 * rounds; ++round)
        {
          const int mode = round % 2;
          mapper->SetOcclusionMode(mode);
          window.Draw();
          const double start = GetSeconds();
          window.Draw();
          frames[mode] = std::min(frames[mode], GetSeconds() - start);
        }
        std::printf("%s,%lld,%.2f,%s,%s,%.2f,%.2f,%.2f,%.1f,%.1f\n", name.c_str(),
          static_cast<long long>(surface->GetNumberOfPoints()), seconds, material.Name.c_str(),
          map.Name.c_str(), 100.0 * values[0], 100.0 * values[1], 100.0 * values[2],
          1e3 * frames[0], 1e3 * frames[1]);
        std::fflush(stdout);
        if (!pictures.empty())
        {
          const std::string file = pictures + "/" + name + "-" + material.Name + "-" +
                                   map.Name.substr(0, map.Name.find('.'));
          off.Write(file + "-off.png");
          on.Write(file + "-on.png");
        }
        for (int k = 0; k < 3; ++k)
        {
          sums[k] += values[k];
          worst[k] = std::max(worst[k], values[k]);
        }
        worse += values[2] > values[0] ? 1 : 0;
        ++count;
      }
    }
  }
  std::printf("mean,,,,,%.2f,%.2f,%.2f\nworst,,,,,%.2f,%.2f,%.2f\nworse than off,%d of %d\n",
    100.0 * sums[0] / count, 100.0 * sums[1] / count, 100.0 * sums[2] / count, 100.0 * worst[0],
    100.0 * worst[1], 100.0 * worst[2], worse, count);
  return 0;
}
