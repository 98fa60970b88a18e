// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A mapper of VTK's whose steps a MaterialShading takes part in: of a batch of blocks, or of a part
 * of a divided surface.
 */

#ifndef ShadedMapper_h
#define ShadedMapper_h

#include "MaterialShading.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkShaderProgram.h"

namespace measuredbrdf
{
/// Base: vtkOpenGLPolyDataMapper or its subclass for batches of blocks.
template <class Base>
class ShadedMapper
  : public Base
  , public MaterialShading
{
public:
  void RenderPiece(vtkRenderer* ren, vtkActor* actor) override
  {
    this->DrawPiece([&]() { this->Base::RenderPiece(ren, actor); },
      [&]() { this->Base::RenderPieceFinish(ren, actor); });
  }
  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    this->ReleaseMaterials(window);
    this->Base::ReleaseGraphicsResources(window);
  }

protected:
  ShadedMapper()
    : MaterialShading(this)
  {
  }

  void RenderPieceStart(vtkRenderer* ren, vtkActor* actor) override
  {
    this->StartPiece(
      ren, actor, [&]() { this->Base::RenderPieceStart(ren, actor); },
      [&]() { this->RenderPieceDraw(ren, actor); });
  }
  void RenderPieceDraw(vtkRenderer* ren, vtkActor* actor) override
  {
    this->DrawMaterials([&]() { this->Base::RenderPieceDraw(ren, actor); });
  }
  void RenderPieceFinish(vtkRenderer* ren, vtkActor* actor) override
  {
    this->FinishPiece([&]() { this->Base::RenderPieceFinish(ren, actor); });
  }
  bool GetNeedToRebuildBufferObjects(vtkRenderer* ren, vtkActor* actor) override
  {
    return this->Base::GetNeedToRebuildBufferObjects(ren, actor) || this->AreBuffersOutdated();
  }
  void BuildBufferObjects(vtkRenderer* ren, vtkActor* actor) override
  {
    this->PrepareBuffers(ren);
    this->Base::BuildBufferObjects(ren, actor);
  }
  bool GetNeedToRebuildShaders(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override
  {
    const bool rebuild = this->Base::GetNeedToRebuildShaders(cellBO, ren, actor);
    return this->AreShadersOutdated(cellBO, ren) || rebuild;
  }
  void ReplaceShaderValues(Shaders shaders, vtkRenderer* ren, vtkActor* actor) override
  {
    this->ReplaceValues(
      shaders, actor, [&]() { this->Base::ReplaceShaderValues(shaders, ren, actor); });
  }
  void ReplaceShaderLight(Shaders shaders, vtkRenderer* ren, vtkActor* actor) override
  {
    if (!this->ReplaceLight(shaders, ren, actor))
    {
      this->Base::ReplaceShaderLight(shaders, ren, actor);
    }
  }
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override
  {
    this->Base::SetMapperShaderParameters(cellBO, ren, actor);
    this->SetMapperUniforms(cellBO, ren, actor);
  }
  void SetPropertyShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override
  {
    this->Base::SetPropertyShaderParameters(cellBO, ren, actor);
    this->SetPropertyUniforms(cellBO, actor);
  }
};
} // namespace measuredbrdf

#endif
