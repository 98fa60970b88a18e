// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The squares of the sky with which an adaptive sum begins. Private to the module.
 */

#ifndef FirstSquares_h
#define FirstSquares_h

#include "LocalFrame.h"
#include "ReflectionGuide.h"
#include "TexelTree.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// Small where draws of f are, and large elsewhere.
class FirstSquares
{
public:
  struct Square
  {
    int Level;
    int X;
    int Y;
  };

  /// Forgets all draws; keeps memory.
  void Clear() { this->Near.clear(); }

  /// Every step-th draw from the first one on; local: from the environment's frame.
  void AddDraws(const ReflectionGuide& guide, const glm::dmat3& local, const glm::dvec3& view,
    std::size_t first = 0, std::size_t step = 1);

  /// They cover the sky once.
  const std::vector<Square>& Find(const TexelTree& texels);

private:
  struct Drawn
  {
    glm::vec3 Direction; // in the environment's frame
    float Radius;        // of a square that may stay whole about it
  };
  void Force(const TexelTree& texels, int level, int x, int y, std::size_t first);

  std::vector<ReflectionGuide::Draw> Draws;
  std::vector<Drawn> Near; // those of a square behind those of the larger one
  std::vector<Square> Squares;
};
} // namespace measuredbrdf

#endif
