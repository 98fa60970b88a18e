// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ComparisonSheet.h"

#include "ContactSheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tool
{
namespace
{
//------------------------------------------------------------------------------
// Values at the grid's points to every pixel that a picture covers: the nearest, or between them.
Picture Enlarge(const Picture& small, const Picture& covered, int stride, bool smooth)
{
  const int first = stride / 2;
  Picture result(covered.Width, covered.Height);
  for (int y = 0; y < covered.Height; ++y)
  {
    for (int x = 0; x < covered.Width; ++x)
    {
      const double u = static_cast<double>(x - first) / stride;
      const double v = static_cast<double>(y - first) / stride;
      double sum[4] = {};
      for (int j = static_cast<int>(std::floor(v)) - 1; j <= static_cast<int>(std::floor(v)) + 2;
           ++j)
      {
        for (int i = static_cast<int>(std::floor(u)) - 1; i <= static_cast<int>(std::floor(u)) + 2;
             ++i)
        {
          if (i < 0 || j < 0 || i >= small.Width || j >= small.Height || small.At(i, j)[3] == 0.0f)
          {
            continue;
          }
          // A tent between four neighbors; beyond the rim, those a little farther off.
          const double du = std::abs(u - i);
          const double dv = std::abs(v - j);
          const double weight = smooth ? std::max(0.0, 1.0 - du) * std::max(0.0, 1.0 - dv) +
                                           1e-6 / (0.01 + du * du + dv * dv)
                                       : std::exp(-40.0 * std::max(du, dv));
          for (int c = 0; c < 3; ++c)
          {
            sum[c] += weight * small.At(i, j)[c];
          }
          sum[3] += weight;
        }
      }
      float* pixel = result.At(x, y);
      for (int c = 0; c < 3 && sum[3] > 0.0; ++c)
      {
        pixel[c] = static_cast<float>(sum[c] / sum[3]);
      }
      pixel[3] = sum[3] > 0.0 ? covered.At(x, y)[3] : 0.0f;
    }
  }
  return result;
}

//------------------------------------------------------------------------------
// Blue below, white at and red above zero, at full color where |error| is 1.
RGB ColorError(double error)
{
  const double t = std::clamp(std::abs(error), 0.0, 1.0);
  const RGB far = error < 0.0 ? RGB{ 0.02, 0.1, 0.6 } : RGB{ 0.6, 0.03, 0.02 };
  RGB rgb;
  for (int c = 0; c < 3; ++c)
  {
    rgb[c] = (1.0 - t) * 0.85 + t * far[c];
  }
  return rgb;
}

//------------------------------------------------------------------------------
// Over dark gray, in display light.
Picture MakeTile(Picture picture, double exposure)
{
  for (std::size_t k = 0; k < picture.Pixels.size(); k += 4)
  {
    const double alpha = std::clamp<double>(picture.Pixels[k + 3], 0.0, 1.0);
    for (int c = 0; c < 3; ++c)
    {
      picture.Pixels[k + c] = static_cast<float>(
        alpha * RollOff(exposure * picture.Pixels[k + c]) + (1.0 - alpha) * 0.03);
    }
    picture.Pixels[k + 3] = 1.0f;
  }
  return picture;
}

//------------------------------------------------------------------------------
// The brightest hundredth of the values may be white.
double FindExposure(const std::vector<double>& radiance)
{
  std::vector<double> sorted = radiance;
  std::sort(sorted.begin(), sorted.end());
  return 0.9 / std::max(sorted[sorted.size() * 99 / 100], 1e-30);
}

//------------------------------------------------------------------------------
// Colors of each pixel's error, a share of the mean radiance; full at the given share.
std::vector<double> ColorErrors(
  const std::vector<double>& rgb, const std::vector<double>& reference, double scale)
{
  double mean = 0.0;
  for (const double value : reference)
  {
    mean += value / static_cast<double>(reference.size());
  }
  std::vector<double> errors;
  for (std::size_t k = 0; k < rgb.size(); k += 3)
  {
    const double error =
      (rgb[k] + rgb[k + 1] + rgb[k + 2] - reference[k] - reference[k + 1] - reference[k + 2]) /
      (3.0 * mean);
    const RGB color = ColorError(error / scale);
    errors.insert(errors.end(), color.begin(), color.end());
  }
  return errors;
}

//------------------------------------------------------------------------------
std::string FormatFigures(const ComparedPicture& picture)
{
  return "relative L1 " + FormatPercent(picture.RelativeL1) + ", " +
         FormatMilliseconds(picture.Frame) + " a frame, set-up " +
         FormatMilliseconds(picture.Setup);
}
}

//------------------------------------------------------------------------------
void WriteComparisonSheet(const std::string& path, const std::string& title, const Grid& grid,
  const std::vector<double>& rgb, const std::vector<double>& reference,
  const ComparedPicture& method, const ComparedPicture& stock)
{
  const double exposure = FindExposure(reference);
  // Full color at three times the mean error.
  const double scale = std::max(3.0 * method.RelativeL1, 1e-6);
  const std::vector<double> errors = ColorErrors(rgb, reference, scale);
  const int stride = grid.Surface.Stride;
  ContactSheet sheet(title, 4, 1, method.Drawn.Width, method.Drawn.Height);
  sheet.Add(0, 0, MakeTile(method.Drawn, exposure), method.Name, FormatFigures(method));
  sheet.Add(1, 0, MakeTile(Enlarge(grid.Draw(reference), method.Drawn, stride, true), exposure),
    "reference",
    std::to_string(grid.Surface.Pixels.size()) + " of " +
      std::to_string(grid.Surface.NumberOfCovered) + " pixels, interpolated");
  sheet.Add(2, 0, MakeTile(Enlarge(grid.Draw(errors), method.Drawn, stride, false), 1.0), "error",
    "blue: too dark, red: too bright; full color at " + FormatPercent(scale) +
      " of the mean radiance");
  sheet.Add(3, 0, MakeTile(stock.Drawn, exposure), stock.Name, FormatFigures(stock));
  sheet.Write(path);
}

//------------------------------------------------------------------------------
void WriteLightSheet(const std::string& path, const std::string& title, const std::string& name,
  const Grid& grid, const std::vector<ComparedLight>& lights)
{
  constexpr int smallest = 192; // tile
  const int enlarged = std::max((smallest + grid.Width - 1) / grid.Width, 1);
  Picture covered(enlarged * grid.Width, enlarged * grid.Height);
  for (int y = 0; y < covered.Height; ++y)
  {
    for (int x = 0; x < covered.Width; ++x)
    {
      const double u = 2.0 * (x + 0.5) / covered.Width - 1.0;
      const double v = 2.0 * (y + 0.5) / covered.Height - 1.0;
      const double inside = 0.5 * covered.Width * (1.0 - std::sqrt(u * u + v * v)); // pixels
      covered.At(x, y)[3] = static_cast<float>(std::clamp(inside + 0.5, 0.0, 1.0));
    }
  }
  ContactSheet sheet(title, 3, static_cast<int>(lights.size()), covered.Width, covered.Height);
  for (std::size_t row = 0; row < lights.size(); ++row)
  {
    const ComparedLight& light = lights[row];
    const double exposure = FindExposure(light.Reference);
    const double scale = std::max(3.0 * light.RelativeL1, 1e-6);
    const auto add = [&](int column, const std::vector<double>& rgb, double factor, bool smooth,
                       const std::string& label, const std::string& note)
    {
      const Picture tile = Enlarge(grid.Draw(rgb), covered, enlarged, smooth);
      sheet.Add(column, static_cast<int>(row), MakeTile(tile, factor), label, note);
    };
    char figures[64];
    std::snprintf(figures, sizeof(figures), ", FLIP %.3f", light.Flip);
    add(0, light.Reference, exposure, true, "reference", light.Name);
    add(1, light.Radiance, exposure, true, name,
      "relative L1 " + FormatPercent(light.RelativeL1) + figures);
    add(2, ColorErrors(light.Radiance, light.Reference, scale), 1.0, false, "error",
      "blue: too dark, red: too bright; full color at " + FormatPercent(scale));
  }
  sheet.Write(path);
}
} // namespace tool
