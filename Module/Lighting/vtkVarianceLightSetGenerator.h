// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVarianceLightSetGenerator
 * @brief   any number of lights, each for a cell of little spread in direction
 *
 * A cell's variance V = E - |P|^2/E is its luminance energy times the mean squared distance of its
 * directions to their centroid (E: sum of luminance x solid angle, P: the same sum of directions).
 * With a light at every cell's centroid the error of a smooth integrand g is at most 1/2 sup|g''|
 * sum V. Splitting the cell of largest V, along either axis at the cut that leaves the least V1 +
 * V2, brings that sum down greedily.
 *
 * MINIMUM_VARIANCE is Viriyothai and Debevec 2009 ("Variance Minimization Light Probe Sampling"),
 * for comparison: level by level, every cell across its longer side, at the cut whose larger V is
 * least. Between powers of two it takes a part of the next level.
 *
 * The splits are made once for each environment and serve every number of lights: N + 1 lights
 * differ from N by one split. A cell's light has the exact RGB sum of its texels as irradiance, the
 * direction P/|P|, and the concentration that follows from V/E. Cells without energy give no light,
 * cells of one texel are not split: small maps give fewer lights than asked for.
 *
 * Lights live in the environment's frame; turning it turns them and changes nothing here.
 *
 * Making the tree takes no memory to speak of: each cell's texels are summed anew. ProgressEvent
 * (calldata: double*), interrupted by SetAbort(true).
 */

#ifndef vtkVarianceLightSetGenerator_h
#define vtkVarianceLightSetGenerator_h

#include "vtkLightSetGenerator.h"

#include <atomic> // for Abort
#include <memory> // for Internals

class VTKMEASUREDBRDF_EXPORT vtkVarianceLightSetGenerator : public vtkLightSetGenerator
{
public:
  static vtkVarianceLightSetGenerator* New();
  vtkTypeMacro(vtkVarianceLightSetGenerator, vtkLightSetGenerator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    GREEDY = 0,
    MINIMUM_VARIANCE = 1
  };

  ///@{
  /**
   * How cells are split; default greedy.
   */
  virtual void SetMethod(int method);
  vtkGetMacro(Method, int);
  void SetMethodToGreedy() { this->SetMethod(GREEDY); }
  void SetMethodToMinimumVariance() { this->SetMethod(MINIMUM_VARIANCE); }
  ///@}

  ///@{
  /**
   * Whether the greedy method makes up to four outstandingly bright texels (100 times the mean
   * radiance, 5 % of the energy) lights of their own before it cuts the rest. Default off: the cuts
   * find them by themselves where that pays. Measured with 64 lights on four maps with a sun or
   * lamps: lobes of exponent 500 gained a quarter in RMS under two low suns, nothing else did.
   */
  vtkSetMacro(ExtractedEmitters, bool);
  vtkGetMacro(ExtractedEmitters, bool);
  vtkBooleanMacro(ExtractedEmitters, bool);
  ///@}

  ///@{
  /**
   * For how many lights the tree is made at first; it grows when more are asked for. Default 1024,
   * in [1, MaximumNumberOfLights].
   */
  virtual void SetTreeSize(int treeSize);
  vtkGetMacro(TreeSize, int);
  ///@}

  bool Generate(vtkEnvironment* environment, int count, vtkLightSet* output) override;

  /**
   * Sum of V over E of the last generated set, in [0,1]; 0 before the first. The relative RMS error
   * of radiance from a half-vector lobe of exponent n is about 0.06 n times this (within a factor
   * of 2 until it exceeds some 0.3; conservative where one source dominates).
   */
  vtkGetMacro(ResidualVariance, double);

  /**
   * The least number of lights whose sum of V over E is at most target (>= 0); the largest that can
   * be made where none is enough. 0 with an error event when environment is empty, target is
   * negative or NaN, or the run was aborted.
   */
  int GetNumberOfLightsForVariance(vtkEnvironment* environment, double target);

  ///@{
  /**
   * Set from an observer or another thread to stop a running call, which then fails with an error
   * event, its output unchanged. Each call starts with it cleared.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

protected:
  vtkVarianceLightSetGenerator();
  ~vtkVarianceLightSetGenerator() override;

  int Method = GREEDY;
  bool ExtractedEmitters = false;
  int TreeSize = 1024;
  double ResidualVariance = 0.0;
  std::atomic<bool> Abort{ false };

private:
  vtkVarianceLightSetGenerator(const vtkVarianceLightSetGenerator&) = delete;
  void operator=(const vtkVarianceLightSetGenerator&) = delete;

  bool Grow(vtkEnvironment* environment, int count);

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
