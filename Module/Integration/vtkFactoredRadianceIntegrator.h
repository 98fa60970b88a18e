// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFactoredRadianceIntegrator
 * @brief   outgoing radiance of sharp lobes: a small table and a few maps with weights
 *
 * A table of radiance (vtkTableRadianceIntegrator) that does justice to a mirror-like lobe takes
 * tens of megabytes: it holds a fine map over the lobe's axis D for every view angle and azimuth of
 * the plane of incidence. But the sharp part of these maps depends on the two in few ways. So the
 * kernels are cut in two, by degree of their harmonics: what a blur leaves of them is the business
 * of a small table, and what the table, as it is interpolated, lacks of them is factored,
 *
 *   L_o = table(D, theta_o, psi) + sum over k of W_k(theta_o) (cos(m_k psi) A_k(D) + sin(m_k psi)
 * B_k(D))
 *
 * by singular values of the kernels' harmonics, for each azimuthal order m, weighted by what the
 * environment has of each degree (its power to the 3/2, which serves the absolute error). A_k and
 * B_k are fine maps, each the environment convolved with one function. This is the pair of textures
 * of O'Toole 2007, coefficients and functions, with the light in one of them.
 *
 * Cost: the table's fetches, a bilinear one for each field, and a texel for each eight weights, of
 * which a mode has three. Errors: the table's, bilinear interpolation in the maps, and the modes
 * that are left out.
 *
 * Isotropic BRDFs only, as for tables.
 */

#ifndef vtkFactoredRadianceIntegrator_h
#define vtkFactoredRadianceIntegrator_h

#include "vtkEnvironment.h" // for SetRest
#include "vtkRadianceIntegrator.h"

#include <memory> // for parts

class vtkLightSet;
class vtkTableRadianceIntegrator;

class VTKMEASUREDBRDF_EXPORT vtkFactoredRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkFactoredRadianceIntegrator* New();
  vtkTypeMacro(vtkFactoredRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Rows of the fine maps (default 256, in [8, 512]; twice as many columns), and how many maps at
   * most (default 8, in [1, 32]). A mode takes one, or two where it depends on the azimuth. The
   * maps' values lie at cells' centers, as an environment's do: with as many rows as the
   * environment has, they show what a mirror shows.
   */
  virtual void SetNumberOfRows(int numberOfRows);
  vtkGetMacro(NumberOfRows, int);
  virtual void SetNumberOfFields(int numberOfFields);
  vtkGetMacro(NumberOfFields, int);
  ///@}

  ///@{
  /**
   * Sizes of the small table, as vtkTableRadianceIntegrator has them (default 33 x 12 x 8), and the
   * degree about which it hands over to the maps (default 4, in [1, 64]).
   */
  virtual void SetNumberOfTableRows(int numberOfTableRows);
  vtkGetMacro(NumberOfTableRows, int);
  virtual void SetNumberOfViewAngles(int numberOfViewAngles);
  vtkGetMacro(NumberOfViewAngles, int);
  virtual void SetNumberOfAzimuths(int numberOfAzimuths);
  vtkGetMacro(NumberOfAzimuths, int);
  virtual void SetSmoothingDegree(double smoothingDegree);
  vtkGetMacro(SmoothingDegree, double);
  ///@}

  bool GetShaderInputs(vtkBRDFShaderInputs& form) override;

  ///@{
  /**
   * As a method: "factored", by rows, maps, and the small table's sizes. Planners try it
   * with lights (vtkHybridRadianceIntegrator).
   */
  std::string GetMethodName() override { return "factored"; }
  std::string GetMethodDescription() override
  {
    return "a small table, and maps of the sharp part with weights by view";
  }
  std::vector<Size> GetSizes() override;
  double EstimateCost() override;
  vtkIdType EstimateTextureBytes() override;
  ///@}

#ifndef __VTK_WRAP__
  /**
   * For hybrids: take the environment with these texels changed; null (default): as it is.
   */
  void SetRest(const std::shared_ptr<const vtkEnvironment::TexelChanges>& rest)
  {
    this->Rest = rest;
  }

  /// For hybrids: vtkTableRadianceIntegrator::SetLamps of the small table.
  void SetLamps(vtkLightSet* lamps, vtkBRDF* form = nullptr);
#endif

  bool UsesBRDFOnGPU() override;

protected:
  vtkFactoredRadianceIntegrator();
  ~vtkFactoredRadianceIntegrator() override;

  void CopyProperties(vtkRadianceIntegrator* source) override;
  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  int NumberOfRows = 256;
  int NumberOfFields = 8;
  int NumberOfTableRows = 33;
  int NumberOfViewAngles = 12;
  int NumberOfAzimuths = 8;
  double SmoothingDegree = 4.0;

private:
  vtkFactoredRadianceIntegrator(const vtkFactoredRadianceIntegrator&) = delete;
  void operator=(const vtkFactoredRadianceIntegrator&) = delete;

  vtkSmartPointer<vtkTableRadianceIntegrator> NewTable();

  struct Core;
  bool MakeCore(Precomputation& parts, int tableNodes, Core& core);

  std::unique_ptr<Core> Sharp; // null: not prepared
  vtkSmartPointer<vtkTableRadianceIntegrator> Broad;
  std::shared_ptr<const vtkEnvironment::TexelChanges> Rest;
  vtkSmartPointer<vtkLightSet> Lamps;
  vtkSmartPointer<vtkBRDF> LampForm;
};

#endif
