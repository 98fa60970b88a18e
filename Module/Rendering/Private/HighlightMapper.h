// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws what vtkMapper::SetSelection highlights on a surface, and nothing else of it: the surface
 * itself is drawn part by part. Private to the rendering room.
 */

#ifndef HighlightMapper_h
#define HighlightMapper_h

#include "vtkOpenGLPolyDataMapper.h"

namespace measuredbrdf
{
class HighlightMapper : public vtkOpenGLPolyDataMapper
{
public:
  static HighlightMapper* New();
  vtkTypeMacro(HighlightMapper, vtkOpenGLPolyDataMapper);

protected:
  HighlightMapper() = default;
  ~HighlightMapper() override = default;

  void BuildBufferObjects(vtkRenderer* ren, vtkActor* actor) override;

private:
  HighlightMapper(const HighlightMapper&) = delete;
  void operator=(const HighlightMapper&) = delete;
};
} // namespace measuredbrdf

#endif
