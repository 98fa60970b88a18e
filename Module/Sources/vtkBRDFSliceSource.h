// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFSliceSource
 * @brief   a BRDF over the half vector's and the difference's angles, as a table for charts
 *
 * Rows are samples over theta_h, theta_d and phi_d (Rusinkiewicz 1998, "A New Change of Variables
 * for Efficient BRDF Representation"). Each angle has a range and a number of samples; an angle of
 * one sample stays at the start of its range. By default theta_h runs from 0 to 90 degrees where
 * theta_d = 0 and phi_d = 90 degrees: the highlight's profile. phi_d runs fastest, theta_h slowest.
 *
 * | column | |
 * |---|---|
 * | theta_h, theta_d, phi_d | degrees |
 * | red, green, blue | f in 1/sr, linear RGB |
 * | luminance | of f (Rec. 709) |
 * | vtkValidPointMask | 1 where both directions are above the horizon; else 0, and f is 0 |
 *
 * Without a BRDF, or with more than 10 million rows, the output is empty, with an error event.
 */

#ifndef vtkBRDFSliceSource_h
#define vtkBRDFSliceSource_h

#include "vtkBRDF.h"               // for BRDF
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkSmartPointer.h"       // for BRDF
#include "vtkTableAlgorithm.h"

class VTKMEASUREDBRDF_EXPORT vtkBRDFSliceSource : public vtkTableAlgorithm
{
public:
  static vtkBRDFSliceSource* New();
  vtkTypeMacro(vtkBRDFSliceSource, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material; null by default.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF() { return this->BRDF; }
  ///@}

  ///@{
  /**
   * First and last angle in degrees, both included: theta_h and theta_d in [0, 90], phi_d in
   * [-360, 360]; ranges may run backwards. Defaults (0, 90), (0, 90), (90, 90).
   */
  virtual void SetThetaHRange(double first, double last);
  virtual void SetThetaHRange(const double range[2]);
  vtkGetVector2Macro(ThetaHRange, double);
  virtual void SetThetaDRange(double first, double last);
  virtual void SetThetaDRange(const double range[2]);
  vtkGetVector2Macro(ThetaDRange, double);
  virtual void SetPhiDRange(double first, double last);
  virtual void SetPhiDRange(const double range[2]);
  vtkGetVector2Macro(PhiDRange, double);
  ///@}

  ///@{
  /**
   * Number of samples of each angle, clamped to [1, 100000]; defaults 181, 1, 1.
   */
  virtual void SetNumberOfThetaH(int number);
  vtkGetMacro(NumberOfThetaH, int);
  virtual void SetNumberOfThetaD(int number);
  vtkGetMacro(NumberOfThetaD, int);
  virtual void SetNumberOfPhiD(int number);
  vtkGetMacro(NumberOfPhiD, int);
  ///@}

  ///@{
  /**
   * Whether samples of theta_h grow with the square of their number, as MERL's do (default off):
   * close together at the start of the range, where highlights are.
   */
  vtkSetMacro(UseThetaHSquared, bool);
  vtkGetMacro(UseThetaHSquared, bool);
  vtkBooleanMacro(UseThetaHSquared, bool);
  ///@}

  ///@{
  /**
   * The half vector's azimuth from the tangent in degrees, for anisotropic materials; default 0,
   * clamped to [-360, 360].
   */
  virtual void SetPhiH(double degrees);
  vtkGetMacro(PhiH, double);
  ///@}

  /**
   * Also when the material last changed.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkBRDFSliceSource();
  ~vtkBRDFSliceSource() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkSmartPointer<vtkBRDF> BRDF;
  double ThetaHRange[2] = { 0.0, 90.0 };
  double ThetaDRange[2] = { 0.0, 90.0 };
  double PhiDRange[2] = { 90.0, 90.0 };
  int NumberOfThetaH = 181;
  int NumberOfThetaD = 1;
  int NumberOfPhiD = 1;
  bool UseThetaHSquared = false;
  double PhiH = 0.0;

private:
  void Fill(vtkTable* output);

  vtkBRDFSliceSource(const vtkBRDFSliceSource&) = delete;
  void operator=(const vtkBRDFSliceSource&) = delete;
};

#endif
