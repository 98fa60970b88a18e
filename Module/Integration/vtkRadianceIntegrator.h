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
 *
 * A mapper draws any integrator that has shader inputs (vtkMeasuredBRDFMapper::SetIntegrator). An
 * integrator is a method, too: it has a name and sizes. Register an instance with
 * vtkRadianceMethods, and planners try the sizes that GetCandidateSizes lists, and programs find
 * the method by its name. Examples/Cxx/CustomMethod is one.
 */

#ifndef vtkRadianceIntegrator_h
#define vtkRadianceIntegrator_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF, Environment

#include <atomic>     // for Abort
#include <functional> // for sizes
#include <memory>     // for Precomputation
#include <string>     // for names
#include <vector>     // for sizes

struct vtkBRDFShaderInputs;
struct vtkDirectionPair;

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
   * gives 0. One less than 1.15 degrees above it (a cosine of 0.02) counts as one at 1.15 degrees,
   * as in shaders: measured f grows as 1/cos there, where no instrument measures. Returns false
   * with an error event when arrays do not match, something is missing, a direction is zero or not
   * finite, or the run was aborted.
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
   * (inputs unchanged) where there is no such text or nothing to build it from.
   */
  virtual bool GetShaderInputs(vtkBRDFShaderInputs& inputs);

  /**
   * Whether the GLSL of GetShaderInputs calls the material's brdfEvaluate.
   */
  virtual bool UsesBRDFOnGPU() { return false; }

  /**
   * Whether it calls brdfEvaluateSoft: ask for the material's inputs with
   * vtkBRDFShaderInputs::SoftLights.
   */
  virtual bool UsesSoftLights() { return false; }

  /**
   * Whether it can't do without an environment (default). One that has light of its own, a given
   * light set for instance, says no.
   */
  virtual bool NeedsEnvironment() { return true; }

  /**
   * When anything that Prepare depends on last changed. A rotation of the environment does not
   * count: everything is built in the environment's own frame.
   */
  virtual vtkMTimeType GetInputsMTime();

  /**
   * A new integrator of this class with the same properties, but for the material and the
   * environment. The caller has to release it.
   */
  VTK_NEWINSTANCE vtkRadianceIntegrator* NewCopy();

  ///@{
  /**
   * What programs and files call the method: lower case letters, digits and hyphens (default: the
   * class's name); and one line on it for a program's help.
   */
  virtual std::string GetMethodName();
  virtual std::string GetMethodDescription() { return ""; }
  ///@}

  /// One of the integers that set how accurate and how expensive a method is.
  struct Size
  {
    std::string Name; // "rows": for people
    int Least;
    int Largest;
    int Value;
    std::function<void(int)> Set; // takes a value in that range
  };

  ///@{
  /**
   * The sizes of this integrator, the most important one first (default: none). SetSizes takes
   * values in that order and leaves out the last ones where it is given fewer. It returns false
   * with an error event, nothing changed, where there are more than that or one is out of range.
   */
  virtual std::vector<Size> GetSizes() { return {}; }
  bool SetSizes(const std::vector<int>& values);
  ///@}

  /**
   * The sizes in words, for a plan: "33 rows x 12 view angles x 16 azimuths".
   */
  virtual std::string GetSizesText();

  ///@{
  /**
   * For planners (vtkRadiancePlanner). The material and the environment are set.
   *
   * GetCandidateSizes: the sizes to try, none (default) where the method is not for this material.
   * all: also those that are only worth a comparison.
   *
   * EstimateCost: what a pixel costs, times a pixel of a table of radiance, by its fetches and
   * arithmetic; default 1. Planners try what is cheap first.
   *
   * EstimateTextureBytes: of the textures, but for the material's own; default 0.
   */
  virtual std::vector<std::vector<int>> GetCandidateSizes(bool all);
  virtual double EstimateCost() { return 1.0; }
  virtual vtkIdType EstimateTextureBytes() { return 0; }
  ///@}

#ifndef __VTK_WRAP__
  /// What integrators of one material have in common, whatever the sizes and the light.
  class Precomputation;

  /**
   * Share it with other integrators of the same material while that does not change; null
   * (default): an integrator computes what it needs. For one thread at a time.
   */
  void SetPrecomputation(const std::shared_ptr<Precomputation>& shared) { this->Shared = shared; }
#endif

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

  /// Take the properties of another integrator of the same class. Those that are no sizes need an
  /// override, which calls the superclass's.
  virtual void CopyProperties(vtkRadianceIntegrator* source);

  /// Check and precompute before the threads start, called when inputs changed since the last
  /// success; false (after an error event) stops.
  virtual bool Begin() = 0;

  ///@{
  /// For Begin: whether there is light, and whether the material is isotropic, as methods that are
  /// described by `what` need it. An error event where it is not so.
  bool HasLight();
  bool IsIsotropic(const char* what);
  ///@}

  /// Raise ProgressEvent; returns whether to go on.
  bool Report(double progress);

  /// Add one pair's radiance: unit n and o (environment frame), t = unit tangent or zero, n.o > 0.
  /// Thread safe.
  virtual void IntegratePair(
    const double n[3], const double o[3], const double t[3], double radiance[3]) = 0;

  using SumGroups =
    std::function<void(const vtkDirectionPair* pairs, vtkIdType groups, double* sums)>;

  /// Integrate of groups of so many pairs, which sum adds to zeros, some groups at a time; method:
  /// what errors call it.
  bool IntegrateGroups(const char* method, vtkDataArray* normals, vtkDataArray* views,
    vtkDataArray* radiance, vtkDataArray* tangents, vtkIdType size, const SumGroups& sum);

  /// For integrators that are made of others: IntegratePair of a prepared one.
  static void AddTo(vtkRadianceIntegrator* integrator, const double n[3], const double o[3],
    const double t[3], double radiance[3])
  {
    integrator->IntegratePair(n, o, t, radiance);
  }

  /// For them, too: prepare one of the others. Its progress is this one's, and it stops where this
  /// one is told to.
  bool PrepareLayer(vtkRadianceIntegrator* layer);

  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkEnvironment> Environment;
  std::shared_ptr<Precomputation> Shared;
  vtkTimeStamp PrepareTime;
  std::atomic<bool> Abort{ false };

private:
  vtkRadianceIntegrator(const vtkRadianceIntegrator&) = delete;
  void operator=(const vtkRadianceIntegrator&) = delete;
};

#endif
