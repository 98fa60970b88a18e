// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadianceMetrics
 * @brief   how far radiance is from a reference: relative errors and what a person would see of
 * them
 *
 * For linear RGB radiance x of pixels (or pairs) and the reference r of the same pixels, both
 * finite and not negative. Relative errors are shares: 0.02 is 2 %.
 */

#ifndef vtkRadianceMetrics_h
#define vtkRadianceMetrics_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

class vtkDataArray;

class VTKMEASUREDBRDF_EXPORT vtkRadianceMetrics : public vtkObject
{
public:
  static vtkRadianceMetrics* New();
  vtkTypeMacro(vtkRadianceMetrics, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Compare radiance with a reference, 3 components each, one tuple a pixel. Returns false with an
   * error event, the figures unchanged, where they do not match, hold values that are negative or
   * not finite, or the reference is black.
   */
  bool Compare(vtkDataArray* radiance, vtkDataArray* reference);

  /**
   * FLIP of two pictures of width x height pixels, rows one after the other, where coverage (one
   * component, null: everywhere) is not 0. Elsewhere both are taken as black. Refusals as above.
   */
  bool ComparePictures(int width, int height, vtkDataArray* radiance, vtkDataArray* reference,
    vtkDataArray* coverage = nullptr);

  ///@{
  /**
   * mean |x - r| / mean r and sqrt(mean (x - r)^2) / mean r, over pixels and channels.
   */
  vtkGetMacro(RelativeL1, double);
  vtkGetMacro(RelativeRMSE, double);
  ///@}

  ///@{
  /**
   * Median and 99th percentile (linear between neighbours) of the pixels' sum over channels of
   * |x - r| over that of r; pixels with a black reference are left out.
   */
  vtkGetMacro(MedianRelative, double);
  vtkGetMacro(P99Relative, double);
  ///@}

  /**
   * Mean of |x - r| / (x + r) over pixels and channels, 0 where both are black; in [0,1].
   */
  vtkGetMacro(SMAPE, double);

  /**
   * Mean of the pixels' colour difference Delta E ITP (ITU-R BT.2124), 1 about what can just be
   * told apart, with radiance scaled so that the reference's mean luminance is 100 cd/m2.
   */
  vtkGetMacro(DeltaEITP, double);

  /**
   * Mean FLIP (Andersson et al. 2020) of the covered pixels, in [0,1], of the last ComparePictures:
   * 67 pixels a degree, tone mapped by x^(1/2.2) with the 99th percentile of the covered
   * reference's channels at 1.
   */
  vtkGetMacro(FLIP, double);

protected:
  vtkRadianceMetrics() = default;
  ~vtkRadianceMetrics() override = default;

  double RelativeL1 = 0.0;
  double RelativeRMSE = 0.0;
  double MedianRelative = 0.0;
  double P99Relative = 0.0;
  double SMAPE = 0.0;
  double DeltaEITP = 0.0;
  double FLIP = 0.0;

private:
  vtkRadianceMetrics(const vtkRadianceMetrics&) = delete;
  void operator=(const vtkRadianceMetrics&) = delete;

  bool Check(vtkDataArray* radiance, vtkDataArray* reference);
};

#endif
