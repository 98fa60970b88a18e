// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DistributionFit.h"

#include "HalfVector.h"
#include "Neighbours.h"
#include "NonNegativeLeastSquares.h"
#include "vtkBRDF.h"
#include "vtkSMPTools.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace measuredbrdf
{
namespace
{
using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

constexpr int StartSweeps = 3; // before the best start is chosen
constexpr int NumberOfFresnelStarts = 4;

// The changes of neighbouring cells are tied by this share of what the data say about the better
// known of them: cells that no sample touches move with their neighbours, and where the data are
// fitted nothing moves.
constexpr double Tie = 1e-3;

//------------------------------------------------------------------------------
// Where each sample lies in the tables, shared by the channels. Unknowns of p: the cells, then the
// Lambert part.
class Geometry
{
public:
  Geometry(const FitSamples& samples, const DistributionFitOptions& options)
    : NumberOfCells(options.NumberOfTheta * options.NumberOfPhi)
    , NumberOfNeighbours(options.NumberOfPhi > 1 ? 4 : 2)
  {
    for (const FitSample& sample : samples)
    {
      this->Places.push_back(this->FindPlace(sample, options));
    }
    this->FindTies(options);
    this->MakePattern();
  }

  struct Place
  {
    std::array<int, 5> Unknowns; // neighbours in p, then the Lambert part
    std::array<double, 4> Weights;
    Neighbours D;
    double Scale; // 1 / (4 (cos_i + cos_o - cos_i cos_o))
  };

  // Zeros at all pairs of unknowns that a sample or a tie links (lower triangle).
  Matrix NewMatrix() const { return this->Pattern; }
  // Where in the matrix' values a sample's pairs of unknowns stand.
  const int* GetPositions(std::size_t sample) const
  {
    return &this->Positions[sample * static_cast<std::size_t>(this->GetNumberOfPairs())];
  }
  int GetNumberOfPairs() const
  {
    return (this->NumberOfNeighbours + 1) * (this->NumberOfNeighbours + 2) / 2;
  }
  int FindPosition(int row, int column) const
  {
    const int* begin = this->Pattern.innerIndexPtr() + this->Pattern.outerIndexPtr()[column];
    const int* end = this->Pattern.innerIndexPtr() + this->Pattern.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(begin, end, row) - this->Pattern.innerIndexPtr());
  }

  int NumberOfCells;
  int NumberOfNeighbours;
  std::vector<Place> Places;
  std::vector<std::array<int, 2>> Ties; // neighbouring cells, the larger number first

private:
  Place FindPlace(const FitSample& sample, const DistributionFitOptions& options) const
  {
    const HalfDifference angles = ToHalfDifference(sample.I, sample.O);
    const glm::dvec3& h = sample.H;
    const Neighbours t = ClampedNeighbours(ThetaHToUnit(angles.ThetaH), options.NumberOfTheta);
    const Neighbours p = PeriodicNeighbours(std::atan2(h.y, h.x) / (2.0 * Pi), options.NumberOfPhi);
    Place place;
    place.D = ClampedNeighbours(angles.ThetaD * (2.0 / Pi), options.NumberOfFresnel);
    place.Scale = 0.25 / (sample.I.z + sample.O.z - sample.I.z * sample.O.z);
    place.Unknowns.fill(this->NumberOfCells);
    place.Weights.fill(0.0);
    for (int k = 0; k < this->NumberOfNeighbours; ++k)
    {
      const int phi = k < 2 ? p.First : p.Second;
      place.Unknowns[k] = phi * options.NumberOfTheta + (k % 2 == 0 ? t.First : t.Second);
      place.Weights[k] =
        (k % 2 == 0 ? 1.0 - t.Weight : t.Weight) *
        (this->NumberOfNeighbours == 2 ? 1.0 : (k < 2 ? 1.0 - p.Weight : p.Weight));
    }
    return place;
  }

  void FindTies(const DistributionFitOptions& options)
  {
    const int n = options.NumberOfTheta;
    for (int cell = 0; cell < this->NumberOfCells; ++cell)
    {
      const int beside = (cell + n) % this->NumberOfCells;
      if (cell % n + 1 < n)
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

  template <typename Use>
  void ForPairs(const Use& use) const
  {
    for (const Place& place : this->Places)
    {
      for (int a = 0; a <= this->NumberOfNeighbours; ++a)
      {
        for (int b = 0; b <= a; ++b)
        {
          const int first = this->GetUnknown(place, a), second = this->GetUnknown(place, b);
          use(std::max(first, second), std::min(first, second));
        }
      }
    }
  }

  int GetUnknown(const Place& place, int k) const
  {
    return k < this->NumberOfNeighbours ? place.Unknowns[k] : this->NumberOfCells;
  }

  Matrix Pattern;
  std::vector<int> Positions;
};

//------------------------------------------------------------------------------
// The columns that F is a non-negative sum of.
Eigen::MatrixXd NewFresnelBasis(FresnelShape shape, int n)
{
  if (shape == FresnelShape::Free)
  {
    return Eigen::MatrixXd::Identity(n, n);
  }
  if (shape == FresnelShape::Monotone)
  {
    return Eigen::MatrixXd::Ones(n, n).triangularView<Eigen::Lower>();
  }
  Eigen::MatrixXd basis = Eigen::MatrixXd::Ones(n, 2);
  for (int k = 0; k < n; ++k)
  {
    basis(k, 1) = SchlickFresnel(0.0, std::cos(0.5 * Pi * (k + 0.5) / n));
  }
  return basis;
}

//------------------------------------------------------------------------------
// One channel: f = Lambert + p F / (4 (...)). Both steps linearize T about the model as it is
// (Gauss-Newton), solve for one table and the Lambert part, and go as far as the mean square falls.
class Channel
{
public:
  Channel(const FitSamples& samples, const Geometry& geometry, const Eigen::MatrixXd& basis,
    bool tieFresnel, int channel)
    : Samples(samples)
    , Places(geometry)
    , Basis(basis)
    , TieFresnel(tieFresnel)
    , Index(channel)
  {
  }

  Vector Distribution;
  Vector Fresnel;
  double Lambert = 0.0; // albedo / pi

  double GetMeanSquare() const
  {
    return this->MeanSquare(this->Distribution, this->Fresnel, this->Lambert);
  }

  void Sweep()
  {
    this->SolveDistribution();
    this->SolveFresnel();
  }

private:
  double DistributionAt(const Geometry::Place& place, const Vector& p) const
  {
    double value = 0.0;
    for (int k = 0; k < this->Places.NumberOfNeighbours; ++k)
    {
      value += place.Weights[k] * p[place.Unknowns[k]];
    }
    return value;
  }

  static double FresnelAt(const Geometry::Place& place, const Vector& fresnel)
  {
    return glm::mix(fresnel[place.D.First], fresnel[place.D.Second], place.D.Weight);
  }

  double MeanSquare(const Vector& p, const Vector& fresnel, double lambert) const
  {
    const FitLoss& loss = this->Samples.GetLoss();
    double sum = 0.0;
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      const FitSample& sample = this->Samples[k];
      const Geometry::Place& place = this->Places.Places[k];
      const double f =
        lambert + this->DistributionAt(place, p) * FresnelAt(place, fresnel) * place.Scale;
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
    const int n = this->Places.NumberOfNeighbours;
    const int cells = this->Places.NumberOfCells;
    Matrix H = this->Places.NewMatrix();
    Vector g = Vector::Zero(cells + 1);
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      const Geometry::Place& place = this->Places.Places[k];
      const double factor = FresnelAt(place, this->Fresnel) * place.Scale;
      double weight, target;
      this->Linearize(this->Samples[k],
        this->Lambert + this->DistributionAt(place, this->Distribution) * factor, weight, target);
      double row[5];
      for (int a = 0; a < n; ++a)
      {
        row[a] = factor * place.Weights[a];
        g[place.Unknowns[a]] += weight * target * row[a];
      }
      row[n] = 1.0;
      g[cells] += weight * target;
      const int* position = this->Places.GetPositions(k);
      for (int a = 0; a <= n; ++a)
      {
        for (int b = 0; b <= a; ++b)
        {
          H.valuePtr()[*position++] += weight * row[a] * row[b];
        }
      }
    }
    const Vector known = H.diagonal();
    const double least = 1e-12 * known.mean();
    for (const auto& tie : this->Places.Ties)
    {
      const double strength = Tie * std::max({ known[tie[0]], known[tie[1]], least });
      const double pull = strength * (this->Distribution[tie[0]] - this->Distribution[tie[1]]);
      H.coeffRef(tie[0], tie[0]) += strength;
      H.coeffRef(tie[1], tie[1]) += strength;
      H.coeffRef(tie[0], tie[1]) -= strength;
      g[tie[0]] += pull;
      g[tie[1]] -= pull;
    }
    Vector x(cells + 1);
    x << this->Distribution, this->Lambert;
    SolveNonNegative(H, g, x);
    this->Search(x.head(cells), this->Fresnel, x[cells]);
  }

  void SolveFresnel()
  {
    const Eigen::Index n = this->Basis.rows();
    const Eigen::Index columns = this->Basis.cols();
    // Over the table's samples first (and the Lambert part last), then over the basis.
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + 1, n + 1);
    Vector m = Vector::Zero(n + 1);
    for (std::size_t k = 0; k < this->Samples.size(); ++k)
    {
      const Geometry::Place& place = this->Places.Places[k];
      const double factor = this->DistributionAt(place, this->Distribution) * place.Scale;
      double weight, target;
      this->Linearize(
        this->Samples[k], this->Lambert + FresnelAt(place, this->Fresnel) * factor, weight, target);
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
    const Vector known = M.diagonal();
    for (Eigen::Index k = 0; this->TieFresnel && k + 1 < n; ++k)
    {
      const double strength =
        Tie * std::max({ known[k], known[k + 1], 1e-12 * known.head(n).mean() });
      const double pull = strength * (this->Fresnel[k] - this->Fresnel[k + 1]);
      m[k] += pull;
      m[k + 1] -= pull;
      M(k, k) += strength;
      M(k + 1, k + 1) += strength;
      M(k, k + 1) -= strength;
      M(k + 1, k) -= strength;
    }
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n + 1, columns + 1);
    B.topLeftCorner(n, columns) = this->Basis;
    B(n, columns) = 1.0;
    const Eigen::MatrixXd H = B.transpose() * M * B;
    Vector x = Vector::Ones(columns + 1);
    SolveNonNegative(H.sparseView(), B.transpose() * m, x);
    this->Search(this->Distribution, this->Basis * x.head(columns), x[columns]);
  }

  // All the way to the solution, or half, ..., or nowhere: sums of valid tables are valid.
  void Search(const Vector& p, const Vector& fresnel, double lambert)
  {
    const double now = this->GetMeanSquare();
    for (double t = 1.0; t > 0.01; t *= 0.5)
    {
      const Vector newP = (1.0 - t) * this->Distribution + t * p;
      const Vector newFresnel = (1.0 - t) * this->Fresnel + t * fresnel;
      const double newLambert = (1.0 - t) * this->Lambert + t * lambert;
      if (this->MeanSquare(newP, newFresnel, newLambert) < now)
      {
        this->Distribution = newP;
        this->Fresnel = newFresnel;
        this->Lambert = newLambert;
        return;
      }
    }
  }

  const FitSamples& Samples;
  const Geometry& Places;
  const Eigen::MatrixXd& Basis;
  bool TieFresnel;
  int Index;
};

//------------------------------------------------------------------------------
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

// 4 (2 cos - cos^2): what f is divided by at i = o.
double RetroScale(double cosine) { return 4.0 * (2.0 * cosine - cosine * cosine); }

// p where F(0) = 1: exact at i = o = h (theory of the D-BRDF).
void GuessDistribution(vtkBRDF* input, const DistributionFitOptions& options, Channel* channels)
{
  for (int c = 0; c < 3; ++c)
  {
    channels[c].Distribution.resize(options.NumberOfTheta * options.NumberOfPhi);
  }
  for (int k = 0; k < options.NumberOfTheta * options.NumberOfPhi; ++k)
  {
    const double theta = UnitToThetaH((k % options.NumberOfTheta + 0.5) / options.NumberOfTheta);
    const double phi = 2.0 * Pi * (k / options.NumberOfTheta + 0.5) / options.NumberOfPhi;
    const double d[3] = { std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
      std::cos(theta) };
    double f[3];
    input->Evaluate(d, d, f);
    for (int c = 0; c < 3; ++c)
    {
      channels[c].Distribution[k] = std::max(f[c] - channels[c].Lambert, 0.0) * RetroScale(d[2]);
    }
  }
}

// F from the mirror direction, made to grow; with p(0) from the normal.
Vector GuessFresnel(vtkBRDF* input, const Channel& channel, int index, int n)
{
  const double up[3] = { 0.0, 0.0, 1.0 };
  double normal[3];
  input->Evaluate(up, up, normal);
  const double p0 = std::max(normal[index] - channel.Lambert, 0.0) * RetroScale(1.0);
  Vector fresnel = Vector::Ones(n);
  for (int k = 0; k < n && p0 > 0.0; ++k)
  {
    const double theta = 0.5 * Pi * (k + 0.5) / n;
    const double i[3] = { std::sin(theta), 0.0, std::cos(theta) };
    const double o[3] = { -i[0], 0.0, i[2] };
    double f[3];
    input->Evaluate(i, o, f);
    fresnel[k] = std::max(
      { (f[index] - channel.Lambert) * RetroScale(i[2]) / p0, k > 0 ? fresnel[k - 1] : 1e-3 });
  }
  return fresnel;
}

// The channel after some sweeps from the best of a few F: measured, constant, Schlick's.
void ChooseStart(vtkBRDF* input, const DistributionFitOptions& options, int index, Channel& channel)
{
  const double reflectances[NumberOfFresnelStarts] = { -1.0, 1.0, 0.04, 0.3 };
  const Vector p = channel.Distribution;
  const double lambert = channel.Lambert;
  Vector best[2];
  double bestLambert = 0.0, least = HUGE_VAL;
  for (int k = 0; k < std::min(options.NumberOfStarts, NumberOfFresnelStarts); ++k)
  {
    channel.Distribution = p;
    channel.Lambert = lambert;
    channel.Fresnel = Vector::Ones(options.NumberOfFresnel);
    if (reflectances[k] < 0.0 && options.Shape != FresnelShape::Schlick)
    {
      channel.Fresnel = GuessFresnel(input, channel, index, options.NumberOfFresnel);
    }
    for (int d = 0; d < options.NumberOfFresnel && reflectances[k] >= 0.0; ++d)
    {
      channel.Fresnel[d] =
        SchlickFresnel(reflectances[k], std::cos(0.5 * Pi * (d + 0.5) / options.NumberOfFresnel));
    }
    for (int sweep = 0; sweep < StartSweeps; ++sweep)
    {
      channel.Sweep();
    }
    const double mean = channel.GetMeanSquare();
    if (mean < least)
    {
      least = mean;
      best[0] = channel.Distribution;
      best[1] = channel.Fresnel;
      bestLambert = channel.Lambert;
    }
  }
  channel.Distribution = best[0];
  channel.Fresnel = best[1];
  channel.Lambert = bestLambert;
}

// Moves the scale from p to F so that the integral of p cos theta_h is 1.
void Normalize(const DistributionFitOptions& options, Channel& channel)
{
  const auto sine2 = [&options](int boundary)
  {
    const double s = std::sin(UnitToThetaH(static_cast<double>(boundary) / options.NumberOfTheta));
    return s * s;
  };
  double integral = 0.0;
  for (int k = 0; k < channel.Distribution.size(); ++k)
  {
    const int t = k % options.NumberOfTheta;
    integral += channel.Distribution[k] * Pi * (sine2(t + 1) - sine2(t)) / options.NumberOfPhi;
  }
  if (integral > 0.0)
  {
    channel.Distribution /= integral;
    channel.Fresnel *= integral;
  }
}

double SumMeanSquares(const std::vector<Channel>& channels)
{
  double sum = 0.0;
  for (const Channel& channel : channels)
  {
    sum += channel.GetMeanSquare();
  }
  return sum;
}
}

//------------------------------------------------------------------------------
DistributionFitResult FitDistribution(
  vtkBRDF* input, const FitSamples& samples, const DistributionFitOptions& options)
{
  constexpr double started = 0.3; // of the progress
  const Geometry geometry(samples, options);
  const Eigen::MatrixXd basis = NewFresnelBasis(options.Shape, options.NumberOfFresnel);
  std::vector<Channel> channels;
  for (int c = 0; c < 3; ++c)
  {
    channels.emplace_back(samples, geometry, basis, options.Shape != FresnelShape::Schlick, c);
    channels[c].Lambert = GuessLambert(samples, c);
  }
  GuessDistribution(input, options, channels.data());
  const auto forChannels = [&channels](const auto& use)
  {
    vtkSMPTools::For(0, 3, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType c = begin; c < end; ++c)
        {
          use(channels[static_cast<std::size_t>(c)], static_cast<int>(c));
        }
      });
  };
  forChannels([&](Channel& channel, int c) { ChooseStart(input, options, c, channel); });

  DistributionFitResult result;
  result.History.push_back(SumMeanSquares(channels));
  for (int k = 0; k < options.MaximumNumberOfIterations && !result.Converged; ++k)
  {
    if (!options.Progress(started + (1.0 - started) * k / options.MaximumNumberOfIterations))
    {
      return DistributionFitResult();
    }
    forChannels([](Channel& channel, int) { channel.Sweep(); });
    result.History.push_back(SumMeanSquares(channels));
    const double before = result.History[result.History.size() - 2];
    result.Converged = before - result.History.back() <= options.Tolerance * before;
  }

  for (int c = 0; c < 3; ++c)
  {
    Normalize(options, channels[c]);
    result.Albedo[c] = Pi * channels[c].Lambert;
  }
  for (Eigen::Index k = 0; k < channels[0].Distribution.size(); ++k)
  {
    for (const Channel& channel : channels)
    {
      result.Distribution.push_back(static_cast<float>(channel.Distribution[k]));
    }
  }
  for (Eigen::Index k = 0; k < channels[0].Fresnel.size(); ++k)
  {
    for (const Channel& channel : channels)
    {
      result.Fresnel.push_back(static_cast<float>(channel.Fresnel[k]));
    }
  }
  return result;
}
} // namespace measuredbrdf
