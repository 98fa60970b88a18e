// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaderTest.h"

#include "BRDFShader.h"
#include "Printable.h"
#include "RecentlyUsed.h"
#include "vtkBRDFCommon.h"
#include "vtkBRDFEnvironmentPyramid.h"
#include "vtkNew.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"

#include <cstddef>
#include <mutex>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t LongestCompilerMessage = 2000;

// The text between what the mapper's shaders put before and after it.
std::string GetProgram(const vtkBRDFShaderInputs::Term& term, TermKind kind)
{
  std::string text = term.Source + term.SoftSource;
  for (const vtkBRDFShaderInputs::Constant& constant : term.Constants)
  {
    vtkShaderProgram::Substitute(text, constant.Name, constant.Value);
  }
  vtkShaderProgram::Substitute(text, "INSTANCE", "0");
  std::string program = std::string("#version 150\n") + vtkBRDFCommon + vtkBRDFEnvironmentPyramid +
                        GetSamplesText(SumStage::None);
  if (kind == TermKind::Integrator)
  {
    program += "vec3 brdfEvaluate(vec3 i, vec3 o) { return vec3(0.0); }\n"
               "vec3 brdfEvaluateSoft(vec3 i, vec3 o, float spread) { return vec3(0.0); }\n"
               "uniform mat3 envMatrix;\nuniform mat3 brdfViewToEnvironment;\n";
  }
  const std::string call = kind == TermKind::Material
                             ? "brdfTerm0(vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0))"
                             : "brdfEnvironment0(mat3(1.0), vec3(0.0, 0.0, 1.0))";
  return program + text + "\nout vec4 brdfResult;\nvoid main()\n{\n  brdfResult = vec4(" + call +
         ", 1.0);\n}\n";
}

std::string Compile(const std::string& program)
{
  vtkNew<vtkShader> shader;
  shader->SetType(vtkShader::Fragment);
  shader->SetSource(program);
  const bool works = shader->Compile();
  const std::string error = shader->GetError();
  shader->Cleanup();
  return works ? "" : error.empty() ? "no reason is known" : error;
}

constexpr std::size_t MostPrograms = 64;

// Known texts are not compiled again.
std::string CompileOnce(const std::string& program)
{
  struct Known
  {
    std::mutex Mutex;
    RecentlyUsed<std::string, std::string> Results{ MostPrograms };
  };
  static Known& known = *new Known; // windows may be drawn by threads that outlive statics
  const std::lock_guard<std::mutex> lock(known.Mutex);
  if (const std::string* result = known.Results.Find(program))
  {
    return *result;
  }
  return known.Results[program] = Compile(program);
}
}

std::string TestShaders(const vtkBRDFShaderInputs& inputs, TermKind kind)
{
  const std::string wanted =
    kind == TermKind::Material ? "brdfTermINSTANCE" : "brdfEnvironmentINSTANCE";
  for (const vtkBRDFShaderInputs::Term& term : inputs.Terms)
  {
    if (term.IsTested)
    {
      continue;
    }
    const std::string place = "GLSL text " + Quote(term.Shader) + ": ";
    if (term.Source.find(wanted) == std::string::npos)
    {
      return place + "there is no function " + wanted + " in its " +
             std::to_string(term.Source.size()) + " characters";
    }
    const std::string error = CompileOnce(GetProgram(term, kind));
    if (!error.empty())
    {
      return place + "does not compile: " + ToPrintable(error, LongestCompilerMessage, true);
    }
  }
  return "";
}
} // namespace measuredbrdf
