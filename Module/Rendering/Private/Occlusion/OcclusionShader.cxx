// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionShader.h"

#include "HalfVector.h" // for Pi
#include "HorizonCode.h"
#include "Lamps.h"
#include "LocalFrame.h"
#include "NumberText.h"
#include "TextureEnvironment.h"
#include "vtkActor.h"
#include "vtkBRDFBouncedLight.h"
#include "vtkBRDFHiddenSky.h"
#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <Eigen/Dense>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr float LargestIrradiance = 1e30f;
constexpr std::size_t LampsOfMixtures = 4; // of each of several materials

// What varyings are where nothing is hidden: the logarithm of odds, a lamp's margin.
constexpr const char* OpenOdds = "-8.963"; // brdfSkyOdds(0)
constexpr const char* OpenMargin = "3.0";  // HorizonCode::LargestMargin

// Arrays of vectors. Of no vectors: nothing, as GLSL has no empty arrays.
void SetVectors(
  vtkShaderProgram* program, const std::string& name, const std::vector<glm::dvec3>& vectors)
{
  const std::vector<glm::vec3> values(vectors.begin(), vectors.end());
  if (!values.empty())
  {
    program->SetUniform3fv(name.c_str(), static_cast<int>(values.size()), &values[0].x);
  }
}

void SetVectors(
  vtkShaderProgram* program, const std::string& name, const std::vector<glm::dvec4>& vectors)
{
  const std::vector<glm::vec4> values(vectors.begin(), vectors.end());
  if (!values.empty())
  {
    program->SetUniform4fv(name.c_str(), static_cast<int>(values.size()), &values[0].x);
  }
}

//------------------------------------------------------------------------------
// How text is made of templates.
using Words = std::vector<std::pair<std::string, std::string>>;

std::string Fill(std::string text, const Words& words)
{
  for (const auto& [word, meaning] : words)
  {
    vtkShaderProgram::Substitute(text, word, meaning);
  }
  return text;
}

std::string Number(double value) { return FixedText(value, 9); }

std::string Component(std::size_t k) { return std::string(1, "xyzw"[k % 4]); }

// Byte k of a point's code.
std::string Byte(int k) { return "brdfCode" + std::to_string(k / 3) + "." + "xyz"[k % 3]; }

// Text for each of the first sectors: its azimuth (#ALONG), its bounds, the lower one first, 255
// for 1 (#BOUNDS), those of the opposite sector (#FACING), tangents of its bounds (#TANGENTS), and
// the bytes that hold its bounds (#LOW, #HIGH).
std::string ForSectors(const std::string& text, int count = HorizonCode::Sectors)
{
  std::string all;
  for (int s = 0; s < count; ++s)
  {
    const double azimuth = 2.0 * Pi * s / HorizonCode::Sectors;
    all += Fill(text,
      { { "#ALONG", "vec2(" + Number(std::cos(azimuth)) + ", " + Number(std::sin(azimuth)) + ")" },
        { "#BOUNDS", "brdfSkyBounds" + std::to_string(s) },
        { "#FACING",
          "brdfSkyBounds" + std::to_string((s + HorizonCode::Sectors / 2) % HorizonCode::Sectors) },
        { "#TANGENTS", "brdfSkyTangents" + std::to_string(s) }, { "#LOW", Byte(3 + 2 * s) },
        { "#HIGH", Byte(4 + 2 * s) } });
  }
  return all;
}

const char* GetSideName(std::size_t side) { return side == 0 ? "" : "Back"; }

std::size_t CountSides(const OcclusionLayout& layout) { return layout.TwoSided ? 2 : 1; }

//------------------------------------------------------------------------------
// What hands a value to the fragment shader: a type, and a name to which stages add VSOutput.
struct Varying
{
  std::string Type;
  std::string Name;
  std::string Open; // its value where nothing is hidden
};

// A material of the shader on one side of the surface: 0, the one that codes of one side are about,
// or 1, whose names end in "Back". In its text, #M is the material's number, #SIDE the side's name
// and #OUT both.
class Member
{
public:
  Member(const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side,
    std::size_t member)
    : Light(lights[member])
    , HasLobe(Light->HasLobe)
    , HasPanels(!Light->Panels.empty())
    , Index(member)
    , Digits(std::to_string(member))
    , Side(GetSideName(side))
  {
    // Both sides of three materials or four leave no varyings for lamps, nor for what bounces.
    const bool isCrowded = layout.TwoSided && lights.size() > 2;
    const std::size_t most = isCrowded           ? 0
                             : lights.size() > 1 ? LampsOfMixtures
                                                 : OcclusionLight::MaximumLamps;
    this->Lamps = std::min(this->Light->Lamps.size(), most);
    this->IsBouncing = layout.Bounced && this->Light->Bounce && !isCrowded;
    this->HasTableLamps = this->HasLobe && this->Lamps > 0 && !this->Light->LampLight.empty();
  }

  const OcclusionLight* Light;
  std::size_t Lamps = 0; // that are tested: varyings are few
  bool IsBouncing = false;
  bool HasLobe;
  bool HasPanels;
  bool HasTableLamps = false; // a table holds a part of what the lobe shows of tested lamps
  std::size_t Index;

  std::vector<Varying> GetVaryings() const;
  std::string Declare() const;

  // Varyings of a point that hides nothing.
  std::string MakeOpenCode() const;

  // Hidden light.
  std::string MakeLightCode() const;

  // Where a point hides something at all: the hidden share of the lobe, of panels and of lamps.
  std::string MakeShareCode() const;

private:
  std::string Text(const std::string& text, const Words& more = {}) const
  {
    return Fill(Fill(text, more),
      { { "#OUT", this->Side + this->Digits }, { "#SIDE", this->Side }, { "#M", this->Digits } });
  }
  // Component k of lamps' varyings.
  std::string GetLamp(std::size_t k) const
  {
    return this->Text("brdfLamps#OUT_" + std::to_string(k / 4) + "VSOutput." + Component(k));
  }
  // Text for each tested lamp (#K); #MARGIN is where its margin is.
  std::string ForLamps(const std::string& text) const
  {
    std::string all;
    for (std::size_t k = 0; k < this->Lamps; ++k)
    {
      all += this->Text(text, { { "#K", std::to_string(k) }, { "#MARGIN", this->GetLamp(k) } });
    }
    return all;
  }
  std::string MakeLobeCode() const;
  std::string MakePanelCode() const;
  std::string MakeTableLampCode() const;

  std::string Digits; // of the material's number
  std::string Side;
};

std::vector<Member> GetMembers(
  const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side)
{
  std::vector<Member> members;
  for (std::size_t m = 0; m < lights.size(); ++m)
  {
    if (lights[m])
    {
      members.emplace_back(lights, layout, side, m);
    }
  }
  return members;
}

std::vector<Varying> Member::GetVaryings() const
{
  std::vector<Varying> varyings = { { "vec3", this->Text("brdfHiddenLight#OUT"), "0.0" },
    { "vec3", this->Text("brdfHiddenLobe#OUT"), OpenOdds } };
  if (this->IsBouncing)
  {
    varyings.push_back({ "vec3", this->Text("brdfBounced#OUT"), "0.0" });
  }
  for (std::size_t k = 0; k < (this->Lamps + 3) / 4; ++k)
  {
    varyings.push_back({ "vec4", this->Text("brdfLamps#OUT_" + std::to_string(k)), OpenMargin });
  }
  return varyings;
}

std::string Member::Declare() const
{
  std::string text = R"(uniform vec3 brdfSkyLight#M[#HARMONICS];
uniform vec3 brdfSkyLobes#M[#VIEWS];
uniform mat4 brdfSkyRed#M, brdfSkyGreen#M, brdfSkyBlue#M;
)";
  if (this->IsBouncing)
  {
    text += R"(uniform vec3 brdfBouncedLight#M[#BOUNCED];
uniform vec3 brdfBouncedLambert#M[#VIEWS];
uniform vec3 brdfBouncedLobe#M[#VIEWS];
)";
  }
  if (this->HasPanels)
  {
    text += "uniform vec4 brdfSkyPanel#M[#PANELS], brdfSkyPanelLight#M[#PANELS];\n";
  }
  if (this->Lamps > 0)
  {
    text += "uniform vec3 brdfSkyLamp#M[#LAMPS];\n";
    text += this->Light->LampLight.empty()
              ? ""
              : "uniform vec3 brdfSkyLampLight#M[#LAMPS];\n"
                "uniform float brdfSkyTurns#M[#VIEWS], brdfSkyLampReach#M;\n";
  }
  return this->Text(text, { { "#HARMONICS", std::to_string(sky::Harmonics) },
                            { "#VIEWS", std::to_string(OcclusionViews) },
                            { "#BOUNCED", std::to_string(BounceCode::Harmonics) },
                            { "#PANELS", std::to_string(this->Light->Panels.size()) },
                            { "#LAMPS", std::to_string(this->Lamps) } });
}

std::string Member::MakeOpenCode() const
{
  std::string text;
  for (const Varying& varying : this->GetVaryings())
  {
    text += "  " + varying.Name + "VSOutput = " + varying.Type + "(" + varying.Open + ");\n";
  }
  return text;
}

std::string Member::MakeLightCode() const
{
  std::string text = "  vec3 brdfSum#M = vec3(0.0);\n";
  for (int j = 0; j < HorizonCode::TransferBytes; ++j)
  {
    text += "  brdfSum#M += (" + Byte(HorizonCode::SectorBytes + j) +
            " - 127.0) * brdfSkyLight#M[" + std::to_string(j) + "];\n";
  }
  return this->Text(text + "  brdfHiddenLight#OUTVSOutput = max(brdfSum#M, vec3(0.0));\n");
}

std::string Member::MakeShareCode() const
{
  std::string text;
  if (this->HasLobe)
  {
    text = R"(  vec3 brdfRest#M =
    brdfSkyIrradiance(brdfSkyRed#M, brdfSkyGreen#M, brdfSkyBlue#M, brdfSkyN);
  vec3 brdfContrast#M = brdfSkyContrast(brdfHiddenLight#OUTVSOutput, brdfRest#M, brdfSkyHidden);
)";
  }
  text += this->MakeLobeCode();
  text += this->HasPanels ? this->MakePanelCode() : "";
  // Each lamp's margin, and what is hidden of it where the irradiance holds it.
  text += this->ForLamps(R"(  vec3 brdfLamp#M_#K = brdfSkyLamp#M[#K] * brdfSkyAxes;
  vec2 brdfAzimuth#M_#K = brdfLamp#M_#K.xy / max(length(brdfLamp#M_#K.xy), 1e-6);
  vec3 brdfBounds#M_#K = vec3(0.0);
)" + ForSectors("  brdfSkyLampSector(#ALONG, #TANGENTS, brdfAzimuth#M_#K, brdfBounds#M_#K);\n") +
                         R"(  #MARGIN = (brdfSkyOpening ? -1.0 : 1.0) *
    brdfSkyLampMargin(brdfBounds#M_#K, brdfLamp#M_#K.z);
)" + (this->Light->LampLight.empty() ? "" : R"(  brdfHiddenLight#OUTVSOutput +=
    clamp(0.5 - #MARGIN, 0.0, 1.0) * max(brdfLamp#M_#K.z, 0.0) * brdfSkyLampLight#M[#K];
)"));
  text += this->HasTableLamps ? this->MakeTableLampCode() : "";
  // Odds are what is interpolated between points.
  text += this->HasLobe
            ? "  brdfHiddenLobe#OUTVSOutput = brdfSkyOdds(brdfHiddenLobe#OUTVSOutput);\n"
            : "";
  return this->Text(text);
}

std::string Member::MakeLobeCode() const
{
  std::string text = "  float brdfShareOf#M = 0.0;\n";
  if (this->HasLobe)
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
)" +
      ForSectors(R"(  brdfSkySectors(dot(#ALONG, brdfSlope#M.xy), #BOUNDS, #FACING, brdfRiseLow#M,
    brdfRiseHigh#M, brdfShare#M);
)",
        HorizonCode::Sectors / 2) +
      R"(  brdfShareOf#M = clamp(brdfShare#M.x / max(brdfShare#M.y, 1e-30), 0.0, 1.0);
  brdfShareOf#M = brdfSkyOpening ? 1.0 - brdfShareOf#M : brdfShareOf#M;
)";
  }
  if (this->IsBouncing)
  {
    text += R"(  brdfBounced#OUTVSOutput = brdfBouncedRadiance(
    brdfBouncedIrradiance(brdfBounce#SIDE, brdfBouncedLight#M),
    mix(brdfBouncedLambert#M[brdfSkyKnot], brdfBouncedLambert#M[brdfSkyKnot + 1], brdfSkyView),
    mix(brdfBouncedLobe#M[brdfSkyKnot], brdfBouncedLobe#M[brdfSkyKnot + 1], brdfSkyView),
    brdfShareOf#M, brdfSkyHidden);
)";
  }
  if (this->HasLobe)
  {
    text += "  brdfHiddenLobe#OUTVSOutput =\n"
            "    brdfSkyLobe(brdfShareOf#M, brdfKappa#M * 0.6931471806, brdfContrast#M);\n";
  }
  return this->Text(text);
}

// All light in the lobe, and what is hidden of it: of the rest of the light, of panels, together.
const char* const BeginShine =
  R"(  vec3 brdfLobeAll#M = max(brdfRest#M, vec3(1e-30)) * 0.3183098861837907;
  vec3 brdfLobeLost#M = brdfHiddenLobe#OUTVSOutput * brdfLobeAll#M;
)";
const char* const Shine = R"(    vec2 seen;
    float shine = brdfSkyPanelInLobe(panel.xyz, panel.w, brdfTurned#M, brdfKappa#M,
      vec2(z, brdfSlope#M.z), seen) / brdfLobe#M.z;
    float inLobe = brdfSkyPanelHidden(edge, brdfSkyPanelEnds(z, seen.x, seen.y));
    brdfSkyAddPanel(light, inLobe * brdfTrust#M, shine, brdfLobeAll#M, brdfLobeLost#M);
)";
const char* const EndShine = "  brdfHiddenLobe#OUTVSOutput = brdfLobeLost#M / brdfLobeAll#M;\n";

// Bright panels of the map, each on its own: their light, and with the lobe what it loses of them.
std::string Member::MakePanelCode() const
{
  std::string text = this->HasLobe ? BeginShine : "";
  // How much less the harmonics say is hidden than the sectors.
  text += "  float brdfInSectors#M = 0.0;\n" +
          ForSectors("  brdfInSectors#M += brdfSkySquare(#BOUNDS);\n") +
          R"(  brdfInSectors#M = brdfSkyOpening ? 1.0 - brdfInSectors#M : brdfInSectors#M;
  float brdfTrust#M = clamp(brdfSkyHidden / max(brdfInSectors#M, 1e-6), 0.0, 1.0);
  for (int k = 0; k < #COUNT; ++k)
  {
    vec4 panel = brdfSkyPanel#M[k];
    vec4 glow = brdfSkyPanelLight#M[k];
    vec3 direction = panel.xyz * brdfSkyAxes;
    float z = direction.z;
    vec4 azimuth = brdfSkyPanelAzimuth(direction, glow.w);
    vec2 ends = brdfSkyPanelEnds(z, glow.w, 0.0);
    vec4 sum = vec4(0.0);
)" + ForSectors("    brdfSkyPanelSector(#ALONG, #BOUNDS, #TANGENTS, azimuth.xyz, ends, sum);\n") +
          R"(    float edge = brdfSkyPanelEdge(sum, z, ends, azimuth.w, brdfSkyOpening);
    float hidden = brdfSkyPanelHidden(edge, ends) * brdfTrust#M;
    vec3 light = glow.rgb * brdfSkyPanelRise(z, glow.w);
    brdfHiddenLight#OUTVSOutput += hidden * light;
)";
  text += this->HasLobe ? Shine : "";
  text += "  }\n";
  text += this->HasLobe ? EndShine : "";
  return this->Text(text, { { "#COUNT", std::to_string(this->Light->Panels.size()) } });
}

// After panels and the lamps' margins: what the table holds of lamps (LampWindow) is hidden by
// these, not by what is hidden of the rest.
std::string Member::MakeTableLampCode() const
{
  std::string text = R"(  float brdfTurn#M =
    mix(brdfSkyTurns#M[brdfSkyKnot], brdfSkyTurns#M[brdfSkyKnot + 1], brdfSkyView);
  vec3 brdfAxis#M = normalize(brdfSkyToModel *
    (cos(brdfTurn#M) * brdfSkyNormalVC - sin(brdfTurn#M) * brdfSkyAcross));
)";
  text += this->HasPanels ? "" : BeginShine;
  return this->Text(text + this->ForLamps(R"(  {
    vec3 lamp = brdfSkyLamp#M[#K];
    vec3 light = brdfSkyLampLight#M[#K] *
      (brdfSkyLampInTable(lamp, brdfAxis#M, brdfSkyLampReach#M) *
        brdfSkyLampInLobe(lamp, brdfSkyN, brdfTurned#M, brdfKappa#M, brdfLobe#M.z));
    brdfLobeAll#M += light;
    brdfLobeLost#M += clamp(0.5 - #MARGIN, 0.0, 1.0) * light;
  }
)") + EndShine);
}

//------------------------------------------------------------------------------
// What all materials have in common: attributes, uniforms and functions.
std::string DeclareCodes(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  std::string text;
  for (std::size_t side = 0; side < CountSides(layout); ++side)
  {
    const std::string name = GetSideName(side);
    for (std::size_t k = 0; k < OcclusionArrays::Attributes; ++k)
    {
      text += "in vec4 brdfSky" + name + std::to_string(k) + ";\n";
    }
    text += layout.Bounced ? "in vec3 brdfBounce" + name + ";\n" : "";
  }
  text += vtkBRDFHiddenSky;
  text += layout.Bounced ? vtkBRDFBouncedLight : "";
  for (const Member& member : GetMembers(lights, layout, 0))
  {
    text += member.Declare();
  }
  return text;
}

std::string UnpackNormal(std::size_t side)
{
  return Fill("  vec3 brdfCode0 = brdfSkyBytes(brdfSky#SIDE0.x);\n"
              "  vec3 brdfSkyN = brdfSkyNormal(brdfCode0);\n",
    { { "#SIDE", GetSideName(side) } });
}

// The bytes of a side's code, and what follows from them: the code's frame, how much is hidden,
// sectors' bounds. Most points are open: they need no sums over sectors.
std::string UnpackCode(std::size_t side)
{
  std::string text;
  for (std::size_t k = 1; k < static_cast<std::size_t>(HorizonCode::Bytes) / 3; ++k)
  {
    text += "  vec3 brdfCode" + std::to_string(k) + " = brdfSkyBytes(brdfSky" + GetSideName(side) +
            std::to_string(k / 4) + "." + Component(k) + ");\n";
  }
  text += "  mat3 brdfSkyAxes = brdfSkyFrame(brdfSkyN);\n"
          "  float brdfSkyHidden = clamp((" +
          Byte(HorizonCode::SectorBytes) + " - 127.0) * " +
          Number(HorizonCode::TransferStep * std::sqrt(4.0 * Pi) / Pi) + ", 0.0, 1.0);\n";
  return text + "  float brdfSkySpans = 0.0" + ForSectors(" + #HIGH - #LOW") +
         ";\n  bool brdfSkyMatters = abs(brdfSkySpans) > 0.5;\n"
         "  bool brdfSkyOpening = brdfSkySpans < 0.0;\n" +
         ForSectors("  vec2 #BOUNDS = brdfSkyOpening ? vec2(#HIGH, #LOW) : vec2(#LOW, #HIGH);\n"
                    "  vec2 #TANGENTS = brdfSkyTangents(#BOUNDS);\n");
}

std::string MakeViewCode()
{
  return Fill(R"(  vec3 brdfSkyAcross = brdfSkyO - brdfSkyCosine * brdfSkyNormalVC;
  brdfSkyAcross /= max(length(brdfSkyAcross), 1e-6);
  float brdfSkyView = acos(clamp(brdfSkyCosine, #LEAST, 1.0)) * #VIEWS;
  int brdfSkyKnot = min(int(brdfSkyView), #LAST);
  brdfSkyView -= float(brdfSkyKnot);
)",
    { { "#LEAST", Number(MinimumViewCosine) },
      { "#VIEWS", Number((OcclusionViews - 1) / std::acos(MinimumViewCosine)) },
      { "#LAST", std::to_string(OcclusionViews - 2) } });
}

// A side of a point, outputs open where no triangle shows it.
std::string MakeSideCode(
  const OcclusionLights& lights, const OcclusionLayout& layout, std::size_t side)
{
  const std::vector<Member> members = GetMembers(lights, layout, side);
  std::string text;
  for (const Member& member : members)
  {
    text += member.MakeOpenCode();
  }
  text += "  {\n" + UnpackNormal(side) +
          "  vec3 brdfSkyNormalVC = normalize(brdfSkyN * brdfSkyToModel);\n"
          "  float brdfSkyCosine = dot(brdfSkyNormalVC, brdfSkyO);\n";
  text += side == 0 ? "  brdfSkyNormalVSOutput = brdfSkyNormalVC;\n" : "";
  text += "  if (brdfSkyCosine > brdfSkyLeast)\n  {\n";
  text += UnpackCode(side) + MakeViewCode();
  for (const Member& member : members)
  {
    text +=
      member.MakeLightCode() + "  if (brdfSkyMatters)\n  {\n" + member.MakeShareCode() + "  }\n";
  }
  return text + "  }\n  }\n";
}

std::vector<Varying> GetVaryings(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  std::vector<Varying> varyings = { { "vec3", "brdfSkyNormal", "" } };
  for (std::size_t side = 0; side < CountSides(layout); ++side)
  {
    for (const Member& member : GetMembers(lights, layout, side))
    {
      const std::vector<Varying> own = member.GetVaryings();
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
  for (const Member& member : GetMembers(lights, layout, 0))
  {
    const std::string m = std::to_string(member.Index);
    text += "  brdfHidden" + m + " = " +
            shown("brdfHiddenLight", m + "VSOutput", "vec3(brdfSkyOther)") + ";\n";
    if (member.IsBouncing)
    {
      text +=
        "  brdfBounced" + m + " = " + shown("brdfBounced", m + "VSOutput", "vec3(0.0)") + ";\n";
    }
    text += "  brdfOpenLobe" + m + " = brdfSkyShare(" +
            shown("brdfHiddenLobe", m + "VSOutput",
              std::string("vec3(brdfSkyOther > 0.0 ? 8.963 : ") + OpenOdds + ")") +
            ");\n";
    for (std::size_t k = 0; k < member.Light->Lamps.size(); ++k)
    {
      const std::string margin =
        shown("brdfLamps", m + "_" + std::to_string(k / 4) + "VSOutput." + Component(k),
          "0.5 - min(brdfSkyOther, 1.0)");
      text += "  brdfOpenLamp" + m + "[" + std::to_string(k) +
              "] = " + (k < member.Lamps ? "clamp(0.5 + (" + margin + "), 0.0, 1.0)" : "1.0") +
              ";\n";
    }
  }
  return text;
}

//------------------------------------------------------------------------------
glm::dmat3 GetLinearPart(vtkMatrix4x4* matrix)
{
  glm::dmat3 linear;
  for (int k = 0; k < 9; ++k)
  {
    linear[k % 3][k / 3] = matrix->GetElement(k / 3, k % 3);
  }
  return linear;
}

// The orthogonal factor of the polar decomposition.
glm::dmat3 GetNearestOrthogonal(const glm::dmat3& matrix)
{
  using Columns = Eigen::Map<const Eigen::Matrix3d>;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
    Columns(&matrix[0].x), Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d orthogonal = svd.matrixU() * svd.matrixV().transpose();
  const glm::dmat3 result = glm::make_mat3(orthogonal.data());
  return result;
}

// Irradiance as a quadratic form of (n, 1), for a channel: the polynomials of sky::Evaluate up to
// degree 2, times what each degree makes of irradiance (Ramamoorthi, Hanrahan 2001, eq. 11).
glm::mat4 GetIrradianceForm(const sky::Colors& light, int channel)
{
  const auto a = [&](int j) { return light[j][channel]; };
  const double c0 = Pi * 0.282094791773878140;
  const double c1 = 2.0 * Pi / 3.0 * 0.488602511902919920;
  const double c2 = Pi / 4.0 * 1.092548430592079200;
  const double c20 = Pi / 4.0 * 0.946174695757560080;
  const double c22 = Pi / 4.0 * 0.546274215296039590;
  glm::dmat4 form(0.0);
  form[0][0] = c22 * a(8);
  form[1][1] = -c22 * a(8);
  form[2][2] = c20 * a(6);
  form[3][3] = c0 * a(0) - c20 / 3.0 * a(6);
  form[0][1] = form[1][0] = c22 * a(4);
  form[1][2] = form[2][1] = -0.5 * c2 * a(5);
  form[0][2] = form[2][0] = -0.5 * c2 * a(7);
  form[1][3] = form[3][1] = -0.5 * c1 * a(1);
  form[2][3] = form[3][2] = 0.5 * c1 * a(2);
  form[0][3] = form[3][0] = -0.5 * c1 * a(3);
  return glm::mat4(form);
}

// What comes back from what is hidden: the light's first harmonics, times the steps of
// BouncedLight's bytes and the albedo of what is hidden.
void SetBounce(vtkShaderProgram* program, const std::string& number, const OcclusionLight& light,
  const glm::dmat3& toEnvironment)
{
  const sky::Colors turned = sky::Rotate(light.Bounce->Light, toEnvironment);
  const double root = BounceCode::RootStep * BounceCode::RootStep;
  std::vector<glm::dvec3> harmonics;
  for (std::size_t j = 0; j < BounceCode::Harmonics; ++j)
  {
    harmonics.push_back(
      light.Bounce->Albedo * turned[j] * (j == 0 ? root : root * BounceCode::RatioStep));
  }
  std::vector<glm::dvec3> lambert;
  std::vector<glm::dvec3> albedos;
  for (const OcclusionLobe& lobe : light.Lobes)
  {
    lambert.push_back(lobe.Lambert);
    albedos.push_back(lobe.Albedo);
  }
  SetVectors(program, "brdfBouncedLight" + number, harmonics);
  SetVectors(program, "brdfBouncedLambert" + number, lambert);
  SetVectors(program, "brdfBouncedLobe" + number, albedos);
}
}

//------------------------------------------------------------------------------
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
  return key + (layout.TwoSided ? "/both" : "") + (layout.Bounced ? "/bounced" : "");
}

OcclusionNeeds CountOcclusionNeeds(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  return { CountSides(layout) * (OcclusionArrays::Attributes + (layout.Bounced ? 1 : 0)),
    4 * GetVaryings(lights, layout).size() };
}

OcclusionText MakeOcclusionText(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  OcclusionText text;
  text.VertexDeclarations = DeclareCodes(lights, layout) +
                            "uniform mat3 brdfSkyToModel;\n"
                            "uniform float brdfSkyParallel, brdfSkyLeast;\n";
  text.VertexCode = "  vec3 brdfSkyO = brdfSkyParallel > 0.5 ? vec3(0.0, 0.0, 1.0)\n"
                    "    : normalize(-vertexVCVSOutput.xyz);\n";
  for (std::size_t side = 0; side < CountSides(layout); ++side)
  {
    text.VertexCode += MakeSideCode(lights, layout, side);
  }
  text.FragmentDeclarations = layout.TwoSided ? "" : "uniform float brdfSkyOther;\n";
  // Visible share; brdfSkyOdds' inverse.
  text.FragmentDeclarations += "vec3 brdfSkyShare(vec3 odds)\n{\n"
                               "  vec3 open = 1.0 / (1.0 + exp2(odds));\n"
                               "  return clamp((open - 0.002) / 0.996, 0.0, 1.0);\n}\n";
  for (const Varying& varying : GetVaryings(lights, layout))
  {
    const Words words = { { "#T", varying.Type }, { "#V", varying.Name } };
    text.VertexDeclarations += Fill("out #T #VVSOutput;\n", words);
    text.GeometryDeclarations += Fill("in #T #VVSOutput[];\nout #T #VGSOutput;\n", words);
    text.GeometryCode += Fill("  #VGSOutput = #VVSOutput[i];\n", words);
    text.FragmentDeclarations += Fill("in #T #VVSOutput;\n", words);
  }
  text.FragmentCode = MakeFragmentCode(lights, layout);
  return text;
}

std::string DefineOcclusion(const OcclusionLight* light, std::size_t member)
{
  std::string text = "#undef BRDF_OPEN_IRRADIANCE\n#undef BRDF_OPEN_LOBE\n"
                     "#undef BRDF_OPEN_LAMP\n#undef BRDF_OPEN_LIGHTS\n#undef BRDF_BOUNCED\n";
  if (!light)
  {
    return text + "#define BRDF_OPEN_IRRADIANCE(e) (e)\n#define BRDF_OPEN_LOBE(l) (l)\n"
                  "#define BRDF_OPEN_LAMP(k)\n#define BRDF_OPEN_LIGHTS(l) (l)\n"
                  "#define BRDF_BOUNCED vec3(0.0)\n";
  }
  text += "vec3 brdfHidden#M = vec3(0.0);\nvec3 brdfOpenLobe#M = vec3(1.0);\n"
          "#define BRDF_OPEN_LOBE(l) ((l) * brdfOpenLobe#M)\n";
  text += light->Bounce ? "vec3 brdfBounced#M = vec3(0.0);\n#define BRDF_BOUNCED brdfBounced#M\n"
                        : "#define BRDF_BOUNCED vec3(0.0)\n";
  text += light->IsSplit ? "#define BRDF_OPEN_IRRADIANCE(e) max((e) - brdfHidden#M, vec3(0.0))\n"
                         : "#define BRDF_OPEN_IRRADIANCE(e) ((e) * brdfOpenLobe#M)\n";
  text += light->Lamps.empty() ? "#define BRDF_OPEN_LAMP(k)\n"
                                 "#define BRDF_OPEN_LIGHTS(l) ((l) * brdfOpenLobe#M)\n"
                               : "float brdfOpenLamp#M[#LAMPS];\n"
                                 "#define BRDF_OPEN_LAMP(k) brdfOpenLamp#M[k] *\n"
                                 "#define BRDF_OPEN_LIGHTS(l) (l)\n";
  return Fill(
    text, { { "#M", std::to_string(member) }, { "#LAMPS", std::to_string(light->Lamps.size()) } });
}

OcclusionAxes::OcclusionAxes(
  vtkRenderer* renderer, vtkActor* actor, const std::vector<vtkEnvironment*>& environments)
{
  const glm::dmat3 toWorld = GetLinearPart(actor->GetMatrix());
  const glm::dmat3 toView =
    GetLinearPart(renderer->GetActiveCamera()->GetModelViewTransformMatrix()) * toWorld;
  const double size = std::cbrt(std::abs(glm::determinant(toView)));
  this->ToModel = size > 0.0 ? size * glm::inverse(toView) : glm::dmat3(1.0);
  const glm::dmat3 turned = GetNearestOrthogonal(toWorld);
  for (vtkEnvironment* environment : environments)
  {
    this->ToEnvironment.push_back(GetWorldToEnvironment(renderer, environment) * turned);
  }
}

void SetOcclusionUniforms(vtkShaderProgram* program, const OcclusionLights& lights,
  const OcclusionSides& sides, const glm::dmat3& toModel, bool parallel,
  const std::vector<glm::dmat3>& toEnvironment)
{
  glm::mat3 columns(toModel);
  program->SetUniformMatrix3x3("brdfSkyToModel", &columns[0][0]);
  program->SetUniformf("brdfSkyParallel", parallel ? 1.0f : 0.0f);
  program->SetUniformf("brdfSkyLeast", static_cast<float>(sides.LeastCosine));
  if (!sides.Both)
  {
    program->SetUniformf("brdfSkyOther", sides.IsOtherClosed ? LargestIrradiance : 0.0f);
  }
  for (const Member& member : GetMembers(lights, { sides.Both, sides.Bounced }, 0))
  {
    const std::string number = std::to_string(member.Index);
    const glm::dmat3& turn = toEnvironment[member.Index];
    const glm::dmat3 toSurface = glm::transpose(turn);
    const OcclusionLight& own = *member.Light;
    const sky::Colors light = own.GetLight(turn, member.Lamps);
    std::vector<glm::dvec3> vectors;
    for (const glm::dvec3& color : light)
    {
      vectors.push_back(color * HorizonCode::TransferStep);
    }
    SetVectors(program, "brdfSkyLight" + number, vectors);
    const char* const channels[] = { "brdfSkyRed", "brdfSkyGreen", "brdfSkyBlue" };
    for (int c = 0; c < 3; ++c)
    {
      glm::mat4 form = GetIrradianceForm(light, c); // symmetric
      program->SetUniformMatrix4x4((channels[c] + number).c_str(), &form[0][0]);
    }
    vectors.clear();
    std::vector<float> turns;
    for (const OcclusionLobe& lobe : own.Lobes)
    {
      vectors.emplace_back(lobe.Across, lobe.Along, lobe.Integral);
      turns.push_back(static_cast<float>(lobe.Delta));
    }
    SetVectors(program, "brdfSkyLobes" + number, vectors);
    if (member.IsBouncing)
    {
      SetBounce(program, number, own, turn);
    }
    std::vector<glm::dvec4> places; // and concentrations
    std::vector<glm::dvec4> glows;  // and radii
    for (const EnvironmentPanels::Panel& panel : own.Panels)
    {
      places.emplace_back(toSurface * panel.Direction, panel.Concentration);
      glows.emplace_back(panel.Irradiance, GetPanelRadius(panel));
    }
    SetVectors(program, "brdfSkyPanel" + number, places);
    SetVectors(program, "brdfSkyPanelLight" + number, glows);
    vectors.clear();
    for (std::size_t k = 0; k < member.Lamps; ++k)
    {
      vectors.push_back(toSurface * own.Lamps[k]);
    }
    SetVectors(program, "brdfSkyLamp" + number, vectors);
    vectors = own.LampLight;
    vectors.resize(std::min(vectors.size(), member.Lamps));
    SetVectors(program, "brdfSkyLampLight" + number, vectors);
    if (!vectors.empty())
    {
      program->SetUniform1fv(("brdfSkyTurns" + number).c_str(), OcclusionViews, turns.data());
      program->SetUniformf(
        ("brdfSkyLampReach" + number).c_str(), static_cast<float>(2.0 * LampWindow::GetReach()));
    }
  }
}
} // namespace measuredbrdf
