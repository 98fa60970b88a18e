// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Piecewise bilinear functions on the unit square that depend on up to three parameters, and the
 * warp that such a density defines (the "marginal 2D" of Dupuy and Jakob 2018, section 5): x from
 * the conditional, y from the marginal, both piecewise linear in the density.
 */

#ifndef BilinearWarp_h
#define BilinearWarp_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
class BilinearWarp
{
public:
  BilinearWarp() = default;

  /**
   * values: [axis 0][axis 1]...[height][width], axes slowest first, each with its sorted parameter
   * values. asDensity normalizes every slice to integral 1 and builds its CDFs.
   */
  BilinearWarp(const std::vector<float>& values, int width, int height,
    std::vector<std::vector<float>> axes, bool asDensity)
    : Width(width)
    , Height(height)
    , Axes(std::move(axes))
    , Values(values.begin(), values.end())
  {
    if (!asDensity)
    {
      return;
    }
    const std::size_t size = this->GetSliceSize();
    this->Conditional.resize(this->Values.size());
    this->Marginal.resize(this->Values.size() / static_cast<std::size_t>(width));
    for (std::size_t slice = 0; slice < this->Values.size() / size; ++slice)
    {
      this->BuildCdf(&this->Values[slice * size], &this->Conditional[slice * size],
        &this->Marginal[slice * static_cast<std::size_t>(height)]);
    }
  }

  ///@{
  /// Slices of Width x Height; the integrals along a row (a row's last one is its total) and of all
  /// rows before one, where asDensity.
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  const std::vector<double>& GetValues() const { return this->Values; }
  const std::vector<double>& GetConditional() const { return this->Conditional; }
  const std::vector<double>& GetMarginal() const { return this->Marginal; }
  ///@}

  /// Integral of a slice's bilinear interpolant over the grid's cells; for checks before building.
  static double GetSum(const float* values, int width, int height)
  {
    double sum = 0.0;
    for (int y = 0; y + 1 < height; ++y)
    {
      for (int x = 0; x + 1 < width; ++x)
      {
        const float* v = values + y * width + x;
        sum += 0.25 * (static_cast<double>(v[0]) + v[1] + v[width] + v[width + 1]);
      }
    }
    return sum;
  }

  /// The slices around a set of parameters and their weights (at most 2^3).
  struct Slices
  {
    std::size_t Index[8];
    double Weight[8];
    int Count = 0;
  };

  Slices FindSlices(const double* parameters) const
  {
    Slices result;
    result.Index[0] = 0;
    result.Weight[0] = 1.0;
    result.Count = 1;
    for (std::size_t a = 0; a < this->Axes.size(); ++a)
    {
      const std::vector<float>& axis = this->Axes[a];
      std::size_t first = 0;
      double w = 0.0;
      if (axis.size() > 1)
      {
        const auto it = std::upper_bound(axis.begin(), axis.end(), parameters[a]);
        first = std::min<std::size_t>(
          std::max<std::ptrdiff_t>(it - axis.begin() - 1, 0), axis.size() - 2);
        w = std::clamp((parameters[a] - axis[first]) / (axis[first + 1] - axis[first]), 0.0, 1.0);
      }
      const int count = result.Count;
      for (int k = 0; k < count; ++k)
      {
        result.Index[k] = result.Index[k] * axis.size() + first;
        if (w > 0.0)
        {
          result.Index[result.Count] = result.Index[k] + 1;
          result.Weight[result.Count++] = result.Weight[k] * w;
          result.Weight[k] *= 1.0 - w;
        }
      }
    }
    return result;
  }

  /// Value at u in [0,1]^2 (a density where asDensity).
  double Evaluate(const glm::dvec2& u, const Slices& slices) const
  {
    glm::dvec2 fraction;
    const std::size_t cell = this->FindCell(u, fraction);
    return Interpolate(this->GetCorners(cell, slices), fraction) *
           (this->Conditional.empty() ? 1.0 : this->GetCellsPerSquare());
  }

  /// Values of three functions, no densities, whose slices lie one after another.
  void EvaluateThree(const glm::dvec2& u, const Slices& slices, double values[3]) const
  {
    glm::dvec2 fraction;
    const std::size_t cell = this->FindCell(u, fraction);
    for (std::size_t c = 0; c < 3; ++c)
    {
      values[c] = Interpolate(this->GetCorners(cell, slices, 3, c), fraction);
    }
  }

  /// Uniform square -> square with this density. density: at the returned point.
  glm::dvec2 Sample(glm::dvec2 u, const Slices& slices, double& density) const
  {
    u = glm::clamp(u, glm::dvec2(0.0), glm::dvec2(1.0));
    // Row by the marginal CDF.
    const std::size_t height = this->Height;
    const std::size_t width = this->Width;
    const auto marginal = [&](std::size_t y)
    { return this->Lookup(this->Marginal, y, height, slices); };
    const std::size_t row = FindInterval(height, u.y, marginal);
    u.y -= marginal(row);
    const double r0 = this->RowTotal(row, slices);
    const double r1 = this->RowTotal(row + 1, slices);
    u.y = InvertLinear(r0, r1, u.y);
    // Column by the conditional CDF of the interpolated row.
    u.x *= glm::mix(r0, r1, u.y);
    const auto conditional = [&](std::size_t x)
    {
      return glm::mix(
        this->Lookup(this->Conditional, row * width + x, this->GetSliceSize(), slices),
        this->Lookup(this->Conditional, (row + 1) * width + x, this->GetSliceSize(), slices), u.y);
    };
    const std::size_t column = FindInterval(width, u.x, conditional);
    u.x -= conditional(column);
    const Corners corners = this->GetCorners(row * width + column, slices);
    const glm::dvec2 c = glm::mix(corners[0], corners[1], u.y);
    u.x = InvertLinear(c.x, c.y, u.x);
    density = glm::mix(c.x, c.y, u.x) * this->GetCellsPerSquare();
    return (glm::dvec2(column, row) + u) / glm::dvec2(this->Width - 1, this->Height - 1);
  }

  /// The inverse of Sample. density: at u.
  glm::dvec2 Invert(const glm::dvec2& u, const Slices& slices, double& density) const
  {
    glm::dvec2 fraction;
    const std::size_t cell = this->FindCell(u, fraction);
    const std::size_t width = this->Width;
    const std::size_t row = cell / width;
    // All that is looked up, in one pass over the slices: integrals up to the cell's left side, and
    // of whole rows.
    Corners corners(0.0);
    glm::dvec2 before(0.0), total(0.0);
    double below = 0.0;
    for (int k = 0; k < slices.Count; ++k)
    {
      const std::size_t slice = slices.Index[k];
      const double w = slices.Weight[k];
      const double* conditional = &this->Conditional[slice * this->GetSliceSize()];
      corners += w * this->GetCornersOf(cell, slice);
      before += w * glm::dvec2(conditional[cell], conditional[cell + width]);
      total +=
        w * glm::dvec2(conditional[(row + 1) * width - 1], conditional[(row + 2) * width - 1]);
      below += w * this->Marginal[slice * this->Height + row];
    }
    // From 0 to t under a line from a.x to a.y.
    const auto integrate = [](const glm::dvec2& a, double t)
    { return t * (a.x + 0.5 * t * (a.y - a.x)); };
    const glm::dvec2 c = glm::mix(corners[0], corners[1], fraction.y);
    density = glm::mix(c.x, c.y, fraction.x) * this->GetCellsPerSquare();
    const double x = integrate(c, fraction.x) + glm::mix(before.x, before.y, fraction.y);
    const double all = glm::mix(total.x, total.y, fraction.y);
    return glm::dvec2(all > 0.0 ? x / all : 0.0, integrate(total, fraction.y) + below);
  }

private:
  /// Values at a cell's corners, the lower two and the upper two.
  using Corners = glm::dmat2;

  std::size_t GetSliceSize() const
  {
    return static_cast<std::size_t>(this->Width) * static_cast<std::size_t>(this->Height);
  }

  double GetCellsPerSquare() const
  {
    return static_cast<double>(this->Width - 1) * (this->Height - 1);
  }

  void BuildCdf(double* values, double* conditional, double* marginal) const
  {
    for (int y = 0; y < this->Height; ++y)
    {
      double sum = 0.0;
      double* row = conditional + y * this->Width;
      row[0] = 0.0;
      for (int x = 1; x < this->Width; ++x)
      {
        sum += 0.5 * (values[y * this->Width + x - 1] + values[y * this->Width + x]);
        row[x] = sum;
      }
    }
    double sum = 0.0;
    marginal[0] = 0.0;
    for (int y = 1; y < this->Height; ++y)
    {
      sum += 0.5 * (conditional[y * this->Width - 1] + conditional[(y + 1) * this->Width - 1]);
      marginal[y] = sum;
    }
    for (std::size_t k = 0; k < this->GetSliceSize(); ++k)
    {
      values[k] /= sum;
      conditional[k] /= sum;
    }
    for (int y = 0; y < this->Height; ++y)
    {
      marginal[y] /= sum;
    }
  }

  std::size_t FindCell(const glm::dvec2& u, glm::dvec2& fraction) const
  {
    const glm::dvec2 place =
      glm::clamp(u, 0.0, 1.0) * glm::dvec2(this->Width - 1, this->Height - 1);
    const glm::ivec2 cell =
      glm::min(glm::ivec2(place), glm::ivec2(this->Width - 2, this->Height - 2));
    fraction = place - glm::dvec2(cell);
    return static_cast<std::size_t>(cell.y) * this->Width + cell.x;
  }

  double Lookup(const std::vector<double>& data, std::size_t offset, std::size_t stride,
    const Slices& slices) const
  {
    double value = 0.0;
    for (int k = 0; k < slices.Count; ++k)
    {
      value += slices.Weight[k] * data[slices.Index[k] * stride + offset];
    }
    return value;
  }

  double RowTotal(std::size_t row, const Slices& slices) const
  {
    const std::size_t width = this->Width;
    return this->Lookup(this->Conditional, (row + 1) * width - 1, this->GetSliceSize(), slices);
  }

  Corners GetCornersOf(std::size_t cell, std::size_t slice) const
  {
    const double* v = &this->Values[slice * this->GetSliceSize() + cell];
    return Corners(v[0], v[1], v[this->Width], v[this->Width + 1]);
  }

  /// Of slices that are `stride` apart, from the first one on.
  Corners GetCorners(
    std::size_t cell, const Slices& slices, std::size_t stride = 1, std::size_t first = 0) const
  {
    Corners corners(0.0);
    for (int k = 0; k < slices.Count; ++k)
    {
      corners += slices.Weight[k] * this->GetCornersOf(cell, stride * slices.Index[k] + first);
    }
    return corners;
  }

  static double Interpolate(const Corners& corners, const glm::dvec2& fraction)
  {
    const glm::dvec2 c = glm::mix(corners[0], corners[1], fraction.y);
    return glm::mix(c.x, c.y, fraction.x);
  }

  /// Largest k with cdf(k) <= u, at most n - 2.
  template <typename Cdf>
  static std::size_t FindInterval(std::size_t n, double u, const Cdf& cdf)
  {
    std::size_t first = 0;
    std::size_t last = n - 1;
    while (last - first > 1)
    {
      const std::size_t middle = (first + last) / 2;
      (cdf(middle) <= u ? first : last) = middle;
    }
    return first;
  }

  /// x in [0,1] with x (a + x (b-a)/2) = area: inversion of a linear density a..b.
  static double InvertLinear(double a, double b, double area)
  {
    const double d = b - a;
    double x = 0.0;
    if (std::abs(d) > 1e-4 * (a + b))
    {
      x = (std::sqrt(std::max(a * a + 2.0 * area * d, 0.0)) - a) / d;
    }
    else if (a + b > 0.0)
    {
      x = 2.0 * area / (a + b);
    }
    return std::clamp(x, 0.0, 1.0);
  }

  int Width = 0;
  int Height = 0;
  std::vector<std::vector<float>> Axes;
  std::vector<double> Values;
  std::vector<double> Conditional;
  std::vector<double> Marginal;
};
} // namespace measuredbrdf

#endif
