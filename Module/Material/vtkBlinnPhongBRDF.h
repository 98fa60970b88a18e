// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBlinnPhongBRDF
 * @brief   Blinn-Phong lobe: f = ks (n+2)/(2 pi) (n.h)^n
 *
 * Blinn 1977 with the normalization of Ngan et al. 2005 ("Experimental Analysis of BRDF Models"),
 * thesis section 2.2.2. n is the half-vector exponent. Reciprocal, isotropic. Diffuse reflection
 * is a term of its own: see vtkSumBRDF.
 */

#ifndef vtkBlinnPhongBRDF_h
#define vtkBlinnPhongBRDF_h

#include "vtkBRDF.h"

class VTKMEASUREDBRDF_EXPORT vtkBlinnPhongBRDF : public vtkBRDF
{
public:
  static vtkBlinnPhongBRDF* New();
  vtkTypeMacro(vtkBlinnPhongBRDF, vtkBRDF);

  ///@{
  /**
   * Scale ks of the lobe, RGB, no unit; default 0.1 each. Negative values count as 0.
   */
  virtual void SetSpecular(double x, double y, double z);
  virtual void SetSpecular(const double specular[3]);
  vtkGetVector3Macro(Specular, double);
  ///@}

  ///@{
  /**
   * Exponent n of the half vector's cosine; default 50, clamped to [0, 1e6].
   */
  virtual void SetExponent(double exponent);
  vtkGetMacro(Exponent, double);
  ///@}

  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  std::string GetModelName() override { return "BlinnPhong"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkBlinnPhongBRDF() = default;
  ~vtkBlinnPhongBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;
  void EvaluateSoftAbove(const double i[3], const double o[3], double spread, double f[3]) override;
  bool SampleAbove(const double o[3], double u1, double u2, double i[3]) override;
  double PdfAbove(const double i[3], const double o[3]) override;

  double Specular[3] = { 0.1, 0.1, 0.1 };
  double Exponent = 50.0;

private:
  vtkBlinnPhongBRDF(const vtkBlinnPhongBRDF&) = delete;
  void operator=(const vtkBlinnPhongBRDF&) = delete;
};

#endif
