// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldSynthesis.h"

#include "HalfVector.h" // for Pi
#include "LinearSpline.h"
#include "ParallelFor.h"
#include "RowTransform.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
using Lane = Eigen::Array<float, RowTransform::Lines, 1>; // a part of an item, of eight kinds

struct Item
{
  Lane Real, Imaginary;

  Item(const float* real, const float* imaginary)
    : Real(Eigen::Map<const Lane>(real))
    , Imaginary(Eigen::Map<const Lane>(imaginary))
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

  /// Of some kinds from the first on.
  void Add(const DegreeSum& sums, std::size_t row, std::size_t first, float* lines) const
  {
    const int degree = static_cast<int>(this->Degree);
    for (int m = -degree; m <= degree; ++m)
    {
      if (const float* in = sums.Get(row, m))
      {
        const std::size_t k = static_cast<std::size_t>(m + degree);
        Item item(in + first, in + sums.GetNumberOfKinds() + first);
        item.Multiply(this->Factors[k]);
        AddTo(lines + this->Places[k], item.Real, item.Imaginary);
      }
    }
  }

  /// Of real fields, whose terms of m and -m are conjugates: those of m >= 0 suffice, and the real
  /// parts are those fields, the imaginary parts the next ones, if there are any.
  void AddReal(const DegreeSum& sums, std::size_t row, std::size_t first, float* lines) const
  {
    const std::size_t kinds = sums.GetNumberOfKinds();
    const std::size_t next = std::min(first + RowTransform::Lines, kinds);
    const Eigen::Index beyond = // kinds that are none
      static_cast<Eigen::Index>(RowTransform::Lines - std::min(RowTransform::Lines, kinds - next));
    for (std::size_t m = 0; m <= this->Degree; ++m)
    {
      const float* in = sums.Get(row, static_cast<int>(m));
      if (!in)
      {
        continue;
      }
      const std::complex<float> factor = this->Factors[this->Degree + m];
      Item one(in + first, in + kinds + first);
      Item other(in + next, in + kinds + next);
      other.Real.tail(beyond) = other.Imaginary.tail(beyond) = 0.0f;
      one.Multiply(factor);
      other.Multiply(factor);
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

std::vector<double> GetPolarAngles(int rows, MapNodes nodes)
{
  std::vector<double> angles;
  for (int row = 0; row < rows; ++row)
  {
    angles.push_back(nodes == MapNodes::Centers ? Pi * (row + 0.5) / rows : Pi * row / (rows - 1));
  }
  return angles;
}
}

FieldSynthesis::FieldSynthesis(
  const EnvironmentHarmonics& environment, int rows, int columns, MapNodes nodes)
  : FieldSynthesis(environment, MapPart::OfAll(rows, columns), nodes)
{
}

FieldSynthesis::FieldSynthesis(
  const EnvironmentHarmonics& environment, const MapPart& part, MapNodes nodes)
  : Environment(environment)
  , Part(part)
  , Nodes(nodes)
  , Degrees(GetPolarAngles(part.GetAllRows(), nodes), part.GetRows())
{
  if (nodes == MapNodes::Poles)
  {
    this->FindNeighbors();
  }
}

void FieldSynthesis::Run(
  int order, const Kernels& kernels, std::array<Field, 3>& result, const More* more)
{
  for (Field& field : result)
  {
    field.resize(this->Part.GetNumberOfNodes() * static_cast<std::size_t>(kernels[0].cols()));
  }
  std::vector<DegreeSum::Part> parts{ { this->Environment, kernels } };
  if (more)
  {
    parts.push_back({ more->Light, more->Kernels });
  }
  this->Degrees.Run(order, parts);
  this->SumOrders(order, result);
  if (this->Nodes == MapNodes::Poles)
  {
    this->FitRows(order, result);
  }
}

void FieldSynthesis::FindNeighbors()
{
  const int last = this->Part.GetAllRows() - 1;
  for (std::size_t row = 0; row < this->Part.GetRows().size(); ++row)
  {
    const int at = this->Part.GetRows()[row];
    for (const int column : this->Part.GetColumns(row))
    {
      this->NeighborsOf.push_back(
        { this->Part.Find(at - 1, column), this->Part.Find(at + 1, column), at == 0, at == last });
    }
  }
}

// Linear splines along the meridians. Beyond a pole the meridian opposite goes on, in a frame that
// is turned by half a turn.
void FieldSynthesis::FitRows(int order, std::array<Field, 3>& result) const
{
  const std::size_t nodes = this->Part.GetNumberOfNodes();
  const float sign = order % 2 != 0 ? -1.0f : 1.0f;
  const std::size_t maps = nodes > 0 ? result[0].size() / nodes : 0;
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(3 * maps), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      Field known(nodes);
      for (std::size_t map = static_cast<std::size_t>(begin); map < static_cast<std::size_t>(end);
           ++map)
      {
        std::complex<float>* values = &result[map / maps][map % maps * nodes];
        std::copy(values, values + nodes, known.begin());
        for (std::size_t node = 0; node < nodes; ++node)
        {
          const Neighbors& of = this->NeighborsOf[node];
          if (of.Above != MapPart::None && of.Below != MapPart::None)
          {
            const std::complex<float>& above = known[static_cast<std::size_t>(of.Above)];
            const std::complex<float>& below = known[static_cast<std::size_t>(of.Below)];
            values[node] = FitLinearSpline(of.IsAbovePole ? sign * above : above, known[node],
              of.IsBelowPole ? sign * below : below);
          }
        }
      }
    });
}

// The sum over m, by fast Fourier transforms over the azimuth, some kinds at a time.
void FieldSynthesis::SumOrders(int order, std::array<Field, 3>& result) const
{
  const std::size_t columns = static_cast<std::size_t>(this->Part.GetAllColumns());
  const std::size_t nodes = this->Part.GetNumberOfNodes();
  const std::size_t kinds = this->Degrees.GetNumberOfKinds();
  const std::size_t each = kinds / 3;
  const RowTransform transform(columns);
  const RowTerms terms(this->Degrees.GetDegree(), transform, this->Nodes);
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(this->Part.GetRows().size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<float> lines(columns * RowTransform::Item);
      for (std::size_t row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end);
           ++row)
      {
        // Of order 0, which is real, eight more kinds are the imaginary parts.
        const std::size_t together = order > 0 ? RowTransform::Lines : 2 * RowTransform::Lines;
        for (std::size_t first = 0; first < kinds; first += together)
        {
          std::fill(lines.begin(), lines.end(), 0.0f);
          if (order > 0)
          {
            terms.Add(this->Degrees, row, first, lines.data());
          }
          else
          {
            terms.AddReal(this->Degrees, row, first, lines.data());
          }
          transform.Run(lines.data());
          for (std::size_t kind = first; kind < std::min(first + together, kinds); ++kind)
          {
            std::complex<float>* out =
              &result[kind / each][kind % each * nodes + this->Part.GetFirstNode(row)];
            const std::size_t line = kind - first;
            for (const int column : this->Part.GetColumns(row))
            {
              const float* of =
                &lines[static_cast<std::size_t>(column) * RowTransform::Item + line];
              *out++ = { of[0], order > 0 ? of[RowTransform::Lines] : 0.0f };
            }
          }
        }
      }
    });
}
} // namespace measuredbrdf
