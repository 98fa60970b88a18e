// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartMeter.h"

#include "ParetoFront.h"
#include "Progress.h"
#include "ReferencePicture.h"
#include "Scenes.h"
#include "Tool.h"
#include "TracedSurface.h"

#include "vtkBRDFModels.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

namespace
{
// What the parts of a pair's work take of it, about.
constexpr double ReferenceShare = 0.15;
constexpr double MethodShare = 0.6;
// Frames shorter than this get one before them that does not count: another window's came before.
constexpr double WarmUpBelow = 100.0;
// All frames of one point take about this long at most, in ms, but for the fewest; of one that
// takes as long by itself, the first one is the only one.
constexpr double FrameBudget = 500.0;
constexpr int FewestRounds = 3;
constexpr int StockFetches = 3; // of VTK's PBR: irradiance, filtered light, split sum

//------------------------------------------------------------------------------
// Of a pixel. The material's form is made only where lights need it.
int CountFetches(vtkRadianceIntegrator* integrator)
{
  vtkBRDFShaderInputs inputs;
  if (!integrator || !integrator->GetShaderInputs(inputs))
  {
    return 0;
  }
  vtkBRDFShaderInputs material;
  const bool haveLights = std::any_of(inputs.Terms.begin(), inputs.Terms.end(),
    [](const vtkBRDFShaderInputs::Term& term) { return term.Evaluations > 0; });
  if (haveLights)
  {
    auto* lights = vtkLightSetRadianceIntegrator::SafeDownCast(integrator);
    material.SoftLights = lights && lights->GetSoftLights();
    integrator->GetBRDF()->GetRenderable()->GetShaderInputs(material);
  }
  return inputs.CountFetches(material);
}

//------------------------------------------------------------------------------
double GetElapsed(std::chrono::steady_clock::time_point begin)
{
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
    .count();
}

//------------------------------------------------------------------------------
std::string FormatSeconds(double milliseconds)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.2g s", 1e-3 * milliseconds);
  return text;
}
}

namespace tool
{
//------------------------------------------------------------------------------
struct ChartMeter::Timed
{
  std::unique_ptr<OffscreenScene> Window;
  ChartJson Point;
  std::vector<double> Frames;
  double Expected = 0.0; // ms
  vtkSmartPointer<vtkRadiancePlanner> Planner;

  int GetRounds(int wanted) const
  {
    const int affordable = static_cast<int>(FrameBudget / std::max(this->Expected, 1e-3));
    return affordable > 0 ? std::min(wanted, std::max(affordable, FewestRounds)) : 0;
  }
};

//------------------------------------------------------------------------------
ChartMeter::ChartMeter(const ChartScene& scene, const std::vector<ChartSize>& sizes)
  : Scene(scene)
  , Sizes(sizes)
  , Visible(
      FindSurface(scene.Mesh, scene.Stage.View, ViewFill, scene.Stage.Size, scene.ReferencePixels))
{
}

//------------------------------------------------------------------------------
std::string ChartMeter::DescribePixels() const
{
  const std::string all = std::to_string(this->Visible.NumberOfCovered);
  return this->Visible.Stride == 1 ? "all " + all + " covered pixels"
                                   : std::to_string(this->Visible.Pixels.size()) + " of " + all +
                                       " covered pixels, on a grid";
}

//------------------------------------------------------------------------------
nlohmann::ordered_json ChartMeter::DescribeRenderer() const
{
  StockScene scene;
  this->Place(scene);
  return { { "renderer", scene.GetRendererName() },
    { "renderer_vendor", scene.GetCapability("OpenGL vendor string") },
    { "renderer_version", scene.GetCapability("OpenGL version string") } };
}

//------------------------------------------------------------------------------
std::string ChartMeter::GetFingerprint(const Material& material, vtkEnvironment* environment) const
{
  std::string bytes = vtkBRDFModels::GetContentKey(material.BRDF);
  const auto append = [&bytes](const auto& values)
  {
    bytes.append(
      reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values.front()));
  };
  append(environment->GetPixels());
  append(this->Visible.Normals);
  append(this->Visible.Views);
  char text[17];
  std::snprintf(text, sizeof(text), "%016zx", std::hash<std::string>()(bytes));
  return text;
}

//------------------------------------------------------------------------------
void ChartMeter::Place(OffscreenScene& stage) const
{
  this->Scene.Stage.Place(stage, this->Scene.Mesh);
  stage.Open(this->Scene.Stage.Size.Width, this->Scene.Stage.Size.Height);
}

//------------------------------------------------------------------------------
double ChartMeter::FillErrors(
  ChartJson& point, OffscreenScene& stage, const std::vector<double>& reference) const
{
  vtkNew<vtkRadianceMetrics> metrics;
  const auto begin = std::chrono::steady_clock::now();
  const Size& size = this->Scene.Stage.Size;
  const Picture picture = stage.Render(size.Width, size.Height);
  const double frame = GetElapsed(begin); // reading it back takes little
  const std::vector<double> rgb = Pick(picture, this->Visible);
  tool::Measure(metrics, Grid(this->Visible, size), rgb, reference);
  for (const Metric& metric : GetMetrics())
  {
    point["errors"][metric.Name] = metric.Get(metrics);
  }
  return frame;
}

//------------------------------------------------------------------------------
ChartMeter::Timed ChartMeter::Begin(const ChartSize& size, const Material& material,
  vtkEnvironment* environment, const std::vector<double>& reference, vtkRadiancePlanner* plan)
{
  Timed timed;
  auto scene = std::make_unique<tool::Scene>();
  scene->Mapper->SetOcclusionModeToOff(); // as the reference
  this->Place(*scene);
  Method method;
  const MethodOptions options = size.MakeOptions();
  const auto begin = std::chrono::steady_clock::now();
  if (plan)
  {
    method.BRDF = plan->GetBRDF();
    method.Integrator.TakeReference(plan->NewIntegrator(plan->GetInteractiveChoice()));
  }
  else
  {
    method = MakeMethod(options, material, environment);
  }
  scene->Begin(method, environment, options.Plan);
  timed.Point["setup_ms"] = GetElapsed(begin);
  timed.Planner = method.Planner;
  if (vtkRadiancePlanner* planner = plan ? plan : method.Planner.Get())
  {
    const int index = plan ? plan->GetInteractiveChoice() : planner->GetChoice();
    const double predicted = planner->GetPredictedError(index);
    timed.Point["predicted_error"] = predicted;
    timed.Point["predicted_picture_error"] = planner->GetPredictedPictureError(index);
    timed.Point["meets_tolerance"] =
      plan ? predicted <= options.Plan.Tolerance : planner->GetMeetsTolerance();
    timed.Point["plan"] = planner->GetPlan();
  }
  timed.Point["texture_bytes"] = scene->Mapper->GetTextureBytes();
  timed.Point["texture_fetches"] = CountFetches(method.Integrator);
  timed.Expected = this->FillErrors(timed.Point, *scene, reference);
  if (timed.GetRounds(FewestRounds) == 0)
  {
    timed.Frames.push_back(timed.Expected);
  }
  timed.Window = std::move(scene);
  return timed;
}

//------------------------------------------------------------------------------
ChartMeter::Timed ChartMeter::BeginStock(
  vtkEnvironment* environment, const std::vector<double>& reference)
{
  Timed timed;
  auto stock = std::make_unique<StockScene>();
  this->Place(*stock);
  const auto begin = std::chrono::steady_clock::now();
  stock->SetLight(environment);
  stock->SetMaterial(StockMaterial());
  stock->TimeFrame();
  timed.Point["setup_ms"] = GetElapsed(begin);
  stock->Fit(this->Visible, this->Scene.Stage.Size, reference);
  timed.Point["texture_bytes"] = stock->GetTextureBytes();
  timed.Point["texture_fetches"] = StockFetches;
  timed.Expected = this->FillErrors(timed.Point, *stock, reference);
  timed.Window = std::move(stock);
  return timed;
}

//------------------------------------------------------------------------------
void ChartMeter::TimeFrames(std::vector<Timed>& all, const std::function<void(double)>& show) const
{
  for (int round = 0; round < this->Scene.Rounds; ++round)
  {
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      // There and back: what changes slowly meets all alike.
      Timed& timed = all[round % 2 == 0 ? k : all.size() - 1 - k];
      Interruptible::Check();
      if (!timed.Window || round >= timed.GetRounds(this->Scene.Rounds))
      {
        continue;
      }
      if (timed.Expected < WarmUpBelow)
      {
        timed.Window->TimeFrame();
      }
      timed.Frames.push_back(timed.Window->TimeFrame());
    }
    show(ReferenceShare + MethodShare +
         (1.0 - ReferenceShare - MethodShare) * (round + 1.0) / this->Scene.Rounds);
  }
}

//------------------------------------------------------------------------------
ChartJson ChartMeter::Measure(
  const Material& material, vtkEnvironment* environment, const std::function<void(double)>& show)
{
  double load = -1.0;
  getloadavg(&load, 1); // of the last minute: what else was running
  const auto occlusion =
    PredictOcclusion(MakeTracedScene(this->Scene.Mesh), material.BRDF, environment);
  ChartJson pair = { { "material", material.Name }, { "environment", environment->GetName() },
    { "fingerprint", this->GetFingerprint(material, environment) },
    { "pixels", this->Visible.Pixels.size() }, { "load", load },
    { "unoccluded_error", occlusion->GetError() },
    { "unoccluded_uncertainty", occlusion->GetUncertainty() }, // two standard errors
    { "points", ChartJson::array() } };
  const std::vector<double> reference =
    DrawReference(material.BRDF, environment, this->Visible, this->Scene.Stage.Size).Radiance;
  show(ReferenceShare);

  std::vector<Timed> all;
  const auto add = [&](const ChartSize& size, const std::string& name, vtkRadiancePlanner* plan)
  {
    Timed timed;
    try
    {
      timed = size.Method->Name == PBRMethod
                ? this->BeginStock(environment, reference)
                : this->Begin(size, material, environment, reference, plan);
    }
    catch (const Error& error)
    {
      Interruptible::Check();
      timed.Point["left_out"] = error.what(); // a method need not suit every material
    }
    timed.Point["method"] = size.Method->Name;
    timed.Point["size"] = name;
    all.push_back(std::move(timed));
  };
  for (std::size_t k = 0; k < this->Sizes.size(); ++k)
  {
    Interruptible::Check();
    const ChartSize& size = this->Sizes[k];
    // What the size before leads to expect; sizes come smallest first.
    const bool follows = !all.empty() && all.back().Point["method"] == size.Method->Name &&
                         size.Method->Name != PlannerMethod;
    double expected = follows ? all.back().Expected : 0.0;
    if (follows && size.Method->Grows)
    {
      expected *= std::atof(size.Size.c_str()) / std::atof(this->Sizes[k - 1].Size.c_str());
    }
    if (expected > this->Scene.Slowest)
    {
      Timed timed;
      timed.Point = { { "method", size.Method->Name }, { "size", size.Size },
        { "left_out", "a frame would take about " + FormatSeconds(expected) } };
      timed.Expected = expected;
      all.push_back(std::move(timed));
    }
    else
    {
      add(size, size.Size, nullptr);
      const vtkSmartPointer<vtkRadiancePlanner> plan = all.back().Planner;
      if (plan && plan->GetInteractiveChoice() != plan->GetChoice())
      {
        add(size, size.Size + Interacting, plan);
      }
    }
    show(ReferenceShare + MethodShare * (k + 1.0) / static_cast<double>(this->Sizes.size()));
  }

  this->TimeFrames(all, show);
  for (Timed& timed : all)
  {
    const std::vector<double>& frames = timed.Frames;
    if (!frames.empty())
    {
      timed.Point["frame_ms"] = GetQuantile(frames, 0.5);
      timed.Point["frame_ms_quartiles"] = { GetQuantile(frames, 0.25), GetQuantile(frames, 0.75) };
      timed.Point["frames"] = frames.size();
    }
    pair["points"].push_back(timed.Point);
  }
  RatePair(pair);
  return pair;
}
} // namespace tool
