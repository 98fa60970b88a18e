// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material whose form for shaders is made at once. Private to the rendering room.
 */

#ifndef StandInBRDF_h
#define StandInBRDF_h

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

namespace measuredbrdf
{
/// The material that stands in for one until there is a plan: of its values, but with a coarse
/// table for shaders (vtkBRDF::NewQuickRenderable) where the material's own takes seconds. That is
/// made when it is first asked for: only lights need it.
class StandInBRDF : public vtkBRDF
{
public:
  static StandInBRDF* New();
  vtkTypeMacro(StandInBRDF, vtkBRDF);

  /// The material must not change while this lives.
  static vtkSmartPointer<vtkBRDF> Make(vtkBRDF* material);

  void GetDirectionalAlbedo(const double o[3], double albedo[3]) override;
  void GetBounds(double minimumCosine, double lower[3], double upper[3]) override;
  bool IsIsotropic() override { return this->Material->IsIsotropic(); }
  bool IsReciprocal() override { return this->Material->IsReciprocal(); }
  void Prepare() override { this->Material->Prepare(); }
  bool IsRenderable() override { return false; }
  vtkBRDF* GetRenderable() override;
  void GetShaderInputs(vtkBRDFShaderInputs& form) override;

protected:
  StandInBRDF() = default;
  ~StandInBRDF() override = default;

  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;
  void EvaluateSoftAbove(const double i[3], const double o[3], double spread, double f[3]) override;
  bool SampleAbove(const double o[3], double u1, double u2, double i[3]) override;
  double PdfAbove(const double i[3], const double o[3]) override;

private:
  StandInBRDF(const StandInBRDF&) = delete;
  void operator=(const StandInBRDF&) = delete;

  vtkSmartPointer<vtkBRDF> Material;
  vtkSmartPointer<vtkBRDF> Quick;
};
} // namespace measuredbrdf

#endif
