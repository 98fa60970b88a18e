// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridRadianceIntegrator.h"

#include "EnvironmentPrecomputation.h"
#include "EnvironmentPyramid.h"
#include "LobePart.h"
#include "MaterialPrecomputation.h"
#include "Printable.h"
#include "Setters.h"
#include "TableCandidates.h"
#include "vtkBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkCallbackCommand.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceCostModel.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

using namespace measuredbrdf;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double ResolvedSquares = 36.0; // of the rows' spacing, that a lobe has to fill
constexpr double LeastShare = 2e-3;      // of the albedo: below, a sharp layer is not worth it

// A planner's lamps of many texels are one light each (degrees), or several where more than so much
// of the albedo lies in lobes narrower than twice that.
constexpr double LampAngle = 1.2;
constexpr double FineLampAngle = 0.6;
constexpr double NarrowShare = 0.05;
constexpr int PlannedLights = 16; // at most

constexpr double AngleUnits = 10.0; // of the size that is the light angle, per degree
int ToAngleSize(double degrees) { return static_cast<int>(std::lround(AngleUnits * degrees)); }
}

// Layers are null where there is nothing for them.
struct vtkHybridRadianceIntegrator::Internals
{
  vtkSmartPointer<vtkTableRadianceIntegrator> Broad;
  vtkSmartPointer<vtkFilteredRadianceIntegrator> Sharp;
  vtkSmartPointer<vtkLightSetRadianceIntegrator> Lights;
};

vtkStandardNewMacro(vtkHybridRadianceIntegrator);

//------------------------------------------------------------------------------
vtkHybridRadianceIntegrator::vtkHybridRadianceIntegrator()
  : Impl(new Internals)
{
}

//------------------------------------------------------------------------------
vtkHybridRadianceIntegrator::~vtkHybridRadianceIntegrator() = default;

//------------------------------------------------------------------------------
int vtkHybridRadianceIntegrator::GetNumberOfLights()
{
  return this->Impl->Lights ? this->Impl->Lights->GetLightSet()->GetNumberOfLights() : 0;
}

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::GetHasSharpLayer() { return this->Impl->Sharp != nullptr; }

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::Begin()
{
  this->Abort = false; // one that an earlier run left
  if (!this->Environment || this->Environment->GetPixels().empty())
  {
    vtkErrorMacro("Prepare: there is no environment, or it is empty.");
    return false;
  }
  if (!this->BRDF->IsIsotropic())
  {
    vtkErrorMacro(
      "Prepare: tables of radiance are for isotropic materials; "
      << (this->BRDF->GetName().empty() ? "this one" : measuredbrdf::Quote(this->BRDF->GetName()))
      << " is not.");
    return false;
  }
  const auto lamps = this->Environment->GetParts().GetLamps(this->Environment,
    vtkMath::RadiansFromDegrees(this->LightAngle), this->MaximumNumberOfLights,
    [this]() { return this->Report(0.0); });
  if (!lamps)
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  Internals made;
  if (lamps->Set)
  {
    made.Lights = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
    made.Lights->SetBRDF(this->BRDF->GetRenderable());
    made.Lights->SetLightSet(lamps->Set);
    made.Lights->UnrolledOn(); // their number is the plan's
  }
  const auto parts = this->Shared ? this->Shared : std::make_shared<Precomputation>();
  this->MakeLayers(*parts, lamps->Rest, made);
  made.Broad->SetPrecomputation(made.Sharp ? nullptr : parts);
  const bool broadly = this->PrepareBroad(made.Broad);
  made.Broad->SetPrecomputation(nullptr);
  if (!broadly && this->Given)
  {
    return false;
  }
  const bool done =
    broadly && (!made.Sharp || made.Sharp->Prepare()) && (!made.Lights || made.Lights->Prepare());
  if (!done || this->Abort)
  {
    vtkErrorMacro("Prepare: " << (this->Abort ? "aborted." : "a layer cannot be prepared."));
    return false;
  }
  *this->Impl = std::move(made);
  return true;
}

//------------------------------------------------------------------------------
// Layers of the material, under what the lights leave of the environment.
void vtkHybridRadianceIntegrator::MakeLayers(Precomputation& parts,
  const std::shared_ptr<const vtkEnvironment::TexelChanges>& rest, Internals& made)
{
  vtkSmartPointer<vtkBRDF> broad = this->BRDF;
  if (this->NumberOfSamples > 0)
  {
    const double spacing = Pi / (this->NumberOfRows - 1);
    const auto cut = std::make_shared<LobeSplit>(
      parts.GetViews(this->BRDF, this->Abort), ResolvedSquares * spacing * spacing);
    if (cut->GetSharpShare() > LeastShare)
    {
      const auto layer = [&](bool sharp)
      {
        auto brdf = vtkSmartPointer<LobePart>::New();
        brdf->Set(this->BRDF, cut, sharp);
        return brdf;
      };
      broad = layer(false);
      made.Sharp = vtkSmartPointer<vtkFilteredRadianceIntegrator>::New();
      made.Sharp->SetBRDF(layer(true));
      made.Sharp->SetEnvironment(this->Environment);
      made.Sharp->SetRest(rest);
      made.Sharp->SetNumberOfSamples(this->NumberOfSamples);
      made.Sharp->ExtractLightsOff();
    }
  }
  made.Broad = vtkSmartPointer<vtkTableRadianceIntegrator>::New();
  made.Broad->SetBRDF(broad);
  made.Broad->SetEnvironment(this->Environment);
  made.Broad->SetRest(rest);
  made.Broad->SetNumberOfRows(this->NumberOfRows);
  made.Broad->SetNumberOfViewAngles(this->NumberOfViewAngles);
  made.Broad->SetNumberOfAzimuths(this->NumberOfAzimuths);
}

//------------------------------------------------------------------------------
// The table takes longest: its progress is this one's, and it stops where this one is told to.
bool vtkHybridRadianceIntegrator::PrepareBroad(vtkTableRadianceIntegrator* broad)
{
  vtkNew<vtkCallbackCommand> follow;
  follow->SetClientData(this);
  follow->SetCallback(
    [](vtkObject* caller, unsigned long, void* self, void* progress)
    {
      auto* hybrid = static_cast<vtkHybridRadianceIntegrator*>(self);
      hybrid->InvokeEvent(vtkCommand::ProgressEvent, progress);
      static_cast<vtkTableRadianceIntegrator*>(caller)->SetAbort(hybrid->Abort);
    });
  const unsigned long tag = broad->AddObserver(vtkCommand::ProgressEvent, follow);
  const bool prepared = this->Given ? broad->TakePrepared(*this->Given) : broad->Prepare();
  broad->RemoveObserver(tag);
  return prepared;
}

//------------------------------------------------------------------------------
void vtkHybridRadianceIntegrator::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  AddTo(this->Impl->Broad, n, o, t, radiance);
  if (this->Impl->Sharp)
  {
    AddTo(this->Impl->Sharp, n, o, t, radiance);
  }
  if (this->Impl->Lights)
  {
    AddTo(this->Impl->Lights, n, o, t, radiance);
  }
}

//------------------------------------------------------------------------------
std::string vtkHybridRadianceIntegrator::GetPrepared()
{
  return this->Impl->Broad ? this->Impl->Broad->GetPrepared() : "";
}

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::TakePrepared(const std::string& bytes)
{
  this->Modified(); // so that Prepare does
  this->Given = &bytes;
  const bool taken = this->Prepare();
  this->Given = nullptr;
  return taken;
}

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  if (!this->Prepare())
  {
    return false;
  }
  vtkBRDFShaderInputs result;
  vtkRadianceIntegrator* const layers[] = { this->Impl->Broad, this->Impl->Sharp,
    this->Impl->Lights };
  for (vtkRadianceIntegrator* layer : layers)
  {
    vtkBRDFShaderInputs part;
    if (!layer)
    {
      continue;
    }
    if (!layer->GetShaderInputs(part))
    {
      return false;
    }
    std::move(part.Terms.begin(), part.Terms.end(), std::back_inserter(result.Terms));
    result.QuantizationError = std::max(result.QuantizationError, part.QuantizationError);
    result.Description += (result.Description.empty() ? "" : "; ") + part.Description;
  }
  form = std::move(result);
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, NumberOfRows, int, 9, 513);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, NumberOfViewAngles, int, 2, 64);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, NumberOfAzimuths, int, 4, 64);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, NumberOfSamples, int, 0, 1024);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, MaximumNumberOfLights, int, 0, 1024);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, LightAngle, double, 0.0, 30.0);

//------------------------------------------------------------------------------
std::string vtkHybridRadianceIntegrator::GetMethodDescription()
{
  return "a precomputed table for broad reflection, samples for sharp highlights, lights for "
         "bright "
         "sources";
}

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkHybridRadianceIntegrator::GetSizes()
{
  return { { "rows", 9, 513, this->NumberOfRows },
    { "view angles", 2, 64, this->NumberOfViewAngles },
    { "azimuths", 4, 64, this->NumberOfAzimuths }, { "samples", 0, 1024, this->NumberOfSamples },
    { "lights", 0, 1024, this->MaximumNumberOfLights },
    { "light angle", 0, 300, ToAngleSize(this->LightAngle) } };
}

//------------------------------------------------------------------------------
void vtkHybridRadianceIntegrator::SetSize(int index, int value)
{
  switch (index)
  {
    case 0:
      return this->SetNumberOfRows(value);
    case 1:
      return this->SetNumberOfViewAngles(value);
    case 2:
      return this->SetNumberOfAzimuths(value);
    case 3:
      return this->SetNumberOfSamples(value);
    case 4:
      return this->SetMaximumNumberOfLights(value);
    default:
      this->SetLightAngle(value / AngleUnits);
  }
}

//------------------------------------------------------------------------------
void vtkHybridRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* hybrid = vtkHybridRadianceIntegrator::SafeDownCast(source))
  {
    this->SetLightAngle(hybrid->LightAngle); // which need not be of whole tenths
  }
}

//------------------------------------------------------------------------------
std::string vtkHybridRadianceIntegrator::GetSizesText()
{
  const int lights = this->CountLights(this->LightAngle, this->MaximumNumberOfLights);
  return std::to_string(this->NumberOfRows) + " rows x " +
         std::to_string(this->NumberOfViewAngles) + " view angles x " +
         std::to_string(this->NumberOfAzimuths) + " azimuths" +
         (this->NumberOfSamples > 0 ? ", " + std::to_string(this->NumberOfSamples) + " samples"
                                    : std::string()) +
         (lights > 0 ? ", " + std::to_string(lights) + " suns as lights" : std::string());
}

//------------------------------------------------------------------------------
// Found once for the environment, and shared. None where there is no environment, or the run was
// aborted.
int vtkHybridRadianceIntegrator::CountLights(double angle, int maximum)
{
  if (!this->Environment || this->Environment->GetPixels().empty())
  {
    return 0;
  }
  const auto lamps = this->Environment->GetParts().GetLamps(this->Environment,
    vtkMath::RadiansFromDegrees(angle), maximum, [this]() { return this->Report(0.0); });
  return lamps ? static_cast<int>(lamps->Lights.size()) : 0;
}

//------------------------------------------------------------------------------
double vtkHybridRadianceIntegrator::ChooseLightAngle()
{
  const auto parts = this->Shared ? this->Shared : std::make_shared<Precomputation>();
  const double radius = vtkMath::RadiansFromDegrees(2.0 * LampAngle);
  const LobeSplit cut(parts->GetViews(this->BRDF, this->Abort), Pi * radius * radius);
  return cut.GetSharpShare() > NarrowShare ? FineLampAngle : LampAngle;
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkHybridRadianceIntegrator::GetCandidateSizes(bool)
{
  if (!this->BRDF->IsIsotropic())
  {
    return {};
  }
  const double angle = this->ChooseLightAngle();
  const bool lights = this->CountLights(angle, PlannedLights) > 0;
  std::vector<std::vector<int>> candidates;
  for (std::vector<int> sizes : GetHybridCandidates())
  {
    if (lights || sizes.at(3) > 0) // else it is a table
    {
      sizes.push_back(PlannedLights);
      sizes.push_back(ToAngleSize(angle));
      candidates.push_back(sizes);
    }
  }
  return candidates;
}

//------------------------------------------------------------------------------
double vtkHybridRadianceIntegrator::EstimateCost(vtkRadianceCostModel* costs)
{
  return GetCost(costs, "base") + GetCost(costs, "table") +
         GetCost(costs, "sample") * this->NumberOfSamples +
         GetCost(costs, "light") * this->CountLights(this->LightAngle, this->MaximumNumberOfLights);
}

//------------------------------------------------------------------------------
vtkIdType vtkHybridRadianceIntegrator::EstimateTextureBytes()
{
  return GetTableBytes(this->NumberOfRows, this->NumberOfViewAngles, this->NumberOfAzimuths) +
         32 * this->CountLights(this->LightAngle, this->MaximumNumberOfLights) +
         (this->NumberOfSamples > 0 ? EnvironmentPyramid::EstimateBytes(this->Environment) : 0);
}

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::CanPrune(const std::vector<Attempt>& attempts, double error)
{
  std::vector<Attempt> alike;
  std::copy_if(attempts.begin(), attempts.end(), std::back_inserter(alike),
    [this](const Attempt& attempt) { return attempt.Sizes[3] == this->NumberOfSamples; });
  return CanPruneTable(
    { this->NumberOfRows, this->NumberOfViewAngles, this->NumberOfAzimuths }, alike, error);
}

//------------------------------------------------------------------------------
void vtkHybridRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRows: " << this->NumberOfRows << "\n";
  os << indent << "NumberOfViewAngles: " << this->NumberOfViewAngles << "\n";
  os << indent << "NumberOfAzimuths: " << this->NumberOfAzimuths << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "MaximumNumberOfLights: " << this->MaximumNumberOfLights << "\n";
  os << indent << "LightAngle: " << this->LightAngle << "\n";
  os << indent << "Lights: " << this->GetNumberOfLights() << "\n";
  os << indent << "Sharp layer: " << (this->GetHasSharpLayer() ? "yes" : "no") << "\n";
}
