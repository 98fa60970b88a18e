// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Measuring.h"

#include "Methods.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"

#include <algorithm>
#include <cstdio>

namespace tool
{
//------------------------------------------------------------------------------
Grid::Grid(const tool::Surface& surface, const Size& size)
  : Surface(surface)
  , ImageWidth(size.Width)
  , Width((size.Width - surface.Stride / 2 + surface.Stride - 1) / surface.Stride)
  , Height((size.Height - surface.Stride / 2 + surface.Stride - 1) / surface.Stride)
{
}

//------------------------------------------------------------------------------
Picture Grid::Draw(const std::vector<double>& rgb) const
{
  Picture picture(this->Width, this->Height);
  for (std::size_t k = 0; k < this->Surface.Pixels.size(); ++k)
  {
    const int pixel = this->Surface.Pixels[k];
    picture.At(pixel % this->ImageWidth / this->Surface.Stride,
      pixel / this->ImageWidth / this->Surface.Stride) =
      glm::dvec4(rgb[3 * k], rgb[3 * k + 1], rgb[3 * k + 2], 1.0);
  }
  return picture;
}

//------------------------------------------------------------------------------
const std::vector<Metric>& GetMetrics()
{
  using Metrics = vtkRadianceMetrics;
  static const std::vector<Metric> metrics = { { "relative_l1", "relative L1 error", true,
                                                 &Metrics::GetRelativeL1 },
    { "relative_rmse", "relative RMS error", true, &Metrics::GetRelativeRMSE },
    { "rel_mse", "relMSE", false, &Metrics::GetRelMSE },
    { "median_relative", "median relative error", true, &Metrics::GetMedianRelative },
    { "p99_relative", "99th percentile of the relative error", true, &Metrics::GetP99Relative },
    { "percentile_95", "what 95 % of the pixels stay within", true, &Metrics::GetPercentile95 },
    { "percentile_99", "what 99 % of the pixels stay within", true, &Metrics::GetPercentile99 },
    { "smape", "SMAPE", true, &Metrics::GetSMAPE }, { "flip", "FLIP", false, &Metrics::GetFLIP },
    { "hdr_flip", "HDR-FLIP", false, &Metrics::GetHDRFLIP },
    { "ssim", "SSIM", false, &Metrics::GetSSIM },
    { "delta_e_2000", "Delta E 2000", false, &Metrics::GetDeltaE2000 } };
  return metrics;
}

//------------------------------------------------------------------------------
void Measure(vtkRadianceMetrics* metrics, const Grid& grid, const std::vector<double>& rgb,
  const std::vector<double>& reference)
{
  std::vector<double> pictures[2];
  std::vector<double> coverage;
  for (const bool isReference : { false, true })
  {
    const Picture picture = grid.Draw(isReference ? reference : rgb);
    for (std::size_t k = 0; k < picture.Pixels.size(); ++k)
    {
      std::vector<double>& part = k % 4 == 3 ? coverage : pictures[isReference];
      if (k % 4 != 3 || isReference)
      {
        part.push_back(picture.Pixels[k]);
      }
    }
  }
  const auto compare = [&](vtkRadianceMetrics* made)
  {
    return made->Compare(MakeArray(rgb, 3), MakeArray(reference, 3)) &&
           made->ComparePictures(grid.Width, grid.Height, MakeArray(pictures[0], 3),
             MakeArray(pictures[1], 3), MakeArray(coverage, 1));
  };
  if (!RunWithProgress(metrics, compare, "measuring"))
  {
    throw Error("measuring: " + TakeErrorText());
  }
}

//------------------------------------------------------------------------------
std::vector<double> IntegrateReference(
  vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface)
{
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(brdf);
  reference->SetEnvironment(environment);
  return IntegratePairs(reference, surface.Normals, surface.Views);
}

//------------------------------------------------------------------------------
std::string FormatPercent(double share)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g %%", 100.0 * share);
  return text;
}

//------------------------------------------------------------------------------
std::string FormatMilliseconds(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), value < 100.0 ? "%.3g ms" : "%.0f ms", value);
  return text;
}
} // namespace tool
