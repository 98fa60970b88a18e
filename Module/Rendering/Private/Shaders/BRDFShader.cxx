// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BRDFShader.h"

#include "OcclusionShader.h"

#include "vtkShaderProgram.h"

#include "vtkBRDFBegin.h"
#include "vtkBRDFCommon.h"
#include "vtkBRDFDirectionalLight.h"
#include "vtkBRDFEnd.h"
#include "vtkBRDFEnvironmentPyramid.h"
#include "vtkBRDFFacetNormal.h"
#include "vtkBRDFHeadlight.h"
#include "vtkBRDFPositionalLight.h"
#include "vtkBRDFSampleSum.h"
#include "vtkBRDFTangent.h"
#include "vtkBRDFTangentAxis.h"

namespace measuredbrdf
{
namespace
{
void ReplaceAll(std::string& text, const std::string& from, const std::string& to)
{
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
  {
    text.replace(at, from.size(), to);
  }
}

std::string Numbered(const std::string& source, const std::string& placeholder, std::size_t number)
{
  std::string text = source;
  vtkShaderProgram::Substitute(text, placeholder, std::to_string(number));
  return text;
}

// The terms of shader inputs, and a function of the given signature that adds them up.
std::string Sum(const vtkBRDFShaderInputs& inputs, std::size_t first, const std::string& signature,
  const std::string& name, const std::string& arguments, SumStage stage = SumStage::None)
{
  std::string text;
  // What hidden surfaces send back comes once for all terms.
  std::string sum =
    name == "brdfEnvironment" && stage != SumStage::Add ? "BRDF_BOUNCED" : "vec3(0.0)";
  for (std::size_t k = 0; k < inputs.Terms.size(); ++k)
  {
    std::string term = inputs.Terms[k].Source;
    for (const vtkBRDFShaderInputs::Constant& constant : inputs.Terms[k].Constants)
    {
      vtkShaderProgram::Substitute(term, constant.Name, constant.Value);
    }
    text += Numbered(term, "INSTANCE", first + k);
    if (stage ==
        (term.find("BRDF_SAMPLES") != std::string::npos ? SumStage::Others : SumStage::Add))
    {
      continue;
    }
    const std::string call = name + std::to_string(first + k) + arguments;
    // A method that tells no parts of its light apart is taken as one lobe.
    const bool whole = name == "brdfEnvironment" && term.find("BRDF_OPEN_") == std::string::npos;
    sum += " + " + (whole ? "BRDF_OPEN_LOBE(" + call + ")" : call);
  }
  return text + signature + "\n{\n  return " + sum + ";\n}\n";
}

// The same sum for light with a spread; terms that know no spread as they are.
std::string SoftSum(const vtkBRDFShaderInputs& inputs, std::size_t first)
{
  std::string text;
  std::string sum = "vec3(0.0)";
  for (std::size_t k = 0; k < inputs.Terms.size(); ++k)
  {
    const std::string number = std::to_string(first + k);
    std::string source = inputs.Terms[k].Source;
    if (!inputs.Terms[k].SoftSource.empty())
    {
      source = inputs.Terms[k].SoftSource;
      text += Numbered(source, "INSTANCE", first + k);
    }
    sum += source.find("brdfTermSoftINSTANCE") != std::string::npos
             ? " + brdfTermSoft" + number + "(i, o, spread)"
             : " + brdfTerm" + number + "(i, o)";
  }
  return text + "vec3 brdfEvaluateSoft(vec3 i, vec3 o, float spread)\n{\n  return " + sum +
         ";\n}\n";
}

// brdfEvaluate and brdfEnvironment of one material.
std::string DeclareMember(const ShaderMember& member, std::size_t number, SumStage stage)
{
  const std::size_t first = GetFirstInstance(number);
  const vtkBRDFShaderInputs dark;
  const std::string lights = Sum(member.Environment ? *member.Environment : dark, first,
    "vec3 brdfEnvironment(mat3 frame, vec3 o)", "brdfEnvironment", "(frame, o)", stage);
  std::string text = DefineOcclusion(member.Occlusion, number);
  if (member.Material)
  {
    text += Sum(*member.Material, first, "vec3 brdfEvaluate(vec3 i, vec3 o)", "brdfTerm", "(i, o)");
    if (lights.find("brdfEvaluateSoft") != std::string::npos)
    {
      text += SoftSum(*member.Material, first);
    }
  }
  return text + lights;
}

// The weighted sum of the members' functions of that name. A loop that may end at once and not a
// condition: software renderers (Mesa's llvmpipe) run both sides of conditions.
std::string Mix(const std::vector<ShaderMember>& members, const std::string& signature,
  const std::string& name, const std::string& arguments, bool rotated)
{
  std::string text = signature + "\n{\n  vec3 sum = vec3(0.0);\n";
  for (std::size_t k = 0; k < members.size(); ++k)
  {
    const std::string weight = "brdfWeights[" + std::to_string(members[k].Slot) + "]";
    text += "  for (int once = 0; once < (" + weight +
            " > 0.0 ? 1 : 0); ++once)\n  {\n    sum += " + weight + " * brdfMember" +
            std::to_string(k) + name + "(" + (rotated ? GetRotationName(k) + " * " : "") +
            arguments + ");\n  }\n";
  }
  return text + "  return sum;\n}\n";
}
}

std::size_t GetFirstInstance(std::size_t member) { return 100 * member; }

std::string GetRotationName(std::size_t member)
{
  return "brdfViewToEnvironment" + (member > 0 ? std::to_string(member) : "");
}

std::string GetSamplesText(SumStage stage)
{
  if (stage == SumStage::Add)
  {
    return "uniform vec3 brdfPart; // samples from x to y of z\n"
           "#define BRDF_SAMPLES(count) (ivec2(brdfPart.xy) * count / int(brdfPart.z))\n"
           "#define BRDF_SAMPLES_SHARE brdfPart.z\n";
  }
  return std::string(stage == SumStage::Show ? vtkBRDFSampleSum : "") +
         "#define BRDF_SAMPLES(count) ivec2(0, count)\n#define BRDF_SAMPLES_SHARE 1.0\n";
}

std::string GetShaderDeclarations(const std::vector<ShaderMember>& members, SumStage stage)
{
  std::string text = std::string(vtkBRDFCommon) + vtkBRDFEnvironmentPyramid + GetSamplesText(stage);
  text += "uniform mat3 envMatrix; // VTK's own: view -> the renderer's environment\n"
          "uniform int brdfModulate;\n";
  bool evaluate = true;
  for (std::size_t k = 0; k < members.size(); ++k)
  {
    text += "uniform mat3 " + GetRotationName(k) + "; // view -> the member's environment\n";
    evaluate = evaluate && members[k].Material;
    std::string functions = DeclareMember(members[k], k, stage);
    const std::string prefix = "brdfMember" + std::to_string(k);
    ReplaceAll(functions, "brdfEvaluate", prefix + "Evaluate");
    ReplaceAll(functions, "vec3 brdfEnvironment(", "vec3 " + prefix + "Environment(");
    text += functions;
  }
  if (members.size() > 1)
  {
    text +=
      Mix(members, "vec3 brdfEnvironment(mat3 frame, vec3 o)", "Environment", "frame, o", true);
    text +=
      evaluate ? Mix(members, "vec3 brdfEvaluate(vec3 i, vec3 o)", "Evaluate", "i, o", false) : "";
    return text;
  }
  text += "vec3 brdfEnvironment(mat3 frame, vec3 o)\n{\n  return brdfMember0Environment(" +
          GetRotationName(0) + " * frame, o);\n}\n";
  text += evaluate
            ? "vec3 brdfEvaluate(vec3 i, vec3 o)\n{\n  return brdfMember0Evaluate(i, o);\n}\n"
            : "";
  return text;
}

bool IsOfSum(SumStage stage) { return stage == SumStage::Others || stage == SumStage::Add; }

std::string GetSumOutput(SumStage stage)
{
  return stage == SumStage::Add ? "  gl_FragData[0] = vec4(brdfSummand, brdfPart.y - brdfPart.x);\n"
                                  "  gl_FragData[1] = vec4(0.0);\n"
                                : "  gl_FragData[0] = vec4(0.0);\n"
                                  "  gl_FragData[1] = vec4(brdfSummand, gl_FragCoord.z);\n";
}

std::string GetShaderBody(const ShaderBody& body)
{
  std::string text = body.HasBadNormals ? vtkBRDFFacetNormal : "";
  text += vtkBRDFBegin;
  vtkShaderProgram::Substitute(text, "//VTK::MeasuredBRDF::Weights", body.Weights);
  vtkShaderProgram::Substitute(text, "//VTK::MeasuredBRDF::Tangent",
    body.Tangents == TangentSource::Data
      ? vtkBRDFTangent
      : (body.Tangents == TangentSource::Axis ? vtkBRDFTangentAxis : ""));
  if (body.Stage == SumStage::Show) // a loop, as in Mix
  {
    vtkShaderProgram::Substitute(text, "vec3 brdfRadiance = brdfEnvironment(brdfFrame, brdfView);",
      "vec4 brdfMean = brdfFindSum();\n  vec3 brdfRadiance = brdfMean.rgb;\n"
      "  for (int once = 0; once < (brdfMean.a > 0.0 ? 0 : 1); ++once)\n  {\n"
      "    brdfRadiance = brdfEnvironment(brdfFrame, brdfView);\n  }");
  }
  text += IsOfSum(body.Stage) ? "  vec3 brdfSummand = brdfRadiance;\n" : "";
  if (body.Complexity == 1)
  {
    text += vtkBRDFHeadlight;
  }
  for (int k = 0; body.Complexity > 1 && k < body.LightCount; ++k)
  {
    if (k == body.SuperfluousLight)
    {
      continue;
    }
    text += Numbered(body.Complexity == 2 ? vtkBRDFDirectionalLight : vtkBRDFPositionalLight,
      "LIGHT", static_cast<std::size_t>(k));
  }
  text += vtkBRDFEnd;
  // Software renderers run both sides of conditions, so one that never holds is left out.
  const std::string taken = body.HasBlockColors
                              ? "brdfModulate > 1 || (brdfModulate > 0 && OverridesColor)"
                              : "brdfModulate > 1";
  vtkShaderProgram::Substitute(
    text, "BRDF_TAKES_COLOR", body.HasColors || body.HasBlockColors ? taken : "false");
  const bool tubes = body.HasEdges && body.EdgesAreTubes;
  vtkShaderProgram::Substitute(
    text, "//VTK::MeasuredBRDF::TubeLight", tubes ? "brdfTube += radiance * brdfLight.z;" : "");
  std::string edges;
  if (body.HasEdges)
  {
    edges = tubes ? std::string("color = mix(color, edgeColor * ") +
                      (body.Complexity > 0 ? "brdfTube" : "max(normalVCVSOutput.z, 0.0)")
                  : std::string("color = mix(color, edgeColor");
    edges += body.HasEdgeOpacity ? ", emix * edgeOpacity);" : ", emix);";
  }
  vtkShaderProgram::Substitute(text, "//VTK::MeasuredBRDF::Edges", edges);
  return text;
}
} // namespace measuredbrdf
