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
int Grid::Find(std::size_t k) const
{
  const int x = this->Surface.Pixels[k] % this->ImageWidth / this->Surface.Stride;
  const int y = this->Surface.Pixels[k] / this->ImageWidth / this->Surface.Stride;
  return y * this->Width + x;
}

//------------------------------------------------------------------------------
Picture Grid::Draw(const std::vector<double>& rgb) const
{
  Picture picture(this->Width, this->Height);
  for (std::size_t k = 0; k < this->Surface.Pixels.size(); ++k)
  {
    float* pixel = &picture.Pixels[4 * static_cast<std::size_t>(this->Find(k))];
    std::copy_n(&rgb[3 * k], 3, pixel);
    pixel[3] = 1.0f;
  }
  return picture;
}

//------------------------------------------------------------------------------
const std::vector<Metric>& GetMetrics()
{
  using Metrics = vtkRadianceMetrics;
  static const std::vector<Metric> metrics = { { "relative_l1", "relative L1 error", true, true,
                                                 [](Metrics* m) { return m->GetRelativeL1(); } },
    { "relative_rmse", "relative RMS error", true, true,
      [](Metrics* m) { return m->GetRelativeRMSE(); } },
    { "rel_mse", "relMSE", false, true, [](Metrics* m) { return m->GetRelMSE(); } },
    { "median_relative", "median relative error", true, true,
      [](Metrics* m) { return m->GetMedianRelative(); } },
    { "p99_relative", "99th percentile of the relative error", true, true,
      [](Metrics* m) { return m->GetP99Relative(); } },
    { "percentile_95", "what 95 % of the pixels stay within", true, true,
      [](Metrics* m) { return m->GetPercentile95(); } },
    { "percentile_99", "what 99 % of the pixels stay within", true, true,
      [](Metrics* m) { return m->GetPercentile99(); } },
    { "smape", "SMAPE", true, true, [](Metrics* m) { return m->GetSMAPE(); } },
    { "flip", "FLIP", false, true, [](Metrics* m) { return m->GetFLIP(); } },
    { "hdr_flip", "HDR-FLIP", false, true, [](Metrics* m) { return m->GetHDRFLIP(); } },
    { "ssim", "SSIM", false, false, [](Metrics* m) { return m->GetSSIM(); } },
    { "delta_e_2000", "Delta E 2000", false, true,
      [](Metrics* m) { return m->GetDeltaE2000(); } } };
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
