// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDistributionBRDFFitter
 * @brief   fits a Lambert part and a D-BRDF: tables of p(h) and F(theta_d)
 *
 * The fit starts with the Lambert part from the least values within 60 degrees of the normal; with
 * p from retro-reflection, p(theta) = 4 f(theta) (2 cos - cos^2) (exact except for a scale,
 * Ashikhmin and Premoze 2007); and with F from the mirror direction, constant, or Schlick's. Then,
 * per channel, it improves p and F in turn, each with the Lambert part, by non-negative linear
 * least squares on the linearized loss (Gauss-Newton), with the step length that lowers the
 * residual. Cells without pairs follow their neighbors.
 *
 * p has 128 samples along theta_h, or 48 where it is anisotropic; F has 32 along theta_d, and never
 * falls towards grazing. The output is a vtkSumBRDF of a vtkLambertBRDF and a vtkDistributionBRDF
 * whose p is normalized (the integral of p cos theta_h is 1), so that F contains the scale.
 */

#ifndef vtkDistributionBRDFFitter_h
#define vtkDistributionBRDFFitter_h

#include "vtkBRDFFitter.h"

#include <vector> // for FitTo

class VTKMEASUREDBRDF_EXPORT vtkDistributionBRDFFitter : public vtkBRDFFitter
{
public:
  static vtkDistributionBRDFFitter* New();
  vtkTypeMacro(vtkDistributionBRDFFitter, vtkBRDFFitter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Samples of p along phi_h, 1 (isotropic) to 1024; 0 (default): 1, or 32 where the input is
   * anisotropic.
   */
  virtual void SetNumberOfPhiSamples(int numberOfPhiSamples);
  vtkGetMacro(NumberOfPhiSamples, int);
  ///@}

  std::string GetModelName() override { return "D-BRDF"; }

protected:
  vtkDistributionBRDFFitter() = default;
  ~vtkDistributionBRDFFitter() override = default;

  Result FitTo(const std::vector<Sample>& samples) override;

  int NumberOfPhiSamples = 0;

private:
  vtkDistributionBRDFFitter(const vtkDistributionBRDFFitter&) = delete;
  void operator=(const vtkDistributionBRDFFitter&) = delete;
};

#endif
