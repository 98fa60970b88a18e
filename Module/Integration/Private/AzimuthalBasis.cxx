// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AzimuthalBasis.h"

#include "CosinePowerWarp.h"
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "SymmetricEigen.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int Nodes = AzimuthalBasis::NumberOfNodes;
constexpr int Azimuths = AzimuthalBasis::NumberOfAzimuths;
constexpr int Orders = AzimuthalBasis::NumberOfOrders;
constexpr int Folded = Azimuths / 2 + 1; // azimuths 0 ... pi
constexpr int Channels = 3;

// Fourier coefficients of the weighted samples: per order, rows [channel][theta_o], columns
// theta_i.
struct Series
{
  std::vector<Eigen::MatrixXd> Cosine, Sine;
  double CosineEnergy[Nodes] = {}; // per theta_o, as threads fill it
  double SineEnergy[Nodes] = {};
  double Rest[Nodes] = {}; // beyond the highest order
};

// Transforms of samples folded about azimuth 0: orders x azimuths 0 ... pi.
struct Transform
{
  Eigen::MatrixXd Cosine, Sine;

  Transform()
    : Cosine(Orders + 1, Folded)
    , Sine(Orders + 1, Folded)
  {
    for (int m = 0; m <= Orders; ++m)
    {
      for (int p = 0; p < Folded; ++p)
      {
        this->Cosine(m, p) = std::cos(2.0 * Pi * m * p / Azimuths) / Azimuths;
        this->Sine(m, p) = std::sin(2.0 * Pi * m * p / Azimuths) / Azimuths;
      }
    }
  }
};

class Sampler
{
public:
  Sampler(vtkBRDF* brdf, Series& series)
    : BRDF(brdf)
    , Result(series)
    , In(WarpQuadrature(Nodes, 0.0))
    , Out(WarpQuadrature(Nodes, MinimumViewCosine))
  {
    series.Cosine.assign(Orders, Eigen::MatrixXd(Channels * Nodes, Nodes));
    series.Sine.assign(Orders, Eigen::MatrixXd(Channels * Nodes, Nodes));
  }

  static double GetWeight(const Quadrature& rule, int node)
  {
    const std::size_t k = static_cast<std::size_t>(node);
    return rule.Weights[k] * rule.Nodes[k];
  }

  // All pairs with this theta_o.
  void Sample(int out)
  {
    const double co = this->Out.Nodes[static_cast<std::size_t>(out)];
    const double o[3] = { std::sqrt(1.0 - co * co), 0.0, co };
    Eigen::MatrixXd even(Folded, Channels), odd(Folded, Channels);
    for (int in = 0; in < Nodes; ++in)
    {
      const double ci = this->In.Nodes[static_cast<std::size_t>(in)];
      const double si = std::sqrt(1.0 - ci * ci);
      const double weight = std::sqrt(GetWeight(this->In, in) * GetWeight(this->Out, out));
      even.setZero();
      odd.setZero();
      for (int p = 0; p < Azimuths; ++p)
      {
        const double phi = 2.0 * Pi * p / Azimuths;
        const double i[3] = { si * std::cos(phi), si * std::sin(phi), ci };
        double f[3];
        this->BRDF->Evaluate(i, o, f);
        const int row = p < Folded ? p : Azimuths - p;
        for (int c = 0; c < Channels; ++c)
        {
          even(row, c) += weight * f[c];
          odd(row, c) += (p < Folded ? weight : -weight) * f[c];
        }
      }
      this->Store(in, out, even, odd);
    }
  }

private:
  void Store(int in, int out, const Eigen::MatrixXd& even, const Eigen::MatrixXd& odd)
  {
    const Eigen::MatrixXd cosine = this->ToSeries.Cosine * even;
    const Eigen::MatrixXd sine = this->ToSeries.Sine * odd;
    for (int c = 0; c < Channels; ++c)
    {
      for (int m = 0; m < Orders; ++m)
      {
        this->Result.Cosine[static_cast<std::size_t>(m)](c * Nodes + out, in) = cosine(m, c);
        this->Result.Sine[static_cast<std::size_t>(m)](c * Nodes + out, in) = sine(m, c);
        const double times = m > 0 ? 2.0 : 1.0;
        this->Result.CosineEnergy[out] += times * cosine(m, c) * cosine(m, c);
        this->Result.SineEnergy[out] += times * sine(m, c) * sine(m, c);
      }
      this->Result.Rest[out] += cosine(Orders, c) * cosine(Orders, c);
    }
  }

  vtkBRDF* BRDF;
  Series& Result;
  Quadrature In, Out;
  Transform ToSeries;
};

// The terms of one order. Eigenvectors of the Gram matrix A^T A are the right singular vectors of
// A; its eigenvalues are only as exact as 1e-16 of the largest, 1e-8 in singular values: far below
// any tolerance asked for, and several times faster.
std::vector<AzimuthalBasis::Term> Decompose(const Series& series, int order, bool sine)
{
  const Eigen::MatrixXd& cosines = series.Cosine[static_cast<std::size_t>(order)];
  const Eigen::MatrixXd& sines = series.Sine[static_cast<std::size_t>(order)];
  const bool withSine = sine && order > 0;
  Eigen::MatrixXd gram = cosines.transpose() * cosines;
  if (withSine)
  {
    gram += sines.transpose() * sines;
  }
  const SymmetricEigen eigen(gram);
  const Quadrature in = WarpQuadrature(Nodes, 0.0);
  const Quadrature out = WarpQuadrature(Nodes, MinimumViewCosine);
  std::vector<AzimuthalBasis::Term> terms;
  for (Eigen::Index k = Nodes - 1; k >= 0; --k) // eigenvalues ascend
  {
    const Eigen::VectorXd right = eigen.Vectors.col(k);
    AzimuthalBasis::Term term;
    term.Order = order;
    term.Sigma = std::sqrt(std::max(eigen.Values[k], 0.0));
    const auto project = [&](const Eigen::MatrixXd& samples)
    {
      const Eigen::VectorXd left = samples * right;
      Eigen::MatrixXd views = Eigen::Map<const Eigen::MatrixXd>(left.data(), Nodes, Channels);
      for (int node = 0; node < Nodes; ++node)
      {
        views.row(node) /= std::sqrt(Sampler::GetWeight(out, node));
      }
      return views;
    };
    term.Cosine = project(cosines);
    if (withSine)
    {
      term.Sine = project(sines);
    }
    term.Incident = right;
    for (int node = 0; node < Nodes; ++node)
    {
      term.Incident[node] /= std::sqrt(Sampler::GetWeight(in, node));
    }
    terms.push_back(std::move(term));
  }
  return terms;
}
} // namespace

//------------------------------------------------------------------------------
bool AzimuthalBasis::Compute(
  vtkBRDF* brdf, double sineTolerance, const std::function<bool(double)>& progress)
{
  Series series;
  Sampler sampler(brdf, series);
  // In strides, so that this thread hears of an abort.
  constexpr int stride = 8;
  for (int first = 0; first < Nodes; first += stride)
  {
    measuredbrdf::ParallelFor(first, first + stride, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType out = begin; out < end; ++out)
        {
          sampler.Sample(static_cast<int>(out));
        }
      });
    if (!progress(0.7 * (first + stride) / Nodes))
    {
      return false;
    }
  }
  double cosineEnergy = 0.0;
  double sineEnergy = 0.0;
  double rest = 0.0;
  for (int out = 0; out < Nodes; ++out)
  {
    cosineEnergy += series.CosineEnergy[out];
    sineEnergy += series.SineEnergy[out];
    rest += series.Rest[out];
  }
  const double energy = cosineEnergy + sineEnergy + rest;
  const bool sine = sineEnergy > sineTolerance * sineTolerance * energy;
  rest += sine ? 0.0 : sineEnergy;

  std::vector<std::vector<Term>> byOrder(Orders);
  measuredbrdf::ParallelFor(0, Orders, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType m = begin; m < end; ++m)
      {
        byOrder[static_cast<std::size_t>(m)] = Decompose(series, static_cast<int>(m), sine);
      }
    });
  std::vector<Term> terms;
  for (std::vector<Term>& order : byOrder)
  {
    std::move(order.begin(), order.end(), std::back_inserter(terms));
  }
  std::stable_sort(
    terms.begin(), terms.end(), [](const Term& a, const Term& b) { return a.Sigma > b.Sigma; });

  this->Terms = std::move(terms);
  this->Energy = energy;
  this->SineShare = energy > 0.0 ? std::sqrt(sineEnergy / energy) : 0.0;
  // From the smallest up: sums of what is left out keep their digits.
  this->Discarded.assign(this->Terms.size() + 1, rest);
  for (std::size_t k = this->Terms.size(); k-- > 0;)
  {
    const Term& term = this->Terms[k];
    this->Discarded[k] =
      this->Discarded[k + 1] + term.GetNumberOfFunctions() * term.Sigma * term.Sigma;
  }
  return progress(1.0);
}

//------------------------------------------------------------------------------
int AzimuthalBasis::FindNumberOfTerms(double tolerance, int maximumNumberOfFunctions) const
{
  std::size_t count = 0;
  int functions = 0;
  while (
    count < this->Terms.size() && this->Discarded[count] > tolerance * tolerance * this->Energy)
  {
    functions += this->Terms[count].GetNumberOfFunctions();
    if (functions > maximumNumberOfFunctions)
    {
      break;
    }
    ++count;
  }
  return static_cast<int>(count);
}

//------------------------------------------------------------------------------
double AzimuthalBasis::GetTruncationError(int count) const
{
  return this->Energy > 0.0
           ? std::sqrt(this->Discarded[static_cast<std::size_t>(count)] / this->Energy)
           : 0.0;
}

//------------------------------------------------------------------------------
int AzimuthalBasis::GetNumberOfFunctions(int count) const
{
  int functions = 0;
  for (int k = 0; k < count; ++k)
  {
    functions += this->Terms[static_cast<std::size_t>(k)].GetNumberOfFunctions();
  }
  return functions;
}
} // namespace measuredbrdf
