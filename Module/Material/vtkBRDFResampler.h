// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFResampler
 * @brief   resamples any isotropic BRDF into a half/difference-angle table and measures the error
 *
 * A cell gets the value at its center. With reciprocal output (phi_d over half a turn) it gets the
 * mean of f(i,o) and f(o,i), because a reciprocal table cannot represent the asymmetry of a
 * measurement; this loss is part of the reported error.
 *
 * Without reciprocal output the table is cosine-weighted, with phi_d over the full turn: it keeps
 * the asymmetry, and holds f cos(theta_o), which stays finite up to the horizon.
 *
 * Cells whose i or o lies below the horizon get the value at the largest theta_d of the same h and
 * phi_d that lies above it: constant extrapolation along theta_d. Interpolation next to the horizon
 * needs these values. (Skipping these cells gave 2 to 6 times the error for the RGL materials.)
 */

#ifndef vtkBRDFResampler_h
#define vtkBRDFResampler_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkNew.h"                // for vtkNew
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Input

#include "vtkTabulatedBRDF.h" // for Output

class VTKMEASUREDBRDF_EXPORT vtkBRDFResampler : public vtkObject
{
public:
  static vtkBRDFResampler* New();
  vtkTypeMacro(vtkBRDFResampler, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The BRDF to resample.
   */
  vtkSetSmartPointerMacro(Input, vtkBRDF);
  vtkGetSmartPointerMacro(Input, vtkBRDF);
  ///@}

  ///@{
  /**
   * Relative L2 error to reach (both cosines as weights); default 0.01. Used by Resample(), not by
   * ResampleTo().
   */
  virtual void SetTolerance(double tolerance);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Whether the output is reciprocal by construction; default off.
   */
  vtkSetMacro(Reciprocal, bool);
  vtkGetMacro(Reciprocal, bool);
  vtkBooleanMacro(Reciprocal, bool);
  ///@}

  /**
   * Try larger and larger sizes, up to 2^20 cells (6 MB as 16-bit RGB), until one meets the
   * tolerance, then halve every axis for which the tolerance still holds. Returns whether the
   * tolerance was met; if not, the output is the best size tried. Raises ProgressEvent (calldata:
   * double*) between tries.
   */
  bool Resample();

  /**
   * Resample to the given size (phi_d, theta_d, theta_h), each in [1, 2048]. Returns false with an
   * error event, output unchanged, without an input or with other sizes.
   */
  bool ResampleTo(int nPhiD, int nThetaD, int nThetaH);

  /**
   * The result; its ResamplingError holds the measured error.
   */
  vtkTabulatedBRDF* GetOutput() { return this->Output; }

  /**
   * Relative L2 distance of b from reference a, sqrt(sum |a-b|^2 / sum |a|^2), over the
   * hemispheres of i and o weighted by both cosines, all channels, for views whose cosine is at
   * least 0.02, because no other view is ever shaded. (Measured f grows as 1/cos; without this
   * limit the distance of two measured materials can be infinite.) Computed from `pairs`
   * low-discrepancy pairs, half of them from a's own lobes. NaN with a warning without two BRDFs or
   * pairs. maximum, if not null, gets the largest absolute difference of all pairs.
   */
  static double GetRelativeL2Error(
    vtkBRDF* a, vtkBRDF* b, int pairs = 1 << 17, double* maximum = nullptr);

  /**
   * The same distance over pairs whose polar angles lie in two zones (begin and end in degrees, of
   * i and of o), such as the zones that a device covers. NaN with a warning for zones that
   * vtkBasisBRDF::FindZoneProblem refuses.
   */
  static double GetZoneRelativeL2Error(vtkBRDF* a, vtkBRDF* b, const double incident[2],
    const double outgoing[2], int pairs = 1 << 17, double* maximum = nullptr);

  /**
   * Log-cosine distance (Low et al. 2012), sqrt(mean of (ln(1 + a c) - ln(1 + b c))^2) with c =
   * cos(theta_i), over channels, i evenly over the hemisphere's solid angle, and o evenly over its
   * polar angle up to a cosine of 0.02. In this measure a highlight does not dominate: 0 means
   * equal, 0.01 means about 1 % of f where f c is large, and an absolute 0.01/sr where it is small.
   * Computed from `pairs` low-discrepancy pairs. NaN with a warning without two BRDFs or pairs.
   */
  static double GetLogCosineDistance(vtkBRDF* a, vtkBRDF* b, int pairs = 1 << 17);

protected:
  vtkBRDFResampler() = default;
  ~vtkBRDFResampler() override = default;

  vtkSmartPointer<vtkBRDF> Input;
  vtkNew<vtkTabulatedBRDF> Output;
  double Tolerance = 0.01;
  bool Reciprocal = false;

private:
  vtkBRDFResampler(const vtkBRDFResampler&) = delete;
  void operator=(const vtkBRDFResampler&) = delete;
};

#endif
