// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Calculations on several numbers at once, one in each lane of the processor's vector registers.
 * The vectors are the compilers' own (GCC and Clang): formulas are written as for one number, and
 * the same text serves every kind of processor. Comparisons give masks for `mask ? a : b`.
 *
 * Nothing here is called out of line: how a vector is passed to a function depends on the
 * processor. So functions of vectors are MEASUREDBRDF_INLINE, and lambdas MEASUREDBRDF_INLINED.
 */

#ifndef Lanes_h
#define Lanes_h

#include <cstring>

#define MEASUREDBRDF_INLINE inline __attribute__((always_inline))
#define MEASUREDBRDF_INLINED __attribute__((always_inline)) // behind a lambda's parameters

namespace measuredbrdf
{
using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Double4 = double __attribute__((vector_size(32)));
#ifdef __x86_64__
using Floats = Float8;
using Integers = int __attribute__((vector_size(32)));
#else // ARM's registers hold 16 bytes
using Floats = Float4;
using Integers = int __attribute__((vector_size(16)));
#endif
constexpr int LaneCount = static_cast<int>(sizeof(Floats) / sizeof(float));

/// Memory need not be aligned.
template <typename Vector, typename Number>
MEASUREDBRDF_INLINE Vector Load(const Number* values)
{
  Vector vector;
  std::memcpy(&vector, values, sizeof(Vector));
  return vector;
}

template <typename Vector, typename Number>
MEASUREDBRDF_INLINE void Store(Vector vector, Number* values)
{
  std::memcpy(values, &vector, sizeof(Vector));
}

MEASUREDBRDF_INLINE Floats Fill(float value) { return Floats{} + value; }
MEASUREDBRDF_INLINE Floats ToFloats(Integers x) { return __builtin_convertvector(x, Floats); }
/// Rounds towards zero.
MEASUREDBRDF_INLINE Integers ToIntegers(Floats x) { return __builtin_convertvector(x, Integers); }

///@{
/// b where a is not a number.
MEASUREDBRDF_INLINE Floats Larger(Floats a, Floats b) { return a > b ? a : b; }
MEASUREDBRDF_INLINE Floats Smaller(Floats a, Floats b) { return a < b ? a : b; }
///@}

MEASUREDBRDF_INLINE Floats SquareRoot(Floats x)
{
  Floats root;
  for (int k = 0; k < LaneCount; ++k) // one instruction, as no error numbers are asked for
  {
    root[k] = __builtin_sqrtf(x[k]);
  }
  return root;
}

/// The numbers that have these places in both vectors, one after the other.
template <typename Result, int... places, typename Vector>
MEASUREDBRDF_INLINE Result Shuffle(Vector a, Vector b)
{
#if __has_builtin(__builtin_shufflevector)
  return __builtin_shufflevector(a, b, places...);
#else // GCC 10 and 11
  constexpr int count = static_cast<int>(sizeof(Vector) / sizeof(a[0]));
  return Result{ (places < count ? a[places % count] : b[places % count])... };
#endif
}

/// Rows become columns: of four numbers for each lane, one after the other, the vectors of the
/// first, the second, the third and the fourth.
MEASUREDBRDF_INLINE void Transpose(const Float4 (&rows)[LaneCount], Floats (&columns)[4])
{
  Float4 parts[LaneCount / 4][4];
  for (int k = 0; k < LaneCount / 4; ++k)
  {
    const Float4* const r = rows + 4 * k;
    const Float4 low[2] = { Shuffle<Float4, 0, 4, 1, 5>(r[0], r[1]),
      Shuffle<Float4, 0, 4, 1, 5>(r[2], r[3]) };
    const Float4 high[2] = { Shuffle<Float4, 2, 6, 3, 7>(r[0], r[1]),
      Shuffle<Float4, 2, 6, 3, 7>(r[2], r[3]) };
    parts[k][0] = Shuffle<Float4, 0, 1, 4, 5>(low[0], low[1]);
    parts[k][1] = Shuffle<Float4, 2, 3, 6, 7>(low[0], low[1]);
    parts[k][2] = Shuffle<Float4, 0, 1, 4, 5>(high[0], high[1]);
    parts[k][3] = Shuffle<Float4, 2, 3, 6, 7>(high[0], high[1]);
  }
  for (int c = 0; c < 4; ++c)
  {
#ifdef __x86_64__
    columns[c] = Shuffle<Floats, 0, 1, 2, 3, 4, 5, 6, 7>(parts[0][c], parts[1][c]);
#else
    columns[c] = parts[0][c];
#endif
  }
}

/// Whether RunWidest takes the processor's widest vectors. Tests turn that off, to run both forms.
inline bool& UsesWidestVectors()
{
#ifdef __x86_64__
  static bool uses = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  static bool uses = false;
#endif
  return uses;
}

#ifdef __x86_64__
template <typename Loop>
__attribute__((target("avx2,fma"))) void RunWithAvx2(const Loop& loop)
{
  loop();
}
#endif

/// Runs a loop over vectors. On x86 it is compiled twice: for every such processor, and for those
/// that have AVX2 and FMA. The results of the two differ by rounding.
template <typename Loop>
MEASUREDBRDF_INLINE void RunWidest(const Loop& loop)
{
#ifdef __x86_64__
  if (UsesWidestVectors())
  {
    return RunWithAvx2(loop);
  }
#endif
  loop();
}
} // namespace measuredbrdf

#endif
