// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The table of vtkTableRadianceIntegrator: its look-ups.
 */

#ifndef RadianceTable_h
#define RadianceTable_h

#include "LobeViews.h"
#include "Neighbors.h"
#include "SharedExponent.h"
#include "TableTiles.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace measuredbrdf
{
class TableLamps;

struct RadianceTable
{
  static constexpr int ProfileSize = LobeViews::NumberOfViews;
  static constexpr int IrradianceSide = 129; // texels, of the octahedral map of irradiance
  /// With a shared exponent (SharedExponent.h).
  using Texels = std::vector<std::uint32_t>;

  /// rows: more than TableTiles::LargestWhole are those of tiles.
  RadianceTable(int rows, int angles, int azimuths)
    : Rows(TableTiles::GetRows(rows))
    , Columns(2 * (this->Rows - 1))
    , Angles(angles)
    , Azimuths(azimuths)
    , Tiles(rows, angles * (azimuths + 1))
  {
  }

  int Rows; // of the map that is everywhere
  int Columns;
  int Angles;
  int Azimuths;
  TableTiles Tiles;
  bool HasFloor = false;
  std::vector<float> Profile; // RGB, ProfileSize x 3: (angle, cos, sin delta); share; c
  // Columns x GetHeight() x Angles (Azimuths + 1): the first azimuth comes again after the last. As
  // large as the format allows: the profile's share undoes that.
  Texels Radiance;
  // IrradianceSide x IrradianceSide (GetOctahedralPosition); null: there is no floor. Of all
  // materials.
  std::shared_ptr<const ScaledTexels> Irradiance;

  /// Of a slice: the map, and tiles below it.
  int GetHeight() const { return this->Rows + TableTiles::Texels * this->Tiles.Down; }

  /// Where the map of a view angle and an azimuth psi begins, in texels.
  std::size_t GetMap(int angle, int azimuth) const
  {
    return static_cast<std::size_t>(angle * (this->Azimuths + 1) + azimuth) *
           static_cast<std::size_t>(this->Columns) * static_cast<std::size_t>(this->GetHeight());
  }

  /// Radiance towards o about the normal n, as the shader looks it up; t: a unit tangent or zero;
  /// lamps: beside the table, or null.
  glm::dvec3 Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t,
    const TableLamps* lamps = nullptr) const;

  /// A map of irradiance at a normal.
  static glm::dvec3 GetIrradiance(const ScaledTexels& map, const glm::dvec3& n);
};
} // namespace measuredbrdf

#endif
