// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBlinnPhongBRDFFitter
 * @brief   fits a Lambert part and 1 to 3 Blinn-Phong lobes
 *
 * The unknowns are an RGB albedo and, per lobe, an exponent and an RGB scale >= 0. All log-spaced
 * combinations of exponents are tried with their best scales, and the best NumberOfStarts are
 * refined with Ceres (Levenberg-Marquardt within bounds, analytic derivatives). The output is a
 * vtkSumBRDF of a vtkLambertBRDF and the lobes by ascending exponent.
 */

#ifndef vtkBlinnPhongBRDFFitter_h
#define vtkBlinnPhongBRDFFitter_h

#include "vtkBRDFFitter.h"

#include <vector> // for FitTo

class VTKMEASUREDBRDF_EXPORT vtkBlinnPhongBRDFFitter : public vtkBRDFFitter
{
public:
  static vtkBlinnPhongBRDFFitter* New();
  vtkTypeMacro(vtkBlinnPhongBRDFFitter, vtkBRDFFitter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Number of lobes, 1 to 3; default 1. Other numbers are refused.
   */
  virtual void SetNumberOfLobes(int numberOfLobes);
  vtkGetMacro(NumberOfLobes, int);
  ///@}

  std::string GetModelName() override { return "Blinn-Phong"; }

protected:
  vtkBlinnPhongBRDFFitter() = default;
  ~vtkBlinnPhongBRDFFitter() override = default;

  Result FitTo(const std::vector<Sample>& samples) override;

  int NumberOfLobes = 1;

private:
  vtkBlinnPhongBRDFFitter(const vtkBlinnPhongBRDFFitter&) = delete;
  void operator=(const vtkBlinnPhongBRDFFitter&) = delete;
};

#endif
