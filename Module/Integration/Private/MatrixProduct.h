// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Products of small matrices: most of the time of a large table's synthesis. Eigen's products
 * would take the vectors that every processor has, and so 3 to 4 times as long.
 */

#ifndef MatrixProduct_h
#define MatrixProduct_h

#include <cstddef>

namespace measuredbrdf
{
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
} // namespace measuredbrdf

#endif
