// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiancePlanner.h"

#include "EnvironmentPrecomputation.h"
#include "EnvironmentPyramid.h"
#include "LobeSplit.h"
#include "LowDiscrepancy.h"
#include "MaterialPrecomputation.h"
#include "PlanCache.h"
#include "PlanCandidate.h"
#include "PlanReference.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBasisRadianceIntegrator.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceCostModel.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkVarianceLightSetGenerator.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using measuredbrdf::CanPrune;
using measuredbrdf::GetSizesText;
using Candidate = measuredbrdf::PlanCandidate;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int Pairs = 512;
constexpr vtkIdType FewestPairs = 16;
constexpr vtkIdType MostPairs = 4096;

constexpr int MaximumLights = 16;
// Lamps of many texels are one light each (degrees), or several where more than so much of the
// albedo lies in lobes narrower than twice that.
constexpr double LampAngle = 1.2;
constexpr double FineLampAngle = 0.6;
constexpr double NarrowShare = 0.05;
constexpr double FarAway = 3.0; // times the tolerance: where samples of the sharp layer are tried
constexpr double WorthIt = 0.9; // of another's error, to be worth more cost

constexpr std::size_t LargestCount = 100;
constexpr vtkIdType SmallTexture = 4000000; // bytes; the reason says why a plan takes more

const char* const Names[] = { "light-set", "basis", "filtered", "table", "hybrid" };

// An environment's pyramid in 16 bits, with its levels and their borders.
vtkIdType GetPyramidBytes(vtkEnvironment* environment)
{
  const vtkIdType size = measuredbrdf::EnvironmentPyramid::ChooseSize(environment);
  return 6 * (size + 2) * (2 * size + 24);
}

std::string Percent(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.2g %%", 100.0 * value);
  return text;
}

// Hands a planner's abort on to an integrator at work for it, whose errors it keeps.
class AbortForwarder
{
public:
  AbortForwarder(
    vtkRadiancePlanner* planner, vtkRadianceIntegrator* integrator, std::string& problem)
    : Planner(planner)
    , Integrator(integrator)
    , Problem(problem)
  {
    this->Tags[0] =
      integrator->AddObserver(vtkCommand::ProgressEvent, this, &AbortForwarder::OnProgress);
    this->Tags[1] = integrator->AddObserver(vtkCommand::ErrorEvent, this, &AbortForwarder::OnError);
  }
  ~AbortForwarder()
  {
    this->Integrator->RemoveObserver(this->Tags[0]);
    this->Integrator->RemoveObserver(this->Tags[1]);
  }
  AbortForwarder(const AbortForwarder&) = delete;
  void operator=(const AbortForwarder&) = delete;

private:
  void OnProgress(vtkObject*, unsigned long, void*)
  {
    if (this->Planner->GetAbort())
    {
      this->Integrator->SetAbort(true);
    }
  }
  void OnError(vtkObject*, unsigned long, void* text)
  {
    this->Problem = text ? static_cast<const char*>(text) : "";
  }

  vtkRadiancePlanner* Planner;
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
  std::string& Problem;
  unsigned long Tags[2];
};

// What an integrator may share with others while it prepares.
void SetParts(vtkRadianceIntegrator* integrator,
  const std::shared_ptr<measuredbrdf::MaterialPrecomputation>& parts)
{
  if (auto* table = vtkTableRadianceIntegrator::SafeDownCast(integrator))
  {
    table->SetParts(parts);
  }
  else if (auto* hybrid = vtkHybridRadianceIntegrator::SafeDownCast(integrator))
  {
    hybrid->SetParts(parts);
  }
}

// What takes long to make of an integrator, if anything.
std::string GetPrepared(vtkRadianceIntegrator* integrator)
{
  if (auto* table = vtkTableRadianceIntegrator::SafeDownCast(integrator))
  {
    return table->GetPrepared();
  }
  auto* hybrid = vtkHybridRadianceIntegrator::SafeDownCast(integrator);
  return hybrid ? hybrid->GetPrepared() : "";
}

bool TakePrepared(vtkRadianceIntegrator* integrator, const std::string& bytes)
{
  if (auto* table = vtkTableRadianceIntegrator::SafeDownCast(integrator))
  {
    return table->TakePrepared(bytes);
  }
  auto* hybrid = vtkHybridRadianceIntegrator::SafeDownCast(integrator);
  return !hybrid || hybrid->TakePrepared(bytes);
}

double GetMilliseconds(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
    .count();
}
} // namespace

struct vtkRadiancePlanner::Internals
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkSmartPointer<vtkRadianceCostModel> Costs; // null: the defaults
  std::string Problem;                         // that an integrator had

  // What a camera sees, if that was said.
  vtkSmartPointer<vtkDoubleArray> GivenNormals;
  vtkSmartPointer<vtkDoubleArray> GivenViews;

  std::shared_ptr<measuredbrdf::MaterialPrecomputation> Parts; // while it plans

  // What the candidates are measured against.
  vtkNew<vtkDoubleArray> Normals;
  vtkNew<vtkDoubleArray> Views;
  std::vector<double> Weights; // of the pairs; none: 1 each
  vtkNew<vtkDoubleArray> Reference;

  std::vector<Candidate> Candidates;
  int Choice = -1;
  bool Meets = false;
  std::string Reason;
  vtkTimeStamp Time;

  vtkMTimeType GetInputsMTime(vtkObject* planner) const
  {
    return std::max({ planner->GetMTime(), this->BRDF->GetMTime(),
      this->Environment->GetPixelsMTime(), this->Costs ? this->Costs->GetMTime() : 0 });
  }

  std::vector<double> GetCosts()
  {
    const auto model = this->Costs ? this->Costs : vtkSmartPointer<vtkRadianceCostModel>::New();
    std::vector<double> costs;
    for (int type = 0; type < vtkRadianceCostModel::NUMBER_OF_COSTS; ++type)
    {
      costs.push_back(model->GetCost(type));
    }
    return costs;
  }

  // Everything that a plan depends on; "" where the material doesn't say what it is.
  std::string GetCacheKey(vtkRadiancePlanner* planner)
  {
    const std::string material = this->BRDF->GetContentKey();
    if (material.empty())
    {
      return "";
    }
    measuredbrdf::ContentHash hash;
    hash.AddText(measuredbrdf::GetPlanVersion());
    hash.AddText(material);
    measuredbrdf::AddContent(hash, this->Environment);
    hash.AddValue(planner->GetErrorTolerance());
    hash.AddValue(planner->GetMaximumTextureBytes());
    hash.AddValue(planner->GetEvaluateAll());
    hash.Add(planner->GetViewDirection(), 3 * sizeof(double));
    hash.AddValue(planner->GetNumberOfPixels());
    for (vtkDoubleArray* given : { this->GivenNormals.Get(), this->GivenViews.Get() })
    {
      if (given)
      {
        hash.Add(given->GetPointer(0),
          static_cast<std::size_t>(given->GetNumberOfValues()) * sizeof(double));
      }
    }
    if (this->GivenNormals)
    {
      double rotation[9];
      this->Environment->GetWorldToEnvironment(rotation);
      for (const double value : rotation)
      {
        hash.AddValue(value + 0.0); // -0 and 0 turn alike
      }
    }
    const std::vector<double> costs = this->GetCosts();
    hash.Add(costs.data(), costs.size() * sizeof(double));
    return hash.GetText();
  }

  // One line per candidate, the choice, the reason, then the table's bytes.
  void WritePlan(const std::string& folder, const std::string& key, std::uint64_t maximumBytes)
  {
    std::ostringstream text;
    text.precision(17);
    text << this->Candidates.size() << " " << this->Choice << " " << this->Meets << "\n";
    for (const Candidate& candidate : this->Candidates)
    {
      text << candidate.Method << " " << candidate.Sizes[0] << " " << candidate.Sizes[1] << " "
           << candidate.Sizes[2] << " " << candidate.Sizes[3] << " " << candidate.Lights << " "
           << candidate.LightAngle << " " << candidate.Cost << " " << candidate.Error << " "
           << candidate.Bytes << " " << candidate.SetUp << "\n";
    }
    text << this->Reason << "\n";
    text << GetPrepared(this->Candidates[static_cast<std::size_t>(this->Choice)].Integrator);
    measuredbrdf::WriteCache(folder, key, text.str(), maximumBytes);
  }

  bool ReadPlan(const std::string& folder, const std::string& key)
  {
    std::string contents;
    if (!measuredbrdf::ReadCache(folder, key, contents))
    {
      return false;
    }
    std::istringstream text(contents);
    std::size_t count = 0;
    int choice = -1;
    bool meets = false;
    text >> count >> choice >> meets;
    if (!text || count > LargestCount || choice < 0 || choice >= static_cast<int>(count))
    {
      return false;
    }
    std::vector<Candidate> candidates(count, Candidate(TABLE, 0));
    for (Candidate& candidate : candidates)
    {
      text >> candidate.Method >> candidate.Sizes[0] >> candidate.Sizes[1] >> candidate.Sizes[2] >>
        candidate.Sizes[3] >> candidate.Lights >> candidate.LightAngle >> candidate.Cost >>
        candidate.Error >> candidate.Bytes >> candidate.SetUp;
      if (!text || candidate.Method < LIGHT_SET || candidate.Method > HYBRID)
      {
        return false;
      }
    }
    std::string reason;
    std::getline(text >> std::ws, reason);
    if (!text || text.eof()) // the line has no end
    {
      return false;
    }
    Candidate& chosen = candidates[static_cast<std::size_t>(choice)];
    vtkSmartPointer<vtkRadianceIntegrator> integrator = this->Make(chosen);
    if (!TakePrepared(integrator, contents.substr(static_cast<std::size_t>(text.tellg()))))
    {
      return false;
    }
    chosen.Integrator = integrator;
    this->Candidates = candidates;
    this->Choice = choice;
    this->Meets = meets;
    this->Reason = reason;
    return true;
  }

  double ChooseLampAngle(const std::atomic<bool>& abort)
  {
    const double radius = vtkMath::RadiansFromDegrees(2.0 * LampAngle);
    const measuredbrdf::LobeSplit cut(
      this->Parts->GetViews(this->BRDF, abort), Pi * radius * radius);
    return cut.GetSharpShare() > NarrowShare ? FineLampAngle : LampAngle;
  }

  int CountLamps(vtkRadiancePlanner* planner, double angle)
  {
    const auto lamps =
      this->Environment->GetParts().GetLamps(this->Environment, vtkMath::RadiansFromDegrees(angle),
        MaximumLights, [planner]() { return !planner->GetAbort(); });
    return lamps ? static_cast<int>(lamps->Lights.size()) : 0;
  }

  // Normals as a sphere shows them to a distant camera, uniform over its disc: but half of them
  // crowd to the rim, where radiance is steep, and count less there.
  void DrawPairs(int count, const double wanted[3])
  {
    this->Normals->Initialize();
    this->Views->Initialize();
    this->Normals->SetNumberOfComponents(3);
    this->Views->SetNumberOfComponents(3);
    for (int k = 0; k < count; ++k)
    {
      const unsigned int index = static_cast<unsigned int>(k + 1);
      glm::dvec3 view(wanted[0], wanted[1], wanted[2]);
      if (!(glm::length(view) > 0.0))
      {
        const double z = 2.0 * measuredbrdf::RadicalInverse(index, 5) - 1.0;
        const double phi = 2.0 * Pi * measuredbrdf::RadicalInverse(index, 7);
        const double s = std::sqrt(std::max(1.0 - z * z, 0.0));
        view = glm::dvec3(s * std::cos(phi), z, s * std::sin(phi));
      }
      view = glm::normalize(view);
      const glm::dvec3 any =
        std::abs(view.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
      const glm::dvec3 u = glm::normalize(glm::cross(any, view));
      const glm::dvec3 v = glm::cross(view, u);
      // The view's cosine by the density 2 c of a disc, or by 1 / (2 sqrt(c)).
      const double x = measuredbrdf::RadicalInverse(index, 2);
      const double c = x < 0.5 ? std::sqrt(2.0 * x) : (2.0 * x - 1.0) * (2.0 * x - 1.0);
      this->Weights.push_back(2.0 * c / (c + 0.25 / std::sqrt(std::max(c, 1e-6))));
      const double r = std::sqrt(1.0 - c * c);
      const double phi = 2.0 * Pi * measuredbrdf::RadicalInverse(index, 3);
      const glm::dvec3 n = r * std::cos(phi) * u + r * std::sin(phi) * v + c * view;
      this->Normals->InsertNextTuple(&n.x);
      this->Views->InsertNextTuple(&view.x);
    }
  }

  bool MakeReference(vtkRadiancePlanner* planner)
  {
    this->Weights.clear();
    if (this->GivenNormals)
    {
      this->Normals->DeepCopy(this->GivenNormals);
      this->Views->DeepCopy(this->GivenViews);
    }
    else
    {
      this->DrawPairs(Pairs, planner->GetViewDirection());
    }
    vtkNew<measuredbrdf::PlanReference> reference;
    reference->SetBRDF(this->BRDF);
    reference->SetEnvironment(this->Environment);
    reference->SetErrorTolerance(planner->GetErrorTolerance());
    reference->SetParts(this->Parts);
    const AbortForwarder supervision(planner, reference, this->Problem);
    return reference->Integrate(this->Normals, this->Views, this->Reference);
  }

  vtkSmartPointer<vtkRadianceIntegrator> Make(const Candidate& candidate)
  {
    vtkSmartPointer<vtkRadianceIntegrator> made;
    switch (candidate.Method)
    {
      case LIGHT_SET:
      {
        vtkNew<vtkLightSetRadianceIntegrator> lights;
        lights->SetLightSet(this->Environment->GetParts().GetLightSet(
          this->Environment, nullptr, candidate.Sizes[0], []() { return true; }));
        lights->SetSoftLights(true);
        made = lights.Get();
        break;
      }
      case BASIS:
      {
        vtkNew<vtkBasisRadianceIntegrator> basis;
        basis->SetMaximumNumberOfTerms(candidate.Sizes[0]);
        made = basis.Get();
        break;
      }
      case FILTERED:
      {
        vtkNew<vtkFilteredRadianceIntegrator> filtered;
        filtered->SetNumberOfSamples(candidate.Sizes[0]);
        made = filtered.Get();
        break;
      }
      case HYBRID:
      {
        vtkNew<vtkHybridRadianceIntegrator> hybrid;
        hybrid->SetNumberOfRows(candidate.Sizes[0]);
        hybrid->SetNumberOfViewAngles(candidate.Sizes[1]);
        hybrid->SetNumberOfAzimuths(candidate.Sizes[2]);
        hybrid->SetNumberOfSamples(candidate.Sizes[3]);
        hybrid->SetMaximumNumberOfLights(MaximumLights);
        hybrid->SetLightAngle(candidate.LightAngle);
        made = hybrid.Get();
        break;
      }
      default:
      {
        vtkNew<vtkTableRadianceIntegrator> table;
        table->SetNumberOfRows(candidate.Sizes[0]);
        table->SetNumberOfViewAngles(candidate.Sizes[1]);
        table->SetNumberOfAzimuths(candidate.Sizes[2]);
        made = table.Get();
      }
    }
    made->SetBRDF(this->BRDF);
    made->SetEnvironment(this->Environment);
    return made;
  }

  // Prepare it and see how far it is from the reference.
  bool Try(vtkRadiancePlanner* planner, Candidate& candidate)
  {
    const auto start = std::chrono::steady_clock::now();
    candidate.Integrator = this->Make(candidate);
    const AbortForwarder supervision(planner, candidate.Integrator, this->Problem);
    vtkNew<vtkDoubleArray> radiance;
    SetParts(candidate.Integrator, this->Parts);
    const bool prepared = candidate.Integrator->Prepare();
    SetParts(candidate.Integrator, nullptr); // it may go to another thread
    if (!prepared)
    {
      return false;
    }
    candidate.SetUp = GetMilliseconds(start);
    if (candidate.Integrator->UsesBRDFOnGPU())
    {
      vtkBRDFShaderInputs form;
      form.SoftLights = candidate.Integrator->UsesSoftLights();
      this->BRDF->GetShaderInputs(form);
      candidate.Bytes += static_cast<vtkIdType>(form.GetTextureBytes());
    }
    if (!candidate.Integrator->Integrate(this->Normals, this->Views, radiance))
    {
      return false;
    }
    // One standard error on top of the mean: highlights are rare and decide.
    double sum = 0.0;
    double differences = 0.0;
    double squares = 0.0;
    const vtkIdType pairs = radiance->GetNumberOfTuples();
    for (vtkIdType k = 0; k < pairs; ++k)
    {
      const double weight =
        this->Weights.empty() ? 1.0 : this->Weights[static_cast<std::size_t>(k)];
      double difference = 0.0;
      for (int c = 0; c < 3; ++c)
      {
        difference +=
          weight * std::abs(radiance->GetComponent(k, c) - this->Reference->GetComponent(k, c));
        sum += weight * this->Reference->GetComponent(k, c);
      }
      differences += difference;
      squares += difference * difference;
    }
    const double variance =
      std::max(squares - differences * differences / static_cast<double>(pairs), 0.0);
    candidate.Error = sum > 0.0 ? (differences + std::sqrt(variance)) / sum : 0.0;
    return true;
  }

  // Why the choice takes much memory: what the largest of the small tables that were tried had.
  std::string ExplainMemory() const
  {
    const Candidate& chosen = this->Candidates[static_cast<std::size_t>(this->Choice)];
    const Candidate* small = nullptr;
    for (const Candidate& candidate : this->Candidates)
    {
      const bool fits = candidate.Method == TABLE && candidate.Bytes <= SmallTexture;
      small = fits && (!small || candidate.Bytes > small->Bytes) ? &candidate : small;
    }
    if (chosen.Bytes <= SmallTexture || !small)
    {
      return "";
    }
    const std::string needs = chosen.Method == TABLE
                                ? "gloss needs " + std::to_string(chosen.Sizes[0]) + " rows"
                                : "it needs more than a table";
    return "; " + needs + ": the largest table within 4 MB, " + GetSizesText(*small) + ", has " +
           Percent(small->Error);
  }
};

namespace
{
// Whatever way a run ends; plans outlive it, in mappers, and need no parts.
class ClearAtEnd
{
public:
  ClearAtEnd(std::atomic<bool>& flag, std::shared_ptr<measuredbrdf::MaterialPrecomputation>& parts)
    : Flag(flag)
    , Parts(parts)
  {
    this->Parts = std::make_shared<measuredbrdf::MaterialPrecomputation>();
  }
  ~ClearAtEnd()
  {
    this->Flag = false;
    this->Parts = nullptr;
  }
  ClearAtEnd(const ClearAtEnd&) = delete;
  void operator=(const ClearAtEnd&) = delete;

private:
  std::atomic<bool>& Flag;
  std::shared_ptr<measuredbrdf::MaterialPrecomputation>& Parts;
};
}

vtkStandardNewMacro(vtkRadiancePlanner);

//------------------------------------------------------------------------------
vtkRadiancePlanner::vtkRadiancePlanner()
  : Impl(new Internals)
{
}

//------------------------------------------------------------------------------
vtkRadiancePlanner::~vtkRadiancePlanner() = default;

//------------------------------------------------------------------------------
void vtkRadiancePlanner::SetBRDF(vtkBRDF* brdf)
{
  if (this->Impl->BRDF != brdf)
  {
    this->Impl->BRDF = brdf;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkBRDF* vtkRadiancePlanner::GetBRDF() { return this->Impl->BRDF; }

//------------------------------------------------------------------------------
void vtkRadiancePlanner::SetEnvironment(vtkEnvironment* environment)
{
  if (this->Impl->Environment != environment)
  {
    this->Impl->Environment = environment;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkEnvironment* vtkRadiancePlanner::GetEnvironment() { return this->Impl->Environment; }

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::SetPairs(vtkDataArray* normals, vtkDataArray* views)
{
  Internals& impl = *this->Impl;
  if (!normals && !views)
  {
    if (impl.GivenNormals)
    {
      impl.GivenNormals = nullptr;
      impl.GivenViews = nullptr;
      this->Modified();
    }
    return true;
  }
  const vtkIdType count = normals && views ? normals->GetNumberOfTuples() : 0;
  if (!views || count != views->GetNumberOfTuples() || count < FewestPairs || count > MostPairs ||
      normals->GetNumberOfComponents() != 3 || views->GetNumberOfComponents() != 3)
  {
    vtkErrorMacro("SetPairs: expected two arrays of as many tuples of 3, from "
                  << FewestPairs << " to " << MostPairs << ".");
    return false;
  }
  for (vtkIdType k = 0; k < count; ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      if (!std::isfinite(normals->GetComponent(k, c)) || !std::isfinite(views->GetComponent(k, c)))
      {
        vtkErrorMacro("SetPairs: pair " << k << " has a value that is not finite.");
        return false;
      }
    }
  }
  impl.GivenNormals = vtkSmartPointer<vtkDoubleArray>::New();
  impl.GivenNormals->DeepCopy(normals);
  impl.GivenViews = vtkSmartPointer<vtkDoubleArray>::New();
  impl.GivenViews->DeepCopy(views);
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
vtkIdType vtkRadiancePlanner::GetNumberOfPairs()
{
  return this->Impl->GivenNormals ? this->Impl->GivenNormals->GetNumberOfTuples() : 0;
}

//------------------------------------------------------------------------------
void vtkRadiancePlanner::SetCostModel(vtkRadianceCostModel* model)
{
  if (this->Impl->Costs != model)
  {
    this->Impl->Costs = model;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkRadianceCostModel* vtkRadiancePlanner::GetCostModel() { return this->Impl->Costs; }

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::Fail()
{
  const std::string problem =
    this->Impl->Problem.empty() ? "there is no reference to compare with." : this->Impl->Problem;
  vtkErrorMacro("Update: " << (this->Abort ? "aborted." : problem));
  return false;
}

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::Update()
{
  Internals& impl = *this->Impl;
  const ClearAtEnd clear(this->Abort, impl.Parts);
  impl.Problem.clear();
  if (!impl.BRDF || !impl.Environment || impl.Environment->GetPixels().empty())
  {
    vtkErrorMacro(
      "Update: " << (impl.BRDF ? "there is no environment, or it is empty." : "there is no BRDF."));
    return false;
  }
  if (impl.Choice >= 0 && impl.Time > impl.GetInputsMTime(this))
  {
    return true;
  }
  impl.BRDF->Prepare();
  this->FromCache = false;
  const std::string key = this->CacheFolder.empty() ? "" : impl.GetCacheKey(this);
  if (!key.empty() && impl.ReadPlan(this->CacheFolder, key))
  {
    this->FromCache = true;
    impl.Time.Modified();
    return true;
  }

  measuredbrdf::PlanConstraints wishes;
  wishes.IsIsotropic = impl.BRDF->IsIsotropic();
  wishes.All = this->EvaluateAll;
  if (wishes.IsIsotropic)
  {
    wishes.LightAngle = impl.ChooseLampAngle(this->Abort);
    wishes.Lights = impl.CountLamps(this, wishes.LightAngle);
  }
  wishes.PyramidBytes = GetPyramidBytes(impl.Environment);
  wishes.MaximumBytes = this->MaximumTextureBytes;
  wishes.Pixels = static_cast<double>(this->NumberOfPixels);
  const std::vector<Candidate> wanted = measuredbrdf::ListCandidates(wishes, impl.GetCosts());
  if (wanted.empty())
  {
    vtkErrorMacro(
      "Update: nothing fits into MaximumTextureBytes, " << this->MaximumTextureBytes << " bytes.");
    return false;
  }
  if (this->Abort || !impl.MakeReference(this))
  {
    return this->Fail();
  }
  // In their order until one is within the tolerance: but for those that look hopeless, the
  // largest of which are tried where nothing is.
  std::vector<Candidate> tried;
  std::map<int, Candidate> skipped; // the largest by method
  int choice = -1;
  bool meets = false;
  const auto attempt = [&](Candidate candidate)
  {
    if (!impl.Try(this, candidate))
    {
      return false;
    }
    tried.push_back(candidate);
    const int last = static_cast<int>(tried.size()) - 1;
    const double enough = meets        ? 0.0
                          : choice < 0 ? HUGE_VAL
                                       : WorthIt * tried[static_cast<std::size_t>(choice)].Error;
    if (!meets && candidate.Error <= this->ErrorTolerance)
    {
      meets = true;
      choice = last;
    }
    else if (candidate.Error < enough)
    {
      choice = last;
    }
    for (int other = 0; other <= last; ++other)
    {
      if (other != choice)
      {
        tried[static_cast<std::size_t>(other)].Integrator = nullptr;
      }
    }
    return true;
  };
  for (std::size_t k = 0; k < wanted.size() && !this->Abort; ++k)
  {
    const Candidate& candidate = wanted[k];
    // Others cost more.
    if (meets && !this->EvaluateAll)
    {
      break;
    }
    // Samples take long to set up.
    if (!this->EvaluateAll && candidate.Sizes[3] > 0 && choice >= 0 &&
        tried[static_cast<std::size_t>(choice)].Error < FarAway * this->ErrorTolerance)
    {
      continue;
    }
    if (!this->EvaluateAll && CanPrune(candidate, tried, this->ErrorTolerance))
    {
      const auto [found, isNew] = skipped.try_emplace(candidate.Method, candidate);
      if (!isNew && candidate.Sizes[0] >= found->second.Sizes[0])
      {
        found->second = candidate;
      }
    }
    else if (!attempt(candidate))
    {
      return this->Fail();
    }
    double progress = (k + 1.0) / static_cast<double>(wanted.size());
    this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
  }
  for (const auto& [method, candidate] : skipped)
  {
    const Candidate& best = tried[static_cast<std::size_t>(std::max(choice, 0))];
    const bool isLarger = candidate.Method != best.Method || candidate.Sizes[0] > best.Sizes[0];
    if (!meets && !this->Abort && isLarger && !CanPrune(candidate, tried, WorthIt * best.Error) &&
        !attempt(candidate))
    {
      return this->Fail();
    }
  }
  if (this->Abort)
  {
    return this->Fail();
  }
  impl.Candidates = tried;
  impl.Choice = choice;
  impl.Meets = meets;
  const Candidate& chosen = tried[static_cast<std::size_t>(choice)];
  if (meets)
  {
    impl.Reason = "the first candidate, by cost and size, within " + Percent(this->ErrorTolerance) +
                  (choice > 0 ? ": the one before has " +
                                  Percent(tried[static_cast<std::size_t>(choice) - 1].Error)
                              : std::string());
  }
  else
  {
    impl.Reason = "nothing that was tried is within " + Percent(this->ErrorTolerance) +
                  "; this is the most accurate for its cost, with " + Percent(chosen.Error);
  }
  impl.Reason += impl.ExplainMemory();
  impl.Time.Modified();
  if (!key.empty())
  {
    impl.WritePlan(this->CacheFolder, key, static_cast<std::uint64_t>(this->MaximumCacheBytes));
  }
  return true;
}

//------------------------------------------------------------------------------
std::string vtkRadiancePlanner::GetDefaultCacheFolder()
{
  return measuredbrdf::GetDefaultCacheFolder();
}

//------------------------------------------------------------------------------
int vtkRadiancePlanner::GetNumberOfCandidates()
{
  return static_cast<int>(this->Impl->Candidates.size());
}

//------------------------------------------------------------------------------
int vtkRadiancePlanner::GetMethod(int index)
{
  return index >= 0 && index < this->GetNumberOfCandidates()
           ? this->Impl->Candidates[static_cast<std::size_t>(index)].Method
           : -1;
}

//------------------------------------------------------------------------------
std::string vtkRadiancePlanner::GetMethodName(int index)
{
  const int method = this->GetMethod(index);
  return method >= 0 ? Names[method] : "";
}

//------------------------------------------------------------------------------
std::string vtkRadiancePlanner::GetDescription(int index)
{
  if (this->GetMethod(index) < 0)
  {
    return "";
  }
  const Candidate& candidate = this->Impl->Candidates[static_cast<std::size_t>(index)];
  return GetSizesText(candidate);
}

//------------------------------------------------------------------------------
double vtkRadiancePlanner::GetPredictedError(int index)
{
  return this->GetMethod(index) < 0 ? 0.0
                                    : this->Impl->Candidates[static_cast<std::size_t>(index)].Error;
}

//------------------------------------------------------------------------------
double vtkRadiancePlanner::GetPredictedMilliseconds(int index)
{
  return this->GetMethod(index) < 0
           ? 0.0
           : 1e-6 * this->Impl->Candidates[static_cast<std::size_t>(index)].Cost *
               static_cast<double>(this->NumberOfPixels);
}

//------------------------------------------------------------------------------
vtkIdType vtkRadiancePlanner::GetTextureBytes(int index)
{
  return this->GetMethod(index) < 0 ? 0
                                    : this->Impl->Candidates[static_cast<std::size_t>(index)].Bytes;
}

//------------------------------------------------------------------------------
double vtkRadiancePlanner::GetSetUpMilliseconds(int index)
{
  return this->GetMethod(index) < 0 ? 0.0
                                    : this->Impl->Candidates[static_cast<std::size_t>(index)].SetUp;
}

//------------------------------------------------------------------------------
int vtkRadiancePlanner::GetChoice() { return this->Impl->Choice; }

//------------------------------------------------------------------------------
bool vtkRadiancePlanner::GetMeetsTolerance() { return this->Impl->Meets; }

//------------------------------------------------------------------------------
std::string vtkRadiancePlanner::GetReason() { return this->Impl->Reason; }

//------------------------------------------------------------------------------
std::string vtkRadiancePlanner::GetPlan()
{
  const int choice = this->GetChoice();
  if (choice < 0)
  {
    return "no plan yet";
  }
  char figures[96];
  std::snprintf(figures, sizeof(figures),
    ", error %.2g %%, %.1f MB, set up in %.0f ms: ", 100.0 * this->GetPredictedError(choice),
    1e-6 * static_cast<double>(this->GetTextureBytes(choice)), this->GetSetUpMilliseconds(choice));
  return this->GetMethodName(choice) + ", " + this->GetDescription(choice) + figures +
         this->GetReason();
}

//------------------------------------------------------------------------------
vtkRadianceIntegrator* vtkRadiancePlanner::NewIntegrator(int index)
{
  if (this->GetMethod(index) < 0)
  {
    return nullptr;
  }
  const Candidate& candidate = this->Impl->Candidates[static_cast<std::size_t>(index)];
  vtkSmartPointer<vtkRadianceIntegrator> integrator =
    candidate.Integrator ? candidate.Integrator : this->Impl->Make(candidate);
  integrator->Register(nullptr);
  return integrator;
}

//------------------------------------------------------------------------------
vtkRadianceIntegrator* vtkRadiancePlanner::NewIntegrator()
{
  return this->NewIntegrator(this->Impl->Choice);
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkRadiancePlanner, ErrorTolerance, double, 1e-3, 1.0);
measuredbrdfSetClampedMacro(vtkRadiancePlanner, NumberOfPixels, vtkIdType, 1, VTK_ID_MAX);
measuredbrdfSetFinite3Macro(vtkRadiancePlanner, ViewDirection);
measuredbrdfSetInRangeMacro(vtkRadiancePlanner, MaximumTextureBytes, vtkIdType, 0, VTK_ID_MAX);
measuredbrdfSetInRangeMacro(vtkRadiancePlanner, MaximumCacheBytes, vtkIdType, 0, VTK_ID_MAX);

//------------------------------------------------------------------------------
void vtkRadiancePlanner::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->Impl->BRDF.Get() << "\n";
  os << indent << "Environment: " << this->Impl->Environment.Get() << "\n";
  os << indent
     << "CostModel: " << (this->Impl->Costs ? this->Impl->Costs->GetName() : "the default") << "\n";
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  os << indent << "ViewDirection: " << this->ViewDirection[0] << " " << this->ViewDirection[1]
     << " " << this->ViewDirection[2] << "\n";
  os << indent << "Pairs: " << this->GetNumberOfPairs() << "\n";
  os << indent << "EvaluateAll: " << (this->EvaluateAll ? "On" : "Off") << "\n";
  os << indent << "MaximumTextureBytes: " << this->MaximumTextureBytes << "\n";
  os << indent << "NumberOfPixels: " << this->NumberOfPixels << "\n";
  os << indent << "CacheFolder: " << this->CacheFolder << "\n";
  os << indent << "MaximumCacheBytes: " << this->MaximumCacheBytes << "\n";
  os << indent << "FromCache: " << (this->FromCache ? "yes" : "no") << "\n";
  os << indent << "Plan: " << this->GetPlan() << "\n";
}
