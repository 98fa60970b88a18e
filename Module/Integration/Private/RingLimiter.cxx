// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RingLimiter.h"

#include "vtkSMPTools.h"

#include <Eigen/Core>

namespace measuredbrdf
{
namespace
{
constexpr float LeastShare = 0.75f; // of the blur's least

// A map, a row in each of its columns.
using Map = Eigen::ArrayXXf;

// Each value with its neighbors left and right.
template <typename Combine>
void CombineAlong(const Map& in, const Combine& combine, Map& out)
{
  const Eigen::Index width = in.rows();
  const Eigen::Index inner = width - 6;
  out.middleRows(3, inner) =
    combine(in.topRows(inner), in.middleRows(3, inner), in.bottomRows(inner));
  out.topRows(3) = combine(in.bottomRows(3), in.topRows(3), in.middleRows(3, 3));
  out.bottomRows(3) = combine(in.middleRows(width - 6, 3), in.bottomRows(3), in.topRows(3));
}

// And above and below; beyond a pole the meridian opposite goes on.
template <typename Combine>
void CombineAcross(const Map& in, const Combine& combine, Map& out)
{
  const Eigen::Index inner = in.cols() - 2;
  const Eigen::Index last = in.cols() - 1;
  const Eigen::Index half = in.rows() / 6 * 3;
  const auto beyond = [&in, half](Eigen::Index row)
  {
    Eigen::ArrayXf turned(in.rows());
    turned << in.col(row).tail(in.rows() - half), in.col(row).head(half);
    return turned;
  };
  out.middleCols(1, inner) =
    combine(in.leftCols(inner), in.middleCols(1, inner), in.rightCols(inner));
  out.col(0) = combine(beyond(1), in.col(0), in.col(1));
  out.col(last) = combine(in.col(last - 1), in.col(last), beyond(last - 1));
}
}

void LiftDarkRingsOfMap(float* radiance, std::size_t rows, std::size_t columns)
{
  const auto blur = [](const auto& a, const auto& b, const auto& c)
  { return 0.25f * (a + c) + 0.5f * b; };
  const auto least = [](const auto& a, const auto& b, const auto& c) { return a.min(b).min(c); };
  Map first, second(static_cast<Eigen::Index>(3 * columns), static_cast<Eigen::Index>(rows));
  Eigen::Map<Map> values(radiance, second.rows(), second.cols());
  first = values.max(0.0f);
  for (int pass = 0; pass < 2; ++pass)
  {
    CombineAlong(first, blur, second);
    CombineAcross(second, blur, first);
  }
  for (int pass = 0; pass < 2; ++pass) // as far as the blur reaches: edges do not bleed
  {
    CombineAlong(first, least, second);
    CombineAcross(second, least, first);
  }
  // Where that is 0 all around is negative: f is less than the Lambert part.
  values = (first > 0.0f).select(values.max(LeastShare * first), values);
}

void LiftDarkRings(std::vector<float>& radiance, std::size_t rows, std::size_t columns)
{
  const std::size_t size = 3 * rows * columns;
  vtkSMPTools::For(0, static_cast<vtkIdType>(radiance.size() / size), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        LiftDarkRingsOfMap(&radiance[static_cast<std::size_t>(k) * size], rows, columns);
      }
    });
}
} // namespace measuredbrdf
