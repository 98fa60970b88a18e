// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Acquisition.h"

#include "BasisFunctions.h"
#include "HalfVector.h" // for angles
#include "LocalFrame.h"
#include "ParallelFor.h"

#include "vtkBRDFResampler.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace laboratory
{
namespace
{
using measuredbrdf::BasisFunctions;
using measuredbrdf::Pi;
using measuredbrdf::ToRadians;

// Directions of the projector's light: Gauss nodes in the cosine, equidistant azimuths.
constexpr int NumberOfNodes = 48;
constexpr int LeastAzimuths = 96;

struct Projector
{
  Projector(const BasisFunctions& functions, int azimuths)
    : NumberOfAzimuths(azimuths)
    , Patterns(functions.GetNumberOfFunctions(), NumberOfNodes * azimuths)
  {
    const measuredbrdf::Quadrature rule = measuredbrdf::GaussLegendre(NumberOfNodes);
    const double height = functions.GetNear() - functions.GetFar();
    for (int q = 0; q < NumberOfNodes; ++q)
    {
      const double cosine = functions.GetFar() + 0.5 * (rule.Nodes[q] + 1.0) * height;
      this->Cosines.push_back(cosine);
      this->Weights.push_back(rule.Weights[q] * 0.5 * height * 2.0 * Pi / azimuths * cosine);
      for (int a = 0; a < azimuths; ++a)
      {
        functions.Evaluate(cosine, 2.0 * Pi * a / azimuths, &this->Patterns(0, q * azimuths + a));
      }
    }
  }

  int NumberOfAzimuths;
  std::vector<double> Cosines;
  std::vector<double> Weights; // cos(theta) d omega of a light
  Eigen::MatrixXd Patterns;    // basis functions x lights
};

// What each light adds to each pixel and channel. Of an isotropic sample, the pixels of azimuth 0
// see what all others see of turned lights.
Eigen::MatrixXf FindResponses(vtkBRDF* sample, const Projector& projector,
  const AcquisitionOptions& options, const double zone[2], const Progress& show)
{
  const int azimuths = projector.NumberOfAzimuths;
  const int nPhi = options.NumberOfPhi;
  const int turn = azimuths / nPhi; // lights between two of the camera's azimuths
  const bool isotropic = sample->IsIsotropic();
  Eigen::MatrixXf responses(projector.Patterns.cols(), 3 * options.NumberOfTheta * nPhi);
  for (int t = 0; t < options.NumberOfTheta; ++t)
  {
    const double theta =
      ToRadians(zone[0] + (zone[1] - zone[0]) * t / (options.NumberOfTheta - 1.0));
    measuredbrdf::ParallelFor(0, NumberOfNodes, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType light = begin * azimuths; light < end * azimuths; ++light)
        {
          const vtkIdType q = light / azimuths, a = light % azimuths;
          const glm::dvec3 i =
            measuredbrdf::ToDirection(projector.Cosines[q], 2.0 * Pi * a / azimuths);
          for (int p = 0; p < (isotropic ? 1 : nPhi); ++p)
          {
            const glm::dvec3 o = measuredbrdf::LiftView(
              measuredbrdf::ToDirection(std::cos(theta), 2.0 * Pi * p / nPhi));
            double f[3];
            sample->Evaluate(&i.x, &o.x, f);
            const Eigen::Vector3f response =
              (projector.Weights[q] * Eigen::Map<Eigen::Vector3d>(f)).cast<float>();
            for (int other = p; other < (isotropic ? nPhi : p + 1); ++other)
            {
              responses.row(q * azimuths + (a + (other - p) * turn) % azimuths)
                .segment<3>(3 * (t * nPhi + other)) = response;
            }
          }
        }
      });
    show(0.5 * (t + 1) / options.NumberOfTheta);
  }
  return responses;
}

class Camera
{
public:
  explicit Camera(const AcquisitionOptions& options)
    : Noise(options.Noise)
    , Levels(options.Bits > 0 ? std::exp2(options.Bits) - 1.0 : 0.0)
    , Random(options.Seed)
  {
  }

  // What it makes of an image whose exposure is set to `full`.
  void Expose(Eigen::VectorXd& image, double full)
  {
    for (Eigen::Index k = 0; k < image.size() && full > 0.0; ++k)
    {
      double v = image[k] / full + (this->Noise > 0.0 ? this->Noise * this->GetNormal() : 0.0);
      if (this->Levels > 0.0)
      {
        v = std::round(std::clamp(v, 0.0, 1.0) * this->Levels) / this->Levels;
      }
      image[k] = v * full;
    }
  }

private:
  // Box, Muller 1958: the engine's bits are fixed by the standard, its distributions are not.
  double GetNormal()
  {
    const double u = (static_cast<double>(this->Random()) + 0.5) * 0x1p-32;
    const double v = (static_cast<double>(this->Random()) + 0.5) * 0x1p-32;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * Pi * v);
  }

  double Noise;
  double Levels;
  std::mt19937 Random;
};
}

//------------------------------------------------------------------------------
Acquisition Acquire(vtkBRDF* sample, const AcquisitionOptions& options, const Progress& show)
{
  sample->Prepare();
  const bool hemispherical = options.Basis == vtkBasisBRDF::HEMISPHERICAL;
  const double zone[2] = { hemispherical ? 0.0 : options.Zone[0],
    hemispherical ? 90.0 : options.Zone[1] };
  const BasisFunctions functions(options.Basis == vtkBasisBRDF::LEGENDRE_FOURIER, options.Order,
    std::cos(ToRadians(zone[0])), std::cos(ToRadians(zone[1])));
  const int nPhi = options.NumberOfPhi;
  const Projector projector(functions, (LeastAzimuths + nPhi - 1) / nPhi * nPhi);
  const Eigen::MatrixXf responses = FindResponses(sample, projector, options, zone, show);

  Acquisition result;
  Camera camera(options);
  std::vector<Eigen::VectorXd> stack;
  for (int k = 0; k < functions.GetNumberOfFunctions(); ++k)
  {
    const Eigen::VectorXf pattern = projector.Patterns.row(k).cast<float>();
    Eigen::VectorXd positive = (responses.transpose() * pattern.cwiseMax(0.0f)).cast<double>();
    Eigen::VectorXd negative = Eigen::VectorXd::Zero(positive.size());
    const bool hasNegative = pattern.minCoeff() < 0.0f;
    if (hasNegative)
    {
      negative = (responses.transpose() * (-pattern).cwiseMax(0.0f)).cast<double>();
    }
    const double full = std::max(positive.maxCoeff(), negative.maxCoeff());
    camera.Expose(positive, full);
    if (hasNegative)
    {
      camera.Expose(negative, full);
    }
    result.NumberOfPhotographs += hasNegative ? 2 : 1;
    stack.push_back(positive - negative);
    show(0.5 + 0.5 * (k + 1.0) / functions.GetNumberOfFunctions());
  }

  // Coefficients of an isotropic sample are averaged over the camera's azimuths, each turned back
  // by its own: (c_m, c_-m) -> R(m phi) (c_m, c_-m).
  const bool isotropic = sample->IsIsotropic();
  std::vector<float> coefficients;
  for (int l = 0; l <= options.Order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      const Eigen::VectorXd& same = stack[BasisFunctions::Index(l, m)];
      const Eigen::VectorXd& other = stack[BasisFunctions::Index(l, -m)];
      for (int t = 0; t < options.NumberOfTheta; ++t)
      {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (int p = 0; p < nPhi; ++p)
        {
          const Eigen::Index pixel = 3 * (t * nPhi + p);
          const double angle = 2.0 * Pi * m * p / nPhi;
          mean +=
            (std::cos(angle) * same.segment<3>(pixel) + std::sin(angle) * other.segment<3>(pixel)) /
            nPhi;
          if (!isotropic)
          {
            const Eigen::Vector3d own = same.segment<3>(pixel);
            coefficients.insert(coefficients.end(), own.begin(), own.end());
          }
        }
        if (isotropic)
        {
          coefficients.insert(coefficients.end(), mean.begin(), mean.end());
        }
      }
    }
  }
  result.Stack = vtkSmartPointer<vtkBasisBRDF>::New();
  const std::string problem = result.Stack->SetCoefficients(options.Basis, options.Order, zone,
    zone, options.NumberOfTheta, isotropic ? 1 : nPhi, std::move(coefficients));
  if (!problem.empty())
  {
    throw std::runtime_error("the acquisition of " + sample->GetName() + ": " + problem);
  }
  result.Stack->SetIncidentCosine(true);
  result.Stack->SetName(sample->GetName());
  result.Stack->SetSource(
    "simulated acquisition" + (sample->GetSource().empty() ? "" : " of: " + sample->GetSource()));
  return result;
}

namespace
{
using measuredbrdf::MakeLeastSquares;
using measuredbrdf::MakeRadialMatrix;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int ZonalNodes = 64;
constexpr int NumberOfViews = 64; // of the output, 0 to 90 degrees
constexpr int LambdaSteps = 21;   // 1e-5 to 1

double GetStep(int k) { return std::pow(10.0, -5.0 + 5.0 * k / (LambdaSteps - 1.0)); }

// What a zone's samples are and how they count.
struct Side
{
  std::vector<double> Cosines;
  std::vector<double> Weights;
};

// Rows (l, m), l = |m| ... order, of a stack of coefficients with a row for each function.
Eigen::MatrixXd GetRows(const RowMatrix& stack, int order, int m)
{
  Eigen::MatrixXd rows(order + 1 - std::abs(m), stack.cols());
  for (int l = std::abs(m); l <= order; ++l)
  {
    rows.row(l - std::abs(m)) = stack.row(BasisFunctions::Index(l, m));
  }
  return rows;
}

// The problem over i: the input's values at nodes of its zone, from which harmonics are made. f
// itself extends better than f times a cosine, so that a cosine in the input is divided out.
struct IncidentProblem
{
  explicit IncidentProblem(vtkBasisBRDF* input, const RowMatrix& stack, int orders)
  {
    const double near = std::cos(ToRadians(input->GetIncidentZone()[0]));
    const double far = std::cos(ToRadians(input->GetIncidentZone()[1]));
    const BasisFunctions functions(input->GetBasis() == vtkBasisBRDF::LEGENDRE_FOURIER,
      input->GetOrder(), near, input->GetBasis() == vtkBasisBRDF::SPHERICAL_HARMONICS ? -1.0 : far);
    const measuredbrdf::Quadrature rule = measuredbrdf::GaussLegendre(ZonalNodes);
    Eigen::VectorXd divide = Eigen::VectorXd::Ones(ZonalNodes);
    for (int q = 0; q < ZonalNodes; ++q)
    {
      this->Zone.Cosines.push_back(far + 0.5 * (rule.Nodes[q] + 1.0) * (near - far));
      divide[q] = input->GetIncidentCosine() ? 1.0 / this->Zone.Cosines.back() : 1.0;
    }
    this->Zone.Weights = rule.Weights;
    for (int m = -orders; m <= orders; ++m)
    {
      this->Samples.push_back(divide.asDiagonal() *
                              MakeRadialMatrix(functions, std::abs(m), this->Zone.Cosines) *
                              GetRows(stack, input->GetOrder(), m));
    }
  }

  int GetOrders() const { return static_cast<int>(this->Samples.size()) / 2; }

  Side Zone;
  std::vector<Eigen::MatrixXd> Samples; // of m = -orders ... orders; a column per view and channel
};

struct Score
{
  double Residual = 0.0; // weighted sum of squares
  double Penalty = 0.0;
};

Score Try(const BasisFunctions& harmonics, const IncidentProblem& problem, double lambda)
{
  Score score;
  const Side& zone = problem.Zone;
  const Eigen::Map<const Eigen::VectorXd> weights(zone.Weights.data(), ZonalNodes);
  for (int m = -problem.GetOrders(); m <= problem.GetOrders(); ++m)
  {
    const Eigen::MatrixXd& samples = problem.Samples[m + problem.GetOrders()];
    const Eigen::MatrixXd solve =
      MakeLeastSquares(harmonics, std::abs(m), zone.Cosines, zone.Weights, lambda);
    const Eigen::MatrixXd radial = MakeRadialMatrix(harmonics, std::abs(m), zone.Cosines);
    const Eigen::MatrixXd c = solve * samples;
    score.Residual += (weights.asDiagonal() * (samples - radial * c).cwiseAbs2()).sum();
    for (Eigen::Index row = 0; row < c.rows(); ++row)
    {
      const double l = static_cast<double>(row) + std::abs(m);
      score.Penalty += std::pow(l * (l + 1.0), 2.0) * c.row(row).squaredNorm();
    }
  }
  return score;
}

// The largest curvature of log penalty over log residual, by differences along the steps.
double ChooseLambda(const BasisFunctions& harmonics, const IncidentProblem& problem)
{
  std::vector<Eigen::Vector2d> logs;
  for (int k = 0; k < LambdaSteps; ++k)
  {
    const Score score = Try(harmonics, problem, GetStep(k));
    logs.emplace_back(std::log(score.Residual + 1e-300), std::log(score.Penalty + 1e-300));
  }
  int best = 0;
  double largest = -std::numeric_limits<double>::max();
  for (int k = 1; k + 1 < LambdaSteps; ++k)
  {
    const Eigen::Vector2d first = 0.5 * (logs[k + 1] - logs[k - 1]);
    const Eigen::Vector2d second = logs[k + 1] - 2.0 * logs[k] + logs[k - 1];
    const double speed = std::max(first.norm(), 1e-12);
    const double curvature =
      (first.x() * second.y() - first.y() * second.x()) / (speed * speed * speed);
    if (curvature > largest)
    {
      largest = curvature;
      best = k;
    }
  }
  return GetStep(best);
}

// The problem over o, per azimuthal order: samples over the zone -> values over 0 to 90 degrees.
std::vector<Eigen::MatrixXd> MakeExtensions(
  vtkBasisBRDF* input, const BasisFunctions& harmonics, double lambda)
{
  const double* zone = input->GetOutgoingZone();
  const int nTheta = input->GetNumberOfTheta();
  Side side;
  Eigen::VectorXd divide = Eigen::VectorXd::Ones(nTheta);
  for (int t = 0; t < nTheta; ++t)
  {
    const double theta = ToRadians(zone[0] + (zone[1] - zone[0]) * t / (nTheta - 1.0));
    side.Cosines.push_back(std::cos(theta));
    side.Weights.push_back(std::sin(theta) * (t == 0 || t == nTheta - 1 ? 0.5 : 1.0) + 1e-9);
    if (input->GetOutgoingCosine())
    {
      divide[t] = 1.0 / std::max(side.Cosines.back(), measuredbrdf::MinimumViewCosine);
    }
  }
  std::vector<double> cosines;
  for (int t = 0; t < NumberOfViews; ++t)
  {
    cosines.push_back(std::cos(0.5 * Pi * t / (NumberOfViews - 1.0)));
  }
  std::vector<Eigen::MatrixXd> extensions;
  for (int m = 0; m <= harmonics.GetOrder(); ++m)
  {
    extensions.push_back(MakeRadialMatrix(harmonics, m, cosines) *
                         MakeLeastSquares(harmonics, m, side.Cosines, side.Weights, lambda) *
                         divide.asDiagonal());
  }
  return extensions;
}

// Real Fourier series over n equidistant azimuths: rows 1, cos, sin, cos 2, sin 2, ... of an order
// below n / 2, and at most `order`.
Eigen::MatrixXd MakeSeries(int order, int n)
{
  const int last = std::min(order, (n - 1) / 2);
  Eigen::MatrixXd series = Eigen::MatrixXd::Ones(2 * last + 1, n);
  for (int j = 0; j < n; ++j)
  {
    for (int m = 1; m <= last; ++m)
    {
      series(2 * m - 1, j) = std::cos(2.0 * Pi * m * j / n);
      series(2 * m, j) = std::sin(2.0 * Pi * m * j / n);
    }
  }
  return series;
}
}

//------------------------------------------------------------------------------
Extrapolation Extrapolate(
  vtkBasisBRDF* input, const ExtrapolationOptions& options, const Progress& show)
{
  if (input->GetCoefficients().empty())
  {
    throw std::runtime_error("extrapolation: the input has no coefficients");
  }
  const int order = options.Order > 0 ? options.Order : std::max(input->GetOrder(), 1);
  const int nTheta = input->GetNumberOfTheta();
  const int nPhi = input->GetNumberOfPhi();
  std::string problem = vtkBasisBRDF::FindSizeProblem(order, NumberOfViews, nPhi);
  if (!problem.empty())
  {
    throw std::runtime_error("extrapolation: " + problem);
  }
  const BasisFunctions harmonics(false, order, 1.0, -1.0);
  const int count = harmonics.GetNumberOfFunctions();
  using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMatrix stack = Eigen::Map<const FloatRows>(
    input->GetCoefficients().data(), input->GetNumberOfFunctions(), 3 * nTheta * nPhi)
                            .cast<double>();
  const IncidentProblem incident(input, stack, std::min(order, input->GetOrder()));
  Extrapolation result;
  result.Lambda = ChooseLambda(harmonics, incident);

  // Over i: coefficients of the harmonics for each sample of o.
  RowMatrix half = RowMatrix::Zero(count, stack.cols());
  for (int m = -incident.GetOrders(); m <= incident.GetOrders(); ++m)
  {
    const Eigen::MatrixXd c = MakeLeastSquares(harmonics, std::abs(m), incident.Zone.Cosines,
                                incident.Zone.Weights, result.Lambda) *
                              incident.Samples[m + incident.GetOrders()];
    for (int l = std::abs(m); l <= order; ++l)
    {
      half.row(BasisFunctions::Index(l, m)) = c.row(l - std::abs(m));
    }
  }

  // Over o: coefficient (l, m) is a function of o whose azimuthal order is the isotropic form's m,
  // or runs through a Fourier series.
  const std::vector<Eigen::MatrixXd> extensions = MakeExtensions(input, harmonics, result.Lambda);
  const Eigen::MatrixXd series = MakeSeries(order, nPhi);
  std::vector<float> coefficients(static_cast<std::size_t>(count) * NumberOfViews * 3 * nPhi);
  for (int l = 0; l <= order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      const int k = BasisFunctions::Index(l, m);
      float* output = &coefficients[static_cast<std::size_t>(k) * NumberOfViews * 3 * nPhi];
      using Step = Eigen::Stride<Eigen::Dynamic, 3>;
      for (int c = 0; c < 3; ++c)
      {
        const Eigen::Map<const RowMatrix, 0, Step> samples(
          half.row(k).data() + c, nTheta, nPhi, Step(3 * nPhi, 3));
        const Eigen::MatrixXd spectrum = samples * series.transpose() / nPhi;
        Eigen::MatrixXd extended(NumberOfViews, spectrum.cols());
        for (int column = 0; column < spectrum.cols(); ++column)
        {
          const int azimuthal = nPhi == 1 ? std::abs(m) : (column + 1) / 2;
          extended.col(column) =
            (column > 0 ? 2.0 : 1.0) * (extensions[azimuthal] * spectrum.col(column));
        }
        Eigen::Map<FloatRows, 0, Step>(output + c, NumberOfViews, nPhi, Step(3 * nPhi, 3)) =
          (extended * series).cast<float>();
      }
    }
    show((l + 1.0) / (order + 1.0));
  }

  result.Output = vtkSmartPointer<vtkBasisBRDF>::New();
  const double hemisphere[2] = { 0.0, 90.0 };
  problem = result.Output->SetCoefficients(vtkBasisBRDF::SPHERICAL_HARMONICS, order, hemisphere,
    hemisphere, NumberOfViews, nPhi, std::move(coefficients));
  if (!problem.empty())
  {
    throw std::runtime_error("extrapolation: " + problem);
  }
  result.Output->SetName(input->GetName());
  result.Output->SetSource(input->GetSource());
  result.Output->SetResamplingTolerance(input->GetResamplingTolerance());
  result.InZoneResidual = vtkBRDFResampler::GetZoneRelativeL2Error(
    input, result.Output, input->GetIncidentZone(), input->GetOutgoingZone(), 1 << 14);
  const double usual = input->GetBasis() == vtkBasisBRDF::ZONAL ? 0.10 : 0.03;
  result.ResidualLimit = options.MaximumResidual > 0.0 ? options.MaximumResidual : usual;
  result.NegativeMass = result.Output->GetNegativeMass(hemisphere, hemisphere);
  result.IsAccepted = result.InZoneResidual <= result.ResidualLimit &&
                      result.NegativeMass <= options.MaximumNegativeMass;
  return result;
}
} // namespace laboratory
