// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The kernel f(i,o) cos(theta_i) of one view, as a set of cells of the hemisphere, small where it
 * is large, and in a few numbers, which come from these cells; and of all views: of an isotropic
 * material over the view's polar angle, of an anisotropic one over its azimuth, too.
 */

#ifndef LobeViews_h
#define LobeViews_h

#include "HalfVector.h" // for Pi

#include <glm/glm.hpp>

#include <atomic>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class LobeQuadrature
{
public:
  struct Cell
  {
    glm::dvec3 Direction; // unit, local frame
    glm::dvec3 Weight;    // integral of f cos(theta_i) over the cell, RGB
    double SolidAngle;    // sr
    double Cosine;        // integral of cos(theta_i) over the cell
  };

  /// About as many cells as asked for (at least 16), for a prepared BRDF and unit o above the
  /// horizon.
  LobeQuadrature(vtkBRDF* brdf, const glm::dvec3& o, int count);

  const std::vector<Cell>& GetCells() const { return this->Cells; }

  /// A cell's share of the albedo, all channels, less a Lambert part; never negative.
  static double GetEnergy(const Cell& cell, const glm::dvec3& floor)
  {
    const glm::dvec3 rest = glm::max(cell.Weight - floor * cell.Cosine, glm::dvec3(0.0));
    return rest.x + rest.y + rest.z;
  }

  /// Sum of the weights: the directional albedo.
  glm::dvec3 GetAlbedo() const;

  /// Least mean of f, per channel, over cells whose cosine is at least minimumCosine.
  glm::dvec3 GetFloor(double minimumCosine) const;

private:
  std::vector<Cell> Cells;
};

/// Of a view o, which is (sin theta, 0, cos theta) for isotropic materials.
struct LobeMeans
{
  LobeMeans() = default;
  explicit LobeMeans(const LobeQuadrature& quadrature);

  /// For interpolation, which is a weighted sum.
  void Add(const LobeMeans& other, double weight);

  /// The Lambert part c in 1/sr: the least f up to 80 degrees.
  glm::dvec3 Floor = glm::dvec3(0.0);

  /// Directional albedo of the rest, which is 0 where it is rounding; never negative.
  glm::dvec3 Amplitude = glm::dvec3(0.0);

  ///@{
  /// The rest's mean direction, weighted by its cube so that the sharpest part of a kernel
  /// decides. Of an isotropic material it is (-sin delta, 0, cos delta); LobeViews then limits how
  /// fast its own deltas change from view to view.
  glm::dvec3 Axis = glm::dvec3(0.0);
  double Delta = 0.0;
  ///@}

  /// Directional albedo, the sum of all channels.
  double Albedo = 0.0;
};

/// The kernel f cos(theta_i) of views from the normal to the lowest that shaders take, as cells of
/// a quadrature: what cuts of one material have in common.
class LobeViews
{
public:
  /// They crowd towards the horizon, where measured f is steep.
  static constexpr int NumberOfViews = 64;

  /// Polar angle of one of so many views, from 0 to GetLastAngle(), the lowest that is told apart.
  static double GetAngle(int index, int count = NumberOfViews);
  static double GetLastAngle();

  /// Where between views an angle lies: 0 <= result <= NumberOfViews - 1.
  static double GetPosition(double angle);

  ///@{
  /// Polar angles of the view that a table has kernels at, from 0 to the last, k < count. They
  /// crowd towards the horizon a little, which measured best (docs/methods/tables.md). And where
  /// between them an angle lies: 0 <= result <= count - 1.
  static double GetKnotAngle(int k, int count);
  static double GetKnotPosition(double angle, int count);
  ///@}

  /// Of a prepared, isotropic BRDF. Of no use where it was aborted. quick: by a sixth of the
  /// evaluations.
  explicit LobeViews(vtkBRDF* brdf, const std::atomic<bool>& abort = Never, bool quick = false);

  struct Cell
  {
    double Energy; // of all channels, less the Lambert part; not negative
    double SolidAngle;
  };
  struct View
  {
    LobeMeans Means;
    std::vector<Cell> Cells; // none: interpolated. The first and the last view have some.
  };
  const std::vector<View>& GetViews() const { return this->Views; }

  /// The lobe's angle from the normal seen at a polar angle, between the views' Means.Delta. It
  /// follows the lobe's own where that moves at most one and a half times as fast as the view:
  /// where another part of f takes over, tables would turn the one before away from its place.
  double GetAxis(double theta) const;

  /// Largest share of a view's directional albedo that is sharp: of the kernel less its Lambert
  /// part, what is above the height at which all its energy would fill the solid angle (sr, > 0),
  /// and thus narrower than that (Markov's inequality). Of views that are at most so far from the
  /// normal: towards the horizon all lobes are narrow.
  double GetSharpShare(double solidAngle, double farthest = GetLastAngle()) const;

private:
  static const std::atomic<bool> Never;

  void Evaluate(
    vtkBRDF* brdf, const std::vector<int>& indices, int cells, const std::atomic<bool>& abort);
  LobeMeans Interpolate(const std::vector<int>& known, int index) const;
  void LimitAxes();

  std::vector<View> Views;
};

class AnisotropicViews
{
public:
  static constexpr int Angles = 24;   // polar angles; they crowd towards the horizon, as LobeViews'
  static constexpr int Azimuths = 16; // over the period

  /// A view at a polar angle and an azimuth, in radians.
  static glm::dvec3 GetView(double theta, double phi);

  /// Of a prepared BRDF. Of no use where it was aborted.
  AnisotropicViews(vtkBRDF* brdf, const std::atomic<bool>& abort);

  /// How often f repeats itself while the sample is turned once about its normal: 1 or 2.
  int GetPeriods() const { return this->Periods; }

  static double GetAngle(int index) { return LobeViews::GetAngle(index, Angles); }

  /// Of so many azimuths over the period; those of the views where none are said. In radians.
  double GetAzimuth(int index, int count = Azimuths) const
  {
    return 2.0 * Pi * index / (this->Periods * count);
  }

  const LobeMeans& Get(int angle, int azimuth) const
  {
    return this->Means[azimuth * Angles + angle];
  }

private:
  int Periods;
  std::vector<LobeMeans> Means;
};
} // namespace measuredbrdf

#endif
