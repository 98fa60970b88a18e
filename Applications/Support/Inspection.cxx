// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Inspection.h"

#include "Inputs.h"
#include "Meshes.h"
#include "Methods.h"
#include "Progress.h"
#include "Tool.h"
#include "TracedSurface.h"

#include "vtkBRDFAnalysis.h"
#include "vtkBRDFData.h"
#include "vtkBRDFModels.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

using nlohmann::ordered_json;

namespace tool
{
namespace
{
//------------------------------------------------------------------------------
ordered_json Triple(const double rgb[3]) { return { rgb[0], rgb[1], rgb[2] }; }

//------------------------------------------------------------------------------
// How the material is stored: its model and the model's parameters.
ordered_json Describe(const vtkBRDFData& data)
{
  ordered_json d;
  d["model"] = data.Model;
  const auto insert = [&d](const char* key, auto values)
  {
    if (!values.empty())
    {
      d[key] = std::move(values);
    }
  };
  insert("options", data.Options);
  insert("numbers", data.Numbers);
  ordered_json arrays;
  for (const auto& [name, array] : data.Arrays)
  {
    arrays[name] = { { "shape", array.Shape }, { "channels", array.Channels } };
  }
  insert("arrays", arrays);
  ordered_json terms;
  for (const vtkBRDFData& term : data.Terms)
  {
    terms.push_back(Describe(term));
  }
  insert("terms", terms);
  return d;
}

ordered_json Describe(vtkBRDF* brdf)
{
  vtkBRDFData data;
  if (!vtkBRDFModels::Save(brdf, data).empty())
  {
    return { { "model", brdf->GetClassName() } };
  }
  return Describe(data);
}

//------------------------------------------------------------------------------
// Which representation suits (thesis mode): measured, with the figures behind it.
ordered_json Advise(vtkBRDF* brdf)
{
  constexpr int order = 6;
  const tool::Advice advice = tool::Advise(brdf, order);
  return { { "representation", advice.IsBasis ? "basis" : "fit" }, { "order", order },
    { "in_zone_residual", advice.InZoneResidual }, { "negative_mass", advice.NegativeMass },
    { "reason", advice.Reason } };
}
}

//------------------------------------------------------------------------------
ordered_json InspectMaterial(const Material& material)
{
  vtkBRDF* brdf = material.BRDF;
  brdf->Prepare();
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetBRDF(brdf);
  if (!analysis->Update())
  {
    throw Error(material.File + ": " + TakeErrorText());
  }

  ordered_json info = { { "name", material.Name }, { "source", material.Source },
    { "format", material.Format } };
  info.update(Describe(brdf));
  info["isotropic"] = brdf->IsIsotropic();
  info["reciprocal_by_construction"] = brdf->IsReciprocal();
  info["negative_values"] = material.NumberOfNegativeValues;
  info["invalid_values"] = material.NumberOfInvalidValues;
  info["negative_mass"] = analysis->GetNegativeMass();
  info["range"] = { { "minimum", Triple(analysis->GetMinimum()) },
    { "maximum", Triple(analysis->GetMaximum()) } };
  info["reciprocity_error"] = analysis->GetReciprocityError();
  info["reciprocity_rms_error"] = analysis->GetReciprocityRMSError();
  info["albedo"] = ordered_json::array();
  for (int k = 0; k < analysis->GetNumberOfAngles(); ++k)
  {
    double rgb[3];
    analysis->GetAlbedo(k, rgb);
    info["albedo"].push_back({ { "degrees", analysis->GetAngle(k) }, { "rgb", Triple(rgb) } });
    analysis->GetReflectance(k, rgb);
    info["reflectance_per_angle"].push_back(
      { { "degrees", analysis->GetAngle(k) }, { "rgb", Triple(rgb) } });
  }
  info["largest_albedo"] = analysis->GetLargestAlbedo();
  info["gains_energy"] = analysis->GetGainsEnergy();
  vtkBRDFShaderInputs inputs;
  brdf->GetShaderInputs(inputs);
  info["shader_inputs"] = { { "description", inputs.Description },
    { "texture_bytes", inputs.GetTextureBytes() }, { "resampling_error", inputs.ResamplingError },
    { "quantization_error", inputs.QuantizationError } };
  if (!vtkBasisBRDF::SafeDownCast(brdf))
  {
    info["recommendation"] = Advise(brdf);
  }
  if (material.Transmission)
  {
    info["transmission"] = InspectTransmission(material.Transmission, info);
  }
  info["notes"] = material.Notes;
  return info;
}

namespace
{
constexpr double EnergyLimit = 1.005; // as vtkBRDFAnalysis::GetGainsEnergy: the estimates' error
}

//------------------------------------------------------------------------------
std::array<double, 3> MeasureTransmittance(
  vtkBTDF* transmission, double degrees, TransmissionRole role)
{
  if (BackgroundWork::Get() && BackgroundWork::Get()->IsStopped())
  {
    throw Error("interrupted");
  }
  const double theta = vtkMath::RadiansFromDegrees(degrees);
  const int azimuths = transmission->IsIsotropic() ? 1 : 8;
  std::array<double, 3> mean{};
  for (int k = 0; k < azimuths; ++k)
  {
    const double phi = 2.0 * vtkMath::Pi() * k / azimuths;
    const double z = std::cos(theta);
    const double direction[3] = { std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
      role == TransmissionRole::BackLight ? -z : z };
    double rgb[3];
    role == TransmissionRole::View ? transmission->GetSkyTransmittance(direction, rgb)
                                   : transmission->GetTransmittance(direction, rgb);
    for (std::size_t c = 0; c < 3; ++c)
    {
      mean[c] += rgb[c] / azimuths;
    }
  }
  return mean;
}

//------------------------------------------------------------------------------
ordered_json InspectTransmission(vtkBTDF* transmission, const ordered_json& info)
{
  const bool both =
    transmission->GetFolded(vtkBTDF::FRONT) && transmission->GetFolded(vtkBTDF::BACK);
  ordered_json result = { { "both_sides", both } };
  if (both)
  {
    result["reciprocity_error"] = transmission->GetReciprocityError();
  }
  double largest = 0.0;
  double largestOfBack = 0.0;
  for (const ordered_json& row : info["reflectance_per_angle"])
  {
    const double degrees = row["degrees"];
    const auto back = MeasureTransmittance(transmission, degrees, TransmissionRole::BackLight);
    const auto light = MeasureTransmittance(transmission, degrees, TransmissionRole::Light);
    result["per_angle"].push_back({ { "degrees", degrees },
      { "view", MeasureTransmittance(transmission, degrees, TransmissionRole::View) },
      { "light", light }, { "back_light", back } });
    for (std::size_t c = 0; c < 3; ++c)
    {
      largest = std::max(largest, light[c] + row["rgb"][c].get<double>());
      largestOfBack = std::max(largestOfBack, back[c]);
    }
  }
  result["largest_reflectance_and_transmittance"] = largest;
  // What the back reflects is not here; what it lets through must not be more than what comes.
  result["largest_transmittance_of_back"] = largestOfBack;
  result["gains_energy"] = std::max(largest, largestOfBack) > EnergyLimit;
  return result;
}

namespace
{
constexpr double GlossExponent = 50.0;
}

//------------------------------------------------------------------------------
ordered_json InspectMesh(const std::string& file)
{
  const vtkSmartPointer<vtkPolyData> mesh = LoadMesh(file);
  const vtkSmartPointer<vtkTracedScene> traced = MakeTracedScene(mesh);
  double bounds[6];
  traced->GetBounds(bounds);
  ordered_json info = { { "name", file }, { "points", mesh->GetNumberOfPoints() },
    { "triangles", traced->GetNumberOfTriangles() },
    { "skipped_triangles", traced->GetNumberOfSkippedTriangles() }, { "bounds", bounds },
    { "unoccluded", ordered_json::array() } };
  vtkNew<vtkLambertBRDF> matte;
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetExponent(GlossExponent);
  for (int k = 0; k < vtkEmbeddedEnvironments::GetNumberOfEnvironments(); ++k)
  {
    const std::string name = vtkEmbeddedEnvironments::GetName(k);
    const vtkSmartPointer<vtkEnvironment> environment = LoadEnvironment(name);
    for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(matte), static_cast<vtkBRDF*>(gloss) })
    {
      const auto predictor = PredictOcclusion(traced, brdf, environment);
      info["unoccluded"].push_back(
        { { "environment", name }, { "material", brdf == matte.Get() ? "diffuse" : "gloss" },
          { "error", predictor->GetError() }, { "uncertainty", predictor->GetUncertainty() } });
    }
  }
  return info;
}
} // namespace tool
