// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StabilityRenderer.h"

#include "Inputs.h"
#include "Meshes.h"
#include "Progress.h"
#include "Scenes.h"
#include "Sheets.h"
#include "StabilityErrors.h"
#include "Surface.h"

#include "vtkActor.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr tool::View SphereView = { 30.0, 20.0 };
constexpr double SphereFill = 0.9;
constexpr int Tile = 128;
}

namespace tool::stability
{
//------------------------------------------------------------------------------
StabilityRenderer::StabilityRenderer(Context& context)
  : StabilityRenderer(context, vtkSmartPointer<vtkMeasuredBRDFMapper>::New())
{
}

//------------------------------------------------------------------------------
StabilityRenderer::StabilityRenderer(Context& context, vtkMeasuredBRDFMapper* mapper)
  : OffscreenScene(mapper)
  , Mapper(mapper)
{
  this->SetMesh(MakeSphere());
  this->SetView(SphereView.Azimuth, SphereView.Elevation, SphereFill);
  this->Open(Tile, Tile);
  context.Renderer = this->GetRendererName();
}

//------------------------------------------------------------------------------
void StabilityRenderer::SetIntegrator(vtkRadianceIntegrator* integrator)
{
  this->Mapper->SetBRDF(integrator->GetBRDF());
  this->Mapper->SetEnvironment(integrator->GetEnvironment());
  this->Mapper->SetIntegrator(integrator);
}

//------------------------------------------------------------------------------
Picture StabilityRenderer::Draw(int size)
{
  this->PlaceCamera(size, size);
  return this->DrawAsIs(size, size);
}

//------------------------------------------------------------------------------
Picture StabilityRenderer::DrawAsIs(int width, int height)
{
  Interruptible::Check();
  Picture picture = this->Capture(width, height);
  this->NumberOfBad = CountBad(std::vector<double>(picture.Pixels.begin(), picture.Pixels.end()));
  Decode(picture);
  return picture;
}

//------------------------------------------------------------------------------
Picture MakeSphereSheet(Context& context, const std::string& title, vtkBRDF* brdf,
  vtkEnvironment* environment, const std::vector<MethodUnderTest>& contenders)
{
  const Size size = { Tile, Tile };
  const Surface surface = FindSurface(MakeSphere(), SphereView, SphereFill, size, Tile * Tile);
  const std::vector<double> reference =
    IntegrateReference(brdf, environment, { surface.Normals, surface.Views });
  std::vector<double> sorted = reference;
  std::sort(sorted.begin(), sorted.end());
  const double exposure = 0.9 / std::max(sorted[sorted.size() * 99 / 100], 1e-30);
  Picture exact(Tile, Tile);
  for (std::size_t k = 0; k < surface.Pixels.size(); ++k)
  {
    float* pixel = &exact.Pixels[4 * static_cast<std::size_t>(surface.Pixels[k])];
    std::copy_n(&reference[3 * k], 3, pixel);
    pixel[3] = 1.0f;
  }

  const int columns = std::min<int>(static_cast<int>(contenders.size()) + 1, 5);
  const int rows = (static_cast<int>(contenders.size()) + columns) / columns;
  ContactSheet sheet(title, columns, rows, Tile, Tile);
  const auto add = [&](int k, Picture picture, const std::string& name, const std::string& note)
  {
    for (std::size_t p = 0; p < picture.Pixels.size(); ++p)
    {
      picture.Pixels[p] = p % 4 == 3 || !(picture.Pixels[p - p % 4 + 3] > 0.0f)
                            ? static_cast<float>(p % 4 == 3)
                            : static_cast<float>(RollOff(exposure * picture.Pixels[p]));
    }
    sheet.Add(k % columns, k / columns, picture, name, note);
  };
  add(0, exact, "reference", "");
  StabilityRenderer offscreen(context);
  for (std::size_t k = 0; k < contenders.size(); ++k)
  {
    const vtkSmartPointer<vtkRadianceIntegrator> integrator = contenders[k].Make(brdf, environment);
    offscreen.SetIntegrator(integrator);
    const Picture picture = offscreen.Draw(Tile);
    add(static_cast<int>(k) + 1, picture, contenders[k].Name,
      "error " + Say(100.0 * GetRelativeL1(Pick(picture, surface), reference)) + " %");
  }
  return sheet.GetPicture();
}

//------------------------------------------------------------------------------
std::vector<double> GetCovered(const Picture& picture)
{
  std::vector<double> values;
  for (std::size_t k = 0; k < picture.Pixels.size(); k += 4)
  {
    if (picture.Pixels[k + 3] > 0.0f)
    {
      values.insert(values.end(), &picture.Pixels[k], &picture.Pixels[k] + 3);
    }
  }
  return values;
}

//------------------------------------------------------------------------------
double GetPictureDifference(const Picture& a, const Picture& b)
{
  std::vector<double> values[2];
  for (std::size_t k = 0; k < std::min(a.Pixels.size(), b.Pixels.size()); k += 4)
  {
    if (a.Pixels[k + 3] > 0.0f && b.Pixels[k + 3] > 0.0f)
    {
      values[0].insert(values[0].end(), &a.Pixels[k], &a.Pixels[k] + 3);
      values[1].insert(values[1].end(), &b.Pixels[k], &b.Pixels[k] + 3);
    }
  }
  return values[1].empty() ? Unlimited : GetRelativeL1(values[0], values[1]);
}
} // namespace tool::stability
