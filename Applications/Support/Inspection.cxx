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

//------------------------------------------------------------------------------
std::string Line(const std::string& label, const std::string& value)
{
  std::string padded = label;
  padded.resize(std::max<std::size_t>(26, padded.size() + 1), ' ');
  return value.empty() ? "" : padded + value + "\n";
}

//------------------------------------------------------------------------------
std::string Short(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

// "indexOfRefraction" as "index of refraction"
std::string SplitWords(const std::string& camelCase)
{
  std::string words;
  for (const char c : camelCase)
  {
    words += c >= 'A' && c <= 'Z' ? std::string(" ") + static_cast<char>(c - 'A' + 'a')
                                  : std::string(1, c);
  }
  return words;
}

//------------------------------------------------------------------------------
std::string FormatModel(const ordered_json& d, const std::string& indent)
{
  std::string text = Line(indent + "model", d["model"]);
  const auto list = [](const ordered_json& values, const char* between)
  {
    std::string line;
    for (const ordered_json& value : values)
    {
      line += (line.empty() ? "" : between) + Short(value);
    }
    return line;
  };
  const ordered_json options = d.value("options", ordered_json::object());
  const ordered_json allNumbers = d.value("numbers", ordered_json::object());
  const ordered_json arrays = d.value("arrays", ordered_json::object());
  for (const auto& [name, option] : options.items())
  {
    text += Line(indent + SplitWords(name), option);
  }
  for (const auto& [name, numbers] : allNumbers.items())
  {
    text += Line(indent + SplitWords(name), list(numbers, ", "));
  }
  for (const auto& [name, array] : arrays.items())
  {
    text += Line(indent + SplitWords(name),
      list(array["shape"], " x ") + (array["channels"] == 3 ? " RGB triples" : " numbers"));
  }
  const ordered_json terms = d.value("terms", ordered_json::array());
  for (const ordered_json& term : terms)
  {
    text += FormatModel(term, indent + "  ");
  }
  return text;
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
  vtkBRDFShaderInputs form;
  brdf->GetShaderInputs(form);
  info["shader_inputs"] = { { "description", form.Description },
    { "texture_bytes", form.GetTextureBytes() }, { "resampling_error", form.ResamplingError },
    { "quantization_error", form.QuantizationError } };
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

//------------------------------------------------------------------------------
std::string FormatInspection(const ordered_json& info)
{
  std::string text =
    Line("name", info["name"]) + Line("source", info["source"]) + Line("format", info["format"]) +
    FormatModel(info, "") + Line("isotropic", info["isotropic"] ? "yes" : "no") +
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
  if (info.contains("transmission"))
  {
    text += FormatTransmission(info["transmission"]);
  }
  const std::string notes = info["notes"];
  return text + (notes.empty() ? "" : "\nnotes: " + notes + "\n");
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

//------------------------------------------------------------------------------
std::string FormatTransmission(const ordered_json& transmission)
{
  std::string text =
    "\n        transmittance\n"
    "        (view at that angle,       (light from that angle)    (light from that"
    " angle,\n"
    "        a white sky behind)                                    on the back)\n"
    "  angle      R       G       B         R       G       B         R       G"
    "       B\n";
  for (const ordered_json& row : transmission["per_angle"])
  {
    char part[64];
    std::snprintf(part, sizeof(part), "  %4.0f", row["degrees"].get<double>());
    text += part;
    for (const char* role : { "view", "light", "back_light" })
    {
      const ordered_json& rgb = row[role];
      std::snprintf(part, sizeof(part), "%s%7.4f %7.4f %7.4f", role[0] == 'v' ? "  " : "   ",
        rgb[0].get<double>(), rgb[1].get<double>(), rgb[2].get<double>());
      text += part;
    }
    text += "\n";
  }
  char line[200];
  std::snprintf(line, sizeof(line),
    "  reflected and transmitted together: at most %.4f; light on the back: %.4f transmitted%s\n",
    transmission["largest_reflectance_and_transmittance"].get<double>(),
    transmission["largest_transmittance_of_back"].get<double>(),
    transmission["gains_energy"] ? " (more light than it gets)" : "");
  text += line;
  if (!transmission["both_sides"])
  {
    return text + "  one side is measured; the other follows by reciprocity\n";
  }
  std::snprintf(line, sizeof(line),
    "  both sides are measured; they differ from reciprocity by %.4g, relative\n",
    transmission["reciprocity_error"].get<double>());
  return text + line;
}

namespace
{
constexpr double GlossExponent = 50.0;

//------------------------------------------------------------------------------
std::string CountLine(const char* label, const ordered_json& count)
{
  char line[80];
  std::snprintf(line, sizeof(line), "%-26s%lld\n", label, count.get<long long>());
  return line;
}
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

//------------------------------------------------------------------------------
std::string FormatMeshInspection(const ordered_json& info)
{
  char name[27];
  std::snprintf(name, sizeof(name), "%-26s", "mesh");
  std::string text = name + info["name"].get<std::string>() + "\n";
  text += CountLine("points", info["points"]) + CountLine("triangles", info["triangles"]) +
          CountLine("degenerate triangles", info["skipped_triangles"]);
  text += "\nunoccluded light: error of leaving out what this mesh hides of the environment\n"
          "  environment   material   relative L1\n";
  for (const ordered_json& row : info["unoccluded"])
  {
    char line[160];
    std::snprintf(line, sizeof(line), "  %-13s %-10s %5.1f %% +- %.1f %%\n",
      row["environment"].get<std::string>().c_str(), row["material"].get<std::string>().c_str(),
      100.0 * row["error"].get<double>(), 100.0 * row["uncertainty"].get<double>());
    text += line;
  }
  return text + "\nAs seen from everywhere; gloss: a Blinn-Phong lobe of exponent 50.\n";
}
} // namespace tool
