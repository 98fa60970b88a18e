// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTableRadianceIntegrator
 * @brief   outgoing radiance, integrated ahead of time into a table: a few fetches a pixel
 *
 * For an isotropic BRDF under a distant environment, radiance depends on the normal and the view
 * alone. Per view angle theta_o the kernel f cos(theta_i) is split into a Lambert part c(theta_o)
 * cos(theta_i), which needs the irradiance over the normal only, and the rest, whose mean direction
 * a(theta_o) lies in the plane of incidence. Carried to the axis D = a in the world, the rest
 * varies with three more quantities: D (two charts of the sphere, equal-area azimuthal projection),
 * theta_o and the azimuth psi of the plane of incidence about D. Over psi it is a Fourier series,
 * short because about its mean direction a lobe is nearly round (to first order psi does not matter
 * at all):
 *
 *   L_o = c(theta_o) E(n) + s(theta_o) sum over |m| <= M of T_m(D, theta_o) e^(i m psi)
 *
 * s is the rest's share of the directional albedo, so a constant environment comes out exact. Each
 * T_m is one trilinear fetch; D's charts have smooth frame fields and a border, so nothing is
 * interpolated across a seam or a pole. Entries are sums over the lobe's cells (LobeQuadrature) of
 * weight x mean radiance from an environment pyramid; suns are summed exactly.
 *
 * Cost: 2M + 5 fetches a pixel, whatever the light. Errors: cell size (second order), chart and
 * theta_o interpolation (second order in size x lobe width), azimuth orders beyond M. The axis
 * instead of the mirror direction is this project's.
 *
 * Isotropic BRDFs only. Views closer to the horizon than 1.1 degrees are taken there.
 */

#ifndef vtkTableRadianceIntegrator_h
#define vtkTableRadianceIntegrator_h

#include "vtkRadianceIntegrator.h"

#include <memory> // for tables

namespace measuredbrdf
{
class EnvironmentHarmonics;
}

class VTKMEASUREDBRDF_EXPORT vtkTableRadianceIntegrator : public vtkRadianceIntegrator
{
public:
  static vtkTableRadianceIntegrator* New();
  vtkTypeMacro(vtkTableRadianceIntegrator, vtkRadianceIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Rows of the map over D from pole to pole (default 65, in [9, 513]; twice as many columns less
   * two), view angles (default 16, in [2, 64]), azimuths psi (default 16, in [4, 64]).
   */
  vtkSetClampMacro(NumberOfRows, int, 9, 513);
  vtkGetMacro(NumberOfRows, int);
  vtkSetClampMacro(NumberOfViewAngles, int, 2, 64);
  vtkGetMacro(NumberOfViewAngles, int);
  vtkSetClampMacro(NumberOfAzimuths, int, 4, 64);
  vtkGetMacro(NumberOfAzimuths, int);
  ///@}

  ///@{
  /**
   * Highest degree of the spherical harmonics that carry the light; 0 (default): NumberOfRows.
   */
  vtkSetClampMacro(HarmonicDegree, int, 0, 1024);
  vtkGetMacro(HarmonicDegree, int);
  ///@}

  ///@{
  /**
   * Nodes per angle of the integrals that make the kernels' harmonics (default 96, in [16, 1024]).
   */
  vtkSetClampMacro(NumberOfNodes, int, 16, 1024);
  vtkGetMacro(NumberOfNodes, int);
  ///@}

  bool GetGPUForm(vtkBRDFGPUForm& form) override;

protected:
  vtkTableRadianceIntegrator();
  ~vtkTableRadianceIntegrator() override;

  bool Begin() override;
  void IntegratePart(
    int part, const double n[3], const double o[3], const double t[3], double radiance[3]) override;

  int NumberOfRows = 65;
  int HarmonicDegree = 0;
  int NumberOfViewAngles = 16;
  int NumberOfAzimuths = 16;
  int NumberOfNodes = 96;

private:
  vtkTableRadianceIntegrator(const vtkTableRadianceIntegrator&) = delete;
  void operator=(const vtkTableRadianceIntegrator&) = delete;

  struct Tables;
  void AddIrradiance(const measuredbrdf::EnvironmentHarmonics& environment, Tables& tables);

  std::unique_ptr<Tables> Data;
};

#endif
