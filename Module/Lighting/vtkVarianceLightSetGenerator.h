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
 * N + 1 lights differ from N by one split. A cell's light has the exact RGB sum of its texels as
 * irradiance, the direction P/|P|, and the concentration that follows from V/E. Cells without
 * energy give no light, and cells of one texel are not split, so small maps give fewer lights than
 * requested.
 *
 * The sum of V over E is the relative RMS error of radiance from a half-vector lobe of exponent n
 * over 0.06 n, about (within a factor of 2 until that exceeds some 0.3; conservative where one
 * source dominates). The tree takes next to no memory while it is made, because each cell's texels
 * are summed anew.
 */

#ifndef vtkVarianceLightSetGenerator_h
#define vtkVarianceLightSetGenerator_h

#include "vtkLightSetGenerator.h"

class VTKMEASUREDBRDF_EXPORT vtkVarianceLightSetGenerator : public vtkLightSetGenerator
{
public:
  static vtkVarianceLightSetGenerator* New();
  vtkTypeMacro(vtkVarianceLightSetGenerator, vtkLightSetGenerator);

  bool Generate(vtkEnvironment* environment, int count, vtkLightSet* output) override;

protected:
  vtkVarianceLightSetGenerator() = default;
  ~vtkVarianceLightSetGenerator() override = default;

private:
  vtkVarianceLightSetGenerator(const vtkVarianceLightSetGenerator&) = delete;
  void operator=(const vtkVarianceLightSetGenerator&) = delete;
};

#endif
