// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkExactIntegrator
 * @brief   the reference: the sum over every texel of the environment, in double precision
 *
 * L_o = sum over texels of f(i,o) cos(theta_i) L dw with i at the texel's centre and dw its exact
 * solid angle. Every other integrator is measured against this one.
 */

#ifndef vtkExactIntegrator_h
#define vtkExactIntegrator_h

#include "vtkRadianceIntegrator.h"

#include <vector> // for texels

class VTKMEASUREDBRDF_EXPORT vtkExactIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkExactIntegrator* New();
  vtkTypeMacro(vtkExactIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkExactIntegrator() = default;
  ~vtkExactIntegrator() override = default;

  bool Begin() override;
  int GetNumberOfParts() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

private:
  vtkExactIntegrator(const vtkExactIntegrator&) = delete;
  void operator=(const vtkExactIntegrator&) = delete;

  std::vector<double> Texels; // direction, irradiance: 6 per texel that is not black
};

#endif
