// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFactoredRadianceIntegrator.h"

#include "EnvironmentPrecomputation.h"
#include "MaterialPrecomputation.h"
#include "ModuleShader.h"
#include "Printable.h"
#include "RadianceCore.h"
#include "Setters.h"
#include "TableCandidates.h" // for GetTableBytes
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentCore.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"
#include "vtkTableRadianceIntegrator.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace measuredbrdf;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr int NumberOfKnots = 32; // view angles of the kernels
constexpr int NumberOfNodes = 64;
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
bool vtkFactoredRadianceIntegrator::Begin()
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
      "Prepare: factored tables are for isotropic materials; "
      << (this->BRDF->GetName().empty() ? "this one" : measuredbrdf::Quote(this->BRDF->GetName()))
      << " is not.");
    return false;
  }
  auto broad = vtkSmartPointer<vtkTableRadianceIntegrator>::New();
  broad->SetBRDF(this->BRDF);
  broad->SetEnvironment(this->Environment);
  broad->SetRest(this->Rest);
  broad->SetNumberOfRows(this->NumberOfTableRows);
  broad->SetNumberOfViewAngles(this->NumberOfViewAngles);
  broad->SetNumberOfAzimuths(this->NumberOfAzimuths);
  broad->SetSmoothingDegree(this->SmoothingDegree);
  const auto parts = this->Shared ? this->Shared : std::make_shared<Precomputation>();
  broad->SetPrecomputation(parts);
  if (!broad->Prepare())
  {
    vtkErrorMacro("Prepare: the table of the broad part cannot be prepared.");
    return false;
  }
  broad->SetPrecomputation(nullptr);

  const auto harmonics = this->Environment->GetParts().GetHarmonics(
    this->Environment, this->Rest, this->NumberOfRows, [this]() { return this->Report(0.0); });
  const MaterialPrecomputation::Kernels& knots =
    parts->GetKernels(this->BRDF, NumberOfKnots, NumberOfNodes, this->Abort);
  auto core = std::make_unique<Core>(this->NumberOfRows);
  if (!harmonics || this->Abort ||
      !core->Make(*harmonics, parts->GetViews(this->BRDF, this->Abort), knots, this->NumberOfRows,
        this->SmoothingDegree, this->NumberOfFields,
        [this](double share) { return this->Report(share); }))
  {
    vtkErrorMacro("Prepare: aborted.");
    return false;
  }
  this->Sharp = std::move(core);
  this->Broad = broad;
  return true;
}

//------------------------------------------------------------------------------
void vtkFactoredRadianceIntegrator::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  glm::dvec3 sum = this->Sharp->Evaluate(glm::make_vec3(n), glm::make_vec3(o), glm::make_vec3(t));
  AddTo(this->Broad, n, o, t, &sum.x);
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += std::max(sum[c], 0.0);
  }
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
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFEnvironmentCore", vtkBRDFEnvironmentCore);
  std::string orders;
  for (const int order : core.Orders)
  {
    orders += (orders.empty() ? "" : ", ") + std::to_string(order);
  }
  const int modes = static_cast<int>(core.Orders.size());
  term.Constants = { { "CORE_MODES", std::to_string(modes) }, { "CORE_ORDERS", orders } };
  term.Uniforms.push_back(
    { "brdfCoreLastView", { static_cast<float>(LobeViews::GetLastAngle() * 2.0 / Pi) } });
  vtkBRDFShaderInputs::Texture profile;
  profile.Name = "brdfCoreProfile";
  profile.Components = 3;
  profile.Dimensions = { LobeViews::NumberOfViews, 1 + modes, 1 };
  profile.Data = core.Profile;
  vtkBRDFShaderInputs::Texture fields;
  fields.Name = "brdfCoreFields";
  fields.Components = 3;
  fields.Dimensions = { core.Columns, core.Rows, core.GetNumberOfFields() };
  fields.ThreeD = true;
  fields.HalfFloat = true;
  fields.Repeat[0] = true;
  fields.Data = core.Fields;
  term.Textures = { std::move(profile), std::move(fields) };
  inputs.Description += "; " + std::to_string(core.GetNumberOfFields()) + " maps of " +
                        std::to_string(core.Columns) + " x " + std::to_string(core.Rows) +
                        " of its sharp part";
  inputs.Terms.push_back(std::move(term));
  form = std::move(inputs);
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfRows, int, 9, 513);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfFields, int, 1, 64);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfTableRows, int, 9, 513);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfViewAngles, int, 2, 64);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, NumberOfAzimuths, int, 4, 64);
measuredbrdfSetClampedMacro(vtkFactoredRadianceIntegrator, SmoothingDegree, double, 1.0, 64.0);

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkFactoredRadianceIntegrator::GetSizes()
{
  return { { "rows", 9, 513, this->NumberOfRows }, { "maps", 1, 64, this->NumberOfFields },
    { "table rows", 9, 513, this->NumberOfTableRows },
    { "view angles", 2, 64, this->NumberOfViewAngles },
    { "azimuths", 4, 64, this->NumberOfAzimuths } };
}

//------------------------------------------------------------------------------
void vtkFactoredRadianceIntegrator::SetSize(int index, int value)
{
  switch (index)
  {
    case 0:
      return this->SetNumberOfRows(value);
    case 1:
      return this->SetNumberOfFields(value);
    case 2:
      return this->SetNumberOfTableRows(value);
    case 3:
      return this->SetNumberOfViewAngles(value);
    default:
      this->SetNumberOfAzimuths(value);
  }
}

//------------------------------------------------------------------------------
vtkIdType vtkFactoredRadianceIntegrator::EstimateTextureBytes()
{
  const vtkIdType texels =
    static_cast<vtkIdType>(2 * (this->NumberOfRows - 1)) * this->NumberOfRows;
  return GetTableBytes(this->NumberOfTableRows, this->NumberOfViewAngles, this->NumberOfAzimuths) +
         6 * texels * this->NumberOfFields;
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
