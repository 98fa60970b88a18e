// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBasisBRDF.h"

#include "BasisFunctions.h"
#include "HalfVector.h" // for angles
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ModuleShader.h"
#include "Neighbors.h"
#include "NumberText.h"
#include "Refusal.h"
#include "Setters.h"
#include "vtkBRDFBasis.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBasisBRDF);

namespace
{
constexpr double MinimumCosine = 0.01; // that a sum is divided by; the shader has the same

bool IsBasis(int basis)
{
  return basis >= vtkBasisBRDF::SPHERICAL_HARMONICS && basis <= vtkBasisBRDF::LEGENDRE_FOURIER;
}

bool HasZone(int basis)
{
  return basis == vtkBasisBRDF::ZONAL || basis == vtkBasisBRDF::LEGENDRE_FOURIER;
}

BasisFunctions MakeFunctions(int basis, int order, const double zone[2])
{
  return HasZone(basis) ? BasisFunctions(basis == vtkBasisBRDF::LEGENDRE_FOURIER, order,
                            std::cos(ToRadians(zone[0])), std::cos(ToRadians(zone[1])))
                        : BasisFunctions(false, order, 1.0,
                            basis == vtkBasisBRDF::SPHERICAL_HARMONICS ? -1.0 : 0.0);
}

double GetTurn(double y, double x) { return std::atan2(y, x) / (2.0 * Pi); }

constexpr int LargestSide = 256; // of the basis table
constexpr int MostFunctions = (vtkBasisBRDF::MaximumOrder + 1) * (vtkBasisBRDF::MaximumOrder + 1);

// On the stack: one for each evaluation.
using BasisValues = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, MostFunctions, 1>;
using FloatRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Samples at u = k / (n-1).
Neighbors OnAxis(double u, int n)
{
  const double x = std::clamp(u, 0.0, 1.0) * (n - 1);
  const int first = std::min(static_cast<int>(x), n - 2);
  return { first, first + 1, x - first };
}

// Samples at u = k / n, periodic.
Neighbors OnCircle(double u, int n)
{
  const double x = (u - std::floor(u)) * n;
  const int first = static_cast<int>(x) % n;
  return { first, (first + 1) % n, x - std::floor(x) };
}

// The weighted mean of at(first), at(second).
template <typename At>
auto Mix(const Neighbors& n, const At& at)
{
  const auto first = at(n.First);
  return n.Weight > 0.0 ? ((1.0 - n.Weight) * first + n.Weight * at(n.Second)).eval() : first;
}
}

//------------------------------------------------------------------------------
// Values of all basis functions at equal steps of acos(x) and of the azimuth, and the coefficients.
struct vtkBasisBRDF::Tables
{
  explicit Tables(vtkBasisBRDF* brdf)
    : Functions(MakeFunctions(brdf->Basis, brdf->Order, brdf->IncidentZone))
    , GammaRange(brdf->Basis == SPHERICAL_HARMONICS ? 0.5 * Pi : Pi)
    , Tolerance(brdf->ResamplingTolerance)
    , Cosines{ brdf->IncidentCosine, brdf->OutgoingCosine }
  {
    const int n = this->Functions.GetNumberOfFunctions();
    this->Coefficients = Eigen::Map<const FloatRows>(
      brdf->Coefficients.data(), n, static_cast<Eigen::Index>(brdf->Coefficients.size()) / n);
    // Linear interpolation of cos(m t) at steps h has an RMS error of 0.09 (m h)^2, per axis.
    const double step =
      std::sqrt(this->Tolerance / 0.18) / std::max(static_cast<double>(brdf->Order), 1.0);
    const auto getSamples = [step](double range)
    { return std::clamp(static_cast<int>(std::ceil(range / step)), 1, LargestSide - 1) + 1; };
    this->NumberOfGamma = getSamples(this->GammaRange);
    this->NumberOfPhi = brdf->Order == 0 ? 1 : getSamples(2.0 * Pi);
    this->Basis.resize(n, this->NumberOfGamma * this->NumberOfPhi);
    for (int light = 0; light < this->Basis.cols(); ++light)
    {
      const double gamma =
        this->GammaRange * (light / this->NumberOfPhi) / (this->NumberOfGamma - 1.0);
      this->Basis.col(light) =
        this
          ->Evaluate(
            std::cos(gamma), static_cast<double>(light % this->NumberOfPhi) / this->NumberOfPhi)
          .cast<float>();
    }
  }

  BasisValues Evaluate(double x, double turn) const
  {
    BasisValues values(this->Functions.GetNumberOfFunctions());
    this->Functions.Evaluate(this->Functions.ToCosine(x), 2.0 * Pi * turn, values.data());
    return values;
  }

  BasisValues Interpolate(double x, double turn) const
  {
    const Neighbors gamma = OnAxis(std::acos(x) / this->GammaRange, this->NumberOfGamma);
    const Neighbors phi = OnCircle(turn, this->NumberOfPhi);
    const auto at = [this](int g, int p)
    { return this->Basis.col(g * this->NumberOfPhi + p).cast<double>(); };
    return (1.0 - gamma.Weight) * ((1.0 - phi.Weight) * at(gamma.First, phi.First) +
                                    phi.Weight * at(gamma.First, phi.Second)) +
           gamma.Weight * ((1.0 - phi.Weight) * at(gamma.Second, phi.First) +
                            phi.Weight * at(gamma.Second, phi.Second));
  }

  // The sum of basis functions with the coefficients of one sample of o. The channels side by side:
  // each waits for its own sums only.
  Eigen::Vector3d Sum(int view, const BasisValues& values) const
  {
    const Eigen::Index n = values.size();
    const float* own = this->Coefficients.data() + 3 * view * n;
    double red = 0.0, green = 0.0, blue = 0.0;
    for (Eigen::Index k = 0; k < n; ++k)
    {
      red += values[k] * own[k];
      green += values[k] * own[n + k];
      blue += values[k] * own[2 * n + k];
    }
    return { red, green, blue };
  }

  // interpolation: relative L2 error of the sums by the basis table's steps, directions weighted by
  // the cosine. amplification: how much independent rounding errors of the stored values grow in
  // the sum, sqrt(sum (C_k B_k)^2) / |sum C_k B_k|, RMS.
  void Measure(double& interpolation, double& amplification) const
  {
    const int views = static_cast<int>(this->Coefficients.cols() / 3);
    double difference = 0.0, absolute = 0.0, plain = 0.0;
    for (std::uint32_t sample = 1; sample <= 2000; ++sample)
    {
      const int view = static_cast<int>(RadicalInverse(sample, 2) * views);
      const double x = this->Functions.ToX(std::sqrt(RadicalInverse(sample, 3)));
      const double turn = RadicalInverse(sample, 5);
      const BasisValues exact = this->Evaluate(x, turn);
      plain += this->Sum(view, exact).squaredNorm();
      difference += this->Sum(view, this->Interpolate(x, turn) - exact).squaredNorm();
      absolute += (exact.asDiagonal() * this->Coefficients.middleCols<3>(3 * view).cast<double>())
                    .squaredNorm();
    }
    interpolation = plain > 0.0 ? std::sqrt(difference / plain) : 0.0;
    amplification = plain > 0.0 ? std::sqrt(absolute / plain) : 1.0;
  }

  BasisFunctions Functions;
  double GammaRange; // acos(x) at the last row
  double Tolerance;  // relative error of the interpolated sums, which sets the steps
  bool Cosines[2];
  int NumberOfGamma;
  int NumberOfPhi;
  Eigen::MatrixXf Basis;        // functions x (gamma, phi)
  Eigen::MatrixXf Coefficients; // functions x (theta_o, phi_o, channel)
};

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBasisBRDF, ResamplingError, double, 0.0, 1e6);

//------------------------------------------------------------------------------
std::string vtkBasisBRDF::FindZoneProblem(const double zone[2])
{
  if (zone[0] >= 0.0 && zone[0] <= MaximumZoneBegin && zone[0] + MinimumZoneWidth <= zone[1] &&
      zone[1] <= 90.0)
  {
    return "";
  }
  TextStream text;
  text << "zone " << zone[0] << " to " << zone[1]
       << " degrees, expected 0 <= begin <= " << static_cast<double>(MaximumZoneBegin)
       << ", end <= 90 and at least " << static_cast<double>(MinimumZoneWidth) << " between";
  return text.str();
}

//------------------------------------------------------------------------------
std::string vtkBasisBRDF::FindSizeProblem(int order, int nTheta, int nPhi)
{
  const int most = MaximumNumberOfValues, mostOrder = MaximumOrder; // no references to constants
  if (order < 0 || order > mostOrder)
  {
    return "order " + std::to_string(order) + ", expected 0 to " + std::to_string(mostOrder);
  }
  const std::string samples =
    std::to_string(nTheta) + " x " + std::to_string(nPhi) + " samples of o";
  if (nTheta < 2 || nTheta > 1024 || nPhi < 1 || nPhi > 1024)
  {
    return samples + ", expected 2 to 1024 x 1 to 1024";
  }
  const std::int64_t functions = (order + 1) * (order + 1);
  const std::int64_t values = 3 * functions * nTheta * nPhi;
  return values <= most
           ? ""
           : std::to_string(functions) + " functions x " + samples + " are " +
               std::to_string(values) + " coefficients, expected at most " + std::to_string(most);
}

//------------------------------------------------------------------------------
std::string vtkBasisBRDF::SetCoefficients(int basis, int order, const double incidentZone[2],
  const double outgoingZone[2], int nTheta, int nPhi, std::vector<float> rgb)
{
  const double hemisphere[2] = { 0.0, 90.0 };
  const double* incident = HasZone(basis) ? incidentZone : hemisphere;
  const std::string problem = FindProblemOf(
    [&]()
    {
      Require(IsBasis(basis), "basis " + std::to_string(basis) + " is unknown");
      for (const std::string& each : { FindSizeProblem(order, nTheta, nPhi),
             FindZoneProblem(incident), FindZoneProblem(outgoingZone) })
      {
        Require(each.empty(), each);
      }
      const int count = 3 * (order + 1) * (order + 1) * nTheta * nPhi;
      Require(rgb.size() == static_cast<std::size_t>(count),
        std::to_string(rgb.size()) + " coefficients, expected " + std::to_string(count));
      Require(std::all_of(rgb.begin(), rgb.end(), [](float v) { return std::isfinite(v); }),
        "a coefficient is NaN or infinite");
    });
  if (problem.empty())
  {
    this->Basis = basis;
    this->Order = order;
    std::copy_n(incident, 2, this->IncidentZone);
    std::copy_n(outgoingZone, 2, this->OutgoingZone);
    this->NumberOfTheta = nTheta;
    this->NumberOfPhi = nPhi;
    this->Coefficients = std::move(rgb);
    this->Cached.reset();
    this->Modified();
  }
  return problem;
}

//------------------------------------------------------------------------------
std::string vtkBasisBRDF::GetBasisName(int basis)
{
  static const char* const names[] = { "spherical harmonics", "hemispherical", "zonal",
    "Legendre x Fourier" };
  return IsBasis(basis) ? names[basis] : "unknown";
}

//------------------------------------------------------------------------------
std::vector<double> vtkBasisBRDF::EvaluateBasis(
  int basis, int order, const double zone[2], const double direction[3])
{
  if (!IsBasis(basis) || order < 0 || order > MaximumOrder ||
      (HasZone(basis) && !FindZoneProblem(zone).empty()))
  {
    return {};
  }
  const BasisFunctions functions = MakeFunctions(basis, order, zone);
  std::vector<double> values(static_cast<std::size_t>(functions.GetNumberOfFunctions()));
  functions.Evaluate(direction[2], std::atan2(direction[1], direction[0]), values.data());
  return values;
}

//------------------------------------------------------------------------------
const vtkBasisBRDF::Tables& vtkBasisBRDF::GetTables()
{
  const bool current = this->Cached && this->Cached->Tolerance == this->ResamplingTolerance &&
                       this->Cached->Cosines[0] == this->IncidentCosine &&
                       this->Cached->Cosines[1] == this->OutgoingCosine;
  if (!current)
  {
    this->ResetLobe();
    this->Cached = std::make_shared<const Tables>(this);
  }
  return *this->Cached;
}

//------------------------------------------------------------------------------
void vtkBasisBRDF::EvaluateSigned(const double i[3], const double o[3], double f[3])
{
  f[0] = f[1] = f[2] = 0.0;
  double iUnit[3], oUnit[3];
  if (ToUpperUnit(i, iUnit) && ToUpperUnit(o, oUnit))
  {
    this->Sum(iUnit, oUnit, f);
  }
}

//------------------------------------------------------------------------------
void vtkBasisBRDF::Sum(const double i[3], const double o[3], double f[3])
{
  f[0] = f[1] = f[2] = 0.0;
  if (this->Coefficients.empty())
  {
    return;
  }
  const Tables& tables = this->GetTables();
  const bool isotropic = this->NumberOfPhi == 1;
  const double x = tables.Functions.ToX(i[2]);
  const double turn =
    isotropic ? GetTurn(o[0] * i[1] - o[1] * i[0], i[0] * o[0] + i[1] * o[1]) : GetTurn(i[1], i[0]);
  const BasisValues values = tables.Interpolate(x, turn);
  const double begin = ToRadians(this->OutgoingZone[0]);
  const double end = ToRadians(this->OutgoingZone[1]);
  const double thetaO = std::atan2(std::hypot(o[0], o[1]), o[2]);
  const Neighbors phi = OnCircle(isotropic ? 0.0 : GetTurn(o[1], o[0]), this->NumberOfPhi);
  const Eigen::Vector3d sum = Mix(OnAxis((thetaO - begin) / (end - begin), this->NumberOfTheta),
    [&](int theta) -> Eigen::Vector3d
    { return Mix(phi, [&](int p) { return tables.Sum(theta * this->NumberOfPhi + p, values); }); });
  double divisor = 1.0;
  if (this->IncidentCosine)
  {
    const double far = this->Basis == SPHERICAL_HARMONICS ? 0.0 : tables.Functions.GetFar();
    divisor *= std::max(std::clamp(i[2], far, tables.Functions.GetNear()), MinimumCosine);
  }
  if (this->OutgoingCosine)
  {
    divisor *= std::max(std::clamp(o[2], std::cos(end), std::cos(begin)), MinimumCosine);
  }
  Eigen::Map<Eigen::Vector3d> result(f);
  result = sum / divisor;
}

//------------------------------------------------------------------------------
double vtkBasisBRDF::GetNegativeMass(const double incident[2], const double outgoing[2], int pairs)
{
  if (!FindZoneProblem(incident).empty() || !FindZoneProblem(outgoing).empty())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return measuredbrdf::GetNegativeMass(incident, outgoing, pairs,
    [this](const double i[3], const double o[3], double f[3]) { this->EvaluateSigned(i, o, f); });
}

//------------------------------------------------------------------------------
void vtkBasisBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  this->Sum(i, o, f);
}

//------------------------------------------------------------------------------
void vtkBasisBRDF::Prepare()
{
  if (this->Coefficients.empty())
  {
    return;
  }
  this->GetTables(); // new ones need a new lobe
  if (!this->HasLobe())
  {
    this->SetLobe(45, 1, 0.5);
  }
}

//------------------------------------------------------------------------------
void vtkBasisBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  if (this->Coefficients.empty())
  {
    return;
  }
  const Tables& tables = this->GetTables();
  const int n = this->GetNumberOfFunctions();
  // Large terms that cancel (extrapolated harmonics) need 32 bits.
  double interpolation = 0.0;
  double amplification = 1.0;
  tables.Measure(interpolation, amplification);
  const bool halfFloat = 4.0 * HalfRounding * amplification <= this->ResamplingTolerance;

  vtkBRDFShaderInputs::Texture coefficients;
  coefficients.Name = "brdfCoefficients";
  coefficients.ThreeD = true;
  coefficients.Dimensions = { this->NumberOfPhi, this->NumberOfTheta, n };
  coefficients.Repeat = { true, false, false };
  coefficients.HalfFloat = halfFloat;
  const float scale = halfFloat ? GetPeakScale(this->Coefficients) : 1.0f;
  for (const float coefficient : this->Coefficients)
  {
    coefficients.Data.push_back(coefficient * scale);
  }
  vtkBRDFShaderInputs::Texture basis;
  basis.Name = "brdfBasis";
  basis.ThreeD = true;
  basis.Components = 1;
  basis.Dimensions = { tables.NumberOfPhi, tables.NumberOfGamma, n };
  basis.Repeat = { true, false, false };
  basis.HalfFloat = halfFloat;
  basis.Data.resize(tables.Basis.size());
  Eigen::Map<FloatRows>(basis.Data.data(), n, tables.Basis.cols()) = tables.Basis;

  vtkBRDFShaderInputs::Term term;
  SetModuleShader(term, "vtkBRDFBasis", vtkBRDFBasis);
  term.Constants.push_back({ "BRDF_BASIS_FUNCTIONS", std::to_string(n) });
  const auto add = [&term](const char* name, std::initializer_list<double> values) {
    term.Uniforms.push_back({ name, std::vector<float>(values.begin(), values.end()) });
  };
  const double begin = ToRadians(this->OutgoingZone[0]);
  const double end = ToRadians(this->OutgoingZone[1]);
  add("brdfScale", { 1.0f / scale });
  add("brdfIsotropic", { this->NumberOfPhi == 1 ? 1.0 : 0.0 });
  // The basis's domain: its near cosine, the square of that angle's sine, and the way to the far
  // cosine; acos(x) in the table in right angles, halved.
  const double near = tables.Functions.GetNear();
  add("brdfIncidentZone", { near, 1.0 - near * near, near - tables.Functions.GetFar() });
  add("brdfGammaRange", { tables.GammaRange / Pi });
  // In right angles, and the two cosines.
  add("brdfOutgoingZone", { begin * 2.0 / Pi, 1.0 / ((end - begin) * 2.0 / Pi), 0.0 });
  // Limits of the cosines that the sum is divided by; both 1: it carries none.
  const double far = this->Basis == SPHERICAL_HARMONICS ? 0.0 : tables.Functions.GetFar();
  const auto addLimits = [&add](const char* name, bool carried, double low, double high)
  {
    add(name, { carried ? std::max(low, MinimumCosine) : 1.0,
                carried ? std::max(high, MinimumCosine) : 1.0, 0.0 });
  };
  addLimits("brdfIncidentCosine", this->IncidentCosine, far, near);
  addLimits("brdfOutgoingCosine", this->OutgoingCosine, std::cos(end), std::cos(begin));

  TextStream text;
  text << GetBasisName(this->Basis) << " basis of order " << this->Order << " (" << n
       << " functions), coefficients " << this->NumberOfPhi << " x " << this->NumberOfTheta
       << ", basis values " << tables.NumberOfPhi << " x " << tables.NumberOfGamma << ", "
       << (halfFloat ? "16" : "32") << "-bit float, " << coefficients.GetBytes() + basis.GetBytes()
       << " bytes";
  term.Textures = { std::move(coefficients), std::move(basis) };
  term.Fetches = 2 * n; // of a pixel's first light; the coefficients stay
  inputs.QuantizationError =
    std::max(inputs.QuantizationError, amplification * (halfFloat ? HalfRounding : FloatRounding));
  inputs.ResamplingError =
    std::max(inputs.ResamplingError, std::hypot(this->ResamplingError, interpolation));
  inputs.Description = text.str();
  inputs.Terms.push_back(std::move(term));
}

//------------------------------------------------------------------------------
void vtkBasisBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  exchange.Flag(
    "incidentCosine", this->IncidentCosine, [this](bool on) { this->SetIncidentCosine(on); });
  exchange.Flag(
    "outgoingCosine", this->OutgoingCosine, [this](bool on) { this->SetOutgoingCosine(on); });
  exchange.Number("resamplingError", this->ResamplingError,
    [this](double value) { this->SetResamplingError(value); });
  int basis = this->Basis;
  exchange.Option("basis", { "spherical-harmonics", "hemispherical", "zonal", "legendre-fourier" },
    basis, [&](int value) { basis = value; });
  double order = this->Order, incident[2], outgoing[2];
  std::copy_n(this->IncidentZone, 2, incident);
  std::copy_n(this->OutgoingZone, 2, outgoing);
  const auto exchangeNumber = [&exchange](const char* name, double& number)
  { exchange.Number(name, number, [&number](double value) { number = value; }); };
  exchangeNumber("order", order);
  exchangeNumber("incidentBegin", incident[0]);
  exchangeNumber("incidentEnd", incident[1]);
  exchangeNumber("outgoingBegin", outgoing[0]);
  exchangeNumber("outgoingEnd", outgoing[1]);
  if (!exchange.IsLoading())
  {
    exchange.SaveArray("coefficients",
      { this->GetNumberOfFunctions(), this->NumberOfTheta, this->NumberOfPhi }, 3,
      this->Coefficients);
    return;
  }
  auto coefficients = exchange.LoadArray("coefficients", 3, 3);
  const int functions = coefficients.Shape[0];
  if (order < 0.0 || std::pow(order + 1.0, 2.0) != functions)
  {
    TextStream text;
    text << "number 'order' is " << order << ", expected that of " << functions << " functions";
    exchange.Fail(text.str());
  }
  exchange.Check(this->SetCoefficients(basis, static_cast<int>(order), incident, outgoing,
    coefficients.Shape[1], coefficients.Shape[2], std::move(coefficients.Values)));
}

//------------------------------------------------------------------------------
vtkBRDF* vtkBasisBRDF::NewCopy()
{
  vtkBasisBRDF* copy = vtkBasisBRDF::New();
  copy->Basis = this->Basis;
  copy->Order = this->Order;
  std::copy_n(this->IncidentZone, 2, copy->IncidentZone);
  std::copy_n(this->OutgoingZone, 2, copy->OutgoingZone);
  copy->NumberOfTheta = this->NumberOfTheta;
  copy->NumberOfPhi = this->NumberOfPhi;
  copy->Coefficients = this->Coefficients;
  copy->IncidentCosine = this->IncidentCosine;
  copy->OutgoingCosine = this->OutgoingCosine;
  copy->ResamplingError = this->ResamplingError;
  return copy;
}
