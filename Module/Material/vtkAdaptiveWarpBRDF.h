// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAdaptiveWarpBRDF
 * @brief   RGL's adaptive parameterization of a measured BRDF, exact on the CPU
 *
 * Dupuy and Jakob 2018, "An Adaptive Parameterization for Efficient Material Acquisition and
 * Rendering" (the RGL-EPFL database). Values live on a square warped by the visible normals, so a
 * fixed grid follows the lobe. The tables hold f cos(theta_o) (i: the tables' incident direction);
 * Evaluate divides by that cosine. Negative values (colors outside sRGB) are clamped at 0 per
 * channel after interpolation.
 *
 * Not reciprocal in general: measured values keep their asymmetry.
 *
 * For the GPU the material is resampled into a vtkTabulatedBRDF or, where it is anisotropic, a
 * vtkTabulatedBRDF, over half and difference angles, with phi_d over the full turn to
 * keep the asymmetry; see GetRenderable(). The table grows until it meets ResamplingTolerance. If
 * no size does, the best one is used, with one warning.
 */

#ifndef vtkAdaptiveWarpBRDF_h
#define vtkAdaptiveWarpBRDF_h

#include "vtkResampledBRDF.h"

#include <memory> // for warps
#include <vector> // for tables

class VTKMEASUREDBRDF_EXPORT vtkAdaptiveWarpBRDF : public vtkResampledBRDF
{
public:
  static vtkAdaptiveWarpBRDF* New();
  vtkTypeMacro(vtkAdaptiveWarpBRDF, vtkResampledBRDF);

  /**
   * A table and its shape, slowest axis first (the file's order).
   */
  struct Table
  {
    std::vector<int> Shape;
    std::vector<float> Values;
  };

  /**
   * The fields of the database's tensor files: theta_i [T] and phi_i [P] in radians, ascending; ndf
   * and sigma [.,.]; vndf [P,T,.,.]; luminance [P,T,R,R]; rgb [P,T,3,R,R]. P <= 2: isotropic.
   * phi_i spans the full turn; half of it, where the material is the same after half a turn; or a
   * quarter, where it is mirror-symmetric, too (as Mitsuba 3's "measured" reads such files).
   */
  struct Tables
  {
    std::vector<float> ThetaI;
    std::vector<float> PhiI;
    Table Ndf;
    Table Sigma;
    Table Vndf;
    Table Luminance;
    Table Rgb;
    bool Jacobian = true; // whether rgb lacks the factor ndf/(4 sigma): the files' own flag
  };

  /**
   * Set the tables. Returns an empty string on success. Otherwise it returns a description of the
   * error (shapes that do not match, axes not ascending, values not finite, a warp density that is
   * negative or sums to 0) and leaves the material unchanged. Rounding errors are repaired:
   * densities that are negative by up to 1e-5 of their table's largest value become 0, and angles
   * that decrease by up to 1e-5 are increased by the least step.
   */
  std::string SetTables(Tables tables);
  const Tables& GetTables() const { return this->Data; }

  /**
   * Evaluate for one view and so many lights, all unit vectors above the horizon, in single
   * precision: far faster than one by one. i: x, y and z of all lights; f: red, green and blue.
   */
  VTK_WRAPEXCLUDE void EvaluateLights(
    int count, const float* const i[3], const double o[3], float* const f[3]);

  bool IsIsotropic() override { return this->Data.PhiI.size() <= 2; }
  bool IsReciprocal() override { return false; }
  std::string GetModelName() override { return "AdaptiveWarp"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkAdaptiveWarpBRDF() = default;
  ~vtkAdaptiveWarpBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;
  bool SampleAbove(const double o[3], double u1, double u2, double i[3]) override;
  double PdfAbove(const double i[3], const double o[3]) override;

  Tables Data;

private:
  vtkAdaptiveWarpBRDF(const vtkAdaptiveWarpBRDF&) = delete;
  void operator=(const vtkAdaptiveWarpBRDF&) = delete;

  struct Warps;
  std::shared_ptr<const Warps> Warp;
};

#endif
