// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFImageSource
 * @brief   a BRDF's values over theta_h and theta_d, as an image
 *
 * The image slice of Burley 2012 ("Physically-Based Shading at Disney", section 3): theta_h to the
 * right, theta_d upwards, both from 0 to 90 degrees, where phi_d = 90 degrees. The left edge is the
 * highlight, the top its Fresnel reflection towards grazing angles, the right edge grazing
 * retroreflection. Pixels hold f at their centers: 3 floats "BRDF" in 1/sr, linear RGB. Origin and
 * spacing are in degrees. Where a direction is below the horizon (other phi_d only), f is 0.
 * Without a BRDF the image is black, with an error event.
 */

#ifndef vtkBRDFImageSource_h
#define vtkBRDFImageSource_h

#include "vtkBRDF.h" // for BRDF
#include "vtkImageAlgorithm.h"
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkSmartPointer.h"       // for BRDF

class VTKMEASUREDBRDF_EXPORT vtkBRDFImageSource : public vtkImageAlgorithm
{
public:
  static vtkBRDFImageSource* New();
  vtkTypeMacro(vtkBRDFImageSource, vtkImageAlgorithm);
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
   * Pixels along each edge; default 256, clamped to [2, 4096].
   */
  virtual void SetResolution(int pixels);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * Azimuth of the difference in degrees; default 90, clamped to [-360, 360].
   */
  virtual void SetPhiD(double degrees);
  vtkGetMacro(PhiD, double);
  ///@}

  ///@{
  /**
   * Whether the image's x is 90 sqrt(theta_h / 90) degrees instead of theta_h (default off): MERL's
   * axis, which is fine near highlights.
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
  vtkBRDFImageSource();
  ~vtkBRDFImageSource() override = default;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void ExecuteDataWithInformation(vtkDataObject* output, vtkInformation* outInfo) override;

  vtkSmartPointer<vtkBRDF> BRDF;
  int Resolution = 256;
  double PhiD = 90.0;
  bool UseThetaHSquared = false;
  double PhiH = 0.0;

private:
  vtkBRDFImageSource(const vtkBRDFImageSource&) = delete;
  void operator=(const vtkBRDFImageSource&) = delete;
};

#endif
