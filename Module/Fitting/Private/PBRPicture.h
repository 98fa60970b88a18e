// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures of a sphere under a gray light, drawn by a measured material and by VTK's physically
 * based shading with the same quadrature, so that they can be compared.
 */

#ifndef PBRPicture_h
#define PBRPicture_h

#include "PBRShading.h"

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class PBRPicture
{
public:
  using Light = std::function<double(const glm::dvec3&)>;

  /// The brdf must be prepared. The light is gray radiance by direction, with no details finer than
  /// ten degrees. The sphere is seen from +z.
  PBRPicture(vtkBRDF* brdf, const Light& light);

  /// Base color of least error for the other parameters (of a roughness in hundredths), and that
  /// error: relative L1 over pixels and channels.
  double FitColor(const PBRParameters& parameters, std::array<double, 3>& color);

private:
  // A direction to the light adds f * Weight * L to a pixel's radiance.
  struct Direction
  {
    glm::dvec3 Local;
    double Weight;
    double NdH;
    double S; // (1 - H.L)^5
  };
  struct Pixel
  {
    int View;
    std::vector<double> Light; // Weight * L of each of the view's directions
    PBRMoments Diffuse;
  };
  /// Radiance of a pixel as a polynomial of the channel's base color.
  using Quadratic = std::array<double, 3>;

  void AddView(double cosine);
  void AddPixels(int view, const Light& light);
  void Draw(vtkBRDF* brdf);
  const std::vector<PBRMoments>& GetSpecularMoments(double roughness);
  void GetRadiance(const PBRParameters& parameters, double f90, std::vector<Quadratic>& radiance);
  double GetDistance(
    const std::vector<Quadratic>& radiance, std::size_t channel, double color) const;
  double FitChannel(
    const std::vector<Quadratic>& radiance, std::size_t channel, double& color) const;

  std::vector<double> ViewCosines;
  std::vector<std::vector<Direction>> Directions; // by view
  std::vector<Pixel> Pixels;
  int NumberOfTangents = 1;
  std::vector<double> Reference;                          // by pixel, tangent, channel
  double Total = 0.0;                                     // of Reference
  std::map<int, std::vector<PBRMoments>> SpecularMoments; // by roughness in hundredths
};
} // namespace measuredbrdf

#endif
