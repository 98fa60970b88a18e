// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLightSetGenerator
 * @brief   makes a light set from an environment
 *
 * MEDIAN_CUT (Debevec 2005, "A Median Cut Algorithm for Light Probe Sampling"; thesis 3.2.3): 2^k
 * regions of equal energy, one light each. Every region is split across its longer side (the
 * horizontal extent weighted by the cosine of the middle row's latitude) into halves of nearly
 * equal luminance energy (exact solid angles), k times.
 *
 * VARIANCE: any number of lights. A cell's variance V = E - |P|^2/E is its luminance energy times
 * the mean squared distance of its directions to their centroid (E: sum of luminance x solid angle,
 * P: the same sum of directions). With a light at every cell's centroid the error of a smooth
 * integrand g is at most 1/2 sup|g''| sum V. Splitting the cell of largest V, along either axis at
 * the cut that leaves the least V1 + V2, brings that sum down greedily; N + 1 lights differ from N
 * by one split. The sum of V over E is the relative RMS error of radiance from a half-vector lobe
 * of exponent n over 0.06 n, about (within a factor of 2 until that exceeds some 0.3; conservative
 * where one source dominates).
 *
 * A light of these two has the exact RGB sum of its texels as irradiance, and the centroid of their
 * *directions* (those of image coordinates fail at the seam and the poles). The variance gives its
 * concentration. A cell of one texel is not split, and one without energy gives no light, so small
 * maps and single bright texels give fewer lights than requested.
 *
 * IMPORTANCE (thesis 3.2.2; Agarwal et al. 2003; Pharr and Humphreys 2004): N texels drawn with
 * probability proportional to their energy, by marginal and conditional CDFs over luminance x solid
 * angle. The row number is stratified ((k + xi)/N, jittered), the column and the place inside the
 * texel use the remainders and a shifted radical inverse. Every light has the luminance total/N and
 * the color of its texel. Its solid angle is the share of the texel's that it represents
 * (irradiance / radiance). The same seed gives the same lights on every machine.
 */

#ifndef vtkLightSetGenerator_h
#define vtkLightSetGenerator_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

class vtkEnvironment;
class vtkLightSet;

class VTKMEASUREDBRDF_EXPORT vtkLightSetGenerator : public vtkObject
{
public:
  static vtkLightSetGenerator* New();
  vtkTypeMacro(vtkLightSetGenerator, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    MEDIAN_CUT = 0,
    VARIANCE = 1,
    IMPORTANCE = 2
  };

  ///@{
  /**
   * How the lights are found; MEDIAN_CUT by default.
   */
  virtual void SetMethod(int method);
  vtkGetMacro(Method, int);
  void SetMethodToMedianCut() { this->SetMethod(MEDIAN_CUT); }
  void SetMethodToVariance() { this->SetMethod(VARIANCE); }
  void SetMethodToImportance() { this->SetMethod(IMPORTANCE); }
  ///@}

  ///@{
  /**
   * Seed of IMPORTANCE's random numbers; default 1.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  /**
   * Largest number of lights that can be requested.
   */
  static constexpr int MaximumNumberOfLights = 1 << 20;

  /**
   * Replace output's lights by about `count` lights that represent the environment (without its
   * rotation: in its own frame). Their luminance adds up to the environment's. An all-black
   * environment gives no lights. Returns false with an error event and leaves output unchanged when
   * environment is empty, when count is not in [1, MaximumNumberOfLights], or when it is no power
   * of two and the method is MEDIAN_CUT. A generator of your own overrides this.
   */
  virtual bool Generate(vtkEnvironment* environment, int count, vtkLightSet* output);

protected:
  vtkLightSetGenerator() = default;
  ~vtkLightSetGenerator() override = default;

  int Method = MEDIAN_CUT;
  unsigned int Seed = 1;

private:
  vtkLightSetGenerator(const vtkLightSetGenerator&) = delete;
  void operator=(const vtkLightSetGenerator&) = delete;
};

#endif
