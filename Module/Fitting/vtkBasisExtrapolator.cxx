// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBasisExtrapolator.h"

#include "BasisFunctions.h"
#include "HalfVector.h" // for angles
#include "LocalFrame.h"
#include "Setters.h"
#include "ZonalOperators.h"
#include "vtkBRDFResampler.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBasisExtrapolator);

namespace
{
constexpr int ZonalNodes = 64;
constexpr int NumberOfViews = 64; // of the output, 0 to 90 degrees
constexpr int LambdaSteps = 21;   // 1e-5 to 1
constexpr double ZonalLimit = 0.10;
constexpr double OtherLimit = 0.03;

double GetStep(int k) { return std::pow(10.0, -5.0 + 5.0 * k / (LambdaSteps - 1.0)); }

// The zone's side of the problem over one direction: where samples lie and how they count.
struct Side
{
  std::vector<double> Cosines;
  std::vector<double> Weights;
};

// The data of the problem over i, per azimuthal order: Samples Samples^T is that of all right-hand
// sides (of all views, channels and both parities), whose number is Count.
struct Data
{
  std::vector<Eigen::MatrixXd> Samples;
  double Count = 0.0;
};

struct Score
{
  double Residual = 0.0; // weighted sum of squares
  double Penalty = 0.0;
  double Freedom = 0.0; // number of samples minus the trace of the hat matrices
};

Score Try(const BasisFunctions& harmonics, const Side& side, const Data& data, double lambda)
{
  Score score;
  const Eigen::VectorXd weights = Eigen::Map<const Eigen::VectorXd>(
    side.Weights.data(), static_cast<Eigen::Index>(side.Weights.size()));
  for (std::size_t m = 0; m < data.Samples.size(); ++m)
  {
    const Eigen::MatrixXd& samples = data.Samples[m];
    const int order = static_cast<int>(m);
    const Eigen::MatrixXd solve =
      MakeLeastSquares(harmonics, order, side.Cosines, side.Weights, lambda);
    const Eigen::MatrixXd radial = MakeRadialMatrix(harmonics, order, side.Cosines);
    const Eigen::MatrixXd c = solve * samples;
    const Eigen::MatrixXd difference = samples - radial * c;
    score.Residual += (weights.asDiagonal() * difference.cwiseAbs2()).sum();
    for (Eigen::Index row = 0; row < c.rows(); ++row)
    {
      const double l = static_cast<double>(row + order);
      score.Penalty += std::pow(l * (l + 1.0), 2.0) * c.row(row).squaredNorm();
    }
    const double trace = (radial * solve).trace();
    score.Freedom += (static_cast<double>(radial.rows()) - trace) * data.Count;
  }
  return score;
}

double ChooseLambda(
  int criterion, const BasisFunctions& harmonics, const Side& side, const Data& data)
{
  std::vector<Score> scores;
  for (int k = 0; k < LambdaSteps; ++k)
  {
    scores.push_back(Try(harmonics, side, data, GetStep(k)));
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

// The input's coefficients of one azimuthal order of i: a row per degree, columns theta_o, phi_o,
// channel; first the cosine parts, then the sine parts.
Eigen::MatrixXd Gather(vtkBasisBRDF* input, int m)
{
  const std::vector<float>& coefficients = input->GetCoefficients();
  const int order = input->GetOrder();
  const int columns = 3 * input->GetNumberOfTheta() * input->GetNumberOfPhi();
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(order + 1 - m, 2 * columns);
  for (int l = m; l <= order; ++l)
  {
    for (int v = 0; v < columns; ++v)
    {
      const auto at = [&](int k)
      {
        return static_cast<double>(
          coefficients[static_cast<std::size_t>(k) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(v)]);
      };
      c(l - m, v) = at(BasisFunctions::Index(l, m));
      c(l - m, columns + v) = m > 0 ? at(BasisFunctions::Index(l, -m)) : 0.0;
    }
  }
  return c;
}

// L of c = L Q with orthonormal rows of Q: L L^T = c c^T.
Eigen::MatrixXd Compress(const Eigen::MatrixXd& c)
{
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(c.transpose());
  const Eigen::MatrixXd upper =
    qr.matrixQR().topRows(c.rows()).triangularView<Eigen::Upper>().toDenseMatrix();
  return upper.transpose();
}

// The problem over i: from the input's basis on its zone to harmonics.
struct IncidentProblem
{
  Side Zone;
  std::vector<Eigen::MatrixXd> Values; // per azimuthal order: coefficients -> f at the zone's nodes

  IncidentProblem(vtkBasisBRDF* input, int orders)
  {
    const double* zone = input->GetIncidentZone();
    const double near = std::cos(ToRadians(zone[0]));
    const double far = std::cos(ToRadians(zone[1]));
    const BasisFunctions functions(input->GetBasis() == vtkBasisBRDF::LEGENDRE_FOURIER,
      input->GetOrder(), near, input->GetBasis() == vtkBasisBRDF::SPHERICAL_HARMONICS ? -1.0 : far);
    const Quadrature rule = GaussLegendre(ZonalNodes);
    Eigen::VectorXd divide = Eigen::VectorXd::Ones(ZonalNodes);
    for (int q = 0; q < ZonalNodes; ++q)
    {
      const std::size_t node = static_cast<std::size_t>(q);
      this->Zone.Cosines.push_back(far + 0.5 * (rule.Nodes[node] + 1.0) * (near - far));
      this->Zone.Weights.push_back(rule.Weights[node]);
      if (input->GetIncidentCosine()) // f itself extends better than f times a cosine
      {
        divide(q) = 1.0 / this->Zone.Cosines.back();
      }
    }
    for (int m = 0; m < orders; ++m)
    {
      this->Values.push_back(
        divide.asDiagonal() * MakeRadialMatrix(functions, m, this->Zone.Cosines));
    }
  }
};

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
      divide(t) = 1.0 / std::max(side.Cosines.back(), MinimumViewCosine);
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
  Eigen::MatrixXd series(2 * last + 1, n);
  for (int j = 0; j < n; ++j)
  {
    series(0, j) = 1.0;
    for (int m = 1; m <= last; ++m)
    {
      series(2 * m - 1, j) = std::cos(2.0 * Pi * m * j / n);
      series(2 * m, j) = std::sin(2.0 * Pi * m * j / n);
    }
  }
  return series;
}

Data MakeData(vtkBasisBRDF* input, const IncidentProblem& incident)
{
  Data data;
  data.Count = 6.0 * input->GetNumberOfTheta() * input->GetNumberOfPhi();
  for (std::size_t m = 0; m < incident.Values.size(); ++m)
  {
    data.Samples.push_back(incident.Values[m] * Compress(Gather(input, static_cast<int>(m))));
  }
  return data;
}

// The input's coefficients in harmonics of i, for every sample of o.
Table ExtendIncident(vtkBasisBRDF* input, const IncidentProblem& incident,
  const BasisFunctions& harmonics, double lambda)
{
  const int views = 3 * input->GetNumberOfTheta() * input->GetNumberOfPhi();
  Table half(harmonics.GetNumberOfFunctions(), input->GetNumberOfTheta(), input->GetNumberOfPhi());
  for (int m = 0; m < static_cast<int>(incident.Values.size()); ++m)
  {
    const Eigen::MatrixXd solve =
      MakeLeastSquares(harmonics, m, incident.Zone.Cosines, incident.Zone.Weights, lambda) *
      incident.Values[static_cast<std::size_t>(m)];
    const Eigen::MatrixXd c = solve * Gather(input, m);
    for (int l = m; l <= harmonics.GetOrder(); ++l)
    {
      for (int v = 0; v < views; ++v)
      {
        half.At(BasisFunctions::Index(l, m), 0, 0, v) = c(l - m, v);
        if (m > 0)
        {
          half.At(BasisFunctions::Index(l, -m), 0, 0, v) = c(l - m, views + v);
        }
      }
    }
  }
  return half;
}

// Coefficient (l, m) over all of o. It is a function of o whose azimuthal order is the isotropic
// form's m, or runs through a Fourier series.
void ExtendOutgoing(Table& half, int l, int m, const std::vector<Eigen::MatrixXd>& extensions,
  const Eigen::MatrixXd& series, Table& whole)
{
  const int k = BasisFunctions::Index(l, m);
  const int nPhi = half.NumberOfPhi;
  Eigen::MatrixXd samples(half.NumberOfTheta, nPhi);
  for (int c = 0; c < 3; ++c)
  {
    for (int t = 0; t < half.NumberOfTheta; ++t)
    {
      for (int p = 0; p < nPhi; ++p)
      {
        samples(t, p) = half.At(k, t, p, c);
      }
    }
    Eigen::MatrixXd spectrum = samples * series.transpose() / nPhi;
    Eigen::MatrixXd extended(NumberOfViews, spectrum.cols());
    for (Eigen::Index column = 0; column < spectrum.cols(); ++column)
    {
      const std::size_t azimuthal =
        static_cast<std::size_t>(nPhi == 1 ? std::abs(m) : (column + 1) / 2);
      extended.col(column) =
        (column > 0 ? 2.0 : 1.0) * (extensions[azimuthal] * spectrum.col(column));
    }
    const Eigen::MatrixXd values = extended * series;
    for (int t = 0; t < NumberOfViews; ++t)
    {
      for (int p = 0; p < nPhi; ++p)
      {
        whole.At(k, t, p, c) = values(t, p);
      }
    }
  }
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
  this->Abort = false;
  const int order = this->Order > 0 ? this->Order : std::max(input->GetOrder(), 1);
  const BasisFunctions harmonics(false, order, 1.0, -1.0);
  const int nPhi = input->GetNumberOfPhi();
  const std::string sizeProblem = vtkBasisBRDF::FindSizeProblem(order, NumberOfViews, nPhi);
  if (!sizeProblem.empty())
  {
    vtkErrorMacro("Extrapolate: " << sizeProblem << ".");
    return false;
  }

  const IncidentProblem incident(input, std::min(order, input->GetOrder()) + 1);
  if (this->Criterion != FIXED)
  {
    this->Lambda =
      ChooseLambda(this->Criterion, harmonics, incident.Zone, MakeData(input, incident));
  }
  Table half = ExtendIncident(input, incident, harmonics, this->Lambda);
  const std::vector<Eigen::MatrixXd> extensions = MakeExtensions(input, harmonics, this->Lambda);
  const Eigen::MatrixXd series = MakeSeries(order, nPhi);
  Table whole(harmonics.GetNumberOfFunctions(), NumberOfViews, nPhi);
  for (int l = 0; l <= order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      ExtendOutgoing(half, l, m, extensions, series, whole);
    }
    double progress = (l + 1.0) / (order + 1.0);
    this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
    if (this->Abort)
    {
      return false;
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
  this->InZoneResidual = vtkBRDFResampler::GetZoneRelativeL2Error(
    input, output, input->GetIncidentZone(), input->GetOutgoingZone(), 1 << 14);
  this->ResidualLimit = this->MaximumResidual > 0.0
                          ? this->MaximumResidual
                          : (input->GetBasis() == vtkBasisBRDF::ZONAL ? ZonalLimit : OtherLimit);
  this->NegativeMass = output->GetNegativeMass(hemisphere, hemisphere);
  this->Accepted =
    this->InZoneResidual <= this->ResidualLimit && this->NegativeMass <= this->MaximumNegativeMass;
  return this->Accepted;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBasisExtrapolator, Order, int, 0, vtkBasisBRDF::MaximumOrder);
measuredbrdfSetInRangeMacro(vtkBasisExtrapolator, Criterion, int, CROSS_VALIDATION, FIXED);
measuredbrdfSetClampedMacro(vtkBasisExtrapolator, Lambda, double, 0.0, 1e6);
measuredbrdfSetClampedMacro(vtkBasisExtrapolator, MaximumResidual, double, 0.0, 1e6);
measuredbrdfSetClampedMacro(vtkBasisExtrapolator, MaximumNegativeMass, double, 0.0, 1.0);

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
  os << indent << "ResidualLimit: " << this->ResidualLimit << "\n";
  os << indent << "InZoneResidual: " << this->InZoneResidual << "\n";
  os << indent << "MaximumNegativeMass: " << this->MaximumNegativeMass << "\n";
  os << indent << "NegativeMass: " << this->NegativeMass << "\n";
  os << indent << "Accepted: " << (this->Accepted ? "On" : "Off") << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
}
