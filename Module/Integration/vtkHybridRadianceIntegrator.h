// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridRadianceIntegrator
 * @brief   lights for bright sources, a table for the rest, with maps of its sharp part
 *
 * Each method where it is best:
 *
 * - the few texels that outweigh the environment (ExtractedEmitters: suns, lamps) are evaluated as
 *   directional lights, exactly; what is left varies far less over the directions. More than two
 *   lights on an isotropic material are evaluated near the lobe's axis only; what they show
 *   elsewhere is smooth and goes into the table;
 * - what is left is the business of a vtkTableRadianceIntegrator: a table, or, where the material
 *   reflects it too sharply for few rows, a small one and maps of many rows (NumberOfMaps > 0).
 *
 * Lights are shaded with the material's own GLSL. Where an isotropic material has none
 * (vtkBRDF::IsRenderable), or its lobe is about as narrow as the lamps and sees them as areas, they
 * are shaded with its mean over a lamp, from a table of 0.8 MB that takes both sides of the plane
 * of incidence for alike. Anisotropic materials without GLSL are resampled
 * (vtkBRDF::GetRenderable). Maps are for isotropic materials only.
 */

#ifndef vtkHybridRadianceIntegrator_h
#define vtkHybridRadianceIntegrator_h

#include "vtkEnvironment.h" // for what lights leave of it
#include "vtkRadianceIntegrator.h"

#include <memory> // for Internals
#include <string> // for Given

class vtkBRDF;
class vtkLightSet;
class vtkTableRadianceIntegrator;

class VTKMEASUREDBRDF_EXPORT vtkHybridRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkHybridRadianceIntegrator* New();
  vtkTypeMacro(vtkHybridRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The table's sizes, as vtkTableRadianceIntegrator has them (default 33 x 12 x 16). With maps,
   * the rows are those of the maps (512 at most); the small table then has 33 rows at most. For
   * anisotropic materials the view has as many azimuths as angles (32 at most).
   */
  virtual void SetNumberOfRows(int numberOfRows);
  vtkGetMacro(NumberOfRows, int);
  virtual void SetNumberOfViewAngles(int numberOfViewAngles);
  vtkGetMacro(NumberOfViewAngles, int);
  virtual void SetNumberOfAzimuths(int numberOfAzimuths);
  vtkGetMacro(NumberOfAzimuths, int);
  ///@}

  ///@{
  /**
   * Maps of the sharp part (vtkTableRadianceIntegrator::SetNumberOfMaps), default 0: the table
   * takes all. Clamped to [0, 32].
   */
  virtual void SetNumberOfMaps(int numberOfMaps);
  vtkGetMacro(NumberOfMaps, int);
  ///@}

  ///@{
  /**
   * Lights taken out of the environment at most, the brightest first; default 16, clamped to
   * [0, 1024].
   */
  virtual void SetMaximumNumberOfLights(int maximumNumberOfLights);
  vtkGetMacro(MaximumNumberOfLights, int);
  ///@}

  ///@{
  /**
   * Texels within this angle of a light's brightest one, in degrees, are part of it: a sun or a
   * lamp of several texels. Default 1.2, clamped to [0, 30]; 0: each is a light. What they add up
   * to comes from their mean direction, which is as good as all of them where lobes are wider.
   */
  virtual void SetLightAngle(double lightAngle);
  vtkGetMacro(LightAngle, double);
  ///@}

  ///@{
  /**
   * Whether the table is prepared quickly (vtkTableRadianceIntegrator::SetQuick). Without effect on
   * maps and for anisotropic materials. Default off.
   */
  vtkSetMacro(Quick, bool);
  vtkGetMacro(Quick, bool);
  vtkBooleanMacro(Quick, bool);
  ///@}

  /**
   * Lights that the last preparation made.
   */
  int GetNumberOfLights();

  /**
   * True if so many lights are evaluated near the lobe's axis only. The table then holds the rest
   * of what they reflect, their Lambert part included. Not of anisotropic materials, nor of those
   * whose f a table cannot hold there: noise from cell to cell, no symmetry.
   */
  static bool AreWindowed(vtkBRDF* brdf, int lights);

  ///@{
  /**
   * As a method: "hybrid", by the table's sizes, maps, lights and the light angle in tenths of a
   * degree. Its cost counts the lights that the environment has.
   */
  std::string GetMethodName() override { return "hybrid"; }
  std::string GetMethodDescription() override;
  std::vector<Size> GetSizes() override;
  std::string GetSizesText() override;
  std::vector<std::vector<int>> GetCandidateSizes(bool all) override;
  double EstimateCost() override;
  vtkIdType EstimateTextureBytes() override;
  ///@}

  bool GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  bool UsesBRDFOnGPU() override;

protected:
  vtkHybridRadianceIntegrator();
  ~vtkHybridRadianceIntegrator() override;

  void CopyProperties(vtkRadianceIntegrator* source) override;
  /// Fails for anisotropic materials with maps.
  bool Begin() override;
  void IntegratePair(
    const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  int NumberOfRows = 33;
  int NumberOfViewAngles = 12;
  int NumberOfAzimuths = 16;
  int NumberOfMaps = 0;
  int MaximumNumberOfLights = 16;
  double LightAngle = 1.2;
  bool Quick = false;

private:
  vtkHybridRadianceIntegrator(const vtkHybridRadianceIntegrator&) = delete;
  void operator=(const vtkHybridRadianceIntegrator&) = delete;

  int CountLights(double angle, int maximum);
  bool IsWindowed(int lights); // evaluated near the lobe's axis only
  double ChooseLightAngle();

  vtkSmartPointer<vtkTableRadianceIntegrator> NewBroad(
    const std::shared_ptr<const vtkEnvironment::TexelChanges>& rest = nullptr,
    vtkLightSet* lamps = nullptr, vtkBRDF* lampForm = nullptr);
  double FindLampSpread(const std::shared_ptr<Precomputation>& parts);

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
