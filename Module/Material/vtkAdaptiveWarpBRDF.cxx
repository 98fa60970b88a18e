// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAdaptiveWarpBRDF.h"

#include "BilinearWarp.h"
#include "HalfVector.h"
#include "NumberText.h"
#include "OneByOne.h"
#include "PackedWarp.h"
#include "RoundingNoise.h"
#include "vtkBRDFExchange.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkAdaptiveWarpBRDF);

struct vtkAdaptiveWarpBRDF::Warps
{
  BilinearWarp Ndf;
  BilinearWarp Sigma;
  BilinearWarp Vndf;
  BilinearWarp Luminance;
  BilinearWarp Rgb[3];
  std::optional<PackedWarp> Packed;    // of tables that do not depend on phi_i
  bool Jacobian = true;                // as the tables say
  bool Round = false;                  // whether no table depends on phi_i
  int Parts = 1;                       // of a turn that phi_i spans, 1, 2 or 4
  double MiddlePhi = 0.0;              // of phi_i
  glm::dvec2 Middle = glm::dvec2(0.0); // of phi_i, as a direction

  // f of a pair. incident: phi_i, theta_i.
  void LookUp(const double incident[2], const glm::dvec2& unitIncident, const glm::dvec2& unitHalf,
    double cosine, double f[3]) const;

  /// What x, y and z are multiplied by so that phi_i lies in its span: the same material.
  glm::dvec3 GetFold(const glm::dvec3& incident) const
  {
    const glm::dvec2 along = glm::dvec2(incident) * this->Middle;
    if (this->Parts == 2 && along.x + along.y < 0.0) // half a turn
    {
      return glm::dvec3(-1.0, -1.0, 1.0);
    }
    return this->Parts == 4
             ? glm::dvec3(along.x < 0.0 ? -1.0 : 1.0, along.y < 0.0 ? -1.0 : 1.0, 1.0)
             : glm::dvec3(1.0);
  }
};

namespace
{
constexpr float AngleNoise = 1e-5f;

// What is wrong with the tables: texts, "" where nothing is. This one repairs angles that were
// rounded onto or below the one before.
std::string CheckAxis(const char* name, std::vector<float>& axis)
{
  bool ascending = !axis.empty() && std::isfinite(axis.front());
  const float first = axis.empty() ? 0.0f : axis.front();
  for (std::size_t k = 1; ascending && k < axis.size(); ++k)
  {
    ascending = std::isfinite(axis[k]) && axis[k] >= axis[k - 1] - AngleNoise;
    axis[k] = std::max(axis[k], std::nextafter(axis[k - 1], HUGE_VALF));
  }
  ascending = ascending && (axis.size() == 1 || axis.back() - first > 0.5f * AngleNoise);
  return ascending ? "" : std::string(name) + ": expected ascending finite angles";
}

// prefix: the leading axes' sizes; then two sizes of at least 2.
std::string CheckTable(const char* name, const std::vector<int>& shape,
  const std::vector<float>& values, const std::vector<int>& prefix)
{
  std::size_t count = 1;
  for (int n : shape)
  {
    if (n < 1 || n > (1 << 20) || count > (std::size_t(1) << 40))
    {
      return std::string(name) + ": shape out of range";
    }
    count *= static_cast<std::size_t>(n);
  }
  if (shape.size() != prefix.size() + 2 ||
      !std::equal(prefix.begin(), prefix.end(), shape.begin()) || shape[prefix.size()] < 2 ||
      shape[prefix.size() + 1] < 2 || values.size() != count)
  {
    return std::string(name) + ": shape does not match theta_i, phi_i or its values";
  }
  if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }))
  {
    return std::string(name) + ": expected finite values";
  }
  return "";
}

// A whole turn, half of one or a quarter. One or two azimuths: it is isotropic.
std::string CheckSpan(const std::vector<float>& phi)
{
  if (phi.size() <= 2)
  {
    return "";
  }
  const double span = static_cast<double>(phi.back()) - phi.front();
  const double parts = 2.0 * Pi / span;
  const double whole = std::round(parts);
  if ((whole != 1.0 && whole != 2.0 && whole != 4.0) || std::abs(parts - whole) > 0.05)
  {
    return "phi_i: found a span of " + NumberText(span * 180.0 / Pi) +
           " degrees, expected 360, 180 or 90";
  }
  // Mirrors are the planes of x and y.
  const double start = phi.front() / (0.5 * Pi);
  if (whole == 4.0 && std::abs(start - std::round(start)) > 0.05)
  {
    return "phi_i: found a quarter turn from " + NumberText(phi.front() * 180.0 / Pi) +
           " degrees, expected one from a multiple of 90";
  }
  return "";
}

// Of a table that passed CheckTable. Clears rounding noise below 0.
std::string CheckDensity(
  const char* name, const std::vector<int>& shape, std::vector<float>& values)
{
  const int height = shape[shape.size() - 2];
  const int width = shape[shape.size() - 1];
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (!ClearNoise(values))
  {
    return std::string(name) + ": a density cannot be negative";
  }
  for (std::size_t offset = 0; offset < values.size(); offset += size)
  {
    if (!(BilinearWarp::GetSum(&values[offset], width, height) > 0.0))
    {
      return std::string(name) + ": a density cannot be 0 everywhere";
    }
  }
  return "";
}

// Polar angle without acos: exact for small angles.
double Elevation(const glm::dvec3& d)
{
  const double z = d.z - 1.0;
  return 2.0 * std::asin(std::min(0.5 * std::sqrt(d.x * d.x + d.y * d.y + z * z), 1.0));
}

double PhiToUnit(double phi) { return (phi + Pi) / (2.0 * Pi); }

// A pair in the tables' coordinates.
struct Coordinates
{
  double Incident[2]; // phi_i, theta_i: the slices' parameters
  glm::dvec2 UnitIncident;
  glm::dvec2 UnitHalf;
  glm::dvec3 H;
};

// middle: of phi_i's span; phi is counted within half a turn of it.
double GetAzimuth(const glm::dvec3& incident, double middle)
{
  const double phi = std::atan2(incident.y, incident.x);
  return phi + 2.0 * Pi * std::round((middle - phi) / (2.0 * Pi));
}

Coordinates ToCoordinates(
  const glm::dvec3& incident, const glm::dvec3& outgoing, bool isotropic, double middle)
{
  Coordinates c;
  c.H = HalfVector(incident, outgoing);
  const double theta = Elevation(incident);
  const double phi = GetAzimuth(incident, middle);
  const double phiH = std::atan2(c.H.y, c.H.x);
  c.Incident[0] = phi;
  c.Incident[1] = theta;
  c.UnitIncident =
    glm::dvec2(ThetaHToUnit(theta), PhiToUnit(phi - 2.0 * Pi * std::floor(PhiToUnit(phi))));
  c.UnitHalf = glm::dvec2(ThetaHToUnit(Elevation(c.H)), PhiToUnit(isotropic ? phiH - phi : phiH));
  c.UnitHalf.y -= std::floor(c.UnitHalf.y);
  return c;
}

// Solid angle of outgoing directions per unit of the (theta_h, phi_h) square.
double GetJacobian(double unitTheta, const glm::dvec3& h, const glm::dvec3& incident)
{
  const double sine = std::hypot(h.x, h.y);
  return std::max(2.0 * Pi * Pi * unitTheta * sine, 1e-6) * 4.0 * glm::dot(incident, h);
}
}

//------------------------------------------------------------------------------
void vtkAdaptiveWarpBRDF::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Incident directions: " << this->Data.ThetaI.size() << " theta x "
     << this->Data.PhiI.size() << " phi\n";
  if (!this->Data.Rgb.Shape.empty())
  {
    os << indent << "Values per direction: " << this->Data.Rgb.Shape[3] << " x "
       << this->Data.Rgb.Shape[4] << "\n";
  }
}

//------------------------------------------------------------------------------
std::string vtkAdaptiveWarpBRDF::SetTables(Tables tables)
{
  const std::vector<int> directions = { static_cast<int>(tables.PhiI.size()),
    static_cast<int>(tables.ThetaI.size()) };
  const std::vector<int> channels = { directions[0], directions[1], 3 };
  const std::vector<std::string> problems = { CheckAxis("theta_i", tables.ThetaI),
    CheckAxis("phi_i", tables.PhiI), CheckTable("ndf", tables.Ndf.Shape, tables.Ndf.Values, {}),
    CheckTable("sigma", tables.Sigma.Shape, tables.Sigma.Values, {}),
    CheckTable("vndf", tables.Vndf.Shape, tables.Vndf.Values, directions),
    CheckTable("luminance", tables.Luminance.Shape, tables.Luminance.Values, directions),
    CheckTable("rgb", tables.Rgb.Shape, tables.Rgb.Values, channels), CheckSpan(tables.PhiI) };
  for (const std::string& problem : problems)
  {
    if (!problem.empty())
    {
      return problem;
    }
  }
  for (const std::string& problem : { CheckDensity("vndf", tables.Vndf.Shape, tables.Vndf.Values),
         CheckDensity("luminance", tables.Luminance.Shape, tables.Luminance.Values) })
  {
    if (!problem.empty())
    {
      return problem;
    }
  }

  auto warps = std::make_unique<Warps>();
  const std::vector<std::vector<float>> axes = { tables.PhiI, tables.ThetaI };
  const auto build =
    [](const Table& table, const std::vector<std::vector<float>>& parameters, bool density)
  {
    const std::size_t rank = table.Shape.size();
    return BilinearWarp(
      table.Values, table.Shape[rank - 1], table.Shape[rank - 2], parameters, density);
  };
  if (tables.PhiI.size() > 2)
  {
    const double middle = 0.5 * (static_cast<double>(tables.PhiI.back()) + tables.PhiI.front());
    warps->Parts = static_cast<int>(
      std::lround(2.0 * Pi / (static_cast<double>(tables.PhiI.back()) - tables.PhiI.front())));
    warps->MiddlePhi = middle;
    warps->Middle = glm::dvec2(std::cos(middle), std::sin(middle));
  }
  const std::vector<float>& sigma = tables.Sigma.Values;
  const auto row = static_cast<std::ptrdiff_t>(tables.Sigma.Shape[1]);
  warps->Round =
    tables.PhiI.size() == 1 && std::equal(sigma.begin() + row, sigma.end(), sigma.begin());
  warps->Jacobian = tables.Jacobian;
  warps->Ndf = build(tables.Ndf, {}, false);
  warps->Sigma = build(tables.Sigma, {}, false);
  warps->Vndf = build(tables.Vndf, axes, true);
  warps->Luminance = build(tables.Luminance, axes, true);
  // One function per channel, so that all three share the slices' weights.
  const int height = tables.Rgb.Shape[3];
  const int width = tables.Rgb.Shape[4];
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t c = 0; c < 3; ++c)
  {
    std::vector<float> channel;
    for (std::size_t offset = c * size; offset < tables.Rgb.Values.size(); offset += 3 * size)
    {
      const auto begin = tables.Rgb.Values.begin() + static_cast<std::ptrdiff_t>(offset);
      channel.insert(channel.end(), begin, begin + static_cast<std::ptrdiff_t>(size));
    }
    warps->Rgb[c] = BilinearWarp(channel, width, height, axes, false);
  }
  if (warps->Round)
  {
    warps->Packed.emplace(PackedWarp::Tables{
      warps->Ndf, warps->Sigma, warps->Vndf, warps->Rgb, tables.ThetaI, tables.Jacobian });
  }
  this->Data = std::move(tables);
  this->Warp = std::move(warps);
  this->ResetRenderable();
  this->Modified();
  return "";
}

//------------------------------------------------------------------------------
void vtkAdaptiveWarpBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (!this->Warp)
  {
    return;
  }
  const glm::dvec3 signs = this->Warp->GetFold(glm::make_vec3(i));
  const Coordinates c = ToCoordinates(signs * glm::make_vec3(i), signs * glm::make_vec3(o),
    this->Data.PhiI.size() <= 2, this->Warp->MiddlePhi);
  this->Warp->LookUp(c.Incident, c.UnitIncident, c.UnitHalf, o[2], f);
}

//------------------------------------------------------------------------------
void vtkAdaptiveWarpBRDF::EvaluateLights(
  int count, const float* const i[3], const double o[3], float* const f[3])
{
  if (!this->Warp || !this->Warp->Round)
  {
    EvaluateLightsOneByOne(this, count, i, o, f);
    return;
  }
  this->Warp->Packed->Evaluate(count, i, o, f);
}

//------------------------------------------------------------------------------
// The tables hold f cos(theta_o) = rgb(s) ndf(h) / (4 sigma(i)), s = vndf^-1(h; i).
void vtkAdaptiveWarpBRDF::Warps::LookUp(const double incident[2], const glm::dvec2& unitIncident,
  const glm::dvec2& unitHalf, double cosine, double f[3]) const
{
  const BilinearWarp::Slices none = this->Ndf.FindSlices(nullptr);
  const BilinearWarp::Slices slices = this->Vndf.FindSlices(incident);
  double density = 0.0;
  const glm::dvec2 s = this->Vndf.Invert(unitHalf, slices, density);
  double scale = 1.0 / cosine;
  if (this->Jacobian)
  {
    scale *= this->Ndf.Evaluate(unitHalf, none) / (4.0 * this->Sigma.Evaluate(unitIncident, none));
  }
  BilinearWarp::EvaluateThree(this->Rgb, s, slices, f);
  for (int k = 0; k < 3; ++k)
  {
    f[k] = std::max(f[k], 0.0) * scale;
  }
}

//------------------------------------------------------------------------------
bool vtkAdaptiveWarpBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  if (!this->Warp)
  {
    return this->Superclass::SampleAbove(o, u1, u2, i);
  }
  // The warps draw the view for a light. Here the view is given, so it plays the light: measured
  // materials are nearly reciprocal, and f cos / pdf corrects what is left.
  const glm::dvec3 signs = this->Warp->GetFold(glm::make_vec3(o));
  const glm::dvec3 incident = signs * glm::make_vec3(o);
  const bool isotropic = this->Data.PhiI.size() <= 2;
  const double phi = GetAzimuth(incident, this->Warp->MiddlePhi);
  const double parameters[2] = { phi, Elevation(incident) };
  const BilinearWarp::Slices slices = this->Warp->Vndf.FindSlices(parameters);
  double density = 0.0;
  const glm::dvec2 s = this->Warp->Luminance.Sample(glm::dvec2(u2, u1), slices, density);
  const glm::dvec2 u = this->Warp->Vndf.Sample(s, slices, density);
  const double thetaH = 0.5 * Pi * u.x * u.x;
  const double phiH = (2.0 * u.y - 1.0) * Pi + (isotropic ? phi : 0.0);
  const glm::dvec3 h(
    std::sin(thetaH) * std::cos(phiH), std::sin(thetaH) * std::sin(phiH), std::cos(thetaH));
  const glm::dvec3 direction = signs * ReflectAbout(incident, h);
  std::copy_n(glm::value_ptr(direction), 3, i);
  return direction.z > 0.0 && glm::dot(incident, h) > 0.0;
}

//------------------------------------------------------------------------------
double vtkAdaptiveWarpBRDF::PdfAbove(const double i[3], const double o[3])
{
  if (!this->Warp)
  {
    return this->Superclass::PdfAbove(i, o);
  }
  const glm::dvec3 signs = this->Warp->GetFold(glm::make_vec3(o));
  const glm::dvec3 incident =
    signs * glm::make_vec3(o); // the view plays the light, as in SampleAbove
  const Coordinates c = ToCoordinates(
    incident, signs * glm::make_vec3(i), this->Data.PhiI.size() <= 2, this->Warp->MiddlePhi);
  const BilinearWarp::Slices slices = this->Warp->Vndf.FindSlices(c.Incident);
  double density = 0.0;
  const glm::dvec2 s = this->Warp->Vndf.Invert(c.UnitHalf, slices, density);
  return density * this->Warp->Luminance.Evaluate(s, slices) /
         GetJacobian(c.UnitHalf.x, c.H, incident);
}

//------------------------------------------------------------------------------
void vtkAdaptiveWarpBRDF::GetBounds(double minimumCosine, double lower[3], double upper[3])
{
  for (int c = 0; c < 3; ++c)
  {
    lower[c] = upper[c] = 0.0;
  }
  if (!this->Warp)
  {
    return;
  }
  double scale = 1.0 / std::clamp(minimumCosine, 1e-6, 1.0);
  if (this->Data.Jacobian)
  {
    scale *= *std::max_element(this->Data.Ndf.Values.begin(), this->Data.Ndf.Values.end()) /
             (4.0 * std::max(*std::min_element(
                               this->Data.Sigma.Values.begin(), this->Data.Sigma.Values.end()),
                      std::numeric_limits<float>::min()));
  }
  const std::size_t size = static_cast<std::size_t>(this->Data.Rgb.Shape[3]) *
                           static_cast<std::size_t>(this->Data.Rgb.Shape[4]);
  for (std::size_t k = 0; k < this->Data.Rgb.Values.size(); ++k)
  {
    double& bound = upper[k / size % 3];
    bound = std::max(bound, this->Data.Rgb.Values[k] * scale);
  }
}

//------------------------------------------------------------------------------
void vtkAdaptiveWarpBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  if (!exchange.IsLoading())
  {
    const Tables& tables = this->Data;
    exchange.Option("jacobian", { "off", "on" }, tables.Jacobian, [](int) {});
    exchange.SaveArray("thetaI", { static_cast<int>(tables.ThetaI.size()) }, 1, tables.ThetaI);
    exchange.SaveArray("phiI", { static_cast<int>(tables.PhiI.size()) }, 1, tables.PhiI);
    exchange.SaveArray("ndf", tables.Ndf.Shape, 1, tables.Ndf.Values);
    exchange.SaveArray("sigma", tables.Sigma.Shape, 1, tables.Sigma.Values);
    exchange.SaveArray("vndf", tables.Vndf.Shape, 1, tables.Vndf.Values);
    exchange.SaveArray("luminance", tables.Luminance.Shape, 1, tables.Luminance.Values);
    exchange.SaveArray("rgb", tables.Rgb.Shape, 1, tables.Rgb.Values);
    return;
  }
  const auto load = [&exchange](const char* name, std::size_t axes)
  {
    auto array = exchange.LoadArray(name, axes, 1);
    return Table{ std::move(array.Shape), std::move(array.Values) };
  };
  Tables tables;
  exchange.Option("jacobian", { "off", "on" }, 0, [&](int value) { tables.Jacobian = value == 1; });
  tables.ThetaI = load("thetaI", 1).Values;
  tables.PhiI = load("phiI", 1).Values;
  tables.Ndf = load("ndf", 2);
  tables.Sigma = load("sigma", 2);
  tables.Vndf = load("vndf", 4);
  tables.Luminance = load("luminance", 4);
  tables.Rgb = load("rgb", 5);
  exchange.Check(this->SetTables(std::move(tables)));
}

//------------------------------------------------------------------------------
vtkBRDF* vtkAdaptiveWarpBRDF::NewCopy()
{
  vtkAdaptiveWarpBRDF* copy = vtkAdaptiveWarpBRDF::New();
  copy->Data = this->Data;
  copy->Warp = this->Warp;                                          // never changes once it is made
  copy->ShareRenderable(this);
  return copy;
}
