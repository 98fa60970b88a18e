// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where a view is reflected to, so that sums over the environment know where to look: a few
 * directions drawn from f cos(theta_i), and the peaks of f, which few draws and few points of a sum
 * may both miss.
 */

#ifndef ReflectionGuide_h
#define ReflectionGuide_h

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class ReflectionGuide
{
public:
  /// Unit direction, and the solid angle in sr in which a draw is alone on average.
  struct Draw
  {
    glm::dvec3 Direction;
    double SolidAngle;
  };

  /// Of a prepared BRDF, which is used later on.
  explicit ReflectionGuide(vtkBRDF* brdf);

  /// Draws for unit o above the horizon, in its frame; draws is replaced.
  void Draws(const glm::dvec3& o, std::vector<Draw>& draws) const;

  /// The largest f of one view, by direction.
  class Peaks
  {
  public:
    /// In rad: within less, it is not known whether a peak is inside or beside.
    static constexpr double GetResolution() { return 0.04; }

    /// Sum of the channels, about unit i within so many radians and somewhat beyond; and the solid
    /// angle that this peak fills at least. 0 where nothing is known.
    double Get(const glm::dvec3& i, double radius, double& solidAngle) const;

  private:
    friend class ReflectionGuide;
    const float* Cells = nullptr; // all levels
    glm::dvec2 Azimuth;           // the view's: cosine and sine
  };
  Peaks GetPeaks(const glm::dvec3& o) const;

private:
  void TabulatePeaks();

  vtkSmartPointer<vtkBRDF> BRDF;
  std::vector<std::vector<Draw>> Views; // of an isotropic BRDF, their azimuth 0
  std::vector<float> PeakCells;         // likewise: view, level, cell of the hemisphere's square
};
} // namespace measuredbrdf

#endif
