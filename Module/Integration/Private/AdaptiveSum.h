// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The integral of one pair for vtkAdaptiveRadianceIntegrator, which says how. Private to the
 * module.
 */

#ifndef AdaptiveSum_h
#define AdaptiveSum_h

#include "ErrorQueue.h"
#include "FirstSquares.h"
#include "LightLanes.h"
#include "LocalFrame.h"
#include "ReflectionGuide.h"
#include "SquareMiddles.h"
#include "TexelTree.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

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

  /// How often that evaluated f, about.
  int GetNumberOfEvaluations() const { return this->Evaluations; }

private:
  /// A place in the tree, and what it sends by its own middle. Single precision: sums of many are
  /// not.
  struct Place
  {
    int Level;
    int X;
    int Y;
    float LeastError; // a square where the larger one was wrong may agree with its quarters
    glm::vec3 Value;
    float Cosine; // of theta_i of its middle
  };
  struct Square
  {
    Place Whole;
    glm::vec3 Value; // by the quarters
    float Error;
    float Quarters[3][4]; // their own, by channel
    float Cosines[4];
  };
  void Start(const ReflectionGuide& guide);
  void Evaluate(int count);
  void EvaluatePlaces();
  void MakeAll();
  void Make(std::size_t first, std::size_t last);
  void Finish(std::size_t index);
  float EstimateRising(const Place& place);
  float EstimateHidden(const Square& square) const;
  void Keep(std::size_t index);
  void Add(const Place& place);
  void AddQuarters(std::size_t index);

  const TexelTree* Texels = nullptr;
  vtkBRDF* BRDF = nullptr;
  LightLanes Lights;                  // of it
  glm::dmat3 Local = glm::dmat3(1.0); // from the environment's frame
  float Rows[9] = {};                 // its rows
  glm::dvec3 View = glm::dvec3(0.0, 0.0, 1.0);
  double Tolerance = 0.0;
  int Evaluations = 0;
  ReflectionGuide::Peaks Peaks;
  glm::dvec3 Total = glm::dvec3(0.0);
  double Error = 0.0;       // sum of the squares' errors
  double Squares = 0.0;     // of their squares
  std::vector<Square> All;  // divided ones, too, and room for more
  std::size_t Count = 0;    // of them
  std::size_t Made = 0;     // that have quarters
  ErrorQueue Queue;         // of those that are not divided
  std::vector<Place> Asked; // where to begin
  // Within one step.
  FirstSquares First;
  SquareMiddles Step;
};
} // namespace measuredbrdf

#endif
