// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a smoothed table of radiance lacks of sharp lobes, factored: the kernels' harmonics about
 * the lobe's axis, less what the table has of them, are decomposed by singular values for each
 * azimuthal order, weighted by what the environment's degrees make of them. Each mode is a function
 * about the axis, convolved with the environment once, times a weight over theta_o:
 *
 *   T(axis, theta_o, psi) = sum_k W_k(theta_o) (cos(m_k psi) A_k(axis) + sin(m_k psi) B_k(axis))
 *
 * This is the thesis's pair of textures, coefficients and functions, with the light in one of them.
 */

#ifndef RadianceCore_h
#define RadianceCore_h

#include "EnvironmentHarmonics.h"
#include "FieldSynthesis.h"
#include "LobePlacement.h" // for ProfileTexels
#include "LobeViews.h"
#include "MaterialPrecomputation.h"
#include "Neighbors.h"
#include "RadianceTable.h"

#include <Eigen/Core>
#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// Kernels at view angles (LobeViews::GetKnotAngle), and the table that takes their broad part.
struct CoreKernels
{
  MaterialKernels& Knots;
  MaterialKernels& TableKnots; // at the table's view angles
  const RadianceTable& Table;  // its profile (MakeProfile, scale 1)
  double Smoothing;            // of the table, GetSmoothed
  int Rows;                    // of the maps
  int Degree;                  // of the harmonics

  double GetViewAngle(std::size_t knot) const;
};

struct RadianceCore
{
  static constexpr int LargestOrder = 8; // lobes that are longer than wide; more tells nothing

  explicit RadianceCore(int rows)
    : Rows(rows)
    , Columns(2 * rows)
  {
  }

  int Rows; // of the fields, whose values lie at cells' centers
  int Columns;
  std::vector<int> Orders;    // m of each mode, ascending
  std::vector<float> Profile; // RGB, ProfileSize x (1 + modes): (0, cos, sin delta); W_k
  std::vector<float> Fields;  // RGB, Columns x Rows x fields, of 16 bits: A_k and, for m > 0, B_k

  int GetNumberOfFields() const;

  /// Weights as shaders read them: those of all modes one after the other, four in a texel RGBA of
  /// a row of ProfileTexels; and how many rows so many modes take.
  std::vector<float> GetShaderWeights() const;
  static int CountWeightRows(int modes) { return (3 * modes + 3) / 4; }
  std::size_t GetNumberOfTexels() const
  {
    return static_cast<std::size_t>(this->Columns) * this->Rows;
  }

  /// Radiance, of either sign, towards o about the normal n, as the shader looks it up; t: a unit
  /// tangent or zero.
  glm::dvec3 Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const;

  /// What a table lacks of the kernels, by at most so many fields. goOn gets the share that is
  /// done; where it says false, so does this.
  bool Make(const EnvironmentHarmonics& environment, const LobeViews& views,
    const CoreKernels& kernels, int fields, const std::function<bool(double)>& goOn);

  /// Adds the same to a table's form.
  void AddTo(vtkBRDFShaderInputs& inputs) const;

private:
  double AddFields(int order, const FieldSynthesis::Fields& fields, std::size_t mode);
};
} // namespace measuredbrdf

#endif
