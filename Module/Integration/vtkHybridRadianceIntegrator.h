// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHybridRadianceIntegrator
 * @brief   explicit lights for bright sources, a table for broad reflection, samples for highlights
 *
 * Each method where it is best:
 *
 * - the few texels that outweigh the environment (ExtractedEmitters: suns, lamps) are evaluated as
 *   directional lights, exactly; what is left varies far less over the directions;
 * - the material's kernel f cos(theta_i) is cut, per view, at the height at which all its energy
 *   would fill the solid angle that the table's rows resolve (36 squares of their spacing). What is
 *   below is the business of a vtkTableRadianceIntegrator of few rows;
 * - what is above, a narrow lobe, is left to few samples of the filtered environment
 *   (vtkFilteredRadianceIntegrator). With NumberOfSamples = 0, or where the material has no such
 *   part, the table takes all.
 *
 * Lights are shaded with vtkBRDF::GetRenderable(), what the graphics card evaluates: materials that
 * have no GLSL of their own are resampled for that. Isotropic materials only.
 */

#ifndef vtkHybridRadianceIntegrator_h
#define vtkHybridRadianceIntegrator_h

#include "vtkEnvironment.h" // for what lights leave of it
#include "vtkRadianceIntegrator.h"

#include <memory> // for Internals
#include <string> // for Given

class vtkTableRadianceIntegrator;

class VTKMEASUREDBRDF_EXPORT vtkHybridRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkHybridRadianceIntegrator* New();
  vtkTypeMacro(vtkHybridRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The table's sizes, as vtkTableRadianceIntegrator has them (default 33 x 12 x 16).
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
   * Samples of the sharp layer, default 8, clamped to [0, 1024]; 0: no such layer.
   */
  virtual void SetNumberOfSamples(int numberOfSamples);
  vtkGetMacro(NumberOfSamples, int);
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
   * What the last preparation made of it: lights, and whether there is a sharp layer.
   */
  int GetNumberOfLights();
  bool GetHasSharpLayer();
  ///@}

  ///@{
  /**
   * As a method: "hybrid", by the table's sizes, samples, lights and the light angle in tenths of a
   * degree. Its cost is BASE, TABLE, a SAMPLE each and a LIGHT for each light that the environment
   * has.
   */
  std::string GetMethodName() override { return "hybrid"; }
  std::string GetMethodDescription() override;
  std::vector<Size> GetSizes() override;
  std::string GetSizesText() override;
  std::vector<std::vector<int>> GetCandidateSizes(bool all) override;
  double EstimateCost(vtkRadianceCostModel* costs) override;
  vtkIdType EstimateTextureBytes() override;
  bool IsLastResort() override { return this->NumberOfSamples > 0; }
  bool CanPrune(const std::vector<Attempt>& attempts, double error) override;
  ///@}

  ///@{
  /**
   * The table's bytes ("" before Prepare), and back: its making takes longest. TakePrepared also
   * fails where the rest can't be prepared (an error event says why).
   */
  std::string GetPrepared() override;
  bool TakePrepared(const std::string& bytes) override;
  ///@}

  bool GetShaderInputs(vtkBRDFShaderInputs& form) override;
  bool UsesBRDFOnGPU() override { return this->GetNumberOfLights() > 0; }

protected:
  vtkHybridRadianceIntegrator();
  ~vtkHybridRadianceIntegrator() override;

  void SetSize(int index, int value) override;
  void CopyProperties(vtkRadianceIntegrator* source) override;
  /// Fails for anisotropic materials.
  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  int NumberOfRows = 33;
  int NumberOfViewAngles = 12;
  int NumberOfAzimuths = 16;
  int NumberOfSamples = 8;
  int MaximumNumberOfLights = 16;
  double LightAngle = 1.2;

private:
  vtkHybridRadianceIntegrator(const vtkHybridRadianceIntegrator&) = delete;
  void operator=(const vtkHybridRadianceIntegrator&) = delete;

  int CountLights(double angle, int maximum);
  double ChooseLightAngle();

  struct Internals;
  void MakeLayers(Precomputation& parts,
    const std::shared_ptr<const vtkEnvironment::TexelChanges>& rest, Internals& made);
  bool PrepareBroad(vtkTableRadianceIntegrator* broad);

  std::unique_ptr<Internals> Impl;
  const std::string* Given = nullptr; // TakePrepared's bytes while it prepares
};

#endif
