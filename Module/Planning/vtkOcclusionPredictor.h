// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOcclusionPredictor
 * @brief   how far off a picture is that leaves occlusion out
 *
 * For a scene, a material and an environment: the relative L1 error of light that reaches every
 * point unhindered, E = sum |U - R| / sum R over points and channels, where R is the traced
 * radiance (vtkTracedRadianceIntegrator) and U the same without occlusion. Points are drawn as
 * cameras see them (vtkTracedScene::DrawVisiblePoints), so a point weighs what it covers in a
 * picture.
 *
 * The uncertainty is two standard errors of that ratio of means over the points (Cochran 1977,
 * "Sampling Techniques", section 6.3), the samples' noise included. What hides a point is taken for
 * black.
 *
 * IsWorthModeling says whether occlusion should be modeled: it is what SetOcclusionModeToAuto of
 * the mappers does.
 */

#ifndef vtkOcclusionPredictor_h
#define vtkOcclusionPredictor_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF, Environment, Scene

#include <atomic> // for Abort
#include <string> // for GetText

class vtkBRDF;
class vtkEnvironment;
class vtkTracedScene;

class VTKMEASUREDBRDF_EXPORT vtkOcclusionPredictor : public vtkObject
{
public:
  static vtkOcclusionPredictor* New();
  vtkTypeMacro(vtkOcclusionPredictor, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What to predict for. The environment's rotation applies.
   */
  void SetScene(vtkTracedScene* scene);
  vtkTracedScene* GetScene();
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF();
  void SetEnvironment(vtkEnvironment* environment);
  vtkEnvironment* GetEnvironment();
  ///@}

  ///@{
  /**
   * Points (default 400, from 16 to 10^6), with 64 directions each. Where the uncertainty then
   * exceeds a quarter of the error (and the error, with it, 0.2 %), four times as many points are
   * traced, and four times as many again: reflections of lamps in gloss are rare.
   */
  virtual void SetNumberOfPoints(int numberOfPoints);
  vtkGetMacro(NumberOfPoints, int);
  ///@}

  /**
   * Predict, unless nothing changed. Returns false with an error event, the last prediction
   * unchanged, where something is missing. A scene that shows nothing has an error of 0.
   */
  bool Update();

  ///@{
  /**
   * Stop Update, also from another thread or an observer of ProgressEvent: it returns false with an
   * error event, the last prediction unchanged. Until it is false again, Update fails.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() const { return this->Abort; }
  ///@}

  ///@{
  /**
   * The predicted relative L1 error of leaving occlusion out, and its uncertainty (two standard
   * errors). An error above 1 is possible: where the scene hides most of the light. No light at all
   * reaches the scene: both are infinite.
   */
  vtkGetMacro(Error, double);
  vtkGetMacro(Uncertainty, double);
  ///@}

  /**
   * In words: "unoccluded light: 9 % on this surface (+- 2 %)".
   */
  std::string GetText();
  static std::string FormatText(double error, double uncertainty);

  /**
   * Whether occlusion should be modeled: its error exceeds what the tolerance leaves beside the
   * plan's error, sqrt(tolerance^2 - planError^2), but at least half the tolerance (a plan that is
   * worse than that gains nothing from less). The two errors have different causes, so they add as
   * squares.
   */
  static bool IsWorthModeling(double error, double planError, double tolerance);

protected:
  vtkOcclusionPredictor();
  ~vtkOcclusionPredictor() override;

  int NumberOfPoints = 400;
  double Error = 0.0;
  double Uncertainty = 0.0;
  std::atomic<bool> Abort{ false };

private:
  vtkOcclusionPredictor(const vtkOcclusionPredictor&) = delete;
  void operator=(const vtkOcclusionPredictor&) = delete;

  /// From so many points; false where that fails.
  bool Predict(int numberOfPoints);

  vtkSmartPointer<vtkTracedScene> Scene;
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkTimeStamp UpdateTime;
};

#endif
