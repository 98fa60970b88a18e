// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBasisProjector.h"

#include "BasisFunctions.h"
#include "HalfVector.h" // for angles
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "Setters.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBasisProjector);

namespace
{
constexpr int AzimuthNodes = 256;

// Everything that stays the same for all views.
struct Plan
{
  BasisFunctions Functions;
  std::vector<double> Cosines;            // of the nodes
  std::vector<Eigen::MatrixXd> Operators; // per m: samples at the nodes -> coefficients of l
  Eigen::MatrixXd Cosine, Sine;           // azimuths x m: Fourier coefficients by a product
};

Plan MakePlan(vtkBasisProjector* self)
{
  const int order = self->GetOrder();
  const int basis = self->GetBasis();
  const bool zonal = basis == vtkBasisBRDF::ZONAL || basis == vtkBasisBRDF::LEGENDRE_FOURIER;
  const double* zone = self->GetIncidentZone();
  const double near = zonal ? std::cos(ToRadians(zone[0])) : 1.0;
  const double far = zonal ? std::cos(ToRadians(zone[1])) : 0.0;
  Plan plan;
  plan.Functions = BasisFunctions(basis == vtkBasisBRDF::LEGENDRE_FOURIER, order, near,
    basis == vtkBasisBRDF::SPHERICAL_HARMONICS ? -1.0 : far);
  // The other bases' problems are well-posed: a penalty would only bias them.
  const double regularization =
    basis == vtkBasisBRDF::SPHERICAL_HARMONICS ? self->GetRegularization() : 0.0;
  const Quadrature rule = GaussLegendre(self->GetNumberOfNodes());
  std::vector<double> weights;
  for (std::size_t q = 0; q < rule.Nodes.size(); ++q)
  {
    const double cosine = far + 0.5 * (rule.Nodes[q] + 1.0) * (near - far);
    plan.Cosines.push_back(cosine);
    // Errors of f count by cos(theta_i), whether or not the samples carry it.
    weights.push_back(
      rule.Weights[q] * 0.5 * (near - far) * (self->GetIncidentCosine() ? 1.0 / cosine : cosine));
  }
  const Eigen::Map<const Eigen::VectorXd> plain(rule.Weights.data(), self->GetNumberOfNodes());
  for (int m = 0; m <= order; ++m)
  {
    if (self->GetMethod() == vtkBasisProjector::INNER_PRODUCT)
    {
      plan.Operators.push_back(MakeRadialMatrix(plan.Functions, m, plan.Cosines).transpose() *
                               (Pi * (near - far) * plain).asDiagonal());
    }
    else
    {
      plan.Operators.push_back(
        MakeLeastSquares(plan.Functions, m, plan.Cosines, weights, regularization));
    }
  }
  plan.Cosine.resize(AzimuthNodes, order + 1);
  plan.Sine.resize(AzimuthNodes, order + 1);
  for (int m = 0; m <= order; ++m)
  {
    // With these, sum_m a_m sqrt2 cos(m phi) + b_m sqrt2 sin(m phi), plain for m = 0, is the
    // series.
    const double scale = (m > 0 ? std::sqrt(2.0) : 1.0) / AzimuthNodes;
    for (int p = 0; p < AzimuthNodes; ++p)
    {
      plan.Cosine(p, m) = scale * std::cos(2.0 * Pi * m * p / AzimuthNodes);
      plan.Sine(p, m) = scale * std::sin(2.0 * Pi * m * p / AzimuthNodes);
    }
  }
  return plan;
}

// f towards o times its cosines, per channel: nodes x azimuths.
std::array<Eigen::MatrixXd, 3> SampleView(
  vtkBasisProjector* self, const Plan& plan, const glm::dvec3& o)
{
  std::array<Eigen::MatrixXd, 3> samples;
  for (Eigen::MatrixXd& channel : samples)
  {
    channel.resize(static_cast<Eigen::Index>(plan.Cosines.size()), AzimuthNodes);
  }
  for (std::size_t q = 0; q < plan.Cosines.size(); ++q)
  {
    const double cosine = plan.Cosines[q];
    const double factor =
      (self->GetIncidentCosine() ? cosine : 1.0) * (self->GetOutgoingCosine() ? o.z : 1.0);
    for (int a = 0; a < AzimuthNodes; ++a)
    {
      const glm::dvec3 i = ToDirection(cosine, 2.0 * Pi * a / AzimuthNodes);
      double f[3];
      self->GetInput()->Evaluate(&i.x, &o.x, f);
      for (std::size_t c = 0; c < 3; ++c)
      {
        samples[c](static_cast<Eigen::Index>(q), a) = factor * f[c];
      }
    }
  }
  return samples;
}

// Stores the coefficients of view number `view` of `views`.
void ProjectView(const Plan& plan, const std::array<Eigen::MatrixXd, 3>& samples, std::size_t view,
  std::size_t views, std::vector<float>& coefficients)
{
  const int order = plan.Functions.GetOrder();
  for (std::size_t c = 0; c < 3; ++c)
  {
    const Eigen::MatrixXd even = samples[c] * plan.Cosine;
    const Eigen::MatrixXd odd = samples[c] * plan.Sine;
    for (int m = 0; m <= order; ++m)
    {
      const Eigen::MatrixXd& solve = plan.Operators[static_cast<std::size_t>(m)];
      const Eigen::VectorXd a = solve * even.col(m);
      const Eigen::VectorXd b = solve * odd.col(m);
      for (int l = m; l <= order; ++l)
      {
        const auto store = [&](int k, double value) {
          coefficients[3 * (static_cast<std::size_t>(k) * views + view) + c] =
            static_cast<float>(value);
        };
        store(BasisFunctions::Index(l, m), a(l - m));
        if (m > 0)
        {
          store(BasisFunctions::Index(l, -m), b(l - m));
        }
      }
    }
  }
}
}

//------------------------------------------------------------------------------
void vtkBasisProjector::SetInput(vtkBRDF* input) { measuredbrdfAssignMacro(Input, input); }

//------------------------------------------------------------------------------
bool vtkBasisProjector::Project()
{
  const int nTheta = this->NumberOfTheta;
  const int nPhi = !this->Input || this->Input->IsIsotropic() ? 1 : this->NumberOfPhi;
  const std::string refusal = !this->Input ? "no input"
                              : this->NumberOfNodes <= this->Order
                                ? std::to_string(this->NumberOfNodes) +
                                    " nodes, expected more than the order, " +
                                    std::to_string(this->Order)
                                : vtkBasisBRDF::FindSizeProblem(this->Order, nTheta, nPhi);
  if (!refusal.empty())
  {
    vtkErrorMacro("Project: " << refusal << ".");
    return false;
  }
  const Plan plan = MakePlan(this);
  const int functions = plan.Functions.GetNumberOfFunctions();
  std::vector<float> coefficients(3 * static_cast<std::size_t>(functions) *
                                  static_cast<std::size_t>(nTheta) *
                                  static_cast<std::size_t>(nPhi));
  this->Input->Prepare();
  this->Abort = false;
  const int views = nTheta * nPhi;
  const auto projectView = [&](int view)
  {
    const double theta =
      ToRadians(this->OutgoingZone[0] +
                (this->OutgoingZone[1] - this->OutgoingZone[0]) * (view / nPhi) / (nTheta - 1.0));
    // f has no value at the horizon, where views are shaded as just above it.
    const glm::dvec3 o = LiftView(ToDirection(std::cos(theta), 2.0 * Pi * (view % nPhi) / nPhi));
    ProjectView(plan, SampleView(this, plan, o), static_cast<std::size_t>(view),
      static_cast<std::size_t>(views), coefficients);
  };
  // In batches, so that progress and interruption happen on this thread.
  constexpr int batch = 16;
  for (int first = 0; first < views; first += batch)
  {
    ParallelForEach(
      std::min(batch, views - first), [&](int k) { projectView(first + k); }, nullptr, 0);
    double progress = std::min(first + batch, views) / static_cast<double>(views);
    this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
    if (this->Abort)
    {
      return false;
    }
  }
  const auto output = vtkSmartPointer<vtkBasisBRDF>::New();
  const std::string problem = output->SetCoefficients(this->Basis, this->Order, this->IncidentZone,
    this->OutgoingZone, nTheta, nPhi, std::move(coefficients));
  if (!problem.empty()) // a BRDF of enormous values, whose coefficients overflow
  {
    vtkErrorMacro("Project: " << problem << ".");
    return false;
  }
  output->SetIncidentCosine(this->IncidentCosine);
  output->SetOutgoingCosine(this->OutgoingCosine);
  output->SetName(this->Input->GetName());
  output->SetSource(this->Input->GetSource());
  this->Output = output;
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(
  vtkBasisProjector, Basis, int, vtkBasisBRDF::SPHERICAL_HARMONICS, vtkBasisBRDF::LEGENDRE_FOURIER);
measuredbrdfSetInRangeMacro(vtkBasisProjector, Method, int, LEAST_SQUARES, INNER_PRODUCT);
measuredbrdfSetClampedMacro(vtkBasisProjector, Regularization, double, 0.0, 1.0);
measuredbrdfSetClampedMacro(vtkBasisProjector, NumberOfTheta, int, 2, 1024);
measuredbrdfSetClampedMacro(vtkBasisProjector, NumberOfPhi, int, 4, 1024);
measuredbrdfSetClampedMacro(vtkBasisProjector, NumberOfNodes, int, 8, 1024);
measuredbrdfSetChecked2Macro(vtkBasisProjector, IncidentZone, vtkBasisBRDF::FindZoneProblem);
measuredbrdfSetChecked2Macro(vtkBasisProjector, OutgoingZone, vtkBasisBRDF::FindZoneProblem);
measuredbrdfSetInRangeMacro(vtkBasisProjector, Order, int, 1, vtkBasisBRDF::MaximumOrder);

//------------------------------------------------------------------------------
void vtkBasisProjector::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Input: " << this->Input.Get() << "\n";
  os << indent << "Output: " << this->Output.Get() << "\n";
  os << indent << "Basis: " << vtkBasisBRDF::GetBasisName(this->Basis) << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "IncidentZone: " << this->IncidentZone[0] << " " << this->IncidentZone[1] << "\n";
  os << indent << "OutgoingZone: " << this->OutgoingZone[0] << " " << this->OutgoingZone[1] << "\n";
  os << indent << "IncidentCosine: " << (this->IncidentCosine ? "On" : "Off") << "\n";
  os << indent << "OutgoingCosine: " << (this->OutgoingCosine ? "On" : "Off") << "\n";
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "Regularization: " << this->Regularization << "\n";
  os << indent << "NumberOfTheta: " << this->NumberOfTheta << "\n";
  os << indent << "NumberOfPhi: " << this->NumberOfPhi << "\n";
  os << indent << "NumberOfNodes: " << this->NumberOfNodes << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
}
