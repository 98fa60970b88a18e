// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Nodes of a map over polar angle and azimuth of which alone something is wanted.
 */

#ifndef MapPart_h
#define MapPart_h

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace measuredbrdf
{
/// Ascending rows of the map, and ascending columns of each of them. A node's number is its place
/// in that order.
class MapPart
{
public:
  static constexpr int None = -1;

  MapPart(int allRows, int allColumns)
    : Places(static_cast<std::size_t>(allRows) * static_cast<std::size_t>(allColumns), None)
    , AllRows(allRows)
    , AllColumns(allColumns)
  {
  }

  /// All nodes of some rows.
  static MapPart OfRows(int allRows, int allColumns, const std::vector<int>& rows)
  {
    MapPart part(allRows, allColumns);
    std::vector<int> columns(static_cast<std::size_t>(allColumns));
    std::iota(columns.begin(), columns.end(), 0);
    for (const int row : rows)
    {
      part.AddRow(row, columns);
    }
    return part;
  }

  /// All nodes of a map.
  static MapPart OfAll(int allRows, int allColumns)
  {
    std::vector<int> rows(static_cast<std::size_t>(allRows));
    std::iota(rows.begin(), rows.end(), 0);
    return OfRows(allRows, allColumns, rows);
  }

  /// Below the rows that are there.
  void AddRow(int row, const std::vector<int>& columns)
  {
    this->Rows.push_back(row);
    this->Columns.push_back(columns);
    this->Firsts.push_back(this->Count);
    for (const int column : columns)
    {
      this->Places[this->GetIndex(row, column)] = static_cast<int>(this->Count++);
    }
  }

  int GetAllRows() const { return this->AllRows; }
  int GetAllColumns() const { return this->AllColumns; }
  std::size_t GetNumberOfNodes() const { return this->Count; }
  const std::vector<int>& GetRows() const { return this->Rows; }

  ///@{
  /// Of the row with this number, not of the map's.
  const std::vector<int>& GetColumns(std::size_t row) const { return this->Columns[row]; }
  std::size_t GetFirstNode(std::size_t row) const { return this->Firsts[row]; }
  ///@}

  /// The number of the node there, or None. Columns go round; beyond a pole the meridian opposite
  /// goes on.
  int Find(int row, int column) const
  {
    const int last = this->AllRows - 1;
    if (row < 0 || row > last)
    {
      row = row < 0 ? -row : 2 * last - row;
      column += this->AllColumns / 2;
    }
    column = (column % this->AllColumns + this->AllColumns) % this->AllColumns;
    return this->Places[this->GetIndex(row, column)];
  }

private:
  std::size_t GetIndex(int row, int column) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(this->AllColumns) +
           static_cast<std::size_t>(column);
  }

  std::vector<int> Places; // of all nodes
  int AllRows, AllColumns;
  std::vector<int> Rows;
  std::vector<std::vector<int>> Columns;
  std::vector<std::size_t> Firsts;
  std::size_t Count = 0;
};
} // namespace measuredbrdf

#endif
