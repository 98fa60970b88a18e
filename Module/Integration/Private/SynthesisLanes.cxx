// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SynthesisLanes.h"

#include "HalfVector.h" // for Pi
#include "Lanes.h"

#include <Eigen/Core>

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

LineTransform::LineTransform(std::size_t size)
{
  for (std::size_t k = 0; k < size; ++k)
  {
    this->Turns.emplace_back(std::polar(1.0, -2.0 * Pi * static_cast<double>(k) / size));
  }
  for (std::size_t factor = 2; size > 1; factor += factor == 2 ? 1 : 2)
  {
    for (; size % factor == 0; size /= factor)
    {
      this->Factors.push_back(factor);
    }
  }
}

namespace
{
// The two outputs of a stage that halves: the sum, and the difference turned.
MEASUREDBRDF_INLINE void SumPair(
  const float* in, std::size_t apart, const std::complex<float>& turn, float* out, std::size_t next)
{
  constexpr std::size_t lines = LineTransform::Lines;
  const Float8 a = Load<Float8>(in), b = Load<Float8>(in + lines);
  const Float8 c = Load<Float8>(in + apart), d = Load<Float8>(in + apart + lines);
  Store(a + c, out);
  Store(b + d, out + lines);
  Store(turn.real() * (a - c) - turn.imag() * (b - d), out + next);
  Store(turn.real() * (b - d) + turn.imag() * (a - c), out + next + lines);
}

// One output of any stage: the sum over `factor` inputs that lie `apart`, the k-th turned by k
// steps more than the first.
MEASUREDBRDF_INLINE void SumTurned(const float* in, std::size_t apart, std::size_t factor,
  const std::vector<std::complex<float>>& turns, std::size_t turn, std::size_t step, float* out)
{
  Float8 real{}, imaginary{};
  for (std::size_t k = 0; k < factor; ++k, in += apart)
  {
    const Float8 a = Load<Float8>(in), b = Load<Float8>(in + LineTransform::Lines);
    real += turns[turn].real() * a - turns[turn].imag() * b;
    imaginary += turns[turn].real() * b + turns[turn].imag() * a;
    turn += step;
    turn -= turn < turns.size() ? 0 : turns.size();
  }
  Store(real, out);
  Store(imaginary, out + LineTransform::Lines);
}
}

void LineTransform::Run(std::vector<float>& items, std::vector<float>& other) const
{
  std::size_t stride = 1;
  for (const std::size_t factor : this->Factors)
  {
    const std::size_t size = this->Turns.size(), step = size / factor, rest = step / stride;
    RunWidest(
      [&]() MEASUREDBRDF_INLINED
      {
        for (std::size_t k = 0; k < rest; ++k)
        {
          const float* const in = &items[k * stride * Item];
          float* const out = &other[k * factor * stride * Item];
          for (std::size_t q = 0; factor == 2 && q < stride; ++q)
          {
            SumPair(
              in + q * Item, step * Item, this->Turns[k * stride], out + q * Item, stride * Item);
          }
          for (std::size_t j = 0; factor > 2 && j < factor * stride; ++j)
          {
            const std::size_t of = j / stride;
            SumTurned(in + j % stride * Item, step * Item, factor, this->Turns,
              of * k * stride % size, of * step, out + j * Item);
          }
        }
      });
    items.swap(other);
    stride *= factor;
  }
}

namespace
{
constexpr float LeastOfBlur = 0.75f; // of the blur's least

using RingMap = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Replaces each value by combine(a, b, c), where it is b, with its neighbors left and right, then
// above and below. Rows go around, and beyond a pole the meridian opposite goes on. Both maps have
// a row more at either pole, and left and right of `width` columns three more, and room for
// vectors.
template <typename Combine>
MEASUREDBRDF_INLINE void CombineNeighbors(
  RingMap& map, RingMap& other, Eigen::Index width, const Combine& combine)
{
  const Eigen::Index last = map.rows() - 1, half = width / 6 * 3;
  const auto combineAll = [&](const RingMap& in, Eigen::Index apart, RingMap& out)
                            MEASUREDBRDF_INLINED
  {
    for (Eigen::Index row = 1; row < last; ++row)
    {
      const float* const of = &in(row, 3);
      float* const to = &out(row, 3);
      for (Eigen::Index k = 0; k < width; k += LaneCount)
      {
        Store(
          combine(Load<Floats>(of + k - apart), Load<Floats>(of + k), Load<Floats>(of + k + apart)),
          to + k);
      }
    }
  };
  map.leftCols(3) = map.middleCols(width, 3);
  map.middleCols(width + 3, 3) = map.middleCols(3, 3);
  combineAll(map, 3, other);
  for (const Eigen::Index pole : { Eigen::Index(0), last })
  {
    const auto beyond = other.row(pole == 0 ? 2 : last - 2).segment(3, width);
    other.row(pole).segment(3, width) << beyond.tail(width - half), beyond.head(half);
  }
  combineAll(other, map.cols(), map);
}
}

void LiftDarkRingsOfMap(float* radiance, std::size_t rows, std::size_t columns)
{
  const Eigen::Index height = rows, width = 3 * columns;
  Eigen::Map<RingMap> values(radiance, height, width);
  RingMap map = RingMap::Zero(height + 2, width + 6 + LaneCount), other = map;
  auto around = map.block(1, 3, height, width);
  around = values.max(0.0f);
  RunWidest(
    [&]() MEASUREDBRDF_INLINED
    {
      for (int pass = 0; pass < 2; ++pass)
      {
        CombineNeighbors(map, other, width,
          [](Floats a, Floats b, Floats c) MEASUREDBRDF_INLINED
          { return 0.25f * (a + c) + 0.5f * b; });
      }
      for (int pass = 0; pass < 2; ++pass) // as far as the blur reaches: edges do not bleed
      {
        CombineNeighbors(map, other, width,
          [](Floats a, Floats b, Floats c) MEASUREDBRDF_INLINED
          { return Smaller(Smaller(a, b), c); });
      }
    });
  // Where that is 0 all around is negative: f is less than the Lambert part.
  values = (around > 0.0f).select(values.max(LeastOfBlur * around), values);
}
} // namespace measuredbrdf
