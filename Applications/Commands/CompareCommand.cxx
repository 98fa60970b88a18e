// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FailureMap.h"
#include "Files.h"
#include "Inputs.h"
#include "Measuring.h"
#include "Meshes.h"
#include "Methods.h"
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
  std::string Environment;
  std::string Mesh;
  std::string Size = "500x500";
  std::string View = "30,20";
  int ReferencePixels = 0;       // as many as GetReferencePixels says
  double ReferenceSeconds = 0.0; // no limit
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
// Share of the picture's smaller side that the mesh takes.
constexpr double ComparedFill = 0.9;

/// What passes on the clock, and what all threads take of the processor, system calls included.
struct SetUpTime
{
  double Milliseconds = 0.0;
  double CpuMilliseconds = 0.0;
};

//------------------------------------------------------------------------------
SetUpTime TimeSetUp(const std::function<void()>& run)
{
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t cpuBegin = std::clock();
  run();
  const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - begin;
  return { passed.count(),
    1e3 * static_cast<double>(std::clock() - cpuBegin) / static_cast<double>(CLOCKS_PER_SEC) };
}

//------------------------------------------------------------------------------
/// What was found.
struct Comparison
{
  vtkNew<vtkRadianceMetrics> Metrics;
  vtkNew<vtkRadianceMetrics> StockMetrics;
  tool::StockMaterial Stock;
  SetUpTime Setup;
  SetUpTime StockSetup;
  std::size_t NumberOfFrames = 0;
  double Frame = 0.0;
  double StockFrame = 0.0;
};

//------------------------------------------------------------------------------
nlohmann::ordered_json MakeReport(const CompareOptions& options, const Comparison& found,
  const tool::Method& method, tool::Scene& scene)
{
  vtkRadianceMetrics* metrics = found.Metrics;
  nlohmann::ordered_json report = { { "method", options.Method.Method } };
  for (const tool::Metric& metric : tool::GetMetrics())
  {
    report[metric.Name] = metric.Get(metrics);
  }
  report.update({ { "frame_ms", found.Frame }, { "pbr_frame_ms", found.StockFrame },
    { "pbr_relative_l1", found.StockMetrics->GetRelativeL1() },
    { "setup_ms", found.Setup.Milliseconds }, { "setup_cpu_ms", found.Setup.CpuMilliseconds },
    { "pbr_setup_ms", found.StockSetup.Milliseconds },
    { "pbr_setup_cpu_ms", found.StockSetup.CpuMilliseconds },
    { "pbr_flip", found.StockMetrics->GetFLIP() },
    { "pbr_material", { { "roughness", found.Stock.Roughness },
                        { "metallic", found.Stock.Metallic }, { "albedo", found.Stock.Albedo } } },
    { "frames", found.NumberOfFrames }, { "vtk", vtkVersion::GetVTKVersion() } });
  report["lights"] = method.GetNumberOfLights();
  report["texture_bytes"] = scene.GetTextureBytes();
  report["predicted_error"] = nullptr;
  if (method.Planner)
  {
    report["predicted_error"] = method.Planner->GetPredictedError(method.Planner->GetChoice());
    report["predicted_picture_error"] =
      method.Planner->GetPredictedPictureError(method.Planner->GetChoice());
    report["tolerance"] = options.Method.Plan.Tolerance;
    report["meets_tolerance"] = method.Planner->GetMeetsTolerance();
    report["plan"] = method.Planner->GetPlan();
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
vtkSmartPointer<vtkBRDFFailureMap> MakeFailureMap(vtkBRDF* reference, const tool::Method& method)
{
  auto map = vtkSmartPointer<vtkBRDFFailureMap>::New();
  map->SetReference(reference);
  map->SetBRDF(GetShaded(method));
  if (!tool::RunWithProgress(map.Get(), &vtkBRDFFailureMap::Update, "mapping failures"))
  {
    throw tool::Error("compare: --failure-map: " + tool::TakeErrorText());
  }
  return map;
}

//------------------------------------------------------------------------------
void WriteFailureMap(const CompareOptions& options, const std::string& title,
  const tool::Method& method, vtkBRDFFailureMap* map, const std::vector<tool::ViewError>& views)
{
  tool::FailureCaption caption;
  caption.Title = title;
  caption.Method = options.Method.Method;
  vtkBRDF* shaded = GetShaded(method);
  caption.Note =
    shaded == map->GetReference()
      ? "The method takes the material's own f: its errors are those of the integral alone (right)."
      : "f as " + tool::DescribeForm(shaded) + ": relative L1 " +
          tool::FormatPercent(map->GetRelativeL1()) + ".";
  caption.Note += " Each cell: mean |f - r| over mean r, all azimuths. Gray: below the horizon.";
  tool::WriteFailureMap(options.FailureMap, caption, map, views);
}

//------------------------------------------------------------------------------
void AddFailures(
  vtkBRDFFailureMap* map, const std::vector<tool::ViewError>& views, nlohmann::ordered_json& report)
{
  report["brdf_relative_l1"] = map->GetRelativeL1();
  report["brdf_log_cosine"] =
    vtkBRDFResampler::GetLogCosineDistance(map->GetReference(), map->GetBRDF());
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
// PBR, method and reference in front of the environment.
void WriteStrip(const CompareOptions& options, const std::string& title,
  vtkEnvironment* environment, const Comparison& found, tool::OffscreenScene& scene,
  tool::OffscreenScene& stock, const tool::Surface& surface, const std::vector<double>& reference)
{
  const tool::Size size = tool::ParseSize("--size", options.Size, LargestComparedPicture);
  // Times relative to PBR's, which depend less on the machine.
  char frame[48];
  std::snprintf(frame, sizeof(frame), ", %.2g times PBR's frame time",
    found.Frame / std::max(found.StockFrame, 1e-6));
  tool::ComparisonStrip strip(title, environment, size);
  strip.AddRendered(stock, "VTK's PBR, fitted",
    "error " + tool::FormatPercent(found.StockMetrics->GetRelativeL1()));
  strip.AddRendered(scene, options.Method.Method == "auto" ? "this module" : options.Method.Method,
    "error " + tool::FormatPercent(found.Metrics->GetRelativeL1()) + frame);
  strip.AddRadiance(
    scene, surface, reference, "reference", "the integral itself, 99 % of pixels within 0.3 %");
  strip.Write(options.Strip);
}

//------------------------------------------------------------------------------
void WriteAnyStrip(const CompareOptions& options, const std::string& title,
  vtkEnvironment* environment, const Comparison& found, tool::Scene& scene,
  tool::OffscreenScene& stock, const tool::Surface& surface, const tool::Occlusion& occlusion,
  const std::vector<double>& reference)
{
  if (!options.Occlusion)
  {
    WriteStrip(options, title, environment, found, scene, stock, surface, reference);
    return;
  }
  const std::string name = options.Method.Method == "auto" ? "this module" : options.Method.Method;
  const tool::Size size = tool::ParseSize("--size", options.Size, LargestComparedPicture);
  std::vector<double> black;
  if (options.Trace.Bounces > 0)
  {
    scene.ModelOcclusion(vtkMeasuredBRDFMapper::OCCLUSION_ON, false);
    black = tool::Pick(scene.Render(size.Width, size.Height), surface);
    scene.ModelOcclusion(vtkMeasuredBRDFMapper::OCCLUSION_ON, true);
  }
  tool::WriteOcclusionStrip(options.Strip, title, environment, size, scene, surface,
    occlusion.Traced, name, found.Metrics->GetRelativeL1(), black);
}

//------------------------------------------------------------------------------
void Open(
  tool::OffscreenScene& scene, vtkPolyData* mesh, const tool::View& view, const tool::Size& size)
{
  scene.SetMesh(mesh);
  scene.SetView(view.Azimuth, view.Elevation, ComparedFill, view.Angle);
  scene.Open(size.Width, size.Height);
}

//------------------------------------------------------------------------------
// Both from cold until the first frame is done, in windows that are open already. The measured
// scene goes first: nothing of the material or the environment is prepared.
tool::Method SetUp(const CompareOptions& options, const tool::Material& shaded,
  vtkEnvironment* environment, tool::Scene& scene, tool::StockScene& stock, Comparison& found)
{
  tool::Method method;
  found.Setup = TimeSetUp(
    [&]()
    {
      method = tool::MakeMethod(options.Method, shaded, environment);
      scene.Begin(method, environment, options.Method.Plan);
    });
  found.StockSetup = TimeSetUp(
    [&]()
    {
      stock.SetLight(environment);
      stock.SetMaterial(tool::StockMaterial());
      stock.TimeFrame();
    });
  return method;
}

//------------------------------------------------------------------------------
// Frames of both in turns, so that whatever slows the machine down slows both.
void TimeFrames(tool::OffscreenScene& scene, tool::OffscreenScene& stock, Comparison& found)
{
  std::vector<double> frames;
  std::vector<double> stockFrames;
  double spent = 0.0;
  for (int k = 0; k < WarmUp + NumberOfFrames && (spent < MeasuringBudget || frames.empty()); ++k)
  {
    const double frame = scene.TimeFrame();
    const double stockFrame = stock.TimeFrame();
    spent += frame + stockFrame;
    if (k >= WarmUp || spent >= MeasuringBudget)
    {
      frames.push_back(frame);
      stockFrames.push_back(stockFrame);
    }
  }
  found.NumberOfFrames = frames.size();
  found.Frame = tool::Median(frames);
  found.StockFrame = tool::Median(stockFrames);
}

//------------------------------------------------------------------------------
void PrintSummary(const std::string& title, const CompareOptions& options, const Comparison& found,
  const tool::Grid& grid)
{
  const auto line =
    [](const std::string& name, vtkRadianceMetrics* metrics, double frame, double setup)
  {
    return name + ": relative L1 " + tool::FormatPercent(metrics->GetRelativeL1()) +
           ", 95 % of the pixels within " + tool::FormatPercent(metrics->GetPercentile95()) +
           ", 99 % within " + tool::FormatPercent(metrics->GetPercentile99()) + ", FLIP " +
           tool::FormatNumber(std::round(1e4 * metrics->GetFLIP()) / 1e4) + "; frame " +
           tool::FormatMilliseconds(frame) + ", set-up " + tool::FormatMilliseconds(setup) + "\n";
  };
  tool::PrintOut(
    title + ", " + std::to_string(grid.Surface.Pixels.size()) + " of " +
    std::to_string(grid.Surface.NumberOfCovered) + " covered pixels\n" +
    line(options.Method.Method, found.Metrics, found.Frame, found.Setup.Milliseconds) +
    line("VTK's PBR", found.StockMetrics, found.StockFrame, found.StockSetup.Milliseconds));
}

//------------------------------------------------------------------------------
void PrintPlan(
  const CompareOptions& options, vtkOcclusionPredictor& predictor, vtkRadiancePlanner* planner)
{
  tool::PrintOut(
    predictor.GetText() + (options.Occlusion ? "; the reference has occlusion\n"
                                             : "; method and reference are without occlusion\n"));
  if (planner)
  {
    tool::PrintOut("plan: " + planner->GetPlan() + "\n");
  }
}

//------------------------------------------------------------------------------
void Check(CompareOptions& options, const CLI::App* command)
{
  options.Method.Check(command);
  for (const std::string& path : { options.Output, options.Strip, options.FailureMap })
  {
    if (!path.empty() && tool::Extension(path) != ".png")
    {
      throw tool::UsageError(path + ": the picture must end in .png");
    }
  }
  for (const std::string& path :
    { options.Output, options.Strip, options.FailureMap, options.Report })
  {
    if (!path.empty())
    {
      tool::CheckWritable(path);
    }
  }
}

//------------------------------------------------------------------------------
tool::Surface FindCompared(const CompareOptions& options, vtkPolyData* mesh, vtkBRDF* brdf,
  vtkEnvironment* environment, const tool::Size& size)
{
  const tool::View view = tool::ParseView(options.View);
  int pixels = options.ReferencePixels > 0 ? options.ReferencePixels
               : options.Occlusion         ? TracedPixels
                                           : std::numeric_limits<int>::max();
  pixels = options.Strip.empty() ? pixels : std::numeric_limits<int>::max();
  const tool::Surface surface = tool::FindSurface(mesh, view, ComparedFill, size, pixels);
  pixels = tool::LimitReference(
    brdf, environment, surface, options.ReferenceSeconds, "--reference-seconds");
  return tool::FindSurface(mesh, view, ComparedFill, size, pixels);
}

//------------------------------------------------------------------------------
void Run(CompareOptions& options, const CLI::App* command)
{
  const tool::Size size = tool::ParseSize("--size", options.Size, LargestComparedPicture);
  const tool::View view = tool::ParseView(options.View);
  Check(options, command);
  const tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const tool::Material shaded = options.Fit.empty() ? material : tool::LoadMaterial(options.Fit);
  const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(options.Environment);
  const vtkSmartPointer<vtkPolyData> mesh =
    options.Mesh.empty() ? tool::MakeSphere() : tool::LoadMesh(options.Mesh);

  tool::Scene scene;
  tool::StockScene stock;
  Open(scene, mesh, view, size);
  Open(stock, mesh, view, size);
  scene.ModelOcclusion( // as the reference
    options.Occlusion ? vtkMeasuredBRDFMapper::OCCLUSION_ON : vtkMeasuredBRDFMapper::OCCLUSION_OFF,
    options.Trace.Bounces > 0);
  Comparison found;
  const tool::Method method = SetUp(options, shaded, environment, scene, stock, found);

  const tool::Surface surface = FindCompared(options, mesh, material.BRDF, environment, size);
  const tool::Occlusion occlusion = tool::FindOcclusion(mesh, material.BRDF, environment, scene,
    surface, size, options.Occlusion ? &options.Trace : nullptr);
  const tool::ReferencePicture whole =
    options.Occlusion ? tool::ReferencePicture{ occlusion.Traced.Radiance }
                      : tool::DrawReference(material.BRDF, environment, surface, size);
  const std::vector<double>& reference = whole.Radiance;
  const tool::Picture drawn = scene.Render(size.Width, size.Height);
  const std::vector<double> rgb = tool::Pick(drawn, surface);
  found.Stock = stock.Fit(surface, size, reference);
  const tool::Picture stockDrawn = stock.Render(size.Width, size.Height);
  const tool::Grid grid(surface, size);
  tool::Measure(found.Metrics, grid, rgb, reference);
  tool::Measure(found.StockMetrics, grid, tool::Pick(stockDrawn, surface), reference);
  TimeFrames(scene, stock, found);

  nlohmann::ordered_json report = MakeReport(options, found, method, scene);
  report.update(
    { { "reference_pixels", surface.Pixels.size() }, { "reference_within", whole.Within } });
  report.update(tool::DescribeOcclusion(occlusion, options.Trace));
  report.update({ { "covered_pixels", surface.NumberOfCovered }, { "width", size.Width },
    { "height", size.Height }, { "material", material.Name },
    { "environment", environment->GetName() }, { "renderer", scene.GetRendererName() } });
  if (!options.Fit.empty())
  {
    report["fit"] = shaded.Name;
  }
  const std::string title = material.Name + " under " + environment->GetName();
  if (!options.FailureMap.empty())
  {
    const std::vector<tool::ViewError> views =
      tool::MeasureViews(surface.Normals, surface.Views, rgb, reference);
    const vtkSmartPointer<vtkBRDFFailureMap> map = MakeFailureMap(material.BRDF, method);
    WriteFailureMap(options, title, method, map, views);
    AddFailures(map, views, report);
  }
  if (!options.Report.empty())
  {
    tool::WriteWhole(options.Report,
      report.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }
  if (!options.Strip.empty())
  {
    WriteAnyStrip(options, title, environment, found, scene, stock, surface, occlusion, reference);
  }
  if (!options.Output.empty())
  {
    tool::WriteComparisonSheet(options.Output, title, grid, rgb, reference,
      { options.Method.Method, drawn, found.Metrics->GetRelativeL1(), found.Frame,
        found.Setup.Milliseconds },
      { "VTK's PBR + IBL", stockDrawn, found.StockMetrics->GetRelativeL1(), found.StockFrame,
        found.StockSetup.Milliseconds });
  }
  PrintSummary(title, options, found, grid);
  PrintPlan(options, *occlusion.Predicted, method.Planner);
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
  command->add_option("--environment", options->Environment, EnvironmentHelp)->required();
  AddProjectionOption(command);
  command->add_option("--mesh", options->Mesh,
    "Mesh to show it on: ply, stl, obj, vtp, vtk, gltf, glb or 'ball-on-foot' (default: a sphere)");
  options->Method.Method = "auto";
  options->Method.AddTo(command, false);
  options->Method.Plan.AddForViewTo(command);
  command->add_option(
    "--size", options->Size, "Picture size in pixels, WIDTHxHEIGHT (default 500x500)");
  command->add_option("--view", options->View,
    "Where to look from, AZIMUTH,ELEVATION[,ANGLE] in degrees, as for render (default 30,20)");
  command
    ->add_option("--reference-pixels", options->ReferencePixels,
      "Compare at most this many covered pixels, on a regular grid (default: all; 4096 with "
      "--occlusion). Where all are compared, many are interpolated, 99 % within 0.3 %")
    ->check(CLI::Range(1, LargestComparedPicture * LargestComparedPicture));
  CLI::Option* seconds =
    command
      ->add_option("--reference-seconds", options->ReferenceSeconds,
        "Where the reference of these pixels may take longer on this machine, in seconds, compare "
        "fewer, on a grid, and say how many (default: no limit)")
      ->check(CLI::PositiveNumber);
  command->add_option("--report", options->Report,
    "JSON file to write: relative_l1, relative_rmse, rel_mse, median_relative, p99_relative, "
    "percentile_95, percentile_99 (of the pixels' errors over the mean radiance), smape, flip, "
    "hdr_flip, ssim (null for fewer than 11 x 11 compared pixels), delta_e_2000, "
    "frame_ms, setup_ms, setup_cpu_ms (of all threads), texture_bytes, lights, "
    "predicted_error, some of these for "
    "VTK's shading (pbr_...), and the material, environment and picture");
  command->add_option("-o,--output", options->Output,
    "Picture to write, .png: the method, the reference, the signed error, VTK's shading");
  command
    ->add_option("--strip", options->Strip,
      "Picture to write, .png: VTK's shading, the method and the reference in front of the "
      "environment, with errors and the method's frame time relative to VTK's. Every covered pixel "
      "is compared")
    ->excludes(seconds);
  command
    ->add_flag("--occlusion", options->Occlusion,
      "Compare with a reference that has what the mesh hides of the environment, traced; with "
      "--bounces the method models one bounce. --strip then shows the light that nothing hides, "
      "with "
      "--bounces the method without a bounce, the method and that reference")
    ->excludes(seconds);
  options->Trace.AddTo(command);
  command->add_option("--fit", options->Fit,
    "Another file of the same material (a fit, a projection). It is rendered instead of FILE and "
    "compared with the reference of FILE");
  command->add_option("--failure-map", options->FailureMap,
    "Picture to write, .png, of the angles at which the method fails: the error of its f over "
    "(theta_i, theta_o) and over (theta_h, theta_d), the error of radiance over theta_o, and the "
    "worst angles. The report gets brdf_relative_l1, brdf_log_cosine, worst_angles, "
    "radiance_by_theta_o");
  command->footer(
    "VTK's shading is vtkOpenGLPolyDataMapper with physically based materials and "
    "image-based\nlighting. Its roughness, metallic part and color are fitted "
    "for the least error.\n\nExample:\n  measured-brdf compare gold-paint --environment hall "
    "--tolerance 0.02 -o gold.png");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
