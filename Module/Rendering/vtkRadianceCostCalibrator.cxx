// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadianceCostCalibrator.h"

#include "NumberText.h"
#include "SquareLayers.h"

#include "vtkActor.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceCostModel.h"
#include "vtkRadianceMethods.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <vector>

namespace
{
constexpr int Side = 512;           // of the window, pixels
constexpr int Frames = 5;           // that a time is the least of: other work only adds to it
constexpr double Enough = 5.0;      // ms above the empty frame, to be told from its jitter
constexpr double LeastBase = 0.1;   // of a pixel with one light
constexpr double LeastShare = 0.01; // of BASE, of any other cost

// What is drawn: a share of the window's side, and layers.
struct Load
{
  double Share;
  int Layers;

  double GetPixels() const { return this->Layers * (this->Share * Side) * (this->Share * Side); }
};
const Load Empty = { 1.0 / Side, 1 };
const Load Loads[] = { { 0.125, 1 }, { 0.25, 1 }, { 0.5, 1 }, { 1.0, 1 }, { 1.0, 4 }, { 1.0, 16 },
  { 1.0, 64 }, { 1.0, 256 } };

// Without lamps, which some methods draw as lights.
void SetToSmoothSky(vtkEnvironment* environment)
{
  constexpr int width = 64;
  constexpr int height = 32;
  std::vector<float> pixels;
  for (int k = 0; k < width * height; ++k)
  {
    const float up = static_cast<float>(k / width) / height;
    const float round = static_cast<float>(k % width) / width;
    pixels.insert(pixels.end(), { 0.5f + up, 0.7f + 0.5f * round * (1.0f - round), 1.2f - up });
  }
  environment->SetPixels(width, height, std::move(pixels));
}

// How much of a cost is in an integrator's: costs are linear in the model's.
double CountUnits(vtkRadianceIntegrator* integrator, const std::string& name)
{
  vtkNew<vtkRadianceCostModel> model;
  model->SetCost(name, 1.0);
  const double one = integrator->EstimateCost(model);
  model->SetCost(name, 2.0);
  return integrator->EstimateCost(model) - one;
}

// The methods that have a cost of their own: lights first, which tell the cost of the bare pixel.
std::vector<vtkSmartPointer<vtkRadianceIntegrator>> OrderForMeasuring()
{
  std::vector<vtkSmartPointer<vtkRadianceIntegrator>> methods;
  for (const vtkSmartPointer<vtkRadianceIntegrator>& method : vtkRadianceMethods::GetMethods())
  {
    if (!method->GetCostName().empty() && !method->GetCalibrationSizes().empty())
    {
      methods.push_back(method);
    }
  }
  std::stable_partition(methods.begin(), methods.end(),
    [](const vtkSmartPointer<vtkRadianceIntegrator>& method)
    { return method->GetCostName() == "light"; });
  return methods;
}

int NumberToMeasure()
{
  std::size_t number = 0;
  for (const vtkSmartPointer<vtkRadianceIntegrator>& method : OrderForMeasuring())
  {
    number += method->GetCalibrationSizes().size();
  }
  return static_cast<int>(number);
}

// "" where it has none.
std::string GetCapability(const std::string& report, const std::string& key)
{
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);)
  {
    if (line.compare(0, key.size(), key) == 0)
    {
      const std::size_t begin = line.find_first_not_of(' ', key.size());
      return begin == std::string::npos ? "" : line.substr(begin);
    }
  }
  return "";
}

// The patch in its window.
class Bench
{
public:
  explicit Bench(vtkRenderWindow* window)
    : Window(window)
  {
    SetToSmoothSky(this->Environment);
    this->BRDF->SetExponents(20.0, 20.0);
    this->BRDF->SetDiffuse(0.3, 0.3, 0.3);
    this->Mapper->SetBRDF(this->BRDF);
    this->Mapper->SetEnvironment(this->Environment);
    this->Mapper->AddObserver(vtkCommand::ErrorEvent, this, &Bench::TakeError);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->SetAutomaticLightCreation(false);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(1.0);
    camera->SetPosition(0.0, 0.0, 5.0);
    camera->SetClippingRange(1.0, 10.0);
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(Side, Side);
    window->AddRenderer(this->Renderer);
  }
  ~Bench() { this->Window->RemoveRenderer(this->Renderer); }
  Bench(const Bench&) = delete;
  void operator=(const Bench&) = delete;

  // Nanoseconds per pixel; 0 or less where they can't be told.
  double Measure(vtkRadianceIntegrator* integrator)
  {
    this->Mapper->SetIntegrator(integrator);
    this->Put(Empty);
    const double nothing = this->TimeFrames();
    double time = 0.0;
    double pixels = 1.0;
    for (const Load& load : Loads)
    {
      this->Put(load);
      time = this->TimeFrames() - nothing;
      pixels = load.GetPixels();
      if (time >= Enough)
      {
        break;
      }
    }
    return 1e6 * time / pixels;
  }

  // A method in one size, ready to be measured.
  vtkSmartPointer<vtkRadianceIntegrator> Make(
    vtkRadianceIntegrator* method, const std::vector<int>& sizes)
  {
    auto made = vtkSmartPointer<vtkRadianceIntegrator>::Take(method->NewCopy());
    made->SetSizes(sizes);
    made->SetBRDF(this->BRDF);
    made->SetEnvironment(this->Environment);
    if (auto* lights = vtkLightSetRadianceIntegrator::SafeDownCast(made))
    {
      lights->UnrolledOn(); // as hybrids draw their few lights
    }
    return made;
  }

  std::string Problem;

private:
  void TakeError(vtkObject*, unsigned long, void* text)
  {
    this->Problem = text ? static_cast<const char*>(text) : "";
  }

  // And one frame, for what is done once.
  void Put(const Load& load)
  {
    if (this->Layers != load.Layers)
    {
      this->Mapper->SetInputDataObject(measuredbrdf::MakeSquareLayers(load.Layers));
      this->Layers = load.Layers;
    }
    this->Actor->SetScale(load.Share, load.Share, 1.0);
    this->TimeFrame();
  }

  double TimeFrame()
  {
    const auto begin = std::chrono::steady_clock::now();
    this->Window->Render();
    this->Window->WaitForCompletion();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
  }

  double TimeFrames()
  {
    double least = this->TimeFrame();
    for (int k = 1; k < Frames; ++k)
    {
      least = std::min(least, this->TimeFrame());
    }
    return least;
  }

  vtkRenderWindow* Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkAshikhminShirleyBRDF> BRDF;
  vtkNew<vtkEnvironment> Environment;
  int Layers = 0;
};
}

struct vtkRadianceCostCalibrator::Internals
{
  int NumberMeasured = 0;
  vtkSmartPointer<vtkRenderWindow> Window;
  vtkNew<vtkRadianceCostModel> Model;
};

vtkStandardNewMacro(vtkRadianceCostCalibrator);

//------------------------------------------------------------------------------
vtkRadianceCostCalibrator::vtkRadianceCostCalibrator()
  : Impl(new Internals)
{
}

//------------------------------------------------------------------------------
vtkRadianceCostCalibrator::~vtkRadianceCostCalibrator() = default;

//------------------------------------------------------------------------------
void vtkRadianceCostCalibrator::SetRenderWindow(vtkRenderWindow* window)
{
  if (this->Impl->Window != window)
  {
    this->Impl->Window = window;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkRenderWindow* vtkRadianceCostCalibrator::GetRenderWindow() { return this->Impl->Window; }

//------------------------------------------------------------------------------
vtkRadianceCostModel* vtkRadianceCostCalibrator::GetCostModel() { return this->Impl->Model; }

//------------------------------------------------------------------------------
std::string vtkRadianceCostCalibrator::Measure(vtkRenderWindow* window, const std::string& name)
{
  Bench bench(window);
  this->Impl->NumberMeasured = 0;
  vtkNew<vtkRadianceCostModel> model;
  model->SetName(name);
  bool hasBase = false;
  for (const vtkSmartPointer<vtkRadianceIntegrator>& method : OrderForMeasuring())
  {
    // Nanoseconds per pixel and the units in it, for one or two sizes.
    const std::string cost = method->GetCostName();
    std::vector<double> pixel;
    std::vector<double> units;
    double known = 0.0; // costs of other names in the last one
    for (const std::vector<int>& sizes : method->GetCalibrationSizes())
    {
      const auto integrator = bench.Make(method, sizes);
      pixel.push_back(bench.Measure(integrator));
      units.push_back(CountUnits(integrator, cost));
      known = integrator->EstimateCost(model) - units.back() * model->GetCost(cost);
      double progress = static_cast<double>(++this->Impl->NumberMeasured) / NumberToMeasure();
      this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
      if (this->Abort)
      {
        return "aborted.";
      }
      if (!bench.Problem.empty())
      {
        return bench.Problem;
      }
    }
    double each = 0.0;
    if (!hasBase)
    {
      // Lights: what two numbers of them cost, and what is left without.
      each = (pixel[1] - pixel[0]) / (units[1] - units[0]);
      // On a busy machine the lights' own time may come out as more than there is.
      const double base = std::max(pixel[0] - units[0] * each, LeastBase * pixel[0]);
      if (!(base > 0.0))
      {
        return "frame times on " + name + " tell nothing: " + measuredbrdf::NumberText(pixel[0]) +
               " and " + measuredbrdf::NumberText(pixel[1]) + " ns per pixel with 1 and 64 lights.";
      }
      if (!model->SetCost("base", base))
      {
        return "a cost on " + name + " is out of range.";
      }
      hasBase = true;
    }
    else
    {
      each = (pixel.back() - known) / std::max(units.back(), 1.0);
    }
    if (!model->SetCost(cost, std::max(each, LeastShare * model->GetCost("base"))))
    {
      return "a cost on " + name + " is out of range.";
    }
  }
  this->Impl->Model->DeepCopy(model);
  return "";
}

//------------------------------------------------------------------------------
bool vtkRadianceCostCalibrator::Calibrate()
{
  this->Abort = false;
  vtkRenderWindow* given = this->Impl->Window;
  const bool wasCurrent = given && given->IsCurrent();
  auto window = given ? vtkSmartPointer<vtkRenderWindow>::Take(given->NewInstance())
                      : vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(Side, Side);
  if (given)
  {
    window->SetSharedRenderWindow(given);
  }
  window->Render(); // makes the context
  const std::string report = window->ReportCapabilities();
  const std::string name = GetCapability(report, "OpenGL renderer string:");
  std::string problem;
  if (name.empty())
  {
    problem = "there is no OpenGL context.";
  }
  else
  {
    problem = this->Measure(window, name);
  }
  if (wasCurrent)
  {
    given->MakeCurrent();
  }
  if (!problem.empty())
  {
    vtkErrorMacro("Calibrate: " << problem);
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkRadianceCostCalibrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RenderWindow: " << this->Impl->Window.Get() << "\n";
  os << indent << "CostModel:\n";
  this->Impl->Model->PrintSelf(os, indent.GetNextIndent());
}
