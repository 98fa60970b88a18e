// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeasuredBRDFMapperMixin
 * @brief   lets one of VTK's OpenGL mappers of polydata draw measured materials
 *
 * What vtkMeasuredBRDFMapper and vtkCompositeMeasuredBRDFMapper have in common: the steps of
 * vtkOpenGLPolyDataMapper in which a material takes part. Base is vtkOpenGLPolyDataMapper or one
 * of its subclasses for composite data (vtkCompositeMapperHelper2 up to VTK 9.2,
 * vtkOpenGLBatchedPolyDataMapper since VTK 9.3). Where no material is in use, each step is Base's.
 */

#ifndef vtkMeasuredBRDFMapperMixin_h
#define vtkMeasuredBRDFMapperMixin_h

#include "vtkMeasuredBRDFModule.h"   // for export macro
#include "vtkOpenGLPolyDataMapper.h" // for the types of its methods

#include <map>     // for shaders
#include <memory>  // for Drawing
#include <string>  // for shader keys
#include <utility> // for MaterialUse
#include <vector>  // for MaterialUse

class vtkBRDF;
class vtkEnvironment;
class vtkMeasuredBRDFMapperInternals;  // how materials are drawn
class vtkMeasuredBRDFMapperPoints;     // what is kept of points
struct vtkMeasuredBRDFMapperOcclusion; // what shaders have of what surfaces hide
class vtkPolyData;
class vtkShaderProgram;

template <class Base>
class VTKMEASUREDBRDF_EXPORT vtkMeasuredBRDFMapperMixin : public Base
{
public:
  void RenderPiece(vtkRenderer* ren, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkMeasuredBRDFMapperMixin();
  ~vtkMeasuredBRDFMapperMixin() override;

  /// A material and the surfaces made of it. No material: Base draws them.
  using MaterialUse = std::pair<vtkBRDF*, std::vector<vtkPolyData*>>;

  /// The materials of what is drawn, and their surfaces.
  virtual std::vector<MaterialUse> GetMaterialUses() = 0;

  /// Draw only the surfaces of one material until the next call; -1: all of them. Nothing to do
  /// where there is one material.
  virtual void ShowOnly(int vtkNotUsed(material)) {}

  /// Whether scalars do not color the surfaces that are drawn now, whatever the mapper says.
  virtual bool IgnoresScalars() { return false; }

  void RenderPieceStart(vtkRenderer* ren, vtkActor* actor) override;
  void RenderPieceDraw(vtkRenderer* ren, vtkActor* actor) override;
  void RenderPieceFinish(vtkRenderer* ren, vtkActor* actor) override;
  bool GetNeedToRebuildBufferObjects(vtkRenderer* ren, vtkActor* actor) override;
  void BuildBufferObjects(vtkRenderer* ren, vtkActor* actor) override;
  bool GetNeedToRebuildShaders(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  void UpdateShaders(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;

  using Shaders = std::map<vtkShader::Type, vtkShader*>;
  void ReplaceShaderColor(Shaders shaders, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderEdges(Shaders shaders, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderNormal(Shaders shaders, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderPositionVC(Shaders shaders, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderLight(Shaders shaders, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderTCoord(Shaders shaders, vtkRenderer* ren, vtkActor* actor) override;

  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  void SetPropertyShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;

  /// Whether the primitives now being set up are shaded by a material.
  bool UsesMaterial(const vtkOpenGLHelper* cellBO);

  /// Same key, same text of the materials in the shaders; "" where there are none.
  std::string GetShaderKey(const vtkOpenGLHelper* cellBO);

  /// The light of the scene that the selected materials leave out, by its number; -1: none.
  int FindSuperfluousLight(vtkRenderer* ren);

  /// Whether the material's tangents come with the data.
  bool HasTangents();

  /// Whether scalars color the surfaces that are drawn now.
  bool HasScalarColors();

  /// Hand what the surface hides from itself to the buffers that are being built.
  virtual void AddOcclusion(vtkRenderer* ren);

  /// Warn of what can't be drawn of a surface whose buffers are being built.
  void CheckVertices(vtkPolyData* surface);

  /// Whether what is drawn is a part of a surface that a material map divides.
  virtual bool IsPart() { return false; }

  /// Whether the buffers have what the surface hides from itself; from both sides; what comes back.
  bool HasOcclusion();
  bool HasTwoSidedOcclusion();
  bool HasOcclusionBounce();

  ///@{
  /// OcclusionSides of the buffers.
  double LeastOcclusionCosine = 1.0;
  bool IsOtherSideClosed = false;
  ///@}

  /// Made by the subclass; the mappers that draw the parts of one data set share it.
  std::shared_ptr<vtkMeasuredBRDFMapperInternals> Drawing;

  /// Those that the shaders were made for.
  std::map<const vtkOpenGLHelper*, std::string> ShaderKeys;

  /// Greater than 0 inside of RenderPiece.
  int RenderDepth = 0;

private:
  vtkMeasuredBRDFMapperMixin(const vtkMeasuredBRDFMapperMixin&) = delete;
  void operator=(const vtkMeasuredBRDFMapperMixin&) = delete;

  void WarnOfTextures(vtkActor* actor);
  void ReplaceShaderOcclusion(Shaders shaders);
  vtkMeasuredBRDFMapperOcclusion GetOcclusion();
  bool MayKeepOcclusion();
  bool FitsOcclusion(const vtkMeasuredBRDFMapperOcclusion& occlusion);
  std::vector<vtkEnvironment*> GetEnvironments();
  void KeepOcclusion(
    const vtkMeasuredBRDFMapperOcclusion& occlusion, vtkRenderer* ren, vtkActor* actor);
  void SetOcclusionParameters(vtkShaderProgram* program, vtkRenderer* ren, vtkActor* actor);

  bool HasBadNormals = false;  // of the buffers
  bool HasStarted = false;     // RenderPieceStart, whole
  bool IsPlain = false;        // drawn by the superclass, since materials failed
  int BuiltOcclusionMode = -1; // of the buffers
  bool BuiltOcclusionBounce = false;
  const void* BuiltTracedOcclusion = nullptr;
  std::size_t MostAttributes = 0; // of the graphics card that has the buffers
  std::size_t MostVaryings = 0;
  std::size_t VaryingsOfBase = 0; // for clipping planes and edges, in this frame
  vtkTimeStamp OcclusionTime;     // when the buffers were built
  std::unique_ptr<vtkMeasuredBRDFMapperPoints> Points; // of the buffers
};

#endif
