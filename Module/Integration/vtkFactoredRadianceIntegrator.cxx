// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFactoredRadianceIntegrator.h"

#include "EnvironmentPrecomputation.h"
#include "MaterialPrecomputation.h"
#include "PixelCosts.h"
#include "Printable.h"
#include "RadianceCore.h"
#include "Setters.h"
#include "ShaderWeights.h"
#include "TableCandidates.h" // for GetTableBytes
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
  // Both parts look at the same place of their maps: one text, the maps' before the table's.
  vtkBRDFShaderInputs::Term& term = inputs.Terms.at(0);
  term.Source = std::string(vtkBRDFEnvironmentCore) + term.Source;
  term.Shader = "vtkBRDFEnvironmentCore";
  const ShaderWeights weights(core);
  std::string uniforms, steps;
  for (int row = 0; row < weights.Rows; ++row)
  {
    steps += ShaderWeights::GetUnpacking(row);
  }
  int order = 0;
  for (std::size_t mode = 0; mode < core.Orders.size(); ++mode)
  {
    const int next = core.Orders[mode];
    for (; order < next; ++order)
    {
      steps += "brdfCoreTurnINSTANCE(at); ";
    }
    const std::string unit = "brdfCoreUnit" + std::to_string(mode);
    const float* const values = &core.Units[3 * mode];
    term.Uniforms.push_back({ unit, { values, values + 3 } });
    uniforms += "uniform vec3 " + unit + "INSTANCE;\n";
    const int number = 3 * static_cast<int>(mode);
    steps += std::string("sum += ") +
             (next > 0 ? "brdfCoreTurnedINSTANCE" : "brdfCoreFieldINSTANCE") + "(at) * (vec3(" +
             ShaderWeights::GetName(number) + ", " + ShaderWeights::GetName(number + 1) + ", " +
             ShaderWeights::GetName(number + 2) + ") * " + unit + "INSTANCE); ";
  }
  const int fields = core.GetNumberOfFields();
  term.Fetches += weights.Rows + fields;
  for (vtkBRDFShaderInputs::Constant& constant : term.Constants)
  {
    if (constant.Name == "SHARP_PART")
    {
      constant.Value = "brdfCoreINSTANCE(view, position, turn)";
    }
  }
  term.Constants.push_back({ "CORE_UNIFORMS", uniforms });
  term.Constants.push_back({ "CORE_STEPS", steps });
  term.Constants.push_back({ "CORE_FIELDS", std::to_string(fields) });
  const auto add =
    [&term](const char* name, int width, int height, bool half, const std::vector<float>& data)
  {
    vtkBRDFShaderInputs::Texture texture;
    texture.Name = name;
    texture.Dimensions = { width, height, 1 };
    texture.Components = half ? 3 : 4;
    texture.HalfFloat = half;
    texture.Repeat[0] = half; // maps are round
    texture.Data = data;
    term.Textures.push_back(std::move(texture));
  };
  add(
    "brdfCoreProfile", static_cast<int>(ShaderWeights::Size), weights.Rows, false, weights.Texels);
  add("brdfCoreFields", core.Columns, core.Rows * fields, true, core.Fields);
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
  return { { "rows", 8, 512, this->NumberOfRows }, { "maps", 1, 32, this->NumberOfFields },
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
  const vtkIdType texels = static_cast<vtkIdType>(2 * this->NumberOfRows) * this->NumberOfRows;
  return GetTableBytes(this->NumberOfTableRows, this->NumberOfViewAngles, this->NumberOfAzimuths) +
         6 * texels * this->NumberOfFields +
         16 * static_cast<vtkIdType>(ShaderWeights::Size) *
           ShaderWeights::CountRows(this->NumberOfFields);
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
