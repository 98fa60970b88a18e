// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDistributionBRDFFitter.h"

#include "FitSamples.h"
#include "FitterSamples.h"
#include "HalfVector.h"
#include "LinearLeastSquares.h"
#include "Neighbors.h"
#include "NumberText.h"
#include "ParallelFor.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSumBRDF.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <random>
#include <vector>

// Fits a Lambert part and the D-BRDF's two tables by alternating non-negative least squares.
namespace measuredbrdf
{
namespace
{
struct DistributionSize
{
  int NumberOfTheta;
  int NumberOfPhi; // 1: isotropic
  int NumberOfFresnel;
};

/// The positions of the samples in the tables, shared by the channels. The unknowns of p are its
/// cells (theta fastest), then the Lambert part.
class DistributionGeometry
{
public:
  DistributionGeometry(const FitSamples& samples, const DistributionSize& size)
    : NumberOfCells(size.NumberOfTheta * size.NumberOfPhi)
    , NumberOfNeighbors(size.NumberOfPhi > 1 ? 4 : 2)
  {
    for (const FitSample& sample : samples)
    {
      this->Places.push_back(this->FindPlace(sample, size));
    }
    this->FindTies(size.NumberOfTheta);
    this->MakePattern();
  }

  struct Place
  {
    std::array<int, 5> Unknowns; // neighbors in p, then the Lambert part
    std::array<double, 4> Weights;
    Neighbors D;  // in F
    double Scale; // 1 / (4 (cos_i + cos_o - cos_i cos_o))
  };

  /// Positions of a sample's unknowns (a, b), b <= a, in the pattern's values; b fastest.
  const int* GetPositions(std::size_t sample) const
  {
    const int pairs = (this->NumberOfNeighbors + 1) * (this->NumberOfNeighbors + 2) / 2;
    return &this->Positions[sample * pairs];
  }

  int NumberOfCells;
  int NumberOfNeighbors;                // of a sample in p: 2 or, anisotropic, 4
  std::vector<Place> Places;            // by sample
  std::vector<std::array<int, 2>> Ties; // neighboring cells, the larger number first
  Eigen::SparseMatrix<double> Pattern;  // zeros at all pairs that a sample or a tie links (lower)

private:
  Place FindPlace(const FitSample& sample, const DistributionSize& size) const
  {
    const HalfDifference angles = ToHalfDifference(sample.I, sample.O);
    const Neighbors t = ClampedNeighbors(ThetaHToUnit(angles.ThetaH), size.NumberOfTheta);
    const Neighbors p =
      PeriodicNeighbors(std::atan2(sample.H.y, sample.H.x) / (2.0 * Pi), size.NumberOfPhi);
    Place place;
    place.D = ClampedNeighbors(angles.ThetaD * (2.0 / Pi), size.NumberOfFresnel);
    place.Scale = 0.25 / (sample.I.z + sample.O.z - sample.I.z * sample.O.z);
    place.Unknowns.fill(this->NumberOfCells);
    place.Weights.fill(0.0);
    for (int k = 0; k < this->NumberOfNeighbors; ++k)
    {
      const bool second = k >= 2; // along phi
      const double share =
        this->NumberOfNeighbors == 2 ? 1.0 : (second ? p.Weight : 1.0 - p.Weight);
      place.Unknowns[k] =
        (second ? p.Second : p.First) * size.NumberOfTheta + (k % 2 == 0 ? t.First : t.Second);
      place.Weights[k] = share * (k % 2 == 0 ? 1.0 - t.Weight : t.Weight);
    }
    return place;
  }

  void FindTies(int nTheta)
  {
    for (int cell = 0; cell < this->NumberOfCells; ++cell)
    {
      const int beside = (cell + nTheta) % this->NumberOfCells;
      if (cell % nTheta + 1 < nTheta)
      {
        this->Ties.push_back({ cell + 1, cell });
      }
      if (beside != cell)
      {
        this->Ties.push_back({ std::max(cell, beside), std::min(cell, beside) });
      }
    }
  }

  void MakePattern()
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k <= this->NumberOfCells; ++k)
    {
      entries.emplace_back(k, k, 0.0);
    }
    for (const auto& tie : this->Ties)
    {
      entries.emplace_back(tie[0], tie[1], 0.0);
    }
    this->ForPairs([&entries](int row, int column) { entries.emplace_back(row, column, 0.0); });
    this->Pattern.resize(this->NumberOfCells + 1, this->NumberOfCells + 1);
    this->Pattern.setFromTriplets(entries.begin(), entries.end());
    this->ForPairs(
      [this](int row, int column) { this->Positions.push_back(this->FindPosition(row, column)); });
  }

  int FindPosition(int row, int column) const
  {
    const int* rows = this->Pattern.innerIndexPtr();
    const int* columns = this->Pattern.outerIndexPtr();
    return static_cast<int>(
      std::lower_bound(rows + columns[column], rows + columns[column + 1], row) - rows);
  }

  template <typename Use>
  void ForPairs(const Use& use) const
  {
    for (const Place& place : this->Places)
    {
      for (int a = 0; a <= this->NumberOfNeighbors; ++a)
      {
        for (int b = 0; b <= a; ++b)
        {
          use(std::max(place.Unknowns[a], place.Unknowns[b]),
            std::min(place.Unknowns[a], place.Unknowns[b]));
        }
      }
    }
  }

  std::vector<int> Positions;
};

/// f = Lambert + p F / (4 (cos_i + cos_o - cos_i cos_o)).
struct DistributionTables
{
  Eigen::VectorXd P;
  Eigen::VectorXd F;
  double Lambert = 0.0; // albedo / pi
};

// The changes of neighboring cells are tied by this share of what the data say about the better
// known of them: cells that no sample touches move with their neighbors, and where the data are
// fitted nothing moves.
constexpr double Tie = 1e-3;

double FresnelAt(const DistributionGeometry::Place& place, const Eigen::VectorXd& f)
{
  return (1.0 - place.D.Weight) * f[place.D.First] + place.D.Weight * f[place.D.Second];
}

/// One channel of a D-BRDF with a Lambert part, and the steps that fit it to the samples.
class DistributionChannel
{
public:
  /**
   * basis: F is a non-negative sum of its columns. tieFresnel: for tables, whose samples may lie
   * where there are no data. The arguments must outlive this object.
   */
  DistributionChannel(const FitSamples& samples, const DistributionGeometry& geometry,
    const Eigen::MatrixXd& basis, bool tieFresnel, int channel)
    : Samples(samples)
    , Geometry(geometry)
    , Basis(basis)
    , TieFresnel(tieFresnel)
    , Index(channel)
  {
  }

  DistributionTables Tables;

  /// This channel's part of the weighted mean square over RGB.
  double GetMeanSquare() const { return this->MeanSquare(this->Tables); }

  /**
   * Improve p, then F, each with the Lambert part: linearize T about the current model
   * (Gauss-Newton), solve by non-negative least squares, and choose a step length that lowers the
   * mean square.
   */
  void Sweep()
  {
    this->SolveDistribution();
    this->SolveFresnel();
  }

private:
  double DistributionAt(const DistributionGeometry::Place& place, const Eigen::VectorXd& p) const
  {
    double value = 0.0;
    for (int k = 0; k < this->Geometry.NumberOfNeighbors; ++k)
    {
      value += place.Weights[k] * p[place.Unknowns[k]];
    }
    return value;
  }

  double MeanSquare(const DistributionTables& tables) const
  {
    const FitLoss& loss = this->Samples.GetLoss();
    double sum = 0.0;
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      const FitSample& sample = this->Samples[k];
      const DistributionGeometry::Place& place = this->Geometry.Places[k];
      const double f = tables.Lambert + this->DistributionAt(place, tables.P) *
                                          FresnelAt(place, tables.F) * place.Scale;
      const double t = loss.Value(f, sample.I.z) - loss.Value(sample.F[this->Index], sample.I.z);
      sum += sample.Weight * t * t / 3.0;
    }
    return sum;
  }

  // Weight and right-hand side of the linearized least squares at a sample.
  void Linearize(const FitSample& sample, double f, double& weight, double& target) const
  {
    const FitLoss& loss = this->Samples.GetLoss();
    const double slope = loss.Slope(f, sample.I.z);
    const double t = loss.Value(sample.F[this->Index], sample.I.z) - loss.Value(f, sample.I.z);
    weight = sample.Weight * slope * slope;
    target = f + t / slope;
  }

  void SolveDistribution()
  {
    const int n = this->Geometry.NumberOfNeighbors;
    const int cells = this->Geometry.NumberOfCells;
    const DistributionTables& now = this->Tables;
    Eigen::SparseMatrix<double> H = this->Geometry.Pattern;
    Eigen::VectorXd g = Eigen::VectorXd::Zero(cells + 1);
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      const DistributionGeometry::Place& place = this->Geometry.Places[k];
      const double factor = FresnelAt(place, now.F) * place.Scale;
      double weight, target;
      this->Linearize(this->Samples[k], now.Lambert + this->DistributionAt(place, now.P) * factor,
        weight, target);
      double row[5];
      for (int a = 0; a <= n; ++a)
      {
        row[a] = a < n ? factor * place.Weights[a] : 1.0;
        g[place.Unknowns[a]] += weight * target * row[a];
      }
      const int* position = this->Geometry.GetPositions(k);
      for (int a = 0; a <= n; ++a)
      {
        for (int b = 0; b <= a; ++b)
        {
          H.valuePtr()[*position++] += weight * row[a] * row[b];
        }
      }
    }
    const Eigen::VectorXd known = H.diagonal();
    const double least = 1e-12 * known.mean();
    for (const auto& tie : this->Geometry.Ties)
    {
      const double strength = Tie * std::max({ known[tie[0]], known[tie[1]], least });
      const double pull = strength * (now.P[tie[0]] - now.P[tie[1]]);
      H.coeffRef(tie[0], tie[0]) += strength;
      H.coeffRef(tie[1], tie[1]) += strength;
      H.coeffRef(tie[0], tie[1]) -= strength;
      g[tie[0]] += pull;
      g[tie[1]] -= pull;
    }
    Eigen::VectorXd x(cells + 1);
    x << now.P, now.Lambert;
    SolveNonNegative(H, g, x);
    this->Search({ x.head(cells), now.F, x[cells] });
  }

  void SolveFresnel()
  {
    const Eigen::Index n = this->Basis.rows();
    const Eigen::Index columns = this->Basis.cols();
    const DistributionTables& now = this->Tables;
    // Over the table's samples first (and the Lambert part last), then over the basis.
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + 1, n + 1);
    Eigen::VectorXd m = Eigen::VectorXd::Zero(n + 1);
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      const DistributionGeometry::Place& place = this->Geometry.Places[k];
      const double factor = this->DistributionAt(place, now.P) * place.Scale;
      double weight, target;
      this->Linearize(
        this->Samples[k], now.Lambert + FresnelAt(place, now.F) * factor, weight, target);
      const Eigen::Index unknowns[3] = { place.D.First, place.D.Second, n };
      const double row[3] = { factor * (1.0 - place.D.Weight), factor * place.D.Weight, 1.0 };
      for (int a = 0; a < 3; ++a)
      {
        m[unknowns[a]] += weight * target * row[a];
        for (int b = 0; b < 3; ++b)
        {
          M(unknowns[a], unknowns[b]) += weight * row[a] * row[b];
        }
      }
    }
    const Eigen::VectorXd known = M.diagonal();
    const double least = 1e-12 * known.head(n).mean();
    for (Eigen::Index k = 0; this->TieFresnel && k + 1 < n; ++k)
    {
      const double strength = Tie * std::max({ known[k], known[k + 1], least });
      const double pull = strength * (now.F[k] - now.F[k + 1]);
      M(k, k) += strength;
      M(k + 1, k + 1) += strength;
      M(k, k + 1) -= strength;
      M(k + 1, k) -= strength;
      m[k] += pull;
      m[k + 1] -= pull;
    }
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n + 1, columns + 1);
    B.topLeftCorner(n, columns) = this->Basis;
    B(n, columns) = 1.0;
    const Eigen::MatrixXd H = B.transpose() * M * B;
    Eigen::VectorXd x = Eigen::VectorXd::Ones(columns + 1);
    SolveNonNegative(H.sparseView(), B.transpose() * m, x);
    this->Search({ now.P, this->Basis * x.head(columns), x[columns] });
  }

  // All the way to the goal, or half, ..., or nowhere: means of valid tables are valid.
  void Search(const DistributionTables& goal)
  {
    const DistributionTables from = this->Tables;
    const double now = this->MeanSquare(from);
    for (double t = 1.0; t > 0.01; t *= 0.5)
    {
      const DistributionTables next = { (1.0 - t) * from.P + t * goal.P,
        (1.0 - t) * from.F + t * goal.F, (1.0 - t) * from.Lambert + t * goal.Lambert };
      if (this->MeanSquare(next) < now)
      {
        this->Tables = next;
        return;
      }
    }
  }

  const FitSamples& Samples;
  const DistributionGeometry& Geometry;
  const Eigen::MatrixXd& Basis;
  bool TieFresnel;
  int Index;
};

using Vector = Eigen::VectorXd;
using Channels = std::vector<DistributionChannel>;

constexpr int StartSweeps = 3; // before the best start is chosen

// F to start from: negative: measured in the mirror direction; else Schlick's of that reflectance.
constexpr double StartReflectances[] = { -1.0, 1.0, 0.04, 0.3 };

Vector SchlickTable(double f0, int n)
{
  Vector table(n);
  for (int k = 0; k < n; ++k)
  {
    table[k] = SchlickFresnel(f0, std::cos(0.5 * Pi * (k + 0.5) / n));
  }
  return table;
}

// The columns that F is a non-negative sum of. model: a
// vtkDistributionBRDFFitter::FresnelModelType.
Eigen::MatrixXd NewFresnelBasis(int model, int n)
{
  if (model == vtkDistributionBRDFFitter::FREE)
  {
    return Eigen::MatrixXd::Identity(n, n);
  }
  if (model == vtkDistributionBRDFFitter::MONOTONE)
  {
    return Eigen::MatrixXd::Ones(n, n).triangularView<Eigen::Lower>();
  }
  Eigen::MatrixXd basis(n, 2);
  basis << Vector::Ones(n), SchlickTable(0.0, n);
  return basis;
}

// The 1st percentile of what is seen and lit within 60 degrees of the normal: f_min, but for noise.
double GuessLambert(const FitSamples& samples, int channel)
{
  std::vector<double> values;
  for (const FitSample& sample : samples)
  {
    if (sample.I.z >= 0.5 && sample.O.z >= 0.5)
    {
      values.push_back(sample.F[channel]);
    }
  }
  if (values.empty())
  {
    return 0.0;
  }
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 100);
  std::nth_element(values.begin(), low, values.end());
  return *low;
}

// 4 (2 cos - cos^2): f times this is p F at i = o and in the mirror direction.
double GetScale(double cosine) { return 4.0 * (2.0 * cosine - cosine * cosine); }

// p where F(0) = 1: exact at i = o = h (theory of the D-BRDF).
void GuessDistribution(vtkBRDF* input, const DistributionSize& size, Channels& channels)
{
  const int cells = size.NumberOfTheta * size.NumberOfPhi;
  for (DistributionChannel& channel : channels)
  {
    channel.Tables.P.resize(cells);
  }
  for (int k = 0; k < cells; ++k)
  {
    const double theta = UnitToThetaH((k % size.NumberOfTheta + 0.5) / size.NumberOfTheta);
    const double phi = 2.0 * Pi * (k / size.NumberOfTheta + 0.5) / size.NumberOfPhi;
    const double d[3] = { std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
      std::cos(theta) };
    double f[3];
    input->Evaluate(d, d, f);
    for (std::size_t c = 0; c < 3; ++c)
    {
      DistributionTables& tables = channels[c].Tables;
      tables.P[k] = std::max(f[c] - tables.Lambert, 0.0) * GetScale(d[2]);
    }
  }
}

// F from the mirror direction over p(0) from the normal, made to grow.
Vector GuessFresnel(vtkBRDF* input, double lambert, int channel, int n)
{
  const double up[3] = { 0.0, 0.0, 1.0 };
  double f[3];
  input->Evaluate(up, up, f);
  const double p0 = std::max(f[channel] - lambert, 0.0) * GetScale(1.0);
  Vector fresnel = Vector::Ones(n);
  for (int k = 0; k < n && p0 > 0.0; ++k)
  {
    const double theta = 0.5 * Pi * (k + 0.5) / n;
    const double i[3] = { std::sin(theta), 0.0, std::cos(theta) };
    const double o[3] = { -i[0], 0.0, i[2] };
    input->Evaluate(i, o, f);
    fresnel[k] =
      std::max((f[channel] - lambert) * GetScale(i[2]) / p0, k > 0 ? fresnel[k - 1] : 1e-3);
  }
  return fresnel;
}

// A channel's start: what it became, and its mean squares on the way.
struct Attempt
{
  DistributionTables Tables;
  std::array<double, StartSweeps + 1> History;
};

// The channel after some sweeps from an F.
Attempt Try(DistributionChannel channel, const Vector& fresnel)
{
  Attempt attempt;
  channel.Tables.F = fresnel;
  attempt.History[0] = channel.GetMeanSquare();
  for (int sweep = 0; sweep < StartSweeps; ++sweep)
  {
    channel.Sweep();
    attempt.History[sweep + 1] = channel.GetMeanSquare();
  }
  attempt.Tables = channel.Tables;
  return attempt;
}

// use(c) for the three channels, in threads.
template <typename Use>
void ForChannels(const Use& use)
{
  measuredbrdf::ParallelFor(0, 3, 1,
    [&use](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType c = begin; c < end; ++c)
      {
        use(static_cast<std::size_t>(c));
      }
    });
}

// A random start: of the Lambert part a share, F as Schlick's of some reflectance, p tilted.
Attempt TryRandom(DistributionChannel channel, int thetas, int fresnels, std::mt19937& generator)
{
  const auto draw = [&generator]() { return generator() / 4294967296.0; };
  channel.Tables.Lambert *= draw();
  const double reflectance = std::pow(10.0, -2.0 * draw());
  const double tilt = 4.0 * draw() - 2.0;
  for (Eigen::Index k = 0; k < channel.Tables.P.size(); ++k)
  {
    channel.Tables.P[k] *= std::exp(tilt * static_cast<double>(k % thetas) / thetas);
  }
  return Try(channel, SchlickTable(reflectance, fresnels));
}

// Each channel continues from its best start. The history of their sum; empty: stopped.
std::vector<double> ChooseStarts(vtkDistributionBRDFFitter* fitter, const DistributionSize& size,
  Channels& channels, const std::function<bool(double)>& progress)
{
  const int n = size.NumberOfFresnel;
  const unsigned int seed = fitter->GetStartSeed();
  const int starts = seed > 0 ? fitter->GetNumberOfStarts()
                              : std::min(fitter->GetNumberOfStarts(),
                                  static_cast<int>(std::size(StartReflectances)));
  std::array<Attempt, 3> best;
  for (int k = 0; k < starts; ++k)
  {
    if (!progress(static_cast<double>(k) / starts))
    {
      return {};
    }
    ForChannels(
      [&](std::size_t c)
      {
        Attempt attempt;
        if (seed > 0)
        {
          std::mt19937 generator(seed + 7919u * static_cast<unsigned int>(3 * k + c));
          attempt = TryRandom(channels[c], size.NumberOfTheta, n, generator);
        }
        else
        {
          const bool measured = StartReflectances[k] < 0.0 &&
                                fitter->GetFresnelModel() != vtkDistributionBRDFFitter::SCHLICK;
          const int channel = static_cast<int>(c);
          attempt = Try(channels[c],
            measured ? GuessFresnel(fitter->GetInput(), channels[c].Tables.Lambert, channel, n)
                     : SchlickTable(std::abs(StartReflectances[k]), n));
        }
        if (k == 0 || attempt.History.back() < best[c].History.back())
        {
          best[c] = attempt;
        }
      });
  }
  std::vector<double> history(StartSweeps + 1, 0.0);
  for (std::size_t c = 0; c < 3; ++c)
  {
    channels[c].Tables = best[c].Tables;
    std::transform(history.begin(), history.end(), best[c].History.begin(), history.begin(),
      std::plus<double>());
  }
  return history;
}

// Moves the scale from p to F so that the integral of p cos theta_h is 1.
void Normalize(const DistributionSize& size, DistributionTables& tables)
{
  const auto sine2 = [&size](int boundary)
  {
    const double s = std::sin(UnitToThetaH(static_cast<double>(boundary) / size.NumberOfTheta));
    return s * s;
  };
  double integral = 0.0;
  for (int k = 0; k < tables.P.size(); ++k)
  {
    const int t = k % size.NumberOfTheta;
    integral += tables.P[k] * Pi * (sine2(t + 1) - sine2(t)) / size.NumberOfPhi;
  }
  if (integral > 0.0)
  {
    tables.P /= integral;
    tables.F *= integral;
  }
}

// The channels' tables as one of RGB triples.
std::vector<float> Interleave(const Channels& channels, Vector DistributionTables::*table)
{
  std::vector<float> rgb;
  for (Eigen::Index k = 0; k < (channels[0].Tables.*table).size(); ++k)
  {
    for (const DistributionChannel& channel : channels)
    {
      rgb.push_back(static_cast<float>((channel.Tables.*table)[k]));
    }
  }
  return rgb;
}
}
} // namespace measuredbrdf

using namespace measuredbrdf;

vtkStandardNewMacro(vtkDistributionBRDFFitter);

//------------------------------------------------------------------------------
void vtkDistributionBRDFFitter::SetNumberOfThetaSamples(int numberOfThetaSamples)
{
  if (numberOfThetaSamples != 0 && (numberOfThetaSamples < 2 || numberOfThetaSamples > 4096))
  {
    measuredbrdfRefuseMacro(
      NumberOfThetaSamples, numberOfThetaSamples, "0 or a number from 2 to 4096");
    return;
  }
  measuredbrdfAssignMacro(NumberOfThetaSamples, numberOfThetaSamples);
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkDistributionBRDFFitter, FresnelModel, int, MONOTONE, SCHLICK);
measuredbrdfSetInRangeMacro(vtkDistributionBRDFFitter, NumberOfPhiSamples, int, 0, 1024);
measuredbrdfSetInRangeMacro(vtkDistributionBRDFFitter, NumberOfFresnelSamples, int, 2, 1024);

//------------------------------------------------------------------------------
void vtkDistributionBRDFFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FresnelModel: " << this->FresnelModel << "\n";
  os << indent << "NumberOfThetaSamples: " << this->NumberOfThetaSamples << "\n";
  os << indent << "NumberOfPhiSamples: " << this->NumberOfPhiSamples << "\n";
  os << indent << "NumberOfFresnelSamples: " << this->NumberOfFresnelSamples << "\n";
}

//------------------------------------------------------------------------------
std::string vtkDistributionBRDFFitter::CheckOptions()
{
  int nTheta = 0;
  int nPhi = 0;
  this->GetSize(nTheta, nPhi);
  return nTheta * nPhi <= MaximumNumberOfCells
           ? std::string()
           : "cells of p (NumberOfThetaSamples x NumberOfPhiSamples): expected at most " +
               std::to_string(static_cast<int>(MaximumNumberOfCells)) + ", got " +
               std::to_string(nTheta * nPhi);
}

//------------------------------------------------------------------------------
void vtkDistributionBRDFFitter::GetSize(int& nTheta, int& nPhi)
{
  nPhi =
    this->NumberOfPhiSamples > 0 ? this->NumberOfPhiSamples : (this->Input->IsIsotropic() ? 1 : 32);
  nTheta = this->NumberOfThetaSamples > 0 ? this->NumberOfThetaSamples : (nPhi > 1 ? 48 : 128);
}

//------------------------------------------------------------------------------
vtkBRDFFitter::Result vtkDistributionBRDFFitter::FitTo(const std::vector<Sample>& samples)
{
  constexpr double started = 0.3; // of the progress
  DistributionSize size = { 0, 0, this->NumberOfFresnelSamples };
  this->GetSize(size.NumberOfTheta, size.NumberOfPhi);
  const FitSamples own = ToFitSamples(samples, this->Loss);
  const DistributionGeometry geometry(own, size);
  const Eigen::MatrixXd basis = NewFresnelBasis(this->FresnelModel, size.NumberOfFresnel);
  Channels channels;
  for (int c = 0; c < 3; ++c)
  {
    channels.emplace_back(own, geometry, basis, this->FresnelModel != SCHLICK, c);
    channels.back().Tables.Lambert = GuessLambert(own, c);
  }
  GuessDistribution(this->Input, size, channels);

  Result result;
  result.History = ChooseStarts(
    this, size, channels, [this](double share) { return this->UpdateProgress(started * share); });
  const int most = this->MaximumNumberOfIterations;
  for (int k = 0; k < most && !result.History.empty() && !result.Converged; ++k)
  {
    if (!this->UpdateProgress(started + (1.0 - started) * k / most))
    {
      return Result();
    }
    ForChannels([&channels](std::size_t c) { channels[c].Sweep(); });
    double sum = 0.0;
    for (const DistributionChannel& channel : channels)
    {
      sum += channel.GetMeanSquare();
    }
    const double before = result.History.back();
    result.Converged = before - sum <= this->Tolerance * before;
    result.History.push_back(sum);
  }
  if (result.History.empty())
  {
    return result;
  }
  double albedo[3];
  for (std::size_t c = 0; c < 3; ++c)
  {
    Normalize(size, channels[c].Tables);
    albedo[c] = Pi * channels[c].Tables.Lambert;
  }
  const std::vector<float> p = Interleave(channels, &DistributionTables::P);
  const std::vector<float> fresnel = Interleave(channels, &DistributionTables::F);
  vtkNew<vtkDistributionBRDF> distribution;
  if (!distribution->SetDistribution(size.NumberOfTheta, size.NumberOfPhi, p) ||
      !distribution->SetFresnel(size.NumberOfFresnel, fresnel))
  {
    return Result();
  }
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(albedo);
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  sum->AddTerm(distribution);

  TextStream report;
  const auto add = [&report](const char* before, const auto* rgb, const char* after)
  { report << before << rgb[0] << " " << rgb[1] << " " << rgb[2] << after; };
  add("diffuse albedo: ", albedo, "\n");
  report << "p: " << size.NumberOfTheta << " x " << size.NumberOfPhi << " samples";
  add(", at the normal ", p.data(), " 1/sr\n");
  report << "F: " << size.NumberOfFresnel << " samples";
  add(", from ", fresnel.data(), "");
  add(" to ", &fresnel[fresnel.size() - 3], " at grazing\n");
  result.BRDF = sum;
  result.Report = report.str();
  return result;
}
