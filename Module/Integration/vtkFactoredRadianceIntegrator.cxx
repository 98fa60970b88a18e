// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFactoredRadianceIntegrator.h"

#include "Candidates.h"
#include "DirectionPairs.h"
#include "EnvironmentPrecomputation.h"
#include "MaterialPrecomputation.h"
#include "ModuleShader.h"
#include "Printable.h"
#include "RadianceCore.h"
#include "Setters.h"
#include "TableSynthesis.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentCore.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"
#include "vtkTableRadianceIntegrator.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace measuredbrdf;

namespace
{
constexpr int KnotsPerViewAngle = 4; // of the kernels that the maps are made of
constexpr int KernelNodes = 64;
}

struct vtkFactoredRadianceIntegrator::Core : RadianceCore
{
  using RadianceCore::RadianceCore;
};

vtkStandardNewMacro(vtkFactoredRadianceIntegrator);

//------------------------------------------------------------------------------
vtkFactoredRadianceIntegrator::vtkFactoredRadianceIntegrator() = default;
vtkFactoredRadianceIntegrator::~vtkFactoredRadianceIntegrator() = default;

//------------------------------------------------------------------------------
void vtkFactoredRadianceIntegrator::SetLamps(vtkLightSet* lamps, vtkBRDF* form)
{
  this->Lamps = lamps;
  this->LampForm = form;
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkFactoredRadianceIntegrator::UsesBRDFOnGPU() { return this->Lamps && !this->LampForm; }

//------------------------------------------------------------------------------
bool vtkFactoredRadianceIntegrator::Begin()
{
  if (!this->HasLight() || !this->IsIsotropic("factored tables"))
  {
    return false;
  }
  const auto broad = this->NewTable();
  const auto parts = this->Shared ? this->Shared : std::make_shared<Precomputation>();
  broad->SetPrecomputation(parts);
  const bool broadly = this->PrepareLayer(broad);
  broad->SetPrecomputation(nullptr);
  auto core = std::make_unique<Core>(this->NumberOfRows);
  if (!broadly || !this->MakeCore(*parts, broad->GetNumberOfNodes(), *core))
  {
    vtkErrorMacro("Prepare: " << (this->Abort ? "aborted."
                                              : "the table of the broad part cannot be prepared."));
    return false;
  }
  this->Sharp = std::move(core);
  this->Broad = broad;
  return true;
}

//------------------------------------------------------------------------------
// Of the broad part.
vtkSmartPointer<vtkTableRadianceIntegrator> vtkFactoredRadianceIntegrator::NewTable()
{
  auto table = vtkSmartPointer<vtkTableRadianceIntegrator>::New();
  table->SetBRDF(this->BRDF);
  table->SetEnvironment(this->Environment);
  table->SetRest(this->Rest);
  table->SetLamps(this->Lamps, this->LampForm);
  table->SetNumberOfRows(this->NumberOfTableRows);
  table->SetNumberOfViewAngles(this->NumberOfViewAngles);
  table->SetNumberOfAzimuths(this->NumberOfAzimuths);
  table->SetSmoothingDegree(this->SmoothingDegree);
  return table;
}

//------------------------------------------------------------------------------
// False where it was aborted. tableNodes: of the table's kernels.
bool vtkFactoredRadianceIntegrator::MakeCore(Precomputation& parts, int tableNodes, Core& core)
{
  const int degree = GetMapDegree(this->NumberOfRows);
  const auto harmonics = this->Environment->GetParts().GetHarmonics(
    this->Environment, this->Rest, degree, [this]() { return this->Report(0.0); });
  if (!harmonics)
  {
    return false;
  }
  const LobeViews& views = parts.GetViews(this->BRDF, this->Abort);
  const MaterialPrecomputation::Use use{ false, degree, CoreMode::LargestOrder };
  const MaterialPrecomputation::Kernels& tableKnots =
    parts.GetKernels(this->BRDF, this->NumberOfViewAngles, tableNodes, this->Abort, use);
  const MaterialPrecomputation::Kernels& knots = parts.GetKernels(this->BRDF,
    KnotsPerViewAngle * (this->NumberOfViewAngles - 1) + 1, KernelNodes, this->Abort, use);
  if (this->Abort)
  {
    return false;
  }
  RadianceTable table(this->NumberOfTableRows, this->NumberOfViewAngles, this->NumberOfAzimuths);
  MakeProfile(views, tableKnots, 1.0, table);
  const CoreKernels kernels{ knots, tableKnots, table, views, this->SmoothingDegree,
    this->NumberOfRows, degree, parts };
  return core.Make(*harmonics, views, kernels, this->NumberOfFields,
    [this](double share) { return this->Report(share); });
}

//------------------------------------------------------------------------------
void vtkFactoredRadianceIntegrator::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  glm::dvec3 sum = this->Sharp->Evaluate(glm::make_vec3(n), glm::make_vec3(o), glm::make_vec3(t));
  AddTo(this->Broad, n, o, t, &sum.x);
  AddRGB(glm::max(sum, 0.0), radiance);
}

//------------------------------------------------------------------------------
bool vtkFactoredRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  vtkBRDFShaderInputs inputs;
  if (!this->Prepare() || !this->Broad->GetShaderInputs(inputs))
  {
    return false;
  }
  const RadianceCore& core = *this->Sharp;
  if (core.Orders.empty()) // constant light, or nothing sharp
  {
    form = std::move(inputs);
    return true;
  }
  // Both parts look at the same place of their maps: one text, the maps' before the table's.
  vtkBRDFShaderInputs::Term& term = inputs.Terms.at(0);
  term.Source = std::string(vtkBRDFEnvironmentCore) + term.Source;
  term.Shader = "vtkBRDFEnvironmentCore";
  const int modes = core.Orders.size();
  const int rows = RadianceCore::CountWeightRows(modes);
  std::string steps;
  for (int row = 0; row < rows; ++row)
  {
    const std::string number = std::to_string(row);
    steps += "vec4 weights" + number + " = texelFetch(brdfCoreProfileINSTANCE, ivec2(view, " +
             number + "), 0); ";
  }
  const auto getWeight = [](int number)
  { return "weights" + std::to_string(number / 4) + "." + "xyzw"[number % 4]; };
  int order = 0;
  for (int mode = 0; mode < modes; ++mode)
  {
    const int next = core.Orders[mode];
    for (; order < next; ++order)
    {
      steps += "brdfCoreTurnINSTANCE(at); ";
    }
    steps += std::string("sum += ") +
             (next > 0 ? "brdfCoreTurnedINSTANCE" : "brdfCoreFieldINSTANCE") + "(at) * vec3(" +
             getWeight(3 * mode) + ", " + getWeight(3 * mode + 1) + ", " + getWeight(3 * mode + 2) +
             "); ";
  }
  const int fields = core.GetNumberOfFields();
  term.Fetches += rows + fields;
  for (vtkBRDFShaderInputs::Constant& constant : term.Constants)
  {
    if (constant.Name == "SHARP_PART")
    {
      constant.Value = "brdfCoreINSTANCE(view, position, turn)";
    }
  }
  term.Constants.push_back({ "CORE_STEPS", steps });
  term.Constants.push_back({ "CORE_FIELDS", std::to_string(fields) });
  vtkBRDFShaderInputs::Texture& profile = AddTexture(term, "brdfCoreProfile", ProfileTexels, rows);
  profile.Components = 4;
  profile.Data = core.GetShaderWeights();
  vtkBRDFShaderInputs::Texture& maps =
    AddTexture(term, "brdfCoreFields", core.Columns, core.Rows * fields);
  maps.HalfFloat = true;
  maps.Repeat[0] = true; // they are round
  maps.Data = core.Fields;
  inputs.Description += "; " + std::to_string(fields) + " maps of " + std::to_string(core.Columns) +
                        " x " + std::to_string(core.Rows) + " of its sharp part";
  form = std::move(inputs);
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfRows, int, 8, 512);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfFields, int, 1, 32);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfTableRows, int, 9, 513);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfViewAngles, int, 2, 64);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfAzimuths, int, 4, 64);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, SmoothingDegree, double, 1.0, 64.0);

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkFactoredRadianceIntegrator::GetSizes()
{
  return { { "rows", 8, 512, this->NumberOfRows,
             [this](int value) { this->SetNumberOfRows(value); } },
    { "maps", 1, 32, this->NumberOfFields, [this](int value) { this->SetNumberOfFields(value); } },
    { "table rows", 9, 513, this->NumberOfTableRows,
      [this](int value) { this->SetNumberOfTableRows(value); } },
    { "view angles", 2, 64, this->NumberOfViewAngles,
      [this](int value) { this->SetNumberOfViewAngles(value); } },
    { "azimuths", 4, 64, this->NumberOfAzimuths,
      [this](int value) { this->SetNumberOfAzimuths(value); } } };
}

//------------------------------------------------------------------------------
vtkIdType vtkFactoredRadianceIntegrator::EstimateTextureBytes()
{
  const vtkIdType texels = static_cast<vtkIdType>(2 * this->NumberOfRows) * this->NumberOfRows;
  return GetTableBytes(this->NumberOfTableRows, this->NumberOfViewAngles, this->NumberOfAzimuths) +
         6 * texels * this->NumberOfFields +
         16 * ProfileTexels * RadianceCore::CountWeightRows(this->NumberOfFields);
}

//------------------------------------------------------------------------------
double vtkFactoredRadianceIntegrator::EstimateCost()
{
  return PixelCosts::Table + PixelCosts::Map * this->NumberOfFields;
}

//------------------------------------------------------------------------------
void vtkFactoredRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* factored = vtkFactoredRadianceIntegrator::SafeDownCast(source))
  {
    this->SetSmoothingDegree(factored->SmoothingDegree);
  }
}

//------------------------------------------------------------------------------
void vtkFactoredRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRows: " << this->NumberOfRows << "\n";
  os << indent << "NumberOfFields: " << this->NumberOfFields << "\n";
  os << indent << "NumberOfTableRows: " << this->NumberOfTableRows << "\n";
  os << indent << "NumberOfViewAngles: " << this->NumberOfViewAngles << "\n";
  os << indent << "NumberOfAzimuths: " << this->NumberOfAzimuths << "\n";
  os << indent << "SmoothingDegree: " << this->SmoothingDegree << "\n";
}
