// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldSynthesis.h"

#include "ParallelFor.h"
#include "WignerD.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Of Wigner's functions: less is nothing beside the rounding of floats.
constexpr double LeastTurn = 1e-8;

// Readers take whole vectors.
constexpr std::size_t Beyond = 16;

using Numbers = Eigen::Map<Eigen::ArrayXf>;
using KnownNumbers = Eigen::Map<const Eigen::ArrayXf>;
}

MapPart::MapPart(int allRows, int allColumns, const std::vector<char>* wanted)
  : AllRows(allRows)
  , AllColumns(allColumns)
  , Numbers(static_cast<std::size_t>(allRows) * allColumns, None)
{
  std::size_t at = 0;
  for (int row = 0; row < allRows; ++row)
  {
    Row of{ row, this->Count, {} };
    for (int column = 0; column < allColumns; ++column, ++at)
    {
      if (!wanted || (*wanted)[at])
      {
        of.Columns.push_back(column);
        this->Numbers[at] = static_cast<int>(this->Count++);
      }
    }
    if (!of.Columns.empty())
    {
      this->Rows.push_back(std::move(of));
    }
  }
}

int MapPart::Find(int row, int column) const
{
  const int last = this->AllRows - 1;
  if (row < 0 || row > last)
  {
    row = row < 0 ? -row : 2 * last - row;
    column += this->AllColumns / 2;
  }
  column = (column % this->AllColumns + this->AllColumns) % this->AllColumns;
  return this->Numbers[row * this->AllColumns + column];
}

FieldSynthesis::FieldSynthesis(MapPart nodes, MapNodes places)
  : Nodes(std::move(nodes))
  , Places(places)
{
  const int last = this->Nodes.GetAllRows() - 1;
  std::vector<RowPair> all(static_cast<std::size_t>(last + 1), { None, None });
  const std::vector<MapPart::Row>& rows = this->Nodes.GetRows();
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const int place = rows[k].Place;
    all[place].Place = k;
    all[last - place].Mirror = k;
    for (const int column : rows[k].Columns)
    {
      this->NeighborsOf.push_back({ this->Nodes.Find(place - 1, column),
        this->Nodes.Find(place + 1, column), place == 0, place == last });
    }
  }
  std::vector<int> both;
  for (int row = 0; row <= last; ++row)
  {
    const RowPair& pair = all[row];
    if (pair.Place != None || pair.Mirror != None)
    {
      both.push_back(row);
    }
  }
  this->All = this->MakePanels(all, both);
  both.resize((both.size() + 1) / 2);
  this->North = this->MakePanels(all, both);
}

double FieldSynthesis::GetPolarAngle(int row) const
{
  const int rows = this->Nodes.GetAllRows();
  return this->Places == MapNodes::Centers ? Pi * (row + 0.5) / rows : Pi * row / (rows - 1);
}

// The last panel's rows that are too many are wanted nowhere.
std::vector<FieldSynthesis::Panel> FieldSynthesis::MakePanels(
  const std::vector<RowPair>& rows, const std::vector<int>& at) const
{
  std::vector<Panel> panels;
  for (std::size_t first = 0; first < at.size(); first += WignerLanes::Count)
  {
    WignerLanes::Values angles;
    Panel panel;
    for (std::size_t lane = 0; lane < WignerLanes::Count; ++lane)
    {
      const bool isThere = first + lane < at.size();
      const int row = isThere ? at[first + lane] : at.back();
      angles[lane] = this->GetPolarAngle(row);
      panel.Rows[lane] = isThere ? rows[row] : RowPair{ None, None };
    }
    panel.Angles = WignerLanes(angles);
    panels.push_back(panel);
  }
  return panels;
}

void FieldSynthesis::Run(int order, const std::vector<Part>& parts, Fields& result)
{
  const Kernels& kernels = parts.front().Of;
  this->Degree = static_cast<int>(kernels.cols()) - 1;
  this->Kinds = static_cast<std::size_t>(kernels.rows());
  this->Width = RoundUp(2 * this->Kinds, ProductColumns);
  this->Orders = 2 * static_cast<std::size_t>(this->Degree) + 1;
  this->Known.assign(this->Nodes.GetRows().size() * this->Orders, 0);
  this->Series.resize(this->Known.size() * this->Width + Beyond);
  this->Conjugate.assign(this->Width, -1.0f);
  std::fill_n(this->Conjugate.begin(), this->Kinds, 1.0f);
  for (Field& field : result)
  {
    field.resize(this->Nodes.GetNumberOfNodes() * this->Kinds / 3);
  }
  measuredbrdf::ParallelForEach(
    this->Degree + 1, [&](int m) { this->SumDegrees(m, order, parts); });
  this->SumOrders(order, result);
  if (this->Places == MapNodes::Poles)
  {
    this->FitRows(order, result);
  }
}

// The sums of m and -m.
void FieldSynthesis::SumDegrees(int m, int order, const std::vector<Part>& parts)
{
  const WignerD functions(m, order, this->Degree);
  if (functions.IsEmpty())
  {
    return;
  }
  // b_lk a_lm of each degree: real parts of all kinds, imaginary parts, and what fills the width.
  const int first = functions.GetFirst();
  const std::size_t size = this->Degree + 1 - first;
  std::vector<float> lit(size * this->Width, 0.0f);
  const Eigen::Index count = this->Kinds / 3;
  for (const Part& part : parts)
  {
    for (int l = first; l <= this->Degree; ++l)
    {
      const float* of = part.Of.col(l).data();
      float* out = &lit[static_cast<std::size_t>(l - first) * this->Width];
      for (int channel = 0; channel < 3; ++channel, of += count, out += count)
      {
        const std::complex<double> a = part.Light.Get(channel, l, m);
        Numbers(out, count) += static_cast<float>(a.real()) * KnownNumbers(of, count);
        Numbers(out + this->Kinds, count) += static_cast<float>(a.imag()) * KnownNumbers(of, count);
      }
    }
  }
  std::vector<float> turns(ProductRows * size);
  for (const Panel& panel : order > 0 ? this->All : this->North)
  {
    const std::size_t begin = panel.Angles.EvaluateFrom(functions, LeastTurn, turns.data());
    if (begin < size)
    {
      this->Multiply(panel, m, order, first, size, begin, turns, lit);
    }
  }
}

void FieldSynthesis::Multiply(const Panel& panel, int m, int order, int first, std::size_t size,
  std::size_t begin, const std::vector<float>& turns, const std::vector<float>& lit)
{
  static_assert(ProductRows == WignerLanes::Count, "a panel is what is turned at a time");
  const bool isOdd = (first + static_cast<int>(begin) - order) % 2 != 0; // the first l - k
  const float sign = m % 2 != 0 ? -1.0f : 1.0f;
  constexpr std::size_t together = 3 * ProductColumns;
  float sums[2][ProductRows * together];
  for (std::size_t column = 0; column < this->Width; column += together)
  {
    const std::size_t columns = std::min(together, this->Width - column);
    for (std::size_t part = 0; part < 2; ++part)
    {
      const std::size_t from = begin + part;
      measuredbrdf::Multiply({ turns.data() + ProductRows * from, 2 * ProductRows },
        { lit.data() + from * this->Width + column, 2 * this->Width }, ProductRows,
        from < size ? (size - from + 1) / 2 : 0, columns, sums[part]);
    }
    const Eigen::Index count = columns;
    const KnownNumbers conjugate(&this->Conjugate[column], count);
    for (std::size_t row = 0; row < ProductRows; ++row)
    {
      const KnownNumbers even(&sums[isOdd ? 1 : 0][row * columns], count);
      const KnownNumbers odd(&sums[isOdd ? 0 : 1][row * columns], count);
      const auto getOut = [&](std::size_t place, int at)
      {
        const std::size_t item = place * this->Orders + static_cast<std::size_t>(at + this->Degree);
        this->Known[item] = 1;
        return Numbers(&this->Series[item * this->Width + column], count);
      };
      const RowPair& places = panel.Rows[row];
      if (places.Place != None)
      {
        getOut(places.Place, m) = conjugate * (even + odd);
      }
      if (places.Mirror != None && order == 0) // the conjugate of -m
      {
        getOut(places.Mirror, m) = sign * conjugate * (even - odd);
      }
      else if (places.Mirror != None && m > 0)
      {
        getOut(places.Mirror, -m) = sign * (even - odd);
      }
    }
  }
}

// The real parts of all kinds, then the imaginary parts; a few more numbers may be read. Null: all
// are 0.
const float* FieldSynthesis::GetSum(std::size_t row, int m) const
{
  const std::size_t at = row * this->Orders + static_cast<std::size_t>(m + this->Degree);
  return this->Known[at] ? &this->Series[at * this->Width] : nullptr;
}

// The sum over m, by fast Fourier transforms over the azimuth, some kinds at a time.
void FieldSynthesis::SumOrders(int order, Fields& result) const
{
  constexpr std::size_t lines = LineTransform::Lines;
  using Lane = Eigen::Array<float, lines, 1>;
  const std::size_t nodes = this->Nodes.GetNumberOfNodes();
  const std::size_t each = this->Kinds / 3;
  const int columns = this->Nodes.GetAllColumns();
  const LineTransform transform(columns);
  std::vector<std::complex<float>> factors; // of m from -Degree on
  for (int m = -this->Degree; m <= this->Degree; ++m)
  {
    const double frequency = static_cast<double>(m) / columns;
    factors.push_back(this->Places == MapNodes::Centers // half a column on
                        ? std::polar(1.0f, static_cast<float>(-Pi * frequency))
                        : static_cast<float>(GetLinearSplineGain(frequency)));
  }
  measuredbrdf::ParallelForEach(this->Nodes.GetRows().size(),
    [&](std::size_t row)
    {
      const MapPart::Row& place = this->Nodes.GetRows()[row];
      std::vector<float> items(columns * LineTransform::Item), other(items.size());
      const auto add = [&](int m, const Lane& real, const Lane& imaginary)
      {
        float* const at = &items[(m % columns + columns) % columns * LineTransform::Item];
        Eigen::Map<Lane>(at) += real;
        Eigen::Map<Lane>(at + lines) += imaginary;
      };
      for (std::size_t first = 0; first < this->Kinds; first += lines)
      {
        std::fill(items.begin(), items.end(), 0.0f);
        for (int m = order > 0 ? -this->Degree : 0; m <= this->Degree; ++m)
        {
          if (const float* const of = this->GetSum(row, m))
          {
            const std::complex<float> by = factors[m + this->Degree];
            const Eigen::Map<const Lane> a(of + first), b(of + this->Kinds + first);
            const Lane real = by.real() * a - by.imag() * b;
            const Lane imaginary = by.real() * b + by.imag() * a;
            add(m, real, imaginary);
            if (order == 0 && m > 0) // which is real
            {
              add(-m, real, -imaginary);
            }
          }
        }
        transform.Run(items, other);
        for (std::size_t kind = first; kind < std::min(first + lines, this->Kinds); ++kind)
        {
          std::complex<float>* out = &result[kind / each][kind % each * nodes + place.FirstNode];
          for (const int column : place.Columns)
          {
            const float* const of = &items[column * LineTransform::Item + kind - first];
            *out++ = { of[0], order > 0 ? of[lines] : 0.0f };
          }
        }
      }
    });
}

// Linear splines along the meridians. Beyond a pole the meridian opposite goes on, in a frame that
// is turned by half a turn.
void FieldSynthesis::FitRows(int order, Fields& result) const
{
  const std::size_t nodes = this->Nodes.GetNumberOfNodes();
  const float sign = order % 2 != 0 ? -1.0f : 1.0f;
  const std::size_t maps = nodes > 0 ? this->Kinds / 3 : 0;
  measuredbrdf::ParallelForEach(3 * maps,
    [&](std::size_t map)
    {
      std::complex<float>* values = &result[map / maps][map % maps * nodes];
      const Field known(values, values + nodes);
      for (std::size_t node = 0; node < nodes; ++node)
      {
        const Neighbors& of = this->NeighborsOf[node];
        if (of.Above != MapPart::None && of.Below != MapPart::None)
        {
          const std::complex<float>& above = known[of.Above];
          const std::complex<float>& below = known[of.Below];
          values[node] = FitLinearSpline(of.IsAbovePole ? sign * above : above, known[node],
            of.IsBelowPole ? sign * below : below);
        }
      }
    });
}
} // namespace measuredbrdf
