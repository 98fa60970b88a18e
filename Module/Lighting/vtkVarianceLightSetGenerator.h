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
 * The splits are made once for each environment and are valid for every number of lights: N + 1
 * lights differ from N by one split. A cell's light has the exact RGB sum of its texels as
 * irradiance, the direction P/|P|, and the concentration that follows from V/E. Cells without
 * energy give no light, and cells of one texel are not split, so small maps give fewer lights than
 * requested.
 *
 * Lights are in the environment's frame. A rotation of the environment rotates them and needs no
 * new tree.
 *
 * The tree takes next to no memory while it is made, because each cell's texels are summed anew.
 * Raises ProgressEvent (calldata: double*); SetAbort(true) stops it.
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

  bool Generate(vtkEnvironment* environment, int count, vtkLightSet* output) override;

  /**
   * Sum of V over E of the last generated set, in [0,1]; 0 before the first. The relative RMS error
   * of radiance from a half-vector lobe of exponent n is about 0.06 n times this (within a factor
   * of 2 until it exceeds some 0.3; conservative where one source dominates).
   */
  vtkGetMacro(ResidualVariance, double);

  /**
   * The least number of lights whose sum of V over E is at most target (>= 0), or the largest
   * number that can be made if none is enough. Returns 0 with an error event when environment is
   * empty, target is negative or NaN, or the run was aborted.
   */
  int GetNumberOfLightsForVariance(vtkEnvironment* environment, double target);

  ///@{
  /**
   * Set this from an observer or another thread to stop a running call. The call then fails with an
   * error event and leaves its output unchanged. Each call clears it first.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

protected:
  vtkVarianceLightSetGenerator();
  ~vtkVarianceLightSetGenerator() override;

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
