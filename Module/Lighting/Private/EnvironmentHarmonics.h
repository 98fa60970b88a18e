// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An environment's spherical harmonics, for each channel a_lm = integral of L Y*_lm dw, L
 * interpolated between texels. The poles of the
 * harmonics are the environment's: their frame (X, Y, Z) is the environment's (z, x, y).
 */

#ifndef EnvironmentHarmonics_h
#define EnvironmentHarmonics_h

#include "TexelChanges.h"

#include <complex>
#include <cstddef>
#include <vector>

class vtkEnvironment;

namespace measuredbrdf
{
class EnvironmentHarmonics
{
public:
  /// Harmonics of an environment that is not empty, up to the given degree, with these changes of
  /// its texels.
  EnvironmentHarmonics(
    vtkEnvironment* environment, int maximumDegree, const TexelChanges& changes = {});

  int GetMaximumDegree() const { return this->MaximumDegree; }

  /// a_lm of channel 0, 1 or 2, for 0 <= m <= l; a_l,-m = (-1)^m conj(a_lm).
  std::complex<double> Get(int channel, int l, int m) const
  {
    const std::size_t orders = static_cast<std::size_t>(this->MaximumDegree) + 1;
    return this->Coefficients[(channel * orders + m) * orders + l];
  }

private:
  int MaximumDegree;
  std::vector<std::complex<double>> Coefficients; // channel, m, l
};
} // namespace measuredbrdf

#endif
