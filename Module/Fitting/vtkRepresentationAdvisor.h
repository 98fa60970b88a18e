// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRepresentationAdvisor
 * @brief   measures a material and recommends a basis or a fit for it
 *
 * The thesis represents materials in a basis, and uses the D-BRDF for the one that rings, the foil.
 * It decides by hand; this class measures. It projects the material onto the zonal basis of a given
 * order over the device's zone (vtkBasisProjector) and computes there, with both cosines as
 * weights,
 *
 * - the in-zone residual: relative L2 distance of the projection (clamped at 0, as rendered),
 * - the negative mass of the projection g (vtkBasisBRDF::GetNegativeMass),
 * - the overshoot: integral of the excess of g over f / integral of |g|.
 *
 * It recommends a basis if the residual is at most MaximumResidual, and otherwise a fit. Negative
 * mass and overshoot, each from 0 to 1, describe how the projection rings. They do not enter the
 * decision: for 37 materials and the orders 4 to 12 no negative mass exceeds 0.3 % where the
 * residual is below 10 %. docs/thesis.md has the figures.
 *
 * Represent() makes the recommended material: spherical harmonics of the hemisphere of that order,
 * or the D-BRDF fit. A material that is in a basis already stays as it is.
 */

#ifndef vtkRepresentationAdvisor_h
#define vtkRepresentationAdvisor_h

#include "vtkBRDF.h"               // for Input
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for members

#include <string> // for GetReason

class VTKMEASUREDBRDF_EXPORT vtkRepresentationAdvisor : public vtkObject
{
public:
  static vtkRepresentationAdvisor* New();
  vtkTypeMacro(vtkRepresentationAdvisor, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum RepresentationType
  {
    BASIS = 0,
    FIT = 1
  };

  ///@{
  /**
   * The material.
   */
  void SetInput(vtkBRDF* input);
  vtkBRDF* GetInput() { return this->Input; }
  ///@}

  ///@{
  /**
   * Order of the basis (default 6: 49 functions) and zone in degrees (default 9 to 57).
   */
  virtual void SetOrder(int order);
  vtkGetMacro(Order, int);
  virtual void SetZone(double begin, double end);
  virtual void SetZone(const double zone[2]);
  vtkGetVector2Macro(Zone, double);
  ///@}

  ///@{
  /**
   * Largest in-zone residual for which a basis is recommended; default 0.10.
   */
  virtual void SetMaximumResidual(double maximumResidual);
  vtkGetMacro(MaximumResidual, double);
  ///@}

  /**
   * Measure. Returns false with an error event without an input.
   */
  bool Update();

  ///@{
  /**
   * The measured values, and the recommendation with its reason in one line.
   */
  vtkGetMacro(InZoneResidual, double);
  vtkGetMacro(NegativeMass, double);
  vtkGetMacro(Overshoot, double);
  vtkGetMacro(Recommendation, int);
  vtkGetMacro(Reason, std::string);
  ///@}

  ///@{
  /**
   * Set this in an observer of ProgressEvent (calldata: double*) to stop: Represent returns false.
   */
  vtkSetMacro(Abort, bool);
  vtkGetMacro(Abort, bool);
  vtkBooleanMacro(Abort, bool);
  ///@}

  /**
   * Update and make the recommended material. Returns false and keeps the output if Update or the
   * fit fails (with an error event) or when aborted (without one).
   */
  bool Represent();

  /**
   * The material that Represent made; null before.
   */
  vtkBRDF* GetOutput() { return this->Output; }

protected:
  vtkRepresentationAdvisor() = default;
  ~vtkRepresentationAdvisor() override = default;

  vtkSmartPointer<vtkBRDF> Input;
  vtkSmartPointer<vtkBRDF> Output;
  int Order = 6;
  double Zone[2] = { 9.0, 57.0 };
  double MaximumResidual = 0.10;
  double InZoneResidual = 0.0;
  double NegativeMass = 0.0;
  double Overshoot = 0.0;
  int Recommendation = FIT;
  std::string Reason;
  bool Abort = false;

private:
  vtkRepresentationAdvisor(const vtkRepresentationAdvisor&) = delete;
  void operator=(const vtkRepresentationAdvisor&) = delete;

  template <typename Maker>
  bool RunWithProgress(Maker* maker, bool (Maker::*run)());
};

#endif
