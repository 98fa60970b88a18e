// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkExactRadianceIntegrator
 * @brief   the sum over every texel of the environment, in double precision
 *
 * L_o = sum over texels of f(i,o) cos(theta_i) L dw with i at the texel's center and dw its exact
 * solid angle. Expected values of other programs are such sums. Radiance between the centers does
 * not take part, so lobes as narrow as a texel need vtkAdaptiveRadianceIntegrator, the reference.
 */

#ifndef vtkExactRadianceIntegrator_h
#define vtkExactRadianceIntegrator_h

#include "vtkRadianceIntegrator.h"

#include <vector> // for texels

class VTKMEASUREDBRDF_EXPORT vtkExactRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkExactRadianceIntegrator* New();
  vtkTypeMacro(vtkExactRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// "exact": never a planner's choice, nothing that a mapper can draw.
  std::string GetMethodName() override { return "exact"; }
  std::string GetMethodDescription() override
  {
    return "the sum over the centers of all texels, slow";
  }

protected:
  vtkExactRadianceIntegrator() = default;
  ~vtkExactRadianceIntegrator() override = default;

  bool Begin() override;
  int GetNumberOfParts() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

private:
  vtkExactRadianceIntegrator(const vtkExactRadianceIntegrator&) = delete;
  void operator=(const vtkExactRadianceIntegrator&) = delete;

  std::vector<double> Texels; // direction, irradiance: 6 per texel that is not black
};

#endif
