// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The integral of a pair of normal and view, or of several pairs at once, for
 * vtkAdaptiveRadianceIntegrator, which says how.
 */

#ifndef AdaptiveSum_h
#define AdaptiveSum_h

#include "LightLanes.h"
#include "LocalFrame.h"
#include "TexelTree.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <queue>
#include <utility>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
/// The middles of many squares of the sky in one step of an adaptive sum, one beside the other, in
/// single precision: sums of many are not.
struct SquareMiddles
{
  static constexpr int Most = 64;

  // To be set: of each middle.
  float Directions[3][Most]; // in the sky's frame
  float Irradiances[3][Most];

  // What Turn finds: of each middle, and of those that count, which are above the horizon and not
  // black.
  float Cosines[Most];    // of theta_i
  float Lights[3][Most];  // their directions in the local frame
  float Factors[3][Most]; // irradiance times cosine
  int Numbers[Most];      // of those that count
  int Counting;

  // What Weigh finds: of each middle, f times its factor; 0 where it does not count.
  float Values[3][Most];
  glm::vec3 GetValue(std::size_t k) const
  {
    return { this->Values[0][k], this->Values[1][k], this->Values[2][k] };
  }

  /// rows: of the matrix from the sky's frame to the local one, 3 by 3.
  void Turn(int count, const float rows[9]);

  /// f: of those that count, by channel; room for Most each.
  void Weigh(int count, float f[3][Most]);
};

/// Where a view is reflected to, so that sums over the environment know where to look: a few
/// directions drawn from f cos(theta_i), and the peaks of f, which few draws and few points of a
/// sum may both miss.
class ReflectionGuide
{
public:
  /// Unit direction, and the solid angle in sr in which a draw is alone on average.
  struct Draw
  {
    glm::dvec3 Direction;
    double SolidAngle;
  };

  /// Of a prepared BRDF, which is used later on.
  explicit ReflectionGuide(vtkBRDF* brdf);

  /// Draws for unit o above the horizon, in its frame; draws is replaced.
  void Draws(const glm::dvec3& o, std::vector<Draw>& draws) const;

  /// The largest f of one view, by direction.
  class Peaks
  {
  public:
    /// In rad: within less, it is not known whether a peak is inside or beside.
    static constexpr double GetResolution() { return 0.04; }

    /// Sum of the channels, about unit i within so many radians and somewhat beyond; and the solid
    /// angle that this peak fills at least. 0 where nothing is known.
    double Get(const glm::dvec3& i, double radius, double& solidAngle) const;

  private:
    friend class ReflectionGuide;
    const float* Cells = nullptr; // all levels
    glm::dvec2 Azimuth;           // the view's: cosine and sine
  };
  Peaks GetPeaks(const glm::dvec3& o) const;

private:
  void TabulatePeaks();

  vtkSmartPointer<vtkBRDF> BRDF;
  // Half vectors of an isotropic BRDF's draws, by the view, whose azimuth is 0: nearly the same for
  // all views about it, or turned with them where light is sent back.
  std::vector<std::vector<Draw>> Views;
  std::vector<float> PeakCells; // likewise: view, level, cell of the hemisphere's square
};

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
      glm::vec3 Whole;
      glm::vec3 Value;
      float Error;
      glm::vec3 Quarters[4];
      float Cosines[4];
    } Of[Size]; // the pairs
  };
  // A square to begin with: small where draws of f are, and large elsewhere.
  struct Place
  {
    int Level, X, Y;
  };
  struct Drawn
  {
    glm::vec3 Direction; // in the environment's frame
    float Radius;        // of a square that may stay whole about it
  };
  void Start(const ReflectionGuide& guide);
  void FindPlaces(int level, int x, int y, std::size_t first);
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
  std::priority_queue<std::pair<float, std::uint32_t>> Queue; // those that are not divided, by Key
  std::vector<ReflectionGuide::Draw> Draws;
  std::vector<Drawn> Near; // those of a square behind those of the larger one
  std::vector<Place> Places;
  SquareMiddles Steps[Size];
};
} // namespace measuredbrdf

#endif
