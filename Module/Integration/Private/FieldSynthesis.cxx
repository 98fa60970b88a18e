// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldSynthesis.h"

#include "HalfVector.h" // for Pi
#include "LinearSpline.h"
#include "MatrixProduct.h"
#include "WignerD.h"
#include "vtkSMPTools.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

namespace measuredbrdf
{
namespace
{
constexpr double LeastTurn = 1e-15; // less is 0: slow in floats, and nothing
constexpr std::size_t Lanes = 4;    // rows at a time

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
      float* out = &lit[2 * (channel * count + kernel)];
      for (std::size_t k = 0; k < size; ++k, out += columns)
      {
        out[0] += of[k] * values[k].real();
        out[1] += of[k] * values[k].imag();
      }
    }
  }
}

constexpr std::size_t KindsAtATime = 8; // a cache line

std::complex<float> Times(const std::complex<float>& a, const std::complex<float>& b)
{
  return { a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real() };
}

// Where a row's terms lie in a Fourier transform of the columns, and what each is multiplied by.
class RowTerms
{
public:
  RowTerms(int degree, int columns, MapNodes nodes)
    : Degree(static_cast<std::size_t>(degree))
  {
    for (int m = -degree; m <= degree; ++m)
    {
      const double frequency = static_cast<double>(m) / columns;
      this->Factors.push_back(nodes == MapNodes::Centers // half a column on
                                ? std::polar(1.0f, static_cast<float>(-Pi * frequency))
                                : static_cast<float>(GetLinearSplineGain(frequency)));
      this->Places.push_back(static_cast<std::size_t>((m % columns + columns) % columns));
    }
  }

  using Lines = std::array<FieldSynthesis::Field, KindsAtATime>;

  /// in: count of the kinds, after each other for each m.
  void Add(const std::complex<float>* in, std::size_t kinds, std::size_t count, Lines& lines) const
  {
    for (std::size_t item = 0; item < this->Places.size(); ++item, in += kinds)
    {
      for (std::size_t k = 0; k < count; ++k)
      {
        lines[k][this->Places[item]] += Times(this->Factors[item], in[k]);
      }
    }
  }

  /// Of real fields, whose terms of m and -m are conjugates: those of m >= 0 suffice, and two
  /// fields are the real and the imaginary part of one.
  void AddReal(
    const std::complex<float>* in, std::size_t kinds, std::size_t count, Lines& lines) const
  {
    in += this->Degree * kinds;
    for (std::size_t m = 0; m <= this->Degree; ++m, in += kinds)
    {
      for (std::size_t k = 0; k < count; ++k)
      {
        const std::complex<float> value = Times(this->Factors[this->Degree + m], in[k]);
        const std::complex<float> unit =
          k % 2 == 0 ? std::complex<float>(1.0f) : std::complex<float>(0.0f, 1.0f);
        lines[k / 2][this->Places[this->Degree + m]] += Times(unit, value);
        if (m > 0)
        {
          lines[k / 2][this->Places[this->Degree - m]] += Times(unit, std::conj(value));
        }
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
  using Values = Eigen::Array<double, Lanes, 1>;
  const WignerD functions(m, order, degree);
  const std::size_t rows = static_cast<std::size_t>(this->Rows);
  Turns turns;
  turns.First = functions.GetFirst();
  turns.Size = static_cast<std::size_t>(std::max(degree + 1 - turns.First, 0));
  turns.Begin = turns.End = 0;
  turns.Values.resize((RoundUp(rows, Lanes) + ProductRows) * turns.Size);
  std::vector<Values> d(turns.Size);
  for (std::size_t row = 0; row < rows && turns.Size > 0; row += Lanes)
  {
    Values theta;
    for (std::size_t lane = 0; lane < Lanes; ++lane)
    {
      const int at = this->Chosen[std::min(row + lane, rows - 1)];
      theta[static_cast<Eigen::Index>(lane)] = this->Nodes == MapNodes::Centers
                                                 ? Pi * (at + 0.5) / this->AllRows
                                                 : Pi * at / (this->AllRows - 1);
    }
    functions.Evaluate(theta, d.data());
    bool any = false;
    for (std::size_t lane = 0; lane < Lanes; ++lane)
    {
      float* out = &turns.Values[(row + lane) * turns.Size];
      for (std::size_t l = 0; l < turns.Size; ++l)
      {
        const double value = d[l][static_cast<Eigen::Index>(lane)];
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

// The sum over l: [row][m][channel][kernel].
FieldSynthesis::Field FieldSynthesis::SumDegrees(
  int order, const Kernels& kernels, const More* more) const
{
  const int degree = static_cast<int>(kernels[0].rows()) - 1;
  const std::size_t rows = static_cast<std::size_t>(this->Rows);
  const std::size_t kinds = 3 * static_cast<std::size_t>(kernels[0].cols());
  const std::size_t orders = 2 * static_cast<std::size_t>(degree) + 1;
  const std::size_t columns = RoundUp(2 * kinds, ProductColumns);
  const bool isSymmetric = this->AreRowsSymmetric();
  Field series(orders * kinds * rows);
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
      const auto* in =
        reinterpret_cast<const std::complex<float>*>(&product[(row - turns.Begin) * columns]);
      const std::size_t to = mirrored ? rows - 1 - row : row;
      std::copy(
        in, in + kinds, &series[(to * orders + static_cast<std::size_t>(m + degree)) * kinds]);
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
  int order, const Field& series, int degree, std::array<Field, 3>& result) const
{
  const std::size_t rows = static_cast<std::size_t>(this->Rows);
  const std::size_t columns = static_cast<std::size_t>(this->Columns);
  const std::size_t orders = 2 * static_cast<std::size_t>(degree) + 1;
  const std::size_t kinds = series.size() / (orders * rows);
  const std::size_t each = kinds / 3;
  const RowTerms terms(degree, this->Columns, this->Nodes);
  vtkSMPTools::For(0, static_cast<vtkIdType>(rows), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      Eigen::FFT<float> transform;
      std::array<Field, KindsAtATime> lines;
      for (std::size_t row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end);
           ++row)
      {
        for (std::size_t kind = 0; kind < kinds; kind += KindsAtATime)
        {
          const std::size_t count = std::min(KindsAtATime, kinds - kind);
          const auto* in = &series[row * orders * kinds + kind];
          const auto getResult = [&](std::size_t k)
          { return &result[k / each][(k % each * rows + row) * columns]; };
          for (Field& line : lines)
          {
            line.assign(columns, 0.0f);
          }
          if (order > 0)
          {
            terms.Add(in, kinds, count, lines);
            for (std::size_t k = 0; k < count; ++k)
            {
              transform.fwd(
                getResult(kind + k), lines[k].data(), static_cast<Eigen::Index>(columns));
            }
            continue;
          }
          terms.AddReal(in, kinds, count, lines);
          Field both(columns);
          for (std::size_t k = 0; k < count; ++k)
          {
            if (k % 2 == 0)
            {
              transform.fwd(both.data(), lines[k / 2].data(), static_cast<Eigen::Index>(columns));
            }
            std::transform(both.begin(), both.end(), getResult(kind + k),
              [k](const std::complex<float>& value)
              { return k % 2 == 0 ? value.real() : value.imag(); });
          }
        }
      }
    });
}
} // namespace measuredbrdf
