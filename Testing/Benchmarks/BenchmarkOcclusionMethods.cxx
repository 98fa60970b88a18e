// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What surfaces hide from themselves, drawn by several methods: the error of each against traced
// light (no bounce), and the processor time of a frame relative to one without occlusion, frames
// taken in turns. Meshes x materials x maps x methods, a line of CSV for each; --chart draws their
// means, of measurements or of lines that were written before (--from). Needs an OpenGL context.
//
// off            nothing is hidden
// ambient        a factor of ambient occlusion for each point, as scalars
// ssao RADIUS    vtkSSAOPass over the picture of "off", whose display values it multiplies; radius
//                over the mesh's diagonal
// ssao linear RADIUS   if it multiplied the radiance
// shadows N      vtkShadowMapPass: the N strongest cones of the map as lights, the rest without
//                shadows; or, N = 16, all of the map as lights
// on             vtkSurfaceVisibilityFilter's arrays
//
// Errors are those of occlusion alone (OcclusionTruth.h). A method that draws other light than
// "off" (ssao: of 8 bits; shadows: a few lights) therefore gives the share that it leaves of its
// own light: what it draws over what it draws without shadows, times the picture of "off".
#include "FloatWindow.h"
#include "HiddenSky.h"
#include "OcclusionMeshes.h"
#include "OcclusionMethodRows.h"
#include "OcclusionTruth.h"
#include "StrongLights.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLight.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkSSAOPass.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkShadowMapPass.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkUnsignedCharArray.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

using namespace occlusiontruth;
using measuredbrdf::HiddenSky;

namespace
{
constexpr int NumberOfStrongest[] = { 1, 4 };
constexpr int NumberOfAll = 16;
constexpr double Radii[] = { 0.025, 0.05, 0.1, 0.2 }; // of vtkSSAOPass, over the mesh's diagonal
constexpr double Bias = 0.001;                        // likewise
constexpr int ShadowResolution = 1024;

// A mapper in its window.
struct Stage
{
  explicit Stage(vtkPolyData* surface)
    : Window(this->Mapper, surface)
  {
    this->Mapper->SetInputData(surface);
    this->Mapper->SetOcclusionModeToOff();
  }

  void Show(vtkBRDF* brdf, vtkEnvironment* environment)
  {
    vtkNew<vtkHybridRadianceIntegrator> integrator;
    integrator->SetLightAngle(LampDegrees);
    this->Mapper->SetBRDF(brdf);
    this->Mapper->SetEnvironment(environment);
    this->Mapper->SetIntegrator(integrator);
  }

  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  FloatWindow Window;
};

// Two: with shadows and without.
struct ShadowStages
{
  ShadowStages(vtkPolyData* surface, const std::string& name)
    : Name(name)
    , Lit(surface)
    , Shadowed(surface)
  {
    vtkShadowMapBakerPass* baker = this->Shadows->GetShadowMapBakerPass();
    baker->SetResolution(ShadowResolution);
    this->Passes->AddItem(baker);
    this->Passes->AddItem(this->Shadows);
    this->Sequence->SetPasses(this->Passes);
    this->Shadowed.Window.SetScenePass(this->Sequence);
    surface->GetCenter(this->Center);
    this->Length = surface->GetLength();
  }

  void Show(vtkBRDF* brdf, const StrongLights& lights)
  {
    for (Stage* stage : { &this->Lit, &this->Shadowed })
    {
      stage->Show(brdf, lights.Rest);
      vtkRenderer* renderer = stage->Window.GetRenderer();
      renderer->RemoveAllLights();
      for (const StrongLights::Light& light : lights.Lights)
      {
        vtkNew<vtkLight> lamp;
        lamp->SetLightTypeToSceneLight();
        lamp->SetFocalPoint(this->Center);
        lamp->SetPosition(this->Center[0] + this->Length * light.Direction.x,
          this->Center[1] + this->Length * light.Direction.y,
          this->Center[2] + this->Length * light.Direction.z);
        lamp->SetDiffuseColor(light.Irradiance.x, light.Irradiance.y, light.Irradiance.z);
        renderer->AddLight(lamp);
      }
    }
  }

  std::string Name;
  Stage Lit, Shadowed;
  vtkNew<vtkShadowMapPass> Shadows;
  vtkNew<vtkRenderPassCollection> Passes;
  vtkNew<vtkSequencePass> Sequence;
  double Center[3], Length;
};

// The visible share of a white sky at each point, in the scalars.
vtkSmartPointer<vtkPolyData> MakeAmbient(vtkPolyData* traced)
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(traced);
  const auto get = [traced](const char* name)
  { return vtkUnsignedCharArray::SafeDownCast(traced->GetPointData()->GetArray(name)); };
  vtkUnsignedCharArray* sky = get(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName());
  vtkUnsignedCharArray* light = get(vtkSurfaceVisibilityFilter::GetHiddenLightArrayName());
  vtkNew<vtkUnsignedCharArray> shares;
  shares->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < traced->GetNumberOfPoints(); ++k)
  {
    HiddenSky::Code code;
    std::copy_n(sky->GetPointer(k * HiddenSky::SectorBytes), HiddenSky::SectorBytes, code.begin());
    std::copy_n(light->GetPointer(k * HiddenSky::TransferBytes), HiddenSky::TransferBytes,
      code.begin() + HiddenSky::SectorBytes);
    // Scalars are display values.
    const double open = 255.0 * std::pow(1.0 - HiddenSky(code).GetHiddenCosine(), 1.0 / 2.2);
    shares->InsertNextTuple3(open, open, open);
  }
  surface->GetPointData()->SetScalars(shares);
  return surface;
}

// What a pass leaves of a white picture, in its own display values, of each pixel.
std::vector<double> GetFactors(
  Stage& stage, vtkSSAOPass* pass, double radius, const std::vector<Pixel>& pixels)
{
  FloatPicture pictures[2];
  for (int k = 0; k < 2; ++k)
  {
    pass->SetRadius(k == 0 ? 1e-6 * radius : radius); // nothing is as near as that
    pictures[k] = stage.Window.Render();
  }
  std::vector<double> factors;
  for (const Pixel& pixel : pixels)
  {
    factors.push_back(pictures[1].Get(pixel.X, pixel.Y).x / pictures[0].Get(pixel.X, pixel.Y).x);
  }
  return factors;
}

struct Bench
{
  std::vector<Material> Materials;
  std::vector<Map> Maps;
  std::vector<std::vector<StrongLights>> Lights; // of each map, of each kind of shadows
  int NumberOfPixels = 200;
  int Rounds = 3;
  bool WithShadows = true;
  std::vector<OcclusionMethodRow> Rows;

  void Measure(const std::string& mesh);
};

// All methods on one mesh.
struct Stages
{
  Stages(vtkPolyData* surface, bool withShadows)
    : Filter(Trace(surface))
    , Plain(vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0)))
    , Ambient(MakeAmbient(vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0))))
    , Screen(surface)
  {
    this->SSAO->SetBias(Bias * surface->GetLength());
    this->SSAO->BlurOn();
    this->Screen.Window.SetImagePass(this->SSAO);
    for (const int count : { NumberOfStrongest[0], NumberOfStrongest[1], NumberOfAll })
    {
      if (!withShadows)
      {
        break;
      }
      this->Shadows.push_back(
        std::make_unique<ShadowStages>(surface, "shadows " + std::to_string(count)));
    }
  }

  static vtkSmartPointer<vtkSurfaceVisibilityFilter> Trace(vtkPolyData* surface)
  {
    auto filter = vtkSmartPointer<vtkSurfaceVisibilityFilter>::New();
    filter->SetInputData(surface);
    filter->Update();
    return filter;
  }

  vtkSmartPointer<vtkSurfaceVisibilityFilter> Filter;
  Stage Plain, Ambient, Screen;
  vtkNew<vtkSSAOPass> SSAO;
  std::vector<std::unique_ptr<ShadowStages>> Shadows;
};

// What a method draws at pixels.
struct Drawn
{
  std::string Method;
  std::vector<glm::dvec3> Radiance;
};

std::vector<glm::dvec3> Pick(const FloatPicture& picture, const std::vector<Pixel>& pixels)
{
  std::vector<glm::dvec3> radiance;
  for (const Pixel& pixel : pixels)
  {
    radiance.push_back(picture.Get(pixel.X, pixel.Y));
  }
  return radiance;
}

// All but SSAO's, "off" first.
std::vector<Drawn> DrawAll(Stages& stages, const std::vector<Pixel>& pixels)
{
  stages.Plain.Mapper->SetOcclusionModeToOff();
  std::vector<Drawn> all = { { "off", Pick(stages.Plain.Window.Render(), pixels) } };
  const std::vector<glm::dvec3> open = all.front().Radiance;
  stages.Plain.Mapper->SetOcclusionModeToAuto();
  all.push_back({ "on", Pick(stages.Plain.Window.Render(), pixels) });
  all.push_back({ "ambient", Pick(stages.Ambient.Window.Render(), pixels) });
  for (const auto& shadows : stages.Shadows)
  {
    const std::vector<glm::dvec3> lit = Pick(shadows->Lit.Window.Render(), pixels);
    Drawn drawn = { shadows->Name, Pick(shadows->Shadowed.Window.Render(), pixels) };
    for (std::size_t k = 0; k < lit.size(); ++k)
    {
      drawn.Radiance[k] =
        open[k] * glm::clamp(drawn.Radiance[k] / glm::max(lit[k], glm::dvec3(1e-9)), 0.0, 1.0);
    }
    all.push_back(drawn);
  }
  return all;
}

// Processor time of frames in turns, over that of the first, by method.
std::map<std::string, double> TimeFrames(Stages& stages, int rounds)
{
  struct Entry
  {
    std::string Method;
    Stage* Drawn;
    int Mode; // of occlusion
  };
  std::vector<Entry> entries = { { "off", &stages.Plain, 0 }, { "on", &stages.Plain, 1 },
    { "ambient", &stages.Ambient, 0 }, { "ssao", &stages.Screen, 0 } };
  for (const auto& shadows : stages.Shadows)
  {
    entries.push_back({ shadows->Name, &shadows->Shadowed, 0 });
  }
  std::map<std::string, double> least;
  for (int round = 0; round < rounds; ++round)
  {
    for (const Entry& entry : entries)
    {
      entry.Drawn->Mapper->SetOcclusionMode(entry.Mode);
      entry.Drawn->Window.Draw();
      const double start = GetSeconds();
      entry.Drawn->Window.Draw();
      entry.Drawn->Window.Draw();
      const double seconds = GetSeconds() - start;
      const auto found = least.emplace(entry.Method, seconds).first;
      found->second = std::min(found->second, seconds);
    }
  }
  std::map<std::string, double> ratios;
  for (const auto& [method, seconds] : least)
  {
    ratios[method] = seconds / least["off"];
  }
  return ratios;
}

void Bench::Measure(const std::string& mesh)
{
  const auto surface = MakeOcclusionMesh(mesh);
  SurfaceTracer tracer;
  tracer.AddSurface(surface);
  tracer.Build();
  Stages stages(surface, this->WithShadows);
  std::vector<Pixel> pixels =
    FindPixels(surface, tracer, stages.Plain.Window, this->NumberOfPixels);
  TracePixels(tracer, pixels);
  vtkNew<vtkLambertBRDF> matte;
  vtkNew<vtkEnvironment> white;
  white->SetPixels(2, 1, std::vector<float>(6, 0.9f));
  stages.Screen.Show(matte, white);
  std::map<std::string, std::vector<double>> factors;
  for (const double radius : Radii)
  {
    char name[32];
    std::snprintf(name, sizeof(name), "%g", radius);
    const std::vector<double> found =
      GetFactors(stages.Screen, stages.SSAO, radius * surface->GetLength(), pixels);
    factors["ssao " + std::string(name)] = found;
    for (const double factor : found)
    {
      factors["ssao linear " + std::string(name)].push_back(std::pow(factor, 1.0 / 2.2));
    }
  }
  for (const Material& material : this->Materials)
  {
    const auto kernels = MakeKernels(material.BRDF, pixels);
    for (std::size_t m = 0; m < this->Maps.size(); ++m)
    {
      const Map& map = this->Maps[m];
      for (Stage* stage : { &stages.Plain, &stages.Ambient, &stages.Screen })
      {
        stage->Show(material.BRDF, map.Environment);
      }
      for (std::size_t k = 0; k < stages.Shadows.size(); ++k)
      {
        stages.Shadows[k]->Show(material.BRDF, this->Lights[m][k]);
      }
      std::vector<Drawn> all = DrawAll(stages, pixels);
      std::vector<glm::dvec3> truth = all.front().Radiance;
      for (const auto& [name, values] : factors)
      {
        Drawn drawn = { name, all.front().Radiance };
        for (std::size_t k = 0; k < pixels.size(); ++k)
        {
          drawn.Radiance[k] *= values[k];
        }
        all.push_back(drawn);
      }
      double sum = 0.0;
      for (std::size_t k = 0; k < pixels.size(); ++k)
      {
        truth[k] *= GetShares(pixels[k], kernels[k], map).Visible;
        sum += Sum(truth[k]);
      }
      std::map<std::string, double> frames = TimeFrames(stages, this->Rounds);
      for (const Drawn& drawn : all)
      {
        double difference = 0.0;
        for (std::size_t k = 0; k < pixels.size(); ++k)
        {
          difference += Sum(drawn.Radiance[k] - truth[k]);
        }
        const bool isScreen = drawn.Method.rfind("ssao", 0) == 0;
        this->Rows.push_back({ mesh, material.Name, map.Name, drawn.Method, difference / sum,
          frames[isScreen ? "ssao" : drawn.Method] });
        this->Rows.back().Print();
      }
    }
  }
}
}

int main(int argc, char** argv)
{
  std::vector<std::string> meshes = { "bumps", "gear", "isosurface", "knob", "molecule", "torus" };
  std::vector<std::string> maps = { "city.exr", "courtyard.exr", "interior.exr", "studio.exr",
    "sunset.exr", "pmndrs_sunrise.hdr" };
  std::vector<std::string> materials;
  std::string from;
  std::string chart;
  Bench bench;
  CLI::App app("What surfaces hide from themselves, by several methods.");
  app.add_option("--meshes", meshes, "Those of the default, or .vtp files with point normals");
  app.add_option("--materials", materials, "Some of the six");
  app.add_option("--maps", maps, "Files of the data folder, or embedded names");
  app.add_option("--pixels", bench.NumberOfPixels, "Of each picture");
  app.add_option("--rounds", bench.Rounds, "Of frames for times");
  app.add_flag("!--no-shadows", bench.WithShadows, "Leave out shadow maps, which take most time");
  app.add_option("--from", from, "A file with lines that were written before: nothing is measured");
  app.add_option("--chart", chart, "Chart to draw: this name with .png and .svg");
  CLI11_PARSE(app, argc, argv);

  if (!from.empty())
  {
    bench.Rows = ReadOcclusionMethodRows(from);
  }
  else
  {
    for (const std::string& name : maps)
    {
      if (auto environment = BenchmarkCase::FindEnvironment(name))
      {
        bench.Maps.push_back(MakeMap(name, environment));
        bench.Lights.push_back({ stronglights::TakeStrongest(environment, NumberOfStrongest[0]),
          stronglights::TakeStrongest(environment, NumberOfStrongest[1]),
          stronglights::TakeAll(environment, NumberOfAll) });
      }
    }
    for (const Material& material : MakeMaterials())
    {
      if (materials.empty() ||
          std::find(materials.begin(), materials.end(), material.Name) != materials.end())
      {
        bench.Materials.push_back(material);
      }
    }
    vtkObject::GlobalWarningDisplayOn(); // readers turn it off
    OcclusionMethodRow::PrintHeading();
    for (const std::string& mesh : meshes)
    {
      bench.Measure(mesh);
    }
  }
  const std::vector<OcclusionMethodMean> means = GetOcclusionMethodMeans(bench.Rows);
  PrintOcclusionMethodMeans(means);
  if (!chart.empty())
  {
    DrawOcclusionMethods(means, chart);
  }
  return 0;
}
