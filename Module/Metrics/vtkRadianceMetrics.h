// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadianceMetrics
 * @brief   differences between radiance and a reference: relative errors and visible differences
 *
 * x is the linear RGB radiance of pixels (or pairs), and r the reference of the same pixels. Both
 * must be finite and not negative. Relative errors are shares: 0.02 is 2 %.
 */

#ifndef vtkRadianceMetrics_h
#define vtkRadianceMetrics_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

#include <atomic> // for Abort

class vtkDataArray;

class VTKMEASUREDBRDF_EXPORT vtkRadianceMetrics : public vtkObject
{
public:
  static vtkRadianceMetrics* New();
  vtkTypeMacro(vtkRadianceMetrics, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Compare radiance with a reference, 3 components each, one tuple per pixel. Returns false with
   * an error event and leaves the figures unchanged if the arrays do not match or hold values that
   * are negative or not finite, or if the reference is black.
   */
  bool Compare(vtkDataArray* radiance, vtkDataArray* reference);

  /**
   * Compute FLIP, HDRFLIP, SSIM and DeltaE2000 of two pictures of width x height pixels, stored row
   * by row, where coverage (one component; null: everywhere) is not 0. Elsewhere both count as
   * black. Returns false for the same errors as Compare, and when aborted, and then leaves the
   * figures unchanged. Raises ProgressEvent (calldata: double*).
   */
  bool ComparePictures(int width, int height, vtkDataArray* radiance, vtkDataArray* reference,
    vtkDataArray* coverage = nullptr);

  ///@{
  /**
   * Set this from an observer or another thread to stop a running ComparePictures, which clears it
   * first.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

  ///@{
  /**
   * mean |x - r| / mean r and sqrt(mean (x - r)^2) / mean r, over pixels and channels.
   */
  vtkGetMacro(RelativeL1, double);
  vtkGetMacro(RelativeRMSE, double);
  ///@}

  /**
   * Mean of (x - r)^2 / (r^2 + e) over pixels and channels, e = 0.01 (mean r)^2 (Rousselle et al.
   * 2011, whose 0.01 is for pictures of a mean about 1).
   */
  vtkGetMacro(RelMSE, double);

  ///@{
  /**
   * Median and 99th percentile (linear between neighbors) over pixels of sum |x - r| / sum r,
   * summed over channels; pixels with a black reference are left out.
   */
  vtkGetMacro(MedianRelative, double);
  vtkGetMacro(P99Relative, double);
  ///@}

  ///@{
  /**
   * What 95 and 99 % of the pixels stay within: percentiles of sum |x - r| over the pixels' mean
   * sum of r, as vtkRadiancePlanner predicts them.
   */
  vtkGetMacro(Percentile95, double);
  vtkGetMacro(Percentile99, double);
  ///@}

  /**
   * Mean of |x - r| / (x + r) over pixels and channels, 0 where both are black; in [0,1].
   */
  vtkGetMacro(SMAPE, double);

  /**
   * Mean FLIP (Andersson et al. 2020) of the covered pixels, in [0,1], of the last ComparePictures:
   * 67 pixels per degree, tone mapped by x^(1/2.2) with the 99th percentile of the covered
   * reference's channels at 1.
   */
  vtkGetMacro(FLIP, double);

  /**
   * Mean HDR-FLIP (Andersson et al. 2021) of the covered pixels, in [0,1], of the last
   * ComparePictures: each pixel's largest FLIP over exposures about a stop apart, tone mapped by
   * the ACES curve. The exposures reach from that for the covered reference's brightest pixel to
   * that for its median (2^-23 of the brightest where the median is darker).
   */
  vtkGetMacro(HDRFLIP, double);

  /**
   * Mean structural similarity (Wang et al. 2004) of the last ComparePictures, in [-1,1]; 1 means
   * equal. It is computed from the luma (Rec. 709) of FLIP's pictures in 11 x 11 Gaussian windows
   * about covered pixels at least 5 from the border; NaN if there is no such pixel.
   */
  vtkGetMacro(SSIM, double);

  /**
   * Mean CIEDE2000 color difference of the covered pixels of the last ComparePictures, computed
   * from FLIP's pictures on an sRGB display. A difference of 1 is just visible.
   */
  vtkGetMacro(DeltaE2000, double);

  /**
   * CIEDE2000 difference of two CIELAB colors (Sharma, Wu, Dalal 2005).
   */
  static double ComputeDeltaE2000(const double lab1[3], const double lab2[3]);

protected:
  vtkRadianceMetrics() = default;
  ~vtkRadianceMetrics() override = default;

  double RelativeL1 = 0.0;
  double RelativeRMSE = 0.0;
  double RelMSE = 0.0;
  double MedianRelative = 0.0;
  double P99Relative = 0.0;
  double Percentile95 = 0.0;
  double Percentile99 = 0.0;
  double SMAPE = 0.0;
  double FLIP = 0.0;
  double HDRFLIP = 0.0;
  double SSIM = 0.0;
  double DeltaE2000 = 0.0;
  std::atomic<bool> Abort{ false };

private:
  vtkRadianceMetrics(const vtkRadianceMetrics&) = delete;
  void operator=(const vtkRadianceMetrics&) = delete;
};

#endif
