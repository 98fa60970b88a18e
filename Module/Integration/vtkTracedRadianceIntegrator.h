// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTracedRadianceIntegrator
 * @brief   the reference with occlusion: radiance that leaves points of a scene, by rays
 *
 * L_o = integral of f(i,o) (V(i) L(i) + (1 - V(i)) L_h(i)) cos(theta_i) di about the point's
 * interpolated normal. V is 1 where the scene does not hide the sky in direction i of the point,
 * else 0. L_h is what leaves the point that hides it: nothing with 0 bounces; with b bounces the
 * same integral there, with b - 1. vtkRadianceIntegrator and its subclasses leave V out (V = 1).
 *
 * Directions are drawn by the sky's radiance, by the material and by the cosine, and weighted by
 * the mixture's density (Veach, Guibas 1995). They fall within texels too, so neither L nor V is
 * rounded to their centers. With UnoccludedReference (default) the samples give only the share V of
 * the light, channel by channel, and vtkAdaptiveRadianceIntegrator gives the light itself: where
 * nothing is hidden, the result is that reference. Each point has its own fixed samples: the same
 * call gives the same result, with any number of threads. GetNoise tells how far other samples
 * would be off; it falls as 1/sqrt(samples), or faster.
 *
 * Bounces follow one path for each sample that is hidden.
 */

#ifndef vtkTracedRadianceIntegrator_h
#define vtkTracedRadianceIntegrator_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF, Environment, Scene

#include <atomic> // for Abort
#include <map>    // for materials
#include <string> // for problems

class vtkBRDF;
class vtkDataArray;
class vtkEnvironment;
class vtkPolyData;
class vtkTracedScene;

class VTKMEASUREDBRDF_EXPORT vtkTracedRadianceIntegrator : public vtkObject
{
public:
  static vtkTracedRadianceIntegrator* New();
  vtkTypeMacro(vtkTracedRadianceIntegrator, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What hides and, with bounces, reflects.
   */
  void SetScene(vtkTracedScene* scene);
  vtkTracedScene* GetScene();
  ///@}

  ///@{
  /**
   * The material of all surfaces, but for those that have their own. SetSurfaceBRDF(k, null): the
   * common one again.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF();
  void SetSurfaceBRDF(int surface, vtkBRDF* brdf);
  vtkBRDF* GetSurfaceBRDF(int surface);
  ///@}

  ///@{
  /**
   * The light; its rotation applies.
   */
  void SetEnvironment(vtkEnvironment* environment);
  vtkEnvironment* GetEnvironment();
  ///@}

  ///@{
  /**
   * Directions a point, from 8 to 2^24 (default 512).
   */
  virtual void SetNumberOfSamples(int numberOfSamples);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * How often light that comes from a surface was reflected at most, from 0 (default: what is
   * hidden is black) to 1000.
   */
  virtual void SetNumberOfBounces(int numberOfBounces);
  vtkGetMacro(NumberOfBounces, int);
  ///@}

  ///@{
  /**
   * Take the light from the reference without occlusion, and only the visible share from the
   * samples (default on). Off: all from the samples; faster, and noisy where nothing is hidden,
   * too.
   */
  vtkSetMacro(UnoccludedReference, bool);
  vtkGetMacro(UnoccludedReference, bool);
  vtkBooleanMacro(UnoccludedReference, bool);
  ///@}

  ///@{
  /**
   * Another one gives other samples (default 0).
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  /**
   * Radiance (3 components, RGB; unchanged on failure) that leaves each point towards views (3
   * components, directions from the surface, any length but 0). points: as vtkTracedScene::CastRays
   * fills them, or any with point normals ("FacetNormals": the normals where there are none;
   * "Surface": 0). The normals tell the side. Where "Surface" is -1, or a direction is zero or not
   * finite, the result is 0. A view that is less than 1.15 degrees above the horizon counts as one
   * there, as in shaders.
   *
   * unoccluded, tangents: may be null. unoccluded becomes the radiance if nothing were hidden.
   * tangents: for anisotropic materials; where light bounces they have an arbitrary tangent.
   *
   * Raises ProgressEvent (calldata: double*) from the calling thread. Returns false with an error
   * event where something is missing or does not match, or the run was aborted.
   */
  bool Integrate(vtkPolyData* points, vtkDataArray* views, vtkDataArray* radiance,
    vtkDataArray* unoccluded = nullptr, vtkDataArray* tangents = nullptr);

  /**
   * By how much the last result would differ with other samples: the standard error of a point,
   * mean over all, relative to their mean radiance; from two halves of the samples. 0 before any.
   */
  vtkGetMacro(Noise, double);

  ///@{
  /**
   * Set from an observer or another thread to stop a running Integrate. Each Integrate starts with
   * it cleared.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

protected:
  vtkTracedRadianceIntegrator();
  ~vtkTracedRadianceIntegrator() override;

  int NumberOfSamples = 512;
  int NumberOfBounces = 0;
  bool UnoccludedReference = true;
  int Seed = 0;
  double Noise = 0.0;
  std::atomic<bool> Abort{ false };

private:
  vtkTracedRadianceIntegrator(const vtkTracedRadianceIntegrator&) = delete;
  void operator=(const vtkTracedRadianceIntegrator&) = delete;

  struct Run;
  std::string FindProblem(vtkPolyData* points, vtkDataArray* views, vtkDataArray* tangents);
  bool IntegrateOpen(Run& run);
  bool Trace(Run& run);
  bool Report(double progress);

  vtkSmartPointer<vtkTracedScene> Scene;
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  std::map<int, vtkSmartPointer<vtkBRDF>> SurfaceBRDFs;
};

#endif
