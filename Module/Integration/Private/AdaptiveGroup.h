// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The integrals of four pairs that are nearly the same, as neighboring pixels' are, over the same
 * squares. Private to the module.
 */

#ifndef AdaptiveGroup_h
#define AdaptiveGroup_h

#include "ErrorQueue.h"
#include "FirstSquares.h"
#include "FourNumbers.h"
#include "LightLanes.h"
#include "LocalFrame.h"
#include "ReflectionGuide.h"
#include "SquareMiddles.h"
#include "TexelTree.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
/// As AdaptiveSum, with each pair's error estimated by itself: all four are within the tolerance. A
/// square costs little more than for one pair, but for f; and what one pair needs serves all.
class AdaptiveGroup
{
public:
  static constexpr int Size = 4;

  struct Pair
  {
    Frame Axes;
    glm::dvec3 View; // local
  };

  /// May be called again, with anything: it only keeps memory.
  void Run(const TexelTree& texels, const ReflectionGuide& guide, vtkBRDF* brdf,
    const Pair pairs[Size], double tolerance, glm::dvec3 radiance[Size]);

  /// How often that evaluated f, about.
  int GetNumberOfEvaluations() const { return this->Evaluations; }

private:
  // A place in the tree, and what it sends to each pair: by its middle, by its quarters, and each
  // quarter's own.
  struct Square
  {
    int Level;
    int X;
    int Y;
    float Key;        // in the queue
    bool IsCounted;   // in the totals
    Fours LeastError; // a square where the larger one was wrong may agree with its quarters
    Fours Cosine;     // of theta_i of its middle
    Fours Whole[3];
    Fours Value[3];
    Fours Error;
    Fours Quarters[3][4];
    Fours Cosines[4];
  };
  void Start(const ReflectionGuide& guide);
  void Evaluate(int count);
  void MakeAll();
  void Make(std::size_t first, std::size_t last);
  void Finish(std::size_t index);
  Fours EstimateRising(const Square& square);
  Fours EstimateHidden(const Square& square) const;
  void Keep(std::size_t index);
  void AddQuarters(std::size_t index);
  Square& Add(int level, int x, int y);
  bool FindWeights();
  float GetKey(const Square& square) const;
  void TakeOut(const Square& square);

  const TexelTree* Texels = nullptr;
  vtkBRDF* BRDF = nullptr;
  LightLanes Lights;
  Pair Pairs[Size];
  glm::dmat3 Local[Size];       // from the environment's frame
  float Rows[Size][9] = {};     // their rows
  ReflectionGuide::Peaks Peaks; // of the first pair
  double Tolerance = 0.0;
  int Evaluations = 0;
  double Totals[3][Size] = {};
  double Errors[Size] = {};  // sums of the squares' errors
  double Squares[Size] = {}; // of their squares
  Fours Weights;             // of errors: 0 of pairs that are exact enough
  bool IsQueuing = false;
  std::vector<Square> All; // divided ones, too, and room for more
  std::size_t Count = 0;   // of them
  std::size_t Made = 0;    // that have quarters
  ErrorQueue Queue;        // of those that are not divided
  FirstSquares First;
  SquareMiddles Steps[Size];
};
} // namespace measuredbrdf

#endif
