// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAdaptiveRadianceIntegrator
 * @brief   the reference: the integral itself to a tolerance, pair by pair
 *
 * It integrates f(i,o) cos(theta_i) L over the sky as vtkEnvironment defines it between texels. It
 * begins with squares of many texels and divides the one whose four quarters differ most from it,
 * down to small parts of texels, until what remains is below the tolerance (globally adaptive
 * cubature, as Genz and Malik 1980 do it). docs/methods/reference.md says what keeps it from
 * stopping early where a square and its quarters agree by chance.
 *
 * The tolerance is compared with an estimate of the error, which is no bound. Tests hold each pair
 * within 0.3 % of a fine sum with the default, from felt to mirror-like paint.
 * A sum over the texels' centers, as other programs do it, is something else for lobes as narrow as
 * a texel.
 */

#ifndef vtkAdaptiveRadianceIntegrator_h
#define vtkAdaptiveRadianceIntegrator_h

#include "vtkRadianceIntegrator.h"

#include <atomic> // for Evaluations
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
   * 1e-3, clamped to [1e-5, 0.5]. Values that no tolerance suits, as of hostile data, end at a
   * million squares of the sky.
   */
  vtkSetClampMacro(Tolerance, double, 1e-5, 0.5);
  vtkGetMacro(Tolerance, double);
  ///@}

  /**
   * Like Integrate, for an isotropic BRDF and pixels of a picture: pairs 4 k to 4 k + 3 are four
   * neighbors, which are summed over the same squares. That takes 0.7 to 0.9 times as long at the
   * same tolerance, and mostly is more exact. A four whose mirror directions are more than 2.3
   * degrees from that of its first pair is summed pair by pair, to 0.7 of the tolerance. To
   * fill a four up, repeat a pair. Fails, with an error event, where Integrate does, where the
   * number of pairs is no multiple of 4, and where the BRDF is anisotropic.
   */
  bool IntegrateNeighbors(vtkDataArray* normals, vtkDataArray* views, vtkDataArray* radiance);

  /// How often this has evaluated f so far, about: what integrating costs, whatever the machine.
  vtkTypeInt64 GetNumberOfEvaluations() { return this->Evaluations; }

  /// "reference": never a planner's choice, nothing that a mapper can draw.
  std::string GetMethodName() override { return "reference"; }
  std::string GetMethodDescription() override
  {
    return "the integral itself, each pixel within 0.3 %, on the CPU";
  }

protected:
  vtkAdaptiveRadianceIntegrator();
  ~vtkAdaptiveRadianceIntegrator() override;

  void CopyProperties(vtkRadianceIntegrator* source) override;
  bool Begin() override;
  void IntegratePair(
    const double n[3], const double o[3], const double t[3], double radiance[3]) override;

private:
  vtkAdaptiveRadianceIntegrator(const vtkAdaptiveRadianceIntegrator&) = delete;
  void operator=(const vtkAdaptiveRadianceIntegrator&) = delete;

  double Tolerance = 1e-3;
  void IntegrateFour(const vtkDirectionPair* pairs, double* radiance);
  void SumPair(const vtkDirectionPair& pair, double tolerance, double* radiance);
  struct Internals;
  std::unique_ptr<const Internals> Prepared; // null: nothing yet
  std::atomic<vtkTypeInt64> Evaluations{ 0 };
};

#endif
