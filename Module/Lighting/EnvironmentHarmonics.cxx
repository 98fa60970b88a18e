// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentHarmonics.h"

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
constexpr double Pi = 3.14159265358979323846;
}

EnvironmentHarmonics::EnvironmentHarmonics(
  vtkEnvironment* environment, int maximumDegree, const TexelChanges* changes)
  : MaximumDegree(maximumDegree)
{
  static const TexelChanges none;
  const TexelChanges& texels = changes ? *changes : none;
  const std::size_t width = static_cast<std::size_t>(environment->GetWidth());
  const std::size_t height = static_cast<std::size_t>(environment->GetHeight());
  const std::size_t orders = static_cast<std::size_t>(maximumDegree) + 1;
  this->Coefficients.assign(3 * orders * orders, 0.0);

  // Fourier series of each row. The harmonics' azimuth is pi/2 - phi with phi the environment's,
  // phi = 2 pi (x + 1/2) / width - pi: e^(-i m azimuth) = e^(-i m pi/2) e^(i m phi).
  std::vector<std::complex<double>> rows(3 * height * orders); // channel, row, m
  vtkSMPTools::For(0, static_cast<vtkIdType>(height),
    [&](vtkIdType begin, vtkIdType end)
    {
      Eigen::FFT<double> transform;
      std::vector<std::complex<double>> line(width), series(width);
      std::vector<float> room;
      for (std::size_t y = static_cast<std::size_t>(begin); y < static_cast<std::size_t>(end); ++y)
      {
        const float* row =
          texels.GetRow(environment, static_cast<int>(y), 0, static_cast<int>(width), room);
        for (std::size_t channel = 0; channel < 3; ++channel)
        {
          for (std::size_t x = 0; x < width; ++x)
          {
            line[x] = row[3 * x + channel];
          }
          series = line; // all there is to do for a single texel, where Eigen's transform fails
          if (width > 1)
          {
            transform.fwd(series, line);
          }
          const double solidAngle = environment->GetTexelSolidAngle(static_cast<int>(y));
          for (std::size_t m = 0; m < orders; ++m)
          {
            const double shift =
              static_cast<double>(m) * (Pi / static_cast<double>(width) - 1.5 * Pi);
            // sum_x L e^(i m phi): the conjugate of the forward transform of a real row.
            rows[(channel * height + y) * orders + m] =
              solidAngle * std::conj(series[m % width]) * std::polar(1.0, shift);
          }
        }
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
