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
 * at order 4. lambda is chosen from 1e-5 ... 1 at the corner of the L-curve (Hansen 1992) or by
 * generalized cross-validation (Golub, Heath, Wahba 1979). The latter takes what the input's basis
 * can't hold for signal, not for noise, and so the least lambda there is. Below 1e-5 either may
 * choose a fit that is close inside the zone and wild outside.
 *
 * Inside the zone one can tell how well that went, outside not. So the result only counts where the
 * residual inside is small and the result hardly negative: Extrapolate refuses else
 * (GetInZoneResidual, MaximumResidual, GetNegativeMass, MaximumNegativeMass); a lobe fit is the
 * better way there.
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
  virtual void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * How lambda is chosen; FIXED: as set by SetLambda, clamped to [0, 1e6]. GetLambda: what was
   * used.
   */
  virtual void SetCriterion(int criterion);
  vtkGetMacro(Criterion, int);
  virtual void SetLambda(double lambda);
  vtkGetMacro(Lambda, double);
  ///@}

  ///@{
  /**
   * Largest relative residual inside the zones (L2, both cosines as weights) that is accepted; 0
   * (default): 0.10 of zonal inputs, whose own edges are most of it, 0.03 of others.
   * GetResidualLimit: what was used.
   *
   * Measured on 23 published fits, 14 measured materials and 8 Blinn-Phong lobes (exponents 1 to
   * 200) at orders 4, 6, 8, 12 on 9 to 57 degrees, error over 0 to 75 degrees against that of
   * holding the zone's edge. Zonal: of 77 accepted results 76 are better (0.21 to 0.94 times that
   * error), one is worse (11 instead of 8.7 %); of those refused two thirds are worse, up to 2
   * times. Legendre x Fourier: of 68 accepted 56 are better, 12 worse (at most 11 instead of 7.1
   * %); of those refused five in six are worse, up to 3.3 times.
   */
  virtual void SetMaximumResidual(double maximumResidual);
  vtkGetMacro(MaximumResidual, double);
  vtkGetMacro(ResidualLimit, double);
  ///@}

  ///@{
  /**
   * Largest negative mass of the output over the hemisphere (vtkBasisBRDF::GetNegativeMass) that is
   * accepted; default 0.05.
   */
  virtual void SetMaximumNegativeMass(double maximumNegativeMass);
  vtkGetMacro(MaximumNegativeMass, double);
  ///@}

  ///@{
  /**
   * Set it in an observer of ProgressEvent (calldata: double*) to stop: Extrapolate returns false.
   */
  vtkSetMacro(Abort, bool);
  vtkGetMacro(Abort, bool);
  vtkBooleanMacro(Abort, bool);
  ///@}

  /**
   * Returns whether the residual inside the zone is accepted. False with an error event without an
   * input; false without one where the gate refuses, GetOutput() then holds the refused result, or
   * when aborted, GetOutput() then stays.
   */
  bool Extrapolate();

  ///@{
  /**
   * About the last Extrapolate: the relative residual inside the zones and the output's negative
   * mass.
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
