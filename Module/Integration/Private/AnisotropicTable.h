// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The table of vtkTableRadianceIntegrator for anisotropic materials, which has no tiles:
 *
 *   L_o = c(theta_o, phi_o) E(n) + s(theta_o, phi_o) T(D, psi, theta_o, phi_o)
 *
 * D is the direction of the lobe's axis. psi is the azimuth about D of the tangent, carried from
 * the normal to the axis by the smallest rotation. In this frame lobes of neighboring views
 * resemble each other, so few views suffice, between which T is interpolated linearly.
 *
 * T is a 3D texture: azimuth of D; polar angle of D within azimuths of the view; psi within polar
 * angles of the view. Four trilinear fetches interpolate it in all five numbers. f that is the same
 * after half a turn of the sample, as of brushed metal, needs views over half a turn only.
 */

#ifndef AnisotropicTable_h
#define AnisotropicTable_h

#include "EnvironmentHarmonics.h"
#include "LobeViews.h"
#include "MaterialPrecomputation.h"
#include "RadianceTable.h"

#include <algorithm>
#include <cstddef>
#include <functional>

namespace measuredbrdf
{
struct AnisotropicTable : RadianceTable
{
  AnisotropicTable(int rows, int angles, int azimuths, int viewAzimuths)
    : RadianceTable(std::min(rows, TableTiles::LargestWhole), angles, azimuths)
    , ViewAzimuths(viewAzimuths)
  {
  }

  // The profile is RGB, AnisotropicViews::Angles x Azimuths x 3: (the axis' parts along and across
  // the view's part along the surface, view angle); share; c. Radiance is of Columns x (Rows
  // ViewAzimuths) x (Angles (Azimuths + 1)) texels.
  int ViewAzimuths; // over the period
  int Periods = 1;  // of f in a turn, 1 or 2

  std::size_t GetNumberOfTexels() const
  {
    return static_cast<std::size_t>(this->Columns) * this->Rows;
  }

  /// The radiance, of kernels up to a harmonic degree. goOn gets the share that is done; where it
  /// says false, the table is not complete, and the result is 0. Else it is what undoes the
  /// radiance's scaling.
  double Synthesize(const EnvironmentHarmonics& environment, const MaterialKernels& knots,
    int degree, const std::function<bool(double)>& goOn);

  /// The profile over all views; scale: what undoes the radiance's scaling.
  void MakeProfile(const AnisotropicViews& views, const MaterialKernels& knots, double scale);

  glm::dvec3 Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t,
    const TableLamps* lamps = nullptr) const override;
  vtkBRDFShaderInputs GetShaderInputs() const override;

private:
  glm::dvec3 GetProfile(int layer, double u, double period) const;
};
} // namespace measuredbrdf

#endif
