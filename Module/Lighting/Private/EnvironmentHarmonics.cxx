// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentHarmonics.h"

#include "BasisFunctions.h"
#include "Neighbors.h"
#include "ParallelFor.h"
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
using Complex = std::complex<double>;
using Series = std::vector<Complex>; // by channel, row and order

// How many columns a row is transformed with: its own, or, where a large prime number of columns
// would make that slow, so many interpolated ones that they change next to nothing.
int ChooseColumns(int width)
{
  constexpr int largestFactor = 64;
  int rest = width;
  for (int factor = 2; factor <= largestFactor; ++factor)
  {
    while (rest % factor == 0)
    {
      rest /= factor;
    }
  }
  return rest == 1 ? width : 1 << static_cast<int>(std::ceil(std::log2(8.0 * width)));
}

// The Fourier series of each row, of the function between its texels: that of point masses at
// phi_x = 2 pi (x + 1/2) / width, times that of the triangles that linear interpolation makes of
// them.
Series TransformRows(vtkEnvironment* environment, const TexelChanges& texels, std::size_t orders)
{
  const int width = environment->GetWidth();
  const std::size_t height = environment->GetHeight();
  const int columns = ChooseColumns(width);
  std::vector<Neighbors> neighbors;
  for (int x = 0; x < columns; ++x)
  {
    neighbors.push_back(PeriodicNeighbors((x + 0.5) / columns, width));
  }
  // The harmonics' azimuth is 3 pi/2 - phi_x: e^(-i m azimuth) = i^m e^(i m phi_x).
  const Complex turns[4] = { 1.0, { 0.0, 1.0 }, -1.0, { 0.0, -1.0 } };
  std::vector<Complex> factors;
  for (std::size_t m = 0; m < orders; ++m)
  {
    const double half = Pi * static_cast<double>(m) / columns;
    const double sinc = m > 0 ? std::sin(half) / half : 1.0;
    factors.push_back(turns[m % 4] * std::polar(2.0 * Pi / columns * sinc * sinc, half));
  }
  Series rows(3 * height * orders);
  measuredbrdf::ParallelFor(0, environment->GetHeight(),
    [&](vtkIdType begin, vtkIdType end)
    {
      Eigen::FFT<double> transform;
      std::vector<float> room;
      std::vector<double> values(columns);
      std::vector<Complex> series;
      for (vtkIdType row = begin; row < end; ++row)
      {
        const float* rgb = texels.GetRow(environment, static_cast<int>(row), 0, width, room);
        for (std::size_t channel = 0; channel < 3; ++channel)
        {
          for (int x = 0; x < columns; ++x)
          {
            const Neighbors& near = neighbors[x];
            values[x] =
              near.Mix<double>(rgb[3 * near.First + channel], rgb[3 * near.Second + channel]);
          }
          transform.fwd(series, values);
          Complex* out = &rows[(channel * height + row) * orders];
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
  double Weight;  // with the sine
  Neighbors Rows; // from the south pole for the south, from the north pole for the north
};

// Gauss-Legendre nodes between each two rows' centers, where rows are interpolated linearly, and
// between the pole and the first row's.
std::vector<Ring> MakeRings(int height, int degree)
{
  const double rowsOfDegree = static_cast<double>(degree) / height;
  const Quadrature rule = GaussLegendre(rowsOfDegree <= 0.5 ? 2 : rowsOfDegree <= 1.0 ? 3 : 4);
  std::vector<Ring> rings;
  const double step = Pi / height;
  for (double begin = 0.0; begin < 0.5 * Pi - 1e-6 * step;)
  {
    // Half a row at the pole and, where the rows are even in number, at the equator.
    const double end = std::min(begin + (begin > 0.0 ? step : 0.5 * step), 0.5 * Pi);
    for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
    {
      const double theta = 0.5 * (begin + end) + 0.5 * (end - begin) * rule.Nodes[k];
      rings.push_back({ theta, 0.5 * (end - begin) * rule.Weights[k] * std::sin(theta),
        ClampedNeighbors(theta / Pi, height) });
    }
    begin = end;
  }
  return rings;
}

// One order's sums over the rings of both hemispheres, where l - m is even and where it is odd: a
// row for each such degree, real and imaginary parts of the channels side by side. Functions whose
// l - m is odd change sign across the equator.
using Sums = std::array<Eigen::Matrix<double, Eigen::Dynamic, 6>, 2>;

Sums SumRings(
  const Series& rows, const std::vector<Ring>& rings, int height, std::size_t orders, std::size_t m)
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
        const auto mix = [&](int first, int second)
        {
          const Complex* all = &rows[channel * height * orders + m];
          return ring.Weight * ring.Rows.Mix(all[first * orders], all[second * orders]);
        };
        const Complex north = mix(height - 1 - ring.Rows.First, height - 1 - ring.Rows.Second);
        const Complex south = mix(ring.Rows.First, ring.Rows.Second);
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
  vtkEnvironment* environment, int maximumDegree, const TexelChanges& changes)
  : MaximumDegree(maximumDegree)
{
  environment = environment->GetSubdivided();
  const std::size_t orders = static_cast<std::size_t>(maximumDegree) + 1;
  this->Coefficients.assign(3 * orders * orders, 0.0);
  const Series rows = TransformRows(environment, changes, orders);
  const int height = environment->GetHeight();
  const std::vector<Ring> rings = MakeRings(height, maximumDegree);

  measuredbrdf::ParallelForEach(orders,
    [&](std::size_t m)
    {
      const Sums sums = SumRings(rows, rings, height, orders, m);
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        for (std::size_t l = m; l < orders; ++l)
        {
          const auto row = sums[(l - m) % 2].row(static_cast<Eigen::Index>((l - m) / 2));
          const auto column = static_cast<Eigen::Index>(2 * channel);
          this->Coefficients[(channel * orders + m) * orders + l] =
            std::sqrt((2.0 * static_cast<double>(l) + 1.0) / (4.0 * Pi)) *
            Complex(row[column], row[column + 1]);
        }
      }
    });
}
} // namespace measuredbrdf
