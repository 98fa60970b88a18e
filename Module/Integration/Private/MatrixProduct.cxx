// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MatrixProduct.h"

#include "Lanes.h"

#include <algorithm>

namespace measuredbrdf
{
namespace
{
// ProductRows rows of the result by some vectors of columns: as many sums as registers hold.
template <int Vectors>
MEASUREDBRDF_INLINE void MultiplyTile(
  ProductItems left, ProductItems right, std::size_t depth, std::size_t columns, float* result)
{
  Float8 sums[ProductRows][Vectors] = {};
  for (std::size_t k = 0; k < depth; ++k)
  {
    Float8 of[Vectors];
#pragma GCC unroll 3
    for (int v = 0; v < Vectors; ++v)
    {
      of[v] = Load<Float8>(right.First + ProductColumns * v);
    }
#pragma GCC unroll 4
    for (std::size_t row = 0; row < ProductRows; ++row)
    {
#pragma GCC unroll 3
      for (int v = 0; v < Vectors; ++v)
      {
        sums[row][v] += left.First[row] * of[v];
      }
    }
    left.First += left.Step;
    right.First += right.Step;
  }
#pragma GCC unroll 4
  for (std::size_t row = 0; row < ProductRows; ++row)
  {
#pragma GCC unroll 3
    for (int v = 0; v < Vectors; ++v)
    {
      Store(sums[row][v], result + row * columns + ProductColumns * v);
    }
  }
}
}

void Multiply(const ProductItems& left, const ProductItems& right, std::size_t rows,
  std::size_t depth, std::size_t columns, float* result)
{
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      for (std::size_t column = 0; column < columns;)
      {
        const std::size_t vectors = std::min<std::size_t>((columns - column) / ProductColumns, 3);
        const ProductItems of{ right.First + column, right.Step };
        for (std::size_t row = 0; row < rows; row += ProductRows)
        {
          const ProductItems by{ left.First + row, left.Step };
          float* const to = result + row * columns + column;
          switch (vectors)
          {
            case 3:
              MultiplyTile<3>(by, of, depth, columns, to);
              break;
            case 2:
              MultiplyTile<2>(by, of, depth, columns, to);
              break;
            default:
              MultiplyTile<1>(by, of, depth, columns, to);
          }
        }
        column += ProductColumns * vectors;
      }
    });
}
} // namespace measuredbrdf
