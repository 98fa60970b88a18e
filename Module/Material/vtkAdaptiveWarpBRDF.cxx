// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAdaptiveWarpBRDF.h"

#include "BilinearWarp.h"
#include "Floats.h"
#include "HalfVector.h"
#include "LaneMath.h"
#include "NumberText.h"
#include "OneByOne.h"
#include "Refusal.h"
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
  PackedWarp(const BilinearWarp& ndf, const BilinearWarp& sigma, const BilinearWarp& vndf,
    const BilinearWarp& rgb, const std::vector<float>& thetaI, bool jacobian);

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
PackedWarp::PackedWarp(const BilinearWarp& ndf, const BilinearWarp& sigma, const BilinearWarp& vndf,
  const BilinearWarp& rgb, const std::vector<float>& thetaI, bool jacobian)
  : Jacobian(jacobian)
  , Warp{ vndf.GetWidth(), vndf.GetHeight() }
  , Color{ rgb.GetWidth(), rgb.GetHeight() }
  , Normal{ ndf.GetWidth(), ndf.GetHeight() }
  , SigmaWidth(sigma.GetWidth())
  , Thetas(thetaI)
  , Ndf(ndf.GetValues().begin(), ndf.GetValues().end())
  , Sigma(sigma.GetValues().begin(), sigma.GetValues().begin() + this->SigmaWidth)
{
  for (std::size_t k = 0; k + 1 < this->Thetas.size(); ++k)
  {
    this->Inverses.push_back(1.0f / (this->Thetas[k + 1] - this->Thetas[k]));
  }
  const std::vector<double>& conditional = vndf.GetConditional();
  for (std::size_t k = 0; k < conditional.size(); ++k)
  {
    this->Nodes.push_back(static_cast<float>(vndf.GetValues()[k]));
    this->Nodes.push_back(static_cast<float>(conditional[k]));
  }
  const auto width = static_cast<std::size_t>(this->Warp.Width);
  for (std::size_t k = 0; k < vndf.GetMarginal().size(); ++k)
  {
    const auto total = static_cast<float>(conditional[(k + 1) * width - 1]);
    this->Rows.insert(this->Rows.end(), { total, static_cast<float>(vndf.GetMarginal()[k]) });
  }
  this->Rows.insert(this->Rows.end(), { 0.0f, 0.0f }); // four are loaded
  const std::size_t size = static_cast<std::size_t>(this->Color.Width) * this->Color.Height;
  for (std::size_t k = 0; k < rgb.GetValues().size() / 3; ++k)
  {
    const double* color = &rgb.GetValues()[k / size * 3 * size + k % size];
    for (std::size_t c = 0; c < 3; ++c)
    {
      this->Colors.push_back(static_cast<float>(color[c * size]));
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
      const Float4 left = Shuffle<Float4, 0, 1, 2, 3>(mixed, mixed);
      const Float4 right = Shuffle<Float4, 4, 5, 6, 7>(mixed, mixed);
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

namespace
{
// Polar angle without acos: exact for small angles.
double Elevation(const glm::dvec3& d)
{
  const double z = d.z - 1.0;
  return 2.0 * std::asin(std::min(0.5 * std::sqrt(d.x * d.x + d.y * d.y + z * z), 1.0));
}

// In the coordinates of ndf, sigma and vndf.
glm::dvec2 ToUnit(double theta, double phi)
{
  const double turns = (phi + Pi) / (2.0 * Pi);
  return { ThetaHToUnit(theta), turns - std::floor(turns) };
}

BilinearWarp MakeWarp(
  const vtkAdaptiveWarpBRDF::Table& table, std::vector<std::vector<float>> axes, bool isDensity)
{
  const std::size_t rank = table.Shape.size();
  return BilinearWarp(
    table.Values, table.Shape[rank - 1], table.Shape[rank - 2], std::move(axes), isDensity);
}

// An incident direction as the tables know it.
struct Incident
{
  glm::dvec3 Signs; // x, y and z are multiplied by them, so that phi_i lies in its span
  glm::dvec3 Direction;
  double Theta, Phi;
  double Turn; // of half vectors: the azimuth of isotropic materials, else 0
  BilinearWarp::Slices Slices;

  glm::dvec2 GetUnitHalf(const glm::dvec3& h) const
  {
    return ToUnit(Elevation(h), std::atan2(h.y, h.x) - this->Turn);
  }
};
}

struct vtkAdaptiveWarpBRDF::Warps
{
  explicit Warps(const Tables& tables)
    : Jacobian(tables.Jacobian)
    , Isotropic(tables.PhiI.size() <= 2)
    , Ndf(MakeWarp(tables.Ndf, {}, false))
    , Sigma(MakeWarp(tables.Sigma, {}, false))
    , Vndf(MakeWarp(tables.Vndf, { tables.PhiI, tables.ThetaI }, true))
    , Luminance(MakeWarp(tables.Luminance, { tables.PhiI, tables.ThetaI }, true))
    , Rgb(MakeWarp(tables.Rgb, {}, false))
  {
    if (!this->Isotropic)
    {
      const double first = tables.PhiI.front(), last = tables.PhiI.back();
      this->Parts = static_cast<int>(std::lround(2.0 * Pi / (last - first)));
      this->MiddlePhi = 0.5 * (first + last);
      this->Middle = glm::dvec2(std::cos(this->MiddlePhi), std::sin(this->MiddlePhi));
    }
    const std::vector<float>& sigma = tables.Sigma.Values;
    const auto row = static_cast<std::ptrdiff_t>(tables.Sigma.Shape[1]);
    if (tables.PhiI.size() == 1 && std::equal(sigma.begin() + row, sigma.end(), sigma.begin()))
    {
      this->Packed.emplace(
        this->Ndf, this->Sigma, this->Vndf, this->Rgb, tables.ThetaI, tables.Jacobian);
    }
  }

  Incident Find(const glm::dvec3& direction) const
  {
    glm::dvec3 signs(1.0);
    const glm::dvec2 along = glm::dvec2(direction) * this->Middle;
    if (this->Parts == 2 && along.x + along.y < 0.0) // half a turn
    {
      signs = glm::dvec3(-1.0, -1.0, 1.0);
    }
    else if (this->Parts == 4)
    {
      signs = glm::dvec3(along.x < 0.0 ? -1.0 : 1.0, along.y < 0.0 ? -1.0 : 1.0, 1.0);
    }
    const glm::dvec3 d = signs * direction;
    const double phi = std::atan2(d.y, d.x);
    Incident incident{ signs, d, Elevation(d), phi, this->Isotropic ? phi : 0.0, {} };
    // phi is counted within half a turn of the span's middle.
    const double parameters[2] = {
      phi + 2.0 * Pi * std::round((this->MiddlePhi - phi) / (2.0 * Pi)), incident.Theta
    };
    incident.Slices = this->Vndf.FindSlices(parameters);
    return incident;
  }

  bool Jacobian;
  bool Isotropic;
  int Parts = 1;                       // of a turn that phi_i spans, 1, 2 or 4
  double MiddlePhi = 0.0;              // of phi_i
  glm::dvec2 Middle = glm::dvec2(0.0); // as a direction
  BilinearWarp Ndf, Sigma, Vndf, Luminance;
  BilinearWarp Rgb;                 // three slices for each one of the others
  std::optional<PackedWarp> Packed; // where no table depends on phi_i
};

namespace
{
constexpr float AngleNoise = 1e-5f;

// Repairs angles that were rounded onto or below the one before.
void CheckAxis(const std::string& name, std::vector<float>& axis)
{
  bool ascending = !axis.empty() && std::isfinite(axis.front());
  const float first = axis.empty() ? 0.0f : axis.front();
  for (std::size_t k = 1; ascending && k < axis.size(); ++k)
  {
    ascending = std::isfinite(axis[k]) && axis[k] >= axis[k - 1] - AngleNoise;
    axis[k] = std::max(axis[k], std::nextafter(axis[k - 1], HUGE_VALF));
  }
  Require(ascending && (axis.size() == 1 || axis.back() - first > 0.5f * AngleNoise),
    name + ": expected ascending finite angles");
}

// prefix: the leading axes' sizes; then two sizes of at least 2.
void CheckTable(
  const std::string& name, const vtkAdaptiveWarpBRDF::Table& table, const std::vector<int>& prefix)
{
  const std::vector<int>& shape = table.Shape;
  std::size_t count = 1;
  for (const int n : shape)
  {
    Require(
      n >= 1 && n <= (1 << 20) && count <= (std::size_t(1) << 40), name + ": shape out of range");
    count *= static_cast<std::size_t>(n);
  }
  Require(shape.size() == prefix.size() + 2 &&
            std::equal(prefix.begin(), prefix.end(), shape.begin()) && shape[prefix.size()] >= 2 &&
            shape.back() >= 2 && table.Values.size() == count,
    name + ": shape does not match theta_i, phi_i or its values");
  Require(std::all_of(table.Values.begin(), table.Values.end(),
            [](float value) { return std::isfinite(value); }),
    name + ": expected finite values");
}

// A whole turn, half of one or a quarter. One or two azimuths: it is isotropic.
void CheckSpan(const std::vector<float>& phi)
{
  if (phi.size() <= 2)
  {
    return;
  }
  const double span = static_cast<double>(phi.back()) - phi.front();
  const double parts = 2.0 * Pi / span;
  const double whole = std::round(parts);
  Require((whole == 1.0 || whole == 2.0 || whole == 4.0) && std::abs(parts - whole) <= 0.05,
    "phi_i: found a span of " + NumberText(ToDegrees(span)) + " degrees, expected 360, 180 or 90");
  // Mirrors are the planes of x and y.
  const double start = phi.front() / (0.5 * Pi);
  Require(whole != 4.0 || std::abs(start - std::round(start)) <= 0.05,
    "phi_i: found a quarter turn from " + NumberText(ToDegrees(phi.front())) +
      " degrees, expected one from a multiple of 90");
}

// Of a table that passed CheckTable. Clears rounding noise below 0.
void CheckDensity(const std::string& name, vtkAdaptiveWarpBRDF::Table& table)
{
  const int height = table.Shape[table.Shape.size() - 2];
  const int width = table.Shape.back();
  Require(ClearNoise(table.Values), name + ": a density cannot be negative");
  for (std::size_t at = 0; at < table.Values.size();
       at += static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
  {
    Require(BilinearWarp::GetSum(&table.Values[at], width, height) > 0.0,
      name + ": a density cannot be 0 everywhere");
  }
}
}

//------------------------------------------------------------------------------
std::string vtkAdaptiveWarpBRDF::SetTables(Tables tables)
{
  return FindProblemOf(
    [&]()
    {
      const std::vector<int> directions = { static_cast<int>(tables.PhiI.size()),
        static_cast<int>(tables.ThetaI.size()) };
      CheckAxis("theta_i", tables.ThetaI);
      CheckAxis("phi_i", tables.PhiI);
      CheckTable("ndf", tables.Ndf, {});
      CheckTable("sigma", tables.Sigma, {});
      CheckTable("vndf", tables.Vndf, directions);
      CheckTable("luminance", tables.Luminance, directions);
      CheckTable("rgb", tables.Rgb, { directions[0], directions[1], 3 });
      CheckSpan(tables.PhiI);
      CheckDensity("vndf", tables.Vndf);
      CheckDensity("luminance", tables.Luminance);
      this->Warp = std::make_shared<const Warps>(tables);
      this->Data = std::move(tables);
      this->ResetRenderable();
      this->Modified();
    });
}

//------------------------------------------------------------------------------
// The tables hold f cos(theta_o) = rgb(s) ndf(h) / (4 sigma(i)), s = vndf^-1(h; i).
void vtkAdaptiveWarpBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (!this->Warp)
  {
    return;
  }
  const Warps& warp = *this->Warp;
  const Incident incident = warp.Find(glm::make_vec3(i));
  const glm::dvec3 h = HalfVector(incident.Direction, incident.Signs * glm::make_vec3(o));
  const glm::dvec2 unitHalf = incident.GetUnitHalf(h);
  double density = 0.0;
  const glm::dvec2 s = warp.Vndf.Invert(unitHalf, incident.Slices, density);
  double scale = 1.0 / o[2];
  if (warp.Jacobian)
  {
    const BilinearWarp::Slices none = warp.Ndf.FindSlices(nullptr);
    scale *= warp.Ndf.Evaluate(unitHalf, none) /
             (4.0 * warp.Sigma.Evaluate(ToUnit(incident.Theta, incident.Phi), none));
  }
  warp.Rgb.EvaluateThree(s, incident.Slices, f);
  std::transform(f, f + 3, f, [scale](double value) { return std::max(value, 0.0) * scale; });
}

//------------------------------------------------------------------------------
void vtkAdaptiveWarpBRDF::EvaluateLights(
  int count, const float* const i[3], const double o[3], float* const f[3])
{
  if (!this->Warp || !this->Warp->Packed)
  {
    EvaluateLightsOneByOne(this, count, i, o, f);
    return;
  }
  this->Warp->Packed->Evaluate(count, i, o, f);
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
  const Incident view = this->Warp->Find(glm::make_vec3(o));
  double density = 0.0;
  const glm::dvec2 s = this->Warp->Luminance.Sample(glm::dvec2(u2, u1), view.Slices, density);
  const glm::dvec2 u = this->Warp->Vndf.Sample(s, view.Slices, density);
  const double thetaH = UnitToThetaH(u.x);
  const double phiH = (2.0 * u.y - 1.0) * Pi + view.Turn;
  const glm::dvec3 h(
    std::sin(thetaH) * std::cos(phiH), std::sin(thetaH) * std::sin(phiH), std::cos(thetaH));
  const glm::dvec3 direction = view.Signs * ReflectAbout(view.Direction, h);
  std::copy_n(glm::value_ptr(direction), 3, i);
  return direction.z > 0.0 && glm::dot(view.Direction, h) > 0.0;
}

//------------------------------------------------------------------------------
double vtkAdaptiveWarpBRDF::PdfAbove(const double i[3], const double o[3])
{
  if (!this->Warp)
  {
    return this->Superclass::PdfAbove(i, o);
  }
  const Incident view = this->Warp->Find(glm::make_vec3(o)); // plays the light, as in SampleAbove
  const glm::dvec3 h = HalfVector(view.Direction, view.Signs * glm::make_vec3(i));
  const glm::dvec2 unitHalf = view.GetUnitHalf(h);
  double density = 0.0;
  const glm::dvec2 s = this->Warp->Vndf.Invert(unitHalf, view.Slices, density);
  // Solid angle of outgoing directions per unit of the (theta_h, phi_h) square.
  const double jacobian = std::max(2.0 * Pi * Pi * unitHalf.x * std::hypot(h.x, h.y), 1e-6) * 4.0 *
                          glm::dot(view.Direction, h);
  return density * this->Warp->Luminance.Evaluate(s, view.Slices) / jacobian;
}

//------------------------------------------------------------------------------
void vtkAdaptiveWarpBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  Tables loaded;
  Tables& tables = exchange.IsLoading() ? loaded : this->Data;
  exchange.Flag("jacobian", tables.Jacobian, [&](bool on) { tables.Jacobian = on; });
  const auto exchangeAxis = [&exchange](const char* name, std::vector<float>& axis)
  {
    if (!exchange.IsLoading())
    {
      exchange.SaveArray(name, { static_cast<int>(axis.size()) }, 1, axis);
      return;
    }
    axis = exchange.LoadArray(name, 1, 1).Values;
  };
  const auto exchangeTable = [&exchange](const char* name, std::size_t axes, Table& table)
  {
    if (!exchange.IsLoading())
    {
      exchange.SaveArray(name, table.Shape, 1, table.Values);
      return;
    }
    auto array = exchange.LoadArray(name, axes, 1);
    table = { std::move(array.Shape), std::move(array.Values) };
  };
  exchangeAxis("thetaI", tables.ThetaI);
  exchangeAxis("phiI", tables.PhiI);
  exchangeTable("ndf", 2, tables.Ndf);
  exchangeTable("sigma", 2, tables.Sigma);
  exchangeTable("vndf", 4, tables.Vndf);
  exchangeTable("luminance", 4, tables.Luminance);
  exchangeTable("rgb", 5, tables.Rgb);
  if (exchange.IsLoading())
  {
    exchange.Check(this->SetTables(std::move(loaded)));
  }
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
