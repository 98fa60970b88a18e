// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnisotropicLobe.h"

#include "HalfVector.h" // for Pi
#include "LobeQuadrature.h"
#include "WignerD.h"
#include "vtkBRDF.h"

#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
constexpr int Cells = 512; // that tell where the kernel is
}

AnisotropicLobe::AnisotropicLobe(vtkBRDF* brdf, const glm::dvec3& o, int resolution)
{
  const LobeQuadrature quadrature(brdf, o, Cells);
  this->Means = LobeMeans(quadrature);
  std::vector<glm::dvec2> polar, azimuths;
  for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
  {
    const double energy = LobeQuadrature::GetEnergy(cell, this->Means.Floor);
    const glm::dvec3& d = cell.Direction;
    polar.emplace_back(std::atan2(std::hypot(d.x, d.y), d.z), energy);
    azimuths.emplace_back(std::atan2(d.y, d.x) + Pi, energy);
  }
  this->Polar = MakeLobeNodes(polar, Pi / 2.0, resolution);
  this->Azimuths = MakeLobeNodes(azimuths, 2.0 * Pi, 2 * resolution);
  for (LobeNode& a : this->Azimuths)
  {
    a.Angle -= Pi;
  }
  for (const LobeNode& p : this->Polar)
  {
    const double s = std::sin(p.Angle);
    for (const LobeNode& a : this->Azimuths)
    {
      const glm::dvec3 i(s * std::cos(a.Angle), s * std::sin(a.Angle), std::cos(p.Angle));
      glm::dvec3 f;
      brdf->Evaluate(&i.x, &o.x, &f.x);
      this->Kernel.push_back((f - this->Means.Floor) * i.z);
      this->Sum += this->Kernel.back() * (p.Weight * a.Weight * s);
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

// Where the horizon is a circle of latitude: azimuth series at each polar node, then over the polar
// angle. Azimuths count from the given one. At (k * 3 + channel) * size + l.
AnisotropicLobe::Series AnisotropicLobe::ExpandAboutNormal(int degree, double azimuth) const
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  Series about(3 * size * size);
  std::vector<double> d(size);
  std::vector<double> cosines(this->Azimuths.size()), sines(this->Azimuths.size());
  for (int k = 0; k <= degree; ++k)
  {
    const WignerD functions(k, 0, degree);
    for (std::size_t a = 0; a < cosines.size(); ++a)
    {
      cosines[a] = this->Azimuths[a].Weight * std::cos(k * (this->Azimuths[a].Angle - azimuth));
      sines[a] = this->Azimuths[a].Weight * std::sin(k * (this->Azimuths[a].Angle - azimuth));
    }
    const std::size_t first = static_cast<std::size_t>(k);
    for (std::size_t p = 0; p < this->Polar.size(); ++p)
    {
      glm::dvec3 real(0.0), imaginary(0.0);
      for (std::size_t a = 0; a < cosines.size(); ++a)
      {
        real += cosines[a] * this->Kernel[p * cosines.size() + a];
        imaginary -= sines[a] * this->Kernel[p * cosines.size() + a];
      }
      functions.Evaluate(this->Polar[p].Angle, d.data());
      const double weight = this->Polar[p].Weight * std::sin(this->Polar[p].Angle);
      for (std::size_t c = 0; c < 3; ++c)
      {
        const std::complex<double> value(
          weight * real[static_cast<int>(c)], weight * imaginary[static_cast<int>(c)]);
        std::complex<double>* out = &about[(3 * first + c) * size];
        for (std::size_t l = first; l < size; ++l)
        {
          out[l] += value * d[l - first];
        }
      }
    }
  }
  return about;
}

std::vector<std::complex<float>> AnisotropicLobe::Expand(int degree, int orders) const
{
  // In a frame whose x points away from the axis' azimuth the axis is (-sin delta, 0, cos delta),
  // and the turn to it is one about y: b_lk = sum over k' of d^l_k'k(-delta) n_lk'.
  const glm::dvec3& axis = this->Means.Axis;
  const double azimuth = std::atan2(axis.y, axis.x) + Pi;
  const double delta = std::atan2(std::hypot(axis.x, axis.y), axis.z);
  const Series about = this->ExpandAboutNormal(degree, azimuth);
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  Series turned(3 * static_cast<std::size_t>(orders + 1) * size);
  std::vector<double> d(size);
  for (int k = 0; k <= orders; ++k)
  {
    for (int from = -degree; from <= degree; ++from)
    {
      const WignerD functions(k, from, degree); // d_k'k(-delta) = d_kk'(delta)
      functions.Evaluate(delta, d.data());
      const double sign = from < 0 && from % 2 != 0 ? -1.0 : 1.0; // n_l,-k = (-1)^k conj(n_lk)
      const std::size_t first = static_cast<std::size_t>(functions.GetFirst());
      for (std::size_t c = 0; c < 3; ++c)
      {
        const std::complex<double>* in =
          &about[(3 * static_cast<std::size_t>(std::abs(from)) + c) * size];
        std::complex<double>* out = &turned[(3 * static_cast<std::size_t>(k) + c) * size];
        for (std::size_t l = first; l < size; ++l)
        {
          out[l] += sign * d[l - first] * (from < 0 ? std::conj(in[l]) : in[l]);
        }
      }
    }
  }
  std::vector<std::complex<float>> result(turned.size());
  for (std::size_t n = 0; n < turned.size(); ++n)
  {
    const int channel = static_cast<int>(n / size % 3);
    const double k = static_cast<double>(n / size / 3);
    const double scale =
      this->Sum[channel] > 0.0 ? this->Means.Amplitude[channel] / this->Sum[channel] : 0.0;
    result[n] = std::complex<float>(
      scale * std::sqrt((2.0 * static_cast<double>(n % size) + 1.0) / (4.0 * Pi)) *
      std::polar(1.0, -k * azimuth) * turned[n]); // azimuths from the tangent again
  }
  return result;
}
} // namespace measuredbrdf
