// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BRDFShader.h"

#include "vtkShaderProgram.h"

#include "vtkBRDFBegin.h"
#include "vtkBRDFCommon.h"
#include "vtkBRDFDirectionalLight.h"
#include "vtkBRDFEnd.h"
#include "vtkBRDFEnvironmentPyramid.h"
#include "vtkBRDFHeadlight.h"
#include "vtkBRDFPositionalLight.h"
#include "vtkBRDFTangent.h"
#include "vtkBRDFTangentAxis.h"

namespace measuredbrdf
{
namespace
{
std::string Numbered(const std::string& source, const std::string& placeholder, std::size_t number)
{
  std::string text = source;
  vtkShaderProgram::Substitute(text, placeholder, std::to_string(number));
  return text;
}

// The form's terms, and a function of the given signature that adds them up.
std::string Sum(const vtkBRDFShaderInputs& form, const std::string& signature,
  const std::string& name, const std::string& arguments)
{
  std::string text;
  std::string sum = "vec3(0.0)";
  for (std::size_t k = 0; k < form.Terms.size(); ++k)
  {
    std::string term = form.Terms[k].Source;
    for (const vtkBRDFShaderInputs::Constant& constant : form.Terms[k].Constants)
    {
      vtkShaderProgram::Substitute(term, constant.Name, constant.Value);
    }
    text += Numbered(term, "INSTANCE", k);
    sum += " + " + name + std::to_string(k) + arguments;
  }
  return text + signature + "\n{\n  return " + sum + ";\n}\n";
}

// The same sum for light with a spread; terms without a form for that as they are.
std::string SoftSum(const vtkBRDFShaderInputs& form)
{
  std::string text;
  std::string sum = "vec3(0.0)";
  for (std::size_t k = 0; k < form.Terms.size(); ++k)
  {
    const std::string number = std::to_string(k);
    std::string source = form.Terms[k].Source;
    if (!form.Terms[k].SoftSource.empty())
    {
      source = form.Terms[k].SoftSource;
      text += Numbered(source, "INSTANCE", k);
    }
    sum += source.find("brdfTermSoftINSTANCE") != std::string::npos
             ? " + brdfTermSoft" + number + "(i, o, spread)"
             : " + brdfTerm" + number + "(i, o)";
  }
  return text + "vec3 brdfEvaluateSoft(vec3 i, vec3 o, float spread)\n{\n  return " + sum +
         ";\n}\n";
}
}

std::string GetShaderDeclarations(
  const vtkBRDFShaderInputs* material, const vtkBRDFShaderInputs& environment)
{
  const std::string lights =
    Sum(environment, "vec3 brdfEnvironment(mat3 frame, vec3 o)", "brdfEnvironment", "(frame, o)");
  std::string text = std::string(vtkBRDFCommon) + vtkBRDFEnvironmentPyramid;
  if (material)
  {
    text += Sum(*material, "vec3 brdfEvaluate(vec3 i, vec3 o)", "brdfTerm", "(i, o)");
    if (lights.find("brdfEvaluateSoft") != std::string::npos)
    {
      text += SoftSum(*material);
    }
  }
  text += "uniform mat3 envMatrix; // VTK's own: view -> the renderer's environment\n"
          "uniform mat3 brdfEnvironmentRotation; // the environment's own rotation on top\n";
  text += lights;
  text += "uniform int brdfModulate;\n";
  return text;
}

std::string GetShaderBody(const ShaderBody& body)
{
  std::string text = vtkBRDFBegin;
  vtkShaderProgram::Substitute(text, "//VTK::MeasuredBRDF::Tangent",
    body.Tangents == TangentSource::Data
      ? vtkBRDFTangent
      : (body.Tangents == TangentSource::Axis ? vtkBRDFTangentAxis : ""));
  if (body.Complexity == 1)
  {
    text += vtkBRDFHeadlight;
  }
  for (int k = 0; body.Complexity > 1 && k < body.LightCount; ++k)
  {
    text += Numbered(body.Complexity == 2 ? vtkBRDFDirectionalLight : vtkBRDFPositionalLight,
      "LIGHT", static_cast<std::size_t>(k));
  }
  text += vtkBRDFEnd;
  vtkShaderProgram::Substitute(text, "BRDF_TAKES_COLOR",
    body.HasBlockColors ? "brdfModulate > 1 || (brdfModulate > 0 && OverridesColor)"
                        : "brdfModulate > 1");
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
