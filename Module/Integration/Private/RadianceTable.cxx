// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceTable.h"

#include "HalfVector.h" // for Pi
#include "Lamps.h"
#include "LobePlacement.h"
#include "ModuleShader.h"
#include "ParallelFor.h"
#include "SynthesisLanes.h"
#include "vtkBRDFEnvironmentTable.h"
#include "vtkBRDFEnvironmentTiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>

namespace measuredbrdf
{
void LiftDarkRings(std::vector<float>& radiance, std::size_t rows, std::size_t columns)
{
  const std::size_t size = 3 * rows * columns;
  measuredbrdf::ParallelForEach(radiance.size() / size,
    [&](std::size_t k) { LiftDarkRingsOfMap(&radiance[k * size], rows, columns); });
}

namespace
{
constexpr double Enough = 0.97; // of all bends
// A table's textures take so many bytes, or a multiple of them: what the coarse map and the small
// textures leave is for tiles, at least so many.
constexpr double BytesStep = 4e6;
constexpr double SmallTextures = 1.4e5;
constexpr double LeastTileBytes = 1.4e6;

double GetTileBytes(double ofCoarseMap)
{
  const double others = ofCoarseMap + SmallTextures;
  return BytesStep * std::ceil((others + LeastTileBytes) / BytesStep) - others;
}

constexpr int RingMargin = 4;             // fine nodes beside a tile's that RingLimiter reads
constexpr int RowMargin = RingMargin + 1; // and a spline's neighbors
constexpr int Wide = TableTiles::Texels + 2 * RingMargin;

// A map of RGB, round along the rows.
struct MapView
{
  const float* Values;
  int Rows;
  int Columns;

  const float* Get(int row, int column) const
  {
    const int round = (column + this->Columns) % this->Columns;
    return this->Values + 3 * (static_cast<std::ptrdiff_t>(row) * this->Columns + round);
  }

  // By how much a node is off the middle between its neighbors, along both axes.
  double GetBend(int row, int column) const
  {
    double bend = 0.0;
    const float* at = this->Get(row, column);
    for (int c = 0; c < 3; ++c)
    {
      bend +=
        std::abs(this->Get(row - 1, column)[c] + this->Get(row + 1, column)[c] - 2.0f * at[c]);
      bend +=
        std::abs(this->Get(row, column - 1)[c] + this->Get(row, column + 1)[c] - 2.0f * at[c]);
    }
    return bend;
  }

  // At a fine node, on the edge between two nodes of this map.
  float GetBetween(int row, int column, int c) const
  {
    constexpr int ratio = TableTiles::Ratio;
    const int above = std::min(row / ratio, this->Rows - 2);
    const float down = static_cast<float>(row - ratio * above) / ratio;
    const float across = static_cast<float>(column % ratio) / ratio;
    const auto along = [&](int at)
    {
      const float left = this->Get(at, column / ratio)[c];
      return left + across * (this->Get(at, column / ratio + 1)[c] - left);
    };
    return along(above) + down * (along(above + 1) - along(above));
  }
};
}

int TableTiles::GetFineRows(int rows)
{
  return rows > LargestWhole ? (rows - 1 + Intervals - 1) / Intervals * Intervals + 1 : 0;
}

int TableTiles::GetRows(int rows)
{
  const int fine = GetFineRows(rows);
  return fine > 0 ? (fine - 1) / Ratio + 1 : rows;
}

TableTiles::TableTiles(int rows, int slices)
  : FineRows(GetFineRows(rows))
{
  if (this->FineRows > 0)
  {
    const int columns = 2 * (GetRows(rows) - 1);
    this->Across = columns / Texels;
    const double bytes = GetTileBytes(4.0 * GetRows(rows) * columns * slices);
    this->Down = std::clamp(static_cast<int>(bytes / (4.0 * Texels * columns * slices)), 1,
      (this->CountRows() * this->CountColumns() + this->Across - 1) / this->Across);
    this->Places.assign(static_cast<std::size_t>(this->CountRows()) * this->CountColumns(), 0.0f);
  }
}

void TableTiles::Choose(const std::vector<float>& radiance, const std::vector<double>& weights)
{
  constexpr int side = Intervals / Ratio; // coarse intervals
  const int rows = GetRows(this->FineRows);
  const int columns = 2 * (rows - 1);
  const std::size_t texels = static_cast<std::size_t>(rows) * columns;
  std::vector<double> bends(texels, 0.0);
  measuredbrdf::ParallelFor(1, rows - 1, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row)
      {
        const double area = std::sin(Pi * row / (rows - 1));
        for (std::size_t slice = 0; slice < weights.size(); ++slice)
        {
          const MapView map{ &radiance[3 * slice * texels], rows, columns };
          for (int column = 0; column < columns; ++column)
          {
            bends[row * columns + column] += area * weights[slice] * map.GetBend(row, column);
          }
        }
      }
    });
  std::vector<double> scores(this->Places.size(), 0.0);
  for (std::size_t tile = 0; tile < scores.size(); ++tile)
  {
    const int first = static_cast<int>(tile) / this->CountColumns() * side;
    const int left = static_cast<int>(tile) % this->CountColumns() * side;
    for (int k = 0; k < (side + 1) * (side + 1); ++k)
    {
      const int column = (left + k % (side + 1)) % columns;
      scores[tile] += bends[(first + k / (side + 1)) * columns + column];
    }
  }
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&scores](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  const double all = std::accumulate(scores.begin(), scores.end(), 0.0);
  const int most = std::min(static_cast<int>(order.size()), this->Across * this->Down);
  double sum = 0.0;
  int count = 0;
  for (; count < most && sum < Enough * all; ++count)
  {
    const std::size_t tile = order[count];
    sum += scores[tile];
    this->Places[tile] = static_cast<float>(1 + count);
  }
  this->Down = (count + this->Across - 1) / this->Across;
}

MapPart TableTiles::GetFineNodes() const
{
  const int columns = this->GetFineColumns();
  const auto getPlace = [columns](int row, int column)
  { return static_cast<std::size_t>(row * columns + column); };
  std::vector<char> wanted(getPlace(this->FineRows, 0), 0);
  const int last = this->FineRows - 1;
  for (std::size_t tile = 0; tile < this->Places.size(); ++tile)
  {
    const int first = static_cast<int>(tile) / this->CountColumns() * Intervals;
    const int left = static_cast<int>(tile) % this->CountColumns() * Intervals;
    for (int at = first - RowMargin;
         this->Places[tile] > 0.0f && at <= first + Intervals + RowMargin; ++at)
    {
      const bool isBeyond = at < 0 || at > last; // a pole: on the meridian opposite
      const int row = at < 0 ? -at : at > last ? 2 * last - at : at;
      for (int k = left - RingMargin; k <= left + Intervals + RingMargin; ++k)
      {
        wanted[getPlace(row, (k + columns + (isBeyond ? columns / 2 : 0)) % columns)] = 1;
      }
    }
  }
  return MapPart(this->FineRows, columns, &wanted);
}

// Poles end no tile.
bool TableTiles::IsInside(int row, int column) const
{
  const int count = this->CountColumns();
  for (const int down : { (row - 1) / Intervals, row / Intervals })
  {
    for (const int across : { (column - 1 + count * Intervals) / Intervals, column / Intervals })
    {
      const std::size_t tile = std::min(down, this->CountRows() - 1) * count + across % count;
      if (!(this->Places[tile] > 0.0f))
      {
        return false;
      }
    }
  }
  return true;
}

std::vector<float> TableTiles::Join(
  const std::vector<float>& coarse, const MapPart& nodes, const std::vector<float>& fine) const
{
  const int rows = GetRows(this->FineRows);
  const int columns = 2 * (rows - 1);
  const std::size_t texels = 3 * static_cast<std::size_t>(rows * columns);
  const std::size_t joined = texels + 3 * static_cast<std::size_t>(columns * Texels * this->Down);
  const std::size_t slices = coarse.size() / texels;
  std::vector<float> all(slices * joined, 0.0f);
  const std::vector<Tile> tiles = this->MakeTiles(nodes);
  measuredbrdf::ParallelForEach(slices,
    [&](std::size_t k)
    {
      std::copy_n(&coarse[k * texels], texels, &all[k * joined]);
      this->AddTiles(tiles, fine.data() + 3 * k * nodes.GetNumberOfNodes(), &all[k * joined]);
    });
  return all;
}

std::vector<TableTiles::Tile> TableTiles::MakeTiles(const MapPart& nodes) const
{
  std::vector<Tile> tiles;
  const int rows = GetRows(this->FineRows);
  const int columns = 2 * (rows - 1);
  for (std::size_t number = 0; number < this->Places.size(); ++number)
  {
    const int place = static_cast<int>(this->Places[number]) - 1;
    if (place < 0)
    {
      continue;
    }
    Tile tile;
    tile.Row = static_cast<int>(number) / this->CountColumns() * Intervals;
    tile.Column = static_cast<int>(number) % this->CountColumns() * Intervals;
    tile.Place = static_cast<std::size_t>(
      (rows + place / this->Across * Texels) * columns + place % this->Across * Texels);
    for (int k = 0; k < Wide * Wide; ++k)
    {
      tile.Nodes.push_back(
        nodes.Find(tile.Row + k / Wide - RingMargin, tile.Column + k % Wide - RingMargin));
    }
    for (int k = 0; k < Texels * Texels; ++k)
    {
      tile.Inside.push_back(
        this->IsInside(tile.Row + k / Texels, (tile.Column + k % Texels) % this->GetFineColumns()));
    }
    tiles.push_back(std::move(tile));
  }
  return tiles;
}

// Of one slice.
void TableTiles::AddTiles(const std::vector<Tile>& tiles, const float* fine, float* out) const
{
  const int rows = GetRows(this->FineRows);
  const int columns = 2 * (rows - 1);
  std::vector<float> patch(3 * Wide * Wide);
  for (const Tile& tile : tiles)
  {
    for (std::size_t k = 0; k < tile.Nodes.size(); ++k)
    {
      std::copy_n(fine + 3 * static_cast<std::size_t>(tile.Nodes[k]), 3, &patch[3 * k]);
    }
    LiftDarkRingsOfMap(patch.data(), Wide, Wide); // what is off at the sides, the margin takes
    for (int k = 0; k < Texels * Texels; ++k)
    {
      const int down = k / Texels;
      const int across = k % Texels;
      const float* const value =
        &patch[3 * static_cast<std::size_t>((down + RingMargin) * Wide + across + RingMargin)];
      std::copy_n(
        value, 3, out + 3 * (tile.Place + static_cast<std::size_t>(down * columns + across)));
      // The coarse map rings about lamps: where it meets tiles it takes their values.
      const int row = tile.Row + down;
      const int column = (tile.Column + across) % this->GetFineColumns();
      if (row % Ratio == 0 && column % Ratio == 0)
      {
        std::copy_n(value, 3, out + 3 * (row / Ratio * columns + column / Ratio));
      }
    }
  }
  const MapView map{ out, rows, columns };
  for (const Tile& tile : tiles)
  {
    for (int k = 0; k < Texels * Texels; ++k)
    {
      const int down = k / Texels;
      const int across = k % Texels;
      float* const to = out + 3 * (tile.Place + static_cast<std::size_t>(down * columns + across));
      for (int c = 0; c < 3 && !tile.Inside[k]; ++c)
      {
        to[c] = map.GetBetween(tile.Row + down, tile.Column + across, c);
      }
    }
  }
}

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
    const int place = static_cast<int>(tiles.Places[down * columns + across]) - 1;
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
    sum += lambert * this->GetIrradiance(n);
  }
  if (lamps)
  {
    sum += lamps->Sum(place.Local, place.View, d, lambert);
  }
  return glm::max(sum, glm::dvec3(0.0));
}

glm::dvec3 RadianceTable::GetIrradiance(const glm::dvec3& n) const
{
  const ScaledTexels& map = *this->Irradiance;
  return static_cast<double>(map.Scale) * GetOctahedralValue(map.Texels, IrradianceSide, n);
}

std::vector<float> RadianceTable::GetShaderProfile() const
{
  std::vector<float> texels;
  for (int row = 1; row <= (this->HasFloor ? 2 : 1); ++row)
  {
    for (int k = 0; k < ProfileTexels; ++k)
    {
      const double u = k / (ProfileTexels - 1.0);
      const glm::vec3 rgb(GetProfileValue(this->Profile, row, u));
      texels.insert(
        texels.end(), { rgb.x, rgb.y, rgb.z, static_cast<float>(GetAxisExcess(this->Profile, u)) });
    }
  }
  return texels;
}

vtkBRDFShaderInputs RadianceTable::MakeForm(
  vtkBRDFShaderInputs::Term term, int height, int depth) const
{
  term.Constants.push_back({ "HAS_FLOOR", this->HasFloor ? "1" : "0" });
  term.Uniforms.push_back(
    { "brdfTableLastView", { static_cast<float>(LobeViews::GetLastAngle() * 2.0 / Pi) } });
  vtkBRDFShaderInputs::Texture& radiance =
    AddTexture(term, "brdfTableRadiance", this->Columns, height, depth);
  radiance.SharedExponents = this->Radiance;
  radiance.Repeat[0] = true;
  if (this->HasFloor)
  {
    AddTexture(term, "brdfTableIrradiance", IrradianceSide, IrradianceSide).SharedExponents =
      this->Irradiance->Texels;
    term.Uniforms.push_back({ "brdfTableIrradianceScale", { this->Irradiance->Scale } });
    term.Fetches += 2; // with its profile
  }
  vtkBRDFShaderInputs form;
  form.QuantizationError = std::ldexp(1.0, -9);
  form.Terms.push_back(std::move(term));
  return form;
}

vtkBRDFShaderInputs RadianceTable::GetShaderInputs() const
{
  vtkBRDFShaderInputs::Term term;
  SetModuleShader(term, "vtkBRDFEnvironmentTable", vtkBRDFEnvironmentTable);
  term.Constants = { { "SHARP_PART", "vec3(0.0)" }, { "LAMPS_PART", "vec3(0.0)" },
    { "TILE_PART", "vec2(-1.0)" } };
  term.Uniforms.push_back({ "brdfTableRows", { static_cast<float>(this->Rows) } });
  term.Uniforms.push_back({ "brdfTableAngles", { static_cast<float>(this->Angles) } });
  term.Fetches = 3; // the profile and two view angles
  vtkBRDFShaderInputs::Texture& profile =
    AddTexture(term, "brdfTableProfile", ProfileTexels, this->HasFloor ? 2 : 1);
  profile.Components = 4;
  profile.Data = this->GetShaderProfile();
  std::string sizes = "radiance table, " + std::to_string(this->Columns) + " x " +
                      std::to_string(this->Rows) + " axes";
  const TableTiles& tiles = this->Tiles;
  if (!tiles.Places.empty())
  {
    term.Source = std::string(vtkBRDFEnvironmentTiles) + term.Source;
    term.Constants.back().Value = "brdfTilePositionINSTANCE(position, brdfTableRowsINSTANCE)";
    term.Uniforms.push_back({ "brdfTileAcross", { static_cast<float>(tiles.Across) } });
    vtkBRDFShaderInputs::Texture& places =
      AddTexture(term, "brdfTilePlaces", tiles.CountColumns(), tiles.CountRows(), 1);
    places.Components = 1;
    places.Data = tiles.Places;
    ++term.Fetches;
    sizes += " (" + std::to_string(tiles.GetFineColumns()) + " x " +
             std::to_string(tiles.FineRows) + " where they bend most)";
  }
  vtkBRDFShaderInputs form =
    this->MakeForm(std::move(term), this->GetHeight(), this->Angles * (this->Azimuths + 1));
  form.Description = sizes + " x " + std::to_string(this->Angles) + " view angles x " +
                     std::to_string(this->Azimuths) + " azimuths";
  return form;
}
} // namespace measuredbrdf
