// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableTiles.h"

#include "HalfVector.h" // for Pi
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace measuredbrdf
{
namespace
{
constexpr double Enough = 0.97; // of all bends
// A table's textures take so many bytes, or a multiple of them: what the coarse map and the small
// textures leave is for tiles, at least so many.
constexpr double BytesStep = 4e6;
constexpr double SmallTextures = 1.1e5;
constexpr double LeastTileBytes = 1.4e6;

double GetTileBytes(double ofCoarseMap)
{
  const double others = ofCoarseMap + SmallTextures;
  return BytesStep * std::ceil((others + LeastTileBytes) / BytesStep) - others;
}

constexpr int Margin =
  5; // fine rows beside tiles: four that RingLimiter reads, a spline's neighbor

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
    this->Places.assign(
      static_cast<std::size_t>(this->CountRows()) * static_cast<std::size_t>(this->CountColumns()),
      0.0f);
  }
}

bool TableTiles::ArePlaces(const std::vector<float>& places) const
{
  return places.size() == this->Places.size() &&
         std::all_of(places.begin(), places.end(),
           [this](float place)
           {
             return place >= 0.0f && place <= static_cast<float>(this->Across * this->Down) &&
                    place == std::floor(place);
           });
}

void TableTiles::Choose(const std::vector<float>& radiance, const std::vector<double>& weights)
{
  constexpr int side = Intervals / Ratio; // coarse intervals
  const int rows = GetRows(this->FineRows);
  const int columns = 2 * (rows - 1);
  const std::size_t texels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  std::vector<double> bends(texels, 0.0);
  vtkSMPTools::For(1, rows - 1, 1,
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
            bends[static_cast<std::size_t>(row * columns + column)] +=
              area * weights[slice] * map.GetBend(row, column);
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
      scores[tile] += bends[static_cast<std::size_t>((first + k / (side + 1)) * columns + column)];
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
    const std::size_t tile = order[static_cast<std::size_t>(count)];
    sum += scores[tile];
    this->Places[tile] = static_cast<float>(1 + count);
  }
  this->Down = (count + this->Across - 1) / this->Across;
}

std::vector<int> TableTiles::GetFineRowsOfTiles() const
{
  std::vector<char> wanted(static_cast<std::size_t>(this->FineRows), 0);
  for (std::size_t tile = 0; tile < this->Places.size(); ++tile)
  {
    const int first = static_cast<int>(tile) / this->CountColumns() * Intervals;
    const int begin = std::max(first - Margin, 0);
    const int end = std::min(first + Intervals + Margin + 1, this->FineRows);
    if (this->Places[tile] > 0.0f)
    {
      std::fill(wanted.begin() + begin, wanted.begin() + end, 1);
    }
  }
  std::vector<int> rows;
  for (int row = 0; row < this->FineRows; ++row)
  {
    if (wanted[static_cast<std::size_t>(row)])
    {
      rows.push_back(row);
    }
  }
  return rows;
}

// Poles end no tile.
bool TableTiles::IsInside(int row, int column) const
{
  const int count = this->CountColumns();
  for (const int down : { (row - 1) / Intervals, row / Intervals })
  {
    for (const int across : { (column - 1 + count * Intervals) / Intervals, column / Intervals })
    {
      const std::size_t tile =
        static_cast<std::size_t>(std::min(down, this->CountRows() - 1) * count + across % count);
      if (!(this->Places[tile] > 0.0f))
      {
        return false;
      }
    }
  }
  return true;
}

std::vector<float> TableTiles::Join(
  const std::vector<float>& coarse, const std::vector<float>& fine) const
{
  const int rows = GetRows(this->FineRows);
  const int columns = 2 * (rows - 1);
  const std::size_t texels = 3 * static_cast<std::size_t>(rows * columns);
  const std::size_t joined = texels + 3 * static_cast<std::size_t>(columns * Texels * this->Down);
  const std::size_t slices = coarse.size() / texels;
  const std::vector<int> known = this->GetFineRowsOfTiles();
  std::vector<int> placeOf(static_cast<std::size_t>(this->FineRows), 0);
  for (std::size_t k = 0; k < known.size(); ++k)
  {
    placeOf[static_cast<std::size_t>(known[k])] = static_cast<int>(k);
  }
  std::vector<float> all(slices * joined, 0.0f);
  const auto fill = [&](std::size_t slice)
  {
    float* const out = &all[slice * joined];
    std::copy_n(&coarse[slice * texels], texels, out);
    const MapView map{ out, rows, columns };
    const MapView finer{ fine.data() + 3 * slice * known.size() *
                                         static_cast<std::size_t>(this->GetFineColumns()),
      static_cast<int>(known.size()), this->GetFineColumns() };
    // The coarse map rings about lamps: where it meets tiles it takes their values.
    constexpr int side = Intervals / Ratio + 1;
    for (std::size_t tile = 0; tile < this->Places.size(); ++tile)
    {
      const int first = static_cast<int>(tile) / this->CountColumns() * (side - 1);
      const int left = static_cast<int>(tile) % this->CountColumns() * (side - 1);
      for (int k = 0; this->Places[tile] > 0.0f && k < side * side; ++k)
      {
        const int row = first + k / side;
        const int column = (left + k % side) % columns;
        std::copy_n(finer.Get(placeOf[static_cast<std::size_t>(Ratio * row)], Ratio * column), 3,
          out + 3 * (row * columns + column));
      }
    }
    for (std::size_t tile = 0; tile < this->Places.size(); ++tile)
    {
      const int place = static_cast<int>(this->Places[tile]) - 1;
      const int first = static_cast<int>(tile) / this->CountColumns() * Intervals;
      const int left = static_cast<int>(tile) % this->CountColumns() * Intervals;
      for (int k = 0; place >= 0 && k < Texels * Texels; ++k)
      {
        const int row = first + k / Texels;
        const int column = left + k % Texels;
        const int y = rows + place / this->Across * Texels + k / Texels;
        const int x = place % this->Across * Texels + k % Texels;
        for (int c = 0; c < 3; ++c)
        {
          out[3 * (y * columns + x) + c] =
            this->IsInside(row, column % this->GetFineColumns())
              ? finer.Get(placeOf[static_cast<std::size_t>(row)], column)[c]
              : map.GetBetween(row, column, c);
        }
      }
    }
  };
  vtkSMPTools::For(0, static_cast<vtkIdType>(slices), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType slice = begin; slice < end; ++slice)
      {
        fill(static_cast<std::size_t>(slice));
      }
    });
  return all;
}
} // namespace measuredbrdf
