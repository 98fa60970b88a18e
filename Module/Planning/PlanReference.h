// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   PlanReference
 * @brief   what the planner measures its candidates against: nearly exact, thousands of times
 * cheaper
 *
 * Suns and lamps are lights of their own. The material's broad layer (KernelCut) is summed over
 * thousands of lights of a variance light set of the rest, its sharp layer over thousands of
 * directions drawn by itself for each pair, each reading the rest's texel. Unbiased but for the
 * lights; isotropic or not. Private to the module.
 */

#ifndef PlanReference_h
#define PlanReference_h

#include "EnvironmentParts.h"
#include "vtkRadianceIntegrator.h"

#include <memory>
#include <vector>

namespace measuredbrdf
{
class KernelCut;
class LobeTable;
class RadianceParts;

class PlanReference : public vtkRadianceIntegrator
{
public:
  static PlanReference* New();
  vtkTypeMacro(PlanReference, vtkRadianceIntegrator);

  /// What is known of the material; null (default): nothing.
  void SetParts(const std::shared_ptr<RadianceParts>& parts) { this->Parts = parts; }

protected:
  PlanReference();
  ~PlanReference() override;

  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

private:
  PlanReference(const PlanReference&) = delete;
  void operator=(const PlanReference&) = delete;

  std::vector<BrightTexels::Light> Suns;
  EnvironmentParts::Rest Rest;             // null: there are no suns
  std::vector<BrightTexels::Light> Lights; // of the rest
  std::shared_ptr<RadianceParts> Parts;
  std::shared_ptr<const KernelCut> Cut; // null: there is no sharp layer
  vtkSmartPointer<vtkBRDF> Sharp;       // that
  std::unique_ptr<LobeTable> Lobes;     // of that
};
} // namespace measuredbrdf

#endif
