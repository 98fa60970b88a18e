// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ComparisonStrip.h"

#include "Scene.h"

#include "vtkEnvironment.h"

#include <algorithm>
#include <utility>

namespace
{
constexpr int Smooth = 2; // panels are rendered at this multiple and averaged

//------------------------------------------------------------------------------
// Color for the pixels that an edge covers in part and whose center it misses: the mean of their
// neighbors.
void FillEdges(tool::Picture& picture, const tool::Picture& centers)
{
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      float* pixel = picture.At(x, y);
      if (centers.At(x, y)[3] > 0.0f || pixel[3] == 0.0f)
      {
        continue;
      }
      float sum[4] = {};
      for (int v = std::max(0, y - 1); v <= std::min(picture.Height - 1, y + 1); ++v)
      {
        for (int u = std::max(0, x - 1); u <= std::min(picture.Width - 1, x + 1); ++u)
        {
          const float* neighbor = centers.At(u, v);
          for (int c = 0; c < 4; ++c)
          {
            sum[c] += neighbor[3] * neighbor[c];
          }
        }
      }
      for (int c = 0; c < 3 && sum[3] > 0.0f; ++c)
      {
        pixel[c] = sum[c] / sum[3];
      }
      pixel[3] = sum[3] > 0.0f ? pixel[3] : 0.0f;
    }
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
ComparisonStrip::ComparisonStrip(
  const std::string& title, vtkEnvironment* environment, const Size& size, int panels)
  : PanelSize(size)
  , Background(environment)
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
  Picture centers(this->PanelSize.Width, this->PanelSize.Height);
  for (std::size_t k = 0; k < surface.Pixels.size(); ++k)
  {
    float* pixel = &centers.Pixels[4 * static_cast<std::size_t>(surface.Pixels[k])];
    std::copy_n(&radiance[3 * k], 3, pixel);
    pixel[3] = 1.0f;
  }
  Picture picture = centers;
  for (std::size_t k = 3; k < picture.Pixels.size(); k += 4)
  {
    picture.Pixels[k] = coverage.Pixels[k];
  }
  FillEdges(picture, centers);
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
} // namespace tool
