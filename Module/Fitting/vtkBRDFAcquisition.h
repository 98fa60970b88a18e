// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFAcquisition
 * @brief   measures a material as the device of Ghosh et al. 2007 does, in simulation
 *
 * A projector lights the sample from all directions of a zone at once with the basis functions
 * B_k, one after the other, each as two patterns, max(B_k, 0) and max(-B_k, 0), scaled to the
 * projector's range; a camera sees every direction o of the same zone in one image. The difference
 * of the two photographs, scaled back, is
 *
 *   C_k(o) = integral over the zone of f(i,o) cos(theta_i) B_k(i) di,
 *
 * one slice of the coefficient stack: vtkBasisBRDF with IncidentCosine on, because light that comes
 * from a projector brings the cosine along. Each pair of photographs is exposed so that its
 * brightest pixel is 1; noise is Gaussian with a standard deviation of Noise of that, and values
 * are rounded to Bits bits and clipped to [0, 1]. Isotropic materials: the camera's azimuths are
 * averaged after turning the coefficients, which also averages the noise.
 *
 * The papers' figures (zone, orders, pixels, noise) could not be checked; the defaults are this
 * project's. Repeatable: the same Seed gives the same bits.
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
   * Basis and order; default zonal of order 6. Spherical harmonics are refused: they are no basis
   * of what a device reaches. Orders outside [1, vtkBasisBRDF::MaximumOrder] are refused.
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
   * Bits of the camera's pixels, 1 to 24; 0 (default): no rounding. Others are refused.
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
   * So many pixels of an anisotropic sample that its responses take more than 1 GiB are refused.
   */
  virtual void SetNumberOfTheta(int numberOfTheta);
  vtkGetMacro(NumberOfTheta, int);
  virtual void SetNumberOfPhi(int numberOfPhi);
  vtkGetMacro(NumberOfPhi, int);
  ///@}

  ///@{
  /**
   * Set it in an observer of ProgressEvent (calldata: double*) to stop: Acquire returns false.
   */
  vtkSetMacro(Abort, bool);
  vtkGetMacro(Abort, bool);
  vtkBooleanMacro(Abort, bool);
  ///@}

  /**
   * Measure. Returns false with an error event, output unchanged, without an input or with an
   * option that is refused; false without one when aborted.
   */
  bool Acquire();

  /**
   * The coefficient stack as a material, a new object at every Acquire; null before.
   */
  vtkBasisBRDF* GetOutput() { return this->Output; }

  /**
   * Photographs that were taken: two per basis function but the first, which is nowhere negative
   * (for as many functions as have a negative part).
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
