// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAngularTableBRDF
 * @brief   BRDF at nodes over both directions' polar angles and azimuths
 *
 * The form of goniometers' data, such as the UTIA database's (Filip and Vavra 2014, "Template-based
 * sampling of anisotropic BRDFs"): values at each pair of nodes, which are polar angles and
 * azimuths. It is interpolated linearly along all axes, azimuths around the circle. Before the
 * first polar angle it is constant. Beyond the last one it is extrapolated linearly; what comes out
 * negative is 0. A last polar angle of 90 degrees leaves nothing to extrapolate.
 *
 * Azimuths are counted from the tangent, or those of the view from the light's: then the material
 * is isotropic, and the light's nodes have one azimuth.
 *
 * Nothing is assumed of reciprocity or symmetry. For lights graphics cards get a resampled
 * vtkTabulatedBRDF, with one warning where that exceeds ResamplingTolerance.
 */

#ifndef vtkAngularTableBRDF_h
#define vtkAngularTableBRDF_h

#include "vtkResampledBRDF.h"

#include <vector> // for values

class VTKMEASUREDBRDF_EXPORT vtkAngularTableBRDF : public vtkResampledBRDF
{
public:
  static vtkAngularTableBRDF* New();
  vtkTypeMacro(vtkAngularTableBRDF, vtkResampledBRDF);

  /// Nodes of a direction.
  struct Nodes
  {
    std::vector<float> Theta; // degrees, ascending, in [0, 90]; at least one
    std::vector<float> Phi;   // degrees, ascending, in [0, 360); at least one

    int GetNumberOfNodes() const { return static_cast<int>(this->Theta.size() * this->Phi.size()); }
  };

  /// Where the view's azimuths are counted from; the light's always are from the tangent.
  enum AzimuthOrigin
  {
    TANGENT = 0,
    LIGHT = 1
  };

  /// 0, 360 / count, ... degrees; none where count is not 1 to MaximumNodes.
  static std::vector<float> GetEvenAzimuths(int count);

  /// Of either direction.
  static constexpr int MaximumNodes = 16384;

  /// Of both together, in millions.
  static constexpr int MaximumMegavalues = 64;

  /**
   * Set the nodes and the values: finite RGB triples in 1/sr, a row for each node of the light, in
   * it a triple for each node of the view; polar angle by polar angle, azimuths in each. origin:
   * with LIGHT the light's only azimuth must be 0. Returns an empty string, or what is wrong, the
   * material unchanged. Negative values are kept.
   */
  std::string SetValues(
    Nodes light, Nodes view, std::vector<float> rgb, AzimuthOrigin origin = TANGENT);
  const Nodes& GetLightNodes() const { return this->Light; }
  const Nodes& GetViewNodes() const { return this->View; }
  const std::vector<float>& GetValues() const { return this->Values; }
  AzimuthOrigin GetAzimuthOrigin() const { return this->Origin; }

  bool IsIsotropic() override { return this->Origin == LIGHT; }
  bool IsReciprocal() override { return false; }
  std::string GetModelName() override { return "AngularTable"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkAngularTableBRDF() = default;
  ~vtkAngularTableBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;

  Nodes Light;
  Nodes View;
  std::vector<float> Values;
  AzimuthOrigin Origin = TANGENT;

private:
  vtkAngularTableBRDF(const vtkAngularTableBRDF&) = delete;
  void operator=(const vtkAngularTableBRDF&) = delete;
};

#endif
