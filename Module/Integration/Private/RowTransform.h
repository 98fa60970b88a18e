// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Fourier transforms of eight lines at once, one in each lane of the processor's vectors.
 */

#ifndef RowTransform_h
#define RowTransform_h

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// Powers of two, times a small odd number, by decimation in time (Cooley, Tukey 1965); other
/// sizes line by line with Eigen's.
class RowTransform
{
public:
  static constexpr std::size_t Lines = 8;
  static constexpr std::size_t Item = 2 * Lines; // floats: eight real parts, eight imaginary parts

  explicit RowTransform(std::size_t size);

  std::size_t GetSize() const { return this->Places.size(); }

  /// Where number k of the lines has to be before Run.
  std::size_t GetPlace(std::size_t k) const { return this->Places[k]; }

  /// Of items at their places: number j is then sum over k of x_k e^(-2 pi i j k / size).
  void Run(float* lines) const;

private:
  void RunLineByLine(float* lines) const;

  std::vector<std::size_t> Places;
  std::size_t Odd = 1;                    // factor of the size
  std::vector<std::complex<float>> Turns; // e^(-2 pi i k / size); none: line by line
};
} // namespace measuredbrdf

#endif
