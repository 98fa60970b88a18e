// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a leak is told by: things that are counted. The process's size is not one of them: it also
 * follows the allocator, the driver's threads and what else the machine does.
 */

#ifndef StabilityMemory_h
#define StabilityMemory_h

#include <vector>

namespace tool::stability
{
/// MB that are allocated and not freed, in all threads; 0 where the C library does not tell. On a
/// software renderer textures are among them.
double GetHeapInUse();

/**
 * How much the heap grows while something is repeated. A leak adds in every part of the run; what
 * the C library, the driver or its threads set up at a time of their own adds in one. So the run is
 * cut into up to five equal parts, and the median of their growths counts for each.
 */
class HeapGrowth
{
public:
  /// To call once at the beginning, and after each repetition.
  void Add();

  /// MB, of all repetitions together.
  double Get() const;

private:
  std::vector<double> InUse;
};

/// How many textures, buffers, framebuffers, renderbuffers, vertex arrays, programs and shaders
/// the current OpenGL context holds; -1 where that can't be asked.
int CountOpenGLObjects();
} // namespace tool::stability

#endif
