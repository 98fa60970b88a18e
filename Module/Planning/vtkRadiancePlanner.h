// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadiancePlanner
 * @brief   how to integrate an environment's light for a material: at a small cost, and accurately
 *          enough
 *
 * Given a BRDF, an environment and a tolerance, it looks at candidates (a method of
 * vtkRadianceMethods and its sizes) from cheap to costly and chooses the first of those tried that
 * meets the tolerance. Errors are relative L1 over a sphere, mean |x - r| /
 * mean r, and are predicted by trying: each candidate is prepared and compared on some hundred
 * (normal, view) pairs with a nearly exact sum (for broad lobes a sum over thousands of lights, for
 * sharp ones an adaptive integral). The pairs are a sample of thousands, as a
 * sphere shows them to all views, drawn by where two cheap candidates differ; two standard errors
 * of that sample are added, with the sum's own error, so that what is predicted holds. A choice
 * that may be luck, or one that may have missed the tolerance by chance, is checked on a second
 * sample. The error is the mean over all views. One picture can have several times as much, when
 * most of the light is behind what it shows; GetPredictedPictureError estimates the largest. Where
 * that is above the tolerance, candidates are tried, too, whose frames are no longer and which take
 * at most 4 MB. One of them is taken if it is within the
 * tolerance in single pictures, or has at most two thirds of the error there. For one picture, plan
 * for it (SetPairs, vtkMeasuredBRDFMapper::SetPlanForView). A candidate's cost counts what a pixel
 * fetches and computes, times a pixel of a table (vtkRadianceIntegrator::EstimateCost).
 *
 * Candidates of the same cost are tried in the order of their textures' bytes: tables of radiance
 * cost the same few fetches at every size. Those that the ones before show to be hopeless are left
 * out. Where no candidate meets the tolerance, the most accurate one is chosen, the first of those
 * that differ by less than a tenth, and the reason says so. Frames of more than twice the shortest
 * are not tried where another misses the tolerance by what stands for chance only. A plan is made
 * again when the material, the environment's pixels or the settings changed, not when the
 * environment turned: one for all views is the same at every rotation.
 *
 * What a camera sees can need less than the whole sphere: SetPairs checks candidates on what is in
 * view only.
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
class vtkOcclusionPredictor;
class vtkRadianceIntegrator;
class vtkTracedScene;

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
   * Relative L1 error to stay below (default 0.02, in [1e-3, 1]).
   */
  virtual void SetErrorTolerance(double errorTolerance);
  vtkGetMacro(ErrorTolerance, double);
  ///@}

  ///@{
  /**
   * Unit direction from the object to the camera, world coordinates: pairs are drawn as seen from
   * there. 0, 0, 0 (default): from everywhere.
   */
  virtual void SetViewDirection(double x, double y, double z);
  virtual void SetViewDirection(const double viewDirection[3]);
  vtkGetVector3Macro(ViewDirection, double);
  ///@}

  /**
   * Check candidates on these pairs instead, what a camera sees: as many unit normals as unit
   * directions towards the camera, 3 components each, world coordinates with the environment turned
   * as it is, from 16 to 4096 of them (drawn in proportion to the pixels that they cover). Of more
   * than 512 these are taken for points of a picture: pairs between them are drawn as well, and of
   * all of these a sample of about 512. Copied. Two nulls (default): a sphere's. Returns false
   * with an error event, the pairs as they were, where the arrays do not fit, or a value is not
   * finite.
   */
  bool SetPairs(vtkDataArray* normals, vtkDataArray* views);

  /**
   * How many pairs SetPairs has set.
   */
  vtkIdType GetNumberOfPairs();

  ///@{
  /**
   * Also try the candidates that the search leaves out, and those that are never chosen, for lists
   * of them (default off): seconds instead of tenths. The choice is the same.
   */
  vtkSetMacro(EvaluateAll, bool);
  vtkGetMacro(EvaluateAll, bool);
  vtkBooleanMacro(EvaluateAll, bool);
  ///@}

  ///@{
  /**
   * Largest texture memory of a plan in bytes (default 96 MiB). Where no candidate meets the
   * tolerance, more than 12 MB are taken only if they leave at most 60 % of the error.
   */
  virtual void SetMaximumTextureBytes(vtkIdType maximumTextureBytes);
  vtkGetMacro(MaximumTextureBytes, vtkIdType);
  ///@}

  ///@{
  /**
   * Surfaces whose occlusion Update predicts, too (vtkOcclusionPredictor): by how much a picture of
   * them is off in this material and light, as long as occlusion is left out. Null (default): it is
   * not predicted. The choice does not depend on it.
   */
  void SetScene(vtkTracedScene* scene);
  vtkTracedScene* GetScene();
  ///@}

  ///@{
  /**
   * That error, relative L1, and two standard errors of it (both 0 without a scene); and whether it
   * exceeds what the tolerance leaves beside the choice's error
   * (vtkOcclusionPredictor::IsWorthModeling).
   */
  double GetUnoccludedError();
  double GetUnoccludedErrorUncertainty();
  bool GetNeedsOcclusion();
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
  double GetErrorUncertainty(int index);      // two standard errors and the reference's
  double GetPredictedPictureError(int index); // estimated: the largest of a sphere from 14 sides
  double GetPredictedCost(int index);         // of a pixel, times a table's
  vtkIdType GetTextureBytes(int index);
  double GetSetUpMilliseconds(int index);
  ///@}

  ///@{
  /**
   * The choice, -1 before any; whether it meets the tolerance in the mean over all views (or over
   * what is in view); why it was chosen, one line, also where it takes more than 4 MB or does not
   * meet the tolerance.
   */
  int GetChoice();
  bool GetMeetsTolerance();
  std::string GetReason();
  ///@}

  /**
   * The plan in words: the choice, its figures and the reason; with a scene also the error of
   * leaving occlusion out.
   */
  std::string GetPlan();

  ///@{
  /**
   * The integrator of a candidate (the choice), which the caller has to release. The choice's is
   * the one that was tried, prepared and shared with the planner; others are new. Null where index
   * is out of range.
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
  vtkIdType MaximumTextureBytes = 96 << 20;
  double ViewDirection[3] = { 0.0, 0.0, 0.0 };
  bool EvaluateAll = false;
  std::atomic<bool> Abort{ false };

private:
  vtkRadiancePlanner(const vtkRadiancePlanner&) = delete;
  void operator=(const vtkRadiancePlanner&) = delete;

  /// Choose, unless nothing changed; false with an error event where that is not possible.
  bool Choose();

  /// Choose anew.
  bool Search();

  /// Predict the error of leaving occlusion out of the scene, where there is one.
  bool PredictOcclusion();
  std::string DescribeOcclusion();

  /// The error event of a run that can't go on; false.
  bool Fail();

  struct Internals;
  std::unique_ptr<Internals> Impl;
  vtkSmartPointer<vtkOcclusionPredictor> Occlusion; // null: no scene
};

#endif
