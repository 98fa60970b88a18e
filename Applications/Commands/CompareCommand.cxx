// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FailureMap.h"
#include "Files.h"
#include "Inputs.h"
#include "JsonReport.h"
#include "Measuring.h"
#include "Methods.h"
#include "Options.h"
#include "ParetoFront.h"
#include "Progress.h"
#include "ReferencePicture.h"
#include "Scenes.h"
#include "Sheets.h"
#include "Surface.h"
#include "Tool.h"
#include "TracedSurface.h"

#include "vtkBRDFFailureMap.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"
#include "vtkRadianceMetrics.h"
#include "vtkVersion.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>

namespace
{
struct CompareOptions
{
  std::string File;
  tool::Stage Stage;
  int ReferencePixels = 0; // as many as GetReferencePixels says
  std::string Output;
  std::string Strip;
  std::string Report;
  std::string Fit;
  std::string FailureMap;
  tool::MethodOptions Method;
  tool::TraceOptions Trace;
  bool Occlusion = false;
};

// Frames that frame_ms is the median of, and those before that are not counted. There are fewer
// where they take longer than this in all, in ms.
constexpr int NumberOfFrames = 21;
constexpr int WarmUp = 3;
constexpr double MeasuringBudget = 2000.0;
constexpr int LargestComparedPicture = 4096;
constexpr int TracedPixels = 4096; // by default: rays take a millisecond of a core for each

/// A shading and what was found of it.
struct Shading : tool::ComparedPicture
{
  explicit Shading(const std::string& name) { this->Name = name; }

  vtkNew<vtkRadianceMetrics> Metrics;
  double SetupCpu = 0.0; // of all threads, system calls included

  void TimeSetUp(const std::function<void()>& run)
  {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t cpuBegin = std::clock();
    run();
    const std::chrono::duration<double, std::milli> passed =
      std::chrono::steady_clock::now() - begin;
    this->Setup = passed.count();
    this->SetupCpu = 1e3 * static_cast<double>(std::clock() - cpuBegin) / CLOCKS_PER_SEC;
  }

  void Compare(tool::OffscreenScene& scene, const tool::Grid& grid, const tool::Size& size,
    const std::vector<double>& reference)
  {
    this->Drawn = scene.Render(size.Width, size.Height);
    tool::Measure(this->Metrics, grid, tool::Pick(this->Drawn, grid.Surface), reference);
    this->RelativeL1 = this->Metrics->GetRelativeL1();
  }

  std::string GetSummary() const
  {
    return this->Name + ": relative L1 " + tool::FormatPercent(this->RelativeL1) +
           ", 95 % of the pixels within " + tool::FormatPercent(this->Metrics->GetPercentile95()) +
           ", 99 % within " + tool::FormatPercent(this->Metrics->GetPercentile99()) + ", FLIP " +
           tool::FormatNumber(std::round(1e4 * this->Metrics->GetFLIP()) / 1e4) + "; frame " +
           tool::FormatMilliseconds(this->Frame) + ", set-up " +
           tool::FormatMilliseconds(this->Setup) + "\n";
  }
};

/// All that is compared.
struct Comparison
{
  explicit Comparison(const CompareOptions& options)
    : Options(options)
    , Shaded(options.Method.Method)
    , Stock("VTK's PBR")
  {
  }

  const CompareOptions& Options;
  std::string Title;
  vtkSmartPointer<vtkEnvironment> Environment;
  tool::Scene Scene;
  tool::StockScene StockScene;
  Shading Shaded;
  Shading Stock;
  tool::Method Method;
  tool::StockMaterial StockMaterial;
  std::size_t NumberOfFrames = 0;
  tool::Surface Surface;
  vtkSmartPointer<vtkOcclusionPredictor> Predicted; // what the mesh hides
  tool::TracedSurface Traced;                       // with --occlusion
  std::vector<double> Reference;
};

//------------------------------------------------------------------------------
nlohmann::ordered_json MakeReport(Comparison& found)
{
  nlohmann::ordered_json report = { { "method", found.Shaded.Name } };
  for (const tool::Metric& metric : tool::GetMetrics())
  {
    report[metric.Name] = metric.Get(found.Shaded.Metrics);
  }
  const tool::StockMaterial& stock = found.StockMaterial;
  report.update({ { "frame_ms", found.Shaded.Frame }, { "pbr_frame_ms", found.Stock.Frame },
    { "pbr_relative_l1", found.Stock.RelativeL1 }, { "setup_ms", found.Shaded.Setup },
    { "setup_cpu_ms", found.Shaded.SetupCpu }, { "pbr_setup_ms", found.Stock.Setup },
    { "pbr_setup_cpu_ms", found.Stock.SetupCpu }, { "pbr_flip", found.Stock.Metrics->GetFLIP() },
    { "pbr_material", { { "roughness", stock.Roughness }, { "metallic", stock.Metallic },
                        { "albedo", stock.Albedo } } },
    { "frames", found.NumberOfFrames }, { "vtk", vtkVersion::GetVTKVersion() },
    { "lights", found.Method.GetNumberOfLights() },
    { "texture_bytes", found.Scene.Mapper->GetTextureBytes() }, { "predicted_error", nullptr } });
  if (vtkRadiancePlanner* planner = found.Method.Planner)
  {
    report["predicted_error"] = planner->GetPredictedError(planner->GetChoice());
    report["predicted_picture_error"] = planner->GetPredictedPictureError(planner->GetChoice());
    report["tolerance"] = found.Options.Method.Plan.Tolerance;
    report["meets_tolerance"] = planner->GetMeetsTolerance();
    report["plan"] = planner->GetPlan();
  }
  return report;
}

//------------------------------------------------------------------------------
// What is evaluated in place of the material: the form on the GPU where the method has one.
vtkBRDF* GetShaded(const tool::Method& method)
{
  return method.Integrator->UsesBRDFOnGPU() ? method.BRDF->GetRenderable() : method.BRDF.Get();
}

//------------------------------------------------------------------------------
// The picture of the angles at which the method fails, and what the report says of them.
void WriteFailures(const Comparison& found, vtkBRDF* reference, nlohmann::ordered_json& report)
{
  vtkBRDF* shaded = GetShaded(found.Method);
  vtkNew<vtkBRDFFailureMap> map;
  map->SetReference(reference);
  map->SetBRDF(shaded);
  if (!tool::RunWithProgress(map.Get(), &vtkBRDFFailureMap::Update, "mapping failures"))
  {
    throw tool::Error("compare: --failure-map: " + tool::TakeErrorText());
  }
  const std::vector<tool::ViewError> views = tool::MeasureViews(found.Surface.Normals,
    found.Surface.Views, tool::Pick(found.Shaded.Drawn, found.Surface), found.Reference);
  std::string note =
    shaded == reference
      ? "The method takes the material's own f: its errors are those of the integral alone (right)."
      : "f as " + tool::DescribeForm(shaded) + ": relative L1 " +
          tool::FormatPercent(map->GetRelativeL1()) + ".";
  note += " Each cell: mean |f - r| over mean r, all azimuths. Gray: below the horizon.";
  tool::WriteFailureMap(found.Options.FailureMap, found.Title, note, found.Shaded.Name, map, views);

  report["brdf_relative_l1"] = map->GetRelativeL1();
  report["brdf_log_cosine"] = vtkBRDFResampler::GetLogCosineDistance(reference, shaded);
  report["worst_angles"] = nlohmann::ordered_json::array();
  for (int k = 0; k < map->GetNumberOfWorstAngles(); ++k)
  {
    double angles[3];
    map->GetWorstAngles(k, angles);
    report["worst_angles"].push_back({ { "theta_i", angles[0] }, { "theta_o", angles[1] },
      { "phi", angles[2] }, { "error", map->GetWorstError(k) } });
  }
  report["radiance_by_theta_o"] = nlohmann::ordered_json::array();
  for (const tool::ViewError& view : views)
  {
    report["radiance_by_theta_o"].push_back(
      { { "begin", view.Begin }, { "end", view.End }, { "pixels", view.NumberOfPixels },
        { "relative_l1", view.RelativeL1 }, { "p99_relative", view.P99 } });
  }
}

//------------------------------------------------------------------------------
// PBR, method and reference in front of the environment; with --occlusion the light that nothing
// hides, the method without a bounce and with it, and the traced reference.
void WriteStrip(Comparison& found)
{
  const CompareOptions& options = found.Options;
  const tool::Size& size = options.Stage.Size;
  const double error = found.Shaded.RelativeL1;
  const std::string name = found.Shaded.Name == "auto" ? "this module" : found.Shaded.Name;
  if (options.Occlusion)
  {
    std::vector<double> black;
    if (options.Trace.Bounces > 0)
    {
      found.Scene.Mapper->SetOcclusionBounce(false);
      black = tool::Pick(found.Scene.Render(size.Width, size.Height), found.Surface);
      found.Scene.Mapper->SetOcclusionBounce(true);
    }
    tool::WriteOcclusionStrip(options.Strip, found.Title, found.Environment, size, found.Scene,
      found.Surface, found.Traced, name, error, black);
    return;
  }
  // Times relative to PBR's, which depend less on the machine.
  char frame[48];
  std::snprintf(frame, sizeof(frame), ", %.2g times PBR's frame time",
    found.Shaded.Frame / std::max(found.Stock.Frame, 1e-6));
  tool::ComparisonStrip strip(found.Title, found.Environment, size);
  strip.AddRendered(
    found.StockScene, "VTK's PBR, fitted", "error " + tool::FormatPercent(found.Stock.RelativeL1));
  strip.AddRendered(found.Scene, name, "error " + tool::FormatPercent(error) + frame);
  strip.AddRadiance(found.Scene, found.Surface, found.Reference, "reference",
    "the integral itself, 99 % of pixels within 0.3 %");
  strip.Write(options.Strip);
}

//------------------------------------------------------------------------------
// Both from cold until the first frame is done, in windows that are open already. The measured
// scene goes first: nothing of the material or the environment is prepared.
void SetUp(Comparison& found, const tool::Material& shaded, vtkPolyData* mesh)
{
  const tool::Stage& stage = found.Options.Stage;
  for (tool::OffscreenScene* scene :
    std::initializer_list<tool::OffscreenScene*>{ &found.Scene, &found.StockScene })
  {
    stage.Place(*scene, mesh);
    scene->Open(stage.Size.Width, stage.Size.Height);
  }
  found.Scene.Mapper->SetOcclusionMode( // as the reference
    found.Options.Occlusion ? vtkMeasuredBRDFMapper::OCCLUSION_ON
                            : vtkMeasuredBRDFMapper::OCCLUSION_OFF);
  found.Scene.Mapper->SetOcclusionBounce(found.Options.Trace.Bounces > 0);
  found.Shaded.TimeSetUp(
    [&]()
    {
      found.Method = tool::MakeMethod(found.Options.Method, shaded, found.Environment);
      found.Scene.Begin(found.Method, found.Environment, found.Options.Method.Plan);
    });
  found.Stock.TimeSetUp(
    [&]()
    {
      found.StockScene.SetLight(found.Environment);
      found.StockScene.SetMaterial(tool::StockMaterial());
      found.StockScene.TimeFrame();
    });
}

//------------------------------------------------------------------------------
// Frames of both in turns, so that whatever slows the machine down slows both.
void TimeFrames(Comparison& found)
{
  std::vector<double> frames;
  std::vector<double> stockFrames;
  double spent = 0.0;
  for (int k = 0; k < WarmUp + NumberOfFrames && (spent < MeasuringBudget || frames.empty()); ++k)
  {
    const double frame = found.Scene.TimeFrame();
    const double stockFrame = found.StockScene.TimeFrame();
    spent += frame + stockFrame;
    if (k >= WarmUp || spent >= MeasuringBudget)
    {
      frames.push_back(frame);
      stockFrames.push_back(stockFrame);
    }
  }
  found.NumberOfFrames = frames.size();
  found.Shaded.Frame = tool::GetQuantile(frames, 0.5);
  found.Stock.Frame = tool::GetQuantile(stockFrames, 0.5);
}

//------------------------------------------------------------------------------
int GetComparedPixels(const CompareOptions& options)
{
  const int all = std::numeric_limits<int>::max();
  return !options.Strip.empty()        ? all
         : options.ReferencePixels > 0 ? options.ReferencePixels
         : options.Occlusion           ? TracedPixels
                                       : all;
}

//------------------------------------------------------------------------------
void Run(CompareOptions& options, const CLI::App* command)
{
  options.Method.Check(command);
  for (const std::string& path :
    { options.Output, options.Strip, options.FailureMap, options.Report })
  {
    tool::CheckWritable(path);
  }
  const tool::Size& size = options.Stage.Size;
  const tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const tool::Material shaded = options.Fit.empty() ? material : tool::LoadMaterial(options.Fit);
  Comparison found(options);
  found.Environment = options.Stage.LoadEnvironment();
  found.Title = material.Name + " under " + found.Environment->GetName();
  const vtkSmartPointer<vtkPolyData> mesh = options.Stage.LoadMesh();
  SetUp(found, shaded, mesh);

  found.Surface =
    tool::FindSurface(mesh, options.Stage.View, tool::ViewFill, size, GetComparedPixels(options));
  const vtkSmartPointer<vtkTracedScene> traced = tool::MakeTracedScene(mesh);
  found.Predicted = tool::PredictOcclusion(traced, material.BRDF, found.Environment);
  if (options.Occlusion)
  {
    found.Traced = tool::TraceSurface(
      traced, material.BRDF, found.Environment, found.Scene, found.Surface, size, options.Trace);
  }
  const tool::ReferencePicture whole =
    options.Occlusion ? tool::ReferencePicture{ found.Traced.Radiance }
                      : tool::DrawReference(material.BRDF, found.Environment, found.Surface, size);
  found.Reference = whole.Radiance;
  const tool::Grid grid(found.Surface, size);
  found.StockMaterial = found.StockScene.Fit(found.Surface, size, found.Reference);
  found.Shaded.Compare(found.Scene, grid, size, found.Reference);
  found.Stock.Compare(found.StockScene, grid, size, found.Reference);
  TimeFrames(found);

  nlohmann::ordered_json report = MakeReport(found);
  report.update(
    { { "reference_pixels", found.Surface.Pixels.size() }, { "reference_within", whole.Within } });
  report.update(tool::DescribeOcclusion(found.Predicted, found.Traced, options.Trace));
  report.update({ { "covered_pixels", found.Surface.NumberOfCovered }, { "width", size.Width },
    { "height", size.Height }, { "material", material.Name },
    { "environment", found.Environment->GetName() },
    { "renderer", found.Scene.GetRendererName() } });
  if (!options.Fit.empty())
  {
    report["fit"] = shaded.Name;
  }
  if (!options.FailureMap.empty())
  {
    WriteFailures(found, material.BRDF, report);
  }
  tool::WriteReport(options.Report, report);
  if (!options.Strip.empty())
  {
    WriteStrip(found);
  }
  if (!options.Output.empty())
  {
    tool::WriteComparisonSheet(options.Output, found.Title, grid,
      tool::Pick(found.Shaded.Drawn, found.Surface), found.Reference, found.Shaded, found.Stock);
  }
  tool::PrintOut(found.Title + ", " + std::to_string(found.Surface.Pixels.size()) + " of " +
                 std::to_string(found.Surface.NumberOfCovered) + " covered pixels\n" +
                 found.Shaded.GetSummary() + found.Stock.GetSummary() + found.Predicted->GetText() +
                 (options.Occlusion ? "; the reference has occlusion\n"
                                    : "; method and reference are without occlusion\n") +
                 (found.Method.Planner ? "plan: " + found.Method.Planner->GetPlan() + "\n" : ""));
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddCompareCommand(CLI::App& app)
{
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand(
    "compare", "Compare a method with the reference and with VTK's own shading, in error and time");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  options->Stage.AddTo(command, LargestComparedPicture);
  options->Method.Method = "auto";
  options->Method.AddTo(command, false, true);
  command
    ->add_option("--reference-pixels", options->ReferencePixels,
      "Compare at most this many covered pixels, on a regular grid (default: all; 4096 with "
      "--occlusion). Where all are compared, many are interpolated, 99 % within 0.3 %")
    ->check(CLI::Range(1, LargestComparedPicture * LargestComparedPicture));
  command->add_option("--report", options->Report,
    "JSON file to write: relative_l1, relative_rmse, rel_mse, median_relative, p99_relative, "
    "percentile_95, percentile_99 (of the pixels' errors over the mean radiance), smape, flip, "
    "hdr_flip, ssim (null for fewer than 11 x 11 compared pixels), delta_e_2000, "
    "frame_ms, setup_ms, setup_cpu_ms (of all threads), texture_bytes, lights, "
    "predicted_error, some of these for "
    "VTK's shading (pbr_...), and the material, environment and picture");
  command
    ->add_option("-o,--output", options->Output,
      "Picture to write, .png: the method, the reference, the signed error, VTK's shading")
    ->check(EndsIn({ ".png" }));
  command
    ->add_option("--strip", options->Strip,
      "Picture to write, .png: VTK's shading, the method and the reference in front of the "
      "environment, with errors and the method's frame time relative to VTK's. Every covered pixel "
      "is compared")
    ->check(EndsIn({ ".png" }));
  command->add_flag("--occlusion", options->Occlusion,
    "Compare with a reference that has what the mesh hides of the environment, traced; with "
    "--bounces the method models one bounce. --strip then shows the light that nothing hides, "
    "with "
    "--bounces the method without a bounce, the method and that reference");
  options->Trace.AddTo(command);
  command->add_option("--fit", options->Fit,
    "Another file of the same material (a fit, a projection). It is rendered instead of FILE and "
    "compared with the reference of FILE");
  command
    ->add_option("--failure-map", options->FailureMap,
      "Picture to write, .png, of the angles at which the method fails: the error of its f over "
      "(theta_i, theta_o) and over (theta_h, theta_d), the error of radiance over theta_o, and the "
      "worst angles. The report gets brdf_relative_l1, brdf_log_cosine, worst_angles, "
      "radiance_by_theta_o")
    ->check(EndsIn({ ".png" }));
  command->footer(
    "VTK's shading is vtkOpenGLPolyDataMapper with physically based materials and "
    "image-based\nlighting. Its roughness, metallic part and color are fitted "
    "for the least error.\n\nExample:\n  measured-brdf compare gold-paint --environment hall "
    "--tolerance 0.02 -o gold.png");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
