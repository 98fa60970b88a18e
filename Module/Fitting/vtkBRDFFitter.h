// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFFitter
 * @brief   abstract class that fits the parameters of a model to a given BRDF
 *
 * Minimizes the weighted mean of (T(f) - T(f'))^2 over direction pairs and RGB, where f is the
 * input and f' the model. The weights are solid angle of i times projected solid angle of o (Low et
 * al. 2012 with the view's weights of Bieron and Peers 2020). Only views whose cosine is at least
 * 0.02 are used, because no other view is ever shaded. T is the loss:
 *
 *     LOG_COSINE        ln(1 + f cos_i)       Low et al. 2012; close to visible differences
 *     CUBE_ROOT_COSINE  (f cos_i)^(1/3)       Fores et al. 2012; sharp lobes have less weight
 *     SQUARED           f sqrt(cos_i)         minimizes the relative L2 error
 *
 * Pairs are low-discrepancy points, half over half and difference angles (dense at theta_h = 0, so
 * that sharp lobes are sampled) and half over both hemispheres. Pairs that a table interpolates
 * mostly from invalid cells are left out. The same input, options and seed give the same result.
 *
 * A subclass names its model and minimizes over the samples that it gets (GetModelName, FitTo). The
 * samples, the figures and the checks of input and output are the same for all models.
 *
 * Raises ProgressEvent (calldata: double*) from the calling thread; SetAbort(true) stops the fit.
 */

#ifndef vtkBRDFFitter_h
#define vtkBRDFFitter_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Input, Output

#include <atomic> // for Abort
#include <string> // for GetReport
#include <vector> // for GetResidualHistory

class vtkBRDF;

class VTKMEASUREDBRDF_EXPORT vtkBRDFFitter : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkBRDFFitter, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

#ifndef __VTK_WRAP__
  /**
   * A direction pair that the fit looks at, with the input's f and its weight; all weights sum
   * to 1.
   */
  struct Sample
  {
    double I[3];
    double O[3];
    double F[3];
    double Weight;
  };
  using Samples = std::vector<Sample>;

  /// Makes the weights sum to 1.
  static void NormalizeWeights(Samples& samples);

  /**
   * The result of a model's fit; a null BRDF if it was aborted or failed. Report then says why.
   */
  struct Result
  {
    vtkSmartPointer<vtkBRDF> BRDF;
    std::vector<double> History; // mean squares over the samples
    bool Converged = false;
    std::string Report;
  };

  ///@{
  /**
   * T of the current loss, and its derivative by f, which is finite for every f >= 0.
   */
  double GetLossValue(double f, double cosine) const;
  double GetLossSlope(double f, double cosine) const;
  ///@}
#endif

  enum LossType
  {
    LOG_COSINE = 0,
    CUBE_ROOT_COSINE = 1,
    SQUARED = 2
  };

  ///@{
  /**
   * The BRDF to fit. It is not changed, except that Prepare is called.
   */
  void SetInput(vtkBRDF* input);
  vtkBRDF* GetInput();
  ///@}

  ///@{
  /**
   * The loss to minimize: LOG_COSINE (default), CUBE_ROOT_COSINE or SQUARED.
   */
  virtual void SetLoss(int loss);
  vtkGetMacro(Loss, int);
  void SetLossToLogCosine() { this->SetLoss(LOG_COSINE); }
  void SetLossToCubeRootCosine() { this->SetLoss(CUBE_ROOT_COSINE); }
  void SetLossToSquared() { this->SetLoss(SQUARED); }
  ///@}

  ///@{
  /**
   * Number of direction pairs, in [256, 2^22]; default 32768.
   */
  virtual void SetNumberOfSamples(int numberOfSamples);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * Number of starting points that are refined before the best of them is finished, in [1, 64];
   * default 4. A model may have fewer starting points.
   */
  virtual void SetNumberOfStarts(int numberOfStarts);
  vtkGetMacro(NumberOfStarts, int);
  ///@}

  ///@{
  /**
   * Largest number of iterations from the best start, in [1, 10000]; default 200.
   */
  virtual void SetMaximumNumberOfIterations(int maximumNumberOfIterations);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Stop when an iteration lowers the mean square by a smaller share than this, in (0,1); default
   * 1e-6.
   */
  virtual void SetTolerance(double tolerance);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Shifts the sequence of direction pairs; default 1.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  /**
   * Fit. Returns false with an error event and leaves output and figures unchanged when there is no
   * input, the input is 0 (or has no valid cell) at every pair or is too large to be squared, or
   * the run was aborted.
   */
  bool Fit();

  ///@{
  /**
   * Set this from an observer or another thread to stop a running Fit. Each Fit clears it first.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  void AbortOn() { this->SetAbort(true); }
  void AbortOff() { this->SetAbort(false); }
  ///@}

  /**
   * The fitted material, null before the first success; each Fit makes a new one. It has the
   * input's name.
   */
  vtkBRDF* GetOutput();

  ///@{
  /**
   * Errors of the output over new pairs that the fit did not use (as many, at least 16384): the
   * root of the weighted mean of (T(f) - T(f'))^2, in units of T, and the relative L2 error as in
   * vtkBRDFResampler::GetRelativeL2Error (but without invalid cells).
   */
  vtkGetMacro(Residual, double);
  vtkGetMacro(RelativeL2Error, double);
  ///@}

  ///@{
  /**
   * Hemispherical albedo of input and output, RGB, over the same pairs: the reflected share of the
   * light of a white sky.
   */
  vtkGetVector3Macro(InputAlbedo, double);
  vtkGetVector3Macro(OutputAlbedo, double);
  ///@}

  ///@{
  /**
   * Number of iterations from the best start; whether Tolerance ended them (not
   * MaximumNumberOfIterations); and the residual over the fit's own pairs before and after each
   * iteration, which never grows.
   */
  int GetNumberOfIterations();
  vtkGetMacro(Converged, bool);
  const std::vector<double>& GetResidualHistory() const { return this->ResidualHistory; }
  ///@}

  ///@{
  /**
   * The model's name, and its fitted parameters as text, one per line.
   */
  virtual std::string GetModelName() = 0;
  std::string GetReport() { return this->Report; }
  ///@}

protected:
  vtkBRDFFitter();
  ~vtkBRDFFitter() override;

  /**
   * Fit the model: minimize the mean of (GetLossValue(f, cos_i) - GetLossValue(f', cos_i))^2 over
   * samples and RGB. Input is set and prepared. Ask UpdateProgress now and then.
   */
  virtual Result FitTo(const std::vector<Sample>& samples) = 0;

  /**
   * Report progress to the observers; returns false if the run has to stop.
   */
  bool UpdateProgress(double share);

  vtkSmartPointer<vtkBRDF> Input;
  vtkSmartPointer<vtkBRDF> Output;
  int Loss = LOG_COSINE;
  int NumberOfSamples = 32768;
  int NumberOfStarts = 4;
  int MaximumNumberOfIterations = 200;
  double Tolerance = 1e-6;
  unsigned int Seed = 1;
  std::atomic<bool> Abort{ false };
  double Residual = 0.0;
  double RelativeL2Error = 0.0;
  double InputAlbedo[3] = { 0.0, 0.0, 0.0 };
  double OutputAlbedo[3] = { 0.0, 0.0, 0.0 };
  bool Converged = false;
  std::vector<double> ResidualHistory;
  std::string Report;

private:
  vtkBRDFFitter(const vtkBRDFFitter&) = delete;
  void operator=(const vtkBRDFFitter&) = delete;

  void Measure(vtkBRDF* output); // throws, nothing changed, where the figures are not finite
};

#endif
