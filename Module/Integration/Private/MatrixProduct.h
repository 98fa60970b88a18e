// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Products of small matrices in the widest vectors that the processor at hand has: most of the
 * time of a large table's synthesis. Private to the module.
 */

#ifndef MatrixProduct_h
#define MatrixProduct_h

#include <cstddef>

namespace measuredbrdf
{
/// Rows of left, and columns of right, come in multiples of these; those that are too many hold any
/// finite values.
constexpr std::size_t ProductRows = 6;
constexpr std::size_t ProductColumns = 16;

constexpr std::size_t RoundUp(std::size_t count, std::size_t multiple)
{
  return (count + multiple - 1) / multiple * multiple;
}

/// result[r][c] = sum over k < depth of left[r][k] right[k][c]; all are stored row by row. Sums are
/// rounded as the processor likes: on others the last bits differ.
void Multiply(const float* left, const float* right, std::size_t rows, std::size_t depth,
  std::size_t columns, float* result);

/// What a product's sum runs over: items of so many numbers, Step numbers apart.
struct ProductItems
{
  const float* First;
  std::size_t Step;
};

/// As many rows and at most as many columns as one MultiplyPanel has; columns come in multiples of
/// the last.
constexpr std::size_t PanelRows = 4;
constexpr std::size_t PanelColumns = 24;
constexpr std::size_t PanelStep = 8;

/// result[r * columns + c] = sum over k < depth of left_k[r] right_k[c], r < PanelRows, c <
/// columns.
void MultiplyPanel(const ProductItems& left, const ProductItems& right, std::size_t depth,
  std::size_t columns, float* result);
} // namespace measuredbrdf

#endif
