// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BRDFTextures.h"

#include "vtkBRDF.h"
#include "vtkLightSet.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <map>

namespace measuredbrdf
{
namespace
{
// From the OpenGL registry: VTK 9.1 and 9.4 bring them by different headers.
constexpr unsigned int R16F = 0x822D;
constexpr unsigned int RGB16F = 0x881B;
constexpr unsigned int RGBA16F = 0x881A;

constexpr int LightsPerRow = 512; // the shader asks the texture

std::string Instance(std::size_t term) { return std::to_string(term); }

bool IsLost(vtkTextureObject* texture, vtkOpenGLRenderWindow* window)
{
  return texture->GetHandle() == 0 || texture->GetContext() != window;
}

vtkSmartPointer<vtkTextureObject> Upload(
  vtkBRDFGPUForm::Texture& texture, vtkOpenGLRenderWindow* window, std::string& problem)
{
  const int limit = texture.ThreeD ? vtkTextureObject::GetMaximumTextureSize3D(window)
                                   : vtkTextureObject::GetMaximumTextureSize(window);
  if (*std::max_element(texture.Dimensions.begin(), texture.Dimensions.end()) > limit)
  {
    problem = texture.Name + " is larger than this graphics card's limit of " +
              std::to_string(limit) + " texels a side";
    return nullptr;
  }
  const auto wrap = [&texture](int axis)
  { return texture.Repeat[axis] ? vtkTextureObject::Repeat : vtkTextureObject::ClampToEdge; };
  auto result = vtkSmartPointer<vtkTextureObject>::New();
  result->SetContext(window);
  result->SetMinificationFilter(vtkTextureObject::Linear);
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
  const bool created = texture.ThreeD ? result->Create3DFromRaw(width, height, depth,
                                          texture.Components, VTK_FLOAT, texture.Data.data())
                                      : result->Create2DFromRaw(width, height, texture.Components,
                                          VTK_FLOAT, texture.Data.data());
  if (!created)
  {
    problem = texture.Name + " could not be uploaded";
    return nullptr;
  }
  return result;
}
}

std::shared_ptr<MaterialTextures> MaterialTextures::Find(
  vtkBRDF* brdf, vtkOpenGLRenderWindow* window)
{
  static std::map<std::pair<vtkBRDF*, vtkOpenGLRenderWindow*>, std::weak_ptr<MaterialTextures>>
    shared;
  for (auto it = shared.begin(); it != shared.end();)
  {
    it = it->second.expired() ? shared.erase(it) : std::next(it);
  }
  std::weak_ptr<MaterialTextures>& entry = shared[{ brdf, window }];
  std::shared_ptr<MaterialTextures> found = entry.lock();
  if (!found)
  {
    found = std::make_shared<MaterialTextures>();
    entry = found;
  }
  return found;
}

std::string MaterialTextures::Update(vtkBRDF* brdf, vtkOpenGLRenderWindow* window)
{
  const bool lost = std::any_of(this->Textures.begin(), this->Textures.end(),
    [window](const Uploaded& uploaded) { return IsLost(uploaded.Texture, window); });
  if (this->Window == window && this->Time >= brdf->GetMTime() && !lost)
  {
    return "";
  }
  vtkBRDFGPUForm form;
  brdf->GetGPUForm(form);
  std::vector<Uploaded> textures;
  for (std::size_t term = 0; term < form.Terms.size(); ++term)
  {
    for (vtkBRDFGPUForm::Texture& texture : form.Terms[term].Textures)
    {
      std::string problem;
      vtkSmartPointer<vtkTextureObject> uploaded = Upload(texture, window, problem);
      if (!uploaded)
      {
        return problem;
      }
      textures.push_back({ texture.Name + Instance(term), uploaded });
    }
  }
  this->Bytes = form.GetTextureBytes();
  for (vtkBRDFGPUForm::Term& term : form.Terms)
  {
    term.Textures.clear();
  }
  this->Form = std::move(form);
  this->Textures = std::move(textures);
  this->Time = brdf->GetMTime();
  this->Window = window;
  return "";
}

void MaterialTextures::Activate()
{
  for (const Uploaded& uploaded : this->Textures)
  {
    uploaded.Texture->Activate();
  }
}

void MaterialTextures::Deactivate()
{
  for (const Uploaded& uploaded : this->Textures)
  {
    uploaded.Texture->Deactivate();
  }
}

void MaterialTextures::SetUniforms(vtkShaderProgram* program) const
{
  for (const Uploaded& uploaded : this->Textures)
  {
    program->SetUniformi(uploaded.Sampler.c_str(), uploaded.Texture->GetTextureUnit());
  }
  for (std::size_t term = 0; term < this->Form.Terms.size(); ++term)
  {
    for (const vtkBRDFGPUForm::Uniform& uniform : this->Form.Terms[term].Uniforms)
    {
      const std::string name = uniform.Name + Instance(term);
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

std::string LightTexture::Update(vtkLightSet* lights, vtkOpenGLRenderWindow* window)
{
  const vtkMTimeType time = lights ? lights->GetMTime() : 0;
  if (this->Texture && this->Lights == lights && this->Time == time &&
      !IsLost(this->Texture, window))
  {
    return "";
  }
  const int count = lights ? lights->GetNumberOfLights() : 0;
  const int width = 2 * std::max(std::min(count, LightsPerRow), 1);
  const int height = std::max((count + LightsPerRow - 1) / LightsPerRow, 1);
  if (height > vtkTextureObject::GetMaximumTextureSize(window))
  {
    return "more lights than this graphics card's textures hold";
  }
  std::vector<float> texels(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int k = 0; k < count; ++k)
  {
    double direction[3], irradiance[3];
    lights->GetDirection(k, direction);
    lights->GetIrradiance(k, irradiance);
    float* texel = &texels[8 * static_cast<std::size_t>(k)];
    for (int c = 0; c < 3; ++c)
    {
      texel[c] = static_cast<float>(direction[c]);
      texel[4 + c] = static_cast<float>(irradiance[c]);
    }
  }
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  if (!texture->Create2DFromRaw(static_cast<unsigned int>(width), static_cast<unsigned int>(height),
        4, VTK_FLOAT, texels.data()))
  {
    return "the light set could not be uploaded";
  }
  this->Texture = texture;
  this->Lights = lights;
  this->Time = time;
  this->NumberOfLights = count;
  this->Bytes = texels.size() * sizeof(float);
  return "";
}

void LightTexture::Activate()
{
  if (this->Texture)
  {
    this->Texture->Activate();
  }
}

void LightTexture::Deactivate()
{
  if (this->Texture)
  {
    this->Texture->Deactivate();
  }
}

void LightTexture::SetUniforms(vtkShaderProgram* program) const
{
  if (this->Texture)
  {
    program->SetUniformi("brdfLights", this->Texture->GetTextureUnit());
    program->SetUniformi("brdfNumberOfLights", this->NumberOfLights);
  }
}

void LightTexture::Release(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
    this->Texture = nullptr;
    this->Bytes = 0;
  }
}
} // namespace measuredbrdf
