// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTableRadianceIntegrator
 * @brief   outgoing radiance, integrated ahead of time into a table: a few fetches a pixel
 *
 * For an isotropic BRDF under a distant environment, radiance depends on the normal and the view
 * alone. For each polar angle theta_o of the view the kernel f cos(theta_i) is split into a Lambert
 * part, c(theta_o) cos(theta_i), and the rest, which is seen about its own mean direction: near the
 * mirror direction for gloss, near the normal for felt. With D that direction in the world, psi the
 * azimuth of the plane of incidence about it, and E the irradiance,
 *
 *   L_o = c(theta_o) E(n) + s(theta_o) T(D, theta_o, psi)
 *
 * s is near 1 and keeps the directional albedo exact. T is a 3D texture, which two trilinear
 * fetches interpolate in all four quantities. It is a convolution over the rotation group
 * (Kostelec, Rockmore 2008; Ramamoorthi, Hanrahan 2002). docs/methods/tables.md has the formulas,
 * the cost and the errors.
 *
 * **Anisotropic materials**: T has the view's azimuth as a fifth quantity, and psi is the azimuth
 * of the tangent. Four trilinear fetches interpolate it.
 *
 * **Maps** (isotropic materials): the sharp part of a mirror-like lobe depends on theta_o and psi
 * in few ways. A small table then has what a blur leaves of the kernels, and maps A_k and B_k over
 * D have what it lacks (docs/methods/factored.md):
 *
 *   sum over k of W_k(theta_o) (cos(m_k psi) A_k(D) + sin(m_k psi) B_k(D))
 *
 * This is the pair of textures of O'Toole 2007, coefficients and functions, with the light in one
 * of them. Each map costs a bilinear fetch.
 *
 * Of an isotropic BRDF that is not symmetric about the plane of incidence the mean of both sides is
 * integrated. Views closer to the horizon than 1.1 degrees are taken there.
 */

#ifndef vtkTableRadianceIntegrator_h
#define vtkTableRadianceIntegrator_h

#include "vtkEnvironment.h" // for SetLight
#include "vtkRadianceIntegrator.h"

#include <memory> // for tables
#include <string> // for bytes
#include <vector> // for tables

class vtkLightSet;

class VTKMEASUREDBRDF_EXPORT vtkTableRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkTableRadianceIntegrator* New();
  vtkTypeMacro(vtkTableRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Rows of the map over D from pole to pole (default 65, in [9, 513]; twice as many columns less
   * two; more than 113 are those of tiles where radiance bends most, and a quarter of them
   * everywhere: the next multiple of 4 MB in all; anisotropic materials have at most 113), view
   * angles (default 16, in [2, 64], of anisotropic materials at most 32), azimuths psi (default 16,
   * in [4, 64]), and azimuths of the view over the period of f, for anisotropic materials only
   * (default 8, in [2, 32]).
   */
  virtual void SetNumberOfRows(int numberOfRows);
  vtkGetMacro(NumberOfRows, int);
  virtual void SetNumberOfViewAngles(int numberOfViewAngles);
  vtkGetMacro(NumberOfViewAngles, int);
  virtual void SetNumberOfAzimuths(int numberOfAzimuths);
  vtkGetMacro(NumberOfAzimuths, int);
  virtual void SetNumberOfViewAzimuths(int numberOfViewAzimuths);
  vtkGetMacro(NumberOfViewAzimuths, int);
  ///@}

  ///@{
  /**
   * Maps of the sharp part at most (default 0, in [0, 32]; a mode takes one, or two where it
   * depends on the azimuth), and their rows (default 256, in [8, 512]; twice as many columns). The
   * table hands over to them about degree 4. The maps' values lie at cells' centers, as an
   * environment's do: with as many rows as the environment has, they show what a mirror shows.
   * Prepare fails where the material is anisotropic.
   */
  virtual void SetNumberOfMaps(int numberOfMaps);
  vtkGetMacro(NumberOfMaps, int);
  virtual void SetNumberOfMapRows(int numberOfMapRows);
  vtkGetMacro(NumberOfMapRows, int);
  ///@}

  ///@{
  /**
   * Nodes per angle of the integrals that make the kernels' harmonics (default 64, in [16, 1024]);
   * twice as many where there are tiles.
   */
  virtual void SetNumberOfNodes(int numberOfNodes);
  vtkGetMacro(NumberOfNodes, int);
  ///@}

  ///@{
  /**
   * Whether an isotropic material is sampled with a sixth of the evaluations: half of the nodes,
   * and coarser quadratures of fewer views. For a table that is wanted at once. Default off.
   */
  vtkSetMacro(Quick, bool);
  vtkGetMacro(Quick, bool);
  vtkBooleanMacro(Quick, bool);
  ///@}

  /**
   * How often f repeats itself while the sample is turned once about its normal: 1, or 2 as of
   * brushed metal. 0 before Prepare and of isotropic materials.
   */
  int GetNumberOfPeriods();

  bool GetShaderInputs(vtkBRDFShaderInputs& inputs) override;

  ///@{
  /**
   * As a method: "table", by rows, view angles, azimuths and the view's azimuths.
   */
  std::string GetMethodName() override { return "table"; }
  std::string GetMethodDescription() override { return "a precomputed table of outgoing radiance"; }
  std::vector<Size> GetSizes() override;
  std::string GetSizesText() override;
  std::vector<std::vector<int>> GetCandidateSizes(bool all) override;
  double EstimateCost() override;
  vtkIdType EstimateTextureBytes() override;
  ///@}

#ifndef __VTK_WRAP__
  /// For hybrids: take the environment with these texels changed; null (default): as it is.
  ///
  /// lamps: lights that together are what it lacks then. Pixels add what they see of them within a
  /// window about the lobe's axis; the table holds what lies outside of it. Null (default): there
  /// are none. renderable: what they are evaluated with; null: GetRenderable().
  void SetLight(const std::shared_ptr<const vtkEnvironment::TexelChanges>& rest,
    vtkLightSet* lamps = nullptr, vtkBRDF* renderable = nullptr);
#endif

  bool UsesBRDFOnGPU() override;

protected:
  vtkTableRadianceIntegrator();
  ~vtkTableRadianceIntegrator() override;

  void CopyProperties(vtkRadianceIntegrator* source) override;
  bool Begin() override;
  void IntegratePair(
    const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  int NumberOfRows = 65;
  int NumberOfViewAngles = 16;
  int NumberOfAzimuths = 16;
  int NumberOfViewAzimuths = 8;
  int NumberOfMaps = 0;
  int NumberOfMapRows = 256;
  int NumberOfNodes = 64;
  bool Quick = false;

private:
  vtkTableRadianceIntegrator(const vtkTableRadianceIntegrator&) = delete;
  void operator=(const vtkTableRadianceIntegrator&) = delete;

  struct Tables;
  bool IsTurned() const; // whether the material is anisotropic
  bool MakeTable(Precomputation& parts, Tables& made);
  bool MakeMaps(Precomputation& parts, Tables& made);

  std::shared_ptr<const vtkEnvironment::TexelChanges> Rest;
  vtkSmartPointer<vtkLightSet> Lamps;
  vtkSmartPointer<vtkBRDF> LampForm;
  std::unique_ptr<Tables> Data;
};

#endif
