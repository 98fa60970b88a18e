// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAnisotropicTableRadianceIntegrator.h"

#include "AnisotropicSynthesis.h"
#include "AnisotropicTable.h"
#include "EnvironmentPrecomputation.h"
#include "HalfVector.h" // for Pi
#include "MaterialPrecomputation.h"
#include "ModuleShader.h"
#include "PixelCosts.h"
#include "Setters.h"
#include "TableCandidates.h"
#include "TableSynthesis.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentAnisotropic.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace measuredbrdf;

namespace
{
constexpr int NumberOfNodes = 64; // of the kernels' integrals over theta_i
}

struct vtkAnisotropicTableRadianceIntegrator::Tables : AnisotropicTable
{
  using AnisotropicTable::AnisotropicTable;
};

vtkStandardNewMacro(vtkAnisotropicTableRadianceIntegrator);

//------------------------------------------------------------------------------
vtkAnisotropicTableRadianceIntegrator::vtkAnisotropicTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkAnisotropicTableRadianceIntegrator::~vtkAnisotropicTableRadianceIntegrator() = default;

//------------------------------------------------------------------------------
bool vtkAnisotropicTableRadianceIntegrator::Begin()
{
  this->Abort = false; // one that an earlier run left
  if (!this->Environment || this->Environment->GetPixels().empty())
  {
    vtkErrorMacro("Prepare: there is no environment, or it is empty.");
    return false;
  }
  auto table = std::make_unique<Tables>(this->NumberOfRows, this->NumberOfViewAngles,
    this->NumberOfAzimuths, this->NumberOfViewAzimuths);
  if (!this->MakeTable(*table))
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  this->Data = std::move(table);
  return true;
}

//------------------------------------------------------------------------------
// False where it was aborted.
bool vtkAnisotropicTableRadianceIntegrator::MakeTable(Tables& table)
{
  const int degree = GetMapDegree(this->NumberOfRows);
  const auto parts = this->Shared ? this->Shared : std::make_shared<Precomputation>();
  EnvironmentPrecomputation& ofEnvironment = this->Environment->GetParts();
  const auto goOn = [this]() { return this->Report(0.0); };
  const auto harmonics = ofEnvironment.GetHarmonics(
    this->Environment, this->Rest, std::max(degree, IrradianceDegree), goOn);
  if (!harmonics)
  {
    return false;
  }
  const AnisotropicViews& views = parts->GetAnisotropicViews(this->BRDF, this->Abort);
  if (this->Abort)
  {
    return false;
  }
  const MaterialPrecomputation::AnisotropicKernels& knots = parts->GetAnisotropicKernels(
    this->BRDF, table.Angles, table.ViewAzimuths, NumberOfNodes, this->Abort);
  const double scale = this->Abort ? 0.0
                                   : SynthesizeAnisotropic(
                                       *harmonics, knots, degree,
                                       [this](double share) { return this->Report(share); }, table);
  if (!(scale > 0.0))
  {
    return false;
  }
  MakeAnisotropicProfile(views, knots, scale, table);
  if (table.HasFloor)
  {
    table.Irradiance = ofEnvironment.GetIrradiance(
      this->Rest, goOn, [&harmonics]() { return MakeIrradiance(*harmonics); });
  }
  return !table.HasFloor || table.Irradiance;
}

//------------------------------------------------------------------------------
void vtkAnisotropicTableRadianceIntegrator::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const glm::dvec3 sum =
    this->Data->Evaluate(glm::make_vec3(n), glm::make_vec3(o), glm::make_vec3(t));
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += sum[c];
  }
}

//------------------------------------------------------------------------------
int vtkAnisotropicTableRadianceIntegrator::GetNumberOfPeriods()
{
  return this->Data ? this->Data->Periods : 0;
}

//------------------------------------------------------------------------------
bool vtkAnisotropicTableRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  if (!this->Prepare())
  {
    return false;
  }
  const AnisotropicTable& table = *this->Data;
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(
    term, "vtkBRDFEnvironmentAnisotropic", vtkBRDFEnvironmentAnisotropic);
  term.Constants = { { "HAS_FLOOR", table.HasFloor ? "1" : "0" },
    { "PERIODS", std::to_string(table.Periods) + ".0" },
    { "VIEW_ANGLES", std::to_string(table.Angles) + ".0" },
    { "VIEW_AZIMUTHS", std::to_string(table.ViewAzimuths) + ".0" } };
  term.Uniforms.push_back(
    { "brdfTableLastView", { static_cast<float>(LobeViews::GetLastAngle() * 2.0 / Pi) } });
  const auto add = [&term](const char* name, int width, int height,
                     int depth) -> vtkBRDFShaderInputs::Texture&
  {
    vtkBRDFShaderInputs::Texture texture;
    texture.Name = name;
    texture.Dimensions = { width, height, depth };
    texture.ThreeD = depth > 1;
    term.Textures.push_back(std::move(texture));
    return term.Textures.back();
  };
  term.Fetches = 6; // two of the profile, four views
  vtkBRDFShaderInputs::Texture& profile =
    add("brdfTableProfile", AnisotropicViews::Angles, AnisotropicViews::Azimuths, 3);
  profile.Data = table.Profile;
  profile.Repeat[1] = true;
  vtkBRDFShaderInputs::Texture& radiance = add("brdfTableRadiance", table.Columns,
    table.Rows * table.ViewAzimuths, table.Angles * (table.Azimuths + 1));
  radiance.SharedExponents = table.Radiance;
  radiance.Repeat[0] = true;
  if (table.HasFloor)
  {
    add("brdfTableIrradiance", RadianceTable::IrradianceSide, RadianceTable::IrradianceSide, 1)
      .SharedExponents = table.Irradiance->Texels;
    term.Uniforms.push_back({ "brdfTableIrradianceScale", { table.Irradiance->Scale } });
    term.Fetches += 2; // with its profile
  }
  form = vtkBRDFShaderInputs();
  form.QuantizationError = std::ldexp(1.0, -9);
  form.Description = "anisotropic radiance table, " + std::to_string(table.Columns) + " x " +
                     std::to_string(table.Rows) + " axes x " + std::to_string(table.Azimuths) +
                     " azimuths x " + std::to_string(table.Angles) + " x " +
                     std::to_string(table.ViewAzimuths) + " views";
  form.Terms.push_back(std::move(term));
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkAnisotropicTableRadianceIntegrator, NumberOfRows, int, 9, 129);
measuredbrdfSetClampedMacro(vtkAnisotropicTableRadianceIntegrator, NumberOfViewAngles, int, 2, 32);
measuredbrdfSetClampedMacro(vtkAnisotropicTableRadianceIntegrator, NumberOfAzimuths, int, 4, 64);
measuredbrdfSetClampedMacro(
  vtkAnisotropicTableRadianceIntegrator, NumberOfViewAzimuths, int, 2, 32);

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkAnisotropicTableRadianceIntegrator::GetSizes()
{
  return { { "rows", 9, 129, this->NumberOfRows },
    { "view angles", 2, 32, this->NumberOfViewAngles },
    { "azimuths", 4, 64, this->NumberOfAzimuths },
    { "view azimuths", 2, 32, this->NumberOfViewAzimuths } };
}

//------------------------------------------------------------------------------
void vtkAnisotropicTableRadianceIntegrator::SetSize(int index, int value)
{
  switch (index)
  {
    case 0:
      return this->SetNumberOfRows(value);
    case 1:
      return this->SetNumberOfViewAngles(value);
    case 2:
      return this->SetNumberOfAzimuths(value);
    default:
      this->SetNumberOfViewAzimuths(value);
  }
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkAnisotropicTableRadianceIntegrator::GetCandidateSizes(bool)
{
  if (this->BRDF->IsIsotropic())
  {
    return {};
  }
  std::vector<std::vector<int>> sizes = GetAnisotropicCandidates();
  const auto goOn = [this]() { return this->Report(0.0); };
  if (CountPlannedLights(this->Environment, LampAngle, goOn) > 0)
  {
    sizes.pop_back(); // tables beside lamps take over
  }
  return sizes;
}

//------------------------------------------------------------------------------
double vtkAnisotropicTableRadianceIntegrator::EstimateCost()
{
  return 2.0 * PixelCosts::Table - PixelCosts::Pixel; // two tables in one pixel
}

//------------------------------------------------------------------------------
vtkIdType vtkAnisotropicTableRadianceIntegrator::EstimateTextureBytes()
{
  const vtkIdType columns = 2 * (this->NumberOfRows - 1);
  const vtkIdType maps = static_cast<vtkIdType>(this->NumberOfViewAngles) *
                         (this->NumberOfAzimuths + 1) * this->NumberOfViewAzimuths;
  return 4 * columns * this->NumberOfRows * maps +
         12 * 3 * AnisotropicViews::Angles * AnisotropicViews::Azimuths +
         4 * RadianceTable::IrradianceSide * RadianceTable::IrradianceSide;
}

//------------------------------------------------------------------------------
void vtkAnisotropicTableRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRows: " << this->NumberOfRows << "\n";
  os << indent << "NumberOfViewAngles: " << this->NumberOfViewAngles << "\n";
  os << indent << "NumberOfAzimuths: " << this->NumberOfAzimuths << "\n";
  os << indent << "NumberOfViewAzimuths: " << this->NumberOfViewAzimuths << "\n";
}
