// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The integral of a pair of normal and view, or of several pairs at once, for
 * vtkAdaptiveRadianceIntegrator, which says how.
 */

#ifndef AdaptiveSum_h
#define AdaptiveSum_h

#include "ErrorQueue.h"
#include "LightLanes.h"
#include "LocalFrame.h"
#include "ReflectionGuide.h"
#include "SquareMiddles.h"
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

class vtkBRDF;

namespace measuredbrdf
{
/**
 * The sky's squares are divided where the estimated error is largest, until the sum's error is
 * within the tolerance. Squares are made many at a time, so that f is evaluated for many directions
 * at once.
 *
 * Several pairs that are nearly the same, as neighboring pixels' are, share their squares: a square
 * then costs little more than for one pair, but for f, and what one pair needs serves all. Each
 * pair's error is estimated by itself: all are within the tolerance. Size: the pairs, 1 or 4.
 */
template <int Size>
class AdaptiveSum
{
public:
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
  // quarter's own. Single precision: sums of many are not.
  struct Square
  {
    int Level;
    int X;
    int Y;
    float Key;     // in the queue
    bool IsQueued; // that is, in the totals
    struct
    {
      float LeastError; // a square where the larger one was wrong may agree with its quarters
      float Cosine;     // of theta_i of its middle
      float Whole[3];
      float Value[3];
      float Error;
      float Quarters[3][4];
      float Cosines[4];
    } Of[Size]; // the pairs
  };
  void Start(const ReflectionGuide& guide);
  void Evaluate(int count);
  void MakeAll();
  void Make(std::size_t first, std::size_t last);
  void Finish(std::size_t index);
  void AddRisingErrors(Square& square);
  void AddHiddenErrors(Square& square) const;
  void Keep(std::size_t index);
  void Count(const Square& square, double sign);
  Square& Add(int level, int x, int y);
  void AddQuarters(std::size_t index);
  bool FindWeights();
  float GetKey(const Square& square) const;

  const TexelTree* Texels = nullptr;
  vtkBRDF* BRDF = nullptr;
  LightLanes Lights; // of it
  Pair Pairs[Size];
  glm::dmat3 Local[Size];       // from the environment's frame
  float Rows[Size][9] = {};     // their rows
  ReflectionGuide::Peaks Peaks; // of the first pair
  double Tolerance = 0.0;
  int Evaluations = 0;
  glm::dvec3 Totals[Size] = {};
  double Errors[Size] = {};  // sums of the squares' errors
  double Squares[Size] = {}; // of their squares
  float Weights[Size] = {};  // of errors: 0 of pairs that are exact enough
  bool IsQueuing = false;
  std::vector<Square> All;      // divided ones, too, and room for more
  std::size_t NumberOfAll = 0;  // without that room
  std::size_t NumberOfMade = 0; // that have quarters
  ErrorQueue Queue;             // of those that are not divided
  FirstSquares First;
  SquareMiddles Steps[Size];
};
} // namespace measuredbrdf

#endif
