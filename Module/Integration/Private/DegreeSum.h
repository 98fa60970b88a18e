// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sum over degrees of a convolution over the rotation group: most of the time of a large
 * table's synthesis. Private to the module.
 */

#ifndef DegreeSum_h
#define DegreeSum_h

#include "EnvironmentHarmonics.h"
#include "WignerLanes.h"

#include <Eigen/Core>

#include <array>
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
} // namespace measuredbrdf

#endif
