// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeHarmonics.h"

#include "HalfVector.h" // for Pi
#include "LobeQuadrature.h"
#include "MatrixProduct.h"
#include "WignerD.h"
#include "WignerLanes.h"
#include "vtkBRDF.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
namespace
{
// Nodes that tell whether f is the same on both sides of the plane of incidence: one in so many.
constexpr std::size_t ProbeStride = 37;
constexpr double LargestAsymmetry = 1e-9; // of the value: less is rounding

glm::dvec3 Evaluate(vtkBRDF* brdf, const glm::dvec3& i, const glm::dvec3& o)
{
  glm::dvec3 f;
  brdf->Evaluate(&i.x, &o.x, &f.x);
  return f;
}

// Of a row of all polar nodes' sums.
std::size_t GetSumsWidth(std::size_t nodes) { return RoundUp(3 * nodes, ProductColumns); }

glm::dvec3 Mirror(const glm::dvec3& d) { return glm::dvec3(d.x, -d.y, d.z); }

glm::dvec3 MakeDirection(double polar, double azimuth)
{
  const double s = std::sin(polar);
  return glm::dvec3(s * std::cos(azimuth), s * std::sin(azimuth), std::cos(polar));
}

// Nearly all isotropic materials: half of the evaluations are enough then.
bool IsMirrored(vtkBRDF* brdf, const std::vector<LobeNode>& polar,
  const std::vector<LobeNode>& azimuths, const glm::dvec3& o)
{
  const std::size_t nodes = polar.size() * azimuths.size();
  for (std::size_t k = 0; k < nodes; k += ProbeStride)
  {
    const glm::dvec3 i =
      MakeDirection(polar[k / azimuths.size()].Angle, azimuths[k % azimuths.size()].Angle);
    const glm::dvec3 f = Evaluate(brdf, i, o);
    const glm::dvec3 difference = glm::abs(f - Evaluate(brdf, Mirror(i), o));
    if (glm::any(glm::greaterThan(difference, LargestAsymmetry * glm::abs(f))))
    {
      return false;
    }
  }
  return true;
}
}

LobeHarmonics::LobeHarmonics(vtkBRDF* brdf, double theta, int resolution, int cells)
{
  const glm::dvec3 o(std::sin(theta), 0.0, std::cos(theta));
  const LobeQuadrature quadrature(brdf, o, cells);
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

  const bool isMirrored = IsMirrored(brdf, this->Polar, this->Azimuths, o);
  for (const LobeNode& p : this->Polar)
  {
    for (const LobeNode& a : this->Azimuths)
    {
      const glm::dvec3 i = MakeDirection(p.Angle, a.Angle);
      glm::dvec3 f = Evaluate(brdf, i, o);
      if (!isMirrored)
      {
        f = 0.5 * (f + Evaluate(brdf, Mirror(i), o));
      }
      const glm::dvec3 rest = (f - this->Means.Floor) * i.z;
      this->Kernel.push_back(rest);
      const double weight = 2.0 * p.Weight * a.Weight * std::sin(p.Angle);
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

LobeHarmonics LobeHarmonics::GetOutside(const LampWindow& window, double delta) const
{
  LobeHarmonics outside = *this;
  const glm::dvec3 axis(-std::sin(delta), 0.0, std::cos(delta));
  std::size_t k = 0;
  for (const LobeNode& p : this->Polar)
  {
    for (const LobeNode& a : this->Azimuths)
    {
      const glm::dvec3 i = MakeDirection(p.Angle, a.Angle);
      outside.Kernel[k++] *= 1.0 - window.GetWeight(i, axis);
    }
  }
  return outside;
}

// Of four lobes at once, one in each lane: they share the functions' coefficients, and processors
// work on several numbers at a time.
struct LobeHarmonics::Lanes
{
  static constexpr std::size_t Count = WignerLanes::Count;
  using Values = WignerLanes::Values;

  std::array<const LobeHarmonics*, Count> Lobes;
  Values Delta;
  std::size_t Size; // degrees

  /// About the normal, where the horizon is a circle of latitude: azimuth series at each polar
  /// node, then over the polar angle. n_lk at (k * 3 + channel) * Size + l.
  std::vector<Values> ExpandAboutNormal() const;

  /// Then about the axis: the function seen from a frame turned by -delta about y (z towards -x).
  /// b_lk = sum over k' of d^l_k'k(-delta) n_lk'.
  std::vector<Values> Turn(const std::vector<Values>& about, int orders) const;

private:
  template <typename Pointer>
  std::array<Pointer, 3> GetChannels(Pointer values, int order) const
  {
    Pointer first = values + 3 * static_cast<std::size_t>(order) * this->Size;
    return { first, first + this->Size, first + 2 * this->Size };
  }
};

std::vector<LobeHarmonics::Lanes::Values> LobeHarmonics::Lanes::ExpandAboutNormal() const
{
  std::vector<Values> about(3 * this->Size * this->Size, Values{});
  std::size_t nodes = 0;
  std::array<std::vector<float>, Count> series;
  for (std::size_t lane = 0; lane < Count; ++lane)
  {
    nodes = std::max(nodes, this->Lobes[lane]->Polar.size());
    series[lane] = this->Lobes[lane]->SumAzimuths(this->Size);
  }
  std::vector<WignerLanes> angles;
  for (std::size_t p = 0; p < nodes; ++p)
  {
    Values theta{};
    for (std::size_t lane = 0; lane < Count; ++lane)
    {
      const std::vector<LobeNode>& polar = this->Lobes[lane]->Polar;
      theta[lane] = p < polar.size() ? polar[p].Angle : 0.0;
    }
    angles.emplace_back(theta);
  }
  for (std::size_t k = 0; k < this->Size; ++k)
  {
    const WignerD functions(static_cast<int>(k), 0, static_cast<int>(this->Size) - 1);
    const auto out = this->GetChannels(about.data(), static_cast<int>(k));
    for (std::size_t p = 0; p < nodes; ++p)
    {
      Values factors[3] = {};
      for (std::size_t lane = 0; lane < Count; ++lane)
      {
        const std::size_t count = this->Lobes[lane]->Polar.size();
        for (std::size_t c = 0; p < count && c < 3; ++c)
        {
          factors[c][lane] = static_cast<double>(series[lane][k * GetSumsWidth(count) + 3 * p + c]);
        }
      }
      angles[p].AddSeries(functions, factors, out);
    }
  }
  return about;
}

std::vector<LobeHarmonics::Lanes::Values> LobeHarmonics::Lanes::Turn(
  const std::vector<Values>& about, int orders) const
{
  const int degree = static_cast<int>(this->Size) - 1;
  std::vector<Values> turned(3 * static_cast<std::size_t>(orders + 1) * this->Size, Values{});
  Values theta;
  for (std::size_t lane = 0; lane < Count; ++lane)
  {
    theta[lane] = std::abs(this->Delta[lane]);
  }
  const WignerLanes angles(theta);
  for (int k = 0; k <= orders; ++k)
  {
    for (int from = -degree; from <= degree; ++from)
    {
      const WignerD functions(k, from, degree); // d_k'k(-delta) = d_kk'(delta)
      // d_mk(-x) = (-1)^(m-k) d_mk(x); n_l,-k = (-1)^k n_lk.
      Values sign;
      for (std::size_t lane = 0; lane < Count; ++lane)
      {
        const bool isTurned = (k - from) % 2 != 0 && this->Delta[lane] < 0.0;
        sign[lane] = isTurned != (from < 0 && from % 2 != 0) ? -1.0 : 1.0;
      }
      angles.AddTurned(functions, sign, this->GetChannels(about.data(), std::abs(from)),
        this->GetChannels(turned.data(), k));
    }
  }
  return turned;
}

// The polar nodes' series over the azimuths, with their weights, over the integral of the rest.
std::vector<float> LobeHarmonics::SumAzimuths(std::size_t orders) const
{
  const std::size_t azimuths = this->Azimuths.size();
  const std::size_t width = GetSumsWidth(this->Polar.size());
  std::vector<float> kernel(azimuths * width, 0.0f);
  for (std::size_t p = 0; p < this->Polar.size(); ++p)
  {
    const double weight = this->Polar[p].Weight * std::sin(this->Polar[p].Angle);
    for (std::size_t a = 0; a < azimuths; ++a)
    {
      for (int c = 0; c < 3; ++c)
      {
        kernel[a * width + 3 * p + static_cast<std::size_t>(c)] =
          this->Sum[c] > 0.0
            ? static_cast<float>(weight * this->Kernel[p * azimuths + a][c] / this->Sum[c])
            : 0.0f;
      }
    }
  }
  const std::size_t rows = RoundUp(orders, ProductRows);
  std::vector<float> cosines(rows * azimuths);
  for (std::size_t a = 0; a < azimuths; ++a)
  {
    const double once = std::cos(this->Azimuths[a].Angle);
    double before = once;
    double cosine = 1.0; // of k times the azimuth, after Chebyshev
    for (std::size_t k = 0; k < rows; ++k)
    {
      cosines[k * azimuths + a] = static_cast<float>(2.0 * this->Azimuths[a].Weight * cosine);
      const double next = 2.0 * once * cosine - before;
      before = cosine;
      cosine = next;
    }
  }
  std::vector<float> series(rows * width);
  Multiply(cosines.data(), kernel.data(), rows, azimuths, width, series.data());
  return series;
}

std::vector<std::vector<float>> LobeHarmonics::Expand(
  const std::vector<std::pair<const LobeHarmonics*, double>>& lobes, int degree, int orders)
{
  std::vector<std::vector<float>> results(lobes.size());
  const std::size_t blocks = (lobes.size() + Lanes::Count - 1) / Lanes::Count;
  const auto expand = [&](std::size_t first)
  {
    Lanes lanes;
    lanes.Size = static_cast<std::size_t>(degree) + 1;
    for (std::size_t lane = 0; lane < Lanes::Count; ++lane) // the last ones again, if too few
    {
      const auto& lobe = lobes[std::min(first + lane, lobes.size() - 1)];
      lanes.Lobes[lane] = lobe.first;
      lanes.Delta[lane] = lobe.second;
    }
    const std::vector<Lanes::Values> turned = lanes.Turn(lanes.ExpandAboutNormal(), orders);
    for (std::size_t k = first; k < std::min(first + Lanes::Count, lobes.size()); ++k)
    {
      results[k].reserve(turned.size());
      for (std::size_t n = 0; n < turned.size(); ++n)
      {
        const double l = static_cast<double>(n % lanes.Size);
        results[k].push_back(
          static_cast<float>(turned[n][k - first] * std::sqrt((2.0 * l + 1.0) / (4.0 * Pi))));
      }
    }
  };
  vtkSMPTools::For(0, static_cast<vtkIdType>(blocks), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType block = begin; block < end; ++block)
      {
        expand(Lanes::Count * static_cast<std::size_t>(block));
      }
    });
  return results;
}
} // namespace measuredbrdf
