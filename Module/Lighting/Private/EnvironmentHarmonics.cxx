// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentHarmonics.h"

#include "BasisFunctions.h"
#include "ParallelFor.h"
#include "TexelChanges.h"
#include "TexelInterpolation.h"
#include "WignerD.h"
#include "vtkEnvironment.h"

#include <Eigen/Core>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <array>
#include <cmath>

namespace measuredbrdf
{
namespace
{
// By channel, row and order.
using Series = std::vector<std::complex<double>>;

// How many columns a row is transformed with: its own, or, where a large prime number of columns
// would make that slow, so many interpolated ones that they change next to nothing.
std::size_t ChooseColumns(std::size_t width)
{
  constexpr std::size_t largestFactor = 64;
  std::size_t rest = width;
  for (std::size_t factor = 2; factor <= largestFactor; ++factor)
  {
    while (rest % factor == 0)
    {
      rest /= factor;
    }
  }
  std::size_t power = 1;
  while (power < 8 * width)
  {
    power *= 2;
  }
  return rest == 1 ? width : power;
}

// The Fourier series of each row, of the function between its texels: that of point masses at
// phi_x = 2 pi (x + 1/2) / width, times that of the triangles that linear interpolation makes of
// them.
Series TransformRows(vtkEnvironment* environment, const TexelChanges& texels, std::size_t orders)
{
  const std::size_t width = static_cast<std::size_t>(environment->GetWidth());
  const std::size_t height = static_cast<std::size_t>(environment->GetHeight());
  const std::size_t columns = ChooseColumns(width);
  std::vector<TexelNeighbors> neighbors;
  for (std::size_t x = 0; x < columns; ++x)
  {
    neighbors.push_back(
      TexelNeighbors::InRow((static_cast<double>(x) + 0.5) / static_cast<double>(columns), width));
  }
  // The harmonics' azimuth is 3 pi/2 - phi_x: e^(-i m azimuth) = i^m e^(i m phi_x).
  const std::complex<double> turns[4] = { 1.0, { 0.0, 1.0 }, -1.0, { 0.0, -1.0 } };
  std::vector<std::complex<double>> factors;
  for (std::size_t m = 0; m < orders; ++m)
  {
    const double half = Pi * static_cast<double>(m) / static_cast<double>(columns);
    const double sinc = m > 0 ? std::sin(half) / half : 1.0;
    factors.push_back(
      turns[m % 4] * std::polar(2.0 * Pi / static_cast<double>(columns) * sinc * sinc, half));
  }
  Series rows(3 * height * orders);
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(height),
    [&](vtkIdType begin, vtkIdType end)
    {
      Eigen::FFT<double> transform;
      std::vector<float> room;
      std::vector<double> values(columns);
      std::vector<std::complex<double>> series;
      for (vtkIdType row = begin; row < end; ++row)
      {
        const float* rgb =
          texels.GetRow(environment, static_cast<int>(row), 0, static_cast<int>(width), room);
        for (std::size_t channel = 0; channel < 3; ++channel)
        {
          for (std::size_t x = 0; x < columns; ++x)
          {
            const TexelNeighbors& near = neighbors[x];
            values[x] = near.Mix(rgb[3 * near.First + channel], rgb[3 * near.Second + channel]);
          }
          transform.fwd(series, values);
          std::complex<double>* out =
            &rows[(channel * height + static_cast<std::size_t>(row)) * orders];
          for (std::size_t m = 0; m < orders; ++m)
          {
            out[m] = factors[m] * std::conj(series[m % columns]);
          }
        }
      }
    });
  return rows;
}

// A node of the integral over the polar angle, north of the equator, and its image in the south.
struct Ring
{
  double Theta;
  double Weight;       // with the sine
  TexelNeighbors Rows; // from the south pole for the south, from the north pole for the north

  std::complex<double> Mix(
    const std::complex<double>& first, const std::complex<double>& second) const
  {
    return this->Weight * (first + this->Rows.Weight * (second - first));
  }
};

// Gauss-Legendre nodes between each two rows' centers, where rows are interpolated linearly, and
// between the pole and the first row's.
std::vector<Ring> MakeRings(std::size_t height, int degree)
{
  const double rowsOfDegree = static_cast<double>(degree) / static_cast<double>(height);
  const Quadrature rule = GaussLegendre(rowsOfDegree <= 0.5 ? 2 : rowsOfDegree <= 1.0 ? 3 : 4);
  std::vector<Ring> rings;
  const double step = Pi / static_cast<double>(height);
  for (double begin = 0.0; begin < 0.5 * Pi - 1e-6 * step;)
  {
    // Half a row at the pole and, where the rows are even in number, at the equator.
    const double end = std::min(begin + (begin > 0.0 ? step : 0.5 * step), 0.5 * Pi);
    for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
    {
      const double theta = 0.5 * (begin + end) + 0.5 * (end - begin) * rule.Nodes[k];
      rings.push_back({ theta, 0.5 * (end - begin) * rule.Weights[k] * std::sin(theta),
        TexelNeighbors::InColumn(theta / Pi, height) });
    }
    begin = end;
  }
  return rings;
}

// One order's sums over the rings of both hemispheres, where l - m is even and where it is odd: a
// row for each such degree, real and imaginary parts of the channels side by side. Functions whose
// l - m is odd change sign across the equator.
using Sums = std::array<Eigen::Matrix<double, Eigen::Dynamic, 6>, 2>;

Sums SumRings(const Series& rows, const std::vector<Ring>& rings, std::size_t height,
  std::size_t orders, std::size_t m)
{
  constexpr std::size_t together = 128; // rings, whose functions stay in the processor's cache
  const WignerD functions(static_cast<int>(m), 0, static_cast<int>(orders) - 1);
  const std::vector<WignerD::Step>& steps = functions.GetSteps();
  Sums sums;
  std::array<Eigen::MatrixXd, 2> tables; // of functions, a ring a row
  const auto degrees = [&steps](std::size_t odd)
  { return static_cast<Eigen::Index>((steps.size() + 2 - odd) / 2); };
  for (const std::size_t odd : { 0, 1 })
  {
    sums[odd].setZero(degrees(odd), 6);
  }
  for (std::size_t begin = 0; begin < rings.size(); begin += together)
  {
    const auto count = static_cast<Eigen::Index>(std::min(together, rings.size() - begin));
    Eigen::ArrayXd cosines(count), current(count), before = Eigen::ArrayXd::Zero(count);
    Sums values;
    for (const std::size_t odd : { 0, 1 })
    {
      values[odd].resize(count, 6);
      tables[odd].resize(count, degrees(odd));
    }
    for (Eigen::Index k = 0; k < count; ++k)
    {
      const Ring& ring = rings[begin + static_cast<std::size_t>(k)];
      cosines[k] = std::cos(ring.Theta);
      current[k] = functions.GetStart(
        WignerD::GetLog(std::cos(0.5 * ring.Theta)), WignerD::GetLog(std::sin(0.5 * ring.Theta)));
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        const auto get = [&](std::size_t y) { return rows[(channel * height + y) * orders + m]; };
        const std::size_t top = height - 1;
        const std::complex<double> north =
          ring.Mix(get(top - ring.Rows.First), get(top - ring.Rows.Second));
        const std::complex<double> south = ring.Mix(get(ring.Rows.First), get(ring.Rows.Second));
        const auto column = static_cast<Eigen::Index>(2 * channel);
        values[0].row(k).segment<2>(column) << (north + south).real(), (north + south).imag();
        values[1].row(k).segment<2>(column) << (north - south).real(), (north - south).imag();
      }
    }
    for (std::size_t k = 0; k <= steps.size(); ++k)
    {
      tables[k % 2].col(static_cast<Eigen::Index>(k / 2)) = current;
      if (k < steps.size())
      {
        before = steps[k].A * (cosines - steps[k].B) * current - steps[k].C * before;
        before.swap(current);
      }
    }
    for (const std::size_t odd : { 0, 1 })
    {
      sums[odd].noalias() += tables[odd].transpose() * values[odd];
    }
  }
  return sums;
}
}

EnvironmentHarmonics::EnvironmentHarmonics(
  vtkEnvironment* environment, int maximumDegree, const TexelChanges* changes)
  : MaximumDegree(maximumDegree)
{
  environment = environment->GetSubdivided();
  const std::size_t orders = static_cast<std::size_t>(maximumDegree) + 1;
  this->Coefficients.assign(3 * orders * orders, 0.0);
  static const TexelChanges& none = *new TexelChanges; // never destroyed: threads use it
  const Series rows = TransformRows(environment, changes ? *changes : none, orders);
  const std::size_t height = static_cast<std::size_t>(environment->GetHeight());
  const std::vector<Ring> rings = MakeRings(height, maximumDegree);

  measuredbrdf::ParallelForEach(static_cast<vtkIdType>(orders),
    [&](vtkIdType order)
    {
      const std::size_t m = static_cast<std::size_t>(order);
      const Sums sums = SumRings(rows, rings, height, orders, m);
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        for (std::size_t l = m; l < orders; ++l)
        {
          const auto row = sums[(l - m) % 2].row(static_cast<Eigen::Index>((l - m) / 2));
          const auto column = static_cast<Eigen::Index>(2 * channel);
          this->Coefficients[(channel * orders + m) * orders + l] =
            std::sqrt((2.0 * static_cast<double>(l) + 1.0) / (4.0 * Pi)) *
            std::complex<double>(row[column], row[column + 1]);
        }
      }
    });
}
} // namespace measuredbrdf
