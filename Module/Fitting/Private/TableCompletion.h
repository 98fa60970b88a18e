// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A smooth table over half and difference angles through values at some pairs of directions.
 */

#ifndef TableCompletion_h
#define TableCompletion_h

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace measuredbrdf
{
/// A pair of directions at which values are known, and how much they count.
struct TablePoint
{
  double I[3];
  double O[3];
  double Weight;
};

/**
 * Tables of vtkTabulatedBRDF's form HALF_DIFFERENCE and HALF_TURN, mirror-symmetric in phi_d. In
 * the logarithm, which keeps values positive and lobes smooth, a table minimizes the weighted
 * squared differences at the points plus squared second differences along the axes. One sparse
 * Cholesky factorization (Eigen) serves for all tables. A table's values between its cells are
 * interpolated as vtkTabulatedBRDF does, which is linear in the value, not in its logarithm: the
 * differences that this leaves are smoothed and added again, some times over (iterated Tikhonov
 * regularization, King and Chillingworth 1979).
 */
class TableCompletion
{
public:
  /// Cells along phi_d, theta_d and theta_h. smoothness > 0: weight of the second differences.
  TableCompletion(
    const std::vector<TablePoint>& points, const std::array<int, 3>& dimensions, double smoothness);

  /// Whether the factorization failed.
  bool HasFailed() const { return this->Failed; }

  /**
   * The cells' values, phi_d fastest, from the points' values >= 0. All lie between the least and
   * the largest of these.
   */
  std::vector<double> Complete(const std::vector<double>& values) const;

  /// Share of the cells above the horizon that some point touches.
  double GetSeenShare() const { return this->SeenShare; }

private:
  using Matrix = Eigen::SparseMatrix<double>;
  void AddPoint(
    const TablePoint& point, int row, std::vector<Eigen::Triplet<double>>& entries) const;
  Matrix MakeRoughness() const;
  double FindSeenShare(const Matrix& gram) const;

  std::array<int, 3> Dimensions;
  Matrix Interpolation;    // two rows for each point: it and its mirror image
  Eigen::VectorXd Weights; // of the rows
  Eigen::SimplicialLDLT<Matrix> Solver;
  double SeenShare = 0.0;
  bool Failed = false;
};
} // namespace measuredbrdf

#endif
