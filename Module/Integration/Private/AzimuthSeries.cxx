// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AzimuthSeries.h"

#include "HalfVector.h" // for Pi
#include "LinearSpline.h"
#include "MatrixProduct.h"
#include "ParallelFor.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t Together = 512; // values of each slice, which fit into a core's cache
}

AzimuthSeries::AzimuthSeries(int angles, int azimuths, std::size_t texels)
  : Angles(angles)
  , Azimuths(azimuths)
  , Size(3 * texels)
  , Values(this->Size * this->GetSlices() * static_cast<std::size_t>(angles))
{
}

// A slice has the real field of order 0, and two have the real and the imaginary parts of another.
void AzimuthSeries::Set(int order, const std::array<FieldSynthesis::Field, 3>& fields)
{
  const std::size_t texels = this->Size / 3;
  measuredbrdf::ParallelFor(0, this->Angles, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (std::size_t angle = static_cast<std::size_t>(begin);
           angle < static_cast<std::size_t>(end); ++angle)
      {
        const std::size_t slice = 2 * static_cast<std::size_t>(order) - (order > 0 ? 1 : 0);
        float* real = &this->Values[(angle * this->GetSlices() + slice) * this->Size];
        float* imaginary = order > 0 ? real + this->Size : nullptr;
        const std::complex<float>* in[] = { &fields[0][angle * texels], &fields[1][angle * texels],
          &fields[2][angle * texels] };
        for (std::size_t k = 0; k < this->Size; k += 3)
        {
          for (std::size_t channel = 0; channel < 3; ++channel)
          {
            const std::complex<float> value = in[channel][k / 3];
            real[k + channel] = value.real();
            if (imaginary)
            {
              imaginary[k + channel] = value.imag();
            }
          }
        }
      }
    });
}

// What each number of the series counts for at each azimuth: slices x rows, one for each azimuth
// and some of zeros.
std::vector<float> AzimuthSeries::GetTurns() const
{
  const std::size_t slices = this->GetSlices();
  const std::size_t rows = RoundUp(slices, ProductRows);
  std::vector<float> turns(rows * slices, 0.0f);
  for (std::size_t azimuth = 0; azimuth < slices; ++azimuth)
  {
    turns[azimuth] = 1.0f;
    for (int order = 1; order <= this->GetLastOrder(); ++order)
    {
      const double gain = 2.0 * GetLinearSplineGain(static_cast<double>(order) / this->Azimuths);
      const double angle = 2.0 * Pi * order * static_cast<double>(azimuth) / this->Azimuths;
      const std::size_t at = 2 * static_cast<std::size_t>(order) * rows + azimuth;
      turns[at - rows] = static_cast<float>(gain * std::cos(angle));
      turns[at] = static_cast<float>(gain * std::sin(angle));
    }
  }
  return turns;
}

std::vector<float> AzimuthSeries::TakeRadiance()
{
  const std::size_t slices = this->GetSlices();
  const std::size_t rows = RoundUp(slices, ProductRows);
  const std::vector<float> turns = this->GetTurns();
  const std::size_t blocks = (this->Size + Together - 1) / Together;
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(blocks) * this->Angles, 16,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<float> series(slices * Together, 0.0f);
      std::vector<float> radiance(rows * Together);
      for (std::size_t k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      {
        const std::size_t first = k % blocks * Together;
        const std::size_t count = std::min(Together, this->Size - first);
        float* values = &this->Values[k / blocks * slices * this->Size + first];
        for (std::size_t slice = 0; slice < slices; ++slice)
        {
          std::copy_n(values + slice * this->Size, count, &series[slice * Together]);
        }
        Multiply({ turns.data(), rows }, { series.data(), Together }, rows, slices, Together,
          radiance.data());
        for (std::size_t slice = 0; slice < slices; ++slice)
        {
          std::copy_n(&radiance[slice * Together], count, values + slice * this->Size);
        }
      }
    });
  return std::move(this->Values);
}
} // namespace measuredbrdf
