// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLobeBRDFFitter
 * @brief   fits a Lambert part and 1 to 3 lobes, Blinn-Phong's or Ashikhmin-Shirley's
 *
 * The unknowns are an RGB albedo and, per lobe, an exponent (two if it is anisotropic: along the
 * tangent and the bitangent), an RGB scale S >= 0 and, of Ashikhmin-Shirley's, an RGB reflectance R
 * in [0,1] of Schlick's Fresnel term. The lobes have no coupled diffuse part: the Lambert term
 * replaces it.
 *
 * All log-spaced combinations of exponents are tried with their best coefficients, and the best
 * NumberOfStarts are refined (Levenberg-Marquardt within bounds, analytic derivatives).
 * The output is a vtkSumBRDF of a vtkLambertBRDF and the lobes by ascending exponent.
 */

#ifndef vtkLobeBRDFFitter_h
#define vtkLobeBRDFFitter_h

#include "vtkBRDFFitter.h"

#include <vector> // for FitTo

class VTKMEASUREDBRDF_EXPORT vtkLobeBRDFFitter : public vtkBRDFFitter
{
public:
  static vtkLobeBRDFFitter* New();
  vtkTypeMacro(vtkLobeBRDFFitter, vtkBRDFFitter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ShapeType
  {
    BLINN_PHONG = 0,
    ASHIKHMIN_SHIRLEY = 1
  };

  ///@{
  /**
   * The lobes' shape: vtkBlinnPhongBRDF's or vtkAshikhminShirleyBRDF's (default).
   */
  virtual void SetShape(int shape);
  vtkGetMacro(Shape, int);
  void SetShapeToBlinnPhong() { this->SetShape(BLINN_PHONG); }
  void SetShapeToAshikhminShirley() { this->SetShape(ASHIKHMIN_SHIRLEY); }
  ///@}

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
   * Whether Ashikhmin-Shirley's lobes have two exponents each: AS_INPUT (default), ISOTROPIC or
   * ANISOTROPIC.
   */
  virtual void SetAnisotropy(int anisotropy);
  vtkGetMacro(Anisotropy, int);
  ///@}

  std::string GetModelName() override
  {
    return this->Shape == BLINN_PHONG ? "Blinn-Phong" : "Ashikhmin-Shirley";
  }

protected:
  vtkLobeBRDFFitter() = default;
  ~vtkLobeBRDFFitter() override = default;

  Result FitTo(const std::vector<Sample>& samples) override;

  int Shape = ASHIKHMIN_SHIRLEY;
  int NumberOfLobes = 1;
  int Anisotropy = AS_INPUT;

private:
  vtkLobeBRDFFitter(const vtkLobeBRDFFitter&) = delete;
  void operator=(const vtkLobeBRDFFitter&) = delete;
};

#endif
