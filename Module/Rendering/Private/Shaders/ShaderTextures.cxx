// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaderTextures.h"

#include "BRDFShader.h"
#include "ContentHash.h"
#include "Printable.h"
#include "RecentlyUsed.h"
#include "ScopedErrorCapture.h"
#include "SharedObjects.h"
#include "vtkBRDF.h"
#include "vtkBRDFCommon.h"
#include "vtkBRDFEnvironmentPyramid.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRadianceIntegrator.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkTextureUnitManager.h"

#include <algorithm>
#include <exception>
#include <tuple>

namespace measuredbrdf
{
namespace
{
// From the OpenGL registry: VTK 9.1 and 9.4 bring them by different headers.
constexpr unsigned int R16F = 0x822D;
constexpr unsigned int RGB16F = 0x881B;
constexpr unsigned int RGBA16F = 0x881A;
constexpr unsigned int RGB = 0x1907;
constexpr unsigned int RGB9E5 = 0x8C3D;
constexpr unsigned int UnsignedInt5999 = 0x8C3E; // GL_UNSIGNED_INT_5_9_9_9_REV

// Units that VTK's mapper may still take once ours are bound: colors, normals and edges of cells,
// and the texture of mapped scalars.
constexpr int UnitsOfTheMapper = 4;

bool IsLost(vtkTextureObject* texture, vtkOpenGLRenderWindow* window)
{
  return texture->GetHandle() == 0 || texture->GetContext() != window;
}

std::vector<float> Pad(const std::vector<float>& triples)
{
  std::vector<float> padded;
  padded.reserve(triples.size() / 3 * 4);
  for (std::size_t k = 0; k + 2 < triples.size(); k += 3)
  {
    padded.insert(padded.end(), { triples[k], triples[k + 1], triples[k + 2], 1.0f });
  }
  return padded;
}

std::shared_ptr<vtkTextureObject> Upload(
  vtkBRDFShaderInputs::Texture& texture, vtkOpenGLRenderWindow* window, std::string& problem)
{
  const int limit = texture.ThreeD ? vtkTextureObject::GetMaximumTextureSize3D(window)
                                   : vtkTextureObject::GetMaximumTextureSize(window);
  if (*std::max_element(texture.Dimensions.begin(), texture.Dimensions.end()) > limit)
  {
    problem =
      " is larger than this graphics card's limit of " + std::to_string(limit) + " texels a side";
    return nullptr;
  }
  const auto wrap = [&texture](int axis)
  { return texture.Repeat[axis] ? vtkTextureObject::Repeat : vtkTextureObject::ClampToEdge; };
  const std::shared_ptr<vtkTextureObject> result(
    vtkTextureObject::New(), [](vtkTextureObject* object) { object->Delete(); });
  result->SetContext(window);
  result->SetGenerateMipmap(texture.Mipmaps);
  result->SetMinificationFilter(
    texture.Mipmaps ? vtkTextureObject::LinearMipmapLinear : vtkTextureObject::Linear);
  result->SetMagnificationFilter(vtkTextureObject::Linear);
  result->SetWrapS(wrap(0));
  result->SetWrapT(wrap(1));
  result->SetWrapR(wrap(2));
  if (texture.HalfFloat)
  {
    result->SetInternalFormat(
      texture.Components == 1 ? R16F : (texture.Components == 3 ? RGB16F : RGBA16F));
  }
  const unsigned int width = static_cast<unsigned int>(texture.Dimensions[0]);
  const unsigned int height = static_cast<unsigned int>(texture.Dimensions[1]);
  const unsigned int depth = static_cast<unsigned int>(texture.Dimensions[2]);
  const auto create = [&](int components, int type, void* data)
  {
    return texture.ThreeD ? result->Create3DFromRaw(width, height, depth, components, type, data)
                          : result->Create2DFromRaw(width, height, components, type, data);
  };
  bool created = false;
  if (!texture.SharedExponents.empty())
  {
    result->SetInternalFormat(RGB9E5);
    result->SetFormat(RGB);
    result->SetDataType(UnsignedInt5999);
    created = create(3, VTK_FLOAT, texture.SharedExponents.data()); // filtered as floats are
  }
  else if (texture.IsPadded())
  {
    std::vector<float> padded = Pad(texture.Data);
    created = create(4, VTK_FLOAT, padded.data());
  }
  else
  {
    created = create(texture.Components, VTK_FLOAT, texture.Data.data());
  }
  if (!created)
  {
    problem = " could not be uploaded";
    return nullptr;
  }
  return result;
}

std::string GetContent(const vtkBRDFShaderInputs::Texture& texture)
{
  ContentHash hash;
  hash.AddText(texture.Name);
  hash.AddValue(texture.Components);
  hash.AddValue(texture.ThreeD);
  hash.AddValue(texture.HalfFloat);
  hash.AddValue(texture.Mipmaps);
  for (int axis = 0; axis < 3; ++axis)
  {
    hash.AddValue(texture.Dimensions[static_cast<std::size_t>(axis)]);
    hash.AddValue(static_cast<bool>(texture.Repeat[static_cast<std::size_t>(axis)]));
  }
  hash.AddValues(texture.SharedExponents);
  hash.AddValues(texture.Data);
  return hash.GetText();
}

// Tables of many materials under one environment have the same map of irradiance.
std::shared_ptr<vtkTextureObject> FindOrUpload(
  vtkBRDFShaderInputs::Texture& texture, vtkOpenGLRenderWindow* window, std::string& problem)
{
  using Key = std::pair<std::string, vtkOpenGLRenderWindow*>;
  static HeldObjects<Key, vtkTextureObject> held;
  const Key key(GetContent(texture), window);
  std::shared_ptr<vtkTextureObject> found = held.Find(key);
  if (!found || IsLost(found.get(), window))
  {
    found = Upload(texture, window, problem);
    held.Add(key, found);
  }
  return found;
}

constexpr std::size_t LongestCompilerMessage = 2000;
constexpr std::size_t MostPrograms = 64; // whose results are known

// What a term's text defines.
enum class TermKind
{
  Material,  // brdfTermINSTANCE
  Integrator // brdfEnvironmentINSTANCE
};

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

// Known texts are not compiled again.
std::string CompileOnce(const std::string& program)
{
  static auto& results = SharedCache<std::string, std::string>::MakeForProcess(MostPrograms);
  std::optional<std::string> result = results.Find(program);
  if (!result)
  {
    result = Compile(program);
    results.Put(program, *result);
  }
  return *result;
}

// What is wrong with the GLSL text of terms from outside the module, or "". It is tried on its own,
// since VTK prints a shader that does not compile in full and goes on without one.
std::string ValidateShaders(const vtkBRDFShaderInputs& inputs, TermKind kind)
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
}

bool ShaderTextures::IsIn(vtkOpenGLRenderWindow* window) const
{
  return this->Window == window &&
         std::none_of(this->Textures.begin(), this->Textures.end(),
           [window](const Uploaded& uploaded) { return IsLost(uploaded.Texture.get(), window); });
}

std::string ShaderTextures::Update(
  vtkMTimeType time, vtkOpenGLRenderWindow* window, const Make& make)
{
  if (this->Time >= time && this->IsIn(window))
  {
    return "";
  }
  if (time <= this->FailureTime)
  {
    return this->Failure;
  }
  try
  {
    vtkBRDFShaderInputs inputs;
    inputs.SoftLights = this->SoftLights;
    this->Failure = make(inputs);
    if (this->Failure.empty())
    {
      this->Failure = this->Upload(std::move(inputs), time, window);
    }
  }
  catch (const std::exception& e) // no memory, say
  {
    this->Failure = e.what();
  }
  this->FailureTime = this->Failure.empty() ? this->FailureTime : time;
  return this->Failure;
}

std::shared_ptr<ShaderTextures> ShaderTextures::Find(const void* source, vtkMTimeType time,
  bool softLights, vtkOpenGLRenderWindow* window, const Make& make, std::string& problem)
{
  using Key = std::tuple<const void*, bool, vtkOpenGLRenderWindow*>;
  static HeldObjects<Key, ShaderTextures> held;
  const std::shared_ptr<ShaderTextures> found = held.FindOrMake({ source, softLights, window },
    [softLights]() { return std::make_shared<ShaderTextures>(softLights); });
  problem = found->Update(time, window, make);
  return found;
}

std::shared_ptr<ShaderTextures> ShaderTextures::Find(
  vtkBRDF* brdf, bool softLights, vtkOpenGLRenderWindow* window, std::string& problem)
{
  return Find(
    brdf, brdf->GetMTime(), softLights, window,
    [brdf](vtkBRDFShaderInputs& inputs)
    {
      brdf->GetShaderInputs(inputs);
      return ValidateShaders(inputs, TermKind::Material);
    },
    problem);
}

std::shared_ptr<ShaderTextures> ShaderTextures::Find(
  vtkRadianceIntegrator* integrator, vtkOpenGLRenderWindow* window, std::string& problem)
{
  return Find(
    integrator, integrator->GetInputsMTime(), false, window,
    [integrator](vtkBRDFShaderInputs& inputs)
    {
      const ScopedErrorCapture reason(integrator);
      return integrator->GetShaderInputs(inputs)
               ? ValidateShaders(inputs, TermKind::Integrator)
               : std::string(integrator->GetClassName()) + " has nothing to draw with" +
                   (reason.GetText().empty() ? "" : ": " + reason.GetText());
    },
    problem);
}

std::string ShaderTextures::Upload(
  vtkBRDFShaderInputs inputs, vtkMTimeType time, vtkOpenGLRenderWindow* window)
{
  std::vector<Uploaded> textures;
  for (std::size_t term = 0; term < inputs.Terms.size(); ++term)
  {
    for (vtkBRDFShaderInputs::Texture& texture : inputs.Terms[term].Textures)
    {
      std::string problem;
      const std::size_t bytes = texture.GetBytes();
      const auto uploaded = FindOrUpload(texture, window, problem);
      if (!uploaded)
      {
        return texture.Name + std::to_string(term) + problem;
      }
      textures.push_back({ texture.Name, term, uploaded, bytes });
    }
  }
  for (vtkBRDFShaderInputs::Term& term : inputs.Terms)
  {
    term.Textures.clear();
  }
  this->Inputs = std::move(inputs);
  this->Textures = std::move(textures);
  this->Time = time;
  this->Window = window;
  return "";
}

void ShaderTextures::Activate()
{
  for (Uploaded& uploaded : this->Textures)
  {
    uploaded.Texture->Activate();
    uploaded.Unit = uploaded.Texture->GetTextureUnit();
  }
}

void ShaderTextures::Deactivate()
{
  for (const Uploaded& uploaded : this->Textures)
  {
    uploaded.Texture->Deactivate();
  }
}

std::size_t ShaderTextures::CountBytes(std::set<const vtkTextureObject*>& counted) const
{
  std::size_t bytes = 0;
  for (const Uploaded& uploaded : this->Textures)
  {
    bytes += counted.insert(uploaded.Texture.get()).second ? uploaded.Bytes : 0;
  }
  return bytes;
}

void ShaderTextures::SetUniforms(vtkShaderProgram* program, std::size_t firstInstance) const
{
  const auto numbered = [firstInstance](const std::string& name, std::size_t term)
  { return name + std::to_string(firstInstance + term); };
  for (const Uploaded& uploaded : this->Textures)
  {
    program->SetUniformi(numbered(uploaded.Sampler, uploaded.Term).c_str(), uploaded.Unit);
  }
  for (std::size_t term = 0; term < this->Inputs.Terms.size(); ++term)
  {
    for (const vtkBRDFShaderInputs::Uniform& uniform : this->Inputs.Terms[term].Uniforms)
    {
      const std::string name = numbered(uniform.Name, term);
      if (uniform.Values.size() == 1)
      {
        program->SetUniformf(name.c_str(), uniform.Values[0]);
      }
      else
      {
        program->SetUniform3f(name.c_str(), uniform.Values.data());
      }
    }
  }
}

namespace
{
// Units that are not ours to take.
int CountTakenUnits(vtkOpenGLRenderWindow* window)
{
  vtkTextureUnitManager* manager = window->GetTextureUnitManager();
  int taken = UnitsOfTheMapper;
  for (int unit = 0; unit < manager->GetNumberOfTextureUnits(); ++unit)
  {
    taken += manager->IsAllocated(unit) ? 1 : 0;
  }
  return taken;
}
}

std::size_t CountTextureUnits(vtkOpenGLRenderWindow* window)
{
  const int units = window->GetTextureUnitManager()->GetNumberOfTextureUnits();
  return static_cast<std::size_t>(std::max(units - CountTakenUnits(window), 0));
}

std::string CheckTextureUnits(std::size_t needed, vtkOpenGLRenderWindow* window)
{
  if (needed <= CountTextureUnits(window))
  {
    return "";
  }
  const int units = window->GetTextureUnitManager()->GetNumberOfTextureUnits();
  return "it needs " + std::to_string(needed) + " textures at once, and of this graphics card's " +
         std::to_string(units) + " texture units VTK itself may need " +
         std::to_string(CountTakenUnits(window));
}
} // namespace measuredbrdf
