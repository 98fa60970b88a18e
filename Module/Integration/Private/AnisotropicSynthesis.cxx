// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnisotropicSynthesis.h"

#include "FieldSynthesis.h"
#include "HalfVector.h" // for Pi
#include "LinearSpline.h"
#include "ParallelFor.h"
#include "RingLimiter.h"
#include "TableSynthesis.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
namespace
{
using Kernels = MaterialPrecomputation::AnisotropicKernels;
using Expanded = std::vector<std::vector<std::complex<float>>>;

Expanded ExpandKernels(const Kernels& knots, int degree, int orders)
{
  Expanded kernels(knots.size());
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(knots.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        const std::size_t knot = static_cast<std::size_t>(k);
        kernels[knot] = knots[knot]->Expand(degree, orders);
      }
    });
  return kernels;
}

// One order's kernels of one view angle, by channel: degrees x (real part, imaginary part of each
// azimuth of the view).
std::array<FieldSynthesis::Matrix, 3> PickOrder(
  const Expanded& kernels, std::size_t first, int count, int order, int degree, int rows)
{
  std::array<FieldSynthesis::Matrix, 3> matrices;
  for (int channel = 0; channel < 3; ++channel)
  {
    FieldSynthesis::Matrix& matrix = matrices[static_cast<std::size_t>(channel)];
    matrix.resize(degree + 1, 2 * count);
    for (int k = 0; k < count; ++k)
    {
      const std::complex<float>* in =
        &kernels[first + static_cast<std::size_t>(k)]
                [static_cast<std::size_t>((3 * order + channel) * (degree + 1))];
      for (int l = 0; l <= degree; ++l)
      {
        const float taper = static_cast<float>(GetTaper(l, degree, rows));
        matrix(l, 2 * k) = taper * in[l].real();
        matrix(l, 2 * k + 1) = taper * in[l].imag();
      }
    }
  }
  return matrices;
}

// One order's fields of one view angle, turned to each psi.
void AddOrder(int order, int angle, const std::array<FieldSynthesis::Field, 3>& fields,
  const AnisotropicTable& table, std::vector<float>& radiance)
{
  const std::size_t texels = table.GetNumberOfTexels();
  measuredbrdf::ParallelFor(0, table.Azimuths + 1, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int azimuth = static_cast<int>(begin); azimuth < static_cast<int>(end); ++azimuth)
      {
        const double gain = GetLinearSplineGain(static_cast<double>(order) / table.Azimuths);
        const std::complex<float> turn =
          std::polar(static_cast<float>(order == 0 ? 1.0 : 2.0 * gain),
            static_cast<float>(-2.0 * Pi * order * static_cast<double>(azimuth) / table.Azimuths));
        for (int view = 0; view < table.ViewAzimuths; ++view)
        {
          float* out = &radiance[3 * table.GetMap(angle, azimuth, view)];
          for (std::size_t channel = 0; channel < 3; ++channel)
          {
            const std::complex<float>* real =
              &fields[channel][2 * static_cast<std::size_t>(view) * texels];
            const std::complex<float>* imaginary = real + texels;
            for (std::size_t texel = 0; texel < texels; ++texel)
            {
              const float re = real[texel].real() - imaginary[texel].imag();
              const float im = real[texel].imag() + imaginary[texel].real();
              out[3 * texel + channel] += turn.real() * re - turn.imag() * im;
            }
          }
        }
      }
    });
}
}

double SynthesizeAnisotropic(const EnvironmentHarmonics& environment, const Kernels& knots,
  int degree, const std::function<bool(double)>& goOn, AnisotropicTable& table)
{
  const int orders = std::min(table.Azimuths / 2, degree); // as many as the azimuths can tell apart
  const Expanded kernels = ExpandKernels(knots, degree, orders);
  std::vector<float> radiance(3 * table.GetMap(table.Angles, 0, 0));
  FieldSynthesis synthesis(environment, table.Rows, table.Columns, MapNodes::Poles);
  for (int angle = 0; angle < table.Angles; ++angle)
  {
    const std::size_t first = static_cast<std::size_t>(angle * table.ViewAzimuths);
    for (int order = 0; order <= orders; ++order)
    {
      std::array<FieldSynthesis::Field, 3> fields;
      synthesis.Run(
        order, PickOrder(kernels, first, table.ViewAzimuths, order, degree, table.Rows), fields);
      AddOrder(order, angle, fields, table, radiance);
      if (!goOn((angle * (orders + 1.0) + order + 1.0) / (table.Angles * (orders + 1.0))))
      {
        return 0.0;
      }
    }
  }
  LiftDarkRings(
    radiance, static_cast<std::size_t>(table.Rows), static_cast<std::size_t>(table.Columns));
  return PackRadiance(radiance, table.Radiance);
}

void MakeAnisotropicProfile(
  const AnisotropicViews& views, const Kernels& knots, double scale, AnisotropicTable& table)
{
  table.Periods = views.GetPeriods();
  const int count = AnisotropicViews::Angles * AnisotropicViews::Azimuths;
  table.Profile.resize(3 * 3 * static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
  {
    const int angleIndex = k % AnisotropicViews::Angles;
    const int azimuthIndex = k / AnisotropicViews::Angles;
    const LobeMeans& lobe = views.Get(angleIndex, azimuthIndex);
    // What interpolation between the kernels misses of the directional albedo goes to the rest.
    const double w =
      LobeViews::GetKnotPosition(AnisotropicViews::GetAngle(angleIndex), table.Angles);
    const int low = std::min(static_cast<int>(w), table.Angles - 2);
    const double p =
      static_cast<double>(azimuthIndex * table.ViewAzimuths) / AnisotropicViews::Azimuths;
    const int from = static_cast<int>(p);
    LobeMeans between;
    for (int corner = 0; corner < 4; ++corner)
    {
      const int angle = low + corner % 2;
      const int azimuth = (from + corner / 2) % table.ViewAzimuths;
      between.Add(knots[static_cast<std::size_t>(angle * table.ViewAzimuths + azimuth)]->GetMeans(),
        (corner % 2 ? w - low : 1.0 - w + low) * (corner / 2 ? p - from : 1.0 - p + from));
    }
    glm::dvec3 share(0.0);
    for (int c = 0; c < 3; ++c)
    {
      const double wanted = lobe.Amplitude[c] + Pi * (lobe.Floor[c] - between.Floor[c]);
      share[c] = between.Amplitude[c] > 0.0 ? std::max(wanted, 0.0) / between.Amplitude[c] : 0.0;
    }
    const double phi = views.GetAzimuth(azimuthIndex);
    const glm::dvec2 out(std::cos(phi), std::sin(phi));
    const glm::dvec3 layers[3] = { { lobe.Axis.x * out.x + lobe.Axis.y * out.y,
                                     lobe.Axis.y * out.x - lobe.Axis.x * out.y, w },
      share * scale, between.Floor };
    for (int layer = 0; layer < 3; ++layer)
    {
      for (int c = 0; c < 3; ++c)
      {
        table
          .Profile[3 * static_cast<std::size_t>(layer * count + k) + static_cast<std::size_t>(c)] =
          static_cast<float>(layers[layer][c]);
      }
    }
    table.HasFloor = table.HasFloor || between.Floor != glm::dvec3(0.0);
  }
}
} // namespace measuredbrdf
