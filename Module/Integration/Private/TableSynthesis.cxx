// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableSynthesis.h"

#include "AzimuthSeries.h"
#include "ClampedCosine.h"
#include "FieldSynthesis.h"
#include "HalfVector.h" // for Pi
#include "LobeHarmonics.h"
#include "LobePlacement.h"
#include "ParallelFor.h"
#include "RingLimiter.h"
#include "SharedExponent.h"
#include "TableTiles.h"

#include <Eigen/Core>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr float LeastPeak = 1e-30f; // of radiance: less is black

// What degrees may add at most, of the mean radiance, to be left out: a twentieth of the format's
// rounding.
constexpr double LeastShare = 1e-4;

// By channel and degree: the largest value that the environment's part of that degree can have in
// any direction about any axis, by Cauchy's inequality, over that of degree 0.
std::array<std::vector<double>, 3> GetStrengths(const EnvironmentHarmonics& light, int degree)
{
  std::array<std::vector<double>, 3> strengths;
  for (int channel = 0; channel < 3; ++channel)
  {
    for (int l = 0; l <= degree; ++l)
    {
      double sum = std::norm(light.Get(channel, l, 0));
      for (int m = 1; m <= l; ++m)
      {
        sum += 2.0 * std::norm(light.Get(channel, l, m));
      }
      strengths[static_cast<std::size_t>(channel)].push_back(std::sqrt(sum));
    }
  }
  return strengths;
}

// Kernels that see some light.
struct SeenLight
{
  const std::vector<std::vector<float>>& Kernels;
  std::array<std::vector<double>, 3> Strengths;
};

// The highest degree that one order needs: those above add next to nothing. Broad lobes have few.
int GetNeededDegree(const std::vector<SeenLight>& seen, int order, int degree)
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  int needed = order;
  for (std::size_t k = 0; k < 3 * seen[0].Kernels.size(); ++k)
  {
    const std::size_t kernel = k / 3;
    const std::size_t channel = k % 3;
    const auto sum = [&](std::size_t ofOrder, std::size_t l)
    {
      double all = 0.0;
      for (const SeenLight& light : seen)
      {
        const float of = light.Kernels[kernel][(3 * ofOrder + channel) * size + l];
        all += static_cast<double>(std::abs(of)) * light.Strengths[channel][l];
      }
      return all;
    };
    const double mean = sum(0, 0);
    double rest = 0.0; // 2 Re(e^(-i k psi) G_k)
    for (int l = degree; l > needed; --l)
    {
      rest += 2.0 * sum(static_cast<std::size_t>(order), static_cast<std::size_t>(l));
      if (rest > LeastShare * mean)
      {
        needed = l;
      }
    }
  }
  return std::min(needed, degree);
}

// One order's, by channel: degrees up to the last x view angles.
std::array<FieldSynthesis::Matrix, 3> PickOrder(
  const std::vector<std::vector<float>>& kernels, int order, int degree, int last)
{
  std::array<FieldSynthesis::Matrix, 3> matrices;
  for (int channel = 0; channel < 3; ++channel)
  {
    FieldSynthesis::Matrix& matrix = matrices[static_cast<std::size_t>(channel)];
    matrix.resize(last + 1, static_cast<Eigen::Index>(kernels.size()));
    for (std::size_t angle = 0; angle < kernels.size(); ++angle)
    {
      const std::size_t begin =
        static_cast<std::size_t>(3 * order + channel) * static_cast<std::size_t>(degree + 1);
      matrix.col(static_cast<Eigen::Index>(angle)) =
        Eigen::Map<const Eigen::VectorXf>(&kernels[angle][begin], last + 1);
    }
  }
  return matrices;
}
}

std::vector<std::vector<float>> ExpandTableKernels(MaterialPrecomputation& parts,
  const LobeViews& views, const MaterialPrecomputation::Kernels& knots, int degree, int orders,
  double smoothing, int rows, const LampWindow* window)
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  std::vector<float> smoothed;
  for (int l = 0; l <= degree; ++l)
  {
    smoothed.push_back(static_cast<float>(GetSmoothed(l, smoothing) * GetTaper(l, degree, rows)));
  }
  std::vector<std::pair<const LobeHarmonics*, double>> lobes;
  std::vector<LobeHarmonics> outside;
  outside.reserve(knots.size());
  for (std::size_t k = 0; window && k < knots.size(); ++k)
  {
    const double axis =
      views.GetAxis(LobeViews::GetKnotAngle(static_cast<int>(k), static_cast<int>(knots.size())));
    outside.push_back(knots[k]->GetOutside(*window, axis));
    lobes.emplace_back(&outside.back(), axis);
  }
  std::vector<std::vector<float>> kernels = window ? LobeHarmonics::Expand(lobes, degree, orders)
                                                   : parts.GetExpanded(knots, degree, orders);
  for (std::size_t k = 0; k < kernels.size(); ++k)
  {
    for (std::size_t b = 0; b < kernels[k].size(); ++b)
    {
      const int channel = static_cast<int>(b / size % 3);
      kernels[k][b] *=
        smoothed[b % size] * static_cast<float>(knots[k]->GetMeans().Amplitude[channel]);
    }
  }
  return kernels;
}

double PackRadiance(const std::vector<float>& radiance, RadianceTable::Texels& texels)
{
  float largest = LeastPeak;
  for (const float value : radiance)
  {
    largest = std::max(largest, value);
  }
  const float scale = LargestSharedExponent / largest;
  texels.resize(radiance.size() / 3);
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(texels.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (std::size_t k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      {
        texels[k] = PackSharedExponent(scale * glm::make_vec3(&radiance[3 * k]));
      }
    });
  return 1.0 / static_cast<double>(scale);
}

namespace
{
// RGB of a table's slices at nodes of a map of so many rows, with dark rings. None where goOn said
// false.
std::vector<float> SynthesizeMaps(MaterialPrecomputation& parts, const LobeViews& views,
  const TableLight& light, const MaterialPrecomputation::Kernels& knots, double smoothing,
  const MapPart& part, int degree, const std::function<bool(double)>& goOn,
  const RadianceTable& table)
{
  const int orders = table.Azimuths / 2; // as many as the azimuths can tell apart
  const int rows = part.GetAllRows();
  std::vector<std::vector<float>> kernels =
    ExpandTableKernels(parts, views, knots, degree, orders, smoothing, rows);
  // Lamps are what the one environment has more than the other: K rest + K_out (all - rest) =
  // (K - K_out) rest + K_out all. They are not smoothed: no maps add what they would lack.
  std::vector<std::vector<float>> outside;
  if (light.All)
  {
    outside = ExpandTableKernels(parts, views, knots, degree, orders, 0.0, rows, &light.Window);
    for (std::size_t k = 0; k < kernels.size(); ++k)
    {
      std::transform(kernels[k].begin(), kernels[k].end(), outside[k].begin(), kernels[k].begin(),
        std::minus<float>());
    }
  }
  AzimuthSeries series(table.Angles, table.Azimuths, part.GetNumberOfNodes());
  FieldSynthesis synthesis(light.Environment, part, MapNodes::Poles);
  std::array<FieldSynthesis::Field, 3> fields;
  std::vector<SeenLight> seen{ { kernels, GetStrengths(light.Environment, degree) } };
  if (light.All)
  {
    seen.push_back({ outside, GetStrengths(*light.All, degree) });
  }
  for (int order = 0; order <= orders; ++order)
  {
    const int last = GetNeededDegree(seen, order, degree);
    const FieldSynthesis::Kernels of = PickOrder(kernels, order, degree, last);
    if (light.All)
    {
      const FieldSynthesis::More more{ *light.All, PickOrder(outside, order, degree, last) };
      synthesis.Run(order, of, fields, &more);
    }
    else
    {
      synthesis.Run(order, of, fields);
    }
    series.Set(order, fields);
    if (!goOn((order + 1.0) / (orders + 1)))
    {
      return {};
    }
  }
  return series.TakeRadiance();
}

// How much of a sphere's disc is seen at each slice's view angle.
std::vector<double> GetSliceWeights(const RadianceTable& table)
{
  std::vector<double> weights;
  for (int k = 0; k < table.Angles; ++k)
  {
    const double theta = LobeViews::GetKnotAngle(k, table.Angles);
    const double before = LobeViews::GetKnotAngle(std::max(k - 1, 0), table.Angles);
    const double after = LobeViews::GetKnotAngle(std::min(k + 1, table.Angles - 1), table.Angles);
    const double weight = std::sin(theta) * std::cos(theta) * (after - before);
    weights.insert(weights.end(), static_cast<std::size_t>(table.Azimuths), weight);
    weights.push_back(0.0); // the first azimuth again
  }
  return weights;
}
}

double SynthesizeRadiance(MaterialPrecomputation& parts, const LobeViews& views,
  const TableLight& light, const MaterialPrecomputation::Kernels& knots, int degree,
  double smoothing, const std::function<bool(double)>& goOn, RadianceTable& table)
{
  const int fineRows = table.Tiles.FineRows;
  if (fineRows > 0) // the coarse map's kernels are a part of these
  {
    parts.GetExpanded(knots, degree, table.Azimuths / 2);
  }
  std::vector<float> radiance =
    SynthesizeMaps(parts, views, light, knots, smoothing, MapPart::OfAll(table.Rows, table.Columns),
      fineRows > 0 ? std::min(GetMapDegree(table.Rows), degree) : degree, goOn, table);
  if (radiance.empty())
  {
    return 0.0;
  }
  LiftDarkRings(
    radiance, static_cast<std::size_t>(table.Rows), static_cast<std::size_t>(table.Columns));
  if (fineRows > 0)
  {
    table.Tiles.Choose(radiance, GetSliceWeights(table));
    const MapPart nodes = table.Tiles.GetFineNodes();
    std::vector<float> fine;
    if (nodes.GetNumberOfNodes() > 0)
    {
      fine = SynthesizeMaps(parts, views, light, knots, smoothing, nodes, degree, goOn, table);
      if (fine.empty())
      {
        return 0.0;
      }
    }
    radiance = table.Tiles.Join(radiance, nodes, fine);
  }
  return PackRadiance(radiance, table.Radiance);
}

void MakeProfile(const LobeViews& views, const MaterialPrecomputation::Kernels& knots, double scale,
  RadianceTable& table)
{
  table.Profile.resize(3 * 3 * RadianceTable::ProfileSize);
  for (int k = 0; k < RadianceTable::ProfileSize; ++k)
  {
    const LobeMeans& lobe = views.GetViews()[static_cast<std::size_t>(k)].Means;
    const double theta = LobeViews::GetAngle(k);
    // Between the table's view angles both parts are interpolated, however steeply one hands over
    // to the other; what they miss of the directional albedo goes to the rest.
    const double w = LobeViews::GetKnotPosition(theta, table.Angles);
    const std::size_t low = std::min(static_cast<std::size_t>(w), knots.size() - 2);
    const double t = w - static_cast<double>(low);
    const LobeMeans& below = knots[low]->GetMeans();
    const LobeMeans& above = knots[low + 1]->GetMeans();
    const glm::dvec3 floor = glm::mix(below.Floor, above.Floor, t);
    const glm::dvec3 amplitude = glm::mix(below.Amplitude, above.Amplitude, t);
    glm::dvec3 share(0.0);
    for (int c = 0; c < 3; ++c)
    {
      const double wanted = lobe.Amplitude[c] + Pi * (lobe.Floor[c] - floor[c]);
      share[c] = amplitude[c] > 0.0 ? std::max(wanted, 0.0) / amplitude[c] : 0.0;
    }
    const glm::dvec3 rowsOf[3] = { { w, std::cos(lobe.Delta), std::sin(lobe.Delta) }, share * scale,
      floor };
    for (int row = 0; row < 3; ++row)
    {
      for (int c = 0; c < 3; ++c)
      {
        table.Profile[3 * static_cast<std::size_t>(row * RadianceTable::ProfileSize + k) +
                      static_cast<std::size_t>(c)] = static_cast<float>(rowsOf[row][c]);
      }
    }
    table.HasFloor = table.HasFloor || floor != glm::dvec3(0.0);
  }
}

// On the octahedral map's texels, between those of a map of rows that is twice as fine.
std::shared_ptr<const ScaledTexels> MakeIrradiance(const EnvironmentHarmonics& environment)
{
  FieldSynthesis::Matrix cosine(IrradianceDegree + 1, 1);
  for (int l = 0; l <= IrradianceDegree; ++l)
  {
    cosine(l, 0) = static_cast<float>(GetClampedCosine(l));
  }
  constexpr int side = RadianceTable::IrradianceSide;
  const int rows = 2 * side - 1;
  const int columns = 2 * (rows - 1);
  FieldSynthesis synthesis(environment, rows, columns, MapNodes::Poles);
  std::vector<float> map(3 * static_cast<std::size_t>(columns * rows));
  std::array<FieldSynthesis::Field, 3> fields;
  synthesis.Run(0, { cosine, cosine, cosine }, fields);
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    for (std::size_t texel = 0; texel < fields[channel].size(); ++texel)
    {
      map[3 * texel + channel] = fields[channel][texel].real();
    }
  }
  std::vector<float> values;
  for (int k = 0; k < side * side; ++k)
  {
    const glm::dvec2 place(k % side, k / side);
    const MapPosition at(GetOctahedralDirection(place / (side - 1.0)));
    const glm::vec3 value(GetMapValue(map, rows, columns, 0, at));
    values.insert(values.end(), { value.x, value.y, value.z });
  }
  auto irradiance = std::make_shared<ScaledTexels>();
  irradiance->Scale = static_cast<float>(PackRadiance(values, irradiance->Texels));
  return irradiance;
}

} // namespace measuredbrdf
