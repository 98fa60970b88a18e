// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPictureDifference
 * @brief   how far a picture is from a reference: for image regression tests
 *
 * A picture is a vtkImageData of one slice with 1 to 4 components: gray, gray and alpha, RGB, RGBA.
 * Values of unsigned char and unsigned short are sRGB-encoded, as renderers write them to PNG
 * files; their colors are not multiplied by alpha. Values of float and double are linear light,
 * finite and not negative; their colors are multiplied by alpha, as in OpenEXR files.
 *
 * Pictures with transparent pixels are compared twice, over black and over white: the larger error
 * counts.
 */

#ifndef vtkPictureDifference_h
#define vtkPictureDifference_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Mask, Map

#include <string> // for names

class vtkImageData;

class VTKMEASUREDBRDF_EXPORT vtkPictureDifference : public vtkObject
{
public:
  static vtkPictureDifference* New();
  vtkTypeMacro(vtkPictureDifference, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MetricType
  {
    /// Mean FLIP (Andersson et al. 2020), in [0,1], 67 pixels per degree; light above 1 counts
    /// as 1.
    FLIP = 0,
    /// Mean HDR-FLIP (Andersson et al. 2021), in [0,1]; see vtkRadianceMetrics.
    HDR_FLIP = 1,
    /// Mean SSIM (Wang et al. 2004) of the encoded luma, in [-1,1], 1 is equal; whole windows only.
    SSIM = 2,
    /// Mean CIEDE2000, 0 up; light above 1 counts as 1.
    DELTA_E_2000 = 3,
    /// Mean |x - r| / mean r of linear light, 0 up.
    RELATIVE_L1 = 4,
    /// Largest difference of a stored value, alpha's among them; of integers, as a share of 255 or
    /// 65535.
    MAX_DIFFERENCE = 5,
    NUMBER_OF_METRICS
  };

  ///@{
  /**
   * About a metric: its name, such as "hdr_flip"; whether larger is better; the value up to which
   * (similarities: from which) pictures of two drivers are taken for equal, see
   * docs/image-tests.md. An empty name, false or 0 where there is no such metric.
   */
  static std::string GetMetricName(int metric);
  static bool IsSimilarity(int metric);
  static double GetDefaultThreshold(int metric);
  ///@}

  /**
   * The metric of that name; -1 if there is none.
   */
  static int FindMetric(const std::string& name);

  ///@{
  /**
   * One of MetricType; FLIP by default.
   */
  virtual void SetMetric(int metric);
  vtkGetMacro(Metric, int);
  ///@}

  ///@{
  /**
   * Width in pixels of a frame that is not compared, from 0 (the default) up.
   */
  virtual void SetBorder(int border);
  vtkGetMacro(Border, int);
  ///@}

  ///@{
  /**
   * A picture of the same size, or null (the default): only pixels whose first component is at
   * least half of its type's largest value (of floats: 0.5) are compared.
   */
  virtual void SetMask(vtkImageData* mask);
  vtkImageData* GetMask();
  ///@}

  ///@{
  /**
   * Take all pixels as opaque (default: false).
   */
  vtkSetMacro(IgnoreAlpha, bool);
  vtkGetMacro(IgnoreAlpha, bool);
  vtkBooleanMacro(IgnoreAlpha, bool);
  ///@}

  /**
   * Compare. Returns false with an error event and GetErrorMessage, which say what is wrong with
   * which picture, and then leaves the last results: sizes that differ, values that are not finite
   * or negative, a reference without light for a relative metric, nothing left to compare.
   */
  bool Compare(vtkImageData* picture, vtkImageData* reference);

  ///@{
  /**
   * Of the last Compare: the figure, and the error of each pixel in one float component (0 where
   * nothing is compared; 1 - SSIM for SSIM), null before.
   */
  vtkGetMacro(Value, double);
  vtkImageData* GetMap();
  ///@}

  /**
   * Whether the last Value is within a threshold: at most that, of similarities at least that.
   */
  bool IsWithin(double threshold);

  /**
   * The map in colors of magma, 3 components of unsigned char: black is no error. The brightest is
   * an error of 1, for CIEDE2000 of 10. A new image; null before Compare.
   */
  VTK_NEWINSTANCE vtkImageData* NewHeatMap();

  /**
   * What was wrong in the last Compare; empty if nothing.
   */
  vtkGetMacro(ErrorMessage, std::string);

protected:
  vtkPictureDifference();
  ~vtkPictureDifference() override;

  int Metric = FLIP;
  int Border = 0;
  vtkSmartPointer<vtkImageData> Mask;
  bool IgnoreAlpha = false;
  double Value = 0.0;
  int MapMetric = FLIP; // what Value and Map are of
  vtkSmartPointer<vtkImageData> Map;
  std::string ErrorMessage;

private:
  vtkPictureDifference(const vtkPictureDifference&) = delete;
  void operator=(const vtkPictureDifference&) = delete;
};

#endif
