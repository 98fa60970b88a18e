// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Radiance of kernels over all positions of their axis, by a convolution over the rotation group
 * (Kostelec, Rockmore 2008).
 */

#ifndef FieldSynthesis_h
#define FieldSynthesis_h

#include "EnvironmentHarmonics.h"
#include "MapPart.h"
#include "WignerLanes.h"

#include <Eigen/Core>

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/**
 * For rows of polar angles theta, orders m of the azimuth and kinds (a channel's kernels, one
 * channel after the other): sum_l d^l_mk(theta) b_lk conj(a_lm). The kernels' harmonics b_lk are
 * real.
 *
 * d^l_-mk(pi - theta) = (-1)^(l-k) d^l_mk(theta), a_l,-m = (-1)^m conj(a_lm): with the sums over
 * even and over odd l - k of b_lk a_lm d^l_mk(theta), E and O, m has the conjugate of E + O, and
 * -m has (-1)^m (E - O) at pi - theta.
 */
class DegreeSum
{
public:
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic>;
  using Kernels = std::array<Matrix, 3>; // of each channel: degrees x kernels

  /// Light, and the kernels that see it.
  struct Part
  {
    const EnvironmentHarmonics& Light;
    const Kernels& Of;
  };

  /// theta: of all rows of a map, which lie alike on both sides of the equator. rows: those that
  /// are wanted, ascending.
  DegreeSum(const std::vector<double>& theta, const std::vector<int>& rows);

  /// The sum over parts, all of as many degrees and kernels. Of order k = 0 of m >= 0 only: others
  /// are conjugates. On several threads.
  void Run(int order, const std::vector<Part>& parts);

  /// Of a row by its number among those that are wanted: the real parts of all kinds, then the
  /// imaginary parts; a few more numbers may be read. Null: all are 0.
  const float* Get(std::size_t row, int m) const
  {
    const std::size_t at = row * this->Orders + static_cast<std::size_t>(m + this->Degree);
    return this->Known[at] ? &this->Series[at * this->Width] : nullptr;
  }

  std::size_t GetNumberOfKinds() const { return this->Kinds; }
  int GetDegree() const { return this->Degree; }

private:
  static constexpr std::size_t None = static_cast<std::size_t>(-1);
  struct Row
  {
    std::size_t Place;  // among those that are wanted, or None
    std::size_t Mirror; // of the row opposite
  };
  struct Panel
  {
    WignerLanes Angles;
    std::array<Row, WignerLanes::Count> Rows;
  };
  using Packed = std::vector<std::vector<float>>; // of each part: kinds by degree

  static std::vector<Panel> MakePanels(
    const std::vector<double>& theta, const std::vector<Row>& rows, const std::vector<int>& at);
  void AddOrders(int m, int order, const std::vector<Part>& parts, const Packed& packed);
  void Multiply(const Panel& panel, int m, int order, int first, std::size_t size,
    std::size_t begin, const std::vector<float>& turns, const std::vector<float>& lit);

  std::vector<Panel> All;   // the rows that are wanted and those opposite
  std::vector<Panel> North; // of these, those up to the equator
  std::size_t Wanted;
  int Degree = 0;
  std::size_t Orders = 0, Kinds = 0, Width = 0;
  std::vector<float> Series;    // [row][m][kind]
  std::vector<char> Known;      // [row][m]
  std::vector<float> Conjugate; // what makes a row's numbers those of conjugates
};

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
