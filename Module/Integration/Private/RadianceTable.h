// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The table of vtkTableRadianceIntegrator: how it is stored, with tiles where it has many rows, its
 * look-ups, and how it is made.
 */

#ifndef RadianceTable_h
#define RadianceTable_h

#include "EnvironmentHarmonics.h"
#include "FieldSynthesis.h"
#include "Floats.h"
#include "HalfVector.h" // for Pi
#include "Lamps.h"
#include "LobePlacement.h" // for ProfileTexels
#include "LobeViews.h"
#include "MaterialPrecomputation.h"
#include "Neighbors.h"
#include "WignerD.h"
#include "vtkBRDFShaderInputs.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace measuredbrdf
{
/**
 * What a lobe narrower than a map's texels reflects of a lamp overshoots, and beside the lamp it
 * may fall far below what is around, even below 0. A binomial blur of what is positive shows what
 * is around: values below three quarters of its least within two texels are lifted there, as
 * limiters do in transport schemes (Zalesak 1979). Where radiance is resolved that changes next
 * to nothing.
 *
 * radiance: RGB, maps of rows x columns behind each other, columns around.
 */
void LiftDarkRings(std::vector<float>& radiance, std::size_t rows, std::size_t columns);

/// Of one table; the nodes of the coarse map are nodes of the fine one.
struct TableTiles
{
  static constexpr int LargestWhole = 113; // rows of a table without tiles
  static constexpr int Ratio = 4;          // fine intervals in a coarse one
  static constexpr int Intervals = 8;      // fine ones along a tile's side
  static constexpr int Texels = Intervals + 1;

  /// rows: that were asked for. slices: a map each, one above the other in the texture.
  TableTiles(int rows, int slices);

  ///@{
  /// Rows of the map that is everywhere, and of the one that tiles are cut from: 0 where there are
  /// no tiles, else a multiple of 8 and one.
  static int GetRows(int rows);
  static int GetFineRows(int rows);
  ///@}

  int FineRows;
  int Rows; // of the coarse map
  int Columns;
  int Across = 0; // tiles side by side in the texture, below the coarse map
  int Down = 0;   // rows of them; before Choose: at most
  /// For each tile of the sphere, side by side: 1 + its place in the texture; 0: it has none.
  std::vector<float> Places;

  int GetFineColumns() const { return 2 * (this->FineRows - 1); }
  int CountRows() const { return (this->FineRows - 1) / Intervals; }
  int CountColumns() const { return 2 * this->CountRows(); }

  /// Where radiance (RGB, coarse columns x coarse rows x slices) bends most, each slice with its
  /// weight: as many tiles as there are places, or fewer that hold nearly all.
  void Choose(const std::vector<float>& radiance, const std::vector<double>& weights);

  /// The fine nodes that FieldSynthesis must know for these tiles, with some beside them.
  MapPart GetFineNodes() const;

  /// The coarse map and, below it, the tiles, of each slice; fine: RGB of those nodes, whose dark
  /// rings are lifted here. Where a tile borders on none it takes the coarse map's values, which
  /// are linear there: no seam shows.
  std::vector<float> Join(
    const std::vector<float>& coarse, const MapPart& nodes, const std::vector<float>& fine) const;

private:
  /// Whether all tiles that meet at a fine node have a place.
  bool IsInside(int row, int column) const;
  /// What a tile is made of.
  struct Tile
  {
    struct Node
    {
      int Texel;  // in a slice
      int Coarse; // the coarse map's texel at the same place; -1: none
      bool IsInside;
    };
    int Row, Column;        // of its first fine node
    std::vector<int> Nodes; // of it and a margin, by number
    std::vector<Node> Own;  // without the margin
  };
  std::vector<Tile> MakeTiles(const MapPart& nodes) const;
  void AddTiles(const std::vector<Tile>& tiles, const float* fine, float* map) const;
};

struct RadianceTable
{
  static constexpr int ProfileSize = LobeViews::NumberOfViews;
  static constexpr int IrradianceSide = 129; // texels, of the octahedral map of irradiance
  /// With a shared exponent (Floats.h).
  using Texels = std::vector<std::uint32_t>;

  /// rows: more than TableTiles::LargestWhole are those of tiles.
  RadianceTable(int rows, int angles, int azimuths)
    : Rows(TableTiles::GetRows(rows))
    , Columns(2 * (this->Rows - 1))
    , Angles(angles)
    , Azimuths(azimuths)
    , Tiles(rows, angles * (azimuths + 1))
  {
  }

  int Rows; // of the map that is everywhere
  int Columns;
  int Angles;
  int Azimuths;
  TableTiles Tiles;
  bool HasFloor = false;
  std::vector<float> Profile; // RGB, ProfileSize x 3: (angle, cos, sin delta); share; c
  // Columns x GetHeight() x Angles (Azimuths + 1): the first azimuth comes again after the last. As
  // large as the format allows: the profile's share undoes that.
  Texels Radiance;
  // IrradianceSide x IrradianceSide (GetOctahedralPosition); null: there is no floor. Of all
  // materials.
  std::shared_ptr<const ScaledTexels> Irradiance;

  /// Of a slice: the map, and tiles below it.
  int GetHeight() const { return this->Rows + TableTiles::Texels * this->Tiles.Down; }

  /// Where the map of a view angle and an azimuth psi begins, in texels.
  std::size_t GetMap(int angle, int azimuth) const
  {
    return static_cast<std::size_t>(angle * (this->Azimuths + 1) + azimuth) *
           static_cast<std::size_t>(this->Columns) * this->GetHeight();
  }

  virtual ~RadianceTable() = default;

  /// Radiance towards o about the normal n, as the shader looks it up; t: a unit tangent or zero;
  /// lamps: beside the table, or null.
  virtual glm::dvec3 Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t,
    const TableLamps* lamps = nullptr) const;

  /// What a shader needs to do the same: one term.
  virtual vtkBRDFShaderInputs GetShaderInputs() const;

  /// The profile as shaders read it: RGBA of ProfileTexels view angles, the share and by how much
  /// the sine of the axis' angle exceeds that of the view's, so that what mirrors has no steps; in
  /// a second row, where there is a floor, the Lambert part.
  std::vector<float> GetShaderProfile() const;

protected:
  /// Of the Lambert part, at a normal.
  glm::dvec3 GetIrradiance(const glm::dvec3& n) const;

  /// A form of the term, with the textures of radiance, so many texels high and deep, and
  /// irradiance.
  vtkBRDFShaderInputs MakeForm(vtkBRDFShaderInputs::Term term, int height, int depth) const;
};

/// The clamped cosine's harmonics, of degree l and order 0 about its axis; the others are 0.
inline double GetClampedCosine(int l)
{
  double value = l == 1 ? 2.0 * Pi / 3.0 : 0.0;
  if (l % 2 == 0)
  {
    value = 2.0 * Pi * (l % 4 == 0 ? -1.0 : 1.0) / ((l + 2.0) * (l - 1.0)) *
            std::exp(LogFactorial(l) - 2.0 * LogFactorial(l / 2) - l * std::log(2.0));
  }
  return value * std::sqrt((2.0 * l + 1.0) / (4.0 * Pi));
}

/// From a table's Fourier series over the azimuth of the plane of incidence to its slices: radiance
/// = G_0 + sum_k>0 2 Re(e^(-i k psi) G_k), at each texel of each view angle's map. Both have as
/// many numbers, so that the series lies where the slices will.
class AzimuthSeries
{
public:
  /// Of orders up to half of the azimuths; those that are not set are 0.
  AzimuthSeries(int angles, int azimuths, std::size_t texels);

  /// G_k of each channel: some angles from the first on x texels.
  void Set(int order, const FieldSynthesis::Fields& fields, std::size_t firstAngle = 0);

  /// RGB by view angle and azimuth, the first one again after the last, fitted for linear
  /// interpolation between azimuths (FieldSynthesis.h). Nothing is left here.
  std::vector<float> TakeRadiance();

private:
  int Azimuths;
  std::size_t Slices; // of each view angle
  std::size_t Size;   // RGB of a map
  std::vector<float> Values;
};

/// Degree of the harmonics that a map of irradiance needs: the cosine's fall as l^-2.5.
constexpr int IrradianceDegree = 128;

/// Degree of the harmonics that make a map of so many rows, unless it is set. More than the rows
/// resolve, which measured best (docs/methods/tables.md).
inline int GetMapDegree(int rows) { return rows + std::min(rows / 2, 64); }

/// Harmonics that end at once make lamps ring: from three fifths of the rows on they fade out.
inline double GetTaper(int l, int degree, int rows)
{
  const double from = 0.6 * rows;
  return l <= from ? 1.0 : 0.5 + 0.5 * std::cos(Pi * (l - from) / (degree + 1.0 - from));
}

/// What a blur leaves of degree l; smoothing: the degree about which it ends; 0: no blur.
inline double GetSmoothed(int l, double smoothing)
{
  return smoothing > 0.0 ? std::exp(-0.5 * l * (l + 1.0) / (smoothing * smoothing)) : 1.0;
}

/// What a table of so many rows has of the kernels at its view angles: harmonics about each one's
/// axis, times its albedo, less what a blur takes and what fades, as ExpandLobes has them; all or
/// what lies outside of the LampWindow.
std::vector<std::vector<float>> ExpandTableKernels(MaterialKernels& knots, int degree, int orders,
  double smoothing, int rows, bool outsideOnly = false);

/// Sum of the squares of an environment's harmonics of one degree.
double GetEnergy(const EnvironmentHarmonics& environment, int channel, int l);

/// What a table shows.
struct TableLight
{
  const EnvironmentHarmonics& Environment; // without lamps, if All is given
  const EnvironmentHarmonics* All;         // with them, which the LampWindow hides; null: none
};

/// The table's radiance, of kernels at its view angles up to a harmonic degree. goOn gets the share
/// that is done; where it says false, the table is not complete, and the result is 0. Else it is
/// what undoes the radiance's scaling.
double SynthesizeRadiance(const TableLight& light, MaterialKernels& knots, int degree,
  double smoothing, const std::function<bool(double)>& goOn, RadianceTable& table);

/// RGB scaled so that the peak is the format's largest value, whatever the unit of the light is;
/// negative values are 0. Returns what undoes the scaling.
double PackRadiance(const std::vector<float>& radiance, RadianceTable::Texels& texels);

/// Puts what a profile has at a number of its texels: what is first; the rest's share, which sees
/// to it that what interpolation between kernels misses of the lobe's directional albedo goes to
/// the rest; and the Lambert part, if there is one, as the result says. The profile has a third of
/// its numbers for each of these. scale: what undoes the radiance's scaling.
bool PutProfile(const LobeMeans& lobe, const LobeMeans& between, const glm::dvec3& first,
  double scale, std::size_t at, std::vector<float>& profile);

/// A table's profile over all view angles; scale: what undoes its radiance's scaling.
void MakeProfile(
  const LobeViews& views, const MaterialKernels& knots, double scale, RadianceTable& table);

/// An octahedral map of irradiance.
std::shared_ptr<const ScaledTexels> MakeIrradiance(const EnvironmentHarmonics& environment);

/**
 * The table for anisotropic materials, which has no tiles:
 *
 *   L_o = c(theta_o, phi_o) E(n) + s(theta_o, phi_o) T(D, psi, theta_o, phi_o)
 *
 * D is the direction of the lobe's axis. psi is the azimuth about D of the tangent, carried from
 * the normal to the axis by the smallest rotation. In this frame lobes of neighboring views
 * resemble each other, so few views suffice, between which T is interpolated linearly.
 *
 * T is a 3D texture: azimuth of D; polar angle of D within azimuths of the view; psi within polar
 * angles of the view. Four trilinear fetches interpolate it in all five numbers. f that is the same
 * after half a turn of the sample, as of brushed metal, needs views over half a turn only.
 */
struct AnisotropicTable : RadianceTable
{
  AnisotropicTable(int rows, int angles, int azimuths, int viewAzimuths)
    : RadianceTable(std::min(rows, TableTiles::LargestWhole), angles, azimuths)
    , ViewAzimuths(viewAzimuths)
  {
  }

  // The profile is RGB, AnisotropicViews::Angles x Azimuths x 3: (the axis' parts along and across
  // the view's part along the surface, view angle); share; c. Radiance is of Columns x (Rows
  // ViewAzimuths) x (Angles (Azimuths + 1)) texels.
  int ViewAzimuths; // over the period
  int Periods = 1;  // of f in a turn, 1 or 2

  std::size_t GetNumberOfTexels() const
  {
    return static_cast<std::size_t>(this->Columns) * this->Rows;
  }

  /// The radiance, of kernels up to a harmonic degree. goOn gets the share that is done; where it
  /// says false, the table is not complete, and the result is 0. Else it is what undoes the
  /// radiance's scaling.
  double Synthesize(const EnvironmentHarmonics& environment, const MaterialKernels& knots,
    int degree, const std::function<bool(double)>& goOn);

  /// The profile over all views; scale: what undoes the radiance's scaling.
  void MakeProfile(const AnisotropicViews& views, const MaterialKernels& knots, double scale);

  glm::dvec3 Evaluate(const glm::dvec3& n, const glm::dvec3& o, const glm::dvec3& t,
    const TableLamps* lamps = nullptr) const override;
  vtkBRDFShaderInputs GetShaderInputs() const override;

private:
  glm::dvec3 GetProfile(int layer, double u, double period) const;
};
} // namespace measuredbrdf

#endif
