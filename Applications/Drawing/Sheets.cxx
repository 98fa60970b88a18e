// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sheets.h"

#include "Picture.h"
#include "Scenes.h"

#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace tool
{
namespace
{
constexpr tool::RGB PaperColor = { 0.013, 0.014, 0.017 };
}

//------------------------------------------------------------------------------
Picture MakePaper(int width, int height)
{
  Picture paper(width, height);
  for (int k = 0; k < width * height; ++k)
  {
    paper.At(k % width, k / width) = glm::vec4(PaperColor, 1.0f);
  }
  return paper;
}

//------------------------------------------------------------------------------
void Paste(Picture& sheet, const Picture& tile, int x0, int y0)
{
  const int left = std::max(0, -x0);
  const int right = std::min(tile.Width, sheet.Width - x0);
  for (int y = std::max(0, -y0); left < right && y < std::min(tile.Height, sheet.Height - y0); ++y)
  {
    std::copy_n(&tile.At(left, y), right - left, &sheet.At(x0 + left, y0 + y));
  }
}

//------------------------------------------------------------------------------
void RollOff(Picture& picture)
{
  for (float& value : picture.Pixels)
  {
    value = static_cast<float>(RollOff(value));
  }
}

//------------------------------------------------------------------------------
double ChooseExposure(vtkEnvironment* environment)
{
  double total[3];
  environment->GetTotal(total);
  const double mean = vtkEnvironment::GetLuminance(total) / (4.0 * vtkMath::Pi());
  return mean > 0.0 ? 0.7 / mean : 1.0;
}

//------------------------------------------------------------------------------
ContactSheet::ContactSheet(
  const std::string& title, int columns, int rows, int tileWidth, int tileHeight)
  : TileWidth(tileWidth)
  , TileHeight(tileHeight)
  , Font(std::clamp(tileWidth / 20, 9, 24))
  , Gap(std::max(4, tileWidth / 48))
  , CaptionHeight(Font * 11 / 2)
  , Paper(MakePaper(columns * (tileWidth + Gap) + Gap,
      rows * (tileHeight + CaptionHeight + Gap) + Gap + 3 * Font))
  , Top(Paper.Height - 3 * Font)
{
  DrawText(this->Paper, this->Gap + this->Font / 2, this->Top + this->Font,
    Fit(title, this->Font * 5 / 4, false, this->Paper.Width - 2 * this->Gap - this->Font),
    this->Font * 5 / 4, false, White);
}

//------------------------------------------------------------------------------
void ContactSheet::Add(
  int column, int row, const Picture& tile, const std::string& name, const std::string& note)
{
  const int x = this->Gap + column * (this->TileWidth + this->Gap);
  const int y = this->Top - (row + 1) * (this->TileHeight + this->CaptionHeight + this->Gap);
  Paste(this->Paper, tile, x, y + this->CaptionHeight);
  const int left = x + this->Font / 3;
  const int room = this->TileWidth - this->Font / 2;
  int line = y + this->CaptionHeight - this->Font * 7 / 4;
  DrawText(this->Paper, left, line, Fit(name, this->Font, true, room), this->Font, true, White);
  const int small = std::max(8, this->Font * 4 / 5);
  for (const std::string& text : Wrap(note, small, room, 3))
  {
    line -= small * 3 / 2;
    DrawText(this->Paper, left, line, text, small, false, Gray);
  }
}

//------------------------------------------------------------------------------
void ContactSheet::Write(const std::string& path) const { WritePNG(path, this->Paper, EncodeSRGB); }

namespace
{
//------------------------------------------------------------------------------
// Values at the grid's points to the pixels that a picture covers: of the nearest point, or of one
// beside that where it is not covered. Pixels that have neither show nothing.
Picture Enlarge(const Picture& small, const Picture& covered, int stride)
{
  Picture result(covered.Width, covered.Height);
  for (int y = 0; y < covered.Height; ++y)
  {
    for (int x = 0; x < covered.Width; ++x)
    {
      double nearest = 3.0; // squared, in strides
      for (int k = 0; k < 9 && covered.At(x, y)[3] > 0.0f; ++k)
      {
        const int i = x / stride + k % 3 - 1;
        const int j = y / stride + k / 3 - 1;
        if (i < 0 || j < 0 || i >= small.Width || j >= small.Height || small.At(i, j)[3] == 0.0f)
        {
          continue;
        }
        const double u = static_cast<double>(x - stride / 2) / stride - i;
        const double v = static_cast<double>(y - stride / 2) / stride - j;
        if (u * u + v * v < nearest)
        {
          nearest = u * u + v * v;
          result.At(x, y) = glm::vec4(glm::vec3(small.At(i, j)), covered.At(x, y).a);
        }
      }
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
  return glm::mix(RGB(0.85), far, t);
}

//------------------------------------------------------------------------------
// Over dark gray, in display light.
Picture MakeTile(Picture picture, double exposure)
{
  for (int k = 0; k < picture.Width * picture.Height; ++k)
  {
    glm::vec4& pixel = picture.At(k % picture.Width, k / picture.Width);
    const RGB rgb = exposure * RGB(pixel);
    pixel = glm::dvec4(glm::mix(RGB(0.03), RGB(RollOff(rgb.r), RollOff(rgb.g), RollOff(rgb.b)),
                         std::clamp<double>(pixel.a, 0.0, 1.0)),
      1.0);
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
    errors.insert(errors.end(), { color.r, color.g, color.b });
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
  sheet.Add(1, 0, MakeTile(Enlarge(grid.Draw(reference), method.Drawn, stride), exposure),
    "reference",
    std::to_string(grid.Surface.Pixels.size()) + " of " +
      std::to_string(grid.Surface.NumberOfCovered) + " pixels");
  sheet.Add(2, 0, MakeTile(Enlarge(grid.Draw(errors), method.Drawn, stride), 1.0), "error",
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
    const auto add = [&](int column, const std::vector<double>& rgb, double factor,
                       const std::string& label, const std::string& note)
    {
      const Picture tile = Enlarge(grid.Draw(rgb), covered, enlarged);
      sheet.Add(column, static_cast<int>(row), MakeTile(tile, factor), label, note);
    };
    char figures[64];
    std::snprintf(figures, sizeof(figures), ", FLIP %.3f", light.Flip);
    add(0, light.Reference, exposure, "reference", light.Name);
    add(1, light.Radiance, exposure, name,
      "relative L1 " + FormatPercent(light.RelativeL1) + figures);
    add(2, ColorErrors(light.Radiance, light.Reference, scale), 1.0, "error",
      "blue: too dark, red: too bright; full color at " + FormatPercent(scale));
  }
  sheet.Write(path);
}

namespace
{
constexpr int Smooth = 2; // panels are rendered at this multiple and averaged
}

//------------------------------------------------------------------------------
ComparisonStrip::ComparisonStrip(
  const std::string& title, vtkEnvironment* environment, const Size& size, int panels)
  : PanelSize(size)
  , Background{ environment }
  , Exposure(ChooseExposure(environment))
  , Sheet(title, panels, 1, size.Width, size.Height)
{
}

//------------------------------------------------------------------------------
void ComparisonStrip::AddRendered(
  OffscreenScene& scene, const std::string& name, const std::string& note)
{
  Picture picture = scene.Render(Smooth * this->PanelSize.Width, Smooth * this->PanelSize.Height);
  this->Add(std::move(picture), scene, Smooth, name, note);
}

//------------------------------------------------------------------------------
void ComparisonStrip::AddRadiance(OffscreenScene& scene, const Surface& surface,
  const std::vector<double>& radiance, const std::string& name, const std::string& note)
{
  const Picture coverage = Downsample(
    scene.Render(Smooth * this->PanelSize.Width, Smooth * this->PanelSize.Height), Smooth);
  Picture picture = Enlarge(Grid(surface, this->PanelSize).Draw(radiance), coverage, 1);
  scene.PlaceCamera(this->PanelSize.Width, this->PanelSize.Height);
  this->Add(std::move(picture), scene, 1, name, note);
}

//------------------------------------------------------------------------------
void ComparisonStrip::Add(Picture picture, const OffscreenScene& scene, int factor,
  const std::string& name, const std::string& note)
{
  ComposeOver(picture, scene, this->Background, this->Exposure);
  RollOff(picture);
  this->Sheet.Add(this->NumberOfPanels++, 0, Downsample(picture, factor), name, note);
}

namespace
{
// Drawn at this multiple and averaged: smooth edges.
constexpr int MapSmooth = 2;
constexpr tool::RGB Dark = { 0.0, 0.0, 0.0 };

//------------------------------------------------------------------------------
// The map as a picture: its typical brightness (mean of the logarithm) becomes mid gray.
tool::Picture ToneMap(vtkEnvironment* environment, int width, int height)
{
  tool::Picture picture = tool::Backdrop{ environment }.Draw(width, height);
  double logarithms = 0.0;
  double weights = 0.0;
  for (int k = 0; k < width * height; ++k)
  {
    const tool::RGB rgb(picture.At(k % width, k / width));
    const double luminance = vtkEnvironment::GetLuminance(&rgb.x);
    const double weight =
      luminance > 0.0 ? std::sin(vtkMath::Pi() * (k / width + 0.5) / height) : 0.0;
    logarithms += weight > 0.0 ? weight * std::log(luminance) : 0.0;
    weights += weight;
  }
  const double scale = weights > 0.0 ? 0.18 / std::exp(logarithms / weights) : 1.0;
  for (int k = 0; k < width * height; ++k)
  {
    glm::vec4& pixel = picture.At(k % width, k / width);
    pixel = glm::vec4(1.0f - glm::exp(-static_cast<float>(scale) * glm::vec3(pixel)), 1.0f);
  }
  return picture;
}

//------------------------------------------------------------------------------
// A bright frame in a box, and a dark one in that.
void DrawFrame(tool::Picture& picture, const int box[4])
{
  for (int y = box[1]; y < box[3]; ++y)
  {
    for (int x = box[0]; x < box[2]; ++x)
    {
      const int inset = std::min({ x - box[0], box[2] - 1 - x, y - box[1], box[3] - 1 - y });
      picture.Blend(x, y, inset < MapSmooth / 2 ? tool::White : Dark,
        inset < MapSmooth / 2 ? 0.85
        : inset < MapSmooth   ? 0.7
                              : 0.0);
    }
  }
}

//------------------------------------------------------------------------------
// A dot of the light's color in a bright ring in a dark one: seen on any ground.
void DrawDot(tool::Picture& picture, double x, double y, double radius, const tool::RGB& color)
{
  const double outer = radius + 2.0 * MapSmooth;
  for (int py = static_cast<int>(y - outer); py <= static_cast<int>(y + outer + 1.0); ++py)
  {
    for (int px = static_cast<int>(x - outer); px <= static_cast<int>(x + outer + 1.0); ++px)
    {
      const double distance = std::hypot(px + 0.5 - x, py + 0.5 - y);
      const bool isDot = distance < radius;
      const bool isRing = distance < radius + MapSmooth;
      picture.Blend((px % picture.Width + picture.Width) % picture.Width, py,
        isDot    ? color
        : isRing ? tool::White
                 : Dark,
        isRing             ? 1.0
        : distance < outer ? 0.8
                           : 0.0);
    }
  }
}
}

//------------------------------------------------------------------------------
Picture DrawLightMap(vtkEnvironment* environment, vtkLightSet* lights, bool regions,
  int previewWidth, int largestHeight)
{
  const double aspect = static_cast<double>(environment->GetHeight()) / environment->GetWidth();
  const int width = previewWidth * MapSmooth;
  const int height =
    MapSmooth * std::clamp(static_cast<int>(std::lround(previewWidth * aspect)), 16, largestHeight);
  Picture picture = ToneMap(environment, width, height);

  const int n = lights->GetNumberOfLights();
  for (int k = 0; regions && k < n; ++k)
  {
    int region[4];
    if (lights->GetRegion(k, region))
    {
      const int columns = environment->GetSubdivided()->GetWidth();
      const int rows = environment->GetSubdivided()->GetHeight();
      const int box[4] = { region[0] * width / columns, region[1] * height / rows,
        region[2] * width / columns, region[3] * height / rows };
      DrawFrame(picture, box);
    }
  }

  const double radius = MapSmooth * std::clamp(40.0 / std::sqrt(std::max(1, n)), 1.0, 4.0);
  for (int k = 0; k < n; ++k)
  {
    glm::dvec3 direction;
    RGB irradiance;
    lights->GetDirection(k, &direction.x);
    lights->GetIrradiance(k, &irradiance.x);
    double u;
    double v;
    vtkEnvironment::GetCoordinates(&direction.x, u, v);
    const double peak = std::max({ irradiance.r, irradiance.g, irradiance.b, 1e-300 });
    DrawDot(picture, u * width, v * height, radius, irradiance / peak);
  }
  return Downsample(picture, MapSmooth);
}
} // namespace tool
