// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Summed-area table (Crow 1984): the sum over any rectangle of a grid from four look-ups. T is a
 * number or a vector of them, summed side by side.
 */

#ifndef SummedAreaTable_h
#define SummedAreaTable_h

#include "ParallelFor.h"

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
template <typename T>
class BasicSummedAreaTable
{
public:
  BasicSummedAreaTable() = default;

  /**
   * row(y, values) writes the `width` values of row y; called from many threads, once per row.
   */
  template <typename RowFunction>
  BasicSummedAreaTable(int width, int height, RowFunction&& row)
    : Stride(static_cast<std::size_t>(width) + 1)
    , Sums(Stride * (static_cast<std::size_t>(height) + 1), T(0.0))
  {
    // Along the rows, then down the columns (in blocks that stay in the cache).
    measuredbrdf::ParallelFor(0, height,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType y = begin; y < end; ++y)
        {
          T* sums = &this->Sums[this->Stride * static_cast<std::size_t>(y + 1) + 1];
          row(static_cast<int>(y), sums);
          for (int x = 1; x < width; ++x)
          {
            sums[x] += sums[x - 1];
          }
        }
      });
    measuredbrdf::ParallelFor(1, static_cast<vtkIdType>(this->Stride), 128,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (int y = 1; y < height; ++y)
        {
          const T* above = &this->Sums[this->Stride * static_cast<std::size_t>(y)];
          T* sums = &this->Sums[this->Stride * static_cast<std::size_t>(y + 1)];
          for (vtkIdType x = begin; x < end; ++x)
          {
            sums[x] += above[x];
          }
        }
      });
  }

  /// Sum over [x0,x1) x [y0,y1).
  T GetSum(int x0, int y0, int x1, int y1) const
  {
    return (this->At(x1, y1) - this->At(x0, y1)) - (this->At(x1, y0) - this->At(x0, y0));
  }

private:
  T At(int x, int y) const
  {
    return this->Sums[this->Stride * static_cast<std::size_t>(y) + static_cast<std::size_t>(x)];
  }

  std::size_t Stride = 0;
  std::vector<T> Sums;
};

using SummedAreaTable = BasicSummedAreaTable<double>;
} // namespace measuredbrdf

#endif
