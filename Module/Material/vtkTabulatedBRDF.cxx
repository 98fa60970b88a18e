// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTabulatedBRDF.h"

#include "ContentHash.h"
#include "Floats.h"
#include "HalfVector.h"
#include "HalfVectorSampler.h"
#include "LaneMath.h"
#include "ModuleShader.h"
#include "Neighbors.h"
#include "NumberText.h"
#include "OneByOne.h"
#include "Setters.h"
#include "VolumeInterpolation.h"
#include "ZonalKernel.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFHalfDifference.h"
#include "vtkBRDFHalfDifferenceSoft.h"
#include "vtkBRDFIncidentOutgoing.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

namespace measuredbrdf
{
/// How textures store a table's values.
struct TabulatedStorage
{
  ///@{
  /// Largest relative errors of stored values.
  static constexpr double HalfRounding = 1.0 / 2048.0;
  static constexpr double SharedRounding = 1.0 / 512.0; // of the largest channel
  static constexpr double FloatRounding = 0x1p-23;
  ///@}
  static constexpr double ShareOfTolerance = 0.25; // that rounding may take
  // Scaled to a peak of 2^15, 16 bits and shared exponents keep their bits over nine decades.
  static constexpr float Peak = 32768.0f;

  bool SharedExponents = false;
  bool HalfFloat = false;
  float Scale = 1.0f; // of values that are stored

  double GetRounding() const
  {
    return this->SharedExponents ? SharedRounding : this->HalfFloat ? HalfRounding : FloatRounding;
  }

  const char* GetText() const
  {
    return this->SharedExponents ? "9 bits and a shared exponent"
                                 : (this->HalfFloat ? "16-bit float" : "32-bit float");
  }

  /// precision: a vtkTabulatedBRDF::PrecisionType; tolerance: of resampling; volume: RGB, NaN where
  /// a cell is invalid.
  static TabulatedStorage Choose(int precision, double tolerance, const std::vector<float>& volume)
  {
    float peak = 0.0f;
    bool positive = true; // and valid
    for (const float v : volume)
    {
      peak = std::max(peak, std::isnan(v) ? 0.0f : std::abs(v));
      positive = positive && v >= 0.0f;
    }
    const double most = ShareOfTolerance * tolerance;
    TabulatedStorage storage;
    storage.SharedExponents =
      precision == vtkTabulatedBRDF::SHARED_EXPONENT && positive && SharedRounding <= most;
    const bool mayBeHalf = precision != vtkTabulatedBRDF::FLOAT32 && HalfRounding <= most;
    storage.HalfFloat =
      !storage.SharedExponents && (precision == vtkTabulatedBRDF::FLOAT16 || mayBeHalf);
    if ((storage.SharedExponents || storage.HalfFloat) && peak > 1e-30f)
    {
      storage.Scale = Peak / peak;
    }
    return storage;
  }
};

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
class TabulatedLevels
{
public:
  /// volume: RGB triples over (phi_d, theta_d, theta_h) as vtkTabulatedBRDF holds them, NaN:
  /// invalid.
  TabulatedLevels(
    const std::array<int, 3>& dimensions, bool halfTurn, const std::vector<float>& volume);

  /// Number of levels without level 0; 1 to 20.
  int GetNumberOfLevels() const { return this->NumberOfLevels; }

  double GetOwnVariance() const { return this->OwnVariance; }

  /// Samples of level 1 along theta_h.
  int GetFirstCount() const { return this->FirstCount; }

  ///@{
  /// Levels 1, 2, ... along the third axis; RGB triples, NaN: invalid.
  const std::array<int, 3>& GetDimensions() const { return this->Dimensions; }
  const std::vector<float>& GetVolume() const { return this->Volume; }
  ///@}

  /// The levels around a variance >= 0 in h.
  Neighbors FindLevels(double variance) const;

  /// The samples of a level >= 1 around theta_h in table coordinates, as indices of the third axis.
  Neighbors FindSlices(int level, double u) const;

private:
  int GetCount(int level) const { return this->FirstCount >> ((level - 1) / 4); }
  int GetOffset(int level) const;

  int NumberOfLevels = 1;
  int FirstCount = 1;
  double OwnVariance = 1.0;
  std::array<int, 3> Dimensions;
  std::vector<float> Volume;
};

namespace
{
constexpr int MaximumThetaD = 45;          // 2 degrees
constexpr int MaximumPhiDPerHalfTurn = 36; // 5 degrees

// Where fewer of the weights than this fall on valid cells there is no value.
constexpr float MinimumValidWeight = 1e-4f;

// Samples along theta_h for a lobe of variance 1; the square root's spacing needs as many more as
// the fourth root of the variance is smaller.
constexpr double CountOfUnitVariance = 8.0;

// RGB times validity, validity (0 or 1).
struct Cell
{
  float Values[4];
};

// A mean over valid cells.
Cell Normalized(const Cell& sum)
{
  Cell cell{ { 0.0f, 0.0f, 0.0f, 0.0f } };
  if (sum.Values[3] > MinimumValidWeight)
  {
    for (int c = 0; c < 3; ++c)
    {
      cell.Values[c] = sum.Values[c] / sum.Values[3];
    }
    cell.Values[3] = 1.0f;
  }
  return cell;
}

// What part of sample k of `from` lies in sample j of `to` <= from, in units of the latter.
double GetOverlap(int k, int from, int j, int to)
{
  const double scale = static_cast<double>(to) / from;
  return std::max(std::min((k + 1) * scale, j + 1.0) - std::max(k * scale, j + 0.0), 0.0);
}

// The volume averaged to width x height samples of phi_d and theta_d.
std::vector<Cell> Average(
  const std::array<int, 3>& dimensions, const std::vector<float>& volume, int width, int height)
{
  std::vector<Cell> cells;
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < height; ++y)
    {
      const int top = y * dimensions[1] / height;
      const int bottom = ((y + 1) * dimensions[1] + height - 1) / height;
      for (int x = 0; x < width; ++x)
      {
        const int left = x * dimensions[0] / width;
        const int right = ((x + 1) * dimensions[0] + width - 1) / width;
        Cell sum{ { 0.0f, 0.0f, 0.0f, 0.0f } };
        for (int b = top; b < bottom; ++b)
        {
          for (int a = left; a < right; ++a)
          {
            const std::size_t index =
              static_cast<std::size_t>(a) +
              static_cast<std::size_t>(dimensions[0]) *
                (static_cast<std::size_t>(b) +
                  static_cast<std::size_t>(dimensions[1]) * static_cast<std::size_t>(z));
            const float* v = &volume[3 * index];
            if (!std::isnan(v[0]))
            {
              const float weight = static_cast<float>(
                GetOverlap(a, dimensions[0], x, width) * GetOverlap(b, dimensions[1], y, height));
              for (int c = 0; c < 3; ++c)
              {
                sum.Values[c] += weight * v[c];
              }
              sum.Values[3] += weight;
            }
          }
        }
        cells.push_back(Normalized(sum));
      }
    }
  }
  return cells;
}

// Variance of the Gaussian lobe with the width at half the height of the volume's, seen from within
// 45 degrees of h, where every theta_h up to 45 degrees is above the horizon.
double FindOwnVariance(const std::vector<Cell>& cells, int width, int height, int nThetaH)
{
  const std::size_t slice = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t half =
    static_cast<std::size_t>(width) * static_cast<std::size_t>((height + 1) / 2);
  std::vector<double> profile;
  double floor = std::numeric_limits<double>::max();
  for (int z = 0; z < nThetaH; ++z)
  {
    double sum = 0.0;
    double valid = 0.0;
    for (std::size_t k = 0; k < half; ++k)
    {
      const float* v = cells[slice * static_cast<std::size_t>(z) + k].Values;
      sum += static_cast<double>(v[0]) + v[1] + v[2];
      valid += v[3];
    }
    profile.push_back(valid > 0.0 ? sum / valid : (z > 0 ? profile.back() : 0.0));
    floor = std::min(floor, profile.back());
  }
  const double middle = 0.5 * (profile[0] + floor);
  for (int z = 1; z < nThetaH; ++z)
  {
    const double above = profile[static_cast<std::size_t>(z - 1)];
    const double below = profile[static_cast<std::size_t>(z)];
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
std::vector<double> GetWeights(double a, int n, double variance)
{
  const double reach = GetRingReach(variance);
  std::vector<double> weights(static_cast<std::size_t>(n), 0.0);
  double total = 0.0;
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
      weights[static_cast<std::size_t>(t.First)] += weight * (1.0 - t.Weight);
      weights[static_cast<std::size_t>(t.Second)] += weight * t.Weight;
      total += weight;
    }
  }
  for (double& weight : weights)
  {
    weight /= total;
  }
  return weights;
}

// The slice of weighted cells along theta_h, appended to rgb.
void AppendSlice(const std::vector<Cell>& cells, const std::vector<double>& weights,
  std::vector<Cell>& sums, std::vector<float>& rgb)
{
  const std::size_t slice = sums.size();
  std::fill(sums.begin(), sums.end(), Cell{ { 0.0f, 0.0f, 0.0f, 0.0f } });
  for (std::size_t z = 0; z < weights.size(); ++z)
  {
    const float weight = static_cast<float>(weights[z]);
    for (std::size_t k = 0; weight > 0.0f && k < slice; ++k)
    {
      const Cell& cell = cells[slice * z + k];
      for (int c = 0; c < 4; ++c)
      {
        sums[k].Values[c] += weight * cell.Values[c];
      }
    }
  }
  for (const Cell& sum : sums)
  {
    const Cell mean = Normalized(sum);
    for (int c = 0; c < 3; ++c)
    {
      rgb.push_back(
        mean.Values[3] > 0.0f ? mean.Values[c] : std::numeric_limits<float>::quiet_NaN());
    }
  }
}

int RoundUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }
} // namespace

//------------------------------------------------------------------------------
TabulatedLevels::TabulatedLevels(
  const std::array<int, 3>& dimensions, bool halfTurn, const std::vector<float>& volume)
{
  const int width = std::min(dimensions[0], (halfTurn ? 1 : 2) * MaximumPhiDPerHalfTurn);
  const int height = std::min(dimensions[1], MaximumThetaD);
  const std::vector<Cell> cells = Average(dimensions, volume, width, height);
  this->OwnVariance = FindOwnVariance(cells, width, height, dimensions[2]);
  this->NumberOfLevels = static_cast<int>(std::ceil(std::log2(1.0 + 1.0 / this->OwnVariance)));
  const double wanted = std::ceil(CountOfUnitVariance * std::pow(2.0 * this->OwnVariance, -0.25));
  this->FirstCount = RoundUp(
    std::min(static_cast<int>(wanted), dimensions[2]), 1 << ((this->NumberOfLevels - 1) / 4));
  this->Dimensions = { width, height,
    this->GetOffset(this->NumberOfLevels) + this->GetCount(this->NumberOfLevels) };

  std::vector<Cell> sums(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  this->Volume.reserve(3 * sums.size() * static_cast<std::size_t>(this->Dimensions[2]));
  for (int level = 1; level <= this->NumberOfLevels; ++level)
  {
    const double variance = this->OwnVariance * (std::exp2(level) - 1.0);
    const int count = this->GetCount(level);
    for (int k = 0; k < count; ++k)
    {
      const double theta = UnitToThetaH((k + 0.5) / count);
      AppendSlice(cells, GetWeights(theta, dimensions[2], variance), sums, this->Volume);
    }
  }
}

//------------------------------------------------------------------------------
int TabulatedLevels::GetOffset(int level) const
{
  // Four levels of each count, which halves: 4 (n + n/2 + ...) = 8 (n - count).
  const int count = this->GetCount(level);
  return 8 * (this->FirstCount - count) + (level - 1) % 4 * count;
}

//------------------------------------------------------------------------------
Neighbors TabulatedLevels::FindLevels(double variance) const
{
  const double level = std::min(std::log1p(variance / this->OwnVariance) / std::log(2.0),
    static_cast<double>(this->NumberOfLevels));
  const int first = std::min(static_cast<int>(level), this->NumberOfLevels - 1);
  return { first, first + 1, level - first };
}

//------------------------------------------------------------------------------
Neighbors TabulatedLevels::FindSlices(int level, double u) const
{
  const Neighbors slices = ClampedNeighbors(u, this->GetCount(level));
  const int offset = this->GetOffset(level);
  return { offset + slices.First, offset + slices.Second, slices.Weight };
}
} // namespace measuredbrdf

using namespace measuredbrdf;

vtkStandardNewMacro(vtkTabulatedBRDF);

struct vtkTabulatedBRDF::Sampler : public HalfVectorSampler
{
  using HalfVectorSampler::HalfVectorSampler;
};

struct vtkTabulatedBRDF::Levels
{
  std::once_flag Made; // by the first of many threads that asks
  std::optional<TabulatedLevels> Values;
};

namespace
{
// Invalid cells are premultiplied away: the filter then skips them as Evaluate does.
void FillTexture(vtkBRDFShaderInputs::Texture& texture, const std::vector<float>& volume,
  const TabulatedStorage& storage)
{
  const float scale = storage.Scale;
  const std::size_t cells = volume.size() / 3;
  texture.HalfFloat = storage.HalfFloat;
  if (storage.SharedExponents)
  {
    texture.SharedExponents.reserve(cells);
    for (std::size_t k = 0; k < cells; ++k)
    {
      texture.SharedExponents.push_back(
        measuredbrdf::PackSharedExponent(scale * glm::make_vec3(&volume[3 * k])));
    }
    return;
  }
  texture.Data.reserve(cells * static_cast<std::size_t>(texture.Components));
  for (std::size_t k = 0; k < cells; ++k)
  {
    const float* v = &volume[3 * k];
    const bool valid = !std::isnan(v[0]);
    for (int c = 0; c < 3; ++c)
    {
      texture.Data.push_back(valid ? v[c] * scale : 0.0f);
    }
    if (texture.Components == 4)
    {
      texture.Data.push_back(valid ? 1.0f : 0.0f);
    }
  }
}

// What surrounds coordinates u in a half/difference volume's level.
VolumeSum GatherLevel(const TabulatedLevels& levels, int level, const std::vector<float>& volume,
  const int dimensions[3], const glm::dvec3& u)
{
  if (level == 0)
  {
    return GatherCorners(volume, dimensions,
      { FindCorners(u.x, dimensions[0], true), FindCorners(u.y, dimensions[1], false),
        FindCorners(u.z, dimensions[2], false) });
  }
  const std::array<int, 3>& size = levels.GetDimensions();
  const Neighbors z = levels.FindSlices(level, u.z);
  return GatherCorners(levels.GetVolume(), size.data(),
    { FindCorners(u.x, size[0], true), FindCorners(u.y, size[1], false),
      { { z.First, z.Second }, { 1.0 - z.Weight, z.Weight } } });
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
vtkTabulatedBRDF::vtkTabulatedBRDF() = default;

//------------------------------------------------------------------------------
vtkTabulatedBRDF::~vtkTabulatedBRDF() = default;

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkTabulatedBRDF, Precision, int, AUTOMATIC, SHARED_EXPONENT);
measuredbrdfSetClampedMacro(vtkTabulatedBRDF, ResamplingError, double, 0.0, 1e6);

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Parameterization: "
     << (this->Parameterization == HALF_DIFFERENCE ? "half/difference" : "incident/outgoing")
     << "\n";
  os << indent << "AzimuthRange: " << (this->AzimuthRange == HALF_TURN ? "pi" : "2 pi") << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "CosineWeighted: " << (this->CosineWeighted ? "On" : "Off") << "\n";
  os << indent << "Precision: " << this->Precision << "\n";
  os << indent << "ResamplingError: " << this->ResamplingError << "\n";
  os << indent << "NumberOfInvalidCells: " << this->NumberOfInvalidCells << "\n";
}

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::SetVolume(
  int parameterization, int azimuthRange, const int dimensions[3], std::vector<float> rgb)
{
  std::size_t cells = 1;
  for (int a = 0; a < 3; ++a)
  {
    if (dimensions[a] < 1 || dimensions[a] > 2048)
    {
      vtkErrorMacro("SetVolume: found " << dimensions[a] << " samples along axis " << a
                                        << ", expected 1 to 2048; the volume stays.");
      return false;
    }
    cells *= static_cast<std::size_t>(dimensions[a]);
  }
  if (rgb.size() != 3 * cells || parameterization < HALF_DIFFERENCE ||
      parameterization > INCIDENT_OUTGOING || azimuthRange < HALF_TURN || azimuthRange > FULL_TURN)
  {
    vtkErrorMacro("SetVolume: found " << rgb.size() << " values, parameterization "
                                      << parameterization << " and azimuth range " << azimuthRange
                                      << ", expected " << 3 * cells
                                      << " values and 0 or 1 both; the volume stays.");
    return false;
  }
  this->Parameterization = parameterization;
  this->AzimuthRange = azimuthRange;
  std::copy_n(dimensions, 3, this->Dimensions);
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
  this->HalfVectorSampler.reset();
  this->WidenedLevels = std::make_shared<Levels>();
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
vtkImageData* vtkTabulatedBRDF::NewImageData()
{
  vtkImageData* image = vtkImageData::New();
  image->SetDimensions(this->Dimensions);
  vtkNew<vtkFloatArray> values;
  values->SetName("BRDF");
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(static_cast<vtkIdType>(this->Volume.size() / 3));
  std::copy(this->Volume.begin(), this->Volume.end(), values->GetPointer(0));
  image->GetPointData()->SetScalars(values);
  return image;
}

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::GetCellDirections(int parameterization, int azimuthRange,
  const int dimensions[3], int x, int y, int z, double i[3], double o[3])
{
  const double phi = (azimuthRange == HALF_TURN ? Pi : 2.0 * Pi) * (x + 0.5) / dimensions[0];
  const double second = 0.5 * Pi * (y + 0.5) / dimensions[1];
  glm::dvec3 light, view;
  if (parameterization == HALF_DIFFERENCE)
  {
    FromHalfDifference({ UnitToThetaH((z + 0.5) / dimensions[2]), second, phi }, light, view);
  }
  else
  {
    const double first = 0.5 * Pi * (z + 0.5) / dimensions[2];
    light = glm::dvec3(std::sin(first), 0.0, std::cos(first));
    view = glm::dvec3(
      std::sin(second) * std::cos(phi), std::sin(second) * std::sin(phi), std::cos(second));
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
  const glm::dvec3 u =
    ToUnit(this->Parameterization, this->AzimuthRange, glm::make_vec3(i), glm::make_vec3(o));
  // The mirror-symmetric azimuth of incident/outgoing tables ends at 0 and pi, all others close.
  const bool periodic =
    this->Parameterization == HALF_DIFFERENCE || this->AzimuthRange == FULL_TURN;
  const VolumeCorners corners = { FindCorners(u.x, this->Dimensions[0], periodic),
    FindCorners(u.y, this->Dimensions[1], false), FindCorners(u.z, this->Dimensions[2], false) };
  DivideByValid(
    GatherCorners(this->Volume, this->Dimensions, corners), this->CosineWeighted ? o[2] : 1.0, f);
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::EvaluateLights(
  int count, const float* const i[3], const double o[3], float* const f[3])
{
  if (this->NumberOfInvalidCells > 0 || this->Volume.empty())
  {
    EvaluateLightsOneByOne(this, count, i, o, f);
    return;
  }
  const bool isHalfDifference = this->Parameterization == HALF_DIFFERENCE;
  const bool isHalfTurn = this->AzimuthRange == HALF_TURN;
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
      const bool isPeriodic = a == 0 && (isHalfDifference || !isHalfTurn);
      s.Axes[a] = FindAxisLanes(units[a], this->Dimensions[a], isPeriodic);
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
    levels->Values->FindLevels(HalfVectorSpread(spread, glm::dot(HalfVector(light, view), view)));
  const VolumeSum first =
    GatherLevel(*levels->Values, around.First, this->Volume, this->Dimensions, u);
  const VolumeSum second =
    GatherLevel(*levels->Values, around.Second, this->Volume, this->Dimensions, u);
  VolumeSum sum;
  for (int c = 0; c < 3; ++c)
  {
    sum.Values[c] = glm::mix(first.Values[c], second.Values[c], around.Weight);
  }
  sum.Valid = glm::mix(first.Valid, second.Valid, around.Weight);
  DivideByValid(sum, this->CosineWeighted ? o[2] : 1.0, f);
}

//------------------------------------------------------------------------------
const vtkTabulatedBRDF::Levels* vtkTabulatedBRDF::GetLevels()
{
  if (!this->WidenedLevels || this->Parameterization != HALF_DIFFERENCE)
  {
    return nullptr;
  }
  std::call_once(this->WidenedLevels->Made,
    [this]()
    {
      this->WidenedLevels->Values.emplace(
        std::array<int, 3>{ this->Dimensions[0], this->Dimensions[1], this->Dimensions[2] },
        this->AzimuthRange == HALF_TURN, this->Volume);
    });
  return this->WidenedLevels.get();
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::Prepare()
{
  if (this->HalfVectorSampler || this->Volume.empty())
  {
    return;
  }
  // Density of h from the table itself: mean over the difference angles.
  constexpr int nTheta = 90;
  this->HalfVectorSampler = std::make_unique<Sampler>(
    MeanOverDifferenceAngles(nTheta, 1,
      [this](const double i[3], const double o[3], double f[3]) { this->Evaluate(i, o, f); }),
    nTheta, 1, 0.5);
}

//------------------------------------------------------------------------------
bool vtkTabulatedBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  this->Prepare();
  if (!this->HalfVectorSampler)
  {
    return this->Superclass::SampleAbove(o, u1, u2, i);
  }
  glm::dvec3 direction;
  const bool above = this->HalfVectorSampler->Sample(glm::make_vec3(o), u1, u2, direction);
  std::copy_n(glm::value_ptr(direction), 3, i);
  return above;
}

//------------------------------------------------------------------------------
double vtkTabulatedBRDF::PdfAbove(const double i[3], const double o[3])
{
  this->Prepare();
  return this->HalfVectorSampler
           ? this->HalfVectorSampler->Pdf(glm::make_vec3(i), glm::make_vec3(o))
           : this->Superclass::PdfAbove(i, o);
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::GetBounds(double minimumCosine, double lower[3], double upper[3])
{
  // Interpolation never leaves the range of the samples. Where no cell is valid f is 0.
  const double divisor = this->CosineWeighted ? std::clamp(minimumCosine, 1e-6, 1.0) : 1.0;
  for (int c = 0; c < 3; ++c)
  {
    float low = this->NumberOfInvalidCells > 0 || this->Volume.empty()
                  ? 0.0f
                  : std::numeric_limits<float>::max();
    float high = 0.0f;
    for (std::size_t k = static_cast<std::size_t>(c); k < this->Volume.size(); k += 3)
    {
      if (!std::isnan(this->Volume[k]))
      {
        low = std::min(low, this->Volume[k]);
        high = std::max(high, this->Volume[k]);
      }
    }
    lower[c] = std::max(low, 0.0f);
    upper[c] = high / divisor;
  }
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  vtkBRDFShaderInputs::Term term;
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfVolume";
  texture.ThreeD = true;
  texture.Dimensions = { this->Dimensions[0], this->Dimensions[1], this->Dimensions[2] };
  texture.Components = this->NumberOfInvalidCells > 0 ? 4 : 3;
  const bool periodic =
    this->Parameterization == HALF_DIFFERENCE || this->AzimuthRange == FULL_TURN;
  texture.Repeat = { periodic, false, false };

  const TabulatedStorage storage =
    TabulatedStorage::Choose(this->Precision, this->ResamplingTolerance, this->Volume);
  FillTexture(texture, this->Volume, storage);

  const bool half = this->AzimuthRange == HALF_TURN;
  if (this->Parameterization == HALF_DIFFERENCE)
  {
    measuredbrdf::SetModuleShader(term, "vtkBRDFHalfDifference", vtkBRDFHalfDifference);
  }
  else
  {
    measuredbrdf::SetModuleShader(term, "vtkBRDFIncidentOutgoing", vtkBRDFIncidentOutgoing);
  }
  term.Uniforms.push_back({ "brdfScale", { 1.0f / storage.Scale } });
  term.Uniforms.push_back({ "brdfTurns", { half ? 2.0f : 1.0f } });
  term.Uniforms.push_back({ "brdfCosineWeighted", { this->CosineWeighted ? 1.0f : 0.0f } });
  TextStream text;
  text << (this->Parameterization == HALF_DIFFERENCE ? "half/difference" : "incident/outgoing")
       << " volume " << this->Dimensions[0] << " x " << this->Dimensions[1] << " x "
       << this->Dimensions[2] << ", " << storage.GetText() << ", " << texture.GetBytes()
       << " bytes";
  if (this->ResamplingError > 0.0)
  {
    text << ", resampling error " << this->ResamplingError;
  }
  const Levels* levels = form.SoftLights ? this->GetLevels() : nullptr;
  term.Fetches = levels ? 2 : 1;
  if (levels)
  {
    vtkBRDFShaderInputs::Texture wider;
    wider.Name = "brdfLevels";
    wider.ThreeD = true;
    wider.Dimensions = levels->Values->GetDimensions();
    wider.Components = texture.Components;
    wider.Repeat = texture.Repeat;
    FillTexture(wider, levels->Values->GetVolume(), storage);
    term.SoftSource = vtkBRDFHalfDifferenceSoft;
    term.Uniforms.push_back(
      { "brdfNumberOfLevels", { static_cast<float>(levels->Values->GetNumberOfLevels()) } });
    term.Uniforms.push_back(
      { "brdfFirstCount", { static_cast<float>(levels->Values->GetFirstCount()) } });
    term.Uniforms.push_back(
      { "brdfOwnVariance", { static_cast<float>(levels->Values->GetOwnVariance()) } });
    text << ", wider for soft lights: " << levels->Values->GetNumberOfLevels() << " levels, "
         << wider.GetBytes() << " bytes";
    term.Textures.push_back(std::move(wider));
  }
  term.Textures.insert(term.Textures.begin(), std::move(texture));
  form.QuantizationError = std::max(form.QuantizationError, storage.GetRounding());
  form.ResamplingError = std::max(form.ResamplingError, this->ResamplingError);
  form.Description = text.str();
  form.Terms.push_back(std::move(term));
}

//------------------------------------------------------------------------------
void vtkTabulatedBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  exchange.Option("precision", { "automatic", "float16", "float32", "shared-exponent" },
    this->Precision, [this](int value) { this->SetPrecision(value); });
  exchange.Option("cosineWeighted", { "off", "on" }, this->CosineWeighted,
    [this](int value) { this->SetCosineWeighted(value == 1); });
  exchange.Number("resamplingError", this->ResamplingError,
    [this](double value) { this->SetResamplingError(value); });
  int parameterization = this->Parameterization;
  int azimuthRange = this->AzimuthRange;
  exchange.Option("parameterization", { "half-difference", "incident-outgoing" }, parameterization,
    [&](int value) { parameterization = value; });
  exchange.Option("azimuthRange", { "half-turn", "full-turn" }, azimuthRange,
    [&](int value) { azimuthRange = value; });
  if (!exchange.IsLoading())
  {
    exchange.SaveArray(
      "volume", { this->Dimensions[2], this->Dimensions[1], this->Dimensions[0] }, 3, this->Volume);
    return;
  }
  auto volume = exchange.LoadArray("volume", 3, 3);
  const int dimensions[3] = { volume.Shape[2], volume.Shape[1], volume.Shape[0] };
  if (!this->SetVolume(parameterization, azimuthRange, dimensions, std::move(volume.Values)))
  {
    exchange.Fail("array 'volume' was refused");
  }
}

//------------------------------------------------------------------------------
vtkBRDF* vtkTabulatedBRDF::NewCopy()
{
  vtkTabulatedBRDF* copy = vtkTabulatedBRDF::New();
  copy->Parameterization = this->Parameterization;
  copy->AzimuthRange = this->AzimuthRange;
  std::copy_n(this->Dimensions, 3, copy->Dimensions);
  copy->Precision = this->Precision;
  copy->CosineWeighted = this->CosineWeighted;
  copy->ResamplingError = this->ResamplingError;
  copy->Volume = this->Volume;
  copy->NumberOfInvalidCells = this->NumberOfInvalidCells;
  copy->WidenedLevels = this->WidenedLevels;
  return copy;
}

//------------------------------------------------------------------------------
std::pair<std::type_index, std::string> vtkTabulatedBRDF::GetContent()
{
  measuredbrdf::ContentHash hash;
  hash.AddValue(this->Parameterization);
  hash.AddValue(this->AzimuthRange);
  hash.Add(this->Dimensions, sizeof(this->Dimensions));
  hash.AddValue(this->Precision);
  hash.AddValue(this->CosineWeighted);
  hash.AddValue(this->ResamplingError);
  hash.AddValues(this->Volume);
  return { typeid(vtkTabulatedBRDF), hash.GetText() };
}
