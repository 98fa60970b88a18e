// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a leak is told by: things that are counted. The process's size is not one of them: it also
 * follows the allocator, the driver's threads and what else the machine does.
 */

#ifndef StabilityMemory_h
#define StabilityMemory_h

namespace tool::stability
{
/// MB that are allocated and not freed, in all threads; 0 where the C library does not tell. On a
/// software renderer textures are among them.
double GetHeapInUse();

/// How many textures, buffers, framebuffers, renderbuffers, vertex arrays, programs and shaders
/// the current OpenGL context holds; -1 where that can't be asked.
int CountOpenGLObjects();
} // namespace tool::stability

#endif
