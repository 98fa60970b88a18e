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
#include "Scenes.h"
#include "Surface.h"
#include "Tool.h"
#include "TracedSurface.h"

#include "vtkVersion.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

namespace
{
struct RenderOptions
{
  std::string File;
  tool::Stage Stage;
  std::string Background;
  double Exposure = 0.0;
  std::string Output;
  std::string Report;
  tool::MethodOptions Method;
  tool::TraceOptions Trace;
  std::string Occlusion = "auto";
};

// Frames that frame_ms is the median of: fewer where they take longer than this in all, in ms.
constexpr std::size_t NumberOfTimedFrames = 21;
constexpr double TimedFramesBudget = 1000.0;
// PNG pictures are rendered at this multiple and averaged, up to a size that every driver takes.
constexpr int PictureSmooth = 2;
constexpr int LargestPicture = 8192;

//------------------------------------------------------------------------------
// The same pixels by an integrator on the CPU; traced: with what the mesh hides.
tool::Picture SumPixels(
  vtkRadianceIntegrator* integrator, vtkPolyData* mesh, const RenderOptions& options, bool traced)
{
  const tool::Size& size = options.Stage.Size;
  const tool::Surface surface = tool::FindSurface(
    mesh, options.Stage.View, tool::ViewFill, size, std::numeric_limits<int>::max());
  std::vector<double> rgb;
  if (traced)
  {
    tool::Scene camera;
    options.Stage.Place(camera, mesh);
    camera.PlaceCamera(size.Width, size.Height);
    const tool::TracedSurface found = tool::TraceSurface(tool::MakeTracedScene(mesh),
      integrator->GetBRDF(), integrator->GetEnvironment(), camera, surface, size, options.Trace);
    tool::PrintNote("traced: other samples would differ by " + tool::FormatPercent(found.Noise) +
                    " in a pixel, on average");
    rgb = found.Radiance;
  }
  else
  {
    rgb = tool::IntegratePairs(integrator, surface.Normals, surface.Views);
  }
  return tool::Grid(surface, size).Draw(rgb);
}

//------------------------------------------------------------------------------
// PNG pictures are rendered larger and averaged.
int GetFactor(const RenderOptions& options)
{
  const tool::Size& size = options.Stage.Size;
  const bool smooth = tool::Extension(options.Output) == ".png" &&
                      !tool::IsOnCpuOnly(options.Method.Method) &&
                      PictureSmooth * std::max(size.Width, size.Height) <= LargestPicture;
  return smooth ? PictureSmooth : 1;
}

//------------------------------------------------------------------------------
void WritePicture(const RenderOptions& options, const tool::OffscreenScene& scene,
  tool::Picture picture, vtkEnvironment* environment, int factor)
{
  const bool png = tool::Extension(options.Output) == ".png";
  const double exposure = std::exp2(options.Exposure);
  if (options.Background == "environment" || (options.Background.empty() && png))
  {
    tool::ComposeOver(picture, scene, tool::Backdrop{ environment }, exposure);
  }
  else
  {
    for (std::size_t k = 0; k < picture.Pixels.size(); ++k)
    {
      picture.Pixels[k] *= k % 4 == 3 ? 1.0f : static_cast<float>(exposure);
    }
  }
  if (!png)
  {
    tool::WriteEXR(options.Output, picture);
    return;
  }
  for (float& value : picture.Pixels)
  {
    value = std::min(value, 1.0f); // before averaging: smooth edges next to highlights
  }
  tool::WritePNG(options.Output, tool::Downsample(picture, factor), tool::EncodeGamma);
}

//------------------------------------------------------------------------------
// A surface with too many points to be traced unasked.
void NoteUnmodeled(const std::string& plan)
{
  const std::size_t begin = plan.find("unoccluded light: ");
  if (begin != std::string::npos && plan.find(", not modeled", begin) != std::string::npos)
  {
    tool::PrintNote(plan.substr(begin) + "; --occlusion on models it");
  }
}

//------------------------------------------------------------------------------
// Says which options do not matter.
void CheckTracing(const RenderOptions& options, const tool::Method& method, const CLI::App* command)
{
  const bool traced = options.Method.Method == "traced";
  const auto note = [&](const char* name, bool matters, const char* where)
  {
    if (command->count(name) > 0 && !matters)
    {
      tool::PrintNote(std::string(name) + " has no effect " + where);
    }
  };
  const bool drawn = !tool::IsOnCpuOnly(options.Method.Method);
  note("--samples", traced, "without --method traced");
  const bool planned = !method.Integrator; // as yet
  const bool hidden = drawn && (planned || method.Integrator->NeedsEnvironment());
  note("--occlusion", hidden,
    drawn ? "on a sum over lights: no mesh hides them"
          : "with a method on the CPU: only 'traced' knows what the mesh hides");
  note("--bounces",
    traced || (hidden && (options.Occlusion == "on" || (options.Occlusion == "auto" && planned))),
    "where what the mesh hides is left out: 'auto' models it, other methods with --occlusion on");
}

//------------------------------------------------------------------------------
nlohmann::ordered_json MakeRenderReport(
  const RenderOptions& options, const tool::Method& method, const std::string& plan)
{
  nlohmann::ordered_json report = { { "method", options.Method.Method },
    { "lights", options.Method.HasLights() ? options.Method.Lights.Count : 0 },
    { "lights_in_use", method.GetNumberOfLights() }, { "light_set", options.Method.Lights.Method },
    { "soft_lights", options.Method.Lights.Soft }, { "width", options.Stage.Size.Width },
    { "height", options.Stage.Size.Height }, { "vtk", vtkVersion::GetVTKVersion() } };
  if (options.Method.Method == "thesis")
  {
    report["representation"] = method.Thesis.Kind;
    report["representation_form"] = method.Thesis.Description;
    report["reason"] = method.Thesis.Reason;
  }
  if (method.Planner)
  {
    report["plan"] = plan;
    report["predicted_error"] = method.Planner->GetPredictedError(method.Planner->GetChoice());
    report["predicted_picture_error"] =
      method.Planner->GetPredictedPictureError(method.Planner->GetChoice());
  }
  return report;
}

//------------------------------------------------------------------------------
void Run(RenderOptions& options, const CLI::App* command)
{
  options.Method.Check(command);
  const tool::Size& size = options.Stage.Size;
  const tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const vtkSmartPointer<vtkEnvironment> environment =
    tool::LoadEnvironment(options.Stage.EnvironmentFile);
  const vtkSmartPointer<vtkPolyData> mesh = options.Stage.LoadMesh();
  const bool onCpu = tool::IsOnCpuOnly(options.Method.Method);
  if (onCpu)
  {
    tool::CheckWritable(options.Output); // before hours of work
  }

  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&begin]()
  {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
  };
  tool::Method method = tool::MakeMethod(options.Method, material, environment);
  CheckTracing(options, method, command);
  tool::Scene scene;
  options.Stage.Place(scene, mesh);
  const int factor = GetFactor(options);
  std::vector<double> frames;
  std::string plan;
  tool::Picture picture(1, 1);
  double setup = elapsed();
  if (onCpu)
  {
    picture = SumPixels(method.Integrator, mesh, options, options.Method.Method == "traced");
    frames.push_back(elapsed() - setup);
  }
  else
  {
    scene.Mapper->SetOcclusionMode(options.Occlusion == "on" ? vtkMeasuredBRDFMapper::OCCLUSION_ON
                                   : options.Occlusion == "off"
                                     ? vtkMeasuredBRDFMapper::OCCLUSION_OFF
                                     : vtkMeasuredBRDFMapper::OCCLUSION_AUTO);
    scene.Mapper->SetOcclusionBounce(options.Trace.Bounces > 0);
    scene.Open(size.Width, size.Height);
    scene.Begin(method, environment, options.Method.Plan);
    plan = scene.Mapper->GetPlan();
    NoteUnmodeled(plan);
    if (options.Method.Plan.ForView)
    {
      scene.HoldPlan(method, environment); // for the larger picture, too
    }
    setup = elapsed();
    double spent = 0.0;
    while (
      !options.Report.empty() && frames.size() < NumberOfTimedFrames && spent < TimedFramesBudget)
    {
      frames.push_back(scene.TimeFrame());
      spent += frames.back();
    }
    picture = scene.Render(factor * size.Width, factor * size.Height);
  }
  if (!options.Report.empty())
  {
    nlohmann::ordered_json report = { { "frame_ms", tool::GetQuantile(frames, 0.5) },
      { "setup_ms", setup }, { "texture_bytes", onCpu ? 0 : scene.Mapper->GetTextureBytes() },
      { "frames", frames.size() }, { "material", material.Name },
      { "environment", environment->GetName() },
      { "renderer", onCpu ? "CPU" : scene.GetRendererName() } };
    report.update(MakeRenderReport(options, method, plan));
    tool::WriteReport(options.Report, report);
  }
  scene.PlaceCamera(picture.Width, picture.Height);
  WritePicture(options, scene, std::move(picture), environment, factor);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddRenderCommand(CLI::App& app)
{
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
    app.add_subcommand("render", "Render a mesh of the material under an environment");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  options->Stage.Size = { 800, 800 };
  options->Stage.AddTo(command, LargestPicture);
  options->Method.Method = "auto";
  options->Method.AddTo(command, true, true, true);
  options->Trace.AddTo(command);
  command
    ->add_option("--occlusion", options->Occlusion,
      "What the mesh hides of the environment from itself: auto models it as the mapper does in a "
      "program, where its predicted error exceeds what the tolerance leaves, for up to 20,000 "
      "points; on: on any mesh, by every method but sums over lights; off: never, as --method "
      "reference (default: auto)")
    ->check(CLI::IsMember({ "auto", "on", "off" }));
  command->add_option("--exposure", options->Exposure,
    "Brighten (or darken) the picture by this many stops; default 0: unchanged physical values");
  command
    ->add_option("--background", options->Background,
      "environment or none (default: environment in .png, none, with alpha 0, in .exr)")
    ->check(CLI::IsMember({ "environment", "none" }));
  command
    ->add_option("-o,--output", options->Output,
      "Picture to write: .png (8 bit, as displayed) or .exr (linear float RGBA)")
    ->check(tool::EndsIn({ ".png", ".exr" }))
    ->required();
  command->add_option("--report", options->Report,
    "JSON file to write: frame_ms (median), setup_ms, texture_bytes, method, lights, renderer, "
    "vtk; for --method auto also the plan, its predicted_error and predicted_picture_error; for "
    "thesis the representation and the reason");
  command->footer("Example:\n  measured-brdf render gold-paint --environment sky --lights 256 "
                  "-o gold.png\n\nNeeds OpenGL; without a screen, put 'xvfb-run -a' before it.");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
