// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridRadianceIntegrator.h"

#include "Candidates.h"
#include "HalfVector.h" // for Pi
#include "Lamps.h"
#include "LowDiscrepancy.h" // for GoldenRatio
#include "MaterialPrecomputation.h"
#include "Printable.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
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
constexpr int SmallTableRows = 33; // beside maps

// A planner's lamps of many texels are several lights (degrees) where more than so much of the
// albedo lies in lobes narrower than twice LampAngle.
constexpr double FineLampAngle = 0.6;
constexpr double NarrowShare = 0.05;

// Few lights are evaluated everywhere, more of them near the lobe's axis only (TableLamps). What
// finding those costs, and each that is to be found, in lights that are evaluated (llvmpipe).
constexpr int LightsEverywhere = 2;
constexpr double LargestIrregularity = 0.1; // of materials whose tails a table holds
constexpr double Finding = 1.8;
constexpr double Found = 0.15;

constexpr int TailViews = 8;
constexpr int TailDirections = 24;
constexpr double TailStep = 3.75 * Pi / 180.0;    // half of a step of 13 view angles
constexpr double NearestTail = 12.0 * Pi / 180.0; // to the mirror direction
constexpr double FarthestTail = 80.0 * Pi / 180.0;

// f cos(theta_i) of a direction that is given by its angle from the view's mirror direction and its
// azimuth about that; -1 below the horizon.
double GetTailKernel(vtkBRDF* brdf, double view, double angle, double azimuth)
{
  const glm::dvec3 o(std::sin(view), 0.0, std::cos(view));
  const glm::dvec3 i = std::sin(angle) * (std::cos(azimuth) * glm::dvec3(o.z, 0.0, o.x) +
                                           glm::dvec3(0.0, std::sin(azimuth), 0.0)) +
                       std::cos(angle) * glm::dvec3(-o.x, 0.0, o.z);
  glm::dvec3 f;
  brdf->Evaluate(&i.x, &o.x, &f.x);
  const double sum = f.x + f.y + f.z;
  return !(i.z > 0.0) ? -1.0 : std::isfinite(sum) ? sum * i.z : 0.0;
}

// How far f cos(theta_i) of an isotropic material, 12 degrees and more from the mirror direction,
// is from the mean of its values at views 3.75 degrees to either side, mirrored about the plane of
// incidence: the sum of differences by the sum of values, 0 for the smoothest. Noise from cell to
// cell and lobes without that symmetry have a large one. A thousand evaluations of f, the same ones
// each time.
double GetTailIrregularity(vtkBRDF* brdf)
{
  double difference = 0.0;
  double total = 0.0;
  for (int v = 0; v < TailViews; ++v)
  {
    const double view = TailStep * (1 + 2 * v);
    for (int k = 0; k < TailDirections; ++k)
    {
      const double t = (k + 0.5) / TailDirections; // equal solid angles
      const double angle =
        std::acos(std::cos(NearestTail) + t * (std::cos(FarthestTail) - std::cos(NearestTail)));
      const double azimuth = 2.0 * Pi * GoldenRatio * (k + 1 + v * TailDirections);
      const double kernel = GetTailKernel(brdf, view, angle, azimuth);
      double mean = 0.0;
      double least = kernel;
      for (const double side : { view - TailStep, view + TailStep })
      {
        for (const double turn : { azimuth, -azimuth })
        {
          const double neighbor = GetTailKernel(brdf, side, angle, turn);
          least = std::min(least, neighbor);
          mean += 0.25 * neighbor;
        }
      }
      if (least >= 0.0) // all are above the horizon
      {
        difference += std::abs(kernel - mean);
        total += std::max(kernel, mean);
      }
    }
  }
  return total > 0.0 ? difference / total : 0.0;
}

constexpr double AngleUnits = 10.0; // of the size that is the light angle, per degree
int ToAngleSize(double degrees) { return static_cast<int>(std::lround(AngleUnits * degrees)); }
}

struct vtkHybridRadianceIntegrator::Internals
{
  vtkSmartPointer<vtkTableRadianceIntegrator> Broad;     // with lamps, if they are windowed
  vtkSmartPointer<vtkLightSetRadianceIntegrator> Lights; // else; null: there are none
  vtkSmartPointer<vtkBRDF> LampForm;                     // sees lamps as areas; null: need not
  int NumberOfLights = 0;
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
int vtkHybridRadianceIntegrator::GetNumberOfLights() { return this->Impl->NumberOfLights; }

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::Begin()
{
  if (!this->HasLight() || (this->NumberOfMaps > 0 && !this->IsIsotropic("maps of the sharp part")))
  {
    return false;
  }
  const auto goOn = [this]() { return this->Report(0.0); };
  const auto lamps =
    FindLamps(this->Environment, this->LightAngle, this->MaximumNumberOfLights, goOn);
  if (!lamps)
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  Internals made;
  made.NumberOfLights = lamps->Set ? lamps->Set->GetNumberOfLights() : 0;
  const bool isWindowed = this->IsWindowed(made.NumberOfLights);
  const auto parts =
    this->Shared || this->Quick ? this->Shared : std::make_shared<Precomputation>();
  const double spread = this->FindLampSpread(parts);
  if (spread > 0.0 && !this->Abort)
  {
    made.LampForm = parts->GetLampForm(this->BRDF, spread, this->Abort);
  }
  if (this->Abort)
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  if (lamps->Set && !isWindowed)
  {
    made.Lights = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
    made.Lights->SetBRDF(made.LampForm ? made.LampForm.Get() : this->BRDF->GetRenderable());
    made.Lights->SetLightSet(lamps->Set);
    made.Lights->UnrolledOn(); // their number is the plan's
  }
  made.Broad = this->NewBroad(lamps->Rest, isWindowed ? lamps->Set.Get() : nullptr, made.LampForm);
  made.Broad->SetPrecomputation(parts);
  const bool broadly = this->PrepareLayer(made.Broad);
  made.Broad->SetPrecomputation(nullptr);
  if (!broadly || (made.Lights && !made.Lights->Prepare()) || this->Abort)
  {
    vtkErrorMacro("Prepare: " << (this->Abort ? "aborted." : "a layer cannot be prepared."));
    return false;
  }
  *this->Impl = std::move(made);
  return true;
}

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::UsesBRDFOnGPU()
{
  return this->GetNumberOfLights() > 0 && !this->Impl->LampForm;
}

//------------------------------------------------------------------------------
// How wide the lamps are, if they are seen through a LampBRDF; else 0.
double vtkHybridRadianceIntegrator::FindLampSpread(const std::shared_ptr<Precomputation>& parts)
{
  const auto goOn = [this]() { return this->Report(0.0); };
  const bool canSee = !this->Quick && this->BRDF && this->BRDF->IsIsotropic();
  const auto lamps =
    FindLamps(this->Environment, this->LightAngle, canSee ? this->MaximumNumberOfLights : 0, goOn);
  const double spread =
    lamps ? lamps->GetSpread(this->IsWindowed(static_cast<int>(lamps->Lights.size()))) : 0.0;
  // Lights would need a resampled form, which is five times as large.
  const bool isNeeded =
    spread > 0.0 && (!this->BRDF->IsRenderable() ||
                      LampBRDF::IsWidthSeen(parts->GetViews(this->BRDF, this->Abort), spread));
  return isNeeded ? spread : 0.0;
}

//------------------------------------------------------------------------------
// What reflects the rest of the environment and, unless they are null, lamps.
vtkSmartPointer<vtkTableRadianceIntegrator> vtkHybridRadianceIntegrator::NewBroad(
  const std::shared_ptr<const vtkEnvironment::TexelChanges>& rest, vtkLightSet* lamps,
  vtkBRDF* lampForm)
{
  auto table = vtkSmartPointer<vtkTableRadianceIntegrator>::New();
  const bool hasMaps = this->NumberOfMaps > 0;
  table->SetBRDF(this->BRDF);
  table->SetEnvironment(this->Environment);
  table->SetLight(rest, lamps, lampForm);
  table->SetSizes({ hasMaps ? std::min(this->NumberOfRows, SmallTableRows) : this->NumberOfRows,
    this->NumberOfViewAngles, this->NumberOfAzimuths, std::min(this->NumberOfViewAngles, 32) });
  table->SetNumberOfMaps(this->NumberOfMaps);
  table->SetNumberOfMapRows(std::min(this->NumberOfRows, 512));
  table->SetQuick(this->Quick && !hasMaps);
  return table;
}

//------------------------------------------------------------------------------
void vtkHybridRadianceIntegrator::IntegratePair(
  const double n[3], const double o[3], const double t[3], double radiance[3])
{
  AddTo(this->Impl->Broad, n, o, t, radiance);
  if (this->Impl->Lights)
  {
    AddTo(this->Impl->Lights, n, o, t, radiance);
  }
}

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  if (!this->Prepare())
  {
    return false;
  }
  vtkBRDFShaderInputs result;
  vtkRadianceIntegrator* const layers[] = { this->Impl->Broad, this->Impl->Lights };
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
  inputs = std::move(result);
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, NumberOfRows, int, 9, 513);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, NumberOfViewAngles, int, 2, 64);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, NumberOfAzimuths, int, 4, 64);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, NumberOfMaps, int, 0, 32);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, MaximumNumberOfLights, int, 0, 1024);
measuredbrdfSetClampedMacro(vtkHybridRadianceIntegrator, LightAngle, double, 0.0, 30.0);

//------------------------------------------------------------------------------
std::string vtkHybridRadianceIntegrator::GetMethodDescription()
{
  return "lights for bright sources, a precomputed table for the rest, with maps of its sharp part";
}

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkHybridRadianceIntegrator::GetSizes()
{
  return { { "rows", 9, 513, this->NumberOfRows,
             [this](int value) { this->SetNumberOfRows(value); } },
    { "view angles", 2, 64, this->NumberOfViewAngles,
      [this](int value) { this->SetNumberOfViewAngles(value); } },
    { "azimuths", 4, 64, this->NumberOfAzimuths,
      [this](int value) { this->SetNumberOfAzimuths(value); } },
    { "maps", 0, 32, this->NumberOfMaps, [this](int value) { this->SetNumberOfMaps(value); } },
    { "lights", 0, 1024, this->MaximumNumberOfLights,
      [this](int value) { this->SetMaximumNumberOfLights(value); } },
    { "light angle", 0, 300, ToAngleSize(this->LightAngle),
      [this](int value) { this->SetLightAngle(value / AngleUnits); } } };
}

//------------------------------------------------------------------------------
void vtkHybridRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* hybrid = vtkHybridRadianceIntegrator::SafeDownCast(source))
  {
    this->SetLightAngle(hybrid->LightAngle); // which need not be of whole tenths
    this->SetQuick(hybrid->Quick);
  }
}

//------------------------------------------------------------------------------
std::string vtkHybridRadianceIntegrator::GetSizesText()
{
  const int lights = this->CountLights(this->LightAngle, this->MaximumNumberOfLights);
  return std::to_string(this->NumberOfRows) + " rows x " +
         std::to_string(this->NumberOfViewAngles) + " view angles x " +
         std::to_string(this->NumberOfAzimuths) + " azimuths" +
         (this->NumberOfMaps > 0 ? ", " + std::to_string(this->NumberOfMaps) + " maps"
                                 : std::string()) +
         (lights > 0 ? ", " + std::to_string(lights) + " suns as lights" : std::string());
}

//------------------------------------------------------------------------------
// None where there is no environment, or the run was aborted.
int vtkHybridRadianceIntegrator::CountLights(double angle, int maximum)
{
  const auto goOn = [this]() { return this->Report(0.0); };
  const auto lamps = FindLamps(this->Environment, angle, maximum, goOn);
  return lamps ? static_cast<int>(lamps->Lights.size()) : 0;
}

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::AreWindowed(vtkBRDF* brdf, int lights)
{
  if (lights <= LightsEverywhere || !brdf || !brdf->IsIsotropic())
  {
    return false;
  }
  brdf->Prepare();
  return GetTailIrregularity(brdf) < LargestIrregularity;
}

//------------------------------------------------------------------------------
bool vtkHybridRadianceIntegrator::IsWindowed(int lights) { return AreWindowed(this->BRDF, lights); }

//------------------------------------------------------------------------------
double vtkHybridRadianceIntegrator::ChooseLightAngle()
{
  const auto parts = this->Shared ? this->Shared : std::make_shared<Precomputation>();
  const double radius = vtkMath::RadiansFromDegrees(2.0 * LampAngle);
  const double sharp = parts->GetViews(this->BRDF, this->Abort).GetSharpShare(Pi * radius * radius);
  return sharp > NarrowShare ? FineLampAngle : LampAngle;
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkHybridRadianceIntegrator::GetCandidateSizes(bool)
{
  std::vector<std::vector<int>> candidates;
  const double angle = this->BRDF->IsIsotropic() ? this->ChooseLightAngle() : LampAngle;
  if (CountPlannedLights(this->Environment, angle, [this]() { return this->Report(0.0); }) == 0)
  {
    return candidates; // the same as a table
  }
  for (const std::vector<int>& sizes : GetTableCandidates(this->BRDF->IsIsotropic(), true, true))
  {
    candidates.push_back({ sizes[0], sizes[1], sizes[2], this->BRDF->IsIsotropic() ? sizes[3] : 0,
      PlannedLights, ToAngleSize(angle) });
  }
  return candidates;
}

//------------------------------------------------------------------------------
double vtkHybridRadianceIntegrator::EstimateCost()
{
  const int count = this->CountLights(this->LightAngle, this->MaximumNumberOfLights);
  double lights = count;
  if (this->IsWindowed(count))
  {
    lights = Finding + count * (Found + LampWindow::GetShare());
  }
  return this->NewBroad()->EstimateCost() + PixelCosts::Light * lights;
}

//------------------------------------------------------------------------------
vtkIdType vtkHybridRadianceIntegrator::EstimateTextureBytes()
{
  const auto parts = this->Shared ? this->Shared : std::make_shared<Precomputation>();
  const bool seesAreas = this->FindLampSpread(parts) > 0.0;
  return this->NewBroad()->EstimateTextureBytes() +
         32 * this->CountLights(this->LightAngle, this->MaximumNumberOfLights) +
         (seesAreas ? LampBRDF::GetTextureBytes() : 0);
}

//------------------------------------------------------------------------------
void vtkHybridRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LightAngle: " << this->LightAngle << "\n";
  os << indent << "Quick: " << (this->Quick ? "On" : "Off") << "\n";
  os << indent << "Lights: " << this->GetNumberOfLights() << "\n";
}
