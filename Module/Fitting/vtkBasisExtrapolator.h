// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBasisExtrapolator
 * @brief   extrapolates from a zone of directions to the hemisphere by spherical harmonics
 *
 * A device measures a zone of directions only (Ghosh et al. 2007: extrapolated "by re-projection
 * into spherical harmonics"). This class fits harmonics of a given order to the representation
 * inside its zones by least squares, first over i for every measured o, then over o for every
 * harmonic of i, with the penalty lambda sum (l(l+1))^2 c^2 on the Laplacian. Without the penalty
 * the problem is ill-posed: the Gram matrix of the harmonics on 9 to 57 degrees has the condition
 * number 1e9 at order 4. lambda is chosen from 1e-5 ... 1 at the corner of the L-curve (Hansen
 * 1992) or by generalized cross-validation (Golub, Heath, Wahba 1979). Cross-validation takes the
 * part of the input that its basis cannot represent for signal instead of noise, and so chooses the
 * least lambda. Below 1e-5 either may choose a fit that is close inside the zone and wild outside.
 *
 * The error is known inside the zone only. The result is therefore accepted only if its residual
 * there and its negative mass are small; otherwise Extrapolate refuses it (GetInZoneResidual,
 * MaximumResidual, GetNegativeMass, MaximumNegativeMass). Fit lobes to such materials instead.
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
   * The representation to extrapolate, with any basis and zones.
   */
  void SetInput(vtkBasisBRDF* input);
  vtkBasisBRDF* GetInput() { return this->Input; }
  ///@}

  ///@{
  /**
   * Order of the harmonics; 0 (default): that of the input.
   */
  virtual void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * How lambda is chosen. FIXED uses the value of SetLambda, clamped to [0, 1e6]. GetLambda returns
   * the value that was used.
   */
  virtual void SetCriterion(int criterion);
  vtkGetMacro(Criterion, int);
  virtual void SetLambda(double lambda);
  vtkGetMacro(Lambda, double);
  ///@}

  ///@{
  /**
   * Largest accepted relative residual inside the zones (L2, both cosines as weights). 0 (default)
   * means 0.10 for zonal inputs, most of whose residual comes from the zone's edges, and 0.03 for
   * others. GetResidualLimit returns the limit that was used.
   *
   * Measured on 23 published fits, 14 measured materials and 8 Blinn-Phong lobes (exponents 1 to
   * 200) at orders 4, 6, 8, 12 on 9 to 57 degrees: the error over 0 to 75 degrees, compared with
   * that of keeping the value at the zone's edge. Zonal: of 77 accepted results 76 are better (0.21
   * to 0.94 times that error), one is worse (11 instead of 8.7 %); of the refused results two
   * thirds are worse, up to 2 times. Legendre x Fourier: of 68 accepted results 56 are better, 12
   * worse (at most 11 instead of 7.1 %); of the refused results five in six are worse, up to 3.3
   * times.
   */
  virtual void SetMaximumResidual(double maximumResidual);
  vtkGetMacro(MaximumResidual, double);
  vtkGetMacro(ResidualLimit, double);
  ///@}

  ///@{
  /**
   * Largest accepted negative mass of the output over the hemisphere
   * (vtkBasisBRDF::GetNegativeMass); default 0.05.
   */
  virtual void SetMaximumNegativeMass(double maximumNegativeMass);
  vtkGetMacro(MaximumNegativeMass, double);
  ///@}

  ///@{
  /**
   * Set this in an observer of ProgressEvent (calldata: double*) to stop: Extrapolate returns
   * false.
   */
  vtkSetMacro(Abort, bool);
  vtkGetMacro(Abort, bool);
  vtkBooleanMacro(Abort, bool);
  ///@}

  /**
   * Extrapolate. Returns whether the result is accepted. Returns false with an error event without
   * an input. Returns false without an error event if the result is refused (GetOutput() then holds
   * it) or when aborted (GetOutput() then stays).
   */
  bool Extrapolate();

  ///@{
  /**
   * Figures of the last Extrapolate: the relative residual inside the zones and the output's
   * negative mass.
   */
  vtkGetMacro(InZoneResidual, double);
  vtkGetMacro(NegativeMass, double);
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
  double MaximumResidual = 0.0;
  double ResidualLimit = 0.0;
  double MaximumNegativeMass = 0.05;
  double InZoneResidual = 0.0;
  double NegativeMass = 0.0;
  bool Accepted = false;
  bool Abort = false;

private:
  vtkBasisExtrapolator(const vtkBasisExtrapolator&) = delete;
  void operator=(const vtkBasisExtrapolator&) = delete;
};

#endif
