// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * f of many lights where nothing is faster than one light after the other.
 */

#ifndef OneByOne_h
#define OneByOne_h

#include "Floats.h"
#include "vtkBRDF.h"

namespace measuredbrdf
{
/// lights: x, y and z; f: red, green and blue.
inline void EvaluateLightsOneByOne(
  vtkBRDF* brdf, int count, const float* const lights[3], const double view[3], float* const f[3])
{
  for (int k = 0; k < count; ++k)
  {
    const double light[3] = { lights[0][k], lights[1][k], lights[2][k] };
    double rgb[3];
    brdf->Evaluate(light, view, rgb);
    for (int c = 0; c < 3; ++c)
    {
      f[c][k] = ToFloat(rgb[c]);
    }
  }
}
} // namespace measuredbrdf

#endif
