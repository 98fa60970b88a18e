// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WignerLanes.h"

#include "WideVectors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace measuredbrdf
{
namespace
{
using Values = WignerLanes::Values;
using Steps = std::vector<WignerD::Step>;

// Some lanes' values. Vector: of doubles, or one.
template <typename Vector>
MEASUREDBRDF_INLINE void Load(const Values& values, std::size_t lane, Vector& vector)
{
  std::memcpy(&vector, values.data() + lane, sizeof(Vector));
}

template <typename Vector>
MEASUREDBRDF_INLINE void Store(const Vector& vector, Values& values, std::size_t lane)
{
  std::memcpy(values.data() + lane, &vector, sizeof(Vector));
}

// What is done with each degree's value, which is number k.
struct Keep
{
  Values* Out;

  template <typename Vector>
  MEASUREDBRDF_INLINE void Take(const Vector& d, std::size_t k, std::size_t lane) const
  {
    Store(d, this->Out[k], lane);
  }
};

struct Turn
{
  const Values& Factor;
  const Values* In[3];
  Values* Out[3];

  template <typename Vector>
  MEASUREDBRDF_INLINE void Take(const Vector& d, std::size_t k, std::size_t lane) const
  {
    Vector turned;
    Load(this->Factor, lane, turned);
    turned *= d;
    for (std::size_t c = 0; c < 3; ++c)
    {
      Vector in, sum;
      Load(this->In[c][k], lane, in);
      Load(this->Out[c][k], lane, sum);
      sum += turned * in;
      Store(sum, this->Out[c][k], lane);
    }
  }
};

// The recursion of WignerD.
template <typename Vector, typename Taker>
MEASUREDBRDF_INLINE void Recur(
  const Steps& steps, const Values& start, const Values& cosine, const Taker& taker)
{
  for (std::size_t lane = 0; lane < WignerLanes::Count; lane += sizeof(Vector) / sizeof(double))
  {
    Vector x, current;
    Load(cosine, lane, x);
    Load(start, lane, current);
    Vector previous = 0.0 * current;
    taker.Take(current, 0, lane);
    for (std::size_t k = 0; k < steps.size(); ++k)
    {
      const WignerD::Step& step = steps[k];
      const Vector next = step.A * (x - step.B) * current - step.C * previous;
      previous = current;
      current = next;
      taker.Take(current, k + 1, lane);
    }
  }
}

// Several angles' in each lane, whose sums share what is read and written.
struct Series
{
  static constexpr std::size_t Count = 4;
  Values* Out[3];
  Values Cosines[Count];
  Values Starts[Count];
  std::array<Values, 3> Factors[Count];
};

constexpr double LeastOfSeries = 1e-10; // less adds nothing

template <typename Vector>
MEASUREDBRDF_INLINE bool IsLess(const Vector& value, double least)
{
  for (std::size_t lane = 0; lane < sizeof(Vector) / sizeof(double); ++lane)
  {
    if (!(value[lane] < least && value[lane] > -least))
    {
      return false;
    }
  }
  return true;
}

MEASUREDBRDF_INLINE bool IsLess(double value, double least)
{
  return value < least && value > -least;
}

// Some angles of a series, one after the other: what stays in registers.
template <typename Vector, std::size_t Count>
struct SeriesLanes
{
  MEASUREDBRDF_INLINE void Begin(const Series& series, std::size_t lane)
  {
    constexpr std::size_t n = Series::Count - Count;
    Load(series.Cosines[n], lane, this->X);
    Load(series.Starts[n], lane, this->Current);
    this->Previous = 0.0 * this->Current;
    Load(series.Factors[n][0], lane, this->Red);
    Load(series.Factors[n][1], lane, this->Green);
    Load(series.Factors[n][2], lane, this->Blue);
    this->Others.Begin(series, lane);
  }
  MEASUREDBRDF_INLINE bool AreLess(double least) const
  {
    return IsLess(this->Current, least) && this->Others.AreLess(least);
  }
  MEASUREDBRDF_INLINE void GoOn(const WignerD::Step& step)
  {
    const Vector next =
      step.A * (this->X - step.B) * this->Current - step.C * this->Previous;
    this->Previous = this->Current;
    this->Current = next;
    this->Others.GoOn(step);
  }
  MEASUREDBRDF_INLINE void Add(Vector& red, Vector& green, Vector& blue) const
  {
    red += this->Red * this->Current;
    green += this->Green * this->Current;
    blue += this->Blue * this->Current;
    this->Others.Add(red, green, blue);
  }
  Vector X, Current, Previous, Red, Green, Blue;
  SeriesLanes<Vector, Count - 1> Others;
};

template <typename Vector>
struct SeriesLanes<Vector, 0>
{
  MEASUREDBRDF_INLINE void Begin(const Series&, std::size_t) {}
  MEASUREDBRDF_INLINE bool AreLess(double) const { return true; }
  MEASUREDBRDF_INLINE void GoOn(const WignerD::Step&) {}
  MEASUREDBRDF_INLINE void Add(Vector&, Vector&, Vector&) const {}
};

template <typename Vector>
MEASUREDBRDF_INLINE void AddSeriesTo(const Steps& steps, const Series& series)
{
  const std::size_t last = steps.size();
  for (std::size_t lane = 0; lane < WignerLanes::Count; lane += sizeof(Vector) / sizeof(double))
  {
    SeriesLanes<Vector, Series::Count> lanes;
    lanes.Begin(series, lane);
    std::size_t k = 0;
    for (; k < last && lanes.AreLess(LeastOfSeries); ++k)
    {
      lanes.GoOn(steps[k]);
    }
    for (;; ++k)
    {
      Vector sums[3];
      Load(series.Out[0][k], lane, sums[0]);
      Load(series.Out[1][k], lane, sums[1]);
      Load(series.Out[2][k], lane, sums[2]);
      lanes.Add(sums[0], sums[1], sums[2]);
      Store(sums[0], series.Out[0][k], lane);
      Store(sums[1], series.Out[1][k], lane);
      Store(sums[2], series.Out[2][k], lane);
      if (k == last)
      {
        break;
      }
      lanes.GoOn(steps[k]);
    }
  }
}

#ifdef MEASUREDBRDF_HAS_VECTORS
using Vector2 = double __attribute__((vector_size(16)));
using Vector4 = double __attribute__((vector_size(32)));
using FloatVector4 = float __attribute__((vector_size(16)));

// The recursion in all lanes, whatever vectors the processor has; numbers of floats that it is
// slow with are 0.
MEASUREDBRDF_INLINE std::size_t RecurFrom(
  const Steps& steps, const Values& start, const Values& cosine, double least, float* d)
{
  constexpr double tiny = 1e-15;
  Vector4 x, current;
  Load(cosine, 0, x);
  Load(start, 0, current);
  Vector4 previous = {};
  std::size_t k = 0;
  const auto isLess = [&]()
  {
    const auto less = (current < least) & (current > -least);
    return (less[0] & less[1] & less[2] & less[3]) != 0;
  };
  const auto goOn = [&]()
  {
    const WignerD::Step& step = steps[k];
    const Vector4 next = step.A * (x - step.B) * current - step.C * previous;
    previous = current;
    current = next;
  };
  for (; isLess(); ++k)
  {
    if (k == steps.size())
    {
      return k + 1;
    }
    goOn();
  }
  const std::size_t first = k;
  for (;; ++k)
  {
    const auto none = (current < tiny) & (current > -tiny);
    const auto floats = __builtin_convertvector(none ? Vector4{} : current, FloatVector4);
    std::memcpy(d + WignerLanes::Count * k, &floats, sizeof(floats));
    if (k == steps.size())
    {
      return first;
    }
    goOn();
  }
}

__attribute__((target("avx2,fma"))) std::size_t RecurFromWide(
  const Steps& steps, const Values& start, const Values& cosine, double least, float* d)
{
  return RecurFrom(steps, start, cosine, least, d);
}

template <typename Taker>
__attribute__((target("avx2,fma"))) void RecurWide(
  const Steps& steps, const Values& start, const Values& cosine, const Taker& taker)
{
  Recur<Vector4>(steps, start, cosine, taker);
}
#endif

#ifdef MEASUREDBRDF_HAS_VECTORS
__attribute__((target("avx2,fma"))) void AddSeriesWide(const Steps& steps, const Series& series)
{
  AddSeriesTo<Vector4>(steps, series);
}
#endif

void AddSeriesAsWideAsPossible(const Steps& steps, const Series& series)
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    return AddSeriesWide(steps, series);
  }
  AddSeriesTo<Vector2>(steps, series);
#else
  AddSeriesTo<double>(steps, series);
#endif
}

template <typename Taker>
void RecurAsWideAsPossible(
  const Steps& steps, const Values& start, const Values& cosine, const Taker& taker)
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    return RecurWide(steps, start, cosine, taker);
  }
  Recur<Vector2>(steps, start, cosine, taker);
#else
  Recur<double>(steps, start, cosine, taker);
#endif
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

void WignerLanes::Evaluate(const WignerD& functions, Values* d) const
{
  if (!functions.IsEmpty())
  {
    RecurAsWideAsPossible(functions.GetSteps(), this->GetStart(functions), this->Cosine, Keep{ d });
  }
}

std::size_t WignerLanes::EvaluateFrom(
  const WignerD& functions, double least, float* d) const
{
  if (functions.IsEmpty())
  {
    return 0;
  }
  const Values start = this->GetStart(functions);
#ifdef MEASUREDBRDF_HAS_VECTORS
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")
    ? RecurFromWide(functions.GetSteps(), start, this->Cosine, least, d)
    : RecurFrom(functions.GetSteps(), start, this->Cosine, least, d);
#else
  std::vector<Values> all(functions.GetSteps().size() + 1);
  Recur<double>(functions.GetSteps(), start, this->Cosine, Keep{ all.data() });
  const auto isLess = [least](double value) { return std::abs(value) < least; };
  std::size_t first = 0;
  while (first < all.size() && std::all_of(all[first].begin(), all[first].end(), isLess))
  {
    ++first;
  }
  for (std::size_t k = first; k < all.size(); ++k)
  {
    std::copy(all[k].begin(), all[k].end(), d + Count * k);
  }
  return first;
#endif
}

void WignerLanes::AddSeries(const WignerD& functions, const std::vector<WignerLanes>& angles,
  const std::vector<std::array<Values, 3>>& factors, const std::array<Values*, 3>& out)
{
  if (functions.IsEmpty())
  {
    return;
  }
  const int first = functions.GetFirst();
  Series series{ { out[0] + first, out[1] + first, out[2] + first }, {}, {}, {} };
  for (std::size_t n = 0; n < angles.size(); n += Series::Count)
  {
    for (std::size_t k = 0; k < Series::Count; ++k)
    {
      const WignerLanes& at = angles[std::min(n + k, angles.size() - 1)];
      series.Cosines[k] = at.Cosine;
      series.Starts[k] = at.GetStart(functions);
      series.Factors[k] = n + k < angles.size() ? factors[n + k] : std::array<Values, 3>{};
    }
    AddSeriesAsWideAsPossible(functions.GetSteps(), series);
  }
}

void WignerLanes::AddTurned(const WignerD& functions, const Values& factor,
  const std::array<const Values*, 3>& in, const std::array<Values*, 3>& out) const
{
  if (!functions.IsEmpty())
  {
    const int first = functions.GetFirst();
    RecurAsWideAsPossible(functions.GetSteps(), this->GetStart(functions), this->Cosine,
      Turn{ factor, { in[0] + first, in[1] + first, in[2] + first },
        { out[0] + first, out[1] + first, out[2] + first } });
  }
}
} // namespace measuredbrdf
