// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionLamps.h"

#include "LampWindow.h"
#include "OcclusionLight.h"
#include "OcclusionMember.h"
#include "vtkShaderProgram.h"

#include <vector>

namespace measuredbrdf
{
std::string MakeTableLampCode(const OcclusionMember& member)
{
  std::string text =
    R"(  float brdfTurn#M =
    mix(brdfSkyTurns#M[brdfSkyKnot], brdfSkyTurns#M[brdfSkyKnot + 1], brdfSkyView);
  vec3 brdfAxis#M = normalize(brdfSkyToModel *
    (cos(brdfTurn#M) * brdfSkyNormalVC - sin(brdfTurn#M) * brdfSkyAcross));
)";
  if (!member.HasPanels())
  {
    text += R"(  vec3 brdfLobeAll#M = max(brdfRest#M, vec3(1e-30)) * 0.3183098861837907;
  vec3 brdfLobeLost#M = brdfHiddenLobe#OUTVSOutput * brdfLobeAll#M;
)";
  }
  for (std::size_t k = 0; k < member.Lamps; ++k)
  {
    std::string one = R"(  {
    vec3 lamp = brdfSkyLamp#M[#K];
    vec3 light = brdfSkyLampLight#M[#K] *
      (brdfSkyLampInTable(lamp, brdfAxis#M, brdfSkyLampReach#M) *
        brdfSkyLampInLobe(lamp, brdfSkyN, brdfTurned#M, brdfKappa#M, brdfLobe#M.z));
    brdfLobeAll#M += light;
    brdfLobeLost#M += clamp(0.5 - #MARGIN, 0.0, 1.0) * light;
  }
)";
    vtkShaderProgram::Substitute(one, "#K", std::to_string(k));
    vtkShaderProgram::Substitute(one, "#MARGIN", member.GetLamp(k));
    text += one;
  }
  text += "  brdfHiddenLobe#OUTVSOutput = brdfLobeLost#M / brdfLobeAll#M;\n";
  vtkShaderProgram::Substitute(text, "#OUT", member.Out);
  vtkShaderProgram::Substitute(text, "#M", member.Number);
  return text;
}

void SetTableLamps(
  vtkShaderProgram* program, const std::string& number, const OcclusionLight& light)
{
  std::vector<float> turns;
  for (const OcclusionLobes::Lobe& lobe : light.Lobes.GetLobes())
  {
    turns.push_back(static_cast<float>(lobe.Delta));
  }
  program->SetUniform1fv(
    ("brdfSkyTurns" + number).c_str(), static_cast<int>(turns.size()), turns.data());
  program->SetUniformf(
    ("brdfSkyLampReach" + number).c_str(), static_cast<float>(2.0 * LampWindow().Reach));
}
} // namespace measuredbrdf
