// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How the table of vtkTableRadianceIntegrator is made.
 */

#ifndef TableSynthesis_h
#define TableSynthesis_h

#include "EnvironmentHarmonics.h"
#include "FieldSynthesis.h"
#include "HalfVector.h" // for Pi
#include "Lamps.h"
#include "MaterialPrecomputation.h"
#include "RadianceTable.h"
#include "WignerD.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace measuredbrdf
{
/// The clamped cosine's harmonics, of degree l and order 0 about its axis; the others are 0.
inline double GetClampedCosine(int l)
{
  double value = l == 1 ? 2.0 * Pi / 3.0 : 0.0;
  if (l % 2 == 0)
  {
    value = 2.0 * Pi * (l % 4 == 0 ? -1.0 : 1.0) / ((l + 2.0) * (l - 1.0)) *
            std::exp(LogFactorial(l) - 2.0 * LogFactorial(l / 2) - l * std::log(2.0));
  }
  return value * std::sqrt((2.0 * l + 1.0) / (4.0 * Pi));
}

/// From a table's Fourier series over the azimuth of the plane of incidence to its slices: radiance
/// = G_0 + sum_k>0 2 Re(e^(-i k psi) G_k), at each texel of each view angle's map. Both have as
/// many numbers, so that the series lies where the slices will.
class AzimuthSeries
{
public:
  /// Of orders up to half of the azimuths; those that are not set are 0.
  AzimuthSeries(int angles, int azimuths, std::size_t texels);

  int GetLastOrder() const { return this->Azimuths / 2; }

  /// G_k of each channel: some angles from the first on x texels.
  void Set(int order, const FieldSynthesis::Fields& fields, std::size_t firstAngle = 0);

  /// RGB by view angle and azimuth, the first one again after the last, fitted for linear
  /// interpolation between azimuths (FieldSynthesis.h). Nothing is left here.
  std::vector<float> TakeRadiance();

private:
  std::size_t GetSlices() const { return static_cast<std::size_t>(this->Azimuths) + 1; }
  std::vector<float> GetTurns() const;

  int Angles;
  int Azimuths;
  std::size_t Size; // RGB of a map
  std::vector<float> Values;
};

/// Degree of the harmonics that a map of irradiance needs: the cosine's fall as l^-2.5.
constexpr int IrradianceDegree = 128;

/// Degree of the harmonics that make a map of so many rows, unless it is set. More than the rows
/// resolve, which measured best (docs/methods/tables.md).
inline int GetMapDegree(int rows) { return rows + std::min(rows / 2, 64); }

/// Harmonics that end at once make lamps ring: from three fifths of the rows on they fade out.
inline double GetTaper(int l, int degree, int rows)
{
  const double from = 0.6 * rows;
  return l <= from ? 1.0 : 0.5 + 0.5 * std::cos(Pi * (l - from) / (degree + 1.0 - from));
}

/// What a blur leaves of degree l; smoothing: vtkTableRadianceIntegrator::SetSmoothingDegree.
inline double GetSmoothed(int l, double smoothing)
{
  return smoothing > 0.0 ? std::exp(-0.5 * l * (l + 1.0) / (smoothing * smoothing)) : 1.0;
}

/// What a table of so many rows has of the kernels at its view angles: harmonics about each one's
/// axis, times its albedo, less what a blur takes and what fades, as ExpandLobes has them. window:
/// only what lies outside of it; null: all.
std::vector<std::vector<float>> ExpandTableKernels(MaterialKernels& knots, int degree, int orders,
  double smoothing, int rows, const LampWindow* window = nullptr);

/// What a table shows.
struct TableLight
{
  const EnvironmentHarmonics& Environment; // without lamps, if All is given
  const EnvironmentHarmonics* All;         // with them; null: there are none
  LampWindow Window;                       // about the axis: the table has no lamps within it
};

/// The table's radiance, of kernels at its view angles up to a harmonic degree. goOn gets the share
/// that is done; where it says false, the table is not complete, and the result is 0. Else it is
/// what undoes the radiance's scaling.
double SynthesizeRadiance(const TableLight& light, MaterialKernels& knots, int degree,
  double smoothing, const std::function<bool(double)>& goOn, RadianceTable& table);

/// RGB scaled so that the peak is the format's largest value, whatever the unit of the light is;
/// negative values are 0. Returns what undoes the scaling.
double PackRadiance(const std::vector<float>& radiance, RadianceTable::Texels& texels);

/// Puts what a profile has at a number of its texels: what is first; the rest's share, which sees
/// to it that what interpolation between kernels misses of the lobe's directional albedo goes to
/// the rest; and the Lambert part, if there is one, as the result says. The profile has a third of
/// its numbers for each of these. scale: what undoes the radiance's scaling.
bool PutProfile(const LobeMeans& lobe, const LobeMeans& between, const glm::dvec3& first,
  double scale, std::size_t at, std::vector<float>& profile);

/// A table's profile over all view angles; scale: what undoes its radiance's scaling.
void MakeProfile(
  const LobeViews& views, const MaterialKernels& knots, double scale, RadianceTable& table);

/// An octahedral map of irradiance.
std::shared_ptr<const ScaledTexels> MakeIrradiance(const EnvironmentHarmonics& environment);
} // namespace measuredbrdf

#endif
