// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The tables of vtkAdaptiveWarpBRDF once more, in single precision and in an order in which what a
 * pair looks up lies side by side. For many lights at a time, where nothing depends on the light's
 * azimuth. Private to the module.
 */

#ifndef PackedWarp_h
#define PackedWarp_h

#include "BilinearWarp.h"
#include "WarpLanes.h"

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

  /// f of count lights whose coordinates these are: red, green and blue; cosine: of theta_o.
  /// Numbers up to the next multiple of 8 behind them are written, too. form: one that the
  /// processor has.
  void Evaluate(int count, const WarpLanes& lanes, double cosine, float* const f[3],
    VectorForm form = GetWidestForm()) const;

private:
  struct Grid
  {
    int Width;
    int Height;
  };
  struct Steps;
  template <typename Vector>
  void Place(const WarpLanes& lanes, Steps& steps, int k) const;
  template <typename Four>
  void LookUpWarp(Steps& steps, int k) const;
  template <typename Vector>
  void Invert(Steps& steps, int k) const;
  template <typename Four, typename Eight>
  void LookUpColors(Steps& steps, int k) const;
  template <typename Vector>
  void Scale(Steps& steps, float cosine, float* const f[3], int k) const;
  template <typename Vector, typename Four, typename Eight>
  void EvaluateAll(int count, const WarpLanes& lanes, float cosine, float* const f[3]) const;
  void EvaluateWide(int count, const WarpLanes& lanes, float cosine, float* const f[3]) const;

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
