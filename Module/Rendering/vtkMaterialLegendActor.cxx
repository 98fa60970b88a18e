// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaterialLegendActor.h"

#include "NumberText.h"
#include "ParallelFor.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"
#include "vtkTexturedActor2D.h"
#include "vtkViewport.h"
#include "vtkWindow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr double Tolerance = 0.05;   // of the pictures
constexpr double LargestText = 0.33; // of a sphere's diameter, for its name
constexpr double TitleShare = 0.1;   // of the legend's height, at most
constexpr double LegendGap = 0.06;   // between entries, as a share of their size

// Entries stand in equal cells, each a sphere with its name to the right, and go down the columns.
struct LegendGrid
{
  int Rows = 1;
  double Width = 0.0; // of a cell, in pixels
  double Height = 0.0;
  double Sphere = 0.0; // diameter

  // The one with the largest spheres that leave most of the width to the names.
  static LegendGrid Find(int count, double width, double height)
  {
    LegendGrid best;
    for (int columns = 1; columns <= count; ++columns)
    {
      LegendGrid grid;
      grid.Rows = (count + columns - 1) / columns;
      grid.Width = width / columns;
      grid.Height = height / grid.Rows;
      const double share = columns > 1 ? 0.25 : 0.5;
      grid.Sphere = (1.0 - LegendGap) * std::min(share * grid.Width, grid.Height);
      best = grid.Sphere > best.Sphere ? grid : best;
    }
    return best;
  }
};

// A picture of a sphere of a material, RGBA in floats, radiance^(1/2.2), transparent around the
// sphere. Seen along -z from a great distance. Null where there is nothing to integrate with.
vtkSmartPointer<vtkImageData> MakeMaterialPicture(
  vtkBRDF* brdf, vtkEnvironment* environment, int pixels)
{
  vtkNew<vtkRadiancePlanner> planner;
  planner->SetBRDF(brdf);
  planner->SetEnvironment(environment);
  planner->SetErrorTolerance(Tolerance);
  if (!planner->Update())
  {
    return nullptr;
  }
  const auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> radiance;
  for (vtkDoubleArray* array : { normals.Get(), views.Get() })
  {
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(pixels) * pixels);
  }
  const double radius = 0.5 * pixels - 1.0; // room for a soft edge
  std::vector<double> coverage;
  for (int y = 0; y < pixels; ++y)
  {
    for (int x = 0; x < pixels; ++x)
    {
      double u = (x + 0.5 - 0.5 * pixels) / radius;
      double v = (y + 0.5 - 0.5 * pixels) / radius;
      const double r = std::hypot(u, v);
      coverage.push_back(std::clamp((1.0 - r) * radius + 0.5, 0.0, 1.0));
      const double inside = std::min(1.0, 0.999 / std::max(r, 1e-9));
      u *= inside;
      v *= inside;
      const vtkIdType k = static_cast<vtkIdType>(y) * pixels + x;
      normals->SetTuple3(k, u, v, std::sqrt(std::max(1.0 - u * u - v * v, 0.0)));
      views->SetTuple3(k, 0.0, 0.0, 1.0);
    }
  }
  if (!integrator || !integrator->Integrate(normals, views, radiance))
  {
    return nullptr;
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(pixels, pixels, 1);
  image->AllocateScalars(VTK_FLOAT, 4);
  auto* rgba = static_cast<float*>(image->GetScalarPointer());
  for (std::size_t k = 0; k < coverage.size(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = radiance->GetComponent(static_cast<vtkIdType>(k), c);
      *rgba++ = static_cast<float>(std::pow(std::max(value, 0.0), 1.0 / 2.2));
    }
    *rgba++ = static_cast<float>(coverage[k]);
  }
  return image;
}
}

struct vtkMaterialLegendActor::Internals
{
  // A square with the picture, in pixels, and the name.
  struct Entry
  {
    Entry()
    {
      vtkNew<vtkFloatArray> coordinates;
      coordinates->SetNumberOfComponents(2);
      for (int k = 0; k < 4; ++k)
      {
        coordinates->InsertNextTuple2(k == 1 || k == 2 ? 1.0 : 0.0, k / 2);
      }
      vtkNew<vtkPolyData> square;
      square->SetPoints(this->Corners);
      square->GetPointData()->SetTCoords(coordinates);
      square->AllocateExact(1, 4);
      const vtkIdType ids[4] = { 0, 1, 2, 3 };
      square->InsertNextCell(VTK_QUAD, 4, ids);
      vtkNew<vtkPolyDataMapper2D> mapper;
      mapper->SetInputData(square);
      this->Texture->InterpolateOn();
      this->Texture->SetColorModeToDirectScalars();
      this->Sphere->SetMapper(mapper);
      this->Sphere->SetTexture(this->Texture);
    }
    void Place(double left, double bottom, double size)
    {
      for (vtkIdType k = 0; k < 4; ++k)
      {
        this->Corners->InsertPoint(
          k, left + (k == 1 || k == 2 ? size : 0.0), bottom + (k / 2) * size, 0.0);
      }
      this->Corners->GetData()->Modified();
      this->Corners->Modified();
    }

    std::string Label;
    vtkSmartPointer<vtkImageData> Picture; // null: it could not be made
    vtkSmartPointer<vtkBRDF> Material;     // what it was made of
    vtkMTimeType Time = 0;
    int Resolution = 0;
    vtkNew<vtkPoints> Corners;
    vtkNew<vtkTexture> Texture;
    vtkNew<vtkTexturedActor2D> Sphere;
    vtkNew<vtkTextActor> Text;
  };

  vtkSmartPointer<vtkEnvironment> Sky; // where there is no environment
  vtkNew<vtkTextProperty> TextProperty;
  vtkSmartPointer<vtkTextActor> Title; // made when it is drawn: it needs VTK's fonts
  std::vector<std::unique_ptr<Entry>> Entries;
  std::vector<double> LayoutOf; // what the last layout depended on
  vtkMTimeType LayoutTime = 0;

  template <typename Visit>
  void ForEachActor(const Visit& visit)
  {
    for (const auto& entry : this->Entries)
    {
      if (entry->Picture)
      {
        visit(entry->Sphere.Get());
      }
      visit(entry->Text.Get());
    }
    if (this->Title && !this->Entries.empty())
    {
      visit(this->Title.Get());
    }
  }
};

vtkStandardNewMacro(vtkMaterialLegendActor);

//------------------------------------------------------------------------------
vtkMaterialLegendActor::vtkMaterialLegendActor()
  : Impl(new Internals)
{
  this->PositionCoordinate->SetCoordinateSystemToNormalizedViewport();
  this->PositionCoordinate->SetValue(0.8, 0.1);
  this->Position2Coordinate->SetValue(0.18, 0.8);
}

//------------------------------------------------------------------------------
vtkMaterialLegendActor::~vtkMaterialLegendActor() = default;

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::SetMaterialMap(vtkMaterialMap* map)
{
  measuredbrdfAssignMacro(MaterialMap, map);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::SetEnvironment(vtkEnvironment* environment)
{
  measuredbrdfAssignMacro(Environment, environment);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::SetTitle(const std::string& title)
{
  measuredbrdfAssignMacro(Title, title);
}

//------------------------------------------------------------------------------
vtkMaterialMap* vtkMaterialLegendActor::GetMaterialMap() { return this->MaterialMap; }
vtkEnvironment* vtkMaterialLegendActor::GetEnvironment() { return this->Environment; }

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkMaterialLegendActor, SphereResolution, int, 8, 512);

//------------------------------------------------------------------------------
vtkTextProperty* vtkMaterialLegendActor::GetTextProperty() { return this->Impl->TextProperty; }

//------------------------------------------------------------------------------
vtkMTimeType vtkMaterialLegendActor::GetMTime()
{
  vtkMTimeType time = std::max(this->Superclass::GetMTime(), this->Impl->TextProperty->GetMTime());
  time = std::max(time, this->MaterialMap ? this->MaterialMap->GetMTime() : 0);
  return std::max(time, this->Environment ? this->Environment->GetMTime() : 0);
}

//------------------------------------------------------------------------------
// A picture is made anew only where its own material, the light or the resolution changed.
void vtkMaterialLegendActor::UpdateEntries()
{
  vtkEnvironment* light = this->Environment;
  if (!light)
  {
    if (!this->Impl->Sky)
    {
      this->Impl->Sky = vtkSmartPointer<vtkEnvironment>::New();
      this->Impl->Sky->SetToProceduralSky();
    }
    light = this->Impl->Sky;
  }
  std::size_t shown = 0;
  for (int k = 0; this->MaterialMap && k < this->MaterialMap->GetNumberOfMaterials(); ++k)
  {
    vtkBRDF* brdf = this->MaterialMap->GetBRDF(k);
    if (!brdf)
    {
      continue;
    }
    if (shown == this->Impl->Entries.size())
    {
      this->Impl->Entries.push_back(std::make_unique<Internals::Entry>());
    }
    Internals::Entry& entry = *this->Impl->Entries[shown++];
    const std::string name = this->MaterialMap->GetName(k);
    entry.Label = name.empty() ? NumberText(this->MaterialMap->GetValue(k)) : name;
    const vtkMTimeType time = std::max(brdf->GetMTime(), light->GetMTime());
    if (entry.Material != brdf || entry.Time != time || entry.Resolution != this->SphereResolution)
    {
      entry.Material = brdf;
      entry.Time = time;
      entry.Resolution = this->SphereResolution;
      entry.Picture = MakeMaterialPicture(brdf, light, this->SphereResolution);
      entry.Texture->SetInputDataObject(entry.Picture);
      if (!entry.Picture)
      {
        vtkErrorMacro("There is no picture of material " << k << ".");
      }
    }
  }
  this->Impl->Entries.resize(shown);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::UpdateLayout(vtkViewport* viewport)
{
  const int* low = this->PositionCoordinate->GetComputedViewportValue(viewport);
  const double left = low[0];
  const double bottom = low[1];
  const int* high = this->Position2Coordinate->GetComputedViewportValue(viewport);
  const double width = std::max(high[0] - left, 8.0);
  const double height = std::max(high[1] - bottom, 8.0);
  vtkWindow* window = viewport->GetVTKWindow();
  const std::vector<double> from = { left, bottom, width, height,
    static_cast<double>(window ? window->GetDPI() : 0) };
  const vtkMTimeType time = this->GetMTime();
  if (from == this->Impl->LayoutOf && time == this->Impl->LayoutTime)
  {
    return; // fonts take time
  }
  this->Impl->LayoutOf = from;
  this->Impl->LayoutTime = time;
  this->UpdateEntries();
  this->Impl->Title = nullptr;
  if (this->Impl->Entries.empty())
  {
    return;
  }
  double room = height;
  if (!this->Title.empty())
  {
    room -= 1.2 * TitleShare * height;
    this->Impl->Title = vtkSmartPointer<vtkTextActor>::New();
    vtkTextActor* title = this->Impl->Title;
    title->SetInput(this->Title.c_str());
    title->GetTextProperty()->ShallowCopy(this->Impl->TextProperty);
    title->SetConstrainedFontSize(
      viewport, static_cast<int>(width), static_cast<int>(TitleShare * height));
    title->GetTextProperty()->SetVerticalJustificationToTop();
    title->SetPosition(left, bottom + height);
  }
  this->PlaceEntries(viewport, left, bottom, width, room);
}

//------------------------------------------------------------------------------
// All names have one size: the largest with which they fit.
void vtkMaterialLegendActor::PlaceEntries(
  vtkViewport* viewport, double left, double bottom, double width, double height)
{
  const int count = static_cast<int>(this->Impl->Entries.size());
  const LegendGrid grid = LegendGrid::Find(count, width, height);
  const double besides = (1.0 + LegendGap) * grid.Sphere;
  std::vector<vtkTextActor*> texts;
  for (int k = 0; k < count; ++k)
  {
    const double x = left + k / grid.Rows * grid.Width;
    const double middle = bottom + height - (k % grid.Rows + 0.5) * grid.Height;
    Internals::Entry& entry = *this->Impl->Entries[static_cast<std::size_t>(k)];
    entry.Place(x, middle - 0.5 * grid.Sphere, grid.Sphere);
    entry.Text->SetInput(entry.Label.c_str());
    entry.Text->GetTextProperty()->ShallowCopy(this->Impl->TextProperty);
    entry.Text->GetTextProperty()->SetJustificationToLeft();
    entry.Text->GetTextProperty()->SetVerticalJustificationToCentered();
    entry.Text->SetPosition(x + besides, middle);
    texts.push_back(entry.Text);
  }
  const double room = grid.Width - besides - LegendGap * grid.Sphere;
  int size[2];
  vtkTextActor::SetMultipleConstrainedFontSize(viewport, static_cast<int>(std::max(room, 1.0)),
    static_cast<int>(std::max(LargestText * grid.Sphere, 1.0)), texts.data(), count, size);
}

//------------------------------------------------------------------------------
int vtkMaterialLegendActor::RenderOverlay(vtkViewport* viewport)
{
  int drawn = 0;
  if (viewport)
  {
    this->Impl->ForEachActor(
      [&drawn, viewport](vtkActor2D* actor) { drawn += actor->RenderOverlay(viewport); });
  }
  return drawn;
}

//------------------------------------------------------------------------------
int vtkMaterialLegendActor::RenderOpaqueGeometry(vtkViewport* viewport)
{
  int drawn = 0;
  if (viewport && measuredbrdf::RunGuarded(
                    this, "RenderOpaqueGeometry", [&]() { this->UpdateLayout(viewport); }))
  {
    this->Impl->ForEachActor(
      [&drawn, viewport](vtkActor2D* actor) { drawn += actor->RenderOpaqueGeometry(viewport); });
  }
  return drawn;
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Impl->ForEachActor(
    [window](vtkActor2D* actor) { actor->ReleaseGraphicsResources(window); });
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkMaterialLegendActor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaterialMap: " << this->MaterialMap.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "Title: " << this->Title << "\n";
  os << indent << "SphereResolution: " << this->SphereResolution << "\n";
}
