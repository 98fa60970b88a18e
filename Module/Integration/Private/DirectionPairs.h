// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pairs of normal and view, directions from arrays, and work on many of them that can be stopped.
 */

#ifndef DirectionPairs_h
#define DirectionPairs_h

#include "vtkDataArray.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

/// Unit vectors; the tangent may be zero.
struct vtkDirectionPair
{
  glm::dvec3 Normal;
  glm::dvec3 View;
  glm::dvec3 Tangent;
};

namespace measuredbrdf
{
inline glm::dvec3 GetDirection(vtkDataArray* array, vtkIdType index)
{
  glm::dvec3 d(0.0);
  if (array)
  {
    array->GetTuple(index, &d.x);
  }
  return d;
}

inline void AddRGB(const glm::dvec3& rgb, double sum[3])
{
  for (int c = 0; c < 3; ++c)
  {
    sum[c] += rgb[c];
  }
}

/// Unit vector; zero stays zero. Scaled first, so that no finite length over- or underflows.
inline glm::dvec3 NormalizeAny(const glm::dvec3& d)
{
  const double scale = std::max({ std::abs(d.x), std::abs(d.y), std::abs(d.z) });
  return scale > 0.0 ? glm::normalize(d / scale) : d;
}

inline bool IsFiniteDirection(const glm::dvec3& d)
{
  return std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.z);
}

/// Calls work(first, size) for one batch after the other of so many things, larger ones until one
/// takes what a caller may wait for between two looks at the abort flag and the progress. After
/// each batch it calls report(share done), which returns whether to go on. Returns whether it went
/// to the end.
template <typename Work, typename Report>
bool WorkInBatches(vtkIdType count, const Work& work, const Report& report)
{
  constexpr std::chrono::milliseconds batchTime(50);
  vtkIdType batch = 1;
  for (vtkIdType first = 0; first < count;)
  {
    const vtkIdType size = std::min(batch, count - first);
    const auto start = std::chrono::steady_clock::now();
    work(first, size);
    first += size;
    if (std::chrono::steady_clock::now() - start < batchTime / 2)
    {
      batch *= 2;
    }
    if (!report(static_cast<double>(first) / static_cast<double>(count)))
    {
      return false;
    }
  }
  return true;
}
} // namespace measuredbrdf

#endif
