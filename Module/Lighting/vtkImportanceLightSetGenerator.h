// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkImportanceLightSetGenerator
 * @brief   importance sampling: N texels drawn with probability proportional to their energy
 *
 * Thesis 3.2.2 (Agarwal et al. 2003; Pharr and Humphreys 2004). Marginal/conditional CDFs over
 * luminance x solid angle; the row number is stratified ((k + xi)/N, jittered), the column and the
 * place inside the texel use the remainders and a shifted radical inverse. Every light has the
 * luminance total/N and the color of its texel. Its solid angle is the share of the texel's that
 * it represents (irradiance / radiance). The same seed gives the same lights on every machine.
 */

#ifndef vtkImportanceLightSetGenerator_h
#define vtkImportanceLightSetGenerator_h

#include "vtkLightSetGenerator.h"

class VTKMEASUREDBRDF_EXPORT vtkImportanceLightSetGenerator : public vtkLightSetGenerator
{
public:
  static vtkImportanceLightSetGenerator* New();
  vtkTypeMacro(vtkImportanceLightSetGenerator, vtkLightSetGenerator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Seed of the random numbers; default 1.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  bool Generate(vtkEnvironment* environment, int count, vtkLightSet* output) override;

protected:
  vtkImportanceLightSetGenerator() = default;
  ~vtkImportanceLightSetGenerator() override = default;

  unsigned int Seed = 1;

private:
  vtkImportanceLightSetGenerator(const vtkImportanceLightSetGenerator&) = delete;
  void operator=(const vtkImportanceLightSetGenerator&) = delete;
};

#endif
