// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pairs of normal and view from arrays, and work on many of them that can be stopped.
 */

#ifndef DirectionPairs_h
#define DirectionPairs_h

#include "LocalFrame.h"
#include "vtkDataArray.h"
#include "vtkEnvironment.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

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

/// Appends pairs of unit normal, view and tangent, which may be zero or null; what is wrong with
/// the arrays, or "".
template <typename Pair>
std::string TakePairs(
  vtkDataArray* normals, vtkDataArray* views, vtkDataArray* tangents, std::vector<Pair>& pairs)
{
  const vtkIdType count = normals->GetNumberOfTuples();
  for (vtkDataArray* array : { normals, views, tangents })
  {
    if (array && (array->GetNumberOfComponents() != 3 || array->GetNumberOfTuples() != count))
    {
      return "normals, views and tangents must have 3 components and equally many tuples.";
    }
  }
  for (vtkIdType k = 0; k < count; ++k)
  {
    const glm::dvec3 n = GetDirection(normals, k);
    const glm::dvec3 v = GetDirection(views, k);
    const glm::dvec3 t = GetDirection(tangents, k);
    if (!IsFiniteDirection(n) || !IsFiniteDirection(v) || !IsFiniteDirection(t) ||
        n == glm::dvec3(0.0) || v == glm::dvec3(0.0))
    {
      return "pair " + std::to_string(k) + " holds a direction that is zero or not finite.";
    }
    const glm::dvec3 normal = NormalizeAny(n);
    pairs.push_back({ normal, LiftView(NormalizeAny(v), normal), NormalizeAny(t) });
  }
  return "";
}

/// Into the environment's frame.
template <typename Pair>
void TurnPairs(vtkEnvironment* environment, std::vector<Pair>& pairs)
{
  double rows[9];
  environment->GetWorldToEnvironment(rows);
  const glm::dmat3 turn(rows[0], rows[3], rows[6], rows[1], rows[4], rows[7], rows[2], rows[5],
    rows[8]); // glm takes columns
  for (Pair& pair : pairs)
  {
    pair = { turn * pair.Normal, turn * pair.View, turn * pair.Tangent };
  }
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
