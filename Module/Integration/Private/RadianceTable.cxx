// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceTable.h"

#include "HalfVector.h" // for Pi
#include "LobePlacement.h"
#include "TableLamps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Of the axis in a slice: in the map that is everywhere, or in a tile.
struct SlicePlace
{
  Neighbors X;
  Neighbors Y;

  SlicePlace(const RadianceTable& table, const MapPosition& at)
  {
    this->X = GetMapColumns(table.Columns, at);
    this->Y = GetMapRows(table.Rows, at);
    const TableTiles& tiles = table.Tiles;
    if (tiles.Places.empty())
    {
      return;
    }
    const double x = (at.Azimuth - std::floor(at.Azimuth)) * tiles.GetFineColumns();
    const double y = at.Polar * (tiles.FineRows - 1);
    const int columns = tiles.CountColumns();
    const int across = std::min(static_cast<int>(x) / TableTiles::Intervals, columns - 1);
    const int down = std::min(static_cast<int>(y) / TableTiles::Intervals, tiles.CountRows() - 1);
    const int place =
      static_cast<int>(tiles.Places[static_cast<std::size_t>(down * columns + across)]) - 1;
    if (place >= 0)
    {
      this->X = GetNeighbors(place % tiles.Across, x - TableTiles::Intervals * across);
      this->Y = GetNeighbors(place / tiles.Across, y - TableTiles::Intervals * down);
      this->Y.First += table.Rows;
      this->Y.Second += table.Rows;
    }
  }

  static Neighbors GetNeighbors(int tile, double within)
  {
    const int low = std::clamp(static_cast<int>(within), 0, TableTiles::Intervals - 1);
    const int first = TableTiles::Texels * tile + low;
    return { first, first + 1, within - low };
  }
};
}

glm::dvec3 RadianceTable::Evaluate(
  const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t, const TableLamps* lamps) const
{
  const LobePlacement place(n, o, t);
  const double u = GetNearestPosition(place.U);
  const glm::dvec2 delta = GetAxisTurn(this->Profile, place.Theta, u);
  const glm::dvec3 d = place.GetAxis(delta.x, delta.y);
  const MapPosition at(d);
  const glm::dvec2 around = place.GetTurn(delta.x, delta.y, at);
  const double psi = std::atan2(around.y, around.x) / (2.0 * Pi);
  const Neighbors turn = PeriodicNeighbors(psi + 0.5 / this->Azimuths, this->Azimuths);
  const double w = LobeViews::GetKnotPosition(place.Theta, this->Angles);
  const int angle = std::min(static_cast<int>(w), this->Angles - 2);
  const SlicePlace slice(*this, at);
  const auto between = [&](int k)
  {
    return MixTexels(this->Radiance, this->Columns,
      { this->GetMap(k, turn.First), this->GetMap(k, turn.Second) }, slice.X, slice.Y, turn.Weight);
  };
  glm::dvec3 sum = glm::mix(between(angle), between(angle + 1), w - angle);
  sum *= GetProfileValue(this->Profile, 1, u);
  const glm::dvec3 lambert =
    this->HasFloor ? GetProfileValue(this->Profile, 2, u) : glm::dvec3(0.0);
  if (this->HasFloor)
  {
    sum += lambert * GetIrradiance(*this->Irradiance, n);
  }
  if (lamps)
  {
    sum += lamps->Sum(place.Local, place.View, d, lambert);
  }
  return glm::max(sum, glm::dvec3(0.0));
}

glm::dvec3 RadianceTable::GetIrradiance(const ScaledTexels& map, const glm::dvec3& n)
{
  return static_cast<double>(map.Scale) * GetOctahedralValue(map.Texels, IrradianceSide, n);
}
} // namespace measuredbrdf
