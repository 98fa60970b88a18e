// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBasisExtrapolator.h"

#include "GaussLegendre.h"
#include "ZonalOperators.h"
#include "vtkBRDFResampler.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <limits>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBasisExtrapolator);

namespace
{
constexpr int NumberOfNodes = 64;
constexpr int NumberOfViews = 64; // of the output, 0 to 90 degrees
constexpr int LambdaSteps = 41;   // 1e-10 to 1

double ToRadians(double degrees) { return degrees * (Pi / 180.0); }

double GetStep(int k) { return std::pow(10.0, -10.0 + 10.0 * k / (LambdaSteps - 1.0)); }

// The zone's side of the problem over one direction: where samples lie and how they count.
struct Side
{
  std::vector<double> Cosines;
  std::vector<double> Weights;
};

// One least-squares problem per azimuthal order, all its right-hand sides as columns.
using Samples = std::vector<Eigen::MatrixXd>;

struct Score
{
  double Residual = 0.0; // weighted sum of squares
  double Penalty = 0.0;
  double Freedom = 0.0; // number of samples minus the trace of the hat matrices
};

Score Try(const BasisFunctions& harmonics, const Side& side, const Samples& samples, double lambda)
{
  Score score;
  const Eigen::VectorXd weights = Eigen::Map<const Eigen::VectorXd>(
    side.Weights.data(), static_cast<Eigen::Index>(side.Weights.size()));
  for (std::size_t m = 0; m < samples.size(); ++m)
  {
    const int order = static_cast<int>(m);
    const Eigen::MatrixXd solve =
      MakeLeastSquares(harmonics, order, side.Cosines, side.Weights, lambda);
    const Eigen::MatrixXd radial = MakeRadialMatrix(harmonics, order, side.Cosines);
    const Eigen::MatrixXd c = solve * samples[m];
    const Eigen::MatrixXd difference = samples[m] - radial * c;
    score.Residual += (weights.asDiagonal() * difference.cwiseAbs2()).sum();
    for (Eigen::Index row = 0; row < c.rows(); ++row)
    {
      const double l = static_cast<double>(row + order);
      score.Penalty += std::pow(l * (l + 1.0), 2.0) * c.row(row).squaredNorm();
    }
    const double trace = (radial * solve).trace();
    score.Freedom +=
      (static_cast<double>(radial.rows()) - trace) * static_cast<double>(samples[m].cols());
  }
  return score;
}

double ChooseLambda(
  int criterion, const BasisFunctions& harmonics, const Side& side, const Samples& samples)
{
  std::vector<Score> scores;
  for (int k = 0; k < LambdaSteps; ++k)
  {
    scores.push_back(Try(harmonics, side, samples, GetStep(k)));
  }
  int best = 0;
  double smallest = std::numeric_limits<double>::max();
  for (int k = 0; k < LambdaSteps; ++k)
  {
    const Score& score = scores[static_cast<std::size_t>(k)];
    double value = std::numeric_limits<double>::max();
    if (criterion == vtkBasisExtrapolator::CROSS_VALIDATION)
    {
      value = score.Residual / (score.Freedom * score.Freedom);
    }
    else if (k > 0 && k + 1 < LambdaSteps)
    {
      // Curvature of (log residual, log penalty) by differences along the steps.
      const auto point = [&scores](int at)
      {
        const Score& s = scores[static_cast<std::size_t>(at)];
        return glm::dvec2(std::log(s.Residual + 1e-300), std::log(s.Penalty + 1e-300));
      };
      const glm::dvec2 first = 0.5 * (point(k + 1) - point(k - 1));
      const glm::dvec2 second = point(k + 1) - 2.0 * point(k) + point(k - 1);
      const double speed = std::max(glm::length(first), 1e-12);
      value = -(first.x * second.y - first.y * second.x) / (speed * speed * speed);
    }
    if (value < smallest)
    {
      smallest = value;
      best = k;
    }
  }
  return GetStep(best);
}

// Access to a table of coefficients: k slowest, then theta_o, phi_o, channel.
struct Table
{
  std::vector<double> Values;
  int NumberOfTheta;
  int NumberOfPhi;

  Table(int functions, int nTheta, int nPhi)
    : Values(3 * static_cast<std::size_t>(functions) * static_cast<std::size_t>(nTheta) *
             static_cast<std::size_t>(nPhi))
    , NumberOfTheta(nTheta)
    , NumberOfPhi(nPhi)
  {
  }

  double& At(int k, int theta, int phi, int c)
  {
    return this->Values[3 * static_cast<std::size_t>(
                              (k * this->NumberOfTheta + theta) * this->NumberOfPhi + phi) +
                        static_cast<std::size_t>(c)];
  }
};

// Fourier order of phi_o: cosine and sine parts of a series over n equidistant azimuths.
double GetHarmonic(int order, bool sine, int j, int n)
{
  const double angle = 2.0 * Pi * order * j / n;
  return sine ? std::sin(angle) : std::cos(angle);
}
}

//------------------------------------------------------------------------------
void vtkBasisExtrapolator::SetInput(vtkBasisBRDF* input)
{
  if (this->Input != input)
  {
    this->Input = input;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
bool vtkBasisExtrapolator::Extrapolate()
{
  if (!this->Input || this->Input->GetCoefficients().empty())
  {
    vtkErrorMacro("Extrapolate: no input, or one without coefficients.");
    return false;
  }
  vtkBasisBRDF* input = this->Input;
  const int order = this->Order > 0 ? this->Order : std::max(input->GetOrder(), 1);
  const int inputOrder = input->GetOrder();
  const bool fourier = input->GetBasis() == vtkBasisBRDF::LEGENDRE_FOURIER;
  const double* zone = input->GetIncidentZone();
  const double* outgoing = input->GetOutgoingZone();
  const double near = std::cos(ToRadians(zone[0]));
  const double far = std::cos(ToRadians(zone[1]));
  const BasisFunctions harmonics(false, order, 1.0, -1.0);
  const BasisFunctions functions(
    fourier, inputOrder, near, input->GetBasis() == vtkBasisBRDF::SPHERICAL_HARMONICS ? -1.0 : far);
  const int nTheta = input->GetNumberOfTheta();
  const int nPhi = input->GetNumberOfPhi();
  const int views = nTheta * nPhi;

  // Over i: samples of the input at Gauss nodes of its zone, one column per view, channel, parity.
  Side incident;
  const Quadrature rule = GaussLegendre(NumberOfNodes);
  for (int q = 0; q < NumberOfNodes; ++q)
  {
    incident.Cosines.push_back(far + 0.5 * (rule.Nodes[q] + 1.0) * (near - far));
    incident.Weights.push_back(rule.Weights[q]);
  }
  // f itself extends better than f times a cosine: the cosines that the input carries go.
  Eigen::VectorXd divide = Eigen::VectorXd::Ones(NumberOfNodes);
  if (input->GetIncidentCosine())
  {
    for (int q = 0; q < NumberOfNodes; ++q)
    {
      divide(q) = 1.0 / incident.Cosines[static_cast<std::size_t>(q)];
    }
  }
  const std::vector<float>& coefficients = input->GetCoefficients();
  Samples samples;
  for (int m = 0; m <= std::min(order, inputOrder); ++m)
  {
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(inputOrder + 1 - m, 6 * views);
    for (int l = m; l <= inputOrder; ++l)
    {
      for (int v = 0; v < 3 * views; ++v)
      {
        const auto at = [&](int k)
        {
          return static_cast<double>(
            coefficients[3 * static_cast<std::size_t>(k) * static_cast<std::size_t>(views) +
                         static_cast<std::size_t>(v)]);
        };
        c(l - m, v) = at(BasisFunctions::Index(l, m));
        c(l - m, 3 * views + v) = m > 0 ? at(BasisFunctions::Index(l, -m)) : 0.0;
      }
    }
    samples.push_back(divide.asDiagonal() * MakeRadialMatrix(functions, m, incident.Cosines) * c);
  }
  if (this->Criterion != FIXED)
  {
    this->Lambda = ChooseLambda(this->Criterion, harmonics, incident, samples);
  }
  Table half(harmonics.GetNumberOfFunctions(), nTheta, nPhi);
  for (int m = 0; m < static_cast<int>(samples.size()); ++m)
  {
    const Eigen::MatrixXd c =
      MakeLeastSquares(harmonics, m, incident.Cosines, incident.Weights, this->Lambda) *
      samples[static_cast<std::size_t>(m)];
    for (int l = m; l <= order; ++l)
    {
      for (int v = 0; v < 3 * views; ++v)
      {
        half.At(BasisFunctions::Index(l, m), 0, 0, v) = c(l - m, v);
        if (m > 0)
        {
          half.At(BasisFunctions::Index(l, -m), 0, 0, v) = c(l - m, 3 * views + v);
        }
      }
    }
  }

  // Over o: each coefficient is a function of o whose azimuthal order is the isotropic form's m, or
  // runs through a Fourier series.
  Side outside;
  for (int t = 0; t < nTheta; ++t)
  {
    const double theta = ToRadians(outgoing[0] + (outgoing[1] - outgoing[0]) * t / (nTheta - 1.0));
    outside.Cosines.push_back(std::cos(theta));
    outside.Weights.push_back(std::sin(theta) * (t == 0 || t == nTheta - 1 ? 0.5 : 1.0) + 1e-9);
  }
  std::vector<double> viewCosines;
  for (int t = 0; t < NumberOfViews; ++t)
  {
    viewCosines.push_back(std::cos(0.5 * Pi * t / (NumberOfViews - 1.0)));
  }
  std::vector<Eigen::MatrixXd> extend; // per order: samples over the zone -> values over 0 to 90
  for (int m = 0; m <= order; ++m)
  {
    extend.push_back(
      MakeRadialMatrix(harmonics, m, viewCosines) *
      MakeLeastSquares(harmonics, m, outside.Cosines, outside.Weights, this->Lambda));
  }
  Table whole(harmonics.GetNumberOfFunctions(), NumberOfViews, nPhi);
  Eigen::VectorXd series(nTheta);
  for (int l = 0; l <= order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      const int k = BasisFunctions::Index(l, m);
      for (int c = 0; c < 3; ++c)
      {
        const int last = nPhi == 1 ? 0 : std::min(order, (nPhi - 1) / 2);
        for (int azimuthal = 0; azimuthal <= last; ++azimuthal)
        {
          for (const bool sine : { false, true })
          {
            if (sine && azimuthal == 0)
            {
              continue;
            }
            for (int t = 0; t < nTheta; ++t)
            {
              series(t) = 0.0;
              for (int p = 0; p < nPhi; ++p)
              {
                series(t) += half.At(k, t, p, c) * GetHarmonic(azimuthal, sine, p, nPhi) *
                             (azimuthal > 0 ? 2.0 : 1.0) / nPhi;
              }
              if (input->GetOutgoingCosine())
              {
                series(t) /= std::max(outside.Cosines[static_cast<std::size_t>(t)], 0.02);
              }
            }
            const int orderOfView = nPhi == 1 ? std::abs(m) : azimuthal;
            const Eigen::VectorXd values = extend[static_cast<std::size_t>(orderOfView)] * series;
            for (int t = 0; t < NumberOfViews; ++t)
            {
              for (int p = 0; p < nPhi; ++p)
              {
                whole.At(k, t, p, c) += values(t) * GetHarmonic(azimuthal, sine, p, nPhi);
              }
            }
          }
        }
      }
    }
  }

  const auto output = vtkSmartPointer<vtkBasisBRDF>::New();
  const double hemisphere[2] = { 0.0, 90.0 };
  const std::string problem =
    output->SetCoefficients(vtkBasisBRDF::SPHERICAL_HARMONICS, order, hemisphere, hemisphere,
      NumberOfViews, nPhi, std::vector<float>(whole.Values.begin(), whole.Values.end()));
  if (!problem.empty())
  {
    vtkErrorMacro("Extrapolate: " << problem << ".");
    return false;
  }
  output->SetName(input->GetName());
  output->SetSource(input->GetSource());
  output->SetResamplingTolerance(input->GetResamplingTolerance());
  this->Output = output;
  this->InZoneResidual =
    vtkBRDFResampler::GetZoneRelativeL2Error(input, output, zone, outgoing, 1 << 14);
  this->Accepted = this->InZoneResidual <= this->MaximumResidual;
  return this->Accepted;
}

//------------------------------------------------------------------------------
void vtkBasisExtrapolator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Input: " << this->Input.Get() << "\n";
  os << indent << "Output: " << this->Output.Get() << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "Criterion: " << this->Criterion << "\n";
  os << indent << "Lambda: " << this->Lambda << "\n";
  os << indent << "MaximumResidual: " << this->MaximumResidual << "\n";
  os << indent << "InZoneResidual: " << this->InZoneResidual << "\n";
  os << indent << "Accepted: " << (this->Accepted ? "On" : "Off") << "\n";
}
