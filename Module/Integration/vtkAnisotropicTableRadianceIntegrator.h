// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAnisotropicTableRadianceIntegrator
 * @brief   outgoing radiance of anisotropic materials, integrated ahead of time into a table
 *
 * What vtkTableRadianceIntegrator is for isotropic materials. The radiance that an anisotropic one
 * reflects depends on the frame of normal and tangent (three numbers) and on the view's polar angle
 * and azimuth in it (two):
 *
 *   L_o = c(theta_o, phi_o) E(n) + s(theta_o, phi_o) T(D, psi, theta_o, phi_o)
 *
 * D is the direction of the lobe's axis: the mean direction of f cos(theta_i), less a Lambert part,
 * weighted by its cube. psi is the azimuth about D of the tangent, carried from the normal to the
 * axis by the smallest rotation. In this frame lobes of neighboring views resemble each other, so
 * few views suffice, between which T is interpolated linearly. c, s, E as for isotropic tables.
 *
 * T is a 3D texture: azimuth of D; polar angle of D within azimuths of the view; psi within polar
 * angles of the view. Four trilinear fetches interpolate it in all five. It is made as isotropic
 * tables are, by a convolution over the rotation group (Kostelec, Rockmore 2008), with complex
 * harmonics, since kernels have no plane of symmetry.
 *
 * f that is the same after half a turn of the sample, as of brushed metal, needs views over half a
 * turn only; this is detected (GetNumberOfPeriods).
 *
 * Cost: 4 trilinear fetches, 3 of the small profile, and a bilinear one where there is a Lambert
 * part. Errors: linear interpolation, and the harmonics' degree. Narrow lobes need many rows:
 * vtkLightSetRadianceIntegrator with soft lights takes no memory.
 *
 * Isotropic BRDFs may be used, too, but vtkTableRadianceIntegrator takes less for them. Views
 * closer to the horizon than 1.1 degrees are taken there.
 */

#ifndef vtkAnisotropicTableRadianceIntegrator_h
#define vtkAnisotropicTableRadianceIntegrator_h

#include "vtkEnvironment.h" // for SetRest
#include "vtkRadianceIntegrator.h"

#include <memory> // for tables
#include <string> // for bytes
#include <vector> // for sizes

class VTKMEASUREDBRDF_EXPORT vtkAnisotropicTableRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkAnisotropicTableRadianceIntegrator* New();
  vtkTypeMacro(vtkAnisotropicTableRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Rows of the map over D from pole to pole (default 33, in [9, 129]; twice as many columns less
   * two), polar angles of the view (default 8, in [2, 32]), azimuths psi (default 16, in [4, 64]),
   * azimuths of the view over the period of f (default 8, in [2, 32]).
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

  /**
   * How often f repeats itself while the sample is turned once about its normal: 1, or 2 as of
   * brushed metal. 0 before Prepare.
   */
  int GetNumberOfPeriods();

  bool GetShaderInputs(vtkBRDFShaderInputs& form) override;

  ///@{
  /**
   * As a method: "anisotropic-table", by rows, view angles, azimuths and the view's azimuths, for
   * anisotropic materials.
   */
  std::string GetMethodName() override { return "anisotropic-table"; }
  std::string GetMethodDescription() override
  {
    return "a precomputed table of outgoing radiance over turned frames";
  }
  std::vector<Size> GetSizes() override;
  std::vector<std::vector<int>> GetCandidateSizes(bool all) override;
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
#endif

protected:
  vtkAnisotropicTableRadianceIntegrator();
  ~vtkAnisotropicTableRadianceIntegrator() override;

  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  int NumberOfRows = 33;
  int NumberOfViewAngles = 8;
  int NumberOfAzimuths = 16;
  int NumberOfViewAzimuths = 8;

private:
  vtkAnisotropicTableRadianceIntegrator(const vtkAnisotropicTableRadianceIntegrator&) = delete;
  void operator=(const vtkAnisotropicTableRadianceIntegrator&) = delete;

  struct Tables;
  bool MakeTable(Tables& table);

  std::shared_ptr<const vtkEnvironment::TexelChanges> Rest;
  std::unique_ptr<Tables> Data;
};

#endif
