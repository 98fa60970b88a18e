// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTableRadianceIntegrator.h"

#include "Candidates.h"
#include "DirectionPairs.h"
#include "Lamps.h"
#include "LobePlacement.h" // for ProfileTexels
#include "MaterialPrecomputation.h"
#include "RadianceCore.h"
#include "RadianceTable.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <utility>

using namespace measuredbrdf;

struct vtkTableRadianceIntegrator::Tables
{
  std::unique_ptr<RadianceTable> Table;
  std::unique_ptr<TableLamps> Lamps;  // beside it; null: none
  std::unique_ptr<RadianceCore> Maps; // of the sharp part; null: none
  int Periods = 0;
};

namespace
{
constexpr int NodesOfTiles = 2;         // times NumberOfNodes, where there are tiles
constexpr double SmoothingDegree = 4.0; // about which a table hands over to its maps
constexpr int KnotsPerViewAngle = 4;    // of the kernels that the maps are made of
constexpr int KernelNodes = 64;         // likewise
constexpr int MostAnisotropicAngles = 32;
}

vtkStandardNewMacro(vtkTableRadianceIntegrator);

//------------------------------------------------------------------------------
vtkTableRadianceIntegrator::vtkTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkTableRadianceIntegrator::~vtkTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::SetLight(
  const std::shared_ptr<const vtkEnvironment::TexelChanges>& rest, vtkLightSet* lamps,
  vtkBRDF* renderable)
{
  this->Rest = rest;
  this->Lamps = lamps;
  this->LampForm = renderable;
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::UsesBRDFOnGPU() { return this->Lamps && !this->LampForm; }

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::IsTurned() const
{
  return this->BRDF && !this->BRDF->IsIsotropic();
}

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::Begin()
{
  if (!this->HasLight() || (this->NumberOfMaps > 0 && !this->IsIsotropic("maps of the sharp part")))
  {
    return false;
  }
  const bool isQuick = this->Quick && !this->IsTurned();
  const auto parts =
    this->Shared && !isQuick ? this->Shared : std::make_shared<Precomputation>(isQuick);
  auto made = std::make_unique<Tables>();
  if (!this->MakeTable(*parts, *made) || (this->NumberOfMaps > 0 && !this->MakeMaps(*parts, *made)))
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  if (this->Lamps)
  {
    const vtkSmartPointer<vtkBRDF> shaded =
      this->LampForm ? this->LampForm.Get() : this->BRDF->GetRenderable();
    shaded->Prepare(); // as the material is now
    made->Lamps = std::make_unique<TableLamps>(this->Lamps, shaded);
  }
  this->Data = std::move(made);
  return true;
}

//------------------------------------------------------------------------------
// False where it was aborted.
bool vtkTableRadianceIntegrator::MakeTable(Precomputation& parts, Tables& made)
{
  const bool isTurned = this->IsTurned();
  const int viewAzimuths = isTurned ? this->NumberOfViewAzimuths : 0;
  if (isTurned)
  {
    made.Table = std::make_unique<AnisotropicTable>(this->NumberOfRows,
      std::min(this->NumberOfViewAngles, MostAnisotropicAngles), this->NumberOfAzimuths,
      viewAzimuths);
  }
  else
  {
    made.Table = std::make_unique<RadianceTable>(
      this->NumberOfRows, this->NumberOfViewAngles, this->NumberOfAzimuths);
  }
  RadianceTable& table = *made.Table;
  const bool hasTiles = table.Tiles.FineRows > 0;
  const int degree = GetMapDegree(hasTiles ? table.Tiles.FineRows : table.Rows);
  EnvironmentPrecomputation& ofEnvironment = this->Environment->GetParts();
  const auto goOn = [this]() { return this->Report(0.0); };
  const auto report = [this](double share) { return this->Report(share); };
  const auto getHarmonics = [&](const EnvironmentPrecomputation::Rest& rest)
  {
    return ofEnvironment.GetHarmonics(
      this->Environment, rest, std::max(degree, IrradianceDegree), goOn);
  };
  const auto harmonics = getHarmonics(this->Rest);
  const auto all = this->Lamps ? getHarmonics(nullptr) : harmonics;
  if (!harmonics || !all)
  {
    return false;
  }
  // Lobes that need tiles fall between the usual nodes.
  const int nodes = this->Quick && !isTurned ? this->NumberOfNodes / 2
                                             : (hasTiles ? NodesOfTiles : 1) * this->NumberOfNodes;
  // Windows cut the kernels' nodes; harmonics of anisotropic kernels are not kept.
  MaterialKernels& knots = parts.GetKernels(this->BRDF, { table.Angles, nodes, viewAzimuths },
    this->Abort, { isTurned || this->Lamps, degree, table.Azimuths / 2 });
  if (this->Abort)
  {
    return false;
  }
  double scale = 0.0;
  if (isTurned)
  {
    auto& turned = static_cast<AnisotropicTable&>(table);
    scale = turned.Synthesize(*harmonics, knots, degree, report);
    turned.MakeProfile(parts.GetAnisotropicViews(this->BRDF, this->Abort), knots, scale);
    made.Periods = turned.Periods;
  }
  else
  {
    scale = SynthesizeRadiance({ *harmonics, this->Lamps ? all.get() : nullptr }, knots, degree,
      this->NumberOfMaps > 0 ? SmoothingDegree : 0.0, report, table);
    MakeProfile(parts.GetViews(this->BRDF, this->Abort), knots, scale, table);
  }
  if (scale > 0.0 && table.HasFloor)
  {
    table.Irradiance = ofEnvironment.GetIrradiance(
      this->Lamps ? nullptr : this->Rest, goOn, [&all]() { return MakeIrradiance(*all); });
  }
  return scale > 0.0 && (!table.HasFloor || table.Irradiance);
}

//------------------------------------------------------------------------------
// False where it was aborted.
bool vtkTableRadianceIntegrator::MakeMaps(Precomputation& parts, Tables& made)
{
  const int degree = GetMapDegree(this->NumberOfMapRows);
  const auto harmonics = this->Environment->GetParts().GetHarmonics(
    this->Environment, this->Rest, degree, [this]() { return this->Report(0.0); });
  if (!harmonics)
  {
    return false;
  }
  const LobeViews& views = parts.GetViews(this->BRDF, this->Abort);
  const MaterialPrecomputation::Use use{ false, degree, RadianceCore::LargestOrder };
  MaterialKernels& tableKnots = parts.GetKernels(
    this->BRDF, { this->NumberOfViewAngles, this->NumberOfNodes }, this->Abort, use);
  MaterialKernels& knots = parts.GetKernels(this->BRDF,
    { KnotsPerViewAngle * (this->NumberOfViewAngles - 1) + 1, KernelNodes }, this->Abort, use);
  if (this->Abort)
  {
    return false;
  }
  RadianceTable table(this->NumberOfRows, this->NumberOfViewAngles, this->NumberOfAzimuths);
  MakeProfile(views, tableKnots, 1.0, table);
  const CoreKernels kernels{ knots, tableKnots, table, SmoothingDegree, this->NumberOfMapRows,
    degree };
  made.Maps = std::make_unique<RadianceCore>(this->NumberOfMapRows);
  return made.Maps->Make(*harmonics, views, kernels, this->NumberOfMaps,
    [this](double share) { return this->Report(share); });
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::IntegratePair(
  const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const glm::dvec3 normal = glm::make_vec3(n);
  const glm::dvec3 view = glm::make_vec3(o);
  const glm::dvec3 tangent = glm::make_vec3(t);
  glm::dvec3 sum = this->Data->Table->Evaluate(normal, view, tangent, this->Data->Lamps.get());
  if (this->Data->Maps)
  {
    sum = glm::max(sum + this->Data->Maps->Evaluate(normal, view, tangent), 0.0);
  }
  AddRGB(sum, radiance);
}

//------------------------------------------------------------------------------
int vtkTableRadianceIntegrator::GetNumberOfPeriods()
{
  return this->Data ? this->Data->Periods : 0;
}

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  if (!this->Prepare())
  {
    return false;
  }
  inputs = this->Data->Table->GetShaderInputs();
  if (this->Data->Lamps)
  {
    this->Data->Lamps->AddTo(inputs.Terms.front());
    inputs.Description += "; " + std::to_string(this->Lamps->GetNumberOfLights()) +
                          " directional lights near the lobe's axis";
  }
  if (this->Data->Maps)
  {
    this->Data->Maps->AddTo(inputs);
  }
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfRows, int, 9, 513);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfViewAngles, int, 2, 64);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfAzimuths, int, 4, 64);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfViewAzimuths, int, 2, 32);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfMaps, int, 0, 32);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfMapRows, int, 8, 512);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfNodes, int, 16, 1024);

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkTableRadianceIntegrator::GetSizes()
{
  return { { "rows", 9, 513, this->NumberOfRows,
             [this](int value) { this->SetNumberOfRows(value); } },
    { "view angles", 2, 64, this->NumberOfViewAngles,
      [this](int value) { this->SetNumberOfViewAngles(value); } },
    { "azimuths", 4, 64, this->NumberOfAzimuths,
      [this](int value) { this->SetNumberOfAzimuths(value); } },
    { "view azimuths", 2, 32, this->NumberOfViewAzimuths,
      [this](int value) { this->SetNumberOfViewAzimuths(value); } } };
}

//------------------------------------------------------------------------------
// Isotropic materials have no azimuths of the view.
std::string vtkTableRadianceIntegrator::GetSizesText()
{
  const std::string text = this->Superclass::GetSizesText();
  return this->IsTurned() ? text : text.substr(0, text.rfind(" x "));
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* table = vtkTableRadianceIntegrator::SafeDownCast(source))
  {
    this->SetNumberOfMaps(table->NumberOfMaps);
    this->SetNumberOfMapRows(table->NumberOfMapRows);
    this->SetNumberOfNodes(table->NumberOfNodes);
    this->SetQuick(table->Quick);
  }
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkTableRadianceIntegrator::GetCandidateSizes(bool)
{
  const auto goOn = [this]() { return this->Report(0.0); };
  return GetTableCandidates(
    !this->IsTurned(), false, CountPlannedLights(this->Environment, LampAngle, goOn) > 0);
}

//------------------------------------------------------------------------------
double vtkTableRadianceIntegrator::EstimateCost()
{
  if (this->IsTurned())
  {
    return 2.0 * PixelCosts::Table - PixelCosts::Pixel; // two tables in one pixel
  }
  const bool hasTiles = TableTiles::GetFineRows(this->NumberOfRows) > 0;
  return PixelCosts::Table + (hasTiles ? PixelCosts::Tiles : 0.0) +
         PixelCosts::Map * this->NumberOfMaps;
}

//------------------------------------------------------------------------------
vtkIdType vtkTableRadianceIntegrator::EstimateTextureBytes()
{
  constexpr vtkIdType irradiance =
    4 * RadianceTable::IrradianceSide * RadianceTable::IrradianceSide;
  if (this->IsTurned())
  {
    const AnisotropicTable table(this->NumberOfRows,
      std::min(this->NumberOfViewAngles, MostAnisotropicAngles), this->NumberOfAzimuths,
      this->NumberOfViewAzimuths);
    return 4 * static_cast<vtkIdType>(table.GetMap(table.Angles, 0)) * table.ViewAzimuths +
           12 * 3 * AnisotropicViews::Angles * AnisotropicViews::Azimuths + irradiance;
  }
  const RadianceTable table(this->NumberOfRows, this->NumberOfViewAngles, this->NumberOfAzimuths);
  const vtkIdType texels =
    static_cast<vtkIdType>(2 * this->NumberOfMapRows) * this->NumberOfMapRows;
  return 4 * static_cast<vtkIdType>(table.GetMap(table.Angles, 0) + table.Tiles.Places.size()) +
         irradiance + 2 * 16 * ProfileTexels + 6 * texels * this->NumberOfMaps +
         16 * ProfileTexels * RadianceCore::CountWeightRows(this->NumberOfMaps);
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfMaps: " << this->NumberOfMaps << "\n";
  os << indent << "NumberOfMapRows: " << this->NumberOfMapRows << "\n";
  os << indent << "NumberOfNodes: " << this->NumberOfNodes << "\n";
  os << indent << "Quick: " << (this->Quick ? "On" : "Off") << "\n";
}
