// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Methods.h"

#include "RunWithProgress.h"
#include "Tool.h"

#include "vtkBasisRadianceIntegrator.h"
#include "vtkDoubleArray.h"
#include "vtkExactRadianceIntegrator.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkRadianceCostCalibrator.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace
{
constexpr double LeastTolerance = 1e-3; // of vtkRadiancePlanner
constexpr int PairsOfView = 512;        // at most

struct SizeRange
{
  const char* Name;
  int Least;
  int Largest;
};

// What --sizes gives, in this order; later ones may be left out. The ranges are the integrators'.
const std::map<std::string, std::vector<SizeRange>> SizesOf = {
  { "table", { { "rows", 9, 513 }, { "view angles", 2, 64 }, { "azimuths", 4, 64 } } },
  { "hybrid", { { "rows", 9, 513 }, { "view angles", 2, 64 }, { "azimuths", 4, 64 },
                { "samples", 0, 1024 }, { "lights", 0, 1024 } } },
  { "filtered", { { "samples", 1, 1024 } } },
  { "basis", { { "functions", 1, 256 }, { "map size", 8, 128 } } }
};

const std::map<std::string, std::string> MethodHelp = {
  { "exact", "the sum over every texel of the environment, slow" },
  { "light-set", "a sum over a set of lights that replaces the environment" },
  { "thesis",
    "a sum over such lights of the material in a basis or, where that rings, as a D-BRDF fit" },
  { "basis", "maps over the normal, one for each function of a basis of the material" },
  { "filtered", "a few samples of the environment, blurred to their spacing" },
  { "table", "a precomputed table of outgoing radiance" },
  { "hybrid",
    "a precomputed table for broad reflection, samples for sharp highlights, lights for bright "
    "sources" },
  { "auto", "the cheapest that meets --tolerance" }
};

//------------------------------------------------------------------------------
std::vector<int> ParseSizes(const std::string& method, const std::string& text)
{
  const auto found = SizesOf.find(method);
  if (found == SizesOf.end())
  {
    throw tool::UsageError(
      "--sizes: has no effect without --method table, hybrid, filtered or basis");
  }
  std::string wanted;
  for (const SizeRange& size : found->second)
  {
    wanted += (wanted.empty() ? "" : ",") + std::string(size.Name) + " in [" +
              std::to_string(size.Least) + "-" + std::to_string(size.Largest) + "]";
  }
  const auto fail = [&]()
  {
    throw tool::UsageError(
      "--sizes: '" + text + "' is not " + wanted + " (--method " + method + ")");
  };
  std::vector<int> sizes;
  const char* at = text.data();
  const char* end = at + text.size();
  for (const SizeRange& range : found->second)
  {
    int value = 0;
    const auto parsed = std::from_chars(at, end, value);
    if (parsed.ec != std::errc() || value < range.Least || value > range.Largest)
    {
      fail();
    }
    sizes.push_back(value);
    at = parsed.ptr;
    if (at == end)
    {
      return sizes;
    }
    if (*at++ != ',')
    {
      fail();
    }
  }
  fail();
  return sizes;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> NewIntegrator(
  const tool::MethodOptions& options, vtkEnvironment* environment)
{
  const std::vector<int> sizes =
    options.Sizes.empty() ? std::vector<int>() : ParseSizes(options.Method, options.Sizes);
  if (options.Method == "exact")
  {
    return vtkSmartPointer<vtkExactRadianceIntegrator>::New();
  }
  if (options.Method == "basis")
  {
    auto basis = vtkSmartPointer<vtkBasisRadianceIntegrator>::New();
    basis->SetMaximumNumberOfTerms(!sizes.empty() ? sizes[0] : basis->GetMaximumNumberOfTerms());
    basis->SetMapSize(sizes.size() > 1 ? sizes[1] : basis->GetMapSize());
    return basis;
  }
  if (options.Method == "filtered")
  {
    auto filtered = vtkSmartPointer<vtkFilteredRadianceIntegrator>::New();
    filtered->SetNumberOfSamples(!sizes.empty() ? sizes[0] : filtered->GetNumberOfSamples());
    return filtered;
  }
  if (options.Method == "table")
  {
    auto table = vtkSmartPointer<vtkTableRadianceIntegrator>::New();
    table->SetNumberOfRows(!sizes.empty() ? sizes[0] : table->GetNumberOfRows());
    table->SetNumberOfViewAngles(sizes.size() > 1 ? sizes[1] : table->GetNumberOfViewAngles());
    table->SetNumberOfAzimuths(sizes.size() > 2 ? sizes[2] : table->GetNumberOfAzimuths());
    return table;
  }
  if (options.Method == "hybrid")
  {
    auto hybrid = vtkSmartPointer<vtkHybridRadianceIntegrator>::New();
    const auto size = [&sizes](std::size_t k, int otherwise)
    { return k < sizes.size() ? sizes[k] : otherwise; };
    hybrid->SetNumberOfRows(size(0, hybrid->GetNumberOfRows()));
    hybrid->SetNumberOfViewAngles(size(1, hybrid->GetNumberOfViewAngles()));
    hybrid->SetNumberOfAzimuths(size(2, hybrid->GetNumberOfAzimuths()));
    hybrid->SetNumberOfSamples(size(3, hybrid->GetNumberOfSamples()));
    hybrid->SetMaximumNumberOfLights(size(4, hybrid->GetMaximumNumberOfLights()));
    return hybrid;
  }
  auto lights = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  lights->SetLightSet(tool::MakeLightSet(environment, options.Lights));
  lights->SetSoftLights(options.Lights.Soft);
  return lights;
}

//------------------------------------------------------------------------------
// About the up axis, as the mapper takes them where the data has none.
vtkSmartPointer<vtkDoubleArray> MakeTangents(const std::vector<double>& normals)
{
  auto tangents = vtkSmartPointer<vtkDoubleArray>::New();
  tangents->SetNumberOfComponents(3);
  for (std::size_t k = 0; k < normals.size(); k += 3)
  {
    const double x = normals[k + 2];
    const double z = -normals[k];
    const bool pole = std::hypot(x, z) <= 1e-6 * std::abs(normals[k + 1]);
    tangents->InsertNextTuple3(pole ? 1.0 : x, 0.0, pole ? 0.0 : z);
  }
  return tangents;
}

//------------------------------------------------------------------------------
// 3 components each.
vtkNew<vtkDoubleArray> ToArray(const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfComponents(3);
  for (std::size_t k = 0; k < values.size(); k += 3)
  {
    array->InsertNextTuple(&values[k]);
  }
  return array;
}
}

namespace tool
{
//------------------------------------------------------------------------------
void MethodOptions::AddTo(CLI::App* command, const std::vector<std::string>& methods)
{
  std::string help;
  for (const std::string& name : methods)
  {
    help +=
      (help.empty() ? "" : "; ") + name +
      (name == this->Method
          ? " (default" +
              std::string(name == "auto" ? ", unless options for lights are given" : "") + "): "
          : ": ") +
      MethodHelp.at(name);
  }
  command->add_option("--method", this->Method, help)->check(CLI::IsMember(methods));
  AddToleranceOption(command, this->Plan.Tolerance);
  command->add_option("--sizes", this->Sizes,
    "Sizes of --method table (ROWS,VIEW_ANGLES,AZIMUTHS, default 65,16,16), hybrid (the same, "
    "SAMPLES,LIGHTS, default 33,12,16,8,16), filtered (SAMPLES, default 32) or basis "
    "(FUNCTIONS,MAP_SIZE, default 64,48)");
  this->Lights.AddTo(command, "--lights");
  this->Lights.AddSoftTo(command);
  this->Thesis.AddTo(command);
}

//------------------------------------------------------------------------------
void MethodOptions::Check(const CLI::App* command)
{
  const auto given = [&](const char* name) { return command->count(name) > 0; };
  if (this->Method == "auto" && !given("--method") &&
      (given("--lights") || given("--light-set") || given("--seed") || given("--soft-lights")))
  {
    this->Method = "light-set";
  }
  CheckTolerance(this->Plan.Tolerance);
  for (const char* name : { "--tolerance", "--calibrate", "--no-cache", "--for-view" })
  {
    if (command->get_option_no_throw(name) && given(name) && this->Method != "auto")
    {
      PrintNote(std::string(name) + " has no effect without --method auto");
    }
  }
  this->Thesis.Check(command, this->Method);
  if (this->HasLights())
  {
    this->Lights.Check();
  }
  if (given("--sizes"))
  {
    ParseSizes(this->Method, this->Sizes);
  }
}

//------------------------------------------------------------------------------
void PlanOptions::AddCalibrateTo(CLI::App* command)
{
  command->add_flag("--calibrate", this->Calibrate,
    "Plan with the cost of each method on this machine's OpenGL renderer, measured in about a "
    "second or read from disk, instead of built-in figures for Mesa's software renderer");
}

//------------------------------------------------------------------------------
void PlanOptions::AddForViewTo(CLI::App* command)
{
  command->add_flag("--for-view", this->ForView,
    "Plan for the normals, the views and the number of pixels of this picture, instead of for a "
    "sphere seen from everywhere");
}

//------------------------------------------------------------------------------
void PlanOptions::Look(vtkPolyData* mesh, const View& view, double fill, const Size& size)
{
  if (this->ForView)
  {
    this->Seen = FindSurface(mesh, view, fill, size, PairsOfView);
  }
}

//------------------------------------------------------------------------------
void AddToleranceOption(CLI::App* command, double& tolerance)
{
  command->add_option("--tolerance", tolerance,
    "Error that a plan has to stay below, relative to the mean radiance (relative L1), from 0.001 "
    "to 1 (default " +
      FormatNumber(tolerance) + ")");
}

//------------------------------------------------------------------------------
void CheckTolerance(double tolerance)
{
  if (!(tolerance >= LeastTolerance && tolerance <= 1.0))
  {
    throw UsageError(
      "--tolerance: " + FormatNumber(tolerance) + " is not between 0.001 and 1, like 0.02");
  }
}

//------------------------------------------------------------------------------
int Method::GetNumberOfLights() const
{
  auto* lights = vtkLightSetRadianceIntegrator::SafeDownCast(this->Integrator);
  return lights && lights->GetLightSet() ? lights->GetLightSet()->GetNumberOfLights() : 0;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadiancePlanner> MakePlan(
  const Material& material, vtkEnvironment* environment, const PlanOptions& options)
{
  vtkNew<vtkRadianceCostCalibrator> calibrator; // its model as it comes is the built-in one
  if (options.Calibrate &&
      !RunWithProgress(calibrator.Get(), &vtkRadianceCostCalibrator::Calibrate, "calibrating"))
  {
    throw Error("--calibrate: " + TakeErrorText());
  }
  auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
  planner->SetCostModel(calibrator->GetCostModel());
  planner->SetCacheFolder(
    options.UseCache ? vtkRadiancePlanner::GetDefaultCacheFolder() : std::string());
  planner->SetBRDF(material.BRDF);
  planner->SetEnvironment(environment);
  planner->SetErrorTolerance(options.Tolerance);
  planner->SetEvaluateAll(options.All);
  if (!options.Seen.Pixels.empty())
  {
    planner->SetNumberOfPixels(options.Seen.NumberOfCovered);
    if (!planner->SetPairs(ToArray(options.Seen.Normals), ToArray(options.Seen.Views)))
    {
      throw Error("--for-view: the picture shows only " +
                  FormatCount(options.Seen.Pixels.size(), "pixel") + " of the mesh");
    }
  }
  if (!RunWithProgress(planner.Get(), &vtkRadiancePlanner::Update, "planning"))
  {
    throw Error(material.File + ": planning: " + TakeErrorText());
  }
  return planner;
}

//------------------------------------------------------------------------------
Method MakeMethod(
  const MethodOptions& options, const Material& material, vtkEnvironment* environment)
{
  Method made;
  made.BRDF = material.BRDF;
  if (options.Method == "auto")
  {
    made.Planner = MakePlan(material, environment, options.Plan);
    made.Integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(made.Planner->NewIntegrator());
    return made;
  }
  if (options.Method == "thesis")
  {
    made.Thesis = RepresentAsThesis(material, options.Thesis);
    made.BRDF = made.Thesis.BRDF;
  }
  made.Integrator = NewIntegrator(options, environment);
  made.Integrator->SetBRDF(made.BRDF);
  made.Integrator->SetEnvironment(environment);
  if (!RunWithProgress(made.Integrator.Get(), &vtkRadianceIntegrator::Prepare, "preparing"))
  {
    throw Error(material.File + ": --method " + options.Method + ": " + TakeErrorText());
  }
  return made;
}

//------------------------------------------------------------------------------
std::vector<double> IntegratePairs(vtkRadianceIntegrator* integrator,
  const std::vector<double>& normals, const std::vector<double>& views)
{
  const vtkNew<vtkDoubleArray> n = ToArray(normals);
  const vtkNew<vtkDoubleArray> v = ToArray(views);
  vtkNew<vtkDoubleArray> radiance;
  const vtkSmartPointer<vtkDoubleArray> tangents =
    integrator->GetBRDF()->IsIsotropic() ? nullptr : MakeTangents(normals);
  const bool done = RunWithProgress(
    integrator,
    [&](vtkRadianceIntegrator* made) { return made->Integrate(n, v, radiance, tangents); },
    "integrating");
  if (!done)
  {
    throw Error("integrating: " + TakeErrorText());
  }
  std::vector<double> rgb(normals.size());
  for (std::size_t k = 0; k < rgb.size(); ++k)
  {
    rgb[k] = radiance->GetValue(static_cast<vtkIdType>(k));
  }
  return rgb;
}
} // namespace tool
