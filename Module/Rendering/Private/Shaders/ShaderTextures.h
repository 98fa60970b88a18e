// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The shader inputs of BRDFs and integrators on one window's GPU.
 */

#ifndef ShaderTextures_h
#define ShaderTextures_h

#include "vtkBRDFShaderInputs.h"
#include "vtkType.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

class vtkBRDF;
class vtkOpenGLRenderWindow;
class vtkRadianceIntegrator;
class vtkShaderProgram;
class vtkTextureObject;

namespace measuredbrdf
{
/// Shader inputs, uploaded. Shared by all mappers that use the same source in a window.
class ShaderTextures
{
public:
  explicit ShaderTextures(bool softLights)
    : SoftLights(softLights)
  {
  }

  /// Makes what a source has to upload. Returns what is wrong with it, or "".
  using Make = std::function<std::string(vtkBRDFShaderInputs&)>;

  ///@{
  /// Those of a source in this window, uploaded if the source changed or the window lost them.
  /// softLights: with what they need of the material. problem: what went wrong, or ""; what was
  /// uploaded before then stays. Never null. time: when the source last changed.
  static std::shared_ptr<ShaderTextures> Find(
    vtkBRDF* brdf, bool softLights, vtkOpenGLRenderWindow* window, std::string& problem);
  static std::shared_ptr<ShaderTextures> Find(
    vtkRadianceIntegrator* integrator, vtkOpenGLRenderWindow* window, std::string& problem);
  static std::shared_ptr<ShaderTextures> Find(const void* source, vtkMTimeType time,
    bool softLights, vtkOpenGLRenderWindow* window, const Make& make, std::string& problem);
  ///@}

  /// Whether all were uploaded to this window, which has not lost them.
  bool IsIn(vtkOpenGLRenderWindow* window) const;

  void Activate();
  void Deactivate();
  /// firstInstance: the number that stands for INSTANCE in the first term's names.
  void SetUniforms(vtkShaderProgram* program, std::size_t firstInstance) const;

  const vtkBRDFShaderInputs& GetInputs() const { return this->Inputs; }
  /// Those that are not counted yet.
  std::size_t CountBytes(std::set<const vtkTextureObject*>& counted) const;
  std::size_t GetNumberOfSamplers() const { return this->Textures.size(); }

private:
  /// Upload what a source makes at that time. What it can't make is not asked for again until it
  /// changes.
  std::string Update(vtkMTimeType time, vtkOpenGLRenderWindow* window, const Make& make);

  struct Uploaded
  {
    std::string Sampler; // without INSTANCE
    std::size_t Term;
    std::shared_ptr<vtkTextureObject> Texture;
    std::size_t Bytes;
    int Unit = -1; // where it was bound last
  };

  std::string Upload(vtkBRDFShaderInputs inputs, vtkMTimeType time, vtkOpenGLRenderWindow* window);

  bool SoftLights;            // what the source is asked for
  vtkBRDFShaderInputs Inputs; // without the textures' data once they are uploaded
  std::vector<Uploaded> Textures;
  vtkMTimeType Time = 0;
  vtkMTimeType FailureTime = 0; // of inputs that a source refused, or had no memory for
  std::string Failure;
  vtkOpenGLRenderWindow* Window = nullptr;
};
/// Why so many textures cannot be bound at once in this window, beside those that VTK may need; ""
/// if they can.
std::string CheckTextureUnits(std::size_t needed, vtkOpenGLRenderWindow* window);

/// How many can.
std::size_t CountTextureUnits(vtkOpenGLRenderWindow* window);
} // namespace measuredbrdf

#endif
