// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTabulatedBRDF
 * @brief   BRDF as a table over half/difference or incident/outgoing angles, linear between samples
 *
 * HALF_DIFFERENCE (Rusinkiewicz 1998; MERL's parameters): axes (phi_d, theta_d, theta_h), x = phi_d
 * fastest. Sample k of n lies at theta_h = (pi/2) ((k+1/2)/n)^2, theta_d = (pi/2)(k+1/2)/n,
 * phi_d = AzimuthRange (k+1/2)/n, periodic. AzimuthRange pi: f(i,o) = f(o,i) by construction
 * (swapping them adds pi to phi_d), as MERL has it; 2 pi: not necessarily reciprocal.
 *
 * INCIDENT_OUTGOING (MBSDF's parameters): axes (delta phi, theta_o, theta_i), all uniform at cell
 * centers; AzimuthRange pi: mirror-symmetric in delta phi; 2 pi: periodic.
 *
 * ANISOTROPIC (Rusinkiewicz 1998): axes (phi_d, theta_d, phi_h, theta_h), as HALF_DIFFERENCE but
 * with phi_d over 2 pi and the half vector's azimuth from the tangent: phi_h = AzimuthRange
 * (k+1/2)/n, periodic. AzimuthRange pi: the material is the same after half a turn, as brushed
 * metal is; 2 pi: not necessarily, as cloth with a nap. It is the graphics card's form of measured
 * anisotropic materials (vtkAdaptiveWarpBRDF): one 3D texture, two fetches.
 *
 * A cosine-weighted volume holds f cos(theta_o), which stays smooth up to the horizon where f
 * itself grows without bound; Evaluate divides by the cosine.
 *
 * Cells may be invalid (not measured). Interpolation skips them: the weights of the valid corners
 * are renormalized; with none valid the value is 0. theta axes are constant beyond the outermost
 * samples. Stored values may be negative (measured noise); Evaluate clamps at 0 after
 * interpolation.
 *
 * Soft light (EvaluateSoft) reads a HALF_DIFFERENCE volume at a wider level, blurred along theta_h
 * (of the stored value: f, or f cos(theta_o) where it is cosine-weighted). Levels are made, and are
 * part of the shader inputs, only if soft light is requested. Wider levels have fewer samples in
 * theta_h, and samples every 5 degrees in phi_d and every 2 in theta_d. For MERL's 180 x 90 x 90
 * samples (8.7 MB as 16-bit floats) of a lobe of Blinn exponent 10, 300 and 100,000 they take 0.5,
 * 1.9 and 7.1 MB more. For tables that already are as coarse as that in phi_d and theta_d, they
 * take up to 8 times the table's size. The other parameterizations stay hard.
 */

#ifndef vtkTabulatedBRDF_h
#define vtkTabulatedBRDF_h

#include "vtkBRDF.h"

#include <memory> // for levels
#include <vector> // for the volume

class VTKMEASUREDBRDF_EXPORT vtkTabulatedBRDF : public vtkBRDF
{
public:
  static vtkTabulatedBRDF* New();
  vtkTypeMacro(vtkTabulatedBRDF, vtkBRDF);

  enum ParameterizationType
  {
    HALF_DIFFERENCE = 0,
    INCIDENT_OUTGOING = 1,
    ANISOTROPIC = 2
  };

  enum AzimuthRangeType
  {
    HALF_TURN = 0, // [0, pi]
    FULL_TURN = 1  // [0, 2 pi]
  };

  enum PrecisionType
  {
    AUTOMATIC = 0,
    FLOAT16 = 1,
    FLOAT32 = 2,
    SHARED_EXPONENT = 3
  };

  /**
   * Set the whole table. dimensions: samples along (azimuth, second theta, first theta), each
   * in [1, 2048]; rgb: RGB triples, x fastest; invalid cells hold NaN in any channel. Returns false
   * with an error event and leaves the volume as it was when sizes do not match.
   */
  bool SetVolume(
    int parameterization, int azimuthRange, const int dimensions[3], std::vector<float> rgb);

  /**
   * The same for an ANISOTROPIC table. dimensions: samples along (phi_d, theta_d, phi_h, theta_h),
   * each in [1, 2048], as the product of the second and the third; 2^26 in all. All values finite.
   */
  bool SetVolume(int azimuthRange, const int dimensions[4], std::vector<float> rgb);

  /**
   * Make an ANISOTROPIC table of another BRDF: f cos(theta_o) at all samples. Returns false with an
   * error event for sizes that SetVolume refuses. Measures no error.
   */
  bool Resample(vtkBRDF* source, int azimuthRange, const int dimensions[4]);

  ///@{
  /**
   * The values that SetVolume set. Of an ANISOTROPIC table the second dimension is that of theta_d
   * times that of phi_h (NumberOfAzimuths, else 1), theta_d faster.
   */
  vtkGetMacro(Parameterization, int);
  vtkGetMacro(AzimuthRange, int);
  vtkGetVector3Macro(Dimensions, int);
  vtkGetMacro(NumberOfAzimuths, int);
  const std::vector<float>& GetVolume() const { return this->Volume; }
  vtkIdType GetNumberOfInvalidCells() const { return this->NumberOfInvalidCells; }
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
   * Texture precision of the shader inputs. AUTOMATIC (default): 16-bit floats where their rounding
   * (2^-11 relative) is within a quarter of ResamplingTolerance, 32-bit else. 16-bit values are
   * scaled to the table's peak, so none overflows, and keep that rounding over nine decades.
   * SHARED_EXPONENT: 9 bits for each channel and an exponent that they share, two thirds of 16-bit
   * floats' memory, where that rounding (2^-9 of the largest channel) is within a quarter of
   * ResamplingTolerance, no cell is invalid and no value negative; else as AUTOMATIC. ANISOTROPIC
   * tables are always AUTOMATIC.
   */
  virtual void SetPrecision(int precision);
  vtkGetMacro(Precision, int);
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
   * Direction pair at the center of cell (x,y,z) in a canonical azimuth (h or o in the xz plane) of
   * an isotropic table.
   * Returns false where i or o lies at or below the horizon: such cells hold no material.
   */
  static bool GetCellDirections(int parameterization, int azimuthRange, const int dimensions[3],
    int x, int y, int z, double i[3], double o[3]);

  /**
   * Evaluate for one view and so many lights, all unit vectors above the horizon, in single
   * precision: far faster than one by one where no cell is invalid. i: x, y and z of all lights; f:
   * red, green and blue.
   */
  VTK_WRAPEXCLUDE void EvaluateLights(
    int count, const float* const i[3], const double o[3], float* const f[3]);

  bool IsIsotropic() override { return this->Parameterization != ANISOTROPIC; }
  bool IsReciprocal() override
  {
    return this->Parameterization == HALF_DIFFERENCE && this->AzimuthRange == HALF_TURN &&
           !this->CosineWeighted;
  }
  void Prepare() override;
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  std::string GetModelName() override
  {
    return this->Parameterization == ANISOTROPIC ? "AnisotropicTabulated" : "Tabulated";
  }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkTabulatedBRDF() = default;
  ~vtkTabulatedBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;
  void EvaluateSoftAbove(const double i[3], const double o[3], double spread, double f[3]) override;

  int Parameterization = HALF_DIFFERENCE;
  int AzimuthRange = HALF_TURN;
  int Dimensions[3] = { 0, 0, 0 };
  int NumberOfAzimuths = 1;
  int Precision = AUTOMATIC;
  bool CosineWeighted = false;
  double ResamplingError = 0.0;
  std::vector<float> Volume;
  vtkIdType NumberOfInvalidCells = 0;

private:
  vtkTabulatedBRDF(const vtkTabulatedBRDF&) = delete;
  void operator=(const vtkTabulatedBRDF&) = delete;

  void TakeVolume(int parameterization, int azimuthRange, const int dimensions[3], int azimuths,
    std::vector<float> rgb);

  struct Levels;
  const Levels* GetLevels();
  std::shared_ptr<Levels> WidenedLevels; // of this volume: copies share them until either changes
};

#endif
