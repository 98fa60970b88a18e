// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Discrete distributions and their inversion (thesis 2.1), used by the samplers of BRDFs and of
 * environments.
 */

#ifndef Distribution_h
#define Distribution_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/**
 * Probability of each of n cells proportional to its weight. Negative and non-finite weights count
 * as 0; if all are 0 the distribution is uniform (IsZero says so).
 */
class Distribution1D
{
public:
  Distribution1D() = default;

  template <typename Iterator>
  Distribution1D(Iterator begin, Iterator end)
  {
    this->Cdf.reserve(static_cast<std::size_t>(end - begin) + 1);
    this->Cdf.push_back(0.0);
    for (; begin != end; ++begin)
    {
      const double w = static_cast<double>(*begin);
      this->Cdf.push_back(this->Cdf.back() + (std::isfinite(w) && w > 0.0 ? w : 0.0));
    }
    this->Total = this->Cdf.back();
    const std::size_t n = this->GetSize();
    for (std::size_t k = 1; k <= n; ++k)
    {
      this->Cdf[k] = this->Total > 0.0 ? this->Cdf[k] / this->Total : static_cast<double>(k) / n;
    }
  }

  std::size_t GetSize() const { return this->Cdf.empty() ? 0 : this->Cdf.size() - 1; }
  bool IsZero() const { return !(this->Total > 0.0); }

  /// Sum of the weights.
  double GetTotal() const { return this->Total; }

  /// Probability of cell k.
  double GetProbability(std::size_t k) const { return this->Cdf[k + 1] - this->Cdf[k]; }

  /// F_k = sum of the probabilities of the cells before k; k = size gives 1.
  double GetCumulative(std::size_t k) const { return this->Cdf[k]; }

  /**
   * The cell that contains u in [0,1) (never one of probability 0), and the position of u inside
   * it, in [0,1), which is a uniform number and may be used again.
   */
  std::size_t Invert(double u, double& remainder) const
  {
    const std::size_t n = this->GetSize();
    // First boundary beyond u; a cell of probability 0 has equal boundaries and is stepped over.
    auto it = std::upper_bound(this->Cdf.begin() + 1, this->Cdf.end(), u);
    std::size_t k = static_cast<std::size_t>(it - this->Cdf.begin()) - 1;
    if (k >= n) // u >= 1 or rounding of the last boundary
    {
      k = n - 1;
      while (k > 0 && this->GetProbability(k) <= 0.0)
      {
        --k;
      }
    }
    const double p = this->GetProbability(k);
    remainder = p > 0.0 ? std::clamp((u - this->Cdf[k]) / p, 0.0, 0x1.fffffffffffffp-1) : 0.0;
    return k;
  }

private:
  std::vector<double> Cdf;
  double Total = 0.0;
};

/**
 * Probability of each cell of a grid (row-major, rows of `width`) proportional to its weight:
 * marginal over rows, conditional within a row. Rows of weight 0 are never drawn.
 */
class Distribution2D
{
public:
  Distribution2D() = default;

  Distribution2D(const std::vector<double>& weights, std::size_t width, std::size_t height)
  {
    std::vector<double> rows(height);
    this->Rows.reserve(height);
    for (std::size_t y = 0; y < height; ++y)
    {
      const auto begin = weights.begin() + static_cast<std::ptrdiff_t>(y * width);
      this->Rows.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(width));
      rows[y] = this->Rows.back().GetTotal();
    }
    this->Marginal = Distribution1D(rows.begin(), rows.end());
  }

  bool IsZero() const { return this->Marginal.IsZero(); }
  double GetTotal() const { return this->Marginal.GetTotal(); }

  double GetProbability(std::size_t x, std::size_t y) const
  {
    return this->Marginal.GetProbability(y) * this->Rows[y].GetProbability(x);
  }

  /// Cell drawn by (u, v), v choosing the row; remainders in [0,1) place a point inside the cell.
  void Invert(double u, double v, std::size_t& x, std::size_t& y, double& ru, double& rv) const
  {
    y = this->Marginal.Invert(v, rv);
    x = this->Rows[y].Invert(u, ru);
  }

private:
  Distribution1D Marginal;
  std::vector<Distribution1D> Rows;
};
} // namespace measuredbrdf

#endif
