// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a blurred table of radiance lacks of a material's kernels, as few functions about the lobe's
 * axis with weights by view angle: for each azimuthal order the best ones by singular values.
 * Private to the module.
 */

#ifndef CoreModes_h
#define CoreModes_h

#include "EnvironmentHarmonics.h"
#include "MaterialPrecomputation.h"
#include "RadianceTable.h"

#include <Eigen/Core>
#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/// Kernels at view angles (LobeViews::GetKnotAngle), and the table that takes their broad part.
struct CoreKernels
{
  const MaterialPrecomputation::Kernels& Knots;
  const MaterialPrecomputation::Kernels& TableKnots; // at the table's view angles
  const RadianceTable& Table;                        // its profile (MakeProfile, scale 1)
  const LobeViews& Views;
  double Smoothing;              // of the table, GetSmoothed
  int Rows;                      // of the maps
  int Degree;                    // of the harmonics
  MaterialPrecomputation& Known; // that knows the remainders, or will

  double GetViewAngle(std::size_t knot) const;
  double GetAxis(std::size_t knot) const;
};

/// A function about the axis, cos or sin of order times psi, and its weight of each view.
struct CoreMode
{
  static constexpr int LargestOrder = 8; // lobes that are longer than wide; more tells nothing

  int Order = 0;
  double Energy = 0.0;      // of what it explains, by field
  Eigen::VectorXd Function; // harmonics of that order, by degree
  Eigen::VectorXd Weights;  // by knot and channel

  /// A mode of an order above 0 takes two fields, of the cosine and of the sine.
  static int CountFields(int order) { return order > 0 ? 2 : 1; }

  /// Interpolated between the knots.
  glm::dvec3 GetWeight(const CoreKernels& kernels, double theta) const;
};

/// The modes that explain most under an environment, in so many fields at most; orders ascend.
std::vector<CoreMode> ChooseModes(
  const EnvironmentHarmonics& environment, const CoreKernels& kernels, int fields);
} // namespace measuredbrdf

#endif
