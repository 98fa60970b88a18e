// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionShader.h"

#include "HiddenSky.h"
#include "OcclusionBounce.h"
#include "OcclusionKept.h"
#include "OcclusionLamps.h"
#include "OcclusionMember.h"
#include "OcclusionPanels.h"
#include "UniformVectors.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
constexpr float LargestIrradiance = 1e30f;

// A side of a point, outputs open where no triangle shows it.
std::string MakeSideCode(
  const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side)
{
  const std::vector<OcclusionMember> members = GetMembers(lights, layout, side);
  std::string text;
  for (const OcclusionMember& member : members)
  {
    text += member.MakeOpenCode(false);
  }
  text += "  {\n" + UnpackNormal(side);
  text += "  vec3 brdfSkyNormalVC = normalize(brdfSkyN * brdfSkyToModel);\n"
          "  float brdfSkyCosine = dot(brdfSkyNormalVC, brdfSkyO);\n";
  text += side == 0 ? "  brdfSkyNormalVSOutput = brdfSkyNormalVC;\n" : "";
  text += "  if (brdfSkyCosine > brdfSkyLeast)\n  {\n";
  const bool isCoded = !layout.Kept || std::any_of(members.begin(), members.end(),
                                         [](const OcclusionMember& member)
                                         { return member.HasLobe() || member.IsBouncing; });
  if (isCoded)
  {
    text += UnpackCode(side, layout.Kept ? HiddenSky::SectorBytes + 1 : HiddenSky::Bytes) +
            MakeRestingCommonCode() + MakeViewCommonCode();
  }
  for (const OcclusionMember& member : members)
  {
    const bool shines = member.HasLobe() || member.IsBouncing;
    text +=
      layout.Kept ? MakeKeptReading(member) : member.DeclareResting() + member.MakeLightCode();
    if (layout.Kept && !shines)
    {
      continue;
    }
    text += "  if (brdfSkyMatters)\n  {\n";
    text += layout.Kept ? "" : member.MakeContrastCode();
    text += member.MakeLobeCode();
    if (member.HasPanels() && layout.Kept)
    {
      text += member.HasLobe() ? MakeKeptPanelCode(member) : "";
    }
    else if (member.HasPanels())
    {
      text += MakePanelCode(member, PanelUse::Draw);
    }
    text += layout.Kept ? "" : member.MakeLampCode();
    text += member.HasTableLamps() ? MakeTableLampCode(member) : "";
    text += member.MakeOddsCode() + "  }\n";
  }
  return text + "  }\n  }\n";
}

std::vector<OcclusionMember::Varying> GetVaryings(
  const OcclusionLights& lights, const OcclusionLayout& layout)
{
  std::vector<OcclusionMember::Varying> varyings = { { "vec3", "brdfSkyNormal" } };
  for (std::size_t side = 0; side < (layout.TwoSided ? 2 : 1); ++side)
  {
    for (const OcclusionMember& member : GetMembers(lights, layout, side))
    {
      const auto own = member.GetVaryings();
      varyings.insert(varyings.end(), own.begin(), own.end());
    }
  }
  return varyings;
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
      if (OcclusionMember::Bounces(lights, layout, m))
      {
        text += "  brdfBounced" + number + " = " +
                shown("brdfBounced", number + "VSOutput", "vec3(0.0)") + ";\n";
      }
      text += "  brdfOpenLobe" + number + " = brdfSkyShare(" +
              shown("brdfHiddenLobe", number + "VSOutput",
                std::string("vec3(brdfSkyOther > 0.0 ? 8.963 : ") + OpenOdds + ")") +
              ");\n";
      for (std::size_t k = 0; k < OcclusionMember::CountLamps(lights, twoSided, m); ++k)
      {
        text +=
          "  brdfOpenLamp" + number + "[" + std::to_string(k) + "] = clamp(0.5 + (" +
          shown("brdfLamps",
            number + "_" + std::to_string(k / 4) + "VSOutput." + std::string(1, "xyzw"[k % 4]),
            "0.5 - min(brdfSkyOther, 1.0)") +
          "), 0.0, 1.0);\n";
      }
      for (std::size_t k = OcclusionMember::CountLamps(lights, twoSided, m);
           k < lights[m]->Lamps.size(); ++k)
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
                     (light->HasLobe ? "" : "m") + (light->Bounce ? "b" : "")
                 : "/open";
  }
  return key + (layout.TwoSided ? "/both" : "") + (layout.Bounced ? "/bounced" : "") +
         (layout.Kept ? "/kept" : "");
}

OcclusionNeeds CountOcclusionNeeds(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  const std::size_t sides = layout.TwoSided ? 2 : 1;
  return { layout.Kept ? CountKeptAttributes(lights, layout)
                       : sides * (OcclusionArrays::Attributes + (layout.Bounced ? 1 : 0)),
    4 * GetVaryings(lights, layout).size() };
}

OcclusionText MakeOcclusionText(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  const bool twoSided = layout.TwoSided;
  OcclusionText text;
  text.VertexDeclarations = DeclareCodes(lights, layout) +
                            "uniform mat3 brdfSkyToModel;\n"
                            "uniform float brdfSkyParallel, brdfSkyLeast;\n";
  for (const std::string& name :
    layout.Kept ? GetKeptNames(lights, layout) : std::vector<std::string>())
  {
    text.VertexDeclarations += "in vec4 " + name + ";\n";
  }
  text.VertexCode = "  vec3 brdfSkyO = brdfSkyParallel > 0.5 ? vec3(0.0, 0.0, 1.0)\n"
                    "    : normalize(-vertexVCVSOutput.xyz);\n";
  for (std::size_t side = 0; side < (twoSided ? 2 : 1); ++side)
  {
    text.VertexCode += MakeSideCode(lights, layout, side);
  }
  text.FragmentDeclarations = twoSided ? "" : "uniform float brdfSkyOther;\n";
  // Visible share; brdfSkyOdds' inverse.
  text.FragmentDeclarations += "vec3 brdfSkyShare(vec3 odds)\n{\n"
                               "  vec3 open = 1.0 / (1.0 + exp2(odds));\n"
                               "  return clamp((open - 0.002) / 0.996, 0.0, 1.0);\n}\n";
  for (const OcclusionMember::Varying& varying : GetVaryings(lights, layout))
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
      lights[m]->GetLight(toEnvironment[m], OcclusionMember::CountLamps(lights, sides.Both, m));
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
    if (OcclusionMember::Bounces(lights, { sides.Both, sides.Bounced }, m))
    {
      lights[m]->Bounce->SetUniforms(program, m, toEnvironment[m]);
    }
    SetPanels(program, number, lights[m]->Panels, toEnvironment[m]);
    const std::size_t lamps = OcclusionMember::CountLamps(lights, sides.Both, m);
    vectors.clear();
    for (std::size_t k = 0; k < lamps; ++k)
    {
      vectors.push_back(glm::transpose(toEnvironment[m]) * lights[m]->Lamps[k]);
    }
    SetVectors(program, "brdfSkyLamp" + number, vectors);
    vectors = lights[m]->LampLight;
    vectors.resize(std::min(vectors.size(), lamps));
    SetVectors(program, "brdfSkyLampLight" + number, vectors);
    if (!vectors.empty())
    {
      SetTableLamps(program, number, *lights[m]);
    }
  }
}
} // namespace measuredbrdf
