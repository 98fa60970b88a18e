// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionMember.h"

#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "OcclusionArrays.h"
#include "OcclusionBounce.h"
#include "SkyCodeText.h"
#include "vtkBRDFHiddenSky.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t LampsOfMixtures = 4; // of each of several materials

// The codes' frame, how much is hidden.
const char* const RestingCommonCode =
  "  mat3 brdfSkyAxes = brdfSkyFrame(brdfSkyN);\n"
  "  float brdfSkyHidden = clamp((BRDF_FIRST - 127.0) * BRDF_COSINE, 0.0, 1.0);\n";

const char* const ViewCommonCode =
  "  vec3 brdfSkyAcross = brdfSkyO - brdfSkyCosine * brdfSkyNormalVC;\n"
  "  brdfSkyAcross /= max(length(brdfSkyAcross), 1e-6);\n"
  "  float brdfSkyView = acos(clamp(brdfSkyCosine, BRDF_LEAST, 1.0)) * BRDF_VIEWS;\n"
  "  int brdfSkyKnot = min(int(brdfSkyView), BRDF_LAST_KNOT);\n"
  "  brdfSkyView -= float(brdfSkyKnot);\n";

// Both sides of three materials or four leave no varyings for lamps.
bool IsCrowded(const OcclusionLights& lights, bool twoSided)
{
  return twoSided && lights.size() > 2;
}
}

std::size_t OcclusionMember::CountLamps(
  const OcclusionLights& lights, bool twoSided, std::size_t member)
{
  const std::size_t mixed = IsCrowded(lights, twoSided) ? 0 : LampsOfMixtures;
  const std::size_t most = lights.size() > 1 ? mixed : OcclusionLight::MaximumLamps;
  return std::min(lights[member]->Lamps.size(), most);
}

// Nor do they leave any for what bounces.
bool OcclusionMember::Bounces(
  const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t member)
{
  return layout.Bounced && lights[member]->Bounce && !IsCrowded(lights, layout.TwoSided);
}

const char* OcclusionMember::GetSideName(std::size_t side) { return side == 0 ? "" : "Back"; }

OcclusionMember::OcclusionMember(const OcclusionLights& lights, const OcclusionLayout& layout,
  std::size_t side, std::size_t member)
  : Light(lights[member])
  , Member(member)
  , Side(GetSideName(side))
  , Number(std::to_string(member))
  , Out(this->Side + this->Number)
  , Lamps(CountLamps(lights, layout.TwoSided, member))
  , IsBouncing(Bounces(lights, layout, member))
{
}

std::vector<OcclusionMember::Varying> OcclusionMember::GetVaryings() const
{
  std::vector<Varying> varyings = { { "vec3", "brdfHiddenLight" + this->Out },
    { "vec3", "brdfHiddenLobe" + this->Out } };
  if (this->IsBouncing)
  {
    varyings.push_back({ "vec3", "brdfBounced" + this->Out });
  }
  for (std::size_t k = 0; k < (this->Lamps + 3) / 4; ++k)
  {
    varyings.push_back({ "vec4", "brdfLamps" + this->Out + "_" + std::to_string(k) });
  }
  return varyings;
}

std::string OcclusionMember::MakeOpenCode(bool declare) const
{
  std::string text;
  for (const Varying& varying : this->GetVaryings())
  {
    const bool isOdds = varying.Name.find("brdfHiddenLobe") == 0;
    text += "  " + (declare ? varying.Type + " " : std::string()) + varying.Name +
            "VSOutput = " + varying.Type + "(" +
            (varying.Type == "vec4" ? OpenMargin
              : isOdds              ? OpenOdds
                                    : "0.0") +
            ");\n";
  }
  return text;
}

std::string OcclusionMember::GetLamp(std::size_t k) const
{
  return "brdfLamps" + this->Out + "_" + std::to_string(k / 4) + "VSOutput." +
         std::string(1, "xyzw"[k % 4]);
}

std::string OcclusionMember::MakeLightCode() const
{
  const std::string sum = "brdfSum" + this->Number;
  std::string text = "  vec3 " + sum + " = vec3(0.0);\n";
  for (int j = 0; j < HiddenSky::TransferBytes; ++j)
  {
    text += "  " + sum + " += (" + Byte(HiddenSky::SectorBytes + j) + " - 127.0) * brdfSkyLight" +
            this->Number + "[" + std::to_string(j) + "];\n";
  }
  return text + "  brdfHiddenLight" + this->Out + "VSOutput = max(" + sum + ", vec3(0.0));\n";
}

std::string OcclusionMember::MakeContrastCode() const
{
  std::string text =
    R"(  brdfRest#M = brdfSkyIrradiance(brdfSkyRed#M, brdfSkyGreen#M, brdfSkyBlue#M, brdfSkyN);
  brdfContrast#M = brdfSkyContrast(brdfHiddenLight#OUTVSOutput, brdfRest#M, brdfSkyHidden);
)";
  vtkShaderProgram::Substitute(text, "#OUT", this->Out);
  vtkShaderProgram::Substitute(text, "#M", this->Number);
  return this->HasLobe() ? text : "";
}

std::string OcclusionMember::MakeLobeCode() const
{
  const std::string bounce = "brdfShareOf#M";
  std::string text = "  float brdfShareOf#M = 0.0;\n";
  if (this->HasLobe())
  {
    text +=
      R"(  vec3 brdfLobe#M =
    mix(brdfSkyLobes#M[brdfSkyKnot], brdfSkyLobes#M[brdfSkyKnot + 1], brdfSkyView);
  vec3 brdfTurned#M = brdfSkySlope(brdfLobe#M.xy, brdfSkyToModel, brdfSkyNormalVC, brdfSkyAcross);
  vec3 brdfSlope#M = brdfTurned#M * brdfSkyAxes;
  float brdfKappa#M = length(brdfTurned#M);
  vec2 brdfShare#M = vec2(0.0);
  vec3 brdfRiseLow#M, brdfRiseHigh#M;
  brdfSkyRise(brdfSlope#M.z, brdfKappa#M, brdfRiseLow#M, brdfRiseHigh#M);
)";
    for (int s = 0; s < HiddenSky::Sectors / 2; ++s)
    {
      text += "  brdfSkySectors(dot(" + Along(s) + ", brdfSlope#M.xy), " + Bounds(s) + ", " +
              Bounds(s + HiddenSky::Sectors / 2) +
              ", brdfRiseLow#M, brdfRiseHigh#M, brdfShare#M);\n";
    }
    text += "  brdfShareOf#M = clamp(brdfShare#M.x / max(brdfShare#M.y, 1e-30), 0.0, 1.0);\n"
            "  brdfShareOf#M = brdfSkyOpening ? 1.0 - brdfShareOf#M : brdfShareOf#M;\n";
  }
  if (this->IsBouncing)
  {
    text += OcclusionBounce::MakeMemberCode(this->Member, this->Side, bounce);
  }
  text += this->HasLobe() ? "  brdfHiddenLobe#OUTVSOutput = brdfSkyLobe(brdfShareOf#M, "
                            "brdfKappa#M * 0.6931471806, brdfContrast#M);\n"
                          : "";
  vtkShaderProgram::Substitute(text, "#OUT", this->Out);
  vtkShaderProgram::Substitute(text, "#M", this->Number);
  return text;
}

std::string OcclusionMember::MakeOddsCode() const
{
  const std::string name = "brdfHiddenLobe" + this->Out + "VSOutput";
  return this->HasLobe() ? "  " + name + " = brdfSkyOdds(" + name + ");\n" : "";
}

std::string OcclusionMember::MakeLampCode() const
{
  std::string text;
  for (std::size_t k = 0; k < this->Lamps; ++k)
  {
    const std::string lamp = this->Number + "_" + std::to_string(k);
    text += "  vec3 brdfLamp" + lamp + " = brdfSkyLamp" + this->Number + "[" + std::to_string(k) +
            "] * brdfSkyAxes;\n  vec2 brdfAzimuth" + lamp + " = brdfLamp" + lamp +
            ".xy / max(length(brdfLamp" + lamp + ".xy), 1e-6);\n  vec3 brdfBounds" + lamp +
            " = vec3(0.0);\n";
    for (int s = 0; s < HiddenSky::Sectors; ++s)
    {
      text += "  brdfSkyLampSector(" + Along(s) + ", " + Tangents(s) + ", brdfAzimuth" + lamp +
              ", brdfBounds" + lamp + ");\n";
    }
    text += "  " + this->GetLamp(k) + " = (brdfSkyOpening ? -1.0 : 1.0) * brdfSkyLampMargin(" +
            "brdfBounds" + lamp + ", brdfLamp" + lamp + ".z);\n";
    if (!this->Light->LampLight.empty())
    {
      text += "  brdfHiddenLight" + this->Out + "VSOutput += clamp(0.5 - " + this->GetLamp(k) +
              ", 0.0, 1.0) * max(brdfLamp" + lamp + ".z, 0.0) * brdfSkyLampLight" + this->Number +
              "[" + std::to_string(k) + "];\n";
    }
  }
  return text;
}

std::string OcclusionMember::DeclareResting() const
{
  std::string text;
  if (this->HasLobe())
  {
    text = "  vec3 brdfRest" + this->Number + " = vec3(0.0);\n  vec3 brdfContrast" + this->Number +
           " = vec3(0.0);\n";
  }
  const std::string edges = "brdfEdge" + this->Number + "[";
  const std::size_t panels = this->HasLobe() ? this->Light->Panels.size() : 0;
  text += panels > 0 ? "  float brdfTrust" + this->Number + " = 0.0;\n  float " + edges +
                         std::to_string(panels) + "];\n"
                     : "";
  for (std::size_t k = 0; k < panels; ++k)
  {
    text += "  " + edges + std::to_string(k) + "] = 0.0;\n";
  }
  return text;
}

std::vector<OcclusionMember> GetMembers(
  const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side)
{
  std::vector<OcclusionMember> members;
  for (std::size_t m = 0; m < lights.size(); ++m)
  {
    if (lights[m])
    {
      members.emplace_back(lights, layout, side, m);
    }
  }
  return members;
}

std::string DeclareCodes(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  std::string text;
  for (std::size_t k = 0; k < OcclusionArrays::Attributes; ++k)
  {
    const std::string number = std::to_string(k) + ";\n";
    text += "in vec4 brdfSky" + number + (layout.TwoSided ? "in vec4 brdfSkyBack" + number : "");
  }
  text += vtkBRDFHiddenSky;
  text += layout.Bounced ? OcclusionBounce::Declare(layout.TwoSided) : "";
  for (const OcclusionMember& member : GetMembers(lights, layout, 0))
  {
    const std::string& m = member.Number;
    const std::string lamps = "[" + std::to_string(member.Lamps) + "];\n";
    text += (member.IsBouncing ? OcclusionBounce::DeclareMember(member.Member) : "") +
            "uniform vec3 brdfSkyLight" + m + "[" + std::to_string(sky::Harmonics) +
            "];\nuniform vec3 brdfSkyLobes" + m + "[" + std::to_string(OcclusionLobes::Views) +
            "];\nuniform mat4 brdfSkyRed" + m + ", brdfSkyGreen" + m + ", brdfSkyBlue" + m + ";\n";
    if (member.HasPanels())
    {
      const std::string panels = "[" + std::to_string(member.Light->Panels.size()) + "]";
      text += "uniform vec4 brdfSkyPanel" + m + panels + ", brdfSkyPanelLight" + m + panels + ";\n";
    }
    if (member.Lamps > 0)
    {
      text += "uniform vec3 brdfSkyLamp" + m + lamps;
      text += member.Light->LampLight.empty()
                ? ""
                : "uniform vec3 brdfSkyLampLight" + m + lamps + "uniform float brdfSkyTurns" + m +
                    "[" + std::to_string(OcclusionLobes::Views) + "], brdfSkyLampReach" + m + ";\n";
    }
  }
  return text;
}

std::string UnpackNormal(std::size_t side)
{
  return std::string("  vec3 brdfCode0 = brdfSkyBytes(brdfSky") +
         OcclusionMember::GetSideName(side) +
         "0.x);\n  vec3 brdfSkyN = brdfSkyNormal(brdfCode0);\n";
}

std::string UnpackCode(std::size_t side, int bytes)
{
  std::string text;
  for (int k = 1; k < bytes / 3; ++k)
  {
    text += "  vec3 brdfCode" + std::to_string(k) + " = brdfSkyBytes(brdfSky" +
            OcclusionMember::GetSideName(side) + std::to_string(k / 4) + "." +
            std::string(1, "xyzw"[k % 4]) + ");\n";
  }
  return text;
}

std::string MakeRestingCommonCode()
{
  std::string text = RestingCommonCode;
  vtkShaderProgram::Substitute(text, "BRDF_FIRST", Byte(HiddenSky::SectorBytes));
  vtkShaderProgram::Substitute(
    text, "BRDF_COSINE", Number(HiddenSky::TransferStep * std::sqrt(4.0 * Pi) / Pi));
  std::string spans = "  float brdfSkySpans = 0.0";
  std::string bounds;
  for (int s = 0; s < HiddenSky::Sectors; ++s)
  {
    const std::string low = Byte(3 + 2 * s);
    const std::string high = Byte(4 + 2 * s);
    spans += " + " + high + " - " + low;
    bounds += "  vec2 " + Bounds(s) + " = brdfSkyOpening ? vec2(" + high + ", " + low +
              ") : vec2(" + low + ", " + high + ");\n";
    bounds += "  vec2 " + Tangents(s) + " = brdfSkyTangents(" + Bounds(s) + ");\n";
  }
  // Most points are open: they need no sums over sectors.
  return text + spans +
         ";\n  bool brdfSkyMatters = abs(brdfSkySpans) > 0.5;\n"
         "  bool brdfSkyOpening = brdfSkySpans < 0.0;\n" +
         bounds;
}

std::string MakeViewCommonCode()
{
  std::string text = ViewCommonCode;
  const double last = std::acos(MinimumViewCosine);
  vtkShaderProgram::Substitute(text, "BRDF_LEAST", Number(MinimumViewCosine));
  vtkShaderProgram::Substitute(text, "BRDF_VIEWS", Number((OcclusionLobes::Views - 1) / last));
  vtkShaderProgram::Substitute(text, "BRDF_LAST_KNOT", std::to_string(OcclusionLobes::Views - 2));
  return text;
}
} // namespace measuredbrdf
