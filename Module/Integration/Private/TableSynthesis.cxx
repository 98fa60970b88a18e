// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableSynthesis.h"

#include "FieldSynthesis.h"
#include "Floats.h"
#include "HalfVector.h" // for Pi
#include "LobeHarmonics.h"
#include "LobePlacement.h"
#include "ParallelFor.h"
#include "RadianceTable.h"
#include "SynthesisLanes.h"

#include <Eigen/Core>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
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
void AzimuthSeries::Set(int order, const FieldSynthesis::Fields& fields, std::size_t firstAngle)
{
  const std::size_t texels = this->Size / 3;
  measuredbrdf::ParallelForEach(fields[0].size() / texels,
    [&](std::size_t angle)
    {
      const std::size_t slice = 2 * static_cast<std::size_t>(order) - (order > 0 ? 1 : 0);
      float* real = &this->Values[((firstAngle + angle) * this->GetSlices() + slice) * this->Size];
      float* imaginary = order > 0 ? real + this->Size : nullptr;
      for (std::size_t k = 0; k < this->Size; ++k)
      {
        const std::complex<float> value = fields[k % 3][angle * texels + k / 3];
        real[k] = value.real();
        if (imaginary)
        {
          imaginary[k] = value.imag();
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
      for (std::size_t k = begin; k < static_cast<std::size_t>(end); ++k)
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
      strengths[channel].push_back(std::sqrt(sum));
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

// One order's, up to a degree.
FieldSynthesis::Kernels PickOrder(
  const std::vector<std::vector<float>>& kernels, int order, int degree, int last)
{
  const Eigen::Index count = kernels.size();
  FieldSynthesis::Kernels picked(3 * count, last + 1);
  for (Eigen::Index row = 0; row < 3 * count; ++row)
  {
    const Eigen::Index begin = (3 * order + row / count) * (degree + 1);
    picked.row(row) = Eigen::Map<const Eigen::RowVectorXf>(&kernels[row % count][begin], last + 1);
  }
  return picked;
}
}

std::vector<std::vector<float>> ExpandTableKernels(MaterialKernels& knots, int degree, int orders,
  double smoothing, int rows, const LampWindow* window)
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  std::vector<float> smoothed;
  for (int l = 0; l <= degree; ++l)
  {
    smoothed.push_back(static_cast<float>(GetSmoothed(l, smoothing) * GetTaper(l, degree, rows)));
  }
  std::vector<TurnedLobe> lobes;
  std::vector<LobeKernel> outside;
  outside.reserve(knots.At.size());
  for (const LobeKernel& knot : knots.At)
  {
    if (window)
    {
      outside.push_back(knot.GetOutside(*window, knot.Means.Delta));
      lobes.push_back({ &outside.back(), knot.Means.Delta });
    }
  }
  std::vector<std::vector<float>> kernels =
    window ? ExpandLobes(lobes, degree, orders) : knots.Expand(degree, orders);
  for (std::size_t k = 0; k < kernels.size(); ++k)
  {
    for (std::size_t b = 0; b < kernels[k].size(); ++b)
    {
      const int channel = static_cast<int>(b / size % 3);
      kernels[k][b] *=
        smoothed[b % size] * static_cast<float>(knots.At[k].Means.Amplitude[channel]);
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
  measuredbrdf::ParallelForEach(
    texels.size(),
    [&](std::size_t k)
    { texels[k] = PackSharedExponent(scale * glm::make_vec3(&radiance[3 * k])); },
    nullptr, 0);
  return 1.0 / static_cast<double>(scale);
}

namespace
{
// RGB of a table's slices at nodes of a map of so many rows, with dark rings. None where goOn said
// false.
std::vector<float> SynthesizeMaps(const TableLight& light, MaterialKernels& knots, double smoothing,
  const MapPart& part, int degree, const std::function<bool(double)>& goOn,
  const RadianceTable& table)
{
  const int orders = table.Azimuths / 2; // as many as the azimuths can tell apart
  const int rows = part.GetAllRows();
  std::vector<std::vector<float>> kernels =
    ExpandTableKernels(knots, degree, orders, smoothing, rows);
  // Lamps are what the one environment has more than the other: K rest + K_out (all - rest) =
  // (K - K_out) rest + K_out all. They are not smoothed: no maps add what they would lack.
  std::vector<std::vector<float>> outside;
  if (light.All)
  {
    outside = ExpandTableKernels(knots, degree, orders, 0.0, rows, &light.Window);
    for (std::size_t k = 0; k < kernels.size(); ++k)
    {
      std::transform(kernels[k].begin(), kernels[k].end(), outside[k].begin(), kernels[k].begin(),
        std::minus<float>());
    }
  }
  AzimuthSeries series(table.Angles, table.Azimuths, part.GetNumberOfNodes());
  FieldSynthesis synthesis(part, MapNodes::Poles);
  FieldSynthesis::Fields fields;
  std::vector<SeenLight> seen{ { kernels, GetStrengths(light.Environment, degree) } };
  if (light.All)
  {
    seen.push_back({ outside, GetStrengths(*light.All, degree) });
  }
  for (int order = 0; order <= orders; ++order)
  {
    const int last = GetNeededDegree(seen, order, degree);
    std::vector<FieldSynthesis::Part> lit{ { light.Environment,
      PickOrder(kernels, order, degree, last) } };
    if (light.All)
    {
      lit.push_back({ *light.All, PickOrder(outside, order, degree, last) });
    }
    synthesis.Run(order, lit, fields);
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

double SynthesizeRadiance(const TableLight& light, MaterialKernels& knots, int degree,
  double smoothing, const std::function<bool(double)>& goOn, RadianceTable& table)
{
  const int fineRows = table.Tiles.FineRows;
  if (fineRows > 0) // the coarse map's kernels are a part of these
  {
    knots.Expand(degree, table.Azimuths / 2);
  }
  std::vector<float> radiance =
    SynthesizeMaps(light, knots, smoothing, MapPart(table.Rows, table.Columns),
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
      fine = SynthesizeMaps(light, knots, smoothing, nodes, degree, goOn, table);
      if (fine.empty())
      {
        return 0.0;
      }
    }
    radiance = table.Tiles.Join(radiance, nodes, fine);
  }
  return PackRadiance(radiance, table.Radiance);
}

bool PutProfile(const LobeMeans& lobe, const LobeMeans& between, const glm::dvec3& first,
  double scale, std::size_t at, std::vector<float>& profile)
{
  glm::dvec3 share(0.0);
  for (int c = 0; c < 3; ++c)
  {
    const double wanted = lobe.Amplitude[c] + Pi * (lobe.Floor[c] - between.Floor[c]);
    share[c] = between.Amplitude[c] > 0.0 ? std::max(wanted, 0.0) / between.Amplitude[c] : 0.0;
  }
  std::size_t out = 3 * at;
  for (const glm::dvec3& row : { first, share * scale, between.Floor })
  {
    for (int c = 0; c < 3; ++c)
    {
      profile[out + static_cast<std::size_t>(c)] = static_cast<float>(row[c]);
    }
    out += profile.size() / 3;
  }
  return between.Floor != glm::dvec3(0.0);
}

void MakeProfile(
  const LobeViews& views, const MaterialKernels& knots, double scale, RadianceTable& table)
{
  table.Profile.resize(3 * 3 * RadianceTable::ProfileSize);
  for (int k = 0; k < RadianceTable::ProfileSize; ++k)
  {
    const LobeMeans& lobe = views.GetViews()[k].Means;
    const double w = LobeViews::GetKnotPosition(LobeViews::GetAngle(k), table.Angles);
    const std::size_t low = std::min(static_cast<std::size_t>(w), knots.At.size() - 2);
    const double t = w - static_cast<double>(low);
    LobeMeans between;
    between.Add(knots.At[low].Means, 1.0 - t);
    between.Add(knots.At[low + 1].Means, t);
    const bool hasFloor =
      PutProfile(lobe, between, { w, std::cos(lobe.Delta), std::sin(lobe.Delta) }, scale,
        static_cast<std::size_t>(k), table.Profile);
    table.HasFloor = table.HasFloor || hasFloor;
  }
}

// On the octahedral map's texels, between those of a map of rows that is twice as fine.
std::shared_ptr<const ScaledTexels> MakeIrradiance(const EnvironmentHarmonics& environment)
{
  FieldSynthesis::Kernels cosine(3, IrradianceDegree + 1);
  for (int l = 0; l <= IrradianceDegree; ++l)
  {
    cosine.col(l).setConstant(static_cast<float>(GetClampedCosine(l)));
  }
  constexpr int side = RadianceTable::IrradianceSide;
  const int rows = 2 * side - 1;
  const int columns = 2 * (rows - 1);
  FieldSynthesis synthesis(MapPart(rows, columns), MapNodes::Poles);
  std::vector<float> map(3 * static_cast<std::size_t>(columns * rows));
  FieldSynthesis::Fields fields;
  synthesis.Run(0, { { environment, cosine } }, fields);
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
