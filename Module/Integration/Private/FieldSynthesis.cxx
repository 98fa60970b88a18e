// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldSynthesis.h"

#include "HalfVector.h" // for Pi
#include "LinearSpline.h"
#include "MatrixProduct.h"
#include "ParallelFor.h"
#include "RowTransform.h"
#include "WignerD.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>

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

// All kinds of a degree side by side.
std::vector<float> Pack(const DegreeSum::Kernels& kernels)
{
  const Eigen::Index count = kernels[0].cols();
  const Eigen::Index degrees = kernels[0].rows();
  std::vector<float> packed(static_cast<std::size_t>(3 * count * degrees));
  for (Eigen::Index channel = 0; channel < 3; ++channel)
  {
    for (Eigen::Index kernel = 0; kernel < count; ++kernel)
    {
      const auto of = kernels[static_cast<std::size_t>(channel)].col(kernel);
      for (Eigen::Index l = 0; l < degrees; ++l)
      {
        packed[static_cast<std::size_t>((l * 3 + channel) * count + kernel)] = of[l];
      }
    }
  }
  return packed;
}

// Adds b_lk a_lm of each degree from the first on: real parts of all kinds, imaginary parts, and
// what fills the width.
void AddLit(const EnvironmentHarmonics& light, int m, int first, const std::vector<float>& packed,
  std::size_t kinds, std::size_t width, std::vector<float>& lit)
{
  const Eigen::Index count = static_cast<Eigen::Index>(kinds / 3);
  for (std::size_t k = 0; k * width < lit.size(); ++k)
  {
    const std::size_t l = static_cast<std::size_t>(first) + k;
    const float* of = &packed[l * kinds];
    float* out = &lit[k * width];
    for (int channel = 0; channel < 3; ++channel, of += count, out += count)
    {
      const std::complex<double> a = light.Get(channel, static_cast<int>(l), m);
      const KnownNumbers b(of, count);
      Numbers(out, count) += static_cast<float>(a.real()) * b;
      Numbers(out + kinds, count) += static_cast<float>(a.imag()) * b;
    }
  }
}
}

DegreeSum::DegreeSum(const std::vector<double>& theta, const std::vector<int>& rows)
  : Wanted(rows.size())
{
  const std::size_t last = theta.size() - 1;
  std::vector<Row> all(theta.size(), { None, None });
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const std::size_t row = static_cast<std::size_t>(rows[k]);
    all[row].Place = all[last - row].Mirror = k;
  }
  std::vector<int> both;
  for (std::size_t row = 0; row < all.size(); ++row)
  {
    if (all[row].Place != None || all[row].Mirror != None)
    {
      both.push_back(static_cast<int>(row));
    }
  }
  this->All = MakePanels(theta, all, both);
  both.resize((both.size() + 1) / 2);
  this->North = MakePanels(theta, all, both);
}

// Rows that are too many are wanted nowhere.
std::vector<DegreeSum::Panel> DegreeSum::MakePanels(
  const std::vector<double>& theta, const std::vector<Row>& rows, const std::vector<int>& at)
{
  std::vector<Panel> panels;
  for (std::size_t first = 0; first < at.size(); first += WignerLanes::Count)
  {
    WignerLanes::Values angles;
    Panel panel;
    for (std::size_t lane = 0; lane < WignerLanes::Count; ++lane)
    {
      const bool isThere = first + lane < at.size();
      const std::size_t row = static_cast<std::size_t>(isThere ? at[first + lane] : at.back());
      angles[lane] = theta[row];
      panel.Rows[lane] = isThere ? rows[row] : Row{ None, None };
    }
    panel.Angles = WignerLanes(angles);
    panels.push_back(panel);
  }
  return panels;
}

void DegreeSum::Run(int order, const std::vector<Part>& parts)
{
  const Kernels& kernels = parts.front().Of;
  this->Degree = static_cast<int>(kernels[0].rows()) - 1;
  this->Kinds = 3 * static_cast<std::size_t>(kernels[0].cols());
  this->Width = RoundUp(2 * this->Kinds, ProductColumns);
  this->Orders = 2 * static_cast<std::size_t>(this->Degree) + 1;
  this->Series.resize(this->Wanted * this->Orders * this->Width + Beyond);
  this->Known.assign(this->Wanted * this->Orders, 0);
  this->Conjugate.assign(this->Width, -1.0f);
  std::fill_n(this->Conjugate.begin(), this->Kinds, 1.0f);
  Packed packed;
  for (const Part& part : parts)
  {
    packed.push_back(Pack(part.Of));
  }
  measuredbrdf::ParallelFor(0, this->Degree + 1, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType m = begin; m < end; ++m)
      {
        this->AddOrders(static_cast<int>(m), order, parts, packed);
      }
    });
}

// Of m and -m.
void DegreeSum::AddOrders(int m, int order, const std::vector<Part>& parts, const Packed& packed)
{
  const WignerD functions(m, order, this->Degree);
  if (functions.IsEmpty())
  {
    return;
  }
  const int first = functions.GetFirst();
  const std::size_t size = static_cast<std::size_t>(this->Degree + 1 - first);
  std::vector<float> lit(size * this->Width, 0.0f);
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    AddLit(parts[part].Light, m, first, packed[part], this->Kinds, this->Width, lit);
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

void DegreeSum::Multiply(const Panel& panel, int m, int order, int first, std::size_t size,
  std::size_t begin, const std::vector<float>& turns, const std::vector<float>& lit)
{
  static_assert(ProductRows == WignerLanes::Count, "a panel is what is turned at a time");
  const std::size_t begins[2] = { begin, begin + 1 };
  const bool isOdd = (first + static_cast<int>(begin) - order) % 2 != 0; // the first l - k
  const float sign = m % 2 != 0 ? -1.0f : 1.0f;
  constexpr std::size_t together = 3 * ProductColumns;
  float sums[2][ProductRows * together];
  for (std::size_t column = 0; column < this->Width; column += together)
  {
    const std::size_t columns = std::min(together, this->Width - column);
    for (std::size_t part = 0; part < 2; ++part)
    {
      const std::size_t from = begins[part];
      measuredbrdf::Multiply({ turns.data() + ProductRows * from, 2 * ProductRows },
        { lit.data() + from * this->Width + column, 2 * this->Width }, ProductRows,
        from < size ? (size - from + 1) / 2 : 0, columns, sums[part]);
    }
    const Eigen::Index count = static_cast<Eigen::Index>(columns);
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
      const Row& places = panel.Rows[row];
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
