// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The textures of a BRDF and of a light set on one window's GPU. Private to the rendering room.
 */

#ifndef BRDFTextures_h
#define BRDFTextures_h

#include "vtkBRDFGPUForm.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <memory>
#include <string>
#include <vector>

class vtkBRDF;
class vtkLightSet;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace measuredbrdf
{
/// A BRDF's GPU form, uploaded. Shared by all mappers that use the BRDF in a window.
class MaterialTextures
{
public:
  /// The shared object for this BRDF and window; empty when new: Update fills it.
  static std::shared_ptr<MaterialTextures> Find(vtkBRDF* brdf, vtkOpenGLRenderWindow* window);

  /// Upload if the BRDF changed or the window lost the textures. Returns what went wrong, or "".
  std::string Update(vtkBRDF* brdf, vtkOpenGLRenderWindow* window);

  void Activate();
  void Deactivate();
  void SetUniforms(vtkShaderProgram* program) const;

  const vtkBRDFGPUForm& GetForm() const { return this->Form; }
  std::size_t GetBytes() const { return this->Bytes; }

private:
  struct Uploaded
  {
    std::string Sampler;
    vtkSmartPointer<vtkTextureObject> Texture;
  };

  vtkBRDFGPUForm Form; // without the textures' data once they are uploaded
  std::vector<Uploaded> Textures;
  std::size_t Bytes = 0;
  vtkMTimeType Time = 0;
  vtkOpenGLRenderWindow* Window = nullptr;
};

/// A light set as a texture: two texels a light (shaders/vtkBRDFLightSet.glsl).
class LightTexture
{
public:
  std::string Update(vtkLightSet* lights, vtkOpenGLRenderWindow* window);
  void Activate();
  void Deactivate();
  void SetUniforms(vtkShaderProgram* program) const;
  void Release(vtkWindow* window);
  std::size_t GetBytes() const { return this->Bytes; }

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  vtkLightSet* Lights = nullptr; // only to see whether it changed
  vtkMTimeType Time = 0;
  int NumberOfLights = 0;
  std::size_t Bytes = 0;
};
} // namespace measuredbrdf

#endif
