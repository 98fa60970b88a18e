// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * To which tolerance all pixels of a picture are integrated, in blocks, from the evaluations of f
 * that a trial took. Counted, not timed: pictures do not depend on the machine.
 */

#ifndef BlockTolerance_h
#define BlockTolerance_h

#include <cmath>

namespace tool
{
struct BlockTolerance
{
  static constexpr double Coarsest = 0.0028;
  static constexpr double Finest = 0.0014;
  static constexpr double Factor = 0.8;         // where pixels of the sample are off
  static constexpr double Affordable = 10500.0; // evaluations a pixel, by what is predicted
  static constexpr double Most = 16000.0; // with the coarsest tolerance: beyond, no blocks at all
  static constexpr double UsualPixels = 160000.0; // of a sphere in 500 x 500

  /// The finest of some tolerances that is affordable; 0 where not even the coarsest is.
  /// evaluations: of a pixel, with the coarsest. Where a picture has more pixels than usual, as
  /// many in all may be taken.
  static double Choose(double evaluations, double pixels)
  {
    constexpr double power = 0.85; // of the inverse tolerance, about
    const double usual = evaluations * std::fmax(pixels / UsualPixels, 1.0);
    if (usual > Most)
    {
      return 0.0;
    }
    double tolerance = Coarsest;
    for (const double finer : { 0.0024, 0.002, Finest })
    {
      if (usual * std::pow(Coarsest / finer, power) <= Affordable)
      {
        tolerance = finer;
      }
    }
    return tolerance;
  }
};
} // namespace tool

#endif
