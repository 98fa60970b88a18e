// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBasisProjector
 * @brief   projects any BRDF onto a basis, by least squares over a zone of incident directions
 *
 * For every sample of o the coefficients minimize the integral of (f - sum_k C_k B_k)^2
 * cos(theta_i) over the zone. They are computed by a Fourier series in the azimuth (2^8 equidistant
 * nodes) and, per azimuthal order, a weighted least-squares problem over Gauss-Legendre nodes in
 * cos(theta_i) with their exact weights. INNER_PRODUCT gives the plain projections C_k = integral
 * of f [cos(theta_i)] B_k di instead, as a device measures them. Spherical harmonics are not
 * orthogonal on the upper hemisphere alone, so their squares get a term Regularization x sum
 * (l(l+1))^2 C^2, relative to the data's weight.
 *
 * Isotropic materials give the isotropic form (nPhi = 1).
 */

#ifndef vtkBasisProjector_h
#define vtkBasisProjector_h

#include "vtkBRDF.h"               // for Input
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for members

#include "vtkBasisBRDF.h" // for Output

class VTKMEASUREDBRDF_EXPORT vtkBasisProjector : public vtkObject
{
public:
  static vtkBasisProjector* New();
  vtkTypeMacro(vtkBasisProjector, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    LEAST_SQUARES = 0,
    INNER_PRODUCT = 1
  };

  ///@{
  /**
   * The BRDF to project.
   */
  void SetInput(vtkBRDF* input);
  vtkBRDF* GetInput() { return this->Input; }
  ///@}

  ///@{
  /**
   * vtkBasisBRDF's type and order; default Legendre x Fourier of order 6. Project refuses orders
   * outside [1, vtkBasisBRDF::MaximumOrder].
   */
  virtual void SetBasis(int basis);
  vtkGetMacro(Basis, int);
  virtual void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * Polar angles in degrees of the light (for zonal and Legendre x Fourier; the other bases cover
   * the hemisphere) and of the view; default 0 to 90 for both.
   */
  virtual void SetIncidentZone(double begin, double end);
  virtual void SetIncidentZone(const double incidentZone[2]);
  vtkGetVector2Macro(IncidentZone, double);
  virtual void SetOutgoingZone(double begin, double end);
  virtual void SetOutgoingZone(const double outgoingZone[2]);
  vtkGetVector2Macro(OutgoingZone, double);
  ///@}

  ///@{
  /**
   * Whether the sum holds f cos(theta_i), f cos(theta_o) (vtkBasisBRDF); default off and on.
   */
  vtkSetMacro(IncidentCosine, bool);
  vtkGetMacro(IncidentCosine, bool);
  vtkBooleanMacro(IncidentCosine, bool);
  vtkSetMacro(OutgoingCosine, bool);
  vtkGetMacro(OutgoingCosine, bool);
  vtkBooleanMacro(OutgoingCosine, bool);
  ///@}

  ///@{
  /**
   * Least squares (default) or inner products.
   */
  virtual void SetMethod(int method);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /**
   * Weight of the Laplacian's square; default 1e-6, in [0, 1]. It is used only for spherical
   * harmonics by least squares.
   */
  virtual void SetRegularization(double regularization);
  vtkGetMacro(Regularization, double);
  ///@}

  ///@{
  /**
   * Samples of theta_o (default 64, in [2, 1024]) and, for anisotropic materials, of phi_o (default
   * 32, in [4, 1024]).
   */
  virtual void SetNumberOfTheta(int numberOfTheta);
  vtkGetMacro(NumberOfTheta, int);
  virtual void SetNumberOfPhi(int numberOfPhi);
  vtkGetMacro(NumberOfPhi, int);
  ///@}

  ///@{
  /**
   * Nodes in theta_i: default 96, in [8, 1024]. Sharp lobes need more nodes. Project refuses
   * numbers that do not exceed the order.
   */
  virtual void SetNumberOfNodes(int numberOfNodes);
  vtkGetMacro(NumberOfNodes, int);
  ///@}

  ///@{
  /**
   * Set this in an observer of ProgressEvent (calldata: double*) to stop: Project returns false.
   */
  vtkSetMacro(Abort, bool);
  vtkGetMacro(Abort, bool);
  vtkBooleanMacro(Abort, bool);
  ///@}

  /**
   * Project. Returns false with an error event and leaves the output unchanged without an input or
   * with an invalid order, zone (vtkBasisBRDF::FindZoneProblem) or number of nodes; returns false
   * without an error event when aborted.
   */
  bool Project();

  /**
   * The result, a new object at every Project; null before.
   */
  vtkBasisBRDF* GetOutput() { return this->Output; }

protected:
  vtkBasisProjector() = default;
  ~vtkBasisProjector() override = default;

  vtkSmartPointer<vtkBRDF> Input;
  vtkSmartPointer<vtkBasisBRDF> Output;
  int Basis = vtkBasisBRDF::LEGENDRE_FOURIER;
  int Order = 6;
  double IncidentZone[2] = { 0.0, 90.0 };
  double OutgoingZone[2] = { 0.0, 90.0 };
  bool IncidentCosine = false;
  bool OutgoingCosine = true;
  int Method = LEAST_SQUARES;
  double Regularization = 1e-6;
  int NumberOfTheta = 64;
  int NumberOfPhi = 32;
  int NumberOfNodes = 96;
  bool Abort = false;

private:
  vtkBasisProjector(const vtkBasisProjector&) = delete;
  void operator=(const vtkBasisProjector&) = delete;
};

#endif
