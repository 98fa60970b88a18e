// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceTable.h"

#include "FieldSynthesis.h"
#include "Floats.h"
#include "HalfVector.h" // for Pi
#include "Lamps.h"
#include "LobeHarmonics.h"
#include "LobePlacement.h"
#include "ModuleShader.h"
#include "ParallelFor.h"
#include "SynthesisLanes.h"
#include "vtkBRDFEnvironmentAnisotropic.h"
#include "vtkBRDFEnvironmentTable.h"
#include "vtkBRDFEnvironmentTiles.h"

#include <Eigen/Core>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
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

  glm::vec3 Get(int row, int column) const
  {
    const int round = (column + this->Columns) % this->Columns;
    return glm::make_vec3(
      this->Values + 3 * (static_cast<std::ptrdiff_t>(row) * this->Columns + round));
  }

  // By how much a node is off the middle between its neighbors, along both axes.
  double GetBend(int row, int column) const
  {
    const glm::vec3 twice = 2.0f * this->Get(row, column);
    const glm::vec3 bend =
      glm::abs(this->Get(row - 1, column) + this->Get(row + 1, column) - twice) +
      glm::abs(this->Get(row, column - 1) + this->Get(row, column + 1) - twice);
    return bend.x + bend.y + bend.z;
  }

  // At a fine node, on the edge between two nodes of this map.
  glm::vec3 GetBetween(int row, int column) const
  {
    constexpr int ratio = TableTiles::Ratio;
    const int above = std::min(row / ratio, this->Rows - 2);
    const float down = static_cast<float>(row - ratio * above) / ratio;
    const float across = static_cast<float>(column % ratio) / ratio;
    const auto along = [&](int at)
    {
      const glm::vec3 left = this->Get(at, column / ratio);
      return left + across * (this->Get(at, column / ratio + 1) - left);
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
  , Rows(GetRows(rows))
  , Columns(2 * (this->Rows - 1))
{
  if (this->FineRows > 0)
  {
    this->Across = this->Columns / Texels;
    const double bytes = GetTileBytes(4.0 * this->Rows * this->Columns * slices);
    this->Down = std::clamp(static_cast<int>(bytes / (4.0 * Texels * this->Columns * slices)), 1,
      (this->CountRows() * this->CountColumns() + this->Across - 1) / this->Across);
    this->Places.assign(static_cast<std::size_t>(this->CountRows()) * this->CountColumns(), 0.0f);
  }
}

void TableTiles::Choose(const std::vector<float>& radiance, const std::vector<double>& weights)
{
  constexpr int side = Intervals / Ratio; // coarse intervals
  const std::size_t texels = static_cast<std::size_t>(this->Rows) * this->Columns;
  std::vector<double> bends(texels, 0.0);
  measuredbrdf::ParallelForEach(this->Rows - 2,
    [&](int k)
    {
      const int row = k + 1;
      const double area = std::sin(Pi * row / (this->Rows - 1));
      for (std::size_t slice = 0; slice < weights.size(); ++slice)
      {
        const MapView map{ &radiance[3 * slice * texels], this->Rows, this->Columns };
        for (int column = 0; column < this->Columns; ++column)
        {
          bends[row * this->Columns + column] += area * weights[slice] * map.GetBend(row, column);
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
      const int column = (left + k % (side + 1)) % this->Columns;
      scores[tile] += bends[(first + k / (side + 1)) * this->Columns + column];
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
  const std::size_t texels = 3 * static_cast<std::size_t>(this->Rows * this->Columns);
  const std::size_t joined =
    texels + 3 * static_cast<std::size_t>(this->Columns * Texels * this->Down);
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
    for (int k = 0; k < Wide * Wide; ++k)
    {
      tile.Nodes.push_back(
        nodes.Find(tile.Row + k / Wide - RingMargin, tile.Column + k % Wide - RingMargin));
    }
    for (int k = 0; k < Texels * Texels; ++k)
    {
      const int row = tile.Row + k / Texels;
      const int column = (tile.Column + k % Texels) % this->GetFineColumns();
      Tile::Node node;
      node.Texel = (this->Rows + place / this->Across * Texels + k / Texels) * this->Columns +
                   place % this->Across * Texels + k % Texels;
      node.Coarse =
        row % Ratio == 0 && column % Ratio == 0 ? row / Ratio * this->Columns + column / Ratio : -1;
      node.IsInside = this->IsInside(row, column);
      tile.Own.push_back(node);
    }
    tiles.push_back(std::move(tile));
  }
  return tiles;
}

// Of one slice.
void TableTiles::AddTiles(const std::vector<Tile>& tiles, const float* fine, float* out) const
{
  const auto put = [out](int texel, const glm::vec3& rgb)
  { std::copy_n(&rgb.x, 3, out + 3 * static_cast<std::ptrdiff_t>(texel)); };
  std::vector<glm::vec3> patch(Wide * Wide);
  for (const Tile& tile : tiles)
  {
    for (std::size_t k = 0; k < patch.size(); ++k)
    {
      patch[k] = glm::make_vec3(fine + 3 * static_cast<std::ptrdiff_t>(tile.Nodes[k]));
    }
    LiftDarkRingsOfMap(&patch[0].x, Wide, Wide); // what is off at the sides, the margin takes
    for (int k = 0; k < Texels * Texels; ++k)
    {
      const glm::vec3& value = patch[(k / Texels + RingMargin) * Wide + k % Texels + RingMargin];
      put(tile.Own[k].Texel, value);
      // The coarse map rings about lamps: where it meets tiles it takes their values.
      if (tile.Own[k].Coarse >= 0)
      {
        put(tile.Own[k].Coarse, value);
      }
    }
  }
  const MapView map{ out, this->Rows, this->Columns };
  for (const Tile& tile : tiles)
  {
    for (int k = 0; k < Texels * Texels; ++k)
    {
      if (!tile.Own[k].IsInside)
      {
        put(tile.Own[k].Texel, map.GetBetween(tile.Row + k / Texels, tile.Column + k % Texels));
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
  vtkBRDFShaderInputs inputs;
  inputs.QuantizationError = std::ldexp(1.0, -9);
  inputs.Terms.push_back(std::move(term));
  return inputs;
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
  vtkBRDFShaderInputs inputs =
    this->MakeForm(std::move(term), this->GetHeight(), this->Angles * (this->Azimuths + 1));
  inputs.Description = sizes + " x " + std::to_string(this->Angles) + " view angles x " +
                       std::to_string(this->Azimuths) + " azimuths";
  return inputs;
}

AzimuthSeries::AzimuthSeries(int angles, int azimuths, std::size_t texels)
  : Azimuths(azimuths)
  , Slices(static_cast<std::size_t>(azimuths) + 1)
  , Size(3 * texels)
  , Values(this->Size * this->Slices * static_cast<std::size_t>(angles))
{
}

// A slice has the real field of order 0, and two have the real and the imaginary parts of another.
void AzimuthSeries::Set(int order, const FieldSynthesis::Fields& fields, std::size_t firstAngle)
{
  const std::size_t texels = this->Size / 3;
  measuredbrdf::ParallelForEach(fields[0].size() / texels,
    [&](std::size_t angle)
    {
      const std::size_t slice = order > 0 ? 2 * static_cast<std::size_t>(order) - 1 : 0;
      float* real = &this->Values[((firstAngle + angle) * this->Slices + slice) * this->Size];
      for (std::size_t k = 0; k < this->Size; ++k)
      {
        const std::complex<float> value = fields[k % 3][angle * texels + k / 3];
        real[k] = value.real();
        if (order > 0)
        {
          real[this->Size + k] = value.imag();
        }
      }
    });
}

std::vector<float> AzimuthSeries::TakeRadiance()
{
  constexpr std::size_t together = 512; // values of each slice, which fit into a core's cache
  const std::size_t rows = RoundUp(this->Slices, ProductRows);
  // What each number of the series counts for at each azimuth: slices x rows, one for each azimuth
  // and some of zeros.
  std::vector<float> turns(rows * this->Slices, 0.0f);
  for (std::size_t azimuth = 0; azimuth < this->Slices; ++azimuth)
  {
    turns[azimuth] = 1.0f;
    for (int order = 1; order <= this->Azimuths / 2; ++order)
    {
      const double gain = 2.0 * GetLinearSplineGain(static_cast<double>(order) / this->Azimuths);
      const double angle = 2.0 * Pi * order * static_cast<double>(azimuth) / this->Azimuths;
      const std::size_t at = 2 * static_cast<std::size_t>(order) * rows + azimuth;
      turns[at - rows] = static_cast<float>(gain * std::cos(angle));
      turns[at] = static_cast<float>(gain * std::sin(angle));
    }
  }
  const std::size_t blocks = (this->Size + together - 1) / together;
  const std::size_t angles = this->Values.size() / (this->Slices * this->Size);
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(blocks * angles), 16,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<float> series(this->Slices * together, 0.0f);
      std::vector<float> radiance(rows * together);
      for (std::size_t k = begin; k < static_cast<std::size_t>(end); ++k)
      {
        const std::size_t first = k % blocks * together;
        const std::size_t count = std::min(together, this->Size - first);
        float* values = &this->Values[k / blocks * this->Slices * this->Size + first];
        for (std::size_t slice = 0; slice < this->Slices; ++slice)
        {
          std::copy_n(values + slice * this->Size, count, &series[slice * together]);
        }
        Multiply({ turns.data(), rows }, { series.data(), together }, rows, this->Slices, together,
          radiance.data());
        for (std::size_t slice = 0; slice < this->Slices; ++slice)
        {
          std::copy_n(&radiance[slice * together], count, values + slice * this->Size);
        }
      }
    });
  return std::move(this->Values);
}

namespace
{
constexpr float LeastPeak = 1e-30f; // of radiance: less is black

// What degrees may add at most, of the mean radiance, to be left out: a twentieth of the format's
// rounding.
constexpr double LeastShare = 1e-4;

// By channel and degree: the largest value that the environment's part of that degree can have in
// any direction about any axis, by Cauchy's inequality, over that of degree 0.
std::array<std::vector<double>, 3> GetStrengths(const EnvironmentHarmonics& light, int degree)
{
  std::array<std::vector<double>, 3> strengths;
  for (int k = 0; k < 3 * (degree + 1); ++k)
  {
    strengths[k % 3].push_back(std::sqrt(GetEnergy(light, k % 3, k / 3)));
  }
  return strengths;
}

// Kernels that see some light.
struct SeenLight
{
  const std::vector<std::vector<float>>& Kernels;
  std::array<std::vector<double>, 3> Strengths;
};

// The highest degree that one order needs: those above add next to nothing. Broad lobes have few.
int GetNeededDegree(const std::vector<SeenLight>& seen, int order, int degree)
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  int needed = order;
  for (std::size_t k = 0; k < 3 * seen[0].Kernels.size(); ++k)
  {
    const std::size_t kernel = k / 3;
    const std::size_t channel = k % 3;
    const auto sum = [&](std::size_t ofOrder, std::size_t l)
    {
      double all = 0.0;
      for (const SeenLight& light : seen)
      {
        const float of = light.Kernels[kernel][(3 * ofOrder + channel) * size + l];
        all += static_cast<double>(std::abs(of)) * light.Strengths[channel][l];
      }
      return all;
    };
    const double mean = sum(0, 0);
    double rest = 0.0; // 2 Re(e^(-i k psi) G_k)
    for (int l = degree; l > needed; --l)
    {
      rest += 2.0 * sum(static_cast<std::size_t>(order), static_cast<std::size_t>(l));
      if (rest > LeastShare * mean)
      {
        needed = l;
      }
    }
  }
  return std::min(needed, degree);
}

// One order's, up to a degree.
FieldSynthesis::Kernels PickOrder(
  const std::vector<std::vector<float>>& kernels, int order, int degree, int last)
{
  const Eigen::Index count = kernels.size();
  FieldSynthesis::Kernels picked(3 * count, last + 1);
  for (Eigen::Index row = 0; row < 3 * count; ++row)
  {
    const Eigen::Index begin = (3 * order + row / count) * (degree + 1);
    picked.row(row) = Eigen::Map<const Eigen::RowVectorXf>(&kernels[row % count][begin], last + 1);
  }
  return picked;
}
}

std::vector<std::vector<float>> ExpandTableKernels(
  MaterialKernels& knots, int degree, int orders, double smoothing, int rows, bool outsideOnly)
{
  const std::size_t size = static_cast<std::size_t>(degree) + 1;
  std::vector<float> smoothed;
  for (int l = 0; l <= degree; ++l)
  {
    smoothed.push_back(static_cast<float>(GetSmoothed(l, smoothing) * GetTaper(l, degree, rows)));
  }
  std::vector<TurnedLobe> lobes;
  std::vector<LobeKernel> outside;
  outside.reserve(knots.At.size());
  for (const LobeKernel& knot : knots.At)
  {
    if (outsideOnly)
    {
      outside.push_back(knot.GetOutside(knot.Means.Delta));
      lobes.push_back({ &outside.back(), knot.Means.Delta });
    }
  }
  std::vector<std::vector<float>> kernels =
    outsideOnly ? ExpandLobes(lobes, degree, orders) : knots.Expand(degree, orders);
  for (std::size_t k = 0; k < kernels.size(); ++k)
  {
    for (std::size_t b = 0; b < kernels[k].size(); ++b)
    {
      const int channel = static_cast<int>(b / size % 3);
      kernels[k][b] *=
        smoothed[b % size] * static_cast<float>(knots.At[k].Means.Amplitude[channel]);
    }
  }
  return kernels;
}

double GetEnergy(const EnvironmentHarmonics& environment, int channel, int l)
{
  double sum = 0.0;
  for (int m = 0; m <= l; ++m)
  {
    sum += (m > 0 ? 2.0 : 1.0) * std::norm(environment.Get(channel, l, m));
  }
  return sum;
}

double PackRadiance(const std::vector<float>& radiance, RadianceTable::Texels& texels)
{
  float largest = LeastPeak;
  for (const float value : radiance)
  {
    largest = std::max(largest, value);
  }
  const float scale = LargestSharedExponent / largest;
  texels.resize(radiance.size() / 3);
  measuredbrdf::ParallelForEach(
    texels.size(),
    [&](std::size_t k)
    { texels[k] = PackSharedExponent(scale * glm::make_vec3(&radiance[3 * k])); },
    nullptr, 0);
  return 1.0 / static_cast<double>(scale);
}

namespace
{
// RGB of a table's slices at nodes of a map of so many rows, with dark rings. None where goOn said
// false.
std::vector<float> SynthesizeMaps(const TableLight& light, MaterialKernels& knots, double smoothing,
  const MapPart& part, int degree, const std::function<bool(double)>& goOn,
  const RadianceTable& table)
{
  const int orders = table.Azimuths / 2; // as many as the azimuths can tell apart
  const int rows = part.GetAllRows();
  std::vector<std::vector<float>> kernels =
    ExpandTableKernels(knots, degree, orders, smoothing, rows);
  // Lamps are what the one environment has more than the other: K rest + K_out (all - rest) =
  // (K - K_out) rest + K_out all. They are not smoothed: no maps add what they would lack.
  std::vector<std::vector<float>> outside;
  if (light.All)
  {
    outside = ExpandTableKernels(knots, degree, orders, 0.0, rows, true);
    for (std::size_t k = 0; k < kernels.size(); ++k)
    {
      std::transform(kernels[k].begin(), kernels[k].end(), outside[k].begin(), kernels[k].begin(),
        std::minus<float>());
    }
  }
  AzimuthSeries series(table.Angles, table.Azimuths, part.GetNumberOfNodes());
  FieldSynthesis synthesis(part, MapNodes::Poles);
  FieldSynthesis::Fields fields;
  std::vector<SeenLight> seen{ { kernels, GetStrengths(light.Environment, degree) } };
  if (light.All)
  {
    seen.push_back({ outside, GetStrengths(*light.All, degree) });
  }
  for (int order = 0; order <= orders; ++order)
  {
    const int last = GetNeededDegree(seen, order, degree);
    std::vector<FieldSynthesis::Part> lit{ { light.Environment,
      PickOrder(kernels, order, degree, last) } };
    if (light.All)
    {
      lit.push_back({ *light.All, PickOrder(outside, order, degree, last) });
    }
    synthesis.Run(order, lit, fields);
    series.Set(order, fields);
    if (!goOn((order + 1.0) / (orders + 1)))
    {
      return {};
    }
  }
  return series.TakeRadiance();
}

// How much of a sphere's disc is seen at each slice's view angle.
std::vector<double> GetSliceWeights(const RadianceTable& table)
{
  std::vector<double> weights;
  for (int k = 0; k < table.Angles; ++k)
  {
    const double theta = LobeViews::GetKnotAngle(k, table.Angles);
    const double before = LobeViews::GetKnotAngle(std::max(k - 1, 0), table.Angles);
    const double after = LobeViews::GetKnotAngle(std::min(k + 1, table.Angles - 1), table.Angles);
    const double weight = std::sin(theta) * std::cos(theta) * (after - before);
    weights.insert(weights.end(), static_cast<std::size_t>(table.Azimuths), weight);
    weights.push_back(0.0); // the first azimuth again
  }
  return weights;
}
}

double SynthesizeRadiance(const TableLight& light, MaterialKernels& knots, int degree,
  double smoothing, const std::function<bool(double)>& goOn, RadianceTable& table)
{
  const int fineRows = table.Tiles.FineRows;
  if (fineRows > 0) // the coarse map's kernels are a part of these
  {
    knots.Expand(degree, table.Azimuths / 2);
  }
  std::vector<float> radiance =
    SynthesizeMaps(light, knots, smoothing, MapPart(table.Rows, table.Columns),
      fineRows > 0 ? std::min(GetMapDegree(table.Rows), degree) : degree, goOn, table);
  if (radiance.empty())
  {
    return 0.0;
  }
  LiftDarkRings(
    radiance, static_cast<std::size_t>(table.Rows), static_cast<std::size_t>(table.Columns));
  if (fineRows > 0)
  {
    table.Tiles.Choose(radiance, GetSliceWeights(table));
    const MapPart nodes = table.Tiles.GetFineNodes();
    std::vector<float> fine;
    if (nodes.GetNumberOfNodes() > 0)
    {
      fine = SynthesizeMaps(light, knots, smoothing, nodes, degree, goOn, table);
      if (fine.empty())
      {
        return 0.0;
      }
    }
    radiance = table.Tiles.Join(radiance, nodes, fine);
  }
  return PackRadiance(radiance, table.Radiance);
}

bool PutProfile(const LobeMeans& lobe, const LobeMeans& between, const glm::dvec3& first,
  double scale, std::size_t at, std::vector<float>& profile)
{
  const glm::dvec3 wanted =
    glm::max(lobe.Amplitude + Pi * (lobe.Floor - between.Floor), glm::dvec3(0.0));
  const glm::dvec3 share = glm::mix(glm::dvec3(0.0), wanted / between.Amplitude,
    glm::greaterThan(between.Amplitude, glm::dvec3(0.0)));
  std::size_t out = 3 * at;
  for (const glm::vec3 row : { first, share * scale, between.Floor })
  {
    std::copy_n(&row.x, 3, &profile[out]);
    out += profile.size() / 3;
  }
  return between.Floor != glm::dvec3(0.0);
}

void MakeProfile(
  const LobeViews& views, const MaterialKernels& knots, double scale, RadianceTable& table)
{
  table.Profile.resize(3 * 3 * RadianceTable::ProfileSize);
  for (int k = 0; k < RadianceTable::ProfileSize; ++k)
  {
    const LobeMeans& lobe = views.GetViews()[k].Means;
    const double w = LobeViews::GetKnotPosition(LobeViews::GetAngle(k), table.Angles);
    const std::size_t low = std::min(static_cast<std::size_t>(w), knots.At.size() - 2);
    const double t = w - static_cast<double>(low);
    LobeMeans between;
    between.Add(knots.At[low].Means, 1.0 - t);
    between.Add(knots.At[low + 1].Means, t);
    const bool hasFloor =
      PutProfile(lobe, between, { w, std::cos(lobe.Delta), std::sin(lobe.Delta) }, scale,
        static_cast<std::size_t>(k), table.Profile);
    table.HasFloor = table.HasFloor || hasFloor;
  }
}

// On the octahedral map's texels, between those of a map of rows that is twice as fine.
std::shared_ptr<const ScaledTexels> MakeIrradiance(const EnvironmentHarmonics& environment)
{
  FieldSynthesis::Kernels cosine(3, IrradianceDegree + 1);
  for (int l = 0; l <= IrradianceDegree; ++l)
  {
    cosine.col(l).setConstant(static_cast<float>(GetClampedCosine(l)));
  }
  constexpr int side = RadianceTable::IrradianceSide;
  const int rows = 2 * side - 1;
  const int columns = 2 * (rows - 1);
  FieldSynthesis synthesis(MapPart(rows, columns), MapNodes::Poles);
  std::vector<float> map(3 * static_cast<std::size_t>(columns * rows));
  FieldSynthesis::Fields fields;
  synthesis.Run(0, { { environment, cosine } }, fields);
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    for (std::size_t texel = 0; texel < fields[channel].size(); ++texel)
    {
      map[3 * texel + channel] = fields[channel][texel].real();
    }
  }
  std::vector<float> values;
  for (int k = 0; k < side * side; ++k)
  {
    const glm::dvec2 place(k % side, k / side);
    const MapPosition at(GetOctahedralDirection(place / (side - 1.0)));
    const glm::vec3 value(GetMapValue(map, rows, columns, 0, at));
    values.insert(values.end(), { value.x, value.y, value.z });
  }
  auto irradiance = std::make_shared<ScaledTexels>();
  irradiance->Scale = static_cast<float>(PackRadiance(values, irradiance->Texels));
  return irradiance;
}

// u: as profiles over theta_o are read; period: of the view's azimuth, in [0,1].
glm::dvec3 AnisotropicTable::GetProfile(int layer, double u, double period) const
{
  constexpr int angles = AnisotropicViews::Angles;
  constexpr int azimuths = AnisotropicViews::Azimuths;
  const double exact = u * (angles - 1);
  const int low = std::min(static_cast<int>(exact), angles - 2);
  return MixTexels(this->Profile, angles,
    static_cast<std::size_t>(layer) * static_cast<std::size_t>(angles * azimuths),
    { low, low + 1, exact - low }, PeriodicNeighbors(period + 0.5 / azimuths, azimuths));
}

// No lamps lie beside it: hybrids evaluate all of them.
glm::dvec3 AnisotropicTable::Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t,
  const TableLamps* vtkNotUsed(lamps)) const
{
  Frame frame = FrameAbout(n, t);
  glm::dvec3 view = LiftView(ToLocal(frame, o));
  if (this->Periods == 2 && view.y < 0.0) // the same after half a turn
  {
    frame[0] = -frame[0];
    frame[1] = -frame[1];
    view = glm::dvec3(-view.x, -view.y, view.z);
  }
  const double sine = std::hypot(view.x, view.y);
  const glm::dvec2 azimuth = sine > 1e-6 ? glm::dvec2(view) / sine : glm::dvec2(1.0, 0.0);
  double phi = std::atan2(azimuth.y, azimuth.x) / (2.0 * Pi);
  phi = this->Periods * (phi - std::floor(phi));
  const double u = GetProfilePosition(std::atan2(sine, view.z));

  // The axis, and the tangent carried there by the smallest rotation.
  const glm::dvec3 parts = this->GetProfile(0, u, phi);
  const glm::dvec2 level(
    parts.x * azimuth.x - parts.y * azimuth.y, parts.x * azimuth.y + parts.y * azimuth.x);
  const double up = std::sqrt(std::max(1.0 - glm::dot(level, level), 0.0));
  const glm::dvec3 axis = glm::normalize(frame * glm::dvec3(level, up));
  const glm::dvec3 along = frame * glm::dvec3(1.0 - level.x * level.x / (1.0 + up),
                                     -level.x * level.y / (1.0 + up), -level.x);
  const MapPosition at(axis);
  const double psi = std::atan2(glm::dot(along, at.Across), glm::dot(along, at.Along)) / (2.0 * Pi);

  const double w = std::clamp(parts.z, 0.0, this->Angles - 1.0);
  const int angle = std::min(static_cast<int>(w), this->Angles - 2);
  const double p = phi * this->ViewAzimuths;
  const int first = std::min(static_cast<int>(p), this->ViewAzimuths - 1);
  const auto value = [&](int k, int viewAzimuth)
  {
    // After the last azimuth the first one comes again, in a frame that is turned by the period.
    const bool again = viewAzimuth == this->ViewAzimuths;
    const Neighbors turn = PeriodicNeighbors(
      psi + (again ? 1.0 / this->Periods : 0.0) + 0.5 / this->Azimuths, this->Azimuths);
    const auto map = [&](int psiIndex)
    {
      const int slice = k * (this->Azimuths + 1) + psiIndex;
      return (slice * this->ViewAzimuths + (again ? 0 : viewAzimuth)) * this->GetNumberOfTexels();
    };
    return MixTexels(this->Radiance, this->Columns, { map(turn.First), map(turn.Second) },
      GetMapColumns(this->Columns, at), GetMapRows(this->Rows, at), turn.Weight);
  };
  const auto between = [&](int k)
  { return glm::mix(value(k, first), value(k, first + 1), p - first); };
  glm::dvec3 sum = glm::mix(between(angle), between(angle + 1), w - angle);
  sum *= this->GetProfile(1, u, phi);
  if (this->HasFloor)
  {
    sum += this->GetProfile(2, u, phi) * this->GetIrradiance(n);
  }
  return glm::max(sum, glm::dvec3(0.0));
}

namespace
{
using Expanded = std::vector<std::vector<std::complex<float>>>;

// One order's kernels of one view angle: the real part and the imaginary part of each azimuth of
// the view.
FieldSynthesis::Kernels PickTurnedOrder(
  const Expanded& kernels, std::size_t first, int count, int order, int degree, int rows)
{
  FieldSynthesis::Kernels picked(3 * 2 * count, degree + 1);
  for (int l = 0; l <= degree; ++l)
  {
    const float taper = static_cast<float>(GetTaper(l, degree, rows));
    for (int k = 0; k < 3 * count; ++k)
    {
      const std::complex<float> of = kernels[first + static_cast<std::size_t>(k % count)]
                                            [(3 * order + k / count) * (degree + 1) + l];
      picked(2 * k, l) = taper * of.real();
      picked(2 * k + 1, l) = taper * of.imag();
    }
  }
  return picked;
}
}

double AnisotropicTable::Synthesize(const EnvironmentHarmonics& environment,
  const MaterialKernels& knots, int degree, const std::function<bool(double)>& goOn)
{
  const int orders = std::min(this->Azimuths / 2, degree); // as many as the azimuths can tell apart
  const Expanded kernels = ExpandAnisotropicLobes(knots.At, degree, orders);
  // An angle's maps at all azimuths of the view lie side by side.
  const std::size_t texels = this->GetNumberOfTexels();
  AzimuthSeries series(
    this->Angles, this->Azimuths, texels * static_cast<std::size_t>(this->ViewAzimuths));
  FieldSynthesis synthesis(MapPart(this->Rows, this->Columns), MapNodes::Poles);
  for (int angle = 0; angle < this->Angles; ++angle)
  {
    const std::size_t first = angle * this->ViewAzimuths;
    for (int order = 0; order <= orders; ++order)
    {
      FieldSynthesis::Fields fields;
      synthesis.Run(order,
        { { environment,
          PickTurnedOrder(kernels, first, this->ViewAzimuths, order, degree, this->Rows) } },
        fields);
      for (FieldSynthesis::Field& field : fields) // real and imaginary parts of kernels become one
      {
        for (std::size_t k = 0; k < field.size() / 2; ++k)
        {
          const std::complex<float>* of = &field[k / texels * 2 * texels + k % texels];
          field[k] = of[0] + std::complex<float>(-of[texels].imag(), of[texels].real());
        }
        field.resize(field.size() / 2);
      }
      series.Set(order, fields, static_cast<std::size_t>(angle));
      if (!goOn((angle * (orders + 1.0) + order + 1.0) / (this->Angles * (orders + 1.0))))
      {
        return 0.0;
      }
    }
  }
  std::vector<float> radiance = series.TakeRadiance();
  LiftDarkRings(
    radiance, static_cast<std::size_t>(this->Rows), static_cast<std::size_t>(this->Columns));
  return PackRadiance(radiance, this->Radiance);
}

void AnisotropicTable::MakeProfile(
  const AnisotropicViews& views, const MaterialKernels& knots, double scale)
{
  this->Periods = views.GetPeriods();
  const int count = AnisotropicViews::Angles * AnisotropicViews::Azimuths;
  this->Profile.resize(3 * 3 * static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
  {
    const int angleIndex = k % AnisotropicViews::Angles;
    const int azimuthIndex = k / AnisotropicViews::Angles;
    const LobeMeans& lobe = views.Get(angleIndex, azimuthIndex);
    // What interpolation between the kernels misses of the directional albedo goes to the rest.
    const double w =
      LobeViews::GetKnotPosition(AnisotropicViews::GetAngle(angleIndex), this->Angles);
    const int low = std::min(static_cast<int>(w), this->Angles - 2);
    const double p =
      static_cast<double>(azimuthIndex * this->ViewAzimuths) / AnisotropicViews::Azimuths;
    const int from = static_cast<int>(p);
    LobeMeans between;
    for (int corner = 0; corner < 4; ++corner)
    {
      const int angle = low + corner % 2;
      const int azimuth = (from + corner / 2) % this->ViewAzimuths;
      between.Add(knots.At[angle * this->ViewAzimuths + azimuth].Means,
        (corner % 2 ? w - low : 1.0 - w + low) * (corner / 2 ? p - from : 1.0 - p + from));
    }
    const double phi = views.GetAzimuth(azimuthIndex);
    const glm::dvec2 out(std::cos(phi), std::sin(phi));
    const bool hasFloor = PutProfile(lobe, between,
      { lobe.Axis.x * out.x + lobe.Axis.y * out.y, lobe.Axis.y * out.x - lobe.Axis.x * out.y, w },
      scale, static_cast<std::size_t>(k), this->Profile);
    this->HasFloor = this->HasFloor || hasFloor;
  }
}

vtkBRDFShaderInputs AnisotropicTable::GetShaderInputs() const
{
  vtkBRDFShaderInputs::Term term;
  SetModuleShader(term, "vtkBRDFEnvironmentAnisotropic", vtkBRDFEnvironmentAnisotropic);
  term.Constants = { { "PERIODS", std::to_string(this->Periods) + ".0" },
    { "VIEW_ANGLES", std::to_string(this->Angles) + ".0" },
    { "VIEW_AZIMUTHS", std::to_string(this->ViewAzimuths) + ".0" } };
  term.Fetches = 6; // two of the profile, four views
  vtkBRDFShaderInputs::Texture& profile =
    AddTexture(term, "brdfTableProfile", AnisotropicViews::Angles, AnisotropicViews::Azimuths, 3);
  profile.Data = this->Profile;
  profile.Repeat[1] = true;
  vtkBRDFShaderInputs inputs = this->MakeForm(
    std::move(term), this->Rows * this->ViewAzimuths, this->Angles * (this->Azimuths + 1));
  inputs.Description = "anisotropic radiance table, " + std::to_string(this->Columns) + " x " +
                       std::to_string(this->Rows) + " axes x " + std::to_string(this->Azimuths) +
                       " azimuths x " + std::to_string(this->Angles) + " x " +
                       std::to_string(this->ViewAzimuths) + " views";
  return inputs;
}
} // namespace measuredbrdf
