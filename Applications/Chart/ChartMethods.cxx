// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartMethods.h"

#include "Tool.h"

#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkRadianceMethods.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace
{
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
std::vector<tool::ChartMethod> MakeChartMethods()
{
  // Colors that stay apart for every kind of color vision (Okabe and Ito 2008; violet is not
  // theirs).
  const std::vector<std::string> lights = { "4", "16", "64", "256", "1024", "4096" };
  std::vector<tool::ChartMethod> made = {
    { "table", "radiance table", { 0.0, 0.45, 0.70 }, false, { "17,8,8", "33,12,16", "65,12,16" },
      { "9,6,8", "17,8,8", "33,12,16", "33,24,16", "65,8,8", "65,12,16", "65,24,24", "129,8,8",
        "129,12,16", "257,12,16" } },
    { "hybrid", "hybrid", { 0.45, 0.26, 0.65 }, false, { "33,12,16,0", "128,12,8,8" },
      { "17,8,8,0", "33,8,8,0", "33,12,16,0", "65,8,8,0", "65,12,16,0", "129,8,8,0", "64,12,8,8",
        "128,12,8,8", "128,12,8,16", "256,12,8,8" } },
    { "filtered", "filtered samples", { 0.80, 0.47, 0.65 }, true, { "4", "16", "64" },
      { "4", "8", "16", "32", "64", "128", "256" } },
    { "soft-lights", "soft lights", { 0.90, 0.62, 0.0 }, true, { "16", "64", "256" }, lights },
    { "median-cut", "median cut", { 0.84, 0.37, 0.0 }, true, { "16", "64", "256" }, lights },
    { "importance", "random lights", { 0.34, 0.71, 0.91 }, true, { "64" }, lights },
    // Lights and order. The usual size is the first one, which is never left out.
    { "thesis", "thesis", { 0.35, 0.35, 0.35 }, true, { "64,6", "16,6" },
      { "64,6", "16,6", "4,6", "64,2", "64,12", "256,6" } },
    { tool::PBRMethod, "VTK's PBR", { 0.0, 0.0, 0.0 }, false, { "" }, { "" } },
    { tool::PlannerMethod, "planner", { 0.0, 0.0, 0.0 }, false, {}, {} }
  };
  const tool::RGB colors[] = { { 0.55, 0.34, 0.29 }, { 0.50, 0.50, 0.0 }, { 0.0, 0.50, 0.50 } };
  std::size_t others = 0;
  for (const auto& method : vtkRadianceMethods::GetMethods())
  {
    const std::string name = method->GetMethodName();
    const bool known = tool::IsOnCpuOnly(name) || name == "light-set" || // which has three curves
                       std::any_of(made.begin(), made.end(),
                         [&name](const tool::ChartMethod& other) { return other.Name == name; });
    const std::vector<std::string> sizes = known ? std::vector<std::string>() : ListSizes(method);
    if (!sizes.empty())
    {
      made.push_back({ name, name, colors[others++ % std::size(colors)], false,
        { sizes.front(), sizes.back() }, sizes });
    }
  }
  return made;
}
}

namespace tool
{
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
MethodOptions ChartSize::MakeOptions() const
{
  const std::string& name = this->Method->Name;
  const int first = std::atoi(this->Size.c_str());
  MethodOptions options;
  options.Method = name;
  if (name == PlannerMethod)
  {
    options.Method = "auto";
    options.Plan.Tolerance = std::atof(this->Size.c_str());
    options.Plan.ForView = this->Size.find(InView) != std::string::npos;
  }
  else if (name == "thesis")
  {
    options.Lights.Count = first;
    options.Order = std::atoi(this->Size.substr(this->Size.find(',') + 1).c_str());
  }
  else if (name == "soft-lights" || name == "median-cut" || name == "importance")
  {
    const bool soft = name == "soft-lights";
    options.Method = "light-set";
    options.Lights = { first, soft ? "variance" : name, 1, soft };
  }
  else
  {
    options.Sizes = this->Size;
  }
  return options;
}

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
    if (method.Name == PBRMethod ||
        std::find(methods.begin(), methods.end(), method.Name) != methods.end())
    {
      for (const std::string& size : full ? method.AllSizes : method.FewSizes)
      {
        list.push_back({ &method, size });
      }
    }
  }
  // A name of its own: newer compilers fear that the reference is into a temporary.
  const std::string plannerName = PlannerMethod;
  const ChartMethod& planner = FindChartMethod(plannerName);
  for (const char* view : { "", InView })
  {
    for (const double tolerance : tolerances)
    {
      if (forView || *view == '\0')
      {
        list.push_back({ &planner, FormatNumber(tolerance) + view });
      }
    }
  }
  return list;
}
} // namespace tool
