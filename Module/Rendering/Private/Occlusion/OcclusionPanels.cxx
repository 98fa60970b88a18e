// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionPanels.h"

#include "SkyCodeText.h"
#include "vtkShaderProgram.h"

namespace measuredbrdf
{
namespace
{
// All light in the lobe, and what is hidden of it: of the rest of the light, of panels, together.
const char* const BeginShine =
  R"(  vec3 brdfLobeAll#M = max(brdfRest#M, vec3(1e-30)) * 0.3183098861837907;
  vec3 brdfLobeLost#M = brdfHiddenLobe#OUTVSOutput * brdfLobeAll#M;
  float brdfWhole#M = 1.0 / brdfLobe#M.z;
)";
const char* const Shine = R"(    vec2 seen;
    float shine = brdfWhole#M * brdfSkyPanelInLobe(
      panel.xyz, panel.w, brdfTurned#M, brdfKappa#M, vec2(z, brdfSlope#M.z), seen);
    float inLobe = brdfSkyPanelHidden(edge, brdfSkyPanelEnds(z, seen.x, seen.y));
    brdfSkyAddPanel(light, inLobe * brdfTrust#M, shine, brdfLobeAll#M, brdfLobeLost#M);
)";
const char* const EndShine = "  brdfHiddenLobe#OUTVSOutput = brdfLobeLost#M / brdfLobeAll#M;\n";

std::string Fill(std::string text, const OcclusionMember& member)
{
  vtkShaderProgram::Substitute(text, "#OUT", member.Out);
  vtkShaderProgram::Substitute(text, "#M", member.Number);
  vtkShaderProgram::Substitute(text, "#COUNT", std::to_string(member.Light->Panels.size()));
  return text;
}
}

std::string MakePanelCode(const OcclusionMember& member, PanelUse use)
{
  // How much less the harmonics say is hidden than the sectors.
  std::string text = "  float brdfInSectors#M = 0.0;\n";
  for (int s = 0; s < HiddenSky::Sectors; ++s)
  {
    text += "  brdfInSectors#M += brdfSkySquare(" + Bounds(s) + ");\n";
  }
  const bool shines = use == PanelUse::Draw && member.HasLobe();
  text += shines ? BeginShine : "";
  text += member.HasLobe() ? "" : "  float brdfTrust#M;\n";
  text += R"(  brdfInSectors#M = brdfSkyOpening ? 1.0 - brdfInSectors#M : brdfInSectors#M;
  brdfTrust#M = clamp(brdfSkyHidden / max(brdfInSectors#M, 1e-6), 0.0, 1.0);
  for (int k = 0; k < #COUNT; ++k)
  {
    vec4 panel = brdfSkyPanel#M[k];
    vec4 glow = brdfSkyPanelLight#M[k];
    vec3 direction = panel.xyz * brdfSkyAxes;
    float z = direction.z;
    vec4 azimuth = brdfSkyPanelAzimuth(direction, glow.w);
    vec2 ends = brdfSkyPanelEnds(z, glow.w, 0.0);
    vec4 sum = vec4(0.0);
)";
  for (int s = 0; s < HiddenSky::Sectors; ++s)
  {
    text += "    brdfSkyPanelSector(" + Along(s) + ", " + Bounds(s) + ", " + Tangents(s) +
            ", azimuth.xyz, ends, sum);\n";
  }
  text += R"(    float edge = brdfSkyPanelEdge(sum, z, ends, azimuth.w, brdfSkyOpening);
    float hidden = brdfSkyPanelHidden(edge, ends) * brdfTrust#M;
    vec3 light = glow.rgb * brdfSkyPanelRise(z, glow.w);
    brdfHiddenLight#OUTVSOutput += hidden * light;
)";
  text += shines ? Shine : "";
  text += use == PanelUse::Keep && member.HasLobe() ? "    brdfEdge#M[k] = edge;\n" : "";
  text += "  }\n";
  text += shines ? EndShine : "";
  return Fill(text, member);
}

std::string MakeKeptPanelCode(const OcclusionMember& member)
{
  std::string text = BeginShine;
  for (std::size_t k = 0; k < member.Light->Panels.size(); ++k)
  {
    std::string one = R"(  {
    vec4 panel = brdfSkyPanel#M[#K];
    float edge = brdfEdge#M[#K];
    vec4 glow = brdfSkyPanelLight#M[#K];
    float z = dot(panel.xyz, brdfSkyN);
    vec3 light = glow.rgb * brdfSkyPanelRise(z, glow.w);
)" + std::string(Shine) +
                      "  }\n";
    vtkShaderProgram::Substitute(one, "#K", std::to_string(k));
    text += one;
  }
  return Fill(text + EndShine, member);
}

void SetPanels(vtkShaderProgram* program, const std::string& number,
  const std::vector<EnvironmentPanels::Panel>& panels, const glm::dmat3& toEnvironment)
{
  std::vector<float> places; // and concentrations
  std::vector<float> lights; // and radii
  const auto add = [](std::vector<float>& values, const glm::dvec3& v, double last)
  {
    for (const double value : { v.x, v.y, v.z, last })
    {
      values.push_back(static_cast<float>(value));
    }
  };
  for (const EnvironmentPanels::Panel& panel : panels)
  {
    add(places, glm::transpose(toEnvironment) * panel.Direction, panel.Concentration);
    add(lights, panel.Irradiance, GetPanelRadius(panel));
  }
  if (!panels.empty())
  {
    const int count = static_cast<int>(panels.size());
    program->SetUniform4fv(("brdfSkyPanel" + number).c_str(), count, places.data());
    program->SetUniform4fv(("brdfSkyPanelLight" + number).c_str(), count, lights.data());
  }
}
} // namespace measuredbrdf
