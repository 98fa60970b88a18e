// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The inner loops of tables' set-up, on several numbers at a time in the lanes of the processor's
 * vectors: Wigner's functions of four angles, products of small matrices, Fourier transforms of
 * eight lines, and the limiter of dark rings. Eigen's products would take the vectors that every
 * processor has, and so 3 to 4 times as long; its transforms take none, and ten times as long.
 */

#ifndef SynthesisLanes_h
#define SynthesisLanes_h

#include "WignerD.h"

#include <array>
#include <complex>
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

/// Rows and columns come in multiples of these; those that are too many hold any finite values.
constexpr std::size_t ProductRows = 4;
constexpr std::size_t ProductColumns = 8;

constexpr std::size_t RoundUp(std::size_t count, std::size_t multiple)
{
  return (count + multiple - 1) / multiple * multiple;
}

/// What a product's sum runs over: items of so many numbers, Step numbers apart.
struct ProductItems
{
  const float* First;
  std::size_t Step;
};

/// result[r * columns + c] = sum over k < depth of left_k[r] right_k[c], r < rows, c < columns. On
/// other processors the last bits may differ.
void Multiply(const ProductItems& left, const ProductItems& right, std::size_t rows,
  std::size_t depth, std::size_t columns, float* result);

/// Fourier transforms of eight lines, by Stockham's algorithm for any size (Van Loan 1992,
/// "Computational Frameworks for the Fast Fourier Transform", 1.7).
class LineTransform
{
public:
  static constexpr std::size_t Lines = 8;
  static constexpr std::size_t Item = 2 * Lines; // floats: eight real parts, eight imaginary parts

  explicit LineTransform(std::size_t size);

  /// Item j becomes the sum over k of item k times e^(-2 pi i j k / size). other: room for as many.
  void Run(std::vector<float>& items, std::vector<float>& other) const;

private:
  std::vector<std::size_t> Factors;       // of the size
  std::vector<std::complex<float>> Turns; // e^(-2 pi i k / size)
};

/// LiftDarkRings (RadianceTable.h) of one map, on this thread. Four nodes away from the first and
/// the last rows and columns it does not count what lies beyond these.
void LiftDarkRingsOfMap(float* radiance, std::size_t rows, std::size_t columns);
} // namespace measuredbrdf

#endif
