// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMedianCutLightSetGenerator
 * @brief   Debevec's median cut: 2^k regions of equal energy, one light each
 *
 * Debevec 2005, "A Median Cut Algorithm for Light Probe Sampling" (thesis 3.2.3). Every region is
 * split across its longer side (the horizontal extent weighted by the cosine of the middle row's
 * latitude) into halves of nearly equal luminance energy (exact solid angles), k times. A light's
 * irradiance is the sum over its region, its direction the energy centroid of the texels'
 * *directions* (not of their image coordinates: those fail at the seam and the poles).
 *
 * The count must be a power of two. A region of one texel is not split further, so small images
 * and single bright texels give fewer lights; a region without energy gives no light.
 */

#ifndef vtkMedianCutLightSetGenerator_h
#define vtkMedianCutLightSetGenerator_h

#include "vtkLightSetGenerator.h"

class VTKMEASUREDBRDF_EXPORT vtkMedianCutLightSetGenerator : public vtkLightSetGenerator
{
public:
  static vtkMedianCutLightSetGenerator* New();
  vtkTypeMacro(vtkMedianCutLightSetGenerator, vtkLightSetGenerator);

  bool Generate(vtkEnvironment* environment, int count, vtkLightSet* output) override;

protected:
  vtkMedianCutLightSetGenerator() = default;
  ~vtkMedianCutLightSetGenerator() override = default;

private:
  vtkMedianCutLightSetGenerator(const vtkMedianCutLightSetGenerator&) = delete;
  void operator=(const vtkMedianCutLightSetGenerator&) = delete;
};

#endif
