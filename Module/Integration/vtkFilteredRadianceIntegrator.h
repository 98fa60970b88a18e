// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFilteredRadianceIntegrator
 * @brief   filtered importance sampling: few samples of the reflection, each of a blurred
 * environment, and as many lights
 *
 * The reflection is the sum of two parts. With p the density of f cos in its own integral, the
 * share p^2 / (p^2 + (1/sr)^2) is sharp: the power heuristic of multiple importance sampling
 * (Veach, Guibas 1995), with lights in place of the second kind of samples.
 *
 * The sharp part is seen by a fixed low-discrepancy set of N samples; each reads the environment at
 * the resolution at which a texel's solid angle is the sample's, 1/(N pdf) (Colbert, Krivanek, GPU
 * Gems 3, ch. 20). Directions, levels and weights are tabulated by the view's polar angle. The
 * broad part is a sum over N lights (vtkLightSetGenerator, by variance), each evaluated with the
 * material: samples of a broad lobe miss small panels, lights do not. Texels much brighter than the
 * rest (a sun) are taken out first and added as directional lights.
 *
 * Not exact are the environment's blur, which is round and as wide as the samples' spacing, and the
 * lights' directions, both less so as N grows; the interpolation between 128 views; and the map's
 * resolution, at most 1024 x 1024 texels of equal area. Views closer to the horizon than 1.1
 * degrees are taken there, as the shader takes them.
 */

#ifndef vtkFilteredRadianceIntegrator_h
#define vtkFilteredRadianceIntegrator_h

#include "vtkRadianceIntegrator.h"

#include <memory> // for Internals

class VTKMEASUREDBRDF_EXPORT vtkFilteredRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkFilteredRadianceIntegrator* New();
  vtkTypeMacro(vtkFilteredRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Samples per pair, and lights, default 32, clamped to [1, 1024]. Costs are proportional to it.
   */
  virtual void SetNumberOfSamples(int numberOfSamples);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  /**
   * How many texels were taken out by the last preparation: each held more than 0.2 % of the
   * environment's luminance, and much more than its like. At most 64; 0 before.
   */
  int GetNumberOfExtractedLights();

  /**
   * Two bilinear reads of the environment, two of the tables and a light per sample; the extracted
   * lights as vtkLightSetRadianceIntegrator draws them.
   */
  bool GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  bool UsesBRDFOnGPU() override { return true; }

  ///@{
  /**
   * As a method: "filtered", by the number of samples, for isotropic materials; the top of a
   * planner's ladder. Its cost counts the lights that the last preparation took out, too.
   */
  std::string GetMethodName() override { return "filtered"; }
  std::string GetMethodDescription() override;
  std::vector<Size> GetSizes() override;
  std::vector<std::vector<int>> GetCandidateSizes(bool all) override;
  double EstimateCost() override;
  vtkIdType EstimateTextureBytes() override;
  ///@}

protected:
  vtkFilteredRadianceIntegrator();
  ~vtkFilteredRadianceIntegrator() override;

  /// Fails for anisotropic materials.
  bool Begin() override;
  void IntegratePair(
    const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  int NumberOfSamples = 32;

private:
  vtkFilteredRadianceIntegrator(const vtkFilteredRadianceIntegrator&) = delete;
  void operator=(const vtkFilteredRadianceIntegrator&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
