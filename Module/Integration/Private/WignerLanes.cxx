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

// Stored as 0: products of such numbers are denormal, and processors are slow with these.
constexpr double Tiny = 1e-15;

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

// The recursion of WignerD.
template <typename Vector>
struct Recursion
{
  MEASUREDBRDF_INLINE void Begin(const Values& cosine, const Values& start, std::size_t lane)
  {
    Load(cosine, lane, this->X);
    Load(start, lane, this->Current);
    this->Previous = 0.0 * this->Current;
  }
  MEASUREDBRDF_INLINE void GoOn(const WignerD::Step& step)
  {
    const Vector next = step.A * (this->X - step.B) * this->Current - step.C * this->Previous;
    this->Previous = this->Current;
    this->Current = next;
  }
  Vector X, Current, Previous;
};

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

// Some angles of a series, one after the other: what stays in registers.
template <typename Vector, std::size_t Count>
struct SeriesLanes
{
  MEASUREDBRDF_INLINE void Begin(const Series& series, std::size_t lane)
  {
    constexpr std::size_t n = Series::Count - Count;
    this->D.Begin(series.Cosines[n], series.Starts[n], lane);
    Load(series.Factors[n][0], lane, this->Red);
    Load(series.Factors[n][1], lane, this->Green);
    Load(series.Factors[n][2], lane, this->Blue);
    this->Others.Begin(series, lane);
  }
  MEASUREDBRDF_INLINE bool AreLess(double least) const
  {
    return IsLess(this->D.Current, least) && this->Others.AreLess(least);
  }
  MEASUREDBRDF_INLINE void GoOn(const WignerD::Step& step)
  {
    this->D.GoOn(step);
    this->Others.GoOn(step);
  }
  MEASUREDBRDF_INLINE void Add(Vector& red, Vector& green, Vector& blue) const
  {
    red += this->Red * this->D.Current;
    green += this->Green * this->D.Current;
    blue += this->Blue * this->D.Current;
    this->Others.Add(red, green, blue);
  }
  Recursion<Vector> D;
  Vector Red, Green, Blue;
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

struct Turned
{
  const Values& Factor;
  const Values* In[3];
  Values* Out[3];
};

template <typename Vector>
MEASUREDBRDF_INLINE void AddTurnedTo(
  const Steps& steps, const Values& start, const Values& cosine, const Turned& turned)
{
  const std::size_t last = steps.size();
  for (std::size_t lane = 0; lane < WignerLanes::Count; lane += sizeof(Vector) / sizeof(double))
  {
    Recursion<Vector> d;
    d.Begin(cosine, start, lane);
    Vector factor;
    Load(turned.Factor, lane, factor);
    std::size_t k = 0;
    for (; k < last && IsLess(d.Current, LeastOfSeries); ++k)
    {
      d.GoOn(steps[k]);
    }
    for (;; ++k)
    {
      const Vector by = factor * d.Current;
      Vector in[3], sums[3];
      Load(turned.In[0][k], lane, in[0]);
      Load(turned.In[1][k], lane, in[1]);
      Load(turned.In[2][k], lane, in[2]);
      Load(turned.Out[0][k], lane, sums[0]);
      Load(turned.Out[1][k], lane, sums[1]);
      Load(turned.Out[2][k], lane, sums[2]);
      sums[0] += by * in[0];
      sums[1] += by * in[1];
      sums[2] += by * in[2];
      Store(sums[0], turned.Out[0][k], lane);
      Store(sums[1], turned.Out[1][k], lane);
      Store(sums[2], turned.Out[2][k], lane);
      if (k == last)
      {
        break;
      }
      d.GoOn(steps[k]);
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
  Recursion<Vector4> lanes;
  lanes.Begin(cosine, start, 0);
  std::size_t k = 0;
  for (; IsLess(lanes.Current, least); ++k)
  {
    if (k == steps.size())
    {
      return k + 1;
    }
    lanes.GoOn(steps[k]);
  }
  const std::size_t first = k;
  for (;; ++k)
  {
    const auto none = (lanes.Current < Tiny) & (lanes.Current > -Tiny);
    const auto floats = __builtin_convertvector(none ? Vector4{} : lanes.Current, FloatVector4);
    std::memcpy(d + WignerLanes::Count * k, &floats, sizeof(floats));
    if (k == steps.size())
    {
      return first;
    }
    lanes.GoOn(steps[k]);
  }
}

__attribute__((target("avx2,fma"))) std::size_t RecurFromWide(
  const Steps& steps, const Values& start, const Values& cosine, double least, float* d)
{
  return RecurFrom(steps, start, cosine, least, d);
}
#endif

#ifdef MEASUREDBRDF_HAS_VECTORS
__attribute__((target("avx2,fma"))) void AddTurnedWide(
  const Steps& steps, const Values& start, const Values& cosine, const Turned& turned)
{
  AddTurnedTo<Vector4>(steps, start, cosine, turned);
}

__attribute__((target("avx2,fma"))) void AddSeriesWide(const Steps& steps, const Series& series)
{
  AddSeriesTo<Vector4>(steps, series);
}
#endif

void AddTurnedAsWideAsPossible(
  const Steps& steps, const Values& start, const Values& cosine, const Turned& turned)
{
#ifdef MEASUREDBRDF_HAS_VECTORS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    return AddTurnedWide(steps, start, cosine, turned);
  }
  AddTurnedTo<Vector2>(steps, start, cosine, turned);
#else
  AddTurnedTo<double>(steps, start, cosine, turned);
#endif
}

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
#ifdef MEASUREDBRDF_HAS_VECTORS
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")
           ? RecurFromWide(functions.GetSteps(), start, this->Cosine, least, d)
           : RecurFrom(functions.GetSteps(), start, this->Cosine, least, d);
#else
  const Steps& steps = functions.GetSteps();
  std::size_t first = steps.size() + 1;
  for (std::size_t lane = 0; lane < Count; ++lane)
  {
    Recursion<double> one;
    one.Begin(this->Cosine, start, lane);
    for (std::size_t k = 0;; ++k)
    {
      first = IsLess(one.Current, least) ? first : std::min(first, k);
      d[Count * k + lane] = IsLess(one.Current, Tiny) ? 0.0f : static_cast<float>(one.Current);
      if (k == steps.size())
      {
        break;
      }
      one.GoOn(steps[k]);
    }
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
    AddTurnedAsWideAsPossible(functions.GetSteps(), this->GetStart(functions), this->Cosine,
      { factor, { in[0] + first, in[1] + first, in[2] + first },
        { out[0] + first, out[1] + first, out[2] + first } });
  }
}
} // namespace measuredbrdf
