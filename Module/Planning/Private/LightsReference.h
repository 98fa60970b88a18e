// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   LightsReference
 * @brief   a nearly exact sum for lobes that are broad
 *
 * Suns and lamps are lights of their own. The rest is a variance light set of thousands of lights
 * or, where some pairs show that the material does not tell them from all, of hundreds. Isotropic
 * or not. Private to the module.
 */

#ifndef LightsReference_h
#define LightsReference_h

#include "EnvironmentPrecomputation.h"
#include "LightLanes.h"
#include "LocalFrame.h"
#include "vtkRadianceIntegrator.h"

#include <glm/glm.hpp>

#include <vector>

namespace measuredbrdf
{
class LightsReference : public vtkRadianceIntegrator
{
public:
  /// That are extracted.
  static constexpr int MaximumSuns = 64;

  static LightsReference* New();
  vtkTypeMacro(LightsReference, vtkRadianceIntegrator);

  /// What plans are made for: the sum is far more accurate than that. Default 1e-3.
  void SetErrorTolerance(double tolerance) { this->ErrorTolerance = tolerance; }

  /// Relative, by what the pairs told when the lights were chosen; after Prepare.
  double GetError() const { return this->Error; }

protected:
  LightsReference();
  ~LightsReference() override;

  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

private:
  LightsReference(const LightsReference&) = delete;
  void operator=(const LightsReference&) = delete;

  /// By index: Sum evaluates the material for many at a time.
  struct Lights
  {
    std::vector<glm::dvec3> Directions;
    std::vector<glm::dvec3> Irradiances;
  };
  void ChooseLights(const std::vector<vtkSmartPointer<vtkLightSet>>& sets);
  static Lights GetLights(vtkLightSet* set);
  glm::dvec3 Sum(const Lights& lights, const Frame& frame, const glm::dvec3& view) const;

  double ErrorTolerance = 1e-3;
  double Error = 0.0;
  LightLanes Lanes; // of the material
  Lights Suns;
  Lights Others;
};
} // namespace measuredbrdf

#endif
