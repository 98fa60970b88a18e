// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAshikhminShirleyBRDF
 * @brief   Ashikhmin-Shirley: anisotropic Phong lobe with Fresnel term and coupled diffuse part
 *
 * Ashikhmin and Shirley 2000, "An Anisotropic Phong BRDF Model" (thesis section 2.3.5):
 *
 *     f_s = scale sqrt((nu+1)(nv+1))/(8 pi) (n.h)^e / ((h.o) max(cos_i, cos_o)) F(h.o)
 *     e   = (nu (h.x)^2 + nv (h.y)^2) / (1 - (n.h)^2)
 *     f_d = 28 Rd/(23 pi) (1-Rs) (1-(1-cos_i/2)^5) (1-(1-cos_o/2)^5)
 *
 * F is Schlick's with the reflectance Rs at normal incidence (Ngan et al. 2005), or the exact
 * Fresnel reflectance of a dielectric with the given index of refraction (Low et al. 2012).
 */

#ifndef vtkAshikhminShirleyBRDF_h
#define vtkAshikhminShirleyBRDF_h

#include "vtkBRDF.h"

class VTKMEASUREDBRDF_EXPORT vtkAshikhminShirleyBRDF : public vtkBRDF
{
public:
  static vtkAshikhminShirleyBRDF* New();
  vtkTypeMacro(vtkAshikhminShirleyBRDF, vtkBRDF);

  enum FresnelModelType
  {
    SCHLICK = 0,
    DIELECTRIC = 1
  };

  ///@{
  /**
   * Factor on the specular part, RGB; default 1. The published fits use it, the paper has none.
   */
  virtual void SetSpecularScale(double x, double y, double z);
  virtual void SetSpecularScale(const double specularScale[3]);
  vtkGetVector3Macro(SpecularScale, double);
  ///@}

  ///@{
  /**
   * Rs, reflectance at normal incidence, RGB in [0,1]; default 0.04. Used by Schlick's Fresnel term
   * and by the coupled diffuse part.
   */
  virtual void SetReflectance(double x, double y, double z);
  virtual void SetReflectance(const double reflectance[3]);
  vtkGetVector3Macro(Reflectance, double);
  ///@}

  ///@{
  /**
   * Rd, coupled diffuse reflectance, RGB; default 0 (no diffuse part).
   */
  virtual void SetDiffuse(double x, double y, double z);
  virtual void SetDiffuse(const double diffuse[3]);
  vtkGetVector3Macro(Diffuse, double);
  ///@}

  ///@{
  /**
   * Phong exponents along the tangent (nu) and the bitangent (nv); default 100, clamped to [0,1e6].
   */
  virtual void SetExponentU(double exponentU);
  vtkGetMacro(ExponentU, double);
  virtual void SetExponentV(double exponentV);
  vtkGetMacro(ExponentV, double);
  void SetExponents(double nu, double nv)
  {
    this->SetExponentU(nu);
    this->SetExponentV(nv);
  }
  ///@}

  ///@{
  /**
   * Fresnel term: Schlick (default, from Reflectance) or dielectric (from IndexOfRefraction).
   */
  virtual void SetFresnelModel(int fresnelModel);
  vtkGetMacro(FresnelModel, int);
  void SetFresnelModelToSchlick() { this->SetFresnelModel(SCHLICK); }
  void SetFresnelModelToDielectric() { this->SetFresnelModel(DIELECTRIC); }
  ///@}

  ///@{
  /**
   * Relative index of refraction, for the dielectric Fresnel term; default 1.5, clamped to [1,100].
   */
  virtual void SetIndexOfRefraction(double indexOfRefraction);
  vtkGetMacro(IndexOfRefraction, double);
  ///@}

  /**
   * Evaluate for so many lights and one view o, all unit vectors above the horizon, in single
   * precision: far faster than one by one. i: x, y and z of all lights; f: red, green and blue, 0
   * where the model is negative.
   */
  VTK_WRAPEXCLUDE void EvaluateLights(
    int count, const float* const i[3], const double o[3], float* const f[3]);

  bool IsIsotropic() override { return this->ExponentU == this->ExponentV; }
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  std::string GetModelName() override { return "AshikhminShirley"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkAshikhminShirleyBRDF() = default;
  ~vtkAshikhminShirleyBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;
  void EvaluateSoftAbove(const double i[3], const double o[3], double spread, double f[3]) override;
  bool SampleAbove(const double o[3], double u1, double u2, double i[3]) override;
  double PdfAbove(const double i[3], const double o[3]) override;

  double GetFresnel(int channel, double cosine) const;
  double GetSpecularProbability() const;

  double SpecularScale[3] = { 1.0, 1.0, 1.0 };
  double Reflectance[3] = { 0.04, 0.04, 0.04 };
  double Diffuse[3] = { 0.0, 0.0, 0.0 };
  double ExponentU = 100.0;
  double ExponentV = 100.0;
  int FresnelModel = SCHLICK;
  double IndexOfRefraction = 1.5;

private:
  vtkAshikhminShirleyBRDF(const vtkAshikhminShirleyBRDF&) = delete;
  void operator=(const vtkAshikhminShirleyBRDF&) = delete;
};

#endif
