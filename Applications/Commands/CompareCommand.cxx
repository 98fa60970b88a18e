// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "JsonReport.h"
#include "Measuring.h"
#include "Methods.h"
#include "Options.h"
#include "ParetoFront.h"
#include "Picture.h"
#include "Progress.h"
#include "ReferencePicture.h"
#include "Scenes.h"
#include "Sheets.h"
#include "Surface.h"
#include "Tool.h"
#include "TracedSurface.h"

#include "vtkBRDFFailureMap.h"
#include "vtkBRDFResampler.h"
#include "vtkColorTransferFunction.h"
#include "vtkImageData.h"
#include "vtkMath.h"
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
// What the mesh hides, predicted and, where the picture was traced, in that.
nlohmann::ordered_json DescribeOcclusion(vtkOcclusionPredictor* predicted,
  const tool::TracedSurface& traced, const tool::TraceOptions& options)
{
  nlohmann::ordered_json report = { { "unoccluded_error", predicted->GetError() },
    { "unoccluded_uncertainty", predicted->GetUncertainty() },
    { "occlusion", !traced.Radiance.empty() } };
  if (!traced.Radiance.empty())
  {
    double difference = 0.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < traced.Radiance.size(); ++k)
    {
      difference += std::abs(traced.Unoccluded[k] - traced.Radiance[k]);
      sum += traced.Radiance[k];
    }
    report["traced_samples"] = options.Samples;
    report["traced_bounces"] = options.Bounces;
    report["traced_noise"] = traced.Noise;
    report["unoccluded_error_in_view"] = difference / std::max(sum, 1e-300);
  }
  return report;
}

//------------------------------------------------------------------------------
// What is evaluated in place of the material: the form on the GPU where the method has one.
vtkBRDF* GetShaded(const tool::Method& method)
{
  return method.Integrator->UsesBRDFOnGPU() ? method.BRDF->GetRenderable() : method.BRDF.Get();
}

/// Error of radiance at the views between two polar angles; shares, relative to the mean radiance
/// there.
struct ViewError
{
  double Begin; // degrees
  double End;
  std::size_t NumberOfPixels;
  double RelativeL1;
  double P99; // 99th percentile of the pixels' own relative errors
};

constexpr double ViewStep = 5.0; // degrees
constexpr int Views = static_cast<int>(90.0 / ViewStep);

// A map with its axes, in pixels.
constexpr int MapSide = 480;
constexpr int MapMargin = 60; // left of it and below, for the ticks
constexpr int TickSize = 15;

/// Where on an axis, as a share of it, there is which text.
using AxisTicks = std::vector<std::pair<double, std::string>>;

//------------------------------------------------------------------------------
// A logarithm of an error as a share of the colors' range.
double FindShare(double error)
{
  return (std::log10(std::max(error, 1e-12)) - tool::LowestError) /
         (tool::HighestError - tool::LowestError);
}

//------------------------------------------------------------------------------
// Angles on an axis where theta is at theta / 90 or, on one of square roots, at its root.
AxisTicks MakeAngleTicks(const std::vector<int>& degrees, bool isRoot)
{
  AxisTicks ticks;
  for (const int theta : degrees)
  {
    ticks.emplace_back(isRoot ? std::sqrt(theta / 90.0) : theta / 90.0, std::to_string(theta));
  }
  return ticks;
}

//------------------------------------------------------------------------------
// The colors of errors over a square, of its places in [0, 1), gray where an error is not a number;
// with ticks below it and left of it.
tool::Picture DrawMap(const std::function<double(double, double)>& find, const AxisTicks& across,
  const AxisTicks& upwards)
{
  constexpr int side = MapMargin + MapSide + TickSize;
  tool::Picture tile = tool::MakePaper(side, side);
  const auto colors = tool::MakeErrorColors();
  for (int k = 0; k < MapSide * MapSide; ++k)
  {
    const int x = k % MapSide;
    const int y = k / MapSide;
    const double error = find((x + 0.5) / MapSide, (y + 0.5) / MapSide);
    tool::RGB rgb(0.87); // of what is no error
    if (!std::isnan(error))
    {
      colors->GetColor(tool::LowestError + (tool::HighestError - tool::LowestError) *
                                             std::clamp(FindShare(error), 0.0, 1.0),
        &rgb.x);
    }
    tile.Blend(MapMargin + x, MapMargin + y,
      { measuredbrdf::DecodeSRGB(rgb.r), measuredbrdf::DecodeSRGB(rgb.g),
        measuredbrdf::DecodeSRGB(rgb.b) },
      1.0);
  }
  for (const auto& [share, text] : across)
  {
    const int width = tool::MeasureText(text, TickSize, false);
    tool::DrawText(tile, MapMargin + static_cast<int>(share * MapSide) - width / 2,
      MapMargin - 2 * TickSize, text, TickSize, false, tool::White);
  }
  for (const auto& [share, text] : upwards)
  {
    const int width = tool::MeasureText(text, TickSize, false);
    tool::DrawText(tile, MapMargin - width - 6,
      MapMargin + static_cast<int>(share * MapSide) - TickSize / 2, text, TickSize, false,
      tool::White);
  }
  return tile;
}

//------------------------------------------------------------------------------
tool::Picture DrawErrors(vtkImageData* errors, const AxisTicks& across)
{
  const int* size = errors->GetDimensions();
  return DrawMap(
    [=](double u, double v)
    {
      return errors->GetScalarComponentAsDouble(
        static_cast<int>(u * size[0]), static_cast<int>(v * size[1]), 0, 0);
    },
    across, MakeAngleTicks({ 0, 15, 30, 45, 60, 75, 90 }, false));
}

//------------------------------------------------------------------------------
// Of radiance and its reference (3 values a pixel), by the angle between normal and view (3 values
// each), in equal steps; those without a pixel or light are left out.
std::vector<ViewError> MeasureViews(const std::vector<double>& normals,
  const std::vector<double>& views, const std::vector<double>& rgb,
  const std::vector<double>& reference)
{
  std::vector<double> x[Views];
  std::vector<double> r[Views];
  for (std::size_t k = 0; k < normals.size(); k += 3)
  {
    const double cosine = std::clamp(vtkMath::Dot(&normals[k], &views[k]), 0.0, 1.0);
    const double theta = vtkMath::DegreesFromRadians(std::acos(cosine));
    const int step = std::min(Views - 1, static_cast<int>(theta / ViewStep));
    x[step].insert(x[step].end(), { rgb[k], rgb[k + 1], rgb[k + 2] });
    r[step].insert(r[step].end(), { reference[k], reference[k + 1], reference[k + 2] });
  }
  std::vector<ViewError> errors;
  for (int step = 0; step < Views; ++step)
  {
    if (std::any_of(r[step].begin(), r[step].end(), [](double value) { return value > 0.0; }))
    {
      vtkNew<vtkRadianceMetrics> metrics;
      if (!metrics->Compare(tool::MakeArray(x[step], 3), tool::MakeArray(r[step], 3)))
      {
        throw tool::Error("measuring the views: " + tool::TakeErrorText());
      }
      errors.push_back({ step * ViewStep, (step + 1) * ViewStep, x[step].size() / 3,
        metrics->GetRelativeL1(), metrics->GetP99Relative() });
    }
  }
  return errors;
}

//------------------------------------------------------------------------------
// Both maps of f, in the first of them the places of the worst angles, and the errors of radiance
// over theta_o, as PNG. Colors: viridis of the logarithm, 0.1 % to 100 % in every picture, so that
// two of them compare. note: what was compared, below the title. Throws Error.
void WriteFailureMap(const std::string& path, const std::string& title, const std::string& note,
  const std::string& method, vtkBRDFFailureMap* map, const std::vector<ViewError>& views)
{
  const AxisTicks degrees = MakeAngleTicks({ 0, 15, 30, 45, 60, 75, 90 }, false);
  tool::Picture first = DrawErrors(map->GetIncidentOutgoing(), degrees);
  for (int k = 0; k < map->GetNumberOfWorstAngles(); ++k) // white on black: seen on any color
  {
    double angles[3];
    map->GetWorstAngles(k, angles);
    const int x = MapMargin + static_cast<int>(angles[0] / 90.0 * MapSide) - 4;
    const int y = MapMargin + static_cast<int>(angles[1] / 90.0 * MapSide) - 6;
    tool::Paste(first, tool::MakePaper(TickSize - 3, TickSize), x - 2, y - 2);
    tool::DrawText(first, x, y, std::to_string(k + 1), TickSize - 1, true, tool::White);
  }
  const tool::Picture second =
    DrawErrors(map->GetHalfDifference(), MakeAngleTicks({ 0, 2, 5, 10, 20, 30, 45, 60, 90 }, true));
  const tool::Picture third = DrawMap(
    [&views](double u, double v)
    {
      const auto view = std::find_if(views.begin(), views.end(),
        [u](const ViewError& one) { return 90.0 * u >= one.Begin && 90.0 * u < one.End; });
      const double place =
        std::pow(10.0, tool::LowestError + (tool::HighestError - tool::LowestError) * v);
      const bool isBar =
        view != views.end() &&
        place <= (90.0 * u < view->Begin + 0.5 * ViewStep ? view->P99 : view->RelativeL1);
      return isBar ? place : std::numeric_limits<double>::quiet_NaN();
    },
    degrees,
    { { FindShare(0.001), "0.1 %" }, { FindShare(0.01), "1 %" }, { FindShare(0.1), "10 %" },
      { FindShare(1.0), "100 %" } });
  tool::ContactSheet sheet(title, 3, 1, first.Width, first.Height);
  sheet.Add(0, 0, first, "f: theta_i across, theta_o upwards", note);
  sheet.Add(1, 0, second, "f: theta_h across, theta_d upwards",
    "The numbers in the first map mark the worst angles.");
  sheet.Add(2, 0, third, "radiance over theta_o: " + method,
    "Left of each pair: the 99th percentile; right: relative L1. The maps have the same colors.");
  sheet.Write(path);
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
  const std::vector<ViewError> views = MeasureViews(found.Surface.Normals, found.Surface.Views,
    tool::Pick(found.Shaded.Drawn, found.Surface), found.Reference);
  std::string note =
    shaded == reference
      ? "The method takes the material's own f: its errors are those of the integral alone (right)."
      : "f as " + tool::DescribeForm(shaded) + ": relative L1 " +
          tool::FormatPercent(map->GetRelativeL1()) + ".";
  note += " Each cell: mean |f - r| over mean r, all azimuths. Gray: below the horizon.";
  WriteFailureMap(found.Options.FailureMap, found.Title, note, found.Shaded.Name, map, views);

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
  for (const ViewError& view : views)
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
    tool::ComparisonStrip strip(found.Title, found.Environment, size, black.empty() ? 3 : 4);
    const auto add = [&](const std::vector<double>& radiance, const std::string& label)
    {
      vtkNew<vtkRadianceMetrics> metrics;
      tool::Measure(metrics, tool::Grid(found.Surface, size), radiance, found.Traced.Radiance);
      strip.AddRadiance(found.Scene, found.Surface, radiance, label,
        "error " + tool::FormatPercent(metrics->GetRelativeL1()));
    };
    add(found.Traced.Unoccluded, "light that nothing hides");
    if (!black.empty())
    {
      add(black, "black where the sky is hidden");
    }
    strip.AddRendered(found.Scene, name, "error " + tool::FormatPercent(error));
    strip.AddRadiance(
      found.Scene, found.Surface, found.Traced.Radiance, "traced", "the reference with occlusion");
    strip.Write(options.Strip);
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
  found.Environment = tool::LoadEnvironment(options.Stage.EnvironmentFile);
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
  report.update(DescribeOcclusion(found.Predicted, found.Traced, options.Trace));
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
