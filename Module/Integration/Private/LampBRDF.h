// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a material shows of lamps that are as wide as its lobe, or wider.
 */

#ifndef LampBRDF_h
#define LampBRDF_h

#include "vtkBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace measuredbrdf
{
class LobeViews;

/**
 * The mean of an isotropic material's f over a lamp, by the lamp's middle: f(i, o) averaged over
 * directions that are normally distributed about i. It comes from a table of f cos(theta_o) over
 * half and difference angles, half a turn of phi_d: both sides of the plane of incidence are alike.
 */
class LampBRDF : public vtkBRDF
{
public:
  static LampBRDF* New();
  vtkTypeMacro(LampBRDF, vtkBRDF);

  /// spread: the directions' variance along each axis (square radians), vtkLightSet's
  /// 1 / concentration. On several threads.
  static vtkSmartPointer<LampBRDF> Make(vtkBRDF* material, double spread);

  /// Whether the width of such lamps shows: more than 5 % of some view's albedo lie in lobes
  /// narrower than twelve times the lamp, seen at most 60 degrees from the normal.
  static bool IsWidthSeen(const LobeViews& views, double spread);

  ///@{
  /// Whether the parts of a lamp are to be told apart; default: no.
  void SetSeesParts(bool seesParts) { this->SeesParts = seesParts; }
  bool GetSeesParts() const { return this->SeesParts; }
  ///@}

  /// Of the texture.
  static vtkIdType GetTextureBytes();

  /// The name of the function in the text: brdfTermINSTANCE is the material's own.
  static std::string GetFunction() { return "brdfLampINSTANCE"; }

  /// One term. Its function is GetFunction().
  void GetShaderInputs(vtkBRDFShaderInputs& form) override;

  /// The term before another one's, which calls the function.
  void AddTo(vtkBRDFShaderInputs::Term& term);

  void GetBounds(double minimumCosine, double lower[3], double upper[3]) override;
  bool IsReciprocal() override { return false; }

protected:
  LampBRDF() = default;
  ~LampBRDF() override = default;

  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;

private:
  LampBRDF(const LampBRDF&) = delete;
  void operator=(const LampBRDF&) = delete;

  std::vector<std::uint32_t> Texels; // phi_d fastest, with shared exponents
  double Scale = 1.0;                // of their values
  bool SeesParts = false;
};
} // namespace measuredbrdf

#endif
