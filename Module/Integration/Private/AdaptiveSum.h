// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The integral of one pair for vtkAdaptiveRadianceIntegrator, which says how. Private to the
 * module.
 */

#ifndef AdaptiveSum_h
#define AdaptiveSum_h

#include "LocalFrame.h"
#include "ReflectionGuide.h"
#include "TexelTree.h"

#include <glm/glm.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

class vtkAdaptiveWarpBRDF;
class vtkBRDF;

namespace measuredbrdf
{
/// Squares are made many at a time, so that f is evaluated for many directions at once.
class AdaptiveSum
{
public:
  /// May be called again, with anything: it only keeps memory.
  glm::dvec3 Run(const TexelTree& texels, const ReflectionGuide& guide, vtkBRDF* brdf,
    const Frame& frame, const glm::dvec3& view, double tolerance);

private:
  /// A place in the tree, and what it sends by its own middle.
  struct Place
  {
    int Level;
    int X;
    int Y;
    double LeastError; // a square where the larger one was wrong may agree with its quarters
    glm::dvec3 Value;
    double Cosine; // of theta_i of its middle
  };
  struct Square
  {
    Place Whole;
    double Error;
    glm::dvec3 Value;       // by the quarters
    glm::dvec3 Quarters[4]; // their own
    double Cosines[4];
  };
  struct Drawn
  {
    glm::dvec3 Direction; // in the environment's frame
    double Radius;        // of a square that may stay whole about it
  };
  using Entry = std::pair<double, std::size_t>; // error, number of the square

  void Start(const ReflectionGuide& guide);
  void Evaluate(std::vector<Place>& places);
  void MakeAll();
  void Finish(std::size_t index);
  double EstimateRising(const Place& place);
  double EstimateHidden(const Square& square, const TexelTree::Light& light) const;
  void Keep(std::size_t index);
  void Ask(const Square& square, int quarter);
  void AddQuarters(const Square& square);
  void Force(int level, int x, int y, std::size_t first);

  double EstimateError() const;

  const TexelTree* Texels = nullptr;
  vtkBRDF* BRDF = nullptr;
  vtkAdaptiveWarpBRDF* Measured = nullptr; // the same, where it evaluates many lights at once
  glm::dmat3 Local = glm::dmat3(1.0);
  glm::dvec3 View = glm::dvec3(0.0, 0.0, 1.0);
  double Tolerance = 0.0;
  ReflectionGuide::Peaks Peaks;
  glm::dvec3 Total = glm::dvec3(0.0);
  double Error = 0.0;       // sum of the squares' errors
  double Squares = 0.0;     // of their squares
  std::vector<Square> All;  // divided ones, too
  std::vector<Entry> Heap;  // the largest error first
  std::vector<Place> Asked; // to become squares
  // Within one step.
  std::vector<ReflectionGuide::Draw> Draws;
  std::vector<Drawn> Near; // those of a square behind those of the larger one
  std::vector<Place> Quarters;
  std::vector<TexelTree::Light> Found;
  std::vector<glm::dvec3> Lights;
  std::vector<glm::dvec3> Values;
  std::vector<glm::dvec3> Irradiances;
};
} // namespace measuredbrdf

#endif
