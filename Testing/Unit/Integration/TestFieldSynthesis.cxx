// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Maps of kernels that are convolved with an environment, against the sum over harmonics; the
// splines that they store; and dark rings about lamps, which are lifted.

#include "EnvironmentHarmonics.h"
#include "FieldSynthesis.h"
#include "HalfVector.h"
#include "LaneForms.h"
#include "RadianceTable.h"
#include "SynthesisLanes.h"
#include "WignerD.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

using measuredbrdf::FieldSynthesis;
using measuredbrdf::MapPart;

namespace
{
using measuredbrdf::Pi;
constexpr int FieldDegree = 24;
constexpr int FieldRows = 12;
FieldSynthesis::Kernels MakeKernels(int count)
{
  FieldSynthesis::Kernels kernels(3 * count, FieldDegree + 1);
  for (int kind = 0; kind < 3 * count; ++kind)
  {
    for (int l = 0; l <= FieldDegree; ++l)
    {
      kernels(kind, l) =
        static_cast<float>(std::cos(l * (kind % count + 1.0) + kind / count) / (l + 1.0));
    }
  }
  return kernels;
}

// A map's nodes in some columns of some rows.
MapPart MakePart(int columns, const std::vector<std::pair<int, std::vector<int>>>& rows)
{
  std::vector<char> wanted(static_cast<std::size_t>(FieldRows * columns), 0);
  for (const auto& [row, of] : rows)
  {
    for (const int column : of)
    {
      wanted[static_cast<std::size_t>(row * columns + column)] = 1;
    }
  }
  return MapPart(FieldRows, columns, &wanted);
}

// sum_m e^(-i m phi) sum_l d^l_mk(theta) b_l conj(a_lm)
std::complex<double> Sum(const measuredbrdf::EnvironmentHarmonics& light, int channel, int order,
  const FieldSynthesis::Kernels& kernels, int kind, double theta, double phi)
{
  std::complex<double> sum = 0.0;
  std::vector<double> d(FieldDegree + 1);
  for (int m = -FieldDegree; m <= FieldDegree; ++m)
  {
    const measuredbrdf::WignerD functions(m, order, FieldDegree);
    functions.Evaluate(theta, d.data());
    for (int l = functions.GetFirst(); l <= FieldDegree; ++l)
    {
      const std::complex<double> a = light.Get(channel, l, std::abs(m));
      sum += std::polar(1.0, -m * phi) * d[static_cast<std::size_t>(l - functions.GetFirst())] *
             static_cast<double>(kernels(kind, l)) *
             (m >= 0 ? std::conj(a) : (m % 2 != 0 ? -a : a));
    }
  }
  return sum;
}
}

//------------------------------------------------------------------------------
// Of rows that lie alike on both sides of the equator, of others, of some nodes of them, and of
// order 0, which is real; of kernels that are a multiple of what is transformed or multiplied at a
// time, or not.
TEST(FieldSynthesis, IsTheSumOverHarmonics)
{
  vtkNew<vtkEnvironment> hall;
  hall->SetToProceduralHall();
  const measuredbrdf::EnvironmentHarmonics light(hall, FieldDegree);
  // Columns that make a power of two, or not, or are fewer than the orders.
  std::vector<int> all(64);
  std::iota(all.begin(), all.end(), 0);
  const std::vector<std::pair<MapPart, int>> cases{ { MapPart(FieldRows, 24), 5 },
    { MakePart(64, { { 1, all }, { 4, all }, { 9, all } }), 20 },
    { MakePart(64, { { 3, all }, { 8, all } }), 1 }, { MapPart(FieldRows, 64), 12 },
    { MakePart(64, { { 2, { 0, 63 } }, { 7, { 5, 6, 7, 40 } } }), 16 } };
  for (const auto& [part, count] : cases)
  {
    const FieldSynthesis::Kernels kernels = MakeKernels(count);
    FieldSynthesis synthesis(part, measuredbrdf::MapNodes::Centers);
    const std::size_t nodes = part.GetNumberOfNodes();
    for (const int order : { 0, 1, 2 })
    {
      FieldSynthesis::Fields fields;
      synthesis.Run(order, { { light, kernels } }, fields);
      for (std::size_t k = 0; k < 3 * static_cast<std::size_t>(count) * part.GetRows().size(); ++k)
      {
        const std::size_t channel = k % 3;
        const std::size_t kernel = k / 3 % static_cast<std::size_t>(count);
        const std::size_t row = k / 3 / static_cast<std::size_t>(count);
        const MapPart::Row& place = part.GetRows()[row];
        const std::size_t at = (5 * k + 3) % place.Columns.size(); // a column of each
        const std::size_t kind = channel * static_cast<std::size_t>(count) + kernel;
        const std::complex<double> expected = Sum(light, static_cast<int>(channel), order, kernels,
          static_cast<int>(kind), Pi * (place.Place + 0.5) / FieldRows,
          2.0 * Pi * (place.Columns[at] + 0.5) / part.GetAllColumns());
        const std::complex<float> value = fields[channel][kernel * nodes + place.FirstNode + at];
        EXPECT_NEAR(value.real(), expected.real(), 2e-4 * (1.0 + std::abs(expected)))
          << order << ": " << k << " of " << count;
        EXPECT_NEAR(value.imag(), expected.imag(), 2e-4 * (1.0 + std::abs(expected)))
          << order << ": " << k << " of " << count;
      }
    }
  }
}

//------------------------------------------------------------------------------
using measuredbrdf::FitLinearSpline;
using measuredbrdf::GetLinearSplineGain;

namespace
{
using measuredbrdf::Pi;

// Mean squared error of gain cos(2 pi periods x) at so many nodes a turn, interpolated linearly.
double GetSquaredError(int nodes, int periods, double gain)
{
  constexpr int Points = 64; // of an interval
  double sum = 0.0;
  for (int k = 0; k < nodes * Points; ++k)
  {
    const double t = (k % Points + 0.5) / Points;
    const auto wave = [&](double node) { return std::cos(2.0 * Pi * periods * node / nodes); };
    const int node = k / Points;
    const double spline = gain * ((1.0 - t) * wave(node) + t * wave(node + 1));
    sum += std::pow(spline - wave(node + t), 2);
  }
  return sum / (nodes * Points);
}
}

//------------------------------------------------------------------------------
TEST(LinearSpline, GainHasTheLeastSquaredError)
{
  constexpr int Nodes = 48;
  for (const int periods : { 1, 3, 6, 12, 20, 30, 37 })
  {
    const double gain = GetLinearSplineGain(static_cast<double>(periods) / Nodes);
    const double error = GetSquaredError(Nodes, periods, gain);
    EXPECT_LT(error, GetSquaredError(Nodes, periods, gain + 1e-3)) << periods;
    EXPECT_LT(error, GetSquaredError(Nodes, periods, gain - 1e-3)) << periods;
    EXPECT_LT(error, GetSquaredError(Nodes, periods, 1.0)) << periods;
  }
  // A sixth of the squared error of interpolation where the function is smooth.
  EXPECT_NEAR(
    GetSquaredError(Nodes, 1, GetLinearSplineGain(1.0 / Nodes)) / GetSquaredError(Nodes, 1, 1.0),
    1.0 / 6.0, 0.01);
  EXPECT_EQ(GetLinearSplineGain(0.0), 1.0);
  EXPECT_EQ(GetLinearSplineGain(-0.3), GetLinearSplineGain(0.3));
}

//------------------------------------------------------------------------------
// From values alone: the same to the second order.
TEST(LinearSpline, FitFollowsTheGain)
{
  for (const double frequency : { 0.01, 0.05, 0.1 })
  {
    const auto wave = [&](int k)
    { return std::polar(1.0f, static_cast<float>(2.0 * Pi * frequency * k)); };
    const std::complex<float> fitted = FitLinearSpline(wave(-1), wave(0), wave(1));
    EXPECT_NEAR(
      fitted.real(), GetLinearSplineGain(frequency), 30.0 * std::pow(frequency, 4) + 1e-6);
    EXPECT_NEAR(fitted.imag(), 0.0, 1e-6);
  }
}

//------------------------------------------------------------------------------
//------------------------------------------------------------------------------
// As node by node, whatever the width.
TEST(RingLimiter, IsTheSameNodeByNode)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(-3.0f, 9.0f);
  for (const int columns : { 4, 6, 18, 32 })
  {
    constexpr int rows = 7;
    std::vector<float> map(static_cast<std::size_t>(3 * rows * columns));
    std::generate(map.begin(), map.end(), [&]() { return value(random); });
    // Columns go round, and beyond a pole the meridian opposite goes on.
    const auto get = [columns](const std::vector<float>& of, int row, int column, int channel)
    {
      const bool isBeyond = row < 0 || row >= rows;
      const int at = row < 0 ? -row : row >= rows ? 2 * (rows - 1) - row : row;
      const int round = (column + columns + (isBeyond ? columns / 2 : 0)) % columns;
      return of[static_cast<std::size_t>(3 * (at * columns + round) + channel)];
    };
    std::vector<float> around(map.size());
    std::transform(
      map.begin(), map.end(), around.begin(), [](float of) { return std::max(of, 0.0f); });
    for (int pass = 0; pass < 8; ++pass) // blurred twice along and across, then the least
    {
      const std::vector<float> in = around;
      const int down = pass % 2;
      for (int k = 0; k < 3 * rows * columns; ++k)
      {
        const int row = k / 3 / columns, column = k / 3 % columns;
        const float a = get(in, row - down, column - 1 + down, k % 3);
        const float c = get(in, row + down, column + 1 - down, k % 3);
        const float b = in[static_cast<std::size_t>(k)];
        around[static_cast<std::size_t>(k)] =
          pass < 4 ? 0.25f * (a + c) + 0.5f * b : std::min({ a, b, c });
      }
    }
    std::vector<float> lifted = map;
    measuredbrdf::LiftDarkRingsOfMap(lifted.data(), rows, static_cast<std::size_t>(columns));
    int changed = 0;
    for (std::size_t k = 0; k < map.size(); ++k)
    {
      const float expected = around[k] > 0.0f ? std::max(map[k], 0.75f * around[k]) : map[k];
      EXPECT_FLOAT_EQ(lifted[k], expected) << columns << " columns, number " << k;
      changed += lifted[k] != map[k] ? 1 : 0;
    }
    EXPECT_GT(changed, 0);
  }
}
