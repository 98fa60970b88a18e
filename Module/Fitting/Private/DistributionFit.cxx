// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DistributionFit.h"

#include "DistributionChannel.h"
#include "HalfVector.h"
#include "ParallelFor.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <random>

namespace measuredbrdf
{
namespace
{
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
std::vector<double> ChooseStarts(
  vtkBRDF* input, const DistributionFitOptions& options, double share, Channels& channels)
{
  const int n = options.Size.NumberOfFresnel;
  const bool random = options.StartSeed > 0;
  const int starts =
    random ? options.NumberOfStarts
           : std::min(options.NumberOfStarts, static_cast<int>(std::size(StartReflectances)));
  std::array<Attempt, 3> best;
  for (int k = 0; k < starts; ++k)
  {
    if (!options.Progress(share * k / starts))
    {
      return {};
    }
    ForChannels(
      [&](std::size_t c)
      {
        Attempt attempt;
        if (random)
        {
          std::mt19937 generator(options.StartSeed + 7919u * (3u * static_cast<unsigned int>(k) +
                                                               static_cast<unsigned int>(c)));
          attempt = TryRandom(channels[c], options.Size.NumberOfTheta, n, generator);
        }
        else
        {
          const bool measured =
            StartReflectances[k] < 0.0 && options.Shape != FresnelShape::Schlick;
          const Vector fresnel =
            measured ? GuessFresnel(input, channels[c].Tables.Lambert, static_cast<int>(c), n)
                     : SchlickTable(std::abs(StartReflectances[k]), n);
          attempt = Try(channels[c], fresnel);
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
      [](double sum, double mean) { return sum + mean; });
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

//------------------------------------------------------------------------------
DistributionFitResult FitDistribution(
  vtkBRDF* input, const FitSamples& samples, const DistributionFitOptions& options)
{
  constexpr double started = 0.3; // of the progress
  const DistributionGeometry geometry(samples, options.Size);
  const Eigen::MatrixXd basis = NewFresnelBasis(options.Shape, options.Size.NumberOfFresnel);
  Channels channels;
  for (int c = 0; c < 3; ++c)
  {
    channels.emplace_back(samples, geometry, basis, options.Shape != FresnelShape::Schlick, c);
    channels.back().Tables.Lambert = GuessLambert(samples, c);
  }
  GuessDistribution(input, options.Size, channels);

  DistributionFitResult result;
  result.History = ChooseStarts(input, options, started, channels);
  const int most = options.MaximumNumberOfIterations;
  for (int k = 0; k < most && !result.History.empty() && !result.Converged; ++k)
  {
    if (!options.Progress(started + (1.0 - started) * k / most))
    {
      return DistributionFitResult();
    }
    ForChannels([&channels](std::size_t c) { channels[c].Sweep(); });
    double sum = 0.0;
    for (const DistributionChannel& channel : channels)
    {
      sum += channel.GetMeanSquare();
    }
    result.Converged = result.History.back() - sum <= options.Tolerance * result.History.back();
    result.History.push_back(sum);
  }
  if (result.History.empty())
  {
    return result;
  }
  for (std::size_t c = 0; c < 3; ++c)
  {
    Normalize(options.Size, channels[c].Tables);
    result.Albedo[c] = Pi * channels[c].Tables.Lambert;
  }
  result.Distribution = Interleave(channels, &DistributionTables::P);
  result.Fresnel = Interleave(channels, &DistributionTables::F);
  return result;
}
} // namespace measuredbrdf
