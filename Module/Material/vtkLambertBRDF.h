// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLambertBRDF
 * @brief   perfectly diffuse reflection: f = albedo / pi
 *
 * Lambert 1760. Reciprocal, isotropic; directional albedo = Albedo at every angle.
 */

#ifndef vtkLambertBRDF_h
#define vtkLambertBRDF_h

#include "vtkBRDF.h"

class VTKMEASUREDBRDF_EXPORT vtkLambertBRDF : public vtkBRDF
{
public:
  static vtkLambertBRDF* New();
  vtkTypeMacro(vtkLambertBRDF, vtkBRDF);

  ///@{
  /**
   * Share of the incident light that is reflected, RGB; default 0.8 each. Negative values count as
   * 0; values above 1 are kept (measured fits have them).
   */
  virtual void SetAlbedo(double x, double y, double z);
  virtual void SetAlbedo(const double albedo[3]);
  vtkGetVector3Macro(Albedo, double);
  ///@}

  void GetDirectionalAlbedo(const double o[3], double albedo[3]) override;
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  std::string GetModelName() override { return "Lambert"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkLambertBRDF() = default;
  ~vtkLambertBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;

  double Albedo[3] = { 0.8, 0.8, 0.8 };

private:
  vtkLambertBRDF(const vtkLambertBRDF&) = delete;
  void operator=(const vtkLambertBRDF&) = delete;
};

#endif
