// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The radiance of a sphere under environments as a sum over few directions, the same for every
 * material: what a fit compares, hundreds of times.
 *
 * The energy of every texel goes to the nodes of a grid over the half vector that surround it, so
 * nothing of the light is lost. The grid is finest about the mirror direction (theta_h grows with
 * the square of the node's number, MERL's spacing). A material is evaluated at the nodes.
 */

#ifndef LitSphere_h
#define LitSphere_h

#include "Inputs.h"
#include "Surface.h"
#include "SurfaceModel.h"

#include <Eigen/Core>
#include <glm/glm.hpp>

#include <vector>

class vtkBRDF;
class vtkEnvironment;

namespace tool
{
class LitSphere
{
public:
  /**
   * A sphere that is seen from far away, from a direction to the viewer in the world. isotropic:
   * only such materials are summed, which takes a fiftieth of the time. Anisotropic ones have their
   * tangents about the up axis, as IntegratePairs has them.
   */
  LitSphere(const glm::dvec3& view, bool isotropic);

  /// Light it once more, by another environment; its rotation does not apply.
  void AddLight(vtkEnvironment* environment);

  /// A column for each light: radiance by pixel and by channel.
  Eigen::ArrayXXd Sum(vtkBRDF* brdf) const;

  /// The pixels' normals in the world.
  std::vector<glm::dvec3> GetNormals() const;

private:
  struct Pixel
  {
    glm::dmat3 Frame; // columns: tangent, bitangent, normal
    std::size_t View;
  };
  struct LocalView
  {
    glm::dvec3 Direction;
    double Azimuth;
    std::vector<Directions> Lights; // of the nodes above the horizon
    std::vector<int> Nodes;         // each one's place in Lights; -1 below the horizon
  };
  /// Irradiance, RGB, at a pixel's nodes above the horizon.
  using Energies = Eigen::Array3Xd;

  void AddView(const glm::dvec3& direction);
  void Splat(const LocalView& view, const glm::dvec3& light, const glm::dvec3& energy,
    Energies& energies) const;
  Eigen::Array3Xd Evaluate(vtkBRDF* brdf, const LocalView& view) const;

  bool Isotropic;
  int NumberOfAzimuths;
  std::vector<LocalView> Views;
  std::vector<Pixel> Pixels;
  std::vector<std::vector<Energies>> Lights; // by light, by pixel
};

/// The direction to the viewer of an azimuth and an elevation, as OffscreenScene::SetView has them.
glm::dvec3 GetViewDirection(const View& view);

/// Every pixel of a square picture of that size that a sphere covers, which touches its sides.
Surface MakeSphereSurface(int size, const View& view);
} // namespace tool

#endif
