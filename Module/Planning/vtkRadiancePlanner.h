// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiancePlanner
 * @brief   how to integrate an environment's light for a material: the least cost that is accurate
 *          enough
 *
 * Given a BRDF, an environment and a tolerance, it lists candidates (an integrator and its sizes)
 * with predicted error, cost, memory and set-up time, and chooses the cheapest that meets the
 * tolerance: no more than the scene needs. Errors are relative L1 over a sphere, mean |x - r| /
 * mean r; predictions come from certificates that need no rendering:
 *
 * - TABLE: the spectra of the kernels and of the environment. Averaged over all orientations, what
 *   interpolation and truncation change of each degree and order adds up to the mean square error
 *   (Parseval on the rotation group).
 * - BASIS: the SVD's tail (Eckart, Young 1936) and its map's resolution.
 * - LIGHT_SET: the sum of the regions' variances, 0.06 n V / E.
 * - FILTERED: the law of its samples, c / N.
 *
 * Costs are nanoseconds per covered pixel: fetches times what one costs here (SetFetchCosts).
 * A plan is made again when the material or the environment's pixels changed; a rotation changes
 * nothing. With hysteresis: the last choice stays as long as it meets the tolerance times 1.3 and
 * nothing is cheaper by more than 1.3.
 */

#ifndef vtkRadiancePlanner_h
#define vtkRadiancePlanner_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF, Environment

#include <atomic> // for Abort
#include <memory> // for Internals
#include <string> // for descriptions

class vtkBRDF;
class vtkEnvironment;
class vtkRadianceIntegrator;

class VTKMEASUREDBRDF_EXPORT vtkRadiancePlanner : public vtkObject
{
public:
  static vtkRadiancePlanner* New();
  vtkTypeMacro(vtkRadiancePlanner, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    LIGHT_SET = 0, // variance light set, soft
    BASIS = 1,
    FILTERED = 2,
    TABLE = 3
  };

  ///@{
  /**
   * What to plan for.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF();
  void SetEnvironment(vtkEnvironment* environment);
  vtkEnvironment* GetEnvironment();
  ///@}

  ///@{
  /**
   * Relative L1 error to stay below (default 0.02, in [1e-3, 1]).
   */
  vtkSetClampMacro(ErrorTolerance, double, 1e-3, 1.0);
  vtkGetMacro(ErrorTolerance, double);
  ///@}

  ///@{
  /**
   * Largest texture memory of a plan in bytes (default 64 MiB). Plans above 4 MB say why.
   */
  vtkSetMacro(MaximumTextureBytes, vtkIdType);
  vtkGetMacro(MaximumTextureBytes, vtkIdType);
  ///@}

  ///@{
  /**
   * Covered pixels that a predicted frame time counts (default 196350, a 500 x 500 sphere).
   */
  vtkSetMacro(NumberOfPixels, vtkIdType);
  vtkGetMacro(NumberOfPixels, vtkIdType);
  ///@}

  /**
   * List candidates and choose, unless nothing changed. Returns false with an error event, the plan
   * unchanged, where something is missing or nothing can be planned. Raises ProgressEvent.
   */
  bool Update();

  ///@{
  /**
   * The candidates, cheapest first; index in [0, GetNumberOfCandidates()).
   */
  int GetNumberOfCandidates();
  int GetMethod(int index);
  std::string GetMethodName(int index);       // "light-set", "basis", "filtered", "table"
  std::string GetDescription(int index);      // sizes
  double GetPredictedError(int index);        // relative L1
  double GetPredictedMilliseconds(int index); // of NumberOfPixels
  vtkIdType GetTextureBytes(int index);
  double GetSetUpMilliseconds(int index);
  ///@}

  ///@{
  /**
   * The choice, -1 before any; whether it meets the tolerance; why it was chosen, one line.
   */
  int GetChoice();
  bool GetMeetsTolerance();
  std::string GetReason();
  ///@}

  /**
   * The plan in words: the choice, its figures and the reason.
   */
  std::string GetPlan();

  ///@{
  /**
   * An integrator of a candidate (the choice), with BRDF and environment set, not yet prepared. A
   * new object the caller owns; null where index is out of range.
   */
  VTK_NEWINSTANCE vtkRadianceIntegrator* NewIntegrator(int index);
  VTK_NEWINSTANCE vtkRadianceIntegrator* NewIntegrator();
  ///@}

  ///@{
  /**
   * Set from an observer to stop a running Update.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

protected:
  vtkRadiancePlanner();
  ~vtkRadiancePlanner() override;

  double ErrorTolerance = 0.02;
  vtkIdType MaximumTextureBytes = 64 << 20;
  vtkIdType NumberOfPixels = 196350;
  std::atomic<bool> Abort{ false };

private:
  vtkRadiancePlanner(const vtkRadiancePlanner&) = delete;
  void operator=(const vtkRadiancePlanner&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
