// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What surfaces hide from themselves sends light back: the error of drawing it black, and with one
// bounce (SetOcclusionBounce), against traced light with one bounce; and the time of a frame.
// Meshes x materials x maps, a line of CSV for each. Needs an OpenGL context.
//
// The truth of a pixel is what the mapper draws without occlusion, times the visible share of its
// light (OcclusionTruth.h), plus what vtkTracedRadianceIntegrator finds with a bounce and not
// without, from the same samples: errors are those of occlusion alone. Two seeds tell its noise.
//
// --forms: how far other ways to keep the bounce would come, each put in place of the traced one,
// with the exact hidden share of each pixel's lobe:
// mean   no bytes a point: the mesh's mean radiance in each of 128 directions, made of the arrays
// mean, met   the same, of the points that hide something in that direction
// 4, 9, 25    harmonics of the light at each pixel, of many rays
#include "FloatWindow.h"
#include "HiddenSky.h"
#include "OcclusionMeshes.h"
#include "OcclusionTruth.h"
#include "SkyHarmonics.h"
#include "vtkDoubleArray.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTracedRadianceIntegrator.h"
#include "vtkTracedScene.h"
#include "vtkUnsignedCharArray.h"

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
constexpr double CellArea = 4.0 * Pi / (Rows * Columns);
const char* const FormNames[] = { "mean", "mean, met", "4", "9", "25" };
constexpr std::size_t Forms = 5;

sky::Colors GetHarmonics(const Map& map)
{
  sky::Colors light;
  light.fill(glm::dvec3(0.0));
  for (int cell = 0; cell < Rows * Columns; ++cell)
  {
    const sky::Values values = sky::Evaluate(GetDirection(cell));
    for (std::size_t j = 0; j < light.size(); ++j)
    {
      light[j] += values[j] * CellArea * map.Cells[static_cast<std::size_t>(cell)];
    }
  }
  return light;
}

glm::dvec3 Dot(const sky::Values& transfer, const sky::Colors& light, std::size_t count)
{
  glm::dvec3 sum(0.0);
  for (std::size_t j = 0; j < count; ++j)
  {
    sum += transfer[j] * light[j];
  }
  return sum;
}

// The points of both sides of a traced surface, and what each sees of the light.
struct Points
{
  std::vector<HiddenSky> Skies[2];
  std::vector<sky::Values> Visible[2];

  explicit Points(vtkPolyData* traced)
  {
    for (int side = 0; side < 2; ++side)
    {
      const std::string suffix = side == 0 ? "" : "Back";
      const auto get = [&](const char* name)
      {
        return vtkUnsignedCharArray::SafeDownCast(
          traced->GetPointData()->GetArray((name + suffix).c_str()));
      };
      vtkUnsignedCharArray* sky = get(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName());
      vtkUnsignedCharArray* light = get(vtkSurfaceVisibilityFilter::GetHiddenLightArrayName());
      for (vtkIdType k = 0; k < traced->GetNumberOfPoints(); ++k)
      {
        HiddenSky::Code code;
        std::copy_n(
          sky->GetPointer(k * HiddenSky::SectorBytes), HiddenSky::SectorBytes, code.begin());
        std::copy_n(light->GetPointer(k * HiddenSky::TransferBytes), HiddenSky::TransferBytes,
          code.begin() + HiddenSky::SectorBytes);
        this->Skies[side].emplace_back(code);
        sky::Values visible = sky::GetCosineTransfer(this->Skies[side].back().GetNormal());
        for (std::size_t j = 0; j < visible.size(); ++j)
        {
          visible[j] -=
            (code[HiddenSky::SectorBytes + j] - HiddenSky::OpenTransfer) * HiddenSky::TransferStep;
        }
        this->Visible[side].push_back(visible);
      }
    }
  }
};

// Mean irradiance (of transfers) of what turns towards a ray in each of some directions.
struct MeanSurface
{
  static constexpr int Count = 128;
  std::vector<glm::dvec3> Directions;
  std::vector<sky::Values> Means[2]; // of all points; of those that hide something there

  MeanSurface(vtkPolyData* surface, const Points& points)
  {
    const std::vector<double> areas = GetAreas(surface);
    for (int k = 0; k < Count; ++k)
    {
      const double z = 1.0 - 2.0 * (k + 0.5) / Count;
      const double turn = 2.399963229728653 * k;
      const double s = std::sqrt(1.0 - z * z);
      this->Directions.emplace_back(s * std::cos(turn), s * std::sin(turn), z);
      for (int kind = 0; kind < 2; ++kind)
      {
        this->Means[kind].push_back(
          this->GetMean(points, areas, this->Directions.back(), kind == 1));
      }
    }
  }

  // Radiance times pi over albedo, as harmonics of the direction.
  sky::Colors GetHarmonics(const sky::Colors& light, int kind) const
  {
    sky::Colors result;
    result.fill(glm::dvec3(0.0));
    for (std::size_t k = 0; k < this->Directions.size(); ++k)
    {
      const glm::dvec3 value =
        glm::max(Dot(this->Means[kind][k], light, sky::Harmonics), glm::dvec3(0.0));
      const sky::Values values = sky::Evaluate(this->Directions[k]);
      for (std::size_t j = 0; j < result.size(); ++j)
      {
        result[j] += values[j] * value * (4.0 * Pi / Count);
      }
    }
    return result;
  }

private:
  static std::vector<double> GetAreas(vtkPolyData* surface)
  {
    std::vector<double> areas(static_cast<std::size_t>(surface->GetNumberOfPoints()), 0.0);
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    for (vtkIdType cell = 0; cell < surface->GetNumberOfPolys(); ++cell)
    {
      surface->GetPolys()->GetCellAtId(cell, count, ids);
      glm::dvec3 p[3];
      for (int k = 0; k < 3; ++k)
      {
        surface->GetPoint(ids[k], &p[k].x);
      }
      for (int k = 0; k < 3; ++k)
      {
        areas[static_cast<std::size_t>(ids[k])] +=
          glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 6.0;
      }
    }
    return areas;
  }

  sky::Values GetMean(const Points& points, const std::vector<double>& areas,
    const glm::dvec3& direction, bool met) const
  {
    sky::Values sum{};
    double all = 1e-12;
    for (std::size_t k = 0; k < areas.size(); k += areas.size() / 3000 + 1)
    {
      for (int side = 0; side < 2; ++side)
      {
        const HiddenSky& sky = points.Skies[side][k];
        const double cosine = -glm::dot(sky.GetNormal(), direction);
        if (cosine > 0.0 && sky.GetHiddenCosine() < 0.995) // the inside sees nothing
        {
          const double weight =
            areas[k] * cosine * (met ? 0.01 + 1.0 - sky.GetVisibleLamp(-direction) : 1.0);
          all += weight;
          for (std::size_t j = 0; j < sum.size(); ++j)
          {
            sum[j] += weight * points.Visible[side][k][j];
          }
        }
      }
    }
    for (double& value : sum)
    {
      value /= all;
    }
    return sum;
  }
};

// Of a pixel: hidden cosines as harmonics of the direction, and the mean of what is met there.
struct HiddenPart
{
  double Cosine = 1e-9; // integral
  sky::Values Direction{};
  sky::Values Met{};

  HiddenPart(const Pixel& pixel, const SurfaceTracer& tracer, const Points& points)
  {
    for (int cell = 0; cell < Rows * Columns; ++cell)
    {
      const glm::dvec3 d = GetDirection(cell);
      const double weight = glm::dot(d, pixel.Normal) * CellArea;
      if (weight <= 0.0 || pixel.Visible[static_cast<std::size_t>(cell)])
      {
        continue;
      }
      this->Cosine += weight;
      const sky::Values values = sky::Evaluate(d);
      for (std::size_t j = 0; j < values.size(); ++j)
      {
        this->Direction[j] += weight * values[j];
      }
      SurfaceTracer::Hit hit;
      if (cell % 4 == 0 && tracer.Intersect(&pixel.Origin.x, &d.x, 0.0, Far, hit))
      {
        for (int k = 0; k < 3; ++k)
        {
          const auto point = static_cast<std::size_t>(hit.Points[k]);
          const int side = glm::dot(points.Skies[0][point].GetNormal(), d) > 0.0 ? 1 : 0;
          for (std::size_t j = 0; j < values.size(); ++j)
          {
            this->Met[j] += 4.0 * weight * hit.Barycentrics[k] * points.Visible[side][point][j];
          }
        }
      }
    }
  }
};

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

// Hemispherical albedo.
glm::dvec3 GetAlbedo(vtkBRDF* brdf)
{
  constexpr int views = 64;
  constexpr int step = 7; // of cells
  glm::dvec3 sum(0.0);
  for (int k = 0; k < views; ++k)
  {
    const double u = (k + 0.5) / views; // by cosines
    const glm::dvec3 o(std::sqrt(1.0 - u), 0.0, std::sqrt(u));
    for (int cell = 0; cell < Rows * Columns; cell += step)
    {
      const glm::dvec3 i = GetDirection(cell);
      glm::dvec3 f(0.0);
      if (i.z > 0.0)
      {
        brdf->Evaluate(&i.x, &o.x, &f.x);
      }
      sum += f * i.z * (CellArea * step / views);
    }
  }
  return sum;
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
  bool WithForms = false;
  std::string Pictures;

  // Sums over pictures: black, bounce, forms.
  std::array<double, 2 + Forms> Sums{};
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
  std::vector<HiddenPart> parts;
  std::vector<MeanSurface> means;
  if (this->WithForms)
  {
    const Points points(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0)));
    means.emplace_back(surface, points);
    for (const Pixel& pixel : pixels)
    {
      parts.emplace_back(pixel, tracer, points);
    }
  }
  for (const Material& material : this->Materials)
  {
    const auto kernels = MakeKernels(material.BRDF, pixels);
    const glm::dvec3 albedo = GetAlbedo(material.BRDF);
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
      const sky::Colors light = GetHarmonics(map);
      std::array<double, 2 + Forms> errors{};
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
        if (!this->WithForms)
        {
          continue;
        }
        glm::dvec3 hidden(0.0); // albedo of the hidden directions
        for (std::size_t cell = 0; cell < kernels[k].size(); ++cell)
        {
          hidden +=
            pixels[k].Visible[cell] ? glm::dvec3(0.0) : CellArea * glm::dvec3(kernels[k][cell]);
        }
        const HiddenPart& part = parts[k];
        const glm::dvec3 irradiances[Forms] = { Dot(part.Direction, means[0].GetHarmonics(light, 0),
                                                  sky::Harmonics),
          Dot(part.Direction, means[0].GetHarmonics(light, 1), sky::Harmonics),
          Dot(part.Met, light, 4), Dot(part.Met, light, 9), Dot(part.Met, light, 25) };
        for (std::size_t form = 0; form < Forms; ++form)
        {
          const glm::dvec3 mean = glm::max(irradiances[form], glm::dvec3(0.0)) / part.Cosine;
          errors[2 + form] += Sum(hidden * albedo / Pi * mean - bounce.Radiance[k]);
        }
      }
      std::printf("%s,%lld,%.2f,%.2f,%s,%s,%.2f,%.2f,%.2f,%.1f,%.1f,%.1f", mesh.c_str(),
        static_cast<long long>(surface->GetNumberOfPoints()), traced - begun, bounced - traced,
        material.Name.c_str(), map.Name.c_str(), 100.0 * bounce.Noise / all,
        100.0 * errors[0] / all, 100.0 * errors[1] / all, 1e3 * drawn.Frames[0],
        1e3 * drawn.Frames[1], 1e3 * drawn.Frames[2]);
      for (std::size_t form = 0; this->WithForms && form < Forms; ++form)
      {
        std::printf(",%.2f", 100.0 * errors[2 + form] / all);
      }
      std::printf("\n");
      std::fflush(stdout);
      for (std::size_t k = 0; k < errors.size(); ++k)
      {
        this->Sums[k] += errors[k] / all;
      }
      for (std::size_t k = 0; k < 2; ++k)
      {
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
  app.add_flag("--forms", bench.WithForms, "Other ways to keep the bounce, too");
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
              "frame black ms,frame bounce ms");
  for (std::size_t form = 0; bench.WithForms && form < Forms; ++form)
  {
    std::printf(",%s %%", FormNames[form]);
  }
  std::printf("\n");
  for (const std::string& mesh : meshes)
  {
    bench.Measure(mesh);
  }
  std::printf("mean");
  for (std::size_t k = 0; k < (bench.WithForms ? bench.Sums.size() : 2); ++k)
  {
    std::printf(",%.2f", 100.0 * bench.Sums[k] / bench.Count);
  }
  std::printf("\nworst,%.2f,%.2f\nworse than black,%d of %d\n", 100.0 * bench.Worst[0],
    100.0 * bench.Worst[1], bench.Worse, bench.Count);
  return 0;
}
