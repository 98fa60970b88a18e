// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBasisExtrapolator
 * @brief   from a zone of directions to the whole hemisphere, by spherical harmonics
 *
 * What a device measures ends at its zone (Ghosh et al. 2007: extrapolated "by re-projection into
 * spherical harmonics"). Here: harmonics of a given order that fit the representation inside its
 * zones in the least-squares sense, first over i for every measured o, then over o for every
 * harmonic of i, with the penalty lambda sum (l(l+1))^2 c^2 on the Laplacian. Without it the
 * problem is ill-posed: the Gram matrix of the harmonics on 9 to 57 degrees has the condition 1e9
 * at order
 * 4. lambda is chosen from 1e-10 ... 1 by generalized cross-validation (Golub, Heath, Wahba 1979)
 * or at the corner of the L-curve (Hansen 1992).
 *
 * Inside the zone one can tell how well that went, outside not. So the result only counts where the
 * residual inside is small: Extrapolate refuses else (GetInZoneResidual, MaximumResidual); a lobe
 * fit is the better way there.
 */

#ifndef vtkBasisExtrapolator_h
#define vtkBasisExtrapolator_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for members

#include "vtkBasisBRDF.h" // for Output

class VTKMEASUREDBRDF_EXPORT vtkBasisExtrapolator : public vtkObject
{
public:
  static vtkBasisExtrapolator* New();
  vtkTypeMacro(vtkBasisExtrapolator, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum CriterionType
  {
    CROSS_VALIDATION = 0,
    L_CURVE = 1,
    FIXED = 2
  };

  ///@{
  /**
   * What to extrapolate, any basis and zones.
   */
  void SetInput(vtkBasisBRDF* input);
  vtkBasisBRDF* GetInput() { return this->Input; }
  ///@}

  ///@{
  /**
   * Order of the harmonics; 0 (default): the input's.
   */
  vtkSetClampMacro(Order, int, 0, vtkBasisBRDF::MaximumOrder);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * How lambda is chosen; FIXED: as set by SetLambda, clamped to [0, 1e6]. GetLambda: what was
   * used.
   */
  vtkSetClampMacro(Criterion, int, CROSS_VALIDATION, FIXED);
  vtkGetMacro(Criterion, int);
  vtkSetClampMacro(Lambda, double, 0.0, 1e6);
  vtkGetMacro(Lambda, double);
  ///@}

  ///@{
  /**
   * Largest relative residual inside the zone (L2, both cosines as weights) that is accepted;
   * default 0.10. Measured on 12 RGL materials and five Blinn-Phong lobes at orders 4 to 12 on 9 to
   * 57 degrees: up to 0.10 the result was closer to the truth over 0 to 75 degrees than holding the
   * zone edge in all cases, above 0.16 mostly farther, by up to a factor 36.
   */
  vtkSetClampMacro(MaximumResidual, double, 0.0, 1e6);
  vtkGetMacro(MaximumResidual, double);
  ///@}

  /**
   * Returns whether the residual inside the zone is accepted. False with an error event without an
   * input; false without one where the gate refuses: GetOutput() then holds the refused result.
   */
  bool Extrapolate();

  ///@{
  /**
   * About the last Extrapolate: the relative residual inside the zones.
   */
  vtkGetMacro(InZoneResidual, double);
  vtkGetMacro(Accepted, bool);
  ///@}

  /**
   * The result, over the hemisphere of i and o; a new object each time, null before.
   */
  vtkBasisBRDF* GetOutput() { return this->Output; }

protected:
  vtkBasisExtrapolator() = default;
  ~vtkBasisExtrapolator() override = default;

  vtkSmartPointer<vtkBasisBRDF> Input;
  vtkSmartPointer<vtkBasisBRDF> Output;
  int Order = 0;
  int Criterion = L_CURVE;
  double Lambda = 1e-4;
  double MaximumResidual = 0.10;
  double InZoneResidual = 0.0;
  bool Accepted = false;

private:
  vtkBasisExtrapolator(const vtkBasisExtrapolator&) = delete;
  void operator=(const vtkBasisExtrapolator&) = delete;
};

#endif
