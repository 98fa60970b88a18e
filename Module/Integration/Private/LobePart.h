// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The low- or the high-frequency part of a material, a BRDF itself. Private to the module.
 */

#ifndef LobePart_h
#define LobePart_h

#include "LobeSplit.h"
#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <memory>

namespace measuredbrdf
{
/// The low- or the high-frequency part of a material.
class LobePart : public vtkBRDF
{
public:
  static LobePart* New();
  vtkTypeMacro(LobePart, vtkBRDF);

  void Set(vtkBRDF* brdf, const std::shared_ptr<LobeSplit>& cut, bool sharp);

  void GetDirectionalAlbedo(const double o[3], double albedo[3]) override;
  void GetBounds(double minimumCosine, double lower[3], double upper[3]) override;
  /// None: parts are integrated, not drawn.
  void GetShaderInputs(vtkBRDFShaderInputs&) override {}

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;
  bool SampleAbove(const double o[3], double u1, double u2, double i[3]) override;
  double PdfAbove(const double i[3], const double o[3]) override;

private:
  vtkSmartPointer<vtkBRDF> Whole;
  std::shared_ptr<LobeSplit> Cut;
  bool Sharp = false;
};
} // namespace measuredbrdf

#endif
