// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The table of vtkTableRadianceIntegrator: how it is stored, with tiles where it has many rows, and
 * its look-ups.
 */

#ifndef RadianceTable_h
#define RadianceTable_h

#include "FieldSynthesis.h"
#include "Floats.h"
#include "LobePlacement.h" // for ProfileTexels
#include "LobeViews.h"
#include "Neighbors.h"
#include "vtkBRDFShaderInputs.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace measuredbrdf
{
/**
 * What a lobe narrower than a map's texels reflects of a lamp overshoots, and beside the lamp it
 * may fall far below what is around, even below 0. A binomial blur of what is positive shows what
 * is around: values below three quarters of its least within two texels are lifted there, as
 * limiters do in transport schemes (Zalesak 1979). Where radiance is resolved that changes next
 * to nothing.
 *
 * radiance: RGB, maps of rows x columns behind each other, columns around.
 */
void LiftDarkRings(std::vector<float>& radiance, std::size_t rows, std::size_t columns);

/// Of one table; the nodes of the coarse map are nodes of the fine one.
struct TableTiles
{
  static constexpr int LargestWhole = 113; // rows of a table without tiles
  static constexpr int Ratio = 4;          // fine intervals in a coarse one
  static constexpr int Intervals = 8;      // fine ones along a tile's side
  static constexpr int Texels = Intervals + 1;

  /// rows: that were asked for. slices: a map each, one above the other in the texture.
  TableTiles(int rows, int slices);

  ///@{
  /// Rows of the map that is everywhere, and of the one that tiles are cut from: 0 where there are
  /// no tiles, else a multiple of 8 and one.
  static int GetRows(int rows);
  static int GetFineRows(int rows);
  ///@}

  int FineRows = 0;
  int Across = 0; // tiles side by side in the texture, below the coarse map
  int Down = 0;   // rows of them; before Choose: at most
  /// For each tile of the sphere, side by side: 1 + its place in the texture; 0: it has none.
  std::vector<float> Places;

  int GetFineColumns() const { return 2 * (this->FineRows - 1); }
  int CountRows() const { return (this->FineRows - 1) / Intervals; }
  int CountColumns() const { return 2 * this->CountRows(); }

  /// Where radiance (RGB, coarse columns x coarse rows x slices) bends most, each slice with its
  /// weight: as many tiles as there are places, or fewer that hold nearly all.
  void Choose(const std::vector<float>& radiance, const std::vector<double>& weights);

  /// The fine nodes that FieldSynthesis must know for these tiles, with some beside them.
  MapPart GetFineNodes() const;

  /// The coarse map and, below it, the tiles, of each slice; fine: RGB of those nodes, whose dark
  /// rings are lifted here. Where a tile borders on none it takes the coarse map's values, which
  /// are linear there: no seam shows.
  std::vector<float> Join(
    const std::vector<float>& coarse, const MapPart& nodes, const std::vector<float>& fine) const;

private:
  /// Whether all tiles that meet at a fine node have a place.
  bool IsInside(int row, int column) const;
  /// What a tile is made of.
  struct Tile
  {
    int Row, Column;          // of its first fine node
    std::size_t Place;        // of its first texel in a slice
    std::vector<int> Nodes;   // of it and a margin, by number
    std::vector<char> Inside; // whether its nodes are
  };
  std::vector<Tile> MakeTiles(const MapPart& nodes) const;
  void AddTiles(const std::vector<Tile>& tiles, const float* fine, float* map) const;
};

class TableLamps;

struct RadianceTable
{
  static constexpr int ProfileSize = LobeViews::NumberOfViews;
  static constexpr int IrradianceSide = 129; // texels, of the octahedral map of irradiance
  /// With a shared exponent (Floats.h).
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
           static_cast<std::size_t>(this->Columns) * this->GetHeight();
  }

  virtual ~RadianceTable() = default;

  /// Radiance towards o about the normal n, as the shader looks it up; t: a unit tangent or zero;
  /// lamps: beside the table, or null.
  virtual glm::dvec3 Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t,
    const TableLamps* lamps = nullptr) const;

  /// What a shader needs to do the same: one term.
  virtual vtkBRDFShaderInputs GetShaderInputs() const;

  /// The profile as shaders read it: RGBA of ProfileTexels view angles, the share and by how much
  /// the sine of the axis' angle exceeds that of the view's, so that what mirrors has no steps; in
  /// a second row, where there is a floor, the Lambert part.
  std::vector<float> GetShaderProfile() const;

protected:
  /// Of the Lambert part, at a normal.
  glm::dvec3 GetIrradiance(const glm::dvec3& n) const;

  /// A form of the term, with the textures of radiance, so many texels high and deep, and
  /// irradiance.
  vtkBRDFShaderInputs MakeForm(vtkBRDFShaderInputs::Term term, int height, int depth) const;
};
} // namespace measuredbrdf

#endif
