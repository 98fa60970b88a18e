// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiancePlanner
 * @brief   how to integrate an environment's light for a material: at a small cost, and accurately
 *          enough
 *
 * Given a BRDF, an environment and a tolerance, it climbs a ladder of methods and their sizes
 * (vtkRadianceMethods) in the order of what a pixel costs:
 *
 * 1. radiance tables of 17 and 33 rows, and of 49 and 201 where the light has no suns or lamps;
 * 2. where it has: tables of 33, 65 and 81 rows with suns and lamps as lights, and eight maps with
 *    these;
 * 3. filtered samples: 16, 64, 256 of the material's lobe with as many of the light.
 *
 * Anisotropic materials have tables of their own, and sets of 64 and 256 lights at the top. The
 * climb ends at the first rung within the tolerance, which is the choice; where there is none, the
 * most accurate one is. GetInteractiveChoice is what to draw while somebody interacts and the
 * choice takes too long: the most accurate of the rungs tried that cost at most four times a
 * table's pixel, so no samples.
 *
 * Errors are relative L1 over a sphere, mean |x - r| / mean r, and are measured: each rung is
 * prepared and compared on about 512 (normal, view) pairs with a nearly exact sum (for broad lobes
 * of isotropic materials a sum over thousands of lights, for all others an adaptive integral). The
 * pairs are a sample of thousands, as a sphere shows them to all views, drawn by where the two
 * lowest rungs differ; two standard errors of that sample are added, with the sum's own error, so
 * that what is predicted holds. The error is the mean over all views. One picture can have several
 * times as much, when most of the light is behind what it shows; GetPredictedPictureError estimates
 * the largest. For one picture, plan for it (SetPairs, vtkMeasuredBRDFMapper::SetPlanForView).
 *
 * A plan is made again when the material, the environment's pixels or the settings changed, not
 * when the environment turned: one for all views is the same at every rotation.
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
class vtkDataArray;
class vtkEnvironment;
class vtkRadianceIntegrator;

class VTKMEASUREDBRDF_EXPORT vtkRadiancePlanner : public vtkObject
{
public:
  static vtkRadiancePlanner* New();
  vtkTypeMacro(vtkRadiancePlanner, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

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
   * Relative L1 error to stay below (default 0.02, in [1e-3, 1]). No plan promises less than
   * 0.0013, which texture units' weights of 8 bits may cost.
   */
  virtual void SetErrorTolerance(double errorTolerance);
  vtkGetMacro(ErrorTolerance, double);
  ///@}

  /**
   * Check candidates on these pairs instead, what a camera sees: as many unit normals as unit
   * directions towards the camera, 3 components each, world coordinates with the environment turned
   * as it is, from 16 to 16384 of them (drawn in proportion to the pixels that they cover). Of more
   * than 512 a sample of about 512 is compared on. Copied. Two nulls (default): a sphere's. Returns
   * false with an error event, the pairs as they were, where the arrays do not fit, or a value is
   * not finite.
   */
  bool SetPairs(vtkDataArray* normals, vtkDataArray* views);

  ///@{
  /**
   * Also try the rungs that the climb leaves out, and methods that are never chosen, for lists of
   * them (default off): seconds instead of tenths. The choice is the same.
   */
  vtkSetMacro(EvaluateAll, bool);
  vtkGetMacro(EvaluateAll, bool);
  vtkBooleanMacro(EvaluateAll, bool);
  ///@}

  ///@{
  /**
   * Largest texture memory of a plan in bytes, with the material's own textures where a method
   * needs them (default 24 MiB: all rungs under maps of up to 2048 x 1024; tables take at most
   * 12 MB).
   */
  virtual void SetMaximumTextureBytes(vtkIdType maximumTextureBytes);
  vtkGetMacro(MaximumTextureBytes, vtkIdType);
  ///@}

  ///@{
  /**
   * What a pixel may cost, times a table's, in [1, 1e6] (default 150: 256 samples with as many
   * lights cost 115, and suns come on top). The plan says what was given up.
   */
  virtual void SetMaximumCost(double maximumCost);
  vtkGetMacro(MaximumCost, double);
  ///@}

  /**
   * List candidates and choose, unless nothing changed. Returns false with an error event, the plan
   * unchanged, where something is missing or nothing can be planned. Raises ProgressEvent.
   */
  bool Update();

  ///@{
  /**
   * The candidates that were tried, cheapest first; index in [0, GetNumberOfCandidates()).
   */
  int GetNumberOfCandidates();
  std::string GetMethodName(int index);       // as vtkRadianceMethods knows it, e.g. "table"
  std::string GetDescription(int index);      // sizes
  double GetPredictedError(int index);        // relative L1, that of the sample and what follows
  double GetErrorUncertainty(int index);      // of chance, the reference and units
  double GetPredictedPercentile95(int index); // what 95 % of the pixels stay within, over the mean
  double GetPredictedPercentile99(int index);
  double GetPredictedPictureError(int index); // estimated: the largest of a sphere from 14 sides
  double GetPredictedCost(int index);         // of a pixel, times a table's
  vtkIdType GetTextureBytes(int index);
  double GetSetUpMilliseconds(int index);
  ///@}

  ///@{
  /**
   * The choice, -1 before any; what to draw while somebody interacts, the same or a cheaper one;
   * whether the choice meets the tolerance in the mean over all views (or over what is in view);
   * why it was chosen, one line.
   */
  int GetChoice();
  int GetInteractiveChoice();
  bool GetMeetsTolerance();
  std::string GetReason();
  ///@}

  /**
   * The plan in words: the choice, its figures and the reason.
   */
  std::string GetPlan();

  ///@{
  /**
   * The integrator of a candidate (the choice), which the caller has to release. Those of the
   * choice and of the interactive choice are the ones that were tried, prepared and shared with the
   * planner; others are new. Null where index is out of range.
   */
  VTK_NEWINSTANCE vtkRadianceIntegrator* NewIntegrator(int index);
  VTK_NEWINSTANCE vtkRadianceIntegrator* NewIntegrator();
  ///@}

  ///@{
  /**
   * Set from an observer or another thread to stop Update: the running one or, where none runs,
   * the next. Cleared when that returns.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

protected:
  vtkRadiancePlanner();
  ~vtkRadiancePlanner() override;

  double ErrorTolerance = 0.02;
  vtkIdType MaximumTextureBytes = 24 << 20;
  double MaximumCost = 150.0;
  bool EvaluateAll = false;
  std::atomic<bool> Abort{ false };

private:
  vtkRadiancePlanner(const vtkRadiancePlanner&) = delete;
  void operator=(const vtkRadiancePlanner&) = delete;

  /// Choose anew.
  bool Search();

  /// The error event of a run that can't go on; false.
  bool Fail(const std::string& problem);

  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
