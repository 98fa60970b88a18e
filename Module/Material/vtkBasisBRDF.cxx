// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBasisBRDF.h"

#include "BasisFunctions.h"
#include "ContentHash.h"
#include "HalfVector.h" // for angles
#include "HalfVectorSampler.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ModuleShader.h"
#include "NumberText.h"
#include "Setters.h"
#include "vtkBRDFBasis.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace measuredbrdf
{
/// Two neighboring samples of an axis and the weight of the second.
struct Interval
{
  int First;
  int Second;
  double Weight;
};

/// Samples at u = k / (n-1).
inline Interval OnAxis(double u, int n)
{
  const double x = std::clamp(u, 0.0, 1.0) * (n - 1);
  const int first = std::min(static_cast<int>(x), n - 2);
  return { first, first + 1, x - first };
}

/// Samples at u = k / n, periodic.
inline Interval OnCircle(double u, int n)
{
  const double x = (u - std::floor(u)) * n;
  const int first = static_cast<int>(x) % n;
  return { first, (first + 1) % n, x - std::floor(x) };
}

/// Four neighbors in the basis table and their weights.
struct BasisCorners
{
  const float* Rows[4];
  double Weights[4];

  double Interpolate(std::size_t k) const
  {
    return this->Weights[0] * this->Rows[0][k] + this->Weights[1] * this->Rows[1][k] +
           this->Weights[2] * this->Rows[2][k] + this->Weights[3] * this->Rows[3][k];
  }
};

/// Values of all basis functions at equal steps of acos(x) and of the azimuth, and coefficients,
/// both with k fastest.
struct BasisTables
{
  /**
   * gammaRange: acos(x) at the last row. tolerance: relative error of the interpolated sums, which
   * sets the steps. coefficients: RGB triples, k slowest, as vtkBasisBRDF holds them.
   */
  BasisTables(const BasisFunctions& functions, double gammaRange, double tolerance,
    const std::vector<float>& coefficients);

  BasisCorners GetCorners(double x, double turn) const
  {
    const Interval g = OnAxis(std::acos(x) / this->GammaRange, this->NumberOfGamma);
    const Interval p = OnCircle(turn, this->NumberOfPhi);
    const auto row = [this](int gamma, int phi)
    {
      const std::size_t k =
        static_cast<std::size_t>(gamma) * static_cast<std::size_t>(this->NumberOfPhi) +
        static_cast<std::size_t>(phi);
      return &this->Basis[k * static_cast<std::size_t>(this->Functions.GetNumberOfFunctions())];
    };
    return { { row(g.First, p.First), row(g.First, p.Second), row(g.Second, p.First),
               row(g.Second, p.Second) },
      { (1.0 - g.Weight) * (1.0 - p.Weight), (1.0 - g.Weight) * p.Weight,
        g.Weight * (1.0 - p.Weight), g.Weight * p.Weight } };
  }

  /// Adds weight times the sum of basis functions with the coefficients of one sample of o.
  void AddView(int view, const BasisCorners& corners, double weight, double f[3]) const;

  /**
   * interpolation: relative L2 error of the sums by the basis table's steps, directions weighted by
   * the cosine. amplification: how much independent rounding errors of the stored values grow in
   * the sum, sqrt(sum (C_k B_k)^2) / |sum C_k B_k|, RMS.
   */
  void Measure(double& interpolation, double& amplification) const;

  /// Upper bounds of what the sums are, over a divisor: sum |C_k| max |B_k|.
  void GetBounds(double divisor, double upper[3]) const;

  /// The basis values for a shader, k slowest.
  vtkBRDFShaderInputs::Texture MakeTexture(bool halfFloat) const;

  BasisFunctions Functions;
  double GammaRange;
  int NumberOfGamma;
  int NumberOfPhi;
  std::vector<float> Basis;        // [gamma][phi][k]
  std::vector<float> Coefficients; // [theta_o][phi_o][channel][k]
};

/// Coefficients as vtkBasisBRDF holds them for a shader, times `scale`, which uses the range of
/// 16-bit floats.
vtkBRDFShaderInputs::Texture MakeCoefficientTexture(
  const std::vector<float>& coefficients, int nPhi, int nTheta, bool halfFloat, float& scale);

namespace
{
constexpr int LargestSide = 256; // of the basis table
}

//------------------------------------------------------------------------------
BasisTables::BasisTables(const BasisFunctions& functions, double gammaRange, double tolerance,
  const std::vector<float>& coefficients)
  : Functions(functions)
  , GammaRange(gammaRange)
{
  // Linear interpolation of cos(m t) at steps h has an RMS error of 0.09 (m h)^2, per axis.
  const double step =
    std::sqrt(tolerance / 0.18) / std::max(static_cast<double>(functions.GetOrder()), 1.0);
  const auto getSamples = [step](double range)
  { return std::clamp(static_cast<int>(std::ceil(range / step)), 1, LargestSide - 1) + 1; };
  this->NumberOfGamma = getSamples(gammaRange);
  this->NumberOfPhi = functions.GetOrder() == 0 ? 1 : getSamples(2.0 * Pi);
  const std::size_t count = static_cast<std::size_t>(functions.GetNumberOfFunctions());
  std::vector<double> values(count);
  for (int g = 0; g < this->NumberOfGamma; ++g)
  {
    const double gamma = gammaRange * g / (this->NumberOfGamma - 1.0);
    const double cosine = functions.ToCosine(std::cos(gamma));
    for (int p = 0; p < this->NumberOfPhi; ++p)
    {
      functions.Evaluate(cosine, 2.0 * Pi * p / this->NumberOfPhi, values.data());
      this->Basis.insert(this->Basis.end(), values.begin(), values.end());
    }
  }
  const std::size_t views = coefficients.size() / (3 * count);
  this->Coefficients.resize(coefficients.size());
  for (std::size_t k = 0; k < count; ++k)
  {
    for (std::size_t v = 0; v < views; ++v)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        this->Coefficients[(3 * v + c) * count + k] = coefficients[3 * (k * views + v) + c];
      }
    }
  }
}

//------------------------------------------------------------------------------
void BasisTables::AddView(int view, const BasisCorners& corners, double weight, double f[3]) const
{
  const std::size_t n = static_cast<std::size_t>(this->Functions.GetNumberOfFunctions());
  const float* r = &this->Coefficients[3 * static_cast<std::size_t>(view) * n];
  double sum[3] = { 0.0, 0.0, 0.0 };
  for (std::size_t k = 0; k < n; ++k)
  {
    const double b = corners.Interpolate(k);
    sum[0] += b * r[k];
    sum[1] += b * r[n + k];
    sum[2] += b * r[2 * n + k];
  }
  for (int c = 0; c < 3; ++c)
  {
    f[c] += weight * sum[c];
  }
}

//------------------------------------------------------------------------------
void BasisTables::Measure(double& interpolation, double& amplification) const
{
  const std::size_t n = static_cast<std::size_t>(this->Functions.GetNumberOfFunctions());
  const std::size_t views = this->Coefficients.size() / (3 * n);
  std::vector<double> exact(n);
  double difference = 0.0;
  double absolute = 0.0;
  double plain = 0.0;
  for (std::uint32_t sample = 1; sample <= 2000; ++sample)
  {
    const std::size_t view = static_cast<std::size_t>(RadicalInverse(sample, 2) * views);
    const double cosine = std::sqrt(RadicalInverse(sample, 3));
    const double turn = RadicalInverse(sample, 5);
    const double x = this->Functions.ToX(cosine);
    this->Functions.Evaluate(this->Functions.ToCosine(x), 2.0 * Pi * turn, exact.data());
    const BasisCorners corners = this->GetCorners(x, turn);
    for (std::size_t c = 0; c < 3; ++c)
    {
      double sum = 0.0;
      double error = 0.0;
      double magnitude = 0.0;
      for (std::size_t k = 0; k < n; ++k)
      {
        const double coefficient = this->Coefficients[(3 * view + c) * n + k];
        sum += coefficient * exact[k];
        error += coefficient * (corners.Interpolate(k) - exact[k]);
        magnitude += coefficient * exact[k] * coefficient * exact[k];
      }
      plain += sum * sum;
      difference += error * error;
      absolute += magnitude;
    }
  }
  interpolation = plain > 0.0 ? std::sqrt(difference / plain) : 0.0;
  amplification = plain > 0.0 ? std::sqrt(absolute / plain) : 1.0;
}

//------------------------------------------------------------------------------
void BasisTables::GetBounds(double divisor, double upper[3]) const
{
  std::fill_n(upper, 3, 0.0);
  const std::size_t n = static_cast<std::size_t>(this->Functions.GetNumberOfFunctions());
  std::vector<float> largest(n, 0.0f);
  for (std::size_t k = 0; k < this->Basis.size(); ++k)
  {
    largest[k % n] = std::max(largest[k % n], std::abs(this->Basis[k]));
  }
  for (std::size_t row = 0; row < this->Coefficients.size() / n; ++row)
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k)
    {
      sum += static_cast<double>(std::abs(this->Coefficients[row * n + k])) * largest[k];
    }
    sum /= divisor;
    upper[row % 3] = std::max(upper[row % 3], sum);
  }
}

//------------------------------------------------------------------------------
vtkBRDFShaderInputs::Texture BasisTables::MakeTexture(bool halfFloat) const
{
  const int n = this->Functions.GetNumberOfFunctions();
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfBasis";
  texture.ThreeD = true;
  texture.Components = 1;
  texture.Dimensions = { this->NumberOfPhi, this->NumberOfGamma, n };
  texture.Repeat = { true, false, false };
  texture.HalfFloat = halfFloat;
  const std::size_t lights = this->Basis.size() / static_cast<std::size_t>(n);
  texture.Data.reserve(this->Basis.size());
  for (int k = 0; k < n; ++k)
  {
    for (std::size_t light = 0; light < lights; ++light)
    {
      texture.Data.push_back(
        this->Basis[light * static_cast<std::size_t>(n) + static_cast<std::size_t>(k)]);
    }
  }
  return texture;
}

//------------------------------------------------------------------------------
vtkBRDFShaderInputs::Texture MakeCoefficientTexture(
  const std::vector<float>& coefficients, int nPhi, int nTheta, bool halfFloat, float& scale)
{
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfCoefficients";
  texture.ThreeD = true;
  const std::size_t views = static_cast<std::size_t>(nPhi) * static_cast<std::size_t>(nTheta);
  texture.Dimensions = { nPhi, nTheta, static_cast<int>(coefficients.size() / (3 * views)) };
  texture.Repeat = { true, false, false };
  texture.HalfFloat = halfFloat;
  float peak = 0.0f;
  for (const float v : coefficients)
  {
    peak = std::max(peak, std::abs(v));
  }
  scale = halfFloat && peak > 1e-30f ? 32768.0f / peak : 1.0f;
  texture.Data.reserve(coefficients.size());
  for (const float v : coefficients)
  {
    texture.Data.push_back(v * scale);
  }
  return texture;
}
} // namespace measuredbrdf

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBasisBRDF);

namespace
{
constexpr double MinimumCosine = 0.01; // that a sum is divided by; the shader has the same

bool HasZone(int basis)
{
  return basis == vtkBasisBRDF::ZONAL || basis == vtkBasisBRDF::LEGENDRE_FOURIER;
}

BasisFunctions MakeFunctions(int basis, int order, const double zone[2])
{
  const bool fourier = basis == vtkBasisBRDF::LEGENDRE_FOURIER;
  switch (basis)
  {
    case vtkBasisBRDF::SPHERICAL_HARMONICS:
      return BasisFunctions(false, order, 1.0, -1.0);
    case vtkBasisBRDF::HEMISPHERICAL:
      return BasisFunctions(false, order, 1.0, 0.0);
    default:
      return BasisFunctions(
        fourier, order, std::cos(ToRadians(zone[0])), std::cos(ToRadians(zone[1])));
  }
}

double GetTurn(double y, double x) { return std::atan2(y, x) / (2.0 * Pi); }
}

//------------------------------------------------------------------------------
struct vtkBasisBRDF::Tables : public BasisTables
{
  using BasisTables::BasisTables;

  double Tolerance = 0.0; // that they were made for
  bool Cosines[2] = { false, false };
  std::unique_ptr<HalfVectorSampler> Sampler;
};

//------------------------------------------------------------------------------
vtkBasisBRDF::vtkBasisBRDF() = default;

//------------------------------------------------------------------------------
vtkBasisBRDF::~vtkBasisBRDF() = default;

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBasisBRDF, ResamplingError, double, 0.0, 1e6);

//------------------------------------------------------------------------------
void vtkBasisBRDF::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Basis: " << GetBasisName(this->Basis) << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "IncidentZone: " << this->IncidentZone[0] << " " << this->IncidentZone[1] << "\n";
  os << indent << "OutgoingZone: " << this->OutgoingZone[0] << " " << this->OutgoingZone[1] << "\n";
  os << indent << "NumberOfTheta: " << this->NumberOfTheta << "\n";
  os << indent << "NumberOfPhi: " << this->NumberOfPhi << "\n";
  os << indent << "IncidentCosine: " << (this->IncidentCosine ? "On" : "Off") << "\n";
  os << indent << "OutgoingCosine: " << (this->OutgoingCosine ? "On" : "Off") << "\n";
  os << indent << "ResamplingError: " << this->ResamplingError << "\n";
}

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
  if (order < 0 || order > MaximumOrder)
  {
    return "order " + std::to_string(order) + ", expected 0 to " + std::to_string(MaximumOrder);
  }
  if (nTheta < 2 || nTheta > 1024 || nPhi < 1 || nPhi > 1024)
  {
    return std::to_string(nTheta) + " x " + std::to_string(nPhi) +
           " samples of o, expected 2 to 1024 x 1 to 1024";
  }
  const std::int64_t functions = (order + 1) * (order + 1);
  const std::int64_t values = 3 * functions * nTheta * nPhi;
  if (values > MaximumNumberOfValues)
  {
    return std::to_string(functions) + " functions x " + std::to_string(nTheta) + " x " +
           std::to_string(nPhi) + " samples of o are " + std::to_string(values) +
           " coefficients, expected at most " + std::to_string(MaximumNumberOfValues);
  }
  return "";
}

//------------------------------------------------------------------------------
std::string vtkBasisBRDF::SetCoefficients(int basis, int order, const double incidentZone[2],
  const double outgoingZone[2], int nTheta, int nPhi, std::vector<float> rgb)
{
  if (basis < SPHERICAL_HARMONICS || basis > LEGENDRE_FOURIER)
  {
    return "basis " + std::to_string(basis) + " is unknown";
  }
  std::string sizeProblem = FindSizeProblem(order, nTheta, nPhi);
  if (!sizeProblem.empty())
  {
    return sizeProblem;
  }
  const bool ownZone = HasZone(basis);
  const double incident[2] = { ownZone ? incidentZone[0] : 0.0, ownZone ? incidentZone[1] : 90.0 };
  for (const double* zone : { incident, outgoingZone })
  {
    std::string problem = FindZoneProblem(zone);
    if (!problem.empty())
    {
      return problem;
    }
  }
  const std::size_t count = static_cast<std::size_t>((order + 1) * (order + 1)) *
                            static_cast<std::size_t>(nTheta) * static_cast<std::size_t>(nPhi);
  if (rgb.size() != 3 * count)
  {
    return std::to_string(rgb.size()) + " coefficients, expected " + std::to_string(3 * count);
  }
  if (!std::all_of(rgb.begin(), rgb.end(), [](float v) { return std::isfinite(v); }))
  {
    return "a coefficient is NaN or infinite";
  }
  this->Basis = basis;
  this->Order = order;
  std::copy_n(incident, 2, this->IncidentZone);
  std::copy_n(outgoingZone, 2, this->OutgoingZone);
  this->NumberOfTheta = nTheta;
  this->NumberOfPhi = nPhi;
  this->Coefficients = std::move(rgb);
  this->Cached.reset();
  this->Modified();
  return "";
}

//------------------------------------------------------------------------------
std::string vtkBasisBRDF::GetBasisName(int basis)
{
  static const char* const names[] = { "spherical harmonics", "hemispherical", "zonal",
    "Legendre x Fourier" };
  return basis >= SPHERICAL_HARMONICS && basis <= LEGENDRE_FOURIER ? names[basis] : "unknown";
}

//------------------------------------------------------------------------------
std::vector<double> vtkBasisBRDF::EvaluateBasis(
  int basis, int order, const double zone[2], const double direction[3])
{
  if (basis < SPHERICAL_HARMONICS || basis > LEGENDRE_FOURIER || order < 0 ||
      order > MaximumOrder || (HasZone(basis) && !FindZoneProblem(zone).empty()))
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
  if (current)
  {
    return *this->Cached;
  }
  auto tables =
    std::make_unique<Tables>(MakeFunctions(this->Basis, this->Order, this->IncidentZone),
      this->Basis == SPHERICAL_HARMONICS ? 0.5 * Pi : Pi, this->ResamplingTolerance,
      this->Coefficients);
  tables->Tolerance = this->ResamplingTolerance;
  tables->Cosines[0] = this->IncidentCosine;
  tables->Cosines[1] = this->OutgoingCosine;
  this->Cached = std::move(tables);
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
  const BasisCorners corners = tables.GetCorners(x, turn);
  const double begin = ToRadians(this->OutgoingZone[0]);
  const double end = ToRadians(this->OutgoingZone[1]);
  const double thetaO = std::atan2(std::hypot(o[0], o[1]), o[2]);
  const Interval t = OnAxis((thetaO - begin) / (end - begin), this->NumberOfTheta);
  const Interval q = OnCircle(isotropic ? 0.0 : GetTurn(o[1], o[0]), this->NumberOfPhi);

  const auto add = [&](int theta, int phi, double weight)
  { tables.AddView(theta * this->NumberOfPhi + phi, corners, weight, f); };
  add(t.First, q.First, (1.0 - t.Weight) * (1.0 - q.Weight));
  add(t.Second, q.First, t.Weight * (1.0 - q.Weight));
  if (!isotropic)
  {
    add(t.First, q.Second, (1.0 - t.Weight) * q.Weight);
    add(t.Second, q.Second, t.Weight * q.Weight);
  }
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
  for (int c = 0; c < 3; ++c)
  {
    f[c] /= divisor;
  }
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
  if (this->Coefficients.empty() || this->GetTables().Sampler)
  {
    return;
  }
  constexpr int nTheta = 45;
  this->Cached->Sampler = std::make_unique<HalfVectorSampler>(
    MeanOverDifferenceAngles(nTheta, 1,
      [this](const double i[3], const double o[3], double f[3]) { this->Evaluate(i, o, f); }),
    nTheta, 1, 0.5);
}

//------------------------------------------------------------------------------
bool vtkBasisBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  this->Prepare();
  if (this->Coefficients.empty())
  {
    return this->Superclass::SampleAbove(o, u1, u2, i);
  }
  glm::dvec3 direction;
  const bool above = this->Cached->Sampler->Sample(glm::make_vec3(o), u1, u2, direction);
  std::copy_n(glm::value_ptr(direction), 3, i);
  return above;
}

//------------------------------------------------------------------------------
double vtkBasisBRDF::PdfAbove(const double i[3], const double o[3])
{
  this->Prepare();
  return this->Coefficients.empty()
           ? this->Superclass::PdfAbove(i, o)
           : this->Cached->Sampler->Pdf(glm::make_vec3(i), glm::make_vec3(o));
}

//------------------------------------------------------------------------------
void vtkBasisBRDF::GetBounds(double minimumCosine, double lower[3], double upper[3])
{
  // Those of the sums, over the least of the cosines that they are divided by.
  std::fill_n(lower, 3, 0.0);
  std::fill_n(upper, 3, 0.0);
  if (this->Coefficients.empty())
  {
    return;
  }
  const Tables& tables = this->GetTables();
  double divisor = 1.0;
  if (this->IncidentCosine)
  {
    divisor *= std::max(std::min(minimumCosine, tables.Functions.GetNear()), MinimumCosine);
  }
  if (this->OutgoingCosine)
  {
    const double near = std::cos(ToRadians(this->OutgoingZone[0]));
    divisor *= std::max(std::min(minimumCosine, near), MinimumCosine);
  }
  tables.GetBounds(divisor, upper);
}

//------------------------------------------------------------------------------
void vtkBasisBRDF::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  if (this->Coefficients.empty())
  {
    return;
  }
  const Tables& tables = this->GetTables();
  const int n = this->GetNumberOfFunctions();
  // Large terms that cancel (extrapolated harmonics) need 32 bits.
  constexpr double halfRounding = 1.0 / 2048.0;
  double interpolation = 0.0;
  double amplification = 1.0;
  tables.Measure(interpolation, amplification);
  const bool halfFloat = 4.0 * halfRounding * amplification <= this->ResamplingTolerance;

  float scale = 1.0f;
  vtkBRDFShaderInputs::Texture coefficients = MakeCoefficientTexture(
    this->Coefficients, this->NumberOfPhi, this->NumberOfTheta, halfFloat, scale);
  vtkBRDFShaderInputs::Texture basis = tables.MakeTexture(halfFloat);

  vtkBRDFShaderInputs::Term term;
  measuredbrdf::SetModuleShader(term, "vtkBRDFBasis", vtkBRDFBasis);
  term.Constants.push_back({ "BRDF_BASIS_FUNCTIONS", std::to_string(n) });
  const auto number = [](double v) { return static_cast<float>(v); };
  const double begin = ToRadians(this->OutgoingZone[0]);
  const double end = ToRadians(this->OutgoingZone[1]);
  term.Uniforms.push_back({ "brdfScale", { 1.0f / scale } });
  term.Uniforms.push_back({ "brdfIsotropic", { this->NumberOfPhi == 1 ? 1.0f : 0.0f } });
  // The basis's domain: its near cosine, the square of that angle's sine, and the way to the far
  // cosine; acos(x) in the table in right angles, halved.
  const double near = tables.Functions.GetNear();
  term.Uniforms.push_back({ "brdfIncidentZone",
    { number(near), number(1.0 - near * near), number(near - tables.Functions.GetFar()) } });
  term.Uniforms.push_back({ "brdfGammaRange", { number(tables.GammaRange / Pi) } });
  // In right angles, and the two cosines.
  term.Uniforms.push_back({ "brdfOutgoingZone",
    { number(begin * 2.0 / Pi), number(1.0 / ((end - begin) * 2.0 / Pi)), 0.0f } });
  // Limits of the cosines that the sum is divided by; both 1: it carries none.
  const double far = this->Basis == SPHERICAL_HARMONICS ? 0.0 : tables.Functions.GetFar();
  const auto limits = [&number](bool carried, double low, double high) -> std::vector<float>
  {
    if (!carried)
    {
      return { 1.0f, 1.0f, 0.0f };
    }
    return { number(std::max(low, MinimumCosine)), number(std::max(high, MinimumCosine)), 0.0f };
  };
  term.Uniforms.push_back(
    { "brdfIncidentCosine", limits(this->IncidentCosine, far, tables.Functions.GetNear()) });
  term.Uniforms.push_back(
    { "brdfOutgoingCosine", limits(this->OutgoingCosine, std::cos(end), std::cos(begin)) });

  TextStream text;
  text << GetBasisName(this->Basis) << " basis of order " << this->Order << " (" << n
       << " functions), coefficients " << this->NumberOfPhi << " x " << this->NumberOfTheta
       << ", basis values " << tables.NumberOfPhi << " x " << tables.NumberOfGamma << ", "
       << (halfFloat ? "16" : "32") << "-bit float, " << coefficients.GetBytes() + basis.GetBytes()
       << " bytes";
  term.Textures = { std::move(coefficients), std::move(basis) };
  term.Fetches = 2 * n; // of a pixel's first light; the coefficients stay
  form.QuantizationError =
    std::max(form.QuantizationError, amplification * (halfFloat ? halfRounding : 0x1p-23));
  form.ResamplingError =
    std::max(form.ResamplingError, std::hypot(this->ResamplingError, interpolation));
  form.Description = text.str();
  form.Terms.push_back(std::move(term));
}

//------------------------------------------------------------------------------
void vtkBasisBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  const std::vector<std::string> onOff = { "off", "on" };
  exchange.Option("incidentCosine", onOff, this->IncidentCosine,
    [this](int on) { this->SetIncidentCosine(on == 1); });
  exchange.Option("outgoingCosine", onOff, this->OutgoingCosine,
    [this](int on) { this->SetOutgoingCosine(on == 1); });
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
  if (!exchange.HasFailed())
  {
    exchange.Check(this->SetCoefficients(basis, static_cast<int>(order), incident, outgoing,
      coefficients.Shape[1], coefficients.Shape[2], std::move(coefficients.Values)));
  }
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

//------------------------------------------------------------------------------
std::pair<std::type_index, std::string> vtkBasisBRDF::GetContent()
{
  measuredbrdf::ContentHash hash;
  hash.AddValue(this->Basis);
  hash.AddValue(this->Order);
  hash.Add(this->IncidentZone, sizeof(this->IncidentZone));
  hash.Add(this->OutgoingZone, sizeof(this->OutgoingZone));
  hash.AddValue(this->NumberOfTheta);
  hash.AddValue(this->NumberOfPhi);
  hash.AddValues(this->Coefficients);
  hash.AddValue(this->IncidentCosine);
  hash.AddValue(this->OutgoingCosine);
  hash.AddValue(this->ResamplingError);
  return { typeid(vtkBasisBRDF), hash.GetText() };
}
