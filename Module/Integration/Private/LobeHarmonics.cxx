// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeHarmonics.h"

#include "HalfVector.h" // for Pi
#include "LightLanes.h"
#include "LobeQuadrature.h"
#include "ParallelFor.h"
#include "SynthesisLanes.h"
#include "WignerD.h"
#include "vtkBRDF.h"

#include <Eigen/Core>

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

// Over [0, last], of the angle and the energy of each cell.
std::vector<LobeNode> MakeLobeNodes(
  const std::vector<glm::dvec2>& energy, double last, int resolution)
{
  constexpr int bins = 1024;
  Eigen::ArrayXd histogram = Eigen::ArrayXd::Zero(bins);
  for (const glm::dvec2& cell : energy)
  {
    histogram[std::clamp(static_cast<int>(cell.x / last * bins), 0, bins - 1)] += cell.y;
  }
  const double total = histogram.sum();
  // Cells are wider than bins: a few passes of a short filter close the gaps between them.
  for (int pass = 0; pass < 4; ++pass)
  {
    Eigen::ArrayXd padded(bins + 2);
    padded << histogram[0], histogram, histogram[bins - 1];
    histogram = 0.5 * histogram + 0.25 * (padded.head(bins) + padded.tail(bins));
  }
  std::vector<double> edges;
  const int intervals = std::max(resolution / 2, 1);
  double sum = 0.0;
  for (int k = 0; k < bins; ++k)
  {
    const double next = sum + (total > 0.0 ? 0.5 * histogram[k] / total : 0.5 / bins) + 0.5 / bins;
    while (static_cast<double>(edges.size()) < next * intervals)
    {
      edges.push_back(
        last * (k + (static_cast<double>(edges.size()) / intervals - sum) / (next - sum)) / bins);
    }
    sum = next;
  }
  edges.resize(intervals);
  edges.push_back(last);
  std::vector<LobeNode> nodes;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
  {
    const double middle = 0.5 * (edges[k] + edges[k + 1]);
    const double half = 0.5 * (edges[k + 1] - edges[k]);
    nodes.push_back({ middle - half / std::sqrt(3.0), half });
    nodes.push_back({ middle + half / std::sqrt(3.0), half });
  }
  return nodes;
}

// Of a row of all polar nodes' sums.
std::size_t GetSumsWidth(std::size_t nodes) { return RoundUp(3 * nodes, ProductColumns); }

glm::dvec3 Mirror(const glm::dvec3& d) { return glm::dvec3(d.x, -d.y, d.z); }

glm::dvec3 MakeDirection(double polar, double azimuth)
{
  const double s = std::sin(polar);
  return glm::dvec3(s * std::cos(azimuth), s * std::sin(azimuth), std::cos(polar));
}

// Whether f is, as of nearly all isotropic materials: half of the evaluations are enough then.
bool IsMirrored(vtkBRDF* brdf, const LobeKernel& lobe, const glm::dvec3& o)
{
  const std::size_t azimuths = lobe.Azimuths.size();
  for (std::size_t k = 0; k < lobe.Polar.size() * azimuths; k += ProbeStride)
  {
    const glm::dvec3 i =
      MakeDirection(lobe.Polar[k / azimuths].Angle, lobe.Azimuths[k % azimuths].Angle);
    const glm::dvec3 mirrored = Mirror(i);
    glm::dvec3 f, other;
    brdf->Evaluate(&i.x, &o.x, &f.x);
    brdf->Evaluate(&mirrored.x, &o.x, &other.x);
    if (glm::any(glm::greaterThan(glm::abs(f - other), LargestAsymmetry * glm::abs(f))))
    {
      return false;
    }
  }
  return true;
}
}

LobeKernel::LobeKernel(
  vtkBRDF* brdf, const glm::dvec3& o, int resolution, int cells, bool isSymmetric)
{
  const LobeQuadrature quadrature(brdf, o, cells);
  this->Means = LobeMeans(quadrature);
  std::vector<glm::dvec2> polar, azimuths;
  for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
  {
    const double energy = LobeQuadrature::GetEnergy(cell, this->Means.Floor);
    const glm::dvec3& d = cell.Direction;
    const double azimuth = std::atan2(d.y, d.x);
    polar.emplace_back(std::atan2(std::hypot(d.x, d.y), d.z), energy);
    azimuths.emplace_back(isSymmetric ? std::abs(azimuth) : azimuth + Pi, energy);
  }
  this->Polar = MakeLobeNodes(polar, Pi / 2.0, resolution);
  this->Azimuths = isSymmetric ? MakeLobeNodes(azimuths, Pi, resolution)
                               : MakeLobeNodes(azimuths, 2.0 * Pi, 2 * resolution);
  for (LobeNode& node : this->Azimuths)
  {
    node.Angle -= isSymmetric ? 0.0 : Pi;
    node.Weight *= isSymmetric ? 2.0 : 1.0;
  }

  const LightLanes lanes(brdf);
  const bool seesBothSides = isSymmetric && !IsMirrored(brdf, *this, o);
  std::vector<glm::dvec3> lights(this->Azimuths.size()), mirrored(lights.size()),
    values(lights.size()), others(lights.size());
  for (const LobeNode& p : this->Polar)
  {
    for (std::size_t k = 0; k < lights.size(); ++k)
    {
      lights[k] = MakeDirection(p.Angle, this->Azimuths[k].Angle);
    }
    lanes.Evaluate(lights.size(), lights.data(), o, values.data());
    if (seesBothSides)
    {
      std::transform(lights.begin(), lights.end(), mirrored.begin(), Mirror);
      lanes.Evaluate(lights.size(), mirrored.data(), o, others.data());
    }
    for (std::size_t k = 0; k < lights.size(); ++k)
    {
      const glm::dvec3 f = seesBothSides ? 0.5 * (values[k] + others[k]) : values[k];
      this->Rest.push_back((f - this->Means.Floor) * lights[k].z);
      this->Sum += this->Rest.back() * (p.Weight * this->Azimuths[k].Weight * std::sin(p.Angle));
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
  std::vector<LobeNode>().swap(this->Lobe.Polar); // clear() would keep the memory
  std::vector<LobeNode>().swap(this->Lobe.Azimuths);
  std::vector<glm::dvec3>().swap(this->Lobe.Rest);
}

LobeHarmonics LobeHarmonics::GetOutside(const LampWindow& window, double delta) const
{
  LobeHarmonics outside = *this;
  const glm::dvec3 axis(-std::sin(delta), 0.0, std::cos(delta));
  std::size_t k = 0;
  for (const LobeNode& p : this->Lobe.Polar)
  {
    for (const LobeNode& a : this->Lobe.Azimuths)
    {
      const glm::dvec3 i = MakeDirection(p.Angle, a.Angle);
      outside.Lobe.Rest[k++] *= 1.0 - window.GetWeight(i, axis);
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
    const std::size_t nodes = this->Lobes[lane]->Lobe.Polar.size();
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
  const std::size_t azimuths = this->Lobe.Azimuths.size();
  const std::size_t width = GetSumsWidth(this->Lobe.Polar.size());
  std::vector<float> kernel(azimuths * width, 0.0f);
  for (std::size_t p = 0; p < this->Lobe.Polar.size(); ++p)
  {
    const double weight = this->Lobe.Polar[p].Weight * std::sin(this->Lobe.Polar[p].Angle);
    for (std::size_t a = 0; a < azimuths; ++a)
    {
      for (int c = 0; c < 3; ++c)
      {
        kernel[a * width + 3 * p + static_cast<std::size_t>(c)] =
          this->Lobe.Sum[c] > 0.0
            ? static_cast<float>(weight * this->Lobe.Rest[p * azimuths + a][c] / this->Lobe.Sum[c])
            : 0.0f;
      }
    }
  }
  const std::size_t rows = RoundUp(orders, ProductRows);
  std::vector<float> cosines(rows * azimuths);
  for (std::size_t a = 0; a < azimuths; ++a)
  {
    const double once = std::cos(this->Lobe.Azimuths[a].Angle);
    double before = once;
    double cosine = 1.0; // of k times the azimuth, after Chebyshev
    for (std::size_t k = 0; k < rows; ++k)
    {
      cosines[a * rows + k] = static_cast<float>(this->Lobe.Azimuths[a].Weight * cosine);
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
    nodes = std::max(nodes, this->Lobes[lane]->Lobe.Polar.size());
  }
  this->Axes = WignerLanes(theta);
  for (std::size_t p = 0; p < nodes; ++p)
  {
    for (std::size_t lane = 0; lane < Count; ++lane)
    {
      const std::vector<LobeNode>& polar = this->Lobes[lane]->Lobe.Polar;
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
  measuredbrdf::ParallelForEach(degree + 1,
    [&](int k)
    {
      const WignerD functions(k, 0, degree);
      for (std::size_t block = 0; block < blocks.size(); ++block)
      {
        blocks[block].ExpandAboutNormal(functions, k, about[block]);
      }
    });
  // A part of the orders about the normal after the other, so that each is read once; sums of parts
  // do not depend on the threads.
  std::vector<std::vector<Lanes::Values>> turned(
    TurnedParts * blocks.size(), std::vector<Lanes::Values>(kinds * size));
  measuredbrdf::ParallelForEach(TurnedParts,
    [&](int part)
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
  measuredbrdf::ParallelForEach(
    lobes.size(), [&](std::size_t k) { series[k] = lobes[k].first->SumAzimuths(size); });
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

// Where the horizon is a circle of latitude: azimuth series at each polar node, then over the polar
// angle. Azimuths count from the given one. At (k * 3 + channel) * size + l.
AnisotropicLobe::Series AnisotropicLobe::ExpandAboutNormal(int degree, double azimuth) const
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  Series about(3 * size * size);
  std::vector<double> d(size);
  std::vector<double> cosines(this->Lobe.Azimuths.size()), sines(this->Lobe.Azimuths.size());
  for (int k = 0; k <= degree; ++k)
  {
    const WignerD functions(k, 0, degree);
    for (std::size_t a = 0; a < cosines.size(); ++a)
    {
      cosines[a] =
        this->Lobe.Azimuths[a].Weight * std::cos(k * (this->Lobe.Azimuths[a].Angle - azimuth));
      sines[a] =
        this->Lobe.Azimuths[a].Weight * std::sin(k * (this->Lobe.Azimuths[a].Angle - azimuth));
    }
    const std::size_t first = k;
    for (std::size_t p = 0; p < this->Lobe.Polar.size(); ++p)
    {
      glm::dvec3 real(0.0), imaginary(0.0);
      for (std::size_t a = 0; a < cosines.size(); ++a)
      {
        real += cosines[a] * this->Lobe.Rest[p * cosines.size() + a];
        imaginary -= sines[a] * this->Lobe.Rest[p * cosines.size() + a];
      }
      functions.Evaluate(this->Lobe.Polar[p].Angle, d.data());
      const double weight = this->Lobe.Polar[p].Weight * std::sin(this->Lobe.Polar[p].Angle);
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
  const glm::dvec3& axis = this->Lobe.Means.Axis;
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
      const std::size_t first = functions.GetFirst();
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
    const double scale = this->Lobe.Sum[channel] > 0.0
                           ? this->Lobe.Means.Amplitude[channel] / this->Lobe.Sum[channel]
                           : 0.0;
    result[n] = std::complex<float>(
      scale * std::sqrt((2.0 * static_cast<double>(n % size) + 1.0) / (4.0 * Pi)) *
      std::polar(1.0, -k * azimuth) * turned[n]); // azimuths from the tangent again
  }
  return result;
}
} // namespace measuredbrdf
