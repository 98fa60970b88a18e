// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldSynthesis.h"

#include "HalfVector.h" // for Pi
#include "LinearSpline.h"
#include "WignerD.h"
#include "vtkSMPTools.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace measuredbrdf
{
namespace
{
// Real and imaginary parts of b_lk conj(a_lm), for the degrees from first on.
FieldSynthesis::Matrix MakeLit(
  const EnvironmentHarmonics& light, int m, int first, const FieldSynthesis::Kernels& kernels)
{
  const Eigen::Index count = kernels[0].cols();
  const int size = static_cast<int>(kernels[0].rows()) - first;
  FieldSynthesis::Matrix lit(size, 2 * 3 * count);
  for (int channel = 0; channel < 3; ++channel)
  {
    const FieldSynthesis::Matrix& of = kernels[static_cast<std::size_t>(channel)];
    for (int k = 0; k < size; ++k)
    {
      std::complex<double> a = light.Get(channel, first + k, std::abs(m));
      a = m >= 0 ? std::conj(a) : (m % 2 != 0 ? -a : a);
      for (Eigen::Index kernel = 0; kernel < count; ++kernel)
      {
        const Eigen::Index column = 2 * (channel * count + kernel);
        lit(k, column) = of(first + k, kernel) * static_cast<float>(a.real());
        lit(k, column + 1) = of(first + k, kernel) * static_cast<float>(a.imag());
      }
    }
  }
  return lit;
}
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
  this->SumOrders(this->SumDegrees(order, kernels, more), degree, result);
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

// The sum over l: [m][channel][kernel][row].
FieldSynthesis::Field FieldSynthesis::SumDegrees(
  int order, const Kernels& kernels, const More* more) const
{
  const int degree = static_cast<int>(kernels[0].rows()) - 1;
  const std::size_t kinds = 3 * static_cast<std::size_t>(kernels[0].cols());
  const std::size_t orders = 2 * static_cast<std::size_t>(degree) + 1;
  const std::size_t rows = static_cast<std::size_t>(this->Rows);
  Field series(orders * kinds * rows);
  vtkSMPTools::For(0, static_cast<vtkIdType>(orders), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<double> d(static_cast<std::size_t>(degree) + 1);
      for (vtkIdType item = begin; item < end; ++item)
      {
        const int m = static_cast<int>(item) - degree;
        const WignerD functions(m, order, degree);
        const int first = functions.GetFirst();
        const int size = degree + 1 - first;
        if (size <= 0)
        {
          continue;
        }
        Matrix turns(size, this->Rows); // the same for all channels and kernels
        for (int row = 0; row < this->Rows; ++row)
        {
          const int at = this->Chosen[static_cast<std::size_t>(row)];
          functions.Evaluate(this->Nodes == MapNodes::Centers ? Pi * (at + 0.5) / this->AllRows
                                                              : Pi * at / (this->AllRows - 1),
            d.data());
          turns.col(row) = Eigen::Map<const Eigen::VectorXd>(d.data(), size).cast<float>();
        }
        Matrix lit = MakeLit(this->Environment, m, first, kernels);
        if (more)
        {
          lit += MakeLit(more->Light, m, first, more->Kernels);
        }
        const Matrix product = turns.transpose() * lit;
        std::complex<float>* out = &series[static_cast<std::size_t>(item) * kinds * rows];
        for (std::size_t kind = 0; kind < kinds; ++kind)
        {
          const Eigen::Index column = static_cast<Eigen::Index>(2 * kind);
          for (std::size_t row = 0; row < rows; ++row)
          {
            const Eigen::Index r = static_cast<Eigen::Index>(row);
            out[kind * rows + row] = { product(r, column), product(r, column + 1) };
          }
        }
      }
    });
  return series;
}

// The sum over m, by fast Fourier transforms over the azimuth.
void FieldSynthesis::SumOrders(const Field& series, int degree, std::array<Field, 3>& result) const
{
  const std::size_t rows = static_cast<std::size_t>(this->Rows);
  const std::size_t columns = static_cast<std::size_t>(this->Columns);
  const std::size_t orders = 2 * static_cast<std::size_t>(degree) + 1;
  const std::size_t kinds = series.size() / (orders * rows);
  const std::size_t each = kinds / 3;
  std::vector<std::complex<float>> turns(orders);
  for (std::size_t item = 0; item < orders; ++item)
  {
    const double frequency = (static_cast<double>(item) - degree) / this->Columns;
    turns[item] = this->Nodes == MapNodes::Centers // half a column on
                    ? std::polar(1.0f, static_cast<float>(-Pi * frequency))
                    : static_cast<float>(GetLinearSplineGain(frequency));
  }
  vtkSMPTools::For(0, static_cast<vtkIdType>(rows), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      Eigen::FFT<float> transform;
      Field line(columns), field(columns);
      for (std::size_t row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end);
           ++row)
      {
        for (std::size_t kind = 0; kind < kinds; ++kind)
        {
          std::fill(line.begin(), line.end(), 0.0f);
          for (std::size_t item = 0; item < orders; ++item)
          {
            const int m = static_cast<int>(item) - degree;
            const int n = this->Columns;
            line[static_cast<std::size_t>((m % n + n) % n)] +=
              turns[item] * series[(item * kinds + kind) * rows + row];
          }
          transform.fwd(field, line);
          std::copy(field.begin(), field.end(),
            result[kind / each].begin() +
              static_cast<std::ptrdiff_t>((kind % each * rows + row) * columns));
        }
      }
    });
}
} // namespace measuredbrdf
