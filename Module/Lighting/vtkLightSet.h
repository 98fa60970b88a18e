// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLightSet
 * @brief   directional lights that represent an environment
 *
 * Each light has a unit direction towards it (environment frame), an irradiance RGB on a surface
 * that faces it (radiance x solid angle), the solid angle that it represents in sr, a
 * concentration, and optionally the region of texels from which it was made.
 *
 * The concentration kappa says how widely the light of that region is spread: as a von Mises-Fisher
 * distribution exp(kappa (cos - 1)) about the direction, about 1/sqrt(kappa) radians wide. 0 means
 * that the spread is not known: all light comes from the direction itself (Dirac). Only integrators
 * with soft lights use it.
 */

#ifndef vtkLightSet_h
#define vtkLightSet_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

#include <vector> // for lights

class VTKMEASUREDBRDF_EXPORT vtkLightSet : public vtkObject
{
public:
  static vtkLightSet* New();
  vtkTypeMacro(vtkLightSet, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Remove and add lights. Directions are normalized. AddLight returns false and leaves the set
   * unchanged if the direction is zero or not finite, the irradiance negative or not finite, or the
   * concentration negative or NaN. An infinite concentration counts as 0: a Dirac light.
   */
  void RemoveAllLights();
  bool AddLight(const double direction[3], const double irradiance[3], double solidAngle = 0.0,
    double concentration = 0.0);
  ///@}

  ///@{
  /**
   * Read the lights. The index is in [0, GetNumberOfLights()); other indices give zeros.
   */
  int GetNumberOfLights();
  void GetDirection(int index, double direction[3]);
  void GetIrradiance(int index, double irradiance[3]);
  double GetSolidAngle(int index);
  double GetConcentration(int index);
  ///@}

  /**
   * Concentration of light whose directions have the variance v = (mean of |direction -
   * centroid|^2), in [0,1]: kappa = r (3 - r^2)/(1 - r^2) with the centroid's length r = sqrt(1 -
   * v) (Banerjee et al. 2005). 0 (Dirac) for v <= 0; at least 0.003.
   */
  static double GetConcentrationOfVariance(double v);

  /**
   * Sum of the irradiances, RGB.
   */
  void GetTotal(double rgb[3]);

  ///@{
  /**
   * Texels [x0,x1) x [y0,y1) of the light that was added last, row 0 at the bottom, in the map that
   * was divided into lights (vtkEnvironment::GetSubdivided). GetRegion returns false for a light
   * without a region.
   */
  void SetLastRegion(int x0, int y0, int x1, int y1);
  bool GetRegion(int index, int region[4]);
  ///@}

protected:
  vtkLightSet() = default;
  ~vtkLightSet() override = default;

  struct Light
  {
    double Direction[3];
    double Irradiance[3];
    double SolidAngle;
    double Concentration;
    int Region[4]; // x0 == x1: none
  };
  const Light& GetLight(int index) const;
  std::vector<Light> Lights;

private:
  vtkLightSet(const vtkLightSet&) = delete;
  void operator=(const vtkLightSet&) = delete;
};

#endif
