// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From a table's Fourier series over the azimuth of the plane of incidence to its slices. Both have
 * as many numbers, so that the series lies where the slices will.
 */

#ifndef AzimuthSeries_h
#define AzimuthSeries_h

#include "FieldSynthesis.h"

#include <array>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// Radiance = G_0 + sum_k>0 2 Re(e^(-i k psi) G_k), at each texel of each view angle's map.
class AzimuthSeries
{
public:
  /// Of orders up to half of the azimuths; those that are not set are 0.
  AzimuthSeries(int angles, int azimuths, std::size_t texels);

  int GetLastOrder() const { return this->Azimuths / 2; }

  /// G_k of each channel: angles x texels.
  void Set(int order, const std::array<FieldSynthesis::Field, 3>& fields);

  /// RGB by view angle and azimuth, the first one again after the last, fitted for linear
  /// interpolation between azimuths (LinearSpline.h). Nothing is left here.
  std::vector<float> TakeRadiance();

private:
  std::size_t GetSlices() const { return static_cast<std::size_t>(this->Azimuths) + 1; }
  std::vector<float> GetTurns() const;

  int Angles;
  int Azimuths;
  std::size_t Size; // RGB of a map
  std::vector<float> Values;
};
} // namespace measuredbrdf

#endif
