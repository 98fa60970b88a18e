// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentHarmonics.h"

#include "GaussLegendre.h"
#include "TexelChanges.h"
#include "WignerD.h"
#include "vtkEnvironment.h"
#include "vtkSMPTools.h"

#include <unsupported/Eigen/FFT>

#include <cmath>

namespace measuredbrdf
{
namespace
{
// Fourier series of point masses, sum_x L_x e^(i m phi_x), of the few orders that harmonics need
// and for any number of columns, which a transform of the row itself does not suit (long primes
// take it hundreds of times longer): the masses are spread over a grid of a power of two by a
// narrow kernel, the grid's transform is divided by the kernel's (Barnett, Magland, af Klinteberg
// 2019, "A Parallel Nonuniform Fast Fourier Transform Library Based on an 'Exponential of
// Semicircle' Kernel"). Error 1e-12 of the row's sum.
class RowTransform
{
public:
  RowTransform(std::size_t width, std::size_t orders)
    : Size(32)
  {
    while (this->Size < 4 * orders) // twice the orders of either sign
    {
      this->Size *= 2;
    }
    const double size = static_cast<double>(this->Size);
    for (std::size_t x = 0; x < width; ++x)
    {
      const double at = (static_cast<double>(x) + 0.5) / static_cast<double>(width) * size;
      const double first = std::ceil(at - Reach);
      this->Firsts.push_back(static_cast<std::size_t>(first + Reach));
      for (int k = 0; k < Points; ++k)
      {
        this->Weights.push_back(Evaluate((first + k - at) / Reach));
      }
    }
    const Quadrature rule = GaussLegendre(64);
    for (std::size_t m = 0; m < orders; ++m)
    {
      double sum = 0.0;
      for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
      {
        sum += Reach * rule.Weights[k] * Evaluate(rule.Nodes[k]) *
               std::cos(2.0 * Pi * static_cast<double>(m) * Reach * rule.Nodes[k] / size);
      }
      this->Scales.push_back(1.0 / sum);
    }
  }

  // What each thread works with.
  struct Workspace
  {
    Eigen::FFT<double> Transform;
    std::vector<double> Grids[3];
    std::vector<std::complex<double>> Series;
  };

  // Series of one channel after the other, phi_x = 2 pi (x + 1/2) / width, of RGB triples.
  template <typename Output>
  void Run(const float* rgb, Workspace& work, Output&& output) const
  {
    for (std::vector<double>& grid : work.Grids)
    {
      grid.assign(this->Size + 2 * Reach + 1, 0.0);
    }
    const double* weights = this->Weights.data();
    for (const std::size_t first : this->Firsts)
    {
      for (std::vector<double>& grid : work.Grids)
      {
        const double value = *rgb++;
        double* to = &grid[first];
        for (int k = 0; k < Points; ++k)
        {
          to[k] += weights[k] * value;
        }
      }
      weights += Points;
    }
    work.Transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    work.Series.resize(this->Size / 2 + 1);
    for (int channel = 0; channel < 3; ++channel)
    {
      // What lies beyond the ends comes in on the other side.
      std::vector<double>& grid = work.Grids[channel];
      for (std::size_t k = 0; k < Reach; ++k)
      {
        grid[this->Size + k] += grid[k];
      }
      for (std::size_t k = this->Size + Reach; k < grid.size(); ++k)
      {
        grid[k - this->Size] += grid[k];
      }
      work.Transform.fwd(work.Series.data(), &grid[Reach], static_cast<Eigen::Index>(this->Size));
      for (std::size_t m = 0; m < this->Scales.size(); ++m)
      {
        output(channel, m, this->Scales[m] * std::conj(work.Series[m]));
      }
    }
  }

private:
  static constexpr int Reach = 7; // of the kernel, to either side
  static constexpr int Points = 2 * Reach;

  static double Evaluate(double z)
  {
    return std::abs(z) < 1.0 ? std::exp(2.3 * Points * (std::sqrt(1.0 - z * z) - 1.0)) : 0.0;
  }

  std::size_t Size;
  std::vector<std::size_t> Firsts; // grid point of a column's first weight, plus Reach
  std::vector<double> Weights;     // Points of each column
  std::vector<double> Scales;
};
}

EnvironmentHarmonics::EnvironmentHarmonics(
  vtkEnvironment* environment, int maximumDegree, const TexelChanges* changes)
  : MaximumDegree(maximumDegree)
{
  environment = environment->GetSubdivided();
  static const TexelChanges none;
  const TexelChanges& texels = changes ? *changes : none;
  const std::size_t width = static_cast<std::size_t>(environment->GetWidth());
  const std::size_t height = static_cast<std::size_t>(environment->GetHeight());
  const std::size_t orders = static_cast<std::size_t>(maximumDegree) + 1;
  this->Coefficients.assign(3 * orders * orders, 0.0);

  // The harmonics' azimuth is 3 pi/2 - phi_x: e^(-i m azimuth) = i^m e^(i m phi_x).
  const std::complex<double> turns[4] = { 1.0, { 0.0, 1.0 }, -1.0, { 0.0, -1.0 } };
  std::vector<std::complex<double>> rows(3 * height * orders); // channel, row, m
  const RowTransform transform(width, orders);
  vtkSMPTools::For(0, static_cast<vtkIdType>(height),
    [&](vtkIdType begin, vtkIdType end)
    {
      RowTransform::Workspace work;
      std::vector<float> room;
      for (std::size_t y = static_cast<std::size_t>(begin); y < static_cast<std::size_t>(end); ++y)
      {
        const double solidAngle = environment->GetTexelSolidAngle(static_cast<int>(y));
        transform.Run(
          texels.GetRow(environment, static_cast<int>(y), 0, static_cast<int>(width), room), work,
          [&](int channel, std::size_t m, const std::complex<double>& value)
          {
            rows[(static_cast<std::size_t>(channel) * height + y) * orders + m] =
              solidAngle * value * turns[m % 4];
          });
      }
    });

  // Over the rows, order by order.
  vtkSMPTools::For(0, static_cast<vtkIdType>(orders), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<double> d(orders);
      for (vtkIdType order = begin; order < end; ++order)
      {
        const std::size_t m = static_cast<std::size_t>(order);
        const WignerD functions(static_cast<int>(m), 0, maximumDegree);
        for (std::size_t y = 0; y < height; ++y)
        {
          const double theta =
            Pi * (1.0 - (static_cast<double>(y) + 0.5) / static_cast<double>(height));
          functions.Evaluate(theta, d.data());
          for (std::size_t channel = 0; channel < 3; ++channel)
          {
            const std::complex<double> value = rows[(channel * height + y) * orders + m];
            std::complex<double>* out = &this->Coefficients[(channel * orders + m) * orders];
            for (std::size_t l = m; l < orders; ++l)
            {
              out[l] += d[l - m] * value;
            }
          }
        }
        for (std::size_t channel = 0; channel < 3; ++channel)
        {
          for (std::size_t l = m; l < orders; ++l)
          {
            this->Coefficients[(channel * orders + m) * orders + l] *=
              std::sqrt((2.0 * static_cast<double>(l) + 1.0) / (4.0 * Pi));
          }
        }
      }
    });
}
} // namespace measuredbrdf
