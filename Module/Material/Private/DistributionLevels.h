// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A tabulated p(theta_h) at growing widths, for soft lights. Private to the material room.
 */

#ifndef DistributionLevels_h
#define DistributionLevels_h

#include "Neighbors.h"

#include <vector>

namespace measuredbrdf
{
/**
 * Level k of Count is p convolved on the sphere with a von Mises-Fisher distribution of variance
 * (1/kappa) s (r^(k/(Count - 1)) - 1), r = 1 + 1/s, s = p's own variance: from 0 to 1, in steps
 * that lower a lobe's peak by equal factors. Between levels: linear.
 */
class DistributionLevels
{
public:
  static constexpr int Count = 24;

  /// p at the nTheta table angles of vtkDistributionBRDF, RGB triples.
  DistributionLevels(int nTheta, const std::vector<float>& p);

  /// Count rows of nTheta RGB triples; row 0 is p itself.
  const std::vector<float>& GetRows() const { return this->Rows; }

  double GetOwnVariance() const { return this->OwnVariance; }

  /// The levels around a variance >= 0 in h.
  Neighbors Find(double variance) const;

private:
  double OwnVariance = 1.0;
  std::vector<float> Rows;
};
} // namespace measuredbrdf

#endif
