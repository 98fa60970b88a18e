// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTracedRadianceIntegrator.h"

#include "ParallelFor.h"
#include "Setters.h"
#include "TakenError.h"
#include "TracedRadiance.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTracedScene.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace
{
using measuredbrdf::SurfacePoint;
using measuredbrdf::TracedRadiance;

constexpr int FewestSamples = 8;
constexpr int MostSamples = 1 << 24;
constexpr int MostBounces = 1000;
// What the calling thread waits for between two looks at the abort flag and the progress.
constexpr std::chrono::milliseconds BatchTime(100);
constexpr double OpenShare = 0.5; // of the progress, where the reference is integrated first

bool Fits(vtkDataArray* array, int components, vtkIdType count)
{
  return array && array->GetNumberOfComponents() == components &&
         array->GetNumberOfTuples() == count;
}

// Unit length; zero where that is not possible.
glm::dvec3 GetUnit(vtkDataArray* array, vtkIdType k)
{
  glm::dvec3 d(0.0);
  if (array)
  {
    array->GetTuple(k, &d.x);
  }
  const double largest = std::max({ std::abs(d.x), std::abs(d.y), std::abs(d.z) });
  return largest > 0.0 && std::isfinite(d.x + d.y + d.z) ? glm::normalize(d / largest)
                                                         : glm::dvec3(0.0);
}

void Put(const std::vector<glm::dvec3>& values, vtkDataArray* array)
{
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    array->SetTuple(static_cast<vtkIdType>(k), &values[k].x);
  }
  array->Modified();
}

double Sum(const glm::dvec3& rgb) { return rgb.x + rgb.y + rgb.z; }

// What samples say of light that is known as a whole: the visible share of it, channel by channel.
glm::dvec3 GetVisible(const glm::dvec3& whole, const glm::dvec3& open, const glm::dvec3& visible)
{
  const double share = Sum(open) > 0.0 ? Sum(visible) / Sum(open) : 1.0;
  glm::dvec3 result;
  for (int c = 0; c < 3; ++c)
  {
    result[c] = whole[c] * (open[c] > 0.0 ? visible[c] / open[c] : share);
  }
  return result;
}
} // namespace

/// One call of Integrate.
struct vtkTracedRadianceIntegrator::Run
{
  std::vector<TracedRadiance::Receiver> Receivers; // null material: nothing to integrate
  std::unique_ptr<TracedRadiance> Tracer;
  std::vector<glm::dvec3> Open; // by the reference; empty: from the samples
  std::vector<glm::dvec3> Radiance;
  std::vector<glm::dvec3> Unoccluded;
  std::vector<double> Errors;
};

vtkStandardNewMacro(vtkTracedRadianceIntegrator);

//------------------------------------------------------------------------------
vtkTracedRadianceIntegrator::vtkTracedRadianceIntegrator() = default;
vtkTracedRadianceIntegrator::~vtkTracedRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkCxxSetSmartPointerMacro(vtkTracedRadianceIntegrator, Scene, vtkTracedScene);
vtkCxxSetSmartPointerMacro(vtkTracedRadianceIntegrator, BRDF, vtkBRDF);
vtkCxxSetSmartPointerMacro(vtkTracedRadianceIntegrator, Environment, vtkEnvironment);
measuredbrdfSetClampedMacro(vtkTracedRadianceIntegrator, NumberOfBounces, int, 0, MostBounces);

//------------------------------------------------------------------------------
void vtkTracedRadianceIntegrator::SetNumberOfSamples(int value)
{
  const int taken = value == 0 ? 0 : std::clamp(value, FewestSamples, MostSamples);
  if (taken != value)
  {
    vtkWarningMacro("SetNumberOfSamples: " << value << " is neither 0 nor from " << FewestSamples
                                           << " to " << MostSamples << "; " << taken
                                           << " is taken.");
  }
  if (this->NumberOfSamples != taken)
  {
    this->NumberOfSamples = taken;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkTracedScene* vtkTracedRadianceIntegrator::GetScene() { return this->Scene; }
vtkBRDF* vtkTracedRadianceIntegrator::GetBRDF() { return this->BRDF; }
vtkEnvironment* vtkTracedRadianceIntegrator::GetEnvironment() { return this->Environment; }

//------------------------------------------------------------------------------
void vtkTracedRadianceIntegrator::SetSurfaceBRDF(int surface, vtkBRDF* brdf)
{
  if (brdf)
  {
    this->SurfaceBRDFs[surface] = brdf;
  }
  else
  {
    this->SurfaceBRDFs.erase(surface);
  }
  this->Modified();
}

//------------------------------------------------------------------------------
vtkBRDF* vtkTracedRadianceIntegrator::GetSurfaceBRDF(int surface)
{
  const auto own = this->SurfaceBRDFs.find(surface);
  return own != this->SurfaceBRDFs.end() ? own->second : this->BRDF;
}

//------------------------------------------------------------------------------
bool vtkTracedRadianceIntegrator::Report(double progress)
{
  this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
  return !this->Abort;
}

//------------------------------------------------------------------------------
bool vtkTracedRadianceIntegrator::Check(
  vtkPolyData* points, vtkDataArray* views, vtkDataArray* tangents)
{
  if (!this->Scene || !this->Environment || this->Environment->GetPixels().empty())
  {
    vtkErrorMacro("Integrate: there is no scene or no environment, or the environment is empty.");
    return false;
  }
  for (int k = 0; k < std::max(this->Scene->GetNumberOfSurfaces(), 1); ++k)
  {
    if (!this->GetSurfaceBRDF(k))
    {
      vtkErrorMacro("Integrate: surface " << k << " has no BRDF.");
      return false;
    }
  }
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  if (!points || !Fits(views, 3, count) || (tangents && !Fits(tangents, 3, count)) ||
      !Fits(points->GetPointData()->GetNormals(), 3, count))
  {
    vtkErrorMacro("Integrate: points with normals, as many views and, if any, tangents are needed, "
                  "with 3 components each.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkTracedRadianceIntegrator::Integrate(vtkPolyData* points, vtkDataArray* views,
  vtkDataArray* radiance, vtkDataArray* unoccluded, vtkDataArray* tangents)
{
  this->Abort = false;
  if (!radiance || !this->Check(points, views, tangents))
  {
    if (!radiance)
    {
      vtkErrorMacro("Integrate: radiance is needed.");
    }
    return false;
  }
  std::vector<vtkBRDF*> materials;
  for (int k = 0; k < std::max(this->Scene->GetNumberOfSurfaces(), 1); ++k)
  {
    materials.push_back(this->GetSurfaceBRDF(k));
    materials.back()->Prepare();
  }
  Run run;
  run.Tracer =
    std::make_unique<TracedRadiance>(this->Scene->GetSurfaces(), this->Environment, materials);
  vtkPointData* data = points->GetPointData();
  const vtkIdType count = points->GetNumberOfPoints();
  vtkDataArray* facets = data->GetArray("FacetNormals");
  vtkDataArray* surfaces = data->GetArray("Surface");
  for (vtkIdType k = 0; k < count; ++k)
  {
    SurfacePoint point;
    points->GetPoint(k, &point.Position.x);
    point.Normal = GetUnit(data->GetNormals(), k);
    point.Facet = Fits(facets, 3, count) ? GetUnit(facets, k) : point.Normal;
    const double surface = Fits(surfaces, 1, count) ? surfaces->GetTuple1(k) : 0.0;
    const glm::dvec3 view = GetUnit(views, k);
    const bool valid = surface >= 0.0 && surface < static_cast<double>(materials.size()) &&
                       point.Normal != glm::dvec3(0.0) && view != glm::dvec3(0.0) &&
                       std::isfinite(glm::dot(point.Position, point.Position));
    vtkBRDF* material = valid ? materials[static_cast<std::size_t>(surface)] : nullptr;
    run.Receivers.push_back(run.Tracer->MakeReceiver(point, material, view, GetUnit(tangents, k)));
  }
  if (!(this->UnoccludedReference && this->NumberOfSamples > 0 && !this->IntegrateOpen(run)) &&
      this->Trace(run))
  {
    Put(run.Radiance, radiance);
    if (unoccluded)
    {
      Put(run.Unoccluded, unoccluded);
    }
    return true;
  }
  vtkErrorMacro("Integrate: aborted.");
  return false;
}

//------------------------------------------------------------------------------
// The reference without occlusion, material by material.
bool vtkTracedRadianceIntegrator::IntegrateOpen(Run& run)
{
  run.Open.assign(run.Receivers.size(), glm::dvec3(0.0));
  std::map<vtkBRDF*, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < run.Receivers.size(); ++k)
  {
    if (run.Receivers[k].Material)
    {
      groups[run.Receivers[k].Material].push_back(k);
    }
  }
  double done = 0.0;
  for (const auto& [material, members] : groups)
  {
    vtkNew<vtkAdaptiveRadianceIntegrator> reference;
    reference->SetBRDF(material);
    reference->SetEnvironment(this->Environment);
    const double share =
      OpenShare * static_cast<double>(members.size()) / static_cast<double>(run.Receivers.size());
    const auto follow = [&](double progress) { return this->Report(done + share * progress); };
    using Follow = decltype(follow);
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(const_cast<void*>(static_cast<const void*>(&follow)));
    command->SetCallback(
      [](vtkObject* caller, unsigned long, void* self, void* progress)
      {
        static_cast<vtkRadianceIntegrator*>(caller)->SetAbort(
          !(*static_cast<Follow*>(self))(*static_cast<double*>(progress)));
      });
    reference->AddObserver(vtkCommand::ProgressEvent, command);
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec3> views;
    std::vector<glm::dvec3> tangents;
    for (const std::size_t k : members)
    {
      const TracedRadiance::Receiver& receiver = run.Receivers[k];
      normals.push_back(receiver.Point.Normal);
      views.push_back(receiver.Local * receiver.View);
      tangents.push_back(receiver.Local[0]);
    }
    vtkNew<vtkDoubleArray> arrays[4];
    Put(normals, arrays[0]);
    Put(views, arrays[1]);
    Put(tangents, arrays[2]);
    const measuredbrdf::TakenError aborted(reference); // Integrate says it
    if (!reference->Integrate(arrays[0], arrays[1], arrays[3], arrays[2]))
    {
      return false;
    }
    for (std::size_t k = 0; k < members.size(); ++k)
    {
      arrays[3]->GetTuple(static_cast<vtkIdType>(k), &run.Open[members[k]].x);
    }
    done += share;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkTracedRadianceIntegrator::Trace(Run& run)
{
  const std::size_t count = run.Receivers.size();
  run.Radiance.assign(count, glm::dvec3(0.0));
  run.Unoccluded.assign(count, glm::dvec3(0.0));
  run.Errors.assign(count, 0.0);
  const TracedRadiance::Settings settings{ this->NumberOfSamples, this->NumberOfBounces,
    static_cast<std::uint32_t>(this->Seed) };
  const auto integrate = [&](std::size_t k)
  {
    const TracedRadiance::Receiver& receiver = run.Receivers[k];
    if (!receiver.Material)
    {
      return;
    }
    const auto index = static_cast<std::uint32_t>(k);
    const TracedRadiance::Sums sums = settings.Samples > 0
                                        ? run.Tracer->Sample(receiver, index, settings)
                                        : run.Tracer->SumTexels(receiver, index, settings);
    const bool open = !run.Open.empty();
    run.Unoccluded[k] = open ? run.Open[k] : sums.Open[0] + sums.Open[1];
    const glm::dvec3 visible = sums.Visible[0] + sums.Visible[1];
    run.Radiance[k] =
      sums.Bounced[0] + sums.Bounced[1] +
      (open ? GetVisible(run.Open[k], sums.Open[0] + sums.Open[1], visible) : visible);
    glm::dvec3 halves[2];
    for (std::size_t h = 0; h < 2; ++h)
    {
      halves[h] =
        2.0 * sums.Bounced[h] +
        (open ? GetVisible(run.Open[k], sums.Open[h], sums.Visible[h]) : 2.0 * sums.Visible[h]);
    }
    run.Errors[k] = settings.Samples > 0 ? 0.5 * Sum(glm::abs(halves[0] - halves[1])) : 0.0;
  };
  const double begun = run.Open.empty() ? 0.0 : OpenShare;
  std::size_t batch = 1;
  for (std::size_t first = 0; first < count;)
  {
    const std::size_t size = std::min(batch, count - first);
    const auto start = std::chrono::steady_clock::now();
    measuredbrdf::ParallelFor(static_cast<vtkIdType>(first), static_cast<vtkIdType>(first + size),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end && !this->Abort; ++k)
        {
          integrate(static_cast<std::size_t>(k));
        }
      });
    first += size;
    if (std::chrono::steady_clock::now() - start < BatchTime / 2)
    {
      batch *= 2;
    }
    const double share = static_cast<double>(first) / static_cast<double>(count);
    if (!this->Report(begun + (1.0 - begun) * share))
    {
      return false;
    }
  }
  double error = 0.0;
  double radiance = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    error += run.Errors[k];
    radiance += Sum(run.Radiance[k]);
  }
  this->Noise = radiance > 0.0 ? error / radiance : 0.0;
  return true;
}

//------------------------------------------------------------------------------
void vtkTracedRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scene: " << this->Scene.Get() << "\n";
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "SurfaceBRDFs: " << this->SurfaceBRDFs.size() << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "NumberOfBounces: " << this->NumberOfBounces << "\n";
  os << indent << "UnoccludedReference: " << (this->UnoccludedReference ? "On" : "Off") << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Noise: " << this->Noise << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
}
