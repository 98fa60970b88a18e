// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAngleBasisBRDF
 * @brief   BRDF as a matrix over two angle bases: constant within each pair of patches
 *
 * The form of window systems' data (Klems 1994; WINDOW's and Radiance's BSDF XML files): both
 * hemispheres are divided into rings, and these into patches of equal azimuths about multiples of
 * 360 / n degrees. Rows are patches of the light, columns those that the view's direction leaves
 * when it is continued through the surface: its azimuth is turned by 180 degrees, so that the
 * mirror direction has the same number in both. Azimuths count from the tangent.
 *
 * It is not interpolated, as in Radiance. Patches are 10 to 15 degrees wide in the usual bases;
 * pictures show their edges where light is concentrated. For lights graphics cards get a resampled
 * vtkTabulatedBRDF, with one warning where that exceeds ResamplingTolerance.
 */

#ifndef vtkAngleBasisBRDF_h
#define vtkAngleBasisBRDF_h

#include "vtkResampledBRDF.h"

#include <vector> // for the matrix

class VTKMEASUREDBRDF_EXPORT vtkAngleBasisBRDF : public vtkResampledBRDF
{
public:
  static vtkAngleBasisBRDF* New();
  vtkTypeMacro(vtkAngleBasisBRDF, vtkResampledBRDF);

  /// A hemisphere's rings, from the normal outwards.
  struct Basis
  {
    std::vector<float> UpperTheta; // degrees, ascending; the last is 90
    std::vector<int> Patches;      // of each ring, at least 1

    int GetNumberOfPatches() const
    {
      int patches = 0;
      for (const int count : this->Patches)
      {
        patches += count;
      }
      return patches;
    }
  };

  /// Of either basis.
  static constexpr int MaximumPatches = 4096;

  /**
   * Set both bases and the values: finite RGB triples in 1/sr, a row for each patch of the light.
   * Returns an empty string, or what is wrong, the material unchanged. Negative values are kept and
   * count as 0.
   */
  std::string SetMatrix(Basis light, Basis view, std::vector<float> rgb);
  const Basis& GetLightBasis() const { return this->Light; }
  const Basis& GetViewBasis() const { return this->View; }
  const std::vector<float>& GetMatrix() const { return this->Matrix; }

  ///@{
  /**
   * Exact: sums over all patches.
   */
  void GetDirectionalAlbedo(const double o[3], double albedo[3]) override;
  void GetDirectionalReflectance(const double i[3], double reflectance[3]) override;
  ///@}

  bool IsIsotropic() override { return false; }
  bool IsReciprocal() override { return false; }
  std::string GetModelName() override { return "AngleBasis"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkAngleBasisBRDF() = default;
  ~vtkAngleBasisBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;

  Basis Light;
  Basis View;
  std::vector<float> Matrix;

private:
  vtkAngleBasisBRDF(const vtkAngleBasisBRDF&) = delete;
  void operator=(const vtkAngleBasisBRDF&) = delete;

  void SumPatches(const Basis& basis, const double given[3], bool overView, double rgb[3]);
};

#endif
