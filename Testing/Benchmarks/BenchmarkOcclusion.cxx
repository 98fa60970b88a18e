// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What surfaces hide from themselves: the error of drawing without it, with a factor of ambient
// occlusion, and with vtkSurfaceVisibilityFilter's arrays, against traced light (no bounce), over
// meshes x materials x maps; and the time of a frame. A line of CSV for each. Needs an OpenGL
// context. Errors are those of occlusion alone: each pixel's truth is what the mapper draws without
// occlusion, times the share of its light that 9,000 traced directions find visible.
#include "BenchmarkCase.h"
#include "FloatWindow.h"
#include "OcclusionMeshes.h"
#include "SurfaceTracer.h"
#include "vtkActor.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCamera.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int Rows = 96; // of the grid of directions: equal areas
constexpr int Columns = 2 * Rows;
constexpr double LampDegrees = 1.2; // as planners have it
const double Far = std::numeric_limits<double>::infinity();

// Cell of equal area about y.
glm::dvec3 GetDirection(int cell)
{
  const double y = 1.0 - 2.0 * (cell / Columns + 0.5) / Rows;
  const double azimuth = 2.0 * Pi * (cell % Columns + 0.5) / Columns;
  const double s = std::sqrt(1.0 - y * y);
  return { s * std::cos(azimuth), y, s * std::sin(azimuth) };
}

int FindCell(const glm::dvec3& d)
{
  const int row = std::min(static_cast<int>((1.0 - d.y) * 0.5 * Rows), Rows - 1);
  const double turn = std::atan2(d.z, d.x) / (2.0 * Pi);
  return row * Columns +
         std::min(static_cast<int>((turn < 0.0 ? turn + 1.0 : turn) * Columns), Columns - 1);
}

struct Pixel
{
  int X, Y;
  glm::dvec3 Point, Origin, Normal, View;
  std::vector<char> Visible; // of cells above the horizon
};

// A map as cells' means and lamps.
struct Map
{
  std::string Name;
  vtkSmartPointer<vtkEnvironment> Environment;
  std::vector<glm::dvec3> Cells;
};

// Means of the texels in each cell. Lamps stay in their cells: all directions of such a cell are
// taken as its middle, but what is hidden of it is found by several rays.
Map MakeMap(const std::string& name, vtkEnvironment* environment)
{
  Map map = { name, environment, std::vector<glm::dvec3>(Rows * Columns, glm::dvec3(0.0)) };
  std::vector<double> areas(map.Cells.size(), 0.0);
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      glm::dvec3 d, radiance;
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, &d.x);
      environment->GetRadiance(&d.x, &radiance.x);
      const double area = std::sqrt(std::max(1.0 - d.y * d.y, 0.0));
      const auto cell = static_cast<std::size_t>(FindCell(d));
      map.Cells[cell] += area * glm::max(radiance, glm::dvec3(0.0));
      areas[cell] += area;
    }
  }
  for (std::size_t k = 0; k < areas.size(); ++k)
  {
    map.Cells[k] /= std::max(areas[k], 1e-12);
  }
  return map;
}

double Sum(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

std::vector<Pixel> FindPixels(
  vtkPolyData* surface, const SurfaceTracer& tracer, FloatWindow& window, int count)
{
  std::vector<Pixel> pixels;
  std::mt19937 generator(7);
  std::uniform_int_distribution<int> place(0, window.GetSize() - 1);
  for (int tries = 0; tries < 100 * count && static_cast<int>(pixels.size()) < count; ++tries)
  {
    Pixel pixel;
    pixel.X = place(generator);
    pixel.Y = place(generator);
    glm::dvec3 eye, direction;
    window.GetRay(pixel.X, pixel.Y, &eye.x, &direction.x);
    SurfaceTracer::Hit hit;
    if (!tracer.Intersect(&eye.x, &direction.x, 0.0, Far, hit))
    {
      continue;
    }
    pixel.Point = eye + hit.T * direction;
    pixel.View = -glm::normalize(direction);
    pixel.Normal = glm::dvec3(0.0);
    for (int k = 0; k < 3; ++k)
    {
      glm::dvec3 normal;
      surface->GetPointData()->GetNormals()->GetTuple(hit.Points[k], &normal.x);
      pixel.Normal += hit.Barycentrics[k] * normal;
    }
    pixel.Normal = glm::normalize(pixel.Normal);
    glm::dvec3 face = glm::make_vec3(hit.Normal);
    face *= glm::dot(face, pixel.View) < 0.0 ? -1.0 : 1.0;
    if (glm::dot(pixel.Normal, pixel.View) > 0.05) // false for NaN, of triangles without area
    {
      tracer.OffsetOrigin(&pixel.Point.x, &face.x, &face.x, &pixel.Origin.x);
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

void TracePixels(const SurfaceTracer& tracer, std::vector<Pixel>& pixels)
{
  for (Pixel& pixel : pixels)
  {
    pixel.Visible.assign(Rows * Columns, 0);
    for (int cell = 0; cell < Rows * Columns; ++cell)
    {
      const glm::dvec3 d = GetDirection(cell);
      pixel.Visible[static_cast<std::size_t>(cell)] =
        glm::dot(d, pixel.Normal) > 0.0 && !tracer.IsOccluded(&pixel.Origin.x, &d.x, 0.0, Far);
    }
  }
}

struct Material
{
  std::string Name;
  vtkSmartPointer<vtkBRDF> BRDF;
};

std::vector<Material> MakeMaterials()
{
  std::vector<Material> materials;
  vtkNew<vtkLambertBRDF> matte;
  materials.push_back({ "lambert", matte });
  for (const double exponent : { 50.0, 400.0 })
  {
    vtkNew<vtkBlinnPhongBRDF> gloss;
    gloss->SetSpecular(0.5, 0.5, 0.5);
    gloss->SetExponent(exponent);
    materials.push_back({ "blinn" + std::to_string(static_cast<int>(exponent)), gloss });
  }
  for (const char* name : { "cardboard", "satin_purple", "vch_ultra_pink" })
  {
    if (auto brdf = BenchmarkCase::FindBRDF(std::string("rgl/") + name + "_rgb.bsdf"))
    {
      materials.push_back({ name, brdf });
    }
  }
  return materials;
}

// Kernels f cos over the grid, of each pixel.
std::vector<std::vector<glm::vec3>> MakeKernels(vtkBRDF* brdf, const std::vector<Pixel>& pixels)
{
  brdf->Prepare();
  std::vector<std::vector<glm::vec3>> kernels;
  for (const Pixel& pixel : pixels)
  {
    const double s = std::copysign(1.0, pixel.Normal.z);
    const double a = -1.0 / (s + pixel.Normal.z);
    const double b = pixel.Normal.x * pixel.Normal.y * a;
    const glm::dmat3 frame(
      { 1.0 + s * pixel.Normal.x * pixel.Normal.x * a, s * b, -s * pixel.Normal.x },
      { b, s + pixel.Normal.y * pixel.Normal.y * a, -pixel.Normal.y }, pixel.Normal);
    const glm::dvec3 o = glm::transpose(frame) * pixel.View;
    std::vector<glm::vec3> kernel(Rows * Columns, glm::vec3(0.0f));
    for (int cell = 0; cell < Rows * Columns; ++cell)
    {
      const glm::dvec3 i = glm::transpose(frame) * GetDirection(cell);
      if (i.z > 0.0)
      {
        double f[3];
        brdf->Evaluate(&i.x, &o.x, f);
        kernel[static_cast<std::size_t>(cell)] = glm::vec3(glm::make_vec3(f) * i.z);
      }
    }
    kernels.push_back(std::move(kernel));
  }
  return kernels;
}

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
    glm::dvec3 all(0.0);
    glm::dvec3 seen(0.0);
    double cosine = 0.0;
    double open = 0.0;
    for (std::size_t cell = 0; cell < map.Cells.size(); ++cell)
    {
      const glm::dvec3 light = glm::dvec3(kernels[k][cell]) * map.Cells[cell];
      const double z = glm::dot(GetDirection(static_cast<int>(cell)), pixels[k].Normal);
      all += light;
      cosine += std::max(z, 0.0);
      if (pixels[k].Visible[cell])
      {
        seen += light;
        open += std::max(z, 0.0);
      }
    }
    const glm::dvec3 drawn = off.Get(pixels[k].X, pixels[k].Y);
    const glm::dvec3 truth = drawn * seen / glm::max(all, glm::dvec3(1e-12));
    errors.All += Sum(truth);
    errors.Off += Sum(drawn - truth);
    errors.Ambient += Sum(drawn * (open / cosine) - truth);
    errors.On += Sum(on.Get(pixels[k].X, pixels[k].Y) - truth);
  }
  return errors;
}

// Processor time of this program, of all its threads.
double GetSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
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
  CLI::App app("The error of what surfaces hide from themselves.");
  app.add_option("--meshes", meshes, "Those of the default, or .vtp files with point normals");
  app.add_option("--maps", maps, "Files of the data folder, or embedded names");
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
  const std::vector<Material> materials = MakeMaterials();
  vtkObject::GlobalWarningDisplayOn(); // readers turn it off
  std::printf(
    "mesh,points,trace s,material,map,off %%,ambient %%,on %%,frame off ms,frame on ms\n");
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
        double frames[2] = { 0.0, 0.0 };
        for (int mode = 0; rounds > 0 && mode < 2; ++mode)
        {
          frames[mode] = HUGE_VAL;
        }
        for (int round = 0; round < 2 * rounds; ++round)
        {
          mapper->SetOcclusionMode(round % 2);
          window.Draw();
          const double start = GetSeconds();
          window.Draw();
          window.Draw();
          frames[round % 2] = std::min(frames[round % 2], 0.5 * (GetSeconds() - start));
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
