// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionKept.h"

#include "HiddenSky.h"
#include "OcclusionPanels.h"
#include "SkyCodeText.h"
#include "vtkShaderProgram.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// A float of a point: an expression that makes it, and text that reads it (#V).
struct Field
{
  std::string Make;
  std::string Read;
};

void AddVector(const std::string& name, std::vector<Field>& fields)
{
  for (const char component : { 'x', 'y', 'z' })
  {
    const std::string part = name + "." + component;
    fields.push_back({ part, "  " + part + " = #V;\n" });
  }
}

// A number that fits into half of a float.
struct Half
{
  std::string Name;
  double Least;
  double Most;
};

std::string Shrink(const Half& half)
{
  return "(" + half.Name + " - " + Number(half.Least) + ") * " +
         Number(1.0 / (half.Most - half.Least));
}

std::string Grow(const Half& half, const std::string& value)
{
  return "  " + half.Name + " = " + value + " * " + Number(half.Most - half.Least) + " + " +
         Number(half.Least) + ";\n";
}

void AddPairs(const std::string& pair, const std::vector<Half>& halves, std::vector<Field>& fields)
{
  for (std::size_t k = 0; k < halves.size(); k += 2)
  {
    const bool isWhole = k + 1 < halves.size();
    const std::string variable = pair + "_" + std::to_string(k / 2);
    const std::string read = "  vec2 " + variable + " = brdfSkyUnpair(#V);\n" +
                             Grow(halves[k], variable + ".x") +
                             (isWhole ? Grow(halves[k + 1], variable + ".y") : "");
    const std::string other = isWhole ? Shrink(halves[k + 1]) : "0.0";
    fields.push_back({ "brdfSkyPair(" + Shrink(halves[k]) + ", " + other + ")", read });
  }
}

// What panels and lamps in tables are weighted against.
bool NeedsRest(const OcclusionMember& member)
{
  return (member.HasLobe() && member.HasPanels()) || member.HasTableLamps();
}

std::vector<Field> GetFields(const OcclusionMember& member)
{
  std::vector<Field> fields;
  std::vector<Half> halves;
  AddVector("brdfHiddenLight" + member.Out + "VSOutput", fields);
  if (member.HasLobe())
  {
    for (const char* component : { ".x", ".y", ".z" })
    {
      halves.push_back({ "brdfContrast" + member.Number + component, -6.0, 6.0 });
    }
  }
  if (NeedsRest(member))
  {
    AddVector("brdfRest" + member.Number, fields);
  }
  if (member.HasLobe())
  {
    for (std::size_t k = 0; k < member.Light->Panels.size(); ++k)
    {
      halves.push_back({ "brdfEdge" + member.Number + "[" + std::to_string(k) + "]", 0.0, 1.0 });
    }
    if (member.HasPanels())
    {
      halves.push_back({ "brdfTrust" + member.Number, 0.0, 1.0 });
    }
  }
  for (std::size_t k = 0; k < member.Lamps; ++k)
  {
    halves.push_back({ member.GetLamp(k), -HiddenSky::LargestMargin, HiddenSky::LargestMargin });
  }
  AddPairs("brdfPair" + member.Number, halves, fields);
  return fields;
}

std::string GetName(const OcclusionMember& member, std::size_t vector)
{
  return "brdfKept" + member.Out + "_" + std::to_string(vector);
}

// Of GetFields, for each frame.
std::size_t CountVectors(const OcclusionMember& member)
{
  const std::size_t panels = member.HasPanels() ? member.Light->Panels.size() + 1 : 0;
  const std::size_t halves = (member.HasLobe() ? 3 + panels : 0) + member.Lamps;
  return (3 + (NeedsRest(member) ? 3 : 0) + (halves + 1) / 2 + 3) / 4;
}

std::string MakeWriting(const OcclusionMember& member)
{
  std::vector<Field> fields = GetFields(member);
  fields.resize(4 * CountVectors(member), { "0.0", "" });
  std::string text;
  for (std::size_t k = 0; k < fields.size(); k += 4)
  {
    text += "  " + GetName(member, k / 4) + " = vec4(" + fields[k].Make + ", " +
            fields[k + 1].Make + ", " + fields[k + 2].Make + ", " + fields[k + 3].Make + ");\n";
  }
  return text;
}

std::string MakeMaking(const OcclusionMember& member)
{
  std::string text = member.MakeOpenCode(true) + member.DeclareResting() + member.MakeLightCode() +
                     "  if (brdfSkyMatters)\n  {\n" + member.MakeContrastCode();
  text += member.HasPanels() ? MakePanelCode(member, PanelUse::Keep) : "";
  return text + member.MakeLampCode() + "  }\n" + MakeWriting(member);
}
}

std::vector<std::string> GetKeptNames(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  std::vector<std::string> names;
  for (std::size_t side = 0; side < (layout.TwoSided ? 2 : 1); ++side)
  {
    for (const OcclusionMember& member : GetMembers(lights, layout, side))
    {
      for (std::size_t k = 0; k < CountVectors(member); ++k)
      {
        names.push_back(GetName(member, k));
      }
    }
  }
  return names;
}

std::size_t CountKeptAttributes(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  constexpr std::size_t code = 3; // its normal and sectors
  const std::size_t ofSide = code + (layout.Bounced ? 1 : 0);
  return GetKeptNames(lights, layout).size() + (layout.TwoSided ? 2 : 1) * ofSide;
}

std::string MakeKeptShader(const OcclusionLights& lights, const OcclusionLayout& layout)
{
  std::string text = "//VTK::System::Dec\n" + DeclareCodes(lights, layout);
  for (const std::string& name : GetKeptNames(lights, layout))
  {
    text += "out vec4 " + name + ";\n";
  }
  text += "void main()\n{\n";
  for (std::size_t side = 0; side < (layout.TwoSided ? 2 : 1); ++side)
  {
    text +=
      "  {\n" + UnpackNormal(side) + UnpackCode(side, HiddenSky::Bytes) + MakeRestingCommonCode();
    for (const OcclusionMember& member : GetMembers(lights, layout, side))
    {
      text += MakeMaking(member);
    }
    text += "  }\n";
  }
  return text + "  gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // out of sight\n}\n";
}

std::string MakeKeptReading(const OcclusionMember& member)
{
  std::string text = member.DeclareResting();
  const std::vector<Field> fields = GetFields(member);
  for (std::size_t k = 0; k < fields.size(); ++k)
  {
    std::string read = fields[k].Read;
    vtkShaderProgram::Substitute(
      read, "#V", GetName(member, k / 4) + "." + std::string(1, "xyzw"[k % 4]));
    text += read;
  }
  return text;
}

std::vector<double> GetKeptInputs(const OcclusionLights& lights, const OcclusionLayout& layout,
  const std::vector<glm::dmat3>& toEnvironment)
{
  std::vector<double> inputs;
  const auto add = [&inputs](const glm::dvec3& v) {
    inputs.insert(inputs.end(), { v.x, v.y, v.z });
  };
  for (const OcclusionMember& member : GetMembers(lights, layout, 0))
  {
    const glm::dmat3& turn = toEnvironment[member.Member];
    for (int column = 0; column < 3; ++column)
    {
      add(turn[column]);
    }
    for (const std::vector<glm::dvec3>* vectors :
      { &member.Light->Lamps, &member.Light->LampLight })
    {
      inputs.push_back(static_cast<double>(vectors->size()));
      std::for_each(vectors->begin(), vectors->end(), add);
    }
    std::for_each(member.Light->Light.begin(), member.Light->Light.end(), add);
    for (const EnvironmentPanels::Panel& panel : member.Light->Panels)
    {
      add(panel.Direction);
      add(panel.Irradiance);
      inputs.push_back(panel.Concentration);
    }
  }
  return inputs;
}
} // namespace measuredbrdf
