// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAdaptiveRadianceIntegrator
 * @brief   the exact sum to a tolerance, fast enough for every pixel of a picture
 *
 * Like vtkExactRadianceIntegrator it sums f(i,o) cos(theta_i) L dw over the environment's texels,
 * but it looks at single texels only where that counts. It begins with squares of many texels, each
 * with its irradiance and its mean direction, and divides the one whose four quarters differ most
 * from it, until what remains is below the tolerance (globally adaptive cubature, as Genz and Malik
 * 1980 do it). Squares are small in any case about directions drawn from f cos(theta_i), and grow
 * with the distance to them, so that no narrow lobe hides between the squares' middles. With a
 * tolerance of 0 it is the exact sum.
 *
 * The tolerance is compared with an estimate of the error, which is no bound. Tests hold each pair
 * within 0.3 % of the exact sum with the default, from felt to mirror-like paint.
 */

#ifndef vtkAdaptiveRadianceIntegrator_h
#define vtkAdaptiveRadianceIntegrator_h

#include "vtkRadianceIntegrator.h"

#include <memory> // for Prepared

class VTKMEASUREDBRDF_EXPORT vtkAdaptiveRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkAdaptiveRadianceIntegrator* New();
  vtkTypeMacro(vtkAdaptiveRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where to stop: the estimated error of the sum over the channels, relative to that sum; default
   * 5e-4, clamped to [0, 0.5].
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 0.5);
  vtkGetMacro(Tolerance, double);
  ///@}

  /// "adaptive": never a planner's choice, nothing that a mapper can draw.
  std::string GetMethodName() override { return "adaptive"; }
  std::string GetMethodDescription() override
  {
    return "the exact sum to a tolerance, texels summed in groups where that is enough";
  }

protected:
  vtkAdaptiveRadianceIntegrator();
  ~vtkAdaptiveRadianceIntegrator() override;

  void CopyProperties(vtkRadianceIntegrator* source) override;
  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

private:
  vtkAdaptiveRadianceIntegrator(const vtkAdaptiveRadianceIntegrator&) = delete;
  void operator=(const vtkAdaptiveRadianceIntegrator&) = delete;

  double Tolerance = 5e-4;
  struct Internals;
  std::unique_ptr<const Internals> Prepared; // null: nothing yet
};

#endif
