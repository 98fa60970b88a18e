// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionShader.h"

#include "HalfVector.h" // for Pi
#include "HiddenSky.h"
#include "LocalFrame.h"
#include "OcclusionBounce.h"
#include "OcclusionLamps.h"
#include "OcclusionPanels.h"
#include "SkyCodeText.h"
#include "UniformVectors.h"
#include "vtkBRDFHiddenSky.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t LampsOfMixtures = 4; // of each of several materials
constexpr float LargestIrradiance = 1e30f;
// What varyings are where nothing is hidden.
const char* const OpenOdds = "-8.963"; // brdfSkyOdds(0)
const char* const OpenMargin = "3.0";  // HiddenSky::LargestMargin

// Both sides of three materials or four leave no varyings for lamps.
std::size_t CountLamps(const OcclusionLights& lights, bool twoSided, std::size_t member)
{
  const std::size_t mixed = twoSided && lights.size() > 2 ? 0 : LampsOfMixtures;
  const std::size_t most = lights.size() > 1 ? mixed : OcclusionLight::MaximumLamps;
  return std::min(lights[member]->Lamps.size(), most);
}

// Nor do they leave any for what bounces.
bool Bounces(const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t member)
{
  return layout.Bounced && lights[member]->Bounce && !(layout.TwoSided && lights.size() > 2);
}

// Whether a table holds a part of what the lobe shows of tested lamps.
bool HasTableLamps(const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t member)
{
  return CountLamps(lights, layout.TwoSided, member) > 0 && !lights[member]->LampLight.empty();
}

struct Varying
{
  std::string Type;
  std::string Name; // brdf...; stages add VSOutput
};

// What one side of the surface shows; the other one's names end in "Back".
const char* const SideNames[] = { "", "Back" };

void AddVaryings(const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side,
  std::vector<Varying>& varyings)
{
  for (std::size_t m = 0; m < lights.size(); ++m)
  {
    if (lights[m])
    {
      const std::string number = SideNames[side] + std::to_string(m);
      varyings.push_back({ "vec3", "brdfHiddenLight" + number });
      varyings.push_back({ "vec3", "brdfHiddenLobe" + number });
      if (Bounces(lights, layout, m))
      {
        varyings.push_back({ "vec3", "brdfBounced" + number });
      }
      for (std::size_t k = 0; k < (CountLamps(lights, layout.TwoSided, m) + 3) / 4; ++k)
      {
        varyings.push_back({ "vec4", "brdfLamps" + number + "_" + std::to_string(k) });
      }
    }
  }
}

std::vector<Varying> GetVaryings(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  std::vector<Varying> varyings = { { "vec3", "brdfSkyNormal" } };
  for (std::size_t side = 0; side < (layout.TwoSided ? 2 : 1); ++side)
  {
    AddVaryings(lights, layout, side, varyings);
  }
  return varyings;
}

// Where a side does not matter to any triangle, it is not evaluated: it hides nothing.
std::string MakeOpenOutputs(
  const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side)
{
  std::vector<Varying> varyings;
  AddVaryings(lights, layout, side, varyings);
  std::string text;
  for (const Varying& varying : varyings)
  {
    const bool isOdds = varying.Name.find("brdfHiddenLobe") == 0;
    text += "  " + varying.Name + "VSOutput = " + varying.Type + "(" +
            (varying.Type == "vec4" ? OpenMargin
              : isOdds              ? OpenOdds
                                    : "0.0") +
            ");\n";
  }
  return text;
}

// The code's floats of a side as bytes, but for the first three.
std::string UnpackCode(std::size_t side)
{
  std::string text;
  for (int k = 1; k < HiddenSky::Bytes / 3; ++k)
  {
    text += "  vec3 brdfCode" + std::to_string(k) + " = brdfSkyBytes(brdfSky" + SideNames[side] +
            std::to_string(k / 4) + "." + std::string(1, "xyzw"[k % 4]) + ");\n";
  }
  return text;
}

// From the normal and the view: what all materials have in common.
const char* const CommonCode =
  "  mat3 brdfSkyAxes = brdfSkyFrame(brdfSkyN);\n"
  "  vec3 brdfSkyAcross = brdfSkyO - brdfSkyCosine * brdfSkyNormalVC;\n"
  "  brdfSkyAcross /= max(length(brdfSkyAcross), 1e-6);\n"
  "  float brdfSkyView = acos(clamp(brdfSkyCosine, BRDF_LEAST, 1.0)) * BRDF_VIEWS;\n"
  "  int brdfSkyKnot = min(int(brdfSkyView), BRDF_LAST_KNOT);\n"
  "  brdfSkyView -= float(brdfSkyKnot);\n"
  "  float brdfSkyHidden = clamp((BRDF_FIRST - 127.0) * BRDF_COSINE, 0.0, 1.0);\n";

std::string MakeCommonCode()
{
  std::string text = CommonCode;
  const double last = std::acos(MinimumViewCosine);
  vtkShaderProgram::Substitute(text, "BRDF_LEAST", Number(MinimumViewCosine));
  vtkShaderProgram::Substitute(text, "BRDF_VIEWS", Number((OcclusionLobes::Views - 1) / last));
  vtkShaderProgram::Substitute(text, "BRDF_LAST_KNOT", std::to_string(OcclusionLobes::Views - 2));
  vtkShaderProgram::Substitute(text, "BRDF_FIRST", Byte(HiddenSky::SectorBytes));
  vtkShaderProgram::Substitute(
    text, "BRDF_COSINE", Number(HiddenSky::TransferStep * std::sqrt(4.0 * Pi) / Pi));
  // Most points are open: they need no sums over sectors.
  std::string highs = "0.0";
  for (int s = 0; s < HiddenSky::Sectors; ++s)
  {
    highs += " + " + Byte(4 + 2 * s);
  }
  return text + "  bool brdfSkyMatters = " + highs + " > 0.5;\n";
}

std::string MakeMemberCode(const OcclusionLights& lights, const OcclusionLayout& layout,
  std::size_t side, std::size_t member)
{
  const std::string m = std::to_string(member);
  const std::string out = SideNames[side] + m;
  std::string text = "  vec3 brdfSum" + m + " = vec3(0.0);\n";
  for (int j = 0; j < HiddenSky::TransferBytes; ++j)
  {
    text += "  brdfSum" + m + " += (" + Byte(HiddenSky::SectorBytes + j) +
            " - 127.0) * brdfSkyLight" + m + "[" + std::to_string(j) + "];\n";
  }
  text += "  brdfHiddenLight" + out + "VSOutput = max(brdfSum" + m + ", vec3(0.0));\n";
  text += "  if (brdfSkyMatters)\n  {\n";
  text +=
    "  vec3 brdfLobe" + m + " = mix(brdfSkyLobes" + m + "[brdfSkyKnot], brdfSkyLobes" + m +
    "[brdfSkyKnot + 1], brdfSkyView);\n" + "  vec3 brdfSlope" + m + " = brdfSkySlope(brdfLobe" + m +
    ".xy, brdfSkyToModel, brdfSkyNormalVC, brdfSkyAcross) * brdfSkyAxes;\n" + "  float brdfKappa" +
    m + " = length(brdfSlope" + m + ");\n  vec2 brdfShare" + m + " = vec2(0.0);\n";
  for (int s = 0; s < HiddenSky::Sectors; ++s)
  {
    text += "  brdfSkySector(" + Along(s) + ", " + Bounds(s) + ", brdfSlope" + m + ", brdfKappa" +
            m + ", brdfShare" + m + ");\n";
  }
  const std::string share =
    "clamp(brdfShare" + m + ".x / max(brdfShare" + m + ".y, 1e-30), 0.0, 1.0)";
  if (Bounces(lights, layout, member))
  {
    text += OcclusionBounce::MakeMemberCode(member, SideNames[side], share);
  }
  text += "  vec3 brdfRest" + m + " = brdfSkyIrradiance(brdfSkyRed" + m + ", brdfSkyGreen" + m +
          ", brdfSkyBlue" + m + ", brdfSkyN);\n";
  text += "  brdfHiddenLobe" + out + "VSOutput = brdfSkyLobe(" + share + ", brdfKappa" + m +
          " * 0.6931471806, brdfHiddenLight" + out + "VSOutput, brdfRest" + m +
          ", brdfSkyHidden);\n";
  const std::size_t panels = lights[member]->Panels.size();
  text += panels > 0 ? MakePanelCode(m, out, panels) : "";
  for (std::size_t k = 0; k < CountLamps(lights, layout.TwoSided, member); ++k)
  {
    const std::string lamp = m + "_" + std::to_string(k);
    text += "  vec3 brdfLamp" + lamp + " = brdfSkyLamp" + m + "[" + std::to_string(k) +
            "] * brdfSkyAxes;\n  vec2 brdfAzimuth" + lamp + " = brdfLamp" + lamp +
            ".xy / max(length(brdfLamp" + lamp + ".xy), 1e-6);\n  vec3 brdfBounds" + lamp +
            " = vec3(0.0);\n";
    for (int s = 0; s < HiddenSky::Sectors; ++s)
    {
      text += "  brdfSkyLampSector(" + Along(s) + ", " + Bounds(s) + ", brdfAzimuth" + lamp +
              ", brdfBounds" + lamp + ");\n";
    }
    text += "  brdfLamps" + out + "_" + std::to_string(k / 4) + "VSOutput." +
            std::string(1, "xyzw"[k % 4]) + " = brdfSkyLampMargin(brdfBounds" + lamp +
            ", brdfLamp" + lamp + ".z);\n";
    if (!lights[member]->LampLight.empty())
    {
      text += "  brdfHiddenLight" + out + "VSOutput += clamp(0.5 - brdfLamps" + out + "_" +
              std::to_string(k / 4) + "VSOutput." + std::string(1, "xyzw"[k % 4]) +
              ", 0.0, 1.0) * max(brdfLamp" + lamp + ".z, 0.0) * brdfSkyLampLight" + m + "[" +
              std::to_string(k) + "];\n";
    }
  }
  text += HasTableLamps(lights, layout, member)
            ? MakeTableLampCode(m, out, CountLamps(lights, layout.TwoSided, member), panels > 0)
            : "";
  text += "  brdfHiddenLobe" + out + "VSOutput = brdfSkyOdds(brdfHiddenLobe" + out + "VSOutput);\n";
  return text + "  }\n";
}

// A side of a point, outputs open where no triangle shows it.
std::string MakeSideCode(
  const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side)
{
  std::string text = MakeOpenOutputs(lights, layout, side);
  text += std::string("  {\n  vec3 brdfCode0 = brdfSkyBytes(brdfSky") + SideNames[side] + "0.x);\n";
  text += "  vec3 brdfSkyN = brdfSkyNormal(brdfCode0);\n"
          "  vec3 brdfSkyNormalVC = normalize(brdfSkyN * brdfSkyToModel);\n"
          "  float brdfSkyCosine = dot(brdfSkyNormalVC, brdfSkyO);\n";
  text += side == 0 ? "  brdfSkyNormalVSOutput = brdfSkyNormalVC;\n" : "";
  text += "  if (brdfSkyCosine > brdfSkyLeast)\n  {\n" + UnpackCode(side) + MakeCommonCode();
  for (std::size_t m = 0; m < lights.size(); ++m)
  {
    text += lights[m] ? MakeMemberCode(lights, layout, side, m) : "";
  }
  return text + "  }\n  }\n";
}

std::string DeclareMember(
  const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t member)
{
  const std::string m = std::to_string(member);
  const std::size_t lamps = CountLamps(lights, layout.TwoSided, member);
  return (Bounces(lights, layout, member) ? OcclusionBounce::DeclareMember(member) : "") +
         "uniform vec3 brdfSkyLight" + m + "[" + std::to_string(sky::Harmonics) +
         "];\nuniform vec3 brdfSkyLobes" + m + "[" + std::to_string(OcclusionLobes::Views) +
         "];\nuniform mat4 brdfSkyRed" + m + ";\nuniform mat4 brdfSkyGreen" + m +
         ";\nuniform mat4 brdfSkyBlue" + m + ";\n" +
         DeclarePanels(m, lights[member]->Panels.size()) +
         (lamps > 0 ? "uniform vec3 brdfSkyLamp" + m + "[" + std::to_string(lamps) + "];\n" : "") +
         (lamps > 0 && !lights[member]->LampLight.empty()
             ? "uniform vec3 brdfSkyLampLight" + m + "[" + std::to_string(lamps) + "];\n" +
                 DeclareTableLamps(m)
             : "");
}

// What the macros of DefineOcclusion read, of the side that the fragment's triangle shows.
std::string MakeFragmentCode(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  const bool twoSided = layout.TwoSided;
  std::string text = "  bool brdfSkyFront = dot(normalVCVSOutput, brdfSkyNormalVSOutput) > 0.0;\n";
  const auto shown = [twoSided](
                       const std::string& name, const std::string& rest, const std::string& other)
  { return "brdfSkyFront ? " + name + rest + " : " + (twoSided ? name + "Back" + rest : other); };
  for (std::size_t m = 0; m < lights.size(); ++m)
  {
    if (lights[m])
    {
      const std::string number = std::to_string(m);
      text += "  brdfHidden" + number + " = " +
              shown("brdfHiddenLight", number + "VSOutput", "vec3(brdfSkyOther)") + ";\n";
      if (Bounces(lights, layout, m))
      {
        text += "  brdfBounced" + number + " = " +
                shown("brdfBounced", number + "VSOutput", "vec3(0.0)") + ";\n";
      }
      text += "  brdfOpenLobe" + number + " = brdfSkyShare(" +
              shown("brdfHiddenLobe", number + "VSOutput",
                std::string("vec3(brdfSkyOther > 0.0 ? 8.963 : ") + OpenOdds + ")") +
              ");\n";
      for (std::size_t k = 0; k < CountLamps(lights, twoSided, m); ++k)
      {
        text +=
          "  brdfOpenLamp" + number + "[" + std::to_string(k) + "] = clamp(0.5 + (" +
          shown("brdfLamps",
            number + "_" + std::to_string(k / 4) + "VSOutput." + std::string(1, "xyzw"[k % 4]),
            "0.5 - min(brdfSkyOther, 1.0)") +
          "), 0.0, 1.0);\n";
      }
      for (std::size_t k = CountLamps(lights, twoSided, m); k < lights[m]->Lamps.size(); ++k)
      {
        text += "  brdfOpenLamp" + number + "[" + std::to_string(k) + "] = 1.0;\n";
      }
    }
  }
  return text;
}
}

std::string GetOcclusionKey(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  std::string key;
  for (const OcclusionLight* light : lights)
  {
    key += light ? "/sky" + std::to_string(light->Lamps.size()) + (light->IsSplit ? "s" : "w") +
                     (light->LampLight.empty() ? "" : "e") + std::to_string(light->Panels.size()) +
                     (light->Bounce ? "b" : "")
                 : "/open";
  }
  return key + (layout.TwoSided ? "/both" : "") + (layout.Bounced ? "/bounced" : "");
}

OcclusionText MakeOcclusionText(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  const bool twoSided = layout.TwoSided;
  OcclusionText text;
  for (std::size_t k = 0; k < OcclusionArrays::Attributes; ++k)
  {
    const std::string number = std::to_string(k);
    text.VertexDeclarations +=
      "in vec4 brdfSky" + number + ";\n" + (twoSided ? "in vec4 brdfSkyBack" + number + ";\n" : "");
  }
  text.VertexDeclarations +=
    "uniform mat3 brdfSkyToModel;\nuniform float brdfSkyParallel, brdfSkyLeast;\n";
  text.VertexDeclarations += vtkBRDFHiddenSky;
  text.VertexDeclarations += layout.Bounced ? OcclusionBounce::Declare(twoSided) : "";
  text.VertexCode = "  vec3 brdfSkyO = brdfSkyParallel > 0.5 ? vec3(0.0, 0.0, 1.0)\n"
                    "    : normalize(-vertexVCVSOutput.xyz);\n";
  for (std::size_t side = 0; side < (twoSided ? 2 : 1); ++side)
  {
    text.VertexCode += MakeSideCode(lights, layout, side);
  }
  for (std::size_t m = 0; m < lights.size(); ++m)
  {
    text.VertexDeclarations += lights[m] ? DeclareMember(lights, layout, m) : "";
  }
  text.FragmentDeclarations = twoSided ? "" : "uniform float brdfSkyOther;\n";
  // Visible share; brdfSkyOdds' inverse.
  text.FragmentDeclarations += "vec3 brdfSkyShare(vec3 odds)\n{\n"
                               "  vec3 open = 1.0 / (1.0 + exp2(odds));\n"
                               "  return clamp((open - 0.002) / 0.996, 0.0, 1.0);\n}\n";
  for (const Varying& varying : GetVaryings(lights, layout))
  {
    text.VertexDeclarations += "out " + varying.Type + " " + varying.Name + "VSOutput;\n";
    text.GeometryDeclarations += "in " + varying.Type + " " + varying.Name + "VSOutput[];\nout " +
                                 varying.Type + " " + varying.Name + "GSOutput;\n";
    text.GeometryCode += "  " + varying.Name + "GSOutput = " + varying.Name + "VSOutput[i];\n";
    text.FragmentDeclarations += "in " + varying.Type + " " + varying.Name + "VSOutput;\n";
  }
  text.FragmentCode = MakeFragmentCode(lights, layout);
  return text;
}

std::string DefineOcclusion(const OcclusionLight* light, std::size_t member)
{
  const std::string m = std::to_string(member);
  std::string text = "#undef BRDF_OPEN_IRRADIANCE\n#undef BRDF_OPEN_LOBE\n"
                     "#undef BRDF_OPEN_LAMP\n#undef BRDF_OPEN_LIGHTS\n#undef BRDF_BOUNCED\n";
  if (!light)
  {
    return text + "#define BRDF_OPEN_IRRADIANCE(e) (e)\n#define BRDF_OPEN_LOBE(l) (l)\n"
                  "#define BRDF_OPEN_LAMP(k)\n#define BRDF_OPEN_LIGHTS(l) (l)\n"
                  "#define BRDF_BOUNCED vec3(0.0)\n";
  }
  text += "vec3 brdfHidden" + m + " = vec3(0.0);\nvec3 brdfOpenLobe" + m + " = vec3(1.0);\n";
  if (!light->Lamps.empty())
  {
    text += "float brdfOpenLamp" + m + "[" + std::to_string(light->Lamps.size()) + "];\n";
  }
  text += light->Bounce
            ? "vec3 brdfBounced" + m + " = vec3(0.0);\n#define BRDF_BOUNCED brdfBounced" + m + "\n"
            : "#define BRDF_BOUNCED vec3(0.0)\n";
  text += light->IsSplit
            ? "#define BRDF_OPEN_IRRADIANCE(e) max((e) - brdfHidden" + m + ", vec3(0.0))\n"
            : "#define BRDF_OPEN_IRRADIANCE(e) ((e) * brdfOpenLobe" + m + ")\n";
  text += "#define BRDF_OPEN_LOBE(l) ((l) * brdfOpenLobe" + m + ")\n";
  text += light->Lamps.empty() ? "#define BRDF_OPEN_LAMP(k)\n"
                               : "#define BRDF_OPEN_LAMP(k) brdfOpenLamp" + m + "[k] *\n";
  text += light->Lamps.empty() ? "#define BRDF_OPEN_LIGHTS(l) ((l) * brdfOpenLobe" + m + ")\n"
                               : "#define BRDF_OPEN_LIGHTS(l) (l)\n";
  return text;
}

void SetOcclusionUniforms(vtkShaderProgram* program, const OcclusionLights& lights,
  const OcclusionSides& sides, const glm::dmat3& toModel, bool parallel,
  const std::vector<glm::dmat3>& toEnvironment)
{
  float columns[9];
  for (int k = 0; k < 9; ++k)
  {
    columns[k] = static_cast<float>(toModel[k / 3][k % 3]);
  }
  program->SetUniformMatrix3x3("brdfSkyToModel", columns);
  program->SetUniformf("brdfSkyParallel", parallel ? 1.0f : 0.0f);
  program->SetUniformf("brdfSkyLeast", static_cast<float>(sides.LeastCosine));
  if (!sides.Both)
  {
    program->SetUniformf("brdfSkyOther", sides.IsOtherClosed ? LargestIrradiance : 0.0f);
  }
  for (std::size_t m = 0; m < lights.size(); ++m)
  {
    if (!lights[m])
    {
      continue;
    }
    const std::string number = std::to_string(m);
    const sky::Colors light =
      lights[m]->GetLight(toEnvironment[m], CountLamps(lights, sides.Both, m));
    std::vector<glm::dvec3> vectors;
    for (const glm::dvec3& color : light)
    {
      vectors.push_back(color * static_cast<double>(HiddenSky::TransferStep));
    }
    SetVectors(program, "brdfSkyLight" + number, vectors);
    const char* const channels[] = { "brdfSkyRed", "brdfSkyGreen", "brdfSkyBlue" };
    for (int c = 0; c < 3; ++c)
    {
      glm::mat4 form = GetIrradianceForm(light, c); // symmetric
      program->SetUniformMatrix4x4((channels[c] + number).c_str(), &form[0][0]);
    }
    vectors.clear();
    for (const OcclusionLobes::Lobe& lobe : lights[m]->Lobes.GetLobes())
    {
      vectors.emplace_back(lobe.Across, lobe.Along, lobe.Integral);
    }
    SetVectors(program, "brdfSkyLobes" + number, vectors);
    if (Bounces(lights, { sides.Both, sides.Bounced }, m))
    {
      lights[m]->Bounce->SetUniforms(program, m, toEnvironment[m]);
    }
    SetPanels(program, number, lights[m]->Panels, toEnvironment[m]);
    const std::size_t lamps = CountLamps(lights, sides.Both, m);
    vectors.clear();
    for (std::size_t k = 0; k < lamps; ++k)
    {
      vectors.push_back(glm::transpose(toEnvironment[m]) * lights[m]->Lamps[k]);
    }
    SetVectors(program, "brdfSkyLamp" + number, vectors);
    vectors = lights[m]->LampLight;
    vectors.resize(std::min(vectors.size(), lamps));
    SetVectors(program, "brdfSkyLampLight" + number, vectors);
    if (HasTableLamps(lights, { sides.Both, sides.Bounced }, m))
    {
      SetTableLamps(program, number, *lights[m]);
    }
  }
}
} // namespace measuredbrdf
