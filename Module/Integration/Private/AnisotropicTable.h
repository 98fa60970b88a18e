// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The table of vtkAnisotropicTableRadianceIntegrator: its look-ups. Private to the module.
 */

#ifndef AnisotropicTable_h
#define AnisotropicTable_h

#include "AnisotropicViews.h"
#include "RadianceTable.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace measuredbrdf
{
struct AnisotropicTable
{
  AnisotropicTable(int rows, int angles, int azimuths, int viewAzimuths)
    : Rows(rows)
    , Columns(2 * (rows - 1))
    , Angles(angles)
    , Azimuths(azimuths)
    , ViewAzimuths(viewAzimuths)
  {
  }

  int Rows;
  int Columns;
  int Angles;
  int Azimuths;
  int ViewAzimuths; // over the period
  int Periods = 1;  // of f in a turn, 1 or 2
  bool HasFloor = false;
  // RGB, AnisotropicViews::Angles x Azimuths x 3: (the axis' parts along and across the view's part
  // along the surface, view angle); share; c
  std::vector<float> Profile;
  // Columns x (Rows ViewAzimuths) x (Angles (Azimuths + 1)): psi's first value comes again after
  // the last.
  RadianceTable::Texels Radiance;
  std::shared_ptr<const ScaledTexels> Irradiance; // as RadianceTable's

  std::size_t GetNumberOfTexels() const
  {
    return static_cast<std::size_t>(this->Columns) * static_cast<std::size_t>(this->Rows);
  }

  /// Where the map of a view angle, an azimuth psi and a view's azimuth begins, in texels.
  std::size_t GetMap(int angle, int azimuth, int viewAzimuth) const
  {
    return static_cast<std::size_t>(
             (angle * (this->Azimuths + 1) + azimuth) * this->ViewAzimuths + viewAzimuth) *
           this->GetNumberOfTexels();
  }

  /// Radiance towards o about the normal n, as the shader looks it up; t: a unit tangent or zero.
  glm::dvec3 Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t) const;

private:
  glm::dvec3 GetProfile(int layer, double u, double period) const;
};
} // namespace measuredbrdf

#endif
