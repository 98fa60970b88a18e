// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The steps of vtkOpenGLPolyDataMapper in which a material takes part: buffers, shader text,
 * uniforms.
 *
 * Three mappers shade with materials: vtkMeasuredBRDFMapper itself, the mapper of a batch of blocks
 * and the mappers of a divided surface's parts (ShadedMapper). Each has a MaterialShading of its
 * own, which its overrides of VTK's methods call; what they draw with they find in one
 * MaterialDrawing. Where no material is in use, each step is VTK's.
 */

#ifndef MaterialShading_h
#define MaterialShading_h

#include "MaterialDrawing.h"
#include "vtkShader.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkActor;
class vtkOpenGLHelper;
class vtkOpenGLPolyDataMapper;
class vtkOpenGLState;
class vtkPolyData;
class vtkRenderer;
class vtkShaderProgram;
class vtkWindow;

namespace measuredbrdf
{
/// How much goes into and through the stages of a shader.
struct ShaderLimits
{
  ///@{
  /// What OpenGL 3.2 guarantees: attributes of a vertex, and components of what a stage hands to
  /// the next one.
  std::size_t Attributes = 16;
  std::size_t Varyings = 60;
  ///@}

  /// Of a graphics card.
  static ShaderLimits Read(vtkOpenGLState* state);

  /// For tests: Read gives no more than these from now on; zeros: what there is.
  static void SetMost(std::size_t attributes, std::size_t varyings);
};

/// Gives a variable its value back in the end, whatever way that comes.
template <typename T>
class Restored
{
public:
  explicit Restored(T& variable)
    : Variable(variable)
    , Value(variable)
  {
  }
  ~Restored() { this->Variable = this->Value; }
  Restored(const Restored&) = delete;
  void operator=(const Restored&) = delete;

private:
  T& Variable;
  T Value;
};

/// The tag stays, for what comes after.
void AddAfterTag(vtkShader* shader, const std::string& tag, const std::string& lines);

class MaterialShading
{
public:
  using Shaders = std::map<vtkShader::Type, vtkShader*>;
  using Step = std::function<void()>; // what VTK's class does there

  explicit MaterialShading(
    vtkOpenGLPolyDataMapper* mapper, std::shared_ptr<MaterialDrawing> drawing = nullptr);
  virtual ~MaterialShading();
  MaterialShading(const MaterialShading&) = delete;
  void operator=(const MaterialShading&) = delete;

  ///@{
  /// RenderPiece and its three stages. A step that throws is drawn again by VTK's class alone.
  void DrawPiece(const Step& render, const Step& finish);
  void StartPiece(vtkRenderer* ren, vtkActor* actor, const Step& start, const Step& draw);
  void DrawMaterials(const Step& draw);
  void FinishPiece(const Step& finish);
  ///@}

  ///@{
  /// BuildBufferObjects.
  bool AreBuffersOutdated() const;
  void PrepareBuffers(vtkRenderer* ren);
  ///@}

  ///@{
  /// UpdateShaders, and what BuildShaders writes: ReplaceLight returns whether a material did it.
  bool AreShadersOutdated(const vtkOpenGLHelper& cellBO, vtkRenderer* ren);
  void ReplaceValues(Shaders shaders, vtkActor* actor, const Step& replace);
  bool ReplaceLight(Shaders shaders, vtkRenderer* ren, vtkActor* actor);
  ///@}

  ///@{
  /// After those that VTK's class sets.
  void SetMapperUniforms(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor);
  void SetPropertyUniforms(vtkOpenGLHelper& cellBO, vtkActor* actor);
  ///@}

  void ReleaseMaterials(vtkWindow* window);

  /// Shared by the mappers that draw the parts of one data set. Null in a mapper that has not
  /// been given one yet.
  std::shared_ptr<MaterialDrawing> Drawing;

  /// Greater than 0 inside of RenderPiece.
  int RenderDepth = 0;

protected:
  ///@{
  /// What the mapper draws: its materials (MaterialDrawing::BeginFrame); only those of one material
  /// until the next call (-1: all of them); whether scalars do not color what is drawn now,
  /// whatever the mapper says; whether it is a part of a surface that a material map divides.
  virtual std::vector<vtkBRDF*> GetBRDFs() = 0;
  virtual void ShowOnly(int vtkNotUsed(material)) {}
  virtual bool IgnoresScalars() { return false; }
  virtual bool IsPart() { return false; }
  ///@}

  /// Hand what the surface hides from itself to the buffers that are being built.
  virtual void AddOcclusion(vtkRenderer* ren);

  /// Hand a value of the vertex shader on to the fragment shader, as `name`VSOutput, beside the
  /// positions, whose tags are still there.
  static void PassOn(
    Shaders shaders, const std::string& type, const std::string& name, const std::string& value);

  /// Warn of what can't be drawn of a surface whose buffers are being built.
  void CheckVertices(vtkPolyData* surface);

  /// Whether the primitives now being set up are shaded by a material.
  bool UsesMaterial(const vtkOpenGLHelper* cellBO) const;

  /// Whether the buffers have what the surface hides from itself.
  bool HasOcclusion() const { return this->HasBuffer("brdfSky0", 4); }

  OcclusionSides Sides; // of the buffers

  /// What buffers are built of, which only point to the arrays until that is done.
  std::vector<OcclusionArrays> Occlusion;

  /// Same key, same shader text: of the shaders that each kind of primitives has.
  std::map<const vtkOpenGLHelper*, std::string> ShaderKeys;

  std::string GetShaderKey(const vtkOpenGLHelper* cellBO);

private:
  struct SurfaceOcclusion
  {
    OcclusionLights Lights; // none: nothing is hidden
    OcclusionLayout Layout;
  };

  bool HasTangents() const;
  bool HasScalarColors();
  bool HasBuffer(const char* name, int components) const;
  int FindSuperfluousLight(vtkRenderer* ren) const;
  void WarnOfTextures(vtkActor* actor);
  void PassTangentsOn(Shaders shaders) const;
  SurfaceOcclusion GetOcclusion();
  bool FitsOcclusion(const SurfaceOcclusion& occlusion) const;
  void SetOcclusionUniforms(vtkShaderProgram* program, vtkRenderer* ren, vtkActor* actor);

  vtkOpenGLPolyDataMapper* Mapper;
  int LightComplexity = 0;     // VTK's, of the primitives whose shaders are being made
  bool HasBadNormals = false;  // of the buffers
  bool HasStarted = false;     // RenderPieceStart, whole
  bool IsPlain = false;        // drawn by VTK's class, since materials failed
  int BuiltOcclusionMode = -1; // of the buffers
  bool BuiltOcclusionBounce = false;
  vtkSmartPointer<vtkDataObject> BuiltTracedOcclusion;
  ShaderLimits Limits;            // of the graphics card that has the buffers
  std::size_t VaryingsOfBase = 0; // for clipping planes and edges, in this frame
};
} // namespace measuredbrdf

#endif
