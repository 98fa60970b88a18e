// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What VTK calls the mapper of a batch of blocks, and its record of a block. Private to the
 * rendering room.
 */

#ifndef BatchBase_h
#define BatchBase_h

#include "vtkVersionMacros.h"

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkOpenGLBatchedPolyDataMapper.h"
#include "vtkOpenGLCompositePolyDataMapperDelegator.h"
#else
using GLenum = unsigned int; // which the next header takes for declared
#include "vtkCompositeMapperHelper2.h"
#endif

namespace measuredbrdf
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
using BatchBase = vtkOpenGLBatchedPolyDataMapper;
using BlockRecord = vtkOpenGLBatchedPolyDataMapper::GLBatchElement;
inline vtkPolyData* GetSurface(BlockRecord* record) { return record->Parent.PolyData; }
#else
using BatchBase = vtkCompositeMapperHelper2;
using BlockRecord = vtkCompositeMapperHelperData;
inline vtkPolyData* GetSurface(BlockRecord* record) { return record->Data; }
#endif
} // namespace measuredbrdf

#endif
