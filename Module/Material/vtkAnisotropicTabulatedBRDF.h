// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAnisotropicTabulatedBRDF
 * @brief   BRDF as a table over half and difference angles with the half vector's azimuth, linear
 * in all four
 *
 * Rusinkiewicz 1998, axes (phi_d, theta_d, phi_h, theta_h), phi_d fastest. Sample k of n lies at
 * theta_h = (pi/2) ((k+1/2)/n)^2, phi_h = AzimuthRange (k+1/2)/n, theta_d = (pi/2)(k+1/2)/n, and
 * phi_d = 2 pi (k+1/2)/n. Both azimuths are periodic; phi_h counts from the tangent. AzimuthRange
 * pi: the material is the same after half a turn, as brushed metal is; 2 pi: not necessarily, as
 * cloth with a nap. theta axes are constant beyond the outermost samples.
 *
 * It is the graphics card's form of measured anisotropic materials (vtkAdaptiveWarpBRDF): one 3D
 * texture, two fetches. A cosine-weighted volume holds f cos(theta_o), which stays smooth up to the
 * horizon. Stored values may be negative (measured noise); Evaluate clamps at 0 after
 * interpolation. Soft lights count as hard ones.
 */

#ifndef vtkAnisotropicTabulatedBRDF_h
#define vtkAnisotropicTabulatedBRDF_h

#include "vtkBRDF.h"

#include <memory> // for sampling table
#include <vector> // for the volume

class VTKMEASUREDBRDF_EXPORT vtkAnisotropicTabulatedBRDF : public vtkBRDF
{
public:
  static vtkAnisotropicTabulatedBRDF* New();
  vtkTypeMacro(vtkAnisotropicTabulatedBRDF, vtkBRDF);

  enum AzimuthRangeType
  {
    HALF_TURN = 0, // [0, pi]
    FULL_TURN = 1  // [0, 2 pi]
  };

  /// Of theta_d times phi_h, which share an axis of the texture, and of each other axis.
  static constexpr int MaximumSamples = 2048;

  /**
   * Set the whole table. dimensions: samples along (phi_d, theta_d, phi_h, theta_h), each at least
   * 1, with MaximumSamples, 2^26 in all; rgb: finite RGB triples, phi_d fastest. Returns false with
   * an error event and leaves the volume as it was when sizes do not match or a value is not
   * finite.
   */
  bool SetVolume(int azimuthRange, const int dimensions[4], std::vector<float> rgb);

  ///@{
  /**
   * What SetVolume set.
   */
  vtkGetMacro(AzimuthRange, int);
  vtkGetVector4Macro(Dimensions, int);
  const std::vector<float>& GetVolume() const { return this->Volume; }
  ///@}

  ///@{
  /**
   * Whether the volume holds f cos(theta_o) instead of f; default off.
   */
  vtkSetMacro(CosineWeighted, bool);
  vtkGetMacro(CosineWeighted, bool);
  vtkBooleanMacro(CosineWeighted, bool);
  ///@}

  ///@{
  /**
   * Relative L2 error of this table against the data from which it was resampled; 0 (the default)
   * for original data.
   */
  virtual void SetResamplingError(double resamplingError);
  vtkGetMacro(ResamplingError, double);
  ///@}

  /**
   * Fill the table from another BRDF: f cos(theta_o) at all samples. Returns false with an error
   * event for sizes that SetVolume refuses. Measures no error.
   */
  bool Resample(vtkBRDF* source, int azimuthRange, const int dimensions[4]);

  bool IsIsotropic() override { return false; }
  bool IsReciprocal() override { return false; }
  void Prepare() override;
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  std::string GetModelName() override { return "AnisotropicTabulated"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkAnisotropicTabulatedBRDF();
  ~vtkAnisotropicTabulatedBRDF() override;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;

  int AzimuthRange = FULL_TURN;
  int Dimensions[4] = { 0, 0, 0, 0 };
  bool CosineWeighted = false;
  double ResamplingError = 0.0;
  std::vector<float> Volume;

private:
  vtkAnisotropicTabulatedBRDF(const vtkAnisotropicTabulatedBRDF&) = delete;
  void operator=(const vtkAnisotropicTabulatedBRDF&) = delete;
};

#endif
