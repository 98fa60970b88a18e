// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The middles of many squares of the sky in one step of an adaptive sum, one beside the other, in
 * single precision: sums of many are not.
 */

#ifndef SquareMiddles_h
#define SquareMiddles_h

#include <cstddef>

namespace measuredbrdf
{
class TexelTree;

struct SquareMiddles
{
  static constexpr int Most = 64; // a multiple of LaneCount

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

  /// Sets those of a square's four quarters, from number at on.
  void SetQuarters(std::size_t at, const TexelTree& texels, int level, int x, int y);

  /// rows: of the matrix from the sky's frame to the local one, 3 by 3.
  void Turn(int count, const float rows[9]);

  /// f: of those that count, by channel; room for Most each.
  void Weigh(int count, float f[3][Most]);
};
} // namespace measuredbrdf

#endif
