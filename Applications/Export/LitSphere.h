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

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
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
  LitSphere(const std::array<double, 3>& view, bool isotropic);

  /// Light it once more, by another environment; its rotation does not apply.
  void AddLight(vtkEnvironment* environment);

  /// Radiance by light, by pixel and by channel.
  std::vector<double> Sum(vtkBRDF* brdf) const;

  int GetNumberOfLights() const { return static_cast<int>(this->Lights.size()); }
  std::size_t GetNumberOfPixels() const { return this->Pixels.size(); }

  /// A pixel's normal in the world.
  glm::dvec3 GetNormal(std::size_t pixel) const { return this->Pixels[pixel].Frame[2]; }

private:
  struct Pixel
  {
    glm::dmat3 Frame; // columns: tangent, bitangent, normal
    std::size_t View;
  };
  struct View
  {
    glm::dvec3 Direction; // local
    double Azimuth;
    std::vector<Directions> Lights;    // of the nodes above the horizon, local
    std::vector<std::ptrdiff_t> Nodes; // each one's place in Lights; -1 below the horizon
  };
  /// Irradiance at a pixel's nodes above the horizon, RGB.
  using Energies = std::vector<glm::dvec3>;

  std::size_t AddView(const glm::dvec3& direction);
  void Collect(vtkEnvironment* environment, const Pixel& pixel, Energies& energies) const;
  void Splat(
    const View& view, const glm::dvec3& light, const glm::dvec3& energy, Energies& energies) const;
  std::vector<glm::dvec3> Evaluate(vtkBRDF* brdf, const View& view) const;

  bool Isotropic;
  int NumberOfAzimuths;
  std::vector<View> Views;
  std::vector<Pixel> Pixels;
  std::vector<std::vector<Energies>> Lights; // by light, by pixel
};

/// The direction to the viewer of an azimuth and an elevation, as OffscreenScene::SetView has them.
std::array<double, 3> GetViewDirection(const View& view);

/// Every pixel of a square picture of that size that a sphere covers, which touches its sides.
Surface MakeSphereSurface(int size, const View& view);
} // namespace tool

#endif
