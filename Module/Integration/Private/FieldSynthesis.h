// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Radiance of kernels over all positions of their axis, by a convolution over the rotation group
 * (Kostelec, Rockmore 2008), and how it is stored for linear interpolation.
 */

#ifndef FieldSynthesis_h
#define FieldSynthesis_h

#include "EnvironmentHarmonics.h"
#include "HalfVector.h" // for Pi
#include "SynthesisLanes.h"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
///@{
/// What to store at nodes between which a texture unit interpolates linearly. A function's own
/// values there make the error of one sign between nodes; values that make the squared error over
/// the whole axis least leave about 1/sqrt(6) of it (Blu, Unser 1999, "Quantitative Fourier
/// Analysis of Approximation Techniques I").
///
/// For a Fourier series over a circle of nodes: what a term with so many periods per node is
/// multiplied by. The dual spline's spectrum, sinc^2 / ((2 + cos) / 3), beyond half a period, too.
inline double GetLinearSplineGain(double frequency)
{
  const double x = Pi * std::abs(frequency);
  const double sinc = x > 0.0 ? std::sin(x) / x : 1.0;
  return 3.0 * sinc * sinc / (2.0 + std::cos(2.0 * x));
}

/// The same where only a function's values at the nodes are known, to the second order.
inline std::complex<float> FitLinearSpline(const std::complex<float>& before,
  const std::complex<float>& value, const std::complex<float>& after)
{
  return value - (before - 2.0f * value + after) / 12.0f;
}
///@}

/// Nodes of a map over polar angle and azimuth, numbered row by row.
class MapPart
{
public:
  static constexpr int None = -1;

  /// Those that are wanted: not 0 at [row][column]. Null: all.
  MapPart(int allRows, int allColumns, const std::vector<char>* wanted = nullptr);

  /// One that has nodes.
  struct Row
  {
    int Place; // in the map
    std::size_t FirstNode;
    std::vector<int> Columns; // ascending
  };
  const std::vector<Row>& GetRows() const { return this->Rows; }

  int GetAllRows() const { return this->AllRows; }
  int GetAllColumns() const { return this->AllColumns; }
  std::size_t GetNumberOfNodes() const { return this->Count; }

  /// The number of the node there, or None. Columns go round; beyond a pole the meridian opposite
  /// goes on.
  int Find(int row, int column) const;

private:
  int AllRows, AllColumns;
  std::size_t Count = 0;
  std::vector<int> Numbers; // of all nodes
  std::vector<Row> Rows;
};

/// Where the values of a map over polar angle and azimuth lie: the first and the last row at the
/// poles and the first column at 0, fitted for linear interpolation; or all at cells' centers, as
/// in an environment.
enum class MapNodes
{
  Poles,
  Centers
};

/**
 * Kernels are given by their harmonics b_lk, which are real. Over a map of the axis' polar angle
 * theta and azimuth phi, each kernel, channel and azimuthal order k has a field of complex values
 * G_k = sum_m e^(-i m phi) sum_l d^l_mk(theta) b_lk conj(a_lm) such that radiance = G_0 + sum_k>0
 * 2 Re(e^(-i k psi) G_k). psi is the plane of incidence's azimuth from the meridian's direction of
 * growing polar angle.
 *
 * d^l_-mk(pi - theta) = (-1)^(l-k) d^l_mk(theta), a_l,-m = (-1)^m conj(a_lm): with the sums over
 * even and over odd l - k of b_lk a_lm d^l_mk(theta), E and O, m has the conjugate of E + O, and
 * -m has (-1)^m (E - O) at pi - theta.
 */
class FieldSynthesis
{
public:
  /// Harmonics of one order: kinds (a channel's kernels, one channel after the other) x degrees
  /// from 0 on.
  using Kernels = Eigen::MatrixXf;

  /// Light, and the kernels that see it.
  struct Part
  {
    const EnvironmentHarmonics& Light;
    Kernels Of;
  };

  using Field = std::vector<std::complex<float>>; // [kernel][node]
  using Fields = std::array<Field, 3>;            // of each channel

  /// Splines need both neighbors: a node without them has its own value.
  FieldSynthesis(MapPart nodes, MapNodes places);

  /// The sum over parts, all of as many degrees and kernels. On several threads.
  void Run(int order, const std::vector<Part>& parts, Fields& result);

private:
  static constexpr std::size_t None = -1;
  struct RowPair
  {
    std::size_t Place;  // of a row among those that are wanted, or None
    std::size_t Mirror; // of the row opposite
  };
  struct Panel
  {
    WignerLanes Angles;
    std::array<RowPair, WignerLanes::Count> Rows;
  };
  struct Neighbors
  {
    int Above, Below;
    bool IsAbovePole, IsBelowPole; // on the meridian opposite
  };

  std::vector<Panel> MakePanels(const std::vector<RowPair>& rows, const std::vector<int>& at) const;
  double GetPolarAngle(int row) const;
  void SumDegrees(int m, int order, const std::vector<Part>& parts);
  void Multiply(const Panel& panel, int m, int order, int first, std::size_t size,
    std::size_t begin, const std::vector<float>& turns, const std::vector<float>& lit);
  const float* GetSum(std::size_t row, int m) const;
  void SumOrders(int order, Fields& result) const;
  void FitRows(int order, Fields& result) const;

  MapPart Nodes;
  MapNodes Places;
  std::vector<Panel> All;             // the rows that are wanted and those opposite
  std::vector<Panel> North;           // of these, those up to the equator
  std::vector<Neighbors> NeighborsOf; // of each node, for splines

  // Of one run: sums over degrees, [row][m][kind]. Of order 0 of m >= 0 only, as others are
  // conjugates.
  int Degree = 0;
  std::size_t Orders = 0, Kinds = 0, Width = 0;
  std::vector<float> Series;
  std::vector<char> Known;      // [row][m]
  std::vector<float> Conjugate; // what makes a row's numbers those of conjugates
};
} // namespace measuredbrdf

#endif
