// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeHarmonics.h"

#include "HalfVector.h" // for Pi
#include "LobeQuadrature.h"
#include "WignerD.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr int Cells = 512; // that tell where the kernel is
}

LobeHarmonics::LobeHarmonics(vtkBRDF* brdf, double theta, int resolution)
{
  const glm::dvec3 o(std::sin(theta), 0.0, std::cos(theta));
  const LobeQuadrature quadrature(brdf, o, Cells);
  this->Means = LobeMeans(quadrature);
  std::vector<glm::dvec2> polar, azimuths;
  for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
  {
    const double energy = LobeQuadrature::GetEnergy(cell, this->Means.Floor);
    const glm::dvec3& d = cell.Direction;
    polar.emplace_back(std::atan2(std::hypot(d.x, d.y), d.z), energy);
    azimuths.emplace_back(std::atan2(std::abs(d.y), d.x), energy);
  }
  this->Polar = MakeLobeNodes(polar, Pi / 2.0, resolution);
  this->Azimuths = MakeLobeNodes(azimuths, Pi, resolution);

  for (const LobeNode& p : this->Polar)
  {
    for (const LobeNode& a : this->Azimuths)
    {
      const double s = std::sin(p.Angle);
      glm::dvec3 i(s * std::cos(a.Angle), s * std::sin(a.Angle), std::cos(p.Angle));
      glm::dvec3 f, mirrored;
      brdf->Evaluate(&i.x, &o.x, &f.x);
      i.y = -i.y;
      brdf->Evaluate(&i.x, &o.x, &mirrored.x);
      const glm::dvec3 rest = (0.5 * (f + mirrored) - this->Means.Floor) * i.z;
      this->Kernel.push_back(rest);
      const double weight = 2.0 * p.Weight * a.Weight * s;
      this->Sum += rest * weight;
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    if (this->Means.Amplitude[c] <= 0.0 || this->Sum[c] <= 0.0)
    {
      this->Means.Amplitude[c] = this->Sum[c] = 0.0;
    }
  }
}

std::vector<float> LobeHarmonics::Expand(double delta, int degree, int orders) const
{
  // About the normal first, where the horizon is a circle of latitude: azimuth series at each polar
  // node, then over the polar angle. n_lk at (k * 3 + channel) * size + l.
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  std::vector<double> about(3 * size * size, 0.0);
  std::vector<double> d(size);
  for (int k = 0; k <= degree; ++k)
  {
    const WignerD functions(k, 0, degree);
    std::vector<double> cosines;
    for (const LobeNode& a : this->Azimuths)
    {
      cosines.push_back(2.0 * a.Weight * std::cos(k * a.Angle));
    }
    const std::size_t first = static_cast<std::size_t>(k);
    for (std::size_t p = 0; p < this->Polar.size(); ++p)
    {
      glm::dvec3 series(0.0);
      for (std::size_t a = 0; a < cosines.size(); ++a)
      {
        series += cosines[a] * this->Kernel[p * cosines.size() + a];
      }
      functions.Evaluate(this->Polar[p].Angle, d.data());
      series *= this->Polar[p].Weight * std::sin(this->Polar[p].Angle);
      for (std::size_t c = 0; c < 3; ++c)
      {
        double* out = &about[(3 * first + c) * size];
        for (std::size_t l = first; l < size; ++l)
        {
          out[l] += series[static_cast<int>(c)] * d[l - first];
        }
      }
    }
  }

  // Then about the axis: the function seen from a frame turned by -delta about y (z towards -x).
  // b_lk = sum over k' of d^l_k'k(-delta) n_lk'.
  std::vector<double> turned(3 * static_cast<std::size_t>(orders + 1) * size, 0.0);
  for (int k = 0; k <= orders; ++k)
  {
    for (int from = -degree; from <= degree; ++from)
    {
      const WignerD functions(k, from, degree); // d_k'k(-delta) = d_kk'(delta)
      functions.Evaluate(std::abs(delta), d.data());
      // d_mk(-x) = (-1)^(m-k) d_mk(x); n_l,-k = (-1)^k n_lk.
      double sign = delta < 0.0 && (k - from) % 2 != 0 ? -1.0 : 1.0;
      sign = from < 0 && from % 2 != 0 ? -sign : sign;
      const std::size_t first = static_cast<std::size_t>(functions.GetFirst());
      for (std::size_t c = 0; c < 3; ++c)
      {
        const double* in = &about[(3 * static_cast<std::size_t>(std::abs(from)) + c) * size];
        double* out = &turned[(3 * static_cast<std::size_t>(k) + c) * size];
        for (std::size_t l = first; l < size; ++l)
        {
          out[l] += sign * d[l - first] * in[l];
        }
      }
    }
  }
  std::vector<float> result(turned.size());
  for (std::size_t n = 0; n < turned.size(); ++n)
  {
    const double sum = this->Sum[static_cast<int>(n / size % 3)];
    result[n] =
      sum > 0.0
        ? static_cast<float>(
            turned[n] / sum * std::sqrt((2.0 * static_cast<double>(n % size) + 1.0) / (4.0 * Pi)))
        : 0.0f;
  }
  return result;
}
} // namespace measuredbrdf
