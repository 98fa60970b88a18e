// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Maps of kernels that are convolved with an environment, against the sum over harmonics.

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
