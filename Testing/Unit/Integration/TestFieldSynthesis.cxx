// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Maps of kernels that are convolved with an environment, against the sum over harmonics.

#include "EnvironmentHarmonics.h"
#include "FieldSynthesis.h"
#include "HalfVector.h"
#include "LaneForms.h"
#include "SynthesisLanes.h"
#include "TableSynthesis.h"
#include "WignerD.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>
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
// Lanes against one angle after the other, poles and degrees below the first included.
TEST(WignerLanes, AgreeWithOneAngle)
{
  ForEachLaneForm(
    [&]()
    {
      using measuredbrdf::WignerLanes;
      constexpr int last = 40;
      const WignerLanes::Values theta = { 0.0, 0.4, 2.0, Pi };
      const WignerLanes lanes(theta);
      for (const auto& [m, k] : { std::pair(0, 0), std::pair(3, -2), std::pair(-7, 1),
             std::pair(last, 5), std::pair(last + 1, 0) })
      {
        const measuredbrdf::WignerD functions(m, k, last);
        const std::size_t first = static_cast<std::size_t>(functions.GetFirst());
        std::vector<float> d(WignerLanes::Count * (last + 2));
        std::vector<WignerLanes::Values> in(3 * (last + 1)), scaled(3 * (last + 1)),
          turned(3 * (last + 1));
        for (std::size_t n = 0; n < in.size(); ++n)
        {
          in[n].fill(1.0 + 0.1 * static_cast<double>(n));
          scaled[n].fill(5.0);
          turned[n].fill(7.0);
        }
        const WignerLanes::Values factors[3] = { { 1, 2, 3, 4 }, { 2, 2, 2, 2 }, { -1, 0, 1, 3 } };
        const auto channels = [](std::vector<WignerLanes::Values>& of) {
          return std::array<WignerLanes::Values*, 3>{ &of[0], &of[last + 1], &of[2 * (last + 1)] };
        };
        constexpr double least = 1e-3;
        const std::size_t begin = lanes.EvaluateFrom(functions, least, d.data());
        // Five sets of angles, more than are taken at a time; one of them counts.
        std::vector<std::array<WignerLanes::Values, 3>> ofAngles(5);
        ofAngles[4] = { factors[0], factors[1], factors[2] };
        WignerLanes::AddSeries(functions,
          { WignerLanes({ 1.0, 1.0, 1.0, 1.0 }), lanes, lanes, lanes, lanes }, ofAngles,
          channels(scaled));
        lanes.AddTurned(
          functions, factors[0], { &in[0], &in[last + 1], &in[2 * (last + 1)] }, channels(turned));
        std::vector<double> one(last + 2);
        for (std::size_t lane = 0; lane < WignerLanes::Count; ++lane)
        {
          functions.Evaluate(theta[lane], one.data());
          for (std::size_t n = 0; n < scaled.size(); ++n)
          {
            const std::size_t l = n % (last + 1);
            const double expected = l >= first ? one[l - first] : 0.0;
            ASSERT_NEAR(scaled[n][lane], 5.0 + factors[n / (last + 1)][lane] * expected, 1e-11);
            ASSERT_NEAR(turned[n][lane], 7.0 + factors[0][lane] * expected * in[n][lane], 1e-11);
            if (l >= first + begin)
            {
              ASSERT_NEAR(d[WignerLanes::Count * (l - first) + lane], expected, 1e-7)
                << l << " of " << m << ", " << k;
            }
            else
            {
              ASSERT_LT(std::abs(expected), least) << l << " of " << m << ", " << k;
            }
          }
        }
      }
    });
}

//------------------------------------------------------------------------------
TEST(LineTransform, IsTheSumOverItems)
{
  using measuredbrdf::LineTransform;
  ForEachLaneForm(
    [&]()
    {
      for (const std::size_t size : { 1u, 2u, 24u, 25u, 32u, 58u })
      {
        std::vector<float> items(size * LineTransform::Item), other(items.size());
        for (std::size_t k = 0; k < items.size(); ++k)
        {
          items[k] = static_cast<float>(std::sin(1.7 * static_cast<double>(k)));
        }
        const std::vector<float> in = items;
        const auto get = [](const std::vector<float>& of, std::size_t k, std::size_t line)
        {
          const float* const at = &of[k * LineTransform::Item + line];
          return std::complex<double>(at[0], at[LineTransform::Lines]);
        };
        LineTransform(size).Run(items, other);
        for (std::size_t k = 0; k < size * LineTransform::Lines; ++k)
        {
          const std::size_t j = k / LineTransform::Lines, line = k % LineTransform::Lines;
          std::complex<double> sum = 0.0;
          for (std::size_t n = 0; n < size; ++n)
          {
            const double turn = static_cast<double>(j * n) / static_cast<double>(size);
            sum += get(in, n, line) * std::polar(1.0, -2.0 * Pi * turn);
          }
          ASSERT_LT(std::abs(get(items, j, line) - sum), 1e-4) << j << " of " << size;
        }
      }
    });
}

//------------------------------------------------------------------------------
// Constant along the azimuth but for one wave, of more texels than are turned at a time.
TEST(AzimuthSeries, TurnsEachOrder)
{
  constexpr std::size_t texels = 200;
  constexpr int azimuths = 16;
  measuredbrdf::AzimuthSeries series(2, azimuths, texels);
  EXPECT_EQ(series.GetLastOrder(), azimuths / 2);
  FieldSynthesis::Fields constant, wave;
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    for (std::size_t k = 0; k < 2 * texels; ++k)
    {
      constant[channel].emplace_back(1.0f + static_cast<float>(k) + static_cast<float>(channel));
      wave[channel].emplace_back(0.25f * static_cast<float>(k), -0.5f);
    }
  }
  series.Set(0, constant);
  series.Set(1, wave);
  const std::vector<float> radiance = series.TakeRadiance();
  ASSERT_EQ(radiance.size(), 2 * (azimuths + 1) * 3 * texels);
  const double sinc = std::sin(Pi / azimuths) / (Pi / azimuths);
  const double gain = 3.0 * sinc * sinc / (2.0 + std::cos(2.0 * Pi / azimuths));
  for (std::size_t k = 0; k < radiance.size(); ++k)
  {
    const std::size_t slice = k / (3 * texels);
    const std::size_t texel = k / 3 % texels + slice / (azimuths + 1) * texels;
    const double psi = 2.0 * Pi * static_cast<double>(slice % (azimuths + 1)) / azimuths;
    const double mean = 1.0 + static_cast<double>(texel) + static_cast<double>(k % 3);
    const double expected =
      mean + 2.0 * gain * (0.25 * static_cast<double>(texel) * std::cos(psi) - 0.5 * std::sin(psi));
    ASSERT_NEAR(radiance[k], expected, 1e-3) << k;
  }
}
