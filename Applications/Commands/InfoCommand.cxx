// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Inputs.h"
#include "Tool.h"

#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFAnalysis.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkRepresentationAdvisor.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

using nlohmann::ordered_json;

namespace
{
struct Options
{
  std::string File;
  bool Json = false;
};

//------------------------------------------------------------------------------
ordered_json Triple(const double rgb[3]) { return { rgb[0], rgb[1], rgb[2] }; }

//------------------------------------------------------------------------------
// How the material is stored: representation, parameterization, sizes, its own parameters.
ordered_json Describe(vtkBRDF* brdf);

ordered_json DescribeTable(vtkTabulatedBRDF* table)
{
  const bool half = table->GetParameterization() == vtkTabulatedBRDF::HALF_DIFFERENCE;
  const int* n = table->GetDimensions();
  ordered_json d;
  d["representation"] = "tabulated";
  d["parameterization"] = half ? "half/difference angles (phi_d, theta_d, theta_h)"
                               : "incident/outgoing angles (delta phi, theta_o, theta_i)";
  d["dimensions"] = { n[0], n[1], n[2] };
  d["azimuth_range_degrees"] = table->GetAzimuthRange() == vtkTabulatedBRDF::HALF_TURN ? 180 : 360;
  d["invalid_cells"] = table->GetNumberOfInvalidCells();
  return d;
}

ordered_json DescribeWarp(vtkAdaptiveWarpBRDF* warp)
{
  ordered_json d;
  d["representation"] = "adaptive warp";
  d["parameterization"] = "warped by visible normals (phi_i, theta_i, channel, y, x)";
  d["dimensions"] = warp->GetTables().Rgb.Shape;
  return d;
}

ordered_json DescribeSum(vtkSumBRDF* sum)
{
  ordered_json d;
  d["representation"] = "sum";
  d["terms"] = ordered_json::array();
  for (int k = 0; k < sum->GetNumberOfTerms(); ++k)
  {
    d["terms"].push_back(Describe(sum->GetTerm(k)));
  }
  return d;
}

ordered_json DescribeLambert(vtkLambertBRDF* lambert)
{
  ordered_json d;
  d["representation"] = "Lambert";
  d["diffuse"] = Triple(lambert->GetAlbedo());
  return d;
}

ordered_json DescribeBlinnPhong(vtkBlinnPhongBRDF* phong)
{
  ordered_json d;
  d["representation"] = "Blinn-Phong";
  d["specular"] = Triple(phong->GetSpecular());
  d["exponent"] = phong->GetExponent();
  return d;
}

ordered_json DescribeAshikhminShirley(vtkAshikhminShirleyBRDF* ashikhmin)
{
  ordered_json d;
  d["representation"] = "Ashikhmin-Shirley";
  d["specular"] = Triple(ashikhmin->GetSpecularScale());
  const double* diffuse = ashikhmin->GetDiffuse();
  const bool coupled = diffuse[0] > 0.0 || diffuse[1] > 0.0 || diffuse[2] > 0.0;
  const bool schlick = ashikhmin->GetFresnelModel() == vtkAshikhminShirleyBRDF::SCHLICK;
  d["fresnel_model"] = schlick ? "Schlick" : "dielectric";
  if (schlick || coupled)
  {
    d["reflectance"] = Triple(ashikhmin->GetReflectance());
  }
  if (!schlick)
  {
    d["index_of_refraction"] = ashikhmin->GetIndexOfRefraction();
  }
  if (coupled)
  {
    d["diffuse"] = Triple(diffuse);
  }
  d["exponents"] = { ashikhmin->GetExponentU(), ashikhmin->GetExponentV() };
  return d;
}

ordered_json DescribeDistribution(vtkDistributionBRDF* distribution)
{
  ordered_json d;
  d["representation"] = "distribution (D-BRDF)";
  d["parameterization"] = "p(theta_h, phi_h) and F(theta_d)";
  d["dimensions"] = { distribution->GetNumberOfThetaSamples(),
    distribution->GetNumberOfPhiSamples(), distribution->GetFresnel().size() / 3 };
  return d;
}

ordered_json DescribeBasis(vtkBasisBRDF* basis)
{
  const double* incident = basis->GetIncidentZone();
  const double* outgoing = basis->GetOutgoingZone();
  ordered_json d;
  d["representation"] = "basis";
  d["parameterization"] = "coefficients (phi_o, theta_o) per function of i";
  d["basis"] = vtkBasisBRDF::GetBasisName(basis->GetBasis());
  d["order"] = basis->GetOrder();
  d["incident_zone_degrees"] = { incident[0], incident[1] };
  d["outgoing_zone_degrees"] = { outgoing[0], outgoing[1] };
  d["dimensions"] = { basis->GetNumberOfPhi(), basis->GetNumberOfTheta(),
    basis->GetNumberOfFunctions() };
  d["incident_cosine"] = basis->GetIncidentCosine();
  d["outgoing_cosine"] = basis->GetOutgoingCosine();
  return d;
}

//------------------------------------------------------------------------------
// A class of materials, and what describes one of it.
struct Model
{
  std::function<bool(vtkBRDF*)> Includes;
  std::function<ordered_json(vtkBRDF*)> Describe;
};

template <typename BRDF>
Model MakeModel(ordered_json (*describe)(BRDF*))
{
  return { [](vtkBRDF* brdf) { return BRDF::SafeDownCast(brdf) != nullptr; },
    [describe](vtkBRDF* brdf) { return describe(BRDF::SafeDownCast(brdf)); } };
}

ordered_json Describe(vtkBRDF* brdf)
{
  static const std::vector<Model> models = { MakeModel(DescribeTable), MakeModel(DescribeWarp),
    MakeModel(DescribeSum), MakeModel(DescribeLambert), MakeModel(DescribeBlinnPhong),
    MakeModel(DescribeAshikhminShirley), MakeModel(DescribeDistribution),
    MakeModel(DescribeBasis) };
  for (const Model& model : models)
  {
    if (model.Includes(brdf))
    {
      return model.Describe(brdf);
    }
  }
  ordered_json d;
  d["representation"] = brdf->GetClassName();
  return d;
}

//------------------------------------------------------------------------------
// Which representation suits (thesis mode): measured, with the figures behind it.
ordered_json Advise(const std::string& file, vtkBRDF* brdf)
{
  vtkNew<vtkRepresentationAdvisor> advisor;
  advisor->SetInput(brdf);
  if (!advisor->Update())
  {
    throw tool::Error(file + ": " + tool::TakeErrorText());
  }
  const bool basis = advisor->GetRecommendation() == vtkRepresentationAdvisor::BASIS;
  return { { "representation", basis ? "basis" : "fit" }, { "order", advisor->GetOrder() },
    { "in_zone_residual", advisor->GetInZoneResidual() },
    { "negative_mass", advisor->GetNegativeMass() }, { "overshoot", advisor->GetOvershoot() },
    { "reason", advisor->GetReason() } };
}

//------------------------------------------------------------------------------
ordered_json Inspect(const Options& options)
{
  const tool::Material material = tool::LoadMaterial(options.File);
  vtkBRDF* brdf = material.BRDF;
  brdf->Prepare();
  vtkNew<vtkBRDFAnalysis> analysis;
  analysis->SetBRDF(brdf);
  if (!analysis->Update())
  {
    throw tool::Error(options.File + ": " + tool::TakeErrorText());
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
  vtkBRDFShaderInputs form;
  brdf->GetShaderInputs(form);
  info["shader_inputs"] = { { "description", form.Description },
    { "texture_bytes", form.GetTextureBytes() }, { "resampling_error", form.ResamplingError },
    { "quantization_error", form.QuantizationError } };
  if (!vtkBasisBRDF::SafeDownCast(brdf))
  {
    info["recommendation"] = Advise(options.File, brdf);
  }
  info["notes"] = material.Notes;
  return info;
}

//------------------------------------------------------------------------------
std::string Line(const std::string& label, const std::string& value)
{
  std::string padded = label;
  padded.resize(20, ' ');
  return value.empty() ? "" : padded + value + "\n";
}

//------------------------------------------------------------------------------
std::string Short(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

//------------------------------------------------------------------------------
std::string ShortTriple(const ordered_json& rgb)
{
  return Short(rgb[0]) + ", " + Short(rgb[1]) + ", " + Short(rgb[2]);
}

//------------------------------------------------------------------------------
std::string FormatRepresentation(const ordered_json& d, const std::string& indent)
{
  std::string text = Line(indent + "representation", d["representation"]);
  if (d.contains("parameterization"))
  {
    text += Line(indent + "parameterization", d["parameterization"]);
  }
  if (d.contains("dimensions"))
  {
    std::string sizes;
    for (const ordered_json& n : d["dimensions"])
    {
      sizes += (sizes.empty() ? "" : " x ") + std::to_string(n.get<long long>());
    }
    text += Line(indent + "sizes", sizes);
  }
  if (d.contains("azimuth_range_degrees"))
  {
    text += Line(indent + "azimuths",
      "0 to " + std::to_string(d["azimuth_range_degrees"].get<int>()) + " degrees");
  }
  if (d.contains("basis"))
  {
    const auto zone = [&d](const char* key)
    { return Short(d[key][0]) + " to " + Short(d[key][1]) + " degrees"; };
    text += Line(indent + "basis",
      d["basis"].get<std::string>() + ", order " + std::to_string(d["order"].get<int>()));
    text += Line(indent + "zones",
      "light " + zone("incident_zone_degrees") + ", view " + zone("outgoing_zone_degrees"));
    const bool in = d["incident_cosine"], out = d["outgoing_cosine"];
    text += Line(indent + "cosines carried",
      in && out ? "of light and view" : (in ? "of light" : (out ? "of view" : "none")));
  }
  for (const char* key : { "diffuse", "specular", "reflectance" })
  {
    if (d.contains(key))
    {
      text += Line(indent + key, ShortTriple(d[key]));
    }
  }
  if (d.contains("fresnel_model"))
  {
    text += Line(indent + "Fresnel term",
      d["fresnel_model"].get<std::string>() +
        (d.contains("index_of_refraction") ? ", index " + Short(d["index_of_refraction"]) : ""));
  }
  if (d.contains("exponent"))
  {
    text += Line(indent + "exponent", Short(d["exponent"]));
  }
  if (d.contains("exponents"))
  {
    text += Line(indent + "exponents", Short(d["exponents"][0]) + ", " + Short(d["exponents"][1]));
  }
  if (d.contains("terms"))
  {
    for (const ordered_json& term : d["terms"])
    {
      text += FormatRepresentation(term, indent + "  ");
    }
  }
  return text;
}

//------------------------------------------------------------------------------
std::string FormatText(const ordered_json& info)
{
  std::string text =
    Line("name", info["name"]) + Line("source", info["source"]) + Line("format", info["format"]) +
    FormatRepresentation(info, "") + Line("isotropic", info["isotropic"] ? "yes" : "no") +
    Line("negative values", std::to_string(info["negative_values"].get<long long>())) +
    Line("invalid values", std::to_string(info["invalid_values"].get<long long>())) +
    Line("range (1/sr)",
      "R " + Short(info["range"]["minimum"][0]) + " to " + Short(info["range"]["maximum"][0]) +
        ", G " + Short(info["range"]["minimum"][1]) + " to " + Short(info["range"]["maximum"][1]) +
        ", B " + Short(info["range"]["minimum"][2]) + " to " + Short(info["range"]["maximum"][2])) +
    Line("reciprocity error",
      Short(info["reciprocity_error"]) + " relative (RMS " + Short(info["reciprocity_rms_error"]) +
        ")" + (info["reciprocal_by_construction"] ? "; reciprocal by construction" : "")) +
    (info["negative_mass"] > 0.0
        ? Line("negative mass", Short(info["negative_mass"]) + " of all, before the clamp")
        : "") +
    Line("shader inputs", info["shader_inputs"]["description"]) +
    (info.contains("recommendation") ? Line("thesis mode", info["recommendation"]["reason"]) : "");
  text += "\n        directional albedo         reflectance\n"
          "        (view at that angle)       (light from that angle)\n"
          "  angle      R       G       B         R       G       B\n";
  for (std::size_t k = 0; k < info["albedo"].size(); ++k)
  {
    const ordered_json& albedo = info["albedo"][k]["rgb"];
    const ordered_json& reflectance = info["reflectance_per_angle"][k]["rgb"];
    char line[120];
    std::snprintf(line, sizeof(line), "  %4.0f  %7.4f %7.4f %7.4f   %7.4f %7.4f %7.4f\n",
      info["albedo"][k]["degrees"].get<double>(), albedo[0].get<double>(), albedo[1].get<double>(),
      albedo[2].get<double>(), reflectance[0].get<double>(), reflectance[1].get<double>(),
      reflectance[2].get<double>());
    text += line;
  }
  if (info["gains_energy"])
  {
    text += "  (a reflectance above 1: this material gives back more light than it gets)\n";
  }
  const std::string notes = info["notes"];
  return text + (notes.empty() ? "" : "\nnotes: " + notes + "\n");
}

//------------------------------------------------------------------------------
void Run(const Options& options)
{
  const ordered_json info = Inspect(options);
  // Names come from files: bytes that are no UTF-8 are replaced rather than fatal.
  tool::PrintOut(options.Json
                   ? info.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n"
                   : FormatText(info));
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddInfoCommand(CLI::App& app)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
    "info", "Describe a material: format, sizes, range, albedo per angle, reciprocity, bad values");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  command->add_flag("--json", options->Json, "Write JSON instead of text");
  command->footer("Example:\n  measured-brdf info gold-paint");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
