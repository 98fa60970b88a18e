// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkTabulatedBRDF's volume looked up for many lights and one view, in single precision, one light
 * beside the other. Private to the module.
 */

#ifndef TabulatedLanes_h
#define TabulatedLanes_h

#include "WideVectors.h"

#include <vector>

namespace measuredbrdf
{
/// A volume as vtkTabulatedBRDF holds it, without invalid cells.
struct TabulatedLanes
{
  static constexpr int Most = 64; // a multiple of every vector's width

  const std::vector<float>& Volume; // RGB
  const int* Dimensions;            // three
  bool HalfDifference;              // else incident/outgoing
  bool HalfTurn;                    // of the azimuth
  bool CosineWeighted;

  /// f of 1 to Most lights; lights: x, y and z of unit vectors above the horizon; f: red, green and
  /// blue, of which numbers behind the last light are written, too, up to a multiple of 8. To
  /// single precision; the azimuth of what lies nearly in its axis is less exact. form: one that
  /// the processor has.
  void Evaluate(int count, const float* const lights[3], const double view[3], float* const f[3],
    VectorForm form = GetWidestForm()) const;

  /// The same of any number of lights; nothing is written behind the last one.
  void EvaluateMany(
    int count, const float* const lights[3], const double view[3], float* const f[3]) const;

private:
  struct Steps;
  template <typename Vector>
  void PlaceByHalf(Steps& steps, const float view[3], int whole) const;
  template <typename Vector>
  void PlaceByLight(Steps& steps, const float view[3], int whole) const;
  template <typename Vector>
  void FindPlaces(Steps& steps, int whole) const;
  template <typename Four>
  void LookUp(Steps& steps, int k) const;
  template <typename Vector, typename Four>
  void EvaluateAll(Steps& steps, int count, const float view[3], void (*takeRoots)(float*, int),
    float* const f[3]) const;
  void EvaluateWide(Steps& steps, int count, const float view[3], float* const f[3]) const;
};
} // namespace measuredbrdf

#endif
