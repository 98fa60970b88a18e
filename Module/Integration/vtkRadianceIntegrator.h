// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadianceIntegrator
 * @brief   outgoing radiance of a BRDF under light, for (normal, view) pairs (abstract)
 *
 * L_o = integral of f(i,o) L(i) cos(theta_i) di. Subclasses say how the integral is done. Pairs are
 * in world coordinates; the environment's rotation applies. Double precision, threads through
 * vtkSMPTools, ProgressEvent (calldata: double*) from the calling thread, interrupted by
 * SetAbort(true).
 */

#ifndef vtkRadianceIntegrator_h
#define vtkRadianceIntegrator_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF, Environment

#include <atomic> // for Abort

struct vtkBRDFShaderInputs;

class vtkBRDF;
class vtkDataArray;
class vtkEnvironment;

class VTKMEASUREDBRDF_EXPORT vtkRadianceIntegrator : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkRadianceIntegrator, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF();
  ///@}

  ///@{
  /**
   * The light; its rotation applies.
   */
  void SetEnvironment(vtkEnvironment* environment);
  vtkEnvironment* GetEnvironment();
  ///@}

  /**
   * Radiance (resized to 3 components, RGB; unchanged on failure) for each tuple of normals and
   * views (3 components, directions from the surface, any length but 0). tangents may be null: then
   * any frame about the normal is used, right for isotropic materials. A view below the horizon
   * gives 0. Returns false with an error event when arrays do not match, something is missing, a
   * direction is zero or not finite, or the run was aborted.
   */
  bool Integrate(vtkDataArray* normals, vtkDataArray* views, vtkDataArray* radiance,
    vtkDataArray* tangents = nullptr);

  /**
   * Build what the integrals need ahead of time, if it is missing or out of date; Integrate and
   * GetShaderInputs do so themselves. Returns false with an error event where that is not possible.
   */
  bool Prepare();

  /**
   * What a shader needs to do the same, built if necessary: terms whose GLSL text defines
   * `vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)`, their uniforms and textures. The columns of
   * frame are tangent, bitangent and normal in the environment's frame, o is the view in that
   * frame's coordinates, its cosine at least MinimumViewCosine. Terms are summed. Returns false
   * (form unchanged) where there is no such form or nothing to build it from.
   */
  virtual bool GetShaderInputs(vtkBRDFShaderInputs& form);

  /**
   * Whether the GLSL of GetShaderInputs calls the material's brdfEvaluate.
   */
  virtual bool UsesBRDFOnGPU() { return false; }

  /**
   * Whether it calls brdfEvaluateSoft: the material's form has to be asked for with
   * vtkBRDFShaderInputs::SoftLights.
   */
  virtual bool UsesSoftLights() { return false; }

  /**
   * When anything that Prepare depends on last changed. A rotation of the environment does not
   * count: everything is built in the environment's own frame.
   */
  virtual vtkMTimeType GetInputsMTime();

  ///@{
  /**
   * Set from an observer or another thread to stop a running Integrate. Each Integrate starts with
   * it cleared.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

protected:
  vtkRadianceIntegrator();
  ~vtkRadianceIntegrator() override;

  /// Check and precompute before the threads start, called when inputs changed since the last
  /// success; false (after an error event) stops.
  virtual bool Begin() = 0;

  /// Raise ProgressEvent; returns whether to go on.
  bool Report(double progress);

  /// How many parts the sum of one pair has: threads share pairs and parts alike, so one pair may
  /// keep all of them busy. The result does not depend on the number of threads.
  virtual int GetNumberOfParts() { return 1; }

  /// Add one part of one pair's radiance: unit n and o (environment frame), t = unit tangent or
  /// zero, n.o > 0. Thread safe.
  virtual void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) = 0;

  /// For integrators that are made of others: IntegratePart of a prepared one whose sum is one
  /// part.
  static void AddTo(vtkRadianceIntegrator* integrator, const double n[3], const double o[3],
    const double t[3], double radiance[3])
  {
    integrator->IntegratePart(0, n, o, t, radiance);
  }

  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkTimeStamp PrepareTime;
  std::atomic<bool> Abort{ false };

private:
  vtkRadianceIntegrator(const vtkRadianceIntegrator&) = delete;
  void operator=(const vtkRadianceIntegrator&) = delete;
};

#endif
