// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HalfDifferenceFill.h"

#include "HalfVector.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
// Pairs that tell whether both sides are alike.
constexpr std::uint32_t NumberOfMirrorProbes = 64;
constexpr double LargestMirrorDifference = 1e-9; // of the value: less is rounding

struct SlidCell
{
  HalfDifference Angles;
  bool IsSlid = false; // to above the horizon
};

// Directions of a cell, slid along theta_d to above the horizon where they lie below: closely for
// cosine-weighted tables, which stay smooth there; by half a cell for tables of f itself, whose
// values next to the horizon would outweigh all others (f grows as 1/cos).
SlidCell GetSlidCell(const int dimensions[3], double range, int x, int y, int z)
{
  SlidCell cell;
  HalfDifference& angles = cell.Angles;
  angles = { UnitToThetaH((z + 0.5) / dimensions[2]), 0.5 * Pi * (y + 0.5) / dimensions[1],
    range * (x + 0.5) / dimensions[0] };
  const double horizon = FindHorizon(angles);
  const double gap = range < 2.0 * Pi ? 0.25 * Pi / dimensions[1] : 1e-4 * horizon;
  const double last = std::max(horizon - gap, 0.5 * horizon);
  cell.IsSlid = angles.ThetaD >= last;
  angles.ThetaD = std::min(angles.ThetaD, last);
  return cell;
}

// f cos(theta_o), or the mean of f for both ways that light may go.
glm::vec3 EvaluateCell(vtkBRDF* input, bool reciprocal, const HalfDifference& angles)
{
  glm::dvec3 i, o, f;
  FromHalfDifference(angles, i, o);
  input->Evaluate(&i.x, &o.x, &f.x);
  if (reciprocal && !input->IsReciprocal())
  {
    glm::dvec3 g;
    input->Evaluate(&o.x, &i.x, &g.x);
    f = 0.5 * (f + g);
  }
  return glm::vec3(glm::min(
    reciprocal ? f : f * o.z, glm::dvec3(static_cast<double>(std::numeric_limits<float>::max()))));
}

// Whether f is the same at -phi_d.
bool IsMirroredAtH(vtkBRDF* input)
{
  for (std::uint32_t k = 1; k <= NumberOfMirrorProbes; ++k)
  {
    const double thetaH = UnitToThetaH(RadicalInverse(k, 2));
    const HalfDifference angles{ thetaH, (0.5 * Pi - thetaH) * RadicalInverse(k, 3),
      Pi * RadicalInverse(k, 5) };
    glm::dvec3 i, o, f, g;
    FromHalfDifference(angles, i, o);
    input->Evaluate(&i.x, &o.x, &f.x);
    i.y = -i.y;
    o.y = -o.y;
    input->Evaluate(&i.x, &o.x, &g.x);
    if (glm::any(glm::greaterThan(glm::abs(f - g), LargestMirrorDifference * glm::abs(f))))
    {
      return false;
    }
  }
  return true;
}
}

void FillHalfDifference(vtkBRDF* input, bool reciprocal, const int dimensions[3],
  vtkTabulatedBRDF* output, const std::vector<char>* wanted)
{
  const double range = reciprocal ? Pi : 2.0 * Pi;
  const std::size_t width = static_cast<std::size_t>(dimensions[0]);
  const std::size_t height = static_cast<std::size_t>(dimensions[1]);
  std::vector<float> rgb(3 * width * height * static_cast<std::size_t>(dimensions[2]));
  input->Prepare();
  const bool mirrored = !reciprocal && IsMirroredAtH(input);
  const std::size_t sides = mirrored ? (width + 1) / 2 : width;
  measuredbrdf::ParallelFor(0, dimensions[2], 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType column = static_cast<vtkIdType>(sides) * begin;
           column < static_cast<vtkIdType>(sides) * end; ++column)
      {
        const std::size_t x = static_cast<std::size_t>(column) % sides;
        const std::size_t z = static_cast<std::size_t>(column) / sides;
        const std::size_t mirror = mirrored ? width - 1 - x : x;
        const float* slid = nullptr; // the value that the column ends with
        for (std::size_t y = 0; y < height; ++y)
        {
          const std::size_t first = (z * height + y) * width;
          if (wanted && !(*wanted)[first + x] && !(*wanted)[first + mirror])
          {
            continue;
          }
          float* value = &rgb[3 * (first + x)];
          if (slid)
          {
            std::copy_n(slid, 3, value);
          }
          else
          {
            const SlidCell cell = GetSlidCell(
              dimensions, range, static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
            const glm::vec3 f = EvaluateCell(input, reciprocal, cell.Angles);
            std::copy_n(&f.x, 3, value);
            slid = cell.IsSlid ? value : nullptr;
          }
          if (mirror != x)
          {
            std::copy_n(value, 3, &rgb[3 * (first + mirror)]);
          }
        }
      }
    });
  output->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE,
    reciprocal ? vtkTabulatedBRDF::HALF_TURN : vtkTabulatedBRDF::FULL_TURN, dimensions,
    std::move(rgb));
  output->SetCosineWeighted(!reciprocal);
}
} // namespace measuredbrdf
