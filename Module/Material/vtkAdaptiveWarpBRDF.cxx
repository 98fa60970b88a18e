// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAdaptiveWarpBRDF.h"

#include "BilinearWarp.h"
#include "Floats.h"
#include "HalfVector.h"
#include "LaneMath.h"
#include "NumberText.h"
#include "OneByOne.h"
#include "vtkBRDFExchange.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkAdaptiveWarpBRDF);

namespace
{
// A weighted mean of what two slices or rows hold, `next` numbers apart.
template <typename Vector>
MEASUREDBRDF_INLINE Vector LoadMixed(const float* values, std::ptrdiff_t next, float weight)
{
  const Vector first = Load<Vector>(values);
  return first + weight * (Load<Vector>(values + next) - first);
}

// Places between the nodes of an axis.
struct LanePlaces
{
  Integers First;
  Floats Fraction;
};

MEASUREDBRDF_INLINE LanePlaces FindPlaces(Floats unit, int nodes)
{
  const Floats inside = Smaller(Larger(unit, Floats{}), Fill(1.0f)); // not a number: 0
  const Floats position = inside * static_cast<float>(nodes - 1);
  const Integers whole = ToIntegers(position);
  const Integers first = whole < nodes - 2 ? whole : Integers{} + (nodes - 2);
  return { first, position - ToFloats(first) };
}

// Of several lights: the coordinates in which the tables are looked up, and what is found there.
struct WarpState : LaneState
{
  LaneDirections Half;
  Floats Theta;                                   // theta_i in radians
  Floats UnitTheta, UnitThetaH, UnitPhiH;         // in the tables' units; of phi_h - phi_i
  Integers Slice;                                 // the first of those about theta_i
  Floats Weight;                                  // of the second
  LanePlaces Column, Row;                         // in the warp, then among the colors
  Float4 Densities[LaneCount], Totals[LaneCount]; // a light's nodes and rows of the warp
};

MEASUREDBRDF_INLINE void FindCoordinates(WarpState& s)
{
  const LaneDirections normal{ Floats{}, Floats{}, Fill(1.0f) };
  const Floats theta = FindQuarterTurns(FindHalfDistance(s.Light, normal));
  s.Theta = theta * static_cast<float>(0.5 * Pi);
  s.UnitTheta = SquareRoot(theta);
  s.UnitThetaH = SquareRoot(FindQuarterTurns(FindHalfDistance(s.Half, normal)));
  // The azimuth of h from that of the light, which is 0 for an upright light.
  const Floats size = s.Light.X * s.Light.X + s.Light.Y * s.Light.Y;
  const Floats fromX = size > 0.0f ? s.Light.X : Fill(1.0f);
  const Floats along = fromX * s.Half.X + s.Light.Y * s.Half.Y;
  const Floats across = fromX * s.Half.Y - s.Light.Y * s.Half.X;
  const Floats phi = FindTurns(along, across);
  s.UnitPhiH = across < 0.0f ? 0.5f - phi : 0.5f + phi;
}

// The tables once more, in single precision and in an order in which what a pair looks up lies side
// by side: for many lights at a time, where nothing depends on the light's azimuth.
class PackedWarp
{
public:
  /// Tables over theta_i alone; jacobian: whether ndf and sigma count.
  struct Tables
  {
    const BilinearWarp& Ndf;
    const BilinearWarp& Sigma;
    const BilinearWarp& Vndf;
    const BilinearWarp* Rgb; // three
    const std::vector<float>& ThetaI;
    bool Jacobian;
  };
  explicit PackedWarp(const Tables& tables);

  /// f of so many lights for one view, all of them unit vectors above the horizon. lights: x, y and
  /// z; f: red, green and blue. Angles are exact to 1e-6 rad; where the half vector is nearly the
  /// normal, its azimuth is less exact.
  void Evaluate(
    int count, const float* const lights[3], const double view[3], float* const f[3]) const;

private:
  struct Grid
  {
    int Width;
    int Height;
  };

  bool Jacobian;
  Grid Warp;
  Grid Color;
  Grid Normal; // of the ndf
  int SigmaWidth;
  std::vector<float> Thetas;   // of the slices
  std::vector<float> Inverses; // of the steps between them
  std::vector<float> Nodes;  // slice, row, column: density, its integral along the row up to there
  std::vector<float> Rows;   // slice, row: the row's integral, that of all rows before it
  std::vector<float> Colors; // slice, row, column: R, G, B, 0
  std::vector<float> Ndf;    // row, column
  std::vector<float> Sigma;  // its first row
};

//------------------------------------------------------------------------------
PackedWarp::PackedWarp(const Tables& tables)
  : Jacobian(tables.Jacobian)
  , Warp{ tables.Vndf.GetWidth(), tables.Vndf.GetHeight() }
  , Color{ tables.Rgb[0].GetWidth(), tables.Rgb[0].GetHeight() }
  , Normal{ tables.Ndf.GetWidth(), tables.Ndf.GetHeight() }
  , SigmaWidth(tables.Sigma.GetWidth())
  , Thetas(tables.ThetaI)
  , Ndf(tables.Ndf.GetValues().begin(), tables.Ndf.GetValues().end())
  , Sigma(tables.Sigma.GetValues().begin(), tables.Sigma.GetValues().begin() + this->SigmaWidth)
{
  for (std::size_t k = 0; k + 1 < this->Thetas.size(); ++k)
  {
    this->Inverses.push_back(1.0f / (this->Thetas[k + 1] - this->Thetas[k]));
  }
  const std::vector<double>& densities = tables.Vndf.GetValues();
  const std::vector<double>& conditional = tables.Vndf.GetConditional();
  const std::vector<double>& marginal = tables.Vndf.GetMarginal();
  for (std::size_t k = 0; k < densities.size(); ++k)
  {
    this->Nodes.push_back(static_cast<float>(densities[k]));
    this->Nodes.push_back(static_cast<float>(conditional[k]));
  }
  const auto width = static_cast<std::size_t>(this->Warp.Width);
  for (std::size_t k = 0; k < marginal.size(); ++k)
  {
    const auto total = static_cast<float>(conditional[(k + 1) * width - 1]);
    this->Rows.insert(this->Rows.end(), { total, static_cast<float>(marginal[k]) });
  }
  this->Rows.insert(this->Rows.end(), { 0.0f, 0.0f }); // four are loaded
  for (std::size_t k = 0; k < tables.Rgb[0].GetValues().size(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      this->Colors.push_back(static_cast<float>(tables.Rgb[c].GetValues()[k]));
    }
    this->Colors.push_back(0.0f);
  }
}

// f cos(theta_o) = rgb(s) ndf(h) / (4 sigma(i)), s = vndf^-1(h; i), as in vtkAdaptiveWarpBRDF.
void PackedWarp::Evaluate(
  int count, const float* const lights[3], const double view[3], float* const f[3]) const
{
  const std::ptrdiff_t warpWidth = 2 * this->Warp.Width;
  const std::ptrdiff_t warpRows = 2 * this->Warp.Height;
  const std::ptrdiff_t warpSlice = warpWidth * this->Warp.Height;
  const std::ptrdiff_t colorWidth = 4 * this->Color.Width;
  const std::ptrdiff_t colorSlice = colorWidth * this->Color.Height;
  const std::ptrdiff_t next = this->Thetas.size() > 1 ? 1 : 0; // slice

  const auto findHalf = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    Floats cosine;
    s.Half = FindHalf(s.Light, FillDirections(view), cosine);
  };

  const auto findPlaces = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    FindCoordinates(s);
    Floats begin = Fill(this->Thetas[0]);
    Floats inverse = Fill(this->Inverses.empty() ? 0.0f : this->Inverses[0]);
    s.Slice = Integers{};
    for (std::size_t k = 1; k + 1 < this->Thetas.size(); ++k)
    {
      const Integers isBeyond = s.Theta >= this->Thetas[k];
      s.Slice = isBeyond ? Integers{} + static_cast<int>(k) : s.Slice;
      inverse = isBeyond ? Fill(this->Inverses[k]) : inverse;
      begin = isBeyond ? Fill(this->Thetas[k]) : begin;
    }
    s.Weight = Smaller(Larger((s.Theta - begin) * inverse, Floats{}), Fill(1.0f));
    s.Column = FindPlaces(s.UnitThetaH, this->Warp.Width);
    s.Row = FindPlaces(s.UnitPhiH, this->Warp.Height);
  };

  const auto lookUpWarp = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    for (int k = 0; k < LaneCount; ++k)
    {
      const std::ptrdiff_t slice = s.Slice[k];
      const std::ptrdiff_t row = s.Row.First[k];
      const float weight = s.Weight[k];
      const float* const node =
        this->Nodes.data() + slice * warpSlice + row * warpWidth + 2 * s.Column.First[k];
      const Float4 upper = LoadMixed<Float4>(node, next * warpSlice, weight);
      const Float4 lower = LoadMixed<Float4>(node + warpWidth, next * warpSlice, weight);
      s.Densities[k] = upper + s.Row.Fraction[k] * (lower - upper);
      s.Totals[k] =
        LoadMixed<Float4>(this->Rows.data() + slice * warpRows + 2 * row, next * warpRows, weight);
    }
  };

  // As BilinearWarp::Invert: from a row's densities beside the half vector, their integral up to
  // there, and the integrals of that row, of the next one and of all before.
  const auto invert = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    Floats densities[4], totals[4];
    Transpose(s.Densities, densities);
    Transpose(s.Totals, totals);
    const Floats across = s.Column.Fraction;
    const Floats along =
      densities[1] + across * (densities[0] + 0.5f * across * (densities[2] - densities[0]));
    const Floats down = s.Row.Fraction;
    const Floats before = totals[1] + down * (totals[0] + 0.5f * down * (totals[2] - totals[0]));
    const Floats whole = totals[0] + down * (totals[2] - totals[0]);
    s.Column = FindPlaces(whole > 0.0f ? along / whole : Floats{}, this->Color.Width);
    s.Row = FindPlaces(before, this->Color.Height);
  };

  const auto lookUpColors = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    Float4 colors[LaneCount];
    for (int k = 0; k < LaneCount; ++k)
    {
      const float* const at = this->Colors.data() + s.Slice[k] * colorSlice +
                              s.Row.First[k] * colorWidth + 4 * s.Column.First[k];
      const Float8 upper = LoadMixed<Float8>(at, next * colorSlice, s.Weight[k]);
      const Float8 lower = LoadMixed<Float8>(at + colorWidth, next * colorSlice, s.Weight[k]);
      const Float8 mixed = upper + s.Row.Fraction[k] * (lower - upper);
      const Float4 left = __builtin_shufflevector(mixed, mixed, 0, 1, 2, 3);
      const Float4 right = __builtin_shufflevector(mixed, mixed, 4, 5, 6, 7);
      colors[k] = left + s.Column.Fraction[k] * (right - left);
    }
    Floats ofColors[4];
    Transpose(colors, ofColors);
    std::copy_n(ofColors, 3, s.Color);
  };

  const auto scaleColors = [&](WarpState& s) MEASUREDBRDF_INLINED
  {
    Floats scale = Fill(static_cast<float>(1.0 / view[2]));
    if (this->Jacobian)
    {
      const LanePlaces x = FindPlaces(s.UnitThetaH, this->Normal.Width);
      const LanePlaces y = FindPlaces(s.UnitPhiH, this->Normal.Height);
      const LanePlaces ofSigma = FindPlaces(s.UnitTheta, this->SigmaWidth);
      Float4 corners[LaneCount];
      Floats areas[2];
      for (int k = 0; k < LaneCount; ++k)
      {
        const float* const at =
          this->Ndf.data() + std::ptrdiff_t{ y.First[k] } * this->Normal.Width + x.First[k];
        corners[k] = Float4{ at[0], at[1], at[this->Normal.Width], at[this->Normal.Width + 1] };
        const float* const area = this->Sigma.data() + ofSigma.First[k];
        areas[0][k] = area[0];
        areas[1][k] = area[1];
      }
      Floats c[4];
      Transpose(corners, c);
      const Floats above = c[0] + x.Fraction * (c[1] - c[0]);
      const Floats below = c[2] + x.Fraction * (c[3] - c[2]);
      scale *= (above + y.Fraction * (below - above)) /
               (4.0f * (areas[0] + ofSigma.Fraction * (areas[1] - areas[0])));
    }
    for (Floats& color : s.Color)
    {
      const Floats value = Larger(color, Floats{}) * scale;
      color = value <= std::numeric_limits<float>::max() ? value : Floats{};
    }
  };

  EvaluateLanes<WarpState>(
    count, lights, f, findHalf, findPlaces, lookUpWarp, invert, lookUpColors, scaleColors);
}
}

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
  copy->Warp = this->Warp; // never changes once it is made
  copy->ShareRenderable(this);
  return copy;
}
