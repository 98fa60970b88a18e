// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDistributionBRDF
 * @brief   D-BRDF: f = p(h) F(i.h) / (4 (cos_i + cos_o - cos_i cos_o)), p and F tabulated
 *
 * Ashikhmin and Premoze 2007, "Distribution-based BRDFs" (thesis section 2.3.6). p is a microfacet
 * distribution in 1/sr, normalized or not, tabulated over theta_h (and phi_h where it is
 * anisotropic); F is tabulated over the angle between i and h. Both RGB, linearly interpolated,
 * reciprocal by construction.
 *
 * Tables: theta_h = (pi/2) ((k + 1/2)/n)^2 for sample k of n (fine where lobes are sharp), phi_h =
 * 2 pi (k + 1/2)/n, theta_d = (pi/2) (k + 1/2)/n; constant beyond the outermost samples.
 *
 * Soft light (EvaluateSoft) reads an isotropic p at a wider level, blurred beforehand; with an
 * anisotropic p it is hard.
 */

#ifndef vtkDistributionBRDF_h
#define vtkDistributionBRDF_h

#include "vtkBRDF.h"

#include <memory> // for levels
#include <vector> // for tables

class VTKMEASUREDBRDF_EXPORT vtkDistributionBRDF : public vtkBRDF
{
public:
  static vtkDistributionBRDF* New();
  vtkTypeMacro(vtkDistributionBRDF, vtkBRDF);

  /**
   * Set p: nPhi rows of nTheta RGB triples (theta fastest), 1/sr. nPhi = 1: isotropic. Returns
   * false with an error event and leaves the tables as they were on sizes < 1 or values that are
   * negative by more than rounding (1e-5 of the largest; that counts as 0), NaN or infinite.
   */
  bool SetDistribution(int nTheta, int nPhi, const std::vector<float>& rgb);

  /**
   * Set F: n RGB triples over theta_d. Returns false for the same errors.
   */
  bool SetFresnel(int n, const std::vector<float>& rgb);

  ///@{
  /**
   * Convenience: p as Blinn-Phong's normalized (n+2)/(2 pi) cos^n theta_h (256 samples), F as
   * Schlick's F0 + (1-F0)(1-cos theta_d)^5 (64 samples). Defaults: n = 50, F0 = 0.04; n outside
   * [0, 1e6] and F0 outside [0, 1] are refused.
   */
  void SetBlinnDistribution(double exponent);
  void SetSchlickFresnel(const double f0[3]);
  ///@}

  ///@{
  /**
   * The tables and their sizes.
   */
  int GetNumberOfThetaSamples() const { return this->NumberOfTheta; }
  int GetNumberOfPhiSamples() const { return this->NumberOfPhi; }
  const std::vector<float>& GetDistribution() const { return this->Distribution; }
  const std::vector<float>& GetFresnel() const { return this->Fresnel; }
  ///@}

  bool IsIsotropic() override { return this->NumberOfPhi == 1; }
  void Prepare() override;
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  std::string GetModelName() override { return "Distribution"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkDistributionBRDF();
  ~vtkDistributionBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;
  void EvaluateSoftAbove(const double i[3], const double o[3], double spread, double f[3]) override;

  int NumberOfTheta = 0;
  int NumberOfPhi = 0;
  std::vector<float> Distribution;
  std::vector<float> Fresnel;

private:
  vtkDistributionBRDF(const vtkDistributionBRDF&) = delete;
  void operator=(const vtkDistributionBRDF&) = delete;

  void PrepareLevels();

  struct Levels;
  std::shared_ptr<const Levels> WidenedLevels; // of an isotropic p, for EvaluateSoft
};

#endif
