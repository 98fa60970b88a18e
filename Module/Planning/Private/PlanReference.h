// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   PlanReference
 * @brief   what the planner measures its candidates against: nearly exact, thousands of times
 * cheaper
 *
 * Suns and lamps are lights of their own, but for lobes so sharp that they see them as areas. The
 * material's broad layer (LobeSplit) is summed over the lights of a variance light set of the rest,
 * thousands of them or, where some pairs show that the material does not tell them from all,
 * hundreds; its sharp layer over thousands of directions drawn by itself for each pair, each
 * reading the rest's texel. Unbiased but for the lights; isotropic or not. Private to the module.
 */

#ifndef PlanReference_h
#define PlanReference_h

#include "EnvironmentPrecomputation.h"
#include "LobeSplit.h"
#include "LocalFrame.h"
#include "vtkRadianceIntegrator.h"

#include <glm/glm.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace measuredbrdf
{
class LobeTable;

class PlanReference : public vtkRadianceIntegrator
{
public:
  static PlanReference* New();
  vtkTypeMacro(PlanReference, vtkRadianceIntegrator);

  /// What plans are made for: the sum is far more accurate than that. Default 1e-3.
  void SetErrorTolerance(double tolerance) { this->ErrorTolerance = tolerance; }

protected:
  PlanReference();
  ~PlanReference() override;

  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

private:
  PlanReference(const PlanReference&) = delete;
  void operator=(const PlanReference&) = delete;

  // A normal and a view; the cut's heights for that view.
  struct Pair
  {
    Frame Local;
    glm::dvec3 View;
    LobeSplit::View Cut;
  };

  bool ChooseLights(const std::function<bool()>& goOn);
  static std::vector<ExtractedEmitters::Light> GetLights(vtkLightSet* set);
  Pair MakePair(const Frame& about, const glm::dvec3& lifted) const;
  glm::dvec3 Evaluate(const glm::dvec3& i, const Pair& pair) const;
  glm::dvec3 SumLights(const std::vector<ExtractedEmitters::Light>& lights, const Pair& pair) const;

  double ErrorTolerance = 1e-3;
  std::vector<ExtractedEmitters::Light> Suns;
  EnvironmentPrecomputation::Rest Rest;         // null: there are no suns
  std::vector<ExtractedEmitters::Light> Lights; // of the rest
  std::shared_ptr<const LobeSplit> Cut;         // null: there is no sharp layer
  vtkSmartPointer<vtkBRDF> Sharp;               // that
  std::unique_ptr<LobeTable> Lobes;             // of that
  bool SharpSeesSuns = false;                   // in its samples: it is sharper than texels
};
} // namespace measuredbrdf

#endif
