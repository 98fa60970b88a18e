// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBasisBRDF
 * @brief   f(i,o) ~ sum_k C_k(o) B_k(i): the thesis's pair of tables, coefficients and basis values
 *
 * The basis representation of O'Toole 2007, 2.3.3 and 3.1, and of the device of Ghosh et al. 2007:
 * the projector shows B_k, and the camera measures C_k(o). The bases are orthonormal over their
 * domain (the polar angles of i that they cover):
 *
 * SPHERICAL_HARMONICS: real harmonics of the whole sphere, used on the upper half.
 * HEMISPHERICAL: the upper hemisphere (Gautron et al. 2004).
 * ZONAL: theta_i in [begin, end] (Ghosh et al. 2007).
 * LEGENDRE_FOURIER: the same zone, Legendre polynomials x Fourier series. They do not vanish at the
 * zone's edges; in the other bases, all functions that vary with the azimuth do.
 *
 * Order N has K = (N+1)^2 functions, k = l(l+1)+m, 0 <= l <= N, |m| <= l (Legendre x Fourier:
 * degree l - |m|).
 *
 * Coefficients are a table over o: nTheta samples of theta_o from the outgoing zone's begin to its
 * end, both included, times nPhi azimuths 2 pi j / nPhi. nPhi = 1 is the isotropic form: the table
 * holds the coefficients of azimuth 0, and i is rotated by -phi_o instead of the coefficients. Both
 * tables are interpolated linearly along directions and never across k. The basis
 * table's rows lie at equal steps of acos(x), x = 2 (cos theta - cos end) / (cos begin - cos end) -
 * 1, where a function of degree l has no frequency above l; its size follows the order and
 * ResamplingTolerance up to 256 x 256. ResamplingError of the shader inputs is the actual error;
 * orders above about 10 miss the default tolerance where their highest degrees dominate.
 *
 * Directions outside a zone are moved to its edge at the same azimuth, so f is constant there.
 * Sums may be negative (ringing); Evaluate clamps at 0 after the sum, EvaluateSigned does not.
 */

#ifndef vtkBasisBRDF_h
#define vtkBasisBRDF_h

#include "vtkBRDF.h"

#include <memory> // for tables
#include <vector> // for coefficients

class VTKMEASUREDBRDF_EXPORT vtkBasisBRDF : public vtkBRDF
{
public:
  static vtkBasisBRDF* New();
  vtkTypeMacro(vtkBasisBRDF, vtkBRDF);

  enum BasisType
  {
    SPHERICAL_HARMONICS = 0,
    HEMISPHERICAL = 1,
    ZONAL = 2,
    LEGENDRE_FOURIER = 3
  };

  /// Largest order: 441 functions.
  static constexpr int MaximumOrder = 20;

  /// Least width of a zone in degrees, for which a shader's 32-bit cosines can separate its edges.
  static constexpr double MinimumZoneWidth = 1.0;

  /// Largest angle at which a zone may begin, in degrees: directions nearer to the horizon are
  /// never shaded.
  static constexpr double MaximumZoneBegin = 88.0;

  /**
   * Describes the error in a zone of polar angles in degrees: "" where 0 <= begin <=
   * MaximumZoneBegin, begin + MinimumZoneWidth <= end <= 90.
   */
  static std::string FindZoneProblem(const double zone[2]);

  /// Most coefficients, all channels: 256 MiB.
  static constexpr int MaximumNumberOfValues = 1 << 26;

  /**
   * Describes the error in the sizes of a table of coefficients: "" where order is in [0,
   * MaximumOrder], nTheta in [2, 1024], nPhi in [1, 1024] and 3 (order + 1)^2 nTheta nPhi at most
   * MaximumNumberOfValues.
   */
  static std::string FindSizeProblem(int order, int nTheta, int nPhi);

  /**
   * Set the whole representation. order, nTheta, nPhi: see FindSizeProblem; zones in degrees: see
   * FindZoneProblem (the first two bases ignore that of i and cover 0 to 90); rgb: K x nTheta x
   * nPhi RGB triples, phi fastest, finite. Returns "" on success; otherwise returns a description
   * of the error and changes nothing.
   */
  std::string SetCoefficients(int basis, int order, const double incidentZone[2],
    const double outgoingZone[2], int nTheta, int nPhi, std::vector<float> rgb);

  ///@{
  /**
   * The values that SetCoefficients set; zones in degrees.
   */
  vtkGetMacro(Basis, int);
  vtkGetMacro(Order, int);
  vtkGetVector2Macro(IncidentZone, double);
  vtkGetVector2Macro(OutgoingZone, double);
  vtkGetMacro(NumberOfTheta, int);
  vtkGetMacro(NumberOfPhi, int);
  int GetNumberOfFunctions() const { return (this->Order + 1) * (this->Order + 1); }
  const std::vector<float>& GetCoefficients() const { return this->Coefficients; }
  ///@}

  /**
   * The basis by name: "spherical harmonics", "hemispherical", "zonal", "Legendre x Fourier".
   */
  static std::string GetBasisName(int basis);

  ///@{
  /**
   * Whether the sum is f cos(theta_i) instead of f, as a device with a projector measures it;
   * default off. Evaluate divides by the cosine (beyond the zone by that of its edge; by 0.01 at
   * least).
   */
  vtkSetMacro(IncidentCosine, bool);
  vtkGetMacro(IncidentCosine, bool);
  vtkBooleanMacro(IncidentCosine, bool);
  ///@}

  ///@{
  /**
   * Whether the sum contains the factor cos(theta_o); default off. Measured f grows as the inverse
   * of this cosine towards grazing angles, and tables interpolate the product well.
   */
  vtkSetMacro(OutgoingCosine, bool);
  vtkGetMacro(OutgoingCosine, bool);
  vtkBooleanMacro(OutgoingCosine, bool);
  ///@}

  ///@{
  /**
   * Relative L2 error of this representation against the data from which it was made; 0 (the
   * default) means unknown; clamped to [0, 1e6].
   */
  virtual void SetResamplingError(double resamplingError);
  vtkGetMacro(ResamplingError, double);
  ///@}

  /**
   * The sum without the clamp, divided by the cosines that it contains. It may be negative where f
   * rings. Directions are as for Evaluate; the result is zero at and below the horizon.
   */
  void EvaluateSigned(const double i[3], const double o[3], double f[3]);

  /**
   * B_k of a unit direction for all k, computed, not interpolated: GetNumberOfFunctions() values.
   * Zone in degrees; order in [0, MaximumOrder]. Empty for a basis, order or zone that
   * SetCoefficients refuses.
   */
  static std::vector<double> EvaluateBasis(
    int basis, int order, const double zone[2], const double direction[3]);

  /**
   * Share of negative values before the clamp, 0 to 1: integral of f's negative part / integral of
   * |f| over RGB and two zones of polar angles (begin and end in degrees, of i and of o), both
   * cosines as weights, from `pairs` low-discrepancy pairs. NaN for zones that FindZoneProblem
   * refuses.
   */
  double GetNegativeMass(const double incident[2], const double outgoing[2], int pairs = 1 << 14);

  bool IsIsotropic() override { return this->NumberOfPhi == 1; }
  bool IsReciprocal() override { return false; }
  void Prepare() override;
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  std::string GetModelName() override { return "Basis"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;
  double GetMaximumArraySize() override { return MaximumNumberOfValues; }

protected:
  vtkBasisBRDF() = default;
  ~vtkBasisBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;

  int Basis = ZONAL;
  int Order = 0;
  double IncidentZone[2] = { 0.0, 90.0 };
  double OutgoingZone[2] = { 0.0, 90.0 };
  int NumberOfTheta = 0;
  int NumberOfPhi = 1;
  std::vector<float> Coefficients;
  bool IncidentCosine = false;
  bool OutgoingCosine = false;
  double ResamplingError = 0.0;

private:
  vtkBasisBRDF(const vtkBasisBRDF&) = delete;
  void operator=(const vtkBasisBRDF&) = delete;

  struct Tables;
  const Tables& GetTables();
  void Sum(const double i[3], const double o[3], double f[3]);

  std::shared_ptr<const Tables> Cached;
};

#endif
