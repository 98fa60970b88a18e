// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLightSetRadianceIntegrator.h"

#include "Candidates.h"
#include "DirectionPairs.h"
#include "EnvironmentPrecomputation.h"
#include "Lamps.h"
#include "LightLanes.h"
#include "LocalFrame.h"
#include "ModuleShader.h"
#include "ScopedErrorCapture.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkBRDFLightSet.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkLightSetGenerator.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace PixelCosts = measuredbrdf::PixelCosts;
using measuredbrdf::EnvironmentPrecomputation;
using measuredbrdf::GetSpread;
using measuredbrdf::LampBRDF;
using measuredbrdf::MakeLightTexture;

namespace
{
constexpr int MaximumUnrolled = 16;
constexpr std::size_t LightsAtOnce = 128;
const int PlannedCounts[] = { 64, 256, 1024, 4096 };
constexpr int MostPlannedLights = 256; // more cost seconds a frame without a graphics card

void AddLightTexture(vtkLightSet* lights, vtkBRDFShaderInputs::Term& term)
{
  const int count = lights->GetNumberOfLights();
  term.Fetches += 2 * count;
  term.Textures.push_back(MakeLightTexture(lights));
  term.Uniforms.push_back({ "brdfNumberOfLights", { static_cast<float>(count) } });
  term.Constants.push_back({ "LIGHT_UNIFORMS",
    "uniform sampler2D brdfLightsINSTANCE;\nuniform float brdfNumberOfLightsINSTANCE;" });
  term.Constants.push_back({ "ADD_LIGHTS",
    "int perRow = textureSize(brdfLightsINSTANCE, 0).x / 2;\n"
    "  for (int k = 0; k < int(brdfNumberOfLightsINSTANCE); ++k)\n  {\n"
    "    ivec2 texel = ivec2(2 * (k % perRow), k / perRow);\n"
    "    sum += brdfLightINSTANCE(texelFetch(brdfLightsINSTANCE, texel, 0),\n"
    "      texelFetch(brdfLightsINSTANCE, texel + ivec2(1, 0), 0).rgb, frame, o);\n  }" });
}

// Few lights one after the other, in uniforms: software renderers fetch slowly, and loop slowly.
void AddLightUniforms(vtkLightSet* lights, vtkBRDFShaderInputs::Term& term)
{
  std::string uniforms;
  std::string sum;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    const std::string number = std::to_string(k);
    double direction[3], irradiance[3];
    lights->GetDirection(k, direction);
    lights->GetIrradiance(k, irradiance);
    term.Uniforms.push_back(
      { "brdfDirection" + number, std::vector<float>(std::begin(direction), std::end(direction)) });
    term.Uniforms.push_back({ "brdfIrradiance" + number,
      std::vector<float>(std::begin(irradiance), std::end(irradiance)) });
    term.Uniforms.push_back(
      { "brdfSpread" + number, { static_cast<float>(GetSpread(lights, k)) } });
    uniforms += "uniform vec3 brdfDirection" + number + "INSTANCE;\nuniform vec3 brdfIrradiance" +
                number + "INSTANCE;\nuniform float brdfSpread" + number + "INSTANCE;\n";
    sum += "sum += BRDF_OPEN_LAMP(" + number + ") brdfLightINSTANCE(vec4(brdfDirection" + number +
           "INSTANCE, brdfSpread" + number + "INSTANCE), brdfIrradiance" + number +
           "INSTANCE, frame, o);\n  ";
  }
  term.Constants.push_back({ "LIGHT_UNIFORMS", uniforms });
  term.Constants.push_back({ "ADD_LIGHTS", sum });
}
}

vtkStandardNewMacro(vtkLightSetRadianceIntegrator);

//------------------------------------------------------------------------------
struct vtkLightSetRadianceIntegrator::Internals
{
  struct Light
  {
    glm::dvec3 Direction, Irradiance;
    double Spread;
  };
  vtkSmartPointer<vtkLightSet> Set;
  vtkSmartPointer<vtkBRDF> Shaded; // the material, or what knows soft light of it
  measuredbrdf::LightLanes Lanes;  // of it
  std::vector<Light> Lights;
};

//------------------------------------------------------------------------------
vtkLightSetRadianceIntegrator::vtkLightSetRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkLightSetRadianceIntegrator::~vtkLightSetRadianceIntegrator() = default;

//------------------------------------------------------------------------------
vtkCxxSetSmartPointerMacro(vtkLightSetRadianceIntegrator, LightSet, vtkLightSet);
vtkCxxSetSmartPointerMacro(vtkLightSetRadianceIntegrator, Generator, vtkLightSetGenerator);
measuredbrdfSetClampedMacro(vtkLightSetRadianceIntegrator, NumberOfLights, int, 1,
  static_cast<int>(vtkLightSetGenerator::MaximumNumberOfLights));

//------------------------------------------------------------------------------
vtkLightSet* vtkLightSetRadianceIntegrator::GetLightSet() { return this->LightSet; }

//------------------------------------------------------------------------------
vtkLightSetGenerator* vtkLightSetRadianceIntegrator::GetGenerator() { return this->Generator; }

//------------------------------------------------------------------------------
vtkLightSet* vtkLightSetRadianceIntegrator::GetCurrentLightSet()
{
  return this->Prepared ? this->Prepared->Set.Get() : nullptr;
}

//------------------------------------------------------------------------------
bool vtkLightSetRadianceIntegrator::NeedsEnvironment() { return !this->LightSet; }

//------------------------------------------------------------------------------
bool vtkLightSetRadianceIntegrator::Begin()
{
  vtkSmartPointer<vtkLightSet> lights = this->LightSet;
  std::string problem = "there is no light set, and no environment to make one of.";
  if (!lights && this->Environment && this->Environment->GetWidth() > 0)
  {
    lights = this->MakeLights(problem);
  }
  if (!lights)
  {
    vtkErrorMacro("Prepare: " << problem);
    return false;
  }
  const vtkSmartPointer<vtkBRDF> shaded =
    this->SoftLights ? this->BRDF->GetRenderable() : this->BRDF.Get();
  shaded->Prepare();
  this->Prepared.reset(new Internals{ lights, shaded, measuredbrdf::LightLanes(shaded), {} });
  this->Prepared->Lights.reserve(static_cast<std::size_t>(lights->GetNumberOfLights()));
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    Internals::Light light{ {}, {}, this->SoftLights ? GetSpread(lights, k) : 0.0 };
    lights->GetDirection(k, &light.Direction.x);
    lights->GetIrradiance(k, &light.Irradiance.x);
    this->Prepared->Lights.push_back(light);
  }
  return true;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkLightSet> vtkLightSetRadianceIntegrator::MakeLights(std::string& problem)
{
  this->Abort = false; // one that an earlier run left
  problem = "aborted.";
  const auto goOn = [this]() { return this->Report(0.0); };
  EnvironmentPrecomputation& parts = this->Environment->GetParts();
  if (!this->Generator)
  {
    return parts.GetLightSet(this->Environment, nullptr, this->NumberOfLights, goOn);
  }
  const measuredbrdf::ScopedErrorCapture reason(this->Generator);
  auto lights =
    parts.GetGeneratedSet(this->Environment, this->Generator, this->NumberOfLights, goOn);
  problem = reason.GetText().empty() ? problem : reason.GetText() + ".";
  return lights;
}

//------------------------------------------------------------------------------
void vtkLightSetRadianceIntegrator::IntegratePair(
  const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  // As the shader does, so that both agree at silhouettes.
  const glm::dvec3 view = measuredbrdf::LiftView(measuredbrdf::ToLocal(frame, glm::make_vec3(o)));
  std::array<glm::dvec3, LightsAtOnce> above, irradiances, values;
  std::size_t found = 0;
  glm::dvec3 sum(0.0);
  const auto addFound = [&]()
  {
    if (this->InLanes && found > 0)
    {
      this->Prepared->Lanes.Evaluate(found, above.data(), view, values.data());
    }
    for (std::size_t k = 0; k < found; ++k)
    {
      sum += above[k].z * values[k] * irradiances[k];
    }
    found = 0;
  };
  for (const Internals::Light& light : this->Prepared->Lights)
  {
    above[found] = measuredbrdf::ToLocal(frame, light.Direction);
    if (above[found].z > 0.0)
    {
      if (!this->InLanes)
      {
        this->Prepared->Shaded->EvaluateSoft(
          &above[found].x, &view.x, light.Spread, &values[found].x);
      }
      irradiances[found++] = light.Irradiance;
    }
    if (found == LightsAtOnce)
    {
      addFound();
    }
  }
  addFound();
  measuredbrdf::AddRGB(sum, radiance);
}

//------------------------------------------------------------------------------
bool vtkLightSetRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  if (!this->Prepare())
  {
    return false;
  }
  vtkLightSet* const lights = this->Prepared->Set;
  const int count = lights->GetNumberOfLights();
  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFLightSet", vtkBRDFLightSet);
  auto* areas = LampBRDF::SafeDownCast(this->BRDF);
  if (areas)
  {
    areas->AddTo(term);
  }
  (areas ? term.Fetches : term.Evaluations) += count;
  term.Constants.push_back(
    { "EVALUATE_LIGHT", areas              ? LampBRDF::GetFunction() + "(i, o)"
                        : this->SoftLights ? "brdfEvaluateSoft(i, o, light.w)"
                                           : "brdfEvaluate(i, o)" });
  if (this->Unrolled && count <= MaximumUnrolled)
  {
    AddLightUniforms(lights, term);
  }
  else
  {
    AddLightTexture(lights, term);
  }
  inputs = vtkBRDFShaderInputs();
  inputs.Description =
    std::to_string(count) + (this->SoftLights ? " soft" : " directional") + " lights";
  inputs.Terms.push_back(std::move(term));
  return true;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkLightSetRadianceIntegrator::GetInputsMTime()
{
  return std::max(
    { this->Superclass::GetInputsMTime(), this->LightSet ? this->LightSet->GetMTime() : 0,
      this->Generator ? this->Generator->GetMTime() : 0 });
}

//------------------------------------------------------------------------------
std::string vtkLightSetRadianceIntegrator::GetMethodDescription()
{
  return "a sum over a set of lights that replaces the environment";
}

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkLightSetRadianceIntegrator::GetSizes()
{
  return { { "lights", 1, vtkLightSetGenerator::MaximumNumberOfLights, this->NumberOfLights,
    [this](int value) { this->SetNumberOfLights(value); } } };
}

//------------------------------------------------------------------------------
void vtkLightSetRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* lights = vtkLightSetRadianceIntegrator::SafeDownCast(source))
  {
    this->SetGenerator(lights->Generator);
    this->SetLightSet(lights->LightSet);
    this->SetSoftLights(lights->SoftLights);
    this->SetUnrolled(lights->Unrolled);
  }
}

//------------------------------------------------------------------------------
std::string vtkLightSetRadianceIntegrator::GetSizesText()
{
  return std::to_string(this->NumberOfLights) + (this->SoftLights ? " soft lights" : " lights") +
         (this->Generator ? "" : " by variance");
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkLightSetRadianceIntegrator::GetCandidateSizes(bool all)
{
  std::vector<std::vector<int>> candidates;
  for (const int count : PlannedCounts)
  {
    if (all || (!this->BRDF->IsIsotropic() && count <= MostPlannedLights))
    {
      candidates.push_back({ count });
    }
  }
  return candidates;
}

//------------------------------------------------------------------------------
double vtkLightSetRadianceIntegrator::EstimateCost()
{
  return PixelCosts::Pixel + PixelCosts::Light * this->NumberOfLights;
}

//------------------------------------------------------------------------------
vtkIdType vtkLightSetRadianceIntegrator::EstimateTextureBytes()
{
  return 32 * static_cast<vtkIdType>(this->NumberOfLights);
}

//------------------------------------------------------------------------------
void vtkLightSetRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Generator: " << this->Generator.Get() << "\n";
  os << indent << "LightSet: " << this->LightSet.Get() << "\n";
  os << indent << "CurrentLightSet: " << this->GetCurrentLightSet() << "\n";
  os << indent << "SoftLights: " << (this->SoftLights ? "On" : "Off") << "\n";
  os << indent << "Unrolled: " << (this->Unrolled ? "On" : "Off") << "\n";
}
