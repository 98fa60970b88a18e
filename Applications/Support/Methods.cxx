// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Methods.h"

#include "NumberText.h"
#include "Options.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkBRDFResampler.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBasisBRDF.h"
#include "vtkBasisProjector.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkRadianceMethods.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

namespace tool
{
//------------------------------------------------------------------------------
std::string DescribeForm(vtkBRDF* brdf)
{
  vtkBRDFShaderInputs inputs;
  brdf->GetShaderInputs(inputs);
  return inputs.Description;
}

//------------------------------------------------------------------------------
Advice Advise(vtkBRDF* brdf, int order, const double* zone, const std::string& name)
{
  constexpr double limit = 0.10;
  constexpr int pairs = 1 << 14;
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(brdf);
  projector->SetBasis(vtkBasisBRDF::ZONAL);
  projector->SetOrder(order);
  projector->SetIncidentZone(zone);
  projector->SetOutgoingZone(zone);
  if (!RunWithProgress(projector.Get(), &vtkBasisProjector::Project, "measuring"))
  {
    throw Error((name.empty() ? brdf->GetName() : name) + ": " + TakeErrorText());
  }
  vtkBasisBRDF* basis = projector->GetOutput();
  Advice advice;
  advice.InZoneResidual = vtkBRDFResampler::GetZoneRelativeL2Error(brdf, basis, zone, zone, pairs);
  advice.NegativeMass = basis->GetNegativeMass(zone, zone, pairs);
  advice.IsBasis = advice.InZoneResidual <= limit;
  advice.Reason = std::string(advice.IsBasis ? "basis" : "fit") + ": at order " +
                  std::to_string(order) + " over " + FormatNumber(zone[0]) + " to " +
                  FormatNumber(zone[1]) + " degrees the residual is " +
                  measuredbrdf::FixedText(100.0 * advice.InZoneResidual, 1) + " % (limit " +
                  FormatNumber(100.0 * limit) + " %), the negative mass " +
                  measuredbrdf::FixedText(100.0 * advice.NegativeMass, 2) + " %";
  return advice;
}

//------------------------------------------------------------------------------
Representation Represent(const Material& material, int order)
{
  if (vtkBasisBRDF::SafeDownCast(material.BRDF))
  {
    return { material.BRDF, "basis", DescribeForm(material.BRDF), "basis: it is in one already" };
  }
  const Advice advice = Advise(material.BRDF, order, DeviceZone, material.File);
  const auto represent = [&](auto* maker, auto run) -> Representation
  {
    maker->SetInput(material.BRDF);
    if (!RunWithProgress(maker, run, "representing"))
    {
      throw Error(material.File + ": " + TakeErrorText());
    }
    vtkBRDF* output = maker->GetOutput();
    return { output, advice.IsBasis ? "basis" : "fit", DescribeForm(output), advice.Reason };
  };
  if (!advice.IsBasis)
  {
    return represent(vtkNew<vtkDistributionBRDFFitter>().Get(), &vtkBRDFFitter::Fit);
  }
  vtkNew<vtkBasisProjector> projector;
  projector->SetBasis(vtkBasisBRDF::SPHERICAL_HARMONICS);
  projector->SetOrder(order);
  return represent(projector.Get(), &vtkBasisProjector::Project);
}

namespace
{
const char* const Auto = "auto";
const char* const Thesis = "thesis";
const char* const Traced = "traced";
const char* const LightSet = "light-set";

//------------------------------------------------------------------------------
// The sizes that --sizes gives; none of methods that have options of their own.
std::vector<vtkRadianceIntegrator::Size> GetSizes(const std::string& method)
{
  const auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(
    method == LightSet ? nullptr : vtkRadianceMethods::NewIntegrator(method));
  return integrator ? integrator->GetSizes() : std::vector<vtkRadianceIntegrator::Size>();
}

//------------------------------------------------------------------------------
// "table (ROWS,VIEW_ANGLES,AZIMUTHS, default 65,16,16)" of each.
std::string DescribeSizes()
{
  std::string text;
  for (const auto& method : vtkRadianceMethods::GetMethods())
  {
    std::string names;
    std::string values;
    for (const auto& size : GetSizes(method->GetMethodName()))
    {
      std::string name = size.Name;
      std::transform(name.begin(), name.end(), name.begin(),
        [](unsigned char c) { return c == ' ' ? '_' : static_cast<char>(std::toupper(c)); });
      names += (names.empty() ? "" : ",") + name;
      values += (values.empty() ? "" : ",") + std::to_string(size.Value);
    }
    if (!names.empty())
    {
      text += (text.empty() ? "" : ", ") + method->GetMethodName() + " (" + names + ", default " +
              values + ")";
    }
  }
  return text;
}

//------------------------------------------------------------------------------
// What --method takes, with a line on each.
std::vector<std::pair<std::string, std::string>> ListMethods(bool onCpu, bool traced)
{
  std::vector<std::pair<std::string, std::string>> methods;
  for (const auto& method : vtkRadianceMethods::GetMethods())
  {
    const std::string name = method->GetMethodName();
    if (onCpu || !tool::IsOnCpuOnly(name))
    {
      methods.emplace_back(name, method->GetMethodDescription());
    }
  }
  methods.emplace_back(
    Thesis, "a sum over lights of the material in a basis or, where that rings, as a D-BRDF fit");
  if (traced)
  {
    methods.emplace_back(
      Traced, "the reference with what the mesh hides of the environment, by rays, slow");
  }
  methods.emplace_back(Auto, "what the planner finds for --tolerance, from cheap to costly");
  return methods;
}

//------------------------------------------------------------------------------
std::vector<int> ParseSizes(const std::string& method, const std::string& text)
{
  const std::vector<vtkRadianceIntegrator::Size> ranges = GetSizes(method);
  if (ranges.empty())
  {
    throw tool::UsageError("--sizes: has no effect with --method " + method);
  }
  std::string wanted;
  for (const vtkRadianceIntegrator::Size& size : ranges)
  {
    wanted += (wanted.empty() ? "" : ",") + size.Name + " in [" + std::to_string(size.Least) + "-" +
              std::to_string(size.Largest) + "]";
  }
  std::vector<int> sizes;
  std::istringstream stream(text);
  stream >> std::noskipws;
  for (const vtkRadianceIntegrator::Size& range : ranges)
  {
    int value = 0;
    if (!(stream >> value) || value < range.Least || value > range.Largest)
    {
      break;
    }
    sizes.push_back(value);
    const int next = stream.get();
    if (next == std::istringstream::traits_type::eof())
    {
      return sizes;
    }
    if (next != ',')
    {
      break;
    }
  }
  throw tool::UsageError("--sizes: '" + text + "' is not " + wanted + " (--method " + method + ")");
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> NewIntegrator(
  const tool::MethodOptions& options, vtkEnvironment* environment)
{
  if (options.HasLights())
  {
    auto lights = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
    lights->SetLightSet(tool::MakeLightSet(environment, options.Lights));
    lights->SetSoftLights(options.Lights.Soft);
    return lights;
  }
  auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(vtkRadianceMethods::NewIntegrator(
    options.Method == Traced ? "reference" : options.Method)); // the light that is hidden or not
  if (!options.Sizes.empty())
  {
    integrator->SetSizes(ParseSizes(options.Method, options.Sizes));
  }
  return integrator;
}
}

//------------------------------------------------------------------------------
void MethodOptions::AddTo(CLI::App* command, bool onCpu, bool forView, bool traced)
{
  std::string help;
  std::vector<std::string> names;
  for (const auto& [name, description] : ListMethods(onCpu, traced))
  {
    names.push_back(name);
    help += (help.empty() ? "" : "; ") + name +
            (name != this->Method ? ": "
              : name == Auto      ? " (default, unless options for lights are given): "
                                  : " (default): ") +
            description;
  }
  command->add_option("--method", this->Method, help)->check(CLI::IsMember(names));
  this->Plan.AddTo(command, forView);
  command->add_option("--sizes", this->Sizes, "Sizes of --method " + DescribeSizes());
  this->Lights.AddTo(command, "--lights");
  command->add_flag("--soft-lights", this->Lights.Soft,
    "Make each light as wide as its region, so that sharp lobes show no dots; lights "
    "of --light-set importance have no width");
  command
    ->add_option("--order", this->Order,
      "Order of the basis of --method thesis (default " + std::to_string(this->Order) +
        ": 49 functions)")
    ->check(CLI::Range(1, static_cast<int>(vtkBasisBRDF::MaximumOrder)));
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
  for (const char* name : { "--tolerance", "--maximum-cost", "--for-view" })
  {
    if (command->get_option_no_throw(name) && given(name) && this->Method != "auto")
    {
      PrintNote(std::string(name) + " has no effect without --method auto");
    }
  }
  if (given("--order") && this->Method != Thesis)
  {
    throw UsageError("--order: has no effect without --method thesis");
  }
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
void PlanOptions::AddTo(CLI::App* command, bool forView)
{
  command
    ->add_option("--tolerance", this->Tolerance,
      "Error that a plan has to stay below, relative to the mean radiance (relative L1), from "
      "0.001 "
      "to 1 (default " +
        FormatNumber(this->Tolerance) + ")")
    ->check(Between(1e-3, 1.0)); // as vtkRadiancePlanner
  command
    ->add_option("--maximum-cost", this->MaximumCost,
      "What a pixel of a plan may cost, times a table's, from 1 to 1e6 (default " +
        FormatNumber(this->MaximumCost) + ", which allows all methods)")
    ->check(Between(1.0, 1e6));
  if (forView)
  {
    command->add_flag("--for-view", this->ForView,
      "Plan for the normals and the views of this picture, instead of for a sphere seen from "
      "everywhere");
  }
}

//------------------------------------------------------------------------------
bool IsOnCpuOnly(const std::string& method) { return method == "reference" || method == Traced; }

//------------------------------------------------------------------------------
int Method::GetNumberOfLights() const
{
  auto* lights = vtkLightSetRadianceIntegrator::SafeDownCast(this->Integrator);
  return lights && lights->GetCurrentLightSet() ? lights->GetCurrentLightSet()->GetNumberOfLights()
                                                : 0;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadiancePlanner> MakePlan(const Material& material, vtkEnvironment* environment,
  const PlanOptions& options, const VisiblePairs* seen)
{
  auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
  planner->SetBRDF(material.BRDF);
  planner->SetEnvironment(environment);
  planner->SetErrorTolerance(options.Tolerance);
  planner->SetMaximumCost(options.MaximumCost);
  planner->SetEvaluateAll(options.All);
  if (seen && !planner->SetPairs(seen->Normals, seen->Views))
  {
    throw Error("--for-view: the picture shows hardly anything of the mesh");
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
  if (options.Method == Auto)
  {
    return made;
  }
  if (options.Method == Thesis)
  {
    made.Thesis = Represent(material, options.Order);
    PrintNote(material.Name + ": " + made.Thesis.Reason);
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
vtkSmartPointer<vtkRadianceIntegrator> MakeIntegrator(
  const MethodOptions& options, const Material& material, vtkEnvironment* environment)
{
  if (options.Method != Auto)
  {
    return MakeMethod(options, material, environment).Integrator;
  }
  return vtkSmartPointer<vtkRadianceIntegrator>::Take(
    MakePlan(material, environment, options.Plan)->NewIntegrator());
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDoubleArray> MakeArray(const std::vector<double>& values, int components)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

//------------------------------------------------------------------------------
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
std::vector<double> ToVector(vtkDoubleArray* array)
{
  return { array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues() };
}

//------------------------------------------------------------------------------
std::vector<double> IntegratePairs(vtkRadianceIntegrator* integrator,
  const std::vector<double>& normals, const std::vector<double>& views,
  const std::function<void(double)>& show)
{
  if (!show)
  {
    ProgressBar bar("integrating");
    return IntegratePairs(integrator, normals, views, [&bar](double share) { bar.Update(share); });
  }
  const vtkSmartPointer<vtkDoubleArray> n = MakeArray(normals, 3);
  const vtkSmartPointer<vtkDoubleArray> v = MakeArray(views, 3);
  vtkNew<vtkDoubleArray> radiance;
  const vtkSmartPointer<vtkDoubleArray> tangents =
    integrator->GetBRDF()->IsIsotropic() ? nullptr : MakeTangents(normals);
  const bool done = RunWithProgress(
    integrator,
    [&](vtkRadianceIntegrator* made) { return made->Integrate(n, v, radiance, tangents); }, show);
  if (!done)
  {
    throw Error("integrating: " + TakeErrorText());
  }
  return ToVector(radiance);
}
} // namespace tool
