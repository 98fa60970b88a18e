// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeHarmonics.h"

#include "HalfVector.h" // for Pi
#include "LightLanes.h"
#include "LobeQuadrature.h"
#include "MatrixProduct.h"
#include "ParallelFor.h"
#include "WignerD.h"
#include "WignerLanes.h"
#include "vtkBRDF.h"

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

// Lobes that are expanded together: they share functions, and take some megabytes each.
constexpr std::size_t MostTogether = 16;
constexpr int TurnedParts = 8;            // of the turn to the axis, which threads share
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

  const LightLanes lanes(brdf);
  const bool isMirrored = IsMirrored(brdf, this->Polar, this->Azimuths, o);
  std::vector<glm::dvec3> lights(this->Azimuths.size()), mirrored(lights.size()),
    values(lights.size()), others(lights.size());
  for (const LobeNode& p : this->Polar)
  {
    for (std::size_t k = 0; k < lights.size(); ++k)
    {
      lights[k] = MakeDirection(p.Angle, this->Azimuths[k].Angle);
    }
    lanes.Evaluate(lights.size(), lights.data(), o, values.data());
    if (!isMirrored)
    {
      std::transform(lights.begin(), lights.end(), mirrored.begin(), Mirror);
      lanes.Evaluate(lights.size(), mirrored.data(), o, others.data());
    }
    for (std::size_t k = 0; k < lights.size(); ++k)
    {
      const glm::dvec3 f = isMirrored ? values[k] : 0.5 * (values[k] + others[k]);
      const glm::dvec3 rest = (f - this->Means.Floor) * lights[k].z;
      this->Kernel.push_back(rest);
      const double weight = 2.0 * p.Weight * this->Azimuths[k].Weight * std::sin(p.Angle);
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

void LobeHarmonics::ForgetNodes()
{
  std::vector<LobeNode>().swap(this->Polar); // clear() would keep the memory
  std::vector<LobeNode>().swap(this->Azimuths);
  std::vector<glm::dvec3>().swap(this->Kernel);
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

  /// The lobes and their azimuth series from the first on; the last ones again, if too few.
  Lanes(const std::vector<std::pair<const LobeHarmonics*, double>>& lobes,
    const std::vector<std::vector<float>>& series, std::size_t first, std::size_t size);

  std::array<const LobeHarmonics*, Count> Lobes;
  std::array<const std::vector<float>*, Count> Series;
  Values Delta;
  WignerLanes Axes;                // by delta
  std::vector<WignerLanes> Angles; // polar nodes
  std::size_t Size;                // degrees

  /// About the normal, where the horizon is a circle of latitude: azimuth series at each polar
  /// node, then over the polar angle. n_lk at (k * 3 + channel) * Size + l, of one k. functions:
  /// of k and 0.
  void ExpandAboutNormal(const WignerD& functions, int k, std::vector<Values>& about) const;

  /// Then about the axis: the function seen from a frame turned by -delta about y (z towards -x).
  /// b_lk = sum over k' of d^l_k'k(-delta) n_lk'. Adds one of these, from. functions: of k and
  /// from, d_k'k(-delta) = d_kk'(delta).
  void Turn(const WignerD& functions, int k, int from, const std::vector<Values>& about,
    std::vector<Values>& turned) const;

private:
  std::vector<std::array<Values, 3>> GetFactors(int k) const;

  template <typename Pointer>
  std::array<Pointer, 3> GetChannels(Pointer values, int order) const
  {
    Pointer first = values + 3 * static_cast<std::size_t>(order) * this->Size;
    return { first, first + this->Size, first + 2 * this->Size };
  }
};

void LobeHarmonics::Lanes::ExpandAboutNormal(
  const WignerD& functions, int k, std::vector<Values>& about) const
{
  WignerLanes::AddSeries(
    functions, this->Angles, this->GetFactors(k), this->GetChannels(about.data(), k));
}

// Of each polar node: the channels' series, with the node's weight.
std::vector<std::array<WignerLanes::Values, 3>> LobeHarmonics::Lanes::GetFactors(int k) const
{
  std::vector<std::array<Values, 3>> factors(this->Angles.size());
  for (std::size_t lane = 0; lane < Count; ++lane)
  {
    const std::size_t nodes = this->Lobes[lane]->Polar.size();
    const float* const series =
      &(*this->Series[lane])[static_cast<std::size_t>(k) * GetSumsWidth(nodes)];
    for (std::size_t p = 0; p < factors.size(); ++p)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        factors[p][c][lane] = p < nodes ? static_cast<double>(series[3 * p + c]) : 0.0;
      }
    }
  }
  return factors;
}

void LobeHarmonics::Lanes::Turn(const WignerD& functions, int k, int from,
  const std::vector<Values>& about, std::vector<Values>& turned) const
{
  // d_mk(-x) = (-1)^(m-k) d_mk(x); n_l,-k = (-1)^k n_lk.
  Values sign;
  for (std::size_t lane = 0; lane < Count; ++lane)
  {
    const bool isTurned = (k - from) % 2 != 0 && this->Delta[lane] < 0.0;
    sign[lane] = isTurned != (from < 0 && from % 2 != 0) ? -1.0 : 1.0;
  }
  this->Axes.AddTurned(functions, sign, this->GetChannels(about.data(), std::abs(from)),
    this->GetChannels(turned.data(), k));
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
      cosines[a * rows + k] = static_cast<float>(2.0 * this->Azimuths[a].Weight * cosine);
      const double next = 2.0 * once * cosine - before;
      before = cosine;
      cosine = next;
    }
  }
  std::vector<float> series(rows * width);
  Multiply(
    { cosines.data(), rows }, { kernel.data(), width }, rows, azimuths, width, series.data());
  return series;
}

LobeHarmonics::Lanes::Lanes(const std::vector<std::pair<const LobeHarmonics*, double>>& lobes,
  const std::vector<std::vector<float>>& series, std::size_t first, std::size_t size)
  : Size(size)
{
  std::size_t nodes = 0;
  Values theta;
  for (std::size_t lane = 0; lane < Count; ++lane)
  {
    const std::size_t at = std::min(first + lane, lobes.size() - 1);
    this->Lobes[lane] = lobes[at].first;
    this->Series[lane] = &series[at];
    this->Delta[lane] = lobes[at].second;
    theta[lane] = std::abs(this->Delta[lane]);
    nodes = std::max(nodes, this->Lobes[lane]->Polar.size());
  }
  this->Axes = WignerLanes(theta);
  for (std::size_t p = 0; p < nodes; ++p)
  {
    for (std::size_t lane = 0; lane < Count; ++lane)
    {
      const std::vector<LobeNode>& polar = this->Lobes[lane]->Polar;
      theta[lane] = p < polar.size() ? polar[p].Angle : 0.0;
    }
    this->Angles.emplace_back(theta);
  }
}

std::vector<std::vector<float>> LobeHarmonics::ExpandLanes(
  const std::vector<Lanes>& blocks, int degree, int orders, std::size_t count)
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  const std::size_t kinds = 3 * static_cast<std::size_t>(orders + 1);
  std::vector<std::vector<Lanes::Values>> about(
    blocks.size(), std::vector<Lanes::Values>(3 * size * size));
  measuredbrdf::ParallelFor(0, degree + 1, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
      {
        const WignerD functions(k, 0, degree);
        for (std::size_t block = 0; block < blocks.size(); ++block)
        {
          blocks[block].ExpandAboutNormal(functions, k, about[block]);
        }
      }
    });
  // A part of the orders about the normal after the other, so that each is read once; sums of parts
  // do not depend on the threads.
  std::vector<std::vector<Lanes::Values>> turned(
    TurnedParts * blocks.size(), std::vector<Lanes::Values>(kinds * size));
  measuredbrdf::ParallelFor(0, TurnedParts, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int part = static_cast<int>(begin); part < static_cast<int>(end); ++part)
      {
        const std::size_t first = static_cast<std::size_t>(part) * blocks.size();
        for (int from = part; from <= degree; from += TurnedParts)
        {
          for (int n = 0; n <= 2 * orders + 1; ++n)
          {
            const int k = n / 2;
            const int signedFrom = n % 2 == 0 ? from : -from;
            if (n % 2 == 0 || from > 0)
            {
              const WignerD functions(k, signedFrom, degree);
              for (std::size_t block = 0; block < blocks.size(); ++block)
              {
                blocks[block].Turn(functions, k, signedFrom, about[block], turned[first + block]);
              }
            }
          }
        }
      }
    });
  std::vector<std::vector<float>> results(count, std::vector<float>(kinds * size));
  for (std::size_t k = 0; k < count; ++k)
  {
    for (std::size_t n = 0; n < results[k].size(); ++n)
    {
      const double l = static_cast<double>(n % size);
      double sum = 0.0;
      for (std::size_t part = 0; part < turned.size(); part += blocks.size())
      {
        sum += turned[part + k / Lanes::Count][n][k % Lanes::Count];
      }
      results[k][n] = static_cast<float>(sum * std::sqrt((2.0 * l + 1.0) / (4.0 * Pi)));
    }
  }
  return results;
}

std::vector<std::vector<float>> LobeHarmonics::Expand(
  const std::vector<std::pair<const LobeHarmonics*, double>>& lobes, int degree, int orders)
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  std::vector<std::vector<float>> series(lobes.size());
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(lobes.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (std::size_t k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      {
        series[k] = lobes[k].first->SumAzimuths(size);
      }
    });
  std::vector<std::vector<float>> results;
  for (std::size_t first = 0; first < lobes.size(); first += MostTogether)
  {
    const std::size_t count = std::min(MostTogether, lobes.size() - first);
    std::vector<Lanes> blocks;
    for (std::size_t k = 0; k < count; k += Lanes::Count)
    {
      blocks.emplace_back(lobes, series, first + k, size);
    }
    for (std::vector<float>& result : ExpandLanes(blocks, degree, orders, count))
    {
      results.push_back(std::move(result));
    }
  }
  return results;
}
} // namespace measuredbrdf
