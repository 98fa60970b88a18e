// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldSynthesis.h"

#include "HalfVector.h" // for Pi
#include "LinearSpline.h"
#include "MatrixProduct.h"
#include "RowTransform.h"
#include "WignerD.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

namespace measuredbrdf
{
namespace
{
constexpr double LeastTurn = 1e-15;               // less is 0: slow in floats, and nothing
constexpr std::size_t Lanes = WignerLanes::Count; // rows at a time

// Of its real part; the imaginary parts of eight kinds follow their real parts.
std::size_t GetPlaceOfKind(std::size_t kind)
{
  return kind / RowTransform::Lines * RowTransform::Item + kind % RowTransform::Lines;
}

// Floats of all kinds.
std::size_t GetSeriesWidth(std::size_t kinds)
{
  static_assert(RowTransform::Item % ProductColumns == 0, "products come in whole items");
  return RoundUp(2 * kinds, RowTransform::Item);
}

// Adds real and imaginary parts of b_lk conj(a_lm), for the degrees from first on, row by row.
void AddLit(const EnvironmentHarmonics& light, int m, int first,
  const FieldSynthesis::Kernels& kernels, std::size_t columns, std::vector<float>& lit)
{
  const std::size_t count = static_cast<std::size_t>(kernels[0].cols());
  const std::size_t size = lit.size() / columns;
  std::vector<std::complex<float>> values(size);
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    for (std::size_t k = 0; k < size; ++k)
    {
      const std::complex<double> a =
        light.Get(static_cast<int>(channel), first + static_cast<int>(k), std::abs(m));
      values[k] = m >= 0 ? std::conj(a) : (m % 2 != 0 ? -a : a);
    }
    for (std::size_t kernel = 0; kernel < count; ++kernel)
    {
      const float* of = kernels[channel].col(static_cast<Eigen::Index>(kernel)).data() + first;
      float* out = &lit[GetPlaceOfKind(channel * count + kernel)];
      for (std::size_t k = 0; k < size; ++k, out += columns)
      {
        out[0] += of[k] * values[k].real();
        out[RowTransform::Lines] += of[k] * values[k].imag();
      }
    }
  }
}

using Lane = Eigen::Array<float, RowTransform::Lines, 1>; // a part of an item, of eight kinds

struct Item
{
  Lane Real, Imaginary;

  explicit Item(const float* at)
    : Real(Eigen::Map<const Lane>(at))
    , Imaginary(Eigen::Map<const Lane>(at + RowTransform::Lines))
  {
  }

  void Multiply(const std::complex<float>& factor)
  {
    const Lane real = factor.real() * this->Real - factor.imag() * this->Imaginary;
    this->Imaginary = factor.real() * this->Imaginary + factor.imag() * this->Real;
    this->Real = real;
  }
};

void AddTo(float* at, const Lane& real, const Lane& imaginary)
{
  Eigen::Map<Lane>(at) += real;
  Eigen::Map<Lane>(at + RowTransform::Lines) += imaginary;
}

// Where a row's terms lie in a Fourier transform of the columns, and what each is multiplied by.
class RowTerms
{
public:
  RowTerms(int degree, const RowTransform& transform, MapNodes nodes)
    : Degree(static_cast<std::size_t>(degree))
  {
    const int columns = static_cast<int>(transform.GetSize());
    for (int m = -degree; m <= degree; ++m)
    {
      const double frequency = static_cast<double>(m) / columns;
      this->Factors.push_back(nodes == MapNodes::Centers // half a column on
                                ? std::polar(1.0f, static_cast<float>(-Pi * frequency))
                                : static_cast<float>(GetLinearSplineGain(frequency)));
      const int place = (m % columns + columns) % columns;
      this->Places.push_back(
        RowTransform::Item * transform.GetPlace(static_cast<std::size_t>(place)));
    }
  }

  /// in: an item for each m, which lie width apart.
  void Add(const float* in, std::size_t width, float* lines) const
  {
    for (std::size_t k = 0; k < this->Places.size(); ++k, in += width)
    {
      Item item(in);
      item.Multiply(this->Factors[k]);
      AddTo(lines + this->Places[k], item.Real, item.Imaginary);
    }
  }

  /// Of real fields, whose terms of m and -m are conjugates: those of m >= 0 suffice, and the real
  /// parts are those fields, the imaginary parts others (null: none).
  void AddReal(const float* in, const float* others, std::size_t width, float* lines) const
  {
    in += this->Degree * width;
    others += others ? this->Degree * width : 0;
    for (std::size_t m = 0; m <= this->Degree; ++m, in += width, others += others ? width : 0)
    {
      Item one(in);
      Item other(others ? others : in);
      one.Multiply(this->Factors[this->Degree + m]);
      other.Multiply(others ? this->Factors[this->Degree + m] : 0.0f);
      AddTo(lines + this->Places[this->Degree + m], one.Real - other.Imaginary,
        one.Imaginary + other.Real);
      if (m > 0)
      {
        AddTo(lines + this->Places[this->Degree - m], one.Real + other.Imaginary,
          other.Real - one.Imaginary);
      }
    }
  }

private:
  std::size_t Degree;
  std::vector<std::complex<float>> Factors;
  std::vector<std::size_t> Places;
};
}

FieldSynthesis::FieldSynthesis(const EnvironmentHarmonics& environment, int rows, int columns,
  MapNodes nodes, const std::vector<int>& chosen)
  : Environment(environment)
  , AllRows(rows)
  , Chosen(chosen)
  , Columns(columns)
  , Nodes(nodes)
{
  for (int row = 0; chosen.empty() && row < rows; ++row)
  {
    this->Chosen.push_back(row);
  }
  this->Rows = static_cast<int>(this->Chosen.size());
  for (std::size_t row = 0; row < this->Chosen.size(); row += Lanes)
  {
    WignerLanes::Values theta;
    for (std::size_t lane = 0; lane < Lanes; ++lane)
    {
      const int at = this->Chosen[std::min(row + lane, this->Chosen.size() - 1)];
      theta[lane] = nodes == MapNodes::Centers ? Pi * (at + 0.5) / rows : Pi * at / (rows - 1);
    }
    this->Angles.emplace_back(theta);
  }
}

void FieldSynthesis::Run(
  int order, const Kernels& kernels, std::array<Field, 3>& result, const More* more) const
{
  for (Field& field : result)
  {
    field.resize(static_cast<std::size_t>(this->Rows) * static_cast<std::size_t>(this->Columns) *
                 static_cast<std::size_t>(kernels[0].cols()));
  }
  const int degree = static_cast<int>(kernels[0].rows()) - 1;
  this->SumOrders(order, this->SumDegrees(order, kernels, more), degree, result);
  if (this->Nodes == MapNodes::Poles)
  {
    this->FitRows(order, result);
  }
}

// Linear splines along the meridians. Beyond a pole the meridian opposite goes on, in a frame that
// is turned by half a turn.
void FieldSynthesis::FitRows(int order, std::array<Field, 3>& result) const
{
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  const std::size_t rows = static_cast<std::size_t>(this->Rows);
  const std::size_t columns = static_cast<std::size_t>(this->Columns);
  std::vector<std::size_t> places(static_cast<std::size_t>(this->AllRows), none);
  for (std::size_t row = 0; row < rows; ++row)
  {
    places[static_cast<std::size_t>(this->Chosen[row])] = row;
  }
  const float sign = order % 2 != 0 ? -1.0f : 1.0f;
  for (Field& field : result)
  {
    const std::size_t maps = field.size() / (rows * columns);
    vtkSMPTools::For(0, static_cast<vtkIdType>(maps), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        Field known(rows * columns);
        for (vtkIdType map = begin; map < end; ++map)
        {
          std::complex<float>* values = &field[static_cast<std::size_t>(map) * rows * columns];
          std::copy(values, values + known.size(), known.begin());
          for (std::size_t row = 0; row < rows; ++row)
          {
            const int at = this->Chosen[row];
            const bool isFirst = at == 0;
            const bool isLast = at + 1 == this->AllRows;
            const std::size_t above = places[static_cast<std::size_t>(isFirst ? 1 : at - 1)];
            const std::size_t below = places[static_cast<std::size_t>(isLast ? at - 1 : at + 1)];
            for (std::size_t column = 0; above != none && below != none && column < columns;
                 ++column)
            {
              const std::size_t opposite = (column + columns / 2) % columns;
              values[row * columns + column] =
                FitLinearSpline(isFirst ? sign * known[above * columns + opposite]
                                        : known[above * columns + column],
                  known[row * columns + column],
                  isLast ? sign * known[below * columns + opposite]
                         : known[below * columns + column]);
            }
          }
        }
      });
  }
}

// d^l_mk at each row's polar angle, row by row, and the rows where it is not 0.
FieldSynthesis::Turns FieldSynthesis::GetTurns(int m, int order, int degree) const
{
  const WignerD functions(m, order, degree);
  const std::size_t rows = static_cast<std::size_t>(this->Rows);
  Turns turns;
  turns.First = functions.GetFirst();
  turns.Size = static_cast<std::size_t>(std::max(degree + 1 - turns.First, 0));
  turns.Begin = turns.End = 0;
  turns.Values.resize((RoundUp(rows, Lanes) + ProductRows) * turns.Size);
  std::vector<WignerLanes::Values> d(turns.Size);
  for (std::size_t row = 0; row < rows && turns.Size > 0; row += Lanes)
  {
    this->Angles[row / Lanes].Evaluate(functions, d.data());
    bool any = false;
    for (std::size_t lane = 0; lane < Lanes; ++lane)
    {
      float* out = &turns.Values[(row + lane) * turns.Size];
      for (std::size_t l = 0; l < turns.Size; ++l)
      {
        const double value = d[l][lane];
        const bool isNone = std::abs(value) < LeastTurn;
        any = any || !isNone;
        out[l] = isNone ? 0.0f : static_cast<float>(value);
      }
    }
    turns.Begin = any && turns.End == 0 ? row : turns.Begin;
    turns.End = any ? row + Lanes : turns.End;
  }
  turns.End = std::min(turns.End, rows);
  return turns;
}

bool FieldSynthesis::AreRowsSymmetric() const
{
  bool symmetric = true;
  for (std::size_t row = 0; row < this->Chosen.size(); ++row)
  {
    symmetric = symmetric &&
                this->Chosen[row] + *(this->Chosen.rbegin() + static_cast<std::ptrdiff_t>(row)) ==
                  this->AllRows - 1;
  }
  return symmetric;
}

// The sum over l: [row][m][channel][kernel], as GetPlaceOfKind has them.
std::vector<float> FieldSynthesis::SumDegrees(
  int order, const Kernels& kernels, const More* more) const
{
  const int degree = static_cast<int>(kernels[0].rows()) - 1;
  const std::size_t rows = static_cast<std::size_t>(this->Rows);
  const std::size_t kinds = 3 * static_cast<std::size_t>(kernels[0].cols());
  const std::size_t orders = 2 * static_cast<std::size_t>(degree) + 1;
  const std::size_t columns = GetSeriesWidth(kinds);
  const bool isSymmetric = this->AreRowsSymmetric();
  std::vector<float> series(orders * columns * rows);
  const auto add = [&](int m, const Turns& turns, bool mirrored)
  {
    if (turns.Begin == turns.End)
    {
      return;
    }
    std::vector<float> lit(turns.Size * columns, 0.0f);
    AddLit(this->Environment, m, turns.First, kernels, columns, lit);
    if (more)
    {
      AddLit(more->Light, m, turns.First, more->Kernels, columns, lit);
    }
    for (std::size_t k = 0; mirrored && k < turns.Size; ++k)
    {
      if ((turns.First + static_cast<int>(k) - order) % 2 != 0)
      {
        std::transform(
          &lit[k * columns], &lit[k * columns] + columns, &lit[k * columns], std::negate<float>());
      }
    }
    const std::size_t height = RoundUp(turns.End - turns.Begin, ProductRows);
    std::vector<float> product(height * columns);
    Multiply(&turns.Values[turns.Begin * turns.Size], lit.data(), height, turns.Size, columns,
      product.data());
    for (std::size_t row = turns.Begin; row < turns.End; ++row)
    {
      const std::size_t to = mirrored ? rows - 1 - row : row;
      std::copy_n(&product[(row - turns.Begin) * columns], columns,
        &series[(to * orders + static_cast<std::size_t>(m + degree)) * columns]);
    }
  };
  vtkSMPTools::For(0, degree + 1, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int m = static_cast<int>(begin); m < static_cast<int>(end); ++m)
      {
        const Turns turns = this->GetTurns(m, order, degree); // for all channels and kernels
        add(m, turns, false);
        if (m > 0 && order > 0) // of order 0 the field is real: SumOrders needs no more
        {
          // d^l_-mk(theta) = (-1)^(l-k) d^l_mk(pi - theta).
          isSymmetric ? add(-m, turns, true) : add(-m, this->GetTurns(-m, order, degree), false);
        }
      }
    });
  return series;
}

// The sum over m, by fast Fourier transforms over the azimuth, some kinds at a time.
void FieldSynthesis::SumOrders(
  int order, const std::vector<float>& series, int degree, std::array<Field, 3>& result) const
{
  const std::size_t rows = static_cast<std::size_t>(this->Rows);
  const std::size_t columns = static_cast<std::size_t>(this->Columns);
  const std::size_t orders = 2 * static_cast<std::size_t>(degree) + 1;
  const std::size_t each = result[0].size() / (rows * columns);
  const std::size_t kinds = 3 * each;
  const std::size_t width = GetSeriesWidth(kinds);
  const RowTransform transform(columns);
  const RowTerms terms(degree, transform, this->Nodes);
  vtkSMPTools::For(0, static_cast<vtkIdType>(rows), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<float> lines(columns * RowTransform::Item);
      for (std::size_t row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end);
           ++row)
      {
        const float* const in = &series[row * orders * width];
        const auto getResult = [&](std::size_t kind)
        { return &result[kind / each][(kind % each * rows + row) * columns]; };
        // Of order 0, which is real, eight more kinds are the imaginary parts.
        const std::size_t together = order > 0 ? RowTransform::Lines : 2 * RowTransform::Lines;
        for (std::size_t first = 0; first < kinds; first += together)
        {
          const float* const items = in + GetPlaceOfKind(first);
          std::fill(lines.begin(), lines.end(), 0.0f);
          if (order > 0)
          {
            terms.Add(items, width, lines.data());
          }
          else
          {
            const bool isLast = first + RowTransform::Lines >= kinds;
            terms.AddReal(
              items, isLast ? nullptr : items + RowTransform::Item, width, lines.data());
          }
          transform.Run(lines.data());
          for (std::size_t kind = first; kind < std::min(first + together, kinds); ++kind)
          {
            std::complex<float>* const out = getResult(kind);
            const float* of = &lines[order > 0 ? GetPlaceOfKind(kind - first) : kind - first];
            for (std::size_t column = 0; column < columns; ++column, of += RowTransform::Item)
            {
              out[column] = { of[0], order > 0 ? of[RowTransform::Lines] : 0.0f };
            }
          }
        }
      }
    });
}
} // namespace measuredbrdf
