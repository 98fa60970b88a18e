// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An isotropic material in two layers that add up to it: a broad one, what a coarse table can
 * resolve, and the sharp rest. Private to the module.
 */

#ifndef KernelLayers_h
#define KernelLayers_h

#include "KernelMeans.h"
#include "vtkBRDF.h"

#include <glm/glm.hpp>

#include <memory>
#include <vector>

namespace measuredbrdf
{
/// The kernel f cos(theta_i) of views from the normal to the lowest that shaders take, as cells of
/// a quadrature: what cuts of one material have in common.
class KernelViews
{
public:
  /// They crowd towards the horizon, where measured f is steep.
  static constexpr int NumberOfViews = 64;

  /// Polar angle of a view, from 0 to GetLastAngle(), the lowest that is told apart.
  static double GetAngle(int index);
  static double GetLastAngle();

  /// Where between views an angle lies: 0 <= result <= NumberOfViews - 1.
  static double GetPosition(double angle);

  /// Of a prepared, isotropic BRDF.
  explicit KernelViews(vtkBRDF* brdf);

  struct Cell
  {
    double Energy; // of all channels, less the Lambert part; not negative
    double SolidAngle;
  };
  struct View
  {
    KernelMeans Means;
    std::vector<Cell> Cells; // none: interpolated. The first and the last view have some.
  };
  const std::vector<View>& GetViews() const { return this->Views; }

private:
  void Evaluate(vtkBRDF* brdf, const std::vector<int>& indices);
  KernelMeans Interpolate(const std::vector<int>& known, int index) const;

  std::vector<View> Views;
};

/**
 * Per view the kernel f cos(theta_i), less its Lambert part, is cut at the height at which all of
 * its energy would fill the solid angle: what is above is narrower than that angle (Markov's
 * inequality). Both are tabulated over the view's polar angle and interpolated.
 */
class KernelCut
{
public:
  ///@{
  /// Of a prepared, isotropic BRDF, or its views; solidAngle > 0 in sr.
  KernelCut(vtkBRDF* brdf, double solidAngle);
  KernelCut(const KernelViews& views, double solidAngle);
  ///@}

  struct View
  {
    glm::dvec3 Floor;
    double Height; // of the sum of all channels
    double Share;  // that the sharp part has of the albedo

    /// f's broad part, 0 <= result <= f, for a light at this cosine.
    glm::dvec3 GetBroad(const glm::dvec3& f, double cosine) const;
  };

  /// For unit o above the horizon.
  View GetView(const glm::dvec3& o) const;

  /// Largest share that the sharp part has of a view's directional albedo.
  double GetSharpShare() const { return this->SharpShare; }

private:
  std::vector<View> Views;
  double SharpShare = 0.0;
};

/// One of the two layers of a material.
class KernelLayer : public vtkBRDF
{
public:
  static KernelLayer* New();
  vtkTypeMacro(KernelLayer, vtkBRDF);

  void Set(vtkBRDF* brdf, const std::shared_ptr<KernelCut>& cut, bool sharp);

  void GetDirectionalAlbedo(const double o[3], double albedo[3]) override;
  void GetBounds(double minimumCosine, double lower[3], double upper[3]) override;
  /// None: layers are integrated, not drawn.
  void GetGPUForm(vtkBRDFGPUForm&) override {}

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;
  bool SampleAbove(const double o[3], double u1, double u2, double i[3]) override;
  double PdfAbove(const double i[3], const double o[3]) override;

private:
  vtkSmartPointer<vtkBRDF> Whole;
  std::shared_ptr<KernelCut> Cut;
  bool Sharp = false;
};
} // namespace measuredbrdf

#endif
