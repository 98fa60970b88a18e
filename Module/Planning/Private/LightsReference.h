// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   LightsReference
 * @brief   a sum over many lights, for lobes that are broad
 *
 * Suns and lamps are lights of their own. The rest is a variance light set of hundreds or thousands
 * of lights. How far that is from the integral depends on the material: MakeReference measures it.
 * Private to the module.
 */

#ifndef LightsReference_h
#define LightsReference_h

#include "LightLanes.h"
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

  /// Of the variance light set, descending: all that it can have, the default, and fewer.
  static const std::vector<int>& GetCounts();
  vtkSetMacro(NumberOfLights, int);

protected:
  LightsReference();
  ~LightsReference() override;

  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

private:
  LightsReference(const LightsReference&) = delete;
  void operator=(const LightsReference&) = delete;

  int NumberOfLights;
  LightLanes Lanes; // of the material
  // By index: the material is evaluated for many at a time.
  std::vector<glm::dvec3> Directions;
  std::vector<glm::dvec3> Irradiances;
};
} // namespace measuredbrdf

#endif
