// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFAcquisition
 * @brief   simulates the measuring device of Ghosh et al. 2007
 *
 * A projector lights the sample from all directions of a zone at once with the basis functions
 * B_k, one after the other. Each is shown as two patterns, max(B_k, 0) and max(-B_k, 0), scaled to
 * the projector's range. A camera sees every direction o of the same zone in one image. The
 * difference of the two photographs, with the scale undone, is
 *
 *   C_k(o) = integral over the zone of f(i,o) cos(theta_i) B_k(i) di,
 *
 * one slice of the coefficient stack: vtkBasisBRDF with IncidentCosine on, because the projector's
 * light includes the cosine. Each pair of photographs is exposed so that its brightest pixel is 1.
 * Noise is Gaussian with a standard deviation of Noise, relative to that pixel. Values are rounded
 * to Bits bits and clipped to [0, 1]. For isotropic materials the camera's azimuths are averaged
 * after the coefficients are rotated, which also averages the noise.
 *
 * The papers' figures (zone, orders, pixels, noise) could not be checked; the defaults are this
 * project's. The same Seed gives the same bits.
 */

#ifndef vtkBRDFAcquisition_h
#define vtkBRDFAcquisition_h

#include "vtkBRDF.h"               // for Input
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for members

#include "vtkBasisBRDF.h" // for Output

class VTKMEASUREDBRDF_EXPORT vtkBRDFAcquisition : public vtkObject
{
public:
  static vtkBRDFAcquisition* New();
  vtkTypeMacro(vtkBRDFAcquisition, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The sample.
   */
  void SetInput(vtkBRDF* input);
  vtkBRDF* GetInput() { return this->Input; }
  ///@}

  ///@{
  /**
   * Basis and order; default zonal of order 6. Spherical harmonics are refused, because they are no
   * basis of the directions that a device reaches. Orders outside [1, vtkBasisBRDF::MaximumOrder]
   * are refused.
   */
  virtual void SetBasis(int basis);
  vtkGetMacro(Basis, int);
  virtual void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * Polar angles in degrees of projector and camera; default 9 to 57. Hemispherical: 0 to 90.
   */
  virtual void SetZone(double begin, double end);
  virtual void SetZone(const double zone[2]);
  vtkGetVector2Macro(Zone, double);
  ///@}

  ///@{
  /**
   * Camera noise's standard deviation, relative to the brightest pixel of each pair of photographs;
   * default 0; negative or non-finite values are refused.
   */
  virtual void SetNoise(double noise);
  vtkGetMacro(Noise, double);
  ///@}

  ///@{
  /**
   * Bits of the camera's pixels, 1 to 24; 0 (default): no rounding. Other numbers are refused.
   */
  virtual void SetBits(int bits);
  vtkGetMacro(Bits, int);
  ///@}

  ///@{
  /**
   * Seed of the noise.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  ///@{
  /**
   * Camera pixels: polar angles (default 48, in [2, 1024]) and azimuths (default 32, in [1, 256]).
   * Numbers for which the responses of an anisotropic sample would take more than 1 GiB are
   * refused.
   */
  virtual void SetNumberOfTheta(int numberOfTheta);
  vtkGetMacro(NumberOfTheta, int);
  virtual void SetNumberOfPhi(int numberOfPhi);
  vtkGetMacro(NumberOfPhi, int);
  ///@}

  ///@{
  /**
   * Set this in an observer of ProgressEvent (calldata: double*) to stop: Acquire returns false.
   */
  vtkSetMacro(Abort, bool);
  vtkGetMacro(Abort, bool);
  vtkBooleanMacro(Abort, bool);
  ///@}

  /**
   * Measure. Returns false with an error event and leaves the output unchanged without an input or
   * with an invalid option; returns false without an error event when aborted.
   */
  bool Acquire();

  /**
   * The coefficient stack as a material, a new object at every Acquire; null before.
   */
  vtkBasisBRDF* GetOutput() { return this->Output; }

  /**
   * Number of photographs that were taken: two for each basis function that has a negative part,
   * one for each other (such as the first).
   */
  vtkGetMacro(NumberOfPhotographs, int);

protected:
  vtkBRDFAcquisition() = default;
  ~vtkBRDFAcquisition() override = default;

  vtkSmartPointer<vtkBRDF> Input;
  vtkSmartPointer<vtkBasisBRDF> Output;
  int Basis = vtkBasisBRDF::ZONAL;
  int Order = 6;
  double Zone[2] = { 9.0, 57.0 };
  double Noise = 0.0;
  int Bits = 0;
  unsigned int Seed = 1;
  int NumberOfTheta = 48;
  int NumberOfPhi = 32;
  int NumberOfPhotographs = 0;
  bool Abort = false;

private:
  vtkBRDFAcquisition(const vtkBRDFAcquisition&) = delete;
  void operator=(const vtkBRDFAcquisition&) = delete;

  std::string FindProblem() const;
};

#endif
