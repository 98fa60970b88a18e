// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartMethods.h"

#include "Tool.h"

#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkRadianceMethods.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>

namespace
{
using tool::MethodOptions;

using Apply = std::function<void(const std::string& size, MethodOptions& options)>;

//------------------------------------------------------------------------------
Apply ApplyLights(const std::string& set, bool soft = false)
{
  return [set, soft](const std::string& size, MethodOptions& options)
  {
    options.Method = "light-set";
    options.Lights.Method = set;
    options.Lights.Count = std::atoi(size.c_str());
    options.Lights.Soft = soft;
  };
}

//------------------------------------------------------------------------------
Apply ApplySizes(const std::string& method)
{
  return [method](const std::string& size, MethodOptions& options)
  {
    options.Method = method;
    options.Sizes = size;
  };
}

//------------------------------------------------------------------------------
// LIGHTS,ORDER
void ApplyThesis(const std::string& size, MethodOptions& options)
{
  options.Method = "thesis";
  options.Lights.Count = std::atoi(size.c_str());
  options.Thesis.Order = std::atoi(size.substr(size.find(',') + 1).c_str());
}

//------------------------------------------------------------------------------
void ApplyPlanner(const std::string& tolerance, MethodOptions& options)
{
  options.Method = "auto";
  options.Plan.Tolerance = std::atof(tolerance.c_str());
}

//------------------------------------------------------------------------------
// What a method of somebody else's would have a planner try, as --sizes takes it.
std::vector<std::string> ListSizes(vtkRadianceIntegrator* method)
{
  const auto asked = vtkSmartPointer<vtkRadianceIntegrator>::Take(method->NewCopy());
  vtkNew<vtkLambertBRDF> brdf;
  vtkNew<vtkEnvironment> environment;
  environment->SetToProceduralSky();
  asked->SetBRDF(brdf);
  asked->SetEnvironment(environment);
  std::vector<std::string> sizes;
  for (const std::vector<int>& candidate : asked->GetCandidateSizes(true))
  {
    std::string text;
    for (const int size : candidate)
    {
      text += (text.empty() ? "" : ",") + std::to_string(size);
    }
    sizes.push_back(text);
  }
  return sizes;
}

//------------------------------------------------------------------------------
// A curve for each method that has none yet.
void AddOthers(std::vector<tool::ChartMethod>& methods)
{
  const tool::RGB colors[] = { { 0.55, 0.34, 0.29 }, { 0.50, 0.50, 0.0 }, { 0.0, 0.50, 0.50 } };
  std::size_t others = 0;
  for (const auto& method : vtkRadianceMethods::GetMethods())
  {
    const std::string name = method->GetMethodName();
    const bool known = tool::IsOnCpuOnly(name) || name == "light-set" || // which has three curves
                       std::any_of(methods.begin(), methods.end(),
                         [&name](const tool::ChartMethod& other) { return other.Name == name; });
    const std::vector<std::string> sizes = known ? std::vector<std::string>() : ListSizes(method);
    if (!sizes.empty())
    {
      methods.push_back({ name, name, colors[others++ % std::size(colors)], false,
        { sizes.front(), sizes.back() }, sizes, ApplySizes(name) });
    }
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
static std::vector<ChartMethod> MakeChartMethods()
{
  // Colors that stay apart for every kind of color vision (Okabe and Ito 2008; violet is not
  // theirs).
  std::vector<ChartMethod> known = {
    { "table", "radiance table", { 0.0, 0.45, 0.70 }, false, { "17,8,8", "33,12,16", "65,12,16" },
      { "9,6,8", "17,8,8", "33,12,16", "33,24,16", "65,8,8", "65,12,16", "65,24,24", "129,8,8",
        "129,12,16", "257,12,16" },
      ApplySizes("table") },
    { "hybrid", "hybrid", { 0.45, 0.26, 0.65 }, false, { "33,12,16,0", "128,12,8,8" },
      { "17,8,8,0", "33,8,8,0", "33,12,16,0", "65,8,8,0", "65,12,16,0", "129,8,8,0", "64,12,8,8",
        "128,12,8,8", "128,12,8,16", "256,12,8,8" },
      ApplySizes("hybrid") },
    { "filtered", "filtered samples", { 0.80, 0.47, 0.65 }, true, { "4", "16", "64" },
      { "4", "8", "16", "32", "64", "128", "256" }, ApplySizes("filtered") },
    { "soft-lights", "soft lights", { 0.90, 0.62, 0.0 }, true, { "16", "64", "256" },
      { "4", "16", "64", "256", "1024", "4096" }, ApplyLights("variance", true) },
    { "median-cut", "median cut", { 0.84, 0.37, 0.0 }, true, { "16", "64", "256" },
      { "4", "16", "64", "256", "1024", "4096" }, ApplyLights("median-cut") },
    { "importance", "random lights", { 0.34, 0.71, 0.91 }, true, { "64" },
      { "4", "16", "64", "256", "1024", "4096" }, ApplyLights("importance") },
    // Its own size first: the first of each is never left out.
    { ThesisMethod, "thesis", { 0.35, 0.35, 0.35 }, true, { "64,6", "16,6" },
      { "64,6", "16,6", "4,6", "64,2", "64,12", "256,6" }, ApplyThesis },
    { PBRMethod, "VTK's PBR", { 0.0, 0.0, 0.0 }, false, { "" }, { "" }, nullptr },
    { PlannerMethod, "planner", { 0.0, 0.0, 0.0 }, false, {}, {}, ApplyPlanner },
  };
  AddOthers(known);
  return known;
}

//------------------------------------------------------------------------------
const std::vector<ChartMethod>& GetChartMethods()
{
  static const std::vector<ChartMethod> methods = MakeChartMethods();
  return methods;
}

//------------------------------------------------------------------------------
const ChartMethod& FindChartMethod(const std::string& name)
{
  std::string known;
  for (const ChartMethod& method : GetChartMethods())
  {
    if (method.Name == name)
    {
      return method;
    }
    known += (known.empty() ? "" : ", ") + method.Name;
  }
  throw UsageError("--methods: '" + name + "' is none of " + known);
}

//------------------------------------------------------------------------------
bool IsInView(const std::string& size) { return size.find(InView) != std::string::npos; }

//------------------------------------------------------------------------------
bool IsInteracting(const std::string& size) { return size.find(Interacting) != std::string::npos; }

//------------------------------------------------------------------------------
std::vector<ChartSize> ListChartSizes(const std::vector<std::string>& methods,
  const std::vector<double>& tolerances, bool full, bool forView)
{
  for (const std::string& name : methods)
  {
    FindChartMethod(name);
  }
  std::vector<ChartSize> list;
  for (const ChartMethod& method : GetChartMethods())
  {
    const bool always = method.Name == PBRMethod;
    if (!always && std::find(methods.begin(), methods.end(), method.Name) == methods.end())
    {
      continue;
    }
    for (const std::string& size : full ? method.AllSizes : method.FewSizes)
    {
      list.push_back({ &method, size, {} });
      if (method.Apply)
      {
        method.Apply(size, list.back().Options);
      }
    }
  }
  // A name of its own: newer compilers fear that the reference is into a temporary.
  const std::string plannerName = PlannerMethod;
  const ChartMethod& planner = FindChartMethod(plannerName);
  for (const double tolerance : tolerances)
  {
    list.push_back({ &planner, FormatNumber(tolerance), {} });
    planner.Apply(list.back().Size, list.back().Options);
  }
  for (const double tolerance : forView ? tolerances : std::vector<double>())
  {
    list.push_back({ &planner, FormatNumber(tolerance) + InView, {} });
    planner.Apply(list.back().Size, list.back().Options);
    list.back().Options.Plan.ForView = true;
  }
  return list;
}
} // namespace tool
