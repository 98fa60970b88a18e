// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Radiance of kernels over all positions of their axis, by a convolution over the rotation group
 * (Kostelec, Rockmore 2008). Private to the module.
 */

#ifndef FieldSynthesis_h
#define FieldSynthesis_h

#include "DegreeSum.h"
#include "EnvironmentHarmonics.h"
#include "MapPart.h"

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// Where the values of a map over polar angle and azimuth lie: the first and the last row at the
/// poles and the first column at 0, fitted for linear interpolation (LinearSpline.h); or all at
/// cells' centers, as in an environment.
enum class MapNodes
{
  Poles,
  Centers
};

/// Kernels are given by their harmonics b_lk. Over a map of rows x columns of the axis' polar angle
/// and azimuth, each kernel, channel and azimuthal order k has a field of complex values G_k such
/// that radiance = G_0 + sum_k>0 2 Re(e^(-i k psi) G_k). psi is the plane of incidence's azimuth
/// from the meridian's direction of growing polar angle. G_k = sum_m e^(-i m phi) sum_l
/// d^l_mk(theta) b_lk conj(a_lm).
class FieldSynthesis
{
public:
  using Matrix = DegreeSum::Matrix;
  using Field = std::vector<std::complex<float>>;

  ///@{
  /// Of a whole map, or of nodes of it: splines need both neighbors, a node without has its own
  /// value.
  FieldSynthesis(const EnvironmentHarmonics& environment, int rows, int columns, MapNodes nodes);
  FieldSynthesis(const EnvironmentHarmonics& environment, const MapPart& part, MapNodes nodes);
  ///@}

  /// Of each channel: degrees x kernels.
  using Kernels = DegreeSum::Kernels;

  /// Light of its own for kernels of its own, added to the others.
  struct More
  {
    const EnvironmentHarmonics& Light;
    std::array<Matrix, 3> Kernels;
  };

  /// result of each channel: [kernel][node]. more: as many kernels, or null.
  void Run(
    int order, const Kernels& kernels, std::array<Field, 3>& result, const More* more = nullptr);

private:
  void FindNeighbors();
  void FitRows(int order, std::array<Field, 3>& result) const;
  void SumOrders(int order, std::array<Field, 3>& result) const;

  const EnvironmentHarmonics& Environment;
  MapPart Part;
  MapNodes Nodes;
  DegreeSum Degrees;
  struct Neighbors
  {
    int Above, Below;
    bool IsAbovePole, IsBelowPole; // on the meridian opposite
  };
  std::vector<Neighbors> NeighborsOf; // of each node
};
} // namespace measuredbrdf

#endif
