// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAshikhminShirleyBRDFFitter
 * @brief   fits a Lambert part and 1 to 3 Ashikhmin-Shirley lobes
 *
 * The unknowns are an RGB albedo and, per lobe, one exponent (two if it is anisotropic: along the
 * tangent and the bitangent), an RGB scale S >= 0 and an RGB reflectance R in [0,1] of Schlick's
 * Fresnel term. The solver works on S R and S (1 - R), in which the model is linear and S and R
 * cannot cancel. The lobes have no coupled diffuse part: the Lambert term replaces it.
 *
 * All log-spaced combinations of exponents are tried with their best coefficients, and the best
 * NumberOfStarts are refined with Ceres (Levenberg-Marquardt within bounds, analytic derivatives).
 * The output is a vtkSumBRDF of a vtkLambertBRDF and the lobes by ascending exponent.
 */

#ifndef vtkAshikhminShirleyBRDFFitter_h
#define vtkAshikhminShirleyBRDFFitter_h

#include "vtkBRDFFitter.h"

#include <vector> // for FitTo

class VTKMEASUREDBRDF_EXPORT vtkAshikhminShirleyBRDFFitter : public vtkBRDFFitter
{
public:
  static vtkAshikhminShirleyBRDFFitter* New();
  vtkTypeMacro(vtkAshikhminShirleyBRDFFitter, vtkBRDFFitter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum AnisotropyType
  {
    AS_INPUT = 0, // anisotropic where the input is
    ISOTROPIC = 1,
    ANISOTROPIC = 2
  };

  ///@{
  /**
   * Number of lobes, 1 to 3; default 1. Other numbers are refused.
   */
  virtual void SetNumberOfLobes(int numberOfLobes);
  vtkGetMacro(NumberOfLobes, int);
  ///@}

  ///@{
  /**
   * Whether the lobes have two exponents each: AS_INPUT (default), ISOTROPIC or ANISOTROPIC.
   */
  virtual void SetAnisotropy(int anisotropy);
  vtkGetMacro(Anisotropy, int);
  ///@}

  std::string GetModelName() override { return "Ashikhmin-Shirley"; }

protected:
  vtkAshikhminShirleyBRDFFitter() = default;
  ~vtkAshikhminShirleyBRDFFitter() override = default;

  Result FitTo(const std::vector<Sample>& samples) override;

  int NumberOfLobes = 1;
  int Anisotropy = AS_INPUT;

private:
  vtkAshikhminShirleyBRDFFitter(const vtkAshikhminShirleyBRDFFitter&) = delete;
  void operator=(const vtkAshikhminShirleyBRDFFitter&) = delete;
};

#endif
