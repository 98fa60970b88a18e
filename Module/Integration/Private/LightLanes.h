// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * f of many lights for one view, in the fastest way that the material offers.
 */

#ifndef LightLanes_h
#define LightLanes_h

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

class vtkAdaptiveWarpBRDF;
class vtkAshikhminShirleyBRDF;
class vtkBRDF;
class vtkLambertBRDF;
class vtkTabulatedBRDF;

namespace measuredbrdf
{
/// Valid until the material changes.
class LightLanes
{
public:
  LightLanes() = default;
  explicit LightLanes(vtkBRDF* brdf);

  /// Whether the material evaluates them side by side: far faster than one by one.
  bool AreSideBySide() const;

  /// In single precision. Of a prepared material; lights: x, y and z of unit vectors above the
  /// horizon, like the view; f: red, green and blue.
  void Evaluate(
    int count, const float* const lights[3], const glm::dvec3& view, float* const f[3]) const;

  /// The same. In double precision where the material evaluates them one by one.
  void Evaluate(
    std::size_t count, const glm::dvec3* lights, const glm::dvec3& view, glm::dvec3* f) const;

private:
  void AddUp(
    int count, const float* const lights[3], const glm::dvec3& view, float* const f[3]) const;

  vtkBRDF* BRDF = nullptr;
  // One of these, or none:
  vtkAdaptiveWarpBRDF* Warp = nullptr;
  vtkTabulatedBRDF* Table = nullptr;
  vtkAshikhminShirleyBRDF* Fit = nullptr;
  vtkLambertBRDF* Lambert = nullptr;
  std::vector<LightLanes> Terms; // of a sum
};
} // namespace measuredbrdf

#endif
