// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFilteredRadianceIntegrator
 * @brief   filtered importance sampling: few samples of the reflection, each of a blurred
 * environment
 *
 * A fixed low-discrepancy set of N samples from the material's own distribution (one that misses a
 * lobe is mixed with the cosine, balance heuristic: Veach, Guibas 1995); each reads the environment
 * at the resolution at which a texel's solid angle is the sample's, 1/(N pdf) (Colbert, Krivanek,
 * GPU Gems 3, ch. 20). No noise, no light count; best for glossy lobes, which the light loop draws
 * as dots. Directions, levels and weights are tabulated by the view's polar angle, so that any
 * isotropic material can be drawn, without its own GLSL and without being resampled.
 *
 * What is not exact: the environment's blur (it is as wide as the samples' spacing, also beyond a
 * sharp edge of the lobe; round, where lobes are stretched at grazing views); the weights, scaled
 * per view and channel so that under a constant sky the result is the directional albedo (a ratio
 * estimator: bias of order 1/N); the interpolation between 64 views and the map's resolution, at
 * most 1024 x 1024 texels of equal area. All but the last two vanish as N grows. The samples turn
 * with the view's azimuth: where the view comes along the normal, too few of them show as rays
 * about that point. Texels much brighter than the rest (a sun) are taken out and added as
 * directional lights. Views closer to the horizon than 1.1 degrees are taken there, as the shader
 * takes them.
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
   * Samples per pair, default 32, clamped to [1, 1024]. Costs are proportional to it.
   */
  virtual void SetNumberOfSamples(int numberOfSamples);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * Added to every sample's level: +1 reads the environment twice as coarse as the samples' spacing
   * asks for. Default 0, clamped to [-4, 4].
   */
  virtual void SetLevelBias(double levelBias);
  vtkGetMacro(LevelBias, double);
  ///@}

  ///@{
  /**
   * Whether texels that hold more than 0.2 % of the environment's luminance, and much more than
   * their like, are taken out and added as directional lights (up to 64, default on). Off, what
   * they show is blurred as everything else; the material's own GLSL is then not needed.
   */
  vtkSetMacro(ExtractLights, bool);
  vtkGetMacro(ExtractLights, bool);
  vtkBooleanMacro(ExtractLights, bool);
  ///@}

  /**
   * How many lights were taken out by the last preparation; 0 before.
   */
  int GetNumberOfExtractedLights();

  /**
   * Two bilinear reads of the environment and two of the tables per sample; the extracted lights as
   * vtkLightSetRadianceIntegrator draws them.
   */
  bool GetShaderInputs(vtkBRDFShaderInputs& form) override;
  bool UsesBRDFOnGPU() override { return this->GetNumberOfExtractedLights() > 0; }

  ///@{
  /**
   * As a method: "filtered", by the number of samples; planners try it for comparison only. Its
   * cost counts the lights that the last preparation took out, too.
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

  void SetSize(int index, int value) override;
  void CopyProperties(vtkRadianceIntegrator* source) override;
  /// Fails for anisotropic materials.
  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  int NumberOfSamples = 32;
  double LevelBias = 0.0;
  bool ExtractLights = true;

private:
  vtkFilteredRadianceIntegrator(const vtkFilteredRadianceIntegrator&) = delete;
  void operator=(const vtkFilteredRadianceIntegrator&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
