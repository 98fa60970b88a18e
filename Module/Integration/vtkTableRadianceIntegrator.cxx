// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTableRadianceIntegrator.h"

#include "Candidates.h"
#include "DirectionPairs.h"
#include "EnvironmentPrecomputation.h"
#include "HalfVector.h" // for Pi
#include "Lamps.h"
#include "LobePlacement.h" // for ProfileTexels
#include "MaterialPrecomputation.h"
#include "ModuleShader.h"
#include "Printable.h"
#include "RadianceTable.h"
#include "Setters.h"
#include "TableSynthesis.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentTable.h"
#include "vtkBRDFEnvironmentTiles.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace measuredbrdf;

struct vtkTableRadianceIntegrator::Tables : RadianceTable
{
  using RadianceTable::RadianceTable;
  std::unique_ptr<TableLamps> Lamps; // beside it; null: none
};

namespace
{
constexpr int NodesOfTiles = 2; // times NumberOfNodes, where there are tiles

std::string GetTilesText(const TableTiles& tiles)
{
  return tiles.Places.empty() ? ""
                              : " (" + std::to_string(tiles.GetFineColumns()) + " x " +
                                  std::to_string(tiles.FineRows) + " where they bend most)";
}
}

vtkStandardNewMacro(vtkTableRadianceIntegrator);

//------------------------------------------------------------------------------
vtkTableRadianceIntegrator::vtkTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkTableRadianceIntegrator::~vtkTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::SetLamps(vtkLightSet* lamps, vtkBRDF* form)
{
  this->Lamps = lamps;
  this->LampForm = form;
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::UsesBRDFOnGPU() { return this->Lamps && !this->LampForm; }

//------------------------------------------------------------------------------
// Of the material as it is now.
void vtkTableRadianceIntegrator::AddLamps(Tables& table)
{
  if (this->Lamps)
  {
    const vtkSmartPointer<vtkBRDF> shaded =
      this->LampForm ? this->LampForm.Get() : this->BRDF->GetRenderable();
    shaded->Prepare();
    table.Lamps = std::make_unique<TableLamps>(this->Lamps, shaded);
  }
}

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::Begin()
{
  if (!this->HasLight() || !this->IsIsotropic("tables of radiance"))
  {
    return false;
  }
  auto table =
    std::make_unique<Tables>(this->NumberOfRows, this->NumberOfViewAngles, this->NumberOfAzimuths);
  if (!this->MakeTable(*table))
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  this->AddLamps(*table);
  this->Data = std::move(table);
  return true;
}

//------------------------------------------------------------------------------
// False where it was aborted.
bool vtkTableRadianceIntegrator::MakeTable(Tables& table)
{
  const int rows = table.Tiles.FineRows > 0 ? table.Tiles.FineRows : table.Rows;
  const int degree = this->HarmonicDegree > 0 ? this->HarmonicDegree : GetMapDegree(rows);
  const auto parts =
    this->Shared && !this->Quick ? this->Shared : std::make_shared<Precomputation>(this->Quick);
  EnvironmentPrecomputation& ofEnvironment = this->Environment->GetParts();
  const auto goOn = [this]() { return this->Report(0.0); };
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
  const TableLight light{ *harmonics, this->Lamps ? all.get() : nullptr, {} };
  const LobeViews& views = parts->GetViews(this->BRDF, this->Abort);
  // Lobes that need tiles fall between the usual nodes.
  const int nodes = this->Quick
                      ? this->NumberOfNodes / 2
                      : (table.Tiles.FineRows > 0 ? NodesOfTiles : 1) * this->NumberOfNodes;
  const MaterialPrecomputation::Kernels& knots =
    parts->GetKernels(this->BRDF, table.Angles, nodes, this->Abort,
      { this->Lamps != nullptr, degree, table.Azimuths / 2 }); // windows cut the kernels' nodes
  const double scale = this->Abort ? 0.0
                                   : SynthesizeRadiance(
                                       *parts, views, light, knots, degree, this->SmoothingDegree,
                                       [this](double share) { return this->Report(share); }, table);
  if (!(scale > 0.0))
  {
    return false;
  }
  MakeProfile(views, knots, scale, table);
  if (table.HasFloor)
  {
    table.Irradiance = ofEnvironment.GetIrradiance(
      this->Lamps ? nullptr : this->Rest, goOn, [&all]() { return MakeIrradiance(*all); });
  }
  return !table.HasFloor || table.Irradiance;
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const glm::dvec3 sum = this->Data->Evaluate(
    glm::make_vec3(n), glm::make_vec3(o), glm::make_vec3(t), this->Data->Lamps.get());
  measuredbrdf::AddRGB(sum, radiance);
}

//------------------------------------------------------------------------------
bool vtkTableRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  if (!this->Prepare())
  {
    return false;
  }
  const Tables& table = *this->Data;
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFEnvironmentTable", vtkBRDFEnvironmentTable);
  term.Constants = { { "HAS_FLOOR", table.HasFloor ? "1" : "0" }, { "SHARP_PART", "vec3(0.0)" },
    { "LAMPS_PART", "vec3(0.0)" }, { "TILE_PART", "vec2(-1.0)" } };
  term.Uniforms.push_back({ "brdfTableRows", { static_cast<float>(table.Rows) } });
  term.Uniforms.push_back({ "brdfTableAngles", { static_cast<float>(table.Angles) } });
  term.Uniforms.push_back(
    { "brdfTableLastView", { static_cast<float>(LobeViews::GetLastAngle() * 2.0 / Pi) } });
  term.Fetches = 3; // the profile and two view angles
  vtkBRDFShaderInputs::Texture& profile =
    AddTexture(term, "brdfTableProfile", ProfileTexels, table.HasFloor ? 2 : 1);
  profile.Components = 4;
  profile.Data = table.GetShaderProfile();
  vtkBRDFShaderInputs::Texture& radiance = AddTexture(term, "brdfTableRadiance", table.Columns,
    table.GetHeight(), table.Angles * (table.Azimuths + 1));
  radiance.SharedExponents = table.Radiance;
  radiance.Repeat[0] = true;
  const TableTiles& tiles = table.Tiles;
  if (!tiles.Places.empty())
  {
    term.Source = std::string(vtkBRDFEnvironmentTiles) + term.Source;
    term.Constants.back().Value = "brdfTilePositionINSTANCE(position, brdfTableRowsINSTANCE)";
    term.Uniforms.push_back({ "brdfTileAcross", { static_cast<float>(tiles.Across) } });
    vtkBRDFShaderInputs::Texture& places =
      AddTexture(term, "brdfTilePlaces", tiles.CountColumns(), tiles.CountRows(), 1);
    places.Components = 1;
    places.Data = tiles.Places;
    ++term.Fetches;
  }
  if (table.HasFloor)
  {
    constexpr int side = RadianceTable::IrradianceSide;
    AddTexture(term, "brdfTableIrradiance", side, side).SharedExponents = table.Irradiance->Texels;
    term.Uniforms.push_back({ "brdfTableIrradianceScale", { table.Irradiance->Scale } });
    term.Fetches += 2; // with its profile
  }
  form = vtkBRDFShaderInputs();
  form.QuantizationError = std::ldexp(1.0, -9);
  form.Description = "radiance table, " + std::to_string(table.Columns) + " x " +
                     std::to_string(table.Rows) + " axes" + GetTilesText(tiles) + " x " +
                     std::to_string(table.Angles) + " view angles x " +
                     std::to_string(table.Azimuths) + " azimuths";
  if (this->Data->Lamps)
  {
    this->Data->Lamps->AddTo(term);
    form.Description += "; " + std::to_string(this->Lamps->GetNumberOfLights()) +
                        " directional lights near the lobe's axis";
  }
  form.Terms.push_back(std::move(term));
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfRows, int, 9, 513);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfViewAngles, int, 2, 64);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfAzimuths, int, 4, 64);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, HarmonicDegree, int, 0, 1024);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, SmoothingDegree, double, 0.0, 1024.0);
measuredbrdfSetClampedMacro(vtkTableRadianceIntegrator, NumberOfNodes, int, 16, 1024);

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkTableRadianceIntegrator::GetSizes()
{
  return { { "rows", 9, 513, this->NumberOfRows,
             [this](int value) { this->SetNumberOfRows(value); } },
    { "view angles", 2, 64, this->NumberOfViewAngles,
      [this](int value) { this->SetNumberOfViewAngles(value); } },
    { "azimuths", 4, 64, this->NumberOfAzimuths,
      [this](int value) { this->SetNumberOfAzimuths(value); } } };
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* table = vtkTableRadianceIntegrator::SafeDownCast(source))
  {
    this->SetHarmonicDegree(table->HarmonicDegree);
    this->SetNumberOfNodes(table->NumberOfNodes);
    this->SetSmoothingDegree(table->SmoothingDegree);
    this->SetQuick(table->Quick);
  }
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkTableRadianceIntegrator::GetCandidateSizes(bool)
{
  const auto goOn = [this]() { return this->Report(0.0); };
  return this->BRDF->IsIsotropic()
           ? GetTableCandidates(CountPlannedLights(this->Environment, LampAngle, goOn) > 0)
           : std::vector<std::vector<int>>();
}

//------------------------------------------------------------------------------
double vtkTableRadianceIntegrator::EstimateCost()
{
  const bool hasTiles = TableTiles::GetFineRows(this->NumberOfRows) > 0;
  return PixelCosts::Table + (hasTiles ? PixelCosts::Tiles : 0.0);
}

//------------------------------------------------------------------------------
vtkIdType vtkTableRadianceIntegrator::EstimateTextureBytes()
{
  return GetTableBytes(this->NumberOfRows, this->NumberOfViewAngles, this->NumberOfAzimuths);
}

//------------------------------------------------------------------------------
void vtkTableRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRows: " << this->NumberOfRows << "\n";
  os << indent << "NumberOfViewAngles: " << this->NumberOfViewAngles << "\n";
  os << indent << "NumberOfAzimuths: " << this->NumberOfAzimuths << "\n";
  os << indent << "HarmonicDegree: " << this->HarmonicDegree << "\n";
  os << indent << "SmoothingDegree: " << this->SmoothingDegree << "\n";
  os << indent << "NumberOfNodes: " << this->NumberOfNodes << "\n";
  os << indent << "Quick: " << (this->Quick ? "On" : "Off") << "\n";
}
