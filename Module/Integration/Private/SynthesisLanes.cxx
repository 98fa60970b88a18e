// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SynthesisLanes.h"

#include "Lanes.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
using Values = WignerLanes::Values;
using Steps = std::vector<WignerD::Step>;

// Stored as 0: products of such numbers are denormal, and processors are slow with these.
constexpr double Tiny = 1e-15;

constexpr double LeastOfSeries = 1e-10; // less adds nothing

// The recursion of WignerD, of one degree after the other.
struct Recursion
{
  Double4 X, Current, Previous;

  MEASUREDBRDF_INLINE Recursion(const Values& cosine, const Values& start)
    : X(Load<Double4>(cosine.data()))
    , Current(Load<Double4>(start.data()))
    , Previous{}
  {
  }
  MEASUREDBRDF_INLINE void GoOn(const WignerD::Step& step)
  {
    const Double4 next = step.A * (this->X - step.B) * this->Current - step.C * this->Previous;
    this->Previous = this->Current;
    this->Current = next;
  }
  MEASUREDBRDF_INLINE bool IsLess(double least) const
  {
    bool isLess = true;
    for (std::size_t lane = 0; lane < WignerLanes::Count; ++lane)
    {
      isLess = isLess && this->Current[lane]<least&& this->Current[lane]> - least;
    }
    return isLess;
  }
};

// Calls use(k, d) with the functions of each degree, from the first on that is not less than least
// in all lanes. Returns that degree, counted from the functions' first one.
template <typename Use>
MEASUREDBRDF_INLINE std::size_t ForEachDegree(
  const Steps& steps, Recursion d, double least, const Use& use)
{
  std::size_t k = 0;
  for (; k < steps.size() && d.IsLess(least); ++k)
  {
    d.GoOn(steps[k]);
  }
  const std::size_t first = d.IsLess(least) ? k + 1 : k;
  for (; k < steps.size(); ++k)
  {
    use(k, d.Current);
    d.GoOn(steps[k]);
  }
  use(k, d.Current);
  return first;
}

MEASUREDBRDF_INLINE void AddTo(Values& sum, Double4 term)
{
  Store(Load<Double4>(sum.data()) + term, sum.data());
}
}

WignerLanes::WignerLanes(const Values& theta)
{
  for (std::size_t lane = 0; lane < Count; ++lane)
  {
    this->Cosine[lane] = std::cos(theta[lane]);
    this->LogHalfCosine[lane] = WignerD::GetLog(std::cos(0.5 * theta[lane]));
    this->LogHalfSine[lane] = WignerD::GetLog(std::sin(0.5 * theta[lane]));
  }
}

WignerLanes::Values WignerLanes::GetStart(const WignerD& functions) const
{
  Values start;
  for (std::size_t lane = 0; lane < Count; ++lane)
  {
    start[lane] = functions.GetStart(this->LogHalfCosine[lane], this->LogHalfSine[lane]);
  }
  return start;
}

std::size_t WignerLanes::EvaluateFrom(const WignerD& functions, double least, float* d) const
{
  if (functions.IsEmpty())
  {
    return 0;
  }
  const Values start = this->GetStart(functions);
  std::size_t first = 0;
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      first = ForEachDegree(functions.GetSteps(), Recursion(this->Cosine, start), least,
        [d](std::size_t k, Double4 values) MEASUREDBRDF_INLINED
        {
          const auto isNone = (values < Tiny) & (values > -Tiny);
          const Double4 kept = isNone ? Double4{} : values;
          Store(__builtin_convertvector(kept, Float4), d + Count * k);
        });
    });
  return first;
}

void WignerLanes::AddSeries(const WignerD& functions, const std::vector<WignerLanes>& angles,
  const std::vector<std::array<Values, 3>>& factors, const std::array<Values*, 3>& out)
{
  if (functions.IsEmpty())
  {
    return;
  }
  const int first = functions.GetFirst();
  Values* const to[3] = { out[0] + first, out[1] + first, out[2] + first };
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      for (std::size_t n = 0; n < angles.size(); ++n)
      {
        const Double4 red = Load<Double4>(factors[n][0].data());
        const Double4 green = Load<Double4>(factors[n][1].data());
        const Double4 blue = Load<Double4>(factors[n][2].data());
        ForEachDegree(functions.GetSteps(),
          Recursion(angles[n].Cosine, angles[n].GetStart(functions)), LeastOfSeries,
          [&](std::size_t k, Double4 d) MEASUREDBRDF_INLINED
          {
            AddTo(to[0][k], red * d);
            AddTo(to[1][k], green * d);
            AddTo(to[2][k], blue * d);
          });
      }
    });
}

void WignerLanes::AddTurned(const WignerD& functions, const Values& factor,
  const std::array<const Values*, 3>& in, const std::array<Values*, 3>& out) const
{
  if (functions.IsEmpty())
  {
    return;
  }
  const int first = functions.GetFirst();
  const Values start = this->GetStart(functions);
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      const Double4 by = Load<Double4>(factor.data());
      ForEachDegree(functions.GetSteps(), Recursion(this->Cosine, start), LeastOfSeries,
        [&](std::size_t k, Double4 d) MEASUREDBRDF_INLINED
        {
          const std::size_t l = static_cast<std::size_t>(first) + k;
          for (std::size_t c = 0; c < 3; ++c)
          {
            AddTo(out[c][l], by * d * Load<Double4>(in[c][l].data()));
          }
        });
    });
}

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
