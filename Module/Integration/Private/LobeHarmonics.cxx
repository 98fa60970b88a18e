// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeHarmonics.h"

#include "HalfVector.h" // for Pi
#include "LightLanes.h"
#include "LobeViews.h"
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

void LobeKernel::ForgetNodes()
{
  std::vector<LobeNode>().swap(this->Polar); // clear() would keep the memory
  std::vector<LobeNode>().swap(this->Azimuths);
  std::vector<glm::dvec3>().swap(this->Rest);
}

LobeKernel LobeKernel::GetOutside(double delta) const
{
  LobeKernel outside = *this;
  const glm::dvec3 axis(-std::sin(delta), 0.0, std::cos(delta));
  std::size_t k = 0;
  for (const LobeNode& p : this->Polar)
  {
    for (const LobeNode& a : this->Azimuths)
    {
      outside.Rest[k++] *= 1.0 - LampWindow::GetWeight(MakeDirection(p.Angle, a.Angle), axis);
    }
  }
  return outside;
}

namespace
{
// The polar nodes' series of cosines or sines over the azimuths, with their weights, over the
// integral of the rest: orders x GetSumsWidth.
std::vector<float> SumAzimuths(const TurnedLobe& lobe, std::size_t orders)
{
  const LobeKernel& kernel = *lobe.Kernel;
  const std::size_t azimuths = kernel.Azimuths.size();
  const std::size_t width = GetSumsWidth(kernel.Polar.size());
  std::vector<float> rest(azimuths * width, 0.0f);
  for (std::size_t p = 0; p < kernel.Polar.size(); ++p)
  {
    const double weight = kernel.Polar[p].Weight * std::sin(kernel.Polar[p].Angle);
    for (std::size_t a = 0; a < azimuths; ++a)
    {
      for (int c = 0; c < 3; ++c)
      {
        rest[a * width + 3 * p + c] =
          kernel.Sum[c] > 0.0
            ? static_cast<float>(weight * kernel.Rest[p * azimuths + a][c] / kernel.Sum[c])
            : 0.0f;
      }
    }
  }
  const std::size_t rows = RoundUp(orders, ProductRows);
  std::vector<float> turns(rows * azimuths);
  for (std::size_t a = 0; a < azimuths; ++a)
  {
    const double azimuth = kernel.Azimuths[a].Angle - lobe.Azimuth;
    const double once = std::cos(azimuth);
    double before = lobe.IsOdd ? -std::sin(azimuth) : once;
    double turn = lobe.IsOdd ? 0.0 : 1.0; // cosine or sine of k times the azimuth, after Chebyshev
    for (std::size_t k = 0; k < rows; ++k)
    {
      turns[a * rows + k] = static_cast<float>(kernel.Azimuths[a].Weight * turn);
      const double next = 2.0 * once * turn - before;
      before = turn;
      turn = next;
    }
  }
  std::vector<float> series(rows * width);
  Multiply({ turns.data(), rows }, { rest.data(), width }, rows, azimuths, width, series.data());
  return series;
}

// Of four lobes at once, one in each lane: they share the functions' coefficients, and processors
// work on several numbers at a time.
struct LobeLanes
{
  static constexpr std::size_t Count = WignerLanes::Count;
  using Values = WignerLanes::Values;

  // The lobes and their azimuth series from the first on; the last ones again, if too few.
  LobeLanes(const std::vector<TurnedLobe>& lobes, const std::vector<std::vector<float>>& series,
    std::size_t first, std::size_t size)
    : Size(size)
  {
    std::size_t nodes = 0;
    Values theta;
    for (std::size_t lane = 0; lane < Count; ++lane)
    {
      const std::size_t at = std::min(first + lane, lobes.size() - 1);
      this->Lobes[lane] = lobes[at];
      this->Series[lane] = &series[at];
      theta[lane] = std::abs(lobes[at].Delta);
      nodes = std::max(nodes, lobes[at].Kernel->Polar.size());
    }
    this->Axes = WignerLanes(theta);
    for (std::size_t p = 0; p < nodes; ++p)
    {
      for (std::size_t lane = 0; lane < Count; ++lane)
      {
        const std::vector<LobeNode>& polar = this->Lobes[lane].Kernel->Polar;
        theta[lane] = p < polar.size() ? polar[p].Angle : 0.0;
      }
      this->Angles.emplace_back(theta);
    }
  }

  // About the normal, where the horizon is a circle of latitude: azimuth series at each polar node,
  // then over the polar angle. n_lk at (k * 3 + channel) * Size + l, of one k. functions: of k and
  // 0.
  void ExpandAboutNormal(const WignerD& functions, int k, std::vector<Values>& about) const
  {
    std::vector<std::array<Values, 3>> factors(this->Angles.size());
    for (std::size_t lane = 0; lane < Count; ++lane)
    {
      const std::size_t nodes = this->Lobes[lane].Kernel->Polar.size();
      const float* const series = &(*this->Series[lane])[k * GetSumsWidth(nodes)];
      for (std::size_t p = 0; p < factors.size(); ++p)
      {
        for (std::size_t c = 0; c < 3; ++c)
        {
          factors[p][c][lane] = p < nodes ? static_cast<double>(series[3 * p + c]) : 0.0;
        }
      }
    }
    WignerLanes::AddSeries(functions, this->Angles, factors, this->GetChannels(about.data(), k));
  }

  // Then about the axis: the function seen from a frame turned by -delta about y (z towards -x).
  // b_lk = sum over k' of d^l_k'k(-delta) n_lk'. Adds one of these, from. functions: of k and
  // from, d_k'k(-delta) = d_kk'(delta).
  void Turn(const WignerD& functions, int k, int from, const std::vector<Values>& about,
    std::vector<Values>& turned) const
  {
    // d_mk(-x) = (-1)^(m-k) d_mk(x); n_l,-k = (-1)^k conj(n_lk), where odd parts are imaginary.
    Values sign;
    for (std::size_t lane = 0; lane < Count; ++lane)
    {
      const bool isTurned = (k - from) % 2 != 0 && this->Lobes[lane].Delta < 0.0;
      const bool isMirrored = from < 0 && (from % 2 != 0) != this->Lobes[lane].IsOdd;
      sign[lane] = isTurned != isMirrored ? -1.0 : 1.0;
    }
    this->Axes.AddTurned(functions, sign, this->GetChannels(about.data(), std::abs(from)),
      this->GetChannels(turned.data(), k));
  }

private:
  template <typename Pointer>
  std::array<Pointer, 3> GetChannels(Pointer values, int order) const
  {
    Pointer first = values + 3 * order * this->Size;
    return { first, first + this->Size, first + 2 * this->Size };
  }

  std::array<TurnedLobe, Count> Lobes;
  std::array<const std::vector<float>*, Count> Series;
  WignerLanes Axes;                // by delta
  std::vector<WignerLanes> Angles; // polar nodes
  std::size_t Size;                // degrees
};

std::vector<std::vector<float>> ExpandLanes(
  const std::vector<LobeLanes>& blocks, int degree, int orders, std::size_t count)
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  const std::size_t kinds = 3 * static_cast<std::size_t>(orders + 1);
  std::vector<std::vector<LobeLanes::Values>> about(
    blocks.size(), std::vector<LobeLanes::Values>(3 * size * size));
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
  std::vector<std::vector<LobeLanes::Values>> turned(
    TurnedParts * blocks.size(), std::vector<LobeLanes::Values>(kinds * size));
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
        sum += turned[part + k / LobeLanes::Count][n][k % LobeLanes::Count];
      }
      results[k][n] = static_cast<float>(sum * std::sqrt((2.0 * l + 1.0) / (4.0 * Pi)));
    }
  }
  return results;
}
}

std::vector<std::vector<float>> ExpandLobes(
  const std::vector<TurnedLobe>& lobes, int degree, int orders)
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  std::vector<std::vector<float>> series(lobes.size());
  measuredbrdf::ParallelForEach(
    lobes.size(), [&](std::size_t k) { series[k] = SumAzimuths(lobes[k], size); });
  std::vector<std::vector<float>> results;
  for (std::size_t first = 0; first < lobes.size(); first += MostTogether)
  {
    const std::size_t count = std::min(MostTogether, lobes.size() - first);
    std::vector<LobeLanes> blocks;
    for (std::size_t k = 0; k < count; k += LobeLanes::Count)
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

std::vector<std::vector<std::complex<float>>> ExpandAnisotropicLobes(
  const std::vector<LobeKernel>& kernels, int degree, int orders)
{
  // In a frame whose x points away from the axis' azimuth the axis is (-sin delta, 0, cos delta).
  std::vector<TurnedLobe> lobes;
  for (const LobeKernel& kernel : kernels)
  {
    const glm::dvec3& axis = kernel.Means.Axis;
    const double delta = std::atan2(std::hypot(axis.x, axis.y), axis.z);
    const double azimuth = std::atan2(axis.y, axis.x) + Pi;
    lobes.push_back({ &kernel, delta, azimuth, false });
    lobes.push_back({ &kernel, delta, azimuth, true });
  }
  const std::vector<std::vector<float>> parts = ExpandLobes(lobes, degree, orders);
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  std::vector<std::vector<std::complex<float>>> results(kernels.size());
  for (std::size_t lobe = 0; lobe < kernels.size(); ++lobe)
  {
    for (std::size_t n = 0; n < parts[2 * lobe].size(); ++n)
    {
      const std::complex<double> about(parts[2 * lobe][n], -parts[2 * lobe + 1][n]);
      const double amplitude = kernels[lobe].Means.Amplitude[n / size % 3];
      const double k = n / size / 3;
      results[lobe].emplace_back(amplitude * std::polar(1.0, -k * lobes[2 * lobe].Azimuth) *
                                 about); // from the tangent again
    }
  }
  return results;
}
} // namespace measuredbrdf
