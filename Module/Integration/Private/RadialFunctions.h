// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material's functions as vtkBasisRadianceIntegrator integrates them. Private to the module.
 */

#ifndef RadialFunctions_h
#define RadialFunctions_h

#include "AzimuthalBasis.h"

#include <Eigen/Core>
#include <glm/glm.hpp>

#include <vector>

class vtkBasisBRDF;

namespace measuredbrdf
{
constexpr int IncidentNodes = 128; // of V in the maps' sums
constexpr int ViewNodes = 256;     // of U in the texture

/// One radial function: its order, V cos(theta_i) at the incident nodes, U at the view nodes.
/// Orders above 0 count twice, for cosine and sine.
struct Radial
{
  int Order;
  Eigen::VectorXf Incident;
  std::vector<glm::dvec3> Cosine;
  std::vector<glm::dvec3> Sine; // or empty
};

/// A term of a computed basis.
Radial ToRadial(const AzimuthalBasis::Term& term);

/// A basis pair's own functions, orders ascending.
std::vector<Radial> GetOwnBasis(vtkBasisBRDF* brdf);
} // namespace measuredbrdf

#endif
