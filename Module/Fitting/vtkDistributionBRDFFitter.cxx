// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDistributionBRDFFitter.h"

#include "HalfVector.h"
#include "LinearLeastSquares.h"
#include "LocalFrame.h"
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
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

// The model of a channel at a sample is f = Lambert + p F / (4 (cos_i + cos_o - cos_i cos_o)). p
// and F are interpolated in tables, so f is linear in either of them, together with the Lambert
// part: alternating least squares.
namespace measuredbrdf
{
namespace
{
using Vector = Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Tie = std::array<int, 2>;

constexpr int NumberOfFresnel = 32; // samples of F
constexpr int StartSweeps = 3;      // before the best start is chosen

// F to start from: negative: measured in the mirror direction; else Schlick's of that reflectance.
constexpr double StartReflectances[] = { -1.0, 1.0, 0.04, 0.3 };

// The changes of neighboring cells are tied by this share of what the data say about the better
// known of them: cells that no sample touches move with their neighbors, and where the data are
// fitted nothing moves.
constexpr double TieStrength = 1e-3;

/// One of the model's tables, for all channels.
struct Table
{
  /// A row for each sample: the weights of the table's cells, then 1 for the Lambert part.
  SparseRows Interpolation;
  /// The table is a non-negative sum of the columns but the last, which is the Lambert part's.
  Sparse Basis;
  std::vector<Tie> Ties; // neighboring cells

  Table(int samples, const std::vector<Eigen::Triplet<double>>& entries, const Sparse& basis)
    : Interpolation(samples, basis.rows())
    , Basis(basis)
  {
    std::vector<Eigen::Triplet<double>> all = entries;
    for (int k = 0; k < samples; ++k)
    {
      all.emplace_back(k, static_cast<int>(basis.rows()) - 1, 1.0);
    }
    this->Interpolation.setFromTriplets(all.begin(), all.end());
  }

  Eigen::ArrayXd At(const Vector& cells) const
  {
    Vector padded = Vector::Zero(cells.size() + 1);
    padded.head(cells.size()) = cells;
    return (this->Interpolation * padded).array();
  }
};

Vector SchlickTable(double f0)
{
  Vector table(NumberOfFresnel);
  for (int k = 0; k < NumberOfFresnel; ++k)
  {
    table[k] = SchlickFresnel(f0, std::cos(0.5 * Pi * (k + 0.5) / NumberOfFresnel));
  }
  return table;
}

// Cells of p: theta fastest.
Table MakeDistribution(const vtkBRDFFitter::Samples& samples, int thetas, int phis)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < samples.size(); ++k)
  {
    const glm::dvec3 h = HalfVector(glm::make_vec3(samples[k].I), glm::make_vec3(samples[k].O));
    const double theta = std::atan2(std::hypot(h.x, h.y), h.z);
    const Neighbors t = ClampedNeighbors(ThetaHToUnit(theta), thetas);
    const Neighbors p = PeriodicNeighbors(std::atan2(h.y, h.x) / (2.0 * Pi), phis);
    const auto row = static_cast<int>(k);
    for (const auto& [phi, share] : { std::pair(p.First, 1.0 - p.Weight), { p.Second, p.Weight } })
    {
      entries.emplace_back(row, phi * thetas + t.First, share * (1.0 - t.Weight));
      entries.emplace_back(row, phi * thetas + t.Second, share * t.Weight);
    }
  }
  const int cells = thetas * phis;
  Sparse basis(cells + 1, cells + 1);
  basis.setIdentity();
  Table table(static_cast<int>(samples.size()), entries, basis);
  for (int cell = 0; cell < cells; ++cell)
  {
    const int beside = (cell + thetas) % cells;
    if (cell % thetas + 1 < thetas)
    {
      table.Ties.push_back({ cell, cell + 1 });
    }
    if (beside != cell)
    {
      table.Ties.push_back({ cell, beside });
    }
  }
  return table;
}

// F, a sum of steps, so that it never falls towards grazing.
Table MakeFresnel(const vtkBRDFFitter::Samples& samples)
{
  constexpr int n = NumberOfFresnel;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < samples.size(); ++k)
  {
    const HalfDifference angles =
      ToHalfDifference(glm::make_vec3(samples[k].I), glm::make_vec3(samples[k].O));
    const Neighbors d = ClampedNeighbors(angles.ThetaD * (2.0 / Pi), n);
    entries.emplace_back(static_cast<int>(k), d.First, 1.0 - d.Weight);
    entries.emplace_back(static_cast<int>(k), d.Second, d.Weight);
  }
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n + 1, n + 1);
  basis.topLeftCorner(n, n).triangularView<Eigen::Lower>().setOnes();
  basis(n, n) = 1.0;
  Table table(static_cast<int>(samples.size()), entries, basis.sparseView());
  for (int k = 0; k + 1 < n; ++k)
  {
    table.Ties.push_back({ k, k + 1 });
  }
  return table;
}

/// What is the same for all channels.
struct Problem
{
  const vtkBRDFFitter::Samples& Samples;
  const vtkBRDFFitter& Fitter;
  Table Distribution;
  Table Fresnel;
  Eigen::ArrayXd Scale; // 1 / (4 (cos_i + cos_o - cos_i cos_o)) of each sample
};

/// One channel's tables, and the steps that fit them to the samples.
class Channel
{
public:
  Vector P;
  Vector F;
  double Lambert = 0.0;        // albedo / pi
  std::vector<double> History; // this channel's part of the weighted mean square over RGB

  Channel(const Problem& problem, int index)
    : Data(&problem)
    , Index(index)
  {
  }

  /// From here on the history counts.
  void Start(const Vector& fresnel)
  {
    this->F = fresnel;
    this->MeanSquare = this->GetMeanSquare();
    this->History = { this->MeanSquare };
  }

  /// Improve p, then F, each with the Lambert part.
  void Sweep()
  {
    const Problem& data = *this->Data;
    this->Improve(data.Distribution, &Channel::P, data.Fresnel.At(this->F) * data.Scale, true);
    this->Improve(data.Fresnel, &Channel::F, data.Distribution.At(this->P) * data.Scale, false);
    this->History.push_back(this->MeanSquare);
  }

private:
  double GetMeanSquare() const
  {
    const Problem& data = *this->Data;
    const Eigen::ArrayXd f =
      this->Lambert + data.Distribution.At(this->P) * data.Fresnel.At(this->F) * data.Scale;
    double sum = 0.0;
    for (std::size_t k = 0; k < data.Samples.size(); ++k)
    {
      const vtkBRDFFitter::Sample& sample = data.Samples[k];
      const double t = data.Fitter.GetLossValue(f[static_cast<Eigen::Index>(k)], sample.I[2]) -
                       data.Fitter.GetLossValue(sample.F[this->Index], sample.I[2]);
      sum += sample.Weight * t * t / 3.0;
    }
    return sum;
  }

  // Linearizes T about the current model (Gauss-Newton), solves for the table and the Lambert part,
  // and goes towards the solution as far as that lowers the mean square. factor: of the table in f.
  // warm: the solution will be positive where the table is; else perhaps everywhere.
  void Improve(const Table& table, Vector Channel::*values, const Eigen::ArrayXd& factor, bool warm)
  {
    const Problem& data = *this->Data;
    const Eigen::Index cells = (this->*values).size();
    Vector now(cells + 1);
    now << this->*values, this->Lambert;
    SparseRows rows = table.Interpolation; // f = rows * now
    Vector weights(factor.size()), targets(factor.size());
    for (Eigen::Index k = 0; k < factor.size(); ++k)
    {
      double f = 0.0;
      for (SparseRows::InnerIterator it(rows, k); it; ++it)
      {
        it.valueRef() *= it.col() < cells ? factor[k] : 1.0; // the last one is the Lambert part's
        f += it.value() * now[it.col()];
      }
      const vtkBRDFFitter::Sample& sample = data.Samples[static_cast<std::size_t>(k)];
      const double slope = data.Fitter.GetLossSlope(f, sample.I[2]);
      const double t = data.Fitter.GetLossValue(sample.F[this->Index], sample.I[2]) -
                       data.Fitter.GetLossValue(f, sample.I[2]);
      weights[k] = sample.Weight * slope * slope;
      targets[k] = f + t / slope;
    }
    const SparseRows weighted = weights.asDiagonal() * rows;
    Sparse H = rows.transpose() * weighted;
    Vector g = weighted.transpose() * targets;
    const Vector known = H.diagonal();
    const double least = 1e-12 * known.head(cells).mean();
    std::vector<Eigen::Triplet<double>> pulls;
    for (const auto& [a, b] : table.Ties)
    {
      const double strength = TieStrength * std::max({ known[a], known[b], least });
      const double pull = strength * (now[a] - now[b]);
      for (const auto& [row, column, sign] :
        { std::tuple(a, a, 1.0), { b, b, 1.0 }, { a, b, -1.0 }, { b, a, -1.0 } })
      {
        pulls.emplace_back(row, column, sign * strength);
      }
      g[a] += pull;
      g[b] -= pull;
    }
    Sparse ties(cells + 1, cells + 1);
    ties.setFromTriplets(pulls.begin(), pulls.end());
    H += ties;
    Vector x = warm ? now : Vector::Ones(table.Basis.cols());
    SolveNonNegative(table.Basis.transpose() * H * table.Basis, table.Basis.transpose() * g, x);

    // All the way to the goal, or half, ..., or nowhere: means of valid tables are valid.
    const Vector goal = table.Basis * x;
    const Channel from = *this;
    for (double t = 1.0; t > 0.01; t *= 0.5)
    {
      this->*values = (1.0 - t) * from.*values + t * goal.head(cells);
      this->Lambert = (1.0 - t) * from.Lambert + t * goal[cells];
      const double next = this->GetMeanSquare();
      if (next < this->MeanSquare)
      {
        this->MeanSquare = next;
        return;
      }
    }
    this->*values = from.*values;
    this->Lambert = from.Lambert;
  }

  const Problem* Data;
  int Index;
  double MeanSquare = 0.0; // of the tables as they are
};

// The 1st percentile of what is seen and lit within 60 degrees of the normal: f_min, but for noise.
double GuessLambert(const vtkBRDFFitter::Samples& samples, int channel)
{
  std::vector<double> values;
  for (const vtkBRDFFitter::Sample& sample : samples)
  {
    if (sample.I[2] >= 0.5 && sample.O[2] >= 0.5)
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

// p F of a channel without its Lambert part: i = o, or in the mirror direction.
double GetProduct(
  vtkBRDF* input, const glm::dvec3& i, const glm::dvec3& o, double lambert, int channel)
{
  double f[3];
  input->Evaluate(&i.x, &o.x, f);
  return std::max(f[channel] - lambert, 0.0) * 4.0 * (2.0 * i.z - i.z * i.z);
}

// p where F(0) = 1: exact at i = o = h (theory of the D-BRDF).
Vector GuessDistribution(vtkBRDF* input, int thetas, int phis, double lambert, int channel)
{
  Vector p(thetas * phis);
  for (int k = 0; k < thetas * phis; ++k)
  {
    const double theta = UnitToThetaH((k % thetas + 0.5) / thetas);
    const double phi = 2.0 * Pi * (k / thetas + 0.5) / phis;
    const glm::dvec3 d = ToDirection(std::cos(theta), phi);
    p[k] = GetProduct(input, d, d, lambert, channel);
  }
  return p;
}

// F from the mirror direction over p(0) from the normal, made to grow.
Vector GuessFresnel(vtkBRDF* input, double lambert, int channel)
{
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const double p0 = GetProduct(input, up, up, lambert, channel);
  Vector fresnel = Vector::Ones(NumberOfFresnel);
  for (int k = 0; k < NumberOfFresnel && p0 > 0.0; ++k)
  {
    const double theta = 0.5 * Pi * (k + 0.5) / NumberOfFresnel;
    const glm::dvec3 i(std::sin(theta), 0.0, std::cos(theta));
    const double measured = GetProduct(input, i, { -i.x, 0.0, i.z }, lambert, channel) / p0;
    fresnel[k] = std::max(measured, k > 0 ? fresnel[k - 1] : 1e-3);
  }
  return fresnel;
}

// Moves the scale from p to F so that the integral of p cos theta_h is 1.
void Normalize(Channel& channel, int thetas, int phis)
{
  double integral = 0.0;
  for (int k = 0; k < channel.P.size(); ++k)
  {
    const double low = std::sin(UnitToThetaH(static_cast<double>(k % thetas) / thetas));
    const double high = std::sin(UnitToThetaH((k % thetas + 1.0) / thetas));
    integral += channel.P[k] * Pi * (high * high - low * low) / phis;
  }
  if (integral > 0.0)
  {
    channel.P /= integral;
    channel.F *= integral;
  }
}

// The channels' tables as one of RGB triples.
std::vector<float> Interleave(const std::vector<Channel>& channels, Vector Channel::*table)
{
  std::vector<float> rgb;
  for (Eigen::Index k = 0; k < (channels[0].*table).size(); ++k)
  {
    for (const Channel& channel : channels)
    {
      rgb.push_back(static_cast<float>((channel.*table)[k]));
    }
  }
  return rgb;
}

double GetSum(const std::vector<Channel>& channels, std::size_t sweep)
{
  return channels[0].History[sweep] + channels[1].History[sweep] + channels[2].History[sweep];
}
}
} // namespace measuredbrdf

using namespace measuredbrdf;

vtkStandardNewMacro(vtkDistributionBRDFFitter);

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkDistributionBRDFFitter, NumberOfPhiSamples, int, 0, 1024);

//------------------------------------------------------------------------------
void vtkDistributionBRDFFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPhiSamples: " << this->NumberOfPhiSamples << "\n";
}

//------------------------------------------------------------------------------
vtkBRDFFitter::Result vtkDistributionBRDFFitter::FitTo(const std::vector<Sample>& samples)
{
  constexpr double started = 0.3; // of the progress
  const int usual = this->Input->IsIsotropic() ? 1 : 32;
  const int phis = this->NumberOfPhiSamples > 0 ? this->NumberOfPhiSamples : usual;
  const int thetas = phis > 1 ? 48 : 128;
  Problem problem = { samples, *this, MakeDistribution(samples, thetas, phis), MakeFresnel(samples),
    Eigen::ArrayXd(samples.size()) };
  for (std::size_t k = 0; k < samples.size(); ++k)
  {
    const double i = samples[k].I[2], o = samples[k].O[2];
    problem.Scale[static_cast<Eigen::Index>(k)] = 0.25 / (i + o - i * o);
  }

  // Each channel continues from its best start.
  std::vector<Channel> channels = { { problem, 0 }, { problem, 1 }, { problem, 2 } };
  const int starts = std::min<int>(this->NumberOfStarts, std::size(StartReflectances));
  for (int k = 0; k < starts; ++k)
  {
    if (!this->UpdateProgress(started * k / starts))
    {
      return Result();
    }
    ParallelForEach(3,
      [&](int c)
      {
        Channel next(problem, c);
        next.Lambert = GuessLambert(samples, c);
        next.P = GuessDistribution(this->Input, thetas, phis, next.Lambert, c);
        const double reflectance = StartReflectances[k];
        next.Start(reflectance < 0.0 ? GuessFresnel(this->Input, next.Lambert, c)
                                     : SchlickTable(reflectance));
        for (int sweep = 0; sweep < StartSweeps; ++sweep)
        {
          next.Sweep();
        }
        if (k == 0 || next.History.back() < channels[c].History.back())
        {
          channels[c] = next;
        }
      });
  }

  Result result;
  for (std::size_t sweep = 0; sweep <= StartSweeps; ++sweep)
  {
    result.History.push_back(GetSum(channels, sweep));
  }
  const int most = this->MaximumNumberOfIterations;
  for (int k = 0; k < most && !result.Converged; ++k)
  {
    if (!this->UpdateProgress(started + (1.0 - started) * k / most))
    {
      return Result();
    }
    ParallelForEach(3, [&channels](int c) { channels[c].Sweep(); });
    const double before = result.History.back();
    result.History.push_back(GetSum(channels, result.History.size()));
    result.Converged = before - result.History.back() <= this->Tolerance * before;
  }

  double albedo[3];
  for (std::size_t c = 0; c < 3; ++c)
  {
    Normalize(channels[c], thetas, phis);
    albedo[c] = Pi * channels[c].Lambert;
  }
  const std::vector<float> p = Interleave(channels, &Channel::P);
  const std::vector<float> fresnel = Interleave(channels, &Channel::F);
  vtkNew<vtkDistributionBRDF> distribution;
  if (!distribution->SetDistribution(thetas, phis, p) ||
      !distribution->SetFresnel(NumberOfFresnel, fresnel))
  {
    return Result();
  }
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(albedo);
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  sum->AddTerm(distribution);

  TextStream report;
  report << "diffuse albedo: " << albedo[0] << " " << albedo[1] << " " << albedo[2]
         << "\np: " << thetas << " x " << phis << " samples, at the normal " << p[0] << " " << p[1]
         << " " << p[2] << " 1/sr\nF: " << NumberOfFresnel << " samples, from " << fresnel[0] << " "
         << fresnel[1] << " " << fresnel[2] << " to " << fresnel.end()[-3] << " "
         << fresnel.end()[-2] << " " << fresnel.end()[-1] << " at grazing\n";
  result.BRDF = sum;
  result.Report = report.str();
  return result;
}
