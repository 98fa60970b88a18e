// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How a table of radiance of many rows is stored: a map of a quarter of the rows everywhere, and
 * tiles of all rows where radiance bends most. Such places are few: the edges of panels and lamps.
 */

#ifndef TableTiles_h
#define TableTiles_h

#include "MapPart.h"

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
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
} // namespace measuredbrdf

#endif
