// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Measuring.h"
#include "Meshes.h"
#include "Methods.h"
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
  std::string Environment;
  std::string Mesh;
  std::string Size = "800x800";
  std::string View = "30,20";
  std::string Background;
  double Exposure = 0.0;
  std::string Output;
  std::string Report;
  tool::MethodOptions Method;
  tool::TraceOptions Trace;
  std::string Occlusion = "auto";
};

// Frames that frame_ms is the median of: fewer where they take longer than this in all, in ms.
constexpr int NumberOfTimedFrames = 21;
constexpr double TimedFramesBudget = 1000.0;
// PNG pictures are rendered at this multiple and averaged, up to a size that every driver takes.
constexpr int PictureSmooth = 2;
constexpr int LargestPicture = 8192;
// Share of the picture's smaller side that the mesh takes.
constexpr double RenderedFill = 0.9;

//------------------------------------------------------------------------------
// With what the mesh hides.
std::vector<double> TracePixels(vtkRadianceIntegrator* integrator, vtkPolyData* mesh,
  const tool::View& view, const tool::Size& size, const tool::Surface& surface,
  const tool::TraceOptions& options)
{
  tool::Scene camera;
  camera.SetMesh(mesh);
  camera.SetView(view.Azimuth, view.Elevation, RenderedFill, view.Angle);
  camera.PlaceCamera(size.Width, size.Height);
  const tool::TracedSurface traced = tool::TraceSurface(tool::MakeTracedScene(mesh),
    integrator->GetBRDF(), integrator->GetEnvironment(), camera, surface, size, options);
  tool::PrintNote("traced: other samples would differ by " + tool::FormatPercent(traced.Noise) +
                  " in a pixel, on average");
  return traced.Radiance;
}

//------------------------------------------------------------------------------
// The same pixels by an integrator on the CPU.
tool::Picture SumPixels(vtkRadianceIntegrator* integrator, vtkPolyData* mesh,
  const tool::View& view, const tool::Size& size, const tool::TraceOptions* trace)
{
  const tool::Surface surface =
    tool::FindSurface(mesh, view, RenderedFill, size, std::numeric_limits<int>::max());
  const std::vector<double> rgb =
    trace ? TracePixels(integrator, mesh, view, size, surface, *trace)
          : tool::IntegratePairs(integrator, surface.Normals, surface.Views);
  tool::Picture picture(size.Width, size.Height);
  for (std::size_t k = 0; k < surface.Pixels.size(); ++k)
  {
    float* pixel = &picture.Pixels[4 * static_cast<std::size_t>(surface.Pixels[k])];
    std::copy_n(&rgb[3 * k], 3, pixel);
    pixel[3] = 1.0f;
  }
  return picture;
}

//------------------------------------------------------------------------------
// PNG pictures are rendered larger and averaged.
int GetFactor(const RenderOptions& options, const tool::Size& size)
{
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
    tool::ComposeOver(picture, scene, tool::Backdrop(environment), exposure);
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
/// What was measured.
struct Figures
{
  double Setup; // ms
  std::vector<double> Frames;
  tool::Size Size;
  std::string Plan;
};

//------------------------------------------------------------------------------
vtkMeasuredBRDFMapper::OcclusionModeType GetOcclusionMode(const std::string& name)
{
  return name == "on"    ? vtkMeasuredBRDFMapper::OCCLUSION_ON
         : name == "off" ? vtkMeasuredBRDFMapper::OCCLUSION_OFF
                         : vtkMeasuredBRDFMapper::OCCLUSION_AUTO;
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

void WriteReport(const RenderOptions& options, const Figures& found, const tool::Material& material,
  vtkEnvironment* environment, const tool::Method& method, tool::Scene& scene)
{
  const bool onCpu = tool::IsOnCpuOnly(options.Method.Method);
  nlohmann::ordered_json report = { { "frame_ms", tool::Median(found.Frames) },
    { "setup_ms", found.Setup }, { "texture_bytes", onCpu ? 0 : scene.GetTextureBytes() },
    { "method", options.Method.Method },
    { "lights", options.Method.HasLights() ? options.Method.Lights.Count : 0 },
    { "lights_in_use", method.GetNumberOfLights() }, { "light_set", options.Method.Lights.Method },
    { "soft_lights", options.Method.Lights.Soft }, { "width", found.Size.Width },
    { "height", found.Size.Height }, { "frames", found.Frames.size() },
    { "material", material.Name }, { "environment", environment->GetName() },
    { "renderer", onCpu ? "CPU" : scene.GetRendererName() },
    { "vtk", vtkVersion::GetVTKVersion() } };
  if (options.Method.Method == "thesis")
  {
    report["representation"] = method.Thesis.Kind;
    report["representation_form"] = method.Thesis.Description;
    report["reason"] = method.Thesis.Reason;
  }
  if (method.Planner)
  {
    report["plan"] = found.Plan;
    report["predicted_error"] = method.Planner->GetPredictedError(method.Planner->GetChoice());
    report["predicted_picture_error"] =
      method.Planner->GetPredictedPictureError(method.Planner->GetChoice());
  }
  tool::WriteWhole(options.Report,
    report.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

//------------------------------------------------------------------------------
void Run(RenderOptions& options, const CLI::App* command)
{
  const tool::Size size = tool::ParseSize("--size", options.Size, LargestPicture);
  const tool::View view = tool::ParseView(options.View);
  const std::string extension = tool::Extension(options.Output);
  if (extension != ".png" && extension != ".exr")
  {
    throw tool::UsageError(options.Output + ": the picture must end in .png or .exr");
  }
  options.Method.Check(command);

  const tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(options.Environment);
  const vtkSmartPointer<vtkPolyData> mesh =
    options.Mesh.empty() ? tool::MakeSphere() : tool::LoadMesh(options.Mesh);
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
  scene.SetMesh(mesh);
  scene.SetView(view.Azimuth, view.Elevation, RenderedFill, view.Angle);
  const int factor = GetFactor(options, size);
  std::vector<double> frames;
  std::string plan;
  if (!onCpu)
  {
    scene.ModelOcclusion(GetOcclusionMode(options.Occlusion), options.Trace.Bounces > 0);
    scene.Open(size.Width, size.Height);
    scene.Begin(method, environment, options.Method.Plan);
    plan = scene.GetPlan();
    NoteUnmodeled(plan);
    if (options.Method.Plan.ForView)
    {
      scene.HoldPlan(method, environment); // for the larger picture, too
    }
  }
  const double setup = elapsed();
  double spent = 0.0;
  for (int k = 0;
       !onCpu && !options.Report.empty() && k < NumberOfTimedFrames && spent < TimedFramesBudget;
       ++k)
  {
    frames.push_back(scene.TimeFrame());
    spent += frames.back();
  }
  tool::Picture picture = onCpu ? SumPixels(method.Integrator, mesh, view, size,
                                    options.Method.Method == "traced" ? &options.Trace : nullptr)
                                : scene.Render(factor * size.Width, factor * size.Height);
  if (onCpu)
  {
    frames.push_back(elapsed() - setup);
  }
  if (!options.Report.empty())
  {
    WriteReport(options, { setup, frames, size, plan }, material, environment, method, scene);
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
  command->add_option("--environment", options->Environment, EnvironmentHelp)->required();
  AddProjectionOption(command);
  command->add_option("--mesh", options->Mesh,
    "Mesh to show it on: ply, stl, obj, vtp, vtk, gltf or glb, or 'ball-on-foot', which is built "
    "in "
    "(default: a sphere). A mesh without normals gets smooth ones");
  options->Method.Method = "auto";
  options->Method.AddTo(command, true, true);
  options->Trace.AddTo(command);
  command
    ->add_option("--occlusion", options->Occlusion,
      "What the mesh hides of the environment from itself: auto models it as the mapper does in a "
      "program, where its predicted error exceeds what the tolerance leaves, for up to 20,000 "
      "points; on: on any mesh, by every method but sums over lights; off: never, as --method "
      "reference (default: auto)")
    ->check(CLI::IsMember({ "auto", "on", "off" }));
  options->Method.Plan.AddForViewTo(command);
  command->add_option(
    "--size", options->Size, "Picture size in pixels, WIDTHxHEIGHT (default 800x800)");
  command->add_option("--view", options->View,
    "Where to look from, AZIMUTH,ELEVATION[,ANGLE] in degrees: azimuth 0 is from +z, 90 from +x; "
    "elevation is above the horizon; ANGLE is the vertical angle of view (default 30,20,30)");
  command->add_option("--exposure", options->Exposure,
    "Brighten (or darken) the picture by this many stops; default 0: unchanged physical values");
  command
    ->add_option("--background", options->Background,
      "environment or none (default: environment in .png, none, with alpha 0, in .exr)")
    ->check(CLI::IsMember({ "environment", "none" }));
  command
    ->add_option("-o,--output", options->Output,
      "Picture to write: .png (8 bit, as displayed) or .exr (linear float RGBA)")
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
