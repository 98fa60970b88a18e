// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One channel of a D-BRDF with a Lambert part, and the steps that fit it to the samples.
 */

#ifndef DistributionChannel_h
#define DistributionChannel_h

#include "DistributionGeometry.h"

#include <Eigen/Core>

namespace measuredbrdf
{
/// f = Lambert + p F / (4 (cos_i + cos_o - cos_i cos_o)).
struct DistributionTables
{
  Eigen::VectorXd P;
  Eigen::VectorXd F;
  double Lambert = 0.0; // albedo / pi
};

class DistributionChannel
{
public:
  /**
   * basis: F is a non-negative sum of its columns. tieFresnel: for tables, whose samples may lie
   * where there are no data. The arguments must outlive this object.
   */
  DistributionChannel(const FitSamples& samples, const DistributionGeometry& geometry,
    const Eigen::MatrixXd& basis, bool tieFresnel, int channel);

  DistributionTables Tables;

  /// This channel's part of the weighted mean square over RGB.
  double GetMeanSquare() const { return this->MeanSquare(this->Tables); }

  /**
   * Improve p, then F, each with the Lambert part: linearize T about the current model
   * (Gauss-Newton), solve by non-negative least squares, and choose a step length that lowers the
   * mean square.
   */
  void Sweep();

private:
  double DistributionAt(const DistributionGeometry::Place& place, const Eigen::VectorXd& p) const;
  double MeanSquare(const DistributionTables& tables) const;
  void Linearize(const FitSample& sample, double f, double& weight, double& target) const;
  void SolveDistribution();
  void SolveFresnel();
  void Search(const DistributionTables& goal);

  const FitSamples& Samples;
  const DistributionGeometry& Geometry;
  const Eigen::MatrixXd& Basis;
  bool TieFresnel;
  int Index;
};
} // namespace measuredbrdf

#endif
