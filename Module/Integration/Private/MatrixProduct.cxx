// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MatrixProduct.h"

#include "WideVectors.h"

#include <cstring>

namespace measuredbrdf
{
namespace
{
#ifdef MEASUREDBRDF_HAS_VECTORS
using Vector4 = float __attribute__((vector_size(16)));
using Vector8 = float __attribute__((vector_size(32)));

// What stays in registers: some rows by two vectors, a row after the other.
template <typename Vector, std::size_t Count>
struct Tile
{
  MEASUREDBRDF_INLINE void Add(
    const float* left, std::size_t depth, const Vector& first, const Vector& second)
  {
    this->First += left[0] * first;
    this->Second += left[0] * second;
    this->Others.Add(left + depth, depth, first, second);
  }
  MEASUREDBRDF_INLINE void Store(float* result, std::size_t columns) const
  {
    std::memcpy(result, &this->First, sizeof(Vector)); // anywhere: memory is not aligned
    std::memcpy(result + sizeof(Vector) / sizeof(float), &this->Second, sizeof(Vector));
    this->Others.Store(result + columns, columns);
  }
  Vector First = {};
  Vector Second = {};
  Tile<Vector, Count - 1> Others;
};

template <typename Vector>
struct Tile<Vector, 0>
{
  MEASUREDBRDF_INLINE void Add(const float*, std::size_t, const Vector&, const Vector&) {}
  MEASUREDBRDF_INLINE void Store(float*, std::size_t) const {}
};

template <typename Vector, std::size_t Count>
MEASUREDBRDF_INLINE void MultiplyTiles(const float* left, const float* right, std::size_t rows,
  std::size_t depth, std::size_t columns, float* result)
{
  constexpr std::size_t width = sizeof(Vector) / sizeof(float);
  for (std::size_t column = 0; column < columns; column += 2 * width)
  {
    for (std::size_t row = 0; row < rows; row += Count)
    {
      Tile<Vector, Count> tile;
      for (std::size_t k = 0; k < depth; ++k)
      {
        Vector of[2];
        std::memcpy(of, right + k * columns + column, sizeof(of));
        tile.Add(left + row * depth + k, depth, of[0], of[1]);
      }
      tile.Store(result + row * columns + column, columns);
    }
  }
}

// The same of PanelRows rows by some vectors, a vector after the other.
template <typename Vector, std::size_t Count>
struct PanelTile
{
  static constexpr std::size_t Width = sizeof(Vector) / sizeof(float);

  MEASUREDBRDF_INLINE void Add(const float* left, const float* right)
  {
    Vector of;
    std::memcpy(&of, right, sizeof(of));
    this->A += left[0] * of;
    this->B += left[1] * of;
    this->C += left[2] * of;
    this->D += left[3] * of;
    this->Others.Add(left, right + Width);
  }
  MEASUREDBRDF_INLINE void Store(float* result, std::size_t columns) const
  {
    std::memcpy(result, &this->A, sizeof(Vector));
    std::memcpy(result + columns, &this->B, sizeof(Vector));
    std::memcpy(result + 2 * columns, &this->C, sizeof(Vector));
    std::memcpy(result + 3 * columns, &this->D, sizeof(Vector));
    this->Others.Store(result + Width, columns);
  }
  Vector A = {};
  Vector B = {};
  Vector C = {};
  Vector D = {};
  PanelTile<Vector, Count - 1> Others;
};

template <typename Vector>
struct PanelTile<Vector, 0>
{
  MEASUREDBRDF_INLINE void Add(const float*, const float*) {}
  MEASUREDBRDF_INLINE void Store(float*, std::size_t) const {}
};

// Columns from `first` on, as many as stay in registers.
template <typename Vector, std::size_t Count>
MEASUREDBRDF_INLINE void MultiplyPanelTile(const ProductItems& left, const ProductItems& right,
  std::size_t depth, std::size_t columns, std::size_t first, float* result)
{
  PanelTile<Vector, Count> tile;
  const float* l = left.First;
  const float* r = right.First + first;
  for (std::size_t k = 0; k < depth; ++k, l += left.Step, r += right.Step)
  {
    tile.Add(l, r);
  }
  tile.Store(result + first, columns);
}

template <typename Vector>
MEASUREDBRDF_INLINE void MultiplyPanelTiles(const ProductItems& left, const ProductItems& right,
  std::size_t depth, std::size_t columns, float* result)
{
  constexpr std::size_t width = sizeof(Vector) / sizeof(float);
  std::size_t column = 0;
  for (; column + 3 * width <= columns; column += 3 * width)
  {
    MultiplyPanelTile<Vector, 3>(left, right, depth, columns, column, result);
  }
  if (column + 2 * width <= columns)
  {
    MultiplyPanelTile<Vector, 2>(left, right, depth, columns, column, result);
    column += 2 * width;
  }
  if (column < columns)
  {
    MultiplyPanelTile<Vector, 1>(left, right, depth, columns, column, result);
  }
}

__attribute__((target("avx2,fma"))) void MultiplyPanelWide(const ProductItems& left,
  const ProductItems& right, std::size_t depth, std::size_t columns, float* result)
{
  MultiplyPanelTiles<Vector8>(left, right, depth, columns, result);
}

__attribute__((target("avx2,fma"))) void MultiplyWide(const float* left, const float* right,
  std::size_t rows, std::size_t depth, std::size_t columns, float* result)
{
  MultiplyTiles<Vector8, ProductRows>(left, right, rows, depth, columns, result);
}
#endif

void MultiplyAnywhere(const float* left, const float* right, std::size_t rows, std::size_t depth,
  std::size_t columns, float* result)
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  MultiplyTiles<Vector4, ProductRows>(left, right, rows, depth, columns, result);
#else
  std::memset(result, 0, rows * columns * sizeof(float));
  for (std::size_t row = 0; row < rows; ++row)
  {
    for (std::size_t k = 0; k < depth; ++k)
    {
      const float factor = left[row * depth + k];
      for (std::size_t column = 0; column < columns; ++column)
      {
        result[row * columns + column] += factor * right[k * columns + column];
      }
    }
  }
#endif
}

void MultiplyPanelAnywhere(const ProductItems& left, const ProductItems& right, std::size_t depth,
  std::size_t columns, float* result)
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  MultiplyPanelTiles<Vector4>(left, right, depth, columns, result);
#else
  std::memset(result, 0, PanelRows * columns * sizeof(float));
  for (std::size_t k = 0; k < depth; ++k)
  {
    const float* const of = right.First + k * right.Step;
    for (std::size_t row = 0; row < PanelRows; ++row)
    {
      const float factor = left.First[k * left.Step + row];
      for (std::size_t column = 0; column < columns; ++column)
      {
        result[row * columns + column] += factor * of[column];
      }
    }
  }
#endif
}
}

void Multiply(const float* left, const float* right, std::size_t rows, std::size_t depth,
  std::size_t columns, float* result)
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    return MultiplyWide(left, right, rows, depth, columns, result);
  }
#endif
  MultiplyAnywhere(left, right, rows, depth, columns, result);
}

void MultiplyPanel(const ProductItems& left, const ProductItems& right, std::size_t depth,
  std::size_t columns, float* result)
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    return MultiplyPanelWide(left, right, depth, columns, result);
  }
#endif
  MultiplyPanelAnywhere(left, right, depth, columns, result);
}
} // namespace measuredbrdf
