// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTabulatedBRDF.h"

#include "Floats.h"
#include "HalfVector.h"
#include "LaneMath.h"
#include "LocalFrame.h"
#include "ModuleShader.h"
#include "Neighbors.h"
#include "NumberText.h"
#include "OneByOne.h"
#include "ParallelFor.h"
#include "Refusal.h"
#include "Setters.h"
#include "VolumeInterpolation.h"
#include "ZonalKernel.h"
#include "vtkBRDFAnisotropicTable.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFHalfDifference.h"
#include "vtkBRDFHalfDifferenceSoft.h"
#include "vtkBRDFIncidentOutgoing.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/type_ptr.hpp>
#include <glm/gtx/rotate_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <numeric>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkTabulatedBRDF);

namespace
{
// How textures store a table's values.
struct Storage
{
  bool SharedExponents = false;
  bool HalfFloat = false;
  float Scale = 1.0f; // of values that are stored
  double Rounding = FloatRounding;
  const char* Text = "32-bit float";
};

constexpr double SharedRounding = 1.0 / 512.0; // of the largest channel

// precision: a vtkTabulatedBRDF::PrecisionType; tolerance: of resampling, of which rounding may
// take a quarter; volume: RGB, NaN where a cell is invalid.
Storage ChooseStorage(int precision, double tolerance, const std::vector<float>& volume)
{
  const bool mayBeShared =
    precision == vtkTabulatedBRDF::SHARED_EXPONENT && 4.0 * SharedRounding <= tolerance &&
    std::all_of(volume.begin(), volume.end(), [](float v) { return v >= 0.0f; });
  if (mayBeShared)
  {
    return { true, false, GetPeakScale(volume), SharedRounding, "9 bits and a shared exponent" };
  }
  const bool mayBeHalf =
    precision == vtkTabulatedBRDF::FLOAT16 ||
    (precision != vtkTabulatedBRDF::FLOAT32 && 4.0 * HalfRounding <= tolerance);
  return mayBeHalf ? Storage{ false, true, GetPeakScale(volume), HalfRounding, "16-bit float" }
                   : Storage();
}

// Invalid cells are premultiplied away: the filter then skips them as Evaluate does.
void FillTexture(
  vtkBRDFShaderInputs::Texture& texture, const std::vector<float>& volume, const Storage& storage)
{
  texture.HalfFloat = storage.HalfFloat;
  for (std::size_t k = 0; k < volume.size(); k += 3)
  {
    const bool isValid = !std::isnan(volume[k]);
    const glm::vec3 color = isValid ? storage.Scale * glm::make_vec3(&volume[k]) : glm::vec3(0.0f);
    if (storage.SharedExponents)
    {
      texture.SharedExponents.push_back(PackSharedExponent(color));
      continue;
    }
    texture.Data.insert(texture.Data.end(), { color.x, color.y, color.z });
    if (texture.Components == 4)
    {
      texture.Data.push_back(isValid ? 1.0f : 0.0f);
    }
  }
}

// RGB times validity, validity (0 or 1); sums of such cells.
using Cell = glm::vec4;

// A mean over valid cells.
Cell Normalized(const Cell& sum)
{
  constexpr float least = 1e-4f; // fewer of the weights on valid cells are no value
  return sum.w > least ? sum / sum.w : Cell(0.0f);
}

// The volume averaged to width x height samples of phi_d and theta_d: measured noise is, too.
std::vector<Cell> AverageCells(
  const int dimensions[3], const std::vector<float>& volume, int width, int height)
{
  // What part of sample k of `from` lies in sample j of `to` <= from, in units of the latter.
  const auto getOverlap = [](int k, int from, int j, int to)
  {
    const float scale = static_cast<float>(to) / from;
    return std::max(std::min((k + 1) * scale, j + 1.0f) - std::max(k * scale, j + 0.0f), 0.0f);
  };
  std::vector<Cell> cells;
  for (int cell = 0; cell < width * height * dimensions[2]; ++cell)
  {
    const int x = cell % width, y = cell / width % height, z = cell / width / height;
    const int bottom = ((y + 1) * dimensions[1] + height - 1) / height;
    const int right = ((x + 1) * dimensions[0] + width - 1) / width;
    Cell sum(0.0f);
    for (int b = y * dimensions[1] / height; b < bottom; ++b)
    {
      for (int a = x * dimensions[0] / width; a < right; ++a)
      {
        const float* v = &volume[3 * (a + std::size_t(dimensions[0]) * (b + dimensions[1] * z))];
        if (!std::isnan(v[0]))
        {
          sum += getOverlap(a, dimensions[0], x, width) * getOverlap(b, dimensions[1], y, height) *
                 Cell(glm::make_vec3(v), 1.0f);
        }
      }
    }
    cells.push_back(Normalized(sum));
  }
  return cells;
}

// Variance of the Gaussian lobe with the width at half the height of the volume's, seen from within
// 45 degrees of h, where every theta_h up to 45 degrees is above the horizon.
double FindLobeVariance(const std::vector<Cell>& cells, int width, int height, int nThetaH)
{
  std::vector<double> profile;
  for (int z = 0; z < nThetaH; ++z)
  {
    const auto first = cells.begin() + std::ptrdiff_t(z) * width * height;
    const Cell sum = std::accumulate(first, first + width * ((height + 1) / 2), Cell(0.0f));
    profile.push_back(
      sum.w > 0.0f ? (double(sum.x) + sum.y + sum.z) / sum.w : (z > 0 ? profile.back() : 0.0));
  }
  const double middle = 0.5 * (profile[0] + *std::min_element(profile.begin(), profile.end()));
  for (int z = 1; z < nThetaH; ++z)
  {
    const double above = profile[z - 1], below = profile[z];
    if (below <= middle && above > middle)
    {
      const double theta = UnitToThetaH((z - 0.5 + (above - middle) / (above - below)) / nThetaH);
      return std::clamp(theta * theta / (2.0 * std::log(2.0)), 1e-6, 1.0);
    }
  }
  return 1.0;
}

// Weights of the n samples along theta_h in the mean about angle a; they sum to 1. The samples
// stand for their linear interpolation, in steps fine enough for the kernel.
std::vector<double> GetRingWeights(double a, int n, double variance)
{
  const double reach = GetRingReach(variance);
  std::vector<double> weights(n, 0.0);
  for (int k = 0; k <= n; ++k) // between samples k - 1 and k
  {
    const double low = std::max(k - 0.5, 0.0) / n;
    const double high = std::min(k + 0.5, n + 0.0) / n;
    const double width = UnitToThetaH(high) - UnitToThetaH(low);
    if (UnitToThetaH(high) < a - reach || UnitToThetaH(low) > a + reach)
    {
      continue;
    }
    const int steps = 2 + static_cast<int>(4.0 * width / std::sqrt(variance));
    for (int step = 0; step < steps; ++step)
    {
      const double u = low + (high - low) * (step + 0.5) / steps;
      // d theta = pi u du
      const double weight = GetRingWeight(a, UnitToThetaH(u), variance) * u * (high - low) / steps;
      const Neighbors t = ClampedNeighbors(u, n);
      weights[t.First] += weight * (1.0 - t.Weight);
      weights[t.Second] += weight * t.Weight;
    }
  }
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights)
  {
    weight /= total;
  }
  return weights;
}
}

//------------------------------------------------------------------------------
/**
 * A half/difference volume at growing widths along theta_h, for soft lights.
 *
 * Level k is the volume's values, for every phi_d and theta_d, convolved over the sphere of half
 * vectors with a von Mises-Fisher distribution of variance (1/kappa) s (2^k - 1), s the variance of
 * the volume's own lobe: each level is twice as wide (in variance) as the one before. Between
 * levels: linear. Level 0 is the volume itself and not held here.
 *
 * Wide levels need few samples: four levels have the same number along theta_h, the next four
 * half of it; phi_d and theta_d are averaged to steps of at least 5 and 2 degrees. The levels are
 * stacked along theta_h in one volume.
 */
struct vtkTabulatedBRDF::Levels
{
  void Make(const vtkTabulatedBRDF& table)
  {
    // Samples along theta_h for a lobe of variance 1; the square root's spacing needs as many more
    // as the fourth root of the variance is smaller.
    constexpr double countOfUnitVariance = 8.0;
    const int* dimensions = table.Dimensions;
    const int width = std::min(dimensions[0], table.AzimuthRange == HALF_TURN ? 36 : 72);
    const int height = std::min(dimensions[1], 45);
    const std::vector<Cell> cells = AverageCells(dimensions, table.Volume, width, height);
    this->OwnVariance = FindLobeVariance(cells, width, height, dimensions[2]);
    this->Count = static_cast<int>(std::ceil(std::log2(1.0 + 1.0 / this->OwnVariance)));
    const int wanted =
      static_cast<int>(std::ceil(countOfUnitVariance * std::pow(2.0 * this->OwnVariance, -0.25)));
    const int multiple = 1 << ((this->Count - 1) / 4);
    this->FirstSamples = (std::min(wanted, dimensions[2]) + multiple - 1) / multiple * multiple;
    this->Dimensions = { width, height,
      this->GetOffset(this->Count) + this->GetSamples(this->Count) };
    this->Volume.clear(); // of a try that failed
    std::vector<Cell> sums(std::size_t(width) * height);
    for (int level = 1; level <= this->Count; ++level)
    {
      const double variance = this->OwnVariance * (std::exp2(level) - 1.0);
      for (int k = 0; k < this->GetSamples(level); ++k)
      {
        const double theta = UnitToThetaH((k + 0.5) / this->GetSamples(level));
        const std::vector<double> weights = GetRingWeights(theta, dimensions[2], variance);
        std::fill(sums.begin(), sums.end(), Cell(0.0f));
        for (std::size_t z = 0; z < weights.size(); ++z)
        {
          for (std::size_t j = 0; weights[z] > 0.0 && j < sums.size(); ++j)
          {
            sums[j] += static_cast<float>(weights[z]) * cells[sums.size() * z + j];
          }
        }
        for (const Cell& sum : sums)
        {
          const Cell mean = Normalized(sum);
          const glm::vec3 rgb =
            mean.w > 0.0f ? glm::vec3(mean) : glm::vec3(std::numeric_limits<float>::quiet_NaN());
          this->Volume.insert(this->Volume.end(), { rgb.x, rgb.y, rgb.z });
        }
      }
    }
  }

  int GetSamples(int level) const { return this->FirstSamples >> ((level - 1) / 4); }

  // Four levels of each number of samples, which halves: 4 (n + n/2 + ...) = 8 (n - samples).
  int GetOffset(int level) const
  {
    const int samples = this->GetSamples(level);
    return 8 * (this->FirstSamples - samples) + (level - 1) % 4 * samples;
  }

  // The levels around a variance >= 0 in h.
  Neighbors FindLevels(double variance) const
  {
    const double level =
      std::min(std::log1p(variance / this->OwnVariance) / std::log(2.0), this->Count + 0.0);
    const int first = std::min(static_cast<int>(level), this->Count - 1);
    return { first, first + 1, level - first };
  }

  // What surrounds coordinates in a level of the table.
  VolumeSum Gather(const vtkTabulatedBRDF& table, int level, const glm::dvec3& u) const
  {
    if (level == 0)
    {
      return GatherCorners<3>(
        table.Volume, table.Dimensions, FindHalfDifferenceCorners(u, table.Dimensions));
    }
    Neighbors z = ClampedNeighbors(u.z, this->GetSamples(level));
    z.First += this->GetOffset(level);
    z.Second += this->GetOffset(level);
    return GatherCorners<3>(this->Volume, this->Dimensions.data(),
      { PeriodicNeighbors(u.x, this->Dimensions[0]), ClampedNeighbors(u.y, this->Dimensions[1]),
        z });
  }

  std::once_flag Made;  // by the first of many threads that asks
  int Count = 1;        // without level 0; 1 to 20
  int FirstSamples = 1; // of level 1 along theta_h
  double OwnVariance = 1.0;
  std::array<int, 3> Dimensions = { 0, 0, 0 };
  std::vector<float> Volume; // RGB triples, NaN: invalid
};

namespace
{
// The mirror-symmetric azimuth of incident/outgoing tables ends at 0 and pi, all others close.
bool HasPeriodicAzimuth(int parameterization, int azimuthRange)
{
  return parameterization != vtkTabulatedBRDF::INCIDENT_OUTGOING ||
         azimuthRange == vtkTabulatedBRDF::FULL_TURN;
}

double GetLargestAzimuth(int azimuthRange)
{
  return azimuthRange == vtkTabulatedBRDF::HALF_TURN ? Pi : 2.0 * Pi;
}

constexpr int MostSamples = 2048; // along an axis of the texture
constexpr std::size_t MostAnisotropicCells = std::size_t(1) << 26;

// Returns how many values a table of the shape has. Throws what is wrong with the shape.
std::size_t CountValues(int axes, const int* dimensions, int azimuthRange)
{
  std::size_t cells = 1;
  for (int axis = 0; axis < axes; ++axis)
  {
    Require(dimensions[axis] >= 1 && dimensions[axis] <= MostSamples,
      "found " + std::to_string(dimensions[axis]) + " samples along axis " + std::to_string(axis) +
        ", expected 1 to " + std::to_string(MostSamples));
    cells *= static_cast<std::size_t>(dimensions[axis]);
  }
  Require(
    axes < 4 || (dimensions[1] * dimensions[2] <= MostSamples && cells <= MostAnisotropicCells),
    "found " + std::to_string(cells) + " samples, " + std::to_string(dimensions[1]) + " x " +
      std::to_string(dimensions[2]) + " of them along theta_d and phi_h, expected at most " +
      std::to_string(MostAnisotropicCells) + " and " + std::to_string(MostSamples));
  Require(
    azimuthRange == vtkTabulatedBRDF::HALF_TURN || azimuthRange == vtkTabulatedBRDF::FULL_TURN,
    "found azimuth range " + std::to_string(azimuthRange) + ", expected 0 or 1");
  return 3 * cells;
}

// A sample's directions, slid along theta_d to just above the horizon where they lie below: values
// there are seen by interpolation only.
void GetAnisotropicCell(
  int azimuthRange, const int dimensions[4], const int index[4], glm::dvec3& i, glm::dvec3& o)
{
  HalfDifference angles{ UnitToThetaH((index[3] + 0.5) / dimensions[3]),
    0.5 * Pi * (index[1] + 0.5) / dimensions[1], 2.0 * Pi * (index[0] + 0.5) / dimensions[0] };
  angles.ThetaD = std::min(angles.ThetaD, FindHorizon(angles) * (1.0 - 1e-4));
  FromHalfDifference(angles, i, o);
  const double phi = GetLargestAzimuth(azimuthRange) * (index[2] + 0.5) / dimensions[2];
  i = glm::rotateZ(i, phi);
  o = glm::rotateZ(o, phi);
}

// Angles of a pair in units of the axes, each in [0,1] (azimuth: any real number, periodic).
glm::dvec3 ToUnit(int parameterization, int azimuthRange, const glm::dvec3& i, const glm::dvec3& o)
{
  const bool half = azimuthRange == vtkTabulatedBRDF::HALF_TURN;
  if (parameterization == vtkTabulatedBRDF::HALF_DIFFERENCE)
  {
    return ToHalfDifferenceUnit(i, o, half);
  }
  double phi = std::atan2(i.x * o.y - i.y * o.x, i.x * o.x + i.y * o.y);
  if (half)
  {
    phi = std::abs(phi);
  }
  return { phi / (half ? Pi : 2.0 * Pi), std::atan2(std::hypot(o.x, o.y), o.z) * (2.0 / Pi),
    std::atan2(std::hypot(i.x, i.y), i.z) * (2.0 / Pi) };
}

// The same for several lights, to single precision; the azimuth of what lies nearly in its axis is
// less exact.
MEASUREDBRDF_INLINE void FindIncidentOutgoingInLanes(
  const LaneDirections& light, const double o[3], bool isHalfTurn, Floats units[3])
{
  const LaneDirections view = FillDirections(o);
  const Floats along = light.X * view.X + light.Y * view.Y;
  const Floats across = light.X * view.Y - light.Y * view.X;
  const Floats turns = FindTurns(along, across);
  units[0] = isHalfTurn ? 2.0f * turns : (across < 0.0f ? -turns : turns);
  units[1] = Fill(static_cast<float>(std::atan2(std::hypot(o[0], o[1]), o[2]) * (2.0 / Pi)));
  units[2] = FindQuarterTurns(FindHalfDistance(light, { Floats{}, Floats{}, Fill(1.0f) }));
}

MEASUREDBRDF_INLINE void FindHalfDifferenceInLanes(
  const LaneDirections& light, const LaneDirections& h, bool isHalfTurn, Floats units[3])
{
  // The frame of h: along the plane of h and the normal, and across it. Times the sine of theta_h.
  const Floats square = h.X * h.X + h.Y * h.Y;
  const Floats x = square > 1e-14f ? h.X : Fill(1.0f);
  const Floats y = square > 1e-14f ? h.Y : Floats{};
  const Floats below = square > 1e-14f ? square * light.Z : Floats{};
  const Floats along = h.Z * (x * light.X + y * light.Y) - below;
  const Floats across = x * light.Y - y * light.X;
  const Floats turns = FindTurns(along, across);
  units[0] = (across < 0.0f ? -turns : turns) * (isHalfTurn ? 2.0f : 1.0f);
  units[1] = FindQuarterTurns(FindHalfDistance(light, h));
  units[2] = SquareRoot(FindQuarterTurns(FindHalfDistance(h, { Floats{}, Floats{}, Fill(1.0f) })));
}

// The samples of an axis about coordinates, as FindCorners finds them.
struct AxisLanes
{
  Integers First, Second;
  Floats Weight; // of the second
};

MEASUREDBRDF_INLINE AxisLanes FindAxisLanes(Floats unit, int count, bool periodic)
{
  const auto n = static_cast<float>(count);
  Floats x = unit * n - 0.5f;
  x = periodic ? x + 2.0f * n : Smaller(Larger(x, Floats{}), Fill(n - 1.0f)); // unit > -1
  Integers first = ToIntegers(x);
  const Floats weight = x - ToFloats(first);
  for (int turn = 0; turn < 3 && periodic; ++turn)
  {
    first = first >= count ? first - count : first;
  }
  const Integers next = first + 1;
  const Integers beyond = Integers{} + (periodic ? 0 : count - 1);
  return { first, next >= count ? beyond : next, weight };
}

// The volume's value in one lane, of a volume without invalid cells: red, green, blue and a number.
MEASUREDBRDF_INLINE Float4 InterpolateInLanes(
  const std::vector<float>& volume, const int dimensions[3], const AxisLanes axes[3], int k)
{
  const std::ptrdiff_t x[2] = { axes[0].First[k], axes[0].Second[k] };
  const std::ptrdiff_t y[2] = { axes[1].First[k], axes[1].Second[k] };
  const std::ptrdiff_t z[2] = { axes[2].First[k], axes[2].Second[k] };
  const float u = axes[0].Weight[k];
  const float v = axes[1].Weight[k];
  const float w = axes[2].Weight[k];
  const float weights[4] = { (1.0f - v) * (1.0f - w), v * (1.0f - w), (1.0f - v) * w, v * w };
  const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(volume.size()) - 4;
  Float4 sum{};
  for (int row = 0; row < 4; ++row)
  {
    const std::ptrdiff_t start = dimensions[0] * (y[row % 2] + dimensions[1] * z[row / 2]);
    for (int side = 0; side < 2; ++side)
    {
      const std::ptrdiff_t at = 3 * (start + x[side]);
      const float* const rgb = volume.data() + at;
      const float weight = weights[row] * (side == 0 ? 1.0f - u : u);
      const Float4 color = at <= last ? Load<Float4>(rgb) : Float4{ rgb[0], rgb[1], rgb[2], 0.0f };
      sum += weight * color;
    }
  }
  return sum;
}
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkTabulatedBRDF, Precision, int, AUTOMATIC, SHARED_EXPONENT);
measuredbrdfSetClampedMacro(vtkTabulatedBRDF, ResamplingError, double, 0.0, 1e6);

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::SetVolume(
  int parameterization, int azimuthRange, const int dimensions[3], std::vector<float> rgb)
{
  const std::string problem = FindProblemOf(
    [&]()
    {
      Require(parameterization == HALF_DIFFERENCE || parameterization == INCIDENT_OUTGOING,
        "found parameterization " + std::to_string(parameterization) + ", expected 0 or 1");
      const std::size_t count = CountValues(3, dimensions, azimuthRange);
      Require(rgb.size() == count,
        "found " + std::to_string(rgb.size()) + " values, expected " + std::to_string(count));
      this->TakeVolume(parameterization, azimuthRange, dimensions, 1, std::move(rgb));
    });
  if (!problem.empty())
  {
    vtkErrorMacro("SetVolume: " << problem << "; the volume stays.");
  }
  return problem.empty();
}

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::SetVolume(int azimuthRange, const int dimensions[4], std::vector<float> rgb)
{
  const std::string problem = FindProblemOf(
    [&]()
    {
      const std::size_t count = CountValues(4, dimensions, azimuthRange);
      Require(rgb.size() == count,
        "found " + std::to_string(rgb.size()) + " values, expected " + std::to_string(count));
      RequireFinite(rgb, "volume");
      const int texture[3] = { dimensions[0], dimensions[1] * dimensions[2], dimensions[3] };
      this->TakeVolume(ANISOTROPIC, azimuthRange, texture, dimensions[2], std::move(rgb));
    });
  if (!problem.empty())
  {
    vtkErrorMacro("SetVolume: " << problem << "; the volume stays.");
  }
  return problem.empty();
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::TakeVolume(int parameterization, int azimuthRange, const int dimensions[3],
  int azimuths, std::vector<float> rgb)
{
  this->Parameterization = parameterization;
  this->AzimuthRange = azimuthRange;
  std::copy_n(dimensions, 3, this->Dimensions);
  this->NumberOfAzimuths = azimuths;
  this->Volume = std::move(rgb);
  this->NumberOfInvalidCells = 0;
  for (std::size_t k = 0; k < this->Volume.size(); k += 3)
  {
    float* v = &this->Volume[k];
    if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2]))
    {
      v[0] = v[1] = v[2] = std::numeric_limits<float>::quiet_NaN();
      ++this->NumberOfInvalidCells;
    }
  }
  this->ResetLobe();
  this->WidenedLevels = std::make_shared<Levels>();
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::Resample(vtkBRDF* source, int azimuthRange, const int dimensions[4])
{
  const std::string problem = FindProblemOf(
    [&]()
    {
      Require(source, "there is no source");
      CountValues(4, dimensions, azimuthRange);
    });
  if (!problem.empty())
  {
    vtkErrorMacro("Resample: " << problem << "; the volume stays.");
    return false;
  }
  source->Prepare();
  const vtkIdType rows = static_cast<vtkIdType>(dimensions[2]) * dimensions[3];
  const std::size_t row = 3u * static_cast<std::size_t>(dimensions[0] * dimensions[1]);
  std::vector<float> rgb(row * static_cast<std::size_t>(rows));
  measuredbrdf::ParallelFor(0, rows, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      float* value = &rgb[row * static_cast<std::size_t>(begin)];
      for (vtkIdType k = begin; k < end; ++k)
      {
        for (int cell = 0; cell < dimensions[0] * dimensions[1]; ++cell, value += 3)
        {
          const int index[4] = { cell % dimensions[0], cell / dimensions[0],
            static_cast<int>(k % dimensions[2]), static_cast<int>(k / dimensions[2]) };
          glm::dvec3 i, o, f;
          GetAnisotropicCell(azimuthRange, dimensions, index, i, o);
          source->Evaluate(&i.x, &o.x, &f.x);
          const glm::vec3 weighted(
            glm::min(f * o.z, static_cast<double>(std::numeric_limits<float>::max())));
          std::copy_n(&weighted.x, 3, value);
        }
      }
    });
  this->SetCosineWeighted(true);
  return this->SetVolume(azimuthRange, dimensions, std::move(rgb));
}

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::GetCellDirections(int parameterization, int azimuthRange,
  const int dimensions[3], int x, int y, int z, double i[3], double o[3])
{
  const double phi = GetLargestAzimuth(azimuthRange) * (x + 0.5) / dimensions[0];
  const double second = 0.5 * Pi * (y + 0.5) / dimensions[1];
  glm::dvec3 light, view;
  if (parameterization == HALF_DIFFERENCE)
  {
    FromHalfDifference({ UnitToThetaH((z + 0.5) / dimensions[2]), second, phi }, light, view);
  }
  else
  {
    light = ToDirection(std::cos(0.5 * Pi * (z + 0.5) / dimensions[2]), 0.0);
    view = ToDirection(std::cos(second), phi);
  }
  std::copy_n(glm::value_ptr(light), 3, i);
  std::copy_n(glm::value_ptr(view), 3, o);
  return light.z > 0.0 && view.z > 0.0;
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (this->Volume.empty())
  {
    return;
  }
  const glm::dvec3 light = glm::make_vec3(i), view = glm::make_vec3(o);
  const double divisor = this->CosineWeighted ? o[2] : 1.0;
  if (this->Parameterization == ANISOTROPIC)
  {
    const glm::dvec3 unit = ToHalfDifferenceUnit(light, view, false);
    const glm::dvec3 h = HalfVector(light, view);
    const double phiH = std::hypot(h.x, h.y) > 1e-7 ? std::atan2(h.y, h.x) : 0.0;
    const int azimuths = this->NumberOfAzimuths;
    const int dimensions[4] = { this->Dimensions[0], this->Dimensions[1] / azimuths, azimuths,
      this->Dimensions[2] };
    DivideByValid(
      GatherCorners<4>(this->Volume, dimensions,
        { PeriodicNeighbors(unit.x, dimensions[0]), ClampedNeighbors(unit.y, dimensions[1]),
          PeriodicNeighbors(phiH / GetLargestAzimuth(this->AzimuthRange), azimuths),
          ClampedNeighbors(unit.z, dimensions[3]) }),
      divisor, f);
    return;
  }
  const glm::dvec3 u = ToUnit(this->Parameterization, this->AzimuthRange, light, view);
  const Neighbors azimuth = HasPeriodicAzimuth(this->Parameterization, this->AzimuthRange)
                              ? PeriodicNeighbors(u.x, this->Dimensions[0])
                              : ClampedNeighbors(u.x, this->Dimensions[0]);
  DivideByValid(GatherCorners<3>(this->Volume, this->Dimensions,
                  { azimuth, ClampedNeighbors(u.y, this->Dimensions[1]),
                    ClampedNeighbors(u.z, this->Dimensions[2]) }),
    divisor, f);
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::EvaluateLights(
  int count, const float* const i[3], const double o[3], float* const f[3])
{
  if (this->NumberOfInvalidCells > 0 || this->Volume.empty() || !this->IsIsotropic())
  {
    EvaluateLightsOneByOne(this, count, i, o, f);
    return;
  }
  const bool isHalfDifference = this->Parameterization == HALF_DIFFERENCE;
  const bool isHalfTurn = this->AzimuthRange == HALF_TURN;
  const bool isPeriodic = HasPeriodicAzimuth(this->Parameterization, this->AzimuthRange);
  const float scale = this->CosineWeighted ? static_cast<float>(1.0 / o[2]) : 1.0f;
  struct State : LaneState
  {
    LaneDirections Half;
    AxisLanes Axes[3];
  };
  const auto findHalf = [&](State& s) MEASUREDBRDF_INLINED
  {
    Floats cosine;
    s.Half = FindHalf(s.Light, FillDirections(o), cosine);
  };
  const auto findPlaces = [&](State& s) MEASUREDBRDF_INLINED
  {
    Floats units[3];
    if (isHalfDifference)
    {
      FindHalfDifferenceInLanes(s.Light, s.Half, isHalfTurn, units);
    }
    else
    {
      FindIncidentOutgoingInLanes(s.Light, o, isHalfTurn, units);
    }
    for (int a = 0; a < 3; ++a)
    {
      s.Axes[a] = FindAxisLanes(units[a], this->Dimensions[a], a == 0 && isPeriodic);
    }
  };
  const auto interpolate = [&](State& s) MEASUREDBRDF_INLINED
  {
    Float4 colors[LaneCount];
    for (int k = 0; k < LaneCount; ++k)
    {
      colors[k] = scale * InterpolateInLanes(this->Volume, this->Dimensions, s.Axes, k);
    }
    Floats columns[4];
    Transpose(colors, columns);
    std::copy_n(columns, 3, s.Color);
  };
  EvaluateLanes<State>(count, i, f, findHalf, findPlaces, interpolate);
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::EvaluateSoftAbove(
  const double i[3], const double o[3], double spread, double f[3])
{
  const Levels* levels = this->GetLevels();
  if (!levels)
  {
    this->EvaluateAbove(i, o, f);
    return;
  }
  const glm::dvec3 light = glm::make_vec3(i);
  const glm::dvec3 view = glm::make_vec3(o);
  const glm::dvec3 u = ToUnit(this->Parameterization, this->AzimuthRange, light, view);
  const Neighbors around =
    levels->FindLevels(HalfVectorSpread(spread, glm::dot(HalfVector(light, view), view)));
  const VolumeSum first = levels->Gather(*this, around.First, u);
  const VolumeSum second = levels->Gather(*this, around.Second, u);
  DivideByValid({ glm::mix(first.Values, second.Values, around.Weight),
                  glm::mix(first.Valid, second.Valid, around.Weight) },
    this->CosineWeighted ? o[2] : 1.0, f);
}

//------------------------------------------------------------------------------
const vtkTabulatedBRDF::Levels* vtkTabulatedBRDF::GetLevels()
{
  if (!this->WidenedLevels || this->Parameterization != HALF_DIFFERENCE)
  {
    return nullptr;
  }
  std::call_once(this->WidenedLevels->Made, [this]() { this->WidenedLevels->Make(*this); });
  return this->WidenedLevels.get();
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::Prepare()
{
  if (!this->HasLobe() && !this->Volume.empty())
  {
    this->IsIsotropic() ? this->SetLobe(90, 1, 0.5) : this->SetLobe(64, 32, 0.5);
  }
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  vtkBRDFShaderInputs::Term term;
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfVolume";
  texture.ThreeD = true;
  texture.Dimensions = { this->Dimensions[0], this->Dimensions[1], this->Dimensions[2] };
  texture.Components = this->NumberOfInvalidCells > 0 ? 4 : 3;
  texture.Repeat = { HasPeriodicAzimuth(this->Parameterization, this->AzimuthRange), false, false };
  const Storage storage = ChooseStorage(
    this->IsIsotropic() ? this->Precision : AUTOMATIC, this->ResamplingTolerance, this->Volume);
  FillTexture(texture, this->Volume, storage);
  struct Form
  {
    const char* Shader;
    const char* Source;
    const char* Text;
  };
  const Form forms[] = { { "vtkBRDFHalfDifference", vtkBRDFHalfDifference, "half/difference" },
    { "vtkBRDFIncidentOutgoing", vtkBRDFIncidentOutgoing, "incident/outgoing" },
    { "vtkBRDFAnisotropicTable", vtkBRDFAnisotropicTable, "anisotropic half/difference" } };
  const Form& form = forms[this->Parameterization];
  SetModuleShader(term, form.Shader, form.Source);
  term.Uniforms = { { "brdfScale", { 1.0f / storage.Scale } },
    { "brdfTurns", { this->AzimuthRange == HALF_TURN ? 2.0f : 1.0f } },
    { "brdfCosineWeighted", { this->CosineWeighted ? 1.0f : 0.0f } } };
  TextStream text;
  text << form.Text << " volume " << this->Dimensions[0] << " x ";
  if (!this->IsIsotropic())
  {
    term.Uniforms.push_back({ "brdfAzimuths", { 1.0f * this->NumberOfAzimuths } });
    text << this->Dimensions[1] / this->NumberOfAzimuths << " x " << this->NumberOfAzimuths;
  }
  else
  {
    text << this->Dimensions[1];
  }
  text << " x " << this->Dimensions[2] << ", " << storage.Text << ", " << texture.GetBytes()
       << " bytes";
  if (this->ResamplingError > 0.0)
  {
    text << ", resampling error " << this->ResamplingError;
  }
  const Levels* levels = inputs.SoftLights ? this->GetLevels() : nullptr;
  term.Fetches = levels || !this->IsIsotropic() ? 2 : 1;
  if (levels)
  {
    vtkBRDFShaderInputs::Texture wider;
    wider.Name = "brdfLevels";
    wider.ThreeD = true;
    wider.Dimensions = levels->Dimensions;
    wider.Components = texture.Components;
    wider.Repeat = texture.Repeat;
    FillTexture(wider, levels->Volume, storage);
    term.SoftSource = vtkBRDFHalfDifferenceSoft;
    term.Uniforms.push_back({ "brdfNumberOfLevels", { 1.0f * levels->Count } });
    term.Uniforms.push_back({ "brdfFirstCount", { 1.0f * levels->FirstSamples } });
    term.Uniforms.push_back({ "brdfOwnVariance", { static_cast<float>(levels->OwnVariance) } });
    text << ", wider for soft lights: " << levels->Count << " levels, " << wider.GetBytes()
         << " bytes";
    term.Textures.push_back(std::move(wider));
  }
  term.Textures.insert(term.Textures.begin(), std::move(texture));
  inputs.QuantizationError = std::max(inputs.QuantizationError, storage.Rounding);
  inputs.ResamplingError = std::max(inputs.ResamplingError, this->ResamplingError);
  inputs.Description = text.str();
  inputs.Terms.push_back(std::move(term));
}

//------------------------------------------------------------------------------
// An anisotropic table is a model of its own, whose array has four axes.
void vtkTabulatedBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  const bool isIsotropic =
    exchange.IsLoading() ? exchange.GetModelName() != "AnisotropicTabulated" : this->IsIsotropic();
  exchange.Flag(
    "cosineWeighted", this->CosineWeighted, [this](bool on) { this->SetCosineWeighted(on); });
  exchange.Number("resamplingError", this->ResamplingError,
    [this](double value) { this->SetResamplingError(value); });
  int parameterization = this->Parameterization;
  int azimuthRange = this->AzimuthRange;
  exchange.Option("azimuthRange", { "half-turn", "full-turn" }, azimuthRange,
    [&](int value) { azimuthRange = value; });
  if (isIsotropic)
  {
    exchange.Option("precision", { "automatic", "float16", "float32", "shared-exponent" },
      this->Precision, [this](int value) { this->SetPrecision(value); });
    exchange.Option("parameterization", { "half-difference", "incident-outgoing" },
      parameterization, [&](int value) { parameterization = value; });
  }
  if (!exchange.IsLoading())
  {
    std::vector<int> shape = { this->Dimensions[2], this->Dimensions[1], this->Dimensions[0] };
    if (!isIsotropic)
    {
      shape[1] /= this->NumberOfAzimuths;
      shape.insert(shape.begin() + 1, this->NumberOfAzimuths);
    }
    exchange.SaveArray("volume", shape, 3, this->Volume);
    return;
  }
  auto volume = exchange.LoadArray("volume", isIsotropic ? 3 : 4, 3);
  std::reverse(volume.Shape.begin(), volume.Shape.end());
  const bool isTaken =
    isIsotropic ? this->SetVolume(
                    parameterization, azimuthRange, volume.Shape.data(), std::move(volume.Values))
                : this->SetVolume(azimuthRange, volume.Shape.data(), std::move(volume.Values));
  exchange.Check(isTaken ? "" : "array 'volume' was refused");
}

//------------------------------------------------------------------------------
vtkBRDF* vtkTabulatedBRDF::NewCopy()
{
  vtkTabulatedBRDF* copy = vtkTabulatedBRDF::New();
  copy->Parameterization = this->Parameterization;
  copy->AzimuthRange = this->AzimuthRange;
  std::copy_n(this->Dimensions, 3, copy->Dimensions);
  copy->NumberOfAzimuths = this->NumberOfAzimuths;
  copy->Precision = this->Precision;
  copy->CosineWeighted = this->CosineWeighted;
  copy->ResamplingError = this->ResamplingError;
  copy->Volume = this->Volume;
  copy->NumberOfInvalidCells = this->NumberOfInvalidCells;
  copy->WidenedLevels = this->WidenedLevels;
  return copy;
}
