// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Radiance of kernels over all positions of their axis, by a convolution over the rotation group
 * (Kostelec, Rockmore 2008). Private to the module.
 */

#ifndef FieldSynthesis_h
#define FieldSynthesis_h

#include "EnvironmentHarmonics.h"
#include "WignerLanes.h"

#include <Eigen/Core>

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
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic>;
  using Field = std::vector<std::complex<float>>;

  /// chosen: of a map's rows only these, ascending, as if they were all of its rows (splines need
  /// both neighbors; a row without has its own values). None: all of them.
  FieldSynthesis(const EnvironmentHarmonics& environment, int rows, int columns, MapNodes nodes,
    const std::vector<int>& chosen = {});

  /// Of each channel: degrees x kernels.
  using Kernels = std::array<Matrix, 3>;

  /// Light of its own for kernels of its own, added to the others.
  struct More
  {
    const EnvironmentHarmonics& Light;
    std::array<Matrix, 3> Kernels;
  };

  /// result of each channel: [kernel][row][column]. more: as many kernels, or null.
  void Run(int order, const Kernels& kernels, std::array<Field, 3>& result,
    const More* more = nullptr) const;

private:
  struct Turns
  {
    int First;                 // degree
    std::size_t Size;          // degrees
    std::size_t Begin, End;    // rows that are not 0
    std::vector<float> Values; // by row
  };
  Turns GetTurns(int m, int order, int degree) const;
  /// Of order 0, which is real, of m >= 0 only.
  std::vector<float> SumDegrees(int order, const Kernels& kernels, const More* more) const;
  void FitRows(int order, std::array<Field, 3>& result) const;
  void SumOrders(
    int order, const std::vector<float>& series, int degree, std::array<Field, 3>& result) const;
  bool AreRowsSymmetric() const; // about the equator

  const EnvironmentHarmonics& Environment;
  int AllRows;
  std::vector<int> Chosen; // of these
  std::vector<WignerLanes> Angles;
  int Rows; // that are chosen
  int Columns;
  MapNodes Nodes;
};
} // namespace measuredbrdf

#endif
