// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBasisRadianceIntegrator
 * @brief   basis pre-integration: K look-ups a pixel hold every texel of the environment
 *
 * f(i,o) ~ sum_k U_k(o) V_k(i), so L_o(n,o) = sum_k U_k(o) E_k(n) with E_k(n) = integral of L V_k
 * cos(theta_i) in the frame of n. The E_k are maps over normals, made once an environment; its
 * rotation is one of n and costs nothing. V_k: the best basis for the material, a Fourier series in
 * the azimuths' difference, each order decomposed by singular values (weights: both cosines), or
 * the thesis's own where the material is a vtkBasisBRDF.
 *
 * Errors: truncation (GetTruncationError, of the BRDF; in a picture it is usually smaller), the
 * maps' interpolation, and the lights' grouping into NumberOfClusters directions. Sums may be
 * negative; the radiance is clamped at 0. Broad lobes need few functions, sharp ones thousands.
 * Isotropic materials only: others are refused with an error event. Views closer to the horizon
 * than 1.1 degrees are taken there, as the shader takes them.
 */

#ifndef vtkBasisRadianceIntegrator_h
#define vtkBasisRadianceIntegrator_h

#include "vtkRadianceIntegrator.h"

#include <memory> // for tables

class VTKMEASUREDBRDF_EXPORT vtkBasisRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkBasisRadianceIntegrator* New();
  vtkTypeMacro(vtkBasisRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Relative L2 error of the BRDF to aim at, in [1e-4, 1], default 0.01, and the most functions
   * (look-ups a pixel) to spend on it, in [1, 256], default 64.
   */
  virtual void SetTolerance(double tolerance);
  vtkGetMacro(Tolerance, double);
  virtual void SetMaximumNumberOfTerms(int maximumNumberOfTerms);
  vtkGetMacro(MaximumNumberOfTerms, int);
  ///@}

  ///@{
  /**
   * Texels along a map's side (each half of the sphere of normals has one), in [8, 128], default
   * 48.
   */
  virtual void SetMapSize(int mapSize);
  vtkGetMacro(MapSize, int);
  ///@}

  ///@{
  /**
   * Lights of the variance light set (vtkVarianceLightSetGenerator) that stands for the
   * environment, in [64, 1048576], default 1024.
   */
  virtual void SetNumberOfClusters(int numberOfClusters);
  vtkGetMacro(NumberOfClusters, int);
  ///@}

  ///@{
  /**
   * Whether a vtkBasisBRDF is taken by its own functions and coefficients, all of them; default
   * off. Exact but for the clamp: the material clamps every pair's sum at 0, here only the radiance
   * can be. Other materials ignore it.
   */
  vtkSetMacro(UseOwnBasis, bool);
  vtkGetMacro(UseOwnBasis, bool);
  vtkBooleanMacro(UseOwnBasis, bool);
  ///@}

  ///@{
  /**
   * Of what was prepared last: functions in use, and the relative L2 error of the BRDF by leaving
   * out the others (0 with the material's own basis).
   */
  int GetNumberOfTerms();
  double GetTruncationError();
  ///@}

  bool GetShaderInputs(vtkBRDFShaderInputs& form) override;

  ///@{
  /**
   * As a method: "basis", by the most functions and the map's size; planners try it for comparison
   * only. Its cost counts, before Prepare, all functions that there may be.
   */
  std::string GetMethodName() override { return "basis"; }
  std::string GetMethodDescription() override
  {
    return "maps over the normal, one for each function of the material's basis";
  }
  std::vector<Size> GetSizes() override;
  std::string GetSizesText() override;
  std::vector<std::vector<int>> GetCandidateSizes(bool all) override;
  double EstimateCost() override;
  vtkIdType EstimateTextureBytes() override;
  ///@}

protected:
  vtkBasisRadianceIntegrator();
  ~vtkBasisRadianceIntegrator() override;

  void SetSize(int index, int value) override;
  void CopyProperties(vtkRadianceIntegrator* source) override;
  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  double Tolerance = 0.01;
  int MaximumNumberOfTerms = 64;
  int MapSize = 48;
  int NumberOfClusters = 1024;
  bool UseOwnBasis = false;

private:
  vtkBasisRadianceIntegrator(const vtkBasisRadianceIntegrator&) = delete;
  void operator=(const vtkBasisRadianceIntegrator&) = delete;

  struct Tables;
  bool MakeTerms(Tables& tables);
  bool MakeMaps(Tables& tables);

  std::unique_ptr<Tables> Current;
};

#endif
