// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The tables of vtkAdaptiveWarpBRDF once more, in single precision and in an order in which what a
 * pair looks up lies side by side: for many lights at a time, where nothing depends on the light's
 * azimuth.
 */

#ifndef PackedWarp_h
#define PackedWarp_h

#include "BilinearWarp.h"

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
class PackedWarp
{
public:
  /// Tables over theta_i alone; jacobian: whether ndf and sigma count.
  struct Tables
  {
    const BilinearWarp& Ndf;
    const BilinearWarp& Sigma;
    const BilinearWarp& Vndf;
    const BilinearWarp* Rgb; // three
    const std::vector<float>& ThetaI;
    bool Jacobian;
  };
  explicit PackedWarp(const Tables& tables);

  /// f of so many lights for one view, all of them unit vectors above the horizon. lights: x, y and
  /// z; f: red, green and blue. Angles are exact to 1e-6 rad; where the half vector is nearly the
  /// normal, its azimuth is less exact.
  void Evaluate(
    int count, const float* const lights[3], const double view[3], float* const f[3]) const;

private:
  struct Grid
  {
    int Width;
    int Height;
  };

  bool Jacobian;
  Grid Warp;
  Grid Color;
  Grid Normal; // of the ndf
  int SigmaWidth;
  std::vector<float> Thetas;   // of the slices
  std::vector<float> Inverses; // of the steps between them
  std::vector<float> Nodes;  // slice, row, column: density, its integral along the row up to there
  std::vector<float> Rows;   // slice, row: the row's integral, that of all rows before it
  std::vector<float> Colors; // slice, row, column: R, G, B, 0
  std::vector<float> Ndf;    // row, column
  std::vector<float> Sigma;  // its first row
};
} // namespace measuredbrdf

#endif
