// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Wigner's functions of four angles at once, one in each lane of the processor's vectors: what
 * harmonics of kernels and of maps spend their time on.
 */

#ifndef WignerLanes_h
#define WignerLanes_h

#include "WignerD.h"

#include <array>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
class WignerLanes
{
public:
  static constexpr std::size_t Count = 4;
  using Values = std::array<double, Count>;

  WignerLanes() = default;
  explicit WignerLanes(const Values& theta);

  /// In single precision d[4 (l - first) + angle] for the degrees of the functions. Returns how
  /// many of the lowest degrees are left out: their numbers are all less than `least`.
  std::size_t EvaluateFrom(const WignerD& functions, double least, float* d) const;

  /// Adds sum over n of factors[n][c] d^l(angles[n]) to out[c][l], for each channel c and each l
  /// from the functions' first on.
  static void AddSeries(const WignerD& functions, const std::vector<WignerLanes>& angles,
    const std::vector<std::array<Values, 3>>& factors, const std::array<Values*, 3>& out);

  /// Adds factor d^l in[c][l] to out[c][l].
  void AddTurned(const WignerD& functions, const Values& factor,
    const std::array<const Values*, 3>& in, const std::array<Values*, 3>& out) const;

private:
  Values GetStart(const WignerD& functions) const;

  Values Cosine{}, LogHalfCosine{}, LogHalfSine{};
};
} // namespace measuredbrdf

#endif
